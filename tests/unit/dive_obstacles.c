/* Dives among obstacles, under the eyes of a judge that shares nothing with the engine: exact
   predicates on what the line swept, linking numbers about what it may not pass, brute force for
   the distances.

   Every model, hulls, masses, several tethers, jumps of 20 m, flights at 20 m/s, winch, cuts, other
   models while wound, forks and checkpoints in the middle.  With all pairs switched off the judge
   must cry out.

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

#include <bight/bight.h>

#include "../oracle/solids.h"
#include "../oracle/sweep.h"
#include "math/vec.h"
#include "world/line.h"

enum
{
  OBSTACLES = 10,
  LINES = 2,
  PARTS = 2 * LINES, /* a parted line is two */
  POINTS = 2000,
  RING = 6,
  EDGES = 12
};

/* The safe step finds its way from below by casts to a hundredth of a micrometre.  */
#define ROUNDING 1e-9

/* ---- Worlds ---- */

typedef struct scene
{
  bt_world world;
  bt_vehicle_def vehicle[2];
  bt_tether_def tether[LINES];
  bt_obstacle_def obstacle[OBSTACLES];
  double track[2][60];
} scene;

static bt_obstacle_def *
add (scene *s, const char *head, const char *name)
{
  bt_obstacle_def *def = &s->obstacle[s->world.n_obstacles++];
  assert_true (s->world.n_obstacles <= OBSTACLES);
  bt_def_init (bt_head_find (head), def);
  assert_int_equal (bt_def_set_name (def->name, name, NULL), BT_OK);
  return def;
}

static void
add_post (scene *s, const char *head, const char *name, bt_vec3 middle, bt_vec3 axis, double radius)
{
  bt_obstacle_def *def = add (s, head, name);
  def->from = bt__axpy (middle, -200, axis);
  def->to = bt__axpy (middle, 200, axis);
  def->radius = radius;
}

/* It goes to and fro by WAY from MIDDLE, a whole time in SECONDS.  */
static void
send (scene *s, bt_obstacle_def *def, int k, bt_vec3 middle, bt_vec3 way, double seconds)
{
  for (int i = 0; i < 12; i++)
    {
      bt_vec3 p = bt__axpy (middle, i % 2 ? 1 : -1, way);
      double *row = s->track[k] + 5 * i;
      row[0] = seconds / 2 * i;
      row[1] = p.x;
      row[2] = p.y;
      row[3] = p.z;
      row[4] = 0;
    }
  def->track = (bt_rows){ s->track[k], 12, 5 };
}

/* A slack line from (-8 -8 -6) to a vehicle 16 m east of there, in a current to the north.  */
static void
begin_scene (scene *s, bt_model_kind model)
{
  memset (s, 0, sizeof *s);
  bt_def_init (bt_head_find ("sea"), &s->world.sea);
  s->world.sea.depth = 300;
  s->world.sea.current.kind = BT_CURRENT_UNIFORM;
  s->world.sea.current.velocity[0] = (bt_vec3){ 0.05, 0.3, 0 };
  for (int i = 0; i < 2; i++)
    {
      bt_def_init (bt_head_find ("rov"), &s->vehicle[i]);
      bt_def_init (bt_head_find ("tether"), &s->tether[i]);
      s->tether[i].length = 30;
      s->tether[i].props.nodes = 24;
      s->tether[i].props.wet_weight = 0;
      s->tether[i].props.model = model;
      s->tether[i].props.response = BT_RESPONSE_THESIS;
    }
  bt_def_set_name (s->vehicle[0].name, "minnow", NULL);
  bt_def_set_name (s->vehicle[1].name, "garage", NULL);
  bt_def_set_name (s->tether[0].name, "line", NULL);
  bt_def_set_name (s->tether[1].name, "umbilical", NULL);
  bt_def_set_name (s->tether[0].to.part, "minnow", NULL);
  s->vehicle[0].at = (bt_vec3){ 8, -8, -6 };
  s->tether[0].from.at = (bt_vec3){ -8, -8, -6 };
  s->world.vehicles = s->vehicle;
  s->world.n_vehicles = 1;
  s->world.tethers = s->tether;
  s->world.n_tethers = 1;
  s->world.obstacles = s->obstacle;
}

