/* The operations: one table of all that may change a dive besides time.

   Every operation works on a copy of the state; bt_dive_do solves what it changed and takes the copy
   over, or leaves the dive untouched.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/error.h"
#include "math/vec.h"
#include "sim/sim.h"

/* What an operation is given.  */
typedef struct call
{
  bt_dive *dive;
  bt__state *state; /* to change */
  int subject;
  const double *args;
  int n;
  bt_error *error;
} call;

static bt__vehicle *
vehicle_of (const call *c)
{
  return bt__dive_vehicle (c->dive, c->state, c->subject);
}

static bt_vec3
point_of (const call *c)
{
  return bt__vec (c->args[0], c->args[1], c->args[2]);
}

static bt_status
check_point (const call *c)
{
  for (int i = 0; i < 3; i++)
    if (!(fabs (c->args[i]) <= 1e7))
      return bt__fail (c->error, BT_ERR_DOMAIN, "a point lies within 1e7 m, not at (%g %g %g)",
                       c->args[0], c->args[1], c->args[2]);
  return BT_OK;
}

/* BT_ERR_DOMAIN unless the I-th argument, called WHAT, lies in [LOW, HIGH].  */
static bt_status
check_range (const call *c, int i, const char *what, double low, double high)
{
  if (c->args[i] >= low && c->args[i] <= high)
    return BT_OK;
  return bt__fail (c->error, BT_ERR_DOMAIN, "%s is %g to %g, not %g", what, low, high, c->args[i]);
}

/* ---- Vehicles ---- */

static bt_status
drive (const call *c)
{
  static const char *const names[] = { "surge", "sway", "heave", "yaw" };
  bt__vehicle *v = vehicle_of (c);
  for (int i = 0; i < 4; i++)
    if (!isnan (c->args[i]) && check_range (c, i, names[i], -1, 1) != BT_OK)
      return BT_ERR_DOMAIN;
  for (int i = 0; i < 4; i++)
    if (!isnan (c->args[i]))
      v->sticks[i] = c->args[i];
  v->goal = BT__GOAL_NONE; /* hands on the sticks end a flight to a place */
  return BT_OK;
}

static bt_status
release (const call *c)
{
  bt__vehicle *v = vehicle_of (c);
  memset (v->sticks, 0, sizeof v->sticks);
  v->goal = BT__GOAL_NONE;
  v->hold_heading.on = v->hold_depth.on = 0;
  return BT_OK;
}

static void
stand_at (bt__vehicle *v, bt_vec3 p)
{
  v->position = p;
  v->velocity = bt__vec (0, 0, 0);
  v->goal = BT__GOAL_NONE;
}

static bt_status
place (const call *c)
{
  bt__vehicle *v = vehicle_of (c);
  bt_vec3 way;
  double k;
  if (check_point (c) != BT_OK)
    return BT_ERR_DOMAIN;
  way = bt__sub (point_of (c), v->position);
  k = bt__reach_along (c->dive, c->state, c->subject, v->position, point_of (c));
  stand_at (v, k < 1 ? bt__axpy (v->position, k, way) : point_of (c));
  bt__hold_at_tethers (c->dive, c->dive->now, c->state);
  v->held = k < 1;
  return BT_OK;
}

/* Lay tether I anew if it is fastened to the subject.  */
static void
forget_shape (const call *c, int i)
{
  const bt__end *end = c->dive->model->ends[i];
  bt__tether *tether = bt__dive_tether (c->dive, c->state, i);
  if (end[0].vehicle != c->subject && end[1].vehicle != c->subject)
    return;
  memset (&tether->memory, 0, sizeof tether->memory);
  memset (&tether->shape, 0, sizeof tether->shape);
  tether->stale = 1;
}

static bt_status
lay (const call *c)
{
  bt__vehicle *v = vehicle_of (c);
  bt_vec3 p;
  if (check_point (c) != BT_OK)
    return BT_ERR_DOMAIN;
  p = point_of (c);
  if (bt__reach_along (c->dive, c->state, c->subject, v->position, p) < 1)
    return bt__fail (c->error, BT_ERR_DOMAIN, "the tether does not reach to (%g %g %g)", p.x, p.y,
                     p.z);
  stand_at (v, p);
  bt__hold_at_tethers (c->dive, c->dive->now, c->state);
  for (int i = 0; i < c->dive->model->n_tethers; i++)
    forget_shape (c, i);
  return BT_OK;
}

