/* A line led by its ends: at rest an elastic catenary, over a floor it pulls as much as rubs, and
   what cannot be led is refused.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>
#include <math.h>

#include <bight/lead.h>
#include <bight/statics.h>

#define ROWS 400

static const bt_lead_start at_rest = { 0 };

static bt_lead_line
rope (int intervals)
{
  return (bt_lead_line){ .props = { .diameter = 0.004,
                                    .mass = 0.05,
                                    .wet_weight = 0.4,
                                    .ea = 400,
                                    .ba = 1,
                                    .cdn = 1.2,
                                    .cdt = 0.01,
                                    .ca = 1,
                                    .friction = 0.5 },
                         .length = 2.85,
                         .intervals = intervals,
                         .density = 1000,
                         .gravity = 9.80665,
                         .floor = NAN,
                         .step = 0.05 };
}

typedef struct led_rows
{
  double t[ROWS];
  bt_vec3 end[2][ROWS];
  bt_lead_track track;
} led_rows;

/* N rows, the far end going from B by V metres a second.  */
static void
make_rows (led_rows *r, int n, bt_vec3 a, bt_vec3 b, double v)
{
  for (int k = 0; k < n; k++)
    {
      r->t[k] = 0.05 * k;
      r->end[0][k] = a;
      r->end[1][k] = (bt_vec3){ b.x + v * r->t[k], b.y, b.z };
    }
  r->track = (bt_lead_track){ .rows = n, .t = r->t, .end = { r->end[0], r->end[1] } };
}

/* Irvine's line of law_elastic.c: the middle, and the pulls, which hold its weight.  */
static void
hangs_as_irvine_says (void **state)
{
  (void)state;
  static led_rows r;
  const double middle[] = { 1.425 };
  bt_vec3 place[10], pull[20];
  bt_lead_line line = rope (200);
  make_rows (&r, 10, (bt_vec3){ 0, 0, 0 }, (bt_vec3){ 1.9, 0, -0.6 }, 0);
  assert_int_equal (bt_lead (&line, &r.track, &at_rest, middle, 1, place, pull, NULL, NULL, NULL),
                    BT_OK);
  assert_float_equal (place[9].x, 0.7663886382095, 2e-5);
  assert_float_equal (place[9].z, -1.168281352137, 2e-5);
  assert_float_equal (pull[18].x, 0.2410603610317, 1e-4);
  assert_float_equal (pull[18].x + pull[19].x, 0, 1e-6);
  assert_float_equal (pull[18].z + pull[19].z, -0.4 * 2.85, 1e-2);
}

/* Dragged straight over a floor, slowly and in thin air, its far end is held by friction alone.  */
static void
drags_over_a_floor (void **state)
{
  (void)state;
  static led_rows r;
  static bt_vec3 pull[2 * ROWS];
  bt_lead_line line = rope (40);
  line.floor = -1;
  line.density = 0;
  bt_vec3 a = { 0, 0, -0.998 };
  make_rows (&r, ROWS, a, (bt_vec3){ 2.84, 0, -0.998 }, 0.1);
  for (int k = 0; k < ROWS; k++)
    r.end[0][k].x = 0.1 * r.t[k];
  assert_int_equal (bt_lead (&line, &r.track, &at_rest, NULL, 0, NULL, pull, NULL, NULL, NULL),
                    BT_OK);
  double sum = pull[2 * ROWS - 2].x + pull[2 * ROWS - 1].x;
  assert_float_equal (sum, -0.5 * 0.4 * 2.85, 0.05 * 0.5 * 0.4 * 2.85);
}

/* A clock that is late by three rows, in which the end goes 30 mm, shows what was three rows
   before, but for the first step after rest.  */
static void
clock_shifts (void **state)
{
  (void)state;
  static led_rows r;
  const double middle[] = { 1.425 };
  static bt_vec3 early[ROWS], late[ROWS], pull[2 * ROWS];
  bt_lead_line line = rope (20);
  make_rows (&r, 60, (bt_vec3){ 0, 0, 0 }, (bt_vec3){ 1.5, 0, -0.6 }, 0.2);
  assert_int_equal (bt_lead (&line, &r.track, &at_rest, middle, 1, early, pull, NULL, NULL, NULL),
                    BT_OK);
  r.track.clock = 0.15;
  assert_int_equal (bt_lead (&line, &r.track, &at_rest, middle, 1, late, pull, NULL, NULL, NULL),
                    BT_OK);
  for (int k = 3; k < 60; k++)
    assert_float_equal (late[k].x, early[k - 3].x, 5e-4);
}

