/* The answer of a reader program, as bytes.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include "mesh/answer.h"
#include "base/error.h"

bt_status
bt__answer_take (const bt__answer *answer, void *to, size_t n, const char *what, bt_error *error)
{
  size_t got = answer->read (answer->user, to, n);
  if (got < n)
    return bt__fail (error, BT_ERR_FORMAT,
                     "%s's answer is cut short: %zu of the %zu bytes of its %s", answer->title, got,
                     n, what);
  return BT_OK;
}

bt_status
bt__answer_finish (const bt__answer *answer, uint64_t sum, bt_error *error)
{
  uint64_t told;
  char more;
  bt_status s = bt__answer_take (answer, &told, sizeof told, "checksum", error);
  if (s != BT_OK)
    return s;
  if (sum != told)
    return bt__fail (error, BT_ERR_FORMAT, "%s's answer is damaged: its checksum is wrong",
                     answer->title);
  if (answer->read (answer->user, &more, 1) != 0)
    return bt__fail (error, BT_ERR_FORMAT, "%s's answer goes on after its end", answer->title);
  return BT_OK;
}
