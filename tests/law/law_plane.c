/* The shape of a tether in space: the thesis' models, their depth rules, what is remembered.

   The default line `fathom': 7.6 mm, C_n 1.2, neutral, in 1025 kg/m3.  The current flows to +x, the
   chord across it along y, unless said.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

#include "math/vec.h"
#include "tether/shape.h"
#include "near.h"

#define COUNT(table) (sizeof (table) / sizeof *(table))

static void
near_point (const char *what, bt_vec3 is, double x, double y, double z, double tolerance)
{
  if (!(bt__distance (is, bt__vec (x, y, z)) <= tolerance))
    fail_msg ("%s is (%.12g, %.12g, %.12g), not (%.12g, %.12g, %.12g) within %g", what, is.x, is.y,
              is.z, x, y, z, tolerance);
}

/* ---- One tether in one sea ---- */

typedef struct scene
{
  bt_tether_props props;
  bt_current current;
  bt_water water;
  bt__shape_input in;
  bt__shape_tools tools;
  bt__shape_counts counts;
  bt__shape_memory memory;
  bt__shape shape;
  bt_error error;
} scene;

static void
flow (scene *s, double x, double y)
{
  s->current.kind = x != 0 || y != 0 ? BT_CURRENT_UNIFORM : BT_CURRENT_STILL;
  s->current.n = 1;
  s->current.velocity[0] = bt__vec (x, y, 0);
}

static void
begin (scene *s, bt_model_kind model, double length, bt_vec3 b)
{
  memset (s, 0, sizeof *s);
  s->props = (bt_tether_props){ .diameter = 0.0076,
                                .mass = 0.043,
                                .ea = INFINITY,
                                .cdn = 1.2,
                                .cdt = 0.01,
                                .nodes = 100,
                                .model = model,
                                .max_current = 2,
                                .thesis_length_factor = 1 };
  s->water = (bt_water){ .density = 1025, .gravity = 9.81, .depth = 500, .current = &s->current };
  s->in = (bt__shape_input){ .b = b, .length = length, .props = &s->props, .water = &s->water };
  flow (s, 0.5, 0);
}

static bt_status
solve (scene *s)
{
  return bt__shape_solve (&s->in, &s->tools, &s->counts, &s->shape, &s->memory, NULL, NULL,
                          &s->error);
}

static void
solve_well (scene *s)
{
  if (solve (s))
    fail_msg ("%s", s->error.text);
}

static bt_vec3
point (const scene *s, double u)
{
  return bt__shape_point (&s->shape, NULL, NULL, u);
}

static bt_vec3
tangent (const scene *s, double u)
{
  return bt__shape_tangent (&s->shape, NULL, NULL, u);
}

static double
tension (const scene *s, double u)
{
  return bt__shape_tension (&s->shape, NULL, NULL, u);
}

/* What holds of every shape: its ends, its length, finite everywhere, unit tangents along it.  */
static void
is_sound (const scene *s)
{
  double l = s->in.length, sum = 0;
  enum
  {
    N = 4000
  };
  near_point ("start", point (s, 0), s->in.a.x, s->in.a.y, s->in.a.z, 1e-12 * l);
  near_point ("end", point (s, l), s->in.b.x, s->in.b.y, s->in.b.z, 1e-12 * l);
  for (int i = 0; i < N; i++)
    {
      bt_vec3 p = point (s, l * i / N), q = point (s, l * (i + 1) / N),
              t = tangent (s, l * (i + 0.5) / N);
      assert_true (bt__is_finite (p) && bt__is_finite (t) && isfinite (tension (s, l * i / N)));
      near ("unit tangent", bt__norm (t), 1, 1e-14);
      sum += bt__distance (p, q);
    }
  near ("length", sum, fmax (l, bt__distance (s->in.a, s->in.b)), 1e-3 * l);
}

/* ---- The catenary in a current ---- */

/* DOMAIN chapter 6 and test 1: C across, D up-current, L; A, farthest down-current, T at 0.5 m/s.
 */
