/* The hull of a vehicle against obstacles, by continuous collision detection (collide/sweep.h).

   The hull sweeps from its place to the wanted place and attitude up to the first contact.  There a
   vehicle with mass bounces (vehicle/points.c); then the rest of the way, without the part into the
   obstacle, is swept again along the obstacle, twice at most, and the rest of the turn is made as
   far as the hull stays clear.  Kinematic obstacles move with the first sweep and stand afterwards,
   as far as hull and obstacle let each other go.  A vehicle far from all obstacles skips all this.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <math.h>
#include <string.h>

#include "math/vec.h"
#include "sim/around.h"
#include "world/hull.h"
#include "world/obstacles.h"

#define HULL_FRICTION 0.3
#define BALL (1 + 1e-5) /* of the radius of the ball about a hull: rounding */

/* Sweeps of a step, the first included.  */
enum
{
  SLIDES = 3
};

static void
note_stop (bt_dive *dive, bt__state *state, int vehicle, const bt__stop *stop)
{
  bt__subject *subject = bt__dive_subject (dive, state, BT_PART_VEHICLE, vehicle);
  bt__note_meeting (state, subject, BT_PART_VEHICLE, vehicle,
                    bt__stop_obstacle (dive->model, stop));
}

/* WAY without the part into the obstacle.  */
static bt_vec3
along_wall (bt_vec3 way, bt_vec3 normal)
{
  double into = bt__dot (way, normal);
  return into < 0 ? bt__axpy (way, -into, normal) : way;
}

/* A hull on its way in a step.  */
typedef struct passage
{
  bt_dive *dive;
  bt__state *state;
  int vehicle;
  bt__hull_body hull;
  bt__surroundings around;
} passage;

/* Bring *FRAME toward TO; return the share taken.  */
static double
sweep (const passage *p, bt__frame *frame, const bt__frame *to, bt__stop *stop)
{
  bt__motion motion = bt__motion_between (frame, to);
  double share
      = bt__body_sweep (&p->hull.body, &motion, BT__HULL_GAP, p->around.scene, p->around.on,
                        p->around.mover, p->around.movers, stop, &p->dive->contact_work.count);
  *frame = share < 1 ? bt__motion_at (&motion, share) : *to;
  if (share < 1)
    note_stop (p->dive, p->state, p->vehicle, stop);
  return share;
}

/* Let the kinematic obstacles stand where they came in the first sweep.  */
static void
stand_movers (const passage *p)
{
  for (uint32_t k = 0; k < p->around.movers; k++)
    {
      bt__mover *mover = &p->around.mover[k];
      bt__frame there = bt__motion_at (&mover->motion, mover->done);
      mover->motion = bt__motion_between (&there, &there);
      mover->done = 1;
    }
}

/* Slide by WAY along the obstacles met.  */
static void
slide_hull (const passage *p, bt__frame *frame, bt_vec3 way, bt__stop *stop)
{
  for (int k = 1; k < SLIDES; k++)
    {
      bt__frame to = *frame;
      double share;
      way = along_wall (way, stop->normal);
      if (bt__norm (way) == 0)
        return;
      to.origin = bt__add (frame->origin, way);
      share = sweep (p, frame, &to, stop);
      if (share >= 1)
        return;
      way = bt__scale (1 - share, way);
    }
}

/* Turn in place as TO is turned; return the share.  */
static double
turn_hull (const passage *p, bt__frame *frame, bt__frame to)
{
  bt__stop stop;
  to.origin = frame->origin;
  return sweep (p, frame, &to, &stop);
}

/* A vehicle with mass bounces off the obstacle of STOP, with the obstacle's friction, or that of
   hulls on steel if the obstacle has none.  */
static void
strike_obstacle (const passage *p, bt__vehicle *v, const bt__stop *stop)
{
  const bt_model *model = p->dive->model;
  double rough = bt__dive_roughness (p->dive, p->state)[bt__stop_obstacle (model, stop)];
  bt__rigid_bounce (&model->types[p->vehicle], &v->body, stop->point, stop->normal,
                    model->vehicles[p->vehicle].restitution, isnan (rough) ? HULL_FRICTION : rough);
}

/* The attitude of V after SHARE of its turn from BEFORE.  */
static void
turn_body (bt__vehicle *v, const bt__vehicle *before, double share)
{
  bt__quat a = before->body.attitude, b = v->body.attitude;
  double side = a.w * b.w + bt__dot (a.v, b.v) < 0 ? -share : share;
  v->body.attitude = bt__quat_unit ((bt__quat){ (1 - share) * a.w + side * b.w,
                                                bt__axpy (bt__scale (1 - share, a.v), side, b.v) });
  v->body.heading = bt__heading_follow (before->body.heading, v->body.attitude);
}

/* True if VEHICLE can meet no obstacle on its way FROM to WANTED, in any orientation: none is
   within the ball about its hull.  Asked so, most steps need neither the hull nor how it is turned.
 */
static int
is_hull_far (bt_dive *dive, bt_vec3 from, bt_vec3 wanted, int vehicle)
{
  const bt__scene *scene = dive->model->scene;
  bt__aabb way = bt__box_with ((bt__aabb){ from, from }, wanted);
  double radius = BALL * (0.5 * bt__norm (dive->model->vehicles[vehicle].size) + BT__HULL_GAP);
  if (dive->model->n_carried > 0 || !bt__is_finite (wanted))
    return 0;
  return bt__scene_apart (scene, &way) > radius
         || !bt__scene_within (scene, NULL, &(bt__link){ from, wanted }, radius,
                               &dive->contact_work.count);
}

static bt_vec3
reach_among (bt_dive *dive, bt__state *state, int vehicle, bt_vec3 wanted)
{
  const bt__vehicle *before = bt__dive_vehicle (dive, dive->now, vehicle);
  bt__vehicle *v = bt__dive_vehicle (dive, state, vehicle);
  bt__frame frame = bt__vehicle_frame (before), to = bt__vehicle_frame (v);
  passage p = { .dive = dive, .state = state, .vehicle = vehicle };
  bt__stop stop;
  double share;
  to.origin = wanted;
  if (memcmp (&frame, &to, sizeof frame) == 0 && !bt__movers_move (dive))
    return wanted;
  bt__hull_of (&dive->model->vehicles[vehicle], &p.hull);
  p.around = bt__surround (dive, state, BT_PART_VEHICLE, vehicle);
  share = sweep (&p, &frame, &to, &stop);
  bt__around_done (dive);
  if (share >= 1)
    return wanted;
  stand_movers (&p);
  if (v->rigid)
    strike_obstacle (&p, v, &stop);
  slide_hull (&p, &frame, bt__scale (1 - share, bt__sub (wanted, before->position)), &stop);
  share += (1 - share) * turn_hull (&p, &frame, to);
  v->heading = before->heading + share * (v->heading - before->heading);
  if (v->rigid)
    turn_body (v, before, share);
  return frame.origin;
}

bt_vec3
bt__hull_reach (bt_dive *dive, bt__state *state, int vehicle, bt_vec3 wanted)
{
  bt_vec3 before = bt__dive_vehicle (dive, dive->now, vehicle)->position;
  return is_hull_far (dive, before, wanted, vehicle) ? wanted
                                                     : reach_among (dive, state, vehicle, wanted);
}
