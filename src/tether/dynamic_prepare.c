/* The moving line: what a step knows before it is solved.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <string.h>

#include "tether/dynamic_kernel.h"

#define SLACK 1e-5         /* of EA: what resists a change of length in a step, ... */
#define SLACK_INERTIA 0.05 /* ... and at most this of the inertia that does */

/* The tension is T = ka (chord - zero), with the backward difference of the stretch in it.  The
   activity test adds to the multiplier the tension a node's inertia would make of the stretch.  A
   slack interval would be free of all stiffness, on which the iteration walks: every interval
   resists its change of length in the step a little.  A spring to the rest length would do, but it
   stores energy that no line has.  */
static void
prepare_links (bt__dynamic_work *w, const bt__dynamic *d, double rest0)
{
  const double *rest = bt__dynamic_rest (d), *e = bt__dynamic_stretch (d),
               *de = bt__dynamic_dstretch (d), *tension = bt__dynamic_tension (d);
  double ba = w->in->line->ba, kb = w->ea + ba * w->b0;
  double stiff = w->ea / kb, ba0 = ba * w->b0 / kb, ba2 = ba * w->b2 / kb;
  w->rho = w->b0 * w->b0 * w->m * kb / w->ea;
  w->soft = SLACK * stiff;
  w->inertia = SLACK_INERTIA * w->b0 * w->b0 * w->m;
  double before = 0;
  for (int j = 0; j < w->n; j++)
    {
      bt__link *k = w->link + j;
      k->rest = j ? rest[j] : rest0;
      w->node[j].cell = 0.5 * (before + k->rest);
      before = k->rest;
      k->ka = kb / k->rest;
      k->zero = k->rest * (stiff + ba0 * e[j] + ba2 * de[j]);
      k->start = e[j] * rest[j];
      k->thrust = 0;
      k->active = -1;
      w->lam[j] = tension[j];
    }
  w->node[w->n].cell = 0.5 * before;
}

void
bt__dynamic_round (bt__dynamic_work *w, int64_t j, double round)
{
  if (w->chord || (round == 0 && !w->rounded))
    return;
  if (!w->rounded)
    memset (w->round, 0, (size_t)w->n * sizeof *w->round);
  w->rounded = 1;
  w->link[j].zero += round - w->round[j];
  w->link[j].start += round - w->round[j];
  w->round[j] = round;
}

/* The end of a step is taken to its place; any other node goes on as it does.  */
static void
prepare_nodes (bt__dynamic_work *w, const bt__dynamic *d)
{
  const bt_vec3 *v = bt__dynamic_v (d), *dx = bt__dynamic_dx (d), *vp = bt__dynamic_vp (d);
  double h = w->in->h, r = w->b2 > 0 ? h / d->h : 0;
  bt__pair b1 = { w->b1, w->b1 }, b2 = { w->b2, w->b2 }, ahead = { h, h },
           half = { 0.5 * r, 0.5 * r };
  for (int i = 0; i <= w->n; i += 2)
    {
      int j = i < w->n ? i + 1 : i;
      bt__node *p = w->node + i, *q = w->node + j;
      bt__pair_vec now = bt__pair_load (v + i, v + j), before = bt__pair_load (vp + i, vp + j);
      bt__pair_vec speed = bt__pair_axpy (now, half, bt__pair_sub (now, before));
      bt__pair_vec x = bt__pair_load (w->x + i, w->x + j);
      bt__pair_store (&p->v0, &q->v0, bt__pair_scale (-b2, bt__pair_load (dx + i, dx + j)));
      bt__pair_store (&p->a0, &q->a0, bt__pair_axpy (bt__pair_scale (b1, now), b2, before));
      bt__pair_store (w->X + i, w->X + j, bt__pair_axpy (x, ahead, speed));
    }
  w->lo = w->in->end[0].free ? 0 : 1;
  w->hi = w->in->end[1].free ? w->n : w->n - 1;
  if (w->lo > 0)
    w->X[0] = w->in->end[0].at;
  if (w->hi < w->n)
    w->X[w->n] = w->in->end[1].at;
}

static int
has_waves (const bt_water *water)
{
  return water->sea && water->sea->waves && water->sea->waves->n > 0;
}

/* Velocities of the water, and where there are waves its accelerations, to the spare.  */
static void
sample_current (bt__dynamic_work *w)
{
  const bt_water *water = w->in->water;
  int same = bt_water_is_uniform (water);
  bt_vec3 u = same ? bt_water_velocity (water, w->x[0]) : bt__vec (0, 0, 0);
  if (!same)
    bt_water_motions (water, w->X, (size_t)w->n + 1, w->d, w->keep);
  for (int i = 0; i <= w->n; i++)
    w->node[i].current = same ? u : w->d[i];
}

void
bt__dynamic_lump_add (const bt__dynamic_work *w, bt__extra *e, const bt__dynamic_lump *lump,
                      double share)
{
  e->mass += share * (lump->mass + lump->added);
  e->weight += share * lump->wet_weight;
  e->lift += share * (lump->mass * w->in->water->gravity - lump->wet_weight);
  e->linear += share * lump->linear;
  e->quadratic += share * lump->quadratic;
  e->force = bt__axpy (e->force, share, lump->force);
}

