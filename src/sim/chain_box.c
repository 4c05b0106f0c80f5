/* Boxes about the moving lines, for queries of other lines while tethers are resolved.

   The box of a line has room for a step at the speed of the fastest node, and more.  All boxes are
   drawn before the first tether is resolved and stay as long as their lines stay inside.  Queries
   for distant lines therefore have the same answer before and after a step of the distant line, and
   in every thread.  A line ahead of the present has no box (chain_apart.c).

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <math.h>

#include "sim/chain.h"

#define ROOM 0.1  /* m: beyond where the line is */
#define AHEAD 2.0 /* of the way that it goes */

static bt__aabb
box_of (const bt__dynamic *chain)
{
  const bt_vec3 *x = bt__dynamic_x (chain);
  bt__aabb box = { x[0], x[0] };
  for (int64_t k = 1; k <= chain->n; k++)
    box = bt__box_with (box, x[k]);
  return box;
}

/* The way of the fastest node of CHAIN in a step.  */
static double
fastest_way (const bt__dynamic *chain)
{
  const bt_vec3 *v = bt__dynamic_v (chain);
  double most = 0;
  for (int64_t k = 0; k <= chain->n; k++)
    most = fmax (most, bt__dot (v[k], v[k]));
  return BT__TIME_STEP * sqrt (most);
}

/* How far end K of tether I is wanted from where PART has it.  */
static double
way_of_end (const bt_dive *dive, bt__state *state, int i, const bt__dynamic *part, int k)
{
  bt__ends ends = bt__tether_ends (dive, state, i);
  return bt__distance (k ? ends.b : ends.a, bt__dynamic_x (part)[k ? part->n : 0]);
}

/* BOX with WAY about it, and more.  */
static bt__aabb
widened (bt__aabb box, double way)
{
  double more = ROOM + AHEAD * way;
  bt_vec3 room = bt__vec (more, more, more);
  return (bt__aabb){ bt__sub (box.lo, room), bt__add (box.hi, room) };
}

static int
holds (const bt__aabb *box, const bt__aabb *other)
{
  return box->lo.x <= other->lo.x && box->hi.x >= other->hi.x && box->lo.y <= other->lo.y
         && box->hi.y >= other->hi.y && box->lo.z <= other->lo.z && box->hi.z >= other->hi.z;
}

/* About PART of tether I, with room.  */
static bt__aabb
box_for (const bt_dive *dive, bt__state *state, int i, int part)
{
  const bt__dynamic *chain = bt__dive_chain (dive, state, i, part);
  double way = fastest_way (chain);
  int parts = bt__chains (bt__dive_tether (dive, state, i));
  if (part == 0)
    way = fmax (way, way_of_end (dive, state, i, chain, 0));
  if (part == parts - 1)
    way = fmax (way, way_of_end (dive, state, i, chain, 1));
  return widened (box_of (chain), way);
}

int
bt__box_line (bt_dive *dive, bt__state *state, int i)
{
  int left = 0;
  if (bt__is_out_of_sight (dive, state, i) || bt__is_ahead (bt__dive_tether (dive, state, i)))
    return 0;
  for (int part = 0; part < bt__chains (bt__dive_tether (dive, state, i)); part++)
    {
      bt__aabb *known = &dive->contact_work.box[2 * i + part];
      bt__aabb box = box_of (bt__dive_chain (dive, state, i, part));
      if (holds (known, &box))
        continue;
      *known = box_for (dive, state, i, part);
      left = 1;
    }
  return left;
}

void
bt__box_lines (bt_dive *dive, bt__state *state)
{
  static const bt__aabb none
      = { { INFINITY, INFINITY, INFINITY }, { -INFINITY, -INFINITY, -INFINITY } };
  for (int i = 0; i < dive->model->n_tethers; i++)
    {
      dive->contact_work.box[2 * i] = dive->contact_work.box[2 * i + 1] = none;
      bt__box_line (dive, state, i);
    }
}
