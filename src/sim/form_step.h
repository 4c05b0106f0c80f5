/* How a tether of each form comes to its ends: a table of functions for each form, beside the table
   of world/form.h.

   The model of a tether and the world of the dive want a form.  After a change of the model the
   tether still has the former form; the next call of bt__resolve_tether (resolve.c) lays the tether
   anew in the wanted form.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#ifndef BT_SIM_FORM_STEP_H
#define BT_SIM_FORM_STEP_H

#include "sim/sim.h"

typedef bt_status bt__form_move (bt_dive *dive, bt__state *state, int i, const bt__ends *ends,
                                 bt_error *error);

typedef struct bt__form_step
{
  bt__form_move *lay;   /* give tether I the wanted form, between ENDS */
  bt__form_move *carry; /* bring tether I to ENDS in no time, for an operation */
  bt__form_move *step;  /* bring tether I to ENDS in a step */

  /* True if CARRY would not change tether I, laid in the wanted form with both ends at ENDS.  */
  int (*rests) (const bt_dive *dive, bt__state *state, int i, const bt__ends *ends);
} bt__form_step;

extern const bt__form_step bt__step_shape, bt__step_cable; /* resolve.c */
extern const bt__form_step bt__step_spans, bt__step_held;  /* contact_static.c */

/* Return the form that the model of TETHER wants in the world of DIVE.  */
bt__tether_form bt__wanted_form (const bt_dive *dive, const bt__tether *tether);

/* Return the functions of FORM.  */
const bt__form_step *bt__form_step_of (bt__tether_form form);

#endif
