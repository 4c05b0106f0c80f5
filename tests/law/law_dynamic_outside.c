/* The moving line against what others computed or measured.  The reference data are not part of the
   package: without them these tests are skipped.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include "law/dynamic_scene.h"
#include "reference.h"

enum
{
  COLUMNS = 70,
  ROWS = 1000
};

typedef struct table
{
  int rows, columns;
  double at[ROWS][COLUMNS];
} table;

static void
parse (table *t, char *line)
{
  char *end;
  t->columns = 0;
  for (char *p = line; t->columns < COLUMNS; p = end + 1)
    {
      t->at[t->rows][t->columns++] = strtod (p, &end);
      if (*end != ',')
        break;
    }
  t->rows++;
}

/* Read the numbers of FILE; the test is skipped when it is not there.  */
static void
load (const char *file, table *t)
{
  static char line[16384];
  FILE *f = bench_open_reference (file);
  t->rows = 0;
  if (!f)
    {
      printf ("# no reference data: %s\n", file);
      skip ();
      return;
    }
  while (t->rows < ROWS && fgets (line, sizeof line, f))
    if ((line[0] >= '0' && line[0] <= '9') || line[0] == '-')
      parse (t, line);
  fclose (f);
}

static table data;

/* ---- MoorDyn ---- */

static const bt_tether_props moordyn_line = {
  .diameter = 0.01, .mass = 0.0805033117, .ea = 2e5, .ba = 50, .cdn = 1.2, .cdt = 0.02, .ca = 1
};

/* The largest distance and relative difference in tension to DATA's rows of s, x, y, z, T.  */
static void
compare_rest (const scene *s, double miss[2])
{
  miss[0] = miss[1] = 0;
  for (int k = 0; k < data.rows; k++)
    {
      const double *row = data.at[k];
      int i = (int)(row[0] / 100 * (double)s->d->n + 0.5);
      double there = bt__distance (bt__dynamic_x (s->d)[i], bt__vec (row[1], row[2], row[3]));
      miss[0] = fmax (miss[0], there);
      miss[1] = fmax (miss[1], fabs (bt__dynamic_node_tension (s->d, i) / row[4] - 1));
    }
}

static void
test_moordyn_rest (void **state)
{
  (void)state;
  for (int k = 0; k < 2; k++)
    {
      scene s;
      double miss[2];
      bt_tether_props line = moordyn_line;
      bt_vec3 shape[3]
          = { { 0, 0, -100 }, { 30, k ? 30 : 0, k ? -100 : -140 }, { k ? 70 : 60, 0, -100 } };
      load (k ? "moordyn/B.csv" : "moordyn/A.csv", &data);
      line.mass = k ? line.mass : 0.12;
      line.wet_weight = k ? 0 : 0.387462511750;
      scene_open (&s, line, 1025, 800, shape, 3, 100);
      if (k)
        scene_current (&s, bt__vec (0, 0.5, 0));
      scene_settle (&s);
      compare_rest (&s, miss);
      printf ("# MoorDyn %s, 800 intervals: %.2g m, tension %.2g\n", k ? "B" : "A", miss[0],
              miss[1]);
      assert_true (miss[0] < 1e-4 && miss[1] < 1e-4);
      scene_close (&s);
    }
}

/* Fly case C with N intervals in steps of H; *SHAPE, *PULL receive points and end tensions.  */
static void
fly_c (int n, double h, bt_vec3 shape[][21], double pull[][2])
{
  scene s;
  int per = (int)(0.5 / h + 0.5);
  bt_vec3 start[3] = { { 0, 0, -100 }, { 35, 32, -100 }, { 70, 0, -100 } };
  scene_open (&s, moordyn_line, 1025, n, start, 3, 100);
  scene_current (&s, bt__vec (0, 0.5, 0));
  scene_settle (&s);
  for (int k = 0; k < data.rows; k++)
    {
      for (int i = 0; i < (k ? per : 0); i++)
        {
          double t = ((k - 1) * per + i + 1) * h, u = fmin (t / 10, 1);
          double a = 10 * (1 - cos (0.1 * t)) * u * u * u * (10 - 15 * u + 6 * u * u);
          s.in.end[1].at = bt__vec (70 + 0.8 * a, 0, -100 + 0.6 * a);
          scene_step (&s, h);
        }
      for (int i = 0; i <= 20; i++)
        shape[k][i] = bt__dynamic_x (s.d)[i * n / 20];
      for (int e = 0; e < 2; e++)
        pull[k][e] = bt__dynamic_node_tension (s.d, e ? n : 0);
    }
  scene_close (&s);
}

