/* Campaigns of the closed catenary: lengths over 13 decades, slack from 1e-15 to 1e6, slopes from
   1e-16 to 1e16; and, of every eighth, the elastic one, EA from a thousandth of its weight to 1e9
   of them.  A case is a thousand of them.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <math.h>

#include <bight/statics.h>

#include "testbed/calibration.h"
#include "testbed/campaign.h"
#include "stability.h"

enum
{
  STATES = 1000,
  NOT_SOLVED = 0,
  MISSES,
  FAULTS
};

static const char *const fault_names[FAULTS] = { "not solved", "misses its end" };

#define MOST 1e-14 /* of the length */

/* The elastic one is Newton's: what it is asked for.  */
#define MOST_ELASTIC 1e-10

/* Return the miss of the end, of the length S or of what it stretches to; infinity: not solved.  */
static double
miss_of (campaign *c, int elastic)
{
  double s = pow (10, campaign_uniform (c, -6, 7));
  double chord = s / (1 + pow (10, campaign_uniform (c, -15, 6)));
  double slope = pow (10, campaign_uniform (c, -16, 16));
  double side = campaign_uniform (c, -1, 1) < 0 ? -1 : 1;
  double h = chord * (slope / hypot (1, slope)), v = side * chord / hypot (1, slope);
  bt_point2 p;
  if (elastic)
    {
      bt_elastic e;
      double w = pow (10, campaign_uniform (c, -3, 3));
      double ea = w * s * pow (10, campaign_uniform (c, -3, 9));
      if (bt_elastic_solve (h, v, s, w, ea, &e, NULL))
        return INFINITY;
      p = bt_elastic_point (&e, s);
      s *= 1 + w * s / ea; /* what hangs stretches by as much */
    }
  else
    {
      bt_catenary k;
      if (bt_catenary_solve (h, v, s, &k, NULL))
        return INFINITY;
      p = bt_catenary_point (&k, s);
    }
  double miss = hypot (p.x - h, p.y - v) / s;
  return isfinite (miss) ? miss : INFINITY;
}

int
stability_statics (const stability_plan *plan, bench_table *table, stability_log *l)
{
  campaign c = { .seed = 1 };
  double worst_elastic = 0;
  stability_begin (l, plan, "states", fault_names, FAULTS, "worst miss of the closed catenary");
  for (long number; (number = stability_next (l)) >= 0;)
    {
      double start = bench_now ();
      campaign_seed (&c, (uint64_t)plan->seed, number);
      for (int i = 0; i < STATES; i++)
        {
          int elastic = i % 8 == 7;
          double miss = miss_of (&c, elastic), *worst = elastic ? &worst_elastic : &l->worst;
          if (!(miss < (elastic ? MOST_ELASTIC : MOST)))
            stability_fault (l, number, isfinite (miss) ? MISSES : NOT_SOLVED);
          *worst = fmax (*worst, miss);
        }
      l->steps += STATES;
      l->cpu += bench_now () - start;
    }
  bench_put (table, &(bench_row){ "statics", "elastic", "all", "worst miss/length", worst_elastic,
                                  "end", MOST_ELASTIC, 0, NULL });
  return 1;
}
