/* Other collision libraries at the same work, where they are installed.

   Each builds what it makes of a soup of triangles, and says for a tether of N links which
   triangles are within REACH of each: how many, and the sum of their numbers, to compare.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#ifndef BT_BENCH_RIVALS_H
#define BT_BENCH_RIVALS_H

#include <stdint.h>

#include "jacket.h"

#ifdef __cplusplus
extern "C"
{
#endif

  typedef struct rival_answer
  {
    long pairs;
    uint64_t sum; /* of the triangles' numbers */
  } rival_answer;

  typedef struct rival
  {
    const char *name;
    void *(*build) (const jacket *);
    rival_answer (*frame) (void *, const bt_vec3 *x, int n, double reach);
    void (*drop) (void *);
  } rival;

  extern const rival rival_fcl, rival_bullet_contact, rival_bullet_tree;

  /* Nonzero if triangle V is within REACH of the link from A to B; for libraries that leave it to
     the caller to measure.  */
  int rival_measure (const bt_vec3 v[3], bt_vec3 a, bt_vec3 b, double reach);

#ifdef __cplusplus
}
#endif

#endif
