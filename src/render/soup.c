/* Bodies as triangles.

   A soup is a list of vertices with normals and material, and a list of indices, in floats relative
   to the point looked at.  Round bodies get as many sides as the picture needs: chords are off the
   circle by at most 0.15 of a pixel, between 8 and 40 sides; in quick pictures half a pixel.  A
   failed allocation sets `full' and drops further triangles; the picture then fails as a whole.

   A tube is a ring of vertices at each point of its line, joined by triangles.  The frame of the
   rings is carried from point to point by taking out the part along the line (parallel transport),
   so the rings do not turn about the line.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "math/vec.h"
#include "render/soup.h"

enum
{
  ROUND = 40,     /* sides of what is round, at most */
  FEWEST = 8,     /* and at least */
  TUBE_LEAST = 6, /* of a tube */
  QUICK_LEAST = 4 /* of either in a quick picture */
};

void
bt__soup_free (bt__soup *soup)
{
  free (soup->vertex);
  free (soup->index);
}

/* In the picture a point's depth is more than half its distance.  Of what is beside or behind the
   camera no more than the shadow is seen, from about as far.  */
double
bt__pixel_at (const bt__lens *lens, bt_vec3 p)
{
  bt_vec3 way = bt__sub (p, lens->from);
  double depth = fmax (bt__dot (way, lens->ahead), bt__norm (way) / 2);
  return lens->perspective ? lens->pixel * fmax (depth, 0.05) : lens->pixel;
}

double
bt__stroke (const bt__lens *lens)
{
  return fmax (lens->rows / 720.0, 0.4);
}

/* Sides of a circle of RADIUS about AT, LEAST or more: the chords are off the circle by at most
   0.15 of a pixel, or, for a quick picture, 0.5.  A triangle costs as much as many pixels.  */
static int
sides_of (const bt__soup *soup, bt_vec3 at, double radius, int least)
{
  least = soup->lens.quick && least > QUICK_LEAST && least <= FEWEST ? QUICK_LEAST : least;
  double pixels = radius / bt__pixel_at (&soup->lens, at);
  double n = (soup->lens.quick ? 3.2 : 5.8) * sqrt (fmax (pixels, 0));
  return n < least ? least : n > ROUND ? ROUND : (int)ceil (n / 2) * 2;
}

void
bt__stuff_color (bt__stuff *stuff, bt_color color)
{
  stuff->color[0] = (unsigned char)lround (255 * (double)color.r);
  stuff->color[1] = (unsigned char)lround (255 * (double)color.g);
  stuff->color[2] = (unsigned char)lround (255 * (double)color.b);
  stuff->color[3] = 255;
}

/* Room for one more item in ITEMS, or NULL.  */
static void *
room_for (void *items, size_t n, size_t *room, size_t size)
{
  size_t more = *room ? 2 * *room : 4096;
  void *grown;
  if (n < *room)
    return items;
  grown = realloc (items, more * size);
  if (grown)
    *room = more;
  return grown;
}

uint32_t
bt__add_vertex (bt__soup *soup, bt_vec3 p, bt_vec3 normal)
{
  bt_vec3 q = bt__sub (p, soup->origin);
  bt__vertex *grown = room_for (soup->vertex, soup->n, &soup->room, sizeof *grown);
  if (!grown || soup->n == UINT32_MAX)
    {
      soup->full = 1;
      return 0;
    }
  soup->vertex = grown;
  soup->vertex[soup->n] = (bt__vertex){ { (float)q.x, (float)q.y, (float)q.z },
                                        { (float)normal.x, (float)normal.y, (float)normal.z },
                                        soup->stuff };
  return (uint32_t)soup->n++;
}

void
bt__add_triangle (bt__soup *soup, uint32_t a, uint32_t b, uint32_t c)
{
  uint32_t corner[3] = { a, b, c };
  for (int i = 0; i < 3; i++)
    {
      uint32_t *grown = room_for (soup->index, soup->n_index, &soup->room_index, sizeof *grown);
      if (!grown)
        {
          soup->full = 1;
          return;
        }
      soup->index = grown;
      soup->index[soup->n_index++] = corner[i];
    }
}

