/* Remeshing of a line among obstacles while a winch turns.

   Taking a node out moves the line, as if the node went straight to the chord of its neighbours.
   Putting a node on the curve moves the line too, as if the node came from the chord.  So a node is
   taken out only if its way to the chord is clear, and put on the chord itself where anything is
   near.  Sliding nodes and their neighbours stay.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <string.h>

#include "contact/line_bend.h"

enum
{
  TURNS = 16, /* intervals that the winch adds or takes in a step */
  TRIES = 4,  /* nodes that are asked whether they can be taken out */
  ABOUT = 4   /* nodes on either side of a sliding node: their places are chosen by contact, not by
                 the mesh */
};

/* What the line has to keep to beside the nodes that contact put in.  */
static bt__dynamic_mesh
mesh_of (const bt__line_job *k, const bt__sliding *s)
{
  bt__dynamic_mesh mesh = k->in->mesh;
  mesh.fewest += mesh.fewest > 0 ? ABOUT * s->n : 0;
  return mesh;
}

/* Contacts upstream of NODE go with the line, longer by MORE between NODE and the far end.  */
static void
shift_anchors (bt__line_job *k, double from, double more)
{
  bt__contact *a = bt__contacts_at (k->anchors);
  for (int64_t q = 0; q < k->anchors->n; q++)
    {
      int itself = a[q].mover == BT__CONTACT_LINE && a[q].object == k->config->id;
      a[q].from_end += a[q].from_end > from ? more : 0;
      a[q].other += itself && a[q].other > from ? more : 0;
    }
}

/* Note that the line's nodes have changed, whose inner length was INNER; the far part of what
   changed begins FROM the end.  */
static void
note_change (bt__line_job *k, double from, double inner)
{
  bt__sliding_measure (k);
  shift_anchors (k, from, k->w->from_end[1] - inner);
  k->w->self.still = 0;
}

static int
take_out (bt__line_job *k, bt__sliding *s, int64_t i)
{
  double from = k->w->from_end[i], inner = k->w->from_end[1];
  if (!bt__sliding_take_out (k, s, i))
    return 0;
  note_change (k, i > 1 ? from : INFINITY, inner);
  return 1;
}

/* True if nothing is near enough to interval J to meet the curve of the interval.  */
static int
is_interval_clear (bt__line_job *k, int64_t j)
{
  const double *rest = bt__dynamic_rest (k->d);
  bt__link link = bt__link_of (bt__dynamic_x (k->d), (uint32_t)j);
  bt__near unused;
  return k->movers == 0
         && !bt__scene_nearest (k->scene, k->on, &link, 0.5 * rest[j] + k->core, &unused, k->count)
         && bt__self_is_clear (k, j, 0.5 * rest[j]);
}

/* Note that a node came to interval J, which began FROM the far end, and was INNER.  */
static void
note_node (bt__line_job *k, bt__sliding *s, int64_t j, double from, double inner)
{
  bt__sliding_came (k, s, j + 1);
  note_change (k, j > 0 ? from : INFINITY, inner);
}

static void
put_between (bt__line_job *k, bt__sliding *s, int64_t j)
{
  double from = k->w->from_end[j + 1], inner = k->w->from_end[1];
  bt__dynamic_split (k->d, j, 0.5, !is_interval_clear (k, j));
  note_node (k, s, j, from, inner);
}

/* Let a node come out of the winch.  */
static void
put_first (bt__line_job *k, bt__sliding *s, const bt__dynamic_turn *next)
{
  double inner = k->w->from_end[1];
  int clear = is_interval_clear (k, 0);
  if (next->lump && clear)
    bt__dynamic_split_at_lump (k->d, next->first, k->in);
  else
    bt__dynamic_split_first (k->d, next, next->straight || !clear);
  note_node (k, s, 0, INFINITY, inner);
}

static void
flag (uint8_t *kept, int64_t first, int64_t last, int64_t n)
{
  for (int64_t i = first < 0 ? 0 : first; i <= last && i <= n; i++)
    kept[i] = 1;
}

/* Flag in KEPT the sliding nodes with the next WIDE nodes to either side, and the nodes about
   lumps.  */
