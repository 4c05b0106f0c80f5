/* How far the parts of a line may move against each other before any two of its links can touch.

   The answer is a pair of ways: the motion of the ends of a link against each other, and of any two
   places against each other.  For two links with M links between and including them, the relative
   motion is at most M times the first way, and at most the second.

   Links running along with the direction from the first to the last of them come together only by
   turning back.  The rest of the line is halved again and again; each part is a chord and a radius
   that contains its nodes, and two parts with their chords far apart against their radii are not
   opened.

   The answer depends on the place of the line alone, because it is kept in the line's state.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include "contact/self_search.h"

enum
{
  LEAF = 4,   /* links in the smallest part */
  FEWEST = 3, /* links between, up to which the first way counts: so many ... */
  FEW = 16    /* ... or as many as the ratio of the two ways in the last motion */
};

#define LEAST 0.3  /* of a rest length: a link that soon turns back is of no stretch */
#define ROUGH 0.25 /* of their distance: parts that are so thin are not halved */

/* Links FROM to TO, less one, and the index of their chord.  */
typedef struct part
{
  int at, from, to;
} part;

typedef struct look
{
  const bt__line_job *k;
  bt__capsule *chord; /* of each part: its radius is how far its nodes are from it, at most */
  double keep;        /* m: axes farther apart do not touch */
  int few;            /* see FEW */
  double turned, apart;
} look;

static void
lower (double *a, double b)
{
  *a = bt__self_lower (*a, b);
}

/* ---- Parts ---- */

static part
half_part (part p, int second)
{
  int middle = p.from + (p.to - p.from + 1) / 2;
  return (part){ 2 * p.at + second, second ? middle : p.from, second ? p.to : middle };
}

static int
is_leaf (part p)
{
  return p.to - p.from <= LEAF;
}

static double
distance_to (bt_vec3 p, const bt__capsule *chord)
{
  bt_vec3 d = bt__sub (chord->b, chord->a), r = bt__sub (p, chord->a);
  double t = bt__share (bt__dot (r, d), bt__dot (d, d));
  return bt__norm (bt__axpy (r, -t, d));
}

static void
measure_parts (look *s, part p)
{
  const bt_vec3 *x = s->k->x;
  bt__capsule *c = s->chord + p.at;
  *c = (bt__capsule){ x[p.from], x[p.to], 0 };
  if (is_leaf (p))
    {
      for (int i = p.from + 1; i < p.to; i++)
        c->radius = bt__self_higher (c->radius, distance_to (x[i], c));
      return;
    }
  part one = half_part (p, 0), two = half_part (p, 1);
  measure_parts (s, one);
  measure_parts (s, two);
  c->radius = distance_to (x[one.to], c)
              + bt__self_higher (s->chord[one.at].radius, s->chord[two.at].radius);
}

/* ---- What is told ---- */

/* True if links FROM to TO, less one, run along with their chord by a margin; the margin is noted
   as a way of the first kind.  */
static int
is_stretch (look *s, int from, int to)
{
  const bt_vec3 *x = s->k->x;
  const double *rest = bt__dynamic_rest (s->k->d);
  bt_vec3 u = bt__unit_or (bt__sub (x[to], x[from]), bt__vec (0, 0, 0));
  double before = bt__dot (u, x[from]), most = INFINITY;
  for (int j = from; j < to; j++)
    {
      double after = bt__dot (u, x[j + 1]);
      double turns = after - before - BT__SELF_ALONG * rest[j];
      if (!(turns > LEAST * rest[j]))
        return 0;
      most = bt__self_lower (most, turns);
      before = after;
    }
  lower (&s->turned, most);
  return 1;
}

/* Links I and J, or parts from I to J, are nearer by no more than GAP until they touch.  */
static void
tell (look *s, int i, int j, double gap)
{
  int links = j + 1 - i;
  if (links <= s->few)
    lower (&s->turned, gap / links);
  else
    lower (&s->apart, gap);
}

