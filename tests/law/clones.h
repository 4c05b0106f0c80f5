/* A function compiled for several machines, of which those that this one runs are compared.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#ifndef TESTS_CLONES_H
#define TESTS_CLONES_H

#include "math/wide.h"

/* Of the function F, which is always inlined: F_clones[0] for any machine, and more of them.  One
   has fused multiplications at hand, which the compiler must not use.  */
#if defined __x86_64__ && defined __GNUC__
#define CLONES(type, f, parameters, arguments)                                                     \
  static type f##_default parameters                                                               \
  {                                                                                                \
    return f arguments;                                                                            \
  }                                                                                                \
  __attribute__ ((target ("avx2"))) static type f##_avx2 parameters                                \
  {                                                                                                \
    return f arguments;                                                                            \
  }                                                                                                \
  __attribute__ ((target ("avx2,fma"))) static type f##_fma parameters                             \
  {                                                                                                \
    return f arguments;                                                                            \
  }                                                                                                \
  __attribute__ ((target ("avx512f"))) static type f##_avx512 parameters                           \
  {                                                                                                \
    return f arguments;                                                                            \
  }                                                                                                \
  static type (*const f##_clones[]) parameters = { f##_default, f##_avx2, f##_fma, f##_avx512 };

enum
{
  N_CLONES = 4
};

/* Nonzero if this machine runs clone C.  */
static inline int
clone_runs (int c)
{
  switch (c)
    {
    case 0:
      return 1;
    case 1:
      return __builtin_cpu_supports ("avx2");
    case 2:
      return __builtin_cpu_supports ("avx2") && __builtin_cpu_supports ("fma");
    default:
      return __builtin_cpu_supports ("avx512f");
    }
}
#else
#define CLONES(type, f, parameters, arguments)                                                     \
  static type f##_default parameters                                                               \
  {                                                                                                \
    return f arguments;                                                                            \
  }                                                                                                \
  static type (*const f##_clones[]) parameters = { f##_default };

enum
{
  N_CLONES = 1
};

static inline int
clone_runs (int c)
{
  return c == 0;
}
#endif

#endif
