/* The scenes of stability_flight.h, and who flies in them: the jacket is drawn, the others are the
   worlds of their names.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <stdlib.h>

#include "stability_flight.h"

/* Turned by A about the vertical, clockwise seen from above.  */
static bt_vec3
turned (bt_vec3 p, double a)
{
  return bt__vec (p.x * cos (a) + p.y * sin (a), p.y * cos (a) - p.x * sin (a), p.z);
}

/* ---- Rigging ---- */

#define RIGGING_FOOT (-25.0)

static int
raise_rigging (reef *r)
{
  const double foot = RIGGING_FOOT;
  if (!reef_open (r))
    return 0;
  for (int i = -1; i <= 1; i += 2)
    {
      double y = 5 * i;
      reef_wire (r, bt__vec (0, y, foot), bt__vec (0, y, foot + 12), 0.2);
      reef_wire (r, bt__vec (-3, y, foot + 8.4), bt__vec (3, y, foot + 8.4), 0.08);
      for (int side = -1; side <= 1; side += 2)
        for (int aft = -1; aft <= 1; aft += 2)
          reef_wire (r, bt__vec (3 * side, y + aft, foot), bt__vec (0, y, foot + 10.8), 0.01);
    }
  reef_wire (r, bt__vec (0, -5, foot + 12), bt__vec (0, 5, foot + 12), 0.01);
  reef_plane (r, foot);
  return reef_raise (r);
}

/* ---- Wreck ---- */

#define WRECK_FOOT (-24.0)
#define WRECK_TURN (20 * BT__PI / 180) /* heading; and list to starboard */
#define WRECK_BEAM 7.0
#define WRECK_FACET 0.7 /* m */

enum
{
  SLAB_VERTICES = 20000
};

/* Triangles of one surface that grows.  */
typedef struct skin
{
  bt_vec3 v[SLAB_VERTICES];
  uint32_t corner[2 * SLAB_VERTICES][3];
  uint32_t vertices, triangles;
} skin;

/* From the ship's own axes, upright on her keel, to where she lies.  */
static bt_vec3
in_wreck (double x, double y, double z)
{
  double c = cos (WRECK_TURN), s = sin (WRECK_TURN);
  bt_vec3 p = { x * c + z * s, y, z * c - x * s + WRECK_BEAM / 2 * s };
  return bt__add (turned (p, WRECK_TURN), bt__vec (0, 0, WRECK_FOOT));
}

/* The parallelogram at O with sides A and B, of the ship, in facets.  */
static void
add_face (skin *k, bt_vec3 o, bt_vec3 a, bt_vec3 b)
{
  int m = (int)ceil (bt__norm (a) / WRECK_FACET), n = (int)ceil (bt__norm (b) / WRECK_FACET);
  uint32_t first = k->vertices, row = (uint32_t)m + 1;
  for (int j = 0; j <= n; j++)
    for (int i = 0; i <= m; i++)
      {
        bt_vec3 p = bt__axpy (bt__axpy (o, (double)i / m, a), (double)j / n, b);
        k->v[k->vertices++] = in_wreck (p.x, p.y, p.z);
      }
  for (uint32_t j = 0; j < (uint32_t)n; j++)
    for (uint32_t i = 0; i < (uint32_t)m; i++)
      {
        uint32_t p = first + j * row + i, *t = k->corner[k->triangles++],
                 *u = k->corner[k->triangles++];
        t[0] = p;
        t[1] = u[0] = p + 1;
        t[2] = u[2] = p + row;
        u[1] = p + row + 1;
      }
}

static void
add_slab (skin *k, bt_vec3 centre, bt_vec3 size)
{
  bt_vec3 o = bt__axpy (centre, -0.5, size);
  bt_vec3 a = { size.x, 0, 0 }, b = { 0, size.y, 0 }, c = { 0, 0, size.z };
  add_face (k, o, a, b);
  add_face (k, o, b, c);
  add_face (k, o, c, a);
  add_face (k, bt__add (o, c), a, b);
  add_face (k, bt__add (o, a), b, c);
  add_face (k, bt__add (o, b), c, a);
}

static int
raise_wreck (reef *r)
{
  static const bt_vec3 slab[][2] = {
    { { -3.5, 0, 2 }, { 0.3, 30, 4 } },    { { 3.5, 0, 2 }, { 0.3, 30, 4 } },
    { { 0, 0, 0.15 }, { 7, 30, 0.3 } },    { { 0, -15, 2 }, { 7, 0.3, 4 } },
    { { 0, 15, 2 }, { 3.5, 0.3, 4 } },     { { 0, 9, 4 }, { 7, 12, 0.2 } },
    { { 0, -9.75, 4 }, { 7, 10.5, 0.2 } }, { { 0, -10.5, 5.5 }, { 4.2, 4.5, 3 } },
  };
  static skin k;
  k.vertices = k.triangles = 0;
  for (size_t i = 0; i < sizeof slab / sizeof *slab; i++)
    add_slab (&k, slab[i][0], slab[i][1]);
  bt__soup soup = { k.vertices, k.triangles, k.v, (const uint32_t (*)[3])k.corner, NULL };
  if (!reef_open (r) || !reef_soup (r, &soup))
    return 0;
  reef_wire (r, in_wreck (0, 7.5, 4), in_wreck (0, 7.5, 13), 0.2);
  reef_wire (r, in_wreck (0, -3.75, 4), in_wreck (0, -3.75, 15), 0.2);
  reef_wire (r, in_wreck (0, 15, 4), in_wreck (0, 7.5, 13), 0.01);
  reef_wire (r, in_wreck (0, 7.5, 13), in_wreck (0, -3.75, 15), 0.01);
  reef_wire (r, in_wreck (0, -3.75, 15), in_wreck (0, -15, 4), 0.01);
  reef_plane (r, WRECK_FOOT);
  return reef_raise (r);
}

