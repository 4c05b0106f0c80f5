/* The moving line: its twist.

   A line with torsional stiffness GJ, clamped at both ends or with a set, has directors that turn
   about the line by angles theta against the frame of parallel transport (R. L. Bishop, American
   Mathematical Monthly 82, 1975).  Theta is an angle of each interval, and a node stores
   GJ (theta_i - theta_{i-1})^2 / (2 cell).  A line hardly has inertia about its axis: at every
   iterate the angles minimize the energy of twist and of bending (M. Bergou et al., "Discrete
   elastic rods", ACM Transactions on Graphics 27, 2008).  Without a set the torque is
   GJ Theta / L all along.

   Theta, the angle of node n against node 0, is the angle between the far clamp's director and the
   frame there, less the angle at which the far clamp gripped the line in the first step.  From step
   to step Theta goes on continuously, over any number of turns.  A line that leaves a plane turns
   the frame by the area that the tangent sweeps on the sphere of directions (writhe), and the twist
   falls by as much: twist and writhe add up to the link, and only a clamp that turns changes the
   link (G. Calugareanu 1961; F. B. Fuller 1971).

   At the minimum the gradient of the energy by the places is the gradient at fixed angles: the
   torque of the far grip passes every node, as the moments of a set do (dynamic_set.c).  The blocks
   of a step are stiffened by GJ kappa^2 between two grips, an upper bound of the stiffness of
   writhe, and by Q^2 / (4 EI), an upper bound of the stiffness that a torque Q takes from bending
   EI; the forces stay exact.  Only lines of second order in space twist.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <stdlib.h>
#include <string.h>

#include "tether/dynamic_frame.h"

#define EXACT 1e-11 /* rad: the last change of an angle */
#define LOOSE 1e-9  /* of GJ / L: holds angles that nothing holds */
#define ARMIJO 1e-4 /* of the slope: what a search must gain */

enum
{
  MOST_SEARCHES = 40,
  MOST_HALVINGS = 30
};

/* The energy of node I, J: minus (COS cos + SIN sin) of the angle of its directors, and STIFF / 2
   times the square of the difference between the angles before and after the node.  */
typedef struct spring
{
  double cos, sin, stiff;
} spring;

/* Angles of the clamp at node 0, of all intervals, and of the clamp at node n.  */
struct bt__twisted
{
  int n, last;         /* intervals; the last angle that is unknown */
  double grip, before; /* rad: GRIP of the line, TWIST at the start of the step; ... */
  double base, change; /* ... their sum but for whole turns, the change of TWIST since */
  double torque[2];
  double *angle, *trial, *slope, *diag, *off;
  spring *node;
};

struct bt__twisted *
bt__twisted_new (size_t n)
{
  size_t room = n + 2;
  struct bt__twisted *t = calloc (1, sizeof *t + room * (5 * sizeof (double) + sizeof (spring)));
  if (!t)
    return NULL;
  t->angle = (double *)(t + 1);
  t->trial = t->angle + room;
  t->slope = t->trial + room;
  t->diag = t->slope + room;
  t->off = t->diag + room;
  t->node = (spring *)(t->off + room);
  return t;
}

int
bt__twists (const bt__dynamic_input *in)
{
  return in->line->gj > 0 && in->line->ei > 0 && in->order != 4
         && (in->n_sets > 0 || bt__is_gripped (in));
}

void
bt__twist_copy (bt__dynamic *to, const bt__dynamic *from)
{
  to->gripped = from->gripped;
  to->grip = from->grip;
  to->twist = from->twist;
  to->torque[0] = from->torque[0];
  to->torque[1] = from->torque[1];
}

void
bt__twist_forget (bt__dynamic *d)
{
  d->gripped = 0;
  d->grip = d->twist = d->torque[0] = d->torque[1] = 0;
}

static double
length_of (const bt__frame_line *l)
{
  double sum = 0;
  for (int j = 0; j < l->n; j++)
    sum += bt__frame_rest (l, j);
  return sum;
}

/* ---- The far grip ---- */

/* Return the angle of the far clamp's director against the frame of L, rad, and write the springs
   of the nodes to NODE.  */
static double
look_along (const bt__frame_line *l, spring *node)
{
  bt__frame_line bare = *l;
  bare.edge = NULL;
  bt__walk s = bt__set_out (&bare);
  for (int i = bt__first_station (l); i <= bt__last_station (l); i++)
    {
      bt__station at = bt__next_station (&bare, &s, i);
      node[i]
          = (spring){ at.k * bt__dot (at.w, at.d), bt__moment_of (&at), l->in->line->gj / at.cell };
    }
  bt_vec3 side = l->in->end[1].side;
  side = bt__off_axis (s.t, side);
  side = bt__unit_or (side, bt__set_side (s.t));
  return atan2 (bt__dot (side, bt__cross (s.t, s.u)), bt__dot (side, s.u));
}

