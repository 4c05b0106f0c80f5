/* See overwrite.h.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <string.h>

#include "overwrite.h"
#include "tether/dynamic_kernel.h"

void
overwrite_work (bt__dynamic_work *w, int byte)
{
  size_t n = (size_t)w->room + 3;
  bt_vec3 *vectors[]
      = { w->X, w->d, w->rhs, w->keep, w->last, w->twist, w->felt, w->natural, w->whole, w->spare };
  double *numbers[] = { w->lam, w->crumple, w->round };
  for (size_t k = 0; k < sizeof vectors / sizeof *vectors; k++)
    if (vectors[k]) /* of bending: made where a line has it */
      memset (vectors[k], byte, n * sizeof **vectors);
  for (size_t k = 0; k < sizeof numbers / sizeof *numbers; k++)
    if (numbers[k])
      memset (numbers[k], byte, n * sizeof **numbers);
}