static void
golden_catenaries (void **state)
{
  static const double golden[][6]
      = { { 3, 0, 5, .815841, 1.81391, .953 },         { 60, 0, 100, 16.316827, 36.27822, 19.066 },
          { 20, 10, 40, 4.717166, 10.86766, 5.512 },   { 20, -10, 40, 4.717166, 20.86766, 5.512 },
          { 30, 0, 30.5, 47.552295, 2.38550, 55.565 }, { 15, 5, 25, 4.171054, 6.53397, 4.874 } };
  (void)state;
  for (size_t i = 0; i < COUNT (golden); i++)
    {
      const double *g = golden[i];
      scene s;
      begin (&s, BT_MODEL_CATENARY, g[2], bt__vec (-g[1], g[0], 0));
      solve_well (&s);
      is_sound (&s);
      near ("A", s.shape.catenary.a, g[3], 6e-7);
      near ("down-current", point (&s, -s.shape.catenary.sigma0).x, g[4], 6e-6);
      for (int k = 0; k <= 20; k++)
        {
          near ("T", tension (&s, g[2] * k / 20), g[5], 6e-4);
          near ("T = q A", tension (&s, g[2] * k / 20), 1.1685 * s.shape.catenary.a, 1e-12);
        }
    }
}

/* current_neutral_catenary.csv: F_n = rho/2 C d U^2, T = F_n a constant; the second end UPSTREAM.
 */
static void
neutral_line_in_a_current (void **state)
{
  /* L, across, upstream, d, Cd, U, rho, D, a, T, y_low, belly, slope at the start */
  static const double table[][13]
      = { { 2.85, 1.9, -0.6, 0.0035, 1.2, 0.3, 1000, 0.189, 0.6040201591304, 0.1141598100757,
            1.079092400928, 1.249165433428, 2.900542993566 },
          { 100, 60, 20, 0.0076, 1.2, 0.5, 1025, 1.1685, 16.68421715562, 19.49550774634,
            26.61756604365, 26.13586959822, 2.363669945158 },
          { 50, 45, 0, 0.0076, 1.5, 0.25, 1025, 0.36515625, 28.00471875263, 10.22609808202, 22.5,
            9.535450032471, 0.8927066977829 },
          { 300, 150, -100, 0.014, 1.2, 1, 1025, 8.61, 36.19997697803, 311.6818017808,
            87.54595598933, 168.6362045974, 5.569397479107 },
          { 20, 5, 1, 0.004, 1.1, 0.8, 1000, 1.408, 0.7664012019056, 1.079092892283, 2.461647958536,
            8.762997728716, 12.39367844133 },
          { 5, 4.2, 0, 0.01, 1.2, 1, 1000, 6, 2.018195294709, 12.10917176826, 2.1, 1.194764749796,
            1.238730467043 } };
  (void)state;
  for (size_t i = 0; i < COUNT (table); i++)
    {
      const double *t = table[i];
      scene s;
      begin (&s, BT_MODEL_CATENARY, t[0], bt__vec (-t[2], t[1], 0));
      s.props.diameter = t[3];
      s.props.cdn = t[4];
      s.water.density = t[6];
      flow (&s, t[5], 0);
      solve_well (&s);
      near ("load", s.shape.load, t[7], 1e-12 * t[7]);
      near ("a", s.shape.catenary.a, t[8], 2e-12 * t[8]);
      near ("T", tension (&s, 0.3 * t[0]), t[9], 2e-12 * t[9]);
      bt_vec3 low = point (&s, -s.shape.catenary.sigma0), start = tangent (&s, 0);
      near ("lowest", low.y, t[10], 1e-11 * t[0]);
      near ("belly", low.x, t[11], 1e-11 * t[0]);
      near ("slope", start.x / start.y, t[12], 1e-10 * t[12]);
    }
}

/* The shape is that of the current's direction, T goes with its square; -U mirrors.
 */
static void
shape_does_not_know_the_speed (void **state)
{
  scene s, faster;
  (void)state;
  begin (&s, BT_MODEL_CATENARY, 40, bt__vec (-10, 20, 0));
  flow (&s, 0.25, 0);
  solve_well (&s);
  near ("T", tension (&s, 7), 1.378, 6e-4);
  begin (&faster, BT_MODEL_CATENARY, 40, bt__vec (-10, 20, 0));
  flow (&faster, 1, 0);
  solve_well (&faster);
  near ("T", tension (&faster, 7), 22.05, 6e-3);
  for (int i = 0; i <= 40; i++)
    {
      bt_vec3 p = point (&s, i);
      near_point ("same point", point (&faster, i), p.x, p.y, p.z, 1e-12);
    }
  scene back;
  begin (&back, BT_MODEL_CATENARY, 40, bt__vec (10, 20, 0));
  flow (&back, -0.25, 0);
  solve_well (&back);
  for (int i = 0; i <= 40; i++)
    {
      bt_vec3 p = point (&s, i);
      near_point ("mirrored", point (&back, i), -p.x, p.y, p.z, 1e-12);
    }
  /* Force on the vehicle at 0.5 m/s: 5.418 N down-current, 1.016 toward the anchor.
   */
  bt_vec3 pull = bt__scale (-4 * tension (&s, 40), tangent (&s, 40));
  near_point ("force on the vehicle", pull, 5.4175, -1.0163, 0, 6e-4);
}

