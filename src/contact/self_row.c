/* Contact constraints of links against links, of one line or of two.

   Two touching links of the same line push each other at their closest points: one constraint with
   two places, so action and reaction are a single number.

   Another line stands still while this line steps.  As rigid walls, two lines would press each
   other with forces unknown to each other, and each would stop the other for good.  So only the
   line that steps later keeps out of the gap.  The earlier line feels the reaction of the later
   line's last step, plus the resistance of the later line to a displacement: its inertia and its
   tension at the place.  Where the later line resists by no more than this estimate, action and
   reaction agree after a few steps; two lines together are at most twice as heavy as one.

   The half-space is placed at the start of the step.  At the expected end of the step the closest
   points may be different, and a knot that changes between two pairs would never come to rest.

   Links with little line between them are kept apart by the bending of that line, not by contact.
   For two lines fastened at one place, the line between two links leads from one link to the place
   and on to the other link.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include "contact/self_search.h"

#define STIFF 0.1    /* times EA over a link's length: of a touch, ... */
#define STIFFEST 1e6 /* N/m: ... at most, but for the load */
#define YIELD 8.0    /* part of the way to the core: the deepest penetration by the load ... */
#define HARDEST 1e8  /* N/m: ... as far as a touch gives way at all, which held ends do not, ... */
#define RIGID 100.0  /* times EI over the cube of a link's length: ... or a line that is stiff */
#define ALIKE 0.5    /* product of the normals of a touch that is remembered */
#define LEVER 1e-3   /* of a link: so near to an end that is held nothing else is moved */

static double
radius_of (const bt__line_job *k, const bt__self_pair *p)
{
  return p->strand < 0 ? k->config->radius : k->config->strand[p->strand].radius;
}

/* Metres of rest length from the place T on link J of P to the end of its line.  */
static double
from_end_of (const bt__line_job *k, const bt__self_pair *p, double t)
{
  if (p->strand < 0)
    return (1 - t) * k->w->from_end[p->j] + t * k->w->from_end[p->j + 1];
  const bt__dynamic *o = k->config->strand[p->strand].line;
  const double *rest = bt__dynamic_rest (o);
  double sum = (1 - t) * rest[p->j];
  for (int64_t q = p->j + 1; q < o->n; q++)
    sum += rest[q];
  return sum;
}

/* How another line went in its last step, at T along link J.  */
static bt_vec3
drift_of (const bt__line_job *k, const bt__self_pair *p, double t)
{
  if (p->strand < 0)
    return bt__vec (0, 0, 0);
  const bt_vec3 *dx = bt__dynamic_dx (k->config->strand[p->strand].line) + p->j;
  return bt__between (dx, t);
}

/* ---- Lines that yield ---- */

/* The greatest resistance of line O to a displacement in a step, N/m, at T along its link J. A node
   of a chain with inertia M and tension K of its links yields by 1 / sqrt (M2 + 4 M K); the ends of
   the line do not yield.  */
static double
resistance_of (const bt__line_job *k, const bt__strand *o, uint32_t j, double t)
{
  double rest = bt__dynamic_rest (o->line)[j], rate = 1.5 / k->h;
  double m = rate * rate * o->inertia * rest;
  double tension = fmax (bt__dynamic_tension (o->line)[j], 0) / rest;
  double yield = j > 0 ? (1 - t) * (1 - t) : 0;
  yield += (int64_t)j + 1 < o->line->n ? t * t : 0;
  return 2 * sqrt (m * m + 4 * m * tension) / fmax (yield, 1e-9);
}

/* True if a row before Q is of anchor I of the same line.  */
static int
is_contact_taken (const bt__line_job *k, int q, int64_t i)
{
  const bt__line_row *of = k->w->of;
  for (int p = 0; p < k->rows; p++)
    if (p != q && of[p].mover == BT__LINE_SELF && of[p].object == of[q].object
        && of[p].triangle == (uint32_t)i)
      return 1;
  return 0;
}

/* The contact of line O that belongs to constraint Q and is not taken, or -1.  */
static int64_t
their_anchor (const bt__line_job *k, const bt__strand *o, int q)
{
  const bt__line_row *of = k->w->of + q;
  const bt__contact *a = o->anchors ? bt__contacts_at (o->anchors) : NULL;
  double least = bt__dynamic_rest (k->d)[of->link] + bt__dynamic_rest (o->line)[of->slot];
  int64_t best = -1;
  for (int64_t i = 0; a && i < o->anchors->n; i++)
    {
      double away = fabs (a[i].from_end - of->other) + fabs (a[i].other - of->from_end);
      if (a[i].mover != BT__CONTACT_LINE || a[i].object != k->config->id || !(away < least)
          || !(bt__dot (a[i].normal, k->w->row[q].normal) < -ALIKE) || is_contact_taken (k, q, i))
        continue;
      least = away;
      best = i;
    }
  return best;
}

