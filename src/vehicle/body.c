/* The step of a rigid body in water; the method stands in body.h.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <math.h>
#include <string.h>

#include "base/error.h"
#include "vehicle/body.h"
#include "vehicle/inertia.h"
#include "vehicle/solve.h"

enum
{
  ITERATES = 60
};

/* The last change of a solved step, and of what a line sees, of the velocity or of LEAST m/s and
   rad/s.  */
#define SOLVED 1e-14
#define SEEN 1e-10
#define LEAST 0.1
#define QUICK 0.1
#define LETTING_GO 4.0 /* a pull falling to less than a LETTING_GOth in a step counts less */
#define PROPELLER 0.1  /* m: the height over which a thruster leaves the water */
#define SOFT 50.0      /* h2 k / m of a line that is neither soft nor stiff */

/* The data of a step.  Forces are in the own axes but for WORLD_*.  */
typedef struct job
{
  const bt__vehicle_type *type;
  const bt__rigid *body;
  const bt__rigid_input *in;
  bt_vec3 mass, inertia, linear, quadratic, linear_w, quadratic_w;
  bt_vec3 carried;                 /* kg: the masses from which C is built */
  bt__rigid_motion start, mid;     /* relative to the water */
  bt__rigid_motion thrust;         /* N, N m: mean of the step */
  bt_vec3 world_pull, world_force; /* N */
  double solved;                   /* SOLVED or SEEN */
  double theta;                    /* share of the new pull, see body.h */
  double a[6][6];                  /* factors */
} job;

/* ---- Thrusters ---- */

/* The share of thruster K under water; the rest of the propeller turns in air.  */
static double
drowned (const job *j, int k)
{
  if (!(j->in->surface < INFINITY))
    return 1;
  double depth = j->in->surface - bt__rigid_point (j->body, j->type->thruster[k].at).z;
  return bt__clamp (0.5 + depth / PROPELLER, 0, 1);
}

/* The force of thruster K after its lag.  */
static double
settled (const job *j, int k)
{
  const bt__thruster *t = &j->type->thruster[k];
  double nominal = j->type->volts, volts = j->in->volts > 0 ? j->in->volts : nominal;
  double wish = j->in->wish[k];
  if (j->in->lost >> k & 1)
    return 0;
  /* Commands are made for the nominal voltage.  */
  if (volts == nominal && !(t->dead > 0))
    return drowned (j, k) * bt__thruster_nearest (t, volts, wish);
  return drowned (j, k) * bt__thruster_force (t, volts, bt__thruster_command (t, nominal, wish));
}

/* First-order lag, exact for a command held over the step: the mean of the step, and *END.  */
static double
lagged (const bt__thruster *t, double start, double target, double h, double *end)
{
  double s = t->lag > 0 ? h / t->lag : INFINITY;
  double left = exp (-s), mean = t->lag > 0 ? -expm1 (-s) / s : 0;
  *end = target + (start - target) * left;
  return target + (start - target) * mean;
}

static void
run_thrusters (job *j, double *end)
{
  memset (end, 0, BT__THRUSTERS_MAX * sizeof *end);
  for (int k = 0; k < j->type->n; k++)
    {
      const bt__thruster *t = &j->type->thruster[k];
      double f = lagged (t, j->body->thrust[k], settled (j, k), j->in->h, &end[k]);
      j->thrust.v = bt__axpy (j->thrust.v, f, t->along);
      j->thrust.w = bt__axpy (j->thrust.w, f, bt__cross (t->at, t->along));
    }
}

/* ---- The equations ---- */

/* The share of the hull that is under water at height Z.  */
static double
wet_share (const job *j, double z)
{
  double height = j->type->size.z;
  if (!(j->in->surface < INFINITY))
    return 1;
  double s = 0.5 + (j->in->surface - z) / (height > 0 ? height : 1e-3);
  return bt__clamp (s, 0, 1);
}

/* Add -P x to A.  */
static void
add_skew (double (*a)[6], int row, int column, bt_vec3 p)
{
  a[row][column + 1] += p.z;
  a[row][column + 2] -= p.y;
  a[row + 1][column] -= p.z;
  a[row + 1][column + 2] += p.x;
  a[row + 2][column] += p.y;
  a[row + 2][column + 1] -= p.x;
}