/* Turning the world turns the shape.  */
static void
turns_with_the_world (void **state)
{
  scene s;
  (void)state;
  begin (&s, BT_MODEL_CATENARY, 40, bt__vec (-10, 20, 4));
  s.props.sag_buoyancy = -0.3;
  solve_well (&s);
  is_sound (&s);
  for (int k = 1; k < 12; k++)
    {
      double c = cos (0.5 * k), n = sin (0.5 * k);
      scene t;
      begin (&t, BT_MODEL_CATENARY, 40, bt__vec (-10 * c - 20 * n, -10 * n + 20 * c, 4));
      t.props.sag_buoyancy = -0.3;
      flow (&t, 0.5 * c, 0.5 * n);
      solve_well (&t);
      for (int i = 0; i <= 40; i += 4)
        {
          bt_vec3 p = point (&s, i);
          near_point ("turned", point (&t, i), p.x * c - p.y * n, p.x * n + p.y * c, p.z, 1e-12);
        }
    }
}

/* ---- The V ---- */

/* Length 10, 6 across, DZ up-current: l1, bend across and down-current.  */
static void
bends_into_a_v (void **state)
{
  static const double rows[][4]
      = { { 0, 5, 3, 4 }, { 8, 0, 0, 0 }, { -8, 10, 6, 8 }, { 4, 2.5, 1.5, 2 } };
  (void)state;
  for (size_t i = 0; i < COUNT (rows); i++)
    {
      const double *r = rows[i];
      scene s;
      begin (&s, BT_MODEL_V_SHAPE, 10, bt__vec (-r[0], 6, 0));
      solve_well (&s);
      is_sound (&s);
      near ("l1", s.shape.v.l1, r[1], 1e-14);
      near_point ("bend", point (&s, r[1]), r[3], r[2], 0, 1e-13);
      if (fabs (r[0]) == 8)
        continue; /* taut: nothing pulls */
      /* Half of 11.685 N at the bend, two links 53.13 degrees against it.  */
      near ("T", tension (&s, 0), 0.5 * 11.685 / (2 * 0.8), 1e-12);
      near ("T", tension (&s, 10), tension (&s, 0), 0);
      near ("link toward the vehicle at the kink", tangent (&s, r[1]).x, -0.8, 1e-13);
    }
}

/* Length 100, 60 across, 20 up-current, 30 up.  */
static void
begin_deep_v (scene *s, bt_model_kind model, bt_depth_rule rule)
{
  begin (s, model, 100, bt__vec (-20, 60, 30));
  s->props.depth_rule = rule;
}

static void
depth_rule_linear (void **state)
{
  scene s;
  (void)state;
  begin_deep_v (&s, BT_MODEL_V_SHAPE, BT_DEPTH_LINEAR);
  solve_well (&s);
  is_sound (&s);
  near ("L'", s.shape.plane_length, 95.3939, 5e-5);
  near ("ratio", s.shape.v.l1 / s.shape.plane_length, .365160, 5e-7);
  double u = 100 * s.shape.v.l1 / s.shape.plane_length;
  bt_vec3 bend = point (&s, u);
  near_point ("bend", bend, 27.0810, 21.9096, 10.9548, 1e-4);
  near ("total", bt__norm (bend) + bt__distance (bend, s.in.b), 100, 1e-12);
  /* Test 6: the catenary's depth is linear in the arc length.  */
  begin_deep_v (&s, BT_MODEL_CATENARY, BT_DEPTH_LINEAR);
  solve_well (&s);
  is_sound (&s);
  for (int i = 0; i <= 100; i++)
    near ("depth", point (&s, i).z, 0.3 * i, 1e-12);
  double sum = 0;
  for (int i = 0; i < 20000; i++)
    sum += bt__distance (point (&s, i / 200.0), point (&s, (i + 1) / 200.0));
  near ("total", sum, 100, 1e-6);
}