/* Share out SHARE of LUMP at U metres from the far end between the nodes about it.  */
static void
lump_between (bt__dynamic_work *w, const bt__dynamic_lump *lump, double u, double share)
{
  int j = w->n - 1;
  while (j > 0 && u > w->link[j].rest)
    u -= w->link[j--].rest;
  double at = fmin (fmax (u / w->link[j].rest, 0), 1);
  bt__dynamic_lump_add (w, w->extra + j, lump, share * at);
  bt__dynamic_lump_add (w, w->extra + j + 1, lump, share * (1 - at));
}

/* Accelerated water pushes on the volume of the line in any direction, for the tension is the
   effective tension; and across the line on its added mass: two nodes side by side.  */
static void
push_by_waves (bt__dynamic_work *w)
{
  const bt__dynamic_input *in = w->in;
  const bt_vec3 *x = w->x;
  double d = in->line->diameter, displaced = in->water->density * BT__PI / 4 * d * d;
  bt__pair all = { displaced + w->ma, displaced + w->ma }, added = { w->ma, w->ma };
  bt__pair none = { 0, 0 }, most = { INFINITY, INFINITY };
  for (int i = 0; i <= w->n; i += 2)
    {
      int j = i < w->n ? i + 1 : i, after = j < w->n ? j + 1 : j, before = i > 0 ? i - 1 : i;
      bt__extra *p = w->extra + i, *q = w->extra + j;
      bt__pair_vec a = bt__pair_load (w->keep + i, w->keep + j);
      bt__pair_vec chord = bt__pair_sub (bt__pair_load (x + j, x + after),
                                         bt__pair_load (x + before, x + (i < j ? i : before)));
      bt__pair size = bt__pair_dot (chord, chord);
      bt__pair along = added * bt__pair_dot (a, chord) / size;
      along = bt__pair_where ((size > none) & (size < most), along);
      bt__pair wet = { w->node[i].wet, w->node[j].wet };
      bt__pair_vec push = bt__pair_axpy (bt__pair_scale (all, a), -along, chord);
      bt__pair_store (&p->force, &q->force,
                      bt__pair_axpy (bt__pair_load (&p->force, &q->force), wet, push));
    }
}

static void
prepare_lumps (bt__dynamic_work *w)
{
  static const bt__dynamic_lump none;
  const bt__dynamic_input *in = w->in;
  w->lumped = in->n_lumps > 0;
  for (int k = 0; k < 2; k++)
    w->lumped
        = w->lumped || (in->end[k].free && memcmp (&in->end[k].body, &none, sizeof none) != 0);
  w->bodies = w->lumped;
  w->lumped = w->lumped || has_waves (in->water);
  if (!w->lumped)
    return;
  memset (w->extra, 0, (size_t)(w->n + 1) * sizeof *w->extra);
  for (int k = 0; k < 2; k++)
    if (in->end[k].free)
      bt__dynamic_lump_add (w, w->extra + (k ? w->n : 0), &in->end[k].body, 1);
  for (int k = 0; k < in->n_lumps; k++)
    {
      const bt__dynamic_lump *lump = in->lumps + k;
      int parts
          = lump->span > 0 ? (int)fmin (ceil (2 * lump->span / w->link[w->n - 1].rest), 64) : 1;
      for (int p = 0; p < parts; p++)
        lump_between (w, lump, lump->from_end + lump->span * ((p + 0.5) / parts - 0.5),
                      1.0 / parts);
    }
  if (has_waves (in->water))
    push_by_waves (w);
}

void
bt__dynamic_prepare (bt__dynamic_work *w, const bt__dynamic *d, const bt__dynamic_input *in,
                     double rest0)
{
  const bt_tether_props *p = in->line;
  double half = 0.5 * in->water->density * p->diameter;
  w->in = in;
  w->stiffen = 0;
  w->rows = w->pairs = 0;
  w->hold = NULL;
  w->bents = w->rounded = 0;
  w->n = (int)d->n;
  w->ea = bt__stiffness (p->ea);
  w->kn = half * p->cdn;
  w->kt = half * BT__PI * p->cdt;
  w->m = p->mass;
  w->weight = p->wet_weight;
  w->ma = half * p->ca * BT__PI * p->diameter / 2;
  w->x = bt__dynamic_x (d);
  w->chord = in->order == 4 ? bt__dynamic_chord (d) : NULL;
  w->load = in->order == 4 ? bt__dynamic_load (d) : NULL;
  prepare_links (w, d, rest0);
  const bt_vec3 *chord = bt__dynamic_chord (d);
  for (int j = 0; d->rounded && !w->chord && j < w->n; j++)
    if (chord[j].z != 0)
      bt__dynamic_round (w, j, chord[j].z);
  prepare_nodes (w, d);
  sample_current (w);
  bt__dynamic_surface_prepare (w);
  prepare_lumps (w);
  bt__dynamic_bend_prepare (w, d);
}
