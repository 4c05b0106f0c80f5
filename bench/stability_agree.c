/* Do builds agree?  A fixed set of seeded cases of every family, and of whole dives by every model,
   each told in one line: counts, a hash of the states they end in, and the sum of all places.
   Builds of one compiler are to give the same hash, whatever it optimises; the sum is for those
   that do not.

   With traps a floating-point operation that is invalid, divides by zero or overflows ends the run
   with the case it happened in.  Those who mean harm are left out then: what is no number is
   theirs.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <fenv.h>
#include <signal.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include <bight/statics.h>

#include "base/hash.h"
#include "testbed/campaign.h"
#include "testbed/scene.h"
#include "stability_flight.h"

enum
{
  STATICS = 20000,
  LINES = 44,
  LINE_NODES = 300, /* longer ones are left out */
  FLIGHTS = 16,
  FLIGHT_SHORT = 300, /* steps of a flight, ... */
  DIVE_STEPS = 600    /* ... and of a dive */
};

/* What a family came to.  */
typedef struct tally
{
  long cases, steps, faults, unsolved;
  uint64_t hash;
  double sum;
} tally;

/* What runs, for whoever is trapped.  */
static char here[64];

static void
begin_case (tally *t, const char *family, long number)
{
  snprintf (here, sizeof here, "%s case %ld", family, number);
  t->cases++;
}

static void
trapped (int signal)
{
  static const char what[] = ": an invalid operation, a division by zero or an overflow\n";
  (void)signal;
  if (write (STDERR_FILENO, here, strlen (here)) < 0
      || write (STDERR_FILENO, what, sizeof what - 1) < 0)
    _exit (4);
  _exit (3);
}

/* Nonzero if this system can.  */
static int
set_traps (void)
{
#ifdef __GLIBC__
  signal (SIGFPE, trapped);
  return feenableexcept (FE_INVALID | FE_DIVBYZERO | FE_OVERFLOW) >= 0;
#else
  (void)trapped;
  return 0;
#endif
}

static void
take (tally *t, const void *data, size_t bytes)
{
  t->hash = bt__hash (data, bytes, t->hash);
}

static void
take_points (tally *t, const bt_vec3 *x, int n)
{
  take (t, x, (size_t)n * sizeof *x);
  for (int i = 0; i < n; i++)
    t->sum += x[i].x + x[i].y + x[i].z;
}

static void
tell (const char *family, const tally *t)
{
  printf ("%s cases=%ld steps=%ld faults=%ld unsolved=%ld hash=%016llx sum=%.17g\n", family,
          t->cases, t->steps, t->faults, t->unsolved, (unsigned long long)t->hash, t->sum);
  fflush (stdout);
}

/* ---- Families ---- */

static void
statics (void)
{
  tally t = { 0 };
  campaign c = { .seed = 1 };
  for (long k = 0; k < STATICS; k++)
    {
      bt_catenary curve;
      begin_case (&t, "statics", k);
      campaign_seed (&c, 1, k);
      double s = campaign_decades (&c, 1e-2, 1e4),
             chord = s / (1 + campaign_decades (&c, 1e-12, 1e3));
      double slope = campaign_uniform (&c, -BT__PI / 2, BT__PI / 2);
      double h = chord * cos (slope), v = chord * sin (slope);
      if (bt_catenary_solve (h, v, s, &curve, NULL))
        {
          t.faults++;
          continue;
        }
      bt_point2 p = bt_catenary_point (&curve, s / 3);
      take (&t, &p, sizeof p);
      t.sum += (p.x + p.y) / s;
    }
  tell ("statics", &t);
}

