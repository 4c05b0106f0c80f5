/* Which links of a line could meet each other, or those of another line, in a step.

   Links that run along with the way from the first of them to the last, all of them and all the
   time, come no nearer to each other than the line between them is long in that direction: of a
   stretch that is straight so far no pair is asked.  For the rest there are boxes about links,
   about four links, eight, sixteen, and only where boxes meet is looked into them.

   What a look found serves until the line has turned or changed its shape by so much.  Of two
   places with M links between and with them, the one goes no farther against the other than M times
   the most that the two ends of any link do, nor farther than any two nodes do.  So a look lists
   the pairs that are nearer than what either may come to, and from then on no other can touch; of
   those listed all are passed over whose distance is not yet used up.  A line that goes along as a
   whole uses up nothing, and where nothing is listed a step costs one pass over the nodes.

   Which pairs are told never depends on when was looked, so that this saves time alone.

   There is room for so many pairs.  Where there are more the whole move is made shorter, until no
   more than there is room for can meet, or nothing moves, which is safe.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <string.h>

#include "contact/line_job.h"

enum
{
  LEAF = 4,    /* links in the smallest box */
  WAIT = 12,   /* steps after a look that found more than it could list */
  MANY = 4,    /* pairs listed, a link: then it is looked less far, ... */
  FEW = 1,     /* ... and if fewer farther */
  SHORTER = 12 /* times a move is halved for want of room */
};

#define ALONG 0.25 /* of a rest length: a link that goes so far in a direction goes along */
#define UNDER 0.96 /* of that: what such links must keep */
#define TURN 0.5   /* of a piece: what the ends of a link may go apart until the next look, ... */
#define LEAST_TURN 0.1 /* ... at most and at least */
#define WAY 8.0        /* the same of any two nodes */
#define LEAST_WAY 0.5
#define FARTHER 1.4 /* times as far at the next look */
#define SPARE 0.2   /* of a piece: the most of what a line is said to be clear by */
#define WITHIN 0.02 /* of what links must keep: nearer, and they are within each other */
#define CLOSE 1e-6  /* for rounding */

double
bt__self_floor (const bt__line_job *k, uint32_t i, uint32_t j)
{
  return fmin (2 * k->core, UNDER * ALONG * (k->w->from_end[i + 1] - k->w->from_end[j]));
}

/* Links that start nearer may come nearer yet by half, so that they can get away from each other,
   but not through.  Those that start within each other may do as they like.  */
double
bt__self_lowered (double floor, double distance)
{
  double least = WITHIN * floor;
  return distance >= floor ? floor : distance > least ? fmax (0.5 * distance, least) : 0;
}

bt__witness
bt__self_witness (const bt__link *a, const bt__link *b)
{
  bt__capsule axis = { b->a, b->b, 0 };
  bt__witness w;
  bt__pair_capsule (&axis, a, &w);
  return w;
}

/* ---- Boxes ---- */

/* The links of one of two lines, and boxes about them: box 1 about all, of box T the halves 2T and
   2T + 1.  */
typedef struct side
{
  const bt_vec3 *x;
  const double *reach; /* of each link; NULL: THICK */
  double thick;
  bt__aabb *box;
  int links, span; /* links, and how many box 1 could hold */
} side;

/* What box T holds: links FROM to TO, less one.  */
typedef struct part
{
  int t, from, span;
} part;

static int
end_of (const side *s, part p)
{
  return p.from + p.span < s->links ? p.from + p.span : s->links;
}

static part
half_of (part p, int second)
{
  return (part){ 2 * p.t + second, p.from + second * p.span / 2, p.span / 2 };
}

static double
reach_of (const side *s, int j)
{
  return s->reach ? s->reach[j] : s->thick;
}

static double
lower (double a, double b)
{
  return a < b ? a : b;
}

static double
higher (double a, double b)
{
  return a > b ? a : b;
}

