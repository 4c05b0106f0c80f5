/* The extension that finds the properties of a line from measurements: fills the module
   (bight identify solver), and is loaded by the first `identify'.

   The nonlinear least squares are GSL's (gsl_multifit_nlinear): the trust region of Levenberg and
   Marquardt with geodesic acceleration left out, steps by a pivoted QR factorisation of the
   Jacobian (J. J. More, Lecture Notes in Mathematics 630, 1978).

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <math.h>
#include <string.h>

#include <gsl/gsl_eigen.h>
#include <gsl/gsl_errno.h>
#include <gsl/gsl_multifit_nlinear.h>

#include "guile/guile.h"

/* ---- Numbers ---- */

static const double *
doubles (SCM vector)
{
  return (const double *)SCM_BYTEVECTOR_CONTENTS (vector);
}

static size_t
count_of (SCM vector)
{
  return SCM_BYTEVECTOR_LENGTH (vector) / sizeof (double);
}

static SCM
new_doubles (size_t n)
{
  return scm_make_f64vector (scm_from_size_t (n), scm_from_double (0));
}

static double *
content (SCM vector)
{
  return (double *)SCM_BYTEVECTOR_CONTENTS (vector);
}

/* ---- Leading a line ---- */

/* The numbers of a line, in order; see (bight identify flight).  */
enum
{
  DIAMETER,
  MASS,
  WET_WEIGHT,
  EA,
  EI,
  BA,
  BENDING_DAMPING,
  GJ,
  EI_STUCK,
  SLIP_CURVATURE,
  CDN,
  CDT,
  CA,
  FRICTION,
  LENGTH,
  INTERVALS,
  CLAMPED,
  DENSITY,
  GRAVITY,
  CURRENT_X,
  CURRENT_Y,
  CURRENT_Z,
  FLOOR_Z,
  STEP,
  CLOCK,
  LAST,
  TILT,            /* four numbers */
  SETS = TILT + 4, /* from here on four numbers for each set */
  SET_NUMBERS = 4
};

typedef struct lead_call
{
  bt_lead_line line;
  bt_lead_track track;
  bt_lead_start start;
  const double *marks;
  int n;
  bt_vec3 *places, *pulls;
  const volatile int8_t *halt; /* another thread sets it when the call is to be given up */
  bt_status status;
  bt_error error;
} lead_call;

static int
asks_halt (void *user, double share)
{
  (void)share;
  return *((lead_call *)user)->halt != 0;
}

static void *
lead_without_guile (void *user)
{
  lead_call *c = user;
  c->status = bt_lead (&c->line, &c->track, &c->start, c->marks, c->n, c->places, c->pulls,
                       asks_halt, c, &c->error);
  return NULL;
}

/* Of COUNT numbers.  */
static bt_lead_line
line_of (const double *n, size_t count)
{
  return (bt_lead_line){ .props = { .diameter = n[DIAMETER],
                                    .mass = n[MASS],
                                    .wet_weight = n[WET_WEIGHT],
                                    .ea = n[EA],
                                    .ei = n[EI],
                                    .ba = n[BA],
                                    .bending_damping = n[BENDING_DAMPING],
                                    .gj = n[GJ],
                                    .ei_stuck = n[EI_STUCK],
                                    .slip_curvature = n[SLIP_CURVATURE],
                                    .cdn = n[CDN],
                                    .cdt = n[CDT],
                                    .ca = n[CA],
                                    .friction = n[FRICTION] },
                         .length = n[LENGTH],
                         .intervals = (int)n[INTERVALS],
                         .clamped = n[CLAMPED] != 0,
                         .density = n[DENSITY],
                         .gravity = n[GRAVITY],
                         .current = { n[CURRENT_X], n[CURRENT_Y], n[CURRENT_Z] },
                         .floor = n[FLOOR_Z],
                         .step = n[STEP],
                         .tilt = { { n[TILT], n[TILT + 1] }, { n[TILT + 2], n[TILT + 3] } },
                         .sets = (const bt_set *)(const void *)(n + SETS),
                         .n_sets = (int)((count - SETS) / SET_NUMBERS) };
}

