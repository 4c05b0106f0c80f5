/* The moving line: half-spaces not to be entered, and ends pulled with a bounded force.

   A step in parts, for a caller who knows obstacles: begin, iterate with constraints as often as
   needed, alter the places, finish.  The kernel knows nothing of the origin of constraints.

   A constraint belongs to a step, and its half-space is fixed for the step.  On a round obstacle,
   however, the pushed place wanders along the link as the link tilts, by ROLL; otherwise a chain of
   links shorter than the radius would be pushed in the wrong places, in each step to the other
   side.

   A constraint pushes the place between two nodes out of a half-space with STIFFNESS times the
   penetration, and drags the place back to where it stuck.  Friction grows with the dragged
   distance, up to the load times the coefficient at SLIP metres.  The distance is fixed, not the
   stiffness, so heavy contacts are no harder to solve than light ones.

   A constraint may have two places of the line instead: its half-space is then about the vector
   from the second to the first place, and the push on the first acts back on the second
   (dynamic_pair.c).

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#ifndef BT_TETHER_DYNAMIC_CONTACT_H
#define BT_TETHER_DYNAMIC_CONTACT_H

#include "tether/dynamic.h"

typedef struct bt__constraint
{
  int64_t node;     /* the place is at (1 - S) of NODE and S of the next, 0 <= S <= 1; ... */
  double s;         /* ... NODE is not the last */
  int64_t pair;     /* 0, or 1 + the node of the second place, ... */
  double t;         /* ... likewise; then PLACE below is the first's less the second's */
  bt_vec3 normal;   /* unit, out of the half-space, at the end of the step */
  double offset;    /* m: the place must have normal . place >= offset */
  double roll;      /* 1/m: what S loses when the next node rises by a metre against NODE, ... */
  double tilt;      /* m: ... from where it is so much higher along NORMAL */
  double stiffness; /* N/m */
  double friction;  /* Coulomb's coefficient */
  double slip;      /* m of drag from where friction is whole */
  bt_vec3 stick;    /* m: the drag at the start of the step */
  bt_vec3 drift;    /* m: motion of the obstacle there in the step */
  double load;      /* N: in a guess, out the solution */
  double before;    /* N: any value; LOAD while another way is tried */
  double active;    /* out: 1 if it bears, 0 if not; any value in */
  bt_vec3 drag;     /* out, m: the drag that friction answers, not yet shortened to SLIP */
  double shift;     /* out, of the interval: how far the load has wandered by ROLL */
  bt_vec3 force;    /* out, N on the line; of two places on the first */
  double block[6];  /* out, of two places: the stiffness between them */
  int64_t next;     /* any value; in the solver the next constraint at NODE */
} bt__constraint;

/* An end that is taken to its place by MOST newtons at the most; the end must be free in the input.
   What cannot be taken along goes on as a body of MASS pulled by MOST.  */
typedef struct bt__dynamic_hold
{
  int64_t on;
  double most;      /* N */
  double stiffness; /* N/m below that, of a spring that may be searched along */
  double mass;      /* kg */
  bt_vec3 at;       /* m */
  bt_vec3 force;    /* N on the end: in a guess, out the solution */
  bt_vec3 lean;     /* N: with which the safe way's spring pulls in its place; any in */
  int64_t slips;    /* out: true if the pull is MOST */
} bt__dynamic_hold;

enum
{
  BT__BENTS = 48 /* bent nodes a line has at most */
};

#define BT__STICK_DAMPING                                                                          \
  1.0 /* times the step's drag: what sticks is a spring that must not ring */

/* A node about which the line runs, see dynamic_bent.c: held in the plane across AXIS, and line
   flows through it from the interval before to the one after.  */
typedef struct bt__dynamic_bent
{
  int64_t node;     /* neither end */
  bt_vec3 at;       /* m: where it is held at the end of the step, but for along AXIS */
  bt_vec3 axis;     /* unit: of the edge or wire */
  bt_vec3 normal;   /* unit, across AXIS: from the obstacle */
  bt_vec3 drift;    /* m: motion of the obstacle there in the step */
  double stiffness; /* N/m */
  double wrap;      /* coefficient times the angle by which the line turns */
  double friction;  /* Coulomb's coefficient, along AXIS */
  double slip;      /* m of drag from where friction is whole */
  double drag;      /* m: drag along the line at the start of the step, ... */
  double side;      /* ... and along AXIS */
  double flow;      /* m in this step: in a guess, out the solution */
  double load;      /* N along the normal: in a guess, out the solution */
  double pull[2];   /* out, N: the tensions before and after */
  double side_now;  /* out, m: SIDE at the end */
  double step;      /* m: the last update of FLOW, ... */
  double gain[2];   /* ... and what the tensions on both sides gain and lose by it, N/m */
  bt_vec3 force;    /* out, N on the line */
} bt__dynamic_bent;

