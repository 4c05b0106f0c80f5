/* The line in a current between two fixed ends: shooting.

   Unknown: the tension vector at A, in units of a force near its size; residual: the miss of B over
   the length.  GSL's scaled hybrid method (Powell's dog leg, hybridsj) with a Jacobian by forward
   differences: three marches once per solve, of the seven or eight marches of a warm solve, since
   Broyden's updates carry the Jacobian on.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <stdlib.h>

#include <gsl/gsl_errno.h>

#include "base/error.h"
#include "tether/equilibrium.h"
#include "tether/steady.h"

#define TOLERANCE 1e-11 /* of the length: far below the error of any number of steps in use */
#define USABLE 1e-9     /* accepted where rounding stops the search earlier */
#define PROBE 1e-7      /* of the tension: step of the differences */

enum
{
  ITERATIONS = 60,     /* of GSL's method, from a guess; */
  ITERATIONS_WARM = 30 /* from a neighbour's answer, which takes 4 or never gets there */
};

static bt_vec3
pull_from (const gsl_vector *x, double force)
{
  return bt__scale (force,
                    bt__vec (gsl_vector_get (x, 0), gsl_vector_get (x, 1), gsl_vector_get (x, 2)));
}

static void
put_vector (gsl_vector *v, bt_vec3 a)
{
  gsl_vector_set (v, 0, a.x);
  gsl_vector_set (v, 1, a.y);
  gsl_vector_set (v, 2, a.z);
}

/* Return in *MISS the miss of the far end over the length for PULL.  */
static int
shot_miss (bt__shot *shot, bt_vec3 pull, bt_vec3 *miss)
{
  bt_vec3 end;
  shot->marches++;
  if (bt__ask (shot->asker)
      || !bt__march (&shot->loads, shot->a, pull, shot->length, shot->n, &end, NULL, NULL))
    return GSL_EBADFUNC;
  *miss = bt__scale (1 / shot->length, bt__sub (end, shot->chord));
  return GSL_SUCCESS;
}

static int
shot_f (const gsl_vector *x, void *user, gsl_vector *f)
{
  bt__shot *shot = user;
  bt_vec3 miss;
  int status = shot_miss (shot, pull_from (x, shot->force), &miss);
  if (status == GSL_SUCCESS)
    put_vector (f, miss);
  return status;
}

/* Differences about X, where the miss is AT.  */
static int
differences (bt__shot *shot, const gsl_vector *x, bt_vec3 at, gsl_matrix *jacobian)
{
  bt_vec3 pull = pull_from (x, shot->force);
  double h = PROBE * bt__norm (pull), per = shot->force / h;
  for (int k = 0; k < 3; k++)
    {
      bt_vec3 miss,
          moved = bt__add (pull, bt__vec (k == 0 ? h : 0, k == 1 ? h : 0, k == 2 ? h : 0));
      int status = shot_miss (shot, moved, &miss);
      if (status != GSL_SUCCESS)
        return status;
      bt_vec3 column = bt__scale (per, bt__sub (miss, at));
      gsl_matrix_set (jacobian, 0, k, column.x);
      gsl_matrix_set (jacobian, 1, k, column.y);
      gsl_matrix_set (jacobian, 2, k, column.z);
    }
  return GSL_SUCCESS;
}

static int
shot_df (const gsl_vector *x, void *user, gsl_matrix *jacobian)
{
  bt__shot *shot = user;
  bt_vec3 at;
  int status = shot_miss (shot, pull_from (x, shot->force), &at);
  return status == GSL_SUCCESS ? differences (shot, x, at, jacobian) : status;
}

static int
shot_fdf (const gsl_vector *x, void *user, gsl_vector *f, gsl_matrix *jacobian)
{
  bt__shot *shot = user;
  bt_vec3 at;
  int status = shot_miss (shot, pull_from (x, shot->force), &at);
  if (status != GSL_SUCCESS)
    return status;
  put_vector (f, at);
  return differences (shot, x, at, jacobian);
}

static double
miss_of (const gsl_multiroot_fdfsolver *solver)
{
  return hypot (hypot (gsl_vector_get (solver->f, 0), gsl_vector_get (solver->f, 1)),
                gsl_vector_get (solver->f, 2));
}

/* Search from *PULL in AT_MOST iterations; leave the answer there.  */
static void
search (bt_steady *steady, int at_most, bt_vec3 *pull, bt_steady_report *report)
{
  bt__shot *shot = &steady->shot;
  gsl_multiroot_fdfsolver *solver = steady->solver;
  gsl_multiroot_function_fdf f = { shot_f, shot_df, shot_fdf, 3, shot };
  put_vector (steady->guess, bt__scale (1 / shot->force, *pull));
  if (gsl_multiroot_fdfsolver_set (solver, &f, steady->guess) != GSL_SUCCESS)
    return;
  double miss = miss_of (solver);
  int status = GSL_SUCCESS;
  while (miss > TOLERANCE && status == GSL_SUCCESS && report->iterations < at_most)
    {
      status = gsl_multiroot_fdfsolver_iterate (solver);
      miss = miss_of (solver);
      report->iterations++;
    }
  report->converged = miss <= USABLE;
  report->residual = miss * shot->length;
  *pull = pull_from (solver->x, shot->force);
}

