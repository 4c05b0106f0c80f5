/* The march along a line in a current by steps that fit its error, four lines side by side.

   The steps are those of Dormand and Prince, of fifth order with an estimate of fourth (J. R.
   Dormand and P. J. Prince, J. Comput. Appl. Math. 6, 1980).  Nodes between the ends of steps are
   read from the continuous extension of the method (E. Hairer, S. P. Norsett and G. Wanner, Solving
   Ordinary Differential Equations I, 1993, II.6).  A calm part of a line costs few steps, however
   many nodes there are.

   The velocity of a profile has kinks.  A step sees the layer of water in which the step begins, as
   if the layer had no end: so the derivative is smooth and the estimate of the error holds.  A step
   that leaves the layer is cut, on the continuous extension, at the layer's bound, where the next
   step begins in the next layer.  Kinks of grids and of the drag are left to the estimate.

   The march begins at the end of the shot, which may be either end of the line.  Lane 0 is the
   line; the other lanes begin with a pull a little different along x, y and z, and take the same
   steps.  Their differences are the derivatives of all nodes by the pull.  The lanes are vectors of
   GNU C: a march mostly waits for roots and divisions, so four lanes cost little more than one.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include "math/four_vec.h"
#include "model/current.h"
#include "tether/steady.h"

#define TURN 0.2     /* rad: about what the first step turns */
#define LARGEST 0.25 /* of the line: the longest step */
#define LEAST 1e-12  /* of the line: no shorter step is tried */
#define SHRINK 0.2   /* least and ... */
#define GROW 5.0     /* ... greatest ratio of successive steps */
#define SAFETY 0.9   /* of the step that would just meet the tolerance */
#define STUCK 1e-9   /* of a step: no way out of a layer */

enum
{
  STAGES = 7,
  MOST_TRIES = 20000, /* steps of one march, kept or not */
  HALVINGS = 40
};

typedef struct lanes_state
{
  bt__four_vec r, t; /* place from the beginning of the march, m; tension, N */
} lanes_state;

/* One march under way: at arc length S in the state Y with the derivative K[0], in LAYER; a step to
   try of H, with its end in NEXT.  NODE is the next node to be read.  */
typedef struct lanes_march
{
  const bt__shot *shot;
  const bt__aim *aim;
  double probe, s, h;
  lanes_state y, next, k[STAGES];
  double (*at)[6][BT__FOUR];
  int node, layer, stuck;
} lanes_march;

/* The continuous extension of a step at the share F: y + f (way + g (bow + f (lean + g last))),
   with g = 1 - f.  */
typedef struct lanes_curve
{
  lanes_state way, bow, lean, last;
} lanes_curve;

static BT__HOT lanes_state
lanes_on (lanes_state s, double h, const lanes_state *k)
{
  bt__four by = bt__four_all (h);
  return (lanes_state){ bt__four_axpy (s.r, by, k->r), bt__four_axpy (s.t, by, k->t) };
}

static BT__HOT lanes_state
no_lanes (void)
{
  bt__four none = bt__four_all (0);
  return (lanes_state){ { none, none, none }, { none, none, none } };
}

/* ---- The equations ---- */

static BT__HOT bt__four_vec
lanes_currents (const lanes_march *m, bt__four_vec r)
{
  const bt__shot *shot = m->shot;
  const bt__loads *loads = &shot->loads;
  if (loads->uniform)
    return (bt__four_vec){ bt__four_all (loads->u.x), bt__four_all (loads->u.y),
                           bt__four_all (loads->u.z) };
  bt_vec3 u[BT__FOUR], shear;
  if (loads->layered)
    {
      bt__four up = r.z - r.z[0];
      u[0] = bt__water_in_layer (loads->water, m->layer, shot->a.z + r.z[0], &shear);
      return (bt__four_vec){ u[0].x + up * shear.x, u[0].y + up * shear.y, u[0].z + up * shear.z };
    }
  for (int i = 0; i < BT__FOUR; i++)
    u[i] = bt_water_velocity (loads->water, bt__add (shot->a, bt__vec (r.x[i], r.y[i], r.z[i])));
  return (bt__four_vec){ { u[0].x, u[1].x, u[2].x, u[3].x },
                         { u[0].y, u[1].y, u[2].y, u[3].y },
                         { u[0].z, u[1].z, u[2].z, u[3].z } };
}

static BT__HOT bt__four
lanes_abs (bt__four a)
{
  return (bt__four)((bt__four_mask)a & INT64_MAX);
}

/* The derivative of S along the line; a vanished tension gives NaN.  */
static BT__HOT lanes_state
lanes_slope (const lanes_march *m, const lanes_state *s)
{
  const bt__loads *k = &m->shot->loads;
  bt__four tension = bt__four_sqrt (bt__four_dot (s->t, s->t));
  bt__four_vec t = bt__four_scale (1 / tension, s->t), u = lanes_currents (m, s->r);
  bt__four ut = bt__four_dot (u, t);
  bt__four_vec un = bt__four_axpy (u, -ut, t);
  bt__four broadside = -k->kn * bt__four_sqrt (bt__four_dot (un, un));
  bt__four_vec pulls
      = bt__four_axpy (bt__four_scale (broadside, un), -k->kt * lanes_abs (ut) * ut, t);
  pulls.z += k->w;
  return (lanes_state){ bt__four_scale (1 + tension * k->inv_ea, t), pulls };
}

