/* The verbs with named arguments: each writes them as the numbers of its operation.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <bight/verbs.h>

#include <math.h>
#include <string.h>

#include "base/error.h"
#include "world/dive.h"

/* ---- Vehicles ---- */

static bt_status
do_plain (bt_dive *dive, bt_op op, int subject, bt_error *error)
{
  return bt_dive_do (dive, op, subject, NULL, 0, error);
}

static bt_status
do_number (bt_dive *dive, bt_op op, int subject, double value, bt_error *error)
{
  return bt_dive_do (dive, op, subject, &value, 1, error);
}

static bt_status
do_place (bt_dive *dive, bt_op op, int v, bt_vec3 place, bt_error *error)
{
  return bt_dive_do (dive, op, v, (double[]){ place.x, place.y, place.z }, 3, error);
}

static bt_status
do_flight (bt_dive *dive, bt_op op, int v, const bt_flight *f, bt_error *error)
{
  return bt_dive_do (dive, op, v, (double[]){ f->to.x, f->to.y, f->to.z, f->speed }, 4, error);
}

bt_status
bt_vehicle_drive (bt_dive *dive, int v, const bt_sticks *s, bt_error *error)
{
  return bt_dive_do (dive, BT_OP_DRIVE, v, (double[]){ s->surge, s->sway, s->heave, s->yaw }, 4,
                     error);
}

bt_status
bt_vehicle_release (bt_dive *dive, int v, bt_error *error)
{
  return do_plain (dive, BT_OP_RELEASE, v, error);
}

bt_status
bt_vehicle_place (bt_dive *dive, int v, bt_vec3 place, bt_error *error)
{
  return do_place (dive, BT_OP_PLACE, v, place, error);
}

bt_status
bt_vehicle_lay (bt_dive *dive, int v, bt_vec3 place, bt_error *error)
{
  return do_place (dive, BT_OP_LAY, v, place, error);
}

bt_status
bt_vehicle_move (bt_dive *dive, int v, const bt_flight *flight, bt_error *error)
{
  return do_flight (dive, BT_OP_MOVE, v, flight, error);
}

bt_status
bt_vehicle_fly_to (bt_dive *dive, int v, const bt_flight *flight, bt_error *error)
{
  return do_flight (dive, BT_OP_FLY_TO, v, flight, error);
}

bt_status
bt_vehicle_hold_heading (bt_dive *dive, int v, double heading, bt_error *error)
{
  return do_number (dive, BT_OP_HOLD_HEADING, v, heading, error);
}

bt_status
bt_vehicle_hold_depth (bt_dive *dive, int v, double depth, bt_error *error)
{
  return do_number (dive, BT_OP_HOLD_DEPTH, v, depth, error);
}

bt_status
bt_vehicle_hold_altitude (bt_dive *dive, int v, double altitude, bt_error *error)
{
  return do_number (dive, BT_OP_HOLD_ALTITUDE, v, altitude, error);
}

bt_status
bt_vehicle_hold_position (bt_dive *dive, int v, bt_error *error)
{
  return do_plain (dive, BT_OP_HOLD_POSITION, v, error);
}

bt_status
bt_vehicle_follow (bt_dive *dive, int v, const bt_rows *track, bt_error *error)
{
  const bt_op_info *info = bt_op_describe (BT_OP_FOLLOW);
  if (track->width != 4 || track->n > (size_t)info->max_args / 4)
    return bt__fail (error, BT_ERR_DOMAIN,
                     "a track is at most %d rows of four numbers, t x y z, not %zu rows of %zu",
                     info->max_args / 4, track->n, track->width);
  return bt_dive_do (dive, BT_OP_FOLLOW, v, track->at, (int)(4 * track->n), error);
}

bt_status
bt_vehicle_stabilise (bt_dive *dive, int v, bool on, bt_error *error)
{
  return do_number (dive, BT_OP_STABILISE, v, on, error);
}

static bt_status
do_failure (bt_dive *dive, int v, const bt_failure *f, bool on, bt_error *error)
{
  double value = f->fault == BT_FAULT_THRUSTER ? (double)f->thruster : f->drift;
  return bt_dive_do (dive, BT_OP_FAULT, v, (double[]){ (double)f->fault, on, value }, 3, error);
}

bt_status
bt_vehicle_break (bt_dive *dive, int v, const bt_failure *failure, bt_error *error)
{
  return do_failure (dive, v, failure, true, error);
}

