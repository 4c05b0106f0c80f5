/* Flights among obstacles that are to be survived: by pilots in four scenes, and by whoever means
   harm.

   A flight is drawn whole, from its seed, before it is flown: so it can be flown again, and told as
   a scenario.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#ifndef BT_BENCH_STABILITY_FLIGHT_H
#define BT_BENCH_STABILITY_FLIGHT_H

#include "testbed/contact_scene.h"
#include "stability.h"

enum
{
  FLIGHT_STEPS = 4000, /* of a pilot, ... */
  FLIGHT_HARM_STEPS = 1000,
  FLIGHT_QUIET = 120, /* of them before harm is done */
  FLIGHT_AIMS = 64,
  FLIGHT_CORNERS = 5
};

typedef enum flight_kind
{
  FLIGHT_JACKET,  /* tubulars, wires, boxes, a caisson of triangles, a rough bottom */
  FLIGHT_WRECK,   /* worlds/wreck.scm, the ship of triangles */
  FLIGHT_RIGGING, /* worlds/rigging.scm */
  FLIGHT_CANYON,  /* worlds/canyon.scm */
  FLIGHT_HARM,    /* in the jacket: every other case; see flight_harm */
  FLIGHT_KINDS
} flight_kind;

/* What is done in a case of FLIGHT_HARM, after 2 s among the members: places 25 m off and places
   that are no numbers, ...  */
typedef enum flight_harm
{
  HARM_PULL,  /* ... to which a million newtons take the end, ... */
  HARM_FORCE, /* ... or whatever it takes; */
  HARM_SPEED, /* at 20 m/s to places anywhere, with a million newtons; */
  HARM_SPOIL, /* what the solver gives is overwritten, by metres, 1e9 m and what is no number */
  HARMS
} flight_harm;

extern const char *const flight_kind_names[FLIGHT_KINDS];
extern const char *const flight_harm_names[HARMS];

/* What can be wrong with one.  */
typedef enum flight_fault
{
  FLIGHT_REFUSED,
  FLIGHT_NOT_FINITE,
  FLIGHT_CROSSING,
  FLIGHT_TOO_NEAR,    /* nearer than the core */
  FLIGHT_BLOWN,       /* a pilot's, faster than FLIGHT_FASTEST */
  FLIGHT_UNRECOVERED, /* a pilot's, not solved for more than 3 s */
  FLIGHT_TIGHT,       /* tighter than was asked for: `--tension' */
  FLIGHT_FAULTS,
  FLIGHT_SOUND = FLIGHT_FAULTS
} flight_fault;

extern const char *const flight_fault_names[FLIGHT_FAULTS];

/* m/s: 20 times the fastest pilot.  */
#define FLIGHT_FASTEST 100.0

/* From step FROM on the pilot aims at AT.  */
typedef struct flight_aim
{
  int from;
  bt_vec3 at;
} flight_aim;

typedef struct flight
{
  flight_kind kind;
  flight_harm harm;
  uint64_t seed; /* of the scene, and of what is done to the solver */
  int body;      /* the end is a vehicle of 20 kg, and not towed */
  int links, corners, steps, aims;
  double speed, length, friction, weight; /* m/s, m, N/m in water */
  bt_vec3 flow;                           /* m/s, of the water */
  bt_vec3 shape[FLIGHT_CORNERS];          /* how the line lies at first */
  flight_aim aim[FLIGHT_AIMS];
} flight;

/* What came of a flight or of many.  */
typedef struct flight_tally
{
  long flights, steps, solves, unsolved, truncated, touches, faults[FLIGHT_FAULTS];
  long jammed; /* flights of which a hundredth was cut by the guard, or more */
  double unsolved_for, fastest, tension, nearest; /* s, m/s, N; in core radii */
  double seconds;                                 /* CPU, of the steps alone */
  double sum;                                     /* of all places of the line in the end, ... */
  uint64_t hash;                                  /* ... and of its places and velocities */
} flight_tally;

/* Limits, and the guard taken away.  */
typedef struct flight_rules
{
  double tension; /* N; INFINITY: any */
  int mutant;     /* nonzero: without the guard, and HARM_SPOIL flies with contacts alone */
} flight_rules;

/* Draw case NUMBER with SEED into F.  */
void flight_draw (flight *f, uint64_t seed, long number);

/* The line of F.  */
bt_tether_props flight_line (const flight *f);

/* Make R of F's scene; nonzero on success.  reef_close undoes it.  */
int flight_scene (const flight *f, reef *r);

/* Fly F by RULES and write what came of it to T, whose worst of its faults is returned; -1 when
   memory is out.  Never both in two threads.  */
int flight_play (const flight *f, const flight_rules *rules, flight_tally *t);

/* Add FROM to *T.  */
void flight_add (flight_tally *t, const flight_tally *from);

#endif