/* Endless posts, so that whether a line has passed one is a number.  */
static void
plant_wood (scene *s)
{
  bt_vec3 up = { 0, 0, 1 };
  add_post (s, "cylinder", "leg", bt__vec (0, 0, 0), up, 0.6);
  add_post (s, "capsule", "wire", bt__vec (3, -3, 0), up, 0.01);
  add_post (s, "capsule", "brace", bt__vec (0, 3, -4), bt__vec (0.8, 0, 0.6), 0.25);
  add_post (s, "cylinder", "pipe", bt__vec (0, -4, -9), bt__vec (1, 0, 0), 0.3);
  add_post (s, "capsule", "pile", bt__vec (-4, 4, 0), up, 0.45);
}

static void
add_movers (scene *s)
{
  bt_vec3 up = { 0, 0, 1 };
  add_post (s, "capsule", "boom", bt__vec (5, 0, 0), up, 0.2);
  send (s, &s->obstacle[s->world.n_obstacles - 1], 0, bt__vec (5, 0, 0), bt__vec (2, 5, 0), 9);
  add_post (s, "cylinder", "chain", bt__vec (0, 0, -14), bt__vec (0, 1, 0), 0.1);
  send (s, &s->obstacle[s->world.n_obstacles - 1], 1, bt__vec (0, 0, -9), bt__vec (3, 0, 6), 14);
}

static void
give_hull (scene *s, int i, bt_vec3 size)
{
  s->vehicle[i].size = size;
}

/* The line comes from a second vehicle, on an umbilical of its own.  */
static void
hang_garage (scene *s)
{
  s->vehicle[1].at = (bt_vec3){ -8, -8, -6 };
  bt_def_set_name (s->tether[0].from.part, "garage", NULL);
  bt_def_set_name (s->tether[1].to.part, "garage", NULL);
  s->tether[1].from.at = (bt_vec3){ -12, -12, 2 };
  s->world.n_vehicles = s->world.n_tethers = 2;
}

/* A second line holds the same vehicle.  */
static void
tie_twice (scene *s)
{
  bt_def_set_name (s->tether[1].to.part, "minnow", NULL);
  s->tether[1].from.at = (bt_vec3){ 12, -12, -2 };
  s->world.n_tethers = 2;
}

static bt_dive *
enter (const scene *s)
{
  bt_model *model = NULL;
  bt_dive *dive = NULL;
  bt_error e = { 0 };
  if (bt_model_new (&s->world, &model, &e) != BT_OK
      || bt_dive_new (model, NULL, NULL, &dive, &e) != BT_OK)
    fail_msg ("%s", e.text);
  bt_model_release (model);
  return dive;
}

/* ---- What the judge sees ---- */

typedef struct sight
{
  int n[PARTS]; /* 0: there is no such part */
  bt_vec3 x[PARTS][POINTS];
  bt__frame mover[OBSTACLES];
} sight;

typedef struct judge
{
  const scene *scene;
  sight *was, *is;
  uint8_t excused[LINES][OBSTACLES]; /* the pair was off */
  uint8_t excused_hull[2][OBSTACLES];
  long looks, crossings, stretched, apart, not_finite;
  double least, least_hull; /* m: beyond half the radius; beyond touch */
  double stretch;
  int in_step; /* not an operation */
} judge;

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

static void
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

