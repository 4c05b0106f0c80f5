/* The moving line: contact constraints in the equations of a step.

   The quick way treats a constraint like an interval: its multiplier, the linearised load, decides
   together with the gap whether the constraint bears.  Friction takes the load of the previous
   iterate, so its block is symmetric; dynamic_couple.c adds what friction gains with the load, and
   then a constraint that does not bear has no friction.  The safe way takes load and activity from
   the gap, and friction from the load of the previous iterate.

   A held end is stuck to its place while its multiplier is less than the greatest pull; else the
   end is pulled by that force, straight to its place.  The end may have mass, because a slack line
   at an end without mass would fly where the place is far.  In the quick way the end has mass
   against gaining speed toward its place alone: a line that runs taut is never pulled by more than
   the greatest pull.
   The quick way sticks the end with a very firm spring.  The safe way could not descend across so
   narrow a potential: its spring is softer, and the missing force is added from one update of the
   loads to the next (the method of multipliers).

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include "tether/dynamic_kernel.h"

#define ACTIVITY 0.02 /* of the stiffness: what a gap takes from a multiplier */
#define HOLDING 0.05  /* the same of a held end that has mass */
#define FIRM 1e4      /* times stiffer sticks an end that does not slip */

#define LOAD 1.0        /* N: loads that change less in an iteration, ... */
#define LOAD_SHARE 0.05 /* ... and by this share of them, are settled */

/* ---- Rows ---- */

static bt_vec3
place_of (const bt__constraint *r, const bt_vec3 *X)
{
  bt_vec3 p = bt__between (X + r->node, r->s);
  return r->pair > 0 ? bt__sub (p, bt__between (X + r->pair - 1, r->t)) : p;
}

static double
gap_of (const bt__constraint *r, const bt_vec3 *X)
{
  return bt__dot (r->normal, place_of (r, X)) - r->offset;
}

/* What friction answers.  */
static bt_vec3
drag_of (const bt__dynamic_work *w, const bt__constraint *r)
{
  bt_vec3 moved = bt__sub (place_of (r, w->X), place_of (r, w->x));
  return bt__off_axis (r->normal,
                       bt__axpy (r->stick, 1 + BT__STICK_DAMPING, bt__sub (moved, r->drift)));
}

/* How far the next node has risen against the node of R, m.  */
static double
tilt_of (const bt__dynamic_work *w, const bt__constraint *r)
{
  return bt__dot (r->normal, bt__sub (w->X[r->node + 1], w->X[r->node])) - r->tilt;
}

/* How far the load has wandered along the link by TILT, in links, to its ends at most.  */
static double
shift_of (const bt__constraint *r, double tilt)
{
  return fmin (fmax (-r->roll * tilt, -r->s), 1 - r->s);
}

/* Add what LOAD does by having wandered.  */
static void
add_roll (bt__dynamic_work *w, bt__constraint *r, double load)
{
  double tilt = tilt_of (w, r), shift = shift_of (r, tilt);
  double k = shift == -r->roll * tilt ? load * r->roll : 0;
  bt__sym *p = w->diag + r->node;
  bt__sym_add (p, 0, k, r->normal);
  bt__sym_add (p + 1, 0, k, r->normal);
  bt__sym_add (w->off + r->node, 0, k, r->normal);
  r->shift = shift;
  w->rhs[r->node] = bt__axpy (w->rhs[r->node], -load * shift, r->normal);
  w->rhs[r->node + 1] = bt__axpy (w->rhs[r->node + 1], load * shift, r->normal);
}

/* A block kn n n^T + ks (1 - n n^T) - kd d d^T with weights at two nodes, and the force.  */
static void
add_row (bt__dynamic_work *w, bt__constraint *r, double kn, double ks, double kd, bt_vec3 d)
{
  double a = 1 - r->s, b = r->s;
  bt__sym *p = w->diag + r->node, *q = p + 1, *o = w->off + r->node;
  bt__sym k = { 0 };
  bt__sym_add (&k, ks, kn - ks, r->normal);
  bt__sym_add (&k, 0, -kd, d);
  if (r->pair > 0)
    {
      bt__dynamic_pair_add (w, r, &k);
      return;
    }
  bt__sym_axpy (p, a * a, &k);
  bt__sym_axpy (q, b * b, &k);
  bt__sym_axpy (o, -a * b, &k);
  w->rhs[r->node] = bt__axpy (w->rhs[r->node], a, r->force);
  w->rhs[r->node + 1] = bt__axpy (w->rhs[r->node + 1], b, r->force);
}

