/* Labels on the steps between voxels: generators and relations of the edge-path group.

   The edge-path group of a complex has a generator for every step outside a spanning tree and a
   relation for every square.  A grid has far more steps than holes, so generators are not written
   down and eliminated; labels are propagated instead:

   1. grow_trees labels the steps of a spanning tree of every connected part of the water, found
   breadth first, with the empty word.

   2.  A clear square with exactly one unlabelled step settles the label of the step: the product
   once round the square is 1.  The settled step is queued, and the squares about the step are
   looked at next (spread_labels).  Every step is queued once.

   3.  When the queue is empty, the next clear step without a label gets a new letter as its label,
   and step 2 goes on.  Each new letter stands for a hole, or for a loop that a later square will
   relate.

   4.  Squares whose four labels do not cancel are relations (relate_squares), gathered until there
   are 4096; tietze.c eliminates letters by them.

   Labels are numbers of words in a pool with a hash table, since most steps share a few words.  A
   label longer than 512 letters, or no memory, makes the grid fail as a whole.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <stdlib.h>
#include <string.h>

#include "aware/voxel_job.h"
#include "base/error.h"
#include "base/hash.h"

enum
{
  LETTERS = 512,   /* of a label, at most */
  RELATIONS = 4096 /* kept; more make no sense */
};

/* ---- The pool of words ---- */

static int
grow_array (void **at, uint32_t *room, uint32_t need, size_t size)
{
  if (need <= *room)
    return 1;
  uint32_t now = *room ? *room : 64;
  while (now < need)
    now *= 2;
  void *more = realloc (*at, now * size);
  if (!more)
    return 0;
  *at = more;
  *room = now;
  return 1;
}

static uint32_t
home_of (const bt__pool *p, const int32_t *letters, uint32_t n)
{
  return (uint32_t)bt__hash (letters, n * sizeof *letters, 3) & (p->slots - 1);
}

static void
put_in_table (bt__pool *p, uint32_t word)
{
  uint32_t at = home_of (p, p->letter + p->start[word], p->start[word + 1] - p->start[word]);
  while (p->slot[at] != BT__NOWHERE)
    at = (at + 1) & (p->slots - 1);
  p->slot[at] = word;
}

static int
grow_table (bt__pool *p)
{
  uint32_t slots = p->slots ? 2 * p->slots : 256;
  uint32_t *slot = realloc (p->slot, slots * sizeof *slot);
  if (!slot)
    return 0;
  p->slot = slot;
  p->slots = slots;
  memset (slot, 0xff, slots * sizeof *slot);
  for (uint32_t i = 0; i < p->n; i++)
    put_in_table (p, i);
  return 1;
}

/* The number of the word LETTERS.  */
static int32_t
number_of (bt__pool *p, const int32_t *letters, uint32_t n)
{
  if (2 * (p->n + 1) > p->slots && !grow_table (p))
    p->failed = 1;
  if (p->failed)
    return 0;
  for (uint32_t at = home_of (p, letters, n); p->slot[at] != BT__NOWHERE;
       at = (at + 1) & (p->slots - 1))
    {
      uint32_t i = p->slot[at];
      if (p->start[i + 1] - p->start[i] == n
          && (n == 0 || memcmp (p->letter + p->start[i], letters, n * sizeof *letters) == 0))
        return (int32_t)i;
    }
  if (!grow_array ((void **)&p->start, &p->room, p->n + 2, sizeof *p->start)
      || !grow_array ((void **)&p->letter, &p->letter_room, p->letters + n, sizeof *p->letter))
    {
      p->failed = 1;
      return 0;
    }
  if (n > 0)
    memcpy (p->letter + p->letters, letters, n * sizeof *letters);
  p->start[p->n] = p->letters;
  p->letters += n;
  p->start[++p->n] = p->letters;
  put_in_table (p, p->n - 1);
  return (int32_t)(p->n - 1);
}

/* ---- Squares ---- */