static bt__link
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
  bt__link way = { j->was->x[p][end ? j->was->n[p] - 1 : 0], j->is->x[p][end ? j->is->n[p] - 1 : 0] };
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
static bt__box
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
static bt__link
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
  const bt__polyline *p = line.split ? bt__thesis_line (line.split) : line.held;
  double most = 0;
  for (int64_t k = 0; p && k + 1 < p->n; k++)
    {
      const bt_vec3 *x = bt__polyline_x ((bt__polyline *)p);
      const double *u = bt__polyline_u ((bt__polyline *)p);
      most = fmax (most, (bt__distance (x[k], x[k + 1]) - 1e-9) / fmax (u[k + 1] - u[k], 1e-12));
    }
  j->stretch = fmax (j->stretch, most);
  j->stretched += most > 1.01;
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
      if (!(bt__distance (at, wanted) < (follows (dive, end->vehicle) ? 1e-3 : 1e-6)))
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

static void
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

static void
begin_judging (judge *j, const scene *s, const bt_dive *dive)
{
  memset (j, 0, sizeof *j);
  j->scene = s;
  j->was = calloc (1, sizeof *j->was);
  j->is = calloc (1, sizeof *j->is);
  assert_non_null (j->was);
  assert_non_null (j->is);
  j->least = j->least_hull = INFINITY;
  look (dive, j->is);
}

static void
end_judging (judge *j)
{
  free (j->was);
  free (j->is);
}

static void
acquit (const judge *j, const char *name)
{
  if (j->crossings || j->stretched || j->apart || j->not_finite || !(j->least > -ROUNDING)
      || !(j->least_hull > 0))
    fail_msg ("%s: %ld crossings, %ld stretched (%g), %ld ends apart, %ld not finite, clearance "
              "%g, hull %g",
              name, j->crossings, j->stretched, j->stretch, j->apart, j->not_finite, j->least,
              j->least_hull);
}

/* ---- What is done ---- */

static bt_status
operate (bt_dive *dive, bt_op op, int subject, int n, const double *args)
{
  bt_error e = { 0 };
  bt_status status = bt_dive_do (dive, op, subject, args, n, &e);
  assert_true (status == BT_OK || strlen (e.text) > 0);
  if (getenv ("BIGHT_TELL"))
    printf ("# t %.3f op %s subject %d: %g %g %g %g -> %s\n", bt_dive_time (dive),
            bt_op_describe (op)->name, subject, n > 0 ? args[0] : 0, n > 1 ? args[1] : 0,
            n > 2 ? args[2] : 0, n > 3 ? args[3] : 0, status == BT_OK ? "ok" : e.text);
  return status;
}

/* Nonzero if it went; the thesis' search alone may find nothing, and the dive then stands.  */
static int
step (bt_dive *dive)
{
  bt_error e = { 0 };
  bt_status status = bt_dive_step (dive, &e);
  if (status != BT_OK && !strstr (e.text, "search found no catenary"))
    fail_msg ("t = %g: %s", bt_dive_time (dive), e.text);
  return status == BT_OK;
}

static int
field_number (const char *head, const char *name)
{
  const bt_head *h = bt_head_find (head);
  const bt_field *field = bt_field_find (h, name);
  assert_non_null (field);
  return (int)(field - h->fields);
}

static bt_status
take_model (bt_dive *dive, int i, bt_model_kind model)
{
  return operate (dive, BT_OP_ALTER, i, 3,
                  (double[]){ BT_PART_TETHER, field_number ("tether", "model"), model });
}

typedef struct habits
{
  int jumps, winch, models, cut, pairs;
} habits;

static void
switch_pair (bt_dive *dive, judge *j, dice *d)
{
  int o = dice_below (d, bt_dive_count (dive, BT_PART_OBSTACLE));
  int part = dice_below (d, 2) ? BT_PART_VEHICLE : BT_PART_TETHER;
  if (operate (dive, BT_OP_COLLIDE, 0, 3, (double[]){ part, o, dice_below (d, 2) }) != BT_OK)
    return;
  (part == BT_PART_VEHICLE ? j->excused_hull : j->excused)[0][o] = 1;
}