typedef struct flight
{
  bt_vec3 shape[ROWS][21];
  double pull[ROWS][2];
} flight;

/* Rms distance of A to B, or to the reference when B is NULL, and rms difference in tension.  */
static void
compare_flights (const flight *a, const flight *b, double rms[2])
{
  double sum = 0, difference = 0, scale = 0;
  for (int k = 0; k < data.rows; k++)
    {
      for (int i = 0; i <= 20; i++)
        {
          const double *p = data.at[k] + 3 + 3 * i;
          bt_vec3 d = bt__sub (a->shape[k][i], b ? b->shape[k][i] : bt__vec (p[0], p[1], p[2]));
          sum += bt__dot (d, d);
        }
      for (int e = 0; e < 2; e++)
        {
          double d = a->pull[k][e] - (b ? b->pull[k][e] : data.at[k][1 + e]);
          difference += d * d;
          scale += data.at[k][1 + e] * data.at[k][1 + e];
        }
    }
  rms[0] = sqrt (sum / (21 * data.rows));
  rms[1] = sqrt (difference / scale);
}

/* The reference's own uncertainty: 1.12e-5 m and 2e-5 of the tension, rms.  */
static void
test_moordyn_flight (void **state)
{
  (void)state;
  static flight coarse, fine, best;
  double miss[2], own[2], best_miss[2];
  load ("moordyn/C.csv", &data);
  fly_c (100, 0.01, coarse.shape, coarse.pull);
  fly_c (200, 0.005, fine.shape, fine.pull);
  for (int k = 0; k < data.rows; k++) /* second order in both */
    {
      for (int i = 0; i <= 20; i++)
        best.shape[k][i]
            = bt__axpy (fine.shape[k][i], 1.0 / 3, bt__sub (fine.shape[k][i], coarse.shape[k][i]));
      for (int e = 0; e < 2; e++)
        best.pull[k][e] = fine.pull[k][e] + (fine.pull[k][e] - coarse.pull[k][e]) / 3;
    }
  compare_flights (&fine, NULL, miss);
  compare_flights (&fine, &best, own);
  compare_flights (&best, NULL, best_miss);
  printf ("# MoorDyn C, 200 intervals: %.2g m rms (own error %.2g), tension %.2g (%.2g);"
          " extrapolated %.2g m, %.2g\n",
          miss[0], own[0], miss[1], own[1], best_miss[0], best_miss[1]);
  assert_true (miss[0] <= own[0] + 1.2e-5 && miss[1] <= own[1] + 2e-5);
  assert_true (best_miss[0] < 1e-4 && best_miss[1] < 1e-4);
}

/* ---- Lowe & Langley: a flexible jumper ---- */

/* Ours is periodic from the start of the history.  The reference's first cycle is below its later
   ones at the same phase for this long: what is left of its own start.  */
#define RUN_UP 3.0

static double
interpolated (double t)
{
  int k = 1;
  while (k < data.rows - 1 && data.at[k][0] < t)
    k++;
  const double *a = data.at[k - 1], *b = data.at[k];
  return a[1] + (b[1] - a[1]) * (t - a[0]) / (b[0] - a[0]);
}

