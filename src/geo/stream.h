/* The answer of bight-geo-reader to bight: one table of numbers.  Writer and reader are of one
   build on one machine: numbers have the form of the machine.

   head | rows, one after the other, doubles | checksum, 64 bits

   The checksum is bt__hash of the two parts in turn, each from the hash of the part before.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#ifndef BT_GEO_STREAM_H
#define BT_GEO_STREAM_H

#include <stddef.h>
#include <stdint.h>

#include <bight/status.h>

#include "mesh/answer.h"

#define BT__GEO_MAGIC "bt-geo\n"

enum
{
  BT__GEO_VERSION = 1,
  BT__GEO_FLOW_COLUMNS = 7, /* x y z t u v w */
  BT__GEO_FLOW_ROWS_MAX = 1000000
};

typedef struct bt__geo_head
{
  char magic[8];
  uint32_t version;
  uint32_t columns, rows; /* at least 1 */
  uint32_t spare;         /* 0 */
  double x, y, dx, dy;    /* m: of heights, the first post and how far apart they are; else 0 */
} bt__geo_head;

/* Take one table of at most MOST numbers, with nothing behind, from ANSWER into *HEAD and *NUMBERS;
   free *NUMBERS by free; NULL on failure.  Any bytes give either a whole table or an error; the
   values of the numbers are not checked.  BT_ERR_FORMAT, BT_ERR_VERSION, BT_ERR_LIMIT.  */
bt_status bt__geo_take (const bt__answer *answer, uint64_t most, bt__geo_head *head,
                        double **numbers, bt_error *error);

#endif
