/* Which letters a terminal shows, and which it obeys.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#ifndef BT_BASE_LETTER_H
#define BT_BASE_LETTER_H

#include <stdint.h>

/* Return true if a terminal obeys the character U rather than showing it: the control characters of
   ASCII and Latin 1, line feed and tabulator included, and the characters of Unicode that turn the
   direction of a line or end a line.  */
static inline int
bt__is_control (uint32_t u)
{
  return u < 0x20 || (u >= 0x7f && u <= 0x9f) || u == 0x61c || u == 0x200e || u == 0x200f
         || (u >= 0x2028 && u <= 0x202e) || (u >= 0x2066 && u <= 0x2069);
}

#endif
