/* The moving line under abuse: energy, winch, knife, refusals, and a long campaign of random steps.
   BIGHT_LONG=1 makes it a million.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include "law/dynamic_scene.h"

#include "testbed/campaign.h"

/* ---- Energy ---- */

/* A line let go off balance in still water loses energy at every step of 300 s.
 */
static void
test_energy_in_still_water (void **state)
{
  (void)state;
  for (int k = 0; k < 4; k++)
    {
      scene s;
      bt_vec3 shape[3] = { { 0, 0, 0 }, { 12, 15, 3 }, { 20, 0, -5 } };
      bt_tether_props line = { .diameter = 0.0076,
                               .mass = 0.06,
                               .wet_weight = k % 2 ? 0.3 : 0.05,
                               .ea = k < 2 ? 2e5 : 1e7,
                               .ba = k < 2 ? 20 : 0,
                               .ei = k == 1 ? 0.1 : 0,
                               .cdn = 1.2,
                               .cdt = 0.01,
                               .ca = 1 };
      double least, start, gain = 0;
      scene_open (&s, line, 1025, 60, shape, 3, 40);
      s.in.tolerance = 1e-7;
      least = start = scene_energy (&s);
      while (s.water.time < 300)
        {
          scene_step (&s, 1.0 / 60);
          double e = scene_energy (&s);
          gain = fmax (gain, e - least);
          least = fmin (least, e);
        }
      printf ("# still water %d: %.3f J lost, largest gain %.2g J, last speed %.2g m/s\n", k,
              start - least, gain, s.report.speed);
      assert_true (least < start && gain < 1e-9 * (start - least));
      assert_int_equal (s.unconverged, 0);
      assert_true (s.report.speed < 0.02);
      scene_close (&s);
    }
}

/* A swing in vacuo with its slack and its snaps, in coarse steps: nothing is ever gained.  */
static void
test_energy_in_vacuo (void **state)
{
  (void)state;
  static const double steps[] = { 0.1, 1.0 / 60, 1e-3 };
  for (int k = 0; k < 3; k++)
    for (int q = 0; q < 2; q++)
      {
        scene s;
        bt_vec3 shape[3] = { { 0, 0, 0 }, { 9, 0, 2 }, { 12, 0, 0 } };
        bt_tether_props line = { .diameter = 0.01, .mass = 0.1, .wet_weight = 0.981, .ea = 2e5 };
        double start, most = -1e9, scale = 0.981 * 20 * 20;
        scene_open (&s, line, 0, 40, shape, 3, 20);
        s.in.end[1].free = q;
        start = scene_energy (&s);
        while (s.water.time < 20)
          {
            scene_step (&s, steps[k]);
            most = fmax (most, scene_energy (&s) - start);
          }
        printf ("# in vacuo, steps of %.3g s: largest gain %.2g J of %.0f\n", steps[k], most,
                scale);
        if (!(most < 1e-6 * scale))
          fail_msg ("steps of %g s: %g J gained (of %g)", steps[k], most, scale);
        scene_close (&s);
      }
}

/* ---- Winch ---- */

/* A taut 50 m line hauled and paid by 10 m at .5 m/s.  */
static void
test_winch (void **state)
{
  (void)state;
  for (int k = 0; k < 2; k++)
    {
      scene s;
      double sign = k ? -1 : 1, steady = 0, most = 0, h = 1.0 / 60;
      bt_vec3 shape[3] = { { 0, 0, 0 }, { 24, 0, -3 }, { 49, 0, -3 } };
      bt_tether_props line = { .diameter = 0.0076,
                               .mass = 0.06,
                               .wet_weight = 0.1,
                               .ea = 2e5,
                               .ba = 20,
                               .cdn = 1.2,
                               .cdt = 0.01,
                               .ca = 1 };
      scene_open (&s, line, 1025, 50, shape, 3, 50);
      scene_current (&s, bt__vec (0, 0.3, 0));
      scene_settle (&s);
      s.in.tolerance = 1e-6;
      s.in.pay = 0.5 * sign;
      for (int i = 0; i < 1200; i++) /* the vehicle keeps its line as taut as it is */
        {
          s.in.end[1].at.x += 0.5 * sign * h;
          scene_step (&s, h);
          double t = fmax (s.report.tension, bt__dynamic_node_tension (s.d, 0));
          if (i < 120)
            steady = fmax (steady, i > 60 ? t : 0);
          else
            most = fmax (most, t / steady);
          assert_true (bt__dynamic_rest (s.d)[0] > 0.1);
        }
      printf (
          "# winch %+.1f m/s: %d intervals, tension at most %.2f of what it was, %ld unsolved\n",
          s.in.pay, (int)s.d->n, most, s.unconverged);
      assert_close (bt__dynamic_length (s.d), 50 + 10 * sign, 1e-9, "length");
      assert_close ((double)s.d->n, 50 + 10 * sign, 1, "intervals");
      assert_true (most < 1.5);
      scene_close (&s);
    }
}

