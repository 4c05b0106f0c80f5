/* The hulls of vehicles as moving lines meet them.

   To a moving line the hull of a vehicle is a kinematic obstacle: a box on the way from the
   vehicle's place at the start of the step to the vehicle's place at the end.  The line yields,
   whatever the force.  A vehicle with mass feels the contact forces of the line in the next step.
   If the line cannot yield, the step is tried again with the vehicle standing.

   A vehicle carried by a moving line has a place only after the step of the carrying line.
   Carrying lines therefore go before the lines beside the hull (order.c).  Two lines beside each
   other's hulls have no such order: the first is shown a wrong motion.  The step is then tried
   again with the vehicle pinned to the place where the first try brought the vehicle.

   Boxes about the lines and about the ways of the hulls decide, before the tethers are resolved,
   about the pairs of a line and a hull in the step.  If a line or a hull went farther than expected
   the step is tried again with all pairs.  No line meets the hull of a vehicle at either end of the
   line.  A line inside a hull at the start of a step, as after an operation, is let out.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <math.h>
#include <string.h>

#include "math/vec.h"
#include "sim/around.h"
#include "sim/chain.h"
#include "vehicle/inertia.h"
#include "world/hull.h"
#include "world/obstacles.h"

#define ROOM 0.1   /* m: beyond where the hull is */
#define AHEAD 2.0  /* of the way that the hull went */
#define INSIDE 0.5 /* of the core: a line that touches from outside stays farther off */
#define SAME 1e-9  /* m */
#define KICK 1.0   /* m/s: lines change the speed of no point of a hull by more in a step */

/* What a tether has to do with a hull in a step.  */
enum
{
  APART = 0,
  BESIDE, /* they may meet */
  LET_OUT /* the line lies inside */
};

static uint8_t *
pair_with (const bt_dive *dive, int i, int vehicle)
{
  return dive->contact_work.by_hull + i * dive->model->n_hulls + vehicle;
}

static bt__course *
course_of_hull (const bt_dive *dive, int vehicle)
{
  return dive->contact_work.course + dive->model->n_carried + vehicle;
}

static double
radius_of_hull (const bt_dive *dive, int vehicle)
{
  return 0.5 * bt__norm (dive->model->vehicles[vehicle].size);
}

static bt__frame
hull_frame (const bt_dive *dive, bt__state *state, int vehicle)
{
  return bt__vehicle_frame (bt__dive_vehicle (dive, state, vehicle));
}

/* ---- What is near ---- */

/* The box about the hull, in any attitude, from the start of the step to its end, with ROOM.  */
static bt__aabb
box_about_hull (const bt_dive *dive, bt__state *state, int vehicle, double room)
{
  bt_vec3 a = bt__dive_vehicle (dive, dive->now, vehicle)->position;
  bt__aabb box
      = bt__box_with ((bt__aabb){ a, a }, bt__dive_vehicle (dive, state, vehicle)->position);
  double more = radius_of_hull (dive, vehicle) + room;
  bt_vec3 about = bt__vec (more, more, more);
  return (bt__aabb){ bt__sub (box.lo, about), bt__add (box.hi, about) };
}

static int
is_beside (const bt_dive *dive, bt__state *state, int i, int vehicle)
{
  double speed = bt__norm (bt__dive_vehicle (dive, dive->now, vehicle)->velocity);
  bt__aabb hull = box_about_hull (dive, state, vehicle, ROOM + AHEAD * BT__TIME_STEP * speed);
  const bt__aabb *line = dive->contact_work.box + 2 * i;
  double thick = bt__dive_tether (dive, state, i)->props.diameter;
  return bt__boxes_are_near (&line[0], &hull, thick) || bt__boxes_are_near (&line[1], &hull, thick);
}

/* True if CHAIN comes nearer to the hull at the start of the step than a line that touches.  */
static int
is_inside (const bt_dive *dive, const bt__dynamic *chain, int vehicle, double core)
{
  bt__frame at = hull_frame (dive, dive->now, vehicle);
  const bt_vec3 *x = bt__dynamic_x (chain);
  bt__count *count = &((bt_dive *)dive)->contact_work.count;
  for (int64_t k = 0; k < chain->n; k++)
    {
      bt__link link = { bt__to_local (&at, x[k]), bt__to_local (&at, x[k + 1]) };
      if (bt__scene_within (dive->model->hull[vehicle], NULL, &link, INSIDE * core, count))
        return 1;
    }
  return 0;
}

static int
is_let_out (const bt_dive *dive, bt__state *state, int i, int vehicle)
{
  const bt__tether *tether = bt__dive_tether (dive, state, i);
  double core = bt__core (tether->props.diameter);
  for (int part = 0; part < bt__chains (tether); part++)
    if (is_inside (dive, bt__dive_chain (dive, state, i, part), vehicle, core))
      return 1;
  return 0;
}

