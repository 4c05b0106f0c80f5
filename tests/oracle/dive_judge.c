/* See dive_judge.h.

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

#include "dive_judge.h"
#include "math/vec.h"
#include "sim/sim.h"
#include "testbed/sweep.h"
#include "world/line.h"

enum
{
  RING = 6
};

/* ---- What the judge sees ---- */

/* The frame that what has a track is drawn in: for an axis its middle, unturned.  */
static bt__frame
frame_of (const bt_dive *dive, int obstacle)
{
  int k = bt__model_carried (dive->model, obstacle);
  bt__frame still = { { 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 }, { 0, 0, 1 } };
  if (k < 0)
    return still;
  bt_obstacle_view view;
  assert_int_equal (bt_dive_obstacle (dive, obstacle, &view, NULL), BT_OK);
  still.origin = bt__scale (0.5, bt__add (view.from, view.to));
  return still;
}

void
look (const bt_dive *dive, sight *sight)
{
  memset (sight->n, 0, sizeof sight->n);
  for (int i = 0; i < bt_dive_count (dive, BT_PART_TETHER); i++)
    {
      bt_tether_view view;
      assert_int_equal (bt_dive_tether (dive, i, &view, NULL), BT_OK);
      assert_true (view.nodes <= POINTS);
      sight->n[2 * i] = view.nodes;
      assert_int_equal (bt_tether_points (dive, i, 0, sight->x[2 * i], NULL), BT_OK);
      if (view.parted)
        sight->n[2 * i + 1] = bt_tether_tail (dive, i, sight->x[2 * i + 1], POINTS);
    }
  for (int o = 0; o < bt_dive_count (dive, BT_PART_OBSTACLE); o++)
    sight->mover[o] = frame_of (dive, o);
}

/* ---- Has it passed through?  ---- */

/* Where the corners of the N points X lie, 0 to 1 by arc length.  */
static void
measure (const bt_vec3 *x, int n, double *u)
{
  u[0] = 0;
  for (int i = 1; i < n; i++)
    u[i] = u[i - 1] + fmax (bt__distance (x[i - 1], x[i]), 1e-12);
  for (int i = n - 1; i >= 0; i--)
    u[i] /= u[n - 1];
}

/* Put the corners of the other among those of X; return how many there are now.  */
static int
refine (const bt_vec3 *x, const double *u, int n, const double *v, int m, bt_vec3 *out)
{
  int count = 0, j = 1;
  out[count++] = x[0];
  for (int i = 1; i < n; i++)
    {
      for (; j < m - 1 && v[j] < u[i]; j++)
        if (v[j] > u[i - 1])
          out[count++] = bt__axpy (x[i - 1], (v[j] - u[i - 1]) / (u[i] - u[i - 1]),
                                   bt__sub (x[i], x[i - 1]));
        else
          out[count++] = x[i - 1];
      out[count++] = x[i];
      if (j < m - 1 && v[j] == u[i])
        out[count++] = x[i], j++;
    }
  for (; j < m - 1; j++)
    out[count++] = x[n - 1];
  return count;
}

/* The two lines FROM and TO with as many points each: every corner of both is in both.  */
static int
match (const bt_vec3 *from, int n, const bt_vec3 *to, int m, bt_vec3 *a, bt_vec3 *b)
{
  static double u[POINTS], v[POINTS];
  if (n == m)
    {
      memcpy (a, from, sizeof *a * (size_t)n);
      memcpy (b, to, sizeof *b * (size_t)n);
      return n;
    }
  measure (from, n, u);
  measure (to, m, v);
  int p = refine (from, u, n, v, m, a), q = refine (to, v, m, u, n, b);
  while (p < q)
    a[p++] = from[n - 1];
  while (q < p)
    b[q++] = to[m - 1];
  return p;
}

/* A ring that closes the endless axis A B far away.  */
static void
close_ring (bt_vec3 a, bt_vec3 b, bt_vec3 ring[RING])
{
  bt_vec3 d = bt__unit_or (bt__sub (b, a), a), out = bt__scale (5000, bt__across (d));
  ring[0] = bt__axpy (a, -2000, d);
  ring[1] = a;
  ring[2] = b;
  ring[3] = bt__axpy (b, 2000, d);
  ring[4] = bt__add (ring[3], out);
  ring[5] = bt__add (ring[0], out);
}

