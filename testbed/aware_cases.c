/* Scenes and lines for the laws and the bench of what a tether is doing.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <string.h>

#include "testbed/aware_cases.h"

/* ---- Putting scenes together ---- */

void
stage_clear (stage *g)
{
  bt__scene_free (g->scene);
  g->scene = NULL;
  g->n = 0;
}

static bt__obstacle *
one_more (stage *g, bt__obstacle_kind kind)
{
  bt__obstacle *o = g->o + g->n;
  memset (o, 0, sizeof *o);
  o->kind = kind;
  o->id = g->n++;
  o->friction = 0.3;
  return o;
}

void
stage_capsule (stage *g, bt_vec3 a, bt_vec3 b, double radius)
{
  one_more (g, BT__OBSTACLE_CAPSULE)->shape.capsule = (bt__capsule){ a, b, radius };
}

void
stage_cylinder (stage *g, bt_vec3 a, bt_vec3 b, double radius)
{
  bt_vec3 d = bt__sub (b, a);
  one_more (g, BT__OBSTACLE_CYLINDER)->shape.cylinder
      = (bt__cylinder){ bt__scale (0.5, bt__add (a, b)), bt__unit_or (d, d), 0.5 * bt__norm (d),
                        radius };
}

void
stage_box (stage *g, bt_vec3 centre, bt_vec3 half)
{
  bt__frame f = { centre, bt__vec (1, 0, 0), bt__vec (0, 1, 0), bt__vec (0, 0, 1) };
  one_more (g, BT__OBSTACLE_BOX)->shape.box = (bt__box){ f, half };
}

void
stage_sphere (stage *g, bt_vec3 centre, double radius)
{
  one_more (g, BT__OBSTACLE_SPHERE)->shape.sphere = (bt__sphere){ centre, radius };
}

int
stage_make (stage *g)
{
  return bt__scene_new (g->o, g->n, 1, &g->scene, NULL) == BT_OK;
}

/* ---- Drawn at random: water between z -20 and 0 ---- */

static void
add_bed (stage *g)
{
  one_more (g, BT__OBSTACLE_PLANE)->shape.plane = (bt__plane){ bt__vec (0, 0, 1), -20 };
}

void
draw_piles (stage *g, dice *d, int n)
{
  stage_clear (g);
  add_bed (g);
  for (int i = 0; i < n; i++)
    {
      double x = dice_between (d, -14, 14), y = dice_between (d, -10, 10);
      stage_cylinder (g, bt__vec (x, y, 2), bt__vec (x, y, -21), dice_between (d, 0.2, 0.6));
    }
  stage_make (g);
}

/* Corner K of the level at Z.  */
static bt_vec3
corner (int k, double z, double half)
{
  return bt__vec ((k & 3) == 0 || (k & 3) == 3 ? -half : half, (k & 3) < 2 ? -half : half, z);
}

void
draw_jacket (stage *g, dice *d, int bays)
{
  double r = dice_between (d, 0.15, 0.35), half = dice_between (d, 4, 6), step = 21.0 / bays;
  stage_clear (g);
  add_bed (g);
  for (int k = 0; k < 4; k++)
    {
      stage_capsule (g, corner (k, 2, half), corner (k, -21, half), r);
      for (int b = 0; b < bays; b++)
        {
          double top = -0.5 - step * b, low = top - step;
          stage_capsule (g, corner (k, top, half), corner (k + 1, top, half), 0.7 * r);
          stage_capsule (g, corner (k, top, half), corner (k + 1, low, half), 0.6 * r);
          stage_capsule (g, corner (k + 1, top, half), corner (k, low, half), 0.6 * r);
        }
    }
  stage_make (g);
}

static void
add_ring (stage *g, bt_vec3 c, bt_vec3 axis, double radius, double tube)
{
  enum
  {
    SIDES = 16
  };
  bt_vec3 e = bt__across (axis), f = bt__cross (axis, e), last = bt__axpy (c, radius, e);
  for (int i = 1; i <= SIDES; i++)
    {
      double w = 2 * BT__PI * i / SIDES;
      bt_vec3 p = bt__axpy (bt__axpy (c, radius * cos (w), e), radius * sin (w), f);
      p = i == SIDES ? bt__axpy (c, radius, e) : p;
      stage_capsule (g, last, p, tube);
      last = p;
    }
}

void
draw_rings (stage *g, dice *d, int n)
{
  stage_clear (g);
  add_bed (g);
  for (int i = 0; i < n; i++)
    {
      bt_vec3 c = bt__vec (-12 + 24.0 * (i + 0.5) / n, dice_between (d, -6, 6),
                           dice_between (d, -15, -5));
      add_ring (g, c, dice_direction (d), dice_between (d, 1.5, 3), 0.12);
    }
  stage_make (g);
}

void
draw_skeleton (stage *g, int k, dice *d)
{
  static const int bays[] = { 2, 4, 8 };
  if (k == 0)
    draw_piles (g, d, 6);
  else if (k < 3)
    draw_rings (g, d, k == 1 ? 1 : 3);
  else
    draw_jacket (g, d, bays[k - 3]);
}