static void
dynamics (void)
{
  tally t = { 0 };
  campaign c;
  if (!campaign_open (&c, 1))
    return;
  c.quick = 1;
  for (long k = 0; t.cases < LINES; k++)
    {
      campaign_tally one;
      campaign_seed (&c, 1, k);
      campaign_draw (&c, (campaign_kind)(k % CAMPAIGN_KINDS));
      if (c.flight.nodes > LINE_NODES)
        continue;
      begin_case (&t, "dynamics", k);
      t.faults += campaign_play (&c, &one) != CAMPAIGN_SOUND;
      t.steps += one.steps;
      t.unsolved += one.unsolved;
      take_points (&t, bt__dynamic_x (c.d), (int)c.d->n + 1);
      take (&t, bt__dynamic_v (c.d), (size_t)(c.d->n + 1) * sizeof (bt_vec3));
      take (&t, bt__dynamic_tension (c.d), (size_t)c.d->n * sizeof (double));
    }
  campaign_close (&c);
  tell ("dynamics", &t);
}

static void
contact (int harm)
{
  static flight f;
  tally t = { 0 };
  const flight_rules rules = { INFINITY, 0 };
  for (long k = 0; k < FLIGHTS; k++)
    {
      flight_tally one;
      flight_draw (&f, 1, k);
      if (f.kind == FLIGHT_HARM && !harm)
        continue;
      f.steps = FLIGHT_SHORT;
      begin_case (&t, "contact", k);
      t.faults += flight_play (&f, &rules, &one) != FLIGHT_SOUND;
      t.steps += one.steps;
      t.unsolved += one.unsolved;
      t.sum += one.sum;
      take (&t, &one.hash, sizeof one.hash);
    }
  tell (harm ? "contact" : "contact-pilots", &t);
}

/* Bars in a current with a lee and in waves, a vehicle with a mass of its own or without.  */
static void
lay_scene (scene *s, bt_model_kind model)
{
  scene_clear (s);
  scene_current (s, bt__vec (0.2, 0.3, 0));
  bt_vehicle_def *v = scene_vehicle (s, bt__vec (8, 6, -12));
  bt_tether_def *line = scene_line (s, bt__vec (-10, 0, -2), 36, 40);
  line->props.model = model;
  line->props.wet_weight = 0.1;
  if (model != BT_MODEL_DYNAMIC)
    return;
  scene_waves (s);
  s->world.sea.wake = 1;
  v->mass = 12;
  v->size = bt__vec (0.4, 0.5, 0.3);
  for (int i = 0; i < 6; i++)
    scene_bar (s, bt__vec (4 * i - 10, 9, -30), bt__vec (4 * i - 10, 9, 1), 0.3);
}

static void
dives (void)
{
  static scene s;
  tally t = { 0 };
  for (int model = 0; model <= BT_MODEL_AUTO; model++)
    {
      begin_case (&t, "dive", model);
      lay_scene (&s, (bt_model_kind)model);
      bt_dive *dive = scene_begin (&s.world);
      bt_error error;
      bt_profile work;
      bt_vec3 x[200];
      bt_tether_view view;
      const double sticks[4] = { 0.5, 0.2, -0.1, 0.3 };
      t.faults += bt_dive_do (dive, BT_OP_DRIVE, 0, sticks, 4, &error) != BT_OK;
      for (int i = 0; i < DIVE_STEPS; i++)
        t.faults += bt_dive_step (dive, &error) != BT_OK;
      t.steps += DIVE_STEPS;
      bt_dive_profile (dive, &work);
      t.unsolved += (long)work.chain_unconverged;
      if (bt_dive_tether (dive, 0, &view, &error) == BT_OK && view.nodes <= 200
          && bt_tether_points (dive, 0, 0, x, &error) == BT_OK)
        take_points (&t, x, view.nodes);
      uint64_t hash = bt_dive_hash (dive);
      take (&t, &hash, sizeof hash);
      bt_dive_free (dive);
    }
  tell ("dives", &t);
}

int
stability_agree (int traps)
{
  if (traps && !set_traps ())
    {
      fputs ("bight-bench-stability: this system cannot trap\n", stderr);
      return EXIT_FAILURE;
    }
  statics ();
  dynamics ();
  contact (!traps);
  dives ();
  return EXIT_SUCCESS;
}
