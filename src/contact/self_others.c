/* Which other lines are too far from a line to be asked link by link.

   Another line is far if its box and the line's are apart, or if a plane has all of the one line on
   one side and all of the other on the other: boxes alone overlap wherever two lines run obliquely
   beside each other, as those of a fleet do.  Two directions are tried for the normal of the plane,
   the common normal of both chords and the way between the middles.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include "contact/self_search.h"

/* How far a line that went so far in the last step is expected to go against other lines, which
   have stepped already or are to wait.  A step must know early that an end is pulled with limited
   force: before the line comes to what it hits.  */
double
bt__self_expected (const bt__line_job *k, double went)
{
  return k->config->strands > 0 ? BT__LINE_AHEAD * went : 0;
}

/* The box about the line as it is and as it is to go to TO, or NULL, with REACH about it.  */
static bt__aabb
box_of_way (const bt__line_job *k, const bt_vec3 *to, double reach)
{
  bt__aabb b = bt__no_box;
  for (int i = 0; i <= k->links; i++)
    {
      bt__self_add_point (&b, k->x[i], reach);
      if (to)
        bt__self_add_point (&b, to[i], reach);
    }
  return b;
}

/* The box about line number I, as thick as the line is.  */
static bt__aabb
box_of_strand (const bt__line_job *k, int i)
{
  const bt__aabb *known = k->config->strand[i].box;
  bt__self_side s = bt__self_side_of (k, i);
  bt__aabb b = bt__no_box;
  for (int j = 0; !known && j <= s.links; j++)
    bt__self_add_point (&b, s.x[j], s.thick);
  if (known)
    {
      bt__self_add_point (&b, known->lo, s.thick);
      bt__self_add_point (&b, known->hi, s.thick);
    }
  return b;
}

/* ---- A plane between two lines ---- */

/* The least and the most of N points along U, added to those before.  */
static void
add_extent (bt_vec3 u, const bt_vec3 *x, int n, double *least, double *most)
{
  for (int i = 0; i < n; i++)
    {
      double at = bt__dot (u, x[i]);
      *least = bt__self_lower (*least, at);
      *most = bt__self_higher (*most, at);
    }
}

/* True if a plane across U parts the line, as it is and at TO, from SIDE by more than GAP.  */
static int
is_parted_along (const bt__line_job *k, const bt_vec3 *to, const bt__self_side *side, bt_vec3 u,
                 double gap)
{
  double lo = INFINITY, hi = -INFINITY, least = INFINITY, most = -INFINITY;
  add_extent (u, k->x, k->links + 1, &lo, &hi);
  if (to)
    add_extent (u, to, k->links + 1, &lo, &hi);
  add_extent (u, side->x, side->links + 1, &least, &most);
  return lo - most > gap || least - hi > gap;
}

static bt_vec3
chord_from (const bt_vec3 *x, int links)
{
  return bt__unit_or (bt__sub (x[links], x[0]), bt__vec (1, 0, 0));
}

static int
has_plane_between (const bt__line_job *k, const bt_vec3 *to, const bt__self_side *side, double gap)
{
  bt_vec3 a = chord_from (k->x, k->links), b = chord_from (side->x, side->links);
  bt_vec3 n = bt__cross (a, b), way = bt__sub (side->x[side->links / 2], k->x[k->links / 2]);
  double size = bt__norm (n), far = bt__norm (way);
  return (size > 0 && is_parted_along (k, to, side, bt__scale (1 / size, n), gap))
         || (far > gap && is_parted_along (k, to, side, bt__scale (1 / far, way), gap));
}

/* ---- Other lines ---- */

int
bt__self_strand_is_apart (const bt__line_job *k, int i, const bt__aabb *own, const bt_vec3 *to,
                          double reach)
{
  bt__aabb b = box_of_strand (k, i);
  if (!bt__boxes_are_near (&b, own, 0))
    return 1;
  bt__self_side side = bt__self_side_of (k, i);
  return has_plane_between (k, to, &side, reach + side.thick);
}

int
bt__self_others_are_far (const bt__line_job *k, const bt_vec3 *to)
{
  if (k->config->strands == 0)
    return 1;
  double reach = bt__self_touching (k) + (to ? 0 : bt__self_expected (k, k->d->step.way));
  bt__aabb own = box_of_way (k, to, reach);
  for (int i = 0; i < k->config->strands; i++)
    if (!bt__self_strand_is_apart (k, i, &own, to, reach))
      return 0;
  return 1;
}