/* ---- One step ---- */

static BT__HOT void
try_step (lanes_march *m)
{
  static const double a[STAGES][STAGES - 1]
      = { { 0 },
          { 1. / 5 },
          { 3. / 40, 9. / 40 },
          { 44. / 45, -56. / 15, 32. / 9 },
          { 19372. / 6561, -25360. / 2187, 64448. / 6561, -212. / 729 },
          { 9017. / 3168, -355. / 33, 46732. / 5247, 49. / 176, -5103. / 18656 },
          { 35. / 384, 0, 500. / 1113, 125. / 192, -2187. / 6784, 11. / 84 } };
  for (int i = 1; i < STAGES; i++)
    {
      lanes_state s = m->y;
      for (int j = 0; j < i; j++)
        s = lanes_on (s, m->h * a[i][j], &m->k[j]);
      m->k[i] = lanes_slope (m, &s);
      m->next = s;
    }
}

static BT__HOT lanes_state
sum_of_stages (const lanes_march *m, const double weight[STAGES])
{
  lanes_state sum = no_lanes ();
  for (int i = 0; i < STAGES; i++)
    sum = lanes_on (sum, m->h * weight[i], &m->k[i]);
  return sum;
}

/* How far the end of the line moves by errors of the place, OFF, and of the tension, PULL, at the
   end of the step: the movement by the pull at A, less the part of the line marched so far.  */
static BT__HOT bt_vec3
way_of_end (const lanes_march *m, bt_vec3 off, bt_vec3 pull)
{
  const bt_vec3 *column = m->aim->column;
  bt__four_vec r = m->next.r;
  double by[3] = { pull.x, pull.y, pull.z };
  for (int k = 0; k < 3; k++)
    {
      double per = by[k] / m->probe;
      bt_vec3 moved = bt__sub (bt__four_lane (r, k + 1), bt__four_lane (r, 0));
      off = bt__axpy (bt__axpy (off, by[k], column[k]), -per, moved);
    }
  return off;
}

/* The estimated error of the step over the error allowed: the largest of the errors of the step's
   end, of the far end, and of the pull that brings the far end back.  */
static BT__HOT double
error_of_step (const lanes_march *m)
{
  static const double weight[STAGES]
      = { 71. / 57600, 0, -71. / 16695, 71. / 1920, -17253. / 339200, 22. / 525, -1. / 40 };
  lanes_state e = sum_of_stages (m, weight);
  const bt__aim *aim = m->aim;
  bt_vec3 off = bt__four_lane (e.r, 0);
  bt_vec3 pull = bt__four_lane (e.t, 0);
  if (!aim->known)
    return bt__norm (off) / aim->place
           + bt__norm (pull) / bt__norm (bt__four_lane (m->next.t, 0)) / aim->turn;
  bt_vec3 way = way_of_end (m, off, pull);
  double own = fmax (bt__norm (off) / aim->place, bt__norm (pull) / aim->tension);
  double back = bt__norm (bt__stiffness_times (aim->stiffness, way)) / aim->tension;
  return fmax (own, fmax (back, bt__norm (way) / aim->place));
}

/* ---- Nodes ---- */

static BT__HOT void
write_node (double at[6][BT__FOUR], const lanes_state *s)
{
  bt__four_store (at[0], s->r.x);
  bt__four_store (at[1], s->r.y);
  bt__four_store (at[2], s->r.z);
  bt__four_store (at[3], s->t.x);
  bt__four_store (at[4], s->t.y);
  bt__four_store (at[5], s->t.z);
}

static BT__HOT lanes_curve
curve_of_step (const lanes_march *m)
{
  static const double weight[STAGES] = { -12715105075. / 11282082432,  0,
                                         87487479700. / 32700410799,   -10690763975. / 1880347072,
                                         701980252875. / 199316789632, -1453857185. / 822651844,
                                         69997945. / 29380423 };
  lanes_curve c = { .way = lanes_on (m->next, -1, &m->y), .last = sum_of_stages (m, weight) };
  c.bow = lanes_on (lanes_on (no_lanes (), m->h, &m->k[0]), -1, &c.way);
  c.lean = lanes_on (lanes_on (c.way, -m->h, &m->k[STAGES - 1]), -1, &c.bow);
  return c;
}

static BT__HOT lanes_state
state_on_curve (const lanes_march *m, const lanes_curve *c, double f)
{
  double g = 1 - f;
  lanes_state s = lanes_on (lanes_on (m->y, f, &c->way), f * g, &c->bow);
  return lanes_on (lanes_on (s, f * f * g, &c->lean), f * f * g * g, &c->last);
}

/* Read the nodes in the part of the step up to the arc length TO.  */
static BT__HOT void
write_nodes (lanes_march *m, const lanes_curve *c, double to)
{
  double interval = m->shot->length / m->shot->n;
  for (; m->node < m->shot->n && m->node * interval <= to; m->node++)
    {
      lanes_state s = state_on_curve (m, c, (m->node * interval - m->s) / m->h);
      write_node (m->at[m->node], &s);
    }
}

