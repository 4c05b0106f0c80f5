/* The mesh of a moving line follows what is out: whatever length it was laid with, the line that a
   winch pays out or hauls in is the line of that length laid whole.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include "dynamic_scene.h"
#include "tether/dynamic_contact.h"

enum
{
  NODES = 64
};

#define ERROR 5e-3 /* m for each 100 m of line: of the mesh */
#define STEP (1.0 / 60)
#define MOST_BENT 0.02 /* of an interval: what a smooth cubic is longer than its chord */

/* Where the far end is for LENGTH of line.  */
static bt_vec3
far_end (double length)
{
  return bt__vec (0.55 * length, 0.2 * length, -10 - 0.6 * length);
}

/* LENGTH of line in a current, laid straight.  */
static void
lay (scene *s, double length)
{
  bt_tether_props line = { .diameter = 0.01,
                           .mass = 0.1,
                           .wet_weight = 0.2,
                           .ea = 1e5,
                           .ba = 200,
                           .cdn = 1.2,
                           .cdt = 0.01,
                           .ca = 1 };
  bt_vec3 shape[2] = { { 0, 0, -10 }, far_end (length) };
  scene_open (s, line, 1025, NODES, shape, 2, length);
  scene_current (s, bt__vec (0, 0.3, 0));
  s->in.mesh = (bt__dynamic_mesh){ .fewest = NODES, .most = 4 * NODES };
}

/* Wind S on RATE until LENGTH is out, the far end going along.  */
static void
wind_to (scene *s, double length, double rate)
{
  for (double out; out = bt__dynamic_length (s->d), fabs (length - out) > 1e-9 * length;)
    {
      double most = rate * STEP, way = fmax (-most, fmin (most, length - out));
      s->in.pay = way / STEP;
      s->in.end[1].at = far_end (out + way);
      s->in.mesh.error = s->in.mesh.fewest > 0 ? ERROR * out / 100 : 0;
      scene_step (s, STEP);
    }
  s->in.pay = 0;
}

static void
assert_same_line (scene *is, scene *whole, double length)
{
  for (int end = 0; end < 2; end++)
    {
      double wanted = bt__norm (whole->d->pull[end]);
      assert_close (bt__norm (is->d->pull[end]), wanted, 0.01 * wanted, "force at an end");
      double off = bt__distance (is->d->pull[end], whole->d->pull[end]);
      assert_close (off, 0, 0.01 * wanted, "force at an end, its direction too");
    }
  for (int k = 1; k < 8; k++)
    {
      double s = length * k / 8;
      double off = bt__distance (bt__dynamic_point (is->d, s), bt__dynamic_point (whole->d, s));
      assert_close (off, 0, 2.5 * ERROR * length / 100, "shape");
    }
}

/* From any length to any other, out and in.  */
static void
test_as_laid_whole (void **state)
{
  (void)state;
  const double to[][3] = { /* laid, wound to, m/s */
                           { 5, 103, 1 },   { 1, 60, 3 },    { 100, 10, 1 },  { 30, 31, 0.05 },
                           { 20, 19, 0.2 }, { 1, 3000, 20 }, { 3000, 20, 20 }
  };
  for (size_t k = 0; k < sizeof to / sizeof *to; k++)
    {
      scene s, whole;
      lay (&s, to[k][0]);
      scene_settle (&s);
      wind_to (&s, to[k][1], to[k][2]);
      assert_true (s.d->n >= NODES && s.d->n <= 4 * NODES);
      scene_settle (&s);
      lay (&whole, to[k][1]);
      scene_settle (&whole);
      assert_same_line (&s, &whole, to[k][1]);
      scene_close (&s);
      scene_close (&whole);
    }
}

/* With nothing said of its error a mesh that is full goes on with longer intervals.  */
static void
test_full_block (void **state)
{
  (void)state;
  scene s;
  lay (&s, 5);
  s.in.mesh = (bt__dynamic_mesh){ .most = 100 };
  wind_to (&s, 50, 1);
  double longest = 0;
  for (int j = 0; j < s.d->n; j++)
    longest = fmax (longest, bt__dynamic_rest (s.d)[j]);
  assert_true (s.d->n >= 90 && s.d->n <= 100);
  assert_true (longest < 4 * 50.0 / 100);
  scene_close (&s);
}

/* The most that a tension at an end of S changes in a step, of itself or with SHARED of the larger
   of both, once the start of the winch is over, as it turns by PAY until WAY metres have run;
   *CHANGES: steps in which nodes came or went.  */
