/* The trailing line: a chain of tractrices (trail.h).

   The end is moved, then each point is drawn towards the next point along their straight link until
   the link has its old length: the discrete tractrix, also known as "follow the leader".  The walk
   stops at the first link that was not tight.  If the pull reaches the anchor, the same walk runs
   back from the anchor, so the anchor stays and the end keeps the place it was given.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <string.h>

#include "aware/trail.h"

void
bt__trail_lay (bt__trail *trail, const bt_vec3 *p, uint32_t n)
{
  trail->n = n;
  memcpy (trail->x, p, n * sizeof *p);
  for (uint32_t k = 0; k + 1 < n; k++)
    trail->link[k] = bt__distance (p[k], p[k + 1]);
}

/* Bring X to within LENGTH of TO; zero if it is already.  */
static int
follow_to (bt_vec3 *x, bt_vec3 to, double length)
{
  bt_vec3 d = bt__sub (*x, to);
  double far = bt__norm (d);
  if (far <= length)
    return 0;
  *x = bt__axpy (to, length / far, d);
  return 1;
}

uint32_t
bt__trail_lead (bt__trail *trail, bt_vec3 end)
{
  bt_vec3 *x = trail->x, anchor = x[0];
  uint32_t k = trail->n - 1;
  x[k] = end;
  while (k > 0 && follow_to (&x[k - 1], x[k], trail->link[k - 1]))
    k--;
  if (k > 0)
    return k - 1;
  x[0] = anchor;
  for (uint32_t j = 1; j + 1 < trail->n && follow_to (&x[j], x[j - 1], trail->link[j - 1]); j++)
    ;
  return 0;
}

int
bt__trail_meet (bt__trail *trail, uint32_t k, const bt__scene *scene, const bt__switches *on,
                double radius, bt__near *near, bt__count *count)
{
  bt_vec3 *x = trail->x;
  bt__link link = { x[k], x[k + 1] };
  if (!bt__scene_nearest (scene, on, &link, radius, near, count))
    return 0;
  double in = radius - near->w.distance;
  if (k > 0)
    x[k] = bt__axpy (x[k], in, near->w.normal);
  if (k + 2 < trail->n)
    x[k + 1] = bt__axpy (x[k + 1], in, near->w.normal);
  return 1;
}