/* How often the line went through the axis of post DEF in all: what lies between the two sights is
   a path round nothing, or through it.  */
static int
passages (const bt_obstacle_def *def, const bt__frame *f, const bt__frame *g, const bt_vec3 *from,
          int n, const bt_vec3 *to, int m)
{
  static bt_vec3 a[2 * POINTS], b[2 * POINTS];
  bt_vec3 half = bt__scale (0.5, bt__sub (def->to, def->from));
  bt_vec3 middle = bt__scale (0.5, bt__add (def->to, def->from)), ring[RING];
  int k = match (from, n, to, m, a, b), moves = def->track.n > 0;
  sweep_segment axis = moves ? (sweep_segment){ bt__scale (-1, half), half }
                             : (sweep_segment){ bt__sub (middle, half), bt__add (middle, half) };
  for (int i = 0; i < k; i++)
    {
      a[i] = bt__to_local (f, a[i]);
      b[i] = bt__to_local (g, b[i]);
    }
  if (sweep_crossings (a, b, k, &axis) == 0)
    return 0;
  close_ring (axis.a, axis.b, ring);
  return (int)lround (fabs (sweep_linking (a, b, k, ring, RING)));
}

static void
tell_passage (const judge *j, const bt_dive *dive, int part, int o)
{
  if (getenv ("BIGHT_TELL"))
    printf ("# t %.3f part %d went through %s\n", bt_dive_time (dive), part,
            j->scene->obstacle[o].name);
}

bt__link
axis_of (const scene *s, const sight *sight, int o)
{
  const bt_obstacle_def *def = &s->obstacle[o];
  bt_vec3 half = bt__scale (0.5, bt__sub (def->to, def->from));
  bt_vec3 middle
      = def->track.n > 0 ? sight->mover[o].origin : bt__scale (0.5, bt__add (def->from, def->to));
  return (bt__link){ bt__sub (middle, half), bt__add (middle, half) };
}

/* The distance of LINK from the axis of an endless post.  */
static double
line_distance (const bt__link *axis, const bt__link *link)
{
  bt_vec3 d = bt__unit_or (bt__sub (axis->b, axis->a), axis->a);
  bt_vec3 p = bt__sub (link->a, axis->a), q = bt__sub (link->b, axis->a);
  bt_vec3 way, at;
  double t, size;
  p = bt__axpy (p, -bt__dot (p, d), d);
  q = bt__axpy (q, -bt__dot (q, d), d);
  way = bt__sub (q, p);
  size = bt__dot (way, way);
  t = size > 0 ? fmax (0, fmin (1, -bt__dot (p, way) / size)) : 0;
  at = bt__axpy (p, t, way);
  return bt__norm (at);
}

/* Nonzero if the way that end END of part P went in an operation may have led round post O, not
   straight: it slides along what it meets.  */
static int
may_have_slid (const judge *j, int p, int o, int end)
{
  bt__link axis = axis_of (j->scene, j->is, o);
  bt__link way
      = { j->was->x[p][end ? j->was->n[p] - 1 : 0], j->is->x[p][end ? j->is->n[p] - 1 : 0] };
  return line_distance (&axis, &way) < j->scene->obstacle[o].radius + 1.5;
}

/* The free end of a parted line goes nobody knows where in an operation, which takes no time.  */
static int
can_tell (const judge *j, int p)
{
  const int *was = &j->was->n[2 * (p / 2)], *is = &j->is->n[2 * (p / 2)];
  return j->was->n[p] > 1 && j->is->n[p] > 1 && (was[1] == 0) == (is[1] == 0)
         && (was[1] == 0 || j->in_step);
}

