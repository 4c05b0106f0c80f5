/* Pictures as PNG.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#ifndef BT_RENDER_PNG_H
#define BT_RENDER_PNG_H

#include <stdio.h>

#include "render/render.h"

/* Write PICTURE to STREAM; false when that or memory fails, ERRNO then says which.  */
int bt__png_write (const bt__picture *picture, FILE *stream);

#endif