static bt_status
go (const call *c, bt__goal goal)
{
  bt__vehicle *v = vehicle_of (c);
  if (check_point (c) != BT_OK || check_range (c, 3, "a speed in m/s", 1e-6, 1000) != BT_OK)
    return BT_ERR_DOMAIN;
  v->goal = goal;
  v->target = point_of (c);
  v->target_speed = c->args[3];
  return BT_OK;
}

static bt_status
move (const call *c)
{
  return go (c, BT__GOAL_POINT);
}

static bt_status
fly_to (const call *c)
{
  return go (c, BT__GOAL_FLY);
}

static bt_status
hold_heading (const call *c)
{
  bt_status status = check_range (c, 0, "a heading in radians", -1e6, 1e6);
  if (status == BT_OK)
    vehicle_of (c)->hold_heading = (bt__hold){ 1, c->args[0] };
  return status;
}

static bt_status
hold_depth (const call *c)
{
  bt_status status = check_range (c, 0, "a depth in m", -1e7, 1e7);
  if (status == BT_OK)
    vehicle_of (c)->hold_depth = (bt__hold){ 1, c->args[0] };
  return status;
}

static bt_status
hold_altitude (const call *c)
{
  bt_status status = check_range (c, 0, "an altitude in m", 0, c->state->depth);
  if (status == BT_OK)
    vehicle_of (c)->hold_depth = (bt__hold){ 1, c->state->depth - c->args[0] };
  return status;
}

static bt_status
hold_position (const call *c)
{
  bt__vehicle *v = vehicle_of (c);
  memset (v->sticks, 0, sizeof v->sticks);
  v->goal = BT__GOAL_NONE;
  v->hold_heading = (bt__hold){ 1, v->heading };
  v->hold_depth = (bt__hold){ 1, -v->position.z };
  return BT_OK;
}

static bt_status
check_track (const call *c)
{
  if (c->n % 4 != 0)
    return bt__fail (c->error, BT_ERR_FORMAT, "a track has rows of t x y z, not %d numbers", c->n);
  for (int i = 0; i < c->n; i++)
    if (!(fabs (c->args[i]) <= 1e7))
      return bt__fail (c->error, BT_ERR_FORMAT, "row %d of the track has %g", i / 4 + 1, c->args[i]);
  for (int i = 4; i < c->n; i += 4)
    if (c->args[i] <= c->args[i - 4])
      return bt__fail (c->error, BT_ERR_FORMAT, "row %d of the track does not come later than row %d",
                       i / 4 + 1, i / 4);
  return BT_OK;
}

static bt_status
follow (const call *c)
{
  bt__vehicle *v = vehicle_of (c);
  if (v->mass > 0)
    return bt__fail (c->error, BT_ERR_UNSUPPORTED,
                     "a vehicle with mass goes where forces take it; only one without follows a track");
  size_t bytes = sizeof (double) * (size_t)c->n;
  bt_status status = check_track (c);
  bt__track *track = status == BT_OK ? malloc (sizeof *track + bytes) : NULL;
  if (status != BT_OK)
    return status;
  if (!track)
    return bt__fail (c->error, BT_ERR_LIMIT, "no memory for a track of %d rows", c->n / 4);
  atomic_init (&track->references, 1);
  track->n = c->n / 4;
  memcpy (track->row, c->args, bytes);
  status = bt__dive_add_track (c->dive, track, c->error);
  if (status != BT_OK)
    {
      free (track);
      return status;
    }
  v->goal = BT__GOAL_TRACK;
  v->track = c->dive->n_tracks - 1;
  v->track_start = bt__state_time (c->state);
  return BT_OK;
}

/* ---- Tethers ---- */

static bt_status
spool (const call *c, double sign)
{
  bt__tether *tether = bt__dive_tether (c->dive, c->state, c->subject);
  double target = tether->length + sign * c->args[0];
  double drum = c->dive->model->tethers[c->subject].drum;
  if (check_range (c, 0, "metres to spool", 0, 1e6) != BT_OK
      || check_range (c, 1, "a rate in m/s", 1e-6, 1000) != BT_OK)
    return BT_ERR_DOMAIN;
  if (target > drum)
    return bt__fail (c->error, BT_ERR_DOMAIN, "%g m are out: the drum holds %g m", tether->length,
                     drum);
  if (target <= 0 || target > 1e6)
    return bt__fail (c->error, BT_ERR_DOMAIN, "%g m are out: it cannot be made %g m", tether->length,
                     target);
  tether->winch_target = target;
  tether->winch_rate = target == tether->length ? 0 : sign * c->args[1];
  return BT_OK;
}

