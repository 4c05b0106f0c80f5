/* The tables of the structs that are the world's own.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <math.h>

#include "world/judge_tables.h"

/* ---- The sea ---- */

/* What counts of a current is judged by bt_current_check.  */
static const bt__member current[] = {
  BT__WITHIN (bt_current, kind, BT_CURRENT_STILL, BT_CURRENT_GRID),
  BT__WITHIN (bt_current, n, 0, BT_PROFILE_MAX),
  BT__ANY (bt_current, turn_rate),
  BT__ANY (bt_current, exponent),
  BT__ANY (bt_current, period),
  BT__ANY (bt_current, z),
  BT__ANY (bt_current, velocity),
};
const bt__record bt__current_record = BT__RECORD (bt_current, "current", current);

static const bt__member wave[] = {
  BT__WITHIN (bt_wave_def, kind, BT_WAVE_NONE, BT_WAVE_JONSWAP),
  BT__WITHIN (bt_wave_def, height, -BT__HUGE, BT__HUGE),
  BT__WITHIN (bt_wave_def, period, -BT__HUGE, BT__HUGE),
  BT__WITHIN (bt_wave_def, toward, -BT__HUGE, BT__HUGE),
  BT__WITHIN (bt_wave_def, phase, -BT__HUGE, BT__HUGE),
  BT__WITHIN (bt_wave_def, gamma, -BT__HUGE, BT__HUGE),
  BT__WITHIN (bt_wave_def, components, -BT__HUGE, BT__HUGE),
  BT__WITHIN (bt_wave_def, seed, -BT__MANY, BT__MANY),
  BT__WITHIN (bt_wave_def, accuracy, -BT__HUGE, BT__HUGE),
};
const bt__record bt__wave_record = BT__RECORD (bt_wave_def, "waves as asked for", wave);

static const bt__member waves[] = {
  BT__WITHIN (bt_waves, n, 0, BT_WAVES_MAX),
  BT__WITHIN (bt_waves, depth, 0, BT__FAR),
  BT__WITHIN (bt_waves, east, -1, 1),
  BT__WITHIN (bt_waves, north, -1, 1),
  BT__WITHIN (bt_waves, omega, 0, BT__FAR),
  BT__WITHIN (bt_waves, k, 0, BT__FAR),
  BT__WITHIN (bt_waves, amplitude, 0, BT__FAR),
  BT__WITHIN (bt_waves, speed, 0, BT__FAR),
  BT__WITHIN (bt_waves, bed, 0, 1),
  BT__WITHIN (bt_waves, phase, -BT__HUGE, BT__HUGE),
  BT__WITHIN (bt_waves, accuracy, 0, 1),
  BT__WITHIN (bt_waves, reach, 0, BT__FAR),
};
const bt__record bt__waves_record = BT__RECORD (bt_waves, "waves", waves);

static const bt__member event[] = {
  BT__WITHIN (bt_event, time, 0, BT__HUGE),
  BT__WITHIN (bt_event, kind, 0, BT__MANY),
  BT__WITHIN (bt_event, part, BT_PART_SEA, BT_PART_OBSTACLE),
  BT__WITHIN (bt_event, subject, -1, BT__MANY),
  BT__WITHIN (bt_event, object, -1, BT__MANY), /* of those that are kept, see judge_parts.c */
};
const bt__record bt__event_record = BT__RECORD (bt_event, "event", event);

/* The first four are compared before anything is believed; density and gravity are judged by the
   table of fields.  */
static const bt__member state[] = {
  BT__ANY (bt__state, magic),
  BT__ANY (bt__state, model_id),
  BT__ANY (bt__state, size),
  BT__ANY (bt__state, checksum),
  BT__WITHIN (bt__state, step, 0, BT__MANY / 2),
  BT__WITHIN (bt__state, depth, 0, BT__FAR),
  BT__WITHIN (bt__state, density, 0, BT__FAR),
  BT__WITHIN (bt__state, gravity, 0, BT__FAR),
  BT__OF (bt__state, current, bt__current_record),
  BT__TRUTH (bt__state, wake),
  BT__OF (bt__state, wave, bt__wave_record),
  BT__OF (bt__state, waves, bt__waves_record),
  BT__WITHIN (bt__state, events, 0, BT__MANY / 2),
  BT__OF (bt__state, event, bt__event_record),
};
const bt__record bt__state_record = BT__RECORD (bt__state, "head", state);

/* ---- Vehicles ---- */

