/* A dive: one model and the flat state that moves.

   Every operation works on a copy of the state, taken over only after success: a refused call
   leaves the dive unchanged.  Questions are pure reads.  A fork is little more than a state: its
   first operation or step allocates the workspaces, and later steps allocate more when a line has
   more intervals, or touches more, than ever before.  BT_ERR_LIMIT when memory is out.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#ifndef BIGHT_DIVE_H
#define BIGHT_DIVE_H

#include <stddef.h>
#include <stdint.h>

#include <bight/decls.h>
#include <bight/model.h>

BT_BEGIN_DECLS

typedef struct bt_dive bt_dive;

/* Start a dive in MODEL (kept by the dive): vehicles in place, tethers laid.  FUNCTION and USER
   serve a current of kind BT_CURRENT_FUNCTION, else NULL; USER is borrowed.  */
bt_status bt_dive_new (bt_model *model, bt_current_function function, void *user, bt_dive **dive,
                       bt_error *error);
/* The same, asking POLL, with POLL_USER, while tethers are laid and from then on.  */
bt_status bt_dive_new_polled (bt_model *model, bt_current_function function, void *user,
                              bt_poll poll, void *poll_user, bt_dive **dive, bt_error *error);
void bt_dive_free (bt_dive *dive);

/* Let every call on DIVE ask POLL, in the caller's thread, whether to go on; NULL: no asking.  A
   fork begins without a poll.  */
void bt_dive_set_poll (bt_dive *dive, bt_poll poll, void *user);

/* Make *COPY a second dive on the same model in the same state; the two then know nothing of each
   other.  */
bt_status bt_dive_fork (const bt_dive *dive, bt_dive **copy, bt_error *error);
/* Make FORK, a dive no longer needed, a fork of DIVE as bt_dive_fork does, in the memory of FORK.
   BT_ERR_STALE if FORK has another model than DIVE.  */
bt_status bt_dive_fork_again (bt_dive *fork, const bt_dive *dive, bt_error *error);

enum
{
  BT_THREADS_MAX = 64
};

/* Let up to N threads, 1 to BT_THREADS_MAX, step the tethers of DIVE; the caller of bt_dive_step
   counts as one.  A new dive and a fork have N = 1.  N is no part of the state: no result depends
   on N, and bt_dive_restore leaves N alone.  The threads start in the first step with work for
   several, unless the current is a function, and end with bt_dive_free or a change of N.
   BT_ERR_DOMAIN and BT_ERR_LIMIT leave N unchanged.  */
bt_status bt_dive_set_threads (bt_dive *dive, int n, bt_error *error);
int bt_dive_threads (const bt_dive *dive);

/* Let FUNCTION serve currents of kind BT_CURRENT_FUNCTION from now on.  */
void bt_dive_set_current_function (bt_dive *dive, bt_current_function function, void *user);

/* ---- Time ---- */

/* Advance by one step of bt_dive_time_step seconds.  On failure (BT_ERR_DIVERGED) the dive stays at
   its last good step.  */
bt_status bt_dive_step (bt_dive *dive, bt_error *error);

/* Step each of the N DIVES, none of them twice in the list, until STEP steps are taken, on up to
   THREADS threads, the caller's included: each dive ends as bt_dive_step would leave it, whatever
   THREADS is.  EACH receives a status for each dive: a dive whose step failed stays at its last
   good step.  POLL, or NULL, is asked in the caller's thread meanwhile; told to leave, the function
   returns BT_ERR_INTERRUPTED, and a second call with the same STEP goes on from there.
   BT_ERR_DOMAIN for THREADS below 1 or above BT_THREADS_MAX; BT_ERR_UNSUPPORTED if the current of a
   dive is a function.  */
bt_status bt_dives_step (bt_dive *const *dives, int n, int64_t step, int threads, bt_poll poll,
                         void *user, bt_status *each, bt_error *error);
int64_t bt_dive_steps (const bt_dive *dive);
double bt_dive_time (const bt_dive *dive);      /* s: steps times the time step */
double bt_dive_time_step (const bt_dive *dive); /* s */