/* The stiffness of friction of R, N/m, under LOAD and a drag of SIZE.  */
static double
grip_of (const bt__constraint *r, double load, double size)
{
  return (load > 0 ? r->friction * load : 0) / fmax (size, r->slip);
}

static int
assemble_row (bt__dynamic_work *w, bt__constraint *r, bt__mode mode)
{
  double gap = gap_of (r, w->X), urge = -ACTIVITY * r->stiffness * gap;
  urge = mode == BT__SAFE ? -gap : r->load + urge;
  double active = urge > 0, was = r->active;
  double kn = active * r->stiffness, load = active || !w->coupled ? fmax (r->load, 0) : 0;
  r->active = active;
  r->drag = drag_of (w, r);
  double size = bt__norm (r->drag), ks = grip_of (r, load, size), kt = (1 + BT__STICK_DAMPING) * ks;
  int slides = size > r->slip;
  bt_vec3 d = slides ? bt__scale (1 / size, r->drag) : bt__vec (0, 0, 0);
  r->force = bt__axpy (bt__scale (-kn * gap, r->normal), -ks, r->drag);
  add_row (w, r, kn, kt, slides ? kt : 0, d);
  if (r->roll > 0)
    add_roll (w, r, load);
  return active != was && fabs (gap) > w->tolerance;
}

/* ---- The force of rows on a node ---- */

/* The share of node I in a place at S between NODE and the next.  */
static double
node_share (int64_t node, double s, int64_t i)
{
  return i == node ? 1 - s : i == node + 1 ? s : 0;
}

/* The force of R at the solution.  A step that was cut short may have left the place of R far above
   the half-space: an active row pulls by no more than the tolerance of settled loads.  */
static bt_vec3
row_press (const bt__dynamic_work *w, const bt__constraint *r)
{
  bt_vec3 drag = drag_of (w, r);
  double load = r->active > 0 ? fmax (-r->stiffness * gap_of (r, w->X), -LOAD) : 0;
  return bt__axpy (bt__scale (load, r->normal), -grip_of (r, r->load, bt__norm (drag)), drag);
}

bt_vec3
bt__dynamic_contact_on (const bt__dynamic_work *w, int i)
{
  bt_vec3 sum = { 0, 0, 0 };
  for (int k = 0; k < w->rows; k++)
    {
      const bt__constraint *r = w->row + k;
      double share = node_share (r->node, r->s, i);
      int64_t next = r->node + 1;
      if (r->pair > 0)
        share -= node_share (r->pair - 1, r->t, i);
      if (share != 0)
        sum = bt__axpy (sum, share, row_press (w, r));
      if (r->roll > 0 && r->load > 0 && (i == r->node || i == next))
        sum = bt__axpy (sum, (i == next ? 1 : -1) * r->load * shift_of (r, tilt_of (w, r)),
                        r->normal);
    }
  return sum;
}

/* ---- Held ends ---- */

static int
end_node (const bt__dynamic_work *w, int k)
{
  return k ? w->n : 0;
}

/* The pull of the safe way's spring on end K, by however much.  */
static bt_vec3
safe_pull (const bt__dynamic_work *w, int k)
{
  const bt__dynamic_hold *h = w->hold + k;
  return bt__axpy (h->lean, h->stiffness, bt__sub (h->at, w->X[end_node (w, k)]));
}

/* The share of its stiffness by which the pull of a held end follows the place within an iteration.
   Of an end without mass the place alone tells the direction, which would swing else.  */
static double
follows_place (const bt__dynamic_hold *h)
{
  return h->mass > 0 ? HOLDING : 1;
}

/* Toward the place of end K, from where the end was; zero if it was there.  */
static bt_vec3
way_to_place (const bt__dynamic_work *w, int k)
{
  return bt__unit_or (bt__sub (w->hold[k].at, w->x[end_node (w, k)]), bt__vec (0, 0, 0));
}

/* What mass at end K resists of the acceleration of the end, m/s2: in the SAFE way all of it; else
   the gain of speed on the WAY to the place of the end.  */
