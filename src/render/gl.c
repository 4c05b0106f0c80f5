/* Fetching the functions of OpenGL from a context.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include "base/error.h"
#include "render/gl.h"

bt_status
bt__gl_load (bt__gl *gl, const bt__backend *backend, void *context, bt_error *error)
{
#define BT__GL_FIND(type, name)                                                                    \
  gl->name = (type)backend->find (context, "gl" #name);                                            \
  if (!gl->name)                                                                                   \
    return bt__fail (error, BT_ERR_UNSUPPORTED, "%s has no function gl" #name, backend->full);
  BT__GL_FUNCTIONS (BT__GL_FIND)
#undef BT__GL_FIND
  return BT_OK;
}
