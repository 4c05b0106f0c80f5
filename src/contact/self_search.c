/* Which links of a line, or of two, are near each other.

   Links that run along with the way from the first of them to the last, all of them and all the
   time, come no nearer to each other than the line between them is long in that direction: of a
   stretch that is straight so far no pair is asked.  The search is told how far nodes may move; the
   farther, the fewer stretches are straight so far, but contacts are looked for on the
   stretches alone that are not straight as they lie.  For the rest there are boxes about links,
   about four links, eight, sixteen, and only boxes that meet are opened.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include "contact/self_search.h"

enum
{
  LEAF = 4 /* links in the smallest box */
};

/* Metres of line O from link J to end E; counted anew, for a line far from itself has not noted how
   far the nodes are from the end.  */
static double
way_to_end (const bt__dynamic *o, uint32_t j, int e)
{
  const double *rest = bt__dynamic_rest (o);
  double sum = 0;
  for (int64_t q = e ? j + 1 : 0; q < (e ? o->n : (int64_t)j); q++)
    sum += rest[q];
  return sum;
}

double
bt__self_between (const bt__line_job *k, int strand, uint32_t i, uint32_t j)
{
  const double *from_end = k->w->from_end;
  double least = INFINITY;
  if (strand < 0)
    return from_end[i + 1] - from_end[j];
  const bt__strand *o = k->config->strand + strand;
  for (int e = 0; e < 2; e++)
    if (o->shared[e])
      least = fmin (least, way_to_end (k->d, i, e) + way_to_end (o->line, j, o->shared[e] - 1));
  return least;
}

double
bt__self_floor (const bt__line_job *k, int strand, uint32_t i, uint32_t j)
{
  double other = strand < 0 ? k->core : k->config->strand[strand].core * (1 + BT__MARGIN);
  return fmin (k->core + other, BT__SELF_ALONG * bt__self_between (k, strand, i, j));
}

/* True if links I and J of two lines meet at an end that the lines share, as neighbours in one line
   meet at their node.  */
static int
are_neighbours (const bt__self_search *s, int i, int j)
{
  return s->strand >= 0 && !(bt__self_between (s->k, s->strand, (uint32_t)i, (uint32_t)j) > 0);
}

/* Links that start nearer may come nearer yet by half, and so get away, but not through.  Links
   that start nearer than a cast comes overlap, and are free.  */
double
bt__self_lowered (double floor, double distance)
{
  double least = BT__CAST_NEAR * floor;
  return distance >= floor ? floor : distance > least ? fmax (0.5 * distance, least) : 0;
}

/* ---- Boxes ---- */

/* What box T holds: links FROM to TO, less one.  */
typedef struct part
{
  int t, from, span;
} part;

static int
end_of (const bt__self_side *s, part p)
{
  return p.from + p.span < s->links ? p.from + p.span : s->links;
}

static part
half_stretch (part p, int second)
{
  return (part){ 2 * p.t + second, p.from + second * p.span / 2, p.span / 2 };
}

static double
search_reach (const bt__self_side *s, int j)
{
  return s->reach ? s->reach[j] : s->thick;
}

static void
fill_boxes (bt__self_side *s, part p)
{
  bt__aabb b = bt__no_box;
  int to = end_of (s, p);
  if (p.span > LEAF && p.from < to)
    {
      part one = half_stretch (p, 0), two = half_stretch (p, 1);
      fill_boxes (s, one);
      fill_boxes (s, two);
      b = s->box[one.t];
      bt__self_add_point (&b, s->box[two.t].lo, 0);
      bt__self_add_point (&b, s->box[two.t].hi, 0);
      if (two.from >= to)
        b = s->box[one.t];
    }
  else
    for (int j = p.from; j < to; j++)
      {
        bt__self_add_point (&b, s->x[j], search_reach (s, j));
        bt__self_add_point (&b, s->x[j + 1], search_reach (s, j));
      }
  s->box[p.t] = b;
}

static part
whole (bt__self_side *s)
{
  s->span = LEAF;
  while (s->span < s->links)
    s->span *= 2;
  return (part){ 1, 0, s->span };
}

/* ---- The search ---- */

