/* Arrays that grow as they are filled.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#ifndef BT_BASE_ROOM_H
#define BT_BASE_ROOM_H

#include <stddef.h>

/* Make room for NEED elements of SIZE in the array that the pointer at ARRAY points to, which has
   room for *ROOM; the elements there stay, new ones hold anything.  Return false when memory is
   out, the array being as before.  */
int bt__make_room (void *array, size_t *room, size_t need, size_t size);

#endif