static void
add_point (bt__aabb *b, bt_vec3 p, double more)
{
  b->lo = bt__vec (lower (b->lo.x, p.x - more), lower (b->lo.y, p.y - more),
                   lower (b->lo.z, p.z - more));
  b->hi = bt__vec (higher (b->hi.x, p.x + more), higher (b->hi.y, p.y + more),
                   higher (b->hi.z, p.z + more));
}

static const bt__aabb none
    = { { INFINITY, INFINITY, INFINITY }, { -INFINITY, -INFINITY, -INFINITY } };

static void
fill_boxes (side *s, part p)
{
  bt__aabb b = none;
  int to = end_of (s, p);
  if (p.span > LEAF && p.from < to)
    {
      part one = half_of (p, 0), two = half_of (p, 1);
      fill_boxes (s, one);
      fill_boxes (s, two);
      b = s->box[one.t];
      add_point (&b, s->box[two.t].lo, 0);
      add_point (&b, s->box[two.t].hi, 0);
      if (two.from >= to)
        b = s->box[one.t];
    }
  else
    for (int j = p.from; j < to; j++)
      {
        add_point (&b, s->x[j], reach_of (s, j));
        add_point (&b, s->x[j + 1], reach_of (s, j));
      }
  s->box[p.t] = b;
}

static int
are_apart (const bt__aabb *a, const bt__aabb *b)
{
  return a->hi.x < b->lo.x || a->lo.x > b->hi.x || a->hi.y < b->lo.y || a->lo.y > b->hi.y
         || a->hi.z < b->lo.z || a->lo.z > b->hi.z;
}

static part
whole (side *s)
{
  s->span = LEAF;
  while (s->span < s->links)
    s->span *= 2;
  return (part){ 1, 0, s->span };
}

/* How near touches, from the axis of the line on.  */
static double
touching (const bt__line_job *k)
{
  return k->config->radius + k->margin / 2;
}

/* ---- The search ---- */

typedef struct search
{
  bt__line_job *k;
  side own, its;
  const double *move; /* how far each node goes */
  int strand;         /* of ITS, -1: the line itself */
  enum
  {
    PAIRS, /* list what can meet */
    KNOWN, /* list what can meet until the next look */
    SPARED /* how far may each node go? */
  } what;
  double spare;
  int dropped;
} search;

/* The distance of the axes of A and B.  */
static double
distance_of (const bt__link *a, const bt__link *b)
{
  double u, v;
  bt_vec3 d = bt__sub (a->b, a->a), e = bt__sub (b->b, b->a), r = bt__sub (a->a, b->a);
  bt__closest_segments (r, d, e, &u, &v);
  return bt__norm (bt__axpy (bt__axpy (r, u, d), -v, e));
}

/* Nonzero if links FROM to TO, less one, go along with the chord of all of them, wherever they
 * move.
 */
static int
is_straight (const search *s, int from, int to)
{
  const bt_vec3 *x = s->own.x;
  const double *rest = bt__dynamic_rest (s->k->d);
  bt_vec3 u = bt__unit_or (bt__sub (x[to], x[from]), bt__vec (0, 0, 0));
  double before = bt__dot (u, x[from]);
  for (int j = from; j < to; j++)
    {
      double after = bt__dot (u, x[j + 1]);
      if (!(after - before - s->move[j] - s->move[j + 1] >= ALONG * rest[j]))
        return 0;
      before = after;
    }
  return 1;
}

