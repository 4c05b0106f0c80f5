/* Questions about contact: touches, wear, segments between touches, clearances.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include <bight/contact.h>

#include "base/error.h"
#include "collide/sweep.h"
#include "math/vec.h"
#include "world/hull.h"
#include "world/form.h"
#include "world/obstacles.h"

/* Farther than this nothing is near, m.  */
#define FAR 1000.0

enum
{
  TOUCHES_MAX = 4096
};

/* ---- Contacts ---- */

/* The contact TOUCH; of a far part, which begins BEFORE metres from the anchor, if TAIL is true. */
static bt_contact
contact_of (const bt__touch *touch, int tail, double before)
{
  return (bt_contact){ .object = (int)touch->object,
                       .triangle = touch->triangle,
                       .slides = touch->state == BT__TOUCH_SLIDE,
                       .tail = tail,
                       .s = before + touch->s,
                       .position = touch->point,
                       .normal = touch->normal,
                       .force = touch->force };
}

/* All of LINE, tether I, in memory of their own.  */
static bt__touch *
all_touches (const bt_dive *dive, int i, const bt__line *line, int *n)
{
  bt__touch *touch = malloc (sizeof *touch * TOUCHES_MAX);
  *n = touch ? line->form->touches (dive, i, line, touch, TOUCHES_MAX) : 0;
  if (*n > TOUCHES_MAX)
    *n = TOUCHES_MAX;
  return touch;
}

static int
is_tether (const bt_dive *dive, int i)
{
  return i >= 0 && i < dive->model->n_tethers;
}

/* Where the far part of WHOLE, a tether that has parted, begins: m from the anchor, with the line
   that drifted off.  */
static double
before_tail (const bt__line *whole)
{
  return bt__line_length (whole) + whole->tether->lost;
}

int
bt_tether_contacts (const bt_dive *dive, int i, bt_contact *contacts, int max)
{
  int all = 0, n;
  if (!is_tether (dive, i))
    return -1;
  bt__line whole = bt__line_of (dive, dive->now, i);
  double before = before_tail (&whole);
  for (int tail = 0; tail <= (whole.tether->parted != 0); tail++)
    {
      bt__line line = tail ? bt__line_tail (&whole) : whole;
      bt__touch *touch = all_touches (dive, i, &line, &n);
      for (int k = 0; k < n; k++, all++)
        if (all < max)
          contacts[all] = contact_of (&touch[k], tail, tail ? before : 0);
      free (touch);
    }
  return all;
}

/* ---- Wear ---- */

/* Metres of rest length between the far end and S metres from the anchor.  */
static double
from_far_end (const bt_dive *dive, int i, double s)
{
  const bt__tether *tether = bt__dive_tether (dive, dive->now, i);
  return bt__beyond_chain (dive, dive->now, i) + tether->length - s;
}

bt_status
bt_tether_wear (const bt_dive *dive, int i, double *share, bt_error *error)
{
  bt_status status = bt__check_part (dive, BT_PART_TETHER, i, error);
  const bt__tether *tether;
  if (status != BT_OK)
    return status;
  tether = bt__dive_tether (dive, dive->now, i);
  *share = tether->wear / tether->props.wear_energy;
  return BT_OK;
}

bt_status
bt_tether_wear_at (const bt_dive *dive, int i, double s, double *share, bt_error *error)
{
  bt_vec3 unused;
  bt_status status = bt_tether_point (dive, i, s, &unused, error);
  const bt__tether *tether;
  if (status != BT_OK)
    return status;
  tether = bt__dive_tether (dive, dive->now, i);
  *share = 0;
  if (tether->wear != 0)
    {
      bt__wear wear = bt__dive_wear (dive, dive->now, i);
      *share = bt__wear_at (&wear, from_far_end (dive, i, s)) / tether->props.wear_energy;
    }
  return BT_OK;
}

/* ---- Segments ---- */

static int
thesis_segments (const bt__line *line, bt_segment *out, int max)
{
  bt__segment segment[BT__SPLITS_MAX + 1];
  int n = bt__thesis_segments (line->split, (int64_t)line->tether->props.model, segment,
                               BT__SPLITS_MAX + 1);
  for (int k = 0; k < n && k < max; k++)
    out[k] = (bt_segment){
      (double)segment[k].model, segment[k].from, segment[k].to, segment[k].a, segment[k].b, 0
    };
  return n;
}

/* The span of LINE from FROM to TO; of a far part, which begins BEFORE metres from the anchor, if
   TAIL is true.  */