void
bt__add_flat (bt__soup *soup, bt_vec3 a, bt_vec3 b, bt_vec3 c)
{
  bt_vec3 n = bt__unit_or (bt__cross (bt__sub (b, a), bt__sub (c, a)), bt__vec (0, 0, 1));
  uint32_t i = bt__add_vertex (soup, a, n), j = bt__add_vertex (soup, b, n);
  bt__add_triangle (soup, i, j, bt__add_vertex (soup, c, n));
}

static void
add_quad (bt__soup *soup, const bt_vec3 corner[4], bt_vec3 normal)
{
  uint32_t i[4];
  for (int k = 0; k < 4; k++)
    i[k] = bt__add_vertex (soup, corner[k], normal);
  bt__add_triangle (soup, i[0], i[1], i[2]);
  bt__add_triangle (soup, i[0], i[2], i[3]);
}

bt__pose
bt__pose_of (bt_vec3 at, double heading, double pitch, double roll)
{
  bt__pose pose = { .at = at };
  bt_body_axes (heading, pitch, roll, pose.axis);
  return pose;
}

bt_vec3
bt__pose_point (const bt__pose *pose, double x, double y, double z)
{
  return bt__axpy (bt__axpy (bt__axpy (pose->at, x, pose->axis[0]), y, pose->axis[1]), z,
                   pose->axis[2]);
}

void
bt__add_box (bt__soup *soup, const bt__pose *pose, bt_vec3 size)
{
  double h[3] = { size.x / 2, size.y / 2, size.z / 2 };
  for (int side = 0; side < 6; side++)
    {
      int a = side % 3, b = (a + 1) % 3, c = (a + 2) % 3;
      double s = side < 3 ? 1 : -1;
      bt_vec3 middle = bt__axpy (pose->at, s * h[a], pose->axis[a]), corner[4];
      for (int k = 0; k < 4; k++)
        corner[k] = bt__axpy (bt__axpy (middle, k == 1 || k == 2 ? h[b] : -h[b], pose->axis[b]),
                              k > 1 ? h[c] : -h[c], pose->axis[c]);
      add_quad (soup, corner, bt__scale (s, pose->axis[a]));
    }
}

void
bt__add_sphere (bt__soup *soup, bt_vec3 at, double radius)
{
  uint32_t first = (uint32_t)soup->n, round = (uint32_t)sides_of (soup, at, radius, FEWEST);
  uint32_t span = round / 2;
  for (uint32_t i = 0; i <= span; i++)
    for (uint32_t j = 0; j <= round; j++)
      {
        double t = BT__PI * i / span, u = 2 * BT__PI * j / round;
        bt_vec3 n = bt__vec (sin (t) * cos (u), sin (t) * sin (u), cos (t));
        bt__add_vertex (soup, bt__axpy (at, radius, n), n);
      }
  for (uint32_t i = 0; i < span; i++)
    for (uint32_t j = 0; j < round; j++)
      {
        uint32_t k = first + i * (round + 1) + j;
        bt__add_triangle (soup, k, k + round + 1, k + 1);
        bt__add_triangle (soup, k + 1, k + round + 1, k + round + 2);
      }
}

/* Two directions across AXIS.  */
static void
cross_axes (bt_vec3 axis, bt_vec3 *u, bt_vec3 *v)
{
  bt_vec3 helper = fabs (axis.z) < 0.9 ? bt__vec (0, 0, 1) : bt__vec (1, 0, 0);
  *u = bt__unit_or (bt__cross (helper, axis), bt__vec (1, 0, 0));
  *v = bt__cross (axis, *u);
}

static bt_vec3
around (bt_vec3 u, bt_vec3 v, int i, int n)
{
  double t = 2 * BT__PI * i / n;
  return bt__axpy (bt__scale (cos (t), u), sin (t), v);
}

static void
add_disc (bt__soup *soup, bt_vec3 at, bt_vec3 normal, bt_vec3 u, bt_vec3 v, double r, int sides)
{
  uint32_t middle = bt__add_vertex (soup, at, normal);
  for (int i = 0; i <= sides; i++)
    {
      uint32_t k = bt__add_vertex (soup, bt__axpy (at, r, around (u, v, i, sides)), normal);
      if (i)
        bt__add_triangle (soup, middle, k - 1, k);
    }
}

/* True if a disc of RADIUS about AT is less than a pixel of a quick picture.  */
static int
is_dot (const bt__soup *soup, bt_vec3 at, double radius)
{
  return soup->lens.quick && radius < 0.5 * bt__pixel_at (&soup->lens, at);
}

