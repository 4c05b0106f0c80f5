/* The inside of the shadows.  In the plane across the direction, (u, z), w is the depth along it.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#ifndef BT_AWARE_SHADOW_JOB_H
#define BT_AWARE_SHADOW_JOB_H

#include "aware/shadow.h"
#include "aware/tietze.h"

enum
{
  BT__SHADOW_BINS = 48 /* on a side */
};

typedef struct bt__flat
{
  double u, z, w;
} bt__flat;

/* Where an edge goes behind another: from there on it has its next letter.  */
typedef struct bt__cut
{
  double s; /* share of the edge */
  uint32_t edge;
} bt__cut;

typedef struct bt__crossing
{
  uint32_t front, back;
  double s, t; /* shares of the front, of the back */
  int left;    /* the back goes to the left of the front */
} bt__crossing;

/* The bins that something is in: from the first to the last, in u and z.  */
typedef struct bt__area
{
  uint8_t from[2], to[2];
} bt__area;

struct bt__shadow
{
  bt__asker *asker; /* while it is made */
  uint32_t vertices, edges;
  bt_vec3 *v;
  uint32_t (*edge)[2];
  uint32_t *object;
  uint8_t *boundary;
  /* of the direction */
  double angle, cosine, sine;
  bt__flat *at; /* of each vertex */
  bt__crossing *cross;
  uint32_t crosses, room;
  bt__cut *cut;    /* by edge, then share */
  uint32_t *first; /* edge e has cuts first[e] to first[e + 1] - 1, its letters e + first[e] on */
  bt__group group;
  /* to ask */
  double lo[2], wide[2]; /* of the bins, in u and z */
  bt__area *area;        /* of each edge */
  uint32_t bin[BT__SHADOW_BINS * BT__SHADOW_BINS + 1], *in;
  bt__shadow_report report;
  uint64_t world;
};

static inline bt__flat
bt__flatten (const bt__shadow *x, bt_vec3 p)
{
  return (bt__flat){ x->cosine * p.y - x->sine * p.x, p.z, x->cosine * p.x + x->sine * p.y };
}

/* Twice the area of A, B, C: more than 0 if C is on the left of A to B.  */
static inline double
bt__side_of (bt__flat a, bt__flat b, bt__flat c)
{
  return (b.u - a.u) * (c.z - a.z) - (b.z - a.z) * (c.u - a.u);
}

/* True if the segments A to B and C to D cross; then S and T are the shares of the crossing.  A
   point on a line counts as on the left, consistently for all segments through the point.  */
static inline int
bt__do_cross (bt__flat a, bt__flat b, bt__flat c, bt__flat d, double *s, double *t)
{
  double ca = bt__side_of (c, d, a), cb = bt__side_of (c, d, b), ac = bt__side_of (a, b, c),
         ad = bt__side_of (a, b, d);
  if ((ca >= 0) == (cb >= 0) || (ac >= 0) == (ad >= 0))
    return 0;
  *s = ca / (ca - cb);
  *t = ac / (ac - ad);
  return 1;
}

static inline double
bt__depth_at (bt__flat a, bt__flat b, double s)
{
  return a.w + s * (b.w - a.w);
}

/* The letter, from 1, of edge E at share S; at a cut of its own that before it.  */
int32_t bt__letter_at (const bt__shadow *x, uint32_t e, double s);

/* The bins that the line A to B is in; what is outside counts as in the outermost.  */
bt__area bt__area_of (const bt__shadow *x, bt__flat a, bt__flat b);

#endif
