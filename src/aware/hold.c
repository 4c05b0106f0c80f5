/* Holds: the bending angle at a node is credited to the object nearest to the adjacent halves of
   the node's two links.

   A taut string bends only where an obstacle pushes it, so angles add up to the angles of contact
   of the capstan law T_b = T_a exp (mu theta), whatever the mesh: bt__holds_lock is the product of
   the exponentials.

   A string round a round member is a polygon that touches the member's arc from outside.  At a
   corner of angle t the polygon is longer than the arc by 2 rho tan (t / 2) - rho t, with rho the
   radius of the line's arc: the member's radius plus the core, over sin^2 of the angle to the
   member's axis for a helix. bt__holds_length takes this excess off where the two tangents of a
   corner fit on the corner's links; a coarser polygon keeps the excess.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include "aware/hold.h"

#define LEAST_ANGLE 1e-4

/* The angle between directions A and B, good for small ones too.  */
static double
angle_between (bt_vec3 a, bt_vec3 b)
{
  return atan2 (bt__norm (bt__cross (a, b)), bt__dot (a, b));
}

/* True, with *OUT, if an object is within REACH of the halves next to node P[1] of its two links;
 *OUT is the nearest.  */
static int
nearest_to_corner (const bt__scene *s, const bt__switches *on, const bt_vec3 *p, double reach,
                   bt__near *out, bt__count *count)
{
  bt__link before = { bt__scale (0.5, bt__add (p[0], p[1])), p[1] };
  bt__link after = { p[1], bt__scale (0.5, bt__add (p[1], p[2])) };
  bt__near other;
  int found = bt__scene_nearest (s, on, &before, reach, out, count);
  double cap = found ? out->w.distance : reach;
  if (!bt__scene_nearest (s, on, &after, cap, &other, count))
    return found;
  if (!found || other.w.distance < out->w.distance)
    *out = other;
  return 1;
}

/* The radius of a line's arc about a round member of RADIUS: a helix if it goes along AXIS too.  */
static double
helix (double radius, bt_vec3 axis, bt_vec3 along)
{
  bt_vec3 across = bt__cross (axis, along);
  double sine2 = bt__dot (across, across) / bt__dot (along, along);
  return sine2 > 1e-6 ? radius / sine2 : 0;
}

static void
set_radius (const bt__obstacle *o, const bt__witness *w, bt_vec3 along, double core, bt__corner *h)
{
  const bt__capsule *c = &o->shape.capsule;
  h->radius = h->bend = 0;
  if (o->kind == BT__OBSTACLE_SPHERE)
    h->bend = (h->radius = o->shape.sphere.radius) + core;
  else if (o->kind == BT__OBSTACLE_CYLINDER && w->feature == BT__SIDE)
    {
      h->radius = o->shape.cylinder.radius;
      h->bend = helix (h->radius + core, o->shape.cylinder.axis, along);
    }
  else if (o->kind == BT__OBSTACLE_CAPSULE)
    {
      h->radius = c->radius;
      bt_vec3 axis = bt__unit_or (bt__sub (c->b, c->a), bt__vec (0, 0, 0));
      h->bend = w->feature == BT__SIDE ? helix (h->radius + core, axis, along) : h->radius + core;
    }
}

void
bt__holds_find (const bt__scene *scene, const bt__switches *on, const bt_vec3 *p, uint32_t n,
                double core, double reach, bt__holds *list, bt__count *count)
{
  double s = 0;
  list->n = list->dropped = 0;
  for (uint32_t i = 1; i + 1 < n; i++)
    {
      bt_vec3 u = bt__sub (p[i], p[i - 1]), v = bt__sub (p[i + 1], p[i]);
      double angle = angle_between (u, v);
      bt__near near;
      s += bt__norm (u);
      if (!(angle > LEAST_ANGLE) || !nearest_to_corner (scene, on, p + i - 1, reach, &near, count))
        continue;
      if (list->n == list->room)
        {
          list->dropped++;
          continue;
        }
      bt__corner *h = list->at + list->n++;
      *h = (bt__corner){ .node = i,
                         .object = near.object,
                         .triangle = near.triangle,
                         .angle = angle,
                         .s = s,
                         .point = near.w.point,
                         .normal = near.w.normal,
                         .friction = scene->object[near.object].friction };
      bt_vec3 along = bt__add (bt__unit_or (u, u), bt__unit_or (v, v));
      set_radius (scene->object + near.object, &near.w, along, core, h);
    }
}

double
bt__holds_wrap (const bt__holds *list, uint32_t object)
{
  double sum = 0;
  for (uint32_t i = 0; i < list->n; i++)
    sum += list->at[i].object == object ? list->at[i].angle : 0;
  return sum;
}

double
bt__holds_lock (const bt__holds *list)
{
  double sum = 0;
  for (uint32_t i = 0; i < list->n; i++)
    sum += list->at[i].friction * list->at[i].angle;
  return exp (sum);
}

/* Rounding, and a link that is not quite tangent.  */
#define SPARE 1.02

static double
tangent_length (const bt__corner *h)
{
  return h->angle < BT__PI / 2 ? h->bend * tan (0.5 * h->angle) : 0;
}

/* The tangent of the corner K next to corner H, if it lies on the same object at the node WAY on.
 */
static double
next_tangent (const bt__holds *list, const bt__corner *h, uint32_t k, int way)
{
  if (k >= list->n || list->at[k].object != h->object
      || (int)list->at[k].node != (int)h->node + way)
    return 0;
  return tangent_length (&list->at[k]);
}

/* True if the tangent lengths of corner I and of its neighbours fit on the links between them; an
   outer link belongs to its corner alone.  */
static int
fits_its_links (const bt__holds *list, const bt_vec3 *p, uint32_t i)
{
  const bt__corner *h = list->at + i;
  const bt_vec3 *x = p + h->node;
  double tangent = tangent_length (h);
  double before = next_tangent (list, h, i - 1, -1), after = next_tangent (list, h, i + 1, 1);
  return tangent > 0 && tangent + before <= SPARE * bt__distance (x[-1], x[0])
         && tangent + after <= SPARE * bt__distance (x[0], x[1]);
}

double
bt__holds_length (const bt__holds *list, const bt_vec3 *p, uint32_t n)
{
  double length = bt__length (p, n);
  for (uint32_t i = 0; i < list->n; i++)
    if (fits_its_links (list, p, i))
      {
        const bt__corner *h = list->at + i;
        length -= 2 * tangent_length (h) - h->bend * h->angle;
      }
  return length;
}