/* Add P x times MASS.  */
static void
add_skew_by (double (*a)[6], int row, int column, bt_vec3 p, bt_vec3 mass)
{
  a[row][column + 1] -= p.z * mass.y;
  a[row][column + 2] += p.y * mass.z;
  a[row + 1][column] += p.z * mass.x;
  a[row + 1][column + 2] -= p.x * mass.z;
  a[row + 2][column] -= p.y * mass.x;
  a[row + 2][column + 1] += p.x * mass.y;
}

/* The stiffness against turning of the force F, fixed in the world, at R; the negative part is left
   out.  */
static void
add_turning (double (*a)[6], double k, bt_vec3 r, bt_vec3 f)
{
  double along = bt__dot (r, f), level = along + (bt__norm (r) * bt__norm (f) - along) / 2;
  double xy = k * (r.x * f.y + f.x * r.y) / 2, xz = k * (r.x * f.z + f.x * r.z) / 2;
  double yz = k * (r.y * f.z + f.y * r.z) / 2;
  a[3][3] += k * (level - r.x * f.x);
  a[4][4] += k * (level - r.y * f.y);
  a[5][5] += k * (level - r.z * f.z);
  a[3][4] -= xy, a[4][3] -= xy;
  a[3][5] -= xz, a[5][3] -= xz;
  a[4][5] -= yz, a[5][4] -= yz;
}

static void
add_diagonal_block (double (*a)[6], int at, bt_vec3 d)
{
  a[at][at] += d.x;
  a[at + 1][at + 1] += d.y;
  a[at + 2][at + 2] += d.z;
}

static bt_vec3
damping (bt_vec3 linear, bt_vec3 quadratic, bt_vec3 v)
{
  return bt__vec (linear.x + quadratic.x * fabs (v.x), linear.y + quadratic.y * fabs (v.y),
                  linear.z + quadratic.z * fabs (v.z));
}

/* The masses from which C is built: of the added mass what Munk's moment leaves.  */
static bt_vec3
carried_masses (const bt__vehicle_type *type)
{
  bt_vec3 added = bt__along_axes (type->hydro.added);
  double mean = (added.x + added.y + added.z) / 3, munk = type->hydro.munk;
  bt_vec3 kept = bt__axpy (bt__scale ((1 - munk) * mean, bt__vec (1, 1, 1)), munk, added);
  return bt__add (kept, bt__vec (type->mass, type->mass, type->mass));
}

/* The momenta from which C is built.  */
static bt__rigid_motion
momenta (const job *j, bt__rigid_motion m)
{
  return (bt__rigid_motion){ bt__times (j->carried, m.v), bt__times (j->inertia, m.w) };
}

/* Forces and their points at an iterate: everything but C, D and inertia.  */
typedef struct scene
{
  bt__quat q;
  bt_vec3 buoyancy, pull; /* N, own axes */
  bt__rigid_motion sum;
  double wet;
} scene;

static scene
look_at_iterate (const job *j)
{
  const bt__vehicle_type *type = j->type;
  const bt__rigid_input *in = j->in;
  scene s = { .q = bt__quat_turned (j->body->attitude, bt__scale (in->h / 2, j->mid.w)) };
  double up = bt__turn_out (s.q, j->mid.v).z + in->flow.z;
  s.wet = wet_share (j, j->body->position.z + in->h / 2 * up);
  double weight = type->mass * in->gravity, lift = s.wet * in->density * type->volume * in->gravity;
  double displaced = s.wet * in->density * type->volume - type->mass;
  bt_vec3 outside = bt__axpy (j->world_force, displaced, in->flow_acceleration);
  s.buoyancy = bt__turn_in (s.q, bt__vec (0, 0, lift));
  s.pull = bt__turn_in (s.q, j->world_pull);
  outside.z += lift - weight;
  s.sum.v = bt__add (bt__add (bt__turn_in (s.q, outside), s.pull), j->thrust.v);
  s.sum.w = bt__add (bt__cross (type->buoyancy, s.buoyancy), bt__cross (type->attached, s.pull));
  s.sum.w = bt__add (bt__add (s.sum.w, j->thrust.w), bt__turn_in (s.q, in->moment));
  return s;
}

/* What a matrix is for: how the body yields to a force, without C and with damping over velocity;
   an iterate that is bounded whatever the step, with C skew; an iterate of Newton.  */
typedef enum purpose
{
  YIELDING,
  BOUNDED,
  NEWTON
} purpose;

