/* Things of a view as triangles.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <math.h>
#include <stdlib.h>

#include "math/vec.h"
#include "render/soup.h"

static bt__stuff
stuff_of (bt_color color, int fog, int edge, int shading, int gloss)
{
  bt__stuff s = {
    { 0 }, (unsigned char)fog, (unsigned char)edge, (unsigned char)shading, (unsigned char)gloss
  };
  bt__stuff_color (&s, color);
  return s;
}

/* ---- Tubes, lines, arrows, marks ---- */

/* The colours of the points of T, or NULL for a single colour.  */
static bt_color *
tube_colors (const bt_view *view, const bt_thing *t)
{
  bt_color *color = t->values && view->scale.name ? malloc (t->n * sizeof *color) : NULL;
  for (size_t i = 0; color && i < t->n; i++)
    color[i] = bt__scale_color (&view->scale, t->values[i]);
  return color;
}

/* The least width of a tube in pixels.  */
static double
least_width (const bt__soup *soup)
{
  return fmax (1.8, soup->lens.rows / 260.0);
}

static void
add_painted_tube (bt__soup *soup, const bt_view *view, const bt_thing *t)
{
  bt_color *color = tube_colors (view, t);
  size_t first = soup->n_index;
  soup->stuff = stuff_of (t->color, 70, BT__EDGE_NEVER, BT__GLOWING, 40);
  bt__add_tube (soup, t->points, t->n, t->radius, least_width (soup), color);
  free (color);
  if (soup->ghosts < BT__TUBES_MAX)
    soup->ghost[soup->ghosts++] = (bt__range){ first, soup->n_index - first };
}

static void
add_lines (bt__soup *soup, const bt_thing *t)
{
  soup->stuff = stuff_of (t->color, 60, BT__EDGE_NEVER, BT__GLOWING, 0);
  for (size_t i = 0; i + 1 < t->n; i += 2)
    bt__add_tube (soup, t->points + i, 2, t->radius, fmax (1.2, 1.2 * bt__stroke (&soup->lens)),
                  NULL);
}

/* A shaft and a head, thick enough to be seen.  */
static void
draw_arrow (bt__soup *soup, const bt_thing *t)
{
  double length = bt__distance (t->from, t->to);
  double r = fmax (fmax (0.012 * length, t->radius),
                   1.1 * bt__stroke (&soup->lens) * bt__pixel_at (&soup->lens, t->from));
  double head = fmin (7 * r, 0.6 * length);
  bt_vec3 way = bt__unit_or (bt__sub (t->to, t->from), bt__vec (1, 0, 0));
  bt_vec3 neck = bt__axpy (t->to, -head, way);
  soup->stuff = stuff_of (t->color, 110, BT__EDGE_NEVER, BT__GLOWING, 0);
  bt__add_cone (soup, t->from, neck, r, r, 1);
  bt__add_cone (soup, neck, t->to, 2.6 * r, 0, 1);
}

static void
add_mark (bt__soup *soup, const bt_thing *t)
{
  double pixel = bt__stroke (&soup->lens) * bt__pixel_at (&soup->lens, t->at);
  soup->stuff = stuff_of (t->color, 0, BT__EDGE_NEVER, BT__GLOWING, 0);
  /* In front of the thing marked.  */
  bt__add_ring (soup, bt__axpy (t->at, -1.5 * t->radius * pixel, soup->lens.ahead),
                soup->lens.ahead, t->radius * pixel, 0.9 * pixel);
}

/* ---- Solids ---- */

/* Thin round things such as wires are drawn no thinner than a tether: tethers hang on wires.  */
static double
thick_at (bt__soup *soup, double radius, bt_vec3 p)
{
  return fmax (radius, least_width (soup) / 2 * bt__pixel_at (&soup->lens, p));
}

static void
add_round (bt__soup *soup, const bt_thing *t)
{
  double r0 = thick_at (soup, t->radius, t->from), r1 = thick_at (soup, t->radius, t->to);
  int ball = t->kind == BT_THING_CAPSULE;
  if (r0 > t->radius || r1 > t->radius)
    soup->stuff.edge = BT__EDGE_NONE; /* the outlines would cover the whole thing */
  bt__add_cone (soup, t->from, t->to, r0, r1, !ball);
  if (ball)
    {
      bt__add_sphere (soup, t->from, r0);
      bt__add_sphere (soup, t->to, r1);
    }
}

static void
draw_mesh (bt__soup *soup, const bt_thing *t)
{
  bt__pose pose = bt__pose_of (t->at, t->heading, t->pitch, t->roll);
  for (size_t i = 0; i < t->triangles; i++)
    {
      bt_vec3 p[3];
      for (int k = 0; k < 3; k++)
        {
          bt_vec3 q = bt__scale (t->scale, t->points[t->corner[i][k]]);
          p[k] = bt__pose_point (&pose, q.x, q.y, q.z);
        }
      bt__add_flat (soup, p[0], p[1], p[2]);
    }
}

