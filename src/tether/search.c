/* The thesis' own way to a catenary: Nelder and Mead's search on (A, xs), equations 2-2 to 2-4.

   Kept as the base line for measurements of the closed equation, with GSL's nmsimplex2 in place of
   the thesis' Matlab routine.  Section 2.3.2 prints relative errors for y1 and s *below* one.
   Relative errors cure errors of long lines, so relative errors are used above one here.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <stdlib.h>

#include <gsl/gsl_errno.h>
#include <gsl/gsl_multimin.h>

#include <bight/statics.h>

#include "tether/plane.h"

/* What stands for an overflowed error: the simplex must compare numbers.  */
#define OVERFLOWED 1e200

/* Size of the first simplex as a share of each coordinate.  The thesis prints no step.  The cold
   step is the quickest among 0.05, 0.1, 0.5 and 1 with few failures, the warm step among 0.01 to
   0.5 (Matlab's own fmins took 0.05): a base line should be as good as possible.  */
#define COLD_STEP 0.5
#define WARM_STEP 0.05

struct bt_search
{
  gsl_multimin_fminimizer *simplex;
  gsl_vector *start, *step;
};

typedef struct target
{
  double h, v, s;
} target;

void
bt_search_free (bt_search *search)
{
  if (!search)
    return;
  if (search->simplex)
    gsl_multimin_fminimizer_free (search->simplex);
  gsl_vector_free (search->start);
  gsl_vector_free (search->step);
  free (search);
}

bt_search *
bt_search_new (void)
{
  gsl_set_error_handler_off ();
  bt_search *search = calloc (1, sizeof *search);
  if (!search)
    return NULL;
  search->simplex = gsl_multimin_fminimizer_alloc (gsl_multimin_fminimizer_nmsimplex2, 2);
  search->start = gsl_vector_alloc (2);
  search->step = gsl_vector_alloc (2);
  if (search->simplex && search->start && search->step)
    return search;
  bt_search_free (search);
  return NULL;
}

/* The square of how far IS misses WANTED, relative for WANTED beyond one.  */
static double
squared_miss (double is, double wanted)
{
  double e = fabs (wanted) > 1 ? 1 - is / wanted : wanted - is;
  return e * e;
}

/* Equation 2-2.  A may turn negative, as in the thesis: the guess is negative for lines below a
   metre, and the curve of a negative A is upside down, so callers must check the sign.  */
static double
thesis_error (const gsl_vector *at, void *user)
{
  const target *t = user;
  double a = gsl_vector_get (at, 0), xs = gsl_vector_get (at, 1);
  double end = (t->h - xs) / a, start = -xs / a;
  double e = squared_miss (a * cosh (end) - a * cosh (start), t->v)
             + squared_miss (a * (sinh (end) - sinh (start)), t->s);
  return e < OVERFLOWED ? e : OVERFLOWED;
}

/* The thesis' guess from the length alone, or the last answer.  */
static void
place_start (bt_search *search, double s, int warm, const bt_search_result *last)
{
  double root = (3 * log10 (s) + log2 (s)) / 4, xs = root * root * root, a = xs / 2;
  double share = warm ? WARM_STEP : COLD_STEP;
  if (warm)
    {
      a = last->a;
      xs = last->xs;
    }
  gsl_vector_set (search->start, 0, a);
  gsl_vector_set (search->start, 1, xs);
  /* A coordinate of zero would leave the simplex flat.  */
  gsl_vector_set (search->step, 0, share * (a != 0 ? fabs (a) : s));
  gsl_vector_set (search->step, 1, share * (xs != 0 ? fabs (xs) : s));
}

/* Iterate until the error function lies below TOLERANCE squared, that is the relative error below
   TOLERANCE, or no step is left.  Return the steps taken.  */
static int
iterate_simplex (gsl_multimin_fminimizer *simplex, double tolerance, int iterations)
{
  int n = 0;
  while (n < iterations && !gsl_multimin_fminimizer_iterate (simplex))
    {
      n++;
      if (gsl_multimin_fminimizer_minimum (simplex) < tolerance * tolerance)
        break;
    }
  return n;
}

bt_status
bt_search_catenary (bt_search *search, double h, double v, double s, double tolerance,
                    int iterations, int warm, bt_search_result *result, bt_error *error)
{
  bt_status status = bt__plane_check (h, v, s, error);
  if (status)
    return status;
  target goal = { h, v, s };
  gsl_multimin_function f = { thesis_error, 2, &goal };
  gsl_multimin_fminimizer *simplex = search->simplex;
  place_start (search, s, warm, result);
  int steps = 0;
  if (!gsl_multimin_fminimizer_set (simplex, &f, search->start, search->step))
    steps = iterate_simplex (simplex, tolerance, iterations);
  const gsl_vector *x = gsl_multimin_fminimizer_x (simplex);
  *result = (bt_search_result){ gsl_vector_get (x, 0), gsl_vector_get (x, 1), steps, 0 };
  result->converged
      = steps > 0 && gsl_multimin_fminimizer_minimum (simplex) < tolerance * tolerance;
  return BT_OK;
}
