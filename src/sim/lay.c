/* Laying a tether among obstacles: see lay.h.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <math.h>
#include <string.h>

#include "base/error.h"
#include "math/vec.h"
#include "sim/around.h"
#include "sim/chain.h"
#include "sim/lay.h"
#include "world/form.h"
#include "world/obstacles.h"

#define KEPT_OFF 1.1 /* times the core: clearance of a line with corners left out */
#define ENOUGH 0.4   /* of its length: a longer line need not be led on */
#define WASTE 0.05   /* of an interval: the most a line may shorten at a corner left out */

/* ---- Corners ---- */

/* LINK as seen from MOVER where its motion ends.  */
static bt__link
to_mover (const bt__mover *mover, const bt__link *link)
{
  bt__frame frame = bt__motion_at (&mover->motion, 1);
  return (bt__link){ bt__to_local (&frame, link->a), bt__to_local (&frame, link->b) };
}

double
bt__room_about (bt_dive *dive, const bt__surroundings *around, const bt__link *link, double cap,
                bt__near *near)
{
  if (bt__scene_nearest (around->scene, around->on, link, cap, near, &dive->contact_work.count))
    cap = near->w.distance;
  for (uint32_t k = 0; k < around->movers; k++)
    {
      const bt__mover *mover = &around->mover[k];
      bt__link there = to_mover (mover, link);
      if (bt__scene_nearest (mover->body, mover->on, &there, cap, near, &dive->contact_work.count))
        cap = near->w.distance;
    }
  return cap;
}

/* True if nothing is in the triangle A B C, nor within KEEP of it.  */
static int
is_triangle_clear (bt_dive *dive, const bt__surroundings *around, double keep, bt_vec3 a, bt_vec3 b,
                   bt_vec3 c)
{
  bt__link link = { a, c };
  bt__near near;
  bt__witness w;
  bt__pair_point (b, &link, &w);
  return bt__room_about (dive, around, &link, w.distance + 2 * keep, &near) >= w.distance + keep;
}

/* The distance from LINK of the farthest point of CHAIN's straight intervals between FROM and TO
   metres from its beginning; node *J is the first that was not passed, *S metres from there.  */
static double
farthest_off (const bt__dynamic *chain, const bt__link *link, double from, double to, int64_t *j,
              double *s)
{
  bt_vec3 ends[2] = { bt__dynamic_chord_point (chain, from), bt__dynamic_chord_point (chain, to) };
  bt__witness w;
  double off = 0;
  for (int k = 0; k < 2; k++)
    {
      bt__pair_point (ends[k], link, &w);
      off = fmax (off, w.distance);
    }
  for (; *j <= chain->n && *s <= to; *s += bt__dynamic_rest (chain)[(*j)++])
    {
      bt__pair_point (bt__dynamic_x (chain)[*j], link, &w);
      off = fmax (off, w.distance);
    }
  return off;
}

/* True if PART of tether I may change to N intervals without touching.  Each point of the line
   moves straight to the new point of equal arc length: no point leaves the capsule about the new
   interval and the old points.  */
int
bt__may_remesh (bt_dive *dive, bt__state *state, int i, int part, int n)
{
  bt__dynamic *chain = bt__dive_chain (dive, state, i, part);
  bt__surroundings around = bt__surround (dive, state, BT_PART_TETHER, i);
  double core = bt__core (bt__dive_tether (dive, state, i)->props.diameter);
  double length = bt__dynamic_length (chain), s = 0;
  double spare = bt__spare_among_lines (dive, state, i, part); /* where lines touch, nodes stay */
  int64_t j = 0;
  for (int k = 0; k < n; k++)
    {
      bt__link link = { dive->polyline[k], dive->polyline[k + 1] };
      double off = farthest_off (chain, &link, length * k / n, length * (k + 1) / n, &j, &s);
      bt__near near;
      if (off >= spare
          || bt__room_about (dive, &around, &link, off + 2 * core, &near) < off + 1.1 * core)
        return 0;
    }
  return 1;
}

