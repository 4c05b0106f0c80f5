/* What the renderer keeps in its context.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#ifndef BT_RENDER_RENDERER_H
#define BT_RENDER_RENDERER_H

#include <pthread.h>

#include "render/gl.h"
#include "render/render.h"
#include "render/shaders.h"

enum
{
  BT__SHADOW_SIZES = 3
};

/* Depths seen from the sun.  */
typedef struct bt__shadows
{
  GLuint map, frame;
  int side; /* pixels */
} bt__shadows;

/* Buffers for tiles of W by H pixels: samples by colour, by shape, by depth; pixels and of which
   kind they are; how open the sky is.  */
typedef struct bt__frames
{
  int w, h, margin, samples;
  GLuint frame[3];
  GLuint colors, shapes, depths, pixels, kinds, sky;
} bt__frames;

struct bt__renderer
{
  const bt__backend *backend;
  void *context;
  bt__gl gl;
  GLuint scene, shadow; /* programs */
  /* For one sample a pixel or two squared, without perspective or with it; 0 until they are wanted.
   */
  GLuint resolve[2][2][BT__RESOLVE_PASSES];
  bt__shadows shadows[BT__SHADOW_SIZES]; /* likewise; MAP 0 until it is wanted */
  bt__frames frames;                     /* of the last picture; W 0: there are none */
  pthread_mutex_t lock;                  /* of the context: a picture at a time */
  GLuint empty;                          /* a vertex array for what has no vertices */
  char name[200];
};

/* Have the programs that make pixels of SAMPLES squared, 1 or 2, for PERSPECTIVE or none, those for
   the surface of the sea if SURFACE is true; the context is current.  NULL: they are not to be had,
   and ERROR says why.  */
const GLuint *bt__renderer_resolve (bt__renderer *r, int samples, int perspective, int surface,
                                    bt_error *error);

/* Have the shadow map of SIDE pixels, likewise.  */
const bt__shadows *bt__renderer_shadows (bt__renderer *r, int side, bt_error *error);

#endif