static void
judge_passages (judge *j, const bt_dive *dive)
{
  for (int p = 0; p < PARTS; p++)
    for (int o = 0; can_tell (j, p) && o < bt_dive_count (dive, BT_PART_OBSTACLE); o++)
      {
        int blind = !j->in_step && (may_have_slid (j, p, o, 0) || may_have_slid (j, p, o, 1));
        int n = j->excused[p / 2][o] || blind
                    ? 0
                    : passages (&j->scene->obstacle[o], &j->was->mover[o], &j->is->mover[o],
                                j->was->x[p], j->was->n[p], j->is->x[p], j->is->n[p]);
        if (n > 0)
          tell_passage (j, dive, p, o);
        j->crossings += n;
      }
}

/* ---- How near is it?  ---- */

static void
judge_clearance (judge *j, const bt_dive *dive)
{
  const scene *s = j->scene;
  for (int p = 0; p < PARTS; p++)
    for (int o = 0; o < bt_dive_count (dive, BT_PART_OBSTACLE) && j->is->n[p]; o++)
      {
        bt__link axis = axis_of (s, j->is, o);
        double core = s->tether[p / 2].props.diameter / 4;
        for (int i = 0; !j->excused[p / 2][o] && i + 1 < j->is->n[p]; i++)
          {
            bt__link link = { j->is->x[p][i], j->is->x[p][i + 1] };
            double gap = line_distance (&axis, &link) - s->obstacle[o].radius - core;
            if (gap < -ROUNDING && j->least >= -ROUNDING && getenv ("BIGHT_TELL"))
              printf ("# t %.3f part %d link %d in %s by %g\n", bt_dive_time (dive), p, i,
                      s->obstacle[o].name, -gap);
            j->least = fmin (j->least, gap);
          }
      }
}

static bt_vec3
blend (double a, bt_vec3 u, double b, bt_vec3 v)
{
  return bt__axpy (bt__scale (a, u), b, v);
}

/* The hull as it is turned: by heading, then bow up, then starboard down.  */
bt__box
hull_of (const scene *s, int i, const bt_vehicle_view *v)
{
  double c = cos (v->heading), k = sin (v->heading);
  bt_vec3 right = { c, -k, 0 }, ahead = { k, c, 0 }, up = { 0, 0, 1 };
  bt_vec3 bow = blend (cos (v->pitch), ahead, sin (v->pitch), up);
  bt_vec3 mast = blend (cos (v->pitch), up, -sin (v->pitch), ahead);
  bt_vec3 beam = blend (cos (v->roll), right, -sin (v->roll), mast);
  mast = blend (cos (v->roll), mast, sin (v->roll), right);
  return (bt__box){ { v->position, beam, bow, mast }, bt__scale (0.5, s->vehicle[i].size) };
}

/* The axis is longer than the sampling of a brute search likes: the part about the hull.  */
bt__link
part_of_axis (const bt__link *axis, bt_vec3 p)
{
  bt_vec3 d = bt__unit_or (bt__sub (axis->b, axis->a), axis->a);
  bt_vec3 c = bt__axpy (axis->a, bt__dot (bt__sub (p, axis->a), d), d);
  return (bt__link){ bt__axpy (c, -3, d), bt__axpy (c, 3, d) };
}

static void
note_hull (judge *j, const bt_dive *dive, int i, int o, double gap)
{
  if (gap <= 0 && j->least_hull > 0 && getenv ("BIGHT_TELL"))
    printf ("# t %.3f hull of %s in %s by %g\n", bt_dive_time (dive), j->scene->vehicle[i].name,
            j->scene->obstacle[o].name, -gap);
  j->least_hull = fmin (j->least_hull, gap);
}

static void
judge_hulls (judge *j, const bt_dive *dive)
{
  for (int i = 0; i < bt_dive_count (dive, BT_PART_VEHICLE); i++)
    for (int o = 0; o < bt_dive_count (dive, BT_PART_OBSTACLE); o++)
      {
        bt_vehicle_view view;
        bt__link axis = axis_of (j->scene, j->is, o), part;
        assert_int_equal (bt_dive_vehicle (dive, i, &view, NULL), BT_OK);
        solid hull = { .kind = SOLID_BOX, .box = hull_of (j->scene, i, &view) };
        part = part_of_axis (&axis, view.position);
        if (!j->excused_hull[i][o])
          note_hull (j, dive, i, o, solid_brute (&hull, &part) - j->scene->obstacle[o].radius);
      }
}