/* True if tether I is a moving line that may meet the hull of VEHICLE at all.  */
static int
can_meet (const bt_dive *dive, bt__state *state, int i, int vehicle)
{
  return bt__may_meet_hull (dive->model, i, vehicle)
         && bt__is_cable (bt__dive_tether (dive, state, i))
         && !bt__passes_hull (dive, state, i, vehicle);
}

void
bt__near_hulls (bt_dive *dive, bt__state *state, int passes)
{
  for (int i = 0; i < dive->model->n_tethers; i++)
    for (int v = 0; v < dive->model->n_hulls; v++)
      {
        uint8_t *pair = pair_with (dive, i, v);
        *pair = APART;
        if (!passes || !can_meet (dive, state, i, v)
            || !(dive->contact_work.wide || is_beside (dive, state, i, v)))
          continue;
        *pair = is_let_out (dive, state, i, v) ? LET_OUT : BESIDE;
        dive->profile.beside_hulls++;
      }
}

int
bt__is_by_hull (const bt_dive *dive, int i, int vehicle)
{
  return dive->model->n_hulls > 0 && *pair_with (dive, i, vehicle) == BESIDE;
}

int
bt__is_by_a_hull (const bt_dive *dive, int i)
{
  for (int v = 0; v < dive->model->n_hulls; v++)
    if (bt__is_by_hull (dive, i, v))
      return 1;
  return 0;
}

/* ---- How they go ---- */

void
bt__aim_hulls (bt_dive *dive, int round)
{
  for (int v = 0; v < dive->model->n_hulls; v++)
    {
      bt__course *course = course_of_hull (dive, v);
      course->gone = 0;
      if (round == 0)
        course->share = 1;
    }
  if (dive->model->n_hulls > 0)
    dive->contact_work.disagree = 0;
  if (round == 0)
    dive->contact_work.wide = 0;
}

/* Show a line the motion of the hull.  A line shown a different motion before went by a wrong
   motion.  */
static const bt__motion *
show_hull (bt_dive *dive, bt__state *state, int vehicle)
{
  bt__course *course = course_of_hull (dive, vehicle);
  bt__frame from = hull_frame (dive, dive->now, vehicle), to = hull_frame (dive, state, vehicle);
  bt__motion motion = bt__motion_between (&from, &to);
  if (course->gone && memcmp (&motion, &course->whole, sizeof motion) != 0)
    dive->contact_work.disagree = 1;
  course->whole = motion;
  course->gone = 1;
  return &course->whole;
}

void
bt__surround_by_hulls (bt_dive *dive, bt__state *state, int i, bt__surroundings *around)
{
  static const bt__scene nothing; /* in place of a hull that the line may not meet */
  bt__contact_work *work = &dive->contact_work;
  if (!bt__is_by_a_hull (dive, i))
    return;
  for (int v = 0; v < dive->model->n_hulls; v++)
    {
      int counts = bt__is_by_hull (dive, i, v);
      bt__frame here = hull_frame (dive, dive->now, v);
      bt__motion motion = bt__motion_between (&here, &here);
      if (counts)
        motion = bt__motion_part (show_hull (dive, state, v), work->since, 1 - work->left);
      work->mover[around->movers++] = (bt__mover){ .body = counts ? dive->model->hull[v] : &nothing,
                                                   .motion = motion,
                                                   .radius = counts ? radius_of_hull (dive, v) : 0,
                                                   .done = 1 };
    }
}

void
bt__hulls_done (bt_dive *dive, int i)
{
  bt__contact_work *work = &dive->contact_work;
  for (int v = 0; v < dive->model->n_hulls; v++)
    {
      double done = work->mover[dive->model->n_carried + v].done;
      if (!bt__is_by_hull (dive, i, v) || done >= 1)
        continue;
      if (work->since > 0 || work->left > 0)
        work->balked = 1;
      else
        {
          course_of_hull (dive, v)->share *= done;
          work->disagree = 1;
        }
    }
}

int
bt__hulls_rest (bt_dive *dive, bt__state *state, int i)
{
  int rest = 1;
  for (int v = 0; v < dive->model->n_hulls; v++)
    if (bt__is_by_hull (dive, i, v))
      {
        const bt__motion *motion = show_hull (dive, state, v);
        rest = rest && bt__norm (motion->travel) == 0 && motion->angle == 0;
      }
  return rest;
}

/* ---- What the vehicles feel ---- */

int
bt__is_held_by_line (const bt_dive *dive, int vehicle)
{
  return dive->model->n_hulls > 0 && course_of_hull (dive, vehicle)->share < 1;
}

typedef struct load
{
  bt_vec3 force, moment; /* N, N m: on the vehicle, about its centre */
} load;

static void
add_loads (const bt__contacts *anchors, int number, bt_vec3 centre, load *sum)
{
  const bt__contact *a = bt__contacts_at (anchors);
  for (int64_t k = 0; k < anchors->n; k++)
    if (a[k].object == number)
      {
        sum->force = bt__sub (sum->force, a[k].force);
        sum->moment = bt__sub (sum->moment, bt__cross (bt__sub (a[k].point, centre), a[k].force));
      }
}

