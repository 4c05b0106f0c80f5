/* What a tether is caught on: the windings of its class about every obstacle.

   The closed curve out along the tether and home along the free way is drawn tight; the loops about
   members from which the curve cannot be drawn free (caught.h) are the windings.  A mesh is no
   member.  The word of the class decides whether the line is caught on a mesh; the number of turns
   is counted about the vertical through the mesh, over the heights of the mesh.

   A line that can be drawn straight is wound about no member, even if members cut its chord: the
   line merely passes.  No taut string is needed for a straight line or a line drawn free on the
   tree's way.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "aware/caught.h"
#include "aware/turns.h"
#include "base/error.h"
#include "math/vec.h"
#include "world/obstacles.h"
#include "world/watch.h"

#define HELD_ANGLE 1e-3 /* radians: an obstacle at which a string bends more holds the string */

/* ---- Members ---- */

/* Add the loops found about the members of G's graph to its windings.  */
static void
add_loops (const bt_dive *dive, bt__awareness *g)
{
  const bt__graph *graph = &g->frame->graph;
  for (uint32_t e = 0; g->loops.any && e < graph->own; e++)
    if (g->loops.loops[e] != 0)
      {
        g->wound[dive->model->scene->object[graph->object[e]].id] += g->loops.loops[e];
        g->is_wound = 1;
      }
}

/* Mark in FAVOURED the edges of what holds the string.  */
static void
favour (const bt__awareness *g, uint8_t *favoured)
{
  const bt__graph *graph = &g->frame->graph;
  for (uint32_t e = 0; e < graph->own; e++)
    favoured[e] = bt__holds_wrap (&g->holds, graph->object[e]) > HELD_ANGLE;
}

/* Have memory for loops about what G's tether is among.  */
static bt_status
make_loops (bt__awareness *g, bt__asker *asker, bt_error *error)
{
  if (g->loops.graph == &g->frame->graph)
    return BT_OK;
  bt__caught_free (&g->loops);
  free (g->favoured);
  g->favoured = calloc (g->frame->graph.edges + 1, 1);
  bt_status status = g->favoured ? bt__caught_new (&g->frame->graph, &g->loops, error)
                                 : bt__watch_no_memory (error);
  g->loops.asker = asker;
  return status;
}

/* Add the loops about members of the taut string and the free way back.  */
static void
wind_about_members (const bt_dive *dive, bt__awareness *g)
{
  favour (g, g->favoured);
  bt__caught_find (&g->loops, g->taut->x, g->taut->n, g->shortest->x, g->shortest->n, g->favoured);
  add_loops (dive, g);
}

/* True if no member goes through a surface spanned between the tether and its chord: as far as
   members go, the line can be drawn straight.  */
static int
merely_passes (bt__awareness *g)
{
  bt_vec3 chord[2] = { g->node[0], g->node[g->n - 1] };
  return !bt__caught_crossings (&g->frame->graph, g->node, g->n, chord, 2, g->loops.loops);
}

/* Find the loops about members of the curve made of the tether and a way home found without a
   string; *KNOWN is false if no such way is known.  */
static bt_status
quick_loops (const bt_dive *dive, int i, bt__awareness *g, int *known, bt_error *error)
{
  g->loops.any = 0;
  *known = 1;
  if (merely_passes (g))
    return BT_OK;
  g->has_free = 0;
  bt_status status = bt__watch_lay_way (dive, i, g, g->node[g->n - 1], g->shortest, known, error);
  if (status == BT_OK && *known)
    bt__caught_find (&g->loops, g->node, g->n, g->shortest->x, g->shortest->n, NULL);
  return status == BT_OK ? bt__stopped (bt__asker_of (dive), error) : status;
}

/* Set *LOOSE if the tether is about no member, as far as can be told without a string.  */
static bt_status
look_for_loops (const bt_dive *dive, int i, bt__awareness *g, int *loose, bt_error *error)
{
  int known;
  *loose = merely_passes (g);
  if (*loose || g->has_free)
    return BT_OK;
  bt_status status = quick_loops (dive, i, g, &known, error);
  *loose = known && !g->loops.any;
  return status;
}

/* ---- Meshes ---- */

/* The heights between which a line is beside the obstacle at PLACE; infinite where the obstacle
   goes into the ground or out of the water.  */
static void
heights_of (const bt_dive *dive, uint32_t place, double *low, double *high)
{
  bt__aabb box = bt__obstacle_box (&dive->model->scene->object[place]);
  double depth = dive->now->depth;
  *low = depth > 0 && box.lo.z <= -depth + 0.01 ? -INFINITY : box.lo.z;
  *high = box.hi.z >= 0 ? INFINITY : box.hi.z;
}

static bt_vec3
at_height (bt_vec3 a, bt_vec3 b, double z)
{
  return bt__axpy (a, (z - a.z) / (b.z - a.z), bt__sub (b, a));
}

/* Put what is between LOW and HIGH of the link from A to B into OUT; return true if something is.
 */
