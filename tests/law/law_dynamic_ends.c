/* The moving line: the forces at both ends balance all that acts on it.

   What the line weighs, is dragged, accelerates, and presses on is added up here from where its
   nodes are and how they move, by formulas of the test's own, for lines that are drawn by lot.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include "law/dynamic_scene.h"
#include "tether/dynamic_contact.h"

#include <bight/sea.h>

enum
{
  LINES = 120,
  BEFORE = 240, /* steps in which a line comes out of the shape that it was laid in */
  STEPS = 12,
  LUMPS = 4,
  ROWS = 256
};

#define H (1.0 / 120)
#define FLOOR -14.0 /* m */

typedef struct lot
{
  scene s;
  uint64_t seed;
  bt_waves waves;
  bt_sea sea;
  bt__dynamic_lump lump[LUMPS];
  bt__constraint row[ROWS];
  int rows, floored;
  bt_vec3 home[2], swing[2]; /* m: of the ends */
} lot;

/* From LOW to HIGH.  */
static double
draw (lot *l, double low, double high)
{
  l->seed = l->seed * 6364136223846793005u + 1442695040888963407u;
  return low + (high - low) * (double)(l->seed >> 11) / 9007199254740992.0;
}

static int
chance (lot *l, double p)
{
  return draw (l, 0, 1) < p;
}

static bt_vec3
draw_vector (lot *l, double most)
{
  double x = draw (l, -most, most), y = draw (l, -most, most);
  return bt__vec (x, y, draw (l, -most, most));
}

/* ---- A line drawn by lot ---- */

static bt_tether_props
draw_line (lot *l)
{
  double d = exp (draw (l, log (0.003), log (0.03))), mass = 1000 * d * d * draw (l, 0.6, 3);
  int stiff = chance (l, 0.5);
  return (bt_tether_props){ .diameter = d,
                            .mass = mass,
                            .wet_weight = mass * draw (l, -3, 6),
                            .ea = exp (draw (l, log (1e3), log (1e6))),
                            .ei = stiff ? exp (draw (l, log (1e-3), log (10))) : 0,
                            .ba = chance (l, 0.5) ? draw (l, 0, 100) : 0,
                            .cdn = draw (l, 0, 2),
                            .cdt = draw (l, 0, 0.05),
                            .ca = draw (l, 0, 1) };
}

/* Within the first or last interval of N as often as anywhere, and at the ends themselves.  */
static void
draw_lumps (lot *l, int n, double length)
{
  int count = (int)draw (l, 0, LUMPS + 0.99);
  for (int k = 0; k < count; k++)
    {
      double at = draw (l, 0, length), near = draw (l, 0, length / n);
      double from_end = chance (l, 0.3) ? near : chance (l, 0.3) ? length - near : at;
      if (chance (l, 0.2))
        from_end = chance (l, 0.5) ? 0 : length;
      l->lump[k] = (bt__dynamic_lump){ .from_end = from_end,
                                       .mass = draw (l, 0, 3),
                                       .added = draw (l, 0, 1),
                                       .wet_weight = draw (l, -10, 20),
                                       .linear = draw (l, 0, 3),
                                       .quadratic = draw (l, 0, 5),
                                       .force = draw_vector (l, 5) };
    }
  l->s.in.lumps = l->lump;
  l->s.in.n_lumps = count;
}

static void
draw_water (lot *l)
{
  const bt_wave_def swell = { .kind = BT_WAVE_AIRY, .height = draw (l, 0.2, 1), .period = 6 };
  scene_current (&l->s, bt__vec (draw (l, -1, 1), draw (l, -1, 1), 0));
  if (!chance (l, 0.4))
    return;
  assert_int_equal (bt_waves_make (&swell, 1000, 9.81, &l->waves, NULL), BT_OK);
  l->sea = (bt_sea){ .waves = &l->waves };
  l->s.water.sea = &l->sea;
}

static void
draw_ends (lot *l, double ei)
{
  for (int e = 0; e < 2; e++)
    {
      bt__dynamic_end *end = l->s.in.end + e;
      l->swing[e] = chance (l, 0.6) ? draw_vector (l, 0.5) : bt__vec (0, 0, 0);
      end->clamped = ei > 0 && chance (l, 0.5);
      end->direction = bt__unit_or (draw_vector (l, 1), bt__vec (0, 0, -1));
    }
  bt__dynamic_end *far = l->s.in.end + 1;
  if (!chance (l, 0.4))
    return;
  far->free = 1;
  far->body = (bt__dynamic_lump){
    .mass = draw (l, 1, 30), .added = draw (l, 0, 10), .wet_weight = draw (l, -5, 5), .quadratic = 9
  };
  far->gripped = chance (l, 0.5);
  for (int i = 0; i < 3; i++)
    far->stiffness[i][i] = 400;
}