static const bt__member hold[] = {
  BT__TRUTH (bt__hold, on),
  BT__WITHIN (bt__hold, value, -BT__FAR, BT__FAR),
};
const bt__record bt__hold_record = BT__RECORD (bt__hold, "hold", hold);

static const bt__member vehicle[] = {
  BT__WITHIN (bt__vehicle, position, -BT__FAR, BT__FAR),
  BT__WITHIN (bt__vehicle, velocity, -BT__HUGE, BT__HUGE),
  BT__WITHIN (bt__vehicle, heading, -BT__FAR, BT__FAR),
  BT__WITHIN (bt__vehicle, heading0, -BT__FAR, BT__FAR),
  BT__WITHIN (bt__vehicle, pitch, -BT__FAR, BT__FAR),
  BT__WITHIN (bt__vehicle, roll, -BT__FAR, BT__FAR),
  BT__WITHIN (bt__vehicle, sticks, -1, 1),
  BT__WITHIN (bt__vehicle, speeds, 0, BT__FAR),
  BT__WITHIN (bt__vehicle, pull, 0, BT__HUGE),
  BT__WITHIN (bt__vehicle, goal, BT__GOAL_NONE, BT__GOAL_TRACK),
  BT__WITHIN (bt__vehicle, target, -BT__FAR, BT__FAR),
  BT__WITHIN (bt__vehicle, target_speed, 0, BT__FAR),
  BT__WITHIN (bt__vehicle, track, 0, BT__TRACKS_MAX - 1),
  BT__WITHIN (bt__vehicle, track_start, -BT__HUGE, BT__HUGE),
  BT__OF (bt__vehicle, hold_heading, bt__hold_record),
  BT__OF (bt__vehicle, hold_depth, bt__hold_record),
  BT__TRUTH (bt__vehicle, held),
  BT__OF (bt__vehicle, instruments, bt__instruments_record),
  BT__TRUTH (bt__vehicle, rigid),
  BT__WITHIN (bt__vehicle, lost, 0, (1 << BT__THRUSTERS_MAX) - 1),
  BT__TRUTH (bt__vehicle, props),
  BT__WITHIN (bt__vehicle, volts, 0, BT__FAR),
  BT__OF (bt__vehicle, body, bt__rigid_record),
  BT__OF (bt__vehicle, pilot, bt__pilot_record),
};
const bt__record bt__vehicle_record = BT__RECORD (bt__vehicle, "state", vehicle);

/* ---- Tethers ---- */

static const bt__member stretch[] = {
  BT__WITHIN (bt__stretch, span, 0, BT__LONGEST_STRETCH),
  BT__WITHIN (bt__stretch, gone, 0, BT__LONGEST_STRETCH - 1),
  BT__WITHIN (bt__stretch, next, 0, BT__LONGEST_STRETCH),
  BT__WITHIN (bt__stretch, wait, 0, BT__LONGEST_WAIT),
  BT__WITHIN (bt__stretch, tension, -BT__HUGE, BT__HUGE),
  BT__WITHIN (bt__stretch, pull, -BT__HUGE, BT__HUGE),
};
static const bt__record stretch_record = BT__RECORD (bt__stretch, "long step", stretch);

static const bt__member look[] = {
  BT__WITHIN (bt__look, step, 0, BT__MANY / 2),
  BT__WITHIN (bt__look, error, 0, BT__HUGE),
  BT__WITHIN (bt__look, bend, 0, BT__HUGE),
};
static const bt__record look_record = BT__RECORD (bt__look, "look at nodes", look);