/* Add links I of the own side and J of the other, if they can meet.  */
static void
add_pair (search *s, int i, int j)
{
  bt__line_job *k = s->k;
  bt__self *all = &k->w->self;
  bt__link a = bt__line_link (s->own.x, (uint32_t)i), b = bt__line_link (s->its.x, (uint32_t)j);
  double reach = reach_of (&s->own, i) + reach_of (&s->its, j);
  k->report->pairs++;
  if (!(distance_of (&a, &b) <= reach))
    return;
  if (all->pairs == all->room)
    {
      s->dropped++;
      return;
    }
  bt__self_pair *p = all->pair + all->pairs++;
  *p = (bt__self_pair){ .i = (uint32_t)i, .j = (uint32_t)j, .strand = s->strand };
  p->w = bt__self_witness (&a, &b);
  p->floor = s->strand < 0 ? bt__self_floor (k, p->i, p->j)
                           : k->core + k->config->strand[s->strand].core * (1 + CLOSE);
  k->report->overlaps += p->w.distance < p->floor;
  p->floor = bt__self_lowered (p->floor, p->w.distance);
}

/* How far links I and J may come toward each other until the next look.  */
static double
toward (uint32_t i, uint32_t j, double turned, double apart)
{
  return lower ((double)(j + 1 - i) * turned, apart);
}

static void
add_known (search *s, int i, int j)
{
  bt__line_job *k = s->k;
  bt__self *self = &k->w->self;
  bt__link a = bt__line_link (s->own.x, (uint32_t)i), b = bt__line_link (s->its.x, (uint32_t)j);
  double clear = distance_of (&a, &b) - 2 * touching (k);
  k->report->pairs++;
  if (clear > toward ((uint32_t)i, (uint32_t)j, self->turn, self->way))
    return;
  self->least = lower (self->least, clear);
  self->least_turn = lower (self->least_turn, clear / (j + 1 - i));
  if (self->knowns == self->room)
    s->dropped++;
  else
    self->known[self->knowns++] = (bt__self_known){ (uint32_t)i, (uint32_t)j, clear };
}

static void
look_at (search *s, int i, int j)
{
  if (s->what == PAIRS)
    add_pair (s, i, j);
  else if (s->what == KNOWN)
    add_known (s, i, j);
  else
    {
      bt__link a = bt__line_link (s->own.x, (uint32_t)i), b = bt__line_link (s->its.x, (uint32_t)j);
      double near = s->strand < 0 ? touching (s->k) : s->its.thick;
      s->spare = fmin (s->spare, 0.5 * (distance_of (&a, &b) - touching (s->k) - near));
    }
}

/* Parts P of the one and Q of the other, which in the same line comes after it.  */
static void
look_between (search *s, part p, part q)
{
  int a = end_of (&s->own, p), b = end_of (&s->its, q);
  if (p.from >= a || q.from >= b || are_apart (s->own.box + p.t, s->its.box + q.t))
    return;
  int near = s->strand < 0 && q.from - a <= 2 * (p.span + q.span);
  if (near && is_straight (s, p.from, b))
    return;
  if (p.span == LEAF && q.span == LEAF)
    {
      for (int i = p.from; i < a; i++)
        for (int j = s->strand < 0 && q.from < i + 2 ? i + 2 : q.from; j < b; j++)
          look_at (s, i, j);
      return;
    }
  for (int h = 0; h < 2; h++)
    if (p.span >= q.span)
      look_between (s, half_of (p, h), q);
    else
      look_between (s, p, half_of (q, h));
}

static void
look_within (search *s, part p)
{
  int to = end_of (&s->own, p);
  if (p.from >= to || is_straight (s, p.from, to))
    return;
  if (p.span > LEAF)
    {
      look_within (s, half_of (p, 0));
      look_within (s, half_of (p, 1));
      look_between (s, half_of (p, 0), half_of (p, 1));
      return;
    }
  for (int i = p.from; i < to; i++)
    for (int j = i + 2; j < to; j++)
      look_at (s, i, j);
}

/* ---- One line ---- */

static void
measure (bt__line_job *k)
{
  const double *rest = bt__dynamic_rest (k->d);
  double *from_end = k->w->from_end;
  from_end[k->links] = 0;
  for (int j = k->links - 1; j >= 0; j--)
    from_end[j] = from_end[j + 1] + rest[j];
}

