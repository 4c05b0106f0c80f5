/* Charts: the world as prepared for the questions of one tether, made once.

   Three charts are kept for a tether, each made by the first question that needs the chart:

   - Ways: a tree of free ways from the anchor, over about 50 000 cells of a box about the enabled
   obstacles within reach (aware/free.c).  The reach is the next power of two above the greatest
   paid-out length: paying out seldom means a new tree.

   - Frame: the graph of members (aware/graph.c), of the whole world; gaps below 1 cm or the
   tether's diameter are closed.

   - Words: shadows of the graph (aware/shadow.c); if the graph leaves an obstacle undescribed, such
   as a mesh, voxels of the box about the anchor (aware/voxel.c).

   A chart is valid for a set of switches, told by a hash of the switches, for a gap or reach, and
   for a root.  The root is the anchor; for an anchor on waves or on a vehicle the root is a lattice
   point in sight of the anchor.  The state keeps the point until the anchor is 4 m away: equal
   states have equal charts.

   Charts are counted by reference, and a fork shares them.  They are immutable once made, but for
   the tree, which grows as far as anyone's question needs and answers all alike.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/error.h"
#include "math/vec.h"
#include "world/obstacles.h"
#include "world/watch.h"

enum
{
  TREE_CELLS = 50000,
  VOXELS = 150000,
  DIRECTIONS = 24
};

#define JITTER 0.2
#define GAP_LEAST 0.01  /* m: a narrower gap between members is no way through */
#define CLEAR_MOST 0.03 /* m: clearance of free ways */
#define BERTH 2.0       /* m: the coarsest lattice of roots */
#define ASTRAY 4.0      /* m: an anchor so far from the kept root gets another root */

void
bt__chart_release (bt__chart *c)
{
  if (!c || atomic_fetch_sub (&c->references, 1) != 1)
    return;
  bt__free_free (c->tree);
  bt__graph_free (&c->graph);
  bt__shadow_free (c->shadow);
  bt__voxels_free (c->voxels);
  free (c->off);
  free (c);
}

/* A chart of the switches of tether I, with nothing on it yet; NULL: no memory.  */
static bt__chart *
new_chart (const bt_dive *dive, int i)
{
  const bt__scene *scene = dive->model->scene;
  const bt__subject *subject = bt__dive_subject (dive, dive->now, BT_PART_TETHER, i);
  bt__chart *c = calloc (1, sizeof *c);
  if (!c)
    return NULL;
  atomic_init (&c->references, 1);
  c->version = subject->version;
  c->on.version = subject->version;
  if (subject->version == 0)
    return c;
  c->off = malloc (scene->n);
  c->on.off = c->off;
  if (c->off)
    {
      memcpy (c->off, bt__dive_off (dive, dive->now, BT_PART_TETHER, i), scene->n);
      return c;
    }
  free (c);
  return NULL;
}

static int
is_of (const bt_dive *dive, int i, const bt__chart *c)
{
  return c && c->version == bt__dive_subject (dive, dive->now, BT_PART_TETHER, i)->version;
}

bt_status
bt__chart_ways (const bt_dive *dive, int i, bt__awareness *g, bt_error *error)
{
  if (is_of (dive, i, g->ways))
    return BT_OK;
  bt__chart_release (g->ways);
  g->ways = new_chart (dive, i);
  return g->ways ? BT_OK : bt__watch_no_memory (error);
}

/* ---- The box in which there is anything ---- */

static bt_vec3
least_corner (bt_vec3 a, bt_vec3 b)
{
  return bt__vec (fmin (a.x, b.x), fmin (a.y, b.y), fmin (a.z, b.z));
}

static bt_vec3
most (bt_vec3 a, bt_vec3 b)
{
  return bt__vec (fmax (a.x, b.x), fmax (a.y, b.y), fmax (a.z, b.z));
}

/* The box about ANCHOR and the enabled obstacles within REACH, with room to go round them; returns
   0 if there are none.  */