static void
open_lot (lot *l, int which)
{
  *l = (lot){ .seed = 0x9e3779b97f4a7c15u * (uint64_t)(which + 1) };
  int n = 2 + (int)draw (l, 0, 30);
  bt_tether_props line = draw_line (l);
  bt_vec3 a = bt__vec (0, 0, draw (l, -10, chance (l, 0.2) ? 1 : -2));
  bt_vec3 way = draw_vector (l, 10), b = bt__add (a, way);
  l->floored = chance (l, 0.4);
  if (l->floored) /* one end is made fast on it */
    {
      a.z = FLOOR - 1e-3;
      b.z = fmax (b.z, FLOOR + 0.05);
    }
  bt_vec3 mid = bt__vec (0.5 * (a.x + b.x), 0.5 * (a.y + b.y) + draw (l, 0.5, 4),
                         l->floored ? FLOOR - 0.001 : 0.5 * (a.z + b.z) - draw (l, 0.5, 4));
  bt_vec3 shape[3] = { a, mid, b };
  double length = (bt__distance (a, mid) + bt__distance (mid, b)) * draw (l, 0.999, 1.02);
  scene_open (&l->s, line, 1025, n, shape, 3, length);
  l->s.in.tolerance = 1e-12;
  l->s.in.surfaced = 1;
  l->home[0] = a;
  l->home[1] = b;
  draw_lumps (l, n, length);
  draw_water (l);
  draw_ends (l, line.ei);
}

/* ---- A step ---- */

static void
move_ends (lot *l, double t)
{
  for (int e = 0; e < 2; e++)
    l->s.in.end[e].at = bt__axpy (l->home[e], 1 - cos (2 * t), l->swing[e]);
}

/* A rough floor under all nodes, the first and last among them, and under the middle of every third
   interval.  */
static void
lay_floor (lot *l)
{
  int n = (int)l->s.d->n;
  l->rows = 0;
  for (int k = 0; l->floored && k < 2 * n + 1; k++)
    if (k % 2 == 0 || k % 3 == 0)
      l->row[l->rows++] = (bt__constraint){ .node = k < 2 * n ? k / 2 : n - 1,
                                            .s = k < 2 * n ? 0.5 * (k % 2) : 1,
                                            .normal = { 0, 0, 1 },
                                            .offset = FLOOR,
                                            .stiffness = 2e4,
                                            .friction = 0.3,
                                            .slip = 1e-3,
                                            .active = -1 };
}

static void
step_lot (lot *l)
{
  scene *s = &l->s;
  if (!l->floored)
    {
      scene_step (s, H);
      return;
    }
  s->in.h = H;
  s->water.time += H;
  lay_floor (l);
  assert_int_equal (bt__dynamic_begin (s->d, s->work, &s->in, &s->report, &s->error), BT_OK);
  bt__dynamic_iterate (s->work, l->row, l->rows, NULL, &s->report);
  assert_int_equal (bt__dynamic_finish (s->d, s->work, NULL, &s->report, &s->error), BT_OK);
}

/* ---- What acts on the line ---- */

/* How a line moves that moved with V before and VP before that.  */
typedef struct motion
{
  bt_vec3 v[RIG_MAX + 1], vp[RIG_MAX + 1];
  int history;
} motion;

typedef struct sum
{
  bt_vec3 force;
  double size;
} sum;

static void
add (sum *all, bt_vec3 f)
{
  all->force = bt__add (all->force, f);
  all->size += bt__norm (f);
}

static bt_vec3
acceleration (const lot *l, const motion *m, int i)
{
  bt_vec3 v = bt__dynamic_v (l->s.d)[i];
  if (!m->history)
    return bt__scale (1 / H, bt__sub (v, m->v[i]));
  return bt__scale (1 / H, bt__axpy (bt__axpy (bt__scale (1.5, v), -2, m->v[i]), 0.5, m->vp[i]));
}

/* Into a layer of 0.1 m on the surface buoyancy fades as 1 - 3 u^2 + 2 u^3.  */
static double
faded (double u)
{
  return u <= 0 ? 0 : u >= 1 ? 1 : u * u * (3 - 2 * u);
}