/* ---- The angles ---- */

/* The angle of the directors at node I between the ANGLES of its sides.  */
static double
angle_at (const double *angle, int i)
{
  return 0.5 * (angle[i] + angle[i + 1]);
}

/* The energy of the angles, J.  */
static double
stored (const struct bt__twisted *t, const double *angle, int first, int last)
{
  double sum = 0;
  for (int i = first; i <= last; i++)
    {
      double a = angle_at (angle, i), off = angle[i + 1] - angle[i];
      sum += 0.5 * t->node[i].stiff * off * off - t->node[i].cos * cos (a)
             - t->node[i].sin * sin (a);
    }
  return sum;
}

/* The derivatives of the energy by each angle, and its second derivatives without their negative
   parts.  */
static void
derive (struct bt__twisted *t, int first, int last)
{
  size_t size = (size_t)(t->n + 2) * sizeof (double);
  memset (t->slope, 0, size);
  memset (t->diag, 0, size);
  memset (t->off, 0, size);
  for (int i = first; i <= last; i++)
    {
      const spring *k = t->node + i;
      double a = angle_at (t->angle, i), c = cos (a), s = sin (a);
      double pull = k->stiff * (t->angle[i + 1] - t->angle[i]),
             turn = 0.5 * (k->cos * s - k->sin * c),
             stiff = 0.25 * fmax (0, k->cos * c + k->sin * s);
      t->slope[i] += turn - pull;
      t->slope[i + 1] += turn + pull;
      t->diag[i] += stiff + k->stiff;
      t->diag[i + 1] += stiff + k->stiff;
      t->off[i] += stiff - k->stiff;
    }
}

/* Newton's step of the unknown angles to TRIAL; return its slope, and its largest to *MOST.  */
static double
solve_step (struct bt__twisted *t, double loose, double *most)
{
  double *c = t->trial, before = 0, slope = 0;
  for (int e = 1; e <= t->last; e++) /* forward: DIAG becomes the pivots */
    {
      double l = e > 1 ? t->off[e - 1] / t->diag[e - 1] : 0;
      t->diag[e] += loose - (e > 1 ? l * t->off[e - 1] : 0);
      c[e] = before = -t->slope[e] - l * before;
    }
  *most = 0;
  for (int e = t->last; e >= 1; e--)
    {
      c[e] = (c[e] - (e < t->last ? t->off[e] * c[e + 1] : 0)) / t->diag[e];
      slope += c[e] * t->slope[e];
      *most = fmax (*most, fabs (c[e]));
    }
  return slope;
}

/* Go along the step in TRIAL as far as the energy falls.  */
static void
search_angles (struct bt__twisted *t, int first, int last, double slope)
{
  double begun = stored (t, t->angle, first, last), share = 1, gone = 0;
  for (int k = 0; k < MOST_HALVINGS; k++, share *= 0.5)
    {
      for (int e = 1; e <= t->last; e++)
        t->angle[e] += (share - gone) * t->trial[e];
      gone = share;
      if (stored (t, t->angle, first, last) <= begun + ARMIJO * share * slope)
        return;
    }
}

/* Turn all angles by the angle of least energy: without a clamp at node 0 the line turns freely. */
static void
turn_all (struct bt__twisted *t, int first, int last)
{
  double along = 0, across = 0;
  for (int i = first; i <= last; i++)
    {
      double a = angle_at (t->angle, i), c = cos (a), s = sin (a);
      along += t->node[i].cos * c + t->node[i].sin * s;
      across += t->node[i].sin * c - t->node[i].cos * s;
    }
  double by = hypot (along, across) > 0 ? atan2 (across, along) : 0;
  for (int e = 0; e <= t->n + 1; e++)
    t->angle[e] += by;
}

/* A clamp at node n alone bends the line, but lets the directors turn.  */
static void
find_angles (struct bt__twisted *t, const bt__frame_line *l, int gripped, double loose)
{
  int first = bt__first_station (l), last = bt__last_station (l);
  t->last = t->n + (!gripped && last == l->n);
  if (first > 0)
    turn_all (t, first, last);
  for (int k = 0; k < MOST_SEARCHES; k++)
    {
      double most;
      derive (t, first, last);
      double slope = solve_step (t, loose, &most);
      if (most < EXACT)
        break;
      search_angles (t, first, last, slope);
    }
  derive (t, first, last);
}

/* Without a set the angles rise evenly along the line.  */
static void
spread_angles (struct bt__twisted *t, const bt__frame_line *l, double far, double length)
{
  double s = 0;
  t->angle[0] = 0;
  for (int j = 0; j < t->n; j++)
    {
      double rest = bt__frame_rest (l, j);
      t->angle[j + 1] = far * (s + 0.5 * rest) / length;
      s += rest;
    }
  t->angle[t->n + 1] = far;
}

/* The angle of the far grip counts from the start of the step: a small number, in which rounding
   and whole turns lose nothing.  */
