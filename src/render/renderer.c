/* Opening a context, compiling the shaders.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/error.h"
#include "render/renderer.h"
#include "render/shaders.h"

/* ---- Shaders ---- */

static bt_status
compile (const bt__gl *gl, GLenum kind, const char *const *text, GLuint *shader, bt_error *error)
{
  GLsizei n = 0;
  GLint ok = 0;
  while (text[n])
    n++;
  *shader = gl->CreateShader (kind);
  gl->ShaderSource (*shader, n, (const GLchar *const *)text, NULL);
  gl->CompileShader (*shader);
  gl->GetShaderiv (*shader, GL_COMPILE_STATUS, &ok);
  if (!ok)
    {
      char log[300] = "";
      gl->GetShaderInfoLog (*shader, sizeof log, NULL, log);
      log[strcspn (log, "\n")] = 0;
      return bt__fail (error, BT_ERR_UNSUPPORTED, "this OpenGL does not take a shader: %s", log);
    }
  return BT_OK;
}

static bt_status
link_program (const bt__gl *gl, const char *const *vertex, const char *const *fragment,
              GLuint *program, bt_error *error)
{
  GLuint v = 0, f = 0;
  GLint ok = 0;
  bt_status status = compile (gl, GL_VERTEX_SHADER, vertex, &v, error);
  if (status == BT_OK)
    status = compile (gl, GL_FRAGMENT_SHADER, fragment, &f, error);
  if (status == BT_OK)
    {
      *program = gl->CreateProgram ();
      gl->AttachShader (*program, v);
      gl->AttachShader (*program, f);
      gl->LinkProgram (*program);
      gl->GetProgramiv (*program, GL_LINK_STATUS, &ok);
      if (!ok)
        status = bt__fail (error, BT_ERR_UNSUPPORTED, "this OpenGL does not link the shaders");
    }
  gl->DeleteShader (v);
  gl->DeleteShader (f);
  return status;
}

static bt_status
build_programs (bt__renderer *r, bt_error *error)
{
  bt_status status
      = link_program (&r->gl, bt__shader_scene_vertex, bt__shader_scene_fragment, &r->scene, error);
  if (status == BT_OK)
    status = link_program (&r->gl, bt__shader_shadow_vertex, bt__shader_shadow_fragment, &r->shadow,
                           error);
  return status;
}

static bt_status
build_pass (const bt__gl *gl, int pass, int samples, int perspective, GLuint *program,
            bt_error *error)
{
  const char *text[BT__SHADER_PARTS];
  char constants[100];
  snprintf (constants, sizeof constants,
            "#define PASS %d\n#define SAMPLES %d\n#define PERSPECTIVE %d\n", pass, samples,
            perspective);
  bt__shader_pixels (pass, constants, text);
  return link_program (gl, bt__shader_resolve_vertex, text, program, error);
}

/* Link the programs of a picture at its first use: a process that draws one picture pays for one
   set of programs.  */
const GLuint *
bt__renderer_resolve (bt__renderer *r, int samples, int perspective, int surface, bt_error *error)
{
  GLuint *program = r->resolve[samples > 1][perspective != 0];
  bt_status status = BT_OK;
  for (int i = 0; status == BT_OK && i < BT__RESOLVE_PASSES; i++)
    if (!program[i] && (surface || i < BT__RESOLVE_HIGH || i == BT__RESOLVE_SKY))
      status = build_pass (&r->gl, i, samples > 1 ? 2 : 1, perspective != 0, &program[i], error);
  return status == BT_OK ? program : NULL;
}

/* ---- Shadow maps ---- */