double
bt__way_of_remesh (const bt_dive *dive, bt__state *state, int i, int part, int n)
{
  bt__dynamic *chain = bt__dive_chain (dive, state, i, part);
  double length = bt__dynamic_length (chain), s = 0, most = 0;
  int64_t j = 0;
  for (int k = 0; k < n; k++)
    {
      bt__link link = { dive->polyline[k], dive->polyline[k + 1] };
      most = fmax (most, farthest_off (chain, &link, length * k / n, length * (k + 1) / n, &j, &s));
    }
  return most;
}

/* Leave out corners of P, N in number, not needed for a clearance of KEEP, if the line gets shorter
   by no more than LOSS at the corner; return the number of corners left.  */
static int
leave_out_corners (bt_dive *dive, const bt__surroundings *around, double keep, double loss,
                   bt_vec3 *p, int n)
{
  int kept = 1;
  for (int k = 1; k < n; k++)
    {
      for (; kept > 1; kept--)
        {
          bt_vec3 a = p[kept - 2], b = p[kept - 1], c = p[k];
          if (bt__distance (a, b) + bt__distance (b, c) - bt__distance (a, c) > loss
              || !is_triangle_clear (dive, around, keep, a, b, c))
            break;
        }
      p[kept++] = p[k];
    }
  return kept;
}

/* The corners that the tether has, or 0: it has no shape yet.  */
static int
own_corners (bt_dive *dive, bt__state *state, int i)
{
  int n;
  const bt_vec3 *x = bt__form_of (bt__dive_tether (dive, state, i))->laid (dive, state, i, &n);
  if (n > 0)
    memcpy (dive->polyline, x, sizeof *x * (size_t)n);
  return n;
}

/* Those of the world's line of lay; of a tether that is laid anew, a straight line.  */
static int
lay_corners (bt_dive *dive, bt__state *state, int i, const bt__ends *ends)
{
  bt_vec3 point[BT_VIA_MAX + 2];
  int n = bt__dive_tether (dive, state, i)->relaid ? 2 : bt__lay_points (dive->model, i, point);
  memcpy (dive->polyline, point, sizeof *point * (size_t)n);
  dive->polyline[0] = ends->a;
  dive->polyline[n - 1] = ends->b;
  return n;
}

static const char *
name_near (const bt_dive *dive, const bt__surroundings *around, const bt__link *link, double cap)
{
  const bt_model *model = dive->model;
  bt__count count = { 0 };
  bt__near near;
  if (bt__scene_nearest (around->scene, around->on, link, cap, &near, &count))
    return model->obstacles[around->scene->object[near.object].id].name;
  for (uint32_t k = 0; k < around->movers; k++)
    {
      const bt__mover *mover = &around->mover[k];
      bt__link there = to_mover (mover, link);
      if (bt__scene_nearest (mover->body, mover->on, &there, cap, &near, &count))
        return model->obstacles[model->carried[k].obstacle].name;
    }
  return "";
}

static bt_status
check_way (bt_dive *dive, const bt__surroundings *around, int i, int n, bt_error *error)
{
  const bt_tether_def *def = &dive->model->tethers[i];
  double radius = def->props.diameter / 2;
  bt__near near;
  for (int k = 0; k + 1 < n; k++)
    {
      bt__link link = { dive->polyline[k], dive->polyline[k + 1] };
      if (bt__room_about (dive, around, &link, radius, &near) < radius)
        return bt__fail (error, BT_ERR_DOMAIN,
                         "tether `%s' cannot be laid straight to (%g %g %g): `%s' is in the way",
                         def->name, link.b.x, link.b.y, link.b.z,
                         name_near (dive, around, &link, radius));
    }
  return BT_OK;
}