/* ---- Does it hold together?  ---- */

static void
judge_stretch (judge *j, const bt_dive *dive, int i)
{
  bt__line line = bt__line_of (dive, dive->now, i);
  const bt__polyline *p = line.split             ? bt__thesis_line (line.split)
                          : line.tether->blocked ? line.held
                                                 : NULL; /* the shape may still be looked for */
  double most = 0;
  for (int64_t k = 0; p && k + 1 < p->n; k++)
    {
      const bt_vec3 *x = bt__polyline_x ((bt__polyline *)p);
      const double *u = bt__polyline_u ((bt__polyline *)p);
      most = fmax (most, (bt__distance (x[k], x[k + 1]) - 1e-9) / fmax (u[k + 1] - u[k], 1e-12));
    }
  j->stretch = fmax (j->stretch, most);
  j->stretched += most > j->most_stretch;
}

static int
follows (const bt_dive *dive, int vehicle)
{
  return vehicle >= 0 && bt__dive_vehicle (dive, dive->now, vehicle)->rigid;
}

static void
note_apart (judge *j, const bt_dive *dive, int i, int k, double gap)
{
  if (j->apart++ == 0 && getenv ("BIGHT_TELL"))
    printf ("# t %.3f end %d of line %d is apart by %g\n", bt_dive_time (dive), k, i, gap);
}

static void
judge_ends (judge *j, const bt_dive *dive, int i)
{
  const bt__tether *tether = bt__dive_tether (dive, dive->now, i);
  for (int k = 0; k < 2; k++)
    {
      const bt__end *end = &dive->model->ends[i][k];
      int part = 2 * i + (k && tether->parted), n = j->is->n[part];
      bt_vec3 at = j->is->x[part][k ? n - 1 : 0], wanted = end->at;
      if (end->vehicle >= 0)
        wanted = bt__attachment (dive, dive->now, end->vehicle);
      /* A body follows its line as exactly as the step is exact.  */
      if (!(bt__distance (at, wanted) < (follows (dive, end->vehicle) ? 1e-3 : 1e-5)))
        note_apart (j, dive, i, k, bt__distance (at, wanted));
    }
}

static void
judge_numbers (judge *j)
{
  for (int p = 0; p < PARTS; p++)
    for (int i = 0; i < j->is->n[p]; i++)
      j->not_finite += !bt__is_finite (j->is->x[p][i]);
}

void
look_again (judge *j, const bt_dive *dive, int in_step)
{
  sight *old = j->was;
  j->in_step = in_step;
  j->was = j->is;
  j->is = old;
  look (dive, j->is);
  judge_numbers (j);
  judge_passages (j, dive);
  for (int i = 0; i < bt_dive_count (dive, BT_PART_TETHER); i++)
    {
      judge_stretch (j, dive, i);
      judge_ends (j, dive, i);
    }
  if (j->looks++ % 4 == 0)
    judge_clearance (j, dive);
  if (j->looks % 2 == 0)
    judge_hulls (j, dive);
}

void
begin_judging (judge *j, const scene *s, const bt_dive *dive)
{
  memset (j, 0, sizeof *j);
  j->scene = s;
  j->was = calloc (1, sizeof *j->was);
  j->is = calloc (1, sizeof *j->is);
  assert_non_null (j->was);
  assert_non_null (j->is);
  j->most_stretch = 1.01;
  j->least = j->least_hull = INFINITY;
  look (dive, j->is);
}

void
end_judging (judge *j)
{
  free (j->was);
  free (j->is);
}

void
acquit (const judge *j, const char *name)
{
  if (j->crossings || j->stretched || j->apart || j->not_finite || !(j->least > -ROUNDING)
      || !(j->least_hull > 0))
    fail_msg ("%s: %ld crossings, %ld stretched (%g), %ld ends apart, %ld not finite, clearance "
              "%g, hull %g",
              name, j->crossings, j->stretched, j->stretch, j->apart, j->not_finite, j->least,
              j->least_hull);
}