/* Anywhere, or right beside an obstacle, or in it.  */
static bt_vec3
somewhere (const judge *j, dice *d)
{
  int o = dice_below (d, j->scene->world.n_obstacles);
  bt__link axis = axis_of (j->scene, j->is, o);
  bt_vec3 p = dice_point (d, 12);
  p.z = dice_between (d, -16, 0);
  if (dice_below (d, 2))
    {
      axis = part_of_axis (&axis, p);
      p = bt__add (bt__scale (0.5, bt__add (axis.a, axis.b)), dice_point (d, 1.5));
    }
  return p;
}

/* Something a pilot might do, and things no pilot would.  */
static void
do_something (bt_dive *dive, judge *j, dice *d, habits h)
{
  int v = dice_below (d, bt_dive_count (dive, BT_PART_VEHICLE));
  int t = dice_below (d, bt_dive_count (dive, BT_PART_TETHER));
  bt_vec3 p = somewhere (j, d);
  switch (dice_below (d, 9))
    {
    case 0:
    case 1:
      operate (dive, BT_OP_DRIVE, v, 4,
               (double[]){ dice_between (d, -1, 1), dice_between (d, -1, 1),
                           dice_between (d, -1, 1), dice_between (d, -1, 1) });
      break;
    case 2:
      operate (dive, BT_OP_MOVE, v, 4, (double[]){ p.x, p.y, p.z, dice_below (d, 3) ? 2 : 20 });
      break;
    case 3:
      operate (dive, BT_OP_FLY_TO, v, 4, (double[]){ p.x, p.y, p.z, 3 });
      break;
    case 4:
      if (h.jumps)
        operate (dive, BT_OP_PLACE, v, 3, (double[]){ p.x, p.y, p.z });
      break;
    case 5:
      if (h.winch)
        operate (dive, dice_below (d, 2) ? BT_OP_PAY_OUT : BT_OP_HAUL_IN, t, 2,
                 (double[]){ dice_between (d, 0.1, 12), dice_between (d, 0.1, 2) });
      break;
    case 6:
      if (h.models)
        take_model (dive, t, (bt_model_kind)dice_below (d, BT_MODEL_AUTO + 1));
      break;
    case 7:
      if (h.cut && dice_below (d, 4) == 0)
        operate (dive, BT_OP_CUT, t, 1, (double[]){ dice_between (d, 1, 28) });
      break;
    default:
      if (h.pairs)
        switch_pair (dive, j, d);
    }
}

static void
live (bt_dive *dive, judge *j, dice *d, habits h, int acts, int steps)
{
  for (int k = 0; k < acts; k++)
    {
      do_something (dive, j, d, h);
      look_again (j, dive, 0);
      for (int i = 0; i < steps && step (dive); i++)
        look_again (j, dive, 1);
    }
}

/* ---- Dives ---- */

static int
longer (void)
{
  const char *wish = getenv ("BIGHT_LONG");
  return wish && *wish == '1' ? 20 : 1;
}

static uint64_t
other_seeds (void)
{
  const char *wish = getenv ("BIGHT_SEED");
  return wish ? strtoull (wish, NULL, 10) : 0;
}

static void
fly (const scene *s, uint64_t seed, habits h, int acts, int steps, const char *name)
{
  bt_dive *dive = enter (s);
  dice d = dice_new (seed + other_seeds ());
  judge j;
  begin_judging (&j, s, dive);
  live (dive, &j, &d, h, acts * longer (), steps);
  print_message ("# %s: %ld looks, clearance beyond the core %.3g m, hull %.3g m, stretch %.6g\n",
                 name, j.looks, j.least, j.least_hull, j.stretch);
  acquit (&j, name);
  end_judging (&j);
  bt_dive_free (dive);
}

static const char *const model_names[] = { "rubber-band", "v-shape", "catenary", "catenary-simplex",
                                           "elastic",     "steady",  "dynamic",  "auto" };

static void
every_model (void **state)
{
  (void)state;
  for (int model = 0; model <= BT_MODEL_AUTO; model++)
    {
      scene s;
      begin_scene (&s, (bt_model_kind)model);
      plant_wood (&s);
      fly (&s, 10 + (uint64_t)model, (habits){ .jumps = 1, .winch = 1 }, 14, 50,
           model_names[model]);
    }
}

