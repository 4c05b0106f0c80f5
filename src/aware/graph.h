/* What can hold a line for good, as a graph: the axes of members, joined where members overlap, cut
   where they enter the ground or leave the water.

   Members are capsules and cylinders; boxes, balls and hulls are joints where members end in them,
   and, from the ground to the air, pillars with an upright axis.  A member that lies on the ground
   holds nothing there.  Meshes are ground if said so, else they are not described: `undescribed'
   counts them, and members end where they meet them.  Obstacles that move do not belong in the
   scene.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#ifndef BT_AWARE_GRAPH_H
#define BT_AWARE_GRAPH_H

#include "base/ask.h"
#include "collide/scene.h"

typedef struct bt__graph
{
  uint32_t vertices, edges, own; /* the first OWN edges belong to members, the others lead away from
                                    the members' ends */
  bt_vec3 *v;
  double *radius;    /* m: of the thinnest member at the vertex */
  uint8_t *boundary; /* in the ground, out of the water, or at a mesh */
  uint32_t (*edge)[2];
  uint32_t *object; /* of each edge: its member's place in the scene */
  bt__bvh tree;     /* of the edges */
  uint32_t undescribed;
} bt__graph;

typedef struct bt__graph_config
{
  const bt__scene *scene;
  const bt__switches *on;
  const uint8_t *ground; /* which objects are ground besides the planes; NULL: none */
  double surface;        /* m: z of the water's surface; INFINITY: none */
  double depth;          /* m: below z = 0 there is ground from there on; 0: only what is ground */
  double gap;            /* m: less than that between two members is no way through */
  bt__asker *asker;      /* whether to go on; or NULL */
} bt__graph_config;

/* Make *GRAPH (any bytes).  BT_ERR_LIMIT, BT_ERR_INTERRUPTED.  */
bt_status bt__graph_new (const bt__graph_config *config, bt__graph *graph, bt_error *error);

/* Build the tree of the edges of GRAPH anew; called by bt__graph_new, and to be called by whoever
   moves a vertex.  BT_ERR_LIMIT.  */
bt_status bt__graph_plant (bt__graph *graph, bt_error *error);

void bt__graph_free (bt__graph *graph);

/* Return the rank that the fundamental group of the water about GRAPH must have: the edges, less
   the inner vertices, plus one for every component that touches no boundary.  */
uint32_t bt__graph_rank (const bt__graph *graph);

#endif
