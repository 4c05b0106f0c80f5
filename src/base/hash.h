/* 64-bit hashes of bytes.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#ifndef BT_BASE_HASH_H
#define BT_BASE_HASH_H

#include <stddef.h>
#include <stdint.h>

/* Return the hash of N bytes at DATA, continued from SEED (0 at first).  */
uint64_t bt__hash (const void *data, size_t n, uint64_t seed);

/* Return the hash of ROWS rows of USED bytes, as if without gaps; a row begins STRIDE bytes after
   the row before.  USED is a multiple of 8.  */
uint64_t bt__hash_rows (const void *data, size_t rows, size_t used, size_t stride, uint64_t seed);

/* Another such hash, of long data in pieces: several times as fast.  Where one piece ends and the
   next begins counts: the same bytes in other pieces have another hash.  */
enum
{
  BT__HASH_LANES = 16
};

typedef struct bt__hash_lanes
{
  uint64_t lane[BT__HASH_LANES];
  uint64_t little; /* of pieces shorter than a word for each lane */
  uint64_t n;      /* bytes added */
} bt__hash_lanes;

void bt__hash_begin (bt__hash_lanes *lanes);
void bt__hash_add (bt__hash_lanes *lanes, const void *data, size_t n);
uint64_t bt__hash_end (const bt__hash_lanes *lanes);

#endif