static void
hulls_and_movers (void **state)
{
  (void)state;
  for (int model = 0; model <= BT_MODEL_AUTO; model++)
    {
      scene s;
      begin_scene (&s, (bt_model_kind)model);
      plant_wood (&s);
      add_movers (&s);
      give_hull (&s, 0, bt__vec (0.5, 0.8, 0.4));
      fly (&s, 30 + (uint64_t)model, (habits){ .jumps = 1, .winch = 1, .pairs = 1 }, 12, 50,
           model_names[model]);
    }
}

static void
masses (void **state)
{
  static const bt_model_kind models[]
      = { BT_MODEL_DYNAMIC, BT_MODEL_AUTO, BT_MODEL_STEADY, BT_MODEL_CATENARY };
  (void)state;
  for (int k = 0; k < 4; k++)
    {
      scene s;
      begin_scene (&s, models[k]);
      plant_wood (&s);
      add_movers (&s);
      give_hull (&s, 0, bt__vec (0.4, 0.5, 0.3));
      assert_int_equal (bt_def_set_vehicle_type (&s.vehicle[0], "bluerov2-heavy", NULL), BT_OK);
      s.vehicle[0].volume = NAN;
      fly (&s, 50 + (uint64_t)k, (habits){ .jumps = 1, .winch = 1, .cut = 1 }, 12, 50,
           model_names[models[k]]);
    }
}

static void
two_tethers (void **state)
{
  static const bt_model_kind models[] = { BT_MODEL_DYNAMIC, BT_MODEL_CATENARY, BT_MODEL_STEADY };
  (void)state;
  for (int k = 0; k < 6; k++)
    {
      scene s;
      begin_scene (&s, models[k / 2]);
      plant_wood (&s);
      if (k % 2)
        tie_twice (&s);
      else
        hang_garage (&s);
      add_movers (&s);
      give_hull (&s, 0, bt__vec (0.4, 0.5, 0.3));
      fly (&s, 60 + (uint64_t)k, (habits){ .jumps = 1, .winch = 1 }, 10, 40,
           k % 2 ? "two lines" : "garage");
    }
}

static void
other_models_while_wound (void **state)
{
  (void)state;
  for (uint64_t k = 0; k < 4; k++)
    {
      scene s;
      begin_scene (&s, BT_MODEL_DYNAMIC);
      plant_wood (&s);
      add_movers (&s);
      fly (&s, 70 + k, (habits){ .winch = 1, .models = 1, .jumps = k % 2 == 0, .cut = k == 3 }, 16,
           40, "models");
    }
}

/* ---- A yard: walls, boxes, balls, a bed, triangles ---- */

static const bt_vec3 sheet_point[]
    = { { -40, 0, -30 }, { 40, 0, -30 }, { 40, 0, 10 }, { -40, 0, 10 } };
static const uint32_t sheet_corner[][3] = { { 0, 1, 2 }, { 0, 2, 3 } };
static const double gem_points[][3]
    = { { 1, 0, 0 }, { -1, 0, 0 }, { 0, 1, 0 }, { 0, -1, 0 }, { 0, 0, 1 }, { 0, 0, -1 } };

#define BED 12.0

static void
build_yard (scene *s)
{
  bt_obstacle_def *o;
  s->world.sea.depth = BED;
  add (s, "seabed", "bed");
  o = add (s, "box", "wall");
  o->at = (bt_vec3){ 0, 2, -8 };
  o->size = (bt_vec3){ 60, 1, 60 };
  o = add (s, "mesh", "net"); /* not to be passed, though it has no inside */
  o->at = (bt_vec3){ 0, -14, 0 };
  o->mesh = (bt_triangles){ sheet_point, 4, sheet_corner, 2, NULL };
  o = add (s, "sphere", "buoy");
  o->at = (bt_vec3){ 0, -6, -6 };
  o->radius = 1;
  o = add (s, "convex", "gem");
  o->at = (bt_vec3){ 3, -4, -9 };
  o->points = (bt_rows){ gem_points[0], 6, 3 };
}

