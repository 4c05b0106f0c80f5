/* Several equilibria of one line: a search from several sides.

   The line is bent as a catenary to each of six sides (along the load, against the load, both sides
   across, up, down) and relaxed; every new shape at rest is kept.  Bows toward the load mostly fall
   into the same shape; a slack line in a sheared or turning current may have further equilibria.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <string.h>

#include "base/error.h"
#include "tether/steady.h"

#define DISTINCT 0.01 /* of the length: farther apart than this is another shape */

enum
{
  SIDES = 6,
  SOLVES = 600
};

/* Bend a line of LENGTH from A to B toward the unit vector SIDE into N + 1 nodes R.  */
static void
bow (bt_vec3 a, bt_vec3 b, double length, bt_vec3 side, int n, bt_vec3 *r)
{
  bt_vec3 chord = bt__sub (b, a);
  double v = -bt__dot (chord, side);
  bt_vec3 across = bt__axpy (chord, v, side);
  double h = bt__norm (across);
  bt_vec3 skew = fabs (side.z) < 0.9 ? bt__vec (0, 0, 1) : bt__vec (1, 0, 0);
  across = bt__unit_or (across, bt__unit_or (bt__cross (side, skew), skew));
  bt_catenary c;
  /* A folded line is opened a little: its legs must not lie upon each other.  */
  int curved
      = bt_catenary_solve (fmax (h, 1e-3 * length), v, length, &c, NULL) == BT_OK && isfinite (c.a);
  for (int i = 0; i <= n; i++)
    {
      bt_point2 p = { 0, 0 };
      if (curved)
        p = bt_catenary_point (&c, length * i / n);
      r[i] = curved ? bt__axpy (bt__axpy (a, p.x, across), -p.y, side)
                    : bt__axpy (a, (double)i / n, chord);
    }
}

static void
set_sides (const bt_line *line, const bt_water *water, bt_vec3 a, bt_vec3 b, bt_vec3 side[SIDES])
{
  bt__loads k;
  bt__loads_set (&k, line, water, a);
  bt_vec3 u = bt_water_mean_velocity (water, a, b), down = { 0, 0, -1 };
  bt_vec3 load = bt__scale (k.kn * bt__norm (u), u);
  load.z -= k.w;
  load = bt__unit_or (load, down);
  bt_vec3 cross = bt__cross (bt__unit_or (bt__sub (b, a), bt__vec (1, 0, 0)), load);
  cross = bt__unit_or (cross, fabs (load.x) < 0.9 ? bt__vec (1, 0, 0) : bt__vec (0, 1, 0));
  side[0] = load;
  side[1] = bt__scale (-1, load);
  side[2] = cross;
  side[3] = bt__scale (-1, cross);
  side[4] = down;
  side[5] = bt__scale (-1, down);
}

static int
is_new_shape (const bt_vec3 *r, int n, const bt_vec3 *shapes, int found, double apart)
{
  for (int k = 0; k < found; k++)
    {
      double most = 0;
      for (int i = 0; i <= n; i++)
        most = fmax (most, bt__distance (r[i], shapes[(size_t)k * ((size_t)n + 1) + (size_t)i]));
      if (most <= apart)
        return 0;
    }
  return 1;
}

bt_status
bt_steady_equilibria (bt_steady *steady, const bt_line *line, const bt_water *water, bt_vec3 a,
                      bt_vec3 b, int n, int max, bt_vec3 *shapes, int *found, bt_error *error)
{
  bt_vec3 side[SIDES], *r;
  bt_status room = bt__steady_room (steady, n, error);
  *found = 0;
  if (room != BT_OK)
    return room;
  r = steady->shape;
  set_sides (line, water, a, b, side);
  for (int i = 0; i < SIDES && *found < max && !bt__ask (steady->asker); i++)
    {
      bt_steady_report report;
      bow (a, b, line->length, side[i], n, r);
      bt_status status = bt_steady_relax (steady, line, water, a, b, n, SOLVES, r, steady->tensions,
                                          &report, error);
      if (status != BT_OK)
        return status;
      if (!report.converged || !is_new_shape (r, n, shapes, *found, DISTINCT * line->length))
        continue;
      memcpy (shapes + (size_t)*found * ((size_t)n + 1), r, ((size_t)n + 1) * sizeof *r);
      ++*found;
    }
  return BT_OK;
}
