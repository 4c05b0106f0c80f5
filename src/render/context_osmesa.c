/* OSMesa: OpenGL drawn by the processor, without a window system.  The library is opened when the
   first picture is asked for.  Mesa 25.1 and later lack the library; the few declarations needed of
   its final header are repeated here, and no build depends on OSMesa.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <config.h>

#include <dlfcn.h>
#include <stdlib.h>

#include "base/error.h"
#include "render/gl.h"

typedef struct osmesa_context *osmesa_context;
typedef osmesa_context create_function (const int *attributes, osmesa_context sharing);
typedef GLboolean use_function (osmesa_context, void *, GLenum, GLsizei, GLsizei);
typedef bt__gl_function find_function (const char *);
typedef void destroy_function (osmesa_context);

enum
{
  /* <GL/osmesa.h> */
  OSMESA_FORMAT = 0x22,
  OSMESA_RGBA = GL_RGBA,
  OSMESA_PROFILE = 0x33,
  OSMESA_CORE_PROFILE = 0x34,
  OSMESA_CONTEXT_MAJOR_VERSION = 0x36,
  OSMESA_CONTEXT_MINOR_VERSION = 0x37,
  SIDE = 16 /* of the buffer that OSMesa insists on; pictures are drawn elsewhere */
};

typedef struct osmesa
{
  void *library;
  create_function *create;
  use_function *use;
  find_function *find;
  destroy_function *destroy;
  osmesa_context context;
  unsigned char buffer[4 * SIDE * SIDE];
} osmesa;

static void
close_osmesa (void *context)
{
  osmesa *o = context;
  if (o->context)
    o->destroy (o->context);
  /* The library stays: its threads may still be there.  */
  free (o);
}

static bt_status
load_osmesa (osmesa *o, bt_error *error)
{
  static const char *const files[] = { "libOSMesa.so.8", "libOSMesa.so.6", "libOSMesa.so" };
  for (size_t i = 0; !o->library && i < sizeof files / sizeof *files; i++)
    o->library = dlopen (files[i], RTLD_NOW | RTLD_LOCAL);
  if (!o->library)
    return bt__fail (error, BT_ERR_UNSUPPORTED, "libOSMesa is not installed");
  o->create = (create_function *)dlsym (o->library, "OSMesaCreateContextAttribs");
  o->use = (use_function *)dlsym (o->library, "OSMesaMakeCurrent");
  o->find = (find_function *)dlsym (o->library, "OSMesaGetProcAddress");
  o->destroy = (destroy_function *)dlsym (o->library, "OSMesaDestroyContext");
  if (!o->create || !o->use || !o->find || !o->destroy)
    return bt__fail (error, BT_ERR_UNSUPPORTED, "libOSMesa is too old");
  return BT_OK;
}

static bt_status
open_osmesa (void **context, bt_error *error)
{
  static const int attributes[] = { OSMESA_FORMAT,
                                    OSMESA_RGBA,
                                    OSMESA_PROFILE,
                                    OSMESA_CORE_PROFILE,
                                    OSMESA_CONTEXT_MAJOR_VERSION,
                                    3,
                                    OSMESA_CONTEXT_MINOR_VERSION,
                                    3,
                                    0 };
  osmesa *o = calloc (1, sizeof *o);
  bt_status status;
  if (!o)
    return bt__fail (error, BT_ERR_LIMIT, "there is no memory left");
  status = load_osmesa (o, error);
  if (status == BT_OK && !(o->context = o->create (attributes, NULL)))
    status = bt__fail (error, BT_ERR_UNSUPPORTED, "libOSMesa has no OpenGL 3.3");
  if (status != BT_OK)
    close_osmesa (o);
  else
    *context = o;
  return status;
}

static bt_status
use_osmesa (void *context, bt_error *error)
{
  osmesa *o = context;
  if (!o->use (o->context, o->buffer, GL_UNSIGNED_BYTE, SIDE, SIDE))
    return bt__fail (error, BT_ERR_UNSUPPORTED, "libOSMesa cannot make its context current");
  return BT_OK;
}

static void
leave_osmesa (void *context)
{
  osmesa *o = context;
  o->use (NULL, NULL, 0, 0, 0);
}

static bt__gl_function
find_osmesa (void *context, const char *name)
{
  osmesa *o = context;
  return o->find (name);
}

const bt__backend bt__backend_osmesa
    = { "osmesa", "OSMesa", open_osmesa, use_osmesa, leave_osmesa, find_osmesa, close_osmesa };