/* A gap larger than this between links I to J would not lower the ways noted already.  */
static double
told (const look *s, int i, int j)
{
  return j + 1 - i <= s->few ? s->few * s->turned : s->apart;
}

/* True if chords from A to B and from C to D are seen to be GAP apart from the line through
   their middles.  */
static int
are_seen_apart (bt_vec3 a, bt_vec3 b, bt_vec3 c, bt_vec3 d, double gap)
{
  bt_vec3 r = bt__sub (bt__add (a, b), bt__add (c, d)); /* twice */
  double square = bt__dot (r, r);
  double clear = square - fabs (bt__dot (bt__sub (b, a), r)) - fabs (bt__dot (bt__sub (d, c), r));
  return clear > 0 && clear * clear > 4 * gap * gap * square;
}

static void
look_at_links (look *s, part p, part q)
{
  for (int i = p.from; i < p.to; i++)
    for (int j = q.from < i + 2 ? i + 2 : q.from; j < q.to; j++)
      {
        const bt_vec3 *x = s->k->x;
        if (are_seen_apart (x[i], x[i + 1], x[j], x[j + 1], told (s, i, j) + s->keep))
          continue;
        bt__link a = bt__link_of (x, (uint32_t)i), b = bt__link_of (x, (uint32_t)j);
        s->k->report->pairs++;
        tell (s, i, j, bt__self_distance (&a, &b) - s->keep);
      }
}

/* Part P and part Q, which comes after it.  */
static void
measure_between (look *s, part p, part q)
{
  const bt__capsule *a = s->chord + p.at, *b = s->chord + q.at;
  bt__link c = { a->a, a->b }, d = { b->a, b->b };
  double thick = a->radius + b->radius, enough = told (s, p.from, q.to - 1) + thick + s->keep;
  if (are_seen_apart (a->a, a->b, b->a, b->b, enough))
    return;
  double distance = bt__self_distance (&c, &d), gap = distance - thick - s->keep;
  if (distance >= enough)
    return;
  if (p.to == q.from && is_stretch (s, p.from, q.to))
    return;
  if (thick <= ROUGH * distance && gap > 0)
    {
      tell (s, p.from, q.to - 1, gap);
      return;
    }
  if (is_leaf (p) && is_leaf (q))
    {
      look_at_links (s, p, q);
      return;
    }
  int first = q.to - q.from <= p.to - p.from; /* the longer of them is halved, the near end first */
  for (int h = 0; h < 2; h++)
    if (first)
      measure_between (s, half_part (p, !h), q);
    else
      measure_between (s, p, half_part (q, h));
}

static void measure_within (look *s, part p);

static void
look_into (look *s, part p)
{
  if (is_leaf (p))
    {
      look_at_links (s, p, p);
      return;
    }
  part one = half_part (p, 0), two = half_part (p, 1);
  measure_within (s, one);
  measure_within (s, two);
  measure_between (s, one, two);
}

static void
measure_within (look *s, part p)
{
  if (!is_stretch (s, p.from, p.to))
    look_into (s, p);
}

void
bt__self_look (const bt__line_job *k, double *turned, double *apart)
{
  part all = { 1, 0, k->links };
  const bt__dynamic_drift *step = &k->d->step;
  double piece = BT__SELF_PIECES * k->d->piece,
         few = step->turned > 0 ? step->apart / step->turned : FEW;
  look s = { .k = k,
             .chord = k->w->self.chord,
             .keep = 2 * bt__self_touching (k),
             .few = (int)bt__clamp (few, FEWEST, FEW),
             .turned = piece,
             .apart = piece };
  if (!is_stretch (&s, 0, k->links))
    {
      measure_parts (&s, all);
      look_into (&s, all);
    }
  *turned = (1 - BT__MARGIN) * s.turned;
  *apart = (1 - BT__MARGIN) * s.apart;
}