/* The line stays between bed, wall and net, and out of the buoy and the gem.  */
static double
yard_clearance (const sight *sight, int parts)
{
  double least = INFINITY;
  for (int p = 0; p < parts; p++)
    for (int i = 0; i + 1 < sight->n[p]; i++)
      {
        bt_vec3 a = sight->x[p][i], b = sight->x[p][i + 1], c = bt__vec (0, -6, -6);
        bt__link link = { a, b };
        solid buoy = { .kind = SOLID_SPHERE, .sphere = { c, 1 } };
        least = fmin (least, fmin (a.z + BED, 1.5 - a.y));
        least = fmin (least, a.y + 14);
        least = fmin (least, solid_brute (&buoy, &link));
        for (int k = 0; k <= 16; k++)
          {
            bt_vec3 q = bt__axpy (a, k / 16.0, bt__sub (b, a));
            double in = fabs (q.x - 3) + fabs (q.y + 4) + fabs (q.z + 9) - 1;
            least = fmin (least, in / sqrt (3.0));
          }
      }
  return least;
}

static double
yard_hull (const scene *s, const bt_dive *dive)
{
  bt_vehicle_view view;
  assert_int_equal (bt_dive_vehicle (dive, 0, &view, NULL), BT_OK);
  solid hull = { .kind = SOLID_BOX, .box = hull_of (s, 0, &view) };
  double down = solid_support (&hull, bt__vec (0, 0, -1)),
         north = solid_support (&hull, bt__vec (0, 1, 0)),
         south = solid_support (&hull, bt__vec (0, -1, 0));
  double walls = fmin (BED - down, fmin (1.5 - north, 14 - south));
  return fmin (walls, solid_point (&hull, bt__vec (0, -6, -6)) - 1);
}

static void
yard (void **state)
{
  (void)state;
  for (int model = 0; model <= BT_MODEL_AUTO; model++)
    {
      static sight seen;
      scene s;
      begin_scene (&s, (bt_model_kind)model);
      build_yard (&s);
      give_hull (&s, 0, bt__vec (0.5, 0.8, 0.4));
      s.tether[0].props.wet_weight = 0.05;
      bt_dive *dive = enter (&s);
      dice d = dice_new (80 + (uint64_t)model + other_seeds ());
      double least = INFINITY, hull = INFINITY;
      for (int k = 0; k < 14 * longer (); k++)
        {
          bt_vec3 p = dice_point (&d, 20);
          double to[] = { p.x, p.y, p.z, 4 };
          operate (dive, k % 4 ? BT_OP_MOVE : BT_OP_PLACE, 0, k % 4 ? 4 : 3, to);
          operate (dive, BT_OP_HOLD_HEADING, 0, 1, (double[]){ dice_between (&d, 0, 6) });
          if (k == 9 && model == BT_MODEL_DYNAMIC)
            operate (dive, BT_OP_CUT, 0, 1, (double[]){ 12 });
          for (int i = 0; i < 60 && step (dive); i++)
            {
              look (dive, &seen);
              least = fmin (least, yard_clearance (&seen, 2));
              hull = fmin (hull, yard_hull (&s, dive));
            }
        }
      print_message ("# %s: line %.3g m, hull %.3g m\n", model_names[model], least, hull);
      assert_true (least > s.tether[0].props.diameter / 4 - ROUNDING);
      assert_true (hull > 0);
      bt_dive_free (dive);
    }
}

