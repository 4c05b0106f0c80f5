/* Asking a tether, be it a static shape or the moving line.

   bt__line_of finds the form of a tether once (world/form.h); every question then takes the arc
   length s, m from the anchor, and asks the functions of the form.

   A parted line has two chains.  The near chain answers questions along the line, the far chain
   tells the force on the vehicle; bt__line_tail makes the far chain a line of its own.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <math.h>

#include "world/form.h"

#define FOLLOWED 1e-4 /* m: a line so near to where its winch stands has followed it */

/* The default accuracy, m, where its share of what is paid out is more.  */
#define USUAL_ACCURACY 0.02

const bt__form *
bt__form_of (const bt__tether *tether)
{
  static const bt__form *const forms[BT__TETHER_FORMS] = {
    [BT__TETHER_SHAPE] = &bt__form_shape,
    [BT__TETHER_SPANS] = &bt__form_spans,
    [BT__TETHER_HELD] = &bt__form_held,
    [BT__TETHER_CABLE] = &bt__form_cable,
  };
  return forms[bt__tether_form_of (tether)];
}

bt__line
bt__line_of (const bt_dive *dive, bt__state *state, int i)
{
  const bt__tether *tether = bt__dive_tether (dive, state, i);
  bt__line line = { .tether = tether, .form = bt__form_of (tether) };
  line.form->find (dive, state, i, &line);
  return line;
}

bt__line
bt__line_tail (const bt__line *line)
{
  bt__line tail = *line;
  tail.chain = line->far_chain;
  tail.contacts = line->far_contacts;
  return tail;
}

double
bt__accuracy (const bt__tether *tether)
{
  return tether->props.accuracy != BT_ACCURACY_AUTO
             ? tether->props.accuracy
             : fmin (USUAL_ACCURACY, BT__ACCURATE_SHARE * tether->length);
}

double
bt__line_length (const bt__line *line)
{
  return line->form->length (line);
}

int
bt__line_has_followed (const bt__line *line)
{
  return !line->chain || fabs (bt__dynamic_length (line->chain) - line->tether->length) <= FOLLOWED;
}

double
bt__line_out (const bt__line *line)
{
  return bt__line_has_followed (line) ? line->tether->length : bt__dynamic_length (line->chain);
}

bt_vec3
bt__line_point (const bt__line *line, double s)
{
  return line->form->point (line, s);
}

bt_vec3
bt__line_tangent (const bt__line *line, double s)
{
  return line->form->tangent (line, s);
}

double
bt__line_tension (const bt__line *line, double s)
{
  return line->form->tension (line, s);
}

double
bt__line_tension_max (const bt__line *line)
{
  return line->form->tension_max (line);
}

int
bt__line_nodes (const bt__line *line)
{
  return line->form->nodes (line);
}

bt_vec3
bt__line_node (const bt__line *line, int k)
{
  return line->form->node (line, k);
}

double
bt__line_node_tension (const bt__line *line, int k)
{
  return line->form->node_tension (line, k);
}

bt_vec3
bt__line_end (const bt__line *line, int k)
{
  return line->form->end (line, k);
}

bt_vec3
bt__line_pull (const bt__line *line, int k)
{
  return line->form->pull (line, k);
}

double
bt__chain_error (const bt__dynamic *chain)
{
  return BT__CHAIN_ERROR * bt__dynamic_space_error (chain, NULL);
}

double
bt__line_error (const bt__line *line)
{
  if (!line->chain)
    return NAN;
  double error = fmax (BT__COMMON_ERROR * bt__chain_error (line->chain), line->tether->look.error);
  return fmax (error, fabs (line->chain->owed));
}
