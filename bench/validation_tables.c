/* The analytic tables: closed forms and integrations to nine digits and more, against the models
   that claim the same equations.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include <bight/statics.h>

#include "testbed/outside.h"
#include "testbed/reference.h"
#include "testbed/rig.h"
#include "validation.h"

enum
{
  FIELDS = 48,
  INTERVALS = 512
};

/* What a table came to.  */
typedef struct verdict
{
  int rows;
  double place, force; /* the largest misses, of the length and of the tension */
} verdict;

static void
miss_place (verdict *v, bt_vec3 is, bt_vec3 wanted, double length)
{
  v->place = fmax (v->place, bt__distance (is, wanted) / length);
}

static void
miss_force (verdict *v, double is, double wanted, double scale)
{
  v->force = fmax (v->force, fabs (is - wanted) / scale);
}

/* ---- A row of each, as numbers X and words F ---- */

static int
try_catenary (const double *x, char **f, verdict *v)
{
  bt_catenary c;
  (void)f;
  if (bt_catenary_solve (x[1], x[2], x[0], &c, NULL) != BT_OK)
    return 0;
  for (int k = 0; k < 3; k++)
    {
      bt_point2 p = bt_catenary_point (&c, (k + 1) * x[0] / 4);
      miss_place (v, bt__vec (p.x, 0, p.y), bt__vec (x[10 + 2 * k], 0, x[11 + 2 * k]), x[0]);
    }
  return 1;
}

static int
try_elastic (const double *x, char **f, verdict *v)
{
  bt_elastic e;
  (void)f;
  if (bt_elastic_solve (x[1], x[2], x[0], x[3], x[4], &e, NULL) != BT_OK)
    return 0;
  bt_point2 p = bt_elastic_point (&e, x[0] / 2);
  miss_place (v, bt__vec (p.x, 0, p.y), bt__vec (x[9], 0, x[10]), x[0]);
  miss_force (v, bt_elastic_tension (&e, 0), x[7], x[7]);
  miss_force (v, bt_elastic_tension (&e, x[0]), x[8], x[7]);
  return 1;
}

static bt_steady *steady;
static int intervals = INTERVALS; /* and steps: half as many show what they cost */
static bt_vec3 r[INTERVALS + 1], t[INTERVALS + 1];

static int
shoot (const bt_line *line, const bt_water *water, bt_vec3 a, bt_vec3 b)
{
  bt_vec3 pull = { 0, 0, 0 };
  bt_steady_report report;
  return bt_steady_shoot (steady, line, water, a, b, intervals, 0, &pull, r, t, &report, NULL)
             == BT_OK
         && report.converged;
}

/* The current that the word PROFILE names, with its length P.  */
static bt_current
current_of (const char *profile, double p, bt_vec3 u)
{
  bt_current c = { .kind = BT_CURRENT_UNIFORM, .velocity = { u } };
  if (strcmp (profile, "linear") == 0) /* U (1 + z/p) */
    {
      c.kind = BT_CURRENT_PROFILE;
      c.n = 2;
      c.z[1] = -p;
    }
  if (strcmp (profile, "power7") == 0)
    {
      c.kind = BT_CURRENT_POWER;
      c.exponent = 1.0 / 7;
    }
  if (strcmp (profile, "turn") == 0)
    {
      c.kind = BT_CURRENT_TURNING;
      c.turn_rate = -BT__PI / 2 / p;
    }
  return c;
}

static bt_vec3
triple (const double *x)
{
  return bt__vec (x[0], x[1], x[2]);
}

static int
try_fixed_ends (const double *x, char **f, verdict *v)
{
  bt_line line = { x[7], x[9], x[8], INFINITY, x[10], x[11] };
  bt_current current = current_of (f[13], x[14], triple (x + 15));
  bt_water water = { x[12], 9.81, x[14] > 0 ? x[14] : 100, 0, &current, NULL, NULL, NULL };
  if (!shoot (&line, &water, triple (x + 1), triple (x + 4)))
    return 0;
  miss_force (v, bt__distance (t[0], triple (x + 18)), 0, x[21]);
  miss_force (v, bt__distance (t[intervals], triple (x + 22)), 0, x[21]);
  for (int k = 0; k < 3; k++)
    miss_place (v, r[(k + 1) * intervals / 4], triple (x + 26 + 3 * k), x[7]);
  return 1;
}

