/* Lines under abuse: lines of any kind, flown in random steps.  The tests and the stability bench
   fly the same ones.

   A flight is drawn whole, from its seed, before it is flown: so it can be flown again, and written
   to a file.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#ifndef BT_TESTBED_CAMPAIGN_H
#define BT_TESTBED_CAMPAIGN_H

#include <stdint.h>
#include <stdio.h>

#include "tether/dynamic.h"

enum
{
  CAMPAIGN_NODES = 2000,
  CAMPAIGN_MOVES = 200,
  CAMPAIGN_CORNERS = 129
};

typedef enum campaign_kind
{
  CAMPAIGN_PLAIN,     /* jerks, stops, slack and taut, sudden currents; never overstretched */
  CAMPAIGN_TELEPORTS, /* the same, with jumps of 5 m and 5 % too far */
  CAMPAIGN_VACUO,     /* let go without water, the ends held or free: energy may only be lost */
  CAMPAIGN_KINDS
} campaign_kind;

extern const char *const campaign_kind_names[CAMPAIGN_KINDS];

/* A step: how long, where the far end is after it, what pushes it if it is free, how the water
   flows.  */
typedef struct campaign_move
{
  double h;
  bt_vec3 at, force, flow;
} campaign_move;

/* A line, how it lies at first, and its steps.  */
typedef struct campaign_flight
{
  campaign_kind kind;
  bt_tether_props line;
  double length, step; /* m, the longest step in s */
  int jittered;        /* steps of any length up to that */
  int nodes, corners, moves;
  int free; /* the far end, with BODY */
  bt__dynamic_lump body;
  bt_vec3 shape[CAMPAIGN_CORNERS];
  campaign_move move[CAMPAIGN_MOVES];
} campaign_flight;

/* What can be wrong with one.  */
typedef enum campaign_fault
{
  CAMPAIGN_SOUND,
  CAMPAIGN_BROKEN,      /* a step was refused, or the line came to hold what is not finite */
  CAMPAIGN_BLOWN,       /* faster than 20 times what drove it */
  CAMPAIGN_UNRECOVERED, /* not solved for more than 3 s */
  CAMPAIGN_GAINED,      /* energy, without water */
  CAMPAIGN_UNLAID,      /* there is no such line */
  CAMPAIGN_TIGHT,       /* tighter than it may be: see campaign.tension */
  CAMPAIGN_FAULTS
} campaign_fault;

extern const char *const campaign_fault_names[CAMPAIGN_FAULTS];

/* The line that is flown now, and the random numbers of the next.  */
typedef struct campaign
{
  uint64_t seed;
  double (*clock) (void); /* s, or NULL: times are then 0 */
  int quick;              /* nonzero: more short lines than long ones, these not flown as far;
                             else as many in every octave of nodes, 200 steps each */
  campaign_flight flight;
  bt_water water;
  bt_current current;
  bt__dynamic_input in;
  bt__dynamic_report report;
  bt__dynamic *d;
  bt__dynamic_work *work;
  double tension; /* N: the most it may have; 0: any */
  double driven;  /* m/s: the most that ends, water or overstretch can move the line with */
} campaign;

/* What came of one line or of many.  */
typedef struct campaign_tally
{
  long lines, steps, solves, unsolved;
  long broken, blown, unrecovered, gained, tight; /* lines, see campaign_fault */
  double unsolved_for;                            /* s: the longest */
  double tension;                                 /* N */
  double fastest, ratio;                          /* m/s, and as a multiple of what drove it */
  double settled; /* m/s: the fastest after 3 s with the ends held */
  double gain; /* the most energy above that at the start, of m g L^2 and that of bending; below 0:
                  none */
  double seconds, slowest; /* CPU s: of all steps, of a step */
} campaign_tally;

/* More energy than at the start, of that measure, is a fault.  */
#define CAMPAIGN_GAIN 1e-9

/* Return a random number of C between A and B, evenly, or evenly in its logarithm.  */
double campaign_uniform (campaign *c, double a, double b);
double campaign_decades (campaign *c, double a, double b);

/* Make C ready, with SEED.  Return zero when memory is out.  */
int campaign_open (campaign *c, uint64_t seed);
void campaign_close (campaign *c);

/* Begin the random numbers of C anew: those of case NUMBER with SEED.  */
void campaign_seed (campaign *c, uint64_t seed, long number);

/* Draw the next flight of C, of KIND.  */
void campaign_draw (campaign *c, campaign_kind kind);

/* Fly the flight of C and write what came of it to *T.  Return what is wrong with it.  */
campaign_fault campaign_play (campaign *c, campaign_tally *t);

/* Draw and fly, and add what came of it to *T, which began as campaign_nothing.  */
campaign_fault campaign_fly (campaign *c, campaign_kind kind, campaign_tally *t);
extern const campaign_tally campaign_nothing;

/* Add FROM to *T.  */
void campaign_add (campaign_tally *t, const campaign_tally *from);

/* ---- Flights as text: campaign_file.c ---- */

/* Write F to PORT as text that comes back bit by bit; read it.  Zero if it cannot be.  */
int campaign_write (FILE *port, const campaign_flight *f);
int campaign_read (FILE *port, campaign_flight *f);

#endif
