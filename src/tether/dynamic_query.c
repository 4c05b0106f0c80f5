/* The moving line: questions.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include "tether/dynamic_kernel.h"
#include "tether/smooth.h"

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

/* The differences from B of two nodes in a row: x y, z x, y z.  */
typedef struct twin
{
  bt__pair p, q, r;
} twin;

static BT__HOT twin
twin_of (const bt_vec3 *a, const bt_vec3 *b)
{
  bt__pair p = { a[0].x, a[0].y }, q = { a[0].z, a[1].x }, r = { a[1].y, a[1].z };
  bt__pair s = { b[0].x, b[0].y }, t = { b[0].z, b[1].x }, u = { b[1].y, b[1].z };
  return (twin){ p - s, q - t, r - u };
}

/* The largest x, y and z of a twin.  */
static bt_vec3
largest_of (const twin *t)
{
  return bt__vec (fmax (t->p[0], t->q[1]), fmax (t->p[1], t->r[0]), fmax (t->q[0], t->r[1]));
}

static bt_vec3
higher_of (bt_vec3 a, bt_vec3 b)
{
  return bt__vec (fmax (a.x, b.x), fmax (a.y, b.y), fmax (a.z, b.z));
}

static bt_vec3
absolute (bt_vec3 a)
{
  return bt__vec (fabs (a.x), fabs (a.y), fabs (a.z));
}

void
bt__dynamic_drifted (const bt_vec3 *a, const bt_vec3 *b, int n, bt__dynamic_drift *drift)
{
  bt_vec3 d = bt__sub (a[0], b[0]), turn = { 0, 0, 0 };
  twin lo = { { d.x, d.y }, { d.z, d.x }, { d.y, d.z } }, hi = lo, most = { 0 };
  int i = 0;
  if (n >= 4)
    {
      twin now = twin_of (a, b);
      for (; i + 3 < n; i += 2)
        {
          twin next = twin_of (a + i + 2, b + i + 2);
          bt__pair s = { now.q[1], now.r[0] }, t = { now.r[1], next.p[0] },
                   u = { next.p[1], next.q[0] };
          most.p = bt__pair_max (most.p, bt__pair_abs (s - now.p));
          most.q = bt__pair_max (most.q, bt__pair_abs (t - now.q));
          most.r = bt__pair_max (most.r, bt__pair_abs (u - now.r));
          lo = (twin){ bt__pair_min (lo.p, now.p), bt__pair_min (lo.q, now.q),
                       bt__pair_min (lo.r, now.r) };
          hi = (twin){ bt__pair_max (hi.p, now.p), bt__pair_max (hi.q, now.q),
                       bt__pair_max (hi.r, now.r) };
          now = next;
        }
    }
  lo = (twin){ -lo.p, -lo.q, -lo.r };
  bt_vec3 top = largest_of (&hi), bottom = largest_of (&lo);
  turn = largest_of (&most);
  for (bt_vec3 before = bt__sub (a[i], b[i]); i < n; i++)
    {
      d = bt__sub (a[i], b[i]);
      turn = higher_of (turn, absolute (bt__sub (d, before)));
      top = higher_of (top, d);
      bottom = higher_of (bottom, bt__scale (-1, d));
      before = d;
    }
  drift->way = bt__norm (higher_of (absolute (top), absolute (bottom)));
  drift->turned = bt__norm (turn);
  drift->apart = bt__norm (bt__add (top, bottom));
}

double
bt__dynamic_along (const bt__dynamic *d, double s)
{
  return d->owed == 0 ? s : s * (1 - d->owed / bt__dynamic_length (d));
}

int
bt__dynamic_interval (const bt__dynamic *d, double u, double *start)
{
  const double *rest = bt__dynamic_rest (d);
  int n = (int)d->n, j = 0;
  *start = 0;
  while (j < n - 1 && u > *start + rest[j])
    *start += rest[j++];
  return j;
}