static const bt_vec3 *
points_or_null (SCM vector)
{
  return scm_is_true (vector) ? (const bt_vec3 *)(const void *)doubles (vector) : NULL;
}

/* TRACK is a vector (T END END DIRECTION DIRECTION OUT), START (S AT V) or #f.  */
static void
read_track (lead_call *c, const double *numbers, SCM track, SCM start)
{
  SCM out = SCM_SIMPLE_VECTOR_REF (track, 5);
  c->track.t = doubles (SCM_SIMPLE_VECTOR_REF (track, 0));
  c->track.rows = (int)count_of (SCM_SIMPLE_VECTOR_REF (track, 0));
  for (size_t e = 0; e < 2; e++)
    {
      c->track.end[e] = points_or_null (SCM_SIMPLE_VECTOR_REF (track, 1 + e));
      c->track.direction[e] = points_or_null (SCM_SIMPLE_VECTOR_REF (track, 3 + e));
    }
  c->track.out = scm_is_true (out) ? doubles (out) : NULL;
  c->track.clock = numbers[CLOCK];
  c->track.last = (int)numbers[LAST];
  if (scm_is_true (start))
    c->start = (bt_lead_start){ (int)count_of (SCM_SIMPLE_VECTOR_REF (start, 0)),
                                doubles (SCM_SIMPLE_VECTOR_REF (start, 0)),
                                points_or_null (SCM_SIMPLE_VECTOR_REF (start, 1)),
                                points_or_null (SCM_SIMPLE_VECTOR_REF (start, 2)) };
}

static SCM
lead_line (SCM line, SCM track, SCM start, SCM marks, SCM halt)
{
  lead_call c = { .marks = doubles (marks), .n = (int)count_of (marks) };
  SCM_ASSERT (count_of (line) >= SETS && (count_of (line) - SETS) % SET_NUMBERS == 0, line,
              SCM_ARG1, "%lead");
  c.line = line_of (doubles (line), count_of (line));
  read_track (&c, doubles (line), track, start);
  size_t rows = (size_t)(c.track.last > 0 ? c.track.last : c.track.rows);
  SCM places = new_doubles (rows * (size_t)c.n * 3), pulls = new_doubles (rows * 6);
  c.places = (bt_vec3 *)(void *)content (places);
  c.pulls = (bt_vec3 *)(void *)content (pulls);
  c.halt = (const volatile int8_t *)SCM_BYTEVECTOR_CONTENTS (halt);
  scm_without_guile (lead_without_guile, &c);
  scm_remember_upto_here_2 (line, track);
  scm_remember_upto_here_2 (start, marks);
  scm_remember_upto_here_1 (halt);
  return c.status == BT_OK ? scm_cons (places, pulls) : scm_from_utf8_string (c.error.text);
}

/* ---- Least squares ---- */

typedef struct problem
{
  SCM residuals, jacobian; /* procedures of an f64vector */
} problem;

static SCM
from_vector (const gsl_vector *x)
{
  SCM v = new_doubles (x->size);
  for (size_t i = 0; i < x->size; i++)
    content (v)[i] = gsl_vector_get (x, i);
  return v;
}

static int
ask_residuals (const gsl_vector *x, void *user, gsl_vector *f)
{
  SCM r = scm_call_1 (((problem *)user)->residuals, from_vector (x));
  for (size_t i = 0; i < f->size; i++)
    gsl_vector_set (f, i, doubles (r)[i]);
  return GSL_SUCCESS;
}

static int
ask_jacobian (const gsl_vector *x, void *user, gsl_matrix *jacobian)
{
  SCM r = scm_call_1 (((problem *)user)->jacobian, from_vector (x));
  const double *numbers = doubles (r);
  for (size_t i = 0; i < jacobian->size1; i++)
    for (size_t k = 0; k < jacobian->size2; k++)
      gsl_matrix_set (jacobian, i, k, numbers[i * jacobian->size2 + k]);
  return GSL_SUCCESS;
}

static void
free_fit (void *workspace)
{
  gsl_multifit_nlinear_free (workspace);
}