static double
largest_jump (scene *s, double pay, double way, int shared, int *changes)
{
  const double start = 10;
  double most = 0;
  s->in.pay = pay;
  for (int i = 0; i < (int)(way / fabs (pay) / STEP); i++)
    {
      double was[2] = { bt__norm (s->d->pull[0]), bt__norm (s->d->pull[1]) };
      int64_t n = s->d->n;
      double piece = s->d->piece;
      scene_step (s, STEP);
      *changes += s->d->n != n || s->d->piece != piece;
      for (int end = 0; end < 2 && i * STEP > start; end++)
        most = fmax (most, fabs (bt__norm (s->d->pull[end]) - was[end])
                               / (shared ? fmax (was[0], was[1]) : was[end]));
    }
  return most;
}

/* As nodes come and go, no tension jumps.  */
static void
test_no_jump (void **state)
{
  (void)state;
  const double pay[] = { -0.05, 0.05, 0.4 };
  for (int k = 0; k < 3; k++)
    {
      scene s;
      int changes = 0;
      lay (&s, 40);
      scene_settle (&s);
      s.in.mesh.error = 1;
      double most = largest_jump (&s, pay[k], pay[k] < 0 ? 6 : 15, 0, &changes);
      assert_true (changes > 5);
      assert_close (most, 0, 0.02, "jump of a tension");
      scene_close (&s);
    }
}

/* ---- Lumps ---- */

/* LENGTH of line that hangs in a current between ends half as far apart, with a lump of each WEIGHT
   in water FROM_END metres from the far end; MASS is steel's, or that of a float.  */
static void
lay_lumps (scene *s, double length, bt__dynamic_lump *lumps, int n)
{
  lay (s, length);
  s->in.end[1].at = bt__vec (0.55 * length, 0.2 * length, -10);
  for (int k = 0; k < n; k++)
    {
      double heavy = fabs (lumps[k].wet_weight) / 9.81;
      lumps[k].mass = 1.15 * heavy;
      lumps[k].added = 0.5 * heavy;
      lumps[k].quadratic = 5 * heavy;
    }
  s->in.lumps = lumps;
  s->in.n_lumps = n;
  s->in.mesh.corners = 1;
  scene_settle (s);
}

/* Whatever is fastened to the line, and however the winch turns, nothing jumps as nodes come and
   go, by 2 % of the larger tension at an end; and no more come and go than the winch has to add or
   take, and another elsewhere for each.  */
static void
test_lumps (void **state)
{
  (void)state;
  const double pay[] = { -0.2, -0.05, 0.05, 0.4 };
  const bt__dynamic_lump fastened[][3] = {
    { { .from_end = 6, .wet_weight = 17 } },
    { { .from_end = 20.3, .wet_weight = 100 } },
    { { .from_end = 11.1, .wet_weight = -8 } },
    { { .from_end = 25, .wet_weight = 0.5 } },
    { { .from_end = 3, .wet_weight = 5 },
      { .from_end = 3.2, .wet_weight = 5 },
      { .from_end = 17, .wet_weight = -15 } },
  };
  for (size_t k = 0; k < 4 * sizeof fastened / sizeof *fastened; k++)
    {
      scene s;
      bt__dynamic_lump lumps[3];
      int changes = 0, n = fastened[k / 4][1].from_end > 0 ? 3 : 1;
      double rate = pay[k % 4], way = rate < 0 ? 6 : 15;
      memcpy (lumps, fastened[k / 4], sizeof lumps);
      lay_lumps (&s, 40, lumps, n);
      s.in.mesh.error = 0.02;
      double piece = s.d->piece, most = largest_jump (&s, rate, way, 1, &changes);
      assert_close (most, 0, 0.02, "jump of a tension");
      assert_true (changes >= 5 && changes <= 2 * way / piece);
      scene_close (&s);
    }
}

/* Wind S at RATE for TIME s; LUMP is on the line while it is out.  Return the most that a tension
   at an end changes in a step with a change of nodes or one of the ten after it, with a share of
   the larger of both: not while the winch starts, nor as the lump passes it.  */
static double
jump_by_lump (scene *s, const bt__dynamic_lump *lump, double rate, double time)
{
  const double start = 3;
  double most = 0;
  int since = 10;
  s->in.pay = rate;
  s->in.mesh.error = 0.02;
  for (int i = 0; i < (int)(time / STEP); i++)
    {
      double was[2] = { bt__norm (s->d->pull[0]), bt__norm (s->d->pull[1]) };
      int64_t n = s->d->n;
      double piece = s->d->piece;
      int on = lump->from_end < bt__dynamic_length (s->d), passes = on != s->in.n_lumps;
      s->in.n_lumps = on;
      scene_step (s, STEP);
      since = s->d->n != n || s->d->piece != piece ? 0 : since + 1;
      for (int end = 0; end < 2 && since < 10 && i * STEP > start && !passes; end++)
        most = fmax (most, fabs (bt__norm (s->d->pull[end]) - was[end]) / fmax (was[0], was[1]));
    }
  return most;
}

