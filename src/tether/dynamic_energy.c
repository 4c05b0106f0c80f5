/* The moving line: energies, and the energy guard of a line left alone.

   A line without water, winch and moving ends can gain no energy.  Backward Euler keeps to this:
   the potential of the step's equations is convex, and every step loses some energy.  The
   second-order differences lose less, but may add energy where a line runs taut.  So the guard
   compares energies: after a step by second-order differences with more energy than the line had
   when left alone, the step is taken again by backward Euler.

   If the repeated step gains as well, because the step was not solved or bending was held in the
   step, all velocities are slowed down until the gain is gone.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <math.h>

#include "tether/dynamic_frame.h"

#define NOTHING 1e-12 /* of what moves, is strained and can fall: no gain */

/* What an interval stores at the stretch E: one under bending is strained by pushing too.  */
static double
strain_energy (double ea, double rest, double e, int bends)
{
  double over = e - 1;
  return over > 0 || bends ? 0.5 * ea * rest * over * over : 0;
}

/* What D stores at X by bending and twist, twisted as D is, or as W is if W is not NULL.  */
static double
bending_energy (const bt__dynamic *d, const bt__dynamic_work *w, const bt_vec3 *x,
                const bt__dynamic_input *in)
{
  const double *rest = bt__dynamic_rest (d);
  double sum = 0, ei = in->line->ei;
  int n = (int)d->n;
  bt__frame_line l = { .in = in, .x = x, .n = n, .rest = rest };
  if (bt__twists (in))
    {
      bt__twist_of (d, w, &l);
      sum = bt__twist_energy (&l);
    }
  if (in->n_sets > 0 && ei > 0)
    return sum + bt__set_energy (&l);
  for (int i = 1; i < n && ei > 0; i++)
    {
      double cell = 0.5 * (rest[i - 1] + rest[i]);
      sum += 0.5 * ei * bt__turn_square (x + i, rest[i - 1], rest[i]) / cell;
    }
  return bt__layers_slip (in->line) ? sum + bt__slip_energy (d, in, x) : sum;
}

/* The energies of D at the places X with the velocities V, twisted as D is, or as W.  */
static bt__dynamic_energy
energies_at (const bt__dynamic *d, const bt__dynamic_work *w, const bt__dynamic_input *in,
             const bt_vec3 *x, const bt_vec3 *v)
{
  const double *rest = bt__dynamic_rest (d);
  const bt_vec3 *chord = in->order == 4 ? bt__dynamic_chord (d) : NULL;
  const bt_tether_props *p = in->line;
  double ma = in->water->density * p->ca * BT__PI * p->diameter * p->diameter / 4;
  double ea = bt__stiffness (p->ea);
  double lift = in->water->density > 0 ? p->mass * in->water->gravity - p->wet_weight : 0;
  int n = (int)d->n;
  bt__dynamic_energy sum = { 0, 0, 0, bending_energy (d, w, x, in) };
  for (int i = 0; i <= n; i++)
    {
      double cell = 0.5 * ((i ? rest[i - 1] : 0) + (i < n ? rest[i] : 0));
      bt_vec3 tau = bt__sub (x[i < n ? i + 1 : i], x[i ? i - 1 : i]);
      double along = ma > 0 ? bt__dot (v[i], bt__unit_or (tau, bt__vec (0, 0, -1))) : 0;
      sum.kinetic += 0.5 * cell * ((p->mass + ma) * bt__dot (v[i], v[i]) - ma * along * along);
      sum.gravity += p->wet_weight * cell * x[i].z;
    }
  for (int j = 0; j < n; j++)
    {
      bt_vec3 c = bt__sub (x[j + 1], x[j]);
      double length
          = chord ? bt__norm (bt__add (c, chord[j])) : bt__norm (c) - bt__dynamic_chord (d)[j].z;
      double e = length / rest[j];
      sum.strain += strain_energy (ea, rest[j], e, p->ei > 0);
      if (in->surfaced && lift > 0)
        sum.gravity += lift * bt__dynamic_out (in->water, rest[j], x[j], x[j + 1]);
    }
  return sum;
}

bt__dynamic_energy
bt__dynamic_energies (const bt__dynamic *d, const bt__dynamic_input *in)
{
  bt__dynamic_energy now = energies_at (d, NULL, in, bt__dynamic_x (d), bt__dynamic_v (d));
  if (!isfinite (in->line->ea)) /* its strain is what a solved step may leave undone */
    now.strain = 0;
  return now;
}

