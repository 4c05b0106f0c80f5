/* Matrices for a camera.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#ifndef BT_RENDER_CAMERA_H
#define BT_RENDER_CAMERA_H

#include "render/soup.h"

/* A camera in a picture of WIDTH by HEIGHT pixels.  */
typedef struct bt__optics
{
  bt_vec3 eye, right, up, ahead;  /* EYE from the world's origin */
  double half_width, half_height; /* tangents of the angles, or m without perspective */
  double near, far;               /* m along AHEAD */
  int perspective;
} bt__optics;

/* A rectangle of a picture in pixels, its rows counted from the bottom.  */
typedef struct bt__window
{
  double x, y, width, height;
} bt__window;

bt__optics bt__optics_of (const bt_camera *camera, double aspect);
bt__lens bt__lens_of (const bt__optics *optics, int height, int quick);

/* Write the matrix, column by column, that takes points relative to ORIGIN to WINDOW of a picture
   of W by H pixels.  */
void bt__camera_matrix (const bt__optics *optics, bt_vec3 origin, double w, double h,
                        const bt__window *window, float m[16]);

/* The same for parallel light toward SUN on a ball about MIDDLE.  */
void bt__cast_matrix (bt_vec3 sun, bt_vec3 middle, double radius, bt_vec3 origin, float m[16]);

/* Where P falls in a picture of W by H pixels, rows counted from the top; 0 when it lies behind. */
int bt__project (const bt__optics *optics, bt_vec3 p, double w, double h, double *x, double *y);

#endif
