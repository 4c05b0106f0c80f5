/* The moving line in motion: against closed solutions, and the order of its errors.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include "law/dynamic_scene.h"

#include <bight/statics.h>

/* ---- Time between passages through zero ---- */

typedef struct passages
{
  double last, first, at; /* the value before; times of the first and the last passage */
  int count;
} passages;

static void
watch (passages *p, double value, double time, double h)
{
  if (time > 1.5 * h && p->last * value < 0)
    {
      p->at = time - h * value / (value - p->last);
      p->first = p->count++ ? p->first : p->at;
    }
  p->last = value;
}

static double
period (const passages *p)
{
  return 2 * (p->at - p->first) / (p->count - 1);
}

/* ---- Pendulum ---- */

/* pendulum_large_swing.csv: T / T0 = (2 / pi) K (sin^2 (amplitude / 2)), T0 = 2 pi sqrt (L / g). */
static const struct
{
  double degrees, ratio;
} swings[] = {
  { 1, 1.000019038921 }, { 30, 1.017408797596 }, { 60, 1.073182007149 }, { 90, 1.180340599016 }
};

static double
swing (double degrees, double h)
{
  scene s;
  double a = degrees * BT__PI / 180;
  bt_vec3 shape[2] = { { 0, 0, 0 }, { sin (a), 0, -cos (a) } };
  bt_tether_props line = { .diameter = 0.01, .mass = 1e-9, .ea = 1e7 };
  passages p = { 0 };
  scene_open (&s, line, 0, 1, shape, 2, 1);
  s.in.end[1].free = 1;
  s.in.end[1].body = (bt__dynamic_lump){ .mass = 1, .wet_weight = 9.81 };
  while (p.count < 3)
    {
      scene_step (&s, h);
      watch (&p, bt__dynamic_x (s.d)[1].x, s.water.time, h);
    }
  scene_close (&s);
  return period (&p);
}

static void
test_pendulum (void **state)
{
  (void)state;
  for (int k = 0; k < 4; k++)
    {
      double wanted = swings[k].ratio * 2 * BT__PI / sqrt (9.81), error[2];
      for (int q = 0; q < 2; q++)
        error[q] = fabs (swing (swings[k].degrees, q ? 0.002 : 0.004) / wanted - 1);
      if (!(error[1] < 1e-4) || !(error[1] < 0.55 * error[0]))
        fail_msg ("%g degrees: the period is off by %g and %g", swings[k].degrees, error[0],
                  error[1]);
    }
}

/* ---- The falling folded chain ---- */

/* falling_folded_chain.csv (Calkin & March 1989): t sqrt (g / L) when the tip has fallen y L.  */
static const struct
{
  double y, t;
} falls[] = { { 0.1, 0.4433402094669 },
              { 0.3, 0.7526914740438 },
              { 0.5, 0.9480253194308 },
              { 0.7, 1.086387007653 },
              { 0.9, 1.177012991336 } };

static void
test_folded_chain (void **state)
{
  (void)state;
  scene s;
  const int n = 201;
  static bt_vec3 shape[202];
  double l = 1.0 / n, h = 1e-4, last = 0;
  for (int i = 0; i <= n; i++) /* two legs and one interval across */
    shape[i] = i <= n / 2 ? bt__vec (0, 0, -l * i) : bt__vec (l, 0, -l * (n - i));
  bt_tether_props line = { .diameter = 0.01, .mass = 1, .wet_weight = 9.81, .ea = 1e6 };
  scene_open (&s, line, 0, n, shape, n + 1, 1);
  s.in.end[1].free = 1;
  for (int k = 0; k < 5;)
    {
      scene_step (&s, h);
      double y = -bt__dynamic_x (s.d)[n].z;
      if (y >= falls[k].y)
        {
          double t = (s.water.time - h * (y - falls[k].y) / (y - last)) * sqrt (9.81);
          printf ("# folded chain %.1f: t %.5f of %.5f\n", falls[k].y, t, falls[k].t);
          assert_close (t / falls[k].t, 1, 0.01, "time of the fall");
          k++;
        }
      last = y;
    }
  scene_close (&s);
}

