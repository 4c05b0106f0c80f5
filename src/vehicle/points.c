/* Points of a rigid body: their places and velocities, the impulse of a bounce, the heading.

   The bounce is Newton's law of restitution at one point with Coulomb's friction.  First the
   impulse that stops the slip at the point is tried (three equations); if its friction exceeds the
   cone, an impulse on the cone against the slip takes its place.  Friction coupled with the normal
   direction can make energy under Newton's rule, so the impulse is reduced to do no work in sum.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <math.h>
#include <string.h>

#include "vehicle/body.h"
#include "vehicle/inertia.h"

#define UPSIDE_DOWN 0.1 /* cos2 of half the tilt below which a heading means nothing */

bt_vec3
bt__rigid_point (const bt__rigid *body, bt_vec3 p)
{
  return bt__add (body->position, bt__turn_out (body->attitude, p));
}

bt_vec3
bt__rigid_point_velocity (const bt__rigid *body, bt_vec3 p)
{
  return bt__turn_out (body->attitude, bt__add (body->velocity, bt__cross (body->spin, p)));
}

/* Strike BODY at the point P of the world with IMPULSE, N s.  */
static void
strike_body (const bt__vehicle_type *type, bt__rigid *body, bt_vec3 p, bt_vec3 impulse)
{
  bt_vec3 r = bt__turn_in (body->attitude, bt__sub (p, body->position));
  bt_vec3 blow = bt__turn_in (body->attitude, impulse);
  body->velocity = bt__add (body->velocity, bt__over (blow, bt__masses (type)));
  body->spin = bt__add (body->spin, bt__over (bt__cross (r, blow), bt__inertias (type)));
}

/* The change of velocity of the point R by the impulse BLOW at R, own axes.  */
static bt_vec3
answer (const bt__vehicle_type *type, bt_vec3 r, bt_vec3 blow)
{
  bt_vec3 spin = bt__over (bt__cross (r, blow), bt__inertias (type));
  return bt__add (bt__over (blow, bt__masses (type)), bt__cross (spin, r));
}

/* The impulse at R for a change of velocity from V to WISH: three linear equations.  */
static bt_vec3
blow_to (const bt__vehicle_type *type, bt_vec3 r, bt_vec3 v, bt_vec3 wish)
{
  bt_vec3 x = answer (type, r, bt__vec (1, 0, 0)), y = answer (type, r, bt__vec (0, 1, 0));
  bt_vec3 z = answer (type, r, bt__vec (0, 0, 1)), d = bt__sub (wish, v);
  double per = 1 / bt__dot (x, bt__cross (y, z));
  return bt__vec (per * bt__dot (d, bt__cross (y, z)), per * bt__dot (d, bt__cross (z, x)),
                  per * bt__dot (d, bt__cross (x, y)));
}

/* The impulse along N, with friction against the slip of V, for a change of velocity along N of 1
   m/s; without friction where friction would wedge the body.  */
static bt_vec3
sliding_blow (const bt__vehicle_type *type, bt_vec3 r, bt_vec3 n, bt_vec3 v, double friction)
{
  bt_vec3 slip = bt__unit_or (bt__off_axis (n, v), bt__vec (0, 0, 0));
  bt_vec3 way = bt__axpy (n, -friction, slip);
  double gain = bt__dot (n, answer (type, r, way));
  if (gain > 0)
    return bt__scale (1 / gain, way);
  return bt__scale (1 / bt__dot (n, answer (type, r, n)), n);
}

bt_vec3
bt__rigid_bounce (const bt__vehicle_type *type, bt__rigid *body, bt_vec3 p, bt_vec3 normal,
                  double restitution, double friction)
{
  bt_vec3 r = bt__turn_in (body->attitude, bt__sub (p, body->position));
  bt_vec3 n = bt__turn_in (body->attitude, normal);
  bt_vec3 v = bt__add (body->velocity, bt__cross (body->spin, r));
  double into = bt__dot (v, n);
  if (!(into < 0))
    return bt__vec (0, 0, 0);
  bt_vec3 blow = blow_to (type, r, v, bt__scale (-restitution * into, n));
  double press = bt__dot (blow, n);
  bt_vec3 rub = bt__axpy (blow, -press, n);
  if (!(press > 0) || bt__norm (rub) > friction * press)
    blow = bt__scale (-(1 + restitution) * into, sliding_blow (type, r, n, v, friction));
  /* Where friction couples with the normal, Newton's rule may make energy: reduce the impulse until
     it makes none.  */
  double work = bt__dot (blow, v), cost = bt__dot (blow, answer (type, r, blow)) / 2;
  if (work + cost > 0)
    blow = bt__scale (fmax (0, -work / cost), blow);
  blow = bt__turn_out (body->attitude, blow);
  strike_body (type, body, p, blow);
  return blow;
}

/* ---- Heading ---- */

double
bt__heading_follow (double heading, bt__quat q)
{
  if (q.w * q.w + q.v.z * q.v.z < UPSIDE_DOWN)
    return heading;
  return heading + remainder (bt__twist_of (q) - heading, 2 * BT__PI);
}

void
bt__rigid_place (bt__rigid *body, bt_vec3 position, double heading, double pitch, double roll)
{
  memset (body, 0, sizeof *body);
  body->position = position;
  body->attitude = bt__quat_of (heading, pitch, roll);
  body->heading = heading;
}
