/* Looking for links that are near each other, in one line or in two; for self_pairs.c alone.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#ifndef BT_CONTACT_SELF_SEARCH_H
#define BT_CONTACT_SELF_SEARCH_H

#include "contact/line_job.h"

/* A link that goes so much of its rest length in a direction goes along, ... */
#define BT__SELF_TELLS 0.25
#define BT__SELF_ALONG 0.24 /* ... and what such links must keep */
/* Intervals: parts of a line may always come nearer by more.  */
#define BT__SELF_PIECES 8.0

/* ---- Boxes ---- */

static const bt__aabb bt__no_box
    = { { INFINITY, INFINITY, INFINITY }, { -INFINITY, -INFINITY, -INFINITY } };

static inline double
bt__self_lower (double a, double b)
{
  return a < b ? a : b;
}

static inline double
bt__self_higher (double a, double b)
{
  return a > b ? a : b;
}

static inline void
bt__self_add_point (bt__aabb *b, bt_vec3 p, double more)
{
  b->lo = bt__vec (bt__self_lower (b->lo.x, p.x - more), bt__self_lower (b->lo.y, p.y - more),
                   bt__self_lower (b->lo.z, p.z - more));
  b->hi = bt__vec (bt__self_higher (b->hi.x, p.x + more), bt__self_higher (b->hi.y, p.y + more),
                   bt__self_higher (b->hi.z, p.z + more));
}

/* ---- The search ---- */

/* The links of one of two lines, and boxes about them: box 1 about all, of box T the halves 2T and
   2T + 1.  */
typedef struct bt__self_side
{
  const bt_vec3 *x;
  const double *reach; /* of each link; NULL: THICK */
  double thick;
  bt__aabb *box;
  int links, span; /* links, and how many box 1 could hold */
} bt__self_side;

typedef struct bt__self_search
{
  bt__line_job *k;
  bt__self_side own, its;
  const double *move; /* how far each node goes */
  int strand;         /* of ITS, -1: the line itself */
  enum
  {
    BT__SELF_PAIRS, /* list what can meet */
    BT__SELF_KNOWN, /* list what can meet until the next look */
    BT__SELF_SPARED /* how far may each node go? */
  } what;
  double spare;
  int dropped;
} bt__self_search;

/* How near touches, from the axis of the line on.  */
static inline double
bt__self_touching (const bt__line_job *k)
{
  return k->config->radius + k->margin / 2;
}

/* The links of strand number STRAND, -1: of the line itself.  */
bt__self_side bt__self_side_of (const bt__line_job *k, int strand);

/* The distance of the axes of A and B.  */
double bt__self_distance (const bt__link *a, const bt__link *b);

/* How far the ends of a link of the line may go apart, and any two places, until any two of its
   links touch; less than 0: they do (self_look.c).  */
void bt__self_look (const bt__line_job *k, double *turned, double *apart);

/* How far links I and J may come toward each other while no link's ends go farther apart than
   TURNED, nor any two nodes than APART.  */
double bt__self_toward (uint32_t i, uint32_t j, double turned, double apart);

/* Add links I of the own side and J of the other, if they can meet.  */
void bt__self_add (bt__self_search *s, int i, int j);

/* The expected move, in the step, of a line against other lines, after a move of WENT in the last
   step (self_others.c).  */
double bt__self_expected (const bt__line_job *k, double went);

/* True if the line, with REACH about it, stays clear of line number I on its way to TO; NULL: where
   it is.  OWN: a box about all that.  True if it stays clear of all other lines.  */
int bt__self_strand_is_apart (const bt__line_job *k, int i, const bt__aabb *own, const bt_vec3 *to,
                              double reach);
int bt__self_others_are_far (const bt__line_job *k, const bt_vec3 *to);

/* Ask the line, whose nodes go as far as MOVE says and whose links look as far as their REACH, and
   the others.  Return for how many there was no room.  */
int bt__self_look_at_itself (bt__line_job *k, bt__self_search *s);
int bt__self_look_at_others (bt__line_job *k, bt__self_search *s);

#endif
