/* The moving line: questions.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include "tether/dynamic_kernel.h"

/* The largest of their components, two by two, times the root of three.  */
double
bt__dynamic_stray (const bt_vec3 *a, const bt_vec3 *b, int n)
{
  bt__pair most = { 0, 0 }, more = { 0, 0 };
  int i = 0;
  for (; i + 1 < n; i += 2)
    {
      bt__pair x = { a[i].x, a[i].y }, y = { a[i].z, a[i + 1].x }, z = { a[i + 1].y, a[i + 1].z };
      bt__pair p = { b[i].x, b[i].y }, q = { b[i].z, b[i + 1].x }, r = { b[i + 1].y, b[i + 1].z };
      most = bt__pair_max (most, bt__pair_max (bt__pair_abs (x - p), bt__pair_abs (y - q)));
      more = bt__pair_max (more, bt__pair_abs (z - r));
    }
  most = bt__pair_max (most, more);
  double last = 0;
  if (i < n)
    last = fmax (fabs (a[i].x - b[i].x), fmax (fabs (a[i].y - b[i].y), fabs (a[i].z - b[i].z)));
  return 1.7320508075688774 * fmax (last, fmax (most[0], most[1]));
}

/* The value of the node array A at U metres of rest length, by the cubic through the four nodes
   about it (fewer if there are fewer).  */
static bt_vec3
interpolate (const bt__dynamic *d, const bt_vec3 *a, double u)
{
  const double *rest = bt__dynamic_rest (d);
  int n = (int)d->n, j = 0;
  double start = 0;
  u = fmin (fmax (u, 0), bt__dynamic_length (d));
  while (j < n - 1 && u > start + rest[j])
    start += rest[j++];
  int first = j > 0 ? j - 1 : 0, count = n < 3 ? n + 1 : 4;
  if (first + count > n + 1)
    first = n + 1 - count;
  double s[4], at = first < j ? start - rest[j - 1] : start;
  for (int k = j - 1; k > first; k--)
    at -= rest[k - 1];
  for (int k = 0; k < count; at += first + k < n ? rest[first + k] : 0, k++)
    s[k] = at;
  bt_vec3 sum = { 0, 0, 0 };
  for (int k = 0; k < count; k++)
    {
      double weight = 1;
      for (int i = 0; i < count; i++)
        if (i != k)
          weight *= (u - s[i]) / (s[k] - s[i]);
      sum = bt__axpy (sum, weight, bt__sub (a[first + k], a[first]));
    }
  return bt__add (sum, a[first]);
}

bt_vec3
bt__dynamic_point (const bt__dynamic *d, double u)
{
  return interpolate (d, bt__dynamic_x (d), u);
}

bt_vec3
bt__dynamic_velocity (const bt__dynamic *d, double u)
{
  return interpolate (d, bt__dynamic_v (d), u);
}

double
bt__dynamic_node_tension (const bt__dynamic *d, int i)
{
  const double *t = bt__dynamic_tension (d), *rest = bt__dynamic_rest (d);
  if (i <= 0 || i >= d->n)
    return bt__norm (d->pull[i > 0]);
  return (t[i - 1] * rest[i] + t[i] * rest[i - 1]) / (rest[i - 1] + rest[i]);
}

static double
bending_energy (const bt__dynamic *d, double ei)
{
  const bt_vec3 *x = bt__dynamic_x (d);
  const double *rest = bt__dynamic_rest (d);
  double sum = 0;
  for (int i = 1; i < d->n && ei > 0; i++)
    {
      bt_vec3 a = bt__scale (1 / rest[i - 1], bt__sub (x[i], x[i - 1])),
              b = bt__scale (1 / rest[i], bt__sub (x[i + 1], x[i])), turn = bt__sub (b, a);
      sum += ei * bt__dot (turn, turn) / (rest[i - 1] + rest[i]);
    }
  return sum;
}

bt__dynamic_energy
bt__dynamic_energies (const bt__dynamic *d, const bt__dynamic_input *in)
{
  const bt_vec3 *x = bt__dynamic_x (d), *v = bt__dynamic_v (d);
  const double *rest = bt__dynamic_rest (d), *e = bt__dynamic_stretch (d);
  const bt_tether_props *p = in->line;
  double ma = in->water->density * p->ca * BT__PI * p->diameter * p->diameter / 4;
  bt__dynamic_energy sum = { 0, 0, 0, bending_energy (d, p->ei) };
  for (int i = 0; i <= d->n; i++)
    {
      double cell = 0.5 * ((i ? rest[i - 1] : 0) + (i < d->n ? rest[i] : 0));
      bt_vec3 tau = bt__sub (x[i < d->n ? i + 1 : i], x[i ? i - 1 : i]);
      double along = bt__dot (v[i], bt__unit_or (tau, bt__vec (0, 0, -1)));
      sum.kinetic += 0.5 * cell * ((p->mass + ma) * bt__dot (v[i], v[i]) - ma * along * along);
      sum.gravity += p->wet_weight * cell * x[i].z;
    }
  for (int j = 0; j < d->n; j++)
    if (e[j] > 1 && isfinite (p->ea))
      sum.strain += 0.5 * p->ea * rest[j] * (e[j] - 1) * (e[j] - 1);
  return sum;
}

/* The difference between the arc and the chord of interval J, along and across: minus a 24th of the
   second difference of the chords, extended to the ends.  */
static bt_vec3
arc_defect (const bt_vec3 *x, int n, int j)
{
  int k = j < 1 ? 1 : j > n - 2 ? n - 2 : j;
  bt_vec3 mid = bt__sub (x[k + 1], x[k]), wide = bt__sub (x[k + 2], x[k - 1]);
  bt_vec3 defect = bt__scale (-1.0 / 24, bt__axpy (wide, -3, mid));
  if (k == j || n < 4)
    return defect;
  bt_vec3 next = arc_defect (x, n, j < 1 ? 2 : n - 3);
  return bt__axpy (bt__scale (2, defect), -1, next);
}

double
bt__dynamic_space_error (const bt__dynamic *d)
{
  int n = (int)d->n;
  const bt_vec3 *x = bt__dynamic_x (d);
  bt_vec3 all = { 0, 0, 0 }, sum = { 0, 0, 0 };
  double most = 0;
  if (n < 3)
    return bt__dynamic_length (d) / 8;
  for (int j = 0; j < n; j++)
    all = bt__add (all, arc_defect (x, n, j));
  for (int j = 0; j < n; j++)
    {
      sum = bt__add (sum, arc_defect (x, n, j));
      most = fmax (most, bt__norm (bt__axpy (sum, -(j + 1.0) / n, all)));
    }
  return most;
}
