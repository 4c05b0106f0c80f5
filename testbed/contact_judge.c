/* The judge of contact_scene.h: did a polyline pass through something, how near is it?  By exact
   predicates and by brute force, without the engine's help.

   What may be near is found in square bins of the plane: an item is in every bin that its box
   covers, and a pair counts in one bin alone, that of the greater of the lower corners.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <stdlib.h>

#include "testbed/contact_scene.h"

#define LOOK 0.05 /* m: clearances beyond are not looked for */
#define BIN 1.0   /* m: the least side of a bin, of which there are MOST by MOST at most */

enum
{
  MOST = 128
};

typedef struct bounds
{
  bt_vec3 lo, hi;
} bounds;

/* Items are bones, then sheets.  */
struct reef_bins
{
  double x, y, side;
  int across, up, *start, *item;
  bounds *box; /* of each item */
};

static bounds
bounds_of (const bt_vec3 *p, int n, double more)
{
  bounds b = { p[0], p[0] };
  for (int i = 1; i < n; i++)
    {
      b.lo = bt__vec (fmin (b.lo.x, p[i].x), fmin (b.lo.y, p[i].y), fmin (b.lo.z, p[i].z));
      b.hi = bt__vec (fmax (b.hi.x, p[i].x), fmax (b.hi.y, p[i].y), fmax (b.hi.z, p[i].z));
    }
  bt_vec3 m = { more, more, more };
  return (bounds){ bt__sub (b.lo, m), bt__add (b.hi, m) };
}

static int
are_apart (const bounds *a, const bounds *b)
{
  return a->hi.x < b->lo.x || a->lo.x > b->hi.x || a->hi.y < b->lo.y || a->lo.y > b->hi.y
         || a->hi.z < b->lo.z || a->lo.z > b->hi.z;
}

/* ---- Bins ---- */

static int
clamp (double at, int most)
{
  return !(at > 0) ? 0 : at >= most ? most - 1 : (int)at; /* what is not a number, too */
}

static int
column (const reef_bins *b, double x)
{
  return clamp ((x - b->x) / b->side, b->across);
}

static int
line_of (const reef_bins *b, double y)
{
  return clamp ((y - b->y) / b->side, b->up);
}

/* The area that all items cover.  */
static void
lay_out (reef_bins *b, int items)
{
  bounds all = { { 0, 0, 0 }, { 0, 0, 0 } };
  for (int i = 0; i < items; i++)
    {
      const bounds *box = b->box + i;
      all = bounds_of (i ? (bt_vec3[]){ all.lo, all.hi, box->lo, box->hi }
                         : (bt_vec3[]){ box->lo, box->hi, box->lo, box->hi },
                       4, 0);
    }
  double wide = all.hi.x - all.lo.x, long_ = all.hi.y - all.lo.y;
  b->x = all.lo.x;
  b->y = all.lo.y;
  b->side = fmax (BIN, fmax (wide, long_) / MOST);
  b->across = (int)fmin (floor (wide / b->side) + 1, MOST);
  b->up = (int)fmin (floor (long_ / b->side) + 1, MOST);
}

/* Count the items of each bin in START; with ITEM, put them there, START going down to where each
   bin begins.  */
static void
sort_in (reef_bins *b, int items)
{
  for (int i = items - 1; i >= 0; i--)
    {
      const bounds *box = b->box + i;
      for (int v = line_of (b, box->lo.y); v <= line_of (b, box->hi.y); v++)
        for (int u = column (b, box->lo.x); u <= column (b, box->hi.x); u++)
          if (b->item)
            b->item[--b->start[v * b->across + u]] = i;
          else
            b->start[v * b->across + u]++;
    }
}

int
reef_bin (reef *r)
{
  int items = r->bones + r->sheets, bins;
  reef_bins *b = r->bins = calloc (1, sizeof *b);
  if (!b || !(b->box = malloc (((size_t)items + 1) * sizeof *b->box)))
    return 0;
  for (int i = 0; i < items; i++)
    b->box[i] = i < r->bones ? bounds_of ((bt_vec3[]){ r->bone[i].a, r->bone[i].b }, 2, 0)
                             : bounds_of (r->sheet[i - r->bones].v, 3, 0);
  lay_out (b, items);
  bins = b->across * b->up;
  b->start = calloc ((size_t)bins + 1, sizeof *b->start);
  if (!b->start)
    return 0;
  sort_in (b, items);
  for (int i = 1; i <= bins; i++)
    b->start[i] += b->start[i - 1];
  b->item = malloc (((size_t)b->start[bins] + 1) * sizeof *b->item);
  if (b->item)
    sort_in (b, items);
  return b->item != NULL;
}

