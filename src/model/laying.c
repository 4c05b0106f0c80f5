/* Where a dive begins: anchors, vehicles and the lines along which tethers are laid must be clear
   of every obstacle.

   A tether is laid straight from the anchor over the `via' points to the far end, and every
   straight piece must be at least the tether's radius away from all obstacles, kinematic obstacles
   being where they are at time 0.  An obstacle may be touched within 1e-9 m: a world written to
   touch may touch.  The contact solvers rely on this start: from a clear line no step passes
   through an obstacle.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include "base/error.h"
#include "model/compile.h"

#define HAIR 1e-9 /* m: what is written to touch may touch */

int
bt__lay_points (const bt_model *model, int i, bt_vec3 *points)
{
  const bt_via *via = &model->tethers[i].via;
  int n = 0;
  points[n++] = model->ends[i][0].at;
  for (int k = 0; k < (int)via->n; k++)
    points[n++] = via->at[k];
  points[n++] = model->ends[i][1].at;
  return n;
}

/* Return true and the obstacle nearest to LINK in SCENE if the obstacle is nearer than CAP.  */
static int
meets_first (const bt__scene *scene, const bt__link *link, double cap, int *obstacle)
{
  bt__count count = { 0 };
  bt__near near;
  if (!bt__scene_nearest (scene, NULL, link, fmax (cap, HAIR), &near, &count)
      || !(near.w.distance < cap - HAIR || near.w.distance <= 0))
    return 0;
  *obstacle = (int)scene->object[near.object].id;
  return 1;
}

/* Return the obstacle that LINK comes nearer to than CAP when the dive begins, or
   BT__NO_OBSTACLE.  */
static int
obstacle_near (const bt_model *model, const bt__link *link, double cap)
{
  int obstacle = BT__NO_OBSTACLE;
  if (meets_first (model->scene, link, cap, &obstacle))
    return obstacle;
  for (int k = 0; k < model->n_carried; k++)
    {
      bt__frame frame = bt__carried_frame (model, k, 0);
      bt__link own = { bt__to_local (&frame, link->a), bt__to_local (&frame, link->b) };
      if (meets_first (model->carried[k].body, &own, cap, &obstacle))
        return obstacle;
    }
  return BT__NO_OBSTACLE;
}

static int
obstacle_at (const bt_model *model, bt_vec3 p, double cap)
{
  return obstacle_near (model, &(bt__link){ p, p }, cap);
}

static const char *
obstacle_kind (const bt_model *model, int obstacle)
{
  return bt_obstacle_head (model->obstacles[obstacle].kind)->name;
}

static bt_status
check_vehicle (const bt_model *model, int i, bt_error *error)
{
  bt_vec3 at = model->vehicles[i].at;
  int k = obstacle_at (model, at, 0);
  if (k == BT__NO_OBSTACLE)
    return BT_OK;
  return bt__fail (error, BT_ERR_DEF, "rov `%s' is at (%g %g %g), inside %s `%s'",
                   model->vehicles[i].name, at.x, at.y, at.z, obstacle_kind (model, k),
                   model->obstacles[k].name);
}

/* An end that is a point.  */
static bt_status
check_end (const bt_model *model, int i, int which, bt_error *error)
{
  const bt__end *end = &model->ends[i][which];
  double radius = model->tethers[i].props.diameter / 2;
  int k = end->vehicle < 0 ? obstacle_at (model, end->at, radius) : BT__NO_OBSTACLE;
  if (k == BT__NO_OBSTACLE)
    return BT_OK;
  return bt__fail (error, BT_ERR_DEF,
                   "the %s of tether `%s', (%g %g %g), lies in %s `%s', or nearer to it than the "
                   "tether's radius, %g m",
                   which == 0 ? "anchor" : "far end", model->tethers[i].name, end->at.x, end->at.y,
                   end->at.z, obstacle_kind (model, k), model->obstacles[k].name, radius);
}

static bt_status
check_line (const bt_model *model, int i, bt_error *error)
{
  double radius = model->tethers[i].props.diameter / 2;
  bt_vec3 p[BT_VIA_MAX + 2];
  int n = bt__lay_points (model, i, p);
  for (int j = 0; j + 1 < n; j++)
    {
      int k = obstacle_near (model, &(bt__link){ p[j], p[j + 1] }, radius);
      if (k != BT__NO_OBSTACLE)
        return bt__fail (error, BT_ERR_DEF,
                         "tether `%s' cannot be laid straight from (%g %g %g) to (%g %g %g): %s "
                         "`%s' is in the way; (via (x y z) ...) leads it round",
                         model->tethers[i].name, p[j].x, p[j].y, p[j].z, p[j + 1].x, p[j + 1].y,
                         p[j + 1].z, obstacle_kind (model, k), model->obstacles[k].name);
    }
  return BT_OK;
}

bt_status
bt__check_laying (const bt_model *model, bt_error *error)
{
  bt_status status = BT_OK;
  if (model->n_obstacles == 0)
    return BT_OK;
  for (int i = 0; status == BT_OK && i < model->n_vehicles; i++)
    status = check_vehicle (model, i, error);
  for (int i = 0; status == BT_OK && i < model->n_tethers; i++)
    for (int which = 0; status == BT_OK && which < 2; which++)
      status = check_end (model, i, which, error);
  for (int i = 0; status == BT_OK && i < model->n_tethers; i++)
    status = check_line (model, i, error);
  return status;
}