/* ---- Frequencies ---- */

/* Displace the inner nodes of S along WAY by the mode SHAPE, let go, and return the frequency of
   the projection on it over CYCLES, Hz, in steps of a PARTS'th of a cycle of about ABOUT Hz.  */
static double
frequency (scene *s, bt_vec3 way, const double *mode, double amplitude, double about, int parts)
{
  static double before[RIG_MAX + 1];
  passages p = { 0 };
  bt_vec3 *x = bt__dynamic_x (s->d);
  double *e = bt__dynamic_stretch (s->d), h = 1 / (about * parts);
  int n = (int)s->d->n;
  for (int i = 0; i <= n; i++)
    {
      before[i] = bt__dot (x[i], way);
      x[i] = bt__axpy (x[i], amplitude * mode[i], way);
    }
  for (int j = 0; j < n; j++)
    e[j] = bt__distance (x[j], x[j + 1]) / bt__dynamic_rest (s->d)[j];
  s->water.time = 0;
  while (p.count < 5)
    {
      double sum = 0;
      scene_step (s, h);
      for (int i = 0; i <= n; i++)
        sum += mode[i] * (bt__dot (bt__dynamic_x (s->d)[i], way) - before[i]);
      watch (&p, sum, s->water.time, h);
      assert_true (s->steps < 100000);
    }
  return 1 / period (&p);
}

/* The Bessel function J0, by its series; X below 10.  */
static double
bessel (double x)
{
  double sum = 1, term = 1;
  for (int k = 1; k < 60; k++)
    {
      term *= -x * x / (4.0 * k * k);
      sum += term;
    }
  return sum;
}

/* freq_hanging_chain.csv: omega = (j_{0,n} / 2) sqrt (g / L); mode J0 (j_{0,n} sqrt (s / L)), s
   from the free end.  */
static void
test_hanging_chain (void **state)
{
  (void)state;
  static const double zeros[] = { 2.404825557696, 5.520078110286, 8.653727912911 };
  for (int k = 0; k < 3; k++)
    {
      scene s;
      const int n = 100;
      double mode[101], wanted = zeros[k] / 2 * sqrt (9.81) / (2 * BT__PI);
      bt_vec3 shape[2] = { { 0, 0, 0 }, { 0, 0, -1 } };
      bt_tether_props line = { .diameter = 0.01, .mass = 1, .wet_weight = 9.81, .ea = 1e6 };
      scene_open (&s, line, 0, n, shape, 2, 1);
      s.in.end[1].free = 1;
      scene_settle (&s);
      for (int i = 0; i <= n; i++)
        mode[i] = i ? bessel (zeros[k] * sqrt (1 - (double)i / n)) : 0;
      double f = frequency (&s, bt__vec (1, 0, 0), mode, 1e-4, wanted, 600);
      assert_close (f / wanted, 1, k ? 3e-3 : 1e-3, "hanging chain");
      scene_close (&s);
    }
}

/* freq_taut_string_beam.csv: pinned, f = n / (2 L) sqrt ((T + EI (n pi / L)^2) / m).  */
static const struct
{
  double l, t, m, ei;
} strings[]
    = { { 10, 100, 0.05, 0 }, { 10, 100, 0.05, 1 }, { 10, 5, 0.05, 0.5 }, { 100, 50, 0.1, 0 } };

