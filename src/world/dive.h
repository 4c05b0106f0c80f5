/* A dive as the rooms above see it: the model, two buffers of state, the tools of the solvers.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#ifndef BT_WORLD_DIVE_H
#define BT_WORLD_DIVE_H

#include <stdatomic.h>

#include <bight/dive.h>

#include "base/ask.h"
#include "contact/held.h"
#include "contact/line.h"
#include "contact/thesis.h"
#include "contact/wear.h"
#include "model/model.h"
#include "tether/dynamic.h"
#include "world/state.h"

/* A measured track: rows of t x y z.  Immutable once made and shared by forks.  */
typedef struct bt__track
{
  atomic_int references;
  int n;
  double row[][4];
} bt__track;

enum
{
  BT__TRACKS_MAX = 256
};

/* The way of a mover in the present step.  */
typedef struct bt__course
{
  bt__motion whole; /* along its track */
  double seconds;   /* that it takes */
  double share;     /* of it that everybody so far lets it take */
  int gone;         /* somebody has gone by it */
  bt__switches on;
} bt__course;

/* Where a vehicle is taken in the present try at a step, whatever moves it; softly: with no more
   than its pull.  */
typedef enum bt__pin_how
{
  BT__PIN_OFF = 0,
  BT__PIN_HARD,
  BT__PIN_SOFT
} bt__pin_how;

typedef struct bt__pin
{
  int how; /* bt__pin_how */
  bt_vec3 at;
  bt__rigid body; /* of a vehicle with mass: all of it there */
} bt__pin;

/* Inputs of a vehicle with mass in the present step, and the end values of its tether.  */
typedef struct bt__driven
{
  bt__rigid_input in;
  bt__grip grip;
} bt__driven;

/* How many ways there are in a step: those of movers, then those of hulls.  */
static inline int
bt__courses (const bt_model *model)
{
  return model->n_carried + model->n_hulls;
}

/* The workspaces of contact in a step.  NODE, SHARE and POLYLINE are NULL in a world without
   obstacles, SAFE until a step needs it.  */
typedef struct bt__contact_work
{
  bt__mover *mover;
  bt__course *course;
  uint8_t *by_hull; /* of each tether for each of the model's n_hulls: may both meet in the step? */
  int wide;         /* true: every tether may meet every hull, after a try that went too far */
  bt__switches on;
  int disagree;       /* a mover was held back after somebody had gone by its whole way */
  double since, left; /* of the step's time: the shares before and after the part of the step that a
                         line takes */
  int balked;         /* a mover would be held back in a part of a step */
  bt__pin *pin;       /* of each vehicle */
  bt__line_work *line;
  int *order, *place; /* of tethers: which steps when, and when which steps */
  uint8_t *barred;    /* of tethers, true: may not be ahead of the present after the step */
  int alone;          /* true: the line is solved ahead of the present: it sees no other line, and
                         moves no vehicle */
  bt__strand *strand; /* room for both parts of every tether, ... */
  bt__aabb *box;      /* ... and where each is, while tethers are resolved */
  int line_of;        /* the line it knows: twice the tether and the part */
  bt__safe *safe;
  int safe_of;   /* the tether it knows */
  bt_vec3 *node; /* room for a chain, and a share of its length for each interval */
  double *share;
  bt__polyline_work *polyline;
  bt__count count;
  bt__thesis_counts thesis;
} bt__contact_work;

/* One of several dives that share a step out (sim/share.c): its tools, and of a state the head
   alone.  What it borrows it never frees.  */
typedef struct bt__context
{
  bt_dive *dive;
  char *body;         /* of the state that is worked on: each context on tethers of its own */
  const int *group;   /* of each tether: who may meet whom */
  const char *shared; /* of each vehicle, true: several groups hang on it, and none may move it */
  int refused;        /* what it was given cannot be done apart */
} bt__context;

/* Where the parts of a state lie, in bytes after its head: vehicles, then ...  */
typedef struct bt__layout
{
  size_t tethers;
  size_t section, roughness; /* what is known of obstacles: movers, roughness, then ... */
  size_t subjects, subject;  /* ... subjects, each of so many bytes */
  size_t stores;
} bt__layout;

/* What a moving line takes of its store, in bytes.  */
typedef struct bt__line_size
{
  size_t chain; /* of either part, ... */
  size_t part;  /* ... with what that touches */
} bt__line_size;

