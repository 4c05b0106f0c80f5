/* Without friction a taut line lies as the shortest way over what it touches does.

   Unrolled, the shortest way over a drum, a wire or an edge is straight: what it does along the
   axis is in proportion to its way across, and its length is that of the hypotenuse; over a ball it
   stays in the plane of its ends and the centre.  Across, it is two tangents and an arc of the
   radius made larger by the line's own.  The line is drawn tight between two places, first lying
   elsewhere; then its tension is EA (way / rest - 1) everywhere.  The line's own way is longer by
   what a polygon about a circle is: at most (link / radius)^2 / 12 of the arc.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include "contact_law.h"

#define TAUT 1e-3   /* how much shorter at rest than the way */
#define ASIDE 0.8   /* m: how far from the shortest way it is laid, along the axis */
#define SLACK 0.35  /* m: how much nearer its end is in the beginning */
#define MINUTE 1e-4 /* of the way: how much longer or shorter it is measured */

typedef enum body
{
  DRUM,
  WIRE,
  EDGE,
  BALL
} body;

/* Over a body at the origin, its axis along y, from A to B past the top.  */
typedef struct way
{
  const char *name;
  body what;
  double radius; /* m */
  bt_vec3 a, b;  /* m */
  double link;   /* m */
} way;

typedef struct taut
{
  reef reef;
  rope rope;
} taut;

static double
across (bt_vec3 p)
{
  return hypot (p.x, p.z);
}

/* Of the shortest way from A to B over the top of a circle of radius OUT about the y axis, or, for
   a ball, about the normal of the plane: its length across.  */
static double
length_across (double a, double b, double angle, double out)
{
  return sqrt (a * a - out * out) + sqrt (b * b - out * out)
         + out * (angle - acos (out / a) - acos (out / b));
}

/* Radians from A to B about the y axis, over the top.  */
static double
angle_over (bt_vec3 a, bt_vec3 b)
{
  double from = atan2 (a.z, a.x), to = atan2 (b.z, b.x);
  return (from < -BT__PI / 2 ? from + 2 * BT__PI : from) - to;
}

/* Radians the shortest way turns by.  */
static double
turn (const way *w, double out)
{
  double a = across (w->a), b = across (w->b);
  if (w->what == BALL)
    return acos (bt__dot (w->a, w->b) / (bt__norm (w->a) * bt__norm (w->b)))
           - acos (out / bt__norm (w->a)) - acos (out / bt__norm (w->b));
  return angle_over (w->a, w->b) - acos (out / a) - acos (out / b);
}

static double
shortest (const way *w, double out)
{
  double a = bt__norm (w->a), b = bt__norm (w->b);
  if (w->what == BALL)
    return length_across (a, b, acos (bt__dot (w->a, w->b) / (a * b)), out);
  double over = length_across (across (w->a), across (w->b), angle_over (w->a, w->b), out);
  return hypot (over, w->b.y - w->a.y);
}

static void
raise (const way *w, reef *r)
{
  bt_vec3 left = { 0, -6, 0 }, right = { 0, 6, 0 };
  assert_true (reef_open (r));
  if (w->what == DRUM)
    reef_cylinder (r, left, right, w->radius);
  else if (w->what == WIRE)
    reef_wire (r, left, right, w->radius);
  else if (w->what == BALL)
    reef_wire (r, bt__vec (-1e-7, 0, 0), bt__vec (1e-7, 0, 0), w->radius);
  else
    reef_box (r, bt__vec (-3, 0, -3), bt__vec (3, 6, 3), 0);
  assert_true (reef_raise (r));
}

/* Lay the line aside of the shortest way, slack; then draw it tight and let it come to rest.  */
static void
draw (const way *w, taut *t, double rest)
{
  double bulge = fmax (1.3 * w->radius, 0.6 * w->link + 0.02),
         aside = w->what == BALL ? 0.1 : ASIDE;
  bt_vec3 back = bt__scale (-SLACK, bt__unit_or (w->b, w->b)), mid = { 0, aside, bulge };
  mid.y += 0.5 * (w->a.y + w->b.y);
  bt_vec3 start = bt__add (w->b, back), left = mid, right = mid;
  left.x -= bulge;
  right.x += bulge;
  const bt_vec3 shape[] = { w->a, left, right, start };
  int n = (int)(rest / w->link + 0.5), steps = 360;
  assert_true (rope_open (&t->rope, &t->reef, n, shape, 4, rest, 0));
  t->rope.config.pull[1] = INFINITY;
  for (int i = 1; i <= 20 * steps; i++)
    {
      t->rope.in.end[1].at = bt__axpy (start, fmin ((double)i / steps, 1), bt__sub (w->b, start));
      assert_true (rope_step (&t->rope, frame, 0));
    }
}