static void
test_lowe_langley (void **state)
{
  (void)state;
  for (int which = 1; which <= 2; which++)
    {
      scene s;
      char file[80];
      const double h = 0.05, before = 81, pi = BT__PI, g = 9.807;
      double worst = 0, early = 0, sum = 0;
      int count = 0;
      snprintf (file, sizeof file, "published/lowe_langley_2006_case%d.csv", which);
      load (file, &data);
      bt_vec3 shape[3] = { { 0, 0, -5 }, { -40, 0, -95 }, { -100, 0, -55 } };
      bt_tether_props line
          = { .diameter = 0.396, .mass = 165, .ea = 5e8, .ei = 120.8e3, .cdn = 1, .ca = 1 };
      line.wet_weight = (165 - 1000 * pi * 0.396 * 0.396 / 4) * g;
      scene_open (&s, line, 1000, 100, shape, 3, 170);
      s.in.tolerance = 1e-7;
      scene_settle (&s);
      printf ("# Lowe & Langley: static %.2f %.2f kN of 11.40 45.71\n", s.d->pull[0].x / -1e3,
              s.d->pull[0].z / -1e3);
      double last = data.at[data.rows - 1][0];
      for (double t = -before + h; t < last; t += h)
        {
          double ramp = fmin ((t + before) / 27, 1), a = 10 * ramp * sin (2 * pi * t / 27);
          s.in.end[0].at = bt__vec (which == 1 ? a : 0, which == 2 ? a : 0, -5);
          scene_step (&s, h);
          if (t < data.at[0][0])
            continue;
          double off = fabs (bt__dynamic_node_tension (s.d, 0) / 1e3 - interpolated (t));
          early = t < RUN_UP ? fmax (early, off) : early;
          worst = t < RUN_UP ? worst : fmax (worst, off);
          sum += off * off;
          count++;
        }
      printf ("# Lowe & Langley case %d: top tension off by %.2f kN at most, %.2f rms;"
              " %.2f in the reference's first %.1f s\n",
              which, worst, sqrt (sum / count), early, RUN_UP);
      assert_true (worst < 0.5 && early < 0.7);
      scene_close (&s);
    }
}

/* ---- OrcaFlex: a chain that lies on the seabed ---- */

/* WD0050: 410 m of chain from an anchor 400 m off and 50 m down, half of it at rest on the bottom
   (MoorDyn's springs of it, by lumps at the nodes), the fairlead heaving.  The reference's own
   bottom and its friction are not known; here there is none.  The large motion leaves a third of
   the tension at its lowest: there its own tenth is missed, whatever nodes, steps or bottom.  */
enum
{
  CHAIN = 82
};

static void
lie_on_bottom (scene *s, bt__dynamic_lump *lumps, const bt_vec3 *first)
{
  const double stiffness = 1e5, damping = 1e4, d = s->line.diameter; /* Pa/m, Pa s/m */
  for (int i = 1; i < CHAIN; i++)
    {
      double l = 410.0 / CHAIN, deep = first->z - bt__dynamic_x (s->d)[i].z;
      double push = deep > 0 ? stiffness * deep - damping * bt__dynamic_v (s->d)[i].z : 0;
      lumps[i - 1] = (bt__dynamic_lump){ .from_end = (CHAIN - i) * l,
                                         .force = { 0, 0, fmax (push, 0) * d * l } };
    }
  s->in.lumps = lumps;
  s->in.n_lumps = CHAIN - 1;
}

/* The height of the fairlead of MOTION at time T, by the cubic through four rows.  */
static double
heave (const table *motion, double t)
{
  double u = (t - motion->at[0][0]) / 0.1;
  int k = (int)fmin (fmax (u - 1, 0), motion->rows - 4);
  double sum = 0;
  for (int i = k; i < k + 4; i++)
    {
      double p = motion->at[i][3];
      for (int j = k; j < k + 4; j++)
        p *= j == i ? 1 : (u - j) / (i - j);
      sum += p;
    }
  return sum;
}