/* A procedure of the problem that throws leaves through GSL's frames, which hold nothing.  */
static SCM
least_squares (SCM residuals, SCM jacobian, SCM from, SCM count, SCM most)
{
  problem p = { residuals, jacobian };
  size_t n = scm_to_size_t (count), k = count_of (from);
  gsl_multifit_nlinear_parameters how = gsl_multifit_nlinear_default_parameters ();
  gsl_multifit_nlinear_fdf fdf
      = { .f = ask_residuals, .df = ask_jacobian, .n = n, .p = k, .params = &p };
  gsl_vector_const_view x = gsl_vector_const_view_array (doubles (from), k);
  int info = 0;
  how.solver = gsl_multifit_nlinear_solver_qr;
  gsl_set_error_handler_off ();
  gsl_multifit_nlinear_workspace *w
      = gsl_multifit_nlinear_alloc (gsl_multifit_nlinear_trust, &how, n, k);
  SCM_ASSERT (w, from, SCM_ARG3, "%least-squares");
  scm_dynwind_begin (0);
  scm_dynwind_unwind_handler (free_fit, w, SCM_F_WIND_EXPLICITLY);
  gsl_multifit_nlinear_init (&x.vector, &fdf, w);
  gsl_multifit_nlinear_driver (scm_to_size_t (most), 1e-5, 1e-7, 1e-7, NULL, NULL, &info, w);
  SCM found = from_vector (gsl_multifit_nlinear_position (w));
  SCM result
      = scm_list_3 (found, scm_from_size_t (gsl_multifit_nlinear_niter (w)), scm_from_int (info));
  scm_dynwind_end ();
  scm_remember_upto_here_1 (from);
  return result;
}

/* ---- Covariance ---- */

/* The eigenvalues, falling, and unit eigenvectors, one after the other, of a symmetric matrix.  */
static SCM
eigen (SCM matrix, SCM count)
{
  size_t n = scm_to_size_t (count);
  SCM values = new_doubles (n), vectors = new_doubles (n * n);
  gsl_matrix *a = gsl_matrix_alloc (n, n), *v = gsl_matrix_alloc (n, n);
  gsl_vector *l = gsl_vector_alloc (n);
  gsl_eigen_symmv_workspace *w = gsl_eigen_symmv_alloc (n);
  SCM_ASSERT (count_of (matrix) == n * n && a && v && l && w, matrix, SCM_ARG1, "%eigen");
  memcpy (a->data, doubles (matrix), n * n * sizeof (double));
  gsl_eigen_symmv (a, l, v, w);
  gsl_eigen_symmv_sort (l, v, GSL_EIGEN_SORT_VAL_DESC);
  for (size_t i = 0; i < n; i++)
    {
      content (values)[i] = gsl_vector_get (l, i);
      for (size_t k = 0; k < n; k++)
        content (vectors)[i * n + k] = gsl_matrix_get (v, k, i);
    }
  gsl_matrix_free (a);
  gsl_matrix_free (v);
  gsl_vector_free (l);
  gsl_eigen_symmv_free (w);
  scm_remember_upto_here_1 (matrix);
  return scm_cons (values, vectors);
}

void bight_identify_init (void);

__attribute__ ((visibility ("default"))) void
bight_identify_init (void)
{
  static const bt__procedure table[] = {
    { "%lead", 5, 0, (scm_t_subr)lead_line,
      "Lead LINE, its numbers, through TRACK from START; return (PLACES . PULLS) of MARKS at each "
      "row, or a string: what went wrong.  The call is given up when the first of HALT is not 0." },
    { "%least-squares", 5, 0, (scm_t_subr)least_squares,
      "Return (X ITERATIONS REASON): X, near FROM, makes the squares of the N numbers of "
      "(RESIDUALS X) least; (JACOBIAN X) has their derivatives, row by row.  REASON 0: not found "
      "within MOST iterations." },
    { "%eigen", 2, 0, (scm_t_subr)eigen,
      "Return (VALUES . VECTORS) of the symmetric MATRIX of N rows, the greatest value first." },
  };
  bt__define_procedures (table, sizeof table / sizeof *table);
}