double
bt__dynamic_twist (const bt__dynamic_work *w, bt__frame_line *l)
{
  struct bt__twisted *t = w->twisted;
  int gripped = bt__is_gripped (w->in);
  double angle = look_along (l, t->node), length = length_of (l), gj = w->in->line->gj;
  t->change = gripped ? remainder (angle - t->base, 2 * BT__PI) : 0;
  double far = gripped ? t->before + t->change : 0;
  t->torque[0] = t->torque[1] = gripped ? gj * far / length : 0;
  if (w->is_set)
    {
      t->angle[t->n + 1] = gripped ? far : t->angle[t->n];
      find_angles (t, l, gripped, LOOSE * gj / length);
      t->torque[0] = w->in->end[0].clamped ? -t->slope[0] : 0;
      t->torque[1] = gripped ? t->slope[t->n + 1] : 0;
      far = t->angle[t->n + 1];
    }
  else
    spread_angles (t, l, far, length);
  l->edge = t->angle + 1;
  l->stride = 1;
  l->far = far;
  return t->torque[1];
}

double
bt__twist_energy (const bt__frame_line *l)
{
  double sum = 0;
  if (!(l->in->n_sets > 0))
    return 0.5 * l->in->line->gj * l->far * l->far / length_of (l);
  for (int i = bt__first_station (l); i <= bt__last_station (l); i++)
    {
      double cell
          = 0.5
            * ((i > 0 ? bt__frame_rest (l, i - 1) : 0) + (i < l->n ? bt__frame_rest (l, i) : 0));
      double off = bt__angle_after (l, i) - bt__angle_before (l, i);
      sum += 0.5 * l->in->line->gj * off * off / cell;
    }
  return sum;
}

double
bt__dynamic_twist_potential (const bt__dynamic_work *w, const bt__frame_line *l)
{
  const struct bt__twisted *t = w->twisted;
  return w->is_set
             ? bt__twist_energy (l)
             : 0.5 * w->in->line->gj * t->change * (2 * t->before + t->change) / length_of (l);
}

/* ---- A step ---- */

void
bt__dynamic_twist_prepare (bt__dynamic_work *w, const bt__dynamic *d)
{
  struct bt__twisted *t = w->twisted;
  w->twists = bt__twists (w->in);
  if (!w->twists)
    return;
  bt__frame_line l = { .in = w->in, .x = w->x, .n = w->n, .link = w->link };
  t->n = w->n;
  t->before = d->gripped ? d->twist : 0;
  t->grip = d->gripped ? d->grip : look_along (&l, t->node);
  t->base = remainder (t->grip + t->before, 2 * BT__PI);
  t->angle[0] = 0;
  for (int j = 0; j < t->n && w->is_set; j++)
    t->angle[j + 1] = bt__dynamic_load (d)[j].x;
}

/* Stiffen the turn of every interval.  */
void
bt__dynamic_twist_hold (bt__dynamic_work *w)
{
  const bt_tether_props *p = w->in->line;
  double torque = fmax (fabs (w->twisted->torque[0]), fabs (w->twisted->torque[1])), before = 0;
  for (int j = 0; j < w->n; j++)
    {
      double l = w->link[j].rest, next = j + 1 < w->n ? w->link[j + 1].rest : l;
      double after = j + 1 < w->n ? bt__bend_square (w->x + j + 1, l, next) : before;
      double writhe = bt__is_gripped (w->in) ? p->gj * fmax (j ? before : after, after) : 0;
      double k = writhe + torque * torque / (4 * p->ei);
      bt__bend_stiffen (w, &(bt__bend){ .first = j, .count = 2, .c = { -1 / l, 1 / l } }, k * l);
      before = after;
    }
}

void
bt__dynamic_twist_take (bt__dynamic *d, bt__dynamic_work *w)
{
  struct bt__twisted *t = w->twisted;
  bt__frame_line l = { .in = w->in, .x = w->X, .n = w->n, .link = w->link };
  bt__dynamic_twist (w, &l);
  d->gripped = bt__is_gripped (w->in);
  d->grip = d->gripped ? t->grip : 0;
  d->twist = d->gripped ? l.far : 0;
  d->torque[0] = t->torque[0];
  d->torque[1] = t->torque[1];
  for (int j = 0; j < t->n && w->is_set; j++)
    bt__dynamic_load (d)[j] = bt__vec (t->angle[j + 1], 0, 0);
}

void
bt__twist_of (const bt__dynamic *d, const bt__dynamic_work *w, bt__frame_line *l)
{
  if (w)
    {
      bt__dynamic_twist (w, l);
      return;
    }
  l->edge = &bt__dynamic_load (d)->x;
  l->stride = (int)(sizeof (bt_vec3) / sizeof (double));
  l->far = d->gripped ? d->twist : l->edge[(l->n - 1) * l->stride];
}
