/* Ways and words as the judges of a tether's awareness look at them: see aware_cases.h.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <math.h>
#include <string.h>

#include "testbed/aware_cases.h"

double
way_clearance (const bt__taut_config *c, const bt_vec3 *p, uint32_t n, double cap, bt__count *count)
{
  for (uint32_t i = 0; i + 1 < n; i++)
    {
      bt__link link = { p[i], p[i + 1] };
      bt__near near;
      if (bt__scene_nearest (c->scene, c->on, &link, cap, &near, count))
        cap = near.w.distance;
    }
  return cap;
}

double
tight_free_length (bt__free *tree, bt_vec3 from, bt_vec3 to, uint32_t steps, bt__taut *taut,
                   const bt__taut_config *config, bt__string *string, bt__count *count)
{
  if (!bt__free_way (tree, from, to, string, NULL, count))
    return INFINITY;
  return bt__free_tighten (taut, config, steps, string, count);
}

int
is_same_word (const bt__word *a, const bt__word *b)
{
  return !a->lost && memcmp (a, b, sizeof *a) == 0;
}
