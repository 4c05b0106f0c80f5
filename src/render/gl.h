/* The functions of OpenGL 3.3 core used by the renderer, as pointers from the context: no GL
   library is linked.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#ifndef BT_RENDER_GL_H
#define BT_RENDER_GL_H

#include <GL/glcorearb.h>

#include <bight/status.h>

/* X (type, name) for each function.  */
#define BT__GL_FUNCTIONS(X)                                                                        \
  X (PFNGLATTACHSHADERPROC, AttachShader)                                                          \
  X (PFNGLBINDBUFFERPROC, BindBuffer)                                                              \
  X (PFNGLBINDFRAMEBUFFERPROC, BindFramebuffer)                                                    \
  X (PFNGLBINDTEXTUREPROC, BindTexture)                                                            \
  X (PFNGLBINDVERTEXARRAYPROC, BindVertexArray)                                                    \
  X (PFNGLACTIVETEXTUREPROC, ActiveTexture)                                                        \
  X (PFNGLBINDATTRIBLOCATIONPROC, BindAttribLocation)                                              \
  X (PFNGLBLENDCOLORPROC, BlendColor)                                                              \
  X (PFNGLBLENDFUNCSEPARATEPROC, BlendFuncSeparate)                                                \
  X (PFNGLBUFFERDATAPROC, BufferData)                                                              \
  X (PFNGLCHECKFRAMEBUFFERSTATUSPROC, CheckFramebufferStatus)                                      \
  X (PFNGLCLEARBUFFERFVPROC, ClearBufferfv)                                                        \
  X (PFNGLCOMPILESHADERPROC, CompileShader)                                                        \
  X (PFNGLCREATEPROGRAMPROC, CreateProgram)                                                        \
  X (PFNGLCREATESHADERPROC, CreateShader)                                                          \
  X (PFNGLDELETEBUFFERSPROC, DeleteBuffers)                                                        \
  X (PFNGLDELETEFRAMEBUFFERSPROC, DeleteFramebuffers)                                              \
  X (PFNGLDELETEPROGRAMPROC, DeleteProgram)                                                        \
  X (PFNGLDELETESHADERPROC, DeleteShader)                                                          \
  X (PFNGLDELETETEXTURESPROC, DeleteTextures)                                                      \
  X (PFNGLDELETEVERTEXARRAYSPROC, DeleteVertexArrays)                                              \
  X (PFNGLDEPTHFUNCPROC, DepthFunc)                                                                \
  X (PFNGLDEPTHMASKPROC, DepthMask)                                                                \
  X (PFNGLDISABLEPROC, Disable)                                                                    \
  X (PFNGLDRAWARRAYSPROC, DrawArrays)                                                              \
  X (PFNGLDRAWBUFFERSPROC, DrawBuffers)                                                            \
  X (PFNGLDRAWELEMENTSPROC, DrawElements)                                                          \
  X (PFNGLENABLEPROC, Enable)                                                                      \
  X (PFNGLENABLEVERTEXATTRIBARRAYPROC, EnableVertexAttribArray)                                    \
  X (PFNGLFRAMEBUFFERTEXTURE2DPROC, FramebufferTexture2D)                                          \
  X (PFNGLGENBUFFERSPROC, GenBuffers)                                                              \
  X (PFNGLGENFRAMEBUFFERSPROC, GenFramebuffers)                                                    \
  X (PFNGLGENTEXTURESPROC, GenTextures)                                                            \
  X (PFNGLGENVERTEXARRAYSPROC, GenVertexArrays)                                                    \
  X (PFNGLGETERRORPROC, GetError)                                                                  \
  X (PFNGLGETPROGRAMINFOLOGPROC, GetProgramInfoLog)                                                \
  X (PFNGLGETPROGRAMIVPROC, GetProgramiv)                                                          \
  X (PFNGLGETSHADERINFOLOGPROC, GetShaderInfoLog)                                                  \
  X (PFNGLGETSHADERIVPROC, GetShaderiv)                                                            \
  X (PFNGLGETSTRINGPROC, GetString)                                                                \
  X (PFNGLGETUNIFORMLOCATIONPROC, GetUniformLocation)                                              \
  X (PFNGLLINKPROGRAMPROC, LinkProgram)                                                            \
  X (PFNGLPIXELSTOREIPROC, PixelStorei)                                                            \
  X (PFNGLREADPIXELSPROC, ReadPixels)                                                              \
  X (PFNGLSHADERSOURCEPROC, ShaderSource)                                                          \
  X (PFNGLTEXIMAGE2DPROC, TexImage2D)                                                              \
  X (PFNGLTEXPARAMETERIPROC, TexParameteri)                                                        \
  X (PFNGLUNIFORM1FPROC, Uniform1f)                                                                \
  X (PFNGLUNIFORM1IPROC, Uniform1i)                                                                \
  X (PFNGLUNIFORM2FPROC, Uniform2f)                                                                \
  X (PFNGLUNIFORM3FPROC, Uniform3f)                                                                \
  X (PFNGLUNIFORMMATRIX4FVPROC, UniformMatrix4fv)                                                  \
  X (PFNGLUSEPROGRAMPROC, UseProgram)                                                              \
  X (PFNGLVERTEXATTRIBPOINTERPROC, VertexAttribPointer)                                            \
  X (PFNGLVIEWPORTPROC, Viewport)

typedef struct bt__gl
{
#define BT__GL_MEMBER(type, name) type name;
  BT__GL_FUNCTIONS (BT__GL_MEMBER)
#undef BT__GL_MEMBER
} bt__gl;

typedef void (*bt__gl_function) (void);

/* A way to a context that draws without a window.  */
typedef struct bt__backend
{
  const char *name; /* "osmesa" */
  const char *full; /* "OSMesa" */
  /* Make a context into *CONTEXT; on failure fill ERROR with why.  */
  bt_status (*open) (void **context, bt_error *error);
  /* Make CONTEXT the current one of this thread.  */
  bt_status (*use) (void *context, bt_error *error);
  /* Leave this thread without a current context.  */
  void (*leave) (void *context);
  bt__gl_function (*find) (void *context, const char *name);
  void (*close) (void *context);
} bt__backend;

extern const bt__backend bt__backend_osmesa, bt__backend_egl;

/* Fill GL from the current context of BACKEND.  BT_ERR_UNSUPPORTED names a function that is not
   there.  */
bt_status bt__gl_load (bt__gl *gl, const bt__backend *backend, void *context, bt_error *error);

#endif
