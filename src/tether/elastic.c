/* The elastic catenary (Irvine 1981): weight per unstretched metre, Hooke's law, two unknowns.

   The unknowns are the tension across the load H and the force of the support at the start V. With
   A = H / w and sigma0 = -V / w the stretched curve is the inextensible catenary of equal A and
   sigma0 plus the stretch, and the stable point formulas of catenary.c serve here too.  Newton's
   iteration is damped; the first guess is the inextensible catenary of a length stretched by a
   tension T with e T^3 + (1 - c) T^2 = h^2 / (24 c^2), the parabola's sag with Hooke's stretch (T
   in weights, e = weight / EA, c = chord / length, h = H / length).

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <stddef.h>

#include <bight/statics.h>

#include "tether/plane.h"

enum
{
  NEWTON_MAX = 80,
  HALVINGS = 12
};

/* ---- The curve for given H and V ---- */

static bt_catenary
unstretched (const bt_elastic *e)
{
  return (bt_catenary){ e->h, e->v, e->s, e->H / e->w, -e->V / e->w };
}

bt_point2
bt_elastic_point (const bt_elastic *e, double u)
{
  bt_catenary c = unstretched (e);
  bt_point2 p = bt_catenary_point (&c, u);
  u = fmin (fmax (u, 0), e->s);
  p.x += e->H * u / e->ea;
  p.y += (0.5 * e->w * u - e->V) * u / e->ea;
  return p;
}

bt_point2
bt_elastic_tangent (const bt_elastic *e, double u)
{
  bt_catenary c = unstretched (e);
  return bt_catenary_tangent (&c, u);
}

double
bt_elastic_tension (const bt_elastic *e, double u)
{
  u = fmin (fmax (u, 0), e->s);
  return hypot (e->H, e->V - e->w * u);
}

/* ---- Closed cases ---- */

/* H = 0: the line hangs along the load.  Folded, both legs share it; else one end carries all and
   the far end is below the start (V > weight) or above (V < 0).  */
static double
vertical_support (const bt_elastic *e)
{
  double s = e->s, w = e->w, flex = s / e->ea, weight = w * s;
  double folded = (s - e->v + 0.5 * weight * flex) / (flex + 2 / w);
  if (folded >= 0 && folded <= weight)
    return folded;
  return 0.5 * weight - (e->v + (folded < 0 ? -s : s)) / flex;
}

static bt_status
solve_inextensible (bt_elastic *e, bt_error *error)
{
  bt_catenary c;
  bt_status status = bt_catenary_solve (e->h, e->v, e->s, &c, error);
  if (status)
    return status;
  if (isinf (c.a))
    return bt__fail (
        error, BT_ERR_DOMAIN,
        "a line of %.17g m that cannot stretch does not hang between ends %.17g m apart", e->s,
        hypot (e->h, e->v));
  e->H = e->w * c.a;
  e->V = -e->w * c.sigma0;
  return BT_OK;
}

/* ---- Newton ---- */

/* Return the root T > 0 of E T^3 + B T^2 = R > 0, from above, where the function is convex.  */
static double
mean_tension (double e, double b, double r)
{
  double t = cbrt (r / e);
  if (b < 0)
    t += -b / e;
  else if (b > 0)
    t = fmin (t, sqrt (r / b));
  for (int i = 0; i < 20; i++)
    {
      double step = (t * t * (e * t + b) - r) / (t * (3 * e * t + 2 * b));
      t -= step;
      if (!(fabs (step) > 1e-4 * t))
        break;
    }
  return t;
}

/* Guess H and V, see above.  Where the sag is below the last digits the parabola itself serves.  */
static void
guess (bt_elastic *e)
{
  double s = e->s, weight = e->w * s, chord = hypot (e->h, e->v), c = chord / s, across = e->h / s;
  double t = mean_tension (weight / e->ea, 1 - c, across * across / (24 * c * c));
  t = fmax (t, 0.5 * fabs (e->v) / chord); /* a steep line bears its own weight */
  double stretched = s * (1 + weight * t / e->ea);
  bt_catenary k = { 0 };
  if (t < 1e4 && stretched <= BT__PLANE_HUGE
      && bt_catenary_solve (e->h, e->v, stretched, &k, NULL) == BT_OK && isfinite (k.a) && k.a > 0)
    {
      e->H = k.a * weight / stretched;
      e->V = -k.sigma0 * weight / stretched;
      return;
    }
  e->H = weight * t * e->h / chord;
  e->V = weight * (0.5 - t * e->v / chord);
}

/* The far end's miss and its derivatives by (H, V): the matrix is {xx, xy; -xy, -yy}.  */
typedef struct linear
{
  double fx, fy, xx, xy, yy;
} linear;

static double
miss_of_end (const bt_elastic *e, linear *f)
{
  bt_point2 p = bt_elastic_point (e, e->s);
  f->fx = p.x - e->h;
  f->fy = p.y - e->v;
  return sqrt (f->fx * f->fx + f->fy * f->fy);
}

