/* What the solvers of the line in a current share: its loads, one march, the workspace.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#ifndef BT_TETHER_STEADY_H
#define BT_TETHER_STEADY_H

#include <gsl/gsl_multiroots.h>

#include <bight/statics.h>

#include "base/ask.h"
#include "math/vec.h"

/* The coefficients of the loads on one unstretched metre, with the further inputs of a march.  */
typedef struct bt__loads
{
  const bt_water *water;
  double kn, kt; /* N s2/m3: rho/2 cdn d, rho/2 cdt pi d */
  double w;      /* N/m, sinking positive */
  double inv_ea; /* 1/N, zero when inextensible */
  int uniform;   /* the current is the same everywhere: it is U */
  bt_vec3 u;
} bt__loads;

/* Collect the loads of LINE in WATER.  */
void bt__loads_set (bt__loads *loads, const bt_line *line, const bt_water *water, bt_vec3 at);

/* Return the scale of force, N, of the whole line: The weight plus the broadside drag of the line
   in the mean current between A and B; for an unloaded line, the weight of the displaced water.
   Always positive.  */
double bt__loads_scale (const bt__loads *loads, const bt_line *line, bt_vec3 a, bt_vec3 b);

/* The current at P.  */
static inline bt_vec3
bt__loads_current (const bt__loads *loads, bt_vec3 p)
{
  return loads->uniform ? loads->u : bt_water_velocity (loads->water, p);
}

/* The load on a metre of line with unit tangent T in a current U, N/m.  */
static inline bt_vec3
bt__loads_at (const bt__loads *loads, bt_vec3 u, bt_vec3 t)
{
  double ut = bt__dot (u, t);
  bt_vec3 un = bt__axpy (u, -ut, t);
  bt_vec3 load
      = bt__axpy (bt__scale (loads->kn * bt__norm (un), un), loads->kt * fabs (ut) * ut, t);
  load.z -= loads->w;
  return load;
}

/* March from ORIGIN with PULL over LENGTH in N Runge-Kutta steps.  *END receives the far end
   relative to ORIGIN (small numbers keep their digits).  R and T may be NULL.  Return true on
   success, zero when the tension vanishes or a value is not finite.  */
int bt__march (const bt__loads *loads, bt_vec3 origin, bt_vec3 pull, double length, int n,
               bt_vec3 *end, bt_vec3 *r, bt_vec3 *t);

/* Lay N + 1 nodes R along the catenary of LINE between A and B under the mean load (toward FALLBACK
   where the load has no direction across the chord), and return the tension vector at A in *PULL.
   R may be NULL.  Always finite.  */
void bt__steady_guess (const bt_line *line, const bt_water *water, bt_vec3 a, bt_vec3 b,
                       bt_vec3 fallback, int n, bt_vec3 *r, bt_vec3 *pull);

/* Draw in the links longer than REACH of the N + 1 nodes R. REACH exceeds an Nth of the distance
   from the first node to the last; return true if there was such a link (steady_shorten.c).  */
int bt__steady_shorten (bt_vec3 *r, int n, double reach);

typedef struct bt__block
{
  double m[3][3];
} bt__block;

/* One shot's constants, read by GSL's callbacks.  */
typedef struct bt__shot
{
  bt__loads loads;
  bt_vec3 a, chord;
  double length, force; /* m; N, the unit of the unknowns */
  int n, marches;
  bt__asker *asker;
} bt__shot;

/* The workspace; arrays of n_max + 1 elements each.  */
struct bt_steady
{
  int n_max;
  bt__asker *asker; /* of those who search; or NULL */
  gsl_multiroot_fdfsolver *solver;
  gsl_vector *guess;
  bt__shot shot;
  bt_vec3 *x0, *dx, *t, *shape,
      *tensions;             /* start of the step, update, unit tangents, spare shape */
  double *lam, *pull, *bias; /* of each segment, N: multiplier, tension, see steady_relax.c */
  bt__block *up;             /* eliminated upper blocks */
};

#endif