static side
side_of (const bt__line_job *k, int strand)
{
  const bt__strand *o = strand < 0 ? NULL : k->config->strand + strand;
  if (!o)
    return (side){ .x = k->x, .reach = k->w->self.reach, .box = k->w->self.box, .links = k->links };
  return (side){ .x = bt__dynamic_x (o->line),
                 .thick = fmax (o->radius + k->margin / 2, o->core),
                 .box = k->w->self.its,
                 .links = (int)o->line->n };
}

/* Ask the line, whose nodes go as far as MOVE says and whose links look as far as their REACH.  */
static int
look_at_itself (bt__line_job *k, search *s)
{
  part all = whole (&s->own);
  s->its = s->own;
  s->strand = -1;
  if (!k->config->itself || is_straight (s, 0, k->links))
    return 0;
  fill_boxes (&s->own, all);
  look_within (s, all);
  return s->dropped;
}

static int
look_at_others (bt__line_job *k, search *s)
{
  if (k->config->strands == 0)
    return 0;
  part all = whole (&s->own);
  fill_boxes (&s->own, all);
  for (int i = 0; i < k->config->strands; i++)
    {
      s->its = side_of (k, i);
      s->strand = i;
      part other = whole (&s->its);
      fill_boxes (&s->its, other);
      look_between (s, all, other);
    }
  return s->dropped;
}

/* ---- What is known of a line and itself ---- */

/* Look; zero if there was more than room for it.  */
static int
look_once (bt__line_job *k)
{
  bt__self *self = &k->w->self;
  search s = { .k = k, .own = side_of (k, -1), .move = self->move, .what = KNOWN };
  self->knowns = 0;
  self->least = self->least_turn = INFINITY;
  for (int i = 0; i <= k->links; i++)
    self->move[i] = 0.5 * self->turn;
  for (int j = 0; j < k->links; j++)
    self->reach[j] = touching (k) + 0.5 * self->way;
  look_at_itself (k, &s);
  return s.dropped == 0;
}

/* How far to look: farther by what was used up, if few pairs were listed, and less far by what was
   not.  */
static double
suited (double was, double used, int few, double least, double most)
{
  double next = used >= was ? few ? FARTHER * was : was : used < 0.5 * was ? was / FARTHER : was;
  return fmin (fmax (next, least), most);
}

static void
look (bt__line_job *k)
{
  bt__self *self = &k->w->self;
  double piece = k->d->piece;
  int few = 2 * self->knowns < k->links;
  self->turn = suited (self->turn, self->drift.turned, few, LEAST_TURN * piece, TURN * piece);
  self->way = suited (self->way, self->drift.apart, few, LEAST_WAY * piece, WAY * piece);
  self->still = 0;
  while (!look_once (k) && self->way > LEAST_WAY * piece)
    self->way *= 0.5;
  self->wait = self->knowns == self->room ? WAIT : 0;
  self->drift = (bt__dynamic_drift){ 0 };
  if (self->wait > 0)
    return;
  self->still = k->links + 1;
  memcpy (self->stood, k->x, (size_t)self->still * sizeof *k->x);
}

/* How the line at X differs from how it was looked at.  Nonzero if what is known still holds.  */
static int
is_known (const bt__line_job *k, const bt_vec3 *x, bt__dynamic_drift *drift)
{
  const bt__self *self = &k->w->self;
  bt__dynamic_drifted (x, self->stood, self->still, drift);
  drift->turned *= 1 + CLOSE;
  drift->apart *= 1 + CLOSE;
  return drift->turned < self->turn && drift->apart < self->way;
}

/* Nonzero if the line is looked at, or was and still is as then.  */
static int
know (bt__line_job *k)
{
  bt__self *self = &k->w->self;
  if (k->resumes && self->went && self->still == k->links + 1)
    self->drift = self->gone;
  else if (self->still == k->links + 1 && is_known (k, k->x, &self->drift))
    ;
  else if (self->still > 0 || self->wait == 0)
    look (k);
  else
    self->wait--;
  self->went = 0;
  return self->still > 0;
}