/* The steps once round the square across AXIS from CELL; the last two are gone backwards.  */
static void
steps_of (const bt__voxels *v, uint32_t cell, int axis, uint32_t step[4])
{
  int b = (axis + 1) % 3, c = (axis + 2) % 3;
  uint32_t x = bt__voxel_next (v, cell, b, 1), y = bt__voxel_next (v, cell, c, 1);
  step[0] = 3 * cell + (uint32_t)b;
  step[1] = 3 * x + (uint32_t)c;
  step[2] = 3 * y + (uint32_t)b;
  step[3] = 3 * cell + (uint32_t)c;
}

typedef struct stack
{
  int32_t letter[LETTERS];
  uint32_t n;
  int full;
} stack;

static void
multiply (const bt__voxels *v, stack *s, int32_t label, int inverse)
{
  const bt__pool *p = &v->pool;
  uint32_t from = p->start[label], n = p->start[label + 1] - from;
  for (uint32_t i = 0; i < n; i++)
    {
      int32_t letter = inverse ? -p->letter[from + n - 1 - i] : p->letter[from + i];
      if (s->n > 0 && s->letter[s->n - 1] == -letter)
        s->n--;
      else if (s->n < LETTERS)
        s->letter[s->n++] = letter;
      else
        s->full = 1;
    }
}

/* Put into *S the product of the labels of the three steps after step WHICH, once round the square;
   the three are labelled.  */
static void
round_from (const bt__voxels *v, const uint32_t step[4], int which, stack *s)
{
  s->n = 0;
  s->full = 0;
  for (int k = 1; k < 4; k++)
    {
      int i = (which + k) % 4;
      multiply (v, s, v->label[step[i]], i >= 2);
    }
}

/* If exactly one step of the square has no label, label the step and return its number; else return
   BT__NOWHERE.  */
static uint32_t
settle_square (bt__voxels *v, uint32_t cell, int axis)
{
  uint32_t step[4];
  int missing = -1;
  stack s;
  steps_of (v, cell, axis, step);
  for (int i = 0; i < 4; i++)
    if (v->label[step[i]] == BT__UNKNOWN)
      {
        if (missing >= 0)
          return BT__NOWHERE;
        missing = i;
      }
  if (missing < 0)
    return BT__NOWHERE;
  round_from (v, step, missing, &s);
  v->pool.failed |= s.full;
  /* A step gone forwards is the inverse of the product of the following steps, a step gone
     backwards the product.  */
  for (uint32_t i = 0; missing < 2 && i < s.n / 2 + s.n % 2; i++)
    {
      int32_t swap = -s.letter[i];
      s.letter[i] = -s.letter[s.n - 1 - i];
      s.letter[s.n - 1 - i] = swap;
    }
  v->label[step[missing]] = number_of (&v->pool, s.letter, s.n);
  return step[missing];
}

/* ---- Labelling ---- */

static void
start_labels (bt__voxels *v)
{
  for (uint32_t i = 0; i < 3 * v->cells; i++)
    v->label[i] = BT__UNKNOWN;
  number_of (&v->pool, NULL, 0);
}

/* Grow a tree over the clear cells of every connected part of the water; label 0, the empty word,
   for its steps.  */
static void
grow_trees (bt__voxels *v, uint8_t *seen)
{
  for (uint32_t root = 0; root < v->cells; root++)
    {
      if (seen[root] || !(v->clear[root] > 0))
        continue;
      uint32_t head = 0, tail = 0;
      v->queue[tail++] = root;
      seen[root] = 1;
      while (head < tail)
        {
          uint32_t cell = v->queue[head++];
          for (int k = 0; k < 6; k++)
            {
              int a = k / 2, way = k % 2 ? 1 : -1;
              uint32_t to = bt__voxel_next (v, cell, a, way);
              uint32_t low = way > 0 ? cell : to;
              if (to == BT__NOWHERE || seen[to] || !(v->open[low] >> a & 1))
                continue;
              seen[to] = 1;
              v->label[3 * low + (uint32_t)a] = 0;
              v->queue[tail++] = to;
            }
        }
    }
}