void
draw_boxes (stage *g, dice *d)
{
  stage_clear (g);
  add_bed (g);
  for (int i = 0; i < 6; i++)
    {
      bt_vec3 half
          = bt__vec (dice_between (d, 0.5, 3), dice_between (d, 0.5, 3), dice_between (d, 0.5, 3));
      stage_box (g, bt__vec (dice_between (d, -14, 14), dice_between (d, -10, 10), -20 + half.z),
                 half);
      stage_sphere (
          g,
          bt__vec (dice_between (d, -14, 14), dice_between (d, -10, 10), dice_between (d, -17, -3)),
          dice_between (d, 0.5, 2));
    }
  stage_make (g);
}

static int
is_clear (const stage *g, bt_vec3 a, bt_vec3 b, double clear)
{
  bt__count count = { 0 };
  bt__link link = { a, b };
  bt__near near;
  return !bt__scene_nearest (g->scene, NULL, &link, clear, &near, &count);
}

/* A point within 2 m of the surface of some obstacle, to wind lines about things.  */
static bt_vec3
near_something (const stage *g, dice *d)
{
  const bt__obstacle *o = g->o + dice_below (d, (int)g->n);
  double u = dice_uniform (d), off = dice_between (d, 0.4, 2);
  bt_vec3 c, w = dice_direction (d);
  switch (o->kind)
    {
    case BT__OBSTACLE_CAPSULE:
      c = bt__axpy (o->shape.capsule.a, u, bt__sub (o->shape.capsule.b, o->shape.capsule.a));
      return bt__axpy (c, o->shape.capsule.radius + off, w);
    case BT__OBSTACLE_CYLINDER:
      c = bt__axpy (o->shape.cylinder.centre, (2 * u - 1) * o->shape.cylinder.half,
                    o->shape.cylinder.axis);
      return bt__axpy (c, o->shape.cylinder.radius + off, w);
    case BT__OBSTACLE_SPHERE:
      return bt__axpy (o->shape.sphere.centre, o->shape.sphere.radius + off, w);
    case BT__OBSTACLE_BOX:
      return bt__axpy (o->shape.box.frame.origin, bt__norm (o->shape.box.half) + off, w);
    default:
      return bt__vec (dice_between (d, -17, 17), dice_between (d, -13, 13),
                      dice_between (d, -19, -1));
    }
}

/* Add to the N corners WAY up to MOST in all.  */
static int
draw_legs (const stage *g, dice *d, bt_vec3 *way, int n, int most, double clear)
{
  for (int tries = 0; n < most && tries < 5000; tries++)
    {
      bt_vec3 to = near_something (g, d);
      if (fabs (to.x) < 18 && fabs (to.y) < 14 && to.z < -0.3 && to.z > -19.5
          && bt__distance (way[n - 1], to) < 12 && is_clear (g, way[n - 1], to, clear))
        way[n++] = to;
    }
  return n;
}

uint32_t
draw_line (const stage *g, dice *d, int legs, double clear, double mesh, bt_vec3 *p)
{
  bt_vec3 way[40];
  do
    way[0] = bt__vec (dice_between (d, -17, 17), dice_between (d, -13, 13), -19);
  while (!is_clear (g, way[0], way[0], clear));
  int n = draw_legs (g, d, way, 1, legs < 39 ? legs + 1 : 40, clear);
  return refine (way, (uint32_t)n, mesh, p);
}

uint32_t
draw_between (const stage *g, dice *d, bt_vec3 a, bt_vec3 b, int legs, double clear, double mesh,
              bt_vec3 *p)
{
  bt_vec3 way[40] = { a };
  int n = draw_legs (g, d, way, 1, legs < 38 ? legs : 38, clear);
  for (int tries = 0; tries < 5000 && !is_clear (g, way[n - 1], b, clear); tries++)
    {
      n = n > 30 ? 1 : n;
      n = draw_legs (g, d, way, n, n + 1, clear);
    }
  way[n++] = b;
  return refine (way, (uint32_t)n, mesh, p);
}

bt_vec3
draw_point (const stage *g, dice *d, double clear)
{
  bt_vec3 p;
  do
    p = bt__vec (dice_between (d, -17, 17), dice_between (d, -13, 13), dice_between (d, -19, -1));
  while (!is_clear (g, p, p, clear));
  return p;
}

double
best_detour (const stage *g, dice *d, bt__taut *taut, const bt__taut_config *config, bt_vec3 a,
             bt_vec3 b, int tries, bt__string *s)
{
  double best = INFINITY;
  bt__count count = { 0 };
  for (int k = 0; k < tries; k++)
    {
      bt_vec3 way[5];
      int by = dice_below (d, 4), clear = 1;
      way[0] = a;
      way[by + 1] = b;
      for (int i = 1; i <= by; i++)
        way[i] = near_something (g, d);
      for (int i = 0; i <= by && clear; i++)
        clear = way[i].z < 0 && is_clear (g, way[i], way[i + 1], 2 * config->core);
      if (!clear || !bt__string_lay (s, way, (uint32_t)by + 2))
        continue;
      bt__taut_relax (taut, config, s, 300, &count);
      best = fmin (best, bt__string_length (config, s, &count));
    }
  return best;
}

