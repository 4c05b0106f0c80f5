/* A vehicle that runs its line taut.

   The wave in an elastic rod that a mass M at its end strikes (Timoshenko and Goodier, Theory of
   Elasticity, section 172), with internal damping, as a sum over the modes sin (b x): b L tan (b L)
   = m L / M, of the angular frequencies c b, c2 = EA / m, damped by BA b2 / m.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include "testbed/impact.h"

#include <math.h>

#include "math/vec.h"
#include "vehicle/frame.h"
#include "world/dive.h"

#define OF(ea, length)                                                                             \
  {                                                                                                \
    ea, 20, 0.043, length                                                                          \
  }
const impact impacts[IMPACTS] = { OF (1e5, 5), OF (1e5, 10), OF (1e5, 30), OF (1e5, 60),
                                  OF (1e6, 5), OF (1e6, 10), OF (1e6, 30), OF (1e6, 60) };

/* ---- The exact wave ---- */

double
impact_time (const impact *i)
{
  return 1.2 * BT__PI * sqrt (IMPACT_MASS * i->length / i->ea);
}

enum
{
  MODES = 1000,
  INSTANTS = 800
};

/* The K-th root of x tan x = RATIO.  */
static double
mode_of (int k, double ratio)
{
  double low = k * BT__PI, high = low + BT__PI / 2;
  for (int i = 0; i < 100; i++)
    {
      double middle = 0.5 * (low + high);
      *(middle * tan (middle) < ratio ? &low : &high) = middle;
    }
  return low;
}

/* One mode: displacement and velocity of its coordinate at T, begun with velocity V.  */
static void
swing (double omega, double damping, double v, double t, double *q, double *dq)
{
  double a = damping / 2, d = omega * omega - a * a, w = sqrt (fabs (d)), e = exp (-a * t);
  double s = d > 0 ? sin (w * t) * e : 0.5 * (exp ((w - a) * t) - exp (-(w + a) * t));
  double c = d > 0 ? cos (w * t) * e : 0.5 * (exp ((w - a) * t) + exp (-(w + a) * t));
  *q = v * s / w;
  *dq = v * (c - a * s / w);
}

/* Wave numbers, and the velocities with which the modes begin: the mass moves, the line rests.  */
typedef struct modes
{
  double beta[MODES], v[MODES];
} modes;

static void
excite (const impact *r, modes *m)
{
  for (int k = 0; k < MODES; k++)
    {
      double x = mode_of (k, r->mass * r->length / IMPACT_MASS), b = m->beta[k] = x / r->length;
      double line = r->mass * (r->length / 2 - sin (2 * x) / (4 * b));
      m->v[k] = IMPACT_MASS * IMPACT_SPEED * sin (x) / (line + IMPACT_MASS * pow (sin (x), 2));
    }
}

/* The tensions at the anchor and at the vehicle at T.  */
static void
tensions_at (const impact *r, const modes *m, double t, double ends[2])
{
  double c = sqrt (r->ea / r->mass);
  ends[0] = ends[1] = 0;
  for (int k = 0; k < MODES; k++)
    {
      double q, dq, b = m->beta[k];
      swing (c * b, r->ba * b * b / r->mass, m->v[k], t, &q, &dq);
      ends[0] += (r->ea * q + r->ba * dq) * b;
      ends[1] += (r->ea * q + r->ba * dq) * b * cos (b * r->length);
    }
}

double
impact_exact (const impact *r)
{
  modes m = { 0 };
  double seconds = impact_time (r), most = 0, ends[2];
  excite (r, &m);
  for (int i = 1; i <= INSTANTS; i++)
    {
      tensions_at (r, &m, seconds * i / INSTANTS, ends);
      if (ends[1] < 0)
        break;
      most = fmax (most, fmax (ends[0], ends[1]));
    }
  return most;
}

/* ---- A dive of it ---- */

void
impact_scene (scene *s, const impact *i, int nodes)
{
  scene_clear (s);
  s->world.sea.density = 1;
  s->world.sea.gravity = 0;
  bt_vehicle_def *v = scene_vehicle (s, bt__vec (i->length, 0, -50));
  v->mass = v->volume = IMPACT_MASS;
  v->size = bt__vec (0.3, 0.3, 0.3);
  bt_tether_props *p = &scene_line (s, bt__vec (0, 0, -50), i->length, nodes)->props;
  p->tension_accuracy = 0.02;
  p->ea = i->ea;
  p->ba = i->ba;
  p->mass = i->mass;
  p->wet_weight = 0;
  p->cdn = p->cdt = p->ca = 0;
}

bt_dive *
impact_begin (const scene *s)
{
  bt_dive *dive = scene_begin (&s->world);
  bt__vehicle *v = bt__dive_vehicle (dive, dive->now, 0);
  bt__dynamic *chain = bt__dive_chain (dive, dive->now, 0, 0);
  bt_vec3 way = bt__vec (IMPACT_SPEED, 0, 0);
  v->velocity = way;
  v->body.velocity = bt__turn_in (v->body.attitude, way);
  bt__dynamic_still (chain);
  bt__dynamic_v (chain)[chain->n] = way;
  return dive;
}

double
impact_found (bt_dive *dive, double seconds)
{
  double most = 0;
  for (int k = 0; k < seconds * 60; k++)
    {
      bt_tether_view v;
      bt_error error;
      scene_must (bt_dive_step (dive, &error), &error);
      scene_must (bt_dive_tether (dive, 0, &v, &error), &error);
      most = fmax (most, v.tension_max);
    }
  return most;
}
