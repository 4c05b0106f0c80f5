/* Asking a tether, be it a static shape or the moving line.

   A tether has one of four forms: a static shape with closed formulas, a shape with node arrays, a
   polyline (split into spans by a thesis model, or held by obstacles), or the chain of the moving
   line. bt__line_of finds the form once; every question then takes the arc length s, m from the
   anchor, and asks the form.  Forces and tensions at nodes of a moving line are those of its last
   step.

   A parted line has two chains.  The near chain answers questions along the line, the far chain
   tells the force on the vehicle; bt__line_tail makes the far chain a line of its own.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <math.h>

#include "math/vec.h"
#include "world/line.h"

#define FOLLOWED 1e-4 /* m: a line so near to where its winch stands has followed it */

/* The polyline by which obstacles hold tether I; NULL if the line follows its shape and only the
   shape's own points were kept clear of obstacles.  */
static const bt__polyline *
held_line (const bt_dive *dive, bt__state *state, int i)
{
  const bt__tether *tether = bt__dive_tether (dive, state, i);
  const bt__polyline *held = bt__dive_held (dive, state, i);
  return tether->blocked || held->n != tether->props.nodes + 1 ? held : NULL;
}

bt__line
bt__line_of (const bt_dive *dive, bt__state *state, int i)
{
  bt__line line = { .tether = bt__dive_tether (dive, state, i) };
  if (line.tether->shape.form == BT__FORM_CHAIN)
    {
      line.chain = bt__dive_chain (dive, state, i, 0);
      line.far_chain = bt__dive_chain (dive, state, i, line.tether->parted ? 1 : 0);
      return line;
    }
  if (line.tether->contact_form == BT__CONTACT_FORM_SPANS)
    line.split = bt__dive_thesis (dive, state, i);
  else if (line.tether->contact_form == BT__CONTACT_FORM_HELD)
    line.held = held_line (dive, state, i);
  line.nodes = bt__dive_nodes (dive, state, i);
  line.tensions = bt__dive_tensions (dive, state, i);
  return line;
}

bt__line
bt__line_tail (const bt__line *line)
{
  bt__line tail = *line;
  tail.chain = line->far_chain;
  return tail;
}

double
bt__line_length (const bt__line *line)
{
  if (line->split) /* length as it lies: a held polyline approaches its paid-out length step by step
                    */
    {
      bt__polyline *way = bt__thesis_line (line->split);
      return bt__polyline_u (way)[way->n - 1];
    }
  return line->chain ? bt__dynamic_length (line->chain) : line->tether->shape.length;
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

/* ---- Anywhere along the line ---- */

bt_vec3
bt__line_point (const bt__line *line, double s)
{
  if (line->chain)
    return bt__dynamic_point (line->chain, s);
  if (line->split)
    return bt__thesis_point (line->split, s);
  if (line->held)
    return bt__polyline_point (line->held, s);
  return bt__shape_point (&line->tether->shape, line->nodes, line->tensions, s);
}

/* The direction between two points a hundredth of an interval to either side.  */
static bt_vec3
chain_tangent (const bt__dynamic *chain, double s)
{
  double length = bt__dynamic_length (chain), e = 0.01 * length / (double)chain->n;
  bt_vec3 a = bt__dynamic_point (chain, fmax (s - e, 0));
  bt_vec3 b = bt__dynamic_point (chain, fmin (s + e, length));
  return bt__unit_or (bt__sub (b, a), bt__vec (0, 0, -1));
}

bt_vec3
bt__line_tangent (const bt__line *line, double s)
{
  if (line->chain)
    return chain_tangent (line->chain, s);
  if (line->split)
    return bt__thesis_tangent (line->split, s);
  if (line->held)
    return bt__polyline_tangent (line->held, s);
  return bt__shape_tangent (&line->tether->shape, line->nodes, line->tensions, s);
}

/* Between the tensions of the nodes to either side.  */
static double
chain_tension (const bt__dynamic *chain, double s)
{
  const double *rest = bt__dynamic_rest (chain);
  int i = 0, last = (int)chain->n - 1;
  double k, t0, t1;
  s = bt__dynamic_along (chain, s);
  for (; i < last && s > rest[i]; i++)
    s -= rest[i];
  k = fmax (0, fmin (1, s / rest[i]));
  t0 = bt__dynamic_node_tension (chain, i);
  t1 = bt__dynamic_node_tension (chain, i + 1);
  return t0 + k * (t1 - t0);
}

double
bt__line_tension (const bt__line *line, double s)
{
  if (line->chain)
    return chain_tension (line->chain, s);
  if (line->split)
    return bt__thesis_tension (line->split, s);
  return bt__shape_tension (&line->tether->shape, line->nodes, line->tensions, s);
}

static double
largest_tension (const bt__dynamic *chain)
{
  const double *t = bt__dynamic_tension (chain);
  double most = 0;
  for (int64_t j = 0; j < chain->n; j++)
    most = fmax (most, t[j]);
  return most;
}

/* The ends of a moving line bear the loads of half an interval more than the last tension.  */
double
bt__line_tension_max (const bt__line *line)
{
  double ends;
  if (!line->chain)
    return line->tether->tension_max;
  ends = fmax (bt__line_tension (line, 0), bt__norm (bt__line_force (line)));
  ends = fmax (ends, line->tether->peak);
  return fmax (ends, fmax (largest_tension (line->chain), largest_tension (line->far_chain)));
}

/* ---- The model's own points ---- */

int
bt__line_nodes (const bt__line *line)
{
  const bt__polyline *polyline = line->split ? bt__thesis_line (line->split) : line->held;
  if (line->chain)
    return (int)line->chain->n + 1;
  if (polyline)
    return (int)polyline->n;
  switch (line->tether->shape.form)
    {
    case BT__FORM_STRAIGHT:
      return 2;
    case BT__FORM_V:
      return 3;
    default:
      return (int)line->tether->props.nodes + 1;
    }
}

/* The arc length of the K-th point of a static shape: the V has one at its bend.  */
static double
share_of_point (const bt__line *line, int k)
{
  const bt__shape *shape = &line->tether->shape;
  if (line->split)
    return bt__polyline_u (bt__thesis_line (line->split))[k];
  if (line->held)
    return bt__polyline_u ((bt__polyline *)line->held)[k];
  int n = bt__line_nodes (line);
  if (shape->form == BT__FORM_V && k == 1)
    return shape->v.l1 * (shape->length / (shape->v.l1 + shape->v.l2));
  return k == n - 1 ? shape->length : shape->length * k / (n - 1);
}

bt_vec3
bt__line_node (const bt__line *line, int k)
{
  return line->chain ? bt__dynamic_x (line->chain)[k]
                     : bt__line_point (line, share_of_point (line, k));
}

double
bt__line_node_tension (const bt__line *line, int k)
{
  return line->chain ? bt__dynamic_node_tension (line->chain, k)
                     : bt__line_tension (line, share_of_point (line, k));
}

/* ---- Errors and forces ---- */

double
bt__chain_error (const bt__dynamic *chain)
{
  return BT__CHAIN_ERROR * bt__dynamic_space_error (chain, NULL);
}

bt_vec3
bt__line_force (const bt__line *line)
{
  double s = bt__line_length (line);
  if (line->far_chain)
    return line->far_chain->pull[1];
  return bt__scale (-bt__line_tension (line, s), bt__line_tangent (line, s));
}
