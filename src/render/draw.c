/* Drawing a view, tile by tile, with deferred shading.

   Triangles go to the card once.  For each tile the scene is drawn unlit into buffers at several
   samples a pixel (colours, normals, depths), then the passes of shaders_pixels.c make the pixels
   of the tile from the buffers: shadows, outlines, occlusion, fog, averaging.  Only the picture in
   memory grows with the size of the picture.

   Tiles are equal parts of the picture, so that none is a narrow rest, and small in large pictures,
   since fresh memory for large buffers costs more than margins do.  A tile is drawn with a margin
   as wide as the neighbourhood used in shading, so a tiled picture equals the picture drawn at
   once.  Shadows come from one map for all tiles, drawn from the sun's side over the box about all
   bodies.

   Numbers handed to the shaders are relative to the point looked at, the soup's origin, because
   floats have too few digits for metres of a map.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/error.h"
#include "math/vec.h"
#include "render/job.h"

enum
{
  TILE = 640, /* pixels; a picture of no more is a tile, whose memory the next frame has again */
  PART = 320  /* the most of a tile of a larger picture, of which a process mostly draws one */
};

/* ---- Triangles ---- */

static void
upload (bt__job *j)
{
  const bt__gl *gl = j->gl;
  GLsizei stride = sizeof (bt__vertex);
  gl->GenVertexArrays (1, &j->array);
  gl->BindVertexArray (j->array);
  gl->GenBuffers (2, j->buffer);
  gl->BindBuffer (GL_ARRAY_BUFFER, j->buffer[0]);
  gl->BufferData (GL_ARRAY_BUFFER, (GLsizeiptr)(j->soup.n * sizeof *j->soup.vertex), j->soup.vertex,
                  GL_STATIC_DRAW);
  gl->BindBuffer (GL_ELEMENT_ARRAY_BUFFER, j->buffer[1]);
  gl->BufferData (GL_ELEMENT_ARRAY_BUFFER, (GLsizeiptr)(j->soup.n_index * sizeof *j->soup.index),
                  j->soup.index, GL_STATIC_DRAW);
  gl->VertexAttribPointer (0, 3, GL_FLOAT, GL_FALSE, stride, (void *)offsetof (bt__vertex, at));
  gl->VertexAttribPointer (1, 3, GL_FLOAT, GL_FALSE, stride, (void *)offsetof (bt__vertex, normal));
  gl->VertexAttribPointer (2, 4, GL_UNSIGNED_BYTE, GL_TRUE, stride,
                           (void *)offsetof (bt__vertex, stuff.color));
  gl->VertexAttribPointer (3, 4, GL_UNSIGNED_BYTE, GL_FALSE, stride,
                           (void *)offsetof (bt__vertex, stuff.fog));
  for (GLuint i = 0; i < 4; i++)
    gl->EnableVertexAttribArray (i);
}

/* Draw N corners of triangles, from FIRST on.  */
static void
draw_corners (const bt__job *j, size_t first, size_t n)
{
  j->gl->BindVertexArray (j->array);
  j->gl->DrawElements (GL_TRIANGLES, (GLsizei)n, GL_UNSIGNED_INT,
                       (const void *)(first * sizeof *j->soup.index));
}

/* ---- Uniforms ---- */

static GLint
spot (const bt__job *j, GLuint program, const char *name)
{
  return j->gl->GetUniformLocation (program, name);
}

static void
set_number (const bt__job *j, GLuint program, const char *name, double x)
{
  j->gl->Uniform1f (spot (j, program, name), (float)x);
}

static void
set_vector (const bt__job *j, GLuint program, const char *name, bt_vec3 v)
{
  j->gl->Uniform3f (spot (j, program, name), (float)v.x, (float)v.y, (float)v.z);
}

/* The share of daylight that comes down to a camera: exp (-K depth), where K = 1.7 / the depth at
   which a Secchi disc disappears (H. H. Poole and W. R. G. Atkins 1929), taken for the visibility.
   All of the daylight in water of no known turbidity, and a little in any.  */
static double
dusk_of (const bt__job *j)
{
  double depth = j->view->surface - j->optics.eye.z;
  if (!(j->view->visibility > 0) || !j->optics.perspective || !(depth > 0) || !isfinite (depth))
    return 1;
  return fmax (0.01, exp (-1.7 * depth / j->view->visibility));
}

/* Set the uniforms common to all shaders.  Heights and places are relative to the soup's origin;
   SHIFT continues patterns from tile to tile and picture to picture.  */