static bt_vec3
resisted (const bt__dynamic_work *w, int k, int safe, bt_vec3 way)
{
  bt_vec3 a = bt__node_a (w, end_node (w, k), bt__node_v (w, end_node (w, k)));
  return safe ? a : bt__scale (fmax (bt__dot (a, way), 0), way);
}

static void
assemble_hold (bt__dynamic_work *w, int k, bt__mode mode)
{
  bt__dynamic_hold *h = w->hold + k;
  int i = end_node (w, k), safe = mode == BT__SAFE;
  bt_vec3 away = bt__sub (h->at, w->X[i]), along = { 0, 0, 0 };
  bt_vec3 urge
      = safe ? safe_pull (w, k) : bt__axpy (h->force, follows_place (h) * h->stiffness, away);
  double size = bt__norm (urge), c = safe ? h->stiffness : FIRM * h->stiffness, turn = 0;
  h->slips = size > h->most;
  h->force = safe ? urge : bt__scale (c, away);
  if (h->slips)
    {
      along = bt__scale (1 / size, urge);
      h->force = bt__scale (h->most, along);
      c = (safe ? 1 : follows_place (h)) * h->stiffness * h->most / size;
      turn = safe ? 0 : -c; /* the safe way would run off along the pull */
    }
  w->rhs[i] = bt__add (w->rhs[i], h->force);
  bt__sym_add (w->diag + i, c, turn, along);
  if (h->slips || safe)
    {
      bt_vec3 way = way_to_place (w, k), a = resisted (w, k, safe, way);
      double m = w->b0 * w->b0 * h->mass, gains = bt__dot (a, way) > 0;
      w->rhs[i] = bt__axpy (w->rhs[i], -h->mass, a);
      bt__sym_add (w->diag + i, safe ? m : 0, safe ? 0 : gains * m, way);
    }
}

/* An end pulled by a force overshoots its place when nothing holds the end back: then it gets there
   with less.  */
int
bt__dynamic_hold_arrives (bt__dynamic_work *w)
{
  int any = 0;
  for (int k = 0; w->hold && k < 2; k++)
    {
      bt__dynamic_hold *h = w->hold + k;
      int i = end_node (w, k);
      if (!h->on || !h->slips)
        continue;
      bt_vec3 away = bt__sub (h->at, w->X[i]);
      if (!(bt__dot (w->d[i], away) > bt__dot (away, away)))
        continue;
      h->force = bt__vec (0, 0, 0);
      w->X[i] = h->at;
      any = 1;
    }
  return any;
}

/* ---- All ---- */

int
bt__dynamic_contact_assemble (bt__dynamic_work *w, bt__mode mode)
{
  int changed = 0;
  w->pairs = 0;
  for (int k = 0; k < w->rows; k++)
    changed |= assemble_row (w, w->row + k, mode);
  for (int k = 0; w->hold && k < 2; k++)
    if (w->hold[k].on)
      assemble_hold (w, k, mode);
  bt__dynamic_bent_assemble (w, mode);
  return changed;
}

/* What end K pulled by SHARE of what was solved for presses on, it presses by no more.  */
static void
ease_rows (bt__dynamic_work *w, int k, double share)
{
  for (int q = 0; q < w->rows; q++)
    {
      bt__constraint *r = w->row + q;
      int64_t end = k ? w->n - 1 : 0;
      if (r->node == end || r->pair - 1 == end)
        r->load *= share;
    }
}

/* End K slips: return true if its pull, and what the line pulls with there, have hardly changed
   with SHARE of the update.  A stiff line pulls by much more for an update that is small.  An end
   that has mass is not asked: where it gets to in a step is not what its pull alone makes of it. */
static int
keeps_pull (const bt__dynamic_work *w, int k, double share)
{
  const bt__dynamic_hold *h = w->hold + k;
  int i = end_node (w, k), next = k ? i - 1 : 1;
  if (h->mass > 0)
    return 1;
  bt_vec3 solved = bt__axpy (w->X[i], 1 - share, w->d[i]),
          along = bt__scale (1 / h->most, h->force);
  bt_vec3 urge = bt__axpy (h->force, h->stiffness, bt__sub (h->at, solved));
  double turned = bt__distance (bt__unit_or (urge, along), along) * h->most;
  double drawn = bt__dot (bt__sub (w->d[i], w->d[next]), along) * w->link[k ? next : 0].ka;
  return fmax (turned, fabs (drawn)) <= LOAD + LOAD_SHARE * h->most;
}

