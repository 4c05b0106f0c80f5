/* Vehicles with mass on their tethers, through whole dives: at every ratio of masses and every
   stiffness the motion stays bounded, makes no energy and ends where thrust says.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include <bight/bight.h>

#include "math/vec.h"
#include "world/line.h"
#include "../oracle/rigid_energy.h"

#define MASSES 7
#define NODES 20
#define LENGTH 30.0

typedef struct scene
{
  bt_world world;
  bt_vehicle_def vehicle;
  bt_tether_def tether;
} scene;

/* A cube of MASS kg that neither floats nor sinks, with a thruster along its own y, on a neutral
   line of LINE_MASS kg from the origin's anchor.  */
static void
draw (scene *s, double mass, double line_mass, double ea, bt_model_kind model)
{
  memset (s, 0, sizeof *s);
  bt_def_init (bt_head_find ("sea"), &s->world.sea);
  bt_def_init (bt_head_find ("rov"), &s->vehicle);
  bt_def_init (bt_head_find ("tether"), &s->tether);
  double side = cbrt (mass / 1025);
  bt_def_set_name (s->vehicle.name, "body", NULL);
  s->vehicle.at = bt__vec (0, LENGTH - 1, -50);
  s->vehicle.mass = mass;
  s->vehicle.size = bt__vec (side, side, side);
  s->vehicle.attached = bt__vec (0, -side / 2, 0);
  s->vehicle.added.along = bt__vec (mass / 2, mass / 2, mass / 2);
  s->vehicle.thrusters[0]
      = (bt_thruster_def){ .along = { 0, 1, 0 }, .map = BT_MAP_SQUARE, .ahead = 5 * mass };
  s->vehicle.n_thrusters = 1;
  bt_def_set_name (s->tether.name, "line", NULL);
  bt_def_set_name (s->tether.to.part, "body", NULL);
  s->tether.from.at = bt__vec (0, 0, -50);
  s->tether.length = LENGTH;
  s->tether.props.mass = line_mass / LENGTH;
  s->tether.props.wet_weight = 0;
  s->tether.props.ea = ea;
  s->tether.props.ba = 0;
  s->tether.props.nodes = NODES;
  s->tether.props.model = model;
  s->world.vehicles = &s->vehicle;
  s->world.n_vehicles = 1;
  s->world.tethers = &s->tether;
  s->world.n_tethers = 1;
}

static bt_dive *
begin (const scene *s)
{
  bt_error error = { 0 };
  bt_model *model;
  bt_dive *dive;
  if (bt_model_new (&s->world, &model, &error) != BT_OK)
    fail_msg ("%s", error.text);
  if (bt_dive_new (model, NULL, NULL, &dive, &error) != BT_OK)
    fail_msg ("%s", error.text);
  bt_model_release (model);
  return dive;
}

static void
step (bt_dive *dive)
{
  bt_error error;
  if (bt_dive_step (dive, &error) != BT_OK)
    fail_msg ("%s", error.text);
}

static void
push (bt_dive *dive, double surge)
{
  double sticks[4] = { surge, 0, 0, 0 };
  assert_int_equal (bt_dive_do (dive, BT_OP_DRIVE, 0, sticks, 4, NULL), BT_OK);
}

static double
energy (const bt_dive *dive)
{
  const bt__vehicle *v = bt__dive_vehicle (dive, dive->now, 0);
  bt_vec3 still = { 0, 0, 0 };
  bt_energy line;
  assert_int_equal (bt_tether_energy (dive, 0, &line, NULL), BT_OK);
  return line.kinetic + line.strain + rigid_energy (&dive->model->types[0], &v->body, still);
}

static double
gap (const bt_dive *dive)
{
  const bt__dynamic *chain = bt__dive_chain (dive, dive->now, 0, 0);
  return bt__distance (bt__dynamic_x (chain)[chain->n], bt__attachment (dive, dive->now, 0));
}

/* Thrown taut, its thrust off: it bounces on the line, at no time with a hundredth more energy than
   there was, in the end with less, and the end of the line keeps to the body.  */
