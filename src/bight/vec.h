/* Points and vectors: metres, x east, y north, z up, z = 0 the sea surface.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#ifndef BIGHT_VEC_H
#define BIGHT_VEC_H

typedef struct bt_vec3
{
  double x, y, z;
} bt_vec3;

#endif
