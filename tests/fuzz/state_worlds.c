/* See state_worlds.h.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "../oracle/dive_scene.h"
#include "math/vec.h"
#include "state_worlds.h"
#include "world/dive.h"

/* What there is besides a line; flags.  */
enum
{
  WOOD = 1,     /* posts, movers, hulls, a garage on a line of its own */
  WAVES = 2,    /* and a tide */
  MASS = 4,     /* a vehicle that is moved by forces, on autopilots */
  CUT = 8,      /* a line in two */
  TWICE = 16,   /* two lines to one vehicle */
  LUMPS = 32,   /* a clump and a float */
  LOOP = 64,    /* a line laid across itself */
  GROUND = 128, /* a bed of triangles, on which it lies */
  WEAK = 256,   /* a vehicle without mass that the line can hold */
  LAYERS = 512, /* a line clamped at its anchor, with layers that slip */
  SET = 1024    /* a line with natural curvature and a stiffness in torsion */
};

typedef struct recipe
{
  bt_model_kind model;
  int with;
  const char *name;
} recipe;

static const recipe recipes[] = {
  { BT_MODEL_RUBBER_BAND, 0, "rubber-band" },
  { BT_MODEL_V_SHAPE, WAVES, "v-shape in waves" },
  { BT_MODEL_CATENARY, 0, "catenary" },
  { BT_MODEL_CATENARY_SIMPLEX, 0, "catenary-simplex" },
  { BT_MODEL_ELASTIC, 0, "elastic" },
  { BT_MODEL_STEADY, WAVES, "steady in waves" },
  { BT_MODEL_DYNAMIC, WAVES | MASS, "dynamic, mass, waves" },
  { BT_MODEL_AUTO, 0, "auto" },
  { BT_MODEL_RUBBER_BAND, WOOD, "rubber-band among obstacles" },
  { BT_MODEL_V_SHAPE, WOOD, "v-shape among obstacles" },
  { BT_MODEL_CATENARY, WOOD, "catenary among obstacles" },
  { BT_MODEL_CATENARY_SIMPLEX, WOOD, "catenary-simplex among obstacles" },
  { BT_MODEL_ELASTIC, WOOD, "elastic among obstacles" },
  { BT_MODEL_STEADY, WOOD, "steady among obstacles" },
  { BT_MODEL_DYNAMIC, WOOD | WAVES, "dynamic among obstacles" },
  { BT_MODEL_AUTO, WOOD, "auto among obstacles" },
  { BT_MODEL_DYNAMIC, CUT, "dynamic, cut" },
  { BT_MODEL_DYNAMIC, WOOD | CUT, "dynamic among obstacles, cut" },
  { BT_MODEL_DYNAMIC, WOOD | MASS, "dynamic among obstacles, mass" },
  { BT_MODEL_DYNAMIC, TWICE | LUMPS, "two lines, clump and float" },
  { BT_MODEL_DYNAMIC, LOOP, "a line across itself" },
  { BT_MODEL_DYNAMIC, GROUND | WAVES, "dynamic on a mesh" },
  { BT_MODEL_CATENARY, GROUND, "catenary on a mesh" },
  { BT_MODEL_DYNAMIC, GROUND | LOOP | MASS, "a line across itself on a mesh" },
  { BT_MODEL_DYNAMIC, WOOD | WEAK, "dynamic among obstacles, weak vehicles" },
  { BT_MODEL_DYNAMIC, LOOP | WEAK, "a line across itself, weak vehicles" },
  { BT_MODEL_AUTO, GROUND | CUT, "auto on a mesh, cut" },
  { BT_MODEL_AUTO, TWICE | CUT | WAVES, "two lines of auto in waves, one cut" },
  { BT_MODEL_DYNAMIC, LAYERS | GROUND | CUT, "layers that slip, on a mesh, cut" },
  { BT_MODEL_DYNAMIC, LAYERS | WOOD, "layers that slip among obstacles" },
  { BT_MODEL_DYNAMIC, SET | WOOD | CUT, "a set among obstacles, cut" },
  { BT_MODEL_AUTO, SET, "a set, auto" },
};

int
state_worlds (void)
{
  return (int)(sizeof recipes / sizeof *recipes);
}

const char *
state_world_name (int i)
{
  return recipes[i].name;
}

/* ---- Worlds ---- */

static void
make_waves (scene *s)
{
  s->world.sea.waves = (bt_wave_def){
    .kind = BT_WAVE_JONSWAP, .height = 1, .period = 6, .gamma = 3.3, .components = 8, .seed = 3
  };
  s->world.sea.current.kind = BT_CURRENT_TIDE;
  s->world.sea.current.period = 600;
  s->world.sea.wake = 1;
}

static void
fasten_lumps (bt_tether_def *tether)
{
  tether->lumps[0] = (bt_lump){ .at = 10, .mass = 2 };
  tether->lumps[1] = (bt_lump){ .at = 20, .span = 2, .buoyancy = 5 };
  tether->n_lumps = 2;
}