static double
string_frequency (int k, int mode_number, int n, double wanted)
{
  scene s;
  static double mode[201];
  double ea = 1e6, l = strings[k].l;
  bt_vec3 shape[2] = { { 0, 0, 0 }, { l, 0, 0 } };
  bt_tether_props line = { .diameter = 0.01, .mass = strings[k].m, .ea = ea, .ei = strings[k].ei };
  scene_open (&s, line, 0, n, shape, 2, l / (1 + strings[k].t / ea));
  for (int i = 0; i <= n; i++)
    mode[i] = sin (mode_number * BT__PI * i / n);
  double f = frequency (&s, bt__vec (0, 0.6, 0.8), mode, 1e-5 * l, wanted, 800);
  scene_close (&s);
  return f;
}

static void
test_strings_and_beams (void **state)
{
  (void)state;
  for (int k = 0; k < 4; k++)
    for (int q = 1; q <= 5; q += 2)
      {
        double w = q * BT__PI / strings[k].l;
        double wanted
            = w * sqrt ((strings[k].t + strings[k].ei * w * w) / strings[k].m) / (2 * BT__PI);
        double f = string_frequency (k, q, 100, wanted);
        if (!(fabs (f / wanted - 1) < 1.5e-3))
          fail_msg ("string %d, mode %d: %g Hz is not %g", k, q, f, wanted);
      }
}

/* freq_irvine_sagged.csv (Irvine & Caughey): tan (W/2) = W/2 - (4 / lambda^2) (W/2)^3,
   W = omega l / sqrt (H / m); mode 1 - tan (W/2) sin (W x) - cos (W x).  */
static const struct
{
  double lambda2, w; /* first root, in pi */
} sags[] = {
  { 1, 1.040200486809 }, { 39.47841760436, 2 }, { 100, 2.597184544635 }, { 1000, 2.848263638446 }
};

static void
test_sagged_cable (void **state)
{
  (void)state;
  for (int k = 0; k < 4; k++)
    {
      scene s;
      bt_elastic e;
      const int n = 160;
      static double mode[161];
      const double l = 100, load = 0.0981, ratio = 0.03, H = load * l / ratio;
      double le = 1 + ratio * ratio / 8, ea = sags[k].lambda2 * H * le / (ratio * ratio);
      double low = 0.9 * l, high = 1.02 * l;
      for (int i = 0; i < 60; i++) /* the length that hangs with H */
        {
          double mid = 0.5 * (low + high);
          int tight = bt_elastic_solve (l, 0, mid, load, ea, &e, NULL) == BT_OK && e.H > H;
          *(tight ? &low : &high) = mid;
        }
      bt_vec3 shape[3] = { { 0, 0, 0 }, { l / 2, 0, -1 }, { l, 0, 0 } };
      bt_tether_props line
          = { .diameter = 0.01, .mass = 0.01, .wet_weight = load, .ea = ea, .ba = 1e-3 * ea };
      scene_open (&s, line, 0, n, shape, 3, high);
      scene_settle (&s);
      double w = sags[k].w * BT__PI, wanted = w / l * sqrt (H / 0.01) / (2 * BT__PI);
      for (int i = 0; i <= n; i++)
        {
          double x = bt__dynamic_x (s.d)[i].x / l;
          mode[i] = fabs (sags[k].w - 2) < 1e-9 ? 1 - cos (w * x)
                                                : 1 - tan (w / 2) * sin (w * x) - cos (w * x);
        }
      double f = frequency (&s, bt__vec (0, 0, 1), mode, 1e-3, wanted, 600);
      printf ("# sagged cable, lambda^2 %.0f: W/pi %.4f of %.4f\n", sags[k].lambda2,
              f / wanted * sags[k].w, sags[k].w);
      assert_close (f / wanted, 1, 4e-3, "sagged cable");
      scene_close (&s);
    }
}

/* ---- Sinking ---- */

/* sink_terminal.csv: me v' = w - rho/2 Cd d v^2, v = vt tanh (t / tau), fall = vt tau ln cosh (t /
   tau), vt = sqrt (2 w / (rho Cd d)), tau = me vt / w.  */
