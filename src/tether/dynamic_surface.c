/* The moving line: where the line comes out of the water.

   A metre of line is borne up by B = m g - w, its weight in air less its weight in water.  Line
   above the surface has lost B, and is neither dragged by water nor carries added mass.  On the
   surface lies a layer with the thickness of ripples, in which buoyancy goes as 1 - u^2 (3 - 2 u),
   u from 0 at the bottom of the layer to 1 at its top: a force with a potential, part of the
   iteration.  The share of water for drag is held for a step.

   An interval that pierces the surface has lost what of it is above: the loss is integrated along
   the straight interval and shared out to its nodes by the lever, so that a line that is lifted
   grows heavier by its length in air and not by leaps from node to node.  What is lumped at a node
   goes by the node alone.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include "model/current.h"
#include "tether/dynamic_kernel.h"

enum
{
  CHUNK = 64 /* nodes whose surface is asked for at once */
};

#define LAYER 0.1 /* m */
#define LEVEL 0.5 /* of the layer: an interval that rises less is integrated by points */

/* What of an interval is out of the water.  */
typedef struct air
{
  double first, second; /* m, at its two nodes */
  double aa, ab, bb;    /* change of these by the heights of the two nodes */
  double energy;        /* m2: their integral over the height */
} air;

/* How far Z is up the layer on the surface at LEVEL: below 0 in the water, above 1 in the air.
 */
static double
rise (double z, double level)
{
  return (z - level) / LAYER;
}

/* The share of a line at U that is out of the water, its integral over U from 0, and that one's. */
static double
out_of_water (double u)
{
  return u <= 0 ? 0 : u >= 1 ? 1 : u * u * (3 - 2 * u);
}

static double
out_so_far (double u)
{
  return u <= 0 ? 0 : u >= 1 ? u - 0.5 : u * u * u * (1 - 0.5 * u);
}

static double
sum_so_far (double u)
{
  return u <= 0 ? 0 : u >= 1 ? 0.5 * u * (u - 1) + 0.15 : u * u * u * u * (0.25 - 0.1 * u);
}

static double
steepness (double u)
{
  return u <= 0 || u >= 1 ? 0 : 6 * u * (1 - u);
}

/* An interval from A up to B in the layer, which differ by much: integrated by parts.  */
static air
steep_air (double a, double b)
{
  double d = b - a, whole = (out_so_far (b) - out_so_far (a)) / d;
  double sum = (sum_so_far (b) - sum_so_far (a)) / d, second = (out_so_far (b) - sum) / d;
  double s0 = (out_of_water (b) - out_of_water (a)) / d, s1 = (out_of_water (b) - whole) / d,
         s2 = (out_of_water (b) - 2 * second) / d;
  return (air){ whole - second, second, s0 - 2 * s1 + s2, s1 - s2, s2, sum };
}

/* One nearly level: Gauss' rule of four points.  */
static air
level_air (double a, double b)
{
  static const double place[]
      = { 0.069431844202973712, 0.33000947820757187, 0.66999052179242813, 0.93056815579702629 },
      weight[]
      = { 0.17392742256872693, 0.32607257743127307, 0.32607257743127307, 0.17392742256872693 };
  air p = { 0 };
  for (int k = 0; k < 4; k++)
    {
      double y = place[k], x = 1 - y, u = a + y * (b - a), o = weight[k] * out_of_water (u),
             s = weight[k] * steepness (u);
      p.first += x * o;
      p.second += y * o;
      p.aa += x * x * s;
      p.ab += x * y * s;
      p.bb += y * y * s;
      p.energy += weight[k] * out_so_far (u);
    }
  return p;
}

/* What of REST metres between A and B up the layer is out of the water.  */
static air
air_between (double rest, double a, double b)
{
  if (!(a > 0 || b > 0) || !isfinite (a) || !isfinite (b))
    return (air){ 0 };
  if (a >= 1 && b >= 1)
    return (air){ 0.5 * rest, 0.5 * rest, 0, 0, 0, rest * LAYER * 0.5 * (a + b - 1) };
  air p = fabs (b - a) < LEVEL ? level_air (a, b) : steep_air (a, b);
  double k = rest / LAYER;
  return (air){ rest * p.first, rest * p.second, k * p.aa,
                k * p.ab,       k * p.bb,        rest * LAYER * p.energy };
}

/* The same of interval J at the iterate.  */
static air
air_in (const bt__dynamic_work *w, int j)
{
  return air_between (w->link[j].rest, rise (w->X[j].z, w->node[j].level),
                      rise (w->X[j + 1].z, w->node[j + 1].level));
}