static void
keep_held (const bt__line_job *k, const bt__sliding *s, int wide, uint8_t *kept)
{
  memset (kept, 0, (size_t)k->d->n + 1);
  bt__dynamic_keep_lumps (k->d, k->in, wide == 1, kept);
  for (int q = 0; q < s->n; q++)
    flag (kept, s->node[q] - wide, s->node[q] + wide, k->d->n);
}

/* The same for the nodes of intervals that touch: The memory of a contact belongs to its place, and
   a new node loses a part of the memory.  */
static void
keep_touching (const bt__line_job *k, int wide, uint8_t *kept)
{
  const bt__contact *a = bt__contacts_at (k->anchors);
  int64_t i = 0;
  for (int64_t q = 0; q < k->anchors->n; q++)
    {
      while (i + 1 < k->d->n && k->w->from_end[i + 1] >= a[q].from_end)
        i++;
      flag (kept, i - wide, i + 1 + wide, k->d->n);
    }
}

/* Take out the most dispensable node among the nodes without contact, or with TOUCHING among all,
   if its way is clear; the first few are tried.  */
static int
spare_one (bt__line_job *k, bt__sliding *s, int touching)
{
  uint8_t *kept = k->w->restart; /* of the step, which is over */
  keep_held (k, s, 1, kept);
  if (!touching)
    keep_touching (k, 1, kept);
  for (int t = 0; t < TRIES; t++)
    {
      int64_t i = bt__dynamic_spare_node (k->d, kept);
      if (i == 0)
        return 0;
      if (take_out (k, s, i))
        {
          bt__dynamic_refit (k->d);
          return 1;
        }
      kept[i] = 1;
    }
  return 0;
}

/* Halve the interval with the largest part of the shape, away from all contacts.  */
static void
halve_one (bt__line_job *k, bt__sliding *s)
{
  uint8_t *kept = k->w->restart;
  keep_held (k, s, ABOUT, kept);
  keep_touching (k, ABOUT, kept);
  int64_t j = bt__dynamic_worst_interval (k->d, &k->in->mesh, kept);
  if (j == 0)
    return;
  put_between (k, s, j);
  bt__dynamic_refit (k->d);
}

/* The nodes at which lumps make corners of the line, or NULL.  */
static const uint8_t *
corners (const bt__line_job *k)
{
  uint8_t *kept = k->w->restart;
  if (k->in->n_lumps == 0)
    return NULL;
  memset (kept, 0, (size_t)k->d->n + 1);
  bt__dynamic_keep_lumps (k->d, k->in, 0, kept);
  return kept;
}

static void
tune (bt__line_job *k, bt__sliding *s)
{
  bt__dynamic_mesh mesh = mesh_of (k, s);
  int wants = bt__dynamic_wants (k->d, &mesh, corners (k));
  if (wants < 0)
    spare_one (k, s, 0);
  else if (wants > 0)
    halve_one (k, s);
}

/* Turn the winch by one interval.  */
static int
turn (bt__line_job *k, bt__sliding *s, const bt__dynamic_turn *next)
{
  if (next->way < 0)
    return take_out (k, s, 1);
  if (!bt__dynamic_is_open (k->d, &k->in->mesh) && !spare_one (k, s, 0))
    spare_one (k, s, 1);
  if (k->d->n >= k->d->n_max)
    return 0;
  put_first (k, s, next);
  return 1;
}

/* Do NEXT, and whatever else the first interval asks the winch for then.  */
static void
turn_all (bt__line_job *k, bt__sliding *s, bt__dynamic_turn next)
{
  for (int t = 0; t < TURNS && next.way != 0; t++)
    {
      if (!turn (k, s, &next))
        return;
      for (int u = 0; u < BT__DYNAMIC_TUNES; u++)
        tune (k, s);
      next = bt__dynamic_winding (k->d, k->in);
    }
}

void
bt__line_wind (bt__line_job *k)
{
  bt__sliding s;
  bt__dynamic_turn next = bt__dynamic_winding (k->d, k->in);
  if (next.way == 0 && !k->in->mesh.idle)
    return;
  bt__sliding_measure (k);
  bt__sliding_gather (k, &s);
  turn_all (k, &s, next);
  if (k->in->mesh.idle)
    tune (k, &s);
  bt__sliding_measure (k);
  bt__sliding_scatter (k, &s);
}