static void
assemble (job *j, const scene *s, purpose purpose)
{
  double rate = 2 / j->in->h, slope = purpose == YIELDING ? 1 : 2;
  bt_vec3 quadratic = bt__scale (slope, j->quadratic);
  bt_vec3 quadratic_w = bt__scale (slope, j->quadratic_w);
  bt__rigid_motion p = momenta (j, j->mid);
  memset (j->a, 0, sizeof j->a);
  add_diagonal_block (j->a, 0, bt__scale (rate, j->mass));
  add_diagonal_block (j->a, 3, bt__scale (rate, j->inertia));
  add_diagonal_block (j->a, 0, bt__scale (s->wet, damping (j->linear, quadratic, j->mid.v)));
  add_diagonal_block (j->a, 3, bt__scale (s->wet, damping (j->linear_w, quadratic_w, j->mid.w)));
  add_turning (j->a, 1 / rate, j->type->buoyancy, s->buoyancy);
  add_turning (j->a, 1 / rate, j->type->attached, s->pull);
  if (purpose == YIELDING)
    return;
  add_skew (j->a, 0, 3, p.v);
  add_skew (j->a, 3, 0, p.v);
  add_skew (j->a, 3, 3, p.w);
  if (purpose == BOUNDED)
    return;
  add_skew_by (j->a, 0, 0, j->mid.w, j->carried);
  add_skew_by (j->a, 3, 0, j->mid.v, j->carried);
  add_skew_by (j->a, 3, 3, j->mid.w, j->inertia);
}

/* The residual of the equations at the iterate.  */
static void
residual (const job *j, const scene *s, double *r)
{
  double rate = 2 / j->in->h;
  bt__rigid_motion p = momenta (j, j->mid), m = j->mid;
  bt_vec3 v = bt__axpy (s->sum.v, -rate, bt__times (j->mass, bt__sub (m.v, j->start.v)));
  bt_vec3 w = bt__axpy (s->sum.w, -rate, bt__times (j->inertia, bt__sub (m.w, j->start.w)));
  v = bt__axpy (v, -s->wet, bt__times (damping (j->linear, j->quadratic, m.v), m.v));
  w = bt__axpy (w, -s->wet, bt__times (damping (j->linear_w, j->quadratic_w, m.w), m.w));
  v = bt__add (v, bt__cross (p.v, m.w));
  w = bt__add (w, bt__add (bt__cross (p.w, m.w), bt__cross (p.v, m.v)));
  memcpy (r, (double[6]){ v.x, v.y, v.z, w.x, w.y, w.z }, 6 * sizeof *r);
}

/* Factors of the matrix at the iterate: Newton's if *QUICK, unless it has none.  */
static int
factors_at (job *j, const scene *s, int *quick)
{
  if (*quick)
    {
      assemble (j, s, NEWTON);
      if (bt__factor6 (j->a))
        return 1;
      *quick = 0;
    }
  assemble (j, s, BOUNDED);
  return bt__factor6 (j->a);
}

/* Newton's matrix serves on while each update is QUICK of the one before; what is then left after
   an update is foretold by the same share.  Else each iterate is bounded.  */
static int
solve_mid (job *j)
{
  double d[6], before = 0;
  int quick = 1;
  for (int i = 0; i < ITERATES; i++)
    {
      scene s = look_at_iterate (j);
      residual (j, &s, d);
      if ((i == 0 || !quick) && !factors_at (j, &s, &quick))
        return 0;
      bt__substitute6 (j->a, d);
      bt_vec3 dv = bt__vec (d[0], d[1], d[2]), dw = bt__vec (d[3], d[4], d[5]);
      j->mid.v = bt__add (j->mid.v, dv);
      j->mid.w = bt__add (j->mid.w, dw);
      double update = fmax (bt__norm (dv) / (LEAST + bt__norm (j->mid.v)),
                            bt__norm (dw) / (LEAST + bt__norm (j->mid.w)));
      if (update <= j->solved || (i > 0 && quick && update * update <= j->solved * before))
        break;
      quick = quick && (i == 0 || update <= QUICK * before);
      before = update;
    }
  return bt__is_finite (j->mid.v) && bt__is_finite (j->mid.w);
}