static double
sinking_error (double h)
{
  static const double at[] = { 0.05, 0.2, 1 };
  scene s;
  double d = 0.0035, m = 0.0517, w = 0.4, worst = 0;
  double me = m + 1000 * BT__PI * d * d / 4, vt = sqrt (2 * w / (1000 * 1.3 * d)),
         tau = me * vt / w;
  bt_vec3 shape[2] = { { 0, 0, -5 }, { 10, 0, -5 } };
  bt_tether_props line
      = { .diameter = d, .mass = m, .wet_weight = w, .ea = 1e5, .cdn = 1.3, .cdt = 0.01, .ca = 1 };
  scene_open (&s, line, 1000, 10, shape, 2, 10);
  s.in.end[0].free = s.in.end[1].free = 1;
  for (int k = 0; k < 3; k++)
    {
      while (s.water.time < at[k] - h / 2)
        scene_step (&s, h);
      for (int i = 0; i <= 10; i++)
        {
          double t = s.water.time;
          double v = -bt__dynamic_v (s.d)[i].z - vt * tanh (t / tau);
          double fall = -5 - bt__dynamic_x (s.d)[i].z - vt * tau * log (cosh (t / tau));
          worst = fmax (worst, fmax (fabs (v), fabs (fall)));
        }
    }
  scene_close (&s);
  return worst;
}

static void
test_sinking (void **state)
{
  (void)state;
  double coarse = sinking_error (1e-3), fine = sinking_error (5e-4);
  assert_true (fine < 1e-4);
  assert_close (log2 (coarse / fine), 2, 0.2, "order of sinking");
}

/* ---- Snap ---- */

/* snap_load.csv: an end pulled at V, front dT = V sqrt (EA mu), doubled at the fixed end at L / c;
   EA 5e4, mu .08, V 1, L 100: 63.24555320337 and 126.4911064067 N, c 790.5694150421.  */
static void
test_snap_wave (void **state)
{
  (void)state;
  scene s;
  const int n = 400;
  double h = 2.5e-4, moving = 0, fixed = 0, crossing = 100 / 790.5694150421;
  int count = 0, behind = 0;
  bt_vec3 shape[2] = { { 0, 0, 0 }, { 100, 0, 0 } };
  bt_tether_props line = { .diameter = 0.01, .mass = 0.08, .ea = 5e4, .ba = 5 };
  scene_open (&s, line, 0, n, shape, 2, 100);
  while (s.water.time < 1.8 * crossing)
    {
      s.in.end[1].at.x += h;
      scene_step (&s, h);
      if (s.water.time > 0.3 * crossing && s.water.time < 0.9 * crossing)
        {
          moving += bt__norm (s.d->pull[1]);
          count++;
        }
      if (s.water.time > 1.2 * crossing)
        {
          fixed += bt__norm (s.d->pull[0]);
          behind++;
        }
      if (s.water.time < 0.8 * crossing)
        assert_true (bt__norm (s.d->pull[0]) < 0.3);
    }
  assert_close (moving / count, 63.24555320337, 0.3, "front");
  assert_close (fixed / behind, 126.4911064067, 0.6, "reflected front");
  scene_close (&s);
}

/* The same with slack: the front takes up SLACK of the line and stretches it, (SLACK + T/EA) c = v
   with T = mu v c, so T (SLACK + T/EA) = mu v^2; the fixed end doubles it at L / c.  */