/* ---- What a step knows ---- */

/* Ask for the surface at nodes FROM to TO.  */
static void
ask_levels (bt__dynamic_work *w, int from, int to)
{
  double level[CHUNK];
  for (int i = from; i <= to; i += CHUNK)
    {
      int count = to - i < CHUNK ? to - i + 1 : CHUNK;
      bt__water_surfaces (w->in->water, w->X + i, (size_t)count, level);
      for (int k = 0; k < count; k++)
        w->node[i + k].level = level[k];
    }
}

/* Ask for the surface at the nodes of intervals near the surface, note the intervals, and return
   true if there are any.  */
static int
find_levels (bt__dynamic_work *w)
{
  double trough = -bt_water_crest (w->in->water);
  int any = 0, asked = -1, n = w->n; /* ASKED: the last node that was */
  w->near_from = w->near_to = 0;
  for (int i = 0; i <= n; i++)
    {
      int first = i > 0 ? i - 1 : 0, last = i;
      if (!(w->X[i].z > trough))
        continue;
      while (last < n && w->X[last + 1].z > trough)
        last++;
      i = last;
      last = last < n ? last + 1 : n;
      ask_levels (w, first > asked ? first : asked + 1, last);
      asked = last;
      if (!any)
        w->near_from = first;
      w->near_to = last;
      any = 1;
    }
  return any;
}

void
bt__dynamic_surface_prepare (bt__dynamic_work *w)
{
  const bt_water *water = w->in->water;
  w->lift = fmax (0, w->m * water->gravity - w->weight);
  for (int i = 0; i <= w->n; i++)
    {
      w->node[i].wet = w->node[i].cell;
      w->node[i].level = INFINITY; /* deeper than that no wave is asked for */
    }
  w->surfaced = w->in->surfaced && water->density > 0 && find_levels (w);
  for (int i = w->near_from; w->surfaced && i <= w->near_to; i++)
    w->node[i].wet = fmax (0, w->node[i].cell - bt__dynamic_line_out (w, i));
}

double
bt__dynamic_line_out (const bt__dynamic_work *w, int i)
{
  double before = w->surfaced && i > 0 ? air_in (w, i - 1).second : 0;
  return before + (w->surfaced && i < w->n ? air_in (w, i).first : 0);
}

double
bt__dynamic_out_of_water (const bt__dynamic_work *w, int i)
{
  return w->surfaced ? out_of_water (rise (w->X[i].z, w->node[i].level)) : 0;
}

/* ---- Forces and potential ---- */

/* What is lumped at the nodes.  */
static void
lumps_force (bt__dynamic_work *w)
{
  for (int i = w->lo; i <= w->hi; i++)
    {
      double u = rise (w->X[i].z, w->node[i].level), lift = w->extra[i].lift;
      if (u <= 0)
        continue;
      w->rhs[i].z -= lift * out_of_water (u);
      w->diag[i].zz += lift * steepness (u) / LAYER;
    }
}

void
bt__dynamic_surface_force (bt__dynamic_work *w)
{
  double out = 0; /* of the interval before, at the node */
  for (int j = w->near_from; j < w->near_to; j++)
    {
      air p = air_in (w, j);
      w->rhs[j].z -= w->lift * (out + p.first);
      w->diag[j].zz += w->lift * p.aa;
      w->diag[j + 1].zz += w->lift * p.bb;
      w->off[j].zz -= w->lift * p.ab;
      out = p.second;
    }
  w->rhs[w->near_to].z -= w->lift * out;
  if (w->bodies)
    lumps_force (w);
}

double
bt__dynamic_surface_potential (const bt__dynamic_work *w)
{
  double sum = 0;
  for (int j = w->near_from; j < w->near_to; j++)
    sum += w->lift * air_in (w, j).energy;
  for (int i = w->lo; w->bodies && i <= w->hi; i++)
    sum += w->extra[i].lift * LAYER * out_so_far (rise (w->X[i].z, w->node[i].level));
  return sum;
}

double
bt__dynamic_out (const bt_water *water, double rest, bt_vec3 from, bt_vec3 to)
{
  double trough = -bt_water_crest (water);
  if (from.z <= trough && to.z <= trough)
    return 0;
  return air_between (rest, rise (from.z, bt_water_surface (water, from)),
                      rise (to.z, bt_water_surface (water, to)))
      .energy;
}
