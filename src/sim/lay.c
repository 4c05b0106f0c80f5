/* Laying a tether among obstacles: see lay.h.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <math.h>
#include <string.h>

#include "base/error.h"
#include "math/vec.h"
#include "sim/around.h"
#include "sim/chain.h"
#include "sim/lay.h"
#include "world/obstacles.h"

/* A line that falls into place is given so long, and rests below so much.  */
#define FALL 20.0      /* s */
#define AT_REST 5e-3   /* m/s */
#define DRAG_SPEED 3.0 /* m/s */
enum
{
  DRAG_TRIES = 30 /* steps without getting nearer */
};
#define DRAG_LEAST 1e-4 /* m a step */

/* ---- Corners ---- */

/* LINK as seen from MOVER where its motion ends.  */
static bt__link
to_mover (const bt__mover *mover, const bt__link *link)
{
  bt__frame frame = bt__motion_at (&mover->motion, 1);
  return (bt__link){ bt__to_local (&frame, link->a), bt__to_local (&frame, link->b) };
}

/* The distance of LINK to the nearest of what stands around, at most CAP.  */
static double
clearance (bt_dive *dive, const bt__surroundings *around, const bt__link *link, double cap,
           bt__near *near)
{
  if (bt__scene_nearest (around->scene, around->on, link, cap, near, &dive->shore.count))
    cap = near->w.distance;
  for (uint32_t k = 0; k < around->movers; k++)
    {
      const bt__mover *mover = &around->mover[k];
      bt__link there = to_mover (mover, link);
      if (bt__scene_nearest (mover->body, mover->on, &there, cap, near, &dive->shore.count))
        cap = near->w.distance;
    }
  return cap;
}

/* Nonzero if nothing is in the triangle A B C, nor within CORE of it.  */
static int
is_clear (bt_dive *dive, const bt__surroundings *around, double core, bt_vec3 a, bt_vec3 b,
          bt_vec3 c)
{
  bt__link link = { a, c };
  bt__near near;
  bt__witness w;
  bt__pair_point (b, &link, &w);
  return clearance (dive, around, &link, w.distance + 2 * core, &near) >= w.distance + 1.1 * core;
}

int
bt__may_remesh (bt_dive *dive, bt__state *state, int i, int n)
{
  bt__dynamic *chain = bt__dive_chain (dive, state, i, 0);
  bt__surroundings around = bt__surround (dive, state, BT_PART_TETHER, i);
  double core = bt__core (bt__dive_tether (dive, state, i)->props.diameter);
  double length = bt__dynamic_length (chain), s = 0;
  /* It has just stepped; where lines touch, nodes stay.  */
  double spare = bt__line_work_spare (dive->shore.line, chain);
  int64_t j = 0;
  for (int k = 0; k < n; k++)
    {
      bt__link link = { dive->polyline[k], dive->polyline[k + 1] };
      double off = 0;
      bt__near near;
      for (; j <= chain->n && s <= length * (k + 1) / n; s += bt__dynamic_rest (chain)[j++])
        {
          bt__witness w;
          bt__pair_point (bt__dynamic_x (chain)[j], &link, &w);
          off = fmax (off, w.distance);
        }
      if (off >= spare
          || clearance (dive, &around, &link, off + 2 * core, &near) < off + 1.1 * core)
        return 0;
    }
  return 1;
}

/* Leave out of the N corners P what is not needed; return how many are left.  */
static int
simplify (bt_dive *dive, const bt__surroundings *around, double core, bt_vec3 *p, int n)
{
  int kept = 1;
  for (int k = 1; k < n; k++)
    {
      while (kept > 1 && is_clear (dive, around, core, p[kept - 2], p[kept - 1], p[k]))
        kept--;
      p[kept++] = p[k];
    }
  return kept;
}