static void
add_solid (bt__soup *soup, const bt_thing *t)
{
  bt__pose pose = bt__pose_of (t->at, t->heading, t->pitch, t->roll);
  soup->stuff = stuff_of (t->color, 255, t->ground ? BT__EDGE_NONE : BT__EDGE_LINE,
                          t->ground ? BT__GROUND : BT__MATTE, 24);
  if (t->kind == BT_THING_BOX)
    bt__add_box (soup, &pose, t->size);
  else if (t->kind == BT_THING_SPHERE)
    bt__add_sphere (soup, t->at, t->radius);
  else if (t->kind == BT_THING_CYLINDER || t->kind == BT_THING_CAPSULE)
    add_round (soup, t);
  else
    draw_mesh (soup, t);
}

/* ---- Ground ---- */

/* A square of REACH about the point under the camera, in strips that keep the floats exact.  */
static void
draw_level (bt__soup *soup, const bt_thing *t, double reach)
{
  enum
  {
    CELLS = 24
  };
  uint32_t first = (uint32_t)soup->n;
  soup->stuff = stuff_of (t->color, 255, BT__EDGE_NONE, BT__GROUND, 0);
  for (int i = 0; i <= CELLS; i++)
    for (int j = 0; j <= CELLS; j++)
      bt__add_vertex (soup,
                      bt__vec (soup->origin.x + reach * (2.0 * i / CELLS - 1),
                               soup->origin.y + reach * (2.0 * j / CELLS - 1), t->at.z),
                      bt__vec (0, 0, 1));
  for (uint32_t i = 0; i < CELLS; i++)
    for (uint32_t j = 0; j < CELLS; j++)
      {
        uint32_t k = first + i * (CELLS + 1) + j;
        bt__add_triangle (soup, k, k + CELLS + 1, k + 1);
        bt__add_triangle (soup, k + 1, k + CELLS + 1, k + CELLS + 2);
      }
}

/* The height of post (I, J), its edges carried on.  */
static double
post (const bt_heights *g, long i, long j)
{
  long nx = (long)g->nx, ny = (long)g->ny;
  i = i < 0 ? 0 : i >= nx ? nx - 1 : i;
  j = j < 0 ? 0 : j >= ny ? ny - 1 : j;
  return g->z[(size_t)j * g->nx + (size_t)i];
}

static uint32_t
add_post (bt__soup *soup, const bt_heights *g, long i, long j)
{
  double sx = (post (g, i + 1, j) - post (g, i - 1, j)) / (2 * g->dx);
  double sy = (post (g, i, j + 1) - post (g, i, j - 1)) / (2 * g->dy);
  bt_vec3 up = bt__vec (0, 0, 1);
  bt_vec3 n = isfinite (sx + sy) ? bt__unit_or (bt__vec (-sx, -sy, 1), up) : up;
  double z = post (g, i, j);
  return bt__add_vertex (
      soup, bt__vec (g->x + g->dx * (double)i, g->y + g->dy * (double)j, isfinite (z) ? z : 0), n);
}

static void
add_cell (bt__soup *soup, const bt_heights *g, long i, long j, uint32_t first)
{
  uint32_t k = first + (uint32_t)j * (uint32_t)g->nx + (uint32_t)i, up = k + (uint32_t)g->nx;
  int a = isfinite (post (g, i, j)), b = isfinite (post (g, i + 1, j));
  int c = isfinite (post (g, i, j + 1)), d = isfinite (post (g, i + 1, j + 1));
  if (a && b && c)
    bt__add_triangle (soup, k, k + 1, up);
  if (b && c && d)
    bt__add_triangle (soup, k + 1, up + 1, up);
}

static void
add_field (bt__soup *soup, const bt_thing *t)
{
  const bt_heights *g = &t->grid;
  uint32_t first = (uint32_t)soup->n;
  soup->stuff = stuff_of (t->color, 255, BT__EDGE_NONE, BT__GROUND, 0);
  for (long j = 0; j < (long)g->ny; j++)
    for (long i = 0; i < (long)g->nx; i++)
      add_post (soup, g, i, j);
  for (long j = 0; j + 1 < (long)g->ny; j++)
    for (long i = 0; i + 1 < (long)g->nx; i++)
      add_cell (soup, g, i, j, first);
}

void
bt__add_thing (bt__soup *soup, const bt_view *view, const bt_thing *t, double reach)
{
  soup->stuff = stuff_of (t->color, 255, BT__EDGE_LINE, BT__MATTE, 24);
  switch (t->kind)
    {
    case BT_THING_TUBE:
      add_painted_tube (soup, view, t);
      break;
    case BT_THING_LINES:
      add_lines (soup, t);
      break;
    case BT_THING_ARROW:
      draw_arrow (soup, t);
      break;
    case BT_THING_MARK:
      add_mark (soup, t);
      break;
    case BT_THING_LEVEL:
      draw_level (soup, t, reach);
      break;
    case BT_THING_FIELD:
      add_field (soup, t);
      break;
    case BT_THING_VEHICLE:
      bt__add_vehicle (soup, t);
      break;
    case BT_THING_ANCHOR:
      bt__add_anchor (soup, t);
      break;
    case BT_THING_SHIP:
      bt__add_ship (soup, t);
      break;
    case BT_THING_LABEL:
      break;
    default:
      add_solid (soup, t);
    }
}