/* End K does not slip: what its place pulls with where SHARE of the update has been taken over.
   Return true if the place can pull so.  */
static int
take_hold (bt__dynamic_work *w, int k, double share)
{
  bt__dynamic_hold *h = w->hold + k;
  int i = end_node (w, k);
  bt_vec3 solved = bt__axpy (w->X[i], 1 - share, w->d[i]);
  bt_vec3 force = bt__scale (FIRM * h->stiffness, bt__sub (h->at, solved));
  double size = bt__norm (force);
  h->force = force;
  if (size > h->most)
    ease_rows (w, k, h->most / size);
  return size <= h->most;
}

int
bt__dynamic_contact_take (bt__dynamic_work *w, double share)
{
  int settled = 1;
  for (int k = 0; k < w->rows; k++)
    {
      bt__constraint *r = w->row + k;
      double gap = gap_of (r, w->X) + (1 - share) * bt__dot (r->normal, place_of (r, w->d));
      double push = -r->stiffness * gap, load = r->active > 0 ? fmax (push, 0) : 0;
      double next = share < 1 ? r->load + share * (load - r->load) : load;
      settled &= fabs (load - r->load) <= LOAD + LOAD_SHARE * load;
      settled &= r->active > 0 ? push > -LOAD : push < LOAD; /* or it bears the wrong way */
      r->load = next;
    }
  for (int k = 0; w->hold && k < 2; k++)
    if (w->hold[k].on)
      settled &= w->hold[k].slips ? keeps_pull (w, k, share) : take_hold (w, k, share);
  bt__dynamic_bent_take (w, share);
  return settled;
}

/* The safe way's spring of end K leans to its pull, or starts afresh.  */
static void
lean (bt__dynamic_work *w, int k, int none)
{
  bt__dynamic_hold *h = w->hold + k;
  bt_vec3 pull = safe_pull (w, k);
  double size = bt__norm (pull);
  h->lean = none ? bt__vec (0, 0, 0) : bt__scale (size > h->most ? h->most / size : 1, pull);
}

void
bt__dynamic_contact_load (bt__dynamic_work *w, int none)
{
  if (none)
    bt__dynamic_bent_stop (w);
  else
    bt__dynamic_bent_follow (w);
  for (int k = 0; k < w->rows; k++)
    {
      bt__constraint *r = w->row + k;
      r->load = none ? 0 : r->stiffness * fmax (-gap_of (r, w->X), 0);
    }
  for (int k = 0; w->hold && k < 2; k++)
    if (w->hold[k].on)
      lean (w, k, none);
}

static double
roll_potential (const bt__dynamic_work *w, const bt__constraint *r)
{
  double tilt = tilt_of (w, r), most = tilt > 0 ? r->s : 1 - r->s, shift = r->roll * fabs (tilt);
  return shift < most ? 0.5 * shift * fabs (tilt) : most * (fabs (tilt) - 0.5 * most / r->roll);
}

static double
row_potential (const bt__dynamic_work *w, const bt__constraint *r)
{
  double depth = fmax (-gap_of (r, w->X), 0), most = r->friction * r->load;
  double size = bt__norm (drag_of (w, r));
  double drag = size < r->slip ? 0.5 * size * size / r->slip : size - 0.5 * r->slip;
  double roll = r->roll > 0 ? r->load * roll_potential (w, r) : 0;
  return 0.5 * r->stiffness * depth * depth + most * drag / (1 + BT__STICK_DAMPING) + roll;
}

static double
hold_potential (const bt__dynamic_work *w, int k)
{
  const bt__dynamic_hold *h = w->hold + k;
  double away = bt__norm (safe_pull (w, k)) / h->stiffness, yield = h->most / h->stiffness;
  bt_vec3 a = resisted (w, k, 1, bt__vec (0, 0, 0));
  double pull = away < yield ? 0.5 * h->stiffness * away * away : h->most * (away - 0.5 * yield);
  return pull + 0.5 * h->mass * bt__dot (a, a) / (w->b0 * w->b0);
}

double
bt__dynamic_contact_potential (const bt__dynamic_work *w)
{
  double sum = 0;
  for (int k = 0; k < w->rows; k++)
    sum += row_potential (w, w->row + k);
  for (int k = 0; w->hold && k < 2; k++)
    if (w->hold[k].on)
      sum += hold_potential (w, k);
  return sum + bt__dynamic_bent_potential (w);
}