/* Give constraint Q, against a line that yields, the reaction felt by that line.  */
static void
feel_reaction (bt__line_job *k, int q)
{
  bt__constraint *r = k->w->row + q;
  bt__line_row *of = k->w->of + q;
  const bt__strand *o = k->config->strand + of->object - 1;
  int64_t at = their_anchor (k, o, q);
  const bt__contact *a = at < 0 ? NULL : bt__contacts_at (o->anchors) + at;
  double load = a ? a->load : 0;
  r->load = load;
  r->stiffness = fmin (resistance_of (k, o, of->slot, r->t), bt__self_stiffness (k, q));
  r->friction = bt__self_friction (k, q);
  r->slip = BT__LINE_SLIP;
  r->offset += bt__dot (r->normal, r->drift);
  if (!a)
    return;
  const bt_vec3 *x = k->x + r->node;
  bt_vec3 here = bt__add (bt__between (x, r->s), r->drift);
  bt_vec3 drag = bt__off_axis (r->normal, a->force);
  of->triangle = (uint32_t)at;
  r->offset = bt__dot (r->normal, here) + load / r->stiffness;
  r->slip = fmax (BT__LINE_SLIP, r->friction * load / r->stiffness);
  r->stick = bt__scale (r->slip / fmax (r->friction * load, 1e-9), drag);
}

/* ---- Rows ---- */

static void
set_row (bt__line_job *k, int q, const bt__self_pair *p, const bt__link *second,
         const bt__witness *w)
{
  double t = bt__nearest_share (second, w->point), whole = k->config->radius + radius_of (k, p);
  double out = fmin (whole, fmax (p->w.distance, p->floor) + BT__LINE_RECOVERY * k->h);
  double stands = p->strand < 0 ? 0 : bt__dot (w->normal, w->point);
  int64_t id = p->strand < 0 ? k->config->id : k->config->strand[p->strand].id;
  k->w->row[q] = (bt__constraint){ .node = p->i,
                                   .s = w->s,
                                   .pair = p->strand < 0 ? (int64_t)p->j + 1 : 0,
                                   .t = t,
                                   .normal = w->normal,
                                   .offset = out + stands,
                                   .drift = drift_of (k, p, t),
                                   .active = -1 };
  k->w->of[q] = (bt__line_row){ .link = p->i,
                                .mover = BT__LINE_SELF,
                                .object = (uint32_t)(p->strand + 1),
                                .slot = p->j,
                                .triangle = BT__NO_TRIANGLE,
                                .id = id,
                                .fresh = 1,
                                .from_end = (1 - w->s) * k->w->from_end[p->i]
                                            + w->s * k->w->from_end[p->i + 1],
                                .other = from_end_of (k, p, t),
                                .point = bt__axpy (w->point, radius_of (k, p), w->normal) };
}

/* Row Q, just set for P, against a line that yields, gives way as that line does.  */
static void
soften (bt__line_job *k, int q, const bt__self_pair *p)
{
  if (p->strand >= 0 && k->config->strand[p->strand].yields)
    feel_reaction (k, q);
}

/* True if place S of link I of the line is its end, which is held: no constraint there moves it. */
static int
is_at_held_end (const bt__line_job *k, uint32_t i, double s)
{
  int last = (int64_t)i + 1 == k->d->n;
  return (i == 0 && s < LEVER && !k->in->end[0].free)
         || (last && s > 1 - LEVER && !k->in->end[1].free);
}

/* True if both of the closest points W of P are held ends: their holders keep them in place, and
   may hold two lines at one place.  */
static int
is_of_holders (const bt__line_job *k, const bt__self_pair *p, const bt__witness *w, double t)
{
  return is_at_held_end (k, p->i, w->s) && (p->strand >= 0 || is_at_held_end (k, p->j, t));
}

void
bt__self_rows (bt__line_job *k)
{
  const bt__self *self = &k->w->self;
  for (int n = 0; n < self->pairs && bt__line_takes_row (k); n++)
    {
      const bt__self_pair *p = self->pair + n;
      double touch = k->config->radius + radius_of (k, p) + k->margin;
      double way = bt__self_between (k, p->strand, p->i, p->j);
      if (!p->touches || !(p->w.distance < touch) || way * BT__SELF_TELLS < 2 * k->config->core)
        continue;
      bt__link second = bt__self_second (k, k->x, p);
      if (!is_of_holders (k, p, &p->w, bt__nearest_share (&second, p->w.point)))
        {
          set_row (k, k->rows, p, &second, &p->w);
          soften (k, k->rows++, p);
        }
    }
}