static void
prepare_step (job *j, const bt__vehicle_type *type, const bt__rigid *body,
              const bt__rigid_input *in, double solved)
{
  const bt__hydro *hydro = &type->hydro;
  double water = in->density > 0;
  bt_vec3 begin = bt__axpy (in->flow, -in->h / 2, in->flow_acceleration);
  *j = (job){ .type = type, .body = body, .in = in, .solved = solved };
  j->mass = bt__masses (type);
  j->inertia = bt__inertias (type);
  j->carried = carried_masses (type);
  j->linear = bt__scale (water, bt__along_axes (hydro->linear));
  j->quadratic = bt__scale (water, bt__along_axes (hydro->quadratic));
  j->linear_w = bt__scale (water, bt__about (hydro->linear));
  j->quadratic_w = bt__scale (water, bt__about (hydro->quadratic));
  j->start.v = bt__sub (body->velocity, bt__turn_in (body->attitude, begin));
  j->start.w = body->spin;
  j->mid = j->start;
  j->world_force = in->force;
}

/* ---- The step ---- */

/* The reciprocal of the mass moved by the line: along its pull, or the least mass in any direction.
 */
static double
lightness (const job *j, bt_vec3 pull)
{
  bt_vec3 r = j->type->attached, u = bt__turn_in (j->body->attitude, pull);
  double size = bt__norm (pull);
  if (size == 0)
    return 1 / fmin (j->mass.x, fmin (j->mass.y, j->mass.z))
           + bt__dot (r, r) / fmin (j->inertia.x, fmin (j->inertia.y, j->inertia.z));
  u = bt__scale (1 / size, u);
  bt_vec3 m = bt__cross (r, u);
  return bt__dot (u, bt__over (u, j->mass)) + bt__dot (m, bt__over (m, j->inertia));
}

static double
share_of_new (const job *j)
{
  double s = j->in->h * j->in->h * j->in->stiffness * lightness (j, j->body->pull);
  return j->in->gripped ? 0.5 + 0.5 * s / (s + SOFT) : 0.5;
}

/* The mean pull of the step.  If the line lets go within the step, the old pull counts in part:
   counted in full, the line would pull after going slack and make energy.  */
static bt_vec3
mean_pull (const job *j, bt_vec3 pull)
{
  double before = bt__norm (j->body->pull), now = bt__norm (pull);
  double kept = LETTING_GO * now < before ? LETTING_GO * now / before : 1;
  return bt__axpy (bt__scale (j->theta, pull), (1 - j->theta) * kept, j->body->pull);
}

/* The excess of the mean motion over the midpoint's, in a step with a stiff line.  */
static bt__rigid_motion
lead_of (const job *j)
{
  double k = 2 * j->theta - 1;
  return (bt__rigid_motion){ bt__scale (k, bt__sub (j->mid.v, j->start.v)),
                             bt__scale (k, bt__sub (j->mid.w, j->start.w)) };
}

static void
move_body (const job *j, bt__rigid *next)
{
  double h = j->in->h;
  bt__quat q = bt__quat_turned (j->body->attitude, bt__scale (h / 2, j->mid.w));
  bt_vec3 end = bt__axpy (j->in->flow, h / 2, j->in->flow_acceleration);
  bt__rigid_motion lead = lead_of (j);
  bt_vec3 way = bt__add (bt__turn_out (q, bt__add (j->mid.v, lead.v)), j->in->flow);
  next->position = bt__axpy (j->body->position, h, way);
  next->attitude = bt__quat_turned (j->body->attitude, bt__scale (h, bt__add (j->mid.w, lead.w)));
  next->velocity
      = bt__add (bt__sub (bt__scale (2, j->mid.v), j->start.v), bt__turn_in (next->attitude, end));
  next->spin = bt__sub (bt__scale (2, j->mid.w), j->start.w);
}

/* NEXT from the body of J, prepared, with PULL at the end of the step, and with what GRIP knows
   unless NULL; all but its heading.  */
static int
advance_body (job *j, bt_vec3 pull, const bt__grip *grip, bt__rigid *next)
{
  *next = *j->body;
  if (grip)
    {
      j->thrust = grip->thrust;
      j->mid = grip->mid;
      memcpy (next->thrust, grip->end, sizeof next->thrust);
    }
  else
    run_thrusters (j, next->thrust);
  j->theta = share_of_new (j);
  j->world_pull = j->in->gripped ? mean_pull (j, pull) : pull;
  if (!solve_mid (j))
    return 0;
  next->pull = pull;
  move_body (j, next);
  return bt__is_finite (next->position) && bt__is_finite (next->velocity)
         && bt__is_finite (next->spin);
}