static void
set_common (const bt__job *j, GLuint program)
{
  const bt_vec3 o = j->soup.origin;
  j->gl->UseProgram (program);
  set_vector (j, program, "eye", bt__sub (j->optics.eye, o));
  set_vector (j, program, "right", j->optics.right);
  set_vector (j, program, "up", j->optics.up);
  set_vector (j, program, "ahead", j->optics.ahead);
  set_vector (j, program, "sun", j->view->sun);
  set_number (j, program, "surface", fmin (j->view->surface, 1e9));
  set_number (j, program, "visibility", bt__visibility (j));
  set_number (j, program, "lamp", j->view->lamp);
  set_number (j, program, "dusk", dusk_of (j));
  set_number (j, program, "murk", j->view->visibility > 0 ? 1 / j->view->visibility : 0);
  set_number (j, program, "time", fmod (j->view->time, 3600));
  set_number (j, program, "plain", j->drawing.transparent);
  set_number (j, program, "height", o.z);
  j->gl->Uniform2f (spot (j, program, "shift"), (float)fmod (o.x, 1000), (float)fmod (o.y, 1000));
}

/* ---- Passes ---- */

static void
draw_shadows (bt__job *j)
{
  const bt__gl *gl = j->gl;
  const bt__shadows *shadows = j->shade;
  bt__cast_matrix (j->view->sun, j->middle, j->radius, j->soup.origin, j->cast);
  gl->BindFramebuffer (GL_FRAMEBUFFER, shadows->frame);
  gl->Viewport (0, 0, shadows->side, shadows->side);
  gl->ClearBufferfv (GL_DEPTH, 0, (const GLfloat[]){ 1 });
  gl->UseProgram (j->r->shadow);
  gl->UniformMatrix4fv (spot (j, j->r->shadow, "sunward"), 1, GL_FALSE, j->cast);
  draw_corners (j, 0, j->n_cast);
  draw_corners (j, j->n_solid, j->soup.n_index - j->n_solid);
}

/* Mix hidden tubes into the colour in front of them, so that tubes shine through.  */
static void
draw_ghosts (const bt__job *j)
{
  static const GLenum two[] = { GL_COLOR_ATTACHMENT0, GL_COLOR_ATTACHMENT1 };
  const bt__gl *gl = j->gl;
  gl->DrawBuffers (1, two);
  gl->DepthMask (GL_FALSE);
  gl->DepthFunc (GL_GREATER);
  gl->Enable (GL_BLEND);
  gl->BlendColor (0, 0, 0, (GLfloat)j->view->ghost);
  gl->BlendFuncSeparate (GL_CONSTANT_ALPHA, GL_ONE_MINUS_CONSTANT_ALPHA, GL_ZERO, GL_ONE);
  for (int i = 0; i < j->soup.ghosts && j->view->ghost > 0; i++)
    gl->DrawElements (GL_TRIANGLES, (GLsizei)j->soup.ghost[i].n, GL_UNSIGNED_INT,
                      (const void *)(j->soup.ghost[i].first * sizeof *j->soup.index));
  gl->Disable (GL_BLEND);
  gl->DepthFunc (GL_LESS);
  gl->DepthMask (GL_TRUE);
  gl->DrawBuffers (2, two);
}

static void
draw_scene (bt__job *j, const bt__window *window)
{
  static const GLfloat nothing[] = { 0, 0, 0, 0 }, far[] = { 1 };
  const bt__gl *gl = j->gl;
  float clip[16];
  int s = j->drawing.samples;
  bt__camera_matrix (&j->optics, j->soup.origin, j->drawing.width, j->drawing.height, window, clip);
  gl->BindFramebuffer (GL_FRAMEBUFFER, j->frames->frame[0]);
  gl->Viewport (0, 0, s * (int)window->width, s * (int)window->height);
  gl->ClearBufferfv (GL_COLOR, 0, nothing);
  gl->ClearBufferfv (GL_COLOR, 1, nothing);
  gl->ClearBufferfv (GL_DEPTH, 0, far);
  gl->UseProgram (j->r->scene);
  gl->UniformMatrix4fv (spot (j, j->r->scene, "clip"), 1, GL_FALSE, clip);
  draw_corners (j, 0, j->soup.n_index); /* the ground last: most of it is hidden by then */
  draw_ghosts (j);
}