/* ---- Layers ---- */

/* Whether the step leaves its layer: 1 upward, -1 downward, 0 not.  *BOUND is the height where.  */
static int
leaves_layer (const lanes_march *m, double *bound)
{
  double low, high, z = m->shot->a.z + m->next.r.z[0];
  if (!m->shot->loads.layered)
    return 0;
  bt__water_layer_bounds (m->shot->loads.water, m->layer, &low, &high);
  *bound = z > high ? high : low;
  return z > high ? 1 : z < low ? -1 : 0;
}

/* The share of the step at which the march leaves the layer on SIDE through the height BOUND.  */
static BT__HOT double
share_in_layer (const lanes_march *m, const lanes_curve *c, int side, double bound)
{
  double from = 0, to = 1, start = m->shot->a.z + m->y.r.z[0] - bound;
  for (int i = 0; i < HALVINGS; i++)
    {
      double f = 0.5 * (from + to), g = 1 - f;
      double off
          = start
            + f * (c->way.r.z[0] + g * (c->bow.r.z[0] + f * (c->lean.r.z[0] + g * c->last.r.z[0])));
      if (side * off > 0)
        to = f;
      else
        from = f;
    }
  return to;
}

/* End the step just tried at its share F, at the bound of the layer on SIDE.  A step that leaves at
   once only changes the layer; a step that would leave the second layer at once sees no layers.  */
static BT__HOT int
end_in_layer (lanes_march *m, const lanes_curve *c, double f, int side)
{
  const bt_water *water = m->shot->loads.water;
  if (f < STUCK && m->stuck)
    return 0;
  m->layer = bt__water_next_layer (water, m->layer, side > 0);
  m->stuck = f < STUCK;
  if (!m->stuck)
    {
      write_nodes (m, c, m->s + f * m->h);
      m->y = state_on_curve (m, c, f);
      m->s += f * m->h;
    }
  m->k[0] = lanes_slope (m, &m->y);
  return 1;
}

/* ---- The march ---- */

/* Keep the step just tried, or the part of it in its layer.  Return true if it is kept whole.  */
static BT__HOT int
keep_step (lanes_march *m)
{
  double bound;
  int side = leaves_layer (m, &bound);
  lanes_curve c = curve_of_step (m);
  if (side != 0 && end_in_layer (m, &c, share_in_layer (m, &c, side, bound), side))
    return 0;
  write_nodes (m, &c, m->s + m->h);
  m->s += m->h;
  m->y = m->next;
  m->k[0] = m->k[STAGES - 1];
  if (side != 0)
    m->layer = bt__water_layer_at (m->shot->loads.water, m->shot->a.z + m->y.r.z[0]);
  m->stuck = 0;
  return 1;
}

static BT__HOT void
begin_march (lanes_march *m)
{
  double length = m->shot->length;
  if (m->shot->loads.layered)
    m->layer = bt__water_layer_at (m->shot->loads.water, m->shot->a.z);
  m->k[0] = lanes_slope (m, &m->y);
  m->h
      = fmin (TURN * bt__norm (bt__four_lane (m->y.t, 0)) / bt__norm (bt__four_lane (m->k[0].t, 0)),
              LARGEST * length);
  write_node (m->at[0], &m->y);
}

/* March to the end of the line; return true if that is reached.  */
static BT__WIDE int
march_lanes (lanes_march *m)
{
  double length = m->shot->length;
  begin_march (m);
  for (int i = 0; i < MOST_TRIES; i++)
    {
      int last = m->s + 1.001 * m->h >= length;
      if (last)
        m->h = length - m->s;
      else if (!(m->h > LEAST * length))
        return 0;
      try_step (m);
      double error = error_of_step (m), h = m->h;
      if (error <= 1 && keep_step (m) && last)
        return 1;
      /* Roots are the same on any machine; the error goes with the fifth power of the step.  */
      double ratio = fmin (fmax (SAFETY / sqrt (sqrt (error)), SHRINK), GROW);
      m->h = fmin (h * ratio, LARGEST * length);
    }
  return 0;
}

/* PULL in all lanes, BT__PROBE more of it along x, y and z in lanes 1 to 3.  */
static lanes_state
beginning (bt_vec3 pull, double probe)
{
  lanes_state s = no_lanes ();
  s.t = (bt__four_vec){ { pull.x, pull.x + probe, pull.x, pull.x },
                        { pull.y, pull.y, pull.y + probe, pull.y },
                        { pull.z, pull.z, pull.z, pull.z + probe } };
  return s;
}

int
bt__fit_march (bt__shot *shot, bt_vec3 pull, const bt__aim *aim, double (*at)[6][BT__FOUR])
{
  lanes_march m = { .shot = shot, .aim = aim, .at = at, .node = 1 };
  m.probe = BT__PROBE * bt__norm (pull);
  m.y = beginning (pull, m.probe);
  shot->marches++;
  int there = march_lanes (&m);
  write_node (at[shot->n], &m.y);
  return there;
}
