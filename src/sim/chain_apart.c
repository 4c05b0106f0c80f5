/* Lines that are solved ahead of the present, and what comes near them.

   A line ahead of the present has no place in contact: no step works out how far along its stretch
   the line is.  Hence the line must be far from all lines in each step.  The step assumes this
   first, and verifies the assumption afterwards.  For a line ahead before or after the step, the
   space swept by the nodes in the whole stretch is bounded; for a line not ahead, the space between
   the places before and after the step.  Where the spaces of two lines meet, both lines are barred
   from stretches, and the step is taken again with both lines at their present places.

   A space is bounded by boxes about equal shares of the nodes.  bt__dynamic_swing bounds how far a
   node swings off the straight way between begin and end of a stretch.

   The outcome depends on the states before and after the step alone, hence not on the number of
   threads.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <math.h>
#include <string.h>

#include "math/vec.h"
#include "sim/chain.h"
#include "world/obstacles.h"

#define ASTRAY 0.02 /* of the accuracy: an end is led by less than that off its stretch */
#define ROOM 0.1    /* m: beyond where a line is, ... */
#define AHEAD 2.0   /* ... of the line's way in a step: as about a box (chain_box.c) */

enum
{
  LEAVES = 32
};

/* The space that a line sweeps through, in boxes about LEAVES shares of it.  */
typedef struct sweep
{
  bt__aabb leaf[LEAVES];
} sweep;

static const bt__aabb nowhere
    = { { INFINITY, INFINITY, INFINITY }, { -INFINITY, -INFINITY, -INFINITY } };

/* ---- Where a line goes ---- */

static bt__aabb
box_about (bt__aabb box, bt_vec3 p, double room)
{
  bt_vec3 r = bt__vec (room, room, room);
  return bt__box_with (bt__box_with (box, bt__sub (p, r)), bt__add (p, r));
}

/* Add to S the nodes of CHAIN with ROOM about each; if the last step of CHAIN is a STRETCH, also
   the places of the nodes at its begin.  */
static void
add_chain (sweep *s, const bt__dynamic *chain, double room, int stretch)
{
  const bt_vec3 *x = bt__dynamic_x (chain), *dx = bt__dynamic_dx (chain);
  int64_t n = chain->n;
  for (int64_t m = 0; m < LEAVES; m++)
    for (int64_t k = m * n / LEAVES; k <= ((m + 1) * n + LEAVES - 1) / LEAVES; k++)
      {
        s->leaf[m] = box_about (s->leaf[m], x[k], room);
        if (stretch)
          s->leaf[m] = box_about (s->leaf[m], bt__sub (x[k], dx[k]), room);
      }
}

/* Add to S the places of tether I in STATE, of the whole stretch if it has one.  */
static void
add_state (const bt_dive *dive, bt__state *state, int i, sweep *s)
{
  const bt__tether *tether = bt__dive_tether (dive, state, i);
  if (bt__is_ahead (tether))
    {
      const bt__dynamic *end = bt__dive_chain (dive, state, i, 1);
      double astray = ASTRAY * bt__accuracy (tether);
      add_chain (s, end, 1.01 * bt__dynamic_swing (end) + astray, 1);
    }
  else
    for (int part = 0; part < bt__chains (tether); part++)
      add_chain (s, bt__dive_chain (dive, state, i, part), 0, 0);
}

/* Let S be the space of tether I from the present state to STATE, which may be the present.  */
static void
sweep_through (const bt_dive *dive, bt__state *state, int i, sweep *s)
{
  for (int m = 0; m < LEAVES; m++)
    s->leaf[m] = nowhere;
  add_state (dive, dive->now, i, s);
  if (state != dive->now)
    add_state (dive, state, i, s);
}

static bt__aabb
whole_of (const sweep *s)
{
  bt__aabb box = nowhere;
  for (int m = 0; m < LEAVES; m++)
    box = bt__box_with (bt__box_with (box, s->leaf[m].lo), s->leaf[m].hi);
  return box;
}

bt__aabb
bt__box_of_stretch (const bt_dive *dive, bt__state *state, int i)
{
  sweep s;
  for (int m = 0; m < LEAVES; m++)
    s.leaf[m] = nowhere;
  add_state (dive, state, i, &s);
  return whole_of (&s);
}

/* ---- Do they meet? ---- */

static int
meet (const sweep *a, const sweep *b, double gap)
{
  bt__aabb all = whole_of (b);
  for (int m = 0; m < LEAVES; m++)
    for (int n = 0; n < LEAVES && bt__boxes_are_near (&a->leaf[m], &all, gap); n++)
      if (bt__boxes_are_near (&a->leaf[m], &b->leaf[n], gap))
        return 1;
  return 0;
}

