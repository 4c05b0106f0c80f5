/* The inextensible catenary between two points, by one scalar equation.

   With d = s^2 - h^2 - v^2 the whole problem is sinh (x) / x = r, r^2 - 1 = g = d / h^2, for x = h
   / (2 A).  The taut limit lives in d, so d is formed in double-double; then r - 1 is never formed
   by a difference and every size, slack and steepness keeps full precision.  A fit and a Newton
   step give x, in r - 1 or in log r, except for very slack lines with r above 3000.  Points come
   from arc lengths alone, without sinh or cosh: nothing can overflow (the thesis met errors of 1e84
   there, section 2.3.2).

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <bight/statics.h>

#include "tether/plane.h"

/* ---- The checks and the excess ---- */

bt_status
bt__plane_refuse (double h, double v, double s, bt_error *error)
{
  if (!isfinite (h) || !isfinite (v) || !isfinite (s))
    return bt__fail (error, BT_ERR_DOMAIN,
                     "a line needs finite numbers: across %g m, against the load %g m, length %g m",
                     h, v, s);
  if (!(h >= 0))
    return bt__fail (
        error, BT_ERR_DOMAIN,
        "the distance across the load is %g m; it must not be negative (turn the axis)", h);
  if (!(s > 0))
    return bt__fail (error, BT_ERR_DOMAIN, "the length of the line is %g m; it must be positive",
                     s);
  return bt__fail (error, BT_ERR_DOMAIN,
                   "sizes must lie between 1e-30 and 1e30 m: across %g, against the load %g, "
                   "length %g",
                   h, v, s);
}

/* The error of the product A A, exactly (Veltkamp, Dekker): as good as fma, which without its
   instruction is a call.  Sizes that are allowed do not overflow.  */
static inline double
square_error (double a, double square)
{
  double t = 134217729 * a, high = t - (t - a), low = a - high; /* 2^27 + 1 */
  return ((high * high - square) + 2 * (high * low)) + low * low;
}

/* A + B = SUM + ERROR exactly (Knuth).  */
static inline double
two_sum (double a, double b, double *error)
{
  double sum = a + b, part = sum - a;
  *error = (a - (sum - part)) + (b - part);
  return sum;
}

double
bt__plane_excess (double h, double v, double s)
{
  double ss = s * s, hh = h * h, vv = v * v, e1, e2;
  double low = (square_error (s, ss) - square_error (h, hh)) - square_error (v, vv);
  /* The larger square first: its difference from s^2 is then nearly exact.  */
  double more = hh > vv ? hh : vv, less = hh > vv ? vv : hh;
  double first = two_sum (ss, -more, &e1);
  double high = two_sum (first, -less, &e2);
  return high + ((e1 + e2) + low);
}

/* ---- sinh (x) / x = r ---- */

/* Return C[0] + C[1] z + ... + C[5] z^5, of which Z2 is z^2: what can be is done side by side.  */
static inline double
sextic (const double *c, double z, double z2)
{
  return (c[0] + c[1] * z) + z2 * ((c[2] + c[3] * z) + z2 * (c[4] + c[5] * z));
}

/* Return S (y) = sinh (sqrt y) / sqrt y - 1 = sum y^k / (2k + 1)!, twelve terms, for y up to 5, and
   in *SLOPE its derivative to 1e-8, enough for a last correction.  */
static inline double
series (double y, double *slope)
{
  static const double odd[6] = { 1.0 / 6.0,
                                 1.0 / 5040.0,
                                 1.0 / 39916800.0,
                                 1.0 / 1307674368000.0,
                                 1.0 / 121645100408832000.0,
                                 1.0 / 25852016738884976640000.0 };
  static const double even[6] = { 1.0 / 120.0,
                                  1.0 / 362880.0,
                                  1.0 / 6227020800.0,
                                  1.0 / 355687428096000.0,
                                  1.0 / 51090942171709440000.0,
                                  1.0 / 15511210043330985984000000.0 };
  static const double d[8]
      = { 1.0 / 6.0,        2.0 / 120.0,        3.0 / 5040.0,          4.0 / 362880.0,
          5.0 / 39916800.0, 6.0 / 6227020800.0, 7.0 / 1307674368000.0, 8.0 / 355687428096000.0 };
  double z = y * y, z2 = z * z;
  *slope = ((d[0] + d[1] * y) + z * (d[2] + d[3] * y))
           + z2 * ((d[4] + d[5] * y) + z * (d[6] + d[7] * y));
  return y * (sextic (odd, z, z2) + y * sextic (even, z, z2));
}

/* Return x where sinh (x) / x = 1 + RHO, RHO up to 1.32, in y = x^2.  The guess is a rational fit
   good to 1.2e-9; Newton squares that.  */
