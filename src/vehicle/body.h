/* A rigid body in water, with thrusters and a tether, stepped implicitly.

   The equations are Fossen's (Handbook of Marine Craft Hydrodynamics and Motion Control, ch. 6-8).
   Nu is the velocity relative to the water along and about the body's own axes at its centre of
   gravity:

     M nu' + C(nu) nu + D(nu) nu + g = tau + (rho V - m) a + J^T F.

   M is the mass with its added mass, a the acceleration of the water, F the pull of the tether on
   its attachment.  A step is the midpoint rule, of second order, solved by Newton's iterates where
   these settle quickly, else by iterates that hold C skew and D positive: at every such iterate C
   does no work and drag takes energy away, so the step is bounded for any h.  Without forces the
   midpoint rule keeps the kinetic energy, and with the attitude turned by Cayley's transform the
   momentum in the world.

   The implicit line.  A stiff line must be solved together with the body that the line pulls.  Over
   a step the end place X of the attachment is, but for terms of higher order, a linear function of
   the pull F: X = AT + Y F.  To the line the body is therefore a spring of stiffness K = Y^-1 to
   the point AT, both found by bt__rigid_grip.  The line's step adds K (AT - X) to the force on its
   end node and K to the node's block; bt__rigid_step is then given the pull F = K (X - AT).

   With F0 the pull of the last step, the body takes the impulse h (theta F + (1 - theta) F0), and a
   change of velocity counts theta h in the way.  With S = (2 M/h + D + torques that turn with the
   body)^-1, Y = 2 theta2 h J S J^T; over M alone, Y = theta2 h2 J M^-1 J^T.  Theta is 1/2, of
   second order, while the line is soft, and grows to 1, which damps all motion too quick for the
   step, as the line grows stiff: theta = 1/2 + 1/2 s/(s + 50), s = h2 k / m, k of the line at its
   end, m of the body there.  F0 counts for less as F falls below a quarter of F0, because a slack
   line must leave nothing behind: a longer memory makes energy at every snap.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#ifndef BT_VEHICLE_BODY_H
#define BT_VEHICLE_BODY_H

#include <stdint.h>

#include "base/record.h"
#include "vehicle/frame.h"
#include "vehicle/type.h"

/* All that moves: flat, of doubles alone.  */
typedef struct bt__rigid
{
  bt_vec3 position; /* m: of the centre of gravity */
  bt__quat attitude;
  bt_vec3 velocity; /* m/s over ground, along the own axes */
  bt_vec3 spin;     /* rad/s, about the own axes */
  double heading;   /* rad, never wrapped, so turns are counted; clockwise positive */
  double thrust[BT__THRUSTERS_MAX]; /* N: now */
  bt_vec3 pull; /* N: F of the last step; at the start that of the line as it was laid */
} bt__rigid;

extern const bt__record bt__quat_record, bt__rigid_record;

/* Surroundings of the body in a step; all zero: empty space.  */
typedef struct bt__rigid_input
{
  double h;                        /* s */
  double density, gravity;         /* kg/m3, m/s2 */
  double surface;                  /* m: height of the water's surface there; INFINITY: none */
  bt_vec3 flow, flow_acceleration; /* of the water, in the middle of the step */
  bt_vec3 force, moment;           /* N, N m at the centre of gravity, world, held */
  bt_vec3 pull;                    /* N on the attachment: at the end of the step if GRIPPED, else
                                      held over it */
  int64_t gripped;                 /* true: PULL is that of an implicit line */
  double stiffness;                /* N/m: of that line at its end, EA by the length of a piece */
  double volts;                    /* of the battery; 0: the type's */
  uint64_t lost;                   /* bit K: thruster K is dead */
  double wish[BT__THRUSTERS_MAX];  /* N asked of each thruster */
} bt__rigid_input;

/* Put BODY, at rest, at a place in an attitude (rad).  */
void bt__rigid_place (bt__rigid *body, bt_vec3 position, double heading, double pitch, double roll);

/* Step BODY.  BT_ERR_DIVERGED leaves it as it was.  */
bt_status bt__rigid_step (const bt__vehicle_type *type, bt__rigid *body, const bt__rigid_input *in,
                          bt_error *error);

/* Two vectors: along and about the own axes.  */
typedef struct bt__rigid_motion
{
  bt_vec3 v, w;
} bt__rigid_motion;

/* What an implicit line sees at its end.  */
typedef struct bt__grip
{
  bt_vec3 at;              /* m: where the attachment would come to without the line */
  double stiffness[3][3];  /* N/m: symmetric, positive definite */
  bt__rigid_motion mid;    /* m/s, rad/s: in the middle of the step with the pull of the last */
  bt__rigid_motion thrust; /* N, N m: mean of the step */
  double end[BT__THRUSTERS_MAX]; /* N: of each thruster at the end of the step */
} bt__grip;

/* Return in *GRIP the end condition for the line of the coming step; IN->pull is not used.  */
bt_status bt__rigid_grip (const bt__vehicle_type *type, const bt__rigid *body,
                          const bt__rigid_input *in, bt__grip *grip, bt_error *error);

/* Step BODY, whose grip for IN, but for pull, GRIPPED and stiffness, is GRIP: as bt__rigid_step, to
   what is left at the end of its iteration, 1e-14 of the velocities, in less time.  */
bt_status bt__rigid_follow (const bt__vehicle_type *type, bt__rigid *body,
                            const bt__rigid_input *in, const bt__grip *grip, bt_error *error);

/* The pull on the body of a line whose end the step has brought to X.  */
bt_vec3 bt__grip_pull (const bt__grip *grip, bt_vec3 x);

/* ---- Points of it ---- */

/* Place and velocity, in the world, of the point P of its own axes.  */
bt_vec3 bt__rigid_point (const bt__rigid *body, bt_vec3 p);
bt_vec3 bt__rigid_point_velocity (const bt__rigid *body, bt_vec3 p);

/* Let BODY bounce at the point P of the world off a surface with the outward NORMAL: Newton's
   RESTITUTION (0 to 1), Coulomb's FRICTION; never with more energy than before.  Return the
   impulse, N s; zero if P was moving away.  */
bt_vec3 bt__rigid_bounce (const bt__vehicle_type *type, bt__rigid *body, bt_vec3 p, bt_vec3 normal,
                          double restitution, double friction);

/* HEADING carried on to the heading of ATTITUDE by the shorter way.  The heading of an attitude is
   the turn about the vertical that remains without the tilt, so pitch, roll and loops leave the
   count alone.  Within 37 deg of upside down a heading means nothing, and HEADING stays.  */
double bt__heading_follow (double heading, bt__quat attitude);

#endif