static void
test_orcaflex (void **state)
{
  (void)state;
  static table motion;
  static bt__dynamic_lump lumps[CHAIN];
  for (int which = 1; which <= 2; which++)
    {
      scene s;
      char file[80];
      const double h = 0.02;
      double worst = 0, most = 0, sum = 0, scale = 0, peaks[2] = { 0, 0 }, lows[2] = { 1e9, 1e9 };
      snprintf (file, sizeof file, "published/orcaflex_motion_ZZP1_A%d.csv", which);
      load (file, &motion);
      snprintf (file, sizeof file, "published/orcaflex_WD0050_ZZP1_A%d.csv", which);
      load (file, &data);
      bt_vec3 shape[3] = { { 400, 0, -50 }, { 160, 0, -50 }, { 0, 0, 0 } };
      bt_tether_props line = { .diameter = 0.252,
                               .mass = 390,
                               .ea = 1.674e9,
                               .ba = 5 * sqrt (1.674e9 * 390), /* critical for an interval */
                               .cdn = 1.37,
                               .cdt = 0.64,
                               .ca = 1 };
      line.wet_weight = (390 - 1025 * BT__PI * 0.252 * 0.252 / 4) * 9.81;
      scene_open (&s, line, 1025, CHAIN, shape, 3, 410);
      s.in.tolerance = 1e-8;
      for (int i = 0; i < 30000; i++)
        {
          lie_on_bottom (&s, lumps, shape);
          scene_step (&s, h);
        }
      double anchor = bt__dynamic_node_tension (s.d, 0) / 1e3,
             fairlead = bt__dynamic_node_tension (s.d, CHAIN) / 1e3;
      printf ("# OrcaFlex chain, static: fairlead %.1f kN of 991.6, anchor %.1f of 826.2\n",
              fairlead, anchor);
      assert_close (fairlead / 991.6, 1, 0.02, "static tension");
      assert_close (anchor / 826.2, 1, 0.02, "static tension of the anchor");
      for (int i = 1; i <= 1500; i++)
        {
          double t = -10 + i * h;
          s.in.end[1].at.z = heave (&motion, t);
          lie_on_bottom (&s, lumps, shape);
          scene_step (&s, h);
          int row = (int)floor (t * 10 + 0.5);
          if (t < -h / 2 || fabs (t * 10 - row) > 1e-6 || row >= data.rows)
            continue;
          double is = bt__dynamic_node_tension (s.d, CHAIN) / 1e3, wanted = data.at[row][3];
          worst = fmax (worst, fabs (is / wanted - 1));
          most = fmax (most, fabs (is - wanted) / 991.6);
          sum += (is - wanted) * (is - wanted);
          scale += wanted * wanted;
          peaks[0] = fmax (peaks[0], is);
          peaks[1] = fmax (peaks[1], wanted);
          lows[0] = fmin (lows[0], is);
          lows[1] = fmin (lows[1], wanted);
        }
      printf (
          "# OrcaFlex A%d, fairlead: off by %.1f %% of the static tension at most, %.1f %% of its"
          " own, %.1f %% rms; %.0f to %.0f kN of %.0f to %.0f\n",
          which, 100 * most, 100 * worst, 100 * sqrt (sum / scale), lows[0], peaks[0], lows[1],
          peaks[1]);
      assert_true (most < 0.1 && worst < (which == 1 ? 0.1 : 0.15));
      scene_close (&s);
    }
}

/* ---- A tether in a tank ---- */

/* M. Filliung et al. (ICRA 2024), cable 6, surge run; the markers' places along the cable.  */
static const double markers[16] = { 0,    0.05, 0.25, 0.45, 0.65, 0.85, 1.05, 1.25,
                                    1.45, 1.65, 1.85, 2.05, 2.25, 2.45, 2.65, 2.85 };

enum
{
  MOVING,
  SURE, /* moving, the reference's own uncertainty below 20 mm */
  RESTING,
  KINDS
};

typedef struct frames
{
  int count[KINDS];
  double off[KINDS][ROWS], doubt[KINDS][ROWS]; /* mm */
} frames;

