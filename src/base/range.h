/* A range of bytes in a block.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#ifndef BT_BASE_RANGE_H
#define BT_BASE_RANGE_H

#include <stddef.h>

typedef struct bt__range
{
  size_t at, size;
} bt__range;

#endif