/* Nonzero if none of the listed pairs can touch before the line differs by more than DRIFT.  */
static int
none_touches (const bt__self *self, const bt__dynamic_drift *drift)
{
  return drift->apart < self->least || drift->turned < self->least_turn;
}

/* ---- Lists ---- */

/* List the pairs of the line itself that can meet while its links look as far as their REACH, and
   its nodes go no farther than MOVE; if SURE of what is known, which lasts to DRIFT.  */
static int
list_itself (bt__line_job *k, search *s, const bt__dynamic_drift *drift)
{
  const bt__self *self = &k->w->self;
  if (!k->config->itself)
    return 0;
  if (!drift)
    return look_at_itself (k, s);
  s->its = s->own;
  s->strand = -1;
  for (int n = 0; n < self->knowns; n++)
    {
      const bt__self_known *p = self->known + n;
      if (p->clear <= toward (p->i, p->j, drift->turned, drift->apart))
        add_pair (s, (int)p->i, (int)p->j);
    }
  return s->dropped;
}

/* About where the line is and where it is to go, as far as its links look.  */
static bt__aabb
way_of (const bt__line_job *k, const bt_vec3 *to)
{
  bt__aabb b = none;
  for (int i = 0; i <= k->links; i++)
    {
      add_point (&b, k->x[i], touching (k));
      if (to)
        add_point (&b, to[i], touching (k));
    }
  return b;
}

/* Nonzero if no other line is where this one is and is to go.  */
static int
are_others_far (const bt__line_job *k, const bt_vec3 *to)
{
  if (k->config->strands == 0)
    return 1;
  bt__aabb own = way_of (k, to);
  for (int i = 0; i < k->config->strands; i++)
    {
      side s = side_of (k, i);
      bt__aabb b = none;
      for (int j = 0; j <= s.links; j++)
        add_point (&b, s.x[j], s.thick);
      if (!are_apart (&b, &own))
        return 0;
    }
  return 1;
}

/* List the pairs that could meet while the nodes go no farther than MOVE says, on their way TO;
   DRIFT: what is known holds that long.  Zero if there is no room for all.  */
static int
list (bt__line_job *k, const bt_vec3 *to, const bt__dynamic_drift *drift)
{
  bt__self *self = &k->w->self;
  search s = { .k = k, .own = side_of (k, -1), .move = self->move };
  self->pairs = 0;
  if (!drift || self->knowns > 0 || k->config->strands > 0)
    measure (k);
  for (int j = 0; j < k->links; j++)
    self->reach[j] = higher (touching (k), k->core + higher (self->move[j], self->move[j + 1]));
  return list_itself (k, &s, drift) == 0 && (are_others_far (k, to) || look_at_others (k, &s) == 0);
}

/* ---- A step ---- */

int
bt__self_watch (bt__line_job *k)
{
  bt__self *self = &k->w->self;
  if (self->asked)
    return self->pairs > 0;
  self->asked = 1;
  self->pairs = 0;
  if (!bt__self_counts (k))
    return 0;
  int known = !k->config->itself || know (k);
  if (known && (!k->config->itself || none_touches (self, &self->drift))
      && are_others_far (k, NULL))
    return 0;
  memset (self->move, 0, (size_t)(k->links + 1) * sizeof *self->move);
  list (k, NULL, known ? &self->drift : NULL); /* of what finds no room there is no row */
  return self->pairs > 0;
}

/* What is known to hold for all of the proposed move, or NULL: a straight move differs from how the
   line was looked at by no more than its ends do.  */
