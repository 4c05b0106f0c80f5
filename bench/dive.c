/* bight-bench-dive: what a whole dive costs, as CSV rows on standard output.

   The scene has everything: a BlueROV2 Heavy holding its place in a jacket, on 100 nodes of a
   moving line whose anchor rides a wind sea, in a current with the jacket's lee.  Row `all' is CPU
   time of a step, its column `error' how many times faster than real time that is.  Each row
   `without ...' is the same dive with one part left out: its column `error' is that part's share of
   the step, in per cent; its counters are those of the part, which are zero when the scene lacks
   it.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <getopt.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <bight/bight.h>

#include "calibration.h"
#include "math/vec.h"

enum
{
  BARS_MAX = 64,
  ROUNDS = 5
};

/* What the scene has.  */
enum
{
  VEHICLE = 1,
  JACKET = 2,
  WAKE = 4,
  WAVES = 8,
  CURRENT = 16,
  LINE = 32,
  ALL = 63
};

typedef struct scene
{
  bt_world world;
  bt_vehicle_def vehicle;
  bt_tether_def tether;
  bt_obstacle_def bar[BARS_MAX];
} scene;

typedef struct cost
{
  double step; /* s of CPU */
  bt_profile profile;
} cost;

static void
check (bt_status status, const bt_error *error)
{
  if (status == BT_OK)
    return;
  fprintf (stderr, "bight-bench-dive: %s\n", error->text);
  exit (1);
}

/* ---- The scene ---- */

static void
add_bar (scene *s, bt_vec3 from, bt_vec3 to, double radius)
{
  bt_obstacle_def *def = &s->bar[s->world.n_obstacles];
  char name[16];
  snprintf (name, sizeof name, "bar-%d", s->world.n_obstacles++);
  bt_def_init (bt_head_find ("capsule"), def);
  bt_def_set_name (def->name, name, NULL);
  def->from = from;
  def->to = to;
  def->radius = radius;
}

static bt_vec3
corner (int k, double z)
{
  return bt__vec (k == 0 || k == 3 ? -6 : 6, k < 2 ? 6 : -6, z);
}

/* Four legs, three bays: levels and X braces on four sides.  */
static void
add_jacket (scene *s)
{
  for (int k = 0; k < 4; k++)
    add_bar (s, corner (k, 0), corner (k, -60), 0.6);
  for (int bay = 0; bay < 3; bay++)
    for (int k = 0; k < 4; k++)
      {
        double high = -20 * bay, low = high - 20;
        int next = (k + 1) % 4;
        add_bar (s, corner (k, low), corner (next, low), 0.25);
        add_bar (s, corner (k, high), corner (next, low), 0.2);
        add_bar (s, corner (next, high), corner (k, low), 0.2);
      }
}

static void
draw (scene *s, int has)
{
  bt_error error;
  memset (s, 0, sizeof *s);
  bt_def_init (bt_head_find ("sea"), &s->world.sea);
  bt_def_init (bt_head_find ("rov"), &s->vehicle);
  bt_def_init (bt_head_find ("tether"), &s->tether);
  s->world.sea.depth = 60;
  if (has & CURRENT)
    {
      s->world.sea.current.kind = BT_CURRENT_UNIFORM;
      s->world.sea.current.velocity[0] = bt__vec (0.3, 0, 0);
    }
  s->world.sea.wake = (has & WAKE) != 0;
  if (has & WAVES)
    s->world.sea.waves = (bt_wave_def){
      .kind = BT_WAVE_JONSWAP, .height = 1.5, .period = 7, .gamma = 3.3, .components = 32, .seed = 3
    };
  bt_def_set_name (s->vehicle.name, "rov", NULL);
  s->vehicle.at = bt__vec (0, 0, -30);
  if (has & VEHICLE)
    check (bt_def_set_vehicle_type (&s->vehicle, "bluerov2-heavy", &error), &error);
  bt_def_set_name (s->tether.name, "line", NULL);
  bt_def_set_name (s->tether.to.part, "rov", NULL);
  s->tether.from.at = bt__vec (-1, -12, 0);
  s->tether.ride = bt__vec (1, 1, 1);
  s->tether.length = 40;
  s->tether.props.mass = 0.043;
  s->tether.props.ea = 1e5;
  s->tether.props.nodes = 100;
  s->tether.props.model = BT_MODEL_DYNAMIC;
  if (has & JACKET)
    add_jacket (s);
  s->world.vehicles = &s->vehicle;
  s->world.n_vehicles = 1;
  s->world.tethers = &s->tether;
  s->world.n_tethers = (has & LINE) != 0;
  s->world.obstacles = s->bar;
}

