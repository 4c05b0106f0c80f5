/* See play.h.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <stddef.h>

#include "testbed/play.h"

enum
{
  PARTS = 64 /* of a step, to see a tether from a mover that turns */
};

/* ---- Proposals ---- */

static void
propose (stage *g, dice *d, bt_vec3 want[NODES])
{
  int style = dice_below (d, 6);
  bt_vec3 jump = dice_point (d, style == 0 ? 20 : 1), pull = dice_point (d, 8);
  double noise = pow (10, dice_between (d, -3, 0.7));
  for (int i = 0; i < NODES; i++)
    {
      double u = (double)i / (NODES - 1);
      want[i] = bt__axpy (g->x[i], style == 0 ? u : style == 1 ? 1 : 0, jump);
      if (style == 2) /* straight to somewhere */
        want[i] = bt__axpy (g->x[0], u, bt__sub (pull, g->x[0]));
      else if (style >= 3)
        want[i] = bt__add (bt__axpy (g->x[i], 0.2, bt__sub (pull, g->x[i])), dice_point (d, noise));
      int bad = dice_below (d, 300);
      if (bad == 0)
        want[i].y = NAN;
      else if (bad == 1)
        want[i] = dice_point (d, 1e9);
      else if (bad == 2)
        want[i].x = INFINITY;
    }
}

/* ---- The judge ---- */

int
crossings (const stage *g, const bt_vec3 *from, const bt_vec3 *to)
{
  int sum = 0;
  for (int i = 0; i < g->bones; i++)
    sum += sweep_crossings (from, to, NODES, g->bone + i);
  for (int i = 0; i < g->sheets; i++)
    sum += sweep_sheet (from, to, NODES, g->sheet + i);
  return sum;
}

double
clearance (const stage *g, const bt_vec3 *x)
{
  double least = INFINITY;
  for (int j = 0; j + 1 < NODES; j++)
    {
      bt__link link = { x[j], x[j + 1] };
      for (int i = 0; i < g->solids; i++)
        least = fmin (least, solid_brute (g->solid + i, &link));
      for (int i = 0; i < g->sheets; i++)
        {
          solid s = { .kind = SOLID_TRIANGLE };
          for (int k = 0; k < 3; k++)
            s.triangle.v[k] = g->sheet[i].v[k];
          least = fmin (least, solid_brute (&s, &link));
        }
    }
  return least;
}

static bt_vec3
between (bt_vec3 a, bt_vec3 b, double t)
{
  return bt__axpy (a, t, bt__sub (b, a));
}

/* The same seen from mover M, which has taken its way.  */
static int
mover_crossings (const stage *g, const bt__mover *m, const bt_vec3 *from, const bt_vec3 *to)
{
  bt_vec3 old[NODES], new[NODES];
  int sum = 0;
  for (int part = 0; part <= PARTS; part++)
    {
      double t = (double)part / PARTS;
      bt__frame f = bt__motion_at (&m->motion, m->done * t);
      for (int i = 0; i < NODES; i++)
        {
          old[i] = new[i];
          new[i] = bt__to_local (&f, between (from[i], to[i], t));
        }
      if (part > 0)
        sum += sweep_crossings (old, new, NODES, &g->bar_bone);
    }
  return sum;
}

static double
mover_clearance (const stage *g, const bt_vec3 *x)
{
  double least = INFINITY;
  for (int m = 0; m < g->movers; m++)
    for (int j = 0; j + 1 < NODES; j++)
      {
        bt__link link = { bt__to_local (g->at + m, x[j]), bt__to_local (g->at + m, x[j + 1]) };
        least = fmin (least, solid_brute (&g->bar_solid, &link));
      }
  return least;
}

/* Somewhere else, mostly towards the tether; jumps too.  */
static void
send_mover (stage *g, dice *d, int m)
{
  bt_vec3 to = dice_below (d, 3) ? g->x[dice_below (d, NODES)] : dice_point (d, 8);
  bt__motion way = { .from = g->at[m], .axis = dice_direction (d) };
  way.travel = bt__scale (pow (10, dice_between (d, -3, 0)), bt__sub (to, g->at[m].origin));
  way.angle = dice_below (d, 2) ? dice_between (d, 0, 3) : 0;
  g->mover[m] = (bt__mover){ g->bar, NULL, way, g->bar_radius, 1 };
}

static void
look_at_movers (stage *g, const bt_vec3 *before, verdict *v)
{
  for (int m = 0; m < g->movers; m++)
    {
      v->crossings += mover_crossings (g, g->mover + m, before, g->x);
      v->pinched += g->mover[m].done < 1;
      g->at[m] = squared_frame (bt__motion_at (&g->mover[m].motion, g->mover[m].done));
    }
}

verdict
play (stage *g, dice *d, long n, double core)
{
  bt__safe_config config = { core, 2, 1 };
  verdict v = { .least = INFINITY };
  for (long i = 0; i < n; i++)
    {
      bt_vec3 before[NODES], want[NODES];
      bt__safe_report report;
      propose (g, d, want);
      for (int k = 0; k < NODES; k++)
        before[k] = g->x[k];
      for (int m = 0; m < g->movers; m++)
        send_mover (g, d, m);
      bt__safe_step (g->safe, &config, g->scene, NULL, g->mover, (uint32_t)g->movers, g->x, want,
                     NODES, &report, &g->count);
      v.crossings += crossings (g, before, g->x);
      v.truncated += report.truncated;
      v.overflows += report.overflows;
      look_at_movers (g, before, &v);
      if (g->has_ring)
        v.unlinked += !(fabs (sweep_linking (before, g->x, NODES, g->ring, RING)) < 0.01);
      if (i % 20 == 0)
        v.least = fmin (v.least, fmin (clearance (g, g->x), mover_clearance (g, g->x)));
    }
  v.too_near = !(v.least >= core);
  return v;
}