bt_vec3
bt__dynamic_chord_point (const bt__dynamic *d, double u)
{
  const bt_vec3 *x = bt__dynamic_x (d);
  double start;
  int j = bt__dynamic_interval (d, u, &start);
  double at = fmin (fmax (u - start, 0) / bt__dynamic_rest (d)[j], 1);
  return bt__axpy (x[j], at, bt__sub (x[j + 1], x[j]));
}

/* The value of the node array A at U metres of rest length, by the cubic through the four nodes
   about it (fewer if there are fewer).  */
static bt_vec3
interpolate (const bt__dynamic *d, const bt_vec3 *a, double u)
{
  const double *rest = bt__dynamic_rest (d);
  double start;
  u = fmin (fmax (u, 0), bt__dynamic_length (d));
  int n = (int)d->n, j = bt__dynamic_interval (d, u, &start);
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

/* The cubic through the four nodes about interval J of D is, at the share F of the interval, off
   the chord by F (1 - F) (A (1 - F) - B F), with A and B the slopes of the cubic by F at the nodes,
   less the chord: Newton's form (Hairer, Norsett, Wanner, Solving Ordinary Differential Equations
   I, III.1) with the nodes of the interval first.  Two intervals have a parabola, one has its
   chord.  */
static void
end_slopes (const bt__dynamic *d, int j, bt_vec3 *a, bt_vec3 *b)
{
  int n = (int)d->n, first = j > 0 ? j - 1 : 0, count = n < 3 ? n : 3;
  first = first + count > n ? n - count : first;
  const bt_vec3 *x = bt__dynamic_x (d) + first;
  const double *h = bt__dynamic_rest (d) + first;
  double span = h[j - first];
  bt_vec3 zero = { 0, 0, 0 }, slope[3], bend[2] = { zero, zero }, third = zero;
  for (int k = 0; k < count; k++)
    slope[k] = bt__scale (1 / h[k], bt__sub (x[k + 1], x[k]));
  for (int k = 0; k + 1 < count; k++)
    bend[k] = bt__scale (1 / (h[k] + h[k + 1]), bt__sub (slope[k + 1], slope[k]));
  if (count == 3)
    third = bt__scale (1 / (h[0] + h[1] + h[2]), bt__sub (bend[1], bend[0]));
  /* The third node of Newton's form is that before the interval or, at the beginning, after.  */
  int k = j - first;
  double off = k > 0 ? h[k - 1] : n > 1 ? -h[0] - h[1] : 0;
  bt_vec3 second = bend[k > 0 ? k - 1 : 0];
  *a = bt__scale (-span * span, bt__axpy (second, off, third));
  *b = bt__scale (span * span, bt__axpy (second, off + span, third));
}

bt_vec3
bt__dynamic_point (const bt__dynamic *d, double s)
{
  const bt_vec3 *x = bt__dynamic_x (d);
  double start, u = bt__dynamic_along (d, s);
  int j = bt__dynamic_interval (d, u, &start);
  double rest = bt__dynamic_rest (d)[j], f = fmin (fmax (u - start, 0) / rest, 1);
  bt_vec3 chord = bt__sub (x[j + 1], x[j]), p = bt__axpy (x[j], f, chord), a, b;
  if (f == 0 || f == 1)
    return p;
  end_slopes (d, j, &a, &b);
  double share = bt__smooth_share (chord, a, b, rest);
  return bt__axpy (p, share * f * (1 - f), bt__axpy (bt__scale (1 - f, a), -f, b));
}

bt_vec3
bt__dynamic_velocity (const bt__dynamic *d, double s)
{
  return interpolate (d, bt__dynamic_v (d), bt__dynamic_along (d, s));
}

double
bt__dynamic_node_tension (const bt__dynamic *d, int i)
{
  const double *t = bt__dynamic_tension (d), *rest = bt__dynamic_rest (d);
  if (i <= 0 || i >= d->n)
    return bt__norm (d->pull[i > 0]);
  return (t[i - 1] * rest[i] + t[i] * rest[i - 1]) / (rest[i - 1] + rest[i]);
}

/* A walk along a chain: the third derivative by arc length of the polynomials through four nodes
   in a row, of second order, by Newton's divided differences.  */
typedef struct walk
{
  int n;
  const bt_vec3 *x;
  const double *rest;
  int k;            /* the last two polynomials are those that begin at nodes K - 2 and K - 1 */
  bt_vec3 slope;    /* of interval K + 1 */
  bt_vec3 bend;     /* half the second derivative at node K + 1 */
  bt_vec3 third[2]; /* the third derivative of the polynomial from node j - 1 on at j % 2 */
} walk;

static inline bt_vec3
slope_of (const walk *w, int j)
{
  return bt__scale (1 / w->rest[j], bt__sub (w->x[j + 1], w->x[j]));
}

/* A walk along D, of two intervals or more.  */
static walk
walk_along (const bt__dynamic *d)
{
  walk w = { .n = (int)d->n, .x = bt__dynamic_x (d), .rest = bt__dynamic_rest (d) };
  w.slope = slope_of (&w, 1);
  w.bend = bt__scale (1 / (w.rest[0] + w.rest[1]), bt__sub (w.slope, slope_of (&w, 0)));
  return w;
}

/* The third derivative of the polynomial through nodes K - 1 to K + 2; K is no less than the
   largest one before less one.  */
static inline bt_vec3
third_derivative (walk *w, int k)
{
  while (w->k < k)
    {
      const double *h = w->rest + w->k;
      bt_vec3 slope = slope_of (w, ++w->k + 1);
      bt_vec3 bend = bt__scale (1 / (h[1] + h[2]), bt__sub (slope, w->slope));
      w->third[w->k % 2] = bt__scale (6 / (h[0] + h[1] + h[2]), bt__sub (bend, w->bend));
      w->slope = slope;
      w->bend = bend;
    }
  return w->third[k % 2];
}

/* The difference between the arc and the chord of interval J, along and across: minus a 24th of the
   third derivative and the cubed length; the derivative is extended to the ends.
   Nothing is known of it at a CORNER.  */
static inline bt_vec3
arc_defect (walk *w, int j, const uint8_t *corner)
{
  int n = w->n, k = j < 1 ? 1 : j > n - 2 ? n - 2 : j;
  double h = w->rest[j];
  if (corner && (corner[k] || corner[k + 1]))
    return bt__vec (0, 0, 0);
  bt_vec3 third = third_derivative (w, k);
  if (k != j && n >= 4)
    third = bt__axpy (bt__scale (2, third), -1, third_derivative (w, j < 1 ? 2 : n - 3));
  return bt__scale (-h * h * h / 24, third);
}

/* The most that a smooth line through the nodes is off their chords: an eighth of the
   second difference at a node.  */
static double
chord_error (const bt__dynamic *d)
{
  const bt_vec3 *x = bt__dynamic_x (d);
  double most = 0;
  for (int i = 1; i < d->n; i++)
    most = fmax (most, bt__norm (bt__sub (bt__sub (x[i + 1], x[i]), bt__sub (x[i], x[i - 1]))) / 8);
  return most;
}

/* Three intervals have one third derivative: how it changes is not known, and one that does not is
   none between held ends, be the line folded.  */
double
bt__dynamic_space_error (const bt__dynamic *d, const uint8_t *corner)
{
  int n = (int)d->n;
  bt_vec3 all = { 0, 0, 0 }, sum = { 0, 0, 0 };
  double most = 0, length = 0, s = 0;
  if (n < 3)
    return bt__dynamic_length (d) / 8;
  if (n == 3)
    return chord_error (d);
  walk w = walk_along (d);
  for (int j = 0; j < n; j++)
    {
      all = bt__add (all, arc_defect (&w, j, corner));
      length += w.rest[j];
    }
  w = walk_along (d);
  for (int j = 0; j < n; j++)
    {
      sum = bt__add (sum, arc_defect (&w, j, corner));
      s += w.rest[j];
      bt_vec3 off = bt__axpy (sum, -s / length, all);
      most = fmax (most, bt__dot (off, off));
    }
  return sqrt (most);
}
