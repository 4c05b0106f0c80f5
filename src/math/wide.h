/* Functions compiled more than once: for any machine, and for one with AVX2.

   Which is called is settled when the library is loaded; libtool exports no such function, so a
   public one calls it.  AVX2 brings no fused multiplication, and the compiler is told to make none,
   so that both give the same bits.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#ifndef BT_MATH_WIDE_H
#define BT_MATH_WIDE_H

/* Sanitizers are not yet set up when the choice is made.  */
#if defined __x86_64__ && defined __gnu_linux__ && defined __GNUC__ && !defined __clang__          \
    && !defined __SANITIZE_ADDRESS__ && !defined __SANITIZE_THREAD__
#define BT__WIDE __attribute__ ((target_clones ("avx2", "default")))
#else
#define BT__WIDE
#endif

/* For the helpers of a wide function, inlined or else compiled for the lesser machine; and for
   functions of an innermost loop worth inlining several times.  */
#if defined __GNUC__
#define BT__HOT inline __attribute__ ((always_inline))
#else
#define BT__HOT inline
#endif

#endif