static const bt__dynamic_drift *
know_move (const bt__line_job *k, bt__dynamic_drift *drift)
{
  const bt__self *self = &k->w->self;
  if (!k->config->itself)
    return drift;
  drift->turned = self->drift.turned + 2 * k->stride;
  drift->apart = self->drift.apart + 2 * k->stride;
  if (self->still == k->links + 1 && drift->turned < self->turn && drift->apart < self->way)
    return drift;
  if (self->still != k->links + 1 || !is_known (k, k->X, drift))
    return NULL;
  drift->turned = higher (drift->turned, self->drift.turned);
  drift->apart = higher (drift->apart, self->drift.apart);
  return drift;
}

/* Nonzero if no two links can meet in the proposed move, those of P apart.  */
static int
goes_clear (const bt__line_job *k, const bt__self_known *p)
{
  bt__link a = bt__line_link (k->x, p->i), b = bt__line_link (k->x, p->j);
  double most = 0, gap = distance_of (&a, &b);
  for (uint32_t n = 0; n < 2; n++)
    {
      most = fmax (most, bt__distance (k->x[p->i + n], k->X[p->i + n]));
      most = fmax (most, bt__distance (k->x[p->j + n], k->X[p->j + n]));
    }
  return gap > 2 * (k->core + most * (1 + CLOSE)) * (1 + CLOSE);
}

static int
is_listed (const bt__self *self, const bt__self_known *p)
{
  for (int n = 0; n < self->pairs && self->pair[n].strand < 0; n++)
    if (self->pair[n].i == p->i && self->pair[n].j == p->j)
      return 1;
  return 0;
}

/* Nonzero if what is not listed cannot meet while the line differs by no more than DRIFT.  */
static int
others_go_clear (const bt__line_job *k, const bt__dynamic_drift *drift)
{
  const bt__self *self = &k->w->self;
  if (!k->config->itself || none_touches (self, drift))
    return 1;
  for (int n = 0; n < self->knowns; n++)
    {
      const bt__self_known *p = self->known + n;
      if (p->clear <= toward (p->i, p->j, drift->turned, drift->apart) && !goes_clear (k, p)
          && !is_listed (self, p))
        return 0;
    }
  return 1;
}

int
bt__self_stays_far (const bt__line_job *k)
{
  bt__self *self = &k->w->self;
  if (!bt__self_counts (k))
    return 1;
  self->gone = (bt__dynamic_drift){ 0 };
  if (!know_move (k, &self->gone))
    return 0;
  if (!others_go_clear (k, &self->gone) || !are_others_far (k, k->X))
    return 0;
  self->went = k->config->itself;
  return 1;
}

static void
shorten (bt__line_job *k, double share)
{
  for (int i = 0; i <= k->links; i++)
    k->X[i] = bt__axpy (k->x[i], share, bt__sub (k->X[i], k->x[i]));
}

void
bt__self_watch_moves (bt__line_job *k)
{
  bt__self *self = &k->w->self;
  bt__dynamic_drift drift = { 0 };
  if (bt__self_stays_far (k))
    return;
  for (int n = 0;; n++)
    {
      for (int i = 0; i <= k->links; i++)
        self->move[i] = bt__distance (k->x[i], k->X[i]) * (1 + CLOSE);
      if (list (k, k->X, know_move (k, &drift)))
        return;
      k->report->overflows++;
      shorten (k, n < SHORTER ? 0.5 : 0);
      if (n >= SHORTER)
        return;
    }
}

/* ---- Asked apart from a step ---- */

double
bt__self_spare (bt__line_job *k)
{
  bt__self *self = &k->w->self;
  double most = SPARE * k->d->piece;
  search s = { .k = k, .own = side_of (k, -1), .move = self->move, .what = SPARED, .spare = most };
  for (int i = 0; i <= k->links; i++)
    self->move[i] = most;
  for (int j = 0; j < k->links; j++)
    self->reach[j] = touching (k) + most;
  measure (k);
  look_at_itself (k, &s);
  look_at_others (k, &s);
  return fmax (s.spare, 0);
}