static int
at_once (void *user, double share)
{
  (void)user;
  return share >= 0;
}

/* A line that leaves its clamps by a tilt lies as if the clamps were turned so: toward the first
   director, which is north turned from straight down, and the second.  */
static void
tilts_its_clamps (void **state)
{
  enum
  {
    N = 12
  };
  static led_rows r;
  static bt_vec3 along[2][N];
  (void)state;
  bt_vec3 place[2][N], pull[2 * N], east = { 1, 0, 0 };
  double mark = 1.2, tilt[2][2] = { { 0.2, -0.3 }, { -0.1, 0.4 } };
  bt_error error;
  bt_lead_line line = rope (20);
  line.clamped = 1;
  line.props.ei = 0.01;
  for (int by_tilt = 0; by_tilt < 2; by_tilt++)
    {
      make_rows (&r, N, (bt_vec3){ 0, 0, 0 }, (bt_vec3){ 2.4, 0, 0 }, -0.3);
      for (int e = 0; e < 2; e++)
        {
          for (int k = 0; k < N; k++) /* down turned to east: north stays, the second is up */
            along[e][k] = by_tilt ? east : (bt_vec3){ 1, tan (tilt[e][0]), tan (tilt[e][1]) };
          r.track.direction[e] = along[e];
          for (int c = 0; c < 2; c++)
            line.tilt[e][c] = by_tilt ? tilt[e][c] : 0;
        }
      assert_int_equal (
          bt_lead (&line, &r.track, &at_rest, &mark, 1, place[by_tilt], pull, NULL, NULL, &error),
          BT_OK);
    }
  for (int k = 0; k < N; k++)
    assert_true (hypot (hypot (place[0][k].x - place[1][k].x, place[0][k].y - place[1][k].y),
                        place[0][k].z - place[1][k].z)
                 < 1e-7);
  assert_true (fabs (place[0][N - 1].y) > 1e-3);
}

static void
refuses (void **state)
{
  (void)state;
  static led_rows r;
  bt_vec3 pull[40];
  bt_error error;
  bt_lead_line line = rope (20);
  make_rows (&r, 10, (bt_vec3){ 0, 0, 0 }, (bt_vec3){ 1.5, 0, -0.6 }, 0.2);
  assert_int_equal (bt_lead (&line, &r.track, &at_rest, NULL, 0, NULL, pull, at_once, NULL, &error),
                    BT_ERR_INTERRUPTED);
  line.intervals = 1;
  assert_int_equal (bt_lead (&line, &r.track, &at_rest, NULL, 0, NULL, pull, NULL, NULL, &error),
                    BT_ERR_LIMIT);
  line.intervals = 20;
  line.props.mass *= 1e-3;
  assert_int_equal (bt_lead (&line, &r.track, &at_rest, NULL, 0, NULL, pull, NULL, NULL, &error),
                    BT_ERR_DOMAIN);
  line.props.mass *= 1e3;
  r.t[4] = r.t[3];
  assert_int_equal (bt_lead (&line, &r.track, &at_rest, NULL, 0, NULL, pull, NULL, NULL, &error),
                    BT_ERR_DOMAIN);
  r.t[4] = 0.2;
  line.props.ea = -1;
  assert_int_not_equal (
      bt_lead (&line, &r.track, &at_rest, NULL, 0, NULL, pull, NULL, NULL, &error), BT_OK);
}

int
main (void)
{
  const struct CMUnitTest tests[]
      = { cmocka_unit_test (hangs_as_irvine_says), cmocka_unit_test (drags_over_a_floor),
          cmocka_unit_test (clock_shifts), cmocka_unit_test (tilts_its_clamps),
          cmocka_unit_test (refuses) };
  cmocka_set_message_output (CM_OUTPUT_TAP);
  return cmocka_run_group_tests (tests, NULL, NULL);
}