static double
rise_of (const lot *l, bt_vec3 x)
{
  return (x.z - bt_water_surface (&l->s.water, x)) / 0.1;
}

static double
out_of_water (const lot *l, bt_vec3 x)
{
  return faded (rise_of (l, x));
}

/* How much of the interval from X to the node NEXT is out of the water, m of REST, by the lever of
   X: summed along the straight interval.  */
static double
line_out (const lot *l, bt_vec3 x, bt_vec3 next, double rest)
{
  enum
  {
    POINTS = 2000
  };
  double a = rise_of (l, x), b = rise_of (l, next), sum = 0;
  for (int k = 0; k < POINTS; k++)
    {
      double y = (k + 0.5) / POINTS;
      sum += (1 - y) * faded (a + y * (b - a));
    }
  return rest * sum / POINTS;
}

/* Morison's forces and the weight of the half intervals about node I.  */
static void
add_line (const lot *l, const motion *m, int i, sum *all)
{
  const bt_tether_props *p = &l->s.line;
  const bt_vec3 *x = bt__dynamic_x (l->s.d);
  const double *rest = bt__dynamic_rest (l->s.d);
  int n = (int)l->s.d->n;
  double r0 = i > 0 ? rest[i - 1] : 0, r1 = i < n ? rest[i] : 0, cell = 0.5 * (r0 + r1);
  bt_vec3 none = { 0, 0, 0 }, u, wave;
  bt_vec3 t0 = i > 0 ? bt__unit_or (bt__sub (x[i], x[i - 1]), none) : none,
          t1 = i < n ? bt__unit_or (bt__sub (x[i + 1], x[i]), none) : none;
  bt_vec3 t = bt__unit_or (i == 0   ? t1
                           : i == n ? t0
                                    : bt__add (bt__scale (r1, t0), bt__scale (r0, t1)),
                           none);
  bt_vec3 a = acceleration (l, m, i);
  bt_water_motion (&l->s.water, x[i], &u, &wave);
  double out = (i > 0 ? line_out (l, x[i], x[i - 1], r0) : 0)
               + (i < n ? line_out (l, x[i], x[i + 1], r1) : 0),
         wet = cell - out;
  bt_vec3 rel = bt__sub (u, bt__dynamic_v (l->s.d)[i]);
  double along = bt__dot (rel, t), area = BT__PI / 4 * p->diameter * p->diameter;
  bt_vec3 across = bt__axpy (rel, -along, t), behind = bt__axpy (a, -bt__dot (a, t), t);
  bt_vec3 chord = bt__unit_or (bt__sub (x[i < n ? i + 1 : i], x[i > 0 ? i - 1 : i]), none),
          ahead = bt__axpy (wave, -bt__dot (wave, chord), chord);
  double half = 0.5 * 1025 * p->diameter, ma = 1025 * area * p->ca;
  add (all, bt__scale (-p->mass * cell, a));
  add (all, bt__scale (-ma * wet, behind));
  add (all, bt__scale (half * p->cdn * bt__norm (across) * wet, across));
  add (all, bt__scale (half * BT__PI * p->cdt * fabs (along) * along * wet, t));
  add (all, bt__scale (1025 * area * wet, wave));
  add (all, bt__scale (ma * wet, ahead));
  add (all, bt__vec (0, 0, -p->wet_weight * cell));
  add (all, bt__vec (0, 0, -fmax (0, p->mass * 9.81 - p->wet_weight) * out));
}

/* SHARE of lump L as if it were at node I.  */
static void
add_lump (const lot *l, const motion *m, const bt__dynamic_lump *lump, int i, double share,
          sum *all)
{
  bt_vec3 u, wave, x = bt__dynamic_x (l->s.d)[i];
  bt_water_motion (&l->s.water, x, &u, &wave);
  bt_vec3 rel = bt__sub (u, bt__dynamic_v (l->s.d)[i]);
  double lift = lump->mass * 9.81 - lump->wet_weight;
  add (all, bt__scale (-share * (lump->mass + lump->added), acceleration (l, m, i)));
  add (all, bt__scale (share * (lump->linear + lump->quadratic * bt__norm (rel)), rel));
  add (all, bt__vec (0, 0, -share * (lump->wet_weight + lift * out_of_water (l, x))));
  add (all, bt__scale (share, lump->force));
}

