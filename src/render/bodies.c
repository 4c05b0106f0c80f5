/* Bodies that people know: the vehicle, the boat, the frame a tether hangs from.

   The vehicle is a small open-frame inspection ROV: two dark side plates, bright floats on top with
   an orange nose, a clear tube with a dome in front, thrusters on its sides.  Lengths are shares of
   the length of the vehicle; the whole is then stretched to the size of the hull.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <math.h>

#include "math/vec.h"
#include "render/soup.h"

/* A body under construction: The pose of the vehicle, and the metres of one unit: along its axes,
   and of round parts.  */
typedef struct builder
{
  bt__soup *soup;
  bt__pose pose;
  bt_vec3 unit;
  double round;
} builder;

static builder
build (bt__soup *soup, const bt_thing *thing, bt_vec3 unit)
{
  bt__pose pose = bt__pose_of (thing->at, thing->heading, thing->pitch, thing->roll);
  return (builder){ soup, pose, unit, cbrt (unit.x * unit.y * unit.z) };
}

static bt_vec3
place (const builder *b, double x, double y, double z)
{
  return bt__pose_point (&b->pose, b->unit.x * x, b->unit.y * y, b->unit.z * z);
}

static void
paint (builder *b, bt_color color, int gloss)
{
  bt__stuff_color (&b->soup->stuff, color);
  b->soup->stuff.gloss = (unsigned char)gloss;
}

static void
block (builder *b, bt_vec3 at, bt_vec3 size)
{
  bt__pose pose = b->pose;
  pose.at = place (b, at.x, at.y, at.z);
  size = bt__vec (b->unit.x * size.x, b->unit.y * size.y, b->unit.z * size.z);
  bt__add_box (b->soup, &pose, size);
}

static void
rod (builder *b, bt_vec3 from, bt_vec3 to, double r0, double r1)
{
  bt__add_cone (b->soup, place (b, from.x, from.y, from.z), place (b, to.x, to.y, to.z),
                b->round * r0, b->round * r1, 1);
}

static void
ball (builder *b, bt_vec3 at, double r)
{
  bt__add_sphere (b->soup, place (b, at.x, at.y, at.z), b->round * r);
}

static const bt_color dark = { 0.11F, 0.12F, 0.14F }, steel = { 0.55F, 0.57F, 0.6F },
                      glass = { 0.55F, 0.75F, 0.85F }, white = { 0.93F, 0.94F, 0.95F },
                      black = { 0.03F, 0.03F, 0.04F }, lamp = { 1, 0.97F, 0.85F },
                      orange = { 1, 0.55F, 0.08F };

/* ---- The vehicle ---- */

/* A duct about a dark hub, its axis along AXIS.  */
static void
thruster (builder *b, bt_vec3 at, bt_vec3 axis)
{
  bt_vec3 half = bt__scale (0.075, axis);
  paint (b, dark, 60);
  rod (b, bt__sub (at, half), bt__add (at, half), 0.1, 0.1);
  paint (b, steel, 120);
  rod (b, bt__axpy (at, -1.03, half), bt__axpy (at, 1.03, half), 0.045, 0.045);
}

static void
frame (builder *b)
{
  for (int s = -1; s <= 1; s += 2)
    {
      paint (b, dark, 40);
      block (b, bt__vec (0.33 * s, 0, -0.05), bt__vec (0.03, 0.94, 0.44));
      block (b, bt__vec (0.33 * s, 0, -0.29), bt__vec (0.07, 0.8, 0.03)); /* skid */
    }
  block (b, bt__vec (0, 0, -0.24), bt__vec (0.66, 0.5, 0.02));
}

/* Their noses are of another colour: which way it heads is seen from afar.  */
static void
floats (builder *b, bt_color color)
{
  for (int s = -1; s <= 1; s += 2)
    {
      paint (b, color, 50);
      block (b, bt__vec (0.19 * s, -0.1, 0.2), bt__vec (0.24, 0.66, 0.13));
      paint (b, orange, 50);
      block (b, bt__vec (0.19 * s, 0.33, 0.2), bt__vec (0.24, 0.2, 0.13));
      paint (b, white, 50);
      block (b, bt__vec (0.19 * s, -0.1, 0.268), bt__vec (0.1, 0.5, 0.008)); /* its stripe */
    }
}

static void
hull (builder *b)
{
  paint (b, white, 140);
  rod (b, bt__vec (0, -0.36, 0), bt__vec (0, 0.34, 0), 0.125, 0.125);
  paint (b, glass, 255);
  ball (b, bt__vec (0, 0.35, 0), 0.122);
  paint (b, black, 255);
  ball (b, bt__vec (0, 0.41, 0), 0.075); /* the camera's eye */
  paint (b, steel, 120);
  rod (b, bt__vec (0, -0.3, -0.17), bt__vec (0, 0.3, -0.17), 0.07, 0.07); /* battery */
  for (int s = -1; s <= 1; s += 2)
    {
      paint (b, dark, 80);
      rod (b, bt__vec (0.22 * s, 0.36, -0.13), bt__vec (0.22 * s, 0.46, -0.13), 0.045, 0.055);
      paint (b, lamp, 255);
      ball (b, bt__vec (0.22 * s, 0.46, -0.13), 0.04);
    }
}

