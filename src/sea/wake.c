/* The lee of a pile: the share of a current left behind the pile.  The model stands in bight/sea.h.

   Four wakes at a time, side by side in vectors (math/four.h).  Most water is in no lee, found by
   products alone: places and speeds are compared squared and multiplied out, and roots, quotients
   and exponentials are computed only for a block with a lee.  The deficit is a Gaussian across the
   wake, times factors that fade smoothly at the upstream side, at the far end and beyond the ends
   of the cylinder.  Shares of several lees multiply.

   Sums and products run in a fixed order, so a place has the same share on any machine and thread.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <math.h>

#include <bight/sea.h>

#include "math/four.h"
#include "math/vec.h"
#include "sea/lees.h"

/* In diameters.  */
#define CLOSE 3.0
#define FADES 40.0
#define GONE 60.0
#define BEFORE 0.5
#define DEFICIT 0.5
#define WIDE 6.0                 /* standard widths beyond which nothing is left, ... */
#define WITHIN (WIDE * WIDE / 4) /* ... and squared, where the width is half a diameter */

bt_wake
bt_wake_of (bt_vec3 a, bt_vec3 b, double radius)
{
  bt_vec3 axis = bt__sub (b, a);
  return (bt_wake){ a, bt__unit_or (axis, bt__vec (0, 0, 1)), bt__norm (axis), radius };
}

void
bt__wakes_put (bt__wakes *block, size_t i, const bt_wake *wake)
{
  block->a[0][i] = wake->a.x;
  block->a[1][i] = wake->a.y;
  block->a[2][i] = wake->a.z;
  block->axis[0][i] = wake->axis.x;
  block->axis[1][i] = wake->axis.y;
  block->axis[2][i] = wake->axis.z;
  block->length[i] = wake->length;
  block->radius[i] = wake->radius;
}

/* A place among four wakes.  */
typedef struct place
{
  bt__four d, along, past; /* m: the diameter; from the near end along the axis, from the far one */
  bt__four across2;        /* m2/s2: square of the current across the axis */
  bt__four way, side2;     /* m2/s, m4/s2: downstream by that speed, aside squared by its square */
} place;

static BT__HOT place
find_place (const bt__wakes *w, bt_vec3 u, bt_vec3 p)
{
  bt__four x = p.x - bt__four_load (w->a[0]), y = p.y - bt__four_load (w->a[1]),
           z = p.z - bt__four_load (w->a[2]);
  bt__four ex = bt__four_load (w->axis[0]), ey = bt__four_load (w->axis[1]),
           ez = bt__four_load (w->axis[2]);
  bt__four along = x * ex + y * ey + z * ez, down = u.x * ex + u.y * ey + u.z * ez;
  bt__four across2 = bt__dot (u, u) - down * down;
  bt__four way = x * u.x + y * u.y + z * u.z - along * down;
  return (place){ 2 * bt__four_load (w->radius),
                  along,
                  along - bt__four_load (w->length),
                  across2,
                  way,
                  (x * x + y * y + z * z - along * along) * across2 - way * way };
}

/* True where the place lies in the lee: neither beyond an end, nor before, nor too far behind or
   beside; and the current is not along the axis.  */
static BT__HOT bt__four_mask
is_in_lee (const place *at, double speed2)
{
  bt__four way2 = at->way * at->way, d2 = at->d * at->d * at->across2;
  return (at->along > -at->d) & (at->past < at->d) & (at->across2 > 1e-12 * speed2)
         & ((at->way > 0) | (way2 < BEFORE * BEFORE * d2)) & (way2 < GONE * GONE * d2)
         & ((at->side2 < WITHIN * d2)
            | (at->side2 * at->side2 < WITHIN * WITHIN / (CLOSE * CLOSE) * (d2 * way2)));
}

/* 0 to 1 as U does.  */
static BT__HOT bt__four
smooth (bt__four u)
{
  u = bt__four_min (bt__four_max (u, bt__four_all (0)), bt__four_all (1));
  return u * u * (3 - 2 * u);
}