/* The same for a line that hangs, wound to and fro; a sudden rate would send a wave of V sqrt (EA
 * m).  */
static void
test_winch_to_and_fro (void **state)
{
  (void)state;
  scene s;
  double most = 0, h = 1.0 / 60;
  bt_vec3 shape[3] = { { 0, 0, 0 }, { 15, 0, -15 }, { 30, 0, 0 } };
  bt_tether_props line
      = { .diameter = 0.0076, .mass = 0.06, .wet_weight = 0.5, .ea = 2e5, .cdn = 1.2, .ca = 1 };
  scene_open (&s, line, 1025, 40, shape, 3, 45);
  scene_settle (&s);
  double steady = s.report.tension;
  for (int i = 0; i < 1800; i++)
    {
      s.in.pay = 0.5 * sin (0.025 * i);
      scene_step (&s, h);
      most = fmax (most, s.report.tension);
    }
  printf ("# winch to and fro: %.2f of the tension at rest\n", most / steady);
  assert_true (most < 1.5 * steady);
  scene_close (&s);
}

/* ---- The knife ---- */

static void
test_parting (void **state)
{
  (void)state;
  scene s, rest;
  bt_vec3 shape[3] = { { 0, 0, 0 }, { 10, 0, -4 }, { 20, 0, 0 } };
  bt_tether_props line = { .diameter = 0.0076,
                           .mass = 0.06,
                           .wet_weight = 0.5,
                           .ea = 2e5,
                           .ba = 20,
                           .cdn = 1.2,
                           .cdt = 0.01,
                           .ca = 1 };
  scene_open (&s, line, 1025, 30, shape, 3, 20.3);
  scene_open (&rest, line, 1025, 30, shape, 3, 20.3);
  scene_settle (&s);
  bt__dynamic *whole = malloc (bt__dynamic_size (RIG_MAX));
  memcpy (whole, s.d, bt__dynamic_size (RIG_MAX));
  bt__dynamic_cut (whole, 12, 0.5, s.d, rest.d);
  assert_close (bt__dynamic_length (s.d) + bt__dynamic_length (rest.d), 20.3, 1e-12, "length");
  assert_int_equal (s.d->n + rest.d->n, 31);
  s.in.end[1].free = rest.in.end[0].free = 1;
  for (int i = 0; i < 6000; i++)
    {
      scene_step (&s, 1.0 / 60);
      scene_step (&rest, 1.0 / 60);
    }
  printf ("# parted: %.3f %.3f m/s\n", s.report.speed, rest.report.speed);
  bt_vec3 a = bt__dynamic_x (s.d)[s.d->n], b = bt__dynamic_x (rest.d)[0];
  assert_true (bt__distance (a, bt__vec (0, 0, -20.3 * 12.5 / 30)) < 0.05);
  assert_true (bt__distance (b, bt__vec (20, 0, -20.3 * 17.5 / 30)) < 0.05);
  free (whole);
  scene_close (&s);
  scene_close (&rest);
}

/* ---- Refusals, determinism, rest ---- */

static void
hole (void *user, bt_vec3 p, double time, bt_vec3 *v)
{
  (void)user;
  (void)time;
  *v = bt__vec (p.x > 5 ? NAN : 0.3, 0, 0);
}