static int
box_about_anchor (const bt__scene *scene, const bt__switches *on, bt_vec3 anchor, double reach,
                  bt_vec3 *lo, bt_vec3 *hi)
{
  bt_vec3 far = bt__vec (reach, reach, reach), aside = bt__vec (0, 0, 0);
  bt_vec3 from = bt__sub (anchor, far), to = bt__add (anchor, far);
  int found = 0;
  *lo = *hi = anchor;
  for (uint32_t k = 0; k < scene->solids; k++)
    {
      bt__aabb b = bt__obstacle_box (&scene->object[scene->solid[k]]);
      bt_vec3 l = most (b.lo, from), h = least_corner (b.hi, to);
      if (!bt__is_on (on, scene->solid[k]) || l.x > h.x || l.y > h.y || l.z > h.z)
        continue;
      *lo = least_corner (*lo, l);
      *hi = most (*hi, h);
      found = 1;
    }
  double room = fmin (3, 0.1 * bt__distance (*lo, *hi) + 0.05);
  aside = bt__vec (room, room, room);
  *lo = bt__sub (*lo, aside);
  *hi = bt__add (*hi, aside);
  hi->z = fmin (hi->z, fmax (anchor.z, 0) + 0.5 * room); /* nobody flies */
  return found;
}

static double
cell_of (bt_vec3 lo, bt_vec3 hi, int cells)
{
  bt_vec3 d = bt__sub (hi, lo);
  return 1.02 * cbrt (d.x * d.y * d.z / cells);
}

/* ---- The tree of free ways ---- */

/* The reach of the charts of tether I, m: a power of two, so that paying out seldom means growing
   the tree anew.  */
static double
chart_reach (const bt_dive *dive, int i)
{
  return exp2 (ceil (log2 (fmax (bt__watch_longest (dive, i), 1))));
}

/* The point nearest to P, the anchor of tether I, of a lattice of STEP m about the place of the
   anchor when the dive began.  */
static bt_vec3
berth (const bt_dive *dive, int i, bt_vec3 p, double step)
{
  const bt__end *end = &dive->model->ends[i][0];
  bt_vec3 origin = end->vehicle < 0 ? end->at : dive->model->vehicles[end->vehicle].at;
  bt_vec3 d = bt__scale (1 / step, bt__sub (p, origin));
  return bt__axpy (origin, step, bt__vec (round (d.x), round (d.y), round (d.z)));
}

/* The root of the charts of tether I: its anchor, or, for an anchor that rides on waves or on a
   vehicle, a place in sight of the anchor.  Such a place is the coarsest grid point in sight.  The
   state keeps the place until the anchor has strayed from it; otherwise an anchor that swings about
   the middle between two grid points would need the charts of both in turn.  */
static bt_vec3
chart_root (const bt_dive *dive, int i, const bt__awareness *g)
{
  bt_vec3 anchor = g->node[0];
  bt__free_config config = { .scene = dive->model->scene, .on = g->config.on };
  const bt__subject *subject = bt__dive_subject (dive, dive->now, BT_PART_TETHER, i);
  if (subject->berthed && bt__distance (subject->berth, anchor) < ASTRAY
      && bt__free_sees (&config, anchor, subject->berth, CLEAR_MOST, &dive->watch->count))
    return subject->berth;
  for (double step = BERTH; step > 0.1 * BERTH; step *= 0.5)
    {
      bt_vec3 p = berth (dive, i, anchor, step);
      if (bt__distance (p, anchor) < 1e-9)
        return p;
      if (bt__free_sees (&config, anchor, p, CLEAR_MOST, &dive->watch->count))
        return p;
    }
  return anchor;
}

bt_status
bt__watch_berth (const bt_dive *dive, int i, bt_vec3 *berth, bt_error *error)
{
  bt__awareness *g;
  bt_status status = bt__watch_look (dive, i, &g, error);
  if (status == BT_OK)
    *berth = g->open ? g->node[0] : chart_root (dive, i, g);
  return status;
}

static bt_status
plant (const bt_dive *dive, bt__chart *c, double core, bt_error *error)
{
  bt__free_config config = { .scene = dive->model->scene, .on = &c->on };
  if (!box_about_anchor (config.scene, &c->on, c->anchor, c->reach, &config.lo, &config.hi))
    return BT_OK;
  config.cell = cell_of (config.lo, config.hi, TREE_CELLS);
  config.clear = fmax (1.5 * core, fmin (CLEAR_MOST, 0.05 * config.cell));
  return bt__free_new (&config, &c->tree, error);
}