/* ---- Measuring ---- */

static bt_dive *
begin (int has)
{
  scene s;
  bt_model *model;
  bt_dive *dive;
  bt_error error;
  draw (&s, has);
  check (bt_model_new (&s.world, &model, &error), &error);
  check (bt_dive_new (model, NULL, NULL, &dive, &error), &error);
  bt_model_release (model);
  check (bt_dive_do (dive, BT_OP_HOLD_POSITION, 0, NULL, 0, &error), &error);
  return dive;
}

/* A pilot that goes to and fro.  */
static void
fly (bt_dive *dive, int steps)
{
  bt_error error;
  for (int k = 0; k < steps; k++)
    {
      if (k % 600 == 0)
        {
          double sticks[4] = { k % 1200 ? -0.3 : 0.3, k % 1800 ? 0.2 : -0.2, 0, 0.1 };
          check (bt_dive_do (dive, BT_OP_DRIVE, 0, sticks, 4, &error), &error);
        }
      check (bt_dive_step (dive, &error), &error);
    }
}

static cost
measure (int has, int steps)
{
  double seconds[ROUNDS];
  cost c;
  for (int r = 0; r < ROUNDS; r++)
    {
      bt_dive *dive = begin (has);
      double before;
      fly (dive, 60);
      before = bench_now ();
      fly (dive, steps);
      seconds[r] = (bench_now () - before) / steps;
      bt_dive_profile (dive, &c.profile);
      bt_dive_free (dive);
    }
  c.step = bench_median (seconds, ROUNDS);
  return c;
}

static void
row (const char *setting, const char *metric, double value, const char *asked, const cost *c,
     double calibration)
{
  const bt_profile *p = &c->profile;
  printf ("dive,dynamic,%s,%s,%.4g,%s,,%.1f,%.4g,"
          "chain_steps=%llu;body_steps=%llu;links_asked=%llu;wave_samples=%llu;lee_samples=%llu\n",
          setting, metric, value, asked, 1e9 * c->step, c->step / calibration,
          (unsigned long long)p->chain_steps, (unsigned long long)p->body_steps,
          (unsigned long long)p->links_asked, (unsigned long long)p->wave_samples,
          (unsigned long long)p->lee_samples);
  fflush (stdout);
}

int
main (int argc, char **argv)
{
  static const struct option options[] = { { "steps", required_argument, NULL, 's' }, { 0 } };
  static const struct
  {
    const char *name;
    int has;
  } parts[] = { { "without vehicle's mass", VEHICLE },
                { "without jacket and lee", JACKET | WAKE },
                { "without lee", WAKE },
                { "without waves", WAVES },
                { "without current and lee", CURRENT | WAKE },
                { "without line", LINE } };
  int steps = 3600, option;
  double calibration;
  cost all;
  while ((option = getopt_long (argc, argv, "", options, NULL)) != -1)
    {
      if (option != 's')
        return 1;
      steps = atoi (optarg) > 0 ? atoi (optarg) : steps;
    }
  calibration = bench_calibrate (0.5);
  printf (
      "benchmark,model,setting,metric,error,reference,tolerance,cpu_ns,cpu_calibrated,counters\n");
  all = measure (ALL, steps);
  row ("all", "times-real-time", 1.0 / 60 / all.step, "100", &all, calibration);
  for (size_t k = 0; k < sizeof parts / sizeof *parts; k++)
    {
      cost c = measure (ALL & ~parts[k].has, steps);
      row (parts[k].name, "share-percent", 100 * (1 - c.step / all.step), "", &c, calibration);
    }
  return 0;
}