static void
bind_buffers (const bt__job *j, GLuint program)
{
  const GLuint texture[]
      = { j->frames->colors, j->frames->shapes, j->frames->depths, j->shade->map, j->frames->sky };
  const char *const name[] = { "colors", "shapes", "depths", "shadow", "sky" };
  for (int i = 0; i < 5; i++)
    {
      j->gl->ActiveTexture (GL_TEXTURE0 + (GLenum)i);
      j->gl->BindTexture (GL_TEXTURE_2D, texture[i]);
      j->gl->Uniform1i (spot (j, program, name[i]), i);
    }
}

/* For the tile whose first pixel is (X, Y), rows from the bottom.  */
static void
set_tile (const bt__job *j, GLuint program, int x, int y)
{
  const bt__gl *gl = j->gl;
  set_common (j, program);
  bind_buffers (j, program);
  gl->Uniform1i (spot (j, program, "margin"), j->margin);
  gl->Uniform2f (spot (j, program, "tile"), (float)x, (float)y);
  gl->Uniform2f (spot (j, program, "size"), (float)j->drawing.width, (float)j->drawing.height);
  gl->Uniform2f (spot (j, program, "half_size"), (float)j->optics.half_width,
                 (float)j->optics.half_height);
  set_number (j, program, "near", j->optics.near);
  set_number (j, program, "far", j->optics.far);
  set_number (j, program, "pixel", 2 * j->optics.half_height / j->drawing.height);
  set_number (j, program, "reach", j->reach);
  set_number (j, program, "ground", j->level);
  set_number (j, program, "level", fmax (j->level, j->middle.z - j->radius));
  set_number (j, program, "bare", j->drawing.transparent);
  gl->UniformMatrix4fv (spot (j, program, "sunward"), 1, GL_FALSE, j->cast);
  set_number (j, program, "texel", 1.0 / j->shade->side);
  set_number (j, program, "wide", 0.5 / j->radius);
  set_number (j, program, "grid", bt__grid_step (j));
}

/* True if the picture can show the surface of the sea from below.  */
static int
sees_surface (const bt__job *j)
{
  const bt__optics *o = &j->optics;
  return o->perspective && j->view->surface > o->eye.z
         && o->ahead.z + o->half_width * fabs (o->right.z) + o->half_height * fabs (o->up.z) > 0;
}

/* Sort the pixels, then make those of each kind.  */
static void
resolve (const bt__job *j, int x, int y, int w, int h)
{
  const bt__gl *gl = j->gl;
  gl->BindVertexArray (j->r->empty);
  gl->DepthFunc (GL_ALWAYS);
  gl->BindFramebuffer (GL_FRAMEBUFFER, j->frames->frame[2]);
  gl->Viewport (0, 0, bt__cells (w), bt__cells (h));
  set_tile (j, j->resolve[BT__RESOLVE_SKY], x, y);
  gl->DrawArrays (GL_TRIANGLES, 0, 3);
  gl->BindFramebuffer (GL_FRAMEBUFFER, j->frames->frame[1]);
  gl->Viewport (0, 0, w, h);
  for (int i = 0; i < (sees_surface (j) ? BT__RESOLVE_SKY : BT__RESOLVE_HIGH); i++)
    {
      set_tile (j, j->resolve[i], x, y);
      set_number (j, j->resolve[i], "layer", i / 8.0);
      gl->DrawArrays (GL_TRIANGLES, 0, 3);
      gl->DepthFunc (GL_EQUAL);
      gl->DepthMask (GL_FALSE);
    }
  gl->DepthMask (GL_TRUE);
  gl->DepthFunc (GL_LESS);
}

/* Read the tile's pixels, turned right way up, into the picture.  */
static bt_status
read_back (const bt__job *j, int x, int y, int w, int h, bt__picture *picture, bt_error *error)
{
  uint32_t *rows = malloc ((size_t)w * (size_t)h * sizeof *rows);
  if (!rows)
    return bt__fail (error, BT_ERR_LIMIT, "there is no memory left for a tile of the picture");
  j->gl->ReadPixels (0, 0, w, h, GL_BGRA, GL_UNSIGNED_INT_8_8_8_8_REV, rows);
  for (int i = 0; i < h; i++)
    memcpy (picture->pixels + (size_t)(picture->height - 1 - y - i) * (size_t)picture->width + x,
            rows + (size_t)i * (size_t)w, (size_t)w * sizeof *rows);
  free (rows);
  return BT_OK;
}

static int
smaller (int a, int b)
{
  return a < b ? a : b;
}