bt_status
bt__chart_plant (const bt_dive *dive, int i, bt__awareness *g, bt_error *error)
{
  double reach = chart_reach (dive, i);
  bt_vec3 anchor = chart_root (dive, i, g);
  bt__chart *had = g->ways;
  if (had->reach == reach && bt__distance (had->anchor, anchor) == 0)
    return BT_OK;
  bt__chart *c = new_chart (dive, i);
  if (!c)
    return bt__watch_no_memory (error);
  c->reach = reach;
  c->anchor = anchor;
  bt_status status = plant (dive, c, g->config.core, error);
  if (c->tree)
    bt__free_plant (c->tree, anchor);
  if (status != BT_OK)
    {
      bt__chart_release (c);
      return status;
    }
  g->ways = c;
  g->config.on = &c->on;
  bt__chart_release (had);
  return BT_OK;
}

/* ---- The words ---- */

/* Make the graph of the enabled obstacles.  */
static bt_status
describe (const bt_dive *dive, bt__chart *c, bt_error *error)
{
  const bt__scene *scene = dive->model->scene;
  uint8_t *ground = calloc (scene->n, 1);
  if (!ground)
    return bt__watch_no_memory (error);
  for (uint32_t k = 0; k < scene->n; k++)
    ground[k] = dive->model->obstacles[scene->object[k].id].kind == BT_OBSTACLE_SEABED;
  bt_status status = bt__graph_new (&(bt__graph_config){ .scene = scene,
                                                         .on = &c->on,
                                                         .ground = ground,
                                                         .depth = dive->now->depth,
                                                         .gap = c->gap,
                                                         .asker = bt__asker_of (dive) },
                                    &c->graph, error);
  free (ground);
  return status;
}

static double
chart_gap (const bt_dive *dive, int i)
{
  return fmax (GAP_LEAST, bt__dive_tether (dive, dive->now, i)->props.diameter);
}

bt_status
bt__chart_frame (const bt_dive *dive, int i, bt__awareness *g, bt_error *error)
{
  double gap = chart_gap (dive, i);
  if (is_of (dive, i, g->frame) && g->frame->gap == gap)
    return BT_OK;
  bt__chart *c = new_chart (dive, i);
  if (!c)
    return bt__watch_no_memory (error);
  c->gap = gap;
  bt_status status = describe (dive, c, error);
  if (status != BT_OK)
    {
      bt__chart_release (c);
      return status;
    }
  bt__chart_release (g->frame);
  g->frame = c;
  return BT_OK;
}

static bt_status
make_voxels (const bt_dive *dive, bt__chart *c, bt_vec3 anchor, bt_error *error)
{
  bt__voxel_config config = { .scene = dive->model->scene, .on = &c->on };
  box_about_anchor (config.scene, &c->on, anchor, c->reach, &config.lo, &config.hi);
  config.cell = cell_of (config.lo, config.hi, VOXELS);
  return bt__voxels_new (&config, bt__asker_of (dive), &c->voxels, error);
}

/* Make words by shadows if the graph describes every obstacle, else by voxels.  */
static bt_status
make_words (const bt_dive *dive, bt__chart *c, const bt__graph *graph, bt_vec3 anchor,
            bt_error *error)
{
  ((bt_dive *)dive)->profile.charts++;
  if (graph->undescribed)
    return make_voxels (dive, c, anchor, error);
  bt__shadow_config config
      = { .jitter = JITTER, .tries = DIRECTIONS, .asker = bt__asker_of (dive) };
  return bt__shadow_new (graph, &config, &c->shadow, error);
}

/* True if the words of G are still valid.  Words among members hold for the whole world, voxels
   only within reach of the anchor.  */
static int
has_words (const bt_dive *dive, int i, const bt__awareness *g, double gap)
{
  const bt__chart *c = g->words;
  if (!is_of (dive, i, c) || c->gap != gap)
    return 0;
  return c->shadow
         || (c->reach == chart_reach (dive, i)
             && bt__distance (c->anchor, chart_root (dive, i, g)) == 0);
}

bt_status
bt__chart_words (const bt_dive *dive, int i, bt__awareness *g, bt_error *error)
{
  double gap = chart_gap (dive, i);
  if (has_words (dive, i, g, gap))
    return BT_OK;
  bt_status status = bt__chart_frame (dive, i, g, error);
  if (status != BT_OK)
    return status;
  bt__chart *c = new_chart (dive, i);
  if (!c)
    return bt__watch_no_memory (error);
  c->gap = gap;
  c->reach = chart_reach (dive, i);
  c->anchor = chart_root (dive, i, g);
  status = make_words (dive, c, &g->frame->graph, c->anchor, error);
  if (status != BT_OK)
    {
      bt__chart_release (c);
      return status;
    }
  bt__chart_release (g->words);
  g->words = c;
  return BT_OK;
}