/* The velocity deficit behind a cylinder in a current of SPEED, zero outside the LEE.  Only the
   component of the current across the axis makes a lee.  */
static BT__HOT bt__four
deficit (const place *at, bt__four_mask lee, double speed)
{
  bt__four across = bt__four_sqrt (bt__four_where (lee, at->across2)), plus, minus;
  bt__four by = 1 / bt__four_either (lee, across * at->d, bt__four_all (1));
  bt__four s = at->way * by, side2 = bt__four_max (at->side2 * by * by, bt__four_all (0));
  bt__four c2 = CLOSE / bt__four_max (s, bt__four_all (CLOSE));
  bt__four_exp (2 * bt__four_min (side2 * c2, bt__four_all (WITHIN)), &plus, &minus);
  bt__four fade = smooth (s + BEFORE) * (1 - smooth ((s - FADES) * (1 / (GONE - FADES))));
  bt__four ends = smooth (1 - bt__four_max (-at->along, at->past) * (across * by));
  return DEFICIT * bt__four_sqrt (c2) * fade * minus * ends * (across / speed);
}

/* The four shares left by the blocks of wakes from BLOCK to END.  */
static BT__HOT bt__four
share_of_blocks (const bt__wakes *block, const bt__wakes *end, bt_vec3 ambient, double speed,
                 bt_vec3 p)
{
  bt__four share = { 1, 1, 1, 1 };
  for (; block < end; block++)
    {
      place at = find_place (block, ambient, p);
      bt__four_mask lee = is_in_lee (&at, speed * speed);
      if (bt__four_which (lee))
        share *= 1 - deficit (&at, lee, speed);
    }
  return share;
}

static BT__HOT int
is_in_box (const bt__lee_node *node, bt_vec3 p)
{
  return p.x >= node->low[0] && p.x <= node->high[0] && p.y >= node->low[1] && p.y <= node->high[1]
         && p.z >= node->low[2] && p.z <= node->high[2];
}

static BT__WIDE double
share_at (const bt_lees *lees, bt_vec3 ambient, bt_vec3 p)
{
  bt__four share = { 1, 1, 1, 1 };
  double speed = bt__norm (ambient);
  for (uint32_t i = 0; i < lees->nodes;)
    {
      const bt__lee_node *node = lees->node + i;
      int inside = is_in_box (node, p);
      i = inside ? i + 1 : node->skip;
      if (inside && node->blocks > 0)
        share *= share_of_blocks (lees->block + node->first,
                                  lees->block + node->first + node->blocks, ambient, speed, p);
    }
  return (share[0] * share[2]) * (share[1] * share[3]);
}

double
bt_lees_share (const bt_lees *lees, bt_vec3 ambient, bt_vec3 p)
{
  return share_at (lees, ambient, p);
}

/* ---- Places near each other ---- */

enum
{
  TOGETHER = 8, /* places asked about together */
  NEAR = 96     /* the most blocks of wakes with a lee at any of these places */
};

/* Blocks of wakes, each with the number of its leaf.  */
typedef struct nearby
{
  int n;
  const bt__wakes *block[NEAR];
  uint32_t leaf[NEAR];
} nearby;

/* True of wakes that may leave a lee within R metres of the place AT.  The bounds are those of
   is_in_lee, by R and a little more for rounding.  */
static BT__HOT bt__four_mask
may_leave_lee (const place *at, double speed2, double r)
{
  bt__four_mask some = at->across2 > 1e-12 * speed2;
  bt__four by = 1 / bt__four_sqrt (bt__four_either (some, at->across2, bt__four_all (1)));
  bt__four s = at->way * by, more = r + 0.01 * at->d;
  bt__four n = bt__four_sqrt (bt__four_max (at->side2, bt__four_all (0))) * by;
  bt__four near = at->d * sqrt (WITHIN), behind = bt__four_max (s + more, bt__four_all (0));
  bt__four wide = bt__four_sqrt (WITHIN / CLOSE * at->d * behind);
  return some & (at->along > -at->d - more) & (at->past < at->d + more)
         & (s > -BEFORE * at->d - more) & (s < GONE * at->d + more)
         & (n < 1.001 * bt__four_max (near, wide) + more);
}