static void
set_shot (bt__shot *shot, const bt_line *line, const bt_water *water, bt_vec3 a, bt_vec3 b, int n)
{
  bt__loads_set (&shot->loads, line, water, a);
  shot->a = a;
  shot->chord = bt__sub (b, a);
  shot->length = line->length;
  shot->force = bt__loads_scale (&shot->loads, line, a, b);
  shot->n = n;
  shot->marches = 0;
}

bt_status
bt__shot_begin (bt_steady *steady, const bt_line *line, const bt_water *water, bt_vec3 a, bt_vec3 b,
                int n, bt_error *error)
{
  bt_status room = bt__steady_room (steady, n, error);
  if (room != BT_OK)
    return room;
  if (!bt__is_finite (a) || !bt__is_finite (b))
    return bt__fail (error, BT_ERR_DOMAIN, "an end of the line is not at a finite place");
  if (!bt__is_finite (bt_water_mean_velocity (water, a, b)))
    return bt__fail (error, BT_ERR_DIVERGED, "the current between the ends is not finite");
  set_shot (&steady->shot, line, water, a, b, n);
  steady->shot.asker = steady->asker;
  return BT_OK;
}

bt_status
bt_steady_shoot (bt_steady *steady, const bt_line *line, const bt_water *water, bt_vec3 a,
                 bt_vec3 b, int n, int warm, bt_vec3 *pull, bt_vec3 *r, bt_vec3 *t,
                 bt_steady_report *report, bt_error *error)
{
  bt_status status = bt__shot_begin (steady, line, water, a, b, n, error);
  *report = (bt_steady_report){ 0, 0, 0, line->length };
  if (status != BT_OK)
    return status;
  bt__shot *shot = &steady->shot;
  bt_vec3 trial = *pull, end;
  if (!warm)
    bt__steady_guess (line, water, a, b, bt__vec (0, 0, -1), n, NULL, &trial);
  if (bt__is_finite (trial) && bt__norm (trial) > 0)
    search (steady, warm ? ITERATIONS_WARM : ITERATIONS, &trial, report);
  if (report->converged)
    report->converged = bt__march (&shot->loads, a, trial, line->length, n, &end, r, t);
  if (report->converged)
    *pull = trial;
  report->integrations = shot->marches;
  return BT_OK;
}

bt_status
bt__steady_room (bt_steady *steady, int n, bt_error *error)
{
  const struct
  {
    void *at;
    size_t size;
  } array[] = { { &steady->x0, sizeof *steady->x0 },
                { &steady->dx, sizeof *steady->dx },
                { &steady->t, sizeof *steady->t },
                { &steady->shape, sizeof *steady->shape },
                { &steady->tensions, sizeof *steady->tensions },
                { &steady->lam, sizeof *steady->lam },
                { &steady->pull, sizeof *steady->pull },
                { &steady->bias, sizeof *steady->bias },
                { &steady->up, sizeof *steady->up },
                { &steady->lanes, sizeof *steady->lanes } };
  if (n < 1 || n > steady->n_max)
    return bt__fail (error, BT_ERR_LIMIT, "%d intervals; the workspace holds 1 to %d", n,
                     steady->n_max);
  for (size_t i = 0; i < sizeof array / sizeof *array; i++)
    {
      void **at = array[i].at;
      if (!*at && !(*at = calloc ((size_t)steady->n_max + 1, array[i].size)))
        return bt__fail (error, BT_ERR_LIMIT, "no memory for %d intervals", steady->n_max);
    }
  return BT_OK;
}

bt_steady *
bt_steady_new (int n_max)
{
  if (n_max < 1)
    return NULL;
  /* GSL would abort the program at the first memory failure or lack of progress.  */
  gsl_set_error_handler_off ();
  bt_steady *steady = calloc (1, sizeof *steady);
  if (!steady)
    return NULL;
  steady->n_max = n_max;
  steady->solver = gsl_multiroot_fdfsolver_alloc (gsl_multiroot_fdfsolver_hybridsj, 3);
  steady->guess = gsl_vector_alloc (3);
  if (steady->solver && steady->guess)
    return steady;
  bt_steady_free (steady);
  return NULL;
}

void
bt__steady_ask (bt_steady *steady, bt__asker *asker)
{
  steady->asker = asker;
}

void
bt_steady_free (bt_steady *steady)
{
  if (!steady)
    return;
  if (steady->solver)
    gsl_multiroot_fdfsolver_free (steady->solver);
  if (steady->guess)
    gsl_vector_free (steady->guess);
  bt_vec3 *vectors[] = { steady->x0, steady->dx, steady->t, steady->shape, steady->tensions };
  for (size_t i = 0; i < sizeof vectors / sizeof *vectors; i++)
    free (vectors[i]);
  free (steady->lam);
  free (steady->pull);
  free (steady->bias);
  free (steady->up);
  free (steady->lanes);
  free (steady);
}