/* Add SECONDS of wished time to the dive's account and return the number of whole steps in the
   account, to be taken by the caller; the remainder is carried. 0 <= SECONDS <= 1e9, else
   BT_ERR_DOMAIN.  */
bt_status bt_dive_whole_steps (bt_dive *dive, double seconds, int64_t *steps, bt_error *error);
/* Return the remainder, s; set the remainder.  The remainder is no part of the state: a time asked
   for in pieces makes the same dive as the sum.  */
double bt_dive_carried (const bt_dive *dive);
void bt_dive_carry (bt_dive *dive, double seconds);

/* ---- Checkpoints ---- */

/* Return true while the current of DIVE is a function (BT_CURRENT_FUNCTION); state and operations
   alone then do not determine the dive.  */
int bt_dive_asks (const bt_dive *dive);

/* Keep the N numbers ROWS, t x y z of each, as a track of DIVE, and return its number in *INDEX;
   the same rows are kept once.  A state on a track can be restored only in a dive with the same
   track under the same number.  BT_ERR_FORMAT, BT_ERR_LIMIT.  */
bt_status bt_dive_add_track (bt_dive *dive, const double *rows, int n, int *index, bt_error *error);
/* Return how many numbers the I-th track of DIVE has, and where in *ROWS; 0 when there is none.  */
int bt_dive_track (const bt_dive *dive, int i, const double **rows);

/* Return the bytes of a state of DIVE.  */
size_t bt_dive_state_size (const bt_dive *dive);
/* Copy the whole state to STATE, bt_dive_state_size bytes.  */
void bt_dive_save (const bt_dive *dive, void *state);
/* Write the same to PACKED as bt_state_pack packs it (below), in words of eight bytes, and return
   the number of bytes written, at most bt_dive_keep_size: unused room is not gone through.  */
size_t bt_dive_keep_size (const bt_dive *dive);
size_t bt_dive_keep (const bt_dive *dive, void *packed);
/* Return to STATE of SIZE bytes, packed or not, of this dive or a fork, or read from a file by any
   author: every member is judged before use.  BT_ERR_STALE if STATE belongs to another model, or
   follows a track or a function unknown to this dive; BT_ERR_FORMAT if the bytes are not as saved,
   or if a member has an impossible value, named in the text of the error.  */
bt_status bt_dive_restore (bt_dive *dive, const void *state, size_t size, bt_error *error);
/* Return a 64-bit hash of the whole state: equal states, equal hashes.  */
uint64_t bt_dive_hash (const bt_dive *dive);

/* bt_state_pack writes STATE, the SIZE bytes of bt_dive_save, to PACKED without unused room and
   returns the number of bytes written; with PACKED NULL, the number alone.  STATE and PACKED are
   whole words of eight bytes, and aligned.  bt_state_is_packed returns true if BYTES were written
   by bt_state_pack.  bt_state_unpack writes N packed bytes to STATE; BT_ERR_STALE if the packed
   state has another size.  */
size_t bt_state_pack (const void *state, size_t size, void *packed);
int bt_state_is_packed (const void *bytes, size_t size);
bt_status bt_state_unpack (const void *packed, size_t n, void *state, size_t size, bt_error *error);

/* ---- Parts ---- */

typedef enum bt_part
{
  BT_PART_SEA = 0,
  BT_PART_VEHICLE,
  BT_PART_TETHER,
  BT_PART_OBSTACLE
} bt_part;

/* Return how many of PART there are.  */
int bt_dive_count (const bt_dive *dive, bt_part part);
/* Return the name of the I-th PART, or NULL.  What is touched may be a tether or the hull of a
   vehicle: after the last obstacle, tethers are counted on, and then vehicles.  */
const char *bt_dive_name (const bt_dive *dive, bt_part part, int i);

/* ---- Operations: all that changes a dive besides time ---- */

