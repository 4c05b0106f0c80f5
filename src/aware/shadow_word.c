/* Asking shadows: the strips that a line crosses, link by link, with their letters multiplied.

   A link of the line crosses the shadow of an edge if the two segments cross in the picture (u, z)
   and the link is deeper there than the edge.  The letter of the edge's piece enters with the sign
   of the side to which the link goes.  The passages of a link are sorted by place on the link.
   Every letter is then replaced by a word in the generators left by Tietze elimination, and the
   product is reduced freely as the word grows (word.c).

   Time per link is that of the edges in the bins under the link.  An edge and a link may share
   several bins; the pair is tested in the first of the shared bins alone.  A link across more than
   64 shadows makes the word `lost': a lost word equals no word.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <stdlib.h>

#include "aware/shadow_job.h"

enum
{
  AT_ONCE = 64 /* strips one link crosses, at most */
};

typedef struct passage
{
  double s; /* share of the link */
  int32_t letter;
} passage;

typedef struct passages
{
  uint32_t n;
  passage at[AT_ONCE];
  int lost;
} passages;

/* Keep them in the order of the link.  */
static void
insert_passage (passages *list, double s, int32_t letter)
{
  if (list->n == AT_ONCE)
    {
      list->lost = 1;
      return;
    }
  uint32_t i = list->n++;
  for (; i > 0 && list->at[i - 1].s > s; i--)
    list->at[i] = list->at[i - 1];
  list->at[i] = (passage){ s, letter };
}

/* Add to LIST the passage of the link from A to B through the shadow of edge E, if the link crosses
   the shadow.  */
static void
pass_shadow (const bt__shadow *x, bt__flat a, bt__flat b, uint32_t e, passages *list)
{
  bt__flat c = x->at[x->edge[e][0]], d = x->at[x->edge[e][1]];
  double s, t;
  if ((a.w < c.w && a.w < d.w && b.w < c.w && b.w < d.w) || !bt__do_cross (a, b, c, d, &s, &t)
      || !(bt__depth_at (a, b, s) > bt__depth_at (c, d, t)))
    return;
  int32_t letter = bt__letter_at (x, e, t);
  insert_passage (list, s, bt__side_of (c, d, b) > bt__side_of (c, d, a) ? letter : -letter);
}

/* True if bin (I, J) is the first bin that areas A and B share.  A pair is tested in this bin
   alone.  */
static int
is_first (const bt__area *a, const bt__area *b, uint32_t i, uint32_t j)
{
  return i == (a->from[0] > b->from[0] ? a->from[0] : b->from[0])
         && j == (a->from[1] > b->from[1] ? a->from[1] : b->from[1]);
}

static void
pass_link (const bt__shadow *x, bt__flat a, bt__flat b, passages *list)
{
  bt__area r = bt__area_of (x, a, b);
  list->n = 0;
  for (uint32_t j = r.from[1]; j <= r.to[1]; j++)
    for (uint32_t i = r.from[0]; i <= r.to[0]; i++)
      {
        const uint32_t *bin = x->bin + i + BT__SHADOW_BINS * j;
        for (uint32_t k = bin[0]; k < bin[1]; k++)
          if (is_first (&r, x->area + x->in[k], i, j))
            pass_shadow (x, a, b, x->in[k], list);
      }
}

void
bt__shadow_word (const bt__shadow *x, const bt_vec3 *p, uint32_t n, bt__word *word)
{
  passages list = { .n = 0 };
  bt__word_begin (word, x->world, (int)x->report.decided);
  bt__flat a = n ? bt__flatten (x, p[0]) : (bt__flat){ 0, 0, 0 };
  for (uint32_t i = 1; i < n; i++)
    {
      bt__flat b = bt__flatten (x, p[i]);
      pass_link (x, a, b, &list);
      for (uint32_t k = 0; k < list.n; k++)
        {
          int32_t letter = list.at[k].letter;
          const bt__letters *is = x->group.is + abs (letter) - 1;
          bt__word_add (word, is->at, is->n, letter < 0);
        }
      a = b;
    }
  word->lost |= list.lost;
  bt__word_end (word);
}
