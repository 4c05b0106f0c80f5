/* The compiled model, as the rooms above see it.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#ifndef BT_MODEL_MODEL_H
#define BT_MODEL_MODEL_H

#include <stdatomic.h>
#include <stdint.h>

#include <bight/model.h>

#include "collide/scene.h"
#include "vehicle/frame.h"
#include "vehicle/type.h"

enum
{
  BT__NOT_A_VEHICLE = -1, /* an end that is a point */
  BT__NO_OBSTACLE = -1
};

/* An end with its name looked up.  */
typedef struct bt__end
{
  bt_vec3 at;
  int vehicle; /* index, or BT__NOT_A_VEHICLE */
} bt__end;

/* An obstacle on a track.  */
typedef struct bt__carried
{
  int obstacle;     /* its number */
  bt__scene *body;  /* that obstacle alone, in its own frame: its place is the origin, heading 0 */
  double radius;    /* of a ball about the origin that holds it */
  int n;            /* rows, one or more */
  double (*row)[5]; /* t x y z heading: s, m, degrees */
} bt__carried;

struct bt_model
{
  atomic_int references;
  uint64_t id;      /* hash of the content: equal worlds, equal ids */
  bt__asker *asker; /* while it is made; or NULL */
  bt_sea_def sea;
  bt_waves waves;
  bt_lees *lees; /* of the obstacles that stand in the current; NULL: none */
  int n_vehicles, n_tethers;
  bt_vehicle_def *vehicles;
  bt__vehicle_type *types; /* of each; of one without mass what it would be as a dead weight */
  bt__rig *rigs;
  bt_tether_def *tethers; /* props complete */
  bt__end (*ends)[2];     /* per tether: anchor, far end */
  int *led;               /* per vehicle: the first tether whose far end it has, or -1 */
  int *led_too;           /* per tether: the next whose far end the same vehicle has, or -1 */
  int n_obstacles, n_carried;
  bt_obstacle_def *obstacles; /* their numbers and names; what they borrowed is in the scenes */
  int *where;                 /* of each: its place in SCENE, or -1 - its place in CARRIED */
  bt__scene *scene;           /* what stands still, ids its numbers; empty: nothing does */
  bt__carried *carried;       /* what does not */
  int n_hulls;      /* n_vehicles if a tether may meet the hull of another's vehicle; else 0 */
  bt__scene **hull; /* of each of N_HULLS: the vehicle's box in its own frame; NULL: a point */
  double lowest;    /* m: nothing that stands still reaches below; +inf: nothing does */
  int n_floors;     /* 1: the last of SCENE is the bottom beyond the edge of a seabed */
};

/* True if TETHER is clamped at its end K.  */
static inline int
bt__is_clamped (const bt_tether_def *tether, int k)
{
  bt_vec3 u = tether->along[k];
  return u.x != 0 || u.y != 0 || u.z != 0;
}

/* BT_OK if a line can be as stiff as PROPS say, and TETHER have the sets and clamps it has; else
   BT_ERR_DOMAIN or BT_ERR_UNSUPPORTED says why not.  */
bt_status bt__bears_bends (const bt_tether_props *props, const bt_tether_def *tether,
                           bt_error *error);

/* BT_OK if the line of tether NAME can be as light as PROPS say in water of DENSITY under GRAVITY;
   else BT_ERR_DOMAIN tells the least mass.  */
bt_status bt__check_mass (const bt_tether_props *props, const char *name, double density,
                          double gravity, bt_error *error);

/* The longest chord, m, of LENGTH metres of a tether with PROPS under a pull of at most PULL
   newtons: LENGTH plus the elastic stretch, up to the breaking load or a tenth.  */
double bt__longest_chord (const bt_tether_props *props, double length, double pull);

/* The points of the line that tether I is laid along: its anchor, those of `via', its far end; at
   most BT_VIA_MAX + 2.  Return how many.  */
int bt__lay_points (const bt_model *model, int i, bt_vec3 *points);

/* ---- Obstacles ---- */

/* The number of the obstacle called NAME, or BT__NO_OBSTACLE.  */
int bt__model_obstacle (const bt_model *model, const char *name);

/* As what a tether touches the hull of VEHICLE: behind the obstacles and the tethers.  */
static inline int
bt__hull_number (const bt_model *model, int vehicle)
{
  return model->n_obstacles + model->n_tethers + vehicle;
}

/* True if VEHICLE, one of MODEL's n_hulls, has a hull and tether I is not made fast to VEHICLE.  */
static inline int
bt__may_meet_hull (const bt_model *model, int i, int vehicle)
{
  return model->hull[vehicle] && model->ends[i][0].vehicle != vehicle
         && model->ends[i][1].vehicle != vehicle;
}

/* The shape of obstacle I: in the world if it stands still, else in its own frame.  */
const bt__obstacle *bt__model_shape (const bt_model *model, int i);

/* The place in model->carried of obstacle I, or -1: it stands still.  */
int bt__model_carried (const bt_model *model, int i);

/* Where the K-th of model->carried is at the time T: on straight lines between the rows of its
   track, turning the shorter way round; before the first and after the last as there.  */
bt__frame bt__carried_frame (const bt_model *model, int k, double t);

/* The box about SHAPE, drawn in FRAME; exact but for hulls and meshes that are turned.  */
bt__aabb bt__framed_box (const bt__obstacle *shape, const bt__frame *frame);

/* The axes of what is turned by HEADING (compass, clockwise), then bow up by PITCH, then starboard
   down by ROLL, all in degrees; quarter turns are exact.  Its origin is AT.  */
bt__frame bt__turned (bt_vec3 at, double heading, double pitch, double roll);

#endif