typedef enum bt_op
{
  BT_OP_DRIVE = 0,
  BT_OP_RELEASE,
  BT_OP_PLACE,
  BT_OP_LAY,
  BT_OP_MOVE,
  BT_OP_FLY_TO,
  BT_OP_HOLD_HEADING,
  BT_OP_HOLD_DEPTH,
  BT_OP_HOLD_ALTITUDE,
  BT_OP_HOLD_POSITION,
  BT_OP_FOLLOW,
  BT_OP_PAY_OUT,
  BT_OP_HAUL_IN,
  BT_OP_CUT,
  BT_OP_CURRENT,
  BT_OP_ALTER,
  BT_OP_COLLIDE,
  BT_OP_STABILISE,
  BT_OP_WAVES,
  BT_OP_FAULT,
  BT_OP_DRIFT,
  BT_OP_COUNT
} bt_op;

typedef struct bt_op_info
{
  const char *name;
  bt_part subject; /* BT_PART_SEA: none needed (but ALTER: see its text) */
  int min_args, max_args;
  const char *args; /* their names */
  const char *text;
} bt_op_info;

/* Return the description of OP, or NULL.  */
const bt_op_info *bt_op_describe (bt_op op);

enum
{
  BT_CURRENT_ARGS = 4 + 4 * BT_PROFILE_MAX /* most numbers a packed current takes */
};

/* Write CURRENT as the numbers of BT_OP_CURRENT to ARGS and return how many.  */
int bt_current_pack (const bt_current *current, double *args);

/* Make *CURRENT of N such numbers ARGS.  BT_ERR_FORMAT if they are none, BT_ERR_DOMAIN for a
   current that cannot be.  */
bt_status bt_current_unpack (const double *args, int n, bt_current *current, bt_error *error);

enum
{
  BT_WAVES_ARGS = 9
};

/* The same for BT_OP_WAVES.  Waves that cannot be are refused by bt_waves_make.  */
int bt_waves_pack (const bt_wave_def *waves, double *args);
bt_status bt_waves_unpack (const double *args, int n, bt_wave_def *waves, bt_error *error);

/* Do OP on the SUBJECT-th part of its kind with N numbers ARGS.  BT_ERR_NAME for an unknown
   operation or subject, BT_ERR_DOMAIN for numbers outside their range, and any error of the
   tether's model.  */
bt_status bt_dive_do (bt_dive *dive, bt_op op, int subject, const double *args, int n,
                      bt_error *error);

/* ---- Questions ---- */

typedef struct bt_sea_view
{
  double depth, density, gravity;
  bt_wave_def waves;
  int wake; /* true: the current is less in the lee of obstacles */
} bt_sea_view;

typedef struct bt_vehicle_view
{
  bt_vec3 position, velocity;  /* m, m/s */
  bt_vec3 attachment;          /* m: where its tether is made fast */
  bt_vec3 size;                /* m: of its hull, along its own x, y, z; all 0: a point */
  double heading, pitch, roll; /* radians; heading in [0, 2 pi) */
  double turns;                /* signed, clockwise positive, since the dive began */
  double sticks[4];            /* surge sway heave yaw */
  double speeds[4];            /* at full stick: m/s, and rad/s for yaw */
  int arrived;                 /* true: nowhere left to go */
  int held;                    /* true: a taut tether stops it */
} bt_vehicle_view;

typedef struct bt_tether_view
{
  bt_tether_props props;
  double length, drum;                             /* paid out, and the most that can be, m */
  double target;                                   /* paid out when the winch will stop, m */
  double chord;                                    /* straight distance between the ends, m */
  double tension_anchor, tension_end, tension_max; /* N */
  double accuracy;      /* m: the error in position that is accepted now */
  double tension_error; /* N: estimated error of the tension in the last step if above the tether's
                           tension_accuracy; else 0 */
  double twist;         /* radians by which its far end is turned against its anchor, right-handed
                           about the way from the anchor; 0 of a line that does not twist */
  double torque_anchor, torque_end; /* in the line at its ends, likewise, N m */
  bt_vec3 force;                    /* on what the far end is fastened to, N */
  int vehicle;                      /* index of the vehicle at the far end, -1: a fixed point */
  int taut;
  int parted; /* true: the line is in two; what is asked is the part at the anchor */
  int spooling;
  int stuck;   /* true: pulled, and held fast for 5 s, whatever holds it; of the
                  thesis' response: by its rules */
  int blocked; /* true: an obstacle keeps a static line off its shape */
  int settled; /* zero: the shape still moves */
  int asleep;  /* true: the moving line rests and is not stepped */
  int nodes;   /* points of the model's own polyline */
} bt_tether_view;