static void
add_frame (frames *f, const scene *s, const double *row)
{
  double sum = 0;
  for (int k = 0; k < 16; k++)
    {
      const double *p = row + 12 + 3 * k;
      sum += bt__distance (bt__dynamic_point (s->d, markers[k]), bt__vec (p[0], p[1], p[2]));
    }
  int moving = row[11] > 20;
  int into[KINDS] = { moving, moving && row[10] < 20, !moving };
  for (int k = 0; k < KINDS; k++)
    if (into[k])
      {
        f->off[k][f->count[k]] = 1000 * sum / 16;
        f->doubt[k][f->count[k]++] = row[10];
      }
}

static void
fly_tank (double cd, frames *f)
{
  scene s;
  const double *first = data.at[0];
  bt_vec3 end = bt__vec (first[1], first[2], first[3]);
  bt_vec3 shape[3] = { { 0, 0, 0 }, { end.x / 2, end.y / 2, -1.3 }, end };
  bt_tether_props line = { .diameter = 0.0035,
                           .mass = 0.0517,
                           .wet_weight = 0.4,
                           .ea = 1e4,
                           .cdn = cd,
                           .cdt = 0.01,
                           .ca = 1 };
  memset (f, 0, sizeof *f);
  scene_open (&s, line, 1000, 57, shape, 3, 2.85);
  scene_settle (&s);
  for (int k = 0; k < data.rows; k++)
    {
      const double *row = data.at[k];
      s.in.end[1].at = bt__vec (row[1], row[2], row[3]);
      if (k > 0)
        scene_step (&s, row[0] - data.at[k - 1][0]);
      add_frame (f, &s, row);
    }
  scene_close (&s);
}

static int
compare (const void *a, const void *b)
{
  double x = *(const double *)a, y = *(const double *)b;
  return (x > y) - (x < y);
}

/* The mean of the N numbers X; *MEDIAN receives their median.  */
static double
mean (double *x, int n, double *median)
{
  double sum = 0;
  for (int i = 0; i < n; i++)
    sum += x[i];
  qsort (x, (size_t)n, sizeof *x, compare);
  *median = x[n / 2];
  return sum / n;
}

/* The figures of data/README.md for the moving frames, 30 mm of a simple model and 36 mm of
   uncertainty, are medians: the mean uncertainty of the 144 frames is 42.6 mm, their median 35.9.
   So 32 mm is asked of the median, and of the mean that it is within the mean uncertainty.  */
static void
test_tank (void **state)
{
  (void)state;
  static frames f;
  load ("real/toulon_cable6_surge_0p6_0031.csv", &data);
  for (double cd = 1.2; cd < 1.45; cd += 0.1)
    {
      double off[KINDS], median[KINDS], doubt[KINDS], unused;
      fly_tank (cd, &f);
      for (int k = 0; k < KINDS; k++)
        {
          off[k] = mean (f.off[k], f.count[k], median + k);
          doubt[k] = mean (f.doubt[k], f.count[k], &unused);
        }
      printf (
          "# tank, Cd %.1f: %d moving frames, mean %.1f mm, median %.1f (uncertainty %.1f); %d sure"
          " ones, mean %.1f; at rest %.1f\n",
          cd, f.count[MOVING], off[MOVING], median[MOVING], doubt[MOVING], f.count[SURE], off[SURE],
          off[RESTING]);
      assert_int_equal (f.count[MOVING], 144);
      assert_int_equal (f.count[SURE], 32);
      if (fabs (cd - 1.3) < 0.01)
        assert_true (median[MOVING] <= 32 && off[MOVING] <= doubt[MOVING] && off[SURE] <= 14
                     && off[RESTING] <= 10);
    }
}

int
main (void)
{
  const struct CMUnitTest tests[] = {
    cmocka_unit_test (test_moordyn_rest), cmocka_unit_test (test_moordyn_flight),
    cmocka_unit_test (test_lowe_langley), cmocka_unit_test (test_orcaflex),
    cmocka_unit_test (test_tank),
  };
  FILE *readme = bench_open_reference ("README.md");
  if (!readme)
    {
      puts ("1..0 # SKIP the reference data are not here");
      return 0;
    }
  fclose (readme);
  return cmocka_run_group_tests (tests, NULL, NULL);
}