bt_status
bt__corners (bt_dive *dive, bt__state *state, int i, const bt__ends *ends, int *n, bt_error *error)
{
  bt__surroundings around = bt__surround (dive, state, BT_PART_TETHER, i);
  double core = bt__core (bt__dive_tether (dive, state, i)->props.diameter);
  *n = own_corners (dive, state, i);
  if (*n == 0)
    {
      *n = lay_corners (dive, state, i, ends);
      return check_way (dive, &around, i, *n, error);
    }
  *n = leave_out_corners (dive, &around, KEPT_OFF * core, INFINITY, dive->polyline, *n);
  return *n <= 2 * BT__SPLITS_MAX
             ? BT_OK
             : bt__fail (error, BT_ERR_LIMIT, "tether `%s' has more than %d corners",
                         dive->model->tethers[i].name, 2 * BT__SPLITS_MAX);
}

/* ---- A chain along corners ---- */

/* Share N intervals out to the legs between M corners P, by length and at least one to each, and
   write the nodes to X.  */
static void
allot (const bt_vec3 *p, int m, bt_vec3 *x, int n)
{
  double whole = 0, gone = 0;
  int from = 0;
  for (int k = 0; k + 1 < m; k++)
    whole += bt__distance (p[k], p[k + 1]);
  x[0] = p[0];
  for (int k = 0; k + 1 < m; k++)
    {
      int least = from + 1, most = n - (m - 2 - k);
      int to = (int)lround (n * (gone += bt__distance (p[k], p[k + 1])) / fmax (whole, 1e-12));
      to = k + 2 == m ? n : to < least ? least : to > most ? most : to;
      for (int j = from; j < to; j++)
        x[j + 1] = bt__axpy (p[k], (double)(j + 1 - from) / (to - from), bt__sub (p[k + 1], p[k]));
      from = to;
    }
}

/* Let the chain of N intervals of tether I begin along the nodes X. Nodes held up crowd together,
   so nodes are added on the rest; each interval has its chord's share of the length.  */
static void
begin_along_nodes (bt_dive *dive, bt__state *state, int i, bt_vec3 *x, int n)
{
  const bt__tether *tether = bt__dive_tether (dive, state, i);
  bt__surroundings around = bt__surround (dive, state, BT_PART_TETHER, i);
  double keep = KEPT_OFF * bt__core (tether->props.diameter);
  double whole, loss = WASTE * tether->length / n;
  int m = leave_out_corners (dive, &around, keep, loss, x, n + 1);
  allot (x, m, dive->polyline, n);
  x = dive->polyline;
  whole = bt__length (x, (uint32_t)n + 1);
  for (int k = 0; k < n; k++)
    dive->contact_work.share[k] = whole > 0 ? bt__distance (x[k], x[k + 1]) / whole : 1.0 / n;
}

bt_status
bt__lay_chain_among (bt_dive *dive, bt__state *state, int i, const bt__ends *ends, bt_error *error)
{
  bt__tether *tether = bt__dive_tether (dive, state, i);
  bt_vec3 *corner = dive->corner, *node = dive->contact_work.node;
  int m = 0, n = bt__rest_nodes (dive, tether, i), there = 0, bedded;
  double whole;
  bt_status status = bt__corners (dive, state, i, ends, &m, error);
  if (status != BT_OK)
    return status;
  if (m - 1 > n)
    return bt__fail (error, BT_ERR_LIMIT, "tether `%s' has %d legs: it needs as many nodes",
                     dive->model->tethers[i].name, m - 1);
  memcpy (corner, dive->polyline, sizeof *corner * (size_t)m);
  status = bt__trace_rest (dive, state, i, ends, n, error);
  if (status != BT_OK)
    return status;
  allot (corner, m, node, n);
  bedded = bt__lay_on_bed (dive, state, i, node, n);
  whole = bt__length (node, (uint32_t)n + 1);
  status = bt__lead_to_rest (dive, state, i, node, n, &there, error);
  if (status != BT_OK)
    return status;
  if (!there && whole > ENOUGH * tether->length)
    allot (corner, m, node, n);
  if (!there)
    begin_along_nodes (dive, state, i, node, n);
  status
      = bt__begin_chain (dive, state, i, ends, n, there ? NULL : dive->contact_work.share, error);
  there &= !bedded && !bt__is_clamped_at_all (dive, i);
  return status == BT_OK && !there ? bt__fall (dive, state, i, ends, error) : status;
}
