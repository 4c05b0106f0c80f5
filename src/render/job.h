/* One picture on its way: what preparing it and drawing it share.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#ifndef BT_RENDER_JOB_H
#define BT_RENDER_JOB_H

#include "render/camera.h"
#include "render/renderer.h"

typedef struct bt__job
{
  bt__renderer *r;
  const bt__gl *gl;
  const bt_view *view;
  bt__drawing drawing;
  bt__optics optics;
  bt__soup soup;
  size_t n_solid; /* corners of the soup that are no ground; they come first */
  bt_vec3 middle; /* of what casts shadows */
  double radius;
  double level; /* height of level ground, or -1e30 */
  int reach;    /* pixels that shading looks around */
  int margin;   /* pixels around a tile */
  float cast[16];
  GLuint array, buffer[2];
  GLuint frame[2], colors, shapes, depths, pixels, kinds;
} bt__job;

/* Gather the triangles of JOB's view, and from them what its light and its camera span.  */
void bt__prepare (bt__job *job);

/* How far one sees, m.  */
double bt__visibility (const bt__job *job);

/* The distance between lines on the ground, m: 1, 2 or 5 times a power of ten.  */
double bt__grid_step (const bt__job *job);

#endif
