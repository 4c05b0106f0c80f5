/* The buffers of pictures, kept from picture to picture: with drawing by a processor, fresh memory
   costs as much as some of the drawing.  Buffers of more than five million samples are freed after
   the picture.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include "base/error.h"
#include "render/job.h"

enum
{
  KEPT = 5000000 /* samples of buffers that are kept */
};

static GLuint
new_texture (const bt__gl *gl, GLint form, int w, int h, GLenum layout, GLenum type)
{
  GLuint t;
  gl->GenTextures (1, &t);
  gl->BindTexture (GL_TEXTURE_2D, t);
  gl->TexImage2D (GL_TEXTURE_2D, 0, form, w, h, 0, layout, type, NULL);
  gl->TexParameteri (GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
  gl->TexParameteri (GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
  return t;
}

static GLuint
new_depths (const bt__gl *gl, int w, int h)
{
  return new_texture (gl, GL_DEPTH_COMPONENT32F, w, h, GL_DEPTH_COMPONENT, GL_FLOAT);
}

int
bt__cells (int n)
{
  return n / 2 + 3;
}

/* Samples along a side of N pixels.  */
static int
samples_of (const bt__frames *f, int n)
{
  return f->samples * (n + 2 * f->margin);
}

static void
free_frames (const bt__gl *gl, bt__frames *f)
{
  GLuint textures[] = { f->colors, f->shapes, f->depths, f->pixels, f->kinds, f->sky };
  if (f->w == 0)
    return;
  gl->DeleteFramebuffers (3, f->frame);
  gl->DeleteTextures (6, textures);
  *f = (bt__frames){ .w = 0 };
}

/* Attach the N textures COLORS, and DEPTHS unless 0, to FRAME; return true if the frame is
   complete.  */
static int
bind_frame (const bt__gl *gl, GLuint frame, const GLuint *colors, GLsizei n, GLuint depths)
{
  static const GLenum where[] = { GL_COLOR_ATTACHMENT0, GL_COLOR_ATTACHMENT1 };
  gl->BindFramebuffer (GL_FRAMEBUFFER, frame);
  for (int i = 0; i < n; i++)
    gl->FramebufferTexture2D (GL_FRAMEBUFFER, where[i], GL_TEXTURE_2D, colors[i], 0);
  if (depths)
    gl->FramebufferTexture2D (GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_TEXTURE_2D, depths, 0);
  gl->DrawBuffers (n, where);
  return gl->CheckFramebufferStatus (GL_FRAMEBUFFER) == GL_FRAMEBUFFER_COMPLETE;
}

static bt_status
make_frames (const bt__gl *gl, bt__frames *f, bt_error *error)
{
  int w = f->w, h = f->h, bw = samples_of (f, w), bh = samples_of (f, h), ok;
  f->colors = new_texture (gl, GL_RGBA8, bw, bh, GL_RGBA, GL_UNSIGNED_BYTE);
  f->shapes = new_texture (gl, GL_RGB10_A2, bw, bh, GL_RGBA, GL_UNSIGNED_INT_2_10_10_10_REV);
  f->depths = new_depths (gl, bw, bh);
  f->pixels = new_texture (gl, GL_RGBA8, w, h, GL_RGBA, GL_UNSIGNED_BYTE);
  f->kinds = new_depths (gl, w, h);
  f->sky = new_texture (gl, GL_RGBA32F, bt__cells (w), bt__cells (h), GL_RGBA, GL_FLOAT);
  gl->GenFramebuffers (3, f->frame);
  ok = bind_frame (gl, f->frame[0], (const GLuint[]){ f->colors, f->shapes }, 2, f->depths)
       && bind_frame (gl, f->frame[1], &f->pixels, 1, f->kinds)
       && bind_frame (gl, f->frame[2], &f->sky, 1, 0);
  if (ok)
    return BT_OK;
  free_frames (gl, f);
  return bt__fail (error, BT_ERR_LIMIT, "OpenGL has no room for %d x %d samples", bw, bh);
}

bt_status
bt__frames_have (bt__job *j, int w, int h, bt_error *error)
{
  bt__frames *f = &j->r->frames;
  int margin = j->margin, samples = j->drawing.samples;
  j->frames = f;
  if (f->w == w && f->h == h && f->margin == margin && f->samples == samples)
    return BT_OK;
  free_frames (j->gl, f);
  *f = (bt__frames){ .w = w, .h = h, .margin = margin, .samples = samples };
  return make_frames (j->gl, f, error);
}

void
bt__frames_leave (bt__job *j)
{
  bt__frames *f = &j->r->frames;
  if ((double)samples_of (f, f->w) * samples_of (f, f->h) > KEPT)
    free_frames (j->gl, f);
}