void
bt__self_add_hit (bt__line_job *k, const bt__self_pair *p, const bt__witness *w, double t)
{
  int at = 0;
  for (; at < k->rows; at++)
    {
      const bt__line_row *of = k->w->of + at;
      if (of->mover == BT__LINE_SELF && of->link == p->i && of->slot == p->j
          && of->object == (uint32_t)(p->strand + 1)
          && bt__dot (k->w->row[at].normal, w->normal) > BT__LINE_ALIKE_HIT)
        break;
    }
  if (at == k->rows && !bt__line_takes_row (k))
    return;
  bt__link a = bt__self_second (k, k->x, p), b = bt__self_second (k, k->X, p);
  bt__link second
      = { bt__axpy (a.a, t, bt__sub (b.a, a.a)), bt__axpy (a.b, t, bt__sub (b.b, a.b)) };
  int again = at < k->rows ? k->w->of[at].again + 1 : 0; /* too soft: in this step nothing yields */
  double bore = again ? k->w->row[at].load : 0;
  set_row (k, at, p, &second, w);
  if (!again)
    soften (k, at, p);
  k->w->of[at].again = again;
  k->w->row[at].load = bore;
  k->rows += at == k->rows;
}

/* The proposed move of the place at the share S of link J.  */
static bt_vec3
move_between (const bt__line_job *k, int64_t j, double s)
{
  const bt_vec3 *x = k->x + j, *X = k->X + j;
  return bt__between ((bt_vec3[]){ bt__sub (X[0], x[0]), bt__sub (X[1], x[1]) }, s);
}

bt_vec3
bt__self_move (const bt__line_job *k, const bt__constraint *r)
{
  bt_vec3 d = bt__sub (move_between (k, r->node, r->s), r->drift);
  return r->pair == 0 ? d : bt__sub (d, move_between (k, r->pair - 1, r->t));
}

/* ---- What lasts ---- */

/* How far row I is along both lines from what anchor A is of, m; INFINITY: it is of something else.
 */
static double
away_from (const bt__line_job *k, int i, const bt__contact *a)
{
  const bt__line_row *of = k->w->of + i;
  if (a->mover != BT__CONTACT_LINE || a->object != of->id
      || !(bt__dot (a->normal, k->w->row[i].normal) > ALIKE))
    return INFINITY;
  return fabs (a->from_end - of->from_end) + fabs (a->other - of->other);
}

/* True if a row after I is nearer to A than AWAY.  */
static int
is_of_later (const bt__line_job *k, int i, const bt__contact *a, double away)
{
  for (int q = i + 1; q < k->rows; q++)
    if (k->w->of[q].mover == BT__LINE_SELF && away_from (k, q, a) < away)
      return 1;
  return 0;
}

/* In a knot several constraints share the length of a link, and some bear nothing: to each what is
   nearest to it and to no other.  */
int
bt__self_anchor (const bt__line_job *k, int i)
{
  double reach = BT__LINE_REMEMBER * bt__dynamic_rest (k->d)[k->w->row[i].node], least = 2 * reach;
  int best = -1;
  for (int q = 0; q < k->olds; q++)
    {
      const bt__contact *a = k->w->old + q;
      double away = a->state < 0 ? INFINITY : away_from (k, i, a);
      if (!(away < least) || is_of_later (k, i, a, away))
        continue;
      best = q;
      least = away;
    }
  return best;
}

double
bt__self_friction (const bt__line_job *k, int i)
{
  uint32_t strand = k->w->of[i].object;
  double own = k->config->friction;
  return strand ? 0.5 * (own + k->config->strand[strand - 1].friction) : own;
}

double
bt__self_stiffness (const bt__line_job *k, int i)
{
  const bt__constraint *r = k->w->row + i;
  uint32_t strand = k->w->of[i].object;
  const bt__strand *o = strand ? k->config->strand + strand - 1 : NULL;
  double way
      = o ? k->config->radius + o->radius - k->core - o->core : 2 * (k->config->radius - k->core);
  double rest = bt__dynamic_rest (k->d)[r->node];
  double stiff = fmin (STIFF * k->in->line->ea / rest, STIFFEST);
  double hardest = fmax (HARDEST, RIGID * k->in->line->ei / (rest * rest * rest));
  return fmax (stiff, fmin (YIELD * r->load / way, hardest));
}

bt__contact
bt__self_reaction (const bt__line_job *k, const bt__contact *a)
{
  bt__contact b = *a;
  b.from_end = a->other;
  b.other = a->from_end;
  b.point = bt__axpy (a->point, -2 * k->config->radius, a->normal);
  b.normal = bt__scale (-1, a->normal);
  b.force = bt__scale (-1, a->force);
  b.stick = bt__scale (-1, a->stick);
  return b;
}