static void
test_refusals (void **state)
{
  (void)state;
  scene s;
  bt_error error;
  bt_vec3 shape[2] = { { 0, 0, 0 }, { 9, 0, -3 } };
  bt_tether_props line
      = { .diameter = 0.0076, .mass = 0.06, .ea = 2e5, .cdn = 1.2, .cdt = 0.01, .ca = 1 };
  size_t size = bt__dynamic_size (RIG_MAX);
  scene_open (&s, line, 1025, 10, shape, 2, 10);
  scene_step (&s, 0.02);
  bt__dynamic *before = malloc (size);
  memcpy (before, s.d, size);
  s.water.function = hole;
  s.current.kind = BT_CURRENT_FUNCTION;
  assert_int_equal (bt__dynamic_step (s.d, s.work, &s.in, &s.report, &error), BT_ERR_DIVERGED);
  assert_non_null (strstr (error.text, "current at node"));
  s.current.kind = BT_CURRENT_STILL;
  s.in.end[1].at.y = INFINITY;
  assert_int_equal (bt__dynamic_step (s.d, s.work, &s.in, &s.report, &error), BT_ERR_DOMAIN);
  s.in.end[1].at = shape[1];
  s.in.end[1].free = 1;
  s.in.end[1].body.force.x = NAN;
  assert_int_equal (bt__dynamic_step (s.d, s.work, &s.in, &s.report, &error), BT_ERR_DIVERGED);
  s.in.h = -1;
  assert_int_equal (bt__dynamic_step (s.d, s.work, &s.in, &s.report, &error), BT_ERR_DOMAIN);
  assert_memory_equal (before, s.d, size);
  assert_int_equal (bt__dynamic_init (s.d, 5, 6, shape, 2, 1, 1, NULL), BT_ERR_LIMIT);
  assert_int_equal (bt__dynamic_init (s.d, 5, 5, shape, 2, -1, 1, NULL), BT_ERR_DOMAIN);
  free (before);
  scene_close (&s);
}

/* A copied block goes on bit by bit, in another workspace too.
 */
static void
test_checkpoint (void **state)
{
  (void)state;
  scene s, copy;
  bt_vec3 shape[3] = { { 0, 0, 0 }, { 5, 3, -4 }, { 9, 0, -3 } };
  bt_tether_props line = { .diameter = 0.0076,
                           .mass = 0.06,
                           .wet_weight = 0.1,
                           .ea = 2e5,
                           .ba = 5,
                           .ei = 0.05,
                           .cdn = 1.2,
                           .cdt = 0.01,
                           .ca = 1 };
  scene_open (&s, line, 1025, 40, shape, 3, 12);
  scene_open (&copy, line, 1025, 11, shape, 3, 7);
  for (int i = 0; i < 600; i++)
    {
      if (i == 300)
        memcpy (copy.d, s.d, bt__dynamic_size (RIG_MAX));
      s.in.pay = copy.in.pay = 0.3 * sin (0.02 * i);
      s.in.end[1].at.y = copy.in.end[1].at.y = sin (0.05 * i);
      scene_step (&s, 1.0 / 60);
      if (i >= 300)
        scene_step (&copy, 1.0 / 60);
    }
  assert_memory_equal (s.d, copy.d, bt__dynamic_size (RIG_MAX));
  scene_close (&s);
  scene_close (&copy);
}

/* ---- Stiffness ---- */

/* A straight line stretched by 1e-4 of its length pulls EA 1e-4, however stiff it is.  */
static void
test_every_stiffness_counts (void **state)
{
  (void)state;
  for (double ea = 1e3; ea < 2e12; ea *= 1e3)
    {
      scene s;
      bt_vec3 shape[3] = { { 0, 0, 0 }, { 50.005, 0, 0 }, { 100.01, 0, 0 } };
      bt_tether_props line = { .diameter = 0.1, .mass = 8, .ea = ea, .cdn = 1, .ca = 1 };
      scene_open (&s, line, 1025, 20, shape, 3, 100);
      for (int i = 0; i < 20; i++)
        scene_step (&s, 0.02);
      assert_close (bt__dynamic_node_tension (s.d, 10) / (1e-4 * ea), 1, 1e-6, "tension");
      scene_close (&s);
    }
}

/* ---- The campaign ---- */