/* Prepare the step of D that INPUT asks for, which must last until it is finished; the proposal is
   the predictor.  What can fail of bt__dynamic_step fails here or in the end.  */
bt_status bt__dynamic_begin (const bt__dynamic *d, bt__dynamic_work *work,
                             const bt__dynamic_input *input, bt__dynamic_report *report,
                             bt_error *error);

/* Between begin and iterate: the line runs about N nodes BENT, at most BT__BENTS, in order.  They
   are kept for the step.  */
void bt__dynamic_bend (bt__dynamic_work *work, bt__dynamic_bent *bent, int n);

/* Between begin and bt__dynamic_bend: set the surplus of interval J to ROUND metres.  The chord is
   longer than the line by the surplus, as about a round member, and the stretch is of the line.
   Without a call the surplus stays.  Not for the fourth order.  */
void bt__dynamic_round (bt__dynamic_work *work, int64_t j, double round);

/* Let line flow at the sliding nodes until the tensions suit the altered proposal; or not at all.
 */
void bt__dynamic_bent_follow (bt__dynamic_work *work);
void bt__dynamic_bent_stop (bt__dynamic_work *work);

/* The positions proposed for the end of the step; they may be altered.  */
bt_vec3 *bt__dynamic_proposal (bt__dynamic_work *work);

/* Solve with N ROWS, sorted or not, from the proposal on.  HOLD has two, for either end, or is
   NULL. Return true if it converged; the proposal may then be anything, also not finite.  */
int bt__dynamic_iterate (bt__dynamic_work *work, bt__constraint *rows, int n,
                         bt__dynamic_hold *hold, bt__dynamic_report *report);

/* The force of the proposal on end K (0, 1), N: the sum of all forces on the end node but the
   holder's (dynamic_ends.c).  */
bt_vec3 bt__dynamic_end_pull (bt__dynamic_work *work, int k);

/* What is watched in a step of a line that nothing moves, see dynamic_energy.c.  */
typedef struct bt__dynamic_watch
{
  double most; /* J */
  int alone, slowed;
} bt__dynamic_watch;

/* Solve with nothing that is touched, as bt__dynamic_step does; what it does when the solution has
   been taken over.  */
bt_status bt__dynamic_iterate_free (bt__dynamic *d, bt__dynamic_work *work,
                                    bt__dynamic_watch *watch, bt__dynamic_report *report,
                                    bt_error *error);
void bt__dynamic_note_free (bt__dynamic *d, const bt__dynamic_work *work,
                            const bt__dynamic_watch *watch);

/* Take the solution over as bt__dynamic_step does: finish, note, and let nodes come and go.  */
bt_status bt__dynamic_take_free (bt__dynamic *d, bt__dynamic_work *work,
                                 const bt__dynamic_input *input, const bt__dynamic_watch *watch,
                                 bt__dynamic_report *report, bt_error *error);

/* Return no less than the longest of the N vectors A, less B: cheap, and up to sqrt (3) too large.
 */
double bt__dynamic_stray (const bt_vec3 *a, const bt_vec3 *b, int n);

/* How N vectors A differ from B: up to sqrt (3) too much.  */
void bt__dynamic_drifted (const bt_vec3 *a, const bt_vec3 *b, int n, bt__dynamic_drift *drift);

/* Take the proposal over into D, without winding.  RESTART (a flag a node, or NULL) says which
   nodes were held back or met something: they go on with the velocity of the move they made and no
   memory.  BT_ERR_DIVERGED leaves D as it was.  */
bt_status bt__dynamic_finish (bt__dynamic *d, bt__dynamic_work *work, const uint8_t *restart,
                              bt__dynamic_report *report, bt_error *error);

/* The same if the step's drift is no more than MOST; else *TAKEN is zero, there is no error and D
   is as it was.  */
