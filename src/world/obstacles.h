/* What the parts of a dive may meet: places of kinematic obstacles, friction, enabled pairs, and
   contacts by object.  In a world without obstacles the objects are the tethers alone.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#ifndef BT_WORLD_OBSTACLES_H
#define BT_WORLD_OBSTACLES_H

#include "contact/line.h"
#include "contact/touch.h"
#include "world/dive.h"

/* Return the bytes in a state for what the parts of MODEL may meet; the offsets of the friction and
   of the first subject; and the bytes of a subject.  */
size_t bt__obstacles_size (const bt_model *model);
size_t bt__roughness_at (const bt_model *model);
size_t bt__subjects_at (const bt_model *model);
size_t bt__subject_size (const bt_model *model);

/* Put everything in its place for the start of a dive.  */
void bt__obstacles_init (const bt_dive *dive, bt__state *state);

/* What a line of MODEL may meet.  */
static inline bt__among
bt__model_among (const bt_model *model)
{
  return model->n_obstacles > 0 || model->n_hulls > 0 ? BT__AMONG_OBSTACLES
         : model->n_tethers > 1                       ? BT__AMONG_LINES
                                                      : BT__AMONG_ITSELF;
}

bt__mover_state *bt__dive_movers (const bt_dive *dive, bt__state *state);

/* Coulomb's coefficient of each obstacle; NaN: the tether's own.  */
double *bt__dive_roughness (const bt_dive *dive, bt__state *state);

/* How many objects a tether may touch: the obstacles by number, then all tethers, then the hulls of
   vehicles.  */
int bt__objects (const bt_model *model);

/* The place of OBSTACLE among the bytes below: obstacles in the scene by their place in the scene,
   then carried obstacles, then tethers.  */
int bt__obstacle_slot (const bt_model *model, int obstacle);

/* True if tether I passes through tether J, which may be I; through the hull of VEHICLE.  */
int bt__passes_tether (const bt_dive *dive, bt__state *state, int i, int j);
int bt__passes_hull (const bt_dive *dive, bt__state *state, int i, int vehicle);

/* Write to the bytes OFF whether OBSTACLE is on.  */
void bt__switch_slot (const bt_model *model, uint8_t *off, int obstacle, int on);

/* The I-th vehicle or tether, by PART, and its byte for each object, by slot.  */
bt__subject *bt__dive_subject (const bt_dive *dive, bt__state *state, bt_part part, int i);
uint8_t *bt__dive_off (const bt_dive *dive, bt__state *state, bt_part part, int i);

/* The windings of tether I about each obstacle, indexed by obstacle, as of the last look.  */
int8_t *bt__dive_told (const bt_dive *dive, bt__state *state, int i);

/* Return the surroundings of the subject: kinematic obstacles on their way through the step, each
   by its share of the motion; or standing at their present places.  Valid until the next call.  */
bt__surroundings bt__surround (const bt_dive *dive, bt__state *state, bt_part part, int i);
bt__surroundings bt__standing (const bt_dive *dive, bt__state *state, bt_part part, int i);

/* MOTION from the share SINCE to the share UNTIL of it.  */
bt__motion bt__motion_part (const bt__motion *motion, double since, double until);

/* The same of whatever there is, switched off or not.  */
bt__surroundings bt__all_standing (const bt_dive *dive, bt__state *state);

/* Return the distance, m, from P straight down to the first surface, bed or obstacle, and in
   *OBSTACLE, unless NULL, the number of the obstacle met.  Where no obstacle is below P, *OBSTACLE
   is BT__NO_OBSTACLE, and the distance is the height above the depth of the sea, negative below.
   bt__altitude_among: of what is AROUND and switched on alone.  */
double bt__dive_altitude (const bt_dive *dive, bt__state *state, bt_vec3 p, int *obstacle);
double bt__altitude_among (const bt_dive *dive, bt__state *state, const bt__surroundings *around,
                           bt_vec3 p, int *obstacle);

/* Return the greatest altitude that there is under water in STATE, m.  */
double bt__dive_altitude_max (const bt_dive *dive, bt__state *state);

/* Switch the pair of a subject and the object OBSTACLE, or with OBSTACLE -1 all of its pairs, on or
   off.  */
void bt__switch_pair (const bt_dive *dive, bt__state *state, bt_part part, int i, int obstacle,
                      int on);

/* Return the version of the bytes OFF, one for each object: a hash, 0 if all are on.  */
uint64_t bt__pairs_version (const bt_model *model, const uint8_t *off);

/* Note that the subject meets OBSTACLE in this step, with the event `touched'; forget obstacles not
   met for a while, with the event `left'.  */
void bt__note_meeting (bt__state *state, bt__subject *subject, bt_part part, int i, int obstacle);
void bt__note_partings (bt__state *state, bt__subject *subject, bt_part part, int i);

/* True if the subject met OBSTACLE in the last step.  */
int bt__meets (const bt__state *state, const bt__subject *subject, int obstacle);

#endif
