/* Which links of a line could meet each other, or those of another line, in a step.

   A line that is clear of itself knows how far it may go and stay so (self_look.c): until then a
   step asks nothing.  Else a list of pairs is kept.  What a look found serves until the line has
   turned or changed its shape by so much.  Of two places with M links between and with them, the
   one goes no farther against the other than M times the most that the two ends of any link do, nor
   farther than any two nodes do.  So a look lists the pairs that are nearer than what either may
   come to, and from then on no other can touch; of those listed all are passed over whose distance
   is not yet used up.

   Which pairs touch and which can meet never depends on when the line was looked at, so that a look
   saves time alone.

   There is room for so many pairs.  Where there are more the whole move is made shorter, until no
   more than there is room for can meet, or nothing moves, which is safe.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <string.h>

#include "contact/self_search.h"

enum
{
  WAIT = 12,   /* steps after a look that found more than it could list */
  AGAIN = 8,   /* steps until a line that can go on clear for no longer than a step is looked at */
  RANGE = 16,  /* times as far as at least may be looked */
  SHORTER = 12 /* times a move is halved for want of room */
};

/* Of an interval: how far the ends of a link may part until the next look, at most.  */
#define TURN 0.5
#define SPARE 0.2 /* of a piece: the most of what a line is said to be clear by */

/* ---- A line that is clear of itself ---- */

/* How far the line may go apart in a step that starts with the spare in D: links that the spare
   lets come together do not touch, and for a step may touch, but not meet.  */
static bt__dynamic_drift
allowed (const bt__line_job *k)
{
  bt__dynamic_drift may = k->d->spare;
  may.apart += 2 * (bt__self_touching (k) - k->core) * (1 - BT__MARGIN);
  return may;
}

static int
is_ahead (const bt__line_job *k)
{
  bt__dynamic_drift may = allowed (k);
  const bt__dynamic *d = k->d;
  return d->spare.turned > 0 && d->spare.apart > 0 && may.turned > BT__LINE_AHEAD * d->step.turned
         && may.apart > BT__LINE_AHEAD * d->step.apart;
}

/* True if it is clear of itself, and for longer than the step that starts is expected to go.
   What lately was not is not looked at.  */
static int
is_clear_of_itself (bt__line_job *k)
{
  bt__dynamic *d = k->d;
  if (!k->config->itself || is_ahead (k))
    return 1;
  if (d->wait > 0)
    return 0;
  bt__self_look (k, &d->spare.turned, &d->spare.apart);
  return is_ahead (k);
}

/* True if the line met itself or another line in the step.  */
static int
met_a_line (const bt__line_job *k)
{
  for (int q = 0; q < k->rows; q++)
    if (k->w->of[q].mover == BT__LINE_SELF)
      return 1;
  return 0;
}

void
bt__self_note (bt__line_job *k)
{
  const bt__self *self = &k->w->self;
  bt__dynamic *d = k->d;
  d->spare.turned = self->clear ? fmax (d->spare.turned, 0) : 0;
  d->spare.apart = self->clear ? fmax (d->spare.apart, 0) : 0;
  d->wait = self->clear ? 0 : met_a_line (k) ? 1 : d->wait > 0 ? d->wait - 1 : AGAIN;
}

/* ---- What is known of a line and itself ---- */

/* Look; zero if there was more than room for it.  */
static int
look_once (bt__line_job *k)
{
  bt__self *self = &k->w->self;
  bt__self_search s
      = { .k = k, .own = bt__self_side_of (k, -1), .move = self->move, .what = BT__SELF_KNOWN };
  self->knowns = 0;
  self->least = self->least_turn = INFINITY;
  for (int i = 0; i <= k->links; i++)
    self->move[i] = 0.5 * self->turn;
  for (int j = 0; j < k->links; j++)
    self->reach[j] = bt__self_touching (k) + 0.5 * self->way;
  bt__self_look_at_itself (k, &s);
  return s.dropped == 0;
}

/* How far to look, MOST at most: twice as far when all was used up, if few pairs were listed, and
   half as far when less than half was.  */
static double
suited (double was, double used, int few, double most)
{
  double next = used >= was ? few ? 2 * was : was : used < 0.5 * was ? 0.5 * was : was;
  return fmin (fmax (next, most / RANGE), most);
}

static void
look (bt__line_job *k)
{
  bt__self *self = &k->w->self;
  double piece = k->d->piece;
  int few = 2 * self->knowns < k->links;
  self->turn = suited (self->turn, self->drift.turned, few, TURN * piece);
  self->way = suited (self->way, self->drift.apart, few, BT__SELF_PIECES * piece);
  self->still = 0;
  while (!look_once (k) && self->way > BT__SELF_PIECES * piece / RANGE)
    self->way *= 0.5;
  self->wait = self->knowns == self->most ? WAIT : 0;
  self->drift = (bt__dynamic_drift){ 0 };
  if (self->wait > 0)
    return;
  self->still = k->links + 1;
  memcpy (self->stood, k->x, (size_t)self->still * sizeof *k->x);
}

