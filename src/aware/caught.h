/* The turns of a closed line about the members of a graph (graph.h), after the line was drawn free
   of every member as far as possible.

   The class of a closed line in the first homology of the water is a sum of loops about edges: one
   loop about each edge through a surface bounded by the line.  The sum is not unique, because a
   loop slides over a vertex from one edge to all the other edges of the vertex, and off an edge
   with an end in the water.  bt__caught_find takes the sum with the fewest loops.  The fewest loops
   are none exactly if the class is zero; a line round the leg of a frame has 1 about the leg and 0
   about the braces.  Among sums with equally few loops, favoured edges, at which the line is held,
   come first.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#ifndef BT_AWARE_CAUGHT_H
#define BT_AWARE_CAUGHT_H

#include "aware/graph.h"

/* The loops about each edge of a graph, positive if right-handed about the direction from the first
   vertex to the second; with the working memory.  */
typedef struct bt__caught
{
  const bt__graph *graph;
  bt__asker *asker; /* of the search, or NULL; left, the loops are good for nothing */
  int32_t *loops;   /* about each edge */
  int any;          /* true if one of them is not 0 */
  int64_t *cost;    /* of a loop about each edge */
  uint32_t *at;     /* of each vertex: where its edges begin in ... */
  uint32_t *edge;   /* ... this list */
  int64_t *gain;    /* of each vertex: what its one step more gains; less than 0: it costs */
  int64_t *flow;    /* along each edge */
  uint32_t *from;   /* of each vertex: the edge by which a path reaches it */
  uint32_t *queue;
  uint8_t *seen;
} bt__caught;

/* Make *OUT (any bytes) for GRAPH, which must stay.  BT_ERR_LIMIT.  */
bt_status bt__caught_new (const bt__graph *graph, bt__caught *out, bt_error *error);

/* Find the loops of the closed line along P, of N points, and back along Q, of M points; P and Q
   share both ends.  FAVOURED has a byte for each edge, true to prefer the edge; NULL: none.  No
   allocation.  */
void bt__caught_find (bt__caught *caught, const bt_vec3 *p, uint32_t n, const bt_vec3 *q,
                      uint32_t m, const uint8_t *favoured);

void bt__caught_free (bt__caught *caught);

/* caught_surface.c: put into LOOPS, one an edge, how often each edge goes through the surface
   between P and Q; return true if one does.  */
int bt__caught_crossings (const bt__graph *graph, const bt_vec3 *p, uint32_t n, const bt_vec3 *q,
                          uint32_t m, int32_t *loops);

#endif
