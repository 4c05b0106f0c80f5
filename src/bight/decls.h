/* The frame of every public header: C linkage in C++.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#ifndef BIGHT_DECLS_H
#define BIGHT_DECLS_H

#ifdef __cplusplus
#define BT_BEGIN_DECLS                                                                             \
  extern "C"                                                                                       \
  {
#define BT_END_DECLS }
#else
#define BT_BEGIN_DECLS
#define BT_END_DECLS
#endif

#endif