bt_status
bt_vehicle_mend (bt_dive *dive, int v, const bt_failure *failure, bt_error *error)
{
  return do_failure (dive, v, failure, false, error);
}

/* ---- Tethers ---- */

static bt_status
do_spooling (bt_dive *dive, bt_op op, int t, const bt_spooling *s, bt_error *error)
{
  return bt_dive_do (dive, op, t, (double[]){ s->length, s->rate }, 2, error);
}

bt_status
bt_tether_pay_out (bt_dive *dive, int t, const bt_spooling *spooling, bt_error *error)
{
  return do_spooling (dive, BT_OP_PAY_OUT, t, spooling, error);
}

bt_status
bt_tether_haul_in (bt_dive *dive, int t, const bt_spooling *spooling, bt_error *error)
{
  return do_spooling (dive, BT_OP_HAUL_IN, t, spooling, error);
}

bt_status
bt_tether_cut (bt_dive *dive, int t, double arc_length, bt_error *error)
{
  return do_number (dive, BT_OP_CUT, t, arc_length, error);
}

/* ---- The sea ---- */

bt_status
bt_sea_set_current (bt_dive *dive, const bt_current *current, bt_error *error)
{
  double args[BT_CURRENT_ARGS];
  return bt_dive_do (dive, BT_OP_CURRENT, 0, args, bt_current_pack (current, args), error);
}

bt_status
bt_sea_set_waves (bt_dive *dive, const bt_wave_def *waves, bt_error *error)
{
  double args[BT_WAVES_ARGS];
  return bt_dive_do (dive, BT_OP_WAVES, 0, args, bt_waves_pack (waves, args), error);
}

/* ---- Parts ---- */

/* What the I-th PART of DIVE is, or NULL with the reason in ERROR.  */
static const bt_head *
head_of (const bt_dive *dive, bt_part part, int i, bt_error *error)
{
  if (part == BT_PART_SEA)
    return bt_head_find ("sea");
  if (bt__check_part (dive, part, i, error) != BT_OK)
    return NULL;
  if (part == BT_PART_OBSTACLE)
    return bt_obstacle_head (dive->model->obstacles[i].kind);
  return bt_head_find (part == BT_PART_VEHICLE ? "rov" : "tether");
}

/* The field NAME of the I-th PART in *HEAD, or NULL with the reason in ERROR.  */
static const bt_field *
field_of (const bt_dive *dive, bt_part part, int i, const char *name, const bt_head **head,
          bt_error *error)
{
  const bt_field *field = NULL;
  *head = head_of (dive, part, i, error);
  if (*head && !(field = bt_field_find (*head, name)))
    bt__fail (error, BT_ERR_NAME, "a %s has no field `%s'", (*head)->name, name);
  return field;
}

static bt_status
alter (bt_dive *dive, bt_part part, int i, const bt_head *head, const bt_field *field, double value,
       bt_error *error)
{
  double args[] = { (double)part, (double)(field - head->fields), value };
  return bt_dive_do (dive, BT_OP_ALTER, i, args, 3, error);
}

bt_status
bt_part_alter (bt_dive *dive, bt_part part, int i, const char *name, double value, bt_error *error)
{
  const bt_head *head;
  const bt_field *field = field_of (dive, part, i, name, &head, error);
  return field ? alter (dive, part, i, head, field, value, error) : error->status;
}

bt_status
bt_part_choose (bt_dive *dive, bt_part part, int i, const char *name, const char *word,
                bt_error *error)
{
  const bt_head *head;
  const bt_field *field = field_of (dive, part, i, name, &head, error);
  double value;
  bt_status status = field ? bt_word_value (field, word, &value, error) : error->status;
  return status == BT_OK ? alter (dive, part, i, head, field, value, error) : status;
}

bt_status
bt_part_collide (bt_dive *dive, bt_part part, int i, int obstacle, bool on, bt_error *error)
{
  double args[] = { (double)part, (double)obstacle, on };
  return bt_dive_do (dive, BT_OP_COLLIDE, i, args, 3, error);
}

bt_status
bt_obstacle_drift (bt_dive *dive, int i, bt_vec3 velocity, bt_error *error)
{
  double args[] = { velocity.x, velocity.y, velocity.z };
  return bt_dive_do (dive, BT_OP_DRIFT, i, args, 3, error);
}