void
bt__add_cone (bt__soup *soup, bt_vec3 from, bt_vec3 to, double r0, double r1, int caps)
{
  bt_vec3 axis = bt__unit_or (bt__sub (to, from), bt__vec (0, 0, 1)), u, v;
  double length = bt__distance (from, to), lean = length > 0 ? (r0 - r1) / length : 0;
  double along = bt__dot (bt__sub (soup->lens.from, from), axis);
  bt_vec3 nearest = bt__axpy (from, fmin (fmax (along, 0), length), axis);
  int sides = sides_of (soup, nearest, fmax (r0, r1), FEWEST);
  cross_axes (axis, &u, &v);
  for (int i = 0; i <= sides; i++)
    {
      bt_vec3 out = around (u, v, i, sides);
      bt_vec3 normal = bt__unit_or (bt__axpy (out, lean, axis), out);
      uint32_t k = bt__add_vertex (soup, bt__axpy (from, r0, out), normal);
      bt__add_vertex (soup, bt__axpy (to, r1, out), normal);
      if (i)
        {
          bt__add_triangle (soup, k - 2, k - 1, k);
          bt__add_triangle (soup, k, k - 1, k + 1);
        }
    }
  if (caps && r0 > 0 && !is_dot (soup, from, r0))
    add_disc (soup, from, bt__scale (-1, axis), u, v, r0, sides);
  if (caps && r1 > 0 && !is_dot (soup, to, r1))
    add_disc (soup, to, axis, u, v, r1, sides);
}

void
bt__add_ring (bt__soup *soup, bt_vec3 at, bt_vec3 axis, double radius, double thickness)
{
  bt_vec3 point[ROUND + 1], u, v;
  int sides = soup->lens.quick ? sides_of (soup, at, radius, FEWEST) : ROUND;
  cross_axes (axis, &u, &v);
  for (int i = 0; i <= sides; i++)
    point[i] = bt__axpy (at, radius, around (u, v, i, sides));
  bt__add_tube (soup, point, (size_t)sides + 1, thickness, 0, NULL);
}

/* ---- Tubes ---- */

/* The direction of the polyline at point I.  */
static bt_vec3
direction (const bt_vec3 *points, size_t n, size_t i, bt_vec3 last)
{
  bt_vec3 before = points[i ? i - 1 : 0], after = points[i + 1 < n ? i + 1 : n - 1];
  return bt__unit_or (bt__sub (after, before), last);
}

/* True if the ring about P is not seen to be another one than that about LAST, in a quick picture.
 */
static int
is_same_ring (const bt__soup *soup, bt_vec3 p, bt_vec3 last)
{
  return soup->lens.quick && bt__distance (p, last) < bt__pixel_at (&soup->lens, p);
}

/* The frame is carried along without turning about the tube: no tube looks twisted.  */
void
bt__add_tube (bt__soup *soup, const bt_vec3 *points, size_t n, double radius, double least,
              const bt_color *color)
{
  bt_vec3 along = bt__vec (1, 0, 0), u, v, last = { 0, 0, 0 };
  int sides = TUBE_LEAST;
  if (n < 2)
    return;
  for (size_t i = 0; i < n; i++)
    sides = sides_of (soup, points[i], radius, sides);
  along = direction (points, n, 0, along);
  cross_axes (along, &u, &v);
  for (size_t i = 0; i < n; i++)
    {
      double r = fmax (radius, least / 2 * bt__pixel_at (&soup->lens, points[i]));
      if (i && i + 1 < n && is_same_ring (soup, points[i], last))
        continue;
      last = points[i];
      along = direction (points, n, i, along);
      u = bt__unit_or (bt__off_axis (along, u), u);
      v = bt__cross (along, u);
      if (color)
        bt__stuff_color (&soup->stuff, color[i]);
      for (int k = 0; k < sides; k++)
        {
          bt_vec3 out = around (u, v, k, sides);
          bt__add_vertex (soup, bt__axpy (points[i], r, out), out);
        }
      for (uint32_t k = 0, m = (uint32_t)sides; i && k < m; k++)
        {
          uint32_t next = (k + 1) % m, top = (uint32_t)soup->n - m, low = top - m;
          bt__add_triangle (soup, low + k, low + next, top + k);
          bt__add_triangle (soup, top + k, low + next, top + next);
        }
    }
}
