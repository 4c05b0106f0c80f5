/* What law_orders refines: each law hands out some numbers at refinement K, twice as fine as K - 1.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#ifndef BT_LAW_ORDERS_CASES_H
#define BT_LAW_ORDERS_CASES_H

#include "dynamic_scene.h"

enum
{
  NUMBERS = 40
};

typedef struct numbers
{
  int n;
  double x[NUMBERS];
} numbers;

static inline void
add (numbers *v, double x)
{
  assert_true (v->n < NUMBERS);
  v->x[v->n++] = x;
}

static inline void
add_point (numbers *v, bt_vec3 p)
{
  add (v, p.x);
  add (v, p.y);
  add (v, p.z);
}

/* The moving line; the last three are mutants.  */
void line_points (int k, numbers *v);
void line_finer (int k, numbers *v);
void line_quicker (int k, numbers *v);
void line_changing (int k, numbers *v);
void line_abrupt (int k, numbers *v);
void line_hangs (int k, numbers *v);
void line_tension (int k, numbers *v);
void line_corrected (int k, numbers *v);
void line_bends (int k, numbers *v);
void line_sinks (int k, numbers *v);
void line_forgets (int k, numbers *v);
void line_sinks_forgetful (int k, numbers *v);
void line_tension_of_interval (int k, numbers *v);

#endif