/* A lump that comes out of the winch, or goes into it, turns the line there: what comes out along
   the line with the winch's rate U comes out along the new way.  That a wave along the line tells,
   of U sqrt (EA m) at most.  Beyond that no tension jumps as the nodes of the lump come and go.  */
static void
test_lump_passes_the_winch (void **state)
{
  (void)state;
  const double weight[] = { 5, 17, 100, -15 }, rate[] = { 0.02, 0.05 };
  for (int k = 0; k < 8; k++)
    {
      scene s;
      double w = weight[k / 2], u = rate[k % 2], time = 0.8 / u;
      bt__dynamic_lump lump = { .from_end = 40 + 6 * u, .wet_weight = w };
      lay_lumps (&s, 40, &lump, 1);
      s.in.n_lumps = 0;
      scene_settle (&s);
      double wave = u * sqrt (s.line.ea * s.line.mass),
             bound = 0.02 + wave / bt__norm (s.d->pull[0]);
      assert_close (jump_by_lump (&s, &lump, u, time), 0, bound, "jump as a lump comes out");
      assert_int_equal (s.in.n_lumps, 1);
      s.in.pay = 0;
      scene_settle (&s);
      bound = 0.02 + wave / bt__norm (s.d->pull[0]);
      assert_close (jump_by_lump (&s, &lump, -u, time), 0, bound, "jump as a lump goes in");
      assert_int_equal (s.in.n_lumps, 0);
      scene_close (&s);
    }
}

/* Where there is no water, nodes that go give the line no more energy than its weight has for the
   error in position that is aimed at.  */
static void
test_energy (void **state)
{
  (void)state;
  const double error = 0.02;
  scene s;
  lay (&s, 40);
  scene_settle (&s);
  s.water.density = 0;
  s.in.mesh = (bt__dynamic_mesh){ .fewest = 16, .most = NODES, .error = error, .idle = 1 };
  double before = scene_energy (&s), most = before, fell = 0;
  bt_vec3 middle = bt__dynamic_point (s.d, 20);
  for (int i = 0; i < 60 * 8; i++)
    {
      scene_step (&s, STEP);
      most = fmax (most, scene_energy (&s));
      fell = fmax (fell, bt__distance (bt__dynamic_point (s.d, 20), middle));
    }
  assert_true (s.d->n < NODES - 10);
  assert_true (fell > 1);
  assert_true (most - before < s.line.wet_weight * 40 * error);
  scene_close (&s);
}

/* A point at U is no farther from either end than there is line, stretched, between.  */
static void
test_points_are_within_reach (void **state)
{
  (void)state;
  scene s;
  lay (&s, 2);
  for (int k = 0; k < 40; k++)
    {
      double length = bt__dynamic_length (s.d), stretch = 1;
      for (int j = 0; j < s.d->n; j++)
        stretch = fmax (stretch, bt__dynamic_stretch (s.d)[j]);
      for (int i = 0; i <= 200; i++)
        {
          double u = length * i / 200;
          bt_vec3 p = bt__dynamic_point (s.d, u);
          double over = bt__distance (p, bt__dynamic_x (s.d)[0]) - u * stretch;
          assert_true (over <= MOST_BENT * length / s.d->n);
          over = bt__distance (p, bt__dynamic_x (s.d)[s.d->n]) - (length - u) * stretch;
          assert_true (over <= fabs (s.d->owed) * stretch + MOST_BENT * length / s.d->n);
        }
      wind_to (&s, k % 3 == 2 ? 0.4 * length : 1.7 * length, k % 5 ? 4 : 0.7);
      s.in.end[1].at = bt__vec (0.3 * length, k % 2 * 0.2 * length, -12);
      for (int i = 0; i < 30; i++)
        scene_step (&s, STEP);
      if (length > 200)
        wind_to (&s, 3, 30);
    }
  scene_close (&s);
}

int
main (void)
{
  const struct CMUnitTest tests[] = {
    cmocka_unit_test (test_as_laid_whole),
    cmocka_unit_test (test_full_block),
    cmocka_unit_test (test_no_jump),
    cmocka_unit_test (test_lumps),
    cmocka_unit_test (test_energy),
    cmocka_unit_test (test_points_are_within_reach),
    cmocka_unit_test (test_lump_passes_the_winch),
  };
  return cmocka_run_group_tests (tests, NULL, NULL);
}