/* The member `props' is judged by the table of fields.  */
static const bt__member tether[] = {
  BT__ANY (bt__tether, props),
  BT__WITHIN (bt__tether, length, 0, BT__FAR),
  BT__WITHIN (bt__tether, winch_rate, -BT__FAR, BT__FAR),
  BT__WITHIN (bt__tether, winch_target, 0, BT__FAR),
  BT__WITHIN (bt__tether, stalling, 0, BT__MANY),
  BT__WITHIN (bt__tether, tension_max, -BT__HUGE, BT__HUGE),
  BT__WITHIN (bt__tether, pull, -BT__HUGE, BT__HUGE),
  BT__WITHIN (bt__tether, store_at, 0, BT__MANY),
  BT__TRUTH (bt__tether, stale),
  BT__TRUTH (bt__tether, settled),
  BT__TRUTH (bt__tether, taut),
  BT__TRUTH (bt__tether, parted),
  BT__WITHIN (bt__tether, lost, 0, BT__FAR),
  BT__WITHIN (bt__tether, shed, -BT__HUGE, BT__HUGE),
  BT__WITHIN (bt__tether, quiet, 0, BT__MANY / 2),
  BT__WITHIN (bt__tether, slack_at, -1, BT__MANY / 2),
  BT__WITHIN (bt__tether, fine, 0, 2 * BT__FINEST),
  BT__WITHIN (bt__tether, peak, 0, BT__HUGE),
  BT__WITHIN (bt__tether, unsure, 0, BT__HUGE),
  BT__OF (bt__tether, stretch, stretch_record),
  BT__OF (bt__tether, look, look_record),
  BT__TRUTH (bt__tether, hockled),
  BT__TRUTH (bt__tether, kinked),
  BT__WITHIN (bt__tether, pulled, 0, BT__MANY / 2),
  BT__TRUTH (bt__tether, stuck),
  BT__WITHIN (bt__tether, was, -BT__FAR, BT__FAR),
  BT__TRUTH (bt__tether, relaid),
  BT__WITHIN (bt__tether, contact_form, BT__TETHER_SHAPE, BT__TETHER_HELD),
  BT__TRUTH (bt__tether, blocked),
  BT__WITHIN (bt__tether, wear, 0, BT__HUGE),
  BT__TRUTH (bt__tether, worn),
  BT__OF (bt__tether, shape, bt__shape_record),
  BT__OF (bt__tether, memory, bt__shape_memory_record),
};
const bt__record bt__tether_record = BT__RECORD (bt__tether, "state", tether);

/* ---- Obstacles ---- */

static const bt__member frame[] = {
  BT__WITHIN (bt__frame, origin, -BT__FAR, BT__FAR),
  BT__WITHIN (bt__frame, x, -2, 2),
  BT__WITHIN (bt__frame, y, -2, 2),
  BT__WITHIN (bt__frame, z, -2, 2),
};
static const bt__record frame_record = BT__RECORD (bt__frame, "axes", frame);

static const bt__member mover[] = {
  BT__OF (bt__mover_state, frame, frame_record),
  BT__WITHIN (bt__mover_state, clock, 0, BT__HUGE),
  BT__TRUTH (bt__mover_state, pinched),
  BT__TRUTH (bt__mover_state, adrift),
  BT__WITHIN (bt__mover_state, drift, -BT__DRIFT_MAX, BT__DRIFT_MAX),
};
const bt__record bt__mover_record = BT__RECORD (bt__mover_state, "place", mover);

static const bt__member meeting[] = {
  BT__WITHIN (bt__meeting, object, 0, BT__MANY), /* of those in use, see judge_parts.c */
  BT__WITHIN (bt__meeting, last, 0, BT__MANY / 2),
};
static const bt__record meeting_record = BT__RECORD (bt__meeting, "meeting", meeting);

static const bt__member subject[] = {
  BT__ANY (bt__subject, version),
  BT__TRUTH (bt__subject, looked),
  BT__ANY (bt__subject, then),
  BT__WITHIN (bt__subject, seen, -BT__FAR, BT__FAR),
  BT__WITHIN (bt__subject, string, 0, INFINITY),
  BT__WITHIN (bt__subject, there, -BT__FAR, BT__FAR),
  BT__TRUTH (bt__subject, berthed),
  BT__WITHIN (bt__subject, berth, -BT__FAR, BT__FAR),
  BT__WITHIN (bt__subject, n, 0, BT__MEETINGS_MAX),
  BT__OF (bt__subject, meeting, meeting_record),
};
const bt__record bt__subject_record = BT__RECORD (bt__subject, "meetings", subject);

/* ---- All of them ---- */

const bt__record *const *
bt__state_records (size_t *n)
{
  static const bt__record *const all[] = {
    &bt__state_record,    &bt__current_record,      &bt__wave_record,        &bt__waves_record,
    &bt__event_record,    &bt__vehicle_record,      &bt__hold_record,        &bt__rigid_record,
    &bt__quat_record,     &bt__pilot_record,        &bt__instruments_record, &bt__tether_record,
    &bt__shape_record,    &bt__shape_memory_record, &bt__dynamic_record,     &bt__contacts_record,
    &bt__contact_record,  &bt__thesis_record,       &bt__span_record,        &bt__split_record,
    &bt__polyline_record, &bt__mover_record,        &frame_record,           &bt__subject_record,
    &meeting_record,
  };
  *n = sizeof all / sizeof *all;
  return all;
}
