/* EGL on no surface: OpenGL without a window system, by the graphics card where there is one.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <config.h>

#include <dlfcn.h>
#include <stdlib.h>

#include "base/error.h"
#include "render/gl.h"

#define EGL_NO_X11
#include <EGL/egl.h>
#include <EGL/eglext.h>

/* X (name) for each function of EGL.  */
#define FUNCTIONS(X)                                                                               \
  X (GetProcAddress)                                                                               \
  X (Initialize)                                                                                   \
  X (BindAPI)                                                                                      \
  X (ChooseConfig)                                                                                 \
  X (CreateContext)                                                                                \
  X (DestroyContext)                                                                               \
  X (MakeCurrent)                                                                                  \
  X (GetDisplay)

typedef struct egl
{
#define MEMBER(name) __typeof__ (&egl##name) name;
  FUNCTIONS (MEMBER)
#undef MEMBER
  void *library;
  EGLDisplay display;
  EGLContext context;
} egl;

static void
close_egl (void *context)
{
  egl *e = context;
  if (e->context != EGL_NO_CONTEXT)
    e->DestroyContext (e->display, e->context);
  free (e);
}

static bt_status
load_egl (egl *e, bt_error *error)
{
  e->library = dlopen ("libEGL.so.1", RTLD_NOW | RTLD_LOCAL);
  if (!e->library)
    return bt__fail (error, BT_ERR_UNSUPPORTED, "libEGL is not installed");
#define FIND(name)                                                                                 \
  e->name = (__typeof__ (e->name))dlsym (e->library, "egl" #name);                                 \
  if (!e->name)                                                                                    \
    return bt__fail (error, BT_ERR_UNSUPPORTED, "libEGL has no function egl" #name);
  FUNCTIONS (FIND)
#undef FIND
  return BT_OK;
}

static EGLDisplay
find_display (egl *e)
{
  PFNEGLGETPLATFORMDISPLAYEXTPROC get
      = (PFNEGLGETPLATFORMDISPLAYEXTPROC)e->GetProcAddress ("eglGetPlatformDisplayEXT");
  EGLDisplay display = EGL_NO_DISPLAY;
  if (get)
    display = get (EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, NULL);
  return display != EGL_NO_DISPLAY ? display : e->GetDisplay (EGL_DEFAULT_DISPLAY);
}

static bt_status
make_context (egl *e, bt_error *error)
{
  static const EGLint wanted[]
      = { EGL_RENDERABLE_TYPE, EGL_OPENGL_BIT, EGL_SURFACE_TYPE, 0, EGL_NONE };
  static const EGLint attributes[] = { EGL_CONTEXT_MAJOR_VERSION,
                                       3,
                                       EGL_CONTEXT_MINOR_VERSION,
                                       3,
                                       EGL_CONTEXT_OPENGL_PROFILE_MASK,
                                       EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT,
                                       EGL_NONE };
  EGLConfig config = NULL;
  EGLint n = 0;
  e->display = find_display (e);
  if (e->display == EGL_NO_DISPLAY || !e->Initialize (e->display, NULL, NULL))
    return bt__fail (error, BT_ERR_UNSUPPORTED, "EGL cannot work without a window system here");
  if (!e->BindAPI (EGL_OPENGL_API))
    return bt__fail (error, BT_ERR_UNSUPPORTED, "EGL has no OpenGL here");
  if (!e->ChooseConfig (e->display, wanted, &config, 1, &n) || n < 1)
    config = NULL; /* EGL_KHR_no_config_context */
  e->context = e->CreateContext (e->display, config, EGL_NO_CONTEXT, attributes);
  if (e->context == EGL_NO_CONTEXT)
    return bt__fail (error, BT_ERR_UNSUPPORTED, "EGL has no OpenGL 3.3 here");
  return BT_OK;
}

static bt_status
open_egl (void **context, bt_error *error)
{
  egl *e = calloc (1, sizeof *e);
  bt_status status;
  if (!e)
    return bt__fail (error, BT_ERR_LIMIT, "there is no memory left");
  status = load_egl (e, error);
  if (status == BT_OK)
    status = make_context (e, error);
  if (status != BT_OK)
    close_egl (e);
  else
    *context = e;
  return status;
}

static bt_status
use_egl (void *context, bt_error *error)
{
  egl *e = context;
  e->BindAPI (EGL_OPENGL_API);
  if (!e->MakeCurrent (e->display, EGL_NO_SURFACE, EGL_NO_SURFACE, e->context))
    return bt__fail (error, BT_ERR_UNSUPPORTED, "EGL cannot draw without a surface here");
  return BT_OK;
}

static void
leave_egl (void *context)
{
  egl *e = context;
  e->MakeCurrent (e->display, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
}

static bt__gl_function
find_egl (void *context, const char *name)
{
  egl *e = context;
  return (bt__gl_function)e->GetProcAddress (name);
}

const bt__backend bt__backend_egl
    = { "egl", "EGL", open_egl, use_egl, leave_egl, find_egl, close_egl };