/* Parts of a state that mostly stand still: friction and switches of obstacles, with the windings
   told of them; then the store of each tether.  */
typedef enum bt__standing_part
{
  BT__PAIRS = 0,
  BT__STORES
} bt__standing_part;

struct bt_dive
{
  bt_model *model;
  size_t size; /* of a state */
  bt__layout layout;
  bt__line_size *line; /* of each tether */
  bt__state *now;      /* what questions read */
  bt__state *next;     /* what an operation or a step works on; NULL: DIVE is not ready */
  uint8_t *alike;      /* of each bt__standing_part, true: both states hold the same there */
  bt__shape_tools tools;
  bt__dynamic_work *work; /* of the moving line */
  bt_vec3 *polyline;      /* room for the points of any tether */
  bt_vec3 *motion;        /* room for a velocity at each */
  bt_vec3 *corner;        /* room for as many points again */
  double *along;          /* room for a number at each, and ... */
  double *over;           /* ... another: how far it is beyond the water or the bed, m */
  bt__fit *fit;           /* room for an interval of another mesh at each */
  bt_sea *sea;            /* beside the current: in the next state, and in the present */
  bt__driven *driven;     /* of each vehicle */
  bt__contact_work contact_work;
  bt__shape_counts counts;
  bt_profile profile;
  bt_current_function function;
  void *user;
  bt__asker asker; /* asked in long calls; of a context: tells what the dive was told */
  double wished;   /* s: time asked for and not yet stepped */
  int n_tracks;
  bt__track *tracks[BT__TRACKS_MAX];
  struct bt__contexts *contexts; /* that share its steps out; NULL: none */
  bt__context *context;          /* it is the dive of; NULL: of none */
  uint64_t changes;              /* of the present state: the watch goes by it */
  struct bt__watch *watch;       /* what was asked of the tethers; NULL: nothing yet */
};

/* Say that either state is about to be written to: in the store of TETHER; in the friction,
   switches or windings of obstacles.  */
static inline void
bt__store_changes (const bt_dive *dive, int tether)
{
  dive->alike[BT__STORES + tether] = 0;
}

static inline void
bt__pairs_change (const bt_dive *dive)
{
  dive->alike[BT__PAIRS] = 0;
}

/* Make dive->next a copy of the present state and return it; DIVE is ready (bt__dive_ready).  */
bt__state *bt__dive_begin (bt_dive *dive);
/* Take dive->next over as the present.  */
void bt__dive_commit (bt_dive *dive);
/* The same with the memory for looks at windings (bt__watch_prepare); on failure the present stays.
   BT_ERR_INTERRUPTED.  */
bt_status bt__dive_become (bt_dive *dive, bt_error *error);

/* What follows the head of STATE, a state of DIVE: of a context it is another's.  */
static inline char *
bt__state_body (const bt_dive *dive, bt__state *state)
{
  return dive->context && state == dive->next ? dive->context->body : (char *)(state + 1);
}

/* Who is asked in long work with DIVE; questions ask too, and change nothing else.  */
static inline bt__asker *
bt__asker_of (const bt_dive *dive)
{
  return &((bt_dive *)dive)->asker;
}

/* Ask whoever called whether to go on, SHARE of the work being done; BT_ERR_INTERRUPTED, also when
   work was left since the last such question.  */
bt_status bt__poll (const bt_dive *dive, double share, bt_error *error);

/* Views into STATE.  */
static inline bt__vehicle *
bt__dive_vehicle (const bt_dive *dive, bt__state *state, int i)
{
  return (bt__vehicle *)(void *)bt__state_body (dive, state) + i;
}

static inline bt__tether *
bt__dive_tether (const bt_dive *dive, bt__state *state, int i)
{
  return (bt__tether *)(void *)(bt__state_body (dive, state) + dive->layout.tethers) + i;
}

/* Where the tethers of VEHICLE are made fast.  */
bt_vec3 bt__attachment (const bt_dive *dive, bt__state *state, int vehicle);
bt_vec3 *bt__dive_nodes (const bt_dive *dive, bt__state *state, int tether);
bt_vec3 *bt__dive_tensions (const bt_dive *dive, bt__state *state, int tether);
/* Zero both arrays of TETHER behind its nodes, when its shape comes to have nodes: the arrays are
   live as a whole, and held other bytes before.  */