/* The corners that the tether has, or 0: it has no shape yet.  */
static int
own_corners (bt_dive *dive, bt__state *state, int i)
{
  const bt__tether *tether = bt__dive_tether (dive, state, i);
  bt__polyline *line = tether->drape == BT__DRAPE_SPANS
                           ? bt__thesis_line (bt__dive_thesis (dive, state, i))
                           : bt__dive_held (dive, state, i);
  const bt__dynamic *chain = bt__dive_chain (dive, state, i, 0);
  int moves = tether->shape.form == BT__FORM_CHAIN;
  int n = moves ? (int)chain->n + 1 : tether->drape ? (int)line->n : 0;
  const bt_vec3 *x = moves ? bt__dynamic_x (chain) : bt__polyline_x (line);
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
      if (clearance (dive, around, &link, radius, &near) < radius)
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
  *n = simplify (dive, &around, core, dive->polyline, *n);
  return *n <= 2 * BT__SPLITS_MAX
             ? BT_OK
             : bt__fail (error, BT_ERR_LIMIT, "tether `%s' has more than %d corners",
                         dive->model->tethers[i].name, 2 * BT__SPLITS_MAX);
}

/* ---- A chain along corners ---- */

/* Share N intervals out to the legs between M corners P, by length and at least one to each, and
   write the nodes to X and the chords' shares of the whole to SHARE.  */
static void
allot (const bt_vec3 *p, int m, bt_vec3 *x, double *share, int n)
{
  double whole = 0, gone = 0;
  int from = 0;
  for (int k = 0; k + 1 < m; k++)
    whole += bt__distance (p[k], p[k + 1]);
  x[0] = p[0];
  for (int k = 0; k + 1 < m; k++)
    {
      double leg = bt__distance (p[k], p[k + 1]);
      int least = from + 1, most = n - (m - 2 - k);
      int to = (int)lround (n * (gone += leg) / fmax (whole, 1e-12));
      to = k + 2 == m ? n : to < least ? least : to > most ? most : to;
      for (int j = from; j < to; j++)
        {
          x[j + 1]
              = bt__axpy (p[k], (double)(j + 1 - from) / (to - from), bt__sub (p[k + 1], p[k]));
          share[j] = whole > 0 ? leg / (to - from) / whole : 1.0 / n;
        }
      from = to;
    }
}

/* Nonzero if the line gets from the nodes FROM to those on the dive's polyline unhindered.  */
static int
gets_there (bt_dive *dive, bt__state *state, int i, bt_vec3 *from, int n)
{
  bt__surroundings around = bt__surround (dive, state, BT_PART_TETHER, i);
  bt__safe_config config = { .core = bt__core (bt__dive_tether (dive, state, i)->props.diameter),
                             .stride = 1,
                             .rounds = 200 };
  bt__safe_report report;
  bt__safe_forget (dive->shore.safe);
  dive->shore.safe_of = -1;
  bt__safe_step (dive->shore.safe, &config, around.scene, around.on, around.mover, around.movers,
                 from, dive->polyline, (uint32_t)n + 1, &report, &dive->shore.count);
  return report.held == 0 && report.overlaps == 0;
}

/* ---- Falling into place ---- */

static void
pin_ends (bt_dive *dive, bt__state *state, int i, int how)
{
  for (int k = 0; k < 2; k++)
    {
      int vehicle = dive->model->ends[i][k].vehicle;
      if (vehicle >= 0)
        {
          const bt__vehicle *v = bt__dive_vehicle (dive, state, vehicle);
          dive->shore.pin[vehicle] = (bt__pin){ how, v->position, v->body };
        }
    }
}

/* Take what the ends of tether I are pinned by from KEPT, or with TAKE zero put it there.  */
static void
keep_pins (bt_dive *dive, int i, bt__pin kept[2], int take)
{
  for (int k = 0; k < 2; k++)
    {
      int vehicle = dive->model->ends[i][k].vehicle;
      if (vehicle >= 0 && take)
        dive->shore.pin[vehicle] = kept[k];
      else if (vehicle >= 0)
        kept[k] = dive->shore.pin[vehicle];
    }
}

/* The part of a parted line that hangs from the far end.  */
static bt_status
step_far (bt_dive *dive, bt__state *state, int i, bt__dynamic_input input,
          bt__dynamic_report *report, bt_error *error)
{
  bt__dynamic_lump lumps[BT_LUMPS_MAX];
  double length = bt__dynamic_length (bt__dive_chain (dive, state, i, 1));
  bt__fasten (dive, i, 0, length, &input, lumps);
  input.end[0] = (bt__dynamic_end){ .free = 1 };
  return bt__step_among (dive, state, i, 1, &input, report, error);
}

