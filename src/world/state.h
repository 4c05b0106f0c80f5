/* The flat state of a dive: everything that moves, without pointers and without padding.  A copy of
   the bytes is a checkpoint, and a hash of the bytes tells states apart.

   The state is one block.  First come the head, the vehicles and the tethers; in a world with
   obstacles then the kinematic obstacles, the friction of every obstacle and the contacts by
   object.  Behind them each tether has a store: the node arrays of a static shape, or the chain of
   a moving line, the chain of the other part once the line has parted, the contacts, and in a world
   with obstacles the wear.  Only the live bytes of a store are copied, hashed or read.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#ifndef BT_WORLD_STATE_H
#define BT_WORLD_STATE_H

#include <stdint.h>

#include <bight/dive.h>

#include "collide/pair.h"
#include "tether/shape.h"
#include "vehicle/body.h"
#include "vehicle/instruments.h"
#include "vehicle/pilot.h"

typedef enum bt__goal
{
  BT__GOAL_NONE = 0, /* the sticks, and whatever is held */
  BT__GOAL_POINT,    /* along a line to TARGET */
  BT__GOAL_FLY,      /* the same, turning to face it */
  BT__GOAL_TRACK     /* along a measured track */
} bt__goal;

/* A value an autopilot keeps.  */
typedef struct bt__hold
{
  int64_t on;
  double value;
} bt__hold;

typedef struct bt__vehicle
{
  bt_vec3 position, velocity;
  double heading; /* radians, never wrapped: it counts the turns */
  double heading0;
  double pitch, roll;
  double sticks[4];
  double speeds[4]; /* at full stick: surge sway heave (m/s), yaw (rad/s) */
  double pull;
  int64_t goal; /* bt__goal */
  bt_vec3 target;
  double target_speed;
  int64_t track;      /* index in the dive's tracks */
  double track_start; /* s */
  bt__hold hold_heading, hold_depth;
  int64_t held;
  bt__instruments instruments;
  /* Of one with mass, whose place and motion above are those of BODY.  */
  int64_t rigid; /* true: it has mass */
  int64_t lost;  /* bit K: thruster K is dead */
  int64_t props; /* true: a tether is near to its thrusters */
  double volts;  /* of the battery, V */
  bt__rigid body;
  bt__pilot pilot;
} bt__vehicle;

/* A tether is stuck after BT__STUCK_AFTER steps of pulling while its end moves at less than 2 cm/s.
   The place of the end is kept every BT__STUCK_EVERY steps.  */
enum
{
  BT__STUCK_AFTER = 300,
  BT__STUCK_EVERY = 60,
  BT__STUCK_PLACES = BT__STUCK_AFTER / BT__STUCK_EVERY + 1
};

/* How the shape of a tether is kept: as a static shape alone; as spans, split where the line
   touches; as a polyline, held where the line touches; as the chain of a moving line.  The
   functions of each form stand in world/form.h.  */
typedef enum bt__tether_form
{
  BT__TETHER_SHAPE = 0,
  BT__TETHER_SPANS,
  BT__TETHER_HELD,
  BT__TETHER_CABLE,
  BT__TETHER_FORMS
} bt__tether_form;

/* The step of a moving line is taken in 2^BT__FINEST parts at most.  The line sleeps once it has
   rested for BT__SLEEP_AFTER steps.  */
enum
{
  BT__FINEST = 8,
  BT__SLEEP_AFTER = 60
};

/* A stretch: ticks of the dive for which a moving line was solved in one step, ahead of the present
   (sim/chain_stretch.c).  */
enum
{
  BT__LONGEST_STRETCH = 60,
  BT__SHORTEST_WAIT = 8, /* until one is asked for again, after none was to be had */
  BT__LONGEST_WAIT = 64
};

typedef struct bt__stretch
{
  int64_t span;      /* ticks of it; 0: the line was stepped to the present alone */
  int64_t gone;      /* ticks that have passed, less than all */
  int64_t next;      /* ticks the next may have; 0: none, the last was refused or broken off, ... */
  int64_t wait;      /* ... until a step whose number WAIT divides; 0: the last was not */
  double tension[2]; /* N: the largest, at begin and end */
  bt_vec3 pull[2];   /* N: the force on the ends of the line at the begin */
} bt__stretch;

/* The last look at the nodes of a line of model `auto' (sim/remesh.c).  */
typedef struct bt__look
{
  int64_t step; /* the step of the dive that it followed */
  double error; /* m: estimated error in place, of the nodes then and of fewer nodes before */
  double bend;  /* 1/m: the tightest bend then */
} bt__look;

