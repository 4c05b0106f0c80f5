/* The sonar of a vehicle in a dive: its head at the bow, what is solid about it, and the lines.

   Solid are obstacles, the hulls of the other vehicles as boxes, and clumps and floats that sit at
   a point of a line, as balls of their volume; one that is spread over a section is heard as the
   line is.  The vehicle's own hull is not: its head looks past it.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <bight/instruments.h>

#include <math.h>
#include <stdlib.h>

#include "base/error.h"
#include "math/vec.h"
#include "vehicle/sonar.h"
#include "world/hull.h"
#include "world/lump.h"
#include "world/obstacles.h"

/* ---- Solid bodies that are no obstacles ---- */

static int
most_bodies (const bt_model *model)
{
  int n = model->n_vehicles;
  for (int i = 0; i < model->n_tethers; i++)
    n += (int)model->tethers[i].n_lumps;
  return n;
}

static void
gather_hulls (const bt_dive *dive, int but, bt__echoing *around, bt__obstacle *body)
{
  for (int i = 0; i < dive->model->n_vehicles; i++)
    {
      bt__hull_body hull = { 0 };
      bt__obstacle *o = &body[around->bodies];
      bt__hull_of (&dive->model->vehicles[i], &hull);
      if (i == but || !(hull.box.half.x > 0))
        continue;
      *o = (bt__obstacle){ .kind = BT__OBSTACLE_BOX };
      o->shape.box = hull.box;
      o->shape.box.frame = bt__vehicle_frame (bt__dive_vehicle (dive, dive->now, i));
      around->bodies++;
    }
}

static void
gather_lumps (const bt_dive *dive, int i, bt__echoing *around, bt__obstacle *body)
{
  const bt_tether_def *def = &dive->model->tethers[i];
  bt__line line = bt__line_of (dive, dive->now, i);
  bt_water water = bt__dive_water (dive, dive->now);
  for (int k = 0; k < (int)def->n_lumps; k++)
    {
      bt__obstacle *o = &body[around->bodies];
      double radius = bt__ball_radius (bt__lump_volume (&def->lumps[k], &water));
      bt_vec3 at;
      if (def->lumps[k].span > 0 || !bt__lump_place (dive, i, &line, &def->lumps[k], &at))
        continue;
      *o = (bt__obstacle){ .kind = BT__OBSTACLE_SPHERE };
      o->shape.sphere = (bt__sphere){ at, radius };
      around->bodies++;
    }
}

static void
gather (const bt_dive *dive, int vehicle, bt__echoing *around, bt__obstacle *body)
{
  bt__surroundings s = { .scene = dive->model->scene };
  if (dive->model->n_obstacles > 0)
    s = bt__standing (dive, dive->now, BT_PART_VEHICLE, vehicle);
  *around = (bt__echoing){ s.scene, s.on, s.mover, s.movers, body, 0 };
  gather_hulls (dive, vehicle, around, body);
  for (int i = 0; i < dive->model->n_tethers; i++)
    gather_lumps (dive, i, around, body);
}

/* ---- Lines ---- */

static void
hear_part (const bt__sonar *sonar, const bt__echoing *around, const bt__line *line, int beams,
           double *range, bt__count *count)
{
  bt__capsule piece = { .radius = line->tether->props.diameter / 2 };
  for (int k = 0; k + 1 < bt__line_nodes (line); k++)
    {
      piece.a = bt__line_node (line, k);
      piece.b = bt__line_node (line, k + 1);
      bt__sonar_hear_line (sonar, around, &piece, beams, range, count);
    }
}

static void
hear_lines (const bt_dive *dive, const bt__sonar *sonar, const bt__echoing *around, int beams,
            double *range, bt__count *count)
{
  for (int i = 0; i < dive->model->n_tethers; i++)
    {
      bt__line line = bt__line_of (dive, dive->now, i);
      hear_part (sonar, around, &line, beams, range, count);
      if (line.tether->parted)
        {
          bt__line tail = bt__line_tail (&line);
          hear_part (sonar, around, &tail, beams, range, count);
        }
    }
}

/* ---- The instrument ---- */

static bt_status
check (const bt_sonar *sonar, bt_error *error)
{
  if (!(sonar->beams >= 1 && sonar->beams <= BT_BEAMS_MAX && sonar->range > 0
        && isfinite (sonar->range) && isfinite (sonar->tilt) && isfinite (sonar->sector)))
    return bt__fail (error, BT_ERR_DOMAIN, "a sonar of %d beams to %g m; 1 to %d are allowed",
                     sonar->beams, sonar->range, BT_BEAMS_MAX);
  if (!(sonar->width >= 0 && sonar->width < BT__PI))
    return bt__fail (error, BT_ERR_DOMAIN,
                     "a beam of a sonar is 0 to less than 180 degrees wide, not %g",
                     sonar->width * 180 / BT__PI);
  return BT_OK;
}

bt_status
bt_dive_sonar (const bt_dive *dive, int i, const bt_sonar *sonar, double *range, bt_error *error)
{
  bt_status status = bt__check_part (dive, BT_PART_VEHICLE, i, error);
  const bt__vehicle *v = bt__dive_vehicle (dive, dive->now, i);
  bt__obstacle *body;
  bt__echoing around;
  bt__count count = { 0 };
  bt__sonar head;
  if (status == BT_OK)
    status = check (sonar, error);
  if (status != BT_OK)
    return status;
  body = calloc ((size_t)most_bodies (dive->model), sizeof *body);
  if (!body)
    return bt__fail (error, BT_ERR_LIMIT, "no memory for what a sonar hears");
  head = (bt__sonar){ .head = bt__vehicle_frame (v),
                      .sector = sonar->sector,
                      .tilt = sonar->tilt,
                      .range = sonar->range,
                      .width = sonar->width,
                      .noise = v->instruments.range_noise,
                      .seed = v->instruments.seed };
  head.head.origin = bt__vehicle_bow (&dive->model->vehicles[i], v);
  gather (dive, i, &around, body);
  bt__sonar_sweep (&head, &around, sonar->beams, range, &count);
  if (sonar->width > 0)
    hear_lines (dive, &head, &around, sonar->beams, range, &count);
  bt__sonar_add_noise (&head, dive->now->step, sonar->beams, range);
  free (body);
  return BT_OK;
}