void bt__clear_unused_nodes (const bt_dive *dive, bt__state *state, int tether);
/* The chain of a moving tether: PART 0 at the anchor, 1 at the far end once the line has parted. */
bt__dynamic *bt__dive_chain (const bt_dive *dive, bt__state *state, int tether, int part);
/* Metres of rest length of TETHER between its far end and the far end of chain 0: of a parted line
   chain 1 and what was lost, else 0.  */
double bt__beyond_chain (const bt_dive *dive, bt__state *state, int tether);

/* Where tether I is ahead of the present of STATE, chain 1 alone is in use, at the end of the
   stretch.  bt__show_chain lets chain 0 tell the present, as bt__line_of does; bt__leave_stretch
   lets the line be stepped on from there (form_cable.c).  */
void bt__show_chain (const bt_dive *dive, bt__state *state, int i);
void bt__leave_stretch (const bt_dive *dive, bt__state *state, int i);

/* The present force of tether I, a line ahead, on the end K, N.  */
bt_vec3 bt__pull_within (const bt_dive *dive, bt__state *state, int i, int k);

/* The largest tension of the intervals of CHAIN, N.  */
double bt__largest_tension (const bt__dynamic *chain);

/* The chain of tether I that is in use, for the number of its intervals alone.  */
const bt__dynamic *bt__chain_in_use (const bt_dive *dive, bt__state *state, int i);
/* Among obstacles: what that part touches; how its jacket is worn; the static tether as a thesis
   line; as a held one.  */
bt__contacts *bt__dive_anchors (const bt_dive *dive, bt__state *state, int tether, int part);
bt__wear bt__dive_wear (const bt_dive *dive, bt__state *state, int tether);
bt__thesis *bt__dive_thesis (const bt_dive *dive, bt__state *state, int tether);
bt__polyline *bt__dive_held (const bt_dive *dive, bt__state *state, int tether);
/* The most nodes that a polyline of TETHER may have.  */
int bt__polyline_room (const bt_tether_def *tether);
double bt__state_time (const bt__state *state);
/* The most intervals that the chain of TETHER may come to.  */
int bt__chain_room (const bt_tether_def *tether);
bt_water bt__dive_water (const bt_dive *dive, const bt__state *state);

/* Make a dive with an empty state; make the dive of CONTEXT, with workspaces and the head of a
   state alone.  */
bt_status bt__dive_alloc (bt_model *model, bt_dive **dive, bt_error *error);
bt_status bt__dive_alloc_lane (bt_model *model, bt__context *context, bt_error *error);

/* Make the spare state and the workspaces of DIVE, if they are not there (ready.c); free them. Make
   the workspace of safe steps, likewise.  BT_ERR_LIMIT.  */
bt_status bt__dive_ready (bt_dive *dive, bt_error *error);
void bt__dive_clear_up (bt_dive *dive);
bt_status bt__dive_safe (bt_dive *dive, bt_error *error);

/* True if tethers I and J are of groups that step at the same time: each sees the other where it
   was.  */
static inline int
bt__are_apart (const bt_dive *dive, int i, int j)
{
  return dive->context && dive->context->group[i] != dive->context->group[j];
}

/* Add an event to STATE: of the kind of subject that KIND has, or of the PART named, about an
   obstacle.  */
void bt__raise_event (bt__state *state, bt_event_kind kind, int subject);
void bt__raise_event_at (bt__state *state, bt_event_kind kind, bt_part part, int subject,
                         int object);

/* Forget the events of STATE, the next of DIVE, from the number EVENTS on: the step is tried anew.
 */
void bt__forget_events (const bt_dive *dive, bt__state *state, int64_t events);

/* BT_ERR_NAME unless I counts a PART of DIVE.  */
bt_status bt__check_part (const bt_dive *dive, bt_part part, int i, bt_error *error);

/* True if VEHICLE cannot be moved because several groups, stepping at the same time, hang on the
   vehicle; the shared step is then refused.  */
static inline int
bt__is_shared (const bt_dive *dive, int vehicle)
{
  int shared = dive->context && dive->context->shared[vehicle];
  if (shared)
    dive->context->refused = 1;
  return shared;
}

#define BT__TIME_STEP (1.0 / 60)

#endif
