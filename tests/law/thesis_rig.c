/* See thesis_rig.h.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <stdarg.h>
#include <stddef.h>
#include <setjmp.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "thesis_rig.h"

rig *
rig_new (void)
{
  rig *r = calloc (1, sizeof *r);
  assert_non_null (r);
  r->props = (bt_tether_props){ .diameter = 0.01,
                                .ea = INFINITY,
                                .cdn = 1.2,
                                .model = BT_MODEL_CATENARY,
                                .sag_buoyancy = BT_SAG_AUTO,
                                .max_current = 1,
                                .thesis_length_factor = 1,
                                .nodes = RIG_NODES,
                                .rejoin_angle = 185,
                                .stick_angle = 36000,
                                .stick_count = INFINITY,
                                .sliding = 1 };
  r->rules = bt__thesis_rules_of (&r->props);
  r->current = (bt_current){ .kind = BT_CURRENT_UNIFORM, .velocity = { { 0.25, 0, 0 } } };
  r->water
      = (bt_water){ .density = 1025, .gravity = 9.80665, .depth = 100, .current = &r->current };
  r->pull = 100;
  r->tools.search = bt_search_new ();
  r->state = calloc (1, bt__thesis_size (RIG_NODES));
  assert_non_null (r->state);
  return r;
}

void
rig_free (rig *r)
{
  bt__scene_free (r->scene);
  bt__safe_free (r->safe);
  bt__polyline_work_free (r->work);
  bt_search_free (r->tools.search);
  free (r->state);
  free (r);
}

/* ---- Obstacles ---- */

static uint32_t
put (rig *r, bt__obstacle o)
{
  assert_true (r->n < RIG_OBSTACLES);
  o.id = r->n;
  r->obstacle[r->n] = o;
  return r->n++;
}

static void
bone (rig *r, bt_vec3 a, bt_vec3 b)
{
  assert_true (r->bones < 1024);
  r->bone[r->bones++] = (sweep_segment){ a, b };
}

uint32_t
rig_box (rig *r, bt_vec3 centre, bt_vec3 half, double heading)
{
  double c = cos (heading), s = sin (heading);
  bt__box box = { { centre, { c, -s, 0 }, { s, c, 0 }, { 0, 0, 1 } }, half };
  for (int k = 14; k < 27; k++)
    {
      bt_vec3 p = { half.x * (k % 3 - 1), half.y * (k / 3 % 3 - 1), half.z * (k / 9 - 1) };
      bone (r, bt__to_world (&box.frame, p), bt__to_world (&box.frame, bt__scale (-1, p)));
    }
  return put (r, (bt__obstacle){ .kind = BT__OBSTACLE_BOX, .shape.box = box });
}

uint32_t
rig_pile (rig *r, bt_vec3 from, bt_vec3 to, double radius)
{
  bt_vec3 d = bt__sub (to, from), axis = bt__unit_or (d, d);
  bt_vec3 c = bt__axpy (from, 0.5, d), across = bt__scale (radius, bt__across (axis));
  bone (r, from, to);
  bone (r, bt__sub (c, across), bt__add (c, across));
  bt__cylinder k = { c, axis, bt__norm (d) / 2, radius };
  return put (r, (bt__obstacle){ .kind = BT__OBSTACLE_CYLINDER, .shape.cylinder = k });
}

uint32_t
rig_ball (rig *r, bt_vec3 c, double radius)
{
  bone (r, bt__vec (c.x - radius, c.y, c.z), bt__vec (c.x + radius, c.y, c.z));
  bone (r, bt__vec (c.x, c.y - radius, c.z), bt__vec (c.x, c.y + radius, c.z));
  bone (r, bt__vec (c.x, c.y, c.z - radius), bt__vec (c.x, c.y, c.z + radius));
  return put (r, (bt__obstacle){ .kind = BT__OBSTACLE_SPHERE, .shape.sphere = { c, radius } });
}

uint32_t
rig_bar (rig *r, bt_vec3 from, bt_vec3 to, double radius)
{
  bone (r, from, to);
  return put (
      r, (bt__obstacle){ .kind = BT__OBSTACLE_CAPSULE, .shape.capsule = { from, to, radius } });
}

uint32_t
rig_hull (rig *r, const bt_vec3 *points, int n)
{
  bt__hull *hull;
  assert_int_equal (bt__hull_new (points, n, &hull, &r->error), BT_OK);
  for (int i = 0; i + 1 < n; i++)
    bone (r, points[i], points[i + 1]);
  return put (r, (bt__obstacle){ .kind = BT__OBSTACLE_CONVEX, .shape.hull = hull });
}

uint32_t
rig_mesh (rig *r, bt__mesh *mesh)
{
  return put (r, (bt__obstacle){ .kind = BT__OBSTACLE_MESH, .shape.mesh = mesh });
}

/* ---- Flying ---- */

static void
watch (void *user, const bt_vec3 *from, const bt_vec3 *to, uint32_t n)
{
  rig *r = user;
  r->legs++;
  for (int i = 0; i < r->bones; i++)
    r->crossings += sweep_crossings (from, to, (int)n, r->bone + i);
  for (int i = 0; i < r->sheets; i++)
    r->crossings += sweep_sheet (from, to, (int)n, r->sheet + i);
}