static void
test_slack_wave (void **state)
{
  (void)state;
  const double slacks[] = { 1e-5, 1e-3, 1e-2 }, l = 100, ea = 5e4, mu = 0.08, v = 1;
  for (int k = 0; k < 3; k++)
    {
      scene s;
      double slack = slacks[k], h = 2.5e-4, moving = 0;
      double front = 0.5 * ea * (sqrt (slack * slack + 4 * mu * v * v / ea) - slack);
      double crossing = l * mu * v / front;
      int count = 0;
      bt_vec3 shape[2] = { { 0, 0, 0 }, { l, 0, 0 } };
      bt_tether_props line = { .diameter = 0.01, .mass = mu, .ea = ea, .ba = 5 };
      scene_open (&s, line, 0, 400, shape, 2, l * (1 + slack));
      while (s.water.time < 0.9 * crossing)
        {
          s.in.end[1].at.x += v * h;
          scene_step (&s, h);
          assert_true (s.water.time > 0.8 * crossing || bt__norm (s.d->pull[0]) < 0.3);
          if (s.water.time > 0.3 * crossing)
            {
              moving += bt__norm (s.d->pull[1]);
              count++;
            }
        }
      printf ("# slack of %g driven taut at 1 m/s: %.3f of %.3f N, v sqrt (EA m) %.3f\n", slack,
              moving / count, front, v * sqrt (ea * mu));
      assert_close (moving / count / front, 1, 0.02, "front in a slack line");
      scene_close (&s);
    }
}

/* A line that hangs slack in the water, run out at 1 m/s until it is taut, and on at 1 m/s to a
   strain of half a hundredth; *HELD receives the tension a second after.  Return the peak tension
   at the end that runs.  */
static double
run_taut (int n, double h, double *held)
{
  scene s;
  double most = 0, start = 28.5, stop = 30.15, l = 30;
  bt_vec3 shape[3] = { { 0, 0, -20 }, { 14, 3, -23 }, { start, 0, -20 } };
  bt_tether_props line = { .diameter = 0.0076,
                           .mass = 0.06,
                           .wet_weight = 0.1,
                           .ea = 2e4,
                           .ba = 50,
                           .cdn = 1.2,
                           .cdt = 0.01,
                           .ca = 1 };
  scene_open (&s, line, 1025, n, shape, 3, l);
  scene_current (&s, bt__vec (0, 0.2, 0));
  scene_settle (&s);
  s.in.tolerance = 1e-8;
  for (int i = 1; s.water.time < stop - start + 1 - h / 2; i++)
    {
      s.in.end[1].at.x = fmin (start + i * h, stop);
      scene_step (&s, h);
      most = fmax (most, bt__dynamic_node_tension (s.d, n));
    }
  *held = bt__dynamic_node_tension (s.d, n);
  scene_close (&s);
  return most;
}

/* A true impact, against our own run converged in space and time.  */
static void
test_impact (void **state)
{
  (void)state;
  double peak[4], held[4], coarse, after;
  for (int k = 0; k < 4; k++)
    peak[k] = run_taut (50 << k, 0.004 / (1 << k), held + k);
  double best = peak[3] + (peak[3] - peak[2]) / 3, doubt = fabs (peak[3] - peak[2]) / best;
  coarse = run_taut (60, 1.0 / 60, &after);
  printf ("# impact: peaks %.4f %.4f %.4f %.4f N, extrapolated %.4f, apart by %.2g; 60 intervals at"
          " 60 Hz %.4f; a second later %.4f of %.4f\n",
          peak[0], peak[1], peak[2], peak[3], best, doubt, coarse, after, held[3]);
  assert_true (doubt < 1e-3);
  assert_close (coarse / best, 1, 0.02, "peak of the impact");
  assert_close (after / held[3], 1, 0.02, "tension after the impact");
}

/* The last column: a mass M arriving at V on a massless line, T = V sqrt (EA M / L), a quarter of
   its period later.  */
static const struct
{
  double ea, v, l, m, peak, at;
} snaps[] = { { 400, 0.5, 2.85, 11.5, 20.08752777048, 0.4496361614167 },
              { 5e4, 1, 100, 11.5, 75.82875444052, 0.2382230578812 },
              { 5e4, 0.5, 30, 60, 158.1138830084, 0.2980376479739 },
              { 2e4, 0.8, 30, 19.9, 92.05, 0.2713936 } };