typedef struct bt__tether
{
  bt_tether_props props;
  double length;       /* paid out, m */
  double winch_rate;   /* m/s, signed; 0: the winch stands */
  double winch_target; /* m */
  int64_t stalling;    /* steps of hauling with full pull and hardly a turn of the drum */
  double tension_max;  /* of a static shape; a moving line is asked */
  double pull;         /* N: of the vehicle that it holds, as last solved */
  int64_t store_at;    /* offset of its store behind the tethers, bytes */
  int64_t stale;       /* must be solved though its ends did not move */
  int64_t settled;
  int64_t taut;
  int64_t parted;   /* the line is in two: a second chain hangs from the far end */
  double lost;      /* m: of the line between the two, gone when either parted again */
  double shed;      /* J: gone when it parted, from the interval and with such a piece */
  int64_t quiet;    /* DYNAMIC: steps it has rested; it sleeps when they are enough */
  int64_t slack_at; /* DYNAMIC: the step at which it was last slack */
  int64_t fine;     /* DYNAMIC: if not 0, its next step is tried in 2^(FINE - 1) parts first; above
                       BT__FINEST by what is more, for the last was not solved in fewer */
  double peak;   /* N: in no part of its last step was its tension larger; 0: a whole step; ... */
  double unsure; /* ... N: how far the tension of half as many was off, if by more than asked; else
                    0 */
  bt__stretch stretch; /* AUTO: of its store the second chain alone is in use */
  bt__look look;       /* AUTO */
  int64_t hockled;
  int64_t kinked;
  int64_t pulled;                /* steps for which it has been pulled without a break */
  int64_t stuck;                 /* its end has hardly moved meanwhile */
  bt_vec3 was[BT__STUCK_PLACES]; /* where its end was in those steps, the oldest overwritten */
  int64_t relaid;                /* it was laid anew, straight */
  int64_t contact_form;          /* bt__tether_form of a static line; SHAPE of a moving one */
  int64_t blocked;               /* an obstacle holds a static line off its shape */
  double wear;                   /* J/m: the most of any spot; 0: its spots are not in use */
  int64_t worn;                  /* that has reached the limit */
  bt__shape shape;
  bt__shape_memory memory;
} bt__tether;

/* True if TETHER has the form of a moving line.  */
static inline int
bt__is_cable (const bt__tether *tether)
{
  return tether->shape.form == BT__FORM_CHAIN;
}

/* The number of chains of TETHER: 0 of a static one, 2 of a moving line that has parted.  */
static inline int
bt__chains (const bt__tether *tether)
{
  return bt__is_cable (tether) ? 1 + (tether->parted != 0) : 0;
}

/* The wait after S was refused or broken off, twice as long as that before.  */
static inline int64_t
bt__next_wait (const bt__stretch *s)
{
  int64_t twice = 2 * s->wait;
  return twice < BT__SHORTEST_WAIT  ? BT__SHORTEST_WAIT
         : twice > BT__LONGEST_WAIT ? BT__LONGEST_WAIT
                                    : twice;
}

/* True if TETHER is a moving line that was solved ahead of the present.  */
static inline int
bt__is_ahead (const bt__tether *tether)
{
  return bt__is_cable (tether) && tether->stretch.span > 0;
}

/* True if TETHER is a moving line, and not asleep.  */
static inline int
bt__is_awake (const bt__tether *tether)
{
  return bt__is_cable (tether) && tether->quiet < BT__SLEEP_AFTER;
}

/* The form of TETHER, a sound one whatever numbers stand in a state from outside.  */
static inline bt__tether_form
bt__tether_form_of (const bt__tether *tether)
{
  if (bt__is_cable (tether))
    return BT__TETHER_CABLE;
  return tether->contact_form > 0 && tether->contact_form < BT__TETHER_CABLE
             ? (bt__tether_form)tether->contact_form
             : BT__TETHER_SHAPE;
}

/* The first bytes of a state: layout version 16.  */
#define BT__STATE_MAGIC 0x3154484749420010ULL

/* The head.  The members with room for more than is in use stand last: rows of a current,
   components of waves, events (head_in_use of layout.c).  */
typedef struct bt__state
{
  uint64_t magic; /* BT__STATE_MAGIC */
  uint64_t model_id;
  uint64_t size;     /* bytes of the whole block */
  uint64_t checksum; /* of the block with this field zero; set in saved copies only */
  int64_t step;
  double depth, density, gravity;
  int64_t wake;     /* true: the current is less in the lee of obstacles */
  bt_wave_def wave; /* as they were asked for */
  int64_t events;   /* ever raised */
  bt_current current;
  bt_waves waves;
  bt_event event[BT_EVENTS_KEPT];
} bt__state;

/* No obstacle drifts faster along any axis, m/s.  */
#define BT__DRIFT_MAX 10.0

/* An obstacle on a track.  Held back by what it would run into, it goes on later: its clock stands
   meanwhile.  */
typedef struct bt__mover_state
{
  bt__frame frame;
  double clock;    /* s along its track */
  int64_t pinched; /* held back in the last step */
  int64_t adrift;  /* off its track for good: it goes on at the velocity `drift' */
  bt_vec3 drift;   /* m/s */
} bt__mover_state;

enum
{
  BT__MEETINGS_MAX = 30
};

/* What a vehicle or a tether touches, or touched not long ago.  */
typedef struct bt__meeting
{
  int64_t object; /* the obstacle's number */
  int64_t last;   /* the step */
} bt__meeting;

/* What a vehicle or a tether may meet and meets.  Behind a subject lies a byte for each obstacle
   and each tether, true: the pair is switched off; then another byte for each, the winding of a
   tether about the object as of the last look.  */
typedef struct bt__subject
{
  uint64_t version; /* a hash of the bytes; 0: none is off */
  int64_t looked;   /* true: its windings were looked at, when its ends were at SEEN ... */
  uint64_t then;    /* ... and VERSION was that */
  bt_vec3 seen[2];
  double string;    /* m: its taut string's, when its windings were last told in full ... */
  bt_vec3 there[2]; /* ... with its ends here */
  int64_t berthed;  /* true: what is made of the world for it, such as ways, ... */
  bt_vec3 berth;    /* ... begins here, near its anchor, m */
  int64_t n;
  bt__meeting meeting[BT__MEETINGS_MAX];
} bt__subject;

#endif