static void
depth_rule_thesis_linear (void **state)
{
  /* factor, ratio, bend up-current.. : across, down-current, deep, total */
  static const double rows[][6] = { { 1, .375, 22.5, 27.811, 11.25, 101.090 },
                                    { 0.95, .39474, 22.5, 27.564, 11.842, 100.732 } };
  scene s;
  (void)state;
  for (size_t i = 0; i < COUNT (rows); i++)
    {
      const double *r = rows[i];
      begin_deep_v (&s, BT_MODEL_V_SHAPE, BT_DEPTH_THESIS_LINEAR);
      s.props.thesis_length_factor = r[0];
      solve_well (&s);
      near ("l1", s.shape.v.l1, 37.5, 1e-12);
      bt_vec3 bend = point (&s, 100 * s.shape.v.l1 / s.shape.plane_length);
      near_point ("bend", bend, r[3], r[2], r[4], 1e-3);
      near ("total", s.shape.plane_length, r[5], 6e-4);
      near ("total", bt__norm (bend) + bt__distance (bend, s.in.b), r[5], 6e-4);
      near_point ("end", point (&s, 100), -20, 60, 30, 1e-12);
      assert_true (tension (&s, 1) > 0 && tension (&s, 99) > 0);
    }
  /* Near taut its square root turns negative.  */
  begin (&s, BT_MODEL_V_SHAPE, 100, bt__vec (0, 60, 79));
  s.props.depth_rule = BT_DEPTH_THESIS_LINEAR;
  s.props.thesis_length_factor = 0.95;
  assert_int_equal (solve (&s), BT_ERR_DOMAIN);
  assert_non_null (strstr (s.error.text, "square root"));
  begin_deep_v (&s, BT_MODEL_CATENARY, BT_DEPTH_THESIS_LINEAR);
  assert_int_equal (solve (&s), BT_ERR_UNSUPPORTED);
}

/* Buoyancy -0.5 at half of the largest current: the plane tilts by -22.5 degrees. */
static void
depth_rule_sag (void **state)
{
  scene s;
  (void)state;
  begin (&s, BT_MODEL_CATENARY, 40, bt__vec (0, 20, -4));
  flow (&s, 1, 0);
  s.props.sag_buoyancy = -0.5;
  solve_well (&s);
  is_sound (&s);
  double phi = -BT__PI / 8;
  bt_vec3 load = bt__vec (cos (phi), 0, sin (phi));
  near_point ("load", s.memory.load_direction, load.x, load.y, load.z, 1e-15);
  bt_vec3 normal = bt__unit_or (bt__cross (s.in.b, load), load);
  for (int i = 0; i <= 40; i++)
    near ("off the plane", bt__dot (point (&s, i), normal), 0, 1e-9 * 40);
  begin (&s, BT_MODEL_V_SHAPE, 40, bt__vec (0, 20, -4));
  flow (&s, 1, 0);
  s.props.sag_buoyancy = -0.5;
  solve_well (&s);
  assert_true (fabs (tangent (&s, 0).z) > fabs (tangent (&s, 39.9).z));
}

/* The share U / Umax ends at 1, where the sag is 0; in still water the sag is the buoyancy. */
static void
depth_rule_sag_has_ends (void **state)
{
  (void)state;
  for (int b = -4; b <= 4; b++)
    for (int k = 0; k <= 12; k++)
      {
        scene s;
        double buoyancy = b / 4.0, speed = 0.25 * k; /* of at most 2 m/s */
        double phi = buoyancy * fmax (0, 1 - speed / 2) * BT__PI / 2;
        begin (&s, BT_MODEL_CATENARY, 40, bt__vec (0, 20, -4));
        s.props.sag_buoyancy = buoyancy;
        flow (&s, 0.5, 0); /* which way is the last one's in still water */
        solve_well (&s);
        flow (&s, speed, 0);
        solve_well (&s);
        is_sound (&s);
        near_point ("load", bt__scale (-1, s.shape.against), cos (phi), 0, sin (phi), 1e-15);
        if (b == 0 && k == 0)
          continue; /* neither current nor buoyancy: no load */
        begin (&s, BT_MODEL_CATENARY, 40, bt__vec (0, 20, -4));
        s.props.sag_buoyancy = buoyancy;
        flow (&s, speed, 0);
        solve_well (&s);
        near ("sag of the first answer", -s.shape.against.z, sin (phi), 1e-15);
      }
}