/* How the line at X differs from how it was looked at.  True if what is known still holds.  */
static int
is_known (const bt__line_job *k, const bt_vec3 *x, bt__dynamic_drift *drift)
{
  const bt__self *self = &k->w->self;
  bt__dynamic_drifted (x, self->stood, self->still, drift);
  drift->turned *= 1 + BT__MARGIN;
  drift->apart *= 1 + BT__MARGIN;
  return drift->turned < self->turn && drift->apart < self->way;
}

/* True if the line is looked at, or was and still is as then.  */
static int
know (bt__line_job *k)
{
  bt__self *self = &k->w->self;
  if (self->still == k->links + 1 && is_known (k, k->x, &self->drift))
    ;
  else if (self->still > 0 || self->wait == 0)
    look (k);
  else
    self->wait--;
  return self->still > 0;
}

/* True if none of the listed pairs can touch before the line differs by more than DRIFT.  */
static int
none_touches (const bt__self *self, const bt__dynamic_drift *drift)
{
  return drift->apart < self->least || drift->turned < self->least_turn;
}

/* ---- Lists ---- */

/* List the pairs of the line itself that can meet while its links look as far as their REACH, and
   its nodes go no farther than MOVE; if SURE of what is known, which lasts to DRIFT.  */
static int
list_itself (bt__line_job *k, bt__self_search *s, const bt__dynamic_drift *drift)
{
  const bt__self *self = &k->w->self;
  if (!k->config->itself || self->clear)
    return 0;
  if (!drift)
    return bt__self_look_at_itself (k, s);
  s->its = s->own;
  s->strand = -1;
  for (int n = 0; n < self->knowns; n++)
    {
      const bt__self_known *p = self->known + n;
      if (p->clear <= bt__self_toward (p->i, p->j, drift->turned, drift->apart))
        bt__self_add (s, (int)p->i, (int)p->j);
    }
  return s->dropped;
}

/* List the pairs that could meet while the nodes go no farther than MOVE says, on their way TO;
   DRIFT: what is known holds that long.  Zero if there is no room for all.  */
static int
list (bt__line_job *k, const bt_vec3 *to, const bt__dynamic_drift *drift)
{
  bt__self *self = &k->w->self;
  bt__self_search s = { .k = k, .own = bt__self_side_of (k, -1), .move = self->move };
  self->pairs = 0;
  if (!drift || self->knowns > 0 || k->config->strands > 0)
    bt__line_measure (k);
  for (int j = 0; j < k->links; j++)
    self->reach[j] = bt__self_higher (bt__self_touching (k),
                                      k->core + bt__self_higher (self->move[j], self->move[j + 1]));
  return list_itself (k, &s, drift) == 0
         && (bt__self_others_are_far (k, to) || bt__self_look_at_others (k, &s) == 0);
}

/* ---- A step ---- */

/* True if nothing need be listed as the step starts.  */
static int
is_far (bt__line_job *k)
{
  bt__self *self = &k->w->self;
  self->pairs = 0;
  self->clear = 1;
  bt__line_work_came (k->w, bt__self_touching (k) + bt__self_expected (k, k->d->step.way));
  if (!bt__self_counts (k))
    return 1;
  self->clear = is_clear_of_itself (k);
  return (self->clear || (know (k) && none_touches (self, &self->drift)))
         && bt__self_others_are_far (k, NULL);
}

/* True if a listed pair touches, or is of another line.  How many of the line's own pairs are
   listed that are farther apart depends on when the line was looked at, which no result may depend
   on.  */
static int
is_near_a_line (const bt__line_job *k)
{
  const bt__self *self = &k->w->self;
  for (int n = 0; n < self->pairs; n++)
    if (self->pair[n].touches)
      return 1;
  return 0;
}

int
bt__self_watch (bt__line_job *k)
{
  bt__self *self = &k->w->self;
  if (is_far (k))
    return 0;
  int known = self->clear || self->still > 0;
  for (int i = 0; i <= k->links; i++)
    self->move[i] = bt__self_expected (k, bt__norm (bt__dynamic_dx (k->d)[i]));
  list (k, NULL, known ? &self->drift : NULL); /* of what finds no room there is no row */
  return is_near_a_line (k);
}

int
bt__self_is_far (bt__line_job *k, bt__dynamic_drift *may)
{
  if (bt__self_watch (k))
    return 0;
  if (k->config->itself && k->w->self.clear)
    {
      bt__dynamic_drift own = allowed (k);
      may->turned = own.turned;
      may->apart = own.apart;
    }
  return 1;
}

/* What is known to hold for all of the proposed move, or NULL: a straight move differs from how the
   line was looked at by no more than its ends do.  */
