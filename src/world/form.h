/* What keeps the shape of a tether: a table of functions for each form (bt__tether_form).

   A static shape, spans, a held polyline and the moving line lie in the same store of a tether and
   answer the same questions.  bt__line_of finds the form of a tether once; line.h, the layout of a
   state, the judge of a state and the laying of a tether then call the functions of the form.  How
   a tether of each form is stepped stands in a second table, sim/form_step.h.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#ifndef BT_WORLD_FORM_H
#define BT_WORLD_FORM_H

#include "base/range.h"
#include "base/record.h"
#include "contact/touch.h"
#include "world/line.h"

/* The most live ranges of a store: the wear, and chain and contacts of both parts of a line.  */
enum
{
  BT__STORE_RANGES = 1 + 2 * (BT__DYNAMIC_RANGES + 1)
};

typedef struct bt__form
{
  /* Point LINE to what is kept of tether I.  */
  void (*find) (const bt_dive *dive, bt__state *state, int i, bt__line *line);

  /* The answers of line.h: bt__line_length asks LENGTH, and so on.  */
  double (*length) (const bt__line *line);
  bt_vec3 (*point) (const bt__line *line, double s);
  bt_vec3 (*tangent) (const bt__line *line, double s);
  double (*tension) (const bt__line *line, double s);
  double (*tension_max) (const bt__line *line);
  bt_vec3 (*end) (const bt__line *line, int k);
  bt_vec3 (*pull) (const bt__line *line, int k);
  int (*nodes) (const bt__line *line);
  bt_vec3 (*node) (const bt__line *line, int k);
  double (*node_tension) (const bt__line *line, int k);

  /* Return how often LINE, tether I of the present state, touches; TOUCH receives up to ROOM.  */
  int (*touches) (const bt_dive *dive, int i, const bt__line *line, bt__touch *touch, int room);

  /* Return the *N points along which tether I lies; NULL and 0: it is not laid yet.  */
  const bt_vec3 *(*laid) (const bt_dive *dive, bt__state *state, int i, int *n);

  /* Put the used ranges of the store of tether I into OUT, in order, and return the number of
     ranges.  STATE may come from outside: RANGES is asked before JUDGE has judged the store.  */
  int (*ranges) (const bt_dive *dive, const bt__state *state, int i, bt__range *out);
  bt_status (*judge) (bt__judge *judge, const bt_dive *dive, bt__state *state, int i);
} bt__form;

extern const bt__form bt__form_shape, bt__form_spans, bt__form_held; /* form_static.c */
extern const bt__form bt__form_cable;                                /* form_cable.c */

/* Return the functions of the present form of TETHER.  */
const bt__form *bt__form_of (const bt__tether *tether);

#endif
