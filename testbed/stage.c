/* See stage.h.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <stdlib.h>

#include "testbed/stage.h"

static void
add_bone (stage *g, bt_vec3 a, bt_vec3 b)
{
  g->bone[g->bones++] = (sweep_segment){ a, b };
}

static void
add_bones_of_box (stage *g, const bt__box *b)
{
  for (int i = 0; i < 13; i++)
    {
      int k = i + 14; /* one of each pair of opposite corners, edges, sides */
      bt_vec3 p = { b->half.x * (k % 3 - 1), b->half.y * (k / 3 % 3 - 1), b->half.z * (k / 9 - 1) };
      add_bone (g, bt__to_world (&b->frame, p), bt__to_world (&b->frame, bt__scale (-1, p)));
    }
}

static void
add_solid (stage *g, const solid *x)
{
  bt_vec3 c, r;
  g->solid[g->solids++] = *x;
  switch (x->kind)
    {
    case SOLID_BOX:
      add_bones_of_box (g, &x->box);
      break;
    case SOLID_CAPSULE:
      add_bone (g, x->capsule.a, x->capsule.b);
      break;
    case SOLID_CYLINDER:
      c = x->cylinder.centre;
      r = bt__scale (x->cylinder.half, x->cylinder.axis);
      add_bone (g, bt__sub (c, r), bt__add (c, r));
      r = bt__scale (x->cylinder.radius, bt__across (x->cylinder.axis));
      add_bone (g, bt__sub (c, r), bt__add (c, r));
      break;
    default:
      c = x->sphere.centre;
      r = bt__vec (x->sphere.radius, 0, 0);
      add_bone (g, bt__sub (c, r), bt__add (c, r));
      add_bone (g, bt__vec (c.x, c.y - r.x, c.z), bt__vec (c.x, c.y + r.x, c.z));
      add_bone (g, bt__vec (c.x, c.y, c.z - r.x), bt__vec (c.x, c.y, c.z + r.x));
    }
}

solid
capsule_between (bt_vec3 a, bt_vec3 b, double radius)
{
  return (solid){ .kind = SOLID_CAPSULE, .capsule = { a, b, radius } };
}

void
draw_wires (stage *g, dice *d)
{
  for (int i = 0; i < 60; i++)
    {
      bt_vec3 a = dice_point (d, 5), b = bt__axpy (a, dice_between (d, 1, 6), dice_direction (d));
      solid x = capsule_between (a, b, i ? pow (10, dice_between (d, -4, -1)) : 0);
      add_solid (g, &x);
    }
}

void
draw_cage (stage *g, dice *d)
{
  (void)d;
  for (int i = -1; i <= 1; i++)
    for (int j = -1; j <= 1; j++)
      {
        solid x = capsule_between (bt__vec (-3, 2 * i, 2 * j), bt__vec (3, 2 * i, 2 * j), 0.02);
        solid y = capsule_between (bt__vec (2 * i, -3, 2 * j), bt__vec (2 * i, 3, 2 * j), 0.02);
        solid z = capsule_between (bt__vec (2 * i, 2 * j, -3), bt__vec (2 * i, 2 * j, 3), 0.02);
        add_solid (g, &x);
        add_solid (g, &y);
        add_solid (g, &z);
      }
  for (int i = 0; i < RING; i++)
    g->ring[i] = bt__vec (-4, 3 * cos (2 * BT__PI * i / RING), 3 * sin (2 * BT__PI * i / RING));
  for (int i = 0; i < RING; i++)
    {
      solid x = capsule_between (g->ring[i], g->ring[(i + 1) % RING], 0.01);
      add_solid (g, &x);
    }
  g->has_ring = 1;
}

void
draw_corners (stage *g, dice *d)
{
  for (int i = 0; i < 60; i++)
    {
      solid x = solid_draw (d, (solid_kind)dice_below (d, SOLID_TRIANGLE), 1.5, NULL, 0);
      bt_vec3 at = dice_point (d, 5);
      x.sphere.centre = bt__add (x.sphere.centre, at);
      x.box.frame.origin = bt__add (x.box.frame.origin, at);
      x.cylinder.centre = bt__add (x.cylinder.centre, at);
      x.capsule.a = bt__add (x.capsule.a, at);
      x.capsule.b = bt__add (x.capsule.b, at);
      add_solid (g, &x);
    }
}

void
draw_sheets (stage *g, dice *d)
{
  for (; g->sheets < SHEETS; g->sheets++)
    {
      bt_vec3 at = dice_point (d, 5);
      for (int k = 0; k < 3; k++)
        g->sheet[g->sheets].v[k] = bt__add (at, dice_point (d, 1));
    }
}

void
draw_movers (stage *g, dice *d)
{
  for (int i = 0; i < 20; i++)
    {
      bt_vec3 a = dice_point (d, 5);
      solid x = capsule_between (a, bt__axpy (a, 3, dice_direction (d)), 0.01);
      add_solid (g, &x);
    }
  g->bar_bone = (sweep_segment){ { -2, 0, 0 }, { 2, 0, 0 } };
  g->bar_solid = capsule_between (g->bar_bone.a, g->bar_bone.b, 0.03);
  g->bar_radius = 2.04;
  g->movers = MOVERS;
  for (int m = 0; m < MOVERS; m++) /* clear of the tether */
    g->at[m] = (bt__frame){ { 5, 4.0 * m, 0 }, { 1, 0, 0 }, { 0, 1, 0 }, { 0, 0, 1 } };
}

static bt__mesh *
mesh_of_sheets (const stage *g)
{
  static uint32_t corner[SHEETS][3];
  for (uint32_t i = 0; i < 3u * (uint32_t)g->sheets; i++)
    corner[i / 3][i % 3] = i;
  bt__soup soup = { 3 * (uint32_t)g->sheets,
                    (uint32_t)g->sheets,
                    g->sheet->v,
                    (const uint32_t (*)[3])corner,
                    NULL,
                    0 };
  bt__mesh *m = NULL;
  return bt__mesh_new (&soup, NULL, NULL, &m, NULL) == BT_OK ? m : NULL;
}

int
raise_stage (stage *g)
{
  bt__obstacle o[OBSTACLES + 1];
  uint32_t n = 0;
  for (int i = 0; i < g->solids; i++)
    o[n++] = obstacle_of_solid (g->solid + i);
  if (g->sheets)
    {
      bt__mesh *m = mesh_of_sheets (g);
      if (!m)
        return 0;
      o[n++] = (bt__obstacle){ .kind = BT__OBSTACLE_MESH, .shape.mesh = m };
    }
  if (bt__scene_new (o, n, 1, &g->scene, NULL) || bt__safe_new (NODES, 12, &g->safe, NULL))
    return 0;
  if (g->movers)
    {
      bt__obstacle bar = obstacle_of_solid (&g->bar_solid);
      if (bt__scene_new (&bar, 1, 2, &g->bar, NULL))
        return 0;
    }
  for (int i = 0; i < NODES; i++) /* clear of everything */
    g->x[i] = bt__vec (-9, -10 + 20.0 * i / (NODES - 1), 0.1 * sin (i));
  return 1;
}

void
strike (stage *g)
{
  bt__scene_free (g->scene);
  bt__scene_free (g->bar);
  bt__safe_free (g->safe);
  free (g);
}