static const bt__dynamic_drift *
know_move (const bt__line_job *k, bt__dynamic_drift *drift)
{
  const bt__self *self = &k->w->self;
  if (!k->config->itself)
    return drift;
  if (self->still != k->links + 1 || !is_known (k, k->X, drift))
    return NULL;
  drift->turned = bt__self_higher (drift->turned, self->drift.turned);
  drift->apart = bt__self_higher (drift->apart, self->drift.apart);
  return drift;
}

/* True if no two links can meet in the proposed move, those of P apart.  */
static int
goes_clear (const bt__line_job *k, const bt__self_known *p)
{
  bt__link a = bt__link_of (k->x, p->i), b = bt__link_of (k->x, p->j);
  double most = 0, gap = bt__self_distance (&a, &b);
  for (uint32_t n = 0; n < 2; n++)
    {
      most = fmax (most, bt__distance (k->x[p->i + n], k->X[p->i + n]));
      most = fmax (most, bt__distance (k->x[p->j + n], k->X[p->j + n]));
    }
  return gap > 2 * (k->core + most * (1 + BT__MARGIN)) * (1 + BT__MARGIN);
}

static int
is_listed (const bt__self *self, const bt__self_known *p)
{
  for (int n = 0; n < self->pairs && self->pair[n].strand < 0; n++)
    if (self->pair[n].i == p->i && self->pair[n].j == p->j)
      return 1;
  return 0;
}

/* True if what is not listed cannot meet while the line differs by no more than DRIFT.  */
static int
others_go_clear (const bt__line_job *k, const bt__dynamic_drift *drift)
{
  const bt__self *self = &k->w->self;
  if (none_touches (self, drift))
    return 1;
  for (int n = 0; n < self->knowns; n++)
    {
      const bt__self_known *p = self->known + n;
      if (p->clear <= bt__self_toward (p->i, p->j, drift->turned, drift->apart)
          && !goes_clear (k, p) && !is_listed (self, p))
        return 0;
    }
  return 1;
}

/* The same for a line that was clear as the step began: what it proposes must be allowed.  */
static int
stays_clear (bt__line_job *k)
{
  bt__dynamic_drift drift, may = allowed (k);
  if (!k->config->itself)
    return 1;
  bt__dynamic_drifted (k->X, k->x, k->links + 1, &drift);
  return drift.turned <= may.turned && drift.apart <= may.apart;
}

/* Ask how near a line must come, to the place of the line before its move, to be met in the move.
 */
static void
ask_moved (const bt__line_job *k)
{
  if (k->config->strands > 0)
    bt__line_work_came (k->w, bt__self_touching (k) + bt__dynamic_stray (k->X, k->x, k->links + 1));
}

static int
keeps_listed (bt__line_job *k)
{
  bt__self *self = &k->w->self;
  bt__dynamic_drift drift = { 0 };
  ask_moved (k);
  if (!bt__self_counts (k))
    return 1;
  if (self->clear && !stays_clear (k))
    self->clear = self->still = 0;
  if (!self->clear && (!know_move (k, &drift) || !others_go_clear (k, &drift)))
    return 0;
  return bt__self_others_are_far (k, k->X);
}

/* List the pairs that could meet in the proposed move; zero if there is no room for all.  */
static int
list_moves (bt__line_job *k)
{
  bt__self *self = &k->w->self;
  bt__dynamic_drift drift = { 0 };
  for (int i = 0; i <= k->links; i++)
    self->move[i] = bt__distance (k->x[i], k->X[i]) * (1 + BT__MARGIN);
  return list (k, k->X, know_move (k, &drift));
}

/* A clear line is asked after the step whether the way was allowed.  */
int
bt__self_stays_far (bt__line_job *k)
{
  if (k->w->self.clear)
    {
      ask_moved (k);
      return bt__self_others_are_far (k, k->X);
    }
  return keeps_listed (k) || (list_moves (k) && k->w->self.pairs == 0);
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
  if (keeps_listed (k))
    return;
  for (int n = 0; !list_moves (k) && n <= SHORTER; n++)
    {
      k->report->overflows++;
      shorten (k, n < SHORTER ? 0.5 : 0);
    }
}

/* ---- Asked apart from a step ---- */

double
bt__self_spare (bt__line_job *k)
{
  bt__self *self = &k->w->self;
  double most = SPARE * k->d->piece;
  bt__self_search s = { .k = k,
                        .own = bt__self_side_of (k, -1),
                        .move = self->move,
                        .what = BT__SELF_SPARED,
                        .spare = most };
  for (int i = 0; i <= k->links; i++)
    self->move[i] = most;
  for (int j = 0; j < k->links; j++)
    self->reach[j] = bt__self_touching (k) + most;
  bt__self_asks_more (k, bt__self_touching (k) + 2 * most);
  bt__line_measure (k);
  bt__self_look_at_itself (k, &s);
  bt__self_look_at_others (k, &s);
  return fmax (s.spare, 0);
}