/* With the real weight and drag the load is their sum.  */
static void
depth_rule_sag_auto (void **state)
{
  scene s;
  (void)state;
  begin (&s, BT_MODEL_CATENARY, 40, bt__vec (0, 20, -15));
  s.props.sag_buoyancy = BT_SAG_AUTO;
  s.props.wet_weight = 1.1685;
  solve_well (&s);
  is_sound (&s);
  near_point ("load", s.memory.load_direction, sqrt (0.5), 0, -sqrt (0.5), 1e-12);
  near ("load", s.shape.load, 1.1685 * sqrt (2), 1e-12);
  near ("T", tension (&s, 3), s.shape.load * s.shape.catenary.a, 1e-12);
  flow (&s, 0, 0);
  solve_well (&s);
  near_point ("weight", s.memory.load_direction, 0, 0, -1, 0);
  s.props.wet_weight = -1;
  solve_well (&s);
  near_point ("buoyancy", s.memory.load_direction, 0, 0, 1, 0);
}

/* ---- Still water ---- */

static const bt_model_kind bent[]
    = { BT_MODEL_V_SHAPE, BT_MODEL_CATENARY, BT_MODEL_CATENARY_SIMPLEX, BT_MODEL_ELASTIC,
        BT_MODEL_STEADY };

static void
find_tools (scene *s, bt_search *search)
{
  s->tools.search = search;
  /* Without load the steady model needs only that there is one.  */
  s->tools.steady = (bt_steady *)(void *)s;
}

static void
still_and_weightless (void **state)
{
  bt_search *search = bt_search_new ();
  (void)state;
  for (size_t i = 0; i < COUNT (bent); i++)
    {
      scene s;
      int exact = bent[i] != BT_MODEL_CATENARY_SIMPLEX;
      begin (&s, bent[i], 30, bt__vec (20, 0, -10));
      flow (&s, 0, 0);
      find_tools (&s, search);
      solve_well (&s);
      if (exact)
        is_sound (&s);
      assert_true (point (&s, 15).z < -10 && fabs (point (&s, 15).y) < 1e-9); /* straight down */
      near ("no tension", tension (&s, 15), 0, 0);
      /* The plane of the last bend.  */
      s.memory.load_direction = bt__vec (0, 1, 0);
      solve_well (&s);
      assert_true (point (&s, 15).y > 5);
      near_point ("kept", s.memory.load_direction, 0, 1, 0, 0);
      /* Straight if taut, held or not.  */
      s.in.b = bt__vec (0, 30, 40);
      solve_well (&s);
      for (int k = 0; k <= 30; k += 5)
        near_point ("straight", point (&s, k), 0, k, k * 4 / 3.0, 1e-13);
      near ("not held", tension (&s, 15), 0, 0);
      s.in.pull = 12;
      solve_well (&s);
      near ("held", tension (&s, 15), 12, 0);
      near_point ("half", point (&s, 15), 0, 15, 20, 1e-13);
    }
  bt_search_free (search);
}

static void
heavy_line_hangs (void **state)
{
  scene s;
  (void)state;
  begin (&s, BT_MODEL_ELASTIC, 30, bt__vec (20, 0, -10));
  s.props.wet_weight = 0.1;
  solve_well (&s);
  is_sound (&s);
  near ("start", tension (&s, 0), 2.160, 5e-4);
  near ("end", tension (&s, 30), 1.160, 5e-4);
  double low = 0;
  for (int i = 0; i <= 3000; i++)
    low = fmin (low, point (&s, i / 100.0).z);
  near ("lowest", low, -14.896, 5e-4);
  /* The vertical balance: w L carried by both ends.  */
  double up = tension (&s, 0) * -tangent (&s, 0).z + tension (&s, 30) * tangent (&s, 30).z;
  near ("weight", up, 3, 1e-12);
  /* A floating one is the mirror image.  */
  s.props.wet_weight = -0.1;
  s.in.b.z = 10;
  solve_well (&s);
  near ("start", tension (&s, 0), 2.160, 5e-4);
  assert_true (point (&s, 15).z > 10);
}