static void
stiffen (bt_tether_def *tether, int with)
{
  tether->props.ei = 0.05;
  tether->along[0] = bt__vec (1, 0, 0);
  if (with & LAYERS)
    {
      tether->props.ei_stuck = 0.2;
      tether->props.slip_curvature = 0.05;
      return;
    }
  tether->props.gj = 0.05;
  tether->sets[0] = (bt_set){ .span = INFINITY, .curvature = 0.2, .plane = 30 };
  tether->n_sets = 1;
}

/* Round two corners and across what was laid before.  */
static void
lay_loop (bt_tether_def *tether)
{
  static const bt_vec3 at[]
      = { { -2, -8, -6 }, { 2, -5, -6.2 }, { 2, -10, -6.4 }, { -3, -8.5, -6.1 }, { 0, -7, -6 } };
  memcpy (tether->via.at, at, sizeof at);
  tether->via.n = sizeof at / sizeof *at;
  tether->length = 36;
}

static void
spread_ground (scene *s)
{
  static const bt_vec3 vertex[]
      = { { -30, -30, -7 }, { 30, -30, -8 }, { 30, 30, -7 }, { -30, 30, -6.5 }, { 0, -4, -5 } };
  static const uint32_t corner[][3] = { { 0, 1, 4 }, { 1, 2, 4 }, { 2, 3, 4 }, { 3, 0, 4 } };
  bt_obstacle_def *def = add (s, "mesh", "ground");
  def->mesh = (bt_triangles){ .vertex = vertex, .vertices = 5, .corner = corner, .triangles = 4 };
}

static void
make_scene (scene *s, const recipe *r)
{
  begin_scene (s, r->model);
  for (int i = 0; i < 2; i++)
    {
      s->tether[i].props.nodes = 12;
      s->tether[i].props.wet_weight = 0.3;
    }
  if (r->with & WOOD)
    {
      plant_wood (s);
      add_movers (s);
      hang_garage (s);
      give_hull (s, 0, bt__vec (0.4, 0.5, 0.3));
    }
  if (r->with & WAVES)
    make_waves (s);
  if (r->with & MASS)
    assert_int_equal (bt_def_set_vehicle_type (&s->vehicle[0], "bluerov2-heavy", NULL), BT_OK);
  if (r->with & WEAK)
    s->vehicle[0].pull = s->vehicle[1].pull = 2;
  if (r->with & TWICE)
    tie_twice (s);
  if (r->with & LUMPS)
    fasten_lumps (&s->tether[0]);
  if (r->with & (LAYERS | SET))
    stiffen (&s->tether[0], r->with);
  if (r->with & LOOP)
    lay_loop (&s->tether[0]);
  if (r->with & GROUND)
    spread_ground (s);
}

/* ---- What is done in them ---- */

static void
run (bt_dive *dive, int steps)
{
  bt_error e;
  while (steps-- > 0)
    (void)bt_dive_step (dive, &e); /* the thesis' search may find nothing */
}

/* Round the posts, so that the line touches them.  */
static void
fly_round (bt_dive *dive)
{
  static const double ways[][4] = { { 6, 6, -6, 4 }, { -2, 6, -6, 4 }, { -3, -2, -8, 4 } };
  for (size_t k = 0; k < sizeof ways / sizeof *ways; k++)
    {
      operate (dive, BT_OP_MOVE, 0, 4, ways[k]);
      run (dive, 90);
    }
}

static void
steer_mass (bt_dive *dive)
{
  operate (dive, BT_OP_HOLD_HEADING, 0, 1, (double[]){ 1 });
  operate (dive, BT_OP_HOLD_DEPTH, 0, 1, (double[]){ 5 });
  operate (dive, BT_OP_FAULT, 0, 3, (double[]){ BT_FAULT_COMPASS, 1, 0.01 });
  operate (dive, BT_OP_FAULT, 0, 3, (double[]){ BT_FAULT_THRUSTER, 1, 2 });
  operate (dive, BT_OP_DRIVE, 0, 4, (double[]){ 0.5, 0, 0, 0 });
}

static bt_dive *
fly (int i)
{
  static const double track[]
      = { 0, 8, -8, -6, 2, 6, -6, -6, 9, 4, 2, -5, 60, -2, 3, -6 }; /* t x y z */
  const recipe *r = &recipes[i];
  scene *s = malloc (sizeof *s);
  assert_non_null (s);
  make_scene (s, r);
  bt_dive *dive = enter (s);
  free (s);
  if (r->with & MASS)
    steer_mass (dive);
  operate (dive, BT_OP_PAY_OUT, 0, 2, (double[]){ 3, 0.5 });
  fly_round (dive);
  if (r->with & CUT)
    operate (dive, BT_OP_CUT, 0, 1, (double[]){ 12 });
  operate (dive, BT_OP_FOLLOW, 0, 16, track);
  run (dive, 30);
  return dive;
}

/* A world is flown once in a process, since most of a test's time was to fly them; whoever asks
   gets a fork, with its spare state, as if it were flown anew.  */
bt_dive *
state_world (int i)
{
  static bt_dive *flown[sizeof recipes / sizeof *recipes];
  bt_dive *fork = NULL;
  if (!flown[i])
    flown[i] = fly (i);
  assert_int_equal (bt_dive_fork (flown[i], &fork, NULL), BT_OK);
  assert_int_equal (bt__dive_ready (fork, NULL), BT_OK);
  return fork;
}
