/* One picture on its way: the data shared by preparing and drawing.

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
  size_t n_cast;  /* corners of the soup that cast shadows, ground apart; they come first */
  size_t n_solid; /* corners that are no ground */
  bt_vec3 middle; /* of what casts shadows */
  double radius;
  double level; /* height of level ground, or -1e30 */
  int reach;    /* pixels that shading looks around */
  int margin;   /* pixels around a tile */
  float cast[16];
  GLuint array, buffer[2];
  const bt__shadows *shade; /* the renderer's */
  bt__frames *frames;       /* the renderer's, once they are had */
  const GLuint *resolve;    /* the programs of the passes, likewise */
} bt__job;

/* Gather the triangles of JOB's view; from the triangles follow the frame of the light and the
   depths of the camera.  */
void bt__prepare (bt__job *job);

/* frames.c: have buffers for tiles of W by H pixels; buffers of the last picture are used again if
   the size agrees.  Leave them for the next picture, unless they are large.  */
bt_status bt__frames_have (bt__job *job, int w, int h, bt_error *error);
void bt__frames_leave (bt__job *job);
/* The number of cells of two pixels along a side of N pixels, with a border.  */
int bt__cells (int n);

/* How far one sees, m.  */
double bt__visibility (const bt__job *job);

/* The distance between lines on the ground, m: 1, 2 or 5 times a power of ten.  */
double bt__grid_step (const bt__job *job);

#endif