static inline double
root_of_series (double rho)
{
  double p
      = 0.999999998863 + rho * (0.86501755109 + rho * (0.159037712179 + rho * 0.00237665158013));
  double q = 1 + rho * (1.16501743073 + rho * (0.371402139046 + rho * 0.0282956411283));
  double y = 6 * rho * p / q, slope, sum = series (y, &slope);
  return sqrt (y - (sum - rho) / slope);
}

/* Return x where log (sinh (x) / x) = L = log (R), L from 0.8 to 8.  The guess is a rational fit
   good to 4e-8; Newton squares that.  */
static inline double
root_of_ratio (double r, double l)
{
  double p = 0.316774270515
             + l * (7.40604833451 + l * (14.7784521387 + l * (3.82605610478 + l * 0.121489495924)));
  double q
      = 1 + l * (6.75615574311 + l * (6.85586929761 + l * (1.05751400066 + l * 0.0198849562706)));
  double x = l + p / q, e = exp (x), back = 1 / e;
  double over = (e - back) / (2 * x * r) - 1;
  double slope = (e + back) / (e - back) - 1 / x;
  return x - over * (1 - 0.5 * over) / slope;
}

/* The same for L above 8: so slack that nobody waits for it.  Halley's step is cubic: one of 2e-6
 * leaves nothing.  */
static double
root_of_logarithm (double l)
{
  double x = l + log (2 * l + 2 * log (2 * l + 1.4));
  for (int i = 0; i < 8; i++)
    {
      double e = exp (-2 * x), b = 1 / (1 - e), c = 2 * e * b, r = 1 / x;
      double f = x - log (2 * x * b) - l, f1 = 1 - r + c, f2 = r * r - c * (2 + c);
      double step = f * f1 / (f1 * f1 - 0.5 * f * f2);
      x -= step;
      if (fabs (step) < 2e-6)
        break;
    }
  return x;
}

static inline double
root_of_sinh (double g, double r)
{
  if (g < 4.3)
    return root_of_series (g / (1 + r));
  double l = 0.5 * log (1 + g);
  return l < 8 ? root_of_ratio (r, l) : root_of_logarithm (l);
}

/* A line with excess D > 0, not folded.  With sinh x = r x known, coth x needs no exponential.  */
static bt_catenary
slack (double h, double v, double s, double d)
{
  double g = d / (h * h), r = sqrt (1 + g), x = root_of_sinh (g, r);
  double sinh_x = x * r, coth_x = sqrt (1 + sinh_x * sinh_x) / sinh_x;
  return (bt_catenary){ h, v, s, h / (2 * x), 0.5 * (v * coth_x - s) };
}

bt_status
bt_catenary_solve (double h, double v, double s, bt_catenary *c, bt_error *error)
{
  bt_status status = bt__plane_check (h, v, s, error);
  if (status)
    return status;
  double d = bt__plane_excess (h, v, s);
  if (d <= 0)
    *c = (bt_catenary){ h, v, s, INFINITY, 0 };
  else if (h < BT__PLANE_VERTICAL * s)
    *c = (bt_catenary){ h, v, s, 0, 0.5 * (v - s) };
  else
    *c = slack (h, v, s, d);
  return BT_OK;
}

/* ---- Asking ---- */

static double
within_line (double u, double s)
{
  return u > 0 ? (u < s ? u : s) : 0;
}

bt_point2
bt_catenary_point (const bt_catenary *c, double u)
{
  u = within_line (u, c->s);
  if (isinf (c->a))
    return (bt_point2){ c->h * (u / c->s), c->v * (u / c->s) };
  double a = c->a, p = c->sigma0, q = p + u;
  double tp = sqrt (a * a + p * p), tq = sqrt (a * a + q * q);
  if (!(tp + tq > 0))
    return (bt_point2){ 0, 0 };
  double y = u * (q + p) / (tq + tp);
  if (a == 0)
    return (bt_point2){ 0, y };
  /* x = A asinh (n), the difference of two asinh in the form that does not cancel.  */
  double n = (p < 0) == (q < 0) ? u * (q + p) / (q * tp + p * tq) : (q * tp - p * tq) / (a * a);
  return (bt_point2){ a * asinh (n), y };
}

bt_point2
bt_catenary_tangent (const bt_catenary *c, double u)
{
  double x = c->a, y = c->sigma0 + within_line (u, c->s);
  if (isinf (x))
    {
      x = c->h;
      y = c->v;
    }
  double t = sqrt (x * x + y * y);
  /* The bottom of a folded line looks across.  */
  return t > 0 ? (bt_point2){ x / t, y / t } : (bt_point2){ 1, 0 };
}