double
rig_stretch (const bt__polyline *line)
{
  const bt_vec3 *x = bt__polyline_x ((bt__polyline *)line);
  const double *u = bt__polyline_u ((bt__polyline *)line);
  double most = 0, dust = 1e-9 * u[line->n - 1];
  for (int64_t i = 0; i + 1 < line->n; i++)
    most = fmax (most, (bt__distance (x[i], x[i + 1]) - dust) / fmax (u[i + 1] - u[i], dust));
  return most;
}

static void
step (rig *r, int stale)
{
  bt__thesis_input in = { .a = r->a,
                          .b = r->b,
                          .length = r->length,
                          .pull = r->pull,
                          .stale = stale,
                          .props = &r->props,
                          .rules = &r->rules,
                          .water = &r->water,
                          .tools = &r->tools,
                          .counts = &r->shapes };
  bt_status status = bt__thesis_step (r->state, &in, &r->way, &r->counts, &r->report, &r->error);
  if (status != BT_OK)
    fail_msg ("%s", r->error.text);
  r->stretch = fmax (r->stretch, rig_stretch (bt__thesis_line (r->state)));
}

void
rig_start (rig *r, bt_vec3 a, bt_vec3 b, double length)
{
  bt_vec3 ends[2] = { a, b };
  uint32_t room = bt__thesis_room (RIG_NODES);
  assert_int_equal (bt__scene_new (r->obstacle, r->n, 1, &r->scene, &r->error), BT_OK);
  assert_int_equal (bt__safe_new (room, 64, &r->safe, &r->error), BT_OK);
  assert_int_equal (bt__polyline_work_new (room, RIG_MOVERS, &r->work, &r->error), BT_OK);
  r->on = (bt__switches){ r->off, 1 };
  r->around = (bt__surroundings){ r->scene, &r->on, r->mover, r->movers };
  r->way = (bt__way){ .around = &r->around,
                      .core = bt__core (r->props.diameter),
                      .safe = r->safe,
                      .work = r->work,
                      .count = &r->count,
                      .watch = watch,
                      .user = r };
  assert_int_equal (bt__thesis_lay (r->state, RIG_NODES, ends, 2, length, &r->error), BT_OK);
  r->a = a;
  r->b = b;
  r->length = length;
  step (r, 1);
}

void
rig_rest (rig *r, int steps)
{
  for (int i = 0; i < steps; i++)
    step (r, 1);
}

int
rig_step (rig *r, bt_vec3 b)
{
  r->b = b;
  step (r, 0);
  return bt__distance (r->report.b, b) < 1e-9;
}

int
rig_fly (rig *r, bt_vec3 b, double stride)
{
  bt_vec3 from = r->report.b;
  int n = (int)ceil (bt__distance (from, b) / stride), short_of = 0;
  for (int i = 1; i <= n; i++)
    short_of += !rig_step (r, bt__axpy (from, (double)i / n, bt__sub (b, from)));
  return short_of;
}

int
rig_round (rig *r, bt_vec3 centre, double angle, double radius, double stride)
{
  bt_vec3 d = bt__sub (r->report.b, centre);
  double r0 = hypot (d.x, d.y), start = atan2 (d.y, d.x);
  int n = (int)ceil (fabs (angle) * fmax (radius, r0) / stride), short_of = 0;
  for (int i = 1; i <= n; i++)
    {
      double t = (double)i / n, phi = start + t * angle, q = r0 + t * (radius - r0);
      short_of += !rig_step (
          r, bt__vec (centre.x + q * cos (phi), centre.y + q * sin (phi), r->report.b.z));
    }
  return short_of;
}

/* ---- Asking ---- */

bt_vec3 *
rig_x (const rig *r)
{
  return bt__polyline_x (bt__thesis_line (r->state));
}

int64_t
rig_n (const rig *r)
{
  return bt__thesis_line (r->state)->n;
}

int
rig_contacts (const rig *r)
{
  return (int)r->state->spans - 1;
}

double
rig_turns (const rig *r, bt_vec3 c)
{
  double sum = 0;
  const bt_vec3 *x = rig_x (r);
  for (int64_t i = 0; i + 1 < rig_n (r); i++)
    {
      double px = x[i].x - c.x, py = x[i].y - c.y, qx = x[i + 1].x - c.x, qy = x[i + 1].y - c.y;
      sum += atan2 (px * qy - py * qx, px * qx + py * qy);
    }
  return sum / (2 * BT__PI);
}

double
rig_clearance (const rig *r)
{
  double least = INFINITY;
  const bt_vec3 *x = rig_x (r);
  bt__count count = { 0 };
  for (int64_t i = 0; i + 1 < rig_n (r); i++)
    {
      bt__link link = { x[i], x[i + 1] };
      bt__near near;
      if (bt__scene_nearest (r->scene, &r->on, &link, 1, &near, &count))
        least = fmin (least, near.w.distance);
    }
  return least;
}

void
rig_check (const rig *r)
{
  double clear = rig_clearance (r);
  if (r->crossings || !(clear >= bt__core (r->props.diameter)) || !(r->stretch <= 1.01))
    fail_msg ("%ld crossings, clearance %.9g, stretch %.9g", r->crossings, clear, r->stretch);
}

bt__span *
rig_span (const rig *r, int k)
{
  return bt__thesis_spans (r->state) + k;
}
