/* Lines under abuse: lines of any kind, flown in random steps.  The tests and the stability bench
   fly the same ones.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#ifndef BT_BENCH_CAMPAIGN_H
#define BT_BENCH_CAMPAIGN_H

#include <stdint.h>

#include "tether/dynamic.h"

enum
{
  CAMPAIGN_NODES = 2000
};

typedef enum campaign_kind
{
  CAMPAIGN_PLAIN,     /* jerks, stops, slack and taut, sudden currents; never overstretched */
  CAMPAIGN_TELEPORTS, /* the same, with jumps of 5 m and 5 % too far */
  CAMPAIGN_VACUO,     /* let go without water, the ends held or free: energy may only be lost */
  CAMPAIGN_KINDS
} campaign_kind;

/* The line that is flown now, and the random numbers of the next.  */
typedef struct campaign
{
  uint64_t seed;
  double (*clock) (void); /* s, or NULL: times are then 0 */
  int quick;              /* nonzero: more short lines than long ones, these not flown as far;
                             else as many in every octave of nodes, 200 steps each */
  campaign_kind kind;
  bt_tether_props line;
  bt_water water;
  bt_current current;
  bt__dynamic_input in;
  bt__dynamic_report report;
  bt__dynamic *d;
  bt__dynamic_work *work;
  double length, step; /* m, the longest step in s */
  int nodes, jittered;
  bt_vec3 v;     /* of the far end */
  double driven; /* m/s: the most that ends, water or overstretch can move the line with */
} campaign;

/* What came of one line or of many.  */
typedef struct campaign_tally
{
  long lines, steps, solves, unsolved;
  long broken;           /* lines that were refused or came to hold what is not finite */
  long blown;            /* lines faster than 20 times what drove them */
  long unrecovered;      /* lines unsolved for more than 3 s */
  double unsolved_for;   /* s: the longest */
  double fastest, ratio; /* m/s, and as a multiple of what drove it */
  double settled;        /* m/s: the fastest after 3 s with the ends held */
  double gain; /* the most energy above that at the start, of m g L^2 and that of bending; below 0:
                  none */
  double seconds, slowest; /* CPU s: of all steps, of a step */
} campaign_tally;

/* Return a random number of C between A and B, evenly, or evenly in its logarithm.  */
double campaign_uniform (campaign *c, double a, double b);
double campaign_decades (campaign *c, double a, double b);

/* Make C ready, with SEED.  Return zero when memory is out.  */
int campaign_open (campaign *c, uint64_t seed);
void campaign_close (campaign *c);

/* Fly the next line of C, of KIND, and add what came of it to *T, which began as campaign_nothing.
   C keeps what the line was.  */
void campaign_fly (campaign *c, campaign_kind kind, campaign_tally *t);
extern const campaign_tally campaign_nothing;

/* Add FROM to *T.  */
void campaign_add (campaign_tally *t, const campaign_tally *from);

#endif