static bt_status
step_to (bt_dive *dive, bt__state *state, int i, const bt__ends *ends, bt__dynamic_report *report,
         bt_error *error)
{
  bt_water water = bt__dive_water (dive, state);
  bt__dynamic_lump lumps[BT_LUMPS_MAX];
  bt__dynamic_input input = bt__chain_input (dive, state, i, &water, ends);
  bt__dynamic_report far = { 0 };
  double from = 0;
  bt_status status = BT_OK;
  if (bt__dive_tether (dive, state, i)->parted)
    {
      from = bt__dynamic_length (bt__dive_chain (dive, state, i, 1));
      status = step_far (dive, state, i, input, &far, error);
      input.end[1] = (bt__dynamic_end){ .free = 1 };
    }
  bt__fasten (dive, i, from, INFINITY, &input, lumps);
  if (status == BT_OK)
    status = bt__step_among (dive, state, i, 0, &input, report, error);
  report->speed = fmax (report->speed, far.speed);
  return status;
}

static bt_status
fall (bt_dive *dive, bt__state *state, int i, const bt__ends *ends, bt_error *error)
{
  bt__tether *tether = bt__dive_tether (dive, state, i);
  bt__pin kept[2];
  bt__dynamic_report report = { .speed = INFINITY };
  bt_status status = BT_OK;
  int steps = (int)(FALL / BT__TIME_STEP);
  keep_pins (dive, i, kept, 0);
  pin_ends (dive, state, i, BT__PIN_HARD);
  for (int k = 0; status == BT_OK && k < steps && report.speed > AT_REST; k++)
    status = step_to (dive, state, i, ends, &report, error);
  keep_pins (dive, i, kept, 1);
  for (int part = 0; part <= (tether->parted != 0); part++)
    bt__dynamic_still (bt__dive_chain (dive, state, i, part));
  tether->shape.a = ends->a;
  tether->shape.b = ends->b;
  tether->quiet = 0;
  return status;
}

bt_status
bt__lay_chain_among (bt_dive *dive, bt__state *state, int i, const bt__ends *ends, bt_error *error)
{
  bt__tether *tether = bt__dive_tether (dive, state, i);
  bt_vec3 *corner = dive->motion, *node = dive->shore.node;
  int m = 0, n = bt__rest_nodes (dive, tether, i), there;
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
  allot (corner, m, node, dive->shore.share, n);
  there = gets_there (dive, state, i, node, n);
  if (!there)
    allot (corner, m, dive->polyline, dive->shore.share, n);
  status = bt__begin_chain (dive, state, i, ends, n, there ? NULL : dive->shore.share, error);
  return status == BT_OK && !there ? fall (dive, state, i, ends, error) : status;
}

/* ---- Dragging ---- */

static bt_vec3
toward (bt_vec3 from, bt_vec3 to)
{
  double way = bt__distance (from, to), most = DRAG_SPEED * BT__TIME_STEP;
  return way <= most ? to : bt__axpy (from, most / way, bt__sub (to, from));
}

static double
way_left (const bt__ends *at, const bt__ends *to)
{
  return bt__distance (at->a, to->a) + bt__distance (at->b, to->b);
}

bt_status
bt__drag_chain (bt_dive *dive, bt__state *state, int i, const bt__ends *ends, bt_error *error)
{
  bt__tether *tether = bt__dive_tether (dive, state, i);
  bt__ends at = { tether->shape.a, tether->shape.b };
  bt__dynamic_report report;
  bt_status status = BT_OK;
  bt__pin kept[2];
  double least = INFINITY, left;
  int idle = 0;
  keep_pins (dive, i, kept, 0);
  for (int k = 0; k < 2; k++)
    bt__bring_end (dive, state, i, k, k == 0 ? at.a : at.b);
  pin_ends (dive, state, i, BT__PIN_SOFT);
  while (status == BT_OK && idle < DRAG_TRIES && (left = way_left (&at, ends)) > 0)
    {
      idle = left > least - DRAG_LEAST ? idle + 1 : 0;
      least = fmin (least, left);
      bt__ends next = { toward (at.a, ends->a), toward (at.b, ends->b) };
      bt__bring_end (dive, state, i, 0, next.a);
      bt__bring_end (dive, state, i, 1, next.b);
      status = step_to (dive, state, i, &next, &report, error);
      at = bt__tether_ends (dive, state, i);
    }
  keep_pins (dive, i, kept, 1);
  return status == BT_OK ? fall (dive, state, i, &at, error) : status;
}