static void
no_energy_is_made (void **unused)
{
  double worst = 0, widest = 0, pull = 0;
  long flights = 0;
  (void)unused;
  for (double ratio = 1e-3; ratio < 2e3; ratio *= 10)
    for (double ea = 1e3; ea < 2e8; ea *= 100)
      {
        scene s;
        draw (&s, 20, 20 / ratio, ea, BT_MODEL_DYNAMIC);
        s.world.sea.density = 1; /* no drag to hide behind */
        s.world.sea.gravity = 0;
        s.vehicle.volume = 0;
        bt_dive *dive = begin (&s);
        bt__vehicle *v = bt__dive_vehicle (dive, dive->now, 0);
        v->body.velocity = bt__vec (0.3, 2, 0.1);
        double start = energy (dive);
        for (int k = 0; k < 900; k++)
          {
            step (dive);
            worst = fmax (worst, energy (dive) / start - 1);
            widest = fmax (widest, gap (dive));
            bt_tether_view view;
            bt_dive_tether (dive, 0, &view, NULL);
            pull = fmax (pull, view.tension_max);
          }
        assert_true (energy (dive) < start);
        flights++;
        bt_dive_free (dive);
      }
  print_message ("# %ld flights: energy at most %.3g above the start, gap %.3g m, tension %.0f N\n",
                 flights, worst, widest, pull);
  assert_true (pull > 2000);
  assert_true (worst < 0.01);
  assert_true (widest < 5e-3);
}

/* Full ahead against the line it comes to rest, the tension its thrust, without jitter.  What is
   lighter than its line swings on, for thrust that turns with a body feeds its swing.  */
static void
thrust_is_tension (void **unused)
{
  static const bt_model_kind models[]
      = { BT_MODEL_DYNAMIC, BT_MODEL_AUTO, BT_MODEL_STEADY, BT_MODEL_CATENARY };
  double off = 0, jitter = 0, swing = 0;
  (void)unused;
  for (int m = 0; m < 4; m++)
    for (double mass = 0.1; mass < 2e3; mass *= 10)
      {
        scene s;
        draw (&s, mass, 1.3, 1e5, models[m]);
        s.vehicle.quadratic.along = bt__vec (8 * mass, 8 * mass, 8 * mass);
        s.vehicle.linear.along = bt__vec (mass, mass, mass);
        s.vehicle.linear.about = s.vehicle.quadratic.about = bt__vec (mass, mass, mass);
        bt_dive *dive = begin (&s);
        bt_tether_view view;
        push (dive, 1);
        for (int k = 0; k < 2400; k++)
          step (dive);
        for (int k = 0; k < 60; k++)
          {
            bt_vehicle_view v;
            step (dive);
            bt_dive_vehicle (dive, 0, &v, NULL);
            double *most = mass < 5 ? &swing : &jitter;
            *most = fmax (*most, bt__norm (v.velocity));
          }
        bt_dive_tether (dive, 0, &view, NULL);
        off = fmax (off, fabs (view.tension_end / (5 * mass) - 1));
        bt_dive_free (dive);
      }
  print_message ("# tension off by %.3g, speed at rest %.3g m/s; of the lightest %.3g\n", off,
                 jitter, swing);
  assert_true (off < 0.02);
  assert_true (jitter < 1e-3);
  assert_true (swing < 0.05);
}

/* The same again, and from a checkpoint, are the same bits.  */
static void
same_again (void **unused)
{
  uint64_t hash[3];
  (void)unused;
  for (int run = 0; run < 2; run++)
    {
      scene s;
      draw (&s, 13, 1.3, 1e5, BT_MODEL_DYNAMIC);
      s.world.sea.waves = (bt_wave_def){
        .kind = BT_WAVE_JONSWAP, .height = 2, .period = 8, .gamma = 3.3, .components = 16, .seed = 5
      };
      bt_dive *dive = begin (&s);
      void *saved = malloc (bt_dive_state_size (dive));
      push (dive, 0.7);
      for (int k = 0; k < 300; k++)
        {
          if (k == 150)
            bt_dive_save (dive, saved);
          step (dive);
        }
      hash[run] = bt_dive_hash (dive);
      assert_int_equal (bt_dive_restore (dive, saved, bt_dive_state_size (dive), NULL), BT_OK);
      for (int k = 150; k < 300; k++)
        step (dive);
      hash[2] = bt_dive_hash (dive);
      free (saved);
      bt_dive_free (dive);
    }
  assert_true (hash[0] == hash[1] && hash[1] == hash[2]);
}

int
main (void)
{
  const struct CMUnitTest tests[]
      = { cmocka_unit_test (no_energy_is_made), cmocka_unit_test (thrust_is_tension),
          cmocka_unit_test (same_again) };
  return cmocka_run_group_tests (tests, NULL, NULL);
}