/* Cut the line at an arc length.  */
static bt_status
cut (const call *c)
{
  bt__tether *tether = bt__dive_tether (c->dive, c->state, c->subject);
  bt__dynamic *chain = bt__dive_chain (c->dive, c->state, c->subject, 0);
  double s = c->args[0];
  int j = 0;
  if (tether->shape.form != BT__FORM_CHAIN)
    return bt__fail (c->error, BT_ERR_UNSUPPORTED,
                     "only a tether moved by the model `dynamic' can be cut");
  if (tether->parted)
    return bt__fail (c->error, BT_ERR_UNSUPPORTED, "the tether has parted already");
  if (!(s >= 0 && s <= tether->length))
    return bt__fail (c->error, BT_ERR_DOMAIN, "a place to cut lies in 0 to %g m, not %g",
                     tether->length, s);
  for (; j < chain->n - 1 && s > bt__dynamic_rest (chain)[j]; j++)
    s -= bt__dynamic_rest (chain)[j];
  bt__part_chain (c->dive, c->state, c->subject, j);
  return BT_OK;
}

static bt_status
pay_out (const call *c)
{
  return spool (c, 1);
}

static bt_status
haul_in (const call *c)
{
  return spool (c, -1);
}

/* ---- The sea ---- */

int
bt_current_pack (const bt_current *current, double *args)
{
  int rows = current->kind == BT_CURRENT_PROFILE ? (int)current->n : 1, n = 0;
  args[n++] = (double)current->kind;
  args[n++] = current->turn_rate;
  args[n++] = current->exponent;
  args[n++] = current->period;
  for (int i = 0; i < rows; i++)
    {
      args[n++] = current->z[i];
      args[n++] = current->velocity[i].x;
      args[n++] = current->velocity[i].y;
      args[n++] = current->velocity[i].z;
    }
  return n;
}

static bt_status
unpack_current (const call *c, bt_current *current)
{
  int kind = c->args[0] >= 0 && c->args[0] <= BT_CURRENT_FUNCTION ? (int)c->args[0] : -1;
  if (kind < 0 || kind != c->args[0] || c->n % 4 != 0)
    return bt__fail (c->error, BT_ERR_FORMAT, "these %d numbers are not a current", c->n);
  memset (current, 0, sizeof *current);
  current->kind = kind;
  current->turn_rate = c->args[1];
  current->exponent = c->args[2];
  current->period = c->args[3];
  current->n = kind == BT_CURRENT_PROFILE ? (c->n - 4) / 4 : 0;
  for (int i = 0; i < (c->n - 4) / 4; i++)
    {
      const double *row = c->args + 4 + 4 * i;
      current->z[i] = row[0];
      current->velocity[i] = bt__vec (row[1], row[2], row[3]);
    }
  return bt_current_check (current, c->error);
}

static void
mark_all_stale (const call *c)
{
  for (int i = 0; i < c->dive->model->n_tethers; i++)
    bt__dive_tether (c->dive, c->state, i)->stale = 1;
}

static bt_status
set_current (const call *c)
{
  bt_current current;
  bt_status status = unpack_current (c, &current);
  if (status != BT_OK)
    return status;
  if (current.kind == BT_CURRENT_FUNCTION && !c->dive->function)
    return bt__fail (c->error, BT_ERR_UNSUPPORTED, "this dive has no function for its current");
  c->state->current = current;
  mark_all_stale (c);
  return BT_OK;
}

/* ---- Alter a field ---- */

static const bt_field *
live_field (const call *c, const char *head_name)
{
  const bt_head *head = bt_head_find (head_name);
  double i = c->args[1];
  const bt_field *field = i >= 0 && i < (double)head->n_fields ? &head->fields[(size_t)i] : NULL;
  if (!field)
    bt__fail (c->error, BT_ERR_NAME, "a %s has no field number %g", head_name, i);
  else if (!field->live)
    bt__fail (c->error, BT_ERR_DOMAIN, "the %s of a %s is fixed while it dives", field->name,
              head_name);
  return field && field->live ? field : NULL;
}