typedef enum bt_event_kind
{
  BT_EVENT_TAUT = 1,    /* a tether lost its slack */
  BT_EVENT_SLACK,       /* it has some again */
  BT_EVENT_ARRIVED,     /* a vehicle reached where it was sent */
  BT_EVENT_SPOOLED,     /* a winch finished */
  BT_EVENT_STALLED,     /* a winch stopped before, on a taut tether */
  BT_EVENT_PARTED,      /* a tether broke, or was cut */
  BT_EVENT_SNAPPED,     /* a slack tether came taut with a jerk */
  BT_EVENT_HOCKLED,     /* its twist threw a loop into a tether */
  BT_EVENT_KINKED,      /* it was bent more tightly than it may be */
  BT_EVENT_TOUCHED,     /* a tether or a vehicle met an obstacle */
  BT_EVENT_LEFT,        /* it has been away from it for half a second */
  BT_EVENT_STUCK,       /* a tether has held fast for 5 s against a pull */
  BT_EVENT_PINCHED,     /* a moving obstacle was held back by what it would run into */
  BT_EVENT_PROP_DANGER, /* a tether has come near to a thruster of a vehicle that turns */
  BT_EVENT_WORN,        /* an obstacle has worn a tether's jacket to its limit */
  BT_EVENT_WRAPPED,     /* a tether is wound about an obstacle once more */
  BT_EVENT_FREED        /* it is not wound about it any more */
} bt_event_kind;

typedef struct bt_event
{
  double time;     /* s */
  int64_t kind;    /* bt_event_kind */
  int64_t part;    /* bt_part: what its subject is */
  int64_t subject; /* index among its kind */
  int64_t object;  /* index of the obstacle it met, or -1 */
} bt_event;

/* Work done since the dive began: what ran, and what was skipped because nothing asked for it.  */
typedef struct bt_profile
{
  uint64_t steps;
  uint64_t shape_solves, shape_skips; /* tethers solved anew, and found unchanged */
  uint64_t search_iterations;         /* of the thesis' simplex */
  uint64_t shots, marches;            /* of the steady model's shooting */
  uint64_t relaxations, unsettled;
  uint64_t chain_steps, chain_solves; /* of the moving line */
  uint64_t chain_tries;               /* at those steps, with those that were taken back */
  uint64_t chain_vain;                /* solves besides, of which nothing was taken */
  uint64_t chain_parts;               /* of steps that were not taken whole */
  uint64_t chain_stretched;           /* steps that it was solved for ahead */
  uint64_t chain_sleeps;              /* steps it slept through */
  uint64_t chain_remeshes;            /* by model `auto' */
  uint64_t chain_safeguarded, chain_unconverged;
  uint64_t chain_slips; /* turns of lines whose layers slip, added up over the steps */
  /* Work for obstacles, all zero in a world without: segments asked about, boxes visited, parts
     measured, segments known to be clear, casts; contacts, added up over the steps; steps solved
     again after a hit; steps in which continuous collision detection held nodes back.  */
  uint64_t links_asked, boxes_visited, pairs_measured, links_clear, casts;
  uint64_t touches, contact_rounds, truncated;
  uint64_t line_pairs;   /* links of tethers measured against links of tethers */
  uint64_t beside_hulls; /* moving lines near enough to the hull of a foreign vehicle to meet the
                            hull in the step */
  uint64_t chafes;       /* of the touches: those that wore the jacket */
  uint64_t span_solves, span_skips;   /* of the thesis' response */
  uint64_t current_samples_skipped;   /* shapes solved in still water */
  uint64_t strings, charts, words;    /* for questions about what a tether is doing */
  uint64_t body_steps;                /* of vehicles with mass */
  uint64_t wave_samples, lee_samples; /* places of moving lines and vehicles where the water was
                                         asked for waves, for the lee of obstacles */
  uint64_t operations, refused;
  uint64_t threads;      /* ever started */
  uint64_t shared_steps; /* tries at a step whose tethers several threads could share, ... */
  uint64_t shared_again; /* ... and those that one had to do again, for tethers that met */
} bt_profile;

