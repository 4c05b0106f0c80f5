/* How often a closed line goes about the members of a graph (graph.h), when it is drawn free of all
   that it can be drawn free of.

   The class of a closed line in the first homology of the water is a sum of loops about edges, one
   about each edge that goes through a surface which the line bounds.  Such a sum is not unique: a
   loop slides over a vertex from one edge to all the others that meet there, and off an edge that
   ends in the water.  The sum with the fewest loops is taken: zero exactly where the class is zero,
   1 at the leg of a frame that the line goes round and 0 at its braces.  Among sums with as few the
   edges that are favoured, those that hold the line, are taken first.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#ifndef BT_AWARE_CAUGHT_H
#define BT_AWARE_CAUGHT_H

#include "aware/graph.h"

/* The loops about each edge of a graph, right-handed about it from its first vertex to its second
   positive; and the memory to find them in.  */
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

/* Find the loops of the line that goes along P, of N points, and back along Q, of M, which has the
   same ends.  True in FAVOURED (a byte an edge, NULL: none): prefer this edge.  No allocation.  */
void bt__caught_find (bt__caught *caught, const bt_vec3 *p, uint32_t n, const bt_vec3 *q,
                      uint32_t m, const uint8_t *favoured);

void bt__caught_free (bt__caught *caught);

/* caught_surface.c: put into LOOPS, one an edge, how often each edge goes through the surface
   between P and Q; return true if one does.  */
int bt__caught_crossings (const bt__graph *graph, const bt_vec3 *p, uint32_t n, const bt_vec3 *q,
                          uint32_t m, int32_t *loops);

#endif
