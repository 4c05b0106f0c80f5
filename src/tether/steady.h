/* What the solvers of the line in a current share: its loads, one march, the workspace.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#ifndef BT_TETHER_STEADY_H
#define BT_TETHER_STEADY_H

#include <gsl/gsl_multiroots.h>

#include <bight/statics.h>

#include "base/ask.h"
#include "math/four.h"
#include "math/vec.h"
#include "tether/equilibrium.h"

/* The coefficients of the loads on one unstretched metre, with the further inputs of a march.  */
typedef struct bt__loads
{
  const bt_water *water;
  double kn, kt; /* N s2/m3: rho/2 cdn d, rho/2 cdt pi d */
  double w;      /* N/m, sinking positive */
  double inv_ea; /* 1/N, zero when inextensible */
  int uniform;   /* the current is the same everywhere: it is U; ... */
  int layered;   /* ... or depends on the height alone */
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

/* The errors allowed in a step of a march, and the derivatives that tell their effect on the far
   end.  */
typedef struct bt__aim
{
  double place, tension, turn; /* m, N, rad */
  int known;                   /* what follows is known: of a march with about the same pull */
  bt_vec3 column[3];           /* how the far end moves with the pull at A, m/N */
  bt_vec3 stiffness[3];        /* rows of the inverse, N/m */
} bt__aim;

static inline bt_vec3
bt__stiffness_times (const bt_vec3 stiffness[3], bt_vec3 way)
{
  return bt__vec (bt__dot (stiffness[0], way), bt__dot (stiffness[1], way),
                  bt__dot (stiffness[2], way));
}

#define BT__PROBE 1e-7 /* of the pull: the difference between lanes */

/* March by steps that fit AIM.  AT receives SHOT->n + 1
   nodes in four lanes: place from A and tension vector of the line with PULL at A in lane 0; with a
   little more of it along x, y and z in the others (steady_lanes.c).  Return true if the end is
   reached.  */
int bt__fit_march (bt__shot *shot, bt_vec3 pull, const bt__aim *aim, double (*at)[6][BT__FOUR]);

/* Check the shot of LINE in WATER between A and B over N intervals, and set it up
   (steady_shoot.c).  */
bt_status bt__shot_begin (bt_steady *steady, const bt_line *line, const bt_water *water, bt_vec3 a,
                          bt_vec3 b, int n, bt_error *error);

/* Shoot from *REACTION, by steps that make the nodes R and the tensions T of N intervals right to a
   millionth of the length and of the largest tension (steady_refine.c).  REPORT->converged = 0
   where nothing is found.  */
bt_status bt__steady_refine (bt_steady *steady, const bt_line *line, const bt_water *water,
                             bt_vec3 a, bt_vec3 b, int n, bt__reaction *reaction, bt_vec3 *r,
                             bt_vec3 *t, bt_steady_report *report, bt_error *error);

/* Correct the pull of REACTION, of a line whose end B has moved by WAY, m, against end A.  */
void bt__steady_follow (bt__reaction *reaction, bt_vec3 way);

/* The workspace; arrays of n_max + 1 elements each, made by the first call of bt__steady_room.  */
struct bt_steady
{
  int n_max;
  bt__asker *asker; /* of those who search; or NULL */
  gsl_multiroot_fdfsolver *solver;
  gsl_vector *guess;
  bt__shot shot;
  bt_vec3 *x0, *dx, *t, *shape,
      *tensions;                /* start of the step, update, unit tangents, spare shape */
  double *lam, *pull, *bias;    /* of each segment, N: multiplier, tension, see steady_relax.c */
  bt__block *up;                /* eliminated upper blocks */
  double (*lanes)[6][BT__FOUR]; /* nodes of a march, see steady_lanes.c */
};

#endif
