/* Opening a file named by a world, with one sentence of error for anything but a readable file.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#ifndef BT_MESH_FILE_H
#define BT_MESH_FILE_H

#include <stddef.h>
#include <stdint.h>

#include <bight/status.h>

/* Return the end of FILE, at most 150 bytes of it: a name that leaves room for the reason.  */
const char *bt__file_tail (const char *file);

/* Open the regular file FILE to be read, with 1 to MOST bytes; *SIZE is how many.  BT_ERR_IO,
   BT_ERR_LIMIT; *FD is then -1.  */
bt_status bt__file_open (const char *file, uint64_t most, int *fd, uint64_t *size, bt_error *error);

#endif