static BT__HOT int
is_near_box (const bt__lee_node *node, bt_vec3 c, double r)
{
  bt_vec3 low = bt__vec (node->low[0] - r, node->low[1] - r, node->low[2] - r);
  bt_vec3 high = bt__vec (node->high[0] + r, node->high[1] + r, node->high[2] + r);
  return c.x >= low.x && c.x <= high.x && c.y >= low.y && c.y <= high.y && c.z >= low.z
         && c.z <= high.z;
}

/* Find the blocks for places within R metres of C, in the order of the tree; false if there are
   more than NEAR.  */
static BT__HOT int
find_nearby (const bt_lees *lees, bt_vec3 ambient, bt_vec3 c, double r, nearby *found)
{
  double speed2 = ambient.x * ambient.x + ambient.y * ambient.y + ambient.z * ambient.z;
  found->n = 0;
  for (uint32_t i = 0; i < lees->nodes;)
    {
      const bt__lee_node *node = lees->node + i;
      int inside = is_near_box (node, c, r);
      for (uint32_t k = node->first; inside && k < node->first + node->blocks; k++)
        {
          place at = find_place (lees->block + k, ambient, c);
          if (!bt__four_which (may_leave_lee (&at, speed2, r)))
            continue;
          if (found->n == NEAR)
            return 0;
          found->leaf[found->n] = i;
          found->block[found->n++] = lees->block + k;
        }
      i = inside ? i + 1 : node->skip;
    }
  return 1;
}

/* The share at P: the factors of share_at other than 1, multiplied leaf by leaf as in share_at.  */
static BT__HOT double
share_of_nearby (const nearby *found, bt_vec3 ambient, double speed, bt_vec3 p)
{
  bt__four share = { 1, 1, 1, 1 };
  for (int i = 0; i < found->n;)
    {
      bt__four leaf = { 1, 1, 1, 1 };
      int k = i;
      for (; k < found->n && found->leaf[k] == found->leaf[i]; k++)
        leaf *= share_of_blocks (found->block[k], found->block[k] + 1, ambient, speed, p);
      share *= leaf;
      i = k;
    }
  return (share[0] * share[2]) * (share[1] * share[3]);
}

static BT__WIDE int
shares_together (const bt_lees *lees, bt_vec3 ambient, const bt_vec3 *p, size_t n, double *share)
{
  bt_vec3 c = bt__scale (0.5, bt__add (p[0], p[n - 1]));
  double r = 0, speed = bt__norm (ambient);
  nearby found;
  for (size_t i = 0; i < n; i++)
    {
      double away = bt__distance (p[i], c);
      r = away > r || !(away == away) ? away : r;
    }
  if (!(r < INFINITY) || !find_nearby (lees, ambient, c, r, &found))
    return 0;
  for (size_t i = 0; i < n; i++)
    share[i] = share_of_nearby (&found, ambient, speed, p[i]);
  return 1;
}

void
bt_lees_shares (const bt_lees *lees, bt_vec3 ambient, const bt_vec3 *p, size_t n, double *share)
{
  for (size_t i = 0; i < n; i += TOGETHER)
    {
      size_t count = n - i < TOGETHER ? n - i : TOGETHER;
      if (count == 1 || !shares_together (lees, ambient, p + i, count, share + i))
        for (size_t k = i; k < i + count; k++)
          share[k] = share_at (lees, ambient, p[k]);
    }
}

double
bt_wake_share (const bt_wake *wake, bt_vec3 ambient, bt_vec3 p)
{
  bt__wakes block = { 0 };
  bt__lee_node all
      = { { -INFINITY, -INFINITY, -INFINITY }, { INFINITY, INFINITY, INFINITY }, 0, 1, 1 };
  bt_lees alone = { 1, 1, &all, &block };
  bt__wakes_put (&block, 0, wake);
  return share_at (&alone, ambient, p);
}
