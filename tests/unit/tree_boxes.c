/* The boxes of the trees over obstacles' triangles, and the taut string itself, as pictures ask for
   them: the boxes of every level hold all triangles and lie within those above, in pieces as at
   once, still and on a track.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include <bight/bight.h>

#include "math/vec.h"

enum
{
  AROUND = 30,
  ACROSS = 14,
  CORNERS = AROUND * ACROSS,
  TRIANGLES = 2 * CORNERS,
  BOXES = TRIANGLES
};

typedef struct rig
{
  bt_vec3 corner[CORNERS];
  uint32_t triangle[TRIANGLES][3];
  bt_vehicle_def vehicle;
  bt_tether_def tether;
  bt_obstacle_def torus;
  bt_model *model;
  bt_dive *dive;
} rig;

static uint32_t
number (int i, int j)
{
  return (uint32_t)(i % AROUND * ACROSS + j % ACROSS);
}

static void
build_torus (rig *r)
{
  for (int i = 0; i < AROUND; i++)
    for (int j = 0; j < ACROSS; j++)
      {
        double a = 2 * BT__PI * i / AROUND, b = 2 * BT__PI * j / ACROSS, d = 2 + 0.7 * cos (b);
        uint32_t k = number (i, j), next = number (i + 1, j + 1);
        uint32_t first[3] = { k, number (i + 1, j), next },
                 second[3] = { k, next, number (i, j + 1) };
        r->corner[k] = bt__vec (d * cos (a), d * sin (a), 0.7 * sin (b));
        for (int c = 0; c < 3; c++)
          {
            r->triangle[2 * k][c] = first[c];
            r->triangle[2 * k + 1][c] = second[c];
          }
      }
}

/* A torus 5 m below a straight tether, or on TRACK.  */
static rig *
new_rig (const bt_rows *track)
{
  rig *r = calloc (1, sizeof *r);
  bt_world world = { .vehicles = &r->vehicle,
                     .n_vehicles = 1,
                     .tethers = &r->tether,
                     .n_tethers = 1,
                     .obstacles = &r->torus,
                     .n_obstacles = 1 };
  bt_error error;
  build_torus (r);
  bt_def_init (bt_head_find ("sea"), &world.sea);
  bt_def_init (bt_head_find ("rov"), &r->vehicle);
  bt_def_init (bt_head_find ("tether"), &r->tether);
  bt_def_init (bt_head_find ("mesh"), &r->torus);
  strcpy (r->vehicle.name, "rov");
  strcpy (r->tether.name, "line");
  strcpy (r->tether.to.part, "rov");
  strcpy (r->torus.name, "torus");
  world.sea.depth = 40;
  r->vehicle.at = bt__vec (4, 0, -5);
  r->tether.from.at = bt__vec (-4, 0, -5);
  r->tether.length = 9;
  r->torus.at = bt__vec (0, 0, -10);
  r->torus.heading = 25;
  r->torus.mesh
      = (bt_triangles){ r->corner, CORNERS, (const uint32_t (*)[3])r->triangle, TRIANGLES, NULL };
  if (track)
    r->torus.track = *track;
  if (bt_model_new (&world, &r->model, &error) != BT_OK
      || bt_dive_new (r->model, NULL, NULL, &r->dive, &error) != BT_OK)
    fail_msg ("%s", error.text);
  return r;
}

static void
free_rig (rig *r)
{
  bt_dive_free (r->dive);
  bt_model_release (r->model);
  free (r);
}

/* Is P in BOX, whose sides lie along AXES?  */
static int
holds (const bt_tree_box *box, const bt_vec3 axes[3], bt_vec3 p)
{
  const double half[3] = { box->half.x, box->half.y, box->half.z };
  int in = 1;
  for (int k = 0; k < 3; k++)
    in = in && fabs (bt__dot (bt__sub (p, box->centre), axes[k])) <= half[k] + 1e-6;
  return in;
}

static int
holds_all (const bt_tree_box *box, const bt_vec3 axes[3], const bt_facet *facet)
{
  return holds (box, axes, facet->corner[0]) && holds (box, axes, facet->corner[1])
         && holds (box, axes, facet->corner[2]);
}

/* Every triangle lies in a box of LEVEL; what it gives at once it gives in pieces.  Return how many
   boxes.  */