/* The side of the equal parts, of at most MOST pixels, in which N pixels are drawn.  */
static int
tile_side (int n, int most)
{
  int parts = (n + most - 1) / most;
  return (n + parts - 1) / parts;
}

static bt_status
draw_tiles (bt__job *j, bt__picture *picture, bt_error *error)
{
  int W = picture->width, H = picture->height, m = j->margin;
  int most = j->drawing.tile ? j->drawing.tile : W <= TILE && H <= TILE ? TILE : PART;
  int side = tile_side (W, most), tall = tile_side (H, most);
  bt_status status = bt__frames_have (j, side, tall, error);
  for (int y = 0; status == BT_OK && y < H; y += tall)
    for (int x = 0; status == BT_OK && x < W; x += side)
      {
        int w = smaller (side, W - x), h = smaller (tall, H - y);
        draw_scene (j, &(bt__window){ x - m, y - m, w + 2 * m, h + 2 * m });
        resolve (j, x, y, w, h);
        status = read_back (j, x, y, w, h, picture, error);
      }
  if (status == BT_OK && j->gl->GetError () == GL_OUT_OF_MEMORY)
    status = bt__fail (error, BT_ERR_LIMIT, "OpenGL has no memory left for the picture");
  return status;
}

/* ---- The whole ---- */

bt_status
bt__check_size (int width, int height, bt_error *error)
{
  if (width < BT__SIDE_MIN || height < BT__SIDE_MIN || width > BT__SIDE_MAX
      || height > BT__SIDE_MAX)
    return bt__fail (error, BT_ERR_DOMAIN,
                     "a picture is %d to %d pixels wide and high, not %d x %d", BT__SIDE_MIN,
                     BT__SIDE_MAX, width, height);
  return BT_OK;
}

/* Shadows four fifths as fine as the picture: the map spans all that casts them, and its texels are
   blended.  */
static int
shadow_side (const bt__job *j)
{
  int longest = j->drawing.width > j->drawing.height ? j->drawing.width : j->drawing.height;
  return j->drawing.quick || longest <= 640 ? 512 : longest <= 1280 ? 1024 : 2048;
}

static bt_status
draw_alone (bt__job *j, bt__picture *picture, bt_error *error)
{
  bt_status status = j->r->backend->use (j->r->context, error);
  if (status != BT_OK)
    return status;
  j->gl->Enable (GL_DEPTH_TEST);
  j->gl->PixelStorei (GL_PACK_ALIGNMENT, 4);
  j->resolve = bt__renderer_resolve (j->r, j->drawing.samples, j->optics.perspective,
                                     sees_surface (j), error);
  j->shade = j->resolve ? bt__renderer_shadows (j->r, shadow_side (j), error) : NULL;
  upload (j);
  if (j->shade)
    {
      draw_shadows (j);
      status = draw_tiles (j, picture, error);
    }
  else
    status = BT_ERR_UNSUPPORTED;
  j->gl->DeleteBuffers (2, j->buffer);
  j->gl->DeleteVertexArrays (1, &j->array);
  bt__frames_leave (j);
  j->r->backend->leave (j->r->context);
  return status;
}

/* A context is for one thread at a time.  */
static bt_status
draw_in_context (bt__job *j, bt__picture *picture, bt_error *error)
{
  bt_status status;
  pthread_mutex_lock (&j->r->lock);
  status = draw_alone (j, picture, error);
  pthread_mutex_unlock (&j->r->lock);
  return status;
}

bt_status
bt__render (bt__renderer *r, const bt_view *view, const bt__drawing *drawing, bt__picture *picture,
            bt_error *error)
{
  bt__job j = { .r = r, .gl = &r->gl, .view = view, .drawing = *drawing };
  bt_status status = bt__check_size (drawing->width, drawing->height, error);
  if (status != BT_OK)
    return status;
  j.optics = bt__optics_of (&view->camera, (double)drawing->width / drawing->height);
  j.soup.origin = view->camera.at;
  j.soup.lens = bt__lens_of (&j.optics, drawing->height, drawing->quick);
  j.reach = drawing->height / 50;
  j.margin = j.reach + 4;
  bt__prepare (&j);
  status = j.soup.full ? bt__fail (error, BT_ERR_LIMIT, "there is no memory left for the scene")
                       : bt__picture_new (picture, drawing->width, drawing->height, error);
  if (status == BT_OK && (status = draw_in_context (&j, picture, error)) != BT_OK)
    bt__picture_free (picture);
  bt__soup_free (&j.soup);
  return status;
}