static int
try_free_end (const double *x, char **f, verdict *v)
{
  bt_line line = { x[1], x[3], x[2], INFINITY, x[4], x[5] };
  bt_current current = { .kind = BT_CURRENT_UNIFORM, .velocity = { triple (x + 7) } };
  bt_water water = { x[6], 9.81, 1000, 0, &current, NULL, NULL, NULL };
  (void)f;
  if (bt_steady_march (&line, &water, bt__vec (0, 0, 0), bt__scale (-1, triple (x + 10)), intervals,
                       r, t, NULL)
      != BT_OK)
    return 0;
  miss_place (v, r[intervals], triple (x + 13), x[1]);
  miss_place (v, r[intervals / 2], triple (x + 20), x[1]);
  miss_force (v, bt__distance (t[intervals], triple (x + 16)), 0, x[19]);
  return 1;
}

static int
try_neutral (const double *x, char **f, verdict *v)
{
  bt_line line = { x[0], x[3], 0, INFINITY, x[4], 0 };
  bt_current current = { .kind = BT_CURRENT_UNIFORM, .velocity = { bt__vec (x[5], 0, 0) } };
  bt_water water = { x[6], 9.81, 1000, 0, &current, NULL, NULL, NULL };
  (void)f;
  if (!shoot (&line, &water, bt__vec (0, 0, 0), bt__vec (-x[2], x[1], 0)))
    return 0;
  for (int i = 0; i <= intervals; i++)
    miss_force (v, bt__norm (t[i]), x[9], x[9]);
  miss_place (v, bt__vec (atan2 (t[0].x, t[0].y), 0, 0), bt__vec (atan (x[12]), 0, 0), 1);
  return 1;
}

/* A line of 20 m that sinks flat from rest: its way against the length it falls in its time
   constant at full speed.  Its speed stands for a force.  */
static int
try_sinking (const double *x, char **f, verdict *v)
{
  rig line;
  bt_vec3 shape[3] = { { 0, 0, 0 }, { 10, 0, 0 }, { 20, 0, 0 } };
  bt_tether_props props
      = { .diameter = x[1], .mass = x[0], .wet_weight = x[2], .ea = 1e5, .cdn = x[3], .ca = x[4] };
  (void)f;
  rig_open (&line, props, x[5], 20, shape, 3, 20);
  line.in.end[0].free = line.in.end[1].free = 1;
  int steps = (int)lround (x[8] / 2e-4 * intervals / INTERVALS);
  for (int i = 0; i < steps; i++)
    rig_step (&line, x[8] / steps);
  if (line.good)
    {
      miss_place (v, bt__dynamic_x (line.d)[10], bt__vec (10, 0, -x[10]), x[6] * x[7]);
      miss_force (v, -bt__dynamic_v (line.d)[10].z, x[9], x[6]);
    }
  return rig_close (&line);
}

/* Let the first nodes of LINE, as many as lie nearest to that, share LEFT metres alike, and the
   others RIGHT.  */
static void
put_joint (rig *line, double left, double right)
{
  int n = (int)line->d->n, k = (int)lround (n * left / (left + right));
  double *rest = bt__dynamic_rest (line->d);
  for (int j = 0; j < n; j++)
    rest[j] = j < k ? left / k : right / (n - k);
}

/* A cable of 1000 ft span with a load of 8 kip at a joint, which is a node: the second row of its
   table; the first is without the load, and begins each line here.  */
static int
try_point_load (const double *x, char **f, verdict *v)
{
  const double ft = 0.3048, lb = 4.4482216152605, left = 412.8837 * ft, right = 613.0422 * ft;
  rig line;
  bt_vec3 shape[3] = { { 0, 0, 0 }, { 400 * ft, 0, -100 * ft }, { 1000 * ft, 0, 0 } };
  bt_tether_props props
      = { .diameter = 0.026, .mass = 4.7, .wet_weight = 3.16 * lb / ft, .ea = 16150e3 * lb };
  bt__dynamic_lump load = { .from_end = right, .wet_weight = x[0] * lb };
  (void)f;
  rig_open (&line, props, 0, intervals / 64 * 41, shape, 3, left + right);
  if (line.good)
    put_joint (&line, left, right);
  line.in.lumps = &load;
  line.in.n_lumps = 1;
  rig_settle (&line);
  if (line.good)
    {
      bt_vec3 pull = line.d->pull[0];
      miss_place (v, bt__dynamic_point (line.d, left), bt__vec (x[3] * ft, 0, x[4] * ft),
                  left + right);
      miss_force (v, hypot (pull.x, pull.z), hypot (x[1], x[2]) * lb, hypot (x[1], x[2]) * lb);
    }
  return rig_close (&line);
}

