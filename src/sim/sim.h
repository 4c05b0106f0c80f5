/* The parts of a step, in the order it takes them.  Each works on a state that is not yet the
   present.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#ifndef BT_SIM_SIM_H
#define BT_SIM_SIM_H

#include <math.h>

#include "world/dive.h"

/* Move the vehicles of STATE by one step as sticks, autopilots and tracks say (kinematics.c).  */
void bt__move_vehicles (const bt_dive *dive, bt__state *state);

/* The same of VEHICLE alone, without mass (kinematics.c).  */
void bt__move_vehicle (const bt_dive *dive, bt__state *state, int vehicle);

/* The step of a dive taken in the spare state, as bt_dive_step takes those that do not glide
   in place (step.c).  */
bt_status bt__step_aside (bt_dive *dive, bt_error *error);

/* Return how many of the coming STEPS of VEHICLE, without mass, bring no event about; *TO is where
   all of them take it, if none does (kinematics.c).  */
int bt__foresee_vehicle (const bt_dive *dive, bt__state *state, int vehicle, int steps,
                         bt_vec3 *to);

/* Vehicles with mass (bodies.c).  Steer the vehicles of STATE and find the forces of their moving
   lines; step the vehicles carried by no moving line.  */
bt_status bt__steer_bodies (const bt_dive *dive, bt__state *state, bt_error *error);
bt_status bt__step_bodies (const bt_dive *dive, bt__state *state, bt_error *error);

/* Find what the moving line CARRIER has at its end in the coming H seconds: VEHICLE, steered.  */
bt_status bt__grip_body (const bt_dive *dive, bt__state *state, int vehicle, int carrier, double h,
                         bt_error *error);

/* Step VEHICLE with its attachment at X, the place to which the step of its moving line brought the
   end.  */
bt_status bt__follow_line (const bt_dive *dive, bt__state *state, int vehicle, bt_vec3 x,
                           bt_error *error);

/* Return the moving line that pulls VEHICLE at its far end, or -1.  */
int bt__carrier (const bt_dive *dive, bt__state *state, int vehicle);

/* Put V at P, at rest unless it KEEPS its motion.  */
void bt__put_vehicle (bt__vehicle *v, bt_vec3 p, int keeps);

/* Give V, with mass, the place and motion of its body.  */
void bt__mirror_body (bt__vehicle *v);

/* Note tethers near to a turning thruster, with the event `prop-danger' (props.c).  */
void bt__watch_props (const bt_dive *dive, bt__state *state);

/* Turn the kinematic vehicle V into a dead body moved by forces.  */
void bt__deaden_vehicle (bt__vehicle *v);

/* Remember the pull of tether I, laid anew, on the vehicle it carries.  */
void bt__note_pull (const bt_dive *dive, bt__state *state, int i);

enum
{
  BT__REMESH_EVERY = 10 /* steps between looks at the error of a line of model `auto' */
};

/* True if the model of TETHER is a moving line.  */
static inline int
bt__is_moving_model (const bt__tether *tether)
{
  return tether->props.model == BT_MODEL_DYNAMIC || tether->props.model == BT_MODEL_AUTO;
}

/* True if TETHER stretches, so that it holds by force.  */
static inline int
bt__is_spring (const bt__tether *tether)
{
  return tether->props.model >= BT_MODEL_ELASTIC && isfinite (tether->props.ea);
}

/* bt__turn_winches turns the winches of STATE by one step.  bt__stall_where_held, called before,
   stalls each winch that hauls the static tether of a vehicle pinned in this try (winch.c).  */
void bt__turn_winches (const bt_dive *dive, bt__state *state);
void bt__stall_where_held (const bt_dive *dive, bt__state *state);

/* Return the most that the winch of a tether of PROPS hauls with, N; stop the winch of tether I,
   stalled, with LENGTH out (winch.c).  */
double bt__winch_pull (const bt_tether_props *props);
void bt__stall_winch (bt__state *state, bt__tether *tether, int i, double length);

/* Return the greatest length, m, that tether I can have out: the length of its drum, less the
   length lost by parting (winch.c).  */
double bt__most_out (const bt_dive *dive, bt__state *state, int i);

/* A cut line is home with so much of it out, m: its end hangs from the winch.  */
#define BT__HOME_LENGTH 0.1

/* Hold the vehicles of STATE, moved since FROM, within the reach of their tethers (reach.c).  */
void bt__hold_at_tethers (const bt_dive *dive, const bt__state *from, bt__state *state);