static void
test_snap_mass (void **state)
{
  (void)state;
  for (int k = 0; k < 4; k++)
    {
      scene s;
      double h = snaps[k].at / 400, most = 0, at = 0;
      bt_vec3 shape[2] = { { 0, 0, 0 }, { snaps[k].l - 0.5 * h * snaps[k].v, 0, 0 } };
      bt_tether_props line = { .diameter = 0.01, .mass = 1e-5, .ea = snaps[k].ea };
      scene_open (&s, line, 0, 10, shape, 2, snaps[k].l);
      s.in.end[1].free = 1;
      s.in.end[1].body.mass = snaps[k].m;
      for (int i = 0; i <= 10; i++)
        bt__dynamic_v (s.d)[i].x = snaps[k].v * i / 10;
      while (s.water.time < 1.5 * snaps[k].at)
        {
          scene_step (&s, h);
          if (s.report.tension > most)
            {
              most = s.report.tension;
              at = s.water.time - h / 2;
            }
        }
      assert_close (most / snaps[k].peak, 1, 0.002, "snap");
      assert_close (at / snaps[k].at, 1, 0.01, "time of the snap");
      scene_close (&s);
    }
}

/* The same with the drag of the vehicle (13.7 N s/m and 141 N s2/m2, 13.54 kg and 6.36 of
   added mass): thrust off, and held at what kept .8 m/s.  */
static void
test_snap_vehicle (void **state)
{
  (void)state;
  for (int held = 0; held < 2; held++)
    {
      scene s;
      const double h = 1e-3, v = 0.8, wanted = held ? 139.6 : 55.9;
      double most = 0, thrust = 13.7 * v + 141 * v * v;
      bt_vec3 shape[2] = { { 0, 0, -10 }, { 30 - 0.5 * h * v, 0, -10 } };
      bt_tether_props line = { .diameter = 0.01, .mass = 1e-5, .ea = 2e4 };
      scene_open (&s, line, 1025, 10, shape, 2, 30);
      s.in.end[1].free = 1;
      s.in.end[1].body = (bt__dynamic_lump){ .mass = 13.54,
                                             .added = 6.36,
                                             .linear = 13.7,
                                             .quadratic = 141,
                                             .force = { held ? thrust : 0, 0, 0 } };
      for (int i = 0; i <= 10; i++)
        bt__dynamic_v (s.d)[i].x = v * i / 10;
      while (s.water.time < 2)
        {
          scene_step (&s, h);
          most = fmax (most, s.report.tension);
        }
      printf ("# snap of a vehicle, thrust %.1f N: %.2f N of %.1f\n", held ? thrust : 0, most,
              wanted);
      assert_close (most / wanted, 1, 0.1, "snap of a vehicle");
      scene_close (&s);
    }
}

/* ---- The order of the errors ---- */

/* A vehicle that starts gently on a Lissajous path, 2.5 s of it; points at tenths of the line.  */
static void
fly (int n, double h, int order, bt_vec3 *points)
{
  scene s;
  scene_open_flight (&s, n);
  s.in.order = order;
  for (int i = 1; i * h < 2.5 + h / 2; i++)
    {
      double t = i * h;
      s.in.end[1].at = flight_at (t);
      scene_step (&s, h);
    }
  for (int k = 0; k <= 10; k++)
    points[k] = bt__dynamic_point (s.d, 2.4 * k);
  scene_close (&s);
}

static double
apart (const bt_vec3 *a, const bt_vec3 *b)
{
  double sum = 0;
  for (int k = 0; k <= 10; k++)
    sum += bt__dot (bt__sub (a[k], b[k]), bt__sub (a[k], b[k]));
  return sqrt (sum / 11);
}

