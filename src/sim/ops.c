/* The operations: the table of all changes to a dive except the passing of time.

   Every operation works on a copy of the state. bt_dive_do solves the changed tethers and takes the
   copy over, or leaves the dive untouched.  Only an order to a vehicle whose dive rests is written
   to the present state itself (rest.c).

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <math.h>

#include "math/vec.h"
#include "sim/around.h"
#include "sim/ops.h"
#include "world/watch.h"

/* ---- Checks ---- */

bt_vec3
bt__point_of (const bt__call *c)
{
  return bt__vec (c->args[0], c->args[1], c->args[2]);
}

bt_status
bt__check_point (const bt__call *c)
{
  for (int i = 0; i < 3; i++)
    if (!(fabs (c->args[i]) <= 1e7))
      return bt__fail (c->error, BT_ERR_DOMAIN, "a point lies within 1e7 m, not at (%g %g %g)",
                       c->args[0], c->args[1], c->args[2]);
  return BT_OK;
}

bt_status
bt__check_range (const bt__call *c, int i, const char *what, double low, double high)
{
  if (c->args[i] >= low && c->args[i] <= high)
    return BT_OK;
  return bt__fail (c->error, BT_ERR_DOMAIN, "%s is %g to %g, not %g", what, low, high, c->args[i]);
}

void
bt__mark_all_stale (const bt__call *c)
{
  for (int i = 0; i < c->dive->model->n_tethers; i++)
    bt__dive_tether (c->dive, c->state, i)->stale = 1;
}

/* ---- The table ---- */

typedef struct op
{
  bt_op_info info;
  bt_status (*apply) (const bt__call *c);
  int order;
} op;

enum
{
  MOVES = 0,
  ORDERS = 1 /* it moves nothing, see rest.c */
};

static const op ops[BT_OP_COUNT] = {
  [BT_OP_DRIVE] = { { "drive", BT_PART_VEHICLE, 4, 4, "surge sway heave yaw",
                      "set the sticks, -1 to 1; NAN leaves one as it is" },
                    bt__op_drive,
                    ORDERS },
  [BT_OP_RELEASE]
  = { { "release", BT_PART_VEHICLE, 0, 0, "", "centre the sticks and switch the autopilots off" },
      bt__op_release,
      ORDERS },
  [BT_OP_PLACE] = { { "place", BT_PART_VEHICLE, 3, 3, "x y z",
                      "sweep the vehicle there at once, stopping where it is blocked" },
                    bt__op_place,
                    MOVES },
  [BT_OP_LAY]
  = { { "lay", BT_PART_VEHICLE, 3, 3, "x y z", "put the vehicle there and lay the tethers anew" },
      bt__op_lay,
      MOVES },
  [BT_OP_MOVE] = { { "move", BT_PART_VEHICLE, 4, 4, "x y z speed", "go there in a straight line" },
                   bt__op_move,
                   ORDERS },
  [BT_OP_FLY_TO] = { { "fly-to", BT_PART_VEHICLE, 4, 4, "x y z speed", "fly there, facing it" },
                     bt__op_fly_to,
                     ORDERS },
  [BT_OP_HOLD_HEADING]
  = { { "hold-heading", BT_PART_VEHICLE, 1, 1, "radians", "keep this heading" },
      bt__op_hold_heading,
      ORDERS },
  [BT_OP_HOLD_DEPTH] = { { "hold-depth", BT_PART_VEHICLE, 1, 1, "depth", "keep this depth" },
                         bt__op_hold_depth,
                         ORDERS },
  [BT_OP_HOLD_ALTITUDE]
  = { { "hold-altitude", BT_PART_VEHICLE, 1, 1, "altitude", "keep this height above the bottom" },
      bt__op_hold_altitude,
      ORDERS },
  [BT_OP_HOLD_POSITION]
  = { { "hold-position", BT_PART_VEHICLE, 0, 0, "", "stay here" }, bt__op_hold_position, ORDERS },
  [BT_OP_FOLLOW] = { { "follow", BT_PART_VEHICLE, 8, 40000000, "t x y z ...",
                       "follow a measured track, beginning now" },
                     bt__op_follow,
                     MOVES },
  [BT_OP_STABILISE] = { { "stabilise", BT_PART_VEHICLE, 1, 1, "on",
                          "keep a vehicle with mass level; the yaw stick then sets a rate" },
                        bt__op_stabilise,
                        ORDERS },
  [BT_OP_PAY_OUT]
  = { { "pay-out", BT_PART_TETHER, 2, 2, "metres rate", "let tether out" }, bt__op_pay_out, MOVES },
  [BT_OP_HAUL_IN]
  = { { "haul-in", BT_PART_TETHER, 2, 2, "metres rate", "haul tether in" }, bt__op_haul_in, MOVES },
  [BT_OP_CUT] = { { "cut-tether", BT_PART_TETHER, 1, 1, "arc-length", "cut the moving line" },
                  bt__op_cut,
                  MOVES },
  [BT_OP_CURRENT]
  = { { "current", BT_PART_SEA, 8, BT_CURRENT_ARGS, "packed current", "change the current" },
      bt__op_current,
      MOVES },
  [BT_OP_FAULT]
  = { { "fault", BT_PART_VEHICLE, 3, 3, "fault on value",
        "break an instrument (a bt_fault) or mend it; value: of the compass its drift in "
        "rad/s, of a thruster its number" },
      bt__op_fault,
      ORDERS },
  [BT_OP_WAVES] = { { "waves", BT_PART_SEA, BT_WAVES_ARGS, BT_WAVES_ARGS,
                      "kind height period toward phase gamma components seed accuracy",
                      "change the waves; kind 0: none, 1: one, 2: a wind sea" },
                    bt__op_waves,
                    MOVES },
  [BT_OP_ALTER] = { { "alter", BT_PART_SEA, 3, 3, "part field value",
                      "change a live field of the subject-th PART (a bt_part), by its place in the "
                      "table of fields" },
                    bt__op_alter,
                    MOVES },
  [BT_OP_DRIFT]
  = { { "drift", BT_PART_OBSTACLE, 3, 3, "vx vy vz",
        "set an obstacle that has a track adrift, m/s: it leaves the track for good" },
      bt__op_drift,
      MOVES },
  [BT_OP_COLLIDE]
  = { { "collide", BT_PART_SEA, 3, 3, "part obstacle on",
        "let the subject-th PART (a bt_part: a vehicle or a tether) and an obstacle meet or not; "
        "obstacle -1: all of its pairs, part 0: all pairs there are" },
      bt__op_collide,
      MOVES },
};

