/* Arrays that grow as they are filled: by half, so that growing costs little in all.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <stdlib.h>
#include <string.h>

#include "base/room.h"

int
bt__make_room (void *array, size_t *room, size_t need, size_t size)
{
  if (need <= *room)
    return 1;
  size_t more = *room + *room / 2 > need ? *room + *room / 2 : need;
  void *at, *grown;
  memcpy (&at, array, sizeof at);
  grown = realloc (at, more * size);
  if (!grown)
    return 0;
  memcpy (array, &grown, sizeof grown);
  *room = more;
  return 1;
}