static void
add_lumps (const lot *l, const motion *m, sum *all)
{
  const double *rest = bt__dynamic_rest (l->s.d);
  for (int k = 0; k < l->s.in.n_lumps; k++)
    {
      double u = l->lump[k].from_end;
      int j = (int)l->s.d->n - 1;
      for (; j > 0 && u > rest[j]; j--)
        u -= rest[j];
      double before = fmin (u / rest[j], 1);
      add_lump (l, m, l->lump + k, j, before, all);
      add_lump (l, m, l->lump + k, j + 1, 1 - before, all);
    }
}

/* The forces at the ends less what acts on the line, as a share of all sizes.  */
static double
imbalance (const lot *l, const motion *m)
{
  sum all = { { 0, 0, 0 }, 0 };
  for (int i = 0; i <= l->s.d->n; i++)
    add_line (l, m, i, &all);
  add_lumps (l, m, &all);
  for (int k = 0; k < l->rows; k++)
    add (&all, l->row[k].force);
  add (&all, bt__scale (-1, l->s.d->pull[0]));
  add (&all, bt__scale (-1, l->s.d->pull[1]));
  return bt__norm (all.force) / all.size;
}

/* What is told of how hard it is pulled is no less than either end's.  */
static void
check_reports (const lot *l)
{
  for (int e = 0; e < 2; e++)
    {
      double pull = bt__norm (l->s.d->pull[e]);
      assert_true (l->s.report.tension >= pull);
      assert_close (bt__dynamic_node_tension (l->s.d, e ? (int)l->s.d->n : 0), pull, 0, "tension");
    }
}

/* The engine takes the water's motion where it expects a node, and the tangents of drag from the
   second iteration: of a step that needs more, or is solved the safe way, they are not those of the
   solution.  A half-space tells what it did in the last iteration.  */
static double
tolerance_of (const lot *l)
{
  return l->s.water.sea || l->floored ? 1e-3 : 1e-4;
}

static void
test_forces_balance (void **state)
{
  static lot l;
  static motion m;
  int looked = 0;
  (void)state;
  for (int which = 0; which < LINES; which++)
    {
      open_lot (&l, which);
      for (int k = 0; k < BEFORE; k++)
        step_lot (&l);
      for (int k = 1; k <= STEPS; k++)
        {
          size_t size = (size_t)(l.s.d->n + 1) * sizeof *m.v;
          memcpy (m.v, bt__dynamic_v (l.s.d), size);
          memcpy (m.vp, bt__dynamic_vp (l.s.d), size);
          m.history = l.s.d->history != 0;
          move_ends (&l, k * H);
          step_lot (&l);
          if (!l.s.report.converged || l.s.report.safeguarded)
            continue;
          double off = imbalance (&l, &m);
          looked++;
          if (!(off < tolerance_of (&l)))
            fail_msg ("line %d, step %d: %.3g of the forces is not balanced", which, k, off);
          check_reports (&l);
        }
      scene_close (&l.s);
    }
  assert_true (looked > LINES * STEPS / 2);
}

/* Lowe and Langley (2006): a jumper of 170 m with EI 120.8 kN m2, its force at the top at
   rest 11.40 kN across and 45.71 kN up.  Nothing pulls it sideways.  */
static void
test_jumper (void **state)
{
  scene s;
  bt_vec3 shape[3] = { { 0, 0, -5 }, { -40, 0, -95 }, { -100, 0, -55 } };
  bt_tether_props line
      = { .diameter = 0.396, .mass = 165, .ea = 5e8, .ei = 120.8e3, .cdn = 1, .ca = 1 };
  (void)state;
  line.wet_weight = (165 - 1000 * BT__PI * 0.396 * 0.396 / 4) * 9.807;
  scene_open (&s, line, 1000, 80, shape, 3, 170);
  s.water.gravity = 9.807;
  scene_settle (&s);
  const bt_vec3 *pull = s.d->pull;
  assert_close (pull[0].x / -1e3, 11.40, 0.005, "at the top, across, kN");
  assert_close (pull[0].z / -1e3, 45.71, 0.005, "at the top, up, kN");
  assert_close (pull[0].x + pull[1].x, 0, 1e-3, "both ends across, N");
  assert_close (pull[0].z + pull[1].z, -170 * line.wet_weight, 1e-3, "both ends up, N");
  scene_close (&s);
}

int
main (void)
{
  const struct CMUnitTest tests[] = {
    cmocka_unit_test (test_forces_balance),
    cmocka_unit_test (test_jumper),
  };
  return cmocka_run_group_tests (tests, NULL, NULL);
}