/* ---- Canyon ---- */

enum
{
  CANYON_ACROSS = 121,
  CANYON_ALONG = 161
};

static double
canyon_bed (double x, double y)
{
  double off = fabs (x - 6 * sin (y / 8)) - 3, wall = fmax (0, fmin (1, off / 5));
  return -38 + 12 * wall * wall * (3 - 2 * wall) + 0.2 * sin (2 * x) * cos (3 * y);
}

static int
raise_canyon (reef *r)
{
  static double height[CANYON_ACROSS * CANYON_ALONG];
  for (int j = 0; j < CANYON_ALONG; j++)
    for (int i = 0; i < CANYON_ACROSS; i++)
      height[j * CANYON_ACROSS + i] = canyon_bed (-30 + 0.5 * i, -40 + 0.5 * j);
  bt__grid g = { CANYON_ACROSS, CANYON_ALONG, -30, -40, 0.5, 0.5, height };
  return reef_open (r) && reef_grid (r, &g) && reef_raise (r);
}

/* ---- Who flies ---- */

/* Where the line is laid, and the box in which a pilot's aims are.  */
typedef struct place
{
  int corners;
  bt_vec3 shape[FLIGHT_CORNERS];
  double length;
  bt_vec3 lo, hi;
} place;

static const place places[FLIGHT_KINDS] = {
  [FLIGHT_JACKET] = { 4,
                      { { -14, 0, -5 }, { -16, -20, -8 }, { -12, -20, -8 }, { -9, 0, -8 } },
                      60,
                      { -9, -9, -28 },
                      { 9, 9, -1 } },
  [FLIGHT_WRECK] = { 4,
                     { { -16, -18, -3 }, { -28, -14, -6 }, { -18, -2, -12 }, { -10, -8, -16 } },
                     44,
                     { -8, -14, -23.5 },
                     { 8, 14, -9 } },
  [FLIGHT_RIGGING] = { 4,
                       { { -12, -16, -4 }, { -22, -12, -8 }, { -14, -2, -14 }, { -8, -8, -18 } },
                       38,
                       { -5, -8, -24.8 },
                       { 5, 8, -12 } },
  [FLIGHT_CANYON] = { 4,
                      { { 0, -32, -22 }, { 10, -22, -20 }, { 0, -12, -20 }, { 0, -24, -33 } },
                      50,
                      { -9, -34, -37.5 },
                      { 9, 14, -27 } },
};

static const place *
place_of (const flight *f)
{
  return places + (f->kind == FLIGHT_HARM ? FLIGHT_JACKET : f->kind);
}

static bt_vec3
somewhere (const place *p, dice *d)
{
  double x = dice_between (d, p->lo.x, p->hi.x), y = dice_between (d, p->lo.y, p->hi.y);
  return bt__vec (x, y, dice_between (d, p->lo.z, p->hi.z));
}

/* Now and then elsewhere, and now and then the other way.  */
static void
draw_aims (flight *f, dice *d)
{
  const place *p = place_of (f);
  bt_vec3 at = somewhere (p, d);
  for (int i = 0; i < f->steps && f->aims < FLIGHT_AIMS; i++)
    {
      int new = dice_below (d, 240) == 0, about = dice_below (d, 240) == 0;
      if (new)
        at = somewhere (p, d);
      if (about)
        at = bt__sub (bt__add (p->lo, p->hi), at);
      if (new || about || i == 0)
        f->aim[f->aims++] = (flight_aim){ i, at };
    }
}

void
flight_draw (flight *f, uint64_t seed, long number)
{
  long turn = number / 2 % FLIGHT_HARM;
  *f = (flight){ .kind = number % 2 ? FLIGHT_HARM : (flight_kind)turn,
                 .harm = (flight_harm)turn,
                 .seed = seed * 1000003 + (uint64_t)number + 1,
                 .links = 100,
                 .steps = number % 2 ? FLIGHT_HARM_STEPS : FLIGHT_STEPS,
                 .friction = 0.3 };
  const place *p = place_of (f);
  dice d = dice_new (f->seed);
  f->corners = p->corners;
  f->length = p->length;
  for (int i = 0; i < p->corners; i++)
    f->shape[i] = p->shape[i];
  f->body = dice_below (&d, 2) && f->kind != FLIGHT_HARM;
  f->speed = f->kind == FLIGHT_HARM ? 5 : exp (dice_between (&d, log (0.3), log (5)));
  f->weight = dice_below (&d, 3) ? 0 : 0.5;
  double north = dice_between (&d, -0.2, 0.2), east = dice_between (&d, -0.2, 0.2);
  f->flow = bt__vec (east, north, 0);
  draw_aims (f, &d);
}

int
flight_scene (const flight *f, reef *r)
{
  int good = f->kind == FLIGHT_WRECK     ? raise_wreck (r)
             : f->kind == FLIGHT_RIGGING ? raise_rigging (r)
             : f->kind == FLIGHT_CANYON  ? raise_canyon (r)
                                         : reef_jacket (r, f->seed);
  for (int i = 0; good && i < r->obstacles; i++)
    if (f->gone[i])
      reef_take (r, i, 1);
  return good;
}
