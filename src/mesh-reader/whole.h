/* Is a mesh file all there?  Some formats say how much there should be, and assimp does not look:
   it makes up what a PLY file lacks.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#ifndef BT_MESH_READER_WHOLE_H
#define BT_MESH_READER_WHOLE_H

#include <stddef.h>

#include <bight/status.h>

/* Look through the N bytes of a file.  BT_ERR_FORMAT for a PLY whose header is not understood or
   promises more than follows, and for an ASCII STL without its last word; BT_OK for all else.  */
bt_status bt__whole (const char *bytes, size_t n, bt_error *error);

/* Do the N bytes of a file begin as those of a PLY?  */
int bt__is_ply (const char *bytes, size_t n);

/* Take the comments out of the header of a PLY: what is kept of it moves up to its end.  Return
   where the file begins now.  Assimp takes the line after a comment that is empty, or in 5.4 and 6
   begins with a digit, for a part of it; then a line is lost and every corner moves up by one.  */
size_t bt__ply_without_comments (char *bytes, size_t n);

#endif