bt_status
bt__rigid_follow (const bt__vehicle_type *type, bt__rigid *body, const bt__rigid_input *in,
                  const bt__grip *grip, bt_error *error)
{
  job j;
  bt__rigid next;
  prepare_step (&j, type, body, in, SOLVED);
  if (!advance_body (&j, in->pull, grip, &next))
    return bt__fail (error, BT_ERR_DIVERGED, "the motion of a vehicle (%s) has no finite answer",
                     type->name);
  next.heading = bt__heading_follow (next.heading, next.attitude);
  *body = next;
  return BT_OK;
}

bt_status
bt__rigid_step (const bt__vehicle_type *type, bt__rigid *body, const bt__rigid_input *in,
                bt_error *error)
{
  return bt__rigid_follow (type, body, in, NULL, error);
}

/* ---- The grip ---- */

/* The velocity of the attachment per FORCE on it, world: a column of J S J^T.  */
static bt_vec3
yield (job *j, bt__quat q, bt_vec3 force)
{
  bt_vec3 f = bt__turn_in (q, force), m = bt__cross (j->type->attached, f);
  double x[6] = { f.x, f.y, f.z, m.x, m.y, m.z };
  bt__substitute6 (j->a, x);
  bt_vec3 v = bt__vec (x[0], x[1], x[2]), w = bt__vec (x[3], x[4], x[5]);
  return bt__turn_out (q, bt__add (v, bt__cross (w, j->type->attached)));
}

/* The inverse of the matrix of columns C, symmetric.  */
static void
invert (const bt_vec3 *c, double (*k)[3])
{
  bt_vec3 row[3] = { bt__cross (c[1], c[2]), bt__cross (c[2], c[0]), bt__cross (c[0], c[1]) };
  double per = 1 / bt__dot (c[0], row[0]);
  for (int i = 0; i < 3; i++)
    memcpy (k[i], (double[3]){ per * row[i].x, per * row[i].y, per * row[i].z }, sizeof k[i]);
  for (int i = 0; i < 3; i++)
    for (int m = 0; m < i; m++)
      k[i][m] = k[m][i] = (k[i][m] + k[m][i]) / 2;
}

bt_status
bt__rigid_grip (const bt__vehicle_type *type, const bt__rigid *body, const bt__rigid_input *in,
                bt__grip *grip, bt_error *error)
{
  job j;
  bt__rigid next;
  bt__rigid_input gripped = *in;
  bt_vec3 column[3];
  gripped.gripped = 1;
  prepare_step (&j, type, body, &gripped, SEEN);
  if (!advance_body (&j, body->pull, NULL, &next))
    return bt__fail (error, BT_ERR_DIVERGED, "the motion of a vehicle (%s) has no finite answer",
                     type->name);
  scene s = look_at_iterate (&j);
  assemble (&j, &s, YIELDING);
  bt__factor6 (j.a);
  for (int i = 0; i < 3; i++)
    {
      bt_vec3 unit = bt__vec (i == 0, i == 1, i == 2);
      column[i] = bt__scale (2 * j.theta * j.theta * in->h, yield (&j, s.q, unit));
    }
  invert (column, grip->stiffness);
  grip->at = bt__rigid_point (&next, type->attached);
  grip->at = bt__axpy (grip->at, -body->pull.x, column[0]);
  grip->at = bt__axpy (grip->at, -body->pull.y, column[1]);
  grip->at = bt__axpy (grip->at, -body->pull.z, column[2]);
  grip->mid = j.mid;
  grip->thrust = j.thrust;
  memcpy (grip->end, next.thrust, sizeof grip->end);
  return BT_OK;
}

bt_vec3
bt__grip_pull (const bt__grip *grip, bt_vec3 x)
{
  const double (*k)[3] = grip->stiffness;
  bt_vec3 d = bt__sub (x, grip->at);
  return bt__vec (k[0][0] * d.x + k[0][1] * d.y + k[0][2] * d.z,
                  k[1][0] * d.x + k[1][1] * d.y + k[1][2] * d.z,
                  k[2][0] * d.x + k[2][1] * d.y + k[2][2] * d.z);
}