static bt_segment
segment_between (const bt__line *line, double from, double to, int tail, double before)
{
  return (bt_segment){ .model = line->tether->props.model,
                       .from = before + from,
                       .to = before + to,
                       .a = bt__line_point (line, from),
                       .b = bt__line_point (line, to),
                       .tail = tail };
}

/* Greatest arc length, m, between two contacts of one wrap: closer contacts with the same object
   belong to one wrap, without a span between them.  */
static double
wrap_gap (const bt__line *line)
{
  return 2.5 * bt__line_length (line) / fmax (1, bt__line_nodes (line) - 1);
}

static int
is_one_wrap (const bt__touch *a, const bt__touch *b, double gap)
{
  return a->object == b->object && b->s - a->s < gap;
}

/* The stretches of tether I, which is LINE, or its far part, between touches; within a wrap there
   is no stretch.  BEFORE as for segment_between.  */
static int
free_segments (const bt_dive *dive, int i, const bt__line *line, int tail, double before,
               bt_segment *out, int max)
{
  int n = 0, touches;
  double from = 0;
  bt__touch *touch = all_touches (dive, i, line, &touches);
  for (int k = 0; k <= touches; k++)
    {
      double to = k < touches ? touch[k].s : bt__line_length (line);
      int inside = k > 0 && k < touches && is_one_wrap (&touch[k - 1], &touch[k], wrap_gap (line));
      if (!inside && n < max)
        out[n] = segment_between (line, from, to, tail, before);
      n += !inside;
      from = to;
    }
  free (touch);
  return n;
}

int
bt_tether_segments (const bt_dive *dive, int i, bt_segment *segments, int max)
{
  if (!is_tether (dive, i))
    return -1;
  bt__line line = bt__line_of (dive, dive->now, i);
  if (line.split)
    return thesis_segments (&line, segments, max);
  int n = free_segments (dive, i, &line, 0, 0, segments, max);
  if (!line.tether->parted)
    return n;
  bt__line tail = bt__line_tail (&line);
  int room = max > n ? max - n : 0;
  return n
         + free_segments (dive, i, &tail, 1, before_tail (&line),
                          room > 0 ? segments + n : segments, room);
}

/* ---- Clearance ---- */

/* The obstacles of a clearance: all obstacles, a single obstacle or the hull of a vehicle, whether
   pairs are switched on or not.  AROUND is drawn in the frame AT.  */
typedef struct look
{
  bt__surroundings around;
  bt__switches only, only_mover;
  uint8_t *off;
  bt__frame at;
} look;

/* What tether I sees of the hull that is number OBJECT.  BT_ERR_NAME if the two never meet.  */
static bt_status
look_at_hull (const bt_dive *dive, int i, int object, look *look, bt_error *error)
{
  const bt_model *model = dive->model;
  int vehicle = object - bt__hull_number (model, 0);
  bt_status status = bt__check_part (dive, BT_PART_TETHER, i, error);
  if (status == BT_OK)
    status = bt__check_part (dive, BT_PART_VEHICLE, vehicle, error);
  if (status != BT_OK)
    return status;
  if (model->n_hulls == 0 || !bt__may_meet_hull (model, i, vehicle))
    return bt__fail (error, BT_ERR_NAME,
                     "tether `%s' cannot meet `%s', which has no size or is made fast to it",
                     model->tethers[i].name, model->vehicles[vehicle].name);
  *look = (struct look){ .around.scene = model->hull[vehicle],
                         .at = bt__vehicle_frame (bt__dive_vehicle (dive, dive->now, vehicle)) };
  return BT_OK;
}

static bt_status
look_at_subject (const bt_dive *dive, bt_part part, int i, int obstacle, look *look,
                 bt_error *error)
{
  const bt_model *model = dive->model;
  bt_status status = bt__check_part (dive, part, i, error);
  if (status == BT_OK && obstacle >= 0)
    status = bt__check_part (dive, BT_PART_OBSTACLE, obstacle, error);
  memset (look, 0, sizeof *look);
  look->at = bt__turned (bt__vec (0, 0, 0), 0, 0, 0);
  if (status != BT_OK || model->n_obstacles == 0)
    return status;
  look->around = bt__standing (dive, dive->now, part, i);
  size_t n = (size_t)bt__objects (model);
  look->off = malloc (n);
  if (!look->off)
    return bt__fail (error, BT_ERR_LIMIT, "no memory to look at obstacles");
  memset (look->off, obstacle >= 0, n);
  if (obstacle >= 0)
    bt__switch_slot (model, look->off, obstacle, 1);
  look->only.off = look->off;
  look->around.on = &look->only;
  for (uint32_t k = 0; k < look->around.movers; k++)
    {
      dive->contact_work.course[k].on
          = (bt__switches){ look->off + bt__obstacle_slot (model, model->carried[k].obstacle), 0 };
      dive->contact_work.mover[k].on = &dive->contact_work.course[k].on;
    }
  return BT_OK;
}

