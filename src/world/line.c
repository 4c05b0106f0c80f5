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
  error = fmax (error, fabs (line->chain->owed));
  if (line->far_chain != line->chain)
    error = fmax (error, BT__COMMON_ERROR * bt__chain_error (line->far_chain));
  return error;
}

/* Add to SUM the energies of CHAIN, of tether I, BEYOND metres from its far end.  */
static void
add_energies (const bt_dive *dive, bt__state *state, int i, const bt__dynamic *chain, double beyond,
              bt_energy *sum)
{
  const bt_tether_def *def = &dive->model->tethers[i];
  bt_water water = bt__dive_water (dive, state);
  bt__dynamic_set sets[BT_SETS_MAX];
  bt__dynamic_input input = { .line = &bt__dive_tether (dive, state, i)->props,
                              .water = &water,
                              .h = BT__TIME_STEP,
                              .sets = sets };
  input.n_sets = bt__place_sets (def->sets, (int)def->n_sets, def->length, beyond, sets);
  bt__dynamic_energy e = bt__dynamic_energies (chain, &input);
  sum->kinetic += e.kinetic;
  sum->strain += fmax (0, e.strain - bt__dynamic_crumple_energy (chain, &input));
  sum->gravity += e.gravity;
  sum->bending += e.bending;
}

bt_energy
bt__line_energy (const bt_dive *dive, bt__state *state, int i)
{
  bt__line line = bt__line_of (dive, state, i);
  bt_energy sum = { .lost = line.tether->shed };
  add_energies (dive, state, i, line.chain, bt__beyond_chain (dive, state, i), &sum);
  if (line.far_chain != line.chain)
    add_energies (dive, state, i, line.far_chain, 0, &sum);
  return sum;
}