/* At the end of its tether and pushed along a slanting wall, a vehicle must not creep away.  */
static void
taut_along_a_wall (void **state)
{
  (void)state;
  for (int model = 0; model <= BT_MODEL_AUTO; model++)
    {
      scene s;
      bt_vehicle_view view;
      begin_scene (&s, (bt_model_kind)model);
      bt_obstacle_def *wall = add (&s, "box", "wall");
      wall->at = (bt_vec3){ 8, 14, 0 };
      wall->size = (bt_vec3){ 200, 2, 60 };
      wall->heading = 20;
      give_hull (&s, 0, bt__vec (0.5, 0.8, 0.4));
      bt_dive *dive = enter (&s);
      operate (dive, BT_OP_MOVE, 0, 4, (double[]){ 60, 40, -6, 2 });
      for (int i = 0; i < 1800; i++)
        assert_true (step (dive));
      assert_int_equal (bt_dive_vehicle (dive, 0, &view, NULL), BT_OK);
      double out = bt__distance (view.position, s.tether[0].from.at);
      print_message ("# %s: %.6g m out of 30\n", model_names[model], out);
      assert_true (out < 30 * 1.02);
      bt_dive_free (dive);
    }
}

/* ---- Sameness ---- */

static void
make_crowd (scene *s, bt_model_kind model)
{
  begin_scene (s, model);
  plant_wood (s);
  hang_garage (s);
  add_movers (s);
  give_hull (s, 0, bt__vec (0.4, 0.5, 0.3));
}

static void
go_on (bt_dive *dive, const scene *s, uint64_t seed, int acts)
{
  dice d = dice_new (seed);
  judge j;
  begin_judging (&j, s, dive);
  live (dive, &j, &d, (habits){ .jumps = 1, .winch = 1, .models = 1 }, acts, 30);
  end_judging (&j);
}

/* The same again, on a fork and from a checkpoint taken by another dive: not a bit differs.  */
static void
same_again (void **state)
{
  (void)state;
  for (int model = 0; model <= BT_MODEL_AUTO; model++)
    {
      scene s;
      make_crowd (&s, (bt_model_kind)model);
      bt_dive *a = enter (&s), *b = enter (&s), *fork;
      void *kept = malloc (bt_dive_state_size (a));
      assert_non_null (kept);
      go_on (a, &s, 90, 4);
      go_on (b, &s, 90, 4);
      assert_true (bt_dive_hash (a) == bt_dive_hash (b));
      bt_dive_save (a, kept);
      assert_int_equal (bt_dive_fork (a, &fork, NULL), BT_OK);
      go_on (b, &s, 91, 3);
      go_on (a, &s, 91, 3);
      assert_true (bt_dive_hash (a) == bt_dive_hash (b));
      go_on (b, &s, 92, 2); /* somewhere else, and back */
      assert_int_equal (bt_dive_restore (b, kept, bt_dive_state_size (b), NULL), BT_OK);
      go_on (b, &s, 91, 3);
      go_on (fork, &s, 91, 3);
      assert_true (bt_dive_hash (a) == bt_dive_hash (b));
      assert_true (bt_dive_hash (a) == bt_dive_hash (fork));
      free (kept);
      bt_dive_free (fork);
      bt_dive_free (b);
      bt_dive_free (a);
    }
}

/* Bytes that are not as saved are refused, whichever they are, and the dive goes on.  */
static void
spoilt_states (void **state)
{
  static const bt_model_kind models[] = { BT_MODEL_CATENARY, BT_MODEL_STEADY, BT_MODEL_DYNAMIC };
  (void)state;
  for (int k = 0; k < 3; k++)
    {
      scene s;
      make_crowd (&s, models[k]);
      bt_dive *dive = enter (&s);
      dice d = dice_new (95 + (uint64_t)k);
      go_on (dive, &s, 93, 4);
      size_t size = bt_dive_state_size (dive);
      uint64_t hash = bt_dive_hash (dive);
      unsigned char *good = malloc (size), *bad = malloc (size);
      long refused = 0;
      assert_non_null (good);
      assert_non_null (bad);
      bt_dive_save (dive, good);
      for (int i = 0; i < 3000; i++)
        {
          memcpy (bad, good, size);
          for (int n = 1 + dice_below (&d, 8); n-- > 0;)
            bad[dice_below (&d, (int)size)] ^= (unsigned char)(1 + dice_below (&d, 255));
          int same = bt_dive_restore (dive, bad, size, NULL) == BT_OK;
          refused += !same;
          assert_true (bt_dive_hash (dive) == hash); /* what is not in use does not count */
        }
      assert_true (refused > 300);
      assert_int_not_equal (bt_dive_restore (dive, good, size - 8, NULL), BT_OK);
      assert_int_equal (bt_dive_restore (dive, good, size, NULL), BT_OK);
      assert_true (step (dive));
      free (good);
      free (bad);
      bt_dive_free (dive);
    }
}

