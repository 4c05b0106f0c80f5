/* The moving line in a dive, as its files share it.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#ifndef BT_SIM_CHAIN_H
#define BT_SIM_CHAIN_H

#include "base/error.h"
#include "collide/bvh.h"
#include "sim/form_step.h"
#include "sim/sim.h"
#include "world/line.h"

/* The vehicle with mass carried by the far end of tether I, or -1.  */
int bt__carried_vehicle (const bt_dive *dive, bt__state *state, int i);

/* True if tether I is clamped at an end.  */
static inline int
bt__is_clamped_at_all (const bt_dive *dive, int i)
{
  return bt__is_clamped (&dive->model->tethers[i], 0)
         || bt__is_clamped (&dive->model->tethers[i], 1);
}

/* What the kernel is told of tether I: ends, water, the vehicle it carries; no winch, nothing that
   is fastened to the line or has set in it.  */
bt__dynamic_input bt__chain_input (const bt_dive *dive, bt__state *state, int i,
                                   const bt_water *water, const bt__ends *ends);

/* What belongs to the material of a line: the winch does not change distances from the far end.  */
typedef struct bt__fastened
{
  bt__dynamic_lump lumps[BT_LUMPS_MAX];
  bt__dynamic_set sets[BT_SETS_MAX];
} bt__fastened;

/* Give INPUT the lumps of tether I between FROM and TO metres from the far end, and the tether's
   sets; FASTENED keeps both.  */
void bt__fasten (const bt_dive *dive, int i, double from, double to, bt__dynamic_input *input,
                 bt__fastened *fastened);

/* Let the vehicle that tether I carries follow its last node.  */
bt_status bt__bring_vehicle (const bt_dive *dive, bt__state *state, int i, bt_error *error);

/* What the number of intervals of tether I keeps to in a step (remesh.c).  */
bt__dynamic_mesh bt__chain_mesh (const bt_dive *dive, const bt__state *state,
                                 const bt__tether *tether, int i);

/* An arch: neighbouring nodes of a line that are beyond a limit, and the feet where the line
   crosses it (afloat.c).  */
typedef struct bt__arch
{
  int first, last; /* nodes */
  bt_vec3 from, to;
} bt__arch;

/* Write the first arch of the N + 1 nodes X at or behind node K to *A, OVER telling how far each
   node is beyond the limit, m, below 0 within; return zero if there is none.  */
int bt__next_arch (const bt_vec3 *x, const double *over, int n, int k, bt__arch *a);

/* Turn the arch A of the nodes X about the straight line between its feet until it lies aside, down
   the stream; if it HANGS, until it hangs below its feet.  */
void bt__lay_aside (bt_vec3 *x, const bt__arch *a, int hangs, bt_vec3 downstream);

/* Lay all arches of a line of LENGTH m with the N + 1 nodes X on the surface, OVER having room for
   as many numbers; return true if there was an arch.  bt__lay_shape_afloat does so with the static
   shape of tether I, whose form is then AFLOAT (afloat.c).  */
int bt__lay_afloat (bt_vec3 *x, double *over, int n, double length, const bt_water *water);
void bt__lay_shape_afloat (bt_dive *dive, bt__state *state, int i);

/* The most intervals that the mesh of a tether takes of the room of its chain where contact may put
   in nodes, too; the most that model `auto' chooses for tether I.  A node that slides about an edge
   comes only where the chain has room: without that a node of the line is caught there.  */
int bt__mesh_room (const bt_tether_def *def);
int bt__adaptive_room (const bt_dive *dive, int i);

/* bt__rest_nodes returns the number of intervals with which a chain of TETHER begins.
   bt__trace_rest puts N + 1 points of the shape of tether I, or of the equilibrium if the tether
   has no shape, on the dive's polyline, with the tensions along it.  bt__begin_chain begins
   a chain of N intervals on the polyline, at rest; if SHARE is given, each interval has its share
   of the length, and no tension (chain.c).  */
int bt__rest_nodes (const bt_dive *dive, const bt__tether *tether, int i);
bt_status bt__trace_rest (bt_dive *dive, bt__state *state, int i, const bt__ends *ends, int n,
                          bt_error *error);
bt_status bt__begin_chain (bt_dive *dive, bt__state *state, int i, const bt__ends *ends, int n,
                           const double *share, bt_error *error);

/* As bt__dynamic_step for a PART of tether I, with contact of the line with obstacles, other lines
   and its own bights (chain_touch.c).  */
bt_status bt__step_among (bt_dive *dive, bt__state *state, int i, int part,
                          const bt__dynamic_input *input, bt__dynamic_report *report,
                          bt_error *error);

/* The same, with the wear of it, counted in the profile (chain_step.c).  */
bt_status bt__step_part (bt_dive *dive, bt__state *state, int i, int part,
                         const bt__dynamic_input *input, bt__dynamic_report *report,
                         bt_error *error);

/* Add to SUM the report of another part of the step, or of the line: the largest, the tightest;
   what is of one alone is PART's (chain_fine.c).  */
void bt__add_report (bt__dynamic_report *sum, const bt__dynamic_report *part);

/* bt__advance_chain takes tether I on by the part of the step that the contact work of DIVE names;
   its ends go from FROM to TO in the whole step (chain_step.c).  bt__advance_as_asked takes tether
   I through the whole step in as many parts as its accuracy asks for, REPORT being of them all
   (chain_fine.c).  */
bt_status bt__advance_chain (bt_dive *dive, bt__state *state, int i, const bt__ends *from,
                             const bt__ends *to, bt__dynamic_report *report, bt_error *error);
