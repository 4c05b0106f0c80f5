/* Bytes as a stream of MAVLink; the first byte says whether a time stands before each frame.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "targets.h"
#include "telemetry/mavlink.h"

static void
check_good (const bt__mavlink_found *found)
{
  fuzz_check (found->message != NULL && found->message->id == found->id);
  fuzz_check (memchr (found->name, 0, sizeof found->name) != NULL);
  for (int i = 0; i < BT__MAVLINK_FIELDS; i++)
    fuzz_check (!isinf (found->value[i]));
}

void
fuzz_mavlink (const uint8_t *bytes, size_t n)
{
  if (n == 0)
    return;
  size_t stamp = bytes[0] % 2 ? BT__MAVLINK_STAMP : 0, left = n - 1;
  uint8_t *copy = malloc (left ? left : 1); /* as long as the stream, and no longer */
  if (!copy)
    return;
  memcpy (copy, bytes + 1, left);
  for (const uint8_t *p = copy; left > 0;)
    {
      bt__mavlink_found found;
      bt__mavlink_next (p, left, stamp, &found);
      fuzz_check ((found.kind == BT__MAVLINK_SHORT) == (found.size == 0));
      fuzz_check (found.size <= left);
      if (found.kind == BT__MAVLINK_SHORT && left > BT__MAVLINK_LONGEST + stamp)
        __builtin_trap ();
      if (found.kind == BT__MAVLINK_GOOD)
        check_good (&found);
      size_t step = found.size ? found.size : 1;
      p += step;
      left -= step;
    }
  free (copy);
}