void
reef_bins_free (reef_bins *b)
{
  if (!b)
    return;
  free (b->box);
  free (b->start);
  free (b->item);
  free (b);
}

/* What is done with an item that may be near: ADD to *SUM.  */
typedef struct question
{
  const reef *r;
  bounds at;
  void (*ask) (struct question *q, int item);
  const bt_vec3 *from, *to; /* of a link */
  int crossings;
  double least;
} question;

/* Ask of every item whose box meets that of Q, once.  */
static void
look (question *q)
{
  const reef_bins *b = q->r->bins;
  const bounds *at = &q->at;
  for (int v = line_of (b, at->lo.y); v <= line_of (b, at->hi.y); v++)
    for (int u = column (b, at->lo.x); u <= column (b, at->hi.x); u++)
      for (int k = b->start[v * b->across + u]; k < b->start[v * b->across + u + 1]; k++)
        {
          int i = b->item[k];
          const bounds *box = b->box + i;
          if (!are_apart (at, box) && u == column (b, fmax (at->lo.x, box->lo.x))
              && v == line_of (b, fmax (at->lo.y, box->lo.y)))
            q->ask (q, i);
        }
}

/* ---- How near?  ---- */

static void
measure (question *q, int item)
{
  solid s = { .kind = SOLID_TRIANGLE };
  bt__link link = { q->from[0], q->from[1] };
  if (item < q->r->bones)
    return;
  for (int k = 0; k < 3; k++)
    s.triangle.v[k] = q->r->sheet[item - q->r->bones].v[k];
  q->least = fmin (q->least, solid_brute (&s, &link));
}

static double
solid_clearance (const reef *r, const bt_vec3 *x, int n)
{
  double least = LOOK;
  for (int i = 0; i < r->solids; i++)
    for (int j = 0; j + 1 < n; j++)
      {
        bt__link link = { x[j], x[j + 1] };
        bt_vec3 mid = bt__scale (0.5, bt__add (x[j], x[j + 1]));
        double size = bt__distance (x[j], x[j + 1]) / 2;
        if (solid_point (r->solid + i, mid) <= size + LOOK)
          least = fmin (least, solid_brute (r->solid + i, &link));
      }
  return least;
}

static double
plane_clearance (const reef *r, const bt_vec3 *x, int n)
{
  double least = LOOK;
  for (int i = 0; i < r->obstacles; i++)
    for (int j = 0; j < n && r->obstacle[i].kind == BT__OBSTACLE_PLANE; j++)
      least = fmin (least, x[j].z - r->obstacle[i].shape.plane.offset);
  return least;
}

double
reef_clearance (const reef *r, const bt_vec3 *x, int n)
{
  question q = { .r = r, .ask = measure, .least = LOOK };
  for (int j = 0; j + 1 < n; j++)
    {
      q.from = x + j;
      q.at = bounds_of (x + j, 2, LOOK);
      look (&q);
    }
  return fmin (q.least, fmin (solid_clearance (r, x, n), plane_clearance (r, x, n)));
}

/* ---- Has it passed through?  ---- */

static void
cross (question *q, int item)
{
  const reef *r = q->r;
  q->crossings += item < r->bones ? sweep_crossings (q->from, q->to, 2, r->bone + item)
                                  : sweep_sheet (q->from, q->to, 2, r->sheet + item - r->bones);
}

int
reef_crossings (const reef *r, const bt_vec3 *from, const bt_vec3 *to, int n)
{
  question q = { .r = r, .ask = cross };
  for (int j = 0; j + 1 < n; j++)
    {
      q.from = from + j;
      q.to = to + j;
      q.at = bounds_of ((bt_vec3[]){ from[j], from[j + 1], to[j], to[j + 1] }, 4, 0);
      look (&q);
    }
  return q.crossings + (plane_clearance (r, to, n) < 0);
}
