/* The answer of a reader program, as bytes: a head, a body, a checksum, and nothing after it.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#ifndef BT_MESH_ANSWER_H
#define BT_MESH_ANSWER_H

#include <stddef.h>
#include <stdint.h>

#include <bight/status.h>

/* Where bytes come from.  READ returns how many it got, fewer than N only at the end.  */
typedef struct bt__answer
{
  size_t (*read) (void *user, void *to, size_t n);
  void *user;
  const char *title; /* of the program, as a sentence calls it: "the mesh reader" */
} bt__answer;

/* Read N bytes, the reader's WHAT, to TO.  BT_ERR_FORMAT when there are fewer.  */
bt_status bt__answer_take (const bt__answer *answer, void *to, size_t n, const char *what,
                           bt_error *error);

/* Find the checksum SUM next, and nothing after it: BT_ERR_FORMAT otherwise.  */
bt_status bt__answer_finish (const bt__answer *answer, uint64_t sum, bt_error *error);

#endif
