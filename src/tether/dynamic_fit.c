/* The moving line: the nodes of another mesh, brought to the lengths that the tensions ask for.

   Points taken off a smooth curve through the nodes of a line are no mesh of the same tensions.
   The chord of an interval of length h is shorter than the arc by kappa^2 h^2 / 24 of the arc: for
   a radius of 20 m and intervals of 3 m by 1e-3, which is 200 N of a common line.  So the points
   move until each chord is as long as the chords of the old mesh along it, and with it the tension,
   and until each changes its length at the rate at which these do.

   The points move as little as they can: with the ends held, the least motion X with J X = c is
   X = J^T l, (J J^T) l = c, with a row of J for each chord that is to have a length, and J J^T
   tridiagonal; Newton's iteration, as in the projection of constrained dynamics (Ryckaert,
   Ciccotti, Berendsen 1977).  A slack interval has no tension, and only must not become longer than
   it may be.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <math.h>

#include "math/vec.h"
#include "tether/dynamic.h"

#define EXACT 1e-12  /* of its length: what an interval may be off at last ... */
#define ENOUGH 1e-10 /* ... where rounding leaves no less */
#define FIRM 1e-12   /* added to the matrix, which a straight line makes singular */
enum
{
  ROUNDS = 30
};

void
bt__dynamic_measure (const bt__dynamic *d, int n, bt__fit *fit)
{
  const double *rest = bt__dynamic_rest (d), *stretch = bt__dynamic_stretch (d);
  const bt_vec3 *x = bt__dynamic_x (d), *v = bt__dynamic_v (d);
  double all = bt__dynamic_length (d) - d->owed, gone = 0;
  int64_t j = 0;
  for (int k = 0; k < n; k++)
    {
      double end = all * (k + 1) / n, at = all * k / n;
      fit[k] = (bt__fit){ .rest = bt__dynamic_length (d) / n };
      while (at < end)
        {
          int last = j == d->n - 1;
          double until = last ? end : fmin (end, gone + rest[j]), share = (until - at) / rest[j];
          bt_vec3 along = bt__unit_or (bt__sub (x[j + 1], x[j]), bt__vec (0, 0, 0));
          fit[k].length += (until - at) * stretch[j];
          fit[k].rate += share * bt__dot (along, bt__sub (v[j + 1], v[j]));
          at = until;
          if (last || at < gone + rest[j])
            continue;
          gone += rest[j++];
        }
    }
}

/* What interval K of X is off its length, m; 0 if it is slack and may be.  */
static double
too_long (const bt_vec3 *x, const bt__fit *fit, int k)
{
  double off = bt__distance (x[k], x[k + 1]) - fit[k].length;
  return fit[k].length > fit[k].rest || off > 0 ? off : 0;
}

/* Look at the chords of X anew; return the most that one is off, as a share of its length.  */
static double
look_at_chords (const bt_vec3 *x, int n, bt__fit *fit)
{
  double most = 0;
  for (int k = 0; k < n; k++)
    {
      double off = too_long (x, fit, k);
      int held = fit[k].length > fit[k].rest || off > 0;
      fit[k].along = bt__unit_or (bt__sub (x[k + 1], x[k]), bt__vec (0, 0, 0));
      if (!held)
        fit[k].along = bt__vec (0, 0, 0);
      fit[k].off = off;
      most = fmax (most, fabs (off) / fit[k].rest);
    }
  return most;
}

/* Move the inner ones of the N + 1 vectors P by the least that takes each chord's `off' away.  */
static void
project (bt_vec3 *p, int n, bt__fit *fit)
{
  for (int k = 0; k < n; k++)
    {
      double below = k > 0 ? -bt__dot (fit[k - 1].along, fit[k].along) : 0;
      double held = bt__dot (fit[k].along, fit[k].along) > 0;
      double pivot = (held ? (k > 0) + (k + 1 < n) : 1) + FIRM, right = fit[k].off;
      if (k > 0)
        {
          pivot -= below * below / fit[k - 1].pivot;
          right -= below / fit[k - 1].pivot * fit[k - 1].force;
        }
      fit[k].pivot = fmax (pivot, FIRM);
      fit[k].force = right;
    }
  for (int k = n - 1; k >= 0; k--)
    {
      double above = k + 1 < n ? -bt__dot (fit[k].along, fit[k + 1].along) * fit[k + 1].force : 0;
      fit[k].force = (fit[k].force - above) / fit[k].pivot;
    }
  for (int i = 1; i < n; i++)
    {
      bt_vec3 pull = bt__sub (bt__scale (fit[i].force, fit[i].along),
                              bt__scale (fit[i - 1].force, fit[i - 1].along));
      p[i] = bt__add (p[i], pull);
    }
}

int
bt__dynamic_fit (bt_vec3 *x, bt_vec3 *v, int n, bt__fit *fit)
{
  double off = INFINITY, before;
  int round = 0;
  do
    {
      before = off;
      off = look_at_chords (x, n, fit);
      if (off > EXACT && round < ROUNDS)
        project (x, n, fit);
    }
  while (off > EXACT && ++round <= ROUNDS && !(off < ENOUGH && off >= before));
  if (!(off < ENOUGH))
    return 0;
  for (int k = 0; k < n; k++)
    fit[k].off = bt__dot (fit[k].along, bt__sub (v[k + 1], v[k])) - fit[k].rate;
  project (v, n, fit);
  return 1;
}