/* The lines of bight-bench-stability, short ones more often.  */
static void
campaign_of (campaign_kind kind, double allowed)
{
  const char *is_long = getenv ("BIGHT_LONG");
  long wanted = is_long && *is_long ? 1000000 : 10000;
  campaign c;
  campaign_tally t = campaign_nothing;
  assert_true (campaign_open (&c, 0x9e3779b97f4a7c15u));
  c.quick = 1;
  while (t.steps < wanted)
    campaign_fly (&c, kind, &t);
  campaign_close (&c);
  double share = 100.0 * (double)t.unsolved / (double)t.steps;
  printf ("# %s teleports: %ld lines, %ld steps, %.3f %% unsolved, for %.2f s at most, %.2f solves"
          " a step, fastest %.3g m/s, after 3 s %.3g m/s\n",
          kind == CAMPAIGN_TELEPORTS ? "with" : "without", t.lines, t.steps, share, t.unsolved_for,
          (double)t.solves / (double)t.steps, t.fastest, t.settled);
  assert_int_equal (t.broken + t.blown, 0);
  assert_true (t.unrecovered <= t.lines / 200);
  assert_true (share <= allowed);
  assert_true (t.settled < 30);
}

static void
test_campaign (void **state)
{
  (void)state;
  campaign_of (CAMPAIGN_PLAIN, 0.15);
  campaign_of (CAMPAIGN_TELEPORTS, 0.5);
}

/* Let go without water, stiff or limp, in steps that do not follow the motion, no line ever has
   more energy than it began with.  Second-order differences left to themselves give some lines
   more, and so do forces that are not quite solved.  */
static void
test_campaign_in_vacuo (void **state)
{
  (void)state;
  campaign c;
  campaign_tally t = campaign_nothing;
  assert_true (campaign_open (&c, 3));
  c.quick = 1;
  while (t.steps < 12000)
    campaign_fly (&c, CAMPAIGN_VACUO, &t);
  campaign_close (&c);
  printf ("# in vacuo: %ld lines, %ld steps, %ld unsolved, largest gain %.2g of m g L^2\n", t.lines,
          t.steps, t.unsolved, t.gain);
  assert_int_equal (t.broken + t.blown, 0);
  assert_true (t.gain < 1e-11);
  assert_true (t.unsolved <= t.steps / 100);
}

/* ---- As text ---- */

/* A flight comes back from a file bit by bit, and flies as before.  */
static void
test_a_flight_comes_back_from_a_file (void **state)
{
  (void)state;
  static campaign_flight back;
  campaign c;
  campaign_tally t, again;
  assert_true (campaign_open (&c, 1));
  c.quick = 1;
  campaign_seed (&c, 7, 3);
  campaign_draw (&c, CAMPAIGN_PLAIN);
  campaign_play (&c, &t);
  const campaign_flight *f = &c.flight;
  assert_true (f->moves > 1);
  FILE *file = tmpfile ();
  assert_non_null (file);
  assert_true (campaign_write (file, f));
  rewind (file);
  assert_true (campaign_read (file, &back));
  assert_memory_equal (&back.line, &f->line, sizeof back.line);
  assert_memory_equal (back.move, f->move, (size_t)f->moves * sizeof *back.move);
  assert_memory_equal (back.shape, f->shape, (size_t)f->corners * sizeof *back.shape);
  fclose (file);
  c.flight = back;
  campaign_play (&c, &again);
  assert_true (again.solves == t.solves && again.ratio == t.ratio && t.solves > 0);
  campaign_close (&c);
}

int
main (void)
{
  const struct CMUnitTest tests[] = {
    cmocka_unit_test (test_energy_in_still_water),
    cmocka_unit_test (test_energy_in_vacuo),
    cmocka_unit_test (test_winch),
    cmocka_unit_test (test_winch_to_and_fro),
    cmocka_unit_test (test_parting),
    cmocka_unit_test (test_refusals),
    cmocka_unit_test (test_checkpoint),
    cmocka_unit_test (test_every_stiffness_counts),
    cmocka_unit_test (test_campaign),
    cmocka_unit_test (test_campaign_in_vacuo),
    cmocka_unit_test (test_a_flight_comes_back_from_a_file),
  };
  return cmocka_run_group_tests (tests, NULL, NULL);
}