/* Write the present state of the sea, its current as it was set, of vehicle I, of tether I, or of
   the water at P.  BT_ERR_NAME for a part that does not exist, BT_ERR_DOMAIN for a place that is
   not finite.  */
void bt_dive_sea (const bt_dive *dive, bt_sea_view *view);
void bt_dive_current (const bt_dive *dive, bt_current *current);
bt_status bt_dive_vehicle (const bt_dive *dive, int i, bt_vehicle_view *view, bt_error *error);
bt_status bt_dive_tether (const bt_dive *dive, int i, bt_tether_view *view, bt_error *error);
bt_status bt_dive_current_at (const bt_dive *dive, bt_vec3 p, bt_vec3 *velocity, bt_error *error);

/* Write the estimated error in position of moving line I, m: of its nodes, or what is left of the
   error with fewer nodes before; NAN for static shapes.  */
bt_status bt_tether_error_estimate (const bt_dive *dive, int i, double *estimate, bt_error *error);

/* Point, unit tangent (toward the vehicle) and tension (N) of tether I at arc length S metres from
   its anchor.  BT_ERR_DOMAIN if S lies outside the paid-out length.  */
bt_status bt_tether_point (const bt_dive *dive, int i, double s, bt_vec3 *point, bt_error *error);
bt_status bt_tether_tangent (const bt_dive *dive, int i, double s, bt_vec3 *tangent,
                             bt_error *error);
bt_status bt_tether_tension (const bt_dive *dive, int i, double s, double *tension,
                             bt_error *error);

/* Write N points equally spaced in arc length, both ends included (N >= 2), to POINTS; for N = 0
   the model's own, as many as bt_tether_view.nodes says.  Tensions alike.  */
bt_status bt_tether_points (const bt_dive *dive, int i, int n, bt_vec3 *points, bt_error *error);
bt_status bt_tether_tensions (const bt_dive *dive, int i, int n, double *tensions, bt_error *error);

/* Write up to MAX points of the far part of the parted tether I to POINTS, from the new end to the
   far end, and return the number of points; 0 for a whole tether.  */
int bt_tether_tail (const bt_dive *dive, int i, bt_vec3 *points, int max);

/* Return in *RADIUS the radius of the tightest bend of tether I, m: the smallest circle through
   three neighbours among the model's own points; INFINITY when it is straight.  */
bt_status bt_tether_tightest_bend (const bt_dive *dive, int i, double *radius, bt_error *error);

typedef struct bt_energy
{
  double kinetic, strain, gravity, bending; /* J; gravity from z = 0 */
  double lost; /* J: gone at breaks, from the interval that parted and with the line between two
                  breaks; no break changes the sum of all five */
} bt_energy;

/* Return the energies of tether I, of both parts if it has parted, in *ENERGY.  BT_ERR_UNSUPPORTED
   unless its model is a moving line.  */
bt_status bt_tether_energy (const bt_dive *dive, int i, bt_energy *energy, bt_error *error);

/* Search for distinct equilibria of tether I at its present ends, as bt_steady_equilibria, at most
   MAX, into SHAPES (MAX times nodes points).  BT_ERR_UNSUPPORTED unless its model is `steady'.  */
bt_status bt_tether_equilibria (const bt_dive *dive, int i, int max, bt_vec3 *shapes, int *found,
                                bt_error *error);

enum
{
  BT_EVENTS_KEPT = 128 /* older ones are forgotten */
};

/* Return how many events there ever were.  */
int64_t bt_dive_event_count (const bt_dive *dive);
/* Copy the kept events from number FIRST on (0: the first ever), oldest first, to EVENTS, with room
   for BT_EVENTS_KEPT, and return the number copied.  */
int bt_dive_events (const bt_dive *dive, int64_t first, bt_event *events);
/* Return the word for KIND, or NULL when there is no such kind; they count from BT_EVENT_TAUT on.
 */
const char *bt_event_name (bt_event_kind kind);

/* Write the work done since DIVE began.  */
void bt_dive_profile (const bt_dive *dive, bt_profile *profile);

BT_END_DECLS

#endif