/* How near the axes of tethers I and J may come, m, before contact looks at both; less than 0 if
   the tethers pass through each other.  */
static double
gap_between (const bt_dive *dive, bt__state *state, int i, int j)
{
  const bt__tether *a = bt__dive_tether (dive, state, i), *b = bt__dive_tether (dive, state, j);
  if (!bt__is_cable (a) || !bt__is_cable (b)
      || (bt__passes_tether (dive, state, i, j) && bt__passes_tether (dive, state, j, i)))
    return -1;
  return 2 * (a->props.diameter + b->props.diameter);
}

/* ---- Before ---- */

int
bt__is_out_of_sight (const bt_dive *dive, const bt__state *state, int i)
{
  return state->step != dive->now->step && !dive->contact_work.barred[i]
         && bt__is_ahead (bt__dive_tether (dive, dive->now, i));
}

void
bt__leave_barred (const bt_dive *dive, bt__state *state)
{
  for (int i = 0; i < dive->model->n_tethers; i++)
    {
      bt__stretch *s = &bt__dive_tether (dive, state, i)->stretch;
      if (!dive->contact_work.barred[i])
        continue;
      bt__show_chain (dive, dive->now, i);
      if (bt__is_ahead (bt__dive_tether (dive, state, i)))
        bt__leave_stretch (dive, state, i);
      else
        *s = (bt__stretch){ .wait = bt__next_wait (s) };
    }
}

/* The room about tether J for its motion in a step, m.  */
static double
room_to_move (const bt_dive *dive, int j)
{
  const bt__tether *tether = bt__dive_tether (dive, dive->now, j);
  double way = 0;
  for (int part = 0; part < bt__chains (tether) && !bt__is_ahead (tether); part++)
    {
      const bt__dynamic *chain = bt__dive_chain (dive, dive->now, j, part);
      for (int64_t k = 0; k <= chain->n; k++)
        way = fmax (way, BT__TIME_STEP * bt__norm (bt__dynamic_v (chain)[k]));
    }
  return ROOM + AHEAD * way;
}

int
bt__has_room_about (const bt_dive *dive, bt__state *state, int i, double way)
{
  sweep own, other;
  int drawn = 0;
  for (int j = 0; j < dive->model->n_tethers; j++)
    {
      double gap = j == i ? -1 : gap_between (dive, dive->now, i, j);
      if (gap < 0)
        continue;
      if (!drawn++)
        sweep_through (dive, state, i, &own);
      sweep_through (dive, dive->now, j, &other);
      if (meet (&own, &other, gap + way + room_to_move (dive, j)))
        return 0;
    }
  return 1;
}

/* ---- After ---- */

/* True if tether I was ahead before the step, or is after it.  */
static int
has_been_ahead (const bt_dive *dive, int i)
{
  return !dive->contact_work.barred[i]
         && (bt__is_ahead (bt__dive_tether (dive, dive->now, i))
             || bt__is_ahead (bt__dive_tether (dive, dive->next, i)));
}

/* Bar in BAR tether I, which has been ahead, and all tethers whose space tether I met; return true
   if there were any.  */
static int
bar_what_met (bt_dive *dive, int i, const bt__aabb *whole, uint8_t *bar)
{
  sweep own, other;
  int met = 0, drawn = 0;
  for (int j = 0; j < dive->model->n_tethers; j++)
    {
      double gap = j == i ? -1 : gap_between (dive, dive->next, i, j);
      if (gap < 0 || !bt__boxes_are_near (&whole[i], &whole[j], gap))
        continue;
      if (!drawn++)
        sweep_through (dive, dive->next, i, &own);
      sweep_through (dive, dive->next, j, &other);
      if (!meet (&own, &other, gap))
        continue;
      bar[i] = met = 1;
      bar[j] |= has_been_ahead (dive, j);
    }
  return met;
}

int
bt__bar_stretches (bt_dive *dive)
{
  int n = dive->model->n_tethers, ahead = 0, met = 0;
  uint8_t bar[BT_TETHERS_MAX];
  bt__aabb whole[BT_TETHERS_MAX];
  for (int i = 0; i < n; i++)
    ahead |= has_been_ahead (dive, i);
  if (n < 2 || !ahead)
    return 0;
  memcpy (bar, dive->contact_work.barred, (size_t)n);
  for (int i = 0; i < n; i++)
    {
      sweep s;
      sweep_through (dive, dive->next, i, &s);
      whole[i] = whole_of (&s);
    }
  for (int i = 0; i < n; i++)
    met |= has_been_ahead (dive, i) && bar_what_met (dive, i, whole, bar);
  memcpy (dive->contact_work.barred, bar, (size_t)n);
  return met;
}
