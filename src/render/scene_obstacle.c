/* The obstacles of a dive as solids and meshes, and the bottom of its sea.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <math.h>
#include <stdlib.h>

#include "base/error.h"
#include "math/vec.h"
#include "render/scene.h"

/* Heading, pitch and roll of a body with these axes, the inverse of bt_body_axes.  */
static void
set_angles (bt_thing *t, const bt_vec3 axis[3])
{
  double level = hypot (axis[1].x, axis[1].y);
  t->pitch = atan2 (axis[1].z, level);
  t->heading = level > 1e-9 ? atan2 (axis[1].x, axis[1].y) : atan2 (-axis[0].y, axis[0].x);
  t->roll = level > 1e-9 ? atan2 (-axis[0].z, axis[2].z) : 0;
}

static void
add_seabed_level (bt__scene *s, double z)
{
  bt_thing t = bt_thing_of (BT_THING_LEVEL);
  t.at.z = z;
  bt__scene_add (s, &t);
}

/* ---- Triangles ---- */

static uint32_t
count_up (uint32_t *next)
{
  return (*next)++;
}

/* The surface of obstacle I as a mesh where it stands.  */
static void
add_obstacle_mesh (bt__scene *s, int i, const bt_obstacle_view *o)
{
  enum
  {
    BATCH = 256
  };
  bt_facet facet[BATCH];
  bt_thing t = bt_thing_of (BT_THING_MESH);
  bt_vec3 *point = malloc (3 * o->triangles * sizeof *point);
  uint32_t (*corner)[3] = malloc (o->triangles * sizeof *corner), next = 0;
  size_t n = 0, got;
  while (point && corner && n < o->triangles
         && (got = bt_obstacle_triangles (s->dive, i, n, BATCH, facet)) > 0)
    for (size_t k = 0; k < got && n < o->triangles; k++, n++)
      for (int c = 0; c < 3; c++)
        {
          point[3 * n + (size_t)c] = facet[k].corner[c];
          corner[n][c] = count_up (&next);
        }
  if (!point || !corner)
    s->status = bt__fail (s->error, BT_ERR_LIMIT, "there is no memory left for the picture");
  t.points = point;
  t.n = 3 * n;
  t.corner = (const uint32_t (*)[3])corner;
  t.triangles = n;
  t.ground = o->kind == BT_OBSTACLE_SEABED;
  t.color = t.ground ? bt_thing_of (BT_THING_LEVEL).color : t.color;
  t.framing = t.ground ? BT_FRAME_NOT : BT_FRAME_NEAR;
  bt__scene_add (s, &t);
  free (point);
  free (corner);
}

/* ---- Solids ---- */

static bt_thing
solid_of (const bt_obstacle_view *o)
{
  bt_thing t = bt_thing_of (o->kind == BT_OBSTACLE_BOX        ? BT_THING_BOX
                            : o->kind == BT_OBSTACLE_SPHERE   ? BT_THING_SPHERE
                            : o->kind == BT_OBSTACLE_CYLINDER ? BT_THING_CYLINDER
                                                              : BT_THING_CAPSULE);
  t.at = o->centre;
  t.from = o->from;
  t.to = o->to;
  t.size = o->size;
  t.radius = o->radius;
  t.framing = BT_FRAME_NEAR;
  set_angles (&t, o->axes);
  return t;
}

static void
add_obstacle (bt__scene *s, int i, const bt_obstacle_view *o)
{
  bt_thing t;
  if (o->triangles > 0)
    add_obstacle_mesh (s, i, o);
  else if (o->kind == BT_OBSTACLE_SEABED)
    add_seabed_level (s, o->centre.z);
  else
    {
      t = solid_of (o);
      bt__scene_add (s, &t);
    }
}

/* A sea without a bed has none to be seen: nothing would lie on it.  */
void
bt__scene_obstacles (bt__scene *s)
{
  int n = bt_dive_count (s->dive, BT_PART_OBSTACLE);
  for (int i = 0; i < n && s->status == BT_OK; i++)
    {
      bt_obstacle_view o;
      s->status = bt_dive_obstacle (s->dive, i, &o, s->error);
      if (s->status != BT_OK)
        return;
      add_obstacle (s, i, &o);
    }
}
