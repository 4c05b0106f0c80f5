/* What the renderer keeps in its context.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#ifndef BT_RENDER_RENDERER_H
#define BT_RENDER_RENDERER_H

#include "render/gl.h"
#include "render/render.h"

enum
{
  BT__SHADOW_SIDE = 2048
};

struct bt__renderer
{
  const bt__backend *backend;
  void *context;
  bt__gl gl;
  GLuint scene, shadow, resolve; /* programs */
  GLuint shadow_map, shadow_frame;
  GLuint empty; /* a vertex array for what has no vertices */
  char name[200];
};

#endif