/* Return asinh (n) - n k, where 1 - k = LESS.  For small n the two nearly cancel.  */
static double
asinh_minus (double n, double k, double less)
{
  static const double c[]
      = { -1.0 / 6, 3.0 / 40, -15.0 / 336, 105.0 / 3456, -945.0 / 42240, 10395.0 / 599040 };
  double y = n * n, sum = 0;
  if (y > 0.01)
    return asinh (n) - n * k;
  for (int i = 5; i >= 0; i--)
    sum = sum * y + c[i];
  return n * (sum * y + less);
}

/* Differences that vanish for a taut line are written out, else the residual of a steep, nearly
   straight line would be lost in rounding: with k = a^2 / t, t = tp tq, 1 - k = (a^2 (p^2 + q^2) +
   p^2 q^2) / (t (t + a^2)).  */
static void
differentiate (const bt_elastic *e, linear *f)
{
  double a = e->H / e->w, s = e->s, p = -e->V / e->w, q = p + s, flex = s / e->ea;
  double aa = a * a, pp = p * p, qq = q * q, tp = sqrt (aa + pp), tq = sqrt (aa + qq), t = tp * tq;
  double n = (p < 0) == (q < 0) ? s * (q + p) / (q * tp + p * tq) : (q * tp - p * tq) / aa;
  double k = aa / t, less = (aa * (pp + qq) + pp * qq) / ((t + aa) * t);
  f->xx = flex + asinh_minus (n, k, less) / e->w;
  f->xy = a * s * (q + p) / ((tp + tq) * t) / e->w;
  f->yy = flex + n * k / e->w;
}

/* The Newton correction for the miss of AT by the derivatives of F.  */
static void
correction (const linear *f, const linear *at, double *dH, double *dV)
{
  double det = f->xy * f->xy - f->xx * f->yy;
  *dH = (at->fx * f->yy + f->xy * at->fy) / det;
  *dV = -(f->xx * at->fy + f->xy * at->fx) / det;
}

/* True if the correction after the step has shrunk from SIZE, by the derivatives of F.  */
static int
is_on_the_way (const linear *f, const linear *next, double size)
{
  double dH, dV;
  correction (f, next, &dH, &dV);
  return dH * dH + dV * dV < size;
}

/* Take the Newton step of F, halved until the correction that would follow shrinks (Deuflhard's
   monotonicity test: the miss itself is no measure, for a steep line answers a million times more
   across than along) or until rounding is reached.  H is kept positive.  Update *MISSED and the
   miss in F; return the step relative to the forces, 0 when there is no way down.  */
static double
take_newton_step (bt_elastic *e, linear *f, double *missed)
{
  double dH, dV, H = e->H, V = e->V;
  correction (f, f, &dH, &dV);
  double size = dH * dH + dV * dV, k = dH < -0.9 * H ? -0.9 * H / dH : 1;
  for (int i = 0; i < HALVINGS; i++, k *= 0.5)
    {
      linear next;
      e->H = H + k * dH;
      e->V = V + k * dV;
      double now = miss_of_end (e, &next);
      if (now < *missed || is_on_the_way (f, &next, size))
        {
          *missed = now;
          f->fx = next.fx;
          f->fy = next.fy;
          return k * (fabs (dH) / H + fabs (dV) / (fabs (V) + e->w * e->s));
        }
    }
  e->H = H;
  e->V = V;
  return 0;
}

static bt_status
newton (bt_elastic *e, bt_error *error)
{
  linear f;
  double scale = e->s + hypot (e->h, e->v), best = miss_of_end (e, &f), size = 1;
  /* A small step ends it only with a small miss: near taut the forces hide what the end sees.  */
  for (int i = 0; i < NEWTON_MAX && size > 0 && !(best <= 2e-16 * scale); i++)
    {
      differentiate (e, &f);
      size = take_newton_step (e, &f, &best);
      if (size < 1e-9 && best < 1e-15 * scale)
        break;
    }
  if (best <= 1e-12 * scale && isfinite (e->H) && isfinite (e->V))
    return BT_OK;
  return bt__fail (error, BT_ERR_DIVERGED,
                   "the elastic catenary did not settle: its end misses by %g m (across %g m, "
                   "against the load %g m, length %g m, %g N/m, EA %g N)",
                   best, e->h, e->v, e->s, e->w, e->ea);
}

bt_status
bt_elastic_solve (double h, double v, double s, double w, double ea, bt_elastic *e, bt_error *error)
{
  bt_status status = bt__plane_check (h, v, s, error);
  if (status)
    return status;
  if (!(w > 0 && isfinite (w)))
    return bt__fail (error, BT_ERR_DOMAIN,
                     "the load on an elastic line is %g N/m; it must be positive and finite", w);
  if (!(ea > 0))
    return bt__fail (error, BT_ERR_DOMAIN,
                     "the axial stiffness is %g N; it must be positive (infinite: no stretch)", ea);
  bt_elastic out = { h, v, s, w, ea, 0, 0 };
  if (isinf (ea))
    status = solve_inextensible (&out, error);
  else if (h < BT__PLANE_VERTICAL * s)
    out.V = vertical_support (&out);
  else
    {
      guess (&out);
      status = newton (&out, error);
    }
  if (status == BT_OK)
    *e = out;
  return status;
}
