/* Matrices for a camera.

   Optics are eye, three axes (right, up, ahead) and the half sizes of the picture: at distance 1
   with perspective, in metres without.  Matrices are computed in doubles relative to an origin near
   the scene and then stored as floats, column by column, as OpenGL reads them.  A window selects a
   part of the picture, so that tiles of one picture share one camera.

   Without perspective depth is linear between near and far; with perspective it is the usual (f +
   n) / (f - n) - 2 f n / (f - n) / z, affine in 1/z.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <math.h>

#include "math/vec.h"
#include "render/camera.h"

bt__optics
bt__optics_of (const bt_camera *camera, double aspect)
{
  bt__optics o = { .eye = camera->from, .perspective = camera->angle > 0 };
  bt_vec3 east = { 1, 0, 0 };
  o.ahead = bt__unit_or (bt__sub (camera->at, camera->from), bt__vec (0, 1, 0));
  o.right = bt__unit_or (bt__cross (o.ahead, camera->up), east);
  o.up = bt__cross (o.right, o.ahead);
  o.half_height = o.perspective ? tan (camera->angle / 2) : camera->height / 2;
  o.half_width = o.half_height * aspect;
  return o;
}

bt__lens
bt__lens_of (const bt__optics *o, int height, int quick)
{
  return (bt__lens){ o->eye, o->ahead, 2 * o->half_height / height, o->perspective, height, quick };
}

/* Rows of the view transform scaled to the picture's half sizes.  */
static void
set_row (double row[4], bt_vec3 axis, double scale, bt_vec3 offset)
{
  row[0] = axis.x / scale;
  row[1] = axis.y / scale;
  row[2] = axis.z / scale;
  row[3] = bt__dot (axis, offset) / scale;
}

/* The rows of depth z and of the divisor w.  */
static void
set_depth (double z[4], double w[4], const bt__optics *o, bt_vec3 offset)
{
  double n = o->near, f = o->far;
  double a = o->perspective ? (f + n) / (f - n) : 2 / (f - n);
  double b = o->perspective ? -2 * f * n / (f - n) : -(f + n) / (f - n);
  set_row (z, o->ahead, 1 / a, offset);
  z[3] += b;
  set_row (w, o->ahead, 1, offset);
  if (!o->perspective)
    w[0] = w[1] = w[2] = 0, w[3] = 1;
}

static void
store (double row[4][4], float m[16])
{
  for (int i = 0; i < 4; i++)
    for (int j = 0; j < 4; j++)
      m[4 * j + i] = (float)row[i][j];
}

void
bt__camera_matrix (const bt__optics *o, bt_vec3 origin, double w, double h,
                   const bt__window *window, float m[16])
{
  bt_vec3 offset = bt__sub (origin, o->eye);
  double row[4][4], sx = w / window->width, sy = h / window->height;
  double cx = (2 * window->x + window->width) / w - 1,
         cy = (2 * window->y + window->height) / h - 1;
  set_row (row[0], o->right, o->half_width, offset);
  set_row (row[1], o->up, o->half_height, offset);
  set_depth (row[2], row[3], o, offset);
  for (int j = 0; j < 4; j++)
    {
      row[0][j] = sx * (row[0][j] - cx * row[3][j]);
      row[1][j] = sy * (row[1][j] - cy * row[3][j]);
    }
  store (row, m);
}

void
bt__cast_matrix (bt_vec3 sun, bt_vec3 middle, double radius, bt_vec3 origin, float m[16])
{
  bt_vec3 ahead = bt__scale (-1, sun);
  bt_vec3 right = bt__unit_or (bt__cross (ahead, bt__vec (0, 1, 0)), bt__vec (1, 0, 0));
  bt_vec3 offset = bt__sub (origin, middle);
  double row[4][4] = { { 0 } };
  set_row (row[0], right, radius, offset);
  set_row (row[1], bt__cross (right, ahead), radius, offset);
  set_row (row[2], ahead, radius, offset);
  row[3][3] = 1;
  store (row, m);
}

int
bt__project (const bt__optics *o, bt_vec3 p, double w, double h, double *x, double *y)
{
  bt_vec3 q = bt__sub (p, o->eye);
  double depth = bt__dot (q, o->ahead), k = o->perspective ? depth : 1;
  if (o->perspective && depth < 1e-3)
    return 0;
  *x = (bt__dot (q, o->right) / (k * o->half_width) + 1) / 2 * w;
  *y = (1 - bt__dot (q, o->up) / (k * o->half_height)) / 2 * h;
  return 1;
}
