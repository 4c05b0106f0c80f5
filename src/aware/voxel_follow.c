/* Following a line through the voxels: the word of a line that passes between the middles of cells.

   The present point P of the line is joined to the middle of a clear cell by a clear segment.
   While P moves on to Q, the triangle of the middle, P and Q must be clear; then no obstacle lies
   between the old and the new segment, and the class is kept.  If the triangle is not clear, the
   segment changes to a cell up to two steps away, over steps that are clear and in sight of P, and
   the labels of these steps are multiplied to the word.  Between pieces the segment changes to
   neighbours nearer to P (come_near): segments stay short, and most triangles are known to be clear
   from the distance of the cell.

   Pieces are half a cell long and halved where no cell is found; a line that would need pieces
   below a fiftieth of a cell is `lost'.  Both ends finish at the nearest cell: the word depends on
   the ends and on the class of the line, not on the cells along the way.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <stdlib.h>

#include "aware/voxel_job.h"

/* The line is at P, joined to the middle of CELL by a clear segment.  */
typedef struct follower
{
  const bt__voxels *v;
  bt__word *word;
  bt__count *count;
  bt_vec3 p;
  uint32_t cell;
} follower;

/* True if the triangle of the middle of CELL, P and Q is clear.  */
static int
clears (follower *f, uint32_t cell, bt_vec3 p, bt_vec3 q)
{
  bt_vec3 middle = bt__voxel_middle (f->v, cell);
  double reach = fmax (bt__distance (middle, p), bt__distance (middle, q));
  return reach < f->v->clear[cell] || bt__voxel_sees (f->v, middle, p, q, f->count);
}

/* Step from CELL along AXIS, WAY; the letters into the word.  */
static void
walk (follower *f, uint32_t from, int axis, int way)
{
  const bt__voxels *v = f->v;
  uint32_t cell = way > 0 ? from : bt__voxel_next (v, from, axis, -1);
  uint32_t word = (uint32_t)v->label[3 * cell + (uint32_t)axis];
  for (uint32_t i = v->pool.start[word]; i < v->pool.start[word + 1]; i++)
    {
      uint32_t k = way > 0 ? i : v->pool.start[word] + v->pool.start[word + 1] - 1 - i;
      int32_t letter = v->pool.letter[k];
      const bt__letters *is = v->group.is + abs (letter) - 1;
      bt__word_add (f->word, is->at, is->n, (letter < 0) != (way < 0));
    }
}

static int
can_step (const bt__voxels *v, uint32_t cell, int axis, int way, uint32_t *to)
{
  *to = bt__voxel_next (v, cell, axis, way);
  if (*to == BT__NOWHERE)
    return 0;
  return v->open[way > 0 ? cell : *to] >> axis & 1;
}

/* Change to neighbours nearer to the line while the way to the neighbour is clear.  */
static void
come_near (follower *f)
{
  for (int moved = 1; moved;)
    {
      double now = bt__distance (bt__voxel_middle (f->v, f->cell), f->p);
      moved = 0;
      for (int k = 0; k < 6 && !moved; k++)
        {
          uint32_t to;
          if (!can_step (f->v, f->cell, k / 2, k % 2 ? 1 : -1, &to)
              || bt__distance (bt__voxel_middle (f->v, to), f->p) > now - 1e-9
              || !clears (f, f->cell, bt__voxel_middle (f->v, to), f->p))
            continue;
          walk (f, f->cell, k / 2, k % 2 ? 1 : -1);
          f->cell = to;
          moved = 1;
        }
    }
}

/* Move the line on to Q with its present cell or with a cell up to DEPTH steps away.  */
static int
go_on (follower *f, bt_vec3 q, int depth)
{
  if (clears (f, f->cell, f->p, q))
    return 1;
  uint32_t here = f->cell;
  for (int k = 0; k < 6 && depth > 0; k++)
    {
      uint32_t to;
      if (!can_step (f->v, here, k / 2, k % 2 ? 1 : -1, &to)
          || !clears (f, here, bt__voxel_middle (f->v, to), f->p))
        continue;
      bt__word before = *f->word;
      walk (f, here, k / 2, k % 2 ? 1 : -1);
      f->cell = to;
      if (go_on (f, q, depth - 1))
        return 1;
      *f->word = before;
      f->cell = here;
    }
  return 0;
}

/* The nearest cell that sees the line's point, BT__NOWHERE if none does.  */
static uint32_t
nearest_cell (follower *f)
{
  uint32_t own = bt__voxel_of (f->v, f->p), best = BT__NOWHERE;
  double nearest = INFINITY;
  for (int k = 0; k < 27; k++)
    {
      uint32_t cell = own;
      for (int a = 0, m = k; a < 3 && cell != BT__NOWHERE; a++, m /= 3)
        cell = m % 3 == 1 ? cell : bt__voxel_next (f->v, cell, a, m % 3 - 1);
      if (cell == BT__NOWHERE || !(f->v->clear[cell] > 0))
        continue;
      double d = bt__distance (bt__voxel_middle (f->v, cell), f->p);
      if (d < nearest && clears (f, cell, f->p, f->p))
        {
          nearest = d;
          best = cell;
        }
    }
  return best;
}

/* Change to cell TARGET by up to DEPTH steps.  */
static int
arrive_at_cell (follower *f, uint32_t target, int depth)
{
  uint32_t here = f->cell;
  if (here == target)
    return 1;
  for (int k = 0; k < 6 && depth > 0; k++)
    {
      uint32_t to;
      if (!can_step (f->v, here, k / 2, k % 2 ? 1 : -1, &to)
          || !clears (f, here, bt__voxel_middle (f->v, to), f->p))
        continue;
      bt__word before = *f->word;
      walk (f, here, k / 2, k % 2 ? 1 : -1);
      f->cell = to;
      if (arrive_at_cell (f, target, depth - 1))
        return 1;
      *f->word = before;
      f->cell = here;
    }
  return 0;
}

/* Follow the line to Q in pieces of half a cell, in finer pieces where no cell is found.  */
static int
follow_in_pieces (follower *f, bt_vec3 q)
{
  double piece = 0.5 * f->v->c.cell;
  for (double left = bt__distance (f->p, q); left > 0; left = bt__distance (f->p, q))
    {
      double step = fmin (piece, left);
      bt_vec3 to = step < left ? bt__axpy (f->p, step / left, bt__sub (q, f->p)) : q;
      if (!go_on (f, to, 2))
        {
          piece *= 0.5;
          if (piece < 0.02 * f->v->c.cell)
            return 0;
          continue;
        }
      f->p = to;
      come_near (f);
      piece = fmin (2 * piece, 0.5 * f->v->c.cell);
    }
  return 1;
}

void
bt__voxels_word (const bt__voxels *v, const bt_vec3 *p, uint32_t n, bt__word *word,
                 bt__count *count)
{
  bt__word_begin (word, v->world, v->report.leftover == 0);
  follower f = { v, word, count, n ? p[0] : bt__vec (0, 0, 0), 0 };
  f.cell = n ? nearest_cell (&f) : BT__NOWHERE;
  int lost = f.cell == BT__NOWHERE;
  for (uint32_t i = 1; i < n && !lost; i++)
    lost = !follow_in_pieces (&f, p[i]);
  if (!lost)
    {
      /* The same cell at the same end, whatever way led there.  */
      uint32_t last = nearest_cell (&f);
      lost = last == BT__NOWHERE || !arrive_at_cell (&f, last, 4);
    }
  word->lost |= lost;
  bt__word_end (word);
}