/* The farthest any node is from where the shortest way has it, along the axis: unrolled it is
   straight; of a ball, from the plane.  */
static double
astray (const way *w, const bt__dynamic *d)
{
  const bt_vec3 *x = bt__dynamic_x (d);
  double whole = 0, sum = 0, worst = 0;
  bt_vec3 normal = bt__unit_or (bt__cross (w->a, w->b), w->a);
  for (int64_t i = 0; i < d->n; i++)
    whole += across (bt__sub (x[i + 1], x[i]));
  for (int64_t i = 1; i < d->n; i++)
    {
      sum += across (bt__sub (x[i], x[i - 1]));
      double y = w->a.y + (w->b.y - w->a.y) * sum / whole;
      worst = fmax (worst, fabs (w->what == BALL ? bt__dot (normal, x[i]) : x[i].y - y));
    }
  return worst;
}

static void
check (const way *w)
{
  static taut t;
  raise (w, &t.reef);
  double out = w->radius + 0.005, wanted = shortest (w, out), rest = (1 - TAUT) * wanted;
  draw (w, &t, rest);
  const double *f = bt__dynamic_tension (t.rope.d);
  double least = INFINITY, most = 0, ea = t.rope.line.ea, aside = astray (w, t.rope.d);
  for (int64_t i = 0; i < t.rope.d->n; i++)
    {
      least = fmin (least, f[i]);
      most = fmax (most, f[i]);
    }
  double way = rest * (1 + least / ea), part = fmin (w->link / out, turn (w, out));
  double more = part * part / 12 * turn (w, out) * out;
  print_message ("# %s, link %.2f m: %.5f m, exactly %.5f; %.2g m astray; tension %.3f to %.3f N; "
                 "%.1g m/s\n",
                 w->name, w->link, way, wanted, aside, least, most, t.rope.report.speed);
  assert_below (way, (1 + MINUTE) * wanted + more, "the length of the way");
  assert_below ((1 - MINUTE) * wanted, way, "the length of the shortest way");
  assert_below (most / least, 1.015, "the ripple of the tension along a line without friction");
  assert_below (aside, 0.005, "the distance from the shortest way");
  assert_kept (&t.rope, w->name);
  rope_close (&t.rope);
  reef_close (&t.reef);
}

static void
lies_straight_unrolled (void **state)
{
  (void)state;
  const way ways[] = {
    { "drum, links short", DRUM, 0.6, { -4, -1, -1 }, { 3, 1.5, -2 }, 0.06 },
    { "drum", DRUM, 0.6, { -4, -1, -1 }, { 3, 1.5, -2 }, 0.2 },
    { "drum, steep", DRUM, 0.3, { -2, -2, -1 }, { 2, 2, -1 }, 0.1 },
    { "wire, links short", WIRE, 0.02, { -3, -1, -1 }, { 3, 1.5, -2 }, 0.1 },
    { "wire", WIRE, 0.005, { -3, -1, -1 }, { 3, 1.5, -2 }, 0.5 },
    { "edge", EDGE, 0, { -4, -1, 0.3 }, { 0.4, 1.5, -3 }, 0.2 },
    { "edge, links long", EDGE, 0, { -4, -1, 0.3 }, { 0.4, 1.5, -3 }, 0.6 },
  };
  for (size_t i = 0; i < sizeof ways / sizeof *ways; i++)
    check (ways + i);
}

static void
stays_in_the_plane (void **state)
{
  (void)state;
  check (&(way){ "ball", BALL, 1, { -3, 0, 0.3 }, { 3, 0.4, 0.3 }, 0.1 });
  check (&(way){ "ball, links long", BALL, 1, { -3, 0, 0.3 }, { 3, 0.4, 0.3 }, 0.3 });
}

int
main (void)
{
  const struct CMUnitTest tests[]
      = { cmocka_unit_test (lies_straight_unrolled), cmocka_unit_test (stays_in_the_plane) };
  return cmocka_run_group_tests (tests, NULL, NULL);
}
