/* The inside of the graph: points on members, and which are one joint.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#ifndef BT_AWARE_GRAPH_JOB_H
#define BT_AWARE_GRAPH_JOB_H

#include "aware/graph.h"

/* What a point is in.  */
enum
{
  BT__WATER,
  BT__GROUND,
  BT__AIR,
  BT__MESH
};

/* A point on a member, at share S of its axis, or the middle of a joint (member BT__NO_MEMBER).  */
typedef struct bt__point
{
  bt_vec3 at;
  double s, radius;
  uint32_t member, joint; /* joint: another point that is the same vertex, or itself */
  uint8_t boundary, dry;  /* a boundary; no water from here to the next point */
} bt__point;

#define BT__NO_MEMBER UINT32_MAX

typedef struct bt__graph_job
{
  const bt__graph_config *c;
  const bt__scene *scene;
  uint32_t n, room;
  bt__point *p;
  uint8_t *off;     /* all but the ground */
  uint8_t *solid;   /* all but meshes that are no ground */
  bt__aabb *box;    /* about each obstacle, and what the gap adds */
  uint32_t *middle; /* of object i, if it is a joint: its point, else BT__NO_MEMBER */
  bt__count count;
  int failed, undescribed;
} bt__graph_job;

uint32_t bt__joint_of (const bt__graph_job *k, uint32_t i);
void bt__unite (bt__graph_job *k, uint32_t a, uint32_t b);

/* From the points to vertices and edges; FAILED is set if memory runs out.  */
void bt__graph_build (bt__graph_job *k, bt__graph *g);

#endif