static bt_status
alter_vehicle (const call *c)
{
  bt__vehicle *v;
  bt_vehicle_def def = { 0 };
  const bt_field *field = live_field (c, "rov");
  bt_status status = bt__check_part (c->dive, BT_PART_VEHICLE, c->subject, c->error);
  if (status != BT_OK || !field)
    return status != BT_OK ? status : c->error->status;
  v = vehicle_of (c);
  def.surge_speed = v->speeds[0];
  def.sway_speed = v->speeds[1];
  def.heave_speed = v->speeds[2];
  def.yaw_rate = v->speeds[3] * (180 / BT__PI);
  def.pull = v->pull;
  def.drag = v->drag;
  def.quadratic_drag = v->quadratic_drag;
  def.thrust = v->thrust;
  status = bt_def_set_number (field, &def, c->args[2], c->error);
  if (status != BT_OK)
    return status;
  v->speeds[0] = def.surge_speed;
  v->speeds[1] = def.sway_speed;
  v->speeds[2] = def.heave_speed;
  v->speeds[3] = def.yaw_rate * (BT__PI / 180);
  v->pull = def.pull;
  v->drag = def.drag;
  v->quadratic_drag = def.quadratic_drag;
  v->thrust = def.thrust;
  return BT_OK;
}

/* Mass and wet weight follow each other and the diameter.  */
static void
forget_follower (const bt_field *field, bt_tether_props *props)
{
  if (strcmp (field->name, "wet-weight") == 0)
    props->mass = NAN;
  else if (strcmp (field->name, "mass") == 0 || strcmp (field->name, "diameter") == 0)
    props->wet_weight = NAN;
}

static bt_status
alter_tether (const call *c)
{
  bt_tether_def def = { 0 };
  bt__tether *tether;
  bt__ends ends;
  const bt_field *field = live_field (c, "tether");
  bt_status status = bt__check_part (c->dive, BT_PART_TETHER, c->subject, c->error);
  if (status != BT_OK || !field)
    return status != BT_OK ? status : c->error->status;
  tether = bt__dive_tether (c->dive, c->state, c->subject);
  def.props = tether->props;
  status = bt_def_set_number (field, &def, c->args[2], c->error);
  if (status != BT_OK)
    return status;
  if (c->dive->model->tethers[c->subject].n_lumps > 0 && def.props.model < BT_MODEL_DYNAMIC)
    return bt__fail (c->error, BT_ERR_UNSUPPORTED,
                     "the tether has clumps or floats: only `dynamic' and `auto' move it");
  forget_follower (field, &def.props);
  bt_tether_props_complete (&def.props, c->state->density, c->state->gravity);
  ends = bt__tether_ends (c->dive, c->state, c->subject);
  if (!tether->parted
      && bt__distance (ends.a, ends.b)
             > bt__longest_chord (&def.props, tether->length, INFINITY) * (1 + 1e-12))
    return bt__fail (c->error, BT_ERR_DOMAIN, "the tether is stretched, and would not reach so");
  tether->props = def.props;
  tether->stale = 1;
  return BT_OK;
}

/* Every line weighs what its mass does in the new water.  */
static void
weigh_anew (const call *c)
{
  for (int i = 0; i < c->dive->model->n_tethers; i++)
    {
      bt_tether_props *props = &bt__dive_tether (c->dive, c->state, i)->props;
      props->wet_weight = NAN;
      bt_tether_props_complete (props, c->state->density, c->state->gravity);
    }
}

static bt_status
alter_sea (const call *c)
{
  bt_sea_def def = { .depth = c->state->depth,
                     .density = c->state->density,
                     .gravity = c->state->gravity };
  const bt_field *field = live_field (c, "sea");
  bt_status status = field ? bt_def_set_number (field, &def, c->args[2], c->error)
                           : c->error->status;
  if (status != BT_OK)
    return status;
  c->state->density = def.density;
  c->state->gravity = def.gravity;
  weigh_anew (c);
  mark_all_stale (c);
  return BT_OK;
}

static bt_status
alter (const call *c)
{
  if (c->args[0] == BT_PART_SEA)
    return alter_sea (c);
  if (c->args[0] == BT_PART_VEHICLE)
    return alter_vehicle (c);
  if (c->args[0] == BT_PART_TETHER)
    return alter_tether (c);
  return bt__fail (c->error, BT_ERR_NAME, "there is no part of the kind %g", c->args[0]);
}

/* ---- The table ---- */

typedef struct op
{
  bt_op_info info;
  bt_status (*apply) (const call *c);
} op;

