/* Words: free reduction at the end of a stack.

   A word is a product of generators and their inverses, written as positive and negative numbers. A
   new letter cancels against the last letter of the stack if the two are inverse, else is pushed;
   so a word is reduced at all times, and in a free group two words are equal exactly if their
   reduced forms are.  Unused room is zero, so words are compared byte by byte.  A word too long for
   the room is `lost' and equals no word, not even a copy.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <string.h>

#include "aware/word.h"

void
bt__word_begin (bt__word *w, uint64_t world, int decided)
{
  w->world = world;
  w->n = 0;
  w->decided = decided != 0;
  w->lost = 0;
}

static void
push_letter (bt__word *w, int32_t letter)
{
  if (w->n > 0 && w->letter[w->n - 1] == -letter)
    w->n--;
  else if (w->n < BT__WORD_MAX)
    w->letter[w->n++] = letter;
  else
    w->lost = 1;
}

void
bt__word_add (bt__word *w, const int32_t *letters, uint32_t n, int inverse)
{
  for (uint32_t i = 0; i < n; i++)
    push_letter (w, inverse ? -letters[n - 1 - i] : letters[i]);
}

void
bt__word_end (bt__word *w)
{
  memset (w->letter + w->n, 0, (BT__WORD_MAX - w->n) * sizeof *w->letter);
}

void
bt__word_relative (const bt__word *a, const bt__word *b, bt__word *out)
{
  bt__word_begin (out, a->world, a->decided && b->decided);
  out->lost = a->lost || b->lost || a->world != b->world;
  bt__word_add (out, a->letter, a->n, 0);
  bt__word_add (out, b->letter, b->n, 1);
  bt__word_end (out);
}