/* Settle the squares about STEP; the steps that get labels go on the queue.  */
static void
spread_labels (bt__voxels *v, uint32_t step, uint32_t *tail)
{
  uint32_t cell = step / 3;
  int a = (int)(step % 3);
  for (int k = 0; k < 4; k++)
    {
      int along = (a + 1 + k / 2) % 3, axis = 3 - a - along;
      uint32_t from = k % 2 ? bt__voxel_next (v, cell, along, -1) : cell;
      if (from == BT__NOWHERE || !(v->open[from] >> (3 + axis) & 1))
        continue;
      uint32_t settled = settle_square (v, from, axis);
      if (settled != BT__NOWHERE)
        v->queue[(*tail)++] = settled;
    }
}

static void
empty_queue (bt__voxels *v, uint32_t *head, uint32_t *tail)
{
  while (*head < *tail && !v->pool.failed && !bt__ask (v->asker))
    spread_labels (v, v->queue[(*head)++], tail);
}

/* Label all steps; return the number of generators.  A step is queued once, when the step gets its
   label, so the queue has room for all.  */
static uint32_t
label_steps (bt__voxels *v)
{
  uint32_t head = 0, tail = 0, generators = 0;
  for (uint32_t i = 0; i < 3 * v->cells; i++)
    if (v->label[i] == 0)
      v->queue[tail++] = i;
  empty_queue (v, &head, &tail);
  for (uint32_t i = 0; i < 3 * v->cells && !v->pool.failed; i++)
    {
      if (v->label[i] != BT__UNKNOWN || !(v->open[i / 3] >> i % 3 & 1))
        continue;
      if (bt__ask (v->asker))
        break;
      int32_t letter = (int32_t)++generators;
      v->label[i] = number_of (&v->pool, &letter, 1);
      v->queue[tail++] = i;
      empty_queue (v, &head, &tail);
    }
  return generators;
}

/* Make relations of the squares whose labels do not cancel.  */
static void
relate_squares (bt__voxels *v)
{
  int32_t last = 0;
  for (uint32_t i = 0; i < v->cells && v->group.relations < RELATIONS && !bt__ask (v->asker); i++)
    for (int a = 0; a < 3; a++)
      {
        uint32_t step[4];
        stack s;
        if (!(v->open[i] >> (3 + a) & 1))
          continue;
        steps_of (v, i, a, step);
        if ((v->label[step[0]] | v->label[step[1]] | v->label[step[2]] | v->label[step[3]]) == 0)
          continue;
        round_from (v, step, 3, &s);
        multiply (v, &s, v->label[step[3]], 1);
        if (s.n == 0)
          continue;
        /* Neighbouring squares mostly give the same relation: keep a relation only if it differs
           from the last.  */
        int32_t word = number_of (&v->pool, s.letter, s.n);
        if (word != last)
          bt__group_relate (&v->group, s.letter, s.n);
        last = word;
      }
}

bt_status
bt__voxels_label (bt__voxels *v, bt_error *error)
{
  uint8_t *seen = calloc (v->cells, 1);
  start_labels (v);
  if (seen)
    grow_trees (v, seen);
  uint32_t generators = seen ? label_steps (v) : 0;
  v->pool.failed |= !seen;
  free (seen);
  bt_status status = bt__stopped (v->asker, error);
  if (status != BT_OK)
    return status;
  if (v->pool.failed)
    return bt__fail (error, BT_ERR_LIMIT, "no memory for the labels of %u voxels",
                     (unsigned)v->cells);
  bt__group_begin (&v->group, generators);
  v->group.asker = v->asker;
  relate_squares (v);
  status = bt__group_simplify (&v->group, error);
  v->report.generators = v->group.rank;
  v->report.dropped = generators - v->group.rank;
  v->report.leftover = v->group.leftover + (v->group.relations >= RELATIONS);
  return status;
}
