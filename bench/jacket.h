/* A jacket of tubulars, 60 x 60 x 100 m, in as many triangles as wished, and tethers of 100 links
   at it.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#ifndef BT_BENCH_JACKET_H
#define BT_BENCH_JACKET_H

#include <stdint.h>

#include <bight/vec.h>

enum
{
  JACKET_LINKS = 100
};

typedef struct jacket
{
  bt_vec3 *v;
  uint32_t (*corner)[3];
  uint32_t vertices, triangles, room; /* room: of both */
  double wanted;                      /* triangles of all tubes, those without room too */
} jacket;

/* Return nonzero if there was memory for MOST triangles.  */
int jacket_new (jacket *j, uint32_t most);
void jacket_free (jacket *j);

/* Make J of fewer than WANTED triangles, and nearly so many, in facets of one size; but of no fewer
   than the 768 of hexagonal tubes.  */
void jacket_make (jacket *j, uint32_t wanted);

/* Lay a tether: SHIFT, m, along what it touches.  */
typedef void (*jacket_layer) (bt_vec3 x[JACKET_LINKS + 1], double shift);

/* 194 m through two faces, hung over a brace of each.  */
void jacket_drape (bt_vec3 x[JACKET_LINKS + 1], double shift);

/* 155 m along a face, on its braces.  */
void jacket_lie (bt_vec3 x[JACKET_LINKS + 1], double shift);

/* Six turns round a leg, 2 cm off.  */
void jacket_wrap (bt_vec3 x[JACKET_LINKS + 1], double shift);

#endif
