/* Lines whose shortest form among one or two obstacles is known in closed form.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include "testbed/aware_cases.h"

const char *const exact_names[EXACT_KINDS] = { "pile 2.25 turns",   "thin pile 1 turn", "box edges",
                                               "S round two piles", "wire corner",      "sphere" };

/* From A at height 0 by ANGLE about a pile at 0 of radius R, then to height RISE; D the distance of
   both ends from the axis.  */
static double
round_pile (double r, double d, double angle, double rise)
{
  double flat = 2 * sqrt (d * d - r * r) + r * (angle - 2 * acos (r / d));
  return sqrt (flat * flat + rise * rise);
}

static uint32_t
wind (double r, double d, double angle, double rise, double mesh, bt_vec3 *p)
{
  bt_vec3 way[400];
  int n = 0;
  for (int i = 0; i <= 200; i++)
    {
      double u = i / 200.0, w = angle * u, off = r + (d - r) * pow (fabs (2 * u - 1), 3);
      way[n++] = bt__vec (off * cos (w), -off * sin (w), rise * u);
    }
  return refine (way, (uint32_t)n, mesh, p);
}

static uint32_t
pile_case (double r, double angle, double rise, double core, int links, stage *g, bt_vec3 *p,
           double *length)
{
  double d = 2.5;
  stage_cylinder (g, bt__vec (0, 0, 20), bt__vec (0, 0, -20), r);
  *length = round_pile (r + core, d, angle, rise);
  return wind (1.2 * r + 0.05, d, angle, rise, *length / links, p);
}

/* Over a box 4 m wide, each end DOWN below its top and OUT beside it, SHIFT apart along it.  */
static uint32_t
box_case (double core, int links, stage *g, bt_vec3 *p, double *length)
{
  double out = 1, down = 1.5, shift = 3, flat = 0;
  bt_vec3 way[4]
      = { { -2 - out, 0, -down }, { -2.2, 1, 0.8 }, { 2.3, 2, 0.6 }, { 2 + out, shift, -down } };
  stage_box (g, bt__vec (0, 0, -5), bt__vec (2, 40, 5));
  /* Round each edge an arc of radius core: unrolled, a straight line.  */
  double far = sqrt (out * out + down * down), turn = acos (core / far);
  double arc = BT__PI / 2 + atan2 (down, out) - turn;
  flat = 4 + 2 * (sqrt (far * far - core * core) + core * arc);
  *length = sqrt (flat * flat + shift * shift);
  return refine (way, 4, *length / links, p);
}

static uint32_t
two_piles_case (double core, int links, stage *g, bt_vec3 *p, double *length)
{
  double r = 0.5 + core, gap = 4, out = 3;
  bt_vec3 way[6] = { { -gap / 2 - out, 0, 0 }, { -gap / 2, 1.5, 0.2 }, { -0.6, 1.2, 0.3 },
                     { 0.6, -1.2, 0.5 },       { gap / 2, -1.5, 0.8 }, { gap / 2 + out, 0, 1 } };
  stage_cylinder (g, bt__vec (-gap / 2, 0, 20), bt__vec (-gap / 2, 0, -20), 0.5);
  stage_cylinder (g, bt__vec (gap / 2, 0, 20), bt__vec (gap / 2, 0, -20), 0.5);
  double inner = sqrt (gap * gap / 4 - r * r), lean = acos (2 * r / gap);
  double arc = BT__PI - acos (r / out) - lean;
  double flat = 2 * (sqrt (out * out - r * r) + r * arc + inner);
  *length = sqrt (flat * flat + 1);
  return refine (way, 6, *length / links, p);
}

static uint32_t
wire_case (double core, int links, stage *g, bt_vec3 *p, double *length)
{
  double r = 0.0025 + core, d = 4, angle = 2.2;
  bt_vec3 way[3] = { { d, 0, 0 },
                     { 0.3 * cos (1.1), 0.3 * sin (1.1), 1 },
                     { d * cos (angle), d * sin (angle), 2 } };
  stage_capsule (g, bt__vec (0, 0, 20), bt__vec (0, 0, -20), 0.0025);
  /* The line goes round the far side of the wire.  */
  way[1] = bt__scale (-0.2, way[1]);
  way[1].z = 1;
  double sweep = 2 * BT__PI - angle;
  *length = round_pile (r, d, sweep, 2);
  return refine (way, 3, *length / links, p);
}

/* Over the top, though the shortest way is level.  */
static uint32_t
sphere_case (double core, int links, stage *g, bt_vec3 *p, double *length)
{
  double r = 1 + core, d = 2.5, angle = 3;
  bt_vec3 way[12];
  stage_sphere (g, bt__vec (0, 0, 0), 1);
  way[0] = bt__vec (d, 0, 0);
  for (int i = 1; i < 11; i++)
    {
      double w = angle * i / 11, up = 1.2 * sin (BT__PI * i / 11.0);
      bt_vec3 u = bt__vec (cos (w), sin (w), up);
      way[i] = bt__scale (1.3 / bt__norm (u), u);
    }
  way[11] = bt__vec (d * cos (angle), d * sin (angle), 0);
  *length = 2 * sqrt (d * d - r * r) + r * (angle - 2 * acos (r / d));
  return refine (way, 12, *length / links, p);
}

uint32_t
exact_case (exact_kind k, double core, int links, stage *g, bt_vec3 *p, double *length)
{
  uint32_t n;
  stage_clear (g);
  switch (k)
    {
    case EXACT_PILE:
      n = pile_case (0.9, 4.5 * BT__PI, 3, core, links, g, p, length);
      break;
    case EXACT_THIN_PILE:
      n = pile_case (0.3, 2 * BT__PI, 1, core, links, g, p, length);
      break;
    case EXACT_BOX:
      n = box_case (core, links, g, p, length);
      break;
    case EXACT_TWO_PILES:
      n = two_piles_case (core, links, g, p, length);
      break;
    case EXACT_WIRE:
      n = wire_case (core, links, g, p, length);
      break;
    default:
      n = sphere_case (core, links, g, p, length);
    }
  stage_make (g);
  return n;
}