static bt_status
build_shadows (const bt__gl *gl, int side, bt__shadows *s, bt_error *error)
{
  s->side = side;
  gl->GenTextures (1, &s->map);
  gl->BindTexture (GL_TEXTURE_2D, s->map);
  gl->TexImage2D (GL_TEXTURE_2D, 0, GL_DEPTH_COMPONENT16, side, side, 0, GL_DEPTH_COMPONENT,
                  GL_UNSIGNED_SHORT, NULL);
  gl->TexParameteri (GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
  gl->TexParameteri (GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
  gl->TexParameteri (GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
  gl->TexParameteri (GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
  gl->TexParameteri (GL_TEXTURE_2D, GL_TEXTURE_COMPARE_MODE, GL_COMPARE_REF_TO_TEXTURE);
  gl->GenFramebuffers (1, &s->frame);
  gl->BindFramebuffer (GL_FRAMEBUFFER, s->frame);
  gl->FramebufferTexture2D (GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_TEXTURE_2D, s->map, 0);
  gl->DrawBuffers (1, (const GLenum[]){ GL_NONE });
  if (gl->CheckFramebufferStatus (GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE)
    return bt__fail (error, BT_ERR_UNSUPPORTED, "this OpenGL cannot draw shadows");
  return BT_OK;
}

/* A map is made at its first use: a process draws pictures of one size, mostly.  A map without
   memory is tried again by the next picture.  */
const bt__shadows *
bt__renderer_shadows (bt__renderer *r, int side, bt_error *error)
{
  int i = 0;
  while (i < BT__SHADOW_SIZES - 1 && r->shadows[i].map && r->shadows[i].side != side)
    i++;
  if (r->shadows[i].map && r->shadows[i].side == side)
    return &r->shadows[i];
  return build_shadows (&r->gl, side, &r->shadows[i], error) == BT_OK ? &r->shadows[i] : NULL;
}

/* ---- Life ---- */

static void
set_name (bt__renderer *r)
{
  const char *version = (const char *)r->gl.GetString (GL_VERSION);
  snprintf (r->name, sizeof r->name, "%s, OpenGL %s", r->backend->full, version ? version : "");
}

/* The context is current from use to leave.  */
static bt_status
furnish (bt__renderer *r, bt_error *error)
{
  bt_status status = r->backend->use (r->context, error);
  if (status != BT_OK)
    return status;
  status = bt__gl_load (&r->gl, r->backend, r->context, error);
  if (status == BT_OK)
    status = build_programs (r, error);
  if (status == BT_OK)
    {
      r->gl.GenVertexArrays (1, &r->empty);
      set_name (r);
    }
  r->backend->leave (r->context);
  return status;
}

static bt_status
open_backend (const bt__backend *backend, bt__renderer **renderer, bt_error *error)
{
  bt__renderer *r = calloc (1, sizeof *r);
  bt_status status;
  if (!r)
    return bt__fail (error, BT_ERR_LIMIT, "there is no memory left");
  r->backend = backend;
  pthread_mutex_init (&r->lock, NULL);
  status = backend->open (&r->context, error);
  if (status == BT_OK)
    status = furnish (r, error);
  if (status == BT_OK)
    *renderer = r;
  else
    bt__renderer_free (r);
  return status;
}

/* Closing the context frees all its objects.  */
void
bt__renderer_free (bt__renderer *r)
{
  if (!r)
    return;
  if (r->context)
    r->backend->close (r->context);
  pthread_mutex_destroy (&r->lock);
  free (r);
}

const char *
bt__renderer_name (const bt__renderer *r)
{
  return r->name;
}

static const bt__backend *
backend_called (const char *name)
{
  if (strcmp (name, bt__backend_osmesa.name) == 0)
    return &bt__backend_osmesa;
  return strcmp (name, bt__backend_egl.name) == 0 ? &bt__backend_egl : NULL;
}

static bt_status
open_named (const char *name, bt__renderer **renderer, bt_error *error)
{
  const bt__backend *backend = backend_called (name);
  bt_error why;
  bt_status status;
  if (!backend)
    return bt__fail (error, BT_ERR_NAME, "pictures are drawn by osmesa or egl, not by `%.40s'",
                     name);
  status = open_backend (backend, renderer, &why);
  if (status != BT_OK)
    return bt__fail (error, status, "no picture can be drawn by %s: %s", name, why.text);
  return BT_OK;
}

bt_status
bt__renderer_new (const char *name, bt__renderer **renderer, bt_error *error)
{
  const char *wish = name ? name : getenv ("BIGHT_GL");
  bt_error first, second;
  if (wish && *wish)
    return open_named (wish, renderer, error);
  if (open_backend (&bt__backend_osmesa, renderer, &first) == BT_OK
      || open_backend (&bt__backend_egl, renderer, &second) == BT_OK)
    return BT_OK;
  return bt__fail (error, BT_ERR_UNSUPPORTED,
                   "no picture can be drawn: OSMesa: %.120s; EGL: %.120s (Debian packages: "
                   "libegl1, libgl1-mesa-dri)",
                   first.text, second.text);
}