/* ---- All of them ---- */

static const struct
{
  const char *name, *model, *file, *setting, *place, *force;
  int (*try_row) (const double *, char **, verdict *);
  int columns, order; /* order: of what the intervals cost; 0: there are none */
  double sure;
} tables[] = {
  { "table-catenary", "catenary", "analytic/catenary_inextensible.csv", "closed form",
    "largest distance, of the length", NULL, try_catenary, 16, 0, 1e-12 },
  { "table-elastic", "elastic", "analytic/catenary_elastic.csv", "closed form",
    "largest distance, of the length", "largest difference of tension, relative", try_elastic, 11,
    0, 1e-12 },
  { "table-current", "steady", "analytic/current_bvp3d.csv", "512 intervals",
    "largest distance, of the length", "largest difference of tension, relative", try_fixed_ends,
    35, 4, 1e-9 },
  { "table-free-end", "steady", "analytic/current_free_end.csv", "512 intervals",
    "largest distance, of the length", "largest difference of tension, relative", try_free_end, 23,
    4, 1e-9 },
  { "table-neutral", "steady", "analytic/current_neutral_catenary.csv", "512 intervals",
    "difference of the heading at the start rad", "largest difference of tension, relative",
    try_neutral, 13, 4, 1e-12 },
  { "table-sinking", "dynamic", "analytic/sink_terminal.csv", "steps of 0.2 ms",
    "largest difference of the way, of vt tau", "largest difference of speed, of vt", try_sinking,
    11, 2, 1e-12 },
  { "table-point-load", "dynamic", "analytic/michalos_birnstiel.csv", "328 intervals",
    "largest distance, of the length", "largest difference of tension, relative", try_point_load, 9,
    2, 1e-9 },
};

/* Cut LINE into its cells F and their numbers X.  Return how many there are.  */
static int
cut (char *line, char **f, double *x)
{
  int n = 0;
  for (char *p = line; p && n < FIELDS; n++)
    {
      f[n] = p;
      p = strchr (p, ',');
      if (p)
        *p++ = '\0';
      x[n] = strtod (f[n], NULL);
    }
  return n;
}

/* Try the rows of FILE that have COLUMNS cells and are no heading.  */
static outside_result
try_table (FILE *file, size_t k, verdict *v)
{
  char line[4096], *f[FIELDS];
  double x[FIELDS];
  int heading = 1;
  while (fgets (line, sizeof line, file))
    {
      line[strcspn (line, "\r\n")] = '\0';
      if (line[0] == '#' || cut (line, f, x) < tables[k].columns)
        continue;
      if (!heading && !tables[k].try_row (x, f, v))
        return OUTSIDE_FAILED;
      v->rows += !heading;
      heading = 0;
    }
  return v->rows ? OUTSIDE_DONE : OUTSIDE_NO_DATA;
}

/* Try table K with so many INTERVALS.  */
static outside_result
try_file (size_t k, int with, verdict *came)
{
  FILE *file = bench_open_reference (tables[k].file);
  outside_result result = OUTSIDE_NO_DATA;
  *came = (verdict){ 0, 0, 0 };
  intervals = with;
  if (file)
    {
      result = try_table (file, k, came);
      fclose (file);
    }
  return result;
}

static double
own (size_t k, double coarse, double fine)
{
  return tables[k].order ? fabs (coarse - fine) / (pow (2, tables[k].order) - 1) : NAN;
}

static void
put_table (validation *v, size_t k)
{
  verdict came, coarse;
  char setting[48];
  v->model = tables[k].model;
  if (!validation_counts (v, tables[k].name, try_file (k, INTERVALS, &came), tables[k].file)
      || try_file (k, INTERVALS / 2, &coarse) != OUTSIDE_DONE)
    return;
  snprintf (setting, sizeof setting, "%s, %d rows", tables[k].setting, came.rows);
  validation_row (v, tables[k].name, setting, tables[k].place, came.place, "table", tables[k].sure,
                  own (k, coarse.place, came.place));
  if (tables[k].force)
    validation_row (v, tables[k].name, setting, tables[k].force, came.force, "table",
                    tables[k].sure, own (k, coarse.force, came.force));
}

void
validation_tables (validation *v)
{
  steady = bt_steady_new (INTERVALS);
  for (size_t k = 0; steady && k < sizeof tables / sizeof *tables; k++)
    put_table (v, k);
  bt_steady_free (steady);
}