bt_status bt__advance_as_asked (bt_dive *dive, bt__state *state, int i, const bt__ends *to,
                                bt__dynamic_report *report, bt_error *error);

/* What tether I may change in a step beside its store.  bt__keep_present notes it as it is before
   the step; bt__go_back brings tether I back to the present and to what was noted (chain_fine.c).
 */
typedef struct bt__present
{
  bt__tether tether;
  bt__vehicle vehicle[2];
  int64_t events;
} bt__present;

void bt__keep_present (const bt_dive *dive, bt__state *state, int i, bt__present *p);
void bt__go_back (const bt_dive *dive, bt__state *state, int i, const bt__present *p);

/* bt__may_go_back and bt__was_wound: tether I may be taken through the step otherwise than whole.
   The first: the line moved already in the present, the winch stands and gives no line, and water
   and ends alone act on the line.  The second: all line from the winch was in the chain in the
   present.  bt__tension_asked: the accepted error in tension, N, where the largest tension is
   TENSION.  bt__has_jumped: the tension, at most TENSION, changed in the step by more than TIMES
   its accuracy (chain_fine.c).  */
int bt__may_go_back (const bt_dive *dive, bt__state *state, int i);
int bt__was_wound (const bt_dive *dive, int i);
double bt__tension_asked (const bt__tether *tether, double tension);
int bt__has_jumped (const bt_dive *dive, bt__state *state, int i, double tension, double times);

/* bt__rides_stretch takes tether I through the step to ENDS as a part of a stretch and returns
   true, or does nothing.  bt__stretch_tension returns the largest present tension of a TETHER taken
   so, N (chain_stretch.c).  */
int bt__rides_stretch (bt_dive *dive, bt__state *state, int i, const bt__ends *ends);
double bt__stretch_tension (const bt__tether *tether);

/* bt__are_ends_foreseen returns true if the stretch of tether I has its ends at ENDS in the next
   step.  bt__go_on_within takes tether I, with more of its stretch to come than the step, through
   the step to ENDS, with what bt__step_chain notes in such a step (chain_stretch.c).  */
int bt__are_ends_foreseen (const bt_dive *dive, bt__state *state, int i, const bt__ends *ends);
void bt__go_on_within (bt_dive *dive, bt__state *state, int i, const bt__ends *ends);

/* bt__is_out_of_sight returns true if tether I was ahead before the step to STATE: no contact looks
   at tether I.  bt__has_room_about returns true if tether I, WAY metres about its places from the
   present to STATE, meets no tether in the step, nor in the stretch of one (chain_apart.c).  */
int bt__is_out_of_sight (const bt_dive *dive, const bt__state *state, int i);
int bt__has_room_about (const bt_dive *dive, bt__state *state, int i, double way);

/* The way, m, that every node of PART of tether I may go while the part stays clear of itself, of
   the other part and of tethers in sight, however these move; at most a share of an interval
   (chain_touch.c).  */
double bt__spare_among_lines (bt_dive *dive, bt__state *state, int i, int part);

/* The box about all places of tether I of STATE, ahead of the present, in its stretch.  */
bt__aabb bt__box_of_stretch (const bt_dive *dive, bt__state *state, int i);

/* bt__most_pull_at returns what pulls end K of tether I to its place, N: a fixed point whatever it
   takes; a vehicle its pull, and what its other tethers pull against tether I.  bt__slips_at is
   true if end K slips where the tether pulls harder: a vehicle without mass holds it, and no
   measured track tells where that was (chain_touch.c).  */
double bt__most_pull_at (const bt_dive *dive, bt__state *state, int i, int k);
int bt__slips_at (const bt_dive *dive, bt__state *state, int i, int k);

/* Bring tether I, of a static model, to ENDS in a step by GO; an end that slips, and its vehicle,
   only as near as its vehicle can pull it (slip.c).  */
bt_status bt__slip_to_ends (bt_dive *dive, bt__state *state, int i, const bt__ends *ends,
                            bt__form_move *go, bt_error *error);

/* bt__order_tethers sorts the tethers by the direction in which they press on each other.
   bt__put_carriers_first then puts tethers that carry vehicles first and static tethers last, and
   keeps the order otherwise (order.c).  */
void bt__order_tethers (bt_dive *dive, bt__state *state);
void bt__put_carriers_first (bt_dive *dive, bt__state *state);

/* Draw the boxes about all moving lines before tethers are resolved.  Draw the boxes of tether I
   anew, and return true, if the line has left its boxes (chain_box.c).  */
void bt__box_lines (bt_dive *dive, bt__state *state);
int bt__box_line (bt_dive *dive, bt__state *state, int i);

/* Note what PART of tether I touches, with the event `touched'.  A sleeping line touches on.  */
void bt__note_line_meetings (const bt_dive *dive, bt__state *state, int i, int part);

/* Wake the tethers that PART of tether I, which moves, touches.  */
void bt__wake_touched (const bt_dive *dive, bt__state *state, int i, int part);

/* Add the sliding at the contacts of a PART of tether I in the last step to the wear of its jacket
   (chain_wear.c).  */
void bt__wear_chain (bt_dive *dive, bt__state *state, int i, int part);

/* Raise the events of a step of TETHER: all that REPORT tells; those of the largest TENSION alone;
   those of twist.  */
void bt__watch_step (const bt_dive *dive, bt__state *state, bt__tether *tether, int i,
                     const bt__dynamic_report *report);
void bt__watch_tension (bt__state *state, bt__tether *tether, int i, double tension);
void bt__watch_twist (const bt_dive *dive, bt__state *state, bt__tether *tether, int i);

#endif
