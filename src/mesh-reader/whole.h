/* Is a mesh file complete?  Some formats state their amount of data, but assimp does not check: it
   makes up the missing part of a PLY file.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#ifndef BT_MESH_READER_WHOLE_H
#define BT_MESH_READER_WHOLE_H

#include <stddef.h>

#include <bight/status.h>

/* Look through the N bytes of a file.  BT_ERR_FORMAT for a PLY with a header not understood or
   promising more than follows, and for an ASCII STL without its last word; BT_OK for all else.  */
bt_status bt__whole (const char *bytes, size_t n, bt_error *error);

/* Do the N bytes of a file begin as those of a PLY?  */
int bt__is_ply (const char *bytes, size_t n);

/* Take the comments out of the header of a PLY; the remaining lines move up to the end of the
   header.  Return the new beginning of the file.  After a comment, assimp takes an empty line, or
   in 5.4 and 6 a line beginning with a digit, for a part of the comment; then a line is lost and
   every corner moves up by one.  */
size_t bt__ply_without_comments (char *bytes, size_t n);

#endif