/* The nearest part within *CAP of LINK; returns true and lowers *CAP.  */
static int
nearest_part (const bt_dive *dive, const look *look, const bt__link *link, double *cap,
              bt__near *near, bt_clearance *out)
{
  bt__count *count = &((bt_dive *)dive)->contact_work.count;
  const bt__scene *scene = look->around.scene;
  int found = 0;
  if (bt__scene_nearest (scene, look->around.on, link, *cap, near, count))
    {
      *cap = near->w.distance;
      out->object = (int)scene->object[near->object].id;
      out->position = near->w.point;
      found = 1;
    }
  for (uint32_t k = 0; k < look->around.movers; k++)
    {
      const bt__mover *mover = &look->around.mover[k];
      const bt__frame *frame = &mover->motion.from;
      bt__link there = { bt__to_local (frame, link->a), bt__to_local (frame, link->b) };
      if (!bt__scene_nearest (mover->body, mover->on, &there, *cap, near, count))
        continue;
      *cap = near->w.distance;
      out->object = dive->model->carried[k].obstacle;
      out->position = bt__to_world (frame, near->w.point);
      found = 1;
    }
  return found;
}

bt_status
bt_tether_clearance (const bt_dive *dive, int i, int obstacle, bt_clearance *out, bt_error *error)
{
  look look;
  bt__line line;
  bt__near near;
  double cap = FAR, length;
  int n, hull = obstacle >= bt__hull_number (dive->model, 0);
  bt_status status = hull ? look_at_hull (dive, i, obstacle, &look, error)
                          : look_at_subject (dive, BT_PART_TETHER, i, obstacle, &look, error);
  if (status != BT_OK)
    return status;
  *out = (bt_clearance){ .distance = INFINITY, .object = -1 };
  line = bt__line_of (dive, dive->now, i);
  n = bt__line_nodes (&line) - 1;
  length = bt__line_length (&line);
  for (int k = 0; (look.off || hull) && k < n; k++)
    {
      bt__link link = { bt__to_local (&look.at, bt__line_node (&line, k)),
                        bt__to_local (&look.at, bt__line_node (&line, k + 1)) };
      if (!nearest_part (dive, &look, &link, &cap, &near, out))
        continue;
      out->distance = cap - line.tether->props.diameter / 2;
      out->s = length * (k + near.w.s) / n;
    }
  out->position = bt__to_world (&look.at, out->position);
  free (look.off);
  return BT_OK;
}

bt_status
bt_vehicle_clearance (const bt_dive *dive, int i, int obstacle, bt_clearance *out, bt_error *error)
{
  look look;
  bt__hull_body hull;
  bt__stop stop;
  bt_status status = look_at_subject (dive, BT_PART_VEHICLE, i, obstacle, &look, error);
  if (status != BT_OK)
    return status;
  *out = (bt_clearance){ .distance = INFINITY, .object = -1 };
  bt__hull_of (&dive->model->vehicles[i], &hull);
  bt__frame frame = bt__vehicle_frame (bt__dive_vehicle (dive, dive->now, i));
  if (look.off
      && bt__body_nearest (&hull.body, &frame, FAR, look.around.scene, look.around.on,
                           look.around.mover, look.around.movers, &stop,
                           &((bt_dive *)dive)->contact_work.count))
    {
      out->distance = stop.distance;
      out->position = stop.point;
      out->object = bt__stop_obstacle (dive->model, &stop);
    }
  free (look.off);
  return BT_OK;
}

bt_status
bt_point_clearance (const bt_dive *dive, int i, bt_vec3 p, bt_clearance *out, bt_error *error)
{
  look look;
  bt__near near;
  bt__link link = { p, p };
  double cap = FAR;
  bt_status status = look_at_subject (dive, BT_PART_TETHER, i, -1, &look, error);
  if (status != BT_OK)
    return status;
  *out = (bt_clearance){ .distance = INFINITY, .object = -1 };
  if (look.off && nearest_part (dive, &look, &link, &cap, &near, out))
    out->distance = cap;
  free (look.off);
  return BT_OK;
}

int
bt_dive_collided (const bt_dive *dive, bt_part part, int i, int obstacle)
{
  return bt__meets (dive->now, bt__dive_subject (dive, dive->now, part, i), obstacle);
}