double
bt__self_distance (const bt__link *a, const bt__link *b)
{
  double u, v;
  bt_vec3 d = bt__sub (a->b, a->a), e = bt__sub (b->b, b->a), r = bt__sub (a->a, b->a);
  bt__closest_segments (r, d, e, &u, &v);
  return bt__norm (bt__axpy (bt__axpy (r, u, d), -v, e));
}

/* True if parts P and Q, which comes after it, may be of one straight stretch of the line.  */
static int
are_of_stretch (const bt__self_search *s, part p, part q)
{
  return s->strand < 0 && q.from - end_of (&s->own, p) <= 2 * (p.span + q.span);
}

/* How far nodes FROM and TO may go apart.  */
static double
parting (const bt__self_search *s, int from, int to)
{
  const bt__self *self = &s->k->w->self;
  return s->what == BT__SELF_KNOWN
             ? bt__self_toward ((uint32_t)from, (uint32_t)to - 1, self->turn, self->way)
             : s->move[from] + s->move[to];
}

/* True if links FROM to TO, less one, go along with the chord of all of them, wherever their nodes
   go within SHARE of their moves, with which the chord turns, too.  */
static int
is_straight (const bt__self_search *s, double share, int from, int to)
{
  const bt_vec3 *x = s->own.x;
  const double *rest = bt__dynamic_rest (s->k->d);
  bt_vec3 chord = bt__sub (x[to], x[from]), u = bt__unit_or (chord, bt__vec (0, 0, 0));
  double length = bt__dot (chord, u), ends = share * parting (s, from, to);
  double turn = ends > 0 ? ends / (length - ends) : 0;
  if (!(ends < length))
    return 0;
  for (int j = from; j < to; j++)
    {
      bt_vec3 link = bt__sub (x[j + 1], x[j]);
      double lost = share * (s->move[j] + s->move[j + 1]);
      double turned = turn > 0 ? turn * (bt__norm (link) + lost) : 0;
      if (!(bt__dot (u, link) - lost - turned >= BT__SELF_TELLS * rest[j]))
        return 0;
    }
  return 1;
}

static part
half_with (part p, int link)
{
  return half_stretch (p, link >= p.from + p.span / 2);
}

/* True if links I and J of the line are on a stretch that is straight as long as nothing moves.
   Which stretches a search passes over depends on the moves it allows for: a pair that another
   search would have passed over is no contact, however near its links are.  */
static int
are_along (const bt__self_search *s, int i, int j)
{
  bt__self_side side = s->own;
  part p = whole (&side), q = p;
  while (p.t == q.t)
    {
      if (is_straight (s, 0, p.from, end_of (&side, p)))
        return 1;
      if (p.span == LEAF)
        return 0;
      q = half_with (p, j);
      p = half_with (p, i);
    }
  while (!are_of_stretch (s, p, q) || !is_straight (s, 0, p.from, end_of (&side, q)))
    {
      if (p.span == LEAF && q.span == LEAF)
        return 0;
      if (p.span >= q.span)
        p = half_with (p, i);
      else
        q = half_with (q, j);
    }
  return 1;
}

void
bt__self_add (bt__self_search *s, int i, int j)
{
  bt__line_job *k = s->k;
  bt__self *all = &k->w->self;
  bt__link a = bt__link_of (s->own.x, (uint32_t)i), b = bt__link_of (s->its.x, (uint32_t)j);
  double reach = search_reach (&s->own, i) + search_reach (&s->its, j);
  k->report->pairs++;
  if (!(bt__self_distance (&a, &b) <= reach) || are_neighbours (s, i, j))
    return;
  if (all->pairs == all->most || !bt__self_pair_room (k->w))
    {
      s->dropped++;
      return;
    }
  bt__self_pair *p = all->pair + all->pairs++;
  *p = (bt__self_pair){ .i = (uint32_t)i, .j = (uint32_t)j, .strand = s->strand };
  bt__pair_links (&b, &a, &p->w);
  p->floor = bt__self_floor (k, s->strand, p->i, p->j);
  k->report->overlaps += p->w.distance < p->floor;
  p->floor = bt__self_lowered (p->floor, p->w.distance);
  p->touches
      = s->strand >= 0 || (p->w.distance < 2 * bt__self_touching (k) && !are_along (s, i, j));
}

double
bt__self_toward (uint32_t i, uint32_t j, double turned, double apart)
{
  return bt__self_lower ((double)(j + 1 - i) * turned, apart);
}

