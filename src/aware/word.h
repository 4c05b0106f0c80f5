/* A homotopy class as a value: a reduced word in the generators of the fundamental group of the
   water about the obstacles.

   Two lines with the same ends among the same obstacles can be moved into each other if their words
   are equal.  If the words are `decided', lines with unequal words cannot be moved into each other;
   words are decided if the group was shown to be free.  Words of different worlds, or of different
   tables of one world, are never equal.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#ifndef BT_AWARE_WORD_H
#define BT_AWARE_WORD_H

#include <stdint.h>

enum
{
  BT__WORD_MAX = 1022
};

/* Flat, no padding, zeros behind the letters: compared as bytes.  */
typedef struct bt__word
{
  uint64_t world;   /* whose generators */
  uint32_t n;       /* letters */
  uint16_t decided; /* true: unequal words are unequal classes */
  uint16_t lost;    /* true: the word exceeds the room, or the line is inside an obstacle */
  int32_t letter[BT__WORD_MAX]; /* generator g is g, its inverse -g; from 1 */
} bt__word;

/* Make *WORD the word without letters of WORLD.  */
void bt__word_begin (bt__word *word, uint64_t world, int decided);

/* Multiply *WORD by the N LETTERS from the right, or by their inverse, reducing.  */
void bt__word_add (bt__word *word, const int32_t *letters, uint32_t n, int inverse);

/* Put the zeros behind.  */
void bt__word_end (bt__word *word);

/* Make *OUT the word of A and then B backwards: without letters if they are the same way.  */
void bt__word_relative (const bt__word *a, const bt__word *b, bt__word *out);

#endif