static const op ops[BT_OP_COUNT] = {
  [BT_OP_DRIVE] = { { "drive", BT_PART_VEHICLE, 4, 4, "surge sway heave yaw",
                      "set the sticks, -1 to 1; NAN leaves one as it is" },
                    drive },
  [BT_OP_RELEASE] = { { "release", BT_PART_VEHICLE, 0, 0, "",
                        "centre the sticks and switch the autopilots off" },
                      release },
  [BT_OP_PLACE] = { { "place", BT_PART_VEHICLE, 3, 3, "x y z",
                      "sweep the vehicle there at once, stopping where it is blocked" },
                    place },
  [BT_OP_LAY] = { { "lay", BT_PART_VEHICLE, 3, 3, "x y z",
                    "put the vehicle there and lay the tethers anew" },
                  lay },
  [BT_OP_MOVE] = { { "move", BT_PART_VEHICLE, 4, 4, "x y z speed", "go there in a straight line" },
                   move },
  [BT_OP_FLY_TO] = { { "fly-to", BT_PART_VEHICLE, 4, 4, "x y z speed", "fly there, facing it" },
                     fly_to },
  [BT_OP_HOLD_HEADING] = { { "hold-heading", BT_PART_VEHICLE, 1, 1, "radians", "keep this heading" },
                           hold_heading },
  [BT_OP_HOLD_DEPTH] = { { "hold-depth", BT_PART_VEHICLE, 1, 1, "depth", "keep this depth" },
                         hold_depth },
  [BT_OP_HOLD_ALTITUDE] = { { "hold-altitude", BT_PART_VEHICLE, 1, 1, "altitude",
                              "keep this height above the bottom" },
                            hold_altitude },
  [BT_OP_HOLD_POSITION] = { { "hold-position", BT_PART_VEHICLE, 0, 0, "", "stay here" },
                            hold_position },
  [BT_OP_FOLLOW] = { { "follow", BT_PART_VEHICLE, 8, 40000000, "t x y z ...",
                       "follow a measured track, beginning now" },
                     follow },
  [BT_OP_PAY_OUT] = { { "pay-out", BT_PART_TETHER, 2, 2, "metres rate", "let tether out" }, pay_out },
  [BT_OP_HAUL_IN] = { { "haul-in", BT_PART_TETHER, 2, 2, "metres rate", "haul tether in" }, haul_in },
  [BT_OP_CUT] = { { "cut-tether", BT_PART_TETHER, 1, 1, "arc-length", "cut the moving line" }, cut },
  [BT_OP_CURRENT] = { { "current", BT_PART_SEA, 8, BT_CURRENT_ARGS, "packed current",
                        "change the current" },
                      set_current },
  [BT_OP_ALTER] = { { "alter", BT_PART_SEA, 3, 3, "part field value",
                      "change a live field of the subject-th PART (a bt_part), by its place in the "
                      "table of fields" },
                    alter },
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

/* Whatever is done to a vehicle wakes the lines that are fastened to it.  */
static void
wake_lines (const call *c)
{
  for (int i = 0; i < c->dive->model->n_tethers; i++)
    {
      const bt__end *end = c->dive->model->ends[i];
      if (end[0].vehicle == c->subject || end[1].vehicle == c->subject)
        bt__dive_tether (c->dive, c->state, i)->quiet = 0;
    }
}

static bt_status
apply (bt_dive *dive, const op *o, int subject, const double *args, int n, bt_error *error)
{
  call c = { dive, bt__dive_begin (dive), subject, args, n, error };
  bt_status status = o->apply (&c);
  if (o->info.subject == BT_PART_VEHICLE)
    wake_lines (&c);
  return status == BT_OK ? bt__resolve_tethers (dive, c.state, 0, error) : status;
}

static bt_status
try_op (bt_dive *dive, bt_op which, int subject, const double *args, int n, bt_error *error)
{
  const op *o = (unsigned)which < BT_OP_COUNT ? &ops[which] : NULL;
  bt_status status;
  if (!o)
    return bt__fail (error, BT_ERR_NAME, "there is no operation number %d", (int)which);
  status = check_call (dive, o, subject, args, n, error);
  return status == BT_OK ? apply (dive, o, subject, args, n, error) : status;
}

bt_status
bt_dive_do (bt_dive *dive, bt_op which, int subject, const double *args, int n, bt_error *error)
{
  bt_error unasked;
  bt_status status = try_op (dive, which, subject, args, n, error ? error : &unasked);
  if (status == BT_OK)
    bt__dive_commit (dive);
  dive->profile.operations++;
  dive->profile.refused += status != BT_OK;
  return status;
}