bt_status bt__dynamic_finish_within (bt__dynamic *d, bt__dynamic_work *work,
                                     const bt__dynamic_drift *most, int *taken,
                                     bt__dynamic_report *report, bt_error *error);

/* What the winch does next to the nodes of a line.  */
typedef struct bt__dynamic_turn
{
  int way;      /* 1: a node comes; -1: the first inner node goes; 0: nothing */
  double first; /* m: rest length of the first interval when the node has come; 0: all but a piece,
                   whatever a piece is then */
  int straight; /* true if the node that comes lies on the chord */
  int lump;     /* true if the node comes with a lump: see bt__dynamic_split_at_lump */
} bt__dynamic_turn;

/* Return how short the first interval of D, of a line P, need be for what the line turns at the
   winch, m: 0 for a line without bending stiffness, in which a corner is sharp.  */
double bt__dynamic_blunt (const bt__dynamic *d, const bt_tether_props *p);

/* Return the next deed of the winch on D, whose lumps are in INPUT.  */
bt__dynamic_turn bt__dynamic_winding (const bt__dynamic *d, const bt__dynamic_input *input);

/* Put a node at the share U of interval J: on the curve, or with STRAIGHT or where the interval is
   slack on the chord.  The tension stays; what the rest lengths lose is owed.  There must be room.
 */
void bt__dynamic_split (bt__dynamic *d, int64_t j, double u, int straight);

/* Put node 1 where NEXT says, on the curve or, with STRAIGHT, on the chord.  There must be room. */
void bt__dynamic_split_first (bt__dynamic *d, const bt__dynamic_turn *next, int straight);

/* Put node 1 at a lump OUT metres from the winch, in the direction in which D pulls at the winch,
   which pays out at the speed in INPUT.  The loss of rest length is owed.  There must be room.  */
void bt__dynamic_split_at_lump (bt__dynamic *d, double out, const bt__dynamic_input *input);

/* ---- The number of intervals (dynamic_mesh.c) ---- */

/* True if nodes of D may come or go after a step by INPUT.  */
static inline int
bt__dynamic_is_wound (const bt__dynamic *d, const bt__dynamic_input *input)
{
  return input->pay != 0 || input->hold > 0 || d->owed != 0 || input->mesh.idle;
}

/* True if MESH lets D have one interval more.  */
int bt__dynamic_is_open (const bt__dynamic *d, const bt__dynamic_mesh *mesh);

/* Return the inner node of D whose removal changes its shape least, of those from 2 on that KEPT (a
   flag a node, or NULL) does not name; 0 if there is none.  Return the interval that stands for
   most of the shape; of those from 1 on that MESH lets be halved and whose ends KEPT does not name;
   0 if there is none.  */
int64_t bt__dynamic_spare_node (const bt__dynamic *d, const uint8_t *kept);
int64_t bt__dynamic_worst_interval (const bt__dynamic *d, const bt__dynamic_mesh *mesh,
                                    const uint8_t *kept);

/* Flag in KEPT the nodes of D about the point lumps of INPUT, and the next WIDE to either side.  */
void bt__dynamic_keep_lumps (const bt__dynamic *d, const bt__dynamic_input *input, int wide,
                             uint8_t *kept);

/* Return 1 if D should have one interval more to keep to MESH, -1 if one fewer, else 0.  CORNER is
   that of bt__dynamic_space_error.  */
int bt__dynamic_wants (const bt__dynamic *d, const bt__dynamic_mesh *mesh, const uint8_t *corner);

/* Let the winch of D go on with the mean length of its intervals: nodes have come or gone along the
   line.  */
void bt__dynamic_refit (bt__dynamic *d);

/* What bt__dynamic_wants is asked so many times for each interval that the winch adds or takes, for
   the mesh to get better faster than the winch makes it worse.  */
enum
{
  BT__DYNAMIC_TUNES = 2
};

/* Put a node at the share U of interval J's chord, with what it has between its ends; FLOWS:
   interval J runs through one of its ends, and the new node goes along with the other, FROM.  There
   must be room.  */
void bt__dynamic_insert (bt__dynamic *d, int64_t j, double u, int64_t from);

/* Take out node I, not an end: the two intervals become one of the same tension.  */
void bt__dynamic_remove (bt__dynamic *d, int64_t i);

/* Propose that every node of D stays, and forget the answer of the solver.  */
void bt__dynamic_stay (const bt__dynamic *d, bt__dynamic_work *work, bt__dynamic_report *report);

#endif