/* An elastic line stretches where an inextensible one is held.  */
static void
elastic_line_stretches (void **state)
{
  scene s;
  (void)state;
  begin (&s, BT_MODEL_ELASTIC, 50, bt__vec (0, 30.3, 40.4));
  s.props.ea = 1e4;
  solve_well (&s);
  assert_int_equal (s.shape.form, BT__FORM_STRAIGHT);
  near ("EA times strain", tension (&s, 7), 100, 1e-9);
  s.props.wet_weight = 0.1;
  solve_well (&s);
  assert_int_equal (s.shape.form, BT__FORM_ELASTIC);
  near_point ("end", point (&s, 50), 0, 30.3, 40.4, 1e-12);
  near ("tension", tension (&s, 25), 100, 0.5); /* and the sag takes its share */
  s.props.ea = INFINITY;
  s.in.pull = 33;
  solve_well (&s);
  assert_int_equal (s.shape.form, BT__FORM_STRAIGHT);
  near ("held", tension (&s, 25), 33, 0);
}

static void
rubber_band_is_straight (void **state)
{
  scene s;
  (void)state;
  begin (&s, BT_MODEL_RUBBER_BAND, 50, bt__vec (3, 4, 12));
  s.in.pull = 9;
  solve_well (&s);
  near ("slack", tension (&s, 1), 0, 0);
  near_point ("half", point (&s, 25), 1.5, 2, 6, 1e-14);
  s.in.b = bt__vec (0, 0, 0);
  solve_well (&s);
  near_point ("no chord", tangent (&s, 25), 0, 0, -1, 0);
  s.in.b = bt__vec (30, 40, 0);
  solve_well (&s);
  near ("taut", tension (&s, 1), 9, 0);
}

/* ---- What is remembered, what is refused ---- */

/* With the chord along the load the side is that of the last shape.  */
static void
keeps_its_side_when_the_chord_has_none (void **state)
{
  scene s;
  (void)state;
  begin (&s, BT_MODEL_CATENARY, 40, bt__vec (0.001, 20, 0));
  solve_well (&s);
  bt_vec3 side = s.memory.across;
  s.in.b = bt__vec (20, 0, 0);
  solve_well (&s);
  is_sound (&s);
  near_point ("side", s.shape.across, side.x, side.y, side.z, 1e-3);
  begin (&s, BT_MODEL_CATENARY, 40, bt__vec (-20, 0, 0));
  solve_well (&s);
  near ("level", s.shape.across.z, 0, 0);
  begin (&s, BT_MODEL_CATENARY, 40, bt__vec (0, 0, 0));
  solve_well (&s);
  is_sound (&s);
}

static void
simplex_follows_the_catenary (void **state)
{
  scene s, c;
  bt_search *search = bt_search_new ();
  (void)state;
  begin (&s, BT_MODEL_CATENARY_SIMPLEX, 100, bt__vec (-20, 60, 5));
  s.tools.search = search;
  begin (&c, BT_MODEL_CATENARY, 100, bt__vec (-20, 60, 5));
  for (int i = 0; i < 20; i++)
    {
      uint64_t before = s.counts.search_iterations;
      s.in.b.x = c.in.b.x = -20 + 0.2 * i;
      solve_well (&s);
      solve_well (&c);
      if (i == 0)
        assert_true (s.counts.search_iterations > 10);
      if (i > 0) /* warm: the last answer nearly serves */
        assert_true (s.counts.search_iterations - before < 30);
      for (int k = 0; k <= 100; k += 10)
        {
          bt_vec3 p = point (&c, k);
          near_point ("near the true one", point (&s, k), p.x, p.y, p.z, 1.0);
        }
      near ("A", s.shape.catenary.a, c.shape.catenary.a, 0.05 * c.shape.catenary.a);
    }
  assert_true (s.counts.solves == 20);
  /* Very nearly folded it has no answer, and says how far it missed.  */
  begin (&s, BT_MODEL_CATENARY_SIMPLEX, 100, bt__vec (50, 1e-5, 0));
  s.tools.search = search;
  assert_int_equal (solve (&s), BT_ERR_DIVERGED);
  assert_non_null (strstr (s.error.text, "residual"));
  s.tools.search = NULL;
  assert_int_equal (solve (&s), BT_ERR_UNSUPPORTED);
  bt_search_free (search);
}