double
bt__dynamic_crumple_energy (const bt__dynamic *d, const bt__dynamic_input *in)
{
  const double *rest = bt__dynamic_rest (d), *tension = bt__dynamic_tension (d);
  const bt_vec3 *x = bt__dynamic_x (d);
  double ea = bt__stiffness (in->line->ea), sum = 0;
  for (int j = 0; j < d->n && in->line->ei > 0 && isfinite (in->line->ea); j++)
    {
      double e = (bt__distance (x[j], x[j + 1]) - bt__dynamic_chord (d)[j].z) / rest[j];
      double pressed = 1 + fmin (tension[j], 0) / ea; /* the stretch that the tension tells */
      if (e < pressed)
        sum += strain_energy (ea, rest[j], e, 1) - strain_energy (ea, rest[j], pressed, 1);
    }
  return sum;
}

/* ---- A line alone ---- */

int
bt__dynamic_is_alone (const bt__dynamic *d, const bt__dynamic_input *in)
{
  const bt_vec3 *x = bt__dynamic_x (d);
  if (in->water->density > 0 || in->pay != 0 || in->hold > 0 || d->owed != 0)
    return 0;
  for (int k = 0; k < 2; k++)
    {
      const bt__dynamic_end *e = in->end + k;
      if (e->free ? e->gripped : bt__distance (e->at, x[k ? d->n : 0]) > 0)
        return 0;
    }
  return 1;
}

/* The energy of D at X and V with what is lumped there, J; *MOVING of that by motion, and *GRAIN
   what is no difference.  */
static double
energy_of (const bt__dynamic *d, const bt__dynamic_work *w, const bt_vec3 *x, const bt_vec3 *v,
           double *moving, double *grain)
{
  bt__dynamic_energy e = energies_at (d, x == w->X ? w : NULL, w->in, x, v);
  double length = bt__dynamic_length (d), weight = fabs (w->weight) * length;
  for (int i = 0; w->lumped && i <= w->n; i++)
    {
      const bt__extra *l = w->extra + i;
      e.kinetic += 0.5 * l->mass * bt__dot (v[i], v[i]);
      e.gravity += l->weight * x[i].z - bt__dot (l->force, bt__sub (x[i], w->x[i]));
    }
  *moving = e.kinetic;
  *grain = NOTHING * (e.kinetic + e.strain + e.bending + weight * length);
  return e.kinetic + e.strain + e.gravity + e.bending;
}

static double
energy_now (const bt__dynamic *d, const bt__dynamic_work *w)
{
  double moving, grain;
  return energy_of (d, w, bt__dynamic_x (d), bt__dynamic_v (d), &moving, &grain);
}

double
bt__dynamic_most (const bt__dynamic *d, const bt__dynamic_work *w)
{
  double now = energy_now (d, w);
  return now == d->left && d->most > now ? d->most : now;
}

/* Return what the solution has more than MOST, J; *MOVING its kinetic energy.  */
static double
excess (const bt__dynamic *d, bt__dynamic_work *w, double most, double *moving)
{
  double grain;
  for (int i = 0; i <= w->n; i++)
    w->keep[i] = bt__node_v (w, i);
  double over = energy_of (d, w, w->X, w->keep, moving, &grain) - most;
  return over <= grain ? 0 : over;
}

int
bt__dynamic_gains (const bt__dynamic *d, bt__dynamic_work *w, double most)
{
  double moving;
  return excess (d, w, most, &moving) > 0;
}

int
bt__dynamic_slow_down (const bt__dynamic *d, bt__dynamic_work *w, double most,
                       bt__dynamic_report *report)
{
  double moving, over = excess (d, w, most, &moving);
  if (!(over > 0))
    return 0;
  double keep = over < moving ? sqrt (1 - over / moving) : 0;
  if (!(over < moving))
    bt__dynamic_stay (d, w, report);
  for (int i = 0; i <= w->n; i++)
    w->node[i].v0 = bt__axpy (w->node[i].v0, keep - 1, bt__node_v (w, i));
  return 1;
}

void
bt__dynamic_note (bt__dynamic *d, const bt__dynamic_work *w, double most)
{
  d->most = most;
  d->left = energy_now (d, w);
}