static double
least_of (bt_vec3 v)
{
  return fmin (v.x, fmin (v.y, v.z));
}

/* The share of LOAD given to VEHICLE.  The load of a line without a way out in a step would throw
   the vehicle in the next step.  */
static double
bearable_share (const bt_dive *dive, int vehicle, const load *load)
{
  const bt__vehicle_type *type = &dive->model->types[vehicle];
  double turn = bt__norm (load->moment) / least_of (bt__inertias (type));
  double speed = bt__norm (load->force) / least_of (bt__masses (type));
  double kick = BT__TIME_STEP * (speed + turn * radius_of_hull (dive, vehicle));
  return kick > KICK ? KICK / kick : 1;
}

void
bt__add_line_loads (const bt_dive *dive, bt__state *state, int vehicle, bt__rigid_input *in)
{
  const bt_model *model = dive->model;
  bt_vec3 centre = bt__dive_vehicle (dive, state, vehicle)->body.position;
  load sum = { { 0, 0, 0 }, { 0, 0, 0 } };
  for (int i = 0; i < model->n_tethers && model->n_hulls > 0; i++)
    {
      const bt__tether *tether = bt__dive_tether (dive, state, i);
      for (int part = 0; part < bt__chains (tether) && can_meet (dive, state, i, vehicle); part++)
        add_loads (bt__dive_anchors (dive, state, i, part), bt__hull_number (model, vehicle),
                   centre, &sum);
    }
  if (bt__norm (sum.force) == 0)
    return;
  double share = bearable_share (dive, vehicle, &sum);
  in->force = bt__axpy (in->force, share, sum.force);
  in->moment = bt__axpy (in->moment, share, sum.moment);
}

/* ---- Agreement ---- */

static int
are_frames_alike (const bt__frame *a, const bt__frame *b)
{
  return bt__distance (a->origin, b->origin) <= SAME && bt__distance (a->x, b->x) <= SAME
         && bt__distance (a->y, b->y) <= SAME;
}

/* True if every line was shown where VEHICLE is now; else the vehicle is pinned there.  */
static int
was_shown (bt_dive *dive, bt__state *state, int vehicle)
{
  const bt__course *course = course_of_hull (dive, vehicle);
  const bt__vehicle *v = bt__dive_vehicle (dive, state, vehicle);
  bt__pin *pin = &dive->contact_work.pin[vehicle];
  bt__frame shown = bt__motion_at (&course->whole, 1), here = hull_frame (dive, state, vehicle);
  if (!course->gone || are_frames_alike (&shown, &here))
    return 1;
  if (pin->how == BT__PIN_OFF)
    {
      *pin = (bt__pin){ BT__PIN_HARD, v->position, v->body };
      pin->body.position = v->position;
    }
  return 0;
}

/* The box about all that tether I took up in the step.  */
static bt__aabb
box_of_way (const bt_dive *dive, bt__state *state, int i)
{
  bt__aabb box = { { INFINITY, INFINITY, INFINITY }, { -INFINITY, -INFINITY, -INFINITY } };
  bt__state *both[2] = { dive->now, state };
  for (int k = 0; k < 2; k++)
    for (int part = 0; part < bt__chains (bt__dive_tether (dive, both[k], i)); part++)
      {
        const bt__dynamic *chain = bt__dive_chain (dive, both[k], i, part);
        for (int64_t q = 0; q <= chain->n; q++)
          box = bt__box_with (box, bt__dynamic_x (chain)[q]);
      }
  return box;
}

/* True if tether I was shown every hull that it may have met.  */
static int
was_shown_all (const bt_dive *dive, bt__state *state, int i)
{
  bt__aabb way;
  if (!bt__is_cable (bt__dive_tether (dive, dive->now, i))
      || !bt__is_cable (bt__dive_tether (dive, state, i)))
    return 1;
  way = box_of_way (dive, state, i);
  for (int v = 0; v < dive->model->n_hulls; v++)
    {
      bt__aabb hull = box_about_hull (dive, state, v, 0);
      if (can_meet (dive, state, i, v) && *pair_with (dive, i, v) == APART
          && bt__boxes_are_near (&way, &hull, bt__dive_tether (dive, state, i)->props.diameter))
        return 0;
    }
  return 1;
}

int
bt__hulls_agree (bt_dive *dive, bt__state *state)
{
  int agree = 1;
  if (dive->model->n_hulls == 0)
    return 1;
  for (int v = 0; v < dive->model->n_hulls; v++)
    agree &= was_shown (dive, state, v);
  for (int i = 0; i < dive->model->n_tethers && !dive->contact_work.wide; i++)
    if (!was_shown_all (dive, state, i))
      {
        dive->contact_work.wide = 1;
        agree = 0;
      }
  return agree;
}