static void
thrusters (builder *b)
{
  for (int s = -1; s <= 1; s += 2)
    {
      thruster (b, bt__vec (0.46 * s, 0.22, 0.12), bt__vec (0, 0, 1));
      thruster (b, bt__vec (0.46 * s, -0.22, 0.12), bt__vec (0, 0, 1));
      thruster (b, bt__vec (0.2 * s, 0.36, -0.05), bt__vec (0.7 * s, 0.7, 0));
      thruster (b, bt__vec (0.2 * s, -0.38, -0.05), bt__vec (-0.7 * s, 0.7, 0));
      paint (b, dark, 40);
      block (b, bt__vec (0.4 * s, 0.22, 0.02), bt__vec (0.14, 0.05, 0.03));
      block (b, bt__vec (0.4 * s, -0.22, 0.02), bt__vec (0.14, 0.05, 0.03));
    }
}

enum
{
  LEAST_VEHICLE = 26 /* pixels of a picture 720 high */
};

double
bt__vehicle_growth (const bt__lens *lens, const bt_thing *thing)
{
  double least = LEAST_VEHICLE * bt__stroke (lens) * bt__pixel_at (lens, thing->at);
  return fmax (1, least / fmax (thing->size.y, 1e-3));
}

void
bt__add_vehicle (bt__soup *soup, const bt_thing *thing)
{
  static const bt_vec3 built = { 1.258, 1, 0.556 }; /* breadth, length and height of what follows */
  double growth = bt__vehicle_growth (&soup->lens, thing);
  builder b = build (soup, thing,
                     bt__vec (growth * thing->size.x / built.x, growth * thing->size.y / built.y,
                              growth * thing->size.z / built.z));
  soup->stuff.fog = 150;
  frame (&b);
  floats (&b, thing->color);
  hull (&b);
  thrusters (&b);
}

/* ---- Above ---- */

/* Half the breadth of the boat at Y from the stern to the bow, both in parts of its length.  */
static double
half_breadth (double y)
{
  double t = (y + 0.5) / 1;
  return 0.155
         * (t < 0.55 ? 0.86 + 0.14 * sin (BT__PI / 2 * t / 0.55)
                     : cos (BT__PI / 2 * pow ((t - 0.55) / 0.45, 1.6)));
}

enum
{
  STATIONS = 20
};

/* The hull's side S (1 starboard), from the keel line up to the rail.  */
static void
hull_side (builder *b, int s)
{
  for (int i = 0; i < STATIONS; i++)
    {
      double y0 = -0.5 + (double)i / STATIONS, y1 = y0 + 1.0 / STATIONS;
      double w0 = s * half_breadth (y0), w1 = s * half_breadth (y1);
      bt_vec3 rail0 = place (b, w0, y0, 0.09), rail1 = place (b, w1, y1, 0.09);
      bt_vec3 low0 = place (b, 0.75 * w0, y0, -0.05), low1 = place (b, 0.75 * w1, y1, -0.05);
      bt_vec3 deck0 = place (b, 0, y0, 0.09), deck1 = place (b, 0, y1, 0.09);
      bt_vec3 keel0 = place (b, 0, y0, -0.08), keel1 = place (b, 0, y1, -0.08);
      bt__add_flat (b->soup, rail0, low0, low1);
      bt__add_flat (b->soup, rail0, low1, rail1);
      bt__add_flat (b->soup, low0, keel0, keel1);
      bt__add_flat (b->soup, low0, keel1, low1);
      bt__add_flat (b->soup, deck0, rail0, rail1);
      bt__add_flat (b->soup, deck0, rail1, deck1);
    }
}

static void
transom (builder *b)
{
  double w = half_breadth (-0.5);
  bt_vec3 keel = place (b, 0, -0.5, -0.08);
  bt__add_flat (b->soup, place (b, -w, -0.5, 0.09), place (b, w, -0.5, 0.09), keel);
}

void
bt__add_ship (bt__soup *soup, const bt_thing *thing)
{
  double l = thing->size.y;
  builder b = build (soup, thing, bt__vec (l, l, l));
  soup->stuff.fog = 120;
  paint (&b, thing->color, 60);
  hull_side (&b, 1);
  hull_side (&b, -1);
  transom (&b);
  paint (&b, white, 60);
  block (&b, bt__vec (0, 0.1, 0.15), bt__vec (0.2, 0.26, 0.12)); /* the wheelhouse */
  paint (&b, dark, 200);
  block (&b, bt__vec (0, 0.1, 0.17), bt__vec (0.204, 0.264, 0.045));
  paint (&b, steel, 80);
  rod (&b, bt__vec (0, 0.05, 0.2), bt__vec (0, 0.05, 0.36), 0.007, 0.005); /* mast */
}

/* ---- Below ---- */

/* An open frame about the point a tether comes from, seen from afar at LEAST pixels.  */
void
bt__add_anchor (bt__soup *soup, const bt_thing *thing)
{
  double least = 14 * bt__stroke (&soup->lens) * bt__pixel_at (&soup->lens, thing->at);
  double l = fmax (thing->size.y, least);
  builder b = build (soup, thing, bt__vec (l, l, l));
  soup->stuff.fog = 150;
  paint (&b, thing->color, 60);
  for (int i = 0; i < 4; i++)
    {
      double s = i & 1 ? 0.5 : -0.5, t = i & 2 ? 0.5 : -0.5;
      rod (&b, bt__vec (s, t, -0.5), bt__vec (s, t, 0.5), 0.05, 0.05);
      rod (&b, bt__vec (s, -0.5, t), bt__vec (s, 0.5, t), 0.05, 0.05);
      rod (&b, bt__vec (-0.5, s, t), bt__vec (0.5, s, t), 0.05, 0.05);
    }
  paint (&b, dark, 60);
  ball (&b, bt__vec (0, 0, 0), 0.16);
}