static void
test_orders (void **state)
{
  (void)state;
  bt_vec3 p[3][11];
  for (int k = 0; k < 3; k++)
    fly (40, 0.02 / (1 << k), 2, p[k]);
  double in_time = log2 (apart (p[0], p[1]) / apart (p[1], p[2]));
  for (int k = 0; k < 3; k++)
    fly (40 << k, 0.005, 2, p[k]);
  double in_space = log2 (apart (p[0], p[1]) / apart (p[1], p[2]));
  printf ("# orders: %.2f in time, %.2f in space\n", in_time, in_space);
  assert_close (in_time, 2, 0.2, "order in time");
  assert_close (in_space, 2, 0.2, "order in space");
}

/* The corrections for the number of nodes follow the line with a delay: even right after a start
   they take half of the error away.  */
static void
test_correction (void **state)
{
  (void)state;
  bt_vec3 p[2][11], plain[11], corrected[11], best[11];
  fly (160, 0.005, 2, p[0]);
  fly (320, 0.005, 2, p[1]);
  for (int k = 0; k <= 10; k++)
    best[k] = bt__axpy (p[1][k], 1.0 / 3, bt__sub (p[1][k], p[0][k]));
  fly (80, 0.005, 2, plain);
  fly (80, 0.005, 4, corrected);
  double error[2] = { apart (plain, best), apart (corrected, best) };
  printf ("# 80 intervals: off by %.2g m, corrected %.2g m\n", error[0], error[1]);
  assert_true (error[1] < 0.55 * error[0]);
}

/* ---- A line adrift without water ---- */

static void
adrift (double h, double *momentum, double *angular)
{
  scene s;
  const int n = 20;
  bt_vec3 shape[3] = { { 0, 0, 0 }, { 4, 3, 0 }, { 8, 0, 1 } }, p = { 0, 0, 0 }, l = { 0, 0, 0 };
  bt_tether_props line = { .diameter = 0.01, .mass = 0.2, .ea = 1e4, .ba = 20 };
  scene_open (&s, line, 0, n, shape, 3, 10);
  s.in.end[0].free = s.in.end[1].free = 1;
  for (int pass = 0; pass < 2; pass++)
    {
      for (int i = 0; i <= n; i++)
        {
          double m = line.mass * 10 / n * (i == 0 || i == n ? 0.5 : 1), u = (double)i / n;
          bt_vec3 *v = bt__dynamic_v (s.d) + i;
          if (pass == 0)
            *v = bt__vec (sin (3 * u), 2 * u, cos (5 * u));
          bt_vec3 q = bt__scale (pass ? -m : m, *v);
          p = bt__add (p, q);
          l = bt__add (l, bt__cross (bt__dynamic_x (s.d)[i], q));
        }
      while (pass == 0 && s.water.time < 5)
        scene_step (&s, h);
    }
  *momentum = bt__norm (p);
  *angular = bt__norm (l);
  scene_close (&s);
}

static void
test_momentum (void **state)
{
  (void)state;
  double momentum, coarse, fine;
  adrift (0.01, &momentum, &coarse);
  assert_true (momentum < 1e-10);
  adrift (0.0025, &momentum, &fine);
  assert_true (momentum < 1e-10);
  printf ("# angular momentum lost: %.2g, a quarter of the step %.2g N m s\n", coarse, fine);
  assert_true (fine < 0.3 * coarse && fine < 1e-3);
}

int
main (void)
{
  const struct CMUnitTest tests[] = {
    cmocka_unit_test (test_pendulum),      cmocka_unit_test (test_folded_chain),
    cmocka_unit_test (test_hanging_chain), cmocka_unit_test (test_strings_and_beams),
    cmocka_unit_test (test_sagged_cable),  cmocka_unit_test (test_sinking),
    cmocka_unit_test (test_snap_wave),     cmocka_unit_test (test_snap_mass),
    cmocka_unit_test (test_slack_wave),    cmocka_unit_test (test_impact),
    cmocka_unit_test (test_snap_vehicle),  cmocka_unit_test (test_orders),
    cmocka_unit_test (test_correction),    cmocka_unit_test (test_momentum),
  };
  return cmocka_run_group_tests (tests, NULL, NULL);
}
