/* Bytes as a file that may be cut short.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <stdlib.h>
#include <string.h>

#include "mesh-reader/whole.h"
#include "targets.h"

void
fuzz_mesh_whole (const uint8_t *bytes, size_t n)
{
  bt_error e;
  char *copy = malloc (n ? n : 1); /* exactly as long, to see who reads on */
  if (!copy)
    return;
  memcpy (copy, bytes, n);
  bt_status s = bt__whole (copy, n, &e);
  fuzz_check (s == BT_OK || s == BT_ERR_FORMAT);
  free (copy);
}
