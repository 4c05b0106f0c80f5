/* A tree of boxes over the wakes of a sea, split at medians.

   The lee of a cylinder lies within BT__LEE_REACH diameters of the axis and one diameter beyond the
   ends.  A question about a place therefore asks only wakes with the place in their boxes; its cost
   grows with the lees near by, not with the number of obstacles.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <math.h>
#include <stdlib.h>

#include "base/error.h"
#include "math/vec.h"
#include "sea/lees.h"

/* A wake to be sorted; NUMBER decides between wakes with equal middles.  */
typedef struct item
{
  double middle[3];
  bt_wake wake;
  size_t number;
} item;

static double
coordinate (bt_vec3 p, int k)
{
  return k == 0 ? p.x : k == 1 ? p.y : p.z;
}

/* The middle of the axis of W along coordinate K, and half the width of the box about its lee.  */
static double
middle_of_axis (const bt_wake *w, int k)
{
  return coordinate (w->a, k) + w->length / 2 * coordinate (w->axis, k);
}

static double
half_width (const bt_wake *w, int k)
{
  double e = fabs (coordinate (w->axis, k)), d = 2 * w->radius;
  return w->length / 2 * e + d * (e + BT__LEE_REACH * sqrt (fmax (0, 1 - e * e)));
}

static void
set_box (bt__lee_node *node, const item *items, size_t n)
{
  for (int k = 0; k < 3; k++)
    {
      node->low[k] = INFINITY;
      node->high[k] = -INFINITY;
      for (size_t i = 0; i < n; i++)
        {
          double half = half_width (&items[i].wake, k) * (1 + 1e-9);
          node->low[k] = fmin (node->low[k], items[i].middle[k] - half);
          node->high[k] = fmax (node->high[k], items[i].middle[k] + half);
        }
    }
}

/* ---- Splitting ---- */

static int
compare_along (const item *a, const item *b, int k)
{
  if (a->middle[k] != b->middle[k])
    return a->middle[k] < b->middle[k] ? -1 : 1;
  return a->number < b->number ? -1 : a->number > b->number;
}

static int
by_x (const void *a, const void *b)
{
  return compare_along (a, b, 0);
}

static int
by_y (const void *a, const void *b)
{
  return compare_along (a, b, 1);
}

static int
by_z (const void *a, const void *b)
{
  return compare_along (a, b, 2);
}

static void
sort_along_longest (item *items, size_t n)
{
  static int (*const order[3]) (const void *, const void *) = { by_x, by_y, by_z };
  int longest = 0;
  double most = -1;
  for (int k = 0; k < 3; k++)
    {
      double low = INFINITY, high = -INFINITY;
      for (size_t i = 0; i < n; i++)
        {
          low = fmin (low, items[i].middle[k]);
          high = fmax (high, items[i].middle[k]);
        }
      if (high - low > most)
        {
          most = high - low;
          longest = k;
        }
    }
  qsort (items, n, sizeof *items, order[longest]);
}

static void
add_leaf (bt_lees *lees, bt__lee_node *leaf, const item *items, size_t n)
{
  leaf->first = lees->blocks;
  for (size_t i = 0; i < n; i++)
    {
      if (i % BT__WAKES_WIDE == 0)
        lees->blocks++;
      bt__wakes_put (lees->block + lees->blocks - 1, i % BT__WAKES_WIDE, &items[i].wake);
    }
  leaf->blocks = lees->blocks - leaf->first;
}

/* Add the node of N ITEMS and all nodes below.  Halves are whole leaves as far as possible: few
   places of blocks stay unused.  */
static void
add_node (bt_lees *lees, item *items, size_t n)
{
  const size_t leaf = BT__LEAF_BLOCKS * BT__WAKES_WIDE;
  bt__lee_node *node = lees->node + lees->nodes++;
  set_box (node, items, n);
  node->first = node->blocks = 0;
  if (n <= leaf)
    add_leaf (lees, node, items, n);
  else
    {
      size_t half = (n / 2 + leaf - 1) / leaf * leaf;
      sort_along_longest (items, n);
      add_node (lees, items, half);
      add_node (lees, items + half, n - half);
    }
  node->skip = lees->nodes;
}

/* ---- Made and gone ---- */

static item *
items_of (const bt_wake *wakes, size_t n)
{
  item *items = calloc (n, sizeof *items);
  for (size_t i = 0; items && i < n; i++)
    {
      items[i].wake = wakes[i];
      items[i].number = i;
      for (int k = 0; k < 3; k++)
        items[i].middle[k] = middle_of_axis (&wakes[i], k);
    }
  return items;
}

bt_status
bt_lees_new (const bt_wake *wakes, size_t n, bt_lees **out, bt_error *error)
{
  size_t leaves = n / (BT__LEAF_BLOCKS * BT__WAKES_WIDE) + 1;
  bt_lees *lees = *out = NULL;
  item *items;
  if (n == 0)
    return BT_OK;
  items = items_of (wakes, n);
  lees = calloc (1, sizeof *lees);
  if (lees)
    {
      lees->node = calloc (2 * leaves, sizeof *lees->node);
      lees->block = calloc (leaves * BT__LEAF_BLOCKS, sizeof *lees->block);
    }
  if (!items || !lees || !lees->node || !lees->block)
    {
      free (items);
      bt_lees_free (lees);
      return bt__fail (error, BT_ERR_LIMIT, "no memory for the lee of obstacles");
    }
  add_node (lees, items, n);
  free (items);
  *out = lees;
  return BT_OK;
}

void
bt_lees_free (bt_lees *lees)
{
  if (!lees)
    return;
  free (lees->node);
  free (lees->block);
  free (lees);
}