uint32_t
refine (const bt_vec3 *p, uint32_t n, double mesh, bt_vec3 *out)
{
  uint32_t m = 0;
  for (uint32_t i = 0; i + 1 < n; i++)
    {
      bt_vec3 d = bt__sub (p[i + 1], p[i]);
      int parts = (int)fmax (1, ceil (bt__norm (d) / mesh - 1e-9));
      for (int k = 0; k < parts && m < CASE_NODES - 1; k++)
        out[m++] = bt__axpy (p[i], (double)k / parts, d);
    }
  out[m++] = p[n - 1];
  return m;
}

/* ---- Random moves ---- */

static double
volume (bt_vec3 a, bt_vec3 b, bt_vec3 c, bt_vec3 d)
{
  return bt__dot (bt__sub (b, a), bt__cross (bt__sub (c, a), bt__sub (d, a)));
}

static int
is_apart (double a, double b, double c, double p, double q)
{
  return fmax (fmax (a, b), c) < fmin (p, q) || fmin (fmin (a, b), c) > fmax (p, q);
}

/* Nonzero if the segment P to Q goes through the triangle A, B, C.  */
static int
pierces (bt_vec3 p, bt_vec3 q, bt_vec3 a, bt_vec3 b, bt_vec3 c)
{
  if (is_apart (a.x, b.x, c.x, p.x, q.x) || is_apart (a.y, b.y, c.y, p.y, q.y)
      || is_apart (a.z, b.z, c.z, p.z, q.z)
      || (volume (a, b, c, p) >= 0) == (volume (a, b, c, q) >= 0))
    return 0;
  int one = volume (p, q, a, b) >= 0;
  return one == (volume (p, q, b, c) >= 0) && one == (volume (p, q, c, a) >= 0);
}

static int
sweeps_an_axis (const stage *g, bt_vec3 a, bt_vec3 b, bt_vec3 c)
{
  for (uint32_t i = 0; i < g->n; i++)
    {
      const bt__obstacle *o = g->o + i;
      const bt__cylinder *y = &o->shape.cylinder;
      bt__capsule m = o->shape.capsule;
      if (o->kind == BT__OBSTACLE_CYLINDER)
        m = (bt__capsule){ bt__axpy (y->centre, -y->half, y->axis),
                           bt__axpy (y->centre, y->half, y->axis), y->radius };
      else if (o->kind != BT__OBSTACLE_CAPSULE)
        continue;
      if (pierces (m.a, m.b, a, b, c))
        return 1;
    }
  return 0;
}

int
move_node (const stage *g, dice *d, double size, bt_vec3 *p, uint32_t j)
{
  bt_vec3 to = bt__add (p[j], dice_point (d, size));
  if (to.z > -0.01 || !is_clear (g, p[j - 1], to, 0.001) || !is_clear (g, to, p[j + 1], 0.001)
      || sweeps_an_axis (g, p[j - 1], p[j], to) || sweeps_an_axis (g, p[j], p[j + 1], to))
    return 0;
  p[j] = to;
  return 1;
}

/* ---- Knotted obstacles ---- */

static void
add_closed (stage *g, const bt_vec3 *p, int n, double radius)
{
  for (int i = 0; i < n; i++)
    stage_capsule (g, p[i], p[(i + 1) % n], radius);
}

void
draw_hopf (stage *g)
{
  stage_clear (g);
  add_ring (g, bt__vec (0, 0, -10), bt__unit_or (bt__vec (0.1, 0.2, 1), bt__vec (0, 0, 1)), 2,
            0.12);
  add_ring (g, bt__vec (2, 0, -10), bt__unit_or (bt__vec (0.2, 1, 0.1), bt__vec (0, 0, 1)), 2,
            0.12);
  stage_make (g);
}

void
draw_borromean (stage *g)
{
  enum
  {
    SIDES = 20
  };
  bt_vec3 p[SIDES];
  stage_clear (g);
  for (int k = 0; k < 3; k++)
    {
      for (int i = 0; i < SIDES; i++)
        {
          double u = 3 * cos (2 * BT__PI * i / SIDES), v = 1.4 * sin (2 * BT__PI * i / SIDES);
          p[i] = k == 0   ? bt__vec (u, v, -10)
                 : k == 1 ? bt__vec (0, u, v - 10)
                          : bt__vec (v, 0, u - 10);
        }
      add_closed (g, p, SIDES, 0.12);
    }
  stage_make (g);
}

void
draw_trefoil (stage *g)
{
  enum
  {
    SIDES = 40
  };
  bt_vec3 p[SIDES];
  stage_clear (g);
  for (int i = 0; i < SIDES; i++)
    {
      double t = 2 * BT__PI * i / SIDES;
      p[i] = bt__vec (1.5 * (sin (t) + 2 * sin (2 * t)), 1.5 * (cos (t) - 2 * cos (2 * t)),
                      -1.5 * sin (3 * t) - 10);
    }
  add_closed (g, p, SIDES, 0.12);
  stage_make (g);
}