static int
clip_to_heights (bt_vec3 a, bt_vec3 b, double low, double high, bt_vec3 out[2])
{
  if ((a.z < low && b.z < low) || (a.z > high && b.z > high))
    return 0;
  out[0] = a.z < low ? at_height (a, b, low) : a.z > high ? at_height (a, b, high) : a;
  out[1] = b.z < low ? at_height (a, b, low) : b.z > high ? at_height (a, b, high) : b;
  return 1;
}

/* The turns about AXIS of the parts between LOW and HIGH of the string P of N points, each part
   closed by its chord.  WORK has room for 2 N points.  */
static int
wind_between (const bt__axis *axis, const bt_vec3 *p, uint32_t n, double low, double high,
              bt_vec3 *work)
{
  int sum = 0;
  uint32_t m = 0;
  for (uint32_t k = 0; k + 1 < n; k++)
    {
      bt_vec3 part[2];
      int in = clip_to_heights (p[k], p[k + 1], low, high, part);
      if (!in || (m > 0 && bt__distance (work[m - 1], part[0]) > 0))
        {
          sum += bt__winding (axis, work, m);
          m = 0;
        }
      if (in && m == 0)
        work[m++] = part[0];
      if (in)
        work[m++] = part[1];
    }
  return sum + bt__winding (axis, work, m);
}

/* True if the tether's own nodes, closed by their chord, go about the mesh at PLACE.  */
static int
goes_about (const bt_dive *dive, const bt__awareness *g, uint32_t place)
{
  bt__axis axis;
  return bt__axis_of (&dive->model->scene->object[place], &axis)
         && bt__winding (&axis, g->node, g->n) != 0;
}

/* Count the winding about the mesh at PLACE, if the mesh holds the string of G and the class is not
   the free way's.  */
static bt_status
wind_about_mesh (const bt_dive *dive, int i, bt__awareness *g, uint32_t place, bt_error *error)
{
  const bt__obstacle *mesh = &dive->model->scene->object[place];
  bt__axis axis;
  double low, high;
  if (!goes_about (dive, g, place))
    return BT_OK;
  bt_status status = bt__watch_free (dive, i, &g, error);
  if (status != BT_OK || bt__holds_wrap (&g->holds, place) < HELD_ANGLE)
    return status;
  status = bt__watch_class (dive, i, &g, error);
  if (status != BT_OK || (g->word.n == 0 && !g->word.lost))
    return status;
  bt_vec3 *work = malloc (2 * (size_t)g->taut->n * sizeof *work);
  if (!work)
    return bt__watch_no_memory (error);
  bt__axis_of (mesh, &axis);
  heights_of (dive, place, &low, &high);
  int windings = wind_between (&axis, g->taut->x, g->taut->n, low, high, work);
  g->wound[mesh->id] = windings;
  g->is_wound |= windings != 0;
  free (work);
  return BT_OK;
}

/* True if the obstacle at PLACE is a mesh that may hold G's tether.  */
static int
is_mesh (const bt_dive *dive, const bt__awareness *g, uint32_t place)
{
  const bt__obstacle *o = &dive->model->scene->object[place];
  return o->kind == BT__OBSTACLE_MESH && bt__is_on (g->config.on, place)
         && dive->model->obstacles[o->id].kind != BT_OBSTACLE_SEABED;
}

static bt_status
wind_about_meshes (const bt_dive *dive, int i, bt__awareness *g, bt_error *error)
{
  const bt__scene *scene = dive->model->scene;
  bt_status status = BT_OK;
  for (uint32_t k = 0; k < scene->solids && status == BT_OK; k++)
    if (is_mesh (dive, g, scene->solid[k]))
      status = wind_about_mesh (dive, i, g, scene->solid[k], error);
  return status;
}

/* ---- All ---- */

static int
has_wound (const bt_dive *dive, bt__awareness *g)
{
  if (!g->wound)
    g->wound = calloc ((size_t)dive->model->n_obstacles + 1, sizeof *g->wound);
  return g->wound != NULL;
}

bt_status
bt__watch_wind_ready (const bt_dive *dive, int i, bt__awareness *g, bt_error *error)
{
  bt_status status = has_wound (dive, g) ? BT_OK : bt__watch_no_memory (error);
  if (status == BT_OK && !g->open)
    status = bt__chart_frame (dive, i, g, error);
  return status == BT_OK && !g->open ? make_loops (g, bt__asker_of (dive), error) : status;
}

static int
forget (const bt_dive *dive, bt__awareness *g)
{
  size_t n = (size_t)dive->model->n_obstacles;
  if (!has_wound (dive, g))
    return 0;
  if (g->is_wound)
    memset (g->wound, 0, n * sizeof *g->wound);
  g->is_wound = 0;
  return 1;
}

/* Where meshes stand a class without a letter is the free way's, whatever members say.  */
static bt_status
doubt (const bt_dive *dive, int i, bt__awareness *g, bt_error *error)
{
  if (!g->is_wound || g->frame->graph.undescribed == 0)
    return BT_OK;
  bt_status status = bt__watch_class (dive, i, &g, error);
  if (status == BT_OK && g->word.n == 0 && !g->word.lost)
    status = forget (dive, g) ? BT_OK : bt__watch_no_memory (error);
  return status;
}