static void
refuses_nonsense (void **state)
{
  scene s;
  (void)state;
  begin (&s, BT_MODEL_CATENARY, 40, bt__vec (NAN, 0, 0));
  assert_int_equal (solve (&s), BT_ERR_DOMAIN);
  begin (&s, BT_MODEL_CATENARY, 0, bt__vec (1, 0, 0));
  assert_int_equal (solve (&s), BT_ERR_DOMAIN);
  begin (&s, BT_MODEL_CATENARY, 40, bt__vec (1, 0, 0));
  flow (&s, NAN, 0);
  s.current.kind = BT_CURRENT_UNIFORM;
  assert_int_equal (solve (&s), BT_ERR_DIVERGED);
  begin (&s, (bt_model_kind)77, 40, bt__vec (1, 0, 0));
  assert_int_equal (solve (&s), BT_ERR_NAME);
}

/* The same input gives the same bytes, whatever was in the memory before.  */
static void
is_the_same_bytes_again (void **state)
{
  scene s;
  bt__shape first;
  (void)state;
  for (size_t i = 0; i < 2; i++)
    {
      begin (&s, bent[i], 40, bt__vec (1, 20, 3));
      solve_well (&s);
      memcpy (&first, &s.shape, sizeof first);
      memset (&s.shape, 0xa5, sizeof s.shape);
      solve_well (&s);
      assert_memory_equal (&first, &s.shape, sizeof first);
    }
}

/* Nodes on a circle: points to fourth order, tension through the nodes.  */
static void
joins_nodes_smoothly (void **state)
{
  enum
  {
    N = 16
  };
  bt_vec3 r[N + 1], t[N + 1];
  bt__shape shape;
  (void)state;
  memset (&shape, 0, sizeof shape);
  shape.form = BT__FORM_NODES;
  shape.n = N;
  shape.length = 3;
  for (int i = 0; i <= N; i++)
    {
      double u = 3.0 * i / N;
      r[i] = bt__vec (cos (u), sin (u), 0);
      t[i] = bt__scale (2 + sin (u), bt__vec (-sin (u), cos (u), 0));
    }
  shape.a = r[0];
  shape.b = r[N];
  for (int i = 0; i <= 300; i++)
    {
      double u = i / 100.0;
      bt_vec3 p = bt__shape_point (&shape, r, t, u), d = bt__shape_tangent (&shape, r, t, u);
      near_point ("point", p, cos (u), sin (u), 0, 2e-5);
      near_point ("tangent", d, -sin (u), cos (u), 0, 2e-4);
      near ("tension", bt__shape_tension (&shape, r, t, u), 2 + sin (u), 4e-4);
    }
  near_point ("start", bt__shape_point (&shape, r, t, -1), 1, 0, 0, 0);
  near_point ("end", bt__shape_point (&shape, r, t, 9), cos (3), sin (3), 0, 1e-15);
  /* Without tension the tangent is the chord's.  */
  memset (t, 0, sizeof t);
  assert_true (bt__is_finite (bt__shape_tangent (&shape, r, t, 1.1)));
}

int
main (void)
{
  const struct CMUnitTest tests[] = { cmocka_unit_test (golden_catenaries),
                                      cmocka_unit_test (neutral_line_in_a_current),
                                      cmocka_unit_test (shape_does_not_know_the_speed),
                                      cmocka_unit_test (turns_with_the_world),
                                      cmocka_unit_test (bends_into_a_v),
                                      cmocka_unit_test (depth_rule_linear),
                                      cmocka_unit_test (depth_rule_thesis_linear),
                                      cmocka_unit_test (depth_rule_sag),
                                      cmocka_unit_test (depth_rule_sag_has_ends),
                                      cmocka_unit_test (depth_rule_sag_auto),
                                      cmocka_unit_test (still_and_weightless),
                                      cmocka_unit_test (heavy_line_hangs),
                                      cmocka_unit_test (elastic_line_stretches),
                                      cmocka_unit_test (rubber_band_is_straight),
                                      cmocka_unit_test (keeps_its_side_when_the_chord_has_none),
                                      cmocka_unit_test (simplex_follows_the_catenary),
                                      cmocka_unit_test (refuses_nonsense),
                                      cmocka_unit_test (is_the_same_bytes_again),
                                      cmocka_unit_test (joins_nodes_smoothly) };
  return cmocka_run_group_tests_name ("plane", tests, NULL, NULL);
}