const bt_op_info *
bt_op_describe (bt_op which)
{
  unsigned i = (unsigned)which;
  return i < BT_OP_COUNT ? &ops[i].info : NULL;
}

static bt_status
check_call (const bt_dive *dive, const op *o, int subject, const double *args, int n,
            bt_error *error)
{
  if (n < o->info.min_args || n > o->info.max_args)
    return bt__fail (error, BT_ERR_DOMAIN, "`%s' takes %d to %d numbers, not %d", o->info.name,
                     o->info.min_args, o->info.max_args, n);
  if (n > 0 && !args)
    return bt__fail (error, BT_ERR_DOMAIN, "`%s' was given no numbers", o->info.name);
  return o->info.subject == BT_PART_SEA ? BT_OK
                                        : bt__check_part (dive, o->info.subject, subject, error);
}

void
bt__wake_lines (const bt__call *c)
{
  for (int i = 0; i < c->dive->model->n_tethers; i++)
    {
      const bt__end *end = c->dive->model->ends[i];
      if (end[0].vehicle == c->subject || end[1].vehicle == c->subject)
        bt__dive_tether (c->dive, c->state, i)->quiet = 0;
    }
}

/* Among obstacles a vehicle moves up to the first contact of its hull; only the operation `lay'
   jumps past obstacles.  */
static void
place_among (const bt__call *c, const op *o, int round)
{
  bt__rest_movers (c->dive, c->state);
  bt__aim_hulls (c->dive, 0);
  if (o == &ops[BT_OP_LAY])
    bt__unpin_vehicles (c->dive, c->state);
  else
    bt__pin_vehicles (c->dive, c->state, round);
}

/* Apply O to a copy; ROUND tries at it did not fit together with the obstacles.  */
static bt_status
apply_operation (bt_dive *dive, const op *o, int round, int subject, const double *args, int n,
                 bt_error *error)
{
  bt__call c = { dive, bt__dive_begin (dive), subject, args, n, error };
  if (o->info.subject != BT_PART_VEHICLE)
    bt__leave_stretches (dive, c.state);
  bt_status status = o->apply (&c);
  if (status != BT_OK)
    return status;
  if (bt__has_obstacles (dive))
    place_among (&c, o, round);
  else
    bt__unpin_vehicles (dive, c.state);
  if (o->info.subject == BT_PART_VEHICLE)
    bt__wake_lines (&c);
  return bt__resolve_tethers (dive, c.state, 0, error);
}

static int
fits (bt_dive *dive)
{
  return !bt__has_obstacles (dive) || bt__vehicles_agree (dive, dive->next);
}

static bt_status
apply_until_it_fits (bt_dive *dive, const op *o, int subject, const double *args, int n,
                     bt_error *error)
{
  bt_status status = apply_operation (dive, o, 0, subject, args, n, error);
  for (int round = 1; status == BT_OK && round <= BT__TRIES && !fits (dive); round++)
    status = o == &ops[BT_OP_LAY]
                 ? bt__fail (error, BT_ERR_DOMAIN, "the tether cannot be laid to there")
                 : apply_operation (dive, o, round, subject, args, n, error);
  return status;
}

bt_status
bt__operate_on_copy (bt_dive *dive, bt_op which, int subject, const double *args, int n,
                     bt_error *error)
{
  bt_status status = bt__dive_ready (dive, error);
  if (status == BT_OK)
    status = apply_until_it_fits (dive, &ops[which], subject, args, n, error);
  return status == BT_OK ? bt__dive_become (dive, error) : status;
}

static bt_status
try_op (bt_dive *dive, bt_op which, int subject, const double *args, int n, bt_error *error)
{
  const op *o = (unsigned)which < BT_OP_COUNT ? &ops[which] : NULL;
  bt_status status;
  if (!o)
    return bt__fail (error, BT_ERR_NAME, "there is no operation number %d", (int)which);
  status = check_call (dive, o, subject, args, n, error);
  if (status != BT_OK)
    return status;
  if (o->order)
    return bt__give_order (&(bt__call){ dive, dive->now, subject, args, n, error }, which,
                           o->apply);
  return bt__operate_on_copy (dive, which, subject, args, n, error);
}

bt_status
bt_dive_do (bt_dive *dive, bt_op which, int subject, const double *args, int n, bt_error *error)
{
  bt_error unasked;
  bt_status status = try_op (dive, which, subject, args, n, error ? error : &unasked);
  dive->profile.operations++;
  dive->profile.refused += status != BT_OK;
  return status;
}