static bt_status
wind (const bt_dive *dive, int i, bt__awareness *g, bt_error *error)
{
  int loose = 1;
  bt_status status = bt__watch_wind_ready (dive, i, g, error);
  if (status == BT_OK)
    status = look_for_loops (dive, i, g, &loose, error);
  if (status == BT_OK && !loose)
    status = bt__watch_free (dive, i, &g, error);
  if (status == BT_OK && !loose)
    wind_about_members (dive, g);
  if (status == BT_OK)
    status = bt__stopped (bt__asker_of (dive), error);
  if (status == BT_OK && g->frame->graph.undescribed > 0)
    status = wind_about_meshes (dive, i, g, error);
  return status == BT_OK ? doubt (dive, i, g, error) : status;
}

bt_status
bt__watch_wind (const bt_dive *dive, int i, bt__awareness **out, bt_error *error)
{
  bt_status status = bt__watch_look (dive, i, out, error);
  bt__awareness *g = *out;
  if (status != BT_OK || g->has_wound)
    return status;
  if (!forget (dive, g))
    return bt__watch_no_memory (error);
  if (!g->open)
    status = wind (dive, i, g, error);
  g->has_wound = status == BT_OK;
  return status;
}

/* ---- Is it as it was? ---- */

static int
is_as (const bt_dive *dive, const bt__awareness *g, const int8_t *told)
{
  for (int k = 0; k < dive->model->n_obstacles; k++)
    if (told[k] != bt__told (g->wound[k]))
      return 0;
  return 1;
}

static int
goes_about_a_mesh (const bt_dive *dive, const bt__awareness *g)
{
  const bt__scene *scene = dive->model->scene;
  for (uint32_t k = 0; g->frame->graph.undescribed > 0 && k < scene->solids; k++)
    if (is_mesh (dive, g, scene->solid[k]) && goes_about (dive, g, scene->solid[k]))
      return 1;
  return 0;
}

/* Without a string: by the tether itself and the quick way home.  A way longer than the string may
   be is not the shortest: then nothing is said.  */
static bt_status
look_again (const bt_dive *dive, int i, bt__awareness *g, const int8_t *told, double least,
            int *same, bt_error *error)
{
  int known;
  double length = 0;
  bt_status status = bt__watch_wind_ready (dive, i, g, error);
  if (status != BT_OK || goes_about_a_mesh (dive, g))
    return status;
  status = quick_loops (dive, i, g, &known, error);
  if (status != BT_OK || !known)
    return status;
  add_loops (dive, g);
  if (!is_as (dive, g, told))
    return BT_OK;
  if (g->loops.any && bt__length (g->shortest->x, g->shortest->n) > least)
    status = bt__watch_tighten_way (dive, g, g->shortest, &length, error);
  *same = status == BT_OK && (!g->loops.any || length <= least);
  return status;
}

/* The least length, m, of the string of G's tether: what it was when SUBJECT was last told of, less
   the motion of the ends.  */
static double
least_string (const bt__awareness *g, const bt__subject *s)
{
  return s->string - bt__distance (g->node[0], s->there[0])
         - bt__distance (g->node[g->n - 1], s->there[1]);
}

bt_status
bt__watch_wound_still (const bt_dive *dive, int i, int *same, bt_error *error)
{
  bt__awareness *g;
  const int8_t *told = bt__dive_told (dive, dive->now, i);
  bt_status status = bt__watch_look (dive, i, &g, error);
  *same = 0;
  if (status != BT_OK)
    return status;
  if (!g->has_wound && !forget (dive, g))
    return bt__watch_no_memory (error);
  if (!g->has_wound && !g->open)
    {
      const bt__subject *s = bt__dive_subject (dive, dive->now, BT_PART_TETHER, i);
      return look_again (dive, i, g, told, least_string (g, s), same, error);
    }
  *same = is_as (dive, g, told);
  return BT_OK;
}

/* True if what was told last of tether I may still hold: the obstacles are those of then.  */
static int
may_be_as_told (const bt_dive *dive, int i, const bt__awareness *g)
{
  if (g->open || g->has_taut)
    return 0;
  const bt__subject *s = bt__dive_subject (dive, dive->now, BT_PART_TETHER, i);
  return s->looked && s->then == s->version;
}

bt_status
bt__watch_wound (const bt_dive *dive, int i, bt__awareness **out, bt_error *error)
{
  int same = 0;
  bt_status status = bt__watch_look (dive, i, out, error);
  bt__awareness *g = *out;
  if (status != BT_OK || g->has_wound)
    return status;
  if (may_be_as_told (dive, i, g))
    status = bt__watch_wound_still (dive, i, &same, error);
  g->has_wound = same;
  return status == BT_OK && !same ? bt__watch_wind (dive, i, out, error) : status;
}