/* ---- What it costs ---- */

static void
nothing_there_costs_nothing (void **state)
{
  (void)state;
  for (int model = 0; model <= BT_MODEL_AUTO; model++)
    for (int far = 0; far < 2; far++)
      {
        scene s;
        bt_profile p;
        begin_scene (&s, (bt_model_kind)model);
        if (far)
          add_post (&s, "cylinder", "leg", bt__vec (0, 500, 0), bt__vec (0, 0, 1), 1);
        bt_dive *dive = enter (&s);
        operate (dive, BT_OP_DRIVE, 0, 4, (double[]){ 0.7, 0.2, 0.1, 0.3 });
        for (int i = 0; i < 300; i++)
          assert_true (step (dive));
        bt_dive_profile (dive, &p);
        if (!far)
          assert_true (p.links_asked + p.boxes_visited + p.pairs_measured + p.links_clear + p.casts
                           + p.touches + p.contact_rounds + p.truncated + p.span_solves
                           + p.span_skips
                       == 0);
        assert_true (p.pairs_measured + p.casts < 300); /* of some 7000 links */
        bt_dive_free (dive);
      }
}

/* ---- Mutants ---- */

static void
judge_can_say_no (void **state)
{
  static const bt_model_kind models[]
      = { BT_MODEL_RUBBER_BAND, BT_MODEL_CATENARY, BT_MODEL_STEADY, BT_MODEL_DYNAMIC };
  double hull = INFINITY;
  (void)state;
  for (int k = 0; k < 4; k++)
    {
      scene s;
      judge j;
      begin_scene (&s, models[k]);
      plant_wood (&s);
      add_movers (&s);
      give_hull (&s, 0, bt__vec (0.5, 0.8, 0.4));
      bt_dive *dive = enter (&s);
      dice d = dice_new (7);
      operate (dive, BT_OP_COLLIDE, 0, 3, (double[]){ BT_PART_SEA, -1, 0 });
      begin_judging (&j, &s, dive);
      live (dive, &j, &d, (habits){ .jumps = 1 }, 16, 40);
      operate (dive, BT_OP_MOVE, 0, 4, (double[]){ 0, 0, -6, 3 }); /* into the leg */
      for (int i = 0; i < 600; i++)
        {
          assert_true (step (dive));
          look_again (&j, dive, 1);
        }
      print_message ("# %s, all pairs off: %ld crossings, line %.3g m, hull %.3g m\n",
                     model_names[models[k]], j.crossings, j.least, j.least_hull);
      assert_true (j.crossings > 3);
      assert_true (j.least < -0.05);
      hull = fmin (hull, j.least_hull);
      end_judging (&j);
      bt_dive_free (dive);
    }
  assert_true (hull < -0.05);
}

int
main (void)
{
  const struct CMUnitTest tests[] = {
    cmocka_unit_test (judge_can_say_no),
    cmocka_unit_test (every_model),
    cmocka_unit_test (hulls_and_movers),
    cmocka_unit_test (masses),
    cmocka_unit_test (two_tethers),
    cmocka_unit_test (other_models_while_wound),
    cmocka_unit_test (yard),
    cmocka_unit_test (taut_along_a_wall),
    cmocka_unit_test (same_again),
    cmocka_unit_test (spoilt_states),
    cmocka_unit_test (nothing_there_costs_nothing),
  };
  return cmocka_run_group_tests_name ("dive_obstacles", tests, NULL, NULL);
}
