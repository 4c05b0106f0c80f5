/* A group given by letters and relations, and as few of both as simple moves leave.

   Tietze elimination: a relation in which a letter occurs once expresses the letter by the other
   letters; this word replaces the letter everywhere.  When no such relation is left, Nielsen moves
   shorten the relations.  Without relations left the group is free on the remaining letters, and
   reduced words decide equality.  At load only: it allocates.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#ifndef BT_AWARE_TIETZE_H
#define BT_AWARE_TIETZE_H

#include <stdint.h>

#include <bight/status.h>

#include "base/ask.h"

/* Letters of a word, +k or -k for letter k from 1.  */
typedef struct bt__letters
{
  int32_t *at;
  uint32_t n, room;
} bt__letters;

typedef struct bt__group
{
  uint32_t letters, relations, room;
  bt__letters *relation;
  bt__letters *is;   /* what letter k - 1 is in the generators, once simplified */
  int32_t *origin;   /* the letter that generator g - 1 was */
  uint32_t rank;     /* generators left */
  uint32_t leftover; /* relations left; 0: free on them */
  uint32_t longest;  /* of the words IS */
  int failed;        /* memory ran out */
  bt__asker *asker;  /* of the simplifying, or NULL: to be set between the calls below */
} bt__group;

/* Make GROUP (any bytes) that of LETTERS letters without relations.  */
void bt__group_begin (bt__group *group, uint32_t letters);

/* Add the relation that the N LETTERS are nothing.  */
void bt__group_relate (bt__group *group, const int32_t *letters, uint32_t n);

/* Simplify, and fill IS and the rest.  BT_ERR_LIMIT if memory ran out since the beginning,
   BT_ERR_INTERRUPTED.  */
bt_status bt__group_simplify (bt__group *group, bt_error *error);

void bt__group_free (bt__group *group);

#endif