/* Return how far along the straight way from A to B, 0 to 1, vehicle I of STATE gets before a
   tether stops it (reach.c).  */
double bt__reach_along (const bt_dive *dive, bt__state *state, int i, bt_vec3 a, bt_vec3 b);

/* Solve the tethers of STATE whose ends, length, properties or current changed, and, when PASSES is
   true, let the moving lines go on by a step (resolve.c).  */
bt_status bt__resolve_tethers (bt_dive *dive, bt__state *state, int passes, bt_error *error);

/* The same of tether I alone, whose turn it is.  */
bt_status bt__resolve_tether (bt_dive *dive, bt__state *state, int i, int passes, bt_error *error);

/* The ends of tether I of STATE.  */
typedef struct bt__ends
{
  bt_vec3 a, b;
} bt__ends;
bt__ends bt__tether_ends (const bt_dive *dive, bt__state *state, int i);

/* Return the strongest pull of the vehicles at the ends of tether I, N; 0 when both are points.  */
double bt__pull_on (const bt_dive *dive, bt__state *state, int i);

/* True if ENDS are those of SHAPE, to the bit (resolve.c).  */
int bt__are_ends (const bt__ends *ends, const bt__shape *shape);

/* True if ends, length, properties and current, all inputs of the line of TETHER, are unchanged
   since the last solve or step (resolve.c).  */
int bt__is_unchanged (const bt_dive *dive, const bt__state *state, const bt__tether *tether,
                      const bt__ends *ends);

/* Solve the static shape of tether I with PROPS, pulled taut with PULL newtons (resolve.c).  */
bt_status bt__solve_shape (bt_dive *dive, bt__state *state, int i, const bt__ends *ends,
                           const bt_tether_props *props, double pull, bt_error *error);

/* Solve tether I between ENDS by its static model, pulled taut by its vehicles (resolve.c).  */
bt_status bt__solve_static (bt_dive *dive, bt__state *state, int i, const bt__ends *ends,
                            bt_error *error);

/* Let every line that is ahead of the present be stepped on from the present (chain_stretch.c).  */
void bt__leave_stretches (const bt_dive *dive, bt__state *state);

/* bt__leave_barred lets every barred line be stepped on from the present.  bt__bar_stretches bars
   lines ahead of the present, and the lines met by them in the step to the next state.  The return
   value is true if any were met: the step is to be taken again (chain_apart.c).  */
void bt__leave_barred (const bt_dive *dive, bt__state *state);
int bt__bar_stretches (bt_dive *dive);

/* True if the distance of ENDS makes TETHER taut (reach.c).  */
int bt__is_chord_taut (const bt__tether *tether, const bt__ends *ends);

/* True if tether I would pull a vehicle back on the vehicle's way from its place in FROM to its
   place in STATE (reach.c).  */
int bt__is_pulled_back (const bt_dive *dive, const bt__state *from, bt__state *state, int i);

/* Note whether tether I is TAUT, with the event `taut' or `slack' (reach.c).  */
void bt__note_taut (bt__state *state, bt__tether *tether, int i, int taut);

/* The moving line (chain.c): lay tether I from its present shape, or from its equilibrium; go on by
   a step; go along with ends that were put elsewhere; become nodes of a static model; take as many
   nodes as its accuracy wants (remesh.c); part at SHARE of INTERVAL of chain
   PART: of a tether that had parted before, the piece between the two breaks drifts off.  */
bt_status bt__lay_chain (bt_dive *dive, bt__state *state, int i, const bt__ends *ends,
                         bt_error *error);
bt_status bt__step_chain (bt_dive *dive, bt__state *state, int i, const bt__ends *ends,
                          bt_error *error);
bt_status bt__carry_chain (bt_dive *dive, bt__state *state, int i, const bt__ends *ends,
                           bt_error *error);
void bt__still_chain (bt_dive *dive, bt__state *state, int i);
bt_status bt__remesh_chain (bt_dive *dive, bt__state *state, int i, bt_error *error);
void bt__part_chain (bt_dive *dive, bt__state *state, int i, int part, int interval, double share);

/* bt__look_at_nodes notes, after a step of tether I of model `auto' with the tightest bend BEND,
   1/m, the error of the nodes, and remeshes.  bt__is_look_due is true if a look is due
   (remesh.c).  */
int bt__is_look_due (const bt_dive *dive, bt__state *state, int i, double bend);
bt_status bt__look_at_nodes (bt_dive *dive, bt__state *state, int i, double bend, bt_error *error);

#endif