static void
add_known (bt__self_search *s, int i, int j)
{
  bt__line_job *k = s->k;
  bt__self *self = &k->w->self;
  bt__link a = bt__link_of (s->own.x, (uint32_t)i), b = bt__link_of (s->its.x, (uint32_t)j);
  double clear = bt__self_distance (&a, &b) - 2 * bt__self_touching (k);
  k->report->pairs++;
  if (clear > bt__self_toward ((uint32_t)i, (uint32_t)j, self->turn, self->way))
    return;
  self->least = bt__self_lower (self->least, clear);
  self->least_turn = bt__self_lower (self->least_turn, clear / (j + 1 - i));
  if (self->knowns == self->most || !bt__self_known_room (k->w))
    s->dropped++;
  else
    self->known[self->knowns++] = (bt__self_known){ (uint32_t)i, (uint32_t)j, clear };
}

static void
look_at (bt__self_search *s, int i, int j)
{
  if (s->what == BT__SELF_PAIRS)
    bt__self_add (s, i, j);
  else if (s->what == BT__SELF_KNOWN)
    add_known (s, i, j);
  else if (!are_neighbours (s, i, j))
    {
      bt__link a = bt__link_of (s->own.x, (uint32_t)i), b = bt__link_of (s->its.x, (uint32_t)j);
      double near = s->strand < 0 ? bt__self_touching (s->k) : s->its.thick;
      s->spare
          = fmin (s->spare, 0.5 * (bt__self_distance (&a, &b) - bt__self_touching (s->k) - near));
    }
}

/* Part P of the first line and part Q of the second; in the same line Q comes after P.  */
static void
search_between (bt__self_search *s, part p, part q)
{
  int a = end_of (&s->own, p), b = end_of (&s->its, q);
  if (p.from >= a || q.from >= b || !bt__boxes_are_near (s->own.box + p.t, s->its.box + q.t, 0))
    return;
  if (are_of_stretch (s, p, q) && is_straight (s, 1, p.from, b))
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
      search_between (s, half_stretch (p, h), q);
    else
      search_between (s, p, half_stretch (q, h));
}

static void
search_within (bt__self_search *s, part p)
{
  int to = end_of (&s->own, p);
  if (p.from >= to || is_straight (s, 1, p.from, to))
    return;
  if (p.span > LEAF)
    {
      search_within (s, half_stretch (p, 0));
      search_within (s, half_stretch (p, 1));
      search_between (s, half_stretch (p, 0), half_stretch (p, 1));
      return;
    }
  for (int i = p.from; i < to; i++)
    for (int j = i + 2; j < to; j++)
      look_at (s, i, j);
}

/* ---- All of a line ---- */

bt__self_side
bt__self_side_of (const bt__line_job *k, int strand)
{
  const bt__strand *o = strand < 0 ? NULL : k->config->strand + strand;
  if (!o)
    return (bt__self_side){
      .x = k->x, .reach = k->w->self.reach, .box = k->w->self.box, .links = k->links
    };
  return (bt__self_side){ .x = bt__dynamic_x (o->line),
                          .thick = fmax (o->radius + k->margin / 2, o->core),
                          .box = k->w->self.its,
                          .links = (int)o->line->n };
}

int
bt__self_look_at_itself (bt__line_job *k, bt__self_search *s)
{
  part all = whole (&s->own);
  s->its = s->own;
  s->strand = -1;
  if (!k->config->itself || is_straight (s, 1, 0, k->links))
    return 0;
  fill_boxes (&s->own, all);
  search_within (s, all);
  return s->dropped;
}

int
bt__self_look_at_others (bt__line_job *k, bt__self_search *s)
{
  if (k->config->strands == 0)
    return 0;
  part all = whole (&s->own);
  double reach = 0;
  for (int j = 0; j < s->own.links; j++)
    reach = bt__self_higher (reach, search_reach (&s->own, j));
  fill_boxes (&s->own, all);
  for (int i = 0; i < k->config->strands; i++)
    {
      if (bt__self_strand_is_apart (k, i, s->own.box + all.t, NULL, reach))
        continue;
      s->its = bt__self_side_of (k, i);
      s->strand = i;
      part other = whole (&s->its);
      fill_boxes (&s->its, other);
      search_between (s, all, other);
    }
  return s->dropped;
}