static size_t
check_level (rig *r, int level, const bt_vec3 axes[3])
{
  static bt_facet facet[TRIANGLES];
  static bt_tree_box box[BOXES], piece[7];
  size_t n = bt_obstacle_boxes (r->dive, 0, level, 0, BOXES, box), got, done = 0;
  assert_int_equal (bt_obstacle_triangles (r->dive, 0, 0, TRIANGLES, facet), TRIANGLES);
  for (int i = 0; i < TRIANGLES; i++)
    {
      int held = 0;
      for (size_t k = 0; k < n && !held; k++)
        held = holds_all (&box[k], axes, &facet[i]);
      assert_true (held);
    }
  for (; (got = bt_obstacle_boxes (r->dive, 0, level, done, 7, piece)) > 0; done += got)
    for (size_t k = 0; k < got; k++)
      assert_true (bt__distance (piece[k].centre, box[done + k].centre) == 0);
  assert_int_equal (done, n);
  return n;
}

static void
check_levels (rig *r)
{
  bt_obstacle_view view;
  int levels = bt_obstacle_levels (r->dive, 0);
  size_t before = 0, n = 0;
  assert_true (levels >= 4); /* 840 triangles, at most 4 in a leaf, 8 to a node */
  assert_int_equal (bt_dive_obstacle (r->dive, 0, &view, NULL), BT_OK);
  for (int level = 0; level < levels; level++)
    {
      n = check_level (r, level, view.axes);
      assert_true (n > before && n <= 8 * (before ? before : 1));
      before = n;
    }
  assert_true (n >= TRIANGLES / 4);
  assert_int_equal (check_level (r, levels, view.axes), n); /* below there is nothing more */
}

static void
every_level_holds_all (void **state)
{
  rig *r = new_rig (NULL);
  (void)state;
  check_levels (r);
  free_rig (r);
}

static void
they_move_along (void **state)
{
  static const double row[][5] = { { 0, 0, 0, -20, 0 }, { 100, 30, 0, -20, 90 } };
  const bt_rows track = { row[0], 2, 5 };
  rig *r = new_rig (&track);
  bt_tree_box begun, now;
  (void)state;
  bt_obstacle_boxes (r->dive, 0, 0, 0, 1, &begun);
  for (int i = 0; i < 600; i++)
    assert_int_equal (bt_dive_step (r->dive, NULL), BT_OK);
  bt_obstacle_boxes (r->dive, 0, 0, 0, 1, &now);
  assert_true (bt__distance (begun.centre, now.centre) > 2.5);
  check_levels (r);
  free_rig (r);
}

static void
what_has_none (void **state)
{
  rig *r = new_rig (NULL);
  bt_tree_box box;
  (void)state;
  assert_int_equal (bt_obstacle_levels (r->dive, 1), 0);
  assert_int_equal (bt_obstacle_boxes (r->dive, 1, 0, 0, 1, &box), 0);
  assert_int_equal (bt_obstacle_boxes (r->dive, 0, -1, 0, 1, &box), 0);
  assert_int_equal (bt_obstacle_boxes (r->dive, 0, 0, 0, 0, &box), 0);
  assert_int_equal (bt_obstacle_boxes (r->dive, 0, 0, 1, 1, &box), 0);
  free_rig (r);
}

/* Nothing holds the string: it is the chord, as long as it is said to be.  */
static void
the_string (void **state)
{
  rig *r = new_rig (NULL);
  bt_vec3 p[64];
  double length, sum = 0;
  int n = 0;
  (void)state;
  assert_int_equal (bt_tether_taut_string (r->dive, 0, p, 64, &n, NULL), BT_OK);
  assert_int_equal (bt_tether_taut_length (r->dive, 0, &length, NULL), BT_OK);
  for (int k = 1; k < n; k++)
    sum += bt__distance (p[k - 1], p[k]);
  assert_true (n >= 2 && fabs (sum - length) < 1e-9 && fabs (sum - 8) < 1e-6);
  assert_true (bt__distance (p[0], r->tether.from.at) < 1e-9);
  assert_true (bt__distance (p[n - 1], r->vehicle.at) < 1e-9);
  assert_int_equal (bt_tether_taut_string (r->dive, 0, p, 1, &n, NULL), BT_OK);
  assert_int_equal (n, 1);
  assert_int_equal (bt_tether_taut_string (r->dive, 1, p, 64, &n, NULL), BT_ERR_NAME);
  free_rig (r);
}

int
main (void)
{
  const struct CMUnitTest tests[] = {
    cmocka_unit_test (every_level_holds_all),
    cmocka_unit_test (they_move_along),
    cmocka_unit_test (what_has_none),
    cmocka_unit_test (the_string),
  };
  return cmocka_run_group_tests (tests, NULL, NULL);
}
