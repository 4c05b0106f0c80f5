/* The verbs of a dive, a function each.

   Each function is one call of bt_dive_do with named and typed arguments, done whole or not at all.
   Every verb returns BT_ERR_NAME for an unknown vehicle, tether or obstacle, and BT_ERR_DOMAIN for
   a number out of range, with the allowed range in ERROR.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#ifndef BIGHT_VERBS_H
#define BIGHT_VERBS_H

#include <stdbool.h>

#include <bight/dive.h>
#include <bight/instruments.h>

BT_BEGIN_DECLS

/* ---- Vehicles ---- */

/* Sticks, -1 to 1: ahead, to starboard, up, clockwise.  NAN leaves a stick as it is.  */
typedef struct bt_sticks
{
  double surge, sway, heave, yaw;
} bt_sticks;

/* Set the sticks of vehicle V; a flight to a place ends.  */
bt_status bt_vehicle_drive (bt_dive *dive, int v, const bt_sticks *sticks, bt_error *error);

/* Centre the sticks of vehicle V, end its flight and switch its autopilots off.  */
bt_status bt_vehicle_release (bt_dive *dive, int v, bt_error *error);

/* Sweep vehicle V to PLACE (m) at once, as far as obstacles and its tether let it.  */
bt_status bt_vehicle_place (bt_dive *dive, int v, bt_vec3 place, bt_error *error);

/* Put vehicle V at PLACE (m) and lay its tethers anew.  BT_ERR_DOMAIN if an obstacle is there, or
   if a tether does not reach.  */
bt_status bt_vehicle_lay (bt_dive *dive, int v, bt_vec3 place, bt_error *error);

/* A flight to a place.  */
typedef struct bt_flight
{
  bt_vec3 to;   /* m */
  double speed; /* m/s, above 0 */
} bt_flight;

/* Send vehicle V in a straight line, its heading as it is; or facing the way it flies.  */
bt_status bt_vehicle_move (bt_dive *dive, int v, const bt_flight *flight, bt_error *error);
bt_status bt_vehicle_fly_to (bt_dive *dive, int v, const bt_flight *flight, bt_error *error);

/* Let vehicle V keep a compass heading (rad), a depth below the surface (m), an altitude above the
   bed (m), or the place where it is.  */
bt_status bt_vehicle_hold_heading (bt_dive *dive, int v, double heading, bt_error *error);
bt_status bt_vehicle_hold_depth (bt_dive *dive, int v, double depth, bt_error *error);
bt_status bt_vehicle_hold_altitude (bt_dive *dive, int v, double altitude, bt_error *error);
bt_status bt_vehicle_hold_position (bt_dive *dive, int v, bt_error *error);

/* Let vehicle V follow TRACK from now on: rows of four, t x y z (s from now, m), two at least.  */
bt_status bt_vehicle_follow (bt_dive *dive, int v, const bt_rows *track, bt_error *error);

/* Keep vehicle V, which has mass, level: its yaw stick then sets a rate.  */
bt_status bt_vehicle_stabilise (bt_dive *dive, int v, bool on, bt_error *error);

/* Something that breaks on a vehicle.  */
typedef struct bt_failure
{
  bt_fault fault;
  double drift; /* rad/s: of the compass (BT_FAULT_COMPASS) */
  int thruster; /* its number, from 0 (BT_FAULT_THRUSTER) */
} bt_failure;

/* Break something on vehicle V, or mend what is broken.  */
bt_status bt_vehicle_break (bt_dive *dive, int v, const bt_failure *failure, bt_error *error);
bt_status bt_vehicle_mend (bt_dive *dive, int v, const bt_failure *failure, bt_error *error);

/* ---- Tethers ---- */

/* What a winch is to do.  */
typedef struct bt_spooling
{
  double length; /* m */
  double rate;   /* m/s, above 0 */
} bt_spooling;

/* Let line of tether T out, or haul it in, from now on; the winch's own limits hold.  */
bt_status bt_tether_pay_out (bt_dive *dive, int t, const bt_spooling *spooling, bt_error *error);
bt_status bt_tether_haul_in (bt_dive *dive, int t, const bt_spooling *spooling, bt_error *error);

/* Cut tether T at ARC_LENGTH metres from its anchor, within a fifth of an interval.  The
   part at the anchor of a parted tether is cut again: the piece between both cuts drifts off and
   leaves the dive.  BT_ERR_UNSUPPORTED for a model without a moving line.  */
bt_status bt_tether_cut (bt_dive *dive, int t, double arc_length, bt_error *error);

/* ---- The sea ---- */

/* Change the current, or the waves.  */
bt_status bt_sea_set_current (bt_dive *dive, const bt_current *current, bt_error *error);
bt_status bt_sea_set_waves (bt_dive *dive, const bt_wave_def *waves, bt_error *error);

/* ---- Parts ---- */

/* Change the live field FIELD ("friction", "accuracy") of the I-th PART to VALUE, or to the word
   WORD
   ("dynamic").  BT_ERR_NAME for a field or a word that is none.  */
bt_status bt_part_alter (bt_dive *dive, bt_part part, int i, const char *field, double value,
                         bt_error *error);
bt_status bt_part_choose (bt_dive *dive, bt_part part, int i, const char *field, const char *word,
                          bt_error *error);

/* Let the I-th PART, a vehicle or a tether, meet obstacle OBSTACLE, -1: all that it can meet, or
   pass through it.  */
bt_status bt_part_collide (bt_dive *dive, bt_part part, int i, int obstacle, bool on,
                           bt_error *error);

/* Set the I-th obstacle adrift at VELOCITY, m/s: it leaves its track for good, and stands with
   zero. BT_ERR_UNSUPPORTED for an obstacle without a track.  */
bt_status bt_obstacle_drift (bt_dive *dive, int i, bt_vec3 velocity, bt_error *error);

BT_END_DECLS

#endif
