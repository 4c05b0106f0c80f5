/* Taking a table from the reader's stream.  The reader ran a foreign library on a foreign file, so
   no byte of the answer is believed unchecked.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <stdlib.h>
#include <string.h>

#include "base/error.h"
#include "base/hash.h"
#include "geo/stream.h"

static bt_status
check_table_head (const bt__geo_head *head, uint64_t most, bt_error *error)
{
  if (memcmp (head->magic, BT__GEO_MAGIC, sizeof head->magic) != 0 || head->spare != 0)
    return bt__fail (error, BT_ERR_FORMAT, "the geographic reader's answer is not a table");
  if (head->version != BT__GEO_VERSION)
    return bt__fail (error, BT_ERR_VERSION,
                     "the geographic reader is of another build: its version is %u, wanted is %d",
                     (unsigned)head->version, BT__GEO_VERSION);
  uint64_t n = (uint64_t)head->columns * head->rows;
  if (n == 0 || n > most)
    return bt__fail (error, BT_ERR_LIMIT, "a table of %u by %u numbers; 1 to %llu are allowed",
                     (unsigned)head->columns, (unsigned)head->rows, (unsigned long long)most);
  return BT_OK;
}

bt_status
bt__geo_take (const bt__answer *answer, uint64_t most, bt__geo_head *head, double **numbers,
              bt_error *error)
{
  *numbers = NULL;
  bt_status s = bt__answer_take (answer, head, sizeof *head, "head", error);
  if (s == BT_OK)
    s = check_table_head (head, most, error);
  if (s != BT_OK)
    return s;
  size_t size = (size_t)head->columns * head->rows * sizeof **numbers;
  *numbers = malloc (size);
  if (!*numbers)
    return bt__fail (error, BT_ERR_LIMIT, "no memory for a table of %u by %u numbers",
                     (unsigned)head->columns, (unsigned)head->rows);
  s = bt__answer_take (answer, *numbers, size, "numbers", error);
  if (s == BT_OK)
    s = bt__answer_finish (answer, bt__hash (*numbers, size, bt__hash (head, sizeof *head, 0)),
                           error);
  if (s != BT_OK)
    {
      free (*numbers);
      *numbers = NULL;
    }
  return s;
}
