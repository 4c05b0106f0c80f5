/* See contact_scene.h.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <stdlib.h>
#include <string.h>

#include "testbed/contact_scene.h"

/* ---- Obstacles ---- */

int
reef_open (reef *r)
{
  memset (r, 0, sizeof *r);
  r->sheet = malloc (REEF_SHEETS * sizeof *r->sheet);
  r->of_sheet = malloc (REEF_SHEETS * sizeof *r->of_sheet);
  return r->sheet && r->of_sheet;
}

void
reef_close (reef *r)
{
  bt__scene_free (r->scene);
  reef_bins_free (r->bins);
  free (r->sheet);
  free (r->of_sheet);
}

/* Of the obstacle that comes next.  */
static void
add_bone (reef *r, bt_vec3 a, bt_vec3 b)
{
  r->of_bone[r->bones] = r->obstacles;
  r->bone[r->bones++] = (sweep_segment){ a, b };
}

static void
add_solid (reef *r, solid s)
{
  r->of_solid[r->solids] = r->obstacles;
  r->solid[r->solids++] = s;
}

static void
add_obstacle (reef *r, bt__obstacle o)
{
  o.id = (uint32_t)r->obstacles;
  r->obstacle[r->obstacles++] = o;
}

void
reef_box (reef *r, bt_vec3 centre, bt_vec3 half, double turn)
{
  bt__frame f
      = { centre, { cos (turn), sin (turn), 0 }, { -sin (turn), cos (turn), 0 }, { 0, 0, 1 } };
  bt__box b = { f, half };
  add_solid (r, (solid){ .kind = SOLID_BOX, .box = b });
  for (int i = 14; i < 27; i++) /* one of each pair of opposite corners, edges, sides */
    {
      bt_vec3 p = { half.x * (i % 3 - 1), half.y * (i / 3 % 3 - 1), half.z * (i / 9 - 1) };
      add_bone (r, bt__to_world (&f, p), bt__to_world (&f, bt__scale (-1, p)));
    }
  add_obstacle (r, (bt__obstacle){ .kind = BT__OBSTACLE_BOX, .shape.box = b });
}

void
reef_cylinder (reef *r, bt_vec3 a, bt_vec3 b, double radius)
{
  bt_vec3 axis = bt__unit_or (bt__sub (b, a), bt__vec (0, 0, 1));
  bt__cylinder c = { bt__scale (0.5, bt__add (a, b)), axis, bt__distance (a, b) / 2, radius };
  add_solid (r, (solid){ .kind = SOLID_CYLINDER, .cylinder = c });
  add_bone (r, a, b);
  bt_vec3 across = bt__scale (radius, bt__across (axis));
  add_bone (r, bt__sub (c.centre, across), bt__add (c.centre, across));
  add_obstacle (r, (bt__obstacle){ .kind = BT__OBSTACLE_CYLINDER, .shape.cylinder = c });
}

void
reef_wire (reef *r, bt_vec3 a, bt_vec3 b, double radius)
{
  bt__capsule c = { a, b, radius };
  add_solid (r, (solid){ .kind = SOLID_CAPSULE, .capsule = c });
  add_bone (r, a, b);
  add_obstacle (r, (bt__obstacle){ .kind = BT__OBSTACLE_CAPSULE, .shape.capsule = c });
}

void
reef_plane (reef *r, double z)
{
  add_obstacle (r, (bt__obstacle){ .kind = BT__OBSTACLE_PLANE, .shape.plane = { { 0, 0, 1 }, z } });
}

static int
add_mesh (reef *r, bt__mesh *m)
{
  if (!m || r->obstacles == REEF_SOLIDS || r->sheets + (int)m->triangles > REEF_SHEETS)
    return 0;
  for (uint32_t i = 0; i < m->triangles; i++)
    {
      bt__triangle t = bt__mesh_triangle (m, i);
      r->of_sheet[r->sheets] = r->obstacles;
      memcpy (r->sheet[r->sheets++].v, t.v, sizeof t.v);
    }
  add_obstacle (r, (bt__obstacle){ .kind = BT__OBSTACLE_MESH, .shape.mesh = m });
  return 1;
}

int
reef_soup (reef *r, const bt__soup *soup)
{
  bt__mesh *m = NULL;
  return bt__mesh_new (soup, NULL, NULL, &m, NULL) == BT_OK && add_mesh (r, m);
}

int
reef_grid (reef *r, const bt__grid *grid)
{
  bt__mesh *m = NULL;
  return bt__mesh_from_grid (grid, NULL, NULL, &m, NULL) == BT_OK && add_mesh (r, m);
}

int
reef_bottom (reef *r, dice *d, double z, double side, int n, double rough)
{
  int posts = (n + 1) * (n + 1);
  double *height = malloc ((size_t)posts * sizeof *height);
  for (int i = 0; height && i < posts; i++)
    height[i] = z + dice_between (d, -rough, rough);
  bt__grid g
      = { (uint32_t)n + 1, (uint32_t)n + 1, -side * n / 2, -side * n / 2, side, side, height };
  int done = height && reef_grid (r, &g);
  free (height);
  return done;
}

/* Add a standing tube of triangles.  */
static int
add_tube (reef *r, bt_vec3 foot, double height, double radius, int round, int up)
{
  int vertices = round * (up + 1), triangles = 2 * round * up;
  bt_vec3 *v = malloc ((size_t)vertices * sizeof *v);
  uint32_t (*corner)[3] = malloc ((size_t)triangles * sizeof *corner);
  for (int i = 0; v && i < vertices; i++)
    {
      double a = 2 * BT__PI * (i % round) / round;
      v[i]
          = bt__add (foot, bt__vec (radius * cos (a), radius * sin (a), height * (i / round) / up));
    }
  for (int i = 0; corner && i < round * up; i++)
    {
      uint32_t a = (uint32_t)i, b = (uint32_t)(i / round * round + (i + 1) % round),
               above = (uint32_t)round;
      memcpy (corner[2 * i], (uint32_t[]){ a, b, b + above }, sizeof *corner);
      memcpy (corner[2 * i + 1], (uint32_t[]){ a, b + above, a + above }, sizeof *corner);
    }
  bt__soup soup
      = { (uint32_t)vertices, (uint32_t)triangles, v, (const uint32_t (*)[3])corner, NULL, 0 };
  int done = v && corner && reef_soup (r, &soup);
  free (v);
  free (corner);
  return done;
}

int
reef_raise (reef *r)
{
  static uint64_t serial;
  return reef_bin (r)
         && bt__scene_new (r->obstacle, (uint32_t)r->obstacles, ++serial, &r->scene, NULL) == BT_OK;
}

static bt_vec3
leg (int i, double z)
{
  static const double x[4] = { -6, 6, 6, -6 }, y[4] = { -6, -6, 6, 6 };
  return bt__vec (x[i % 4], y[i % 4], z);
}

int
reef_jacket (reef *r, uint64_t seed)
{
  dice d = dice_new (seed);
  if (!reef_open (r))
    return 0;
  for (int i = 0; i < 4; i++)
    reef_cylinder (r, leg (i, -31), leg (i, 2), 0.6);
  for (int level = 0; level < 4; level++)
    for (int i = 0; i < 4; i++)
      {
        double z = -3 - 8.0 * level;
        reef_cylinder (r, leg (i, z), leg (i + 1, z), 0.3);
        if (level == 3)
          continue;
        reef_cylinder (r, leg (i, z), leg (i + 1, z - 8), 0.2);
        reef_cylinder (r, leg (i + 1, z), leg (i, z - 8), 0.2);
      }
  for (int i = 0; i < 24; i++)
    {
      bt_vec3 a
          = { dice_between (&d, -8, 8), dice_between (&d, -8, 8), dice_between (&d, -28, -2) };
      bt_vec3 b
          = { dice_between (&d, -8, 8), dice_between (&d, -8, 8), dice_between (&d, -28, -2) };
      reef_wire (r, a, b, 0.005);
    }
  for (int i = 0; i < 6; i++)
    {
      bt_vec3 at
          = { dice_between (&d, -5, 5), dice_between (&d, -5, 5), dice_between (&d, -26, -4) };
      bt_vec3 half
          = { dice_between (&d, 0.3, 1), dice_between (&d, 0.3, 1), dice_between (&d, 0.3, 1) };
      reef_box (r, at, half, dice_between (&d, 0, 3));
    }
  return add_tube (r, bt__vec (1.5, 1, -29), 27, 0.7, 48, 30)
         && reef_bottom (r, &d, -30, 0.6, 60, 0.15) && reef_raise (r);
}

/* ---- Lines ---- */

enum
{
  SPARE = 48 /* nodes that may come where the line runs about edges */
};

int
rope_open (rope *p, reef *r, int n, const bt_vec3 *shape, int m, double length, double mu)
{
  memset (p, 0, sizeof *p);
  p->reef = r;
  p->line = (bt_tether_props){ .diameter = 0.01,
                               .mass = 0.0805033117,
                               .ea = 2e5,
                               .ba = 20,
                               .cdn = 1.2,
                               .cdt = 0.02,
                               .ca = 1,
                               .friction = mu };
  p->nodes = n + 1;
  p->d = calloc (1, bt__dynamic_size (n + SPARE));
  p->work = bt__dynamic_work_new (n + SPARE);
  p->contact = bt__line_work_new (n + SPARE, BT__AMONG_OBSTACLES);
  p->anchors = malloc (bt__contacts_size (REEF_ANCHORS));
  p->before = malloc ((size_t)(n + 1 + SPARE) * sizeof *p->before);
  p->after = malloc ((size_t)(n + 2 + SPARE) * sizeof *p->after);
  p->room = n + 1 + SPARE;
  p->shown = malloc (ROPE_PARTS * (size_t)p->room * sizeof *p->shown);
  if (!p->after || !p->shown || !p->d || !p->work || !p->contact || !p->anchors || !p->before)
    return 0;
  bt__contacts_init (p->anchors, REEF_ANCHORS);
  p->water = (bt_water){ 1025, 9.81, 1000, 0, NULL, NULL, NULL, NULL };
  p->config = (bt__line_config){
    .radius = 0.005, .core = bt__core (0.01), .friction = mu, .pull = { INFINITY, 150 }
  };
  p->in.end[0].at = shape[0];
  p->in.end[1].at = shape[m - 1];
  return bt__dynamic_init (p->d, n + SPARE, n, shape, m, length, p->line.ea, NULL) == BT_OK;
}

void
rope_close (rope *p)
{
  free (p->d);
  free (p->anchors);
  free (p->before);
  free (p->after);
  free (p->shown);
  bt__dynamic_work_free (p->work);
  bt__line_work_free (p->contact);
}

void
rope_set_itself (rope *p)
{
  p->line.diameter = 0.02;
  p->line.mass = 0.32;
  p->config.radius = 0.01;
  p->config.core = bt__core (0.02);
  p->config.itself = 1;
  p->config.id = 1000;
}

int
rope_tie (rope *p, reef *r, int n, double beam, double mu, double aside)
{
  enum
  {
    TURN = 48
  };
  bt_vec3 path[TURN + 5];
  double ring = beam + 0.25, thick = 0.13, cut = 0.22;
  path[0] = bt__vec (4, 1.5 + aside, 0.3);
  path[1] = bt__vec (ring + 2.5 * thick, 0.4, 0.1);
  for (int i = 0; i <= TURN; i++)
    {
      double t = cut + (2 * BT__PI - 2 * cut) * i / TURN, out = ring + thick * cos (3 * t);
      path[i + 2] = bt__vec (out * cos (2 * t), out * sin (2 * t), thick * sin (3 * t));
    }
  path[TURN + 3] = bt__vec (ring + 2.5 * thick, -0.4, -0.1);
  path[TURN + 4] = bt__vec (4, -1.5, -0.3);
  if (!reef_open (r))
    return 0;
  reef_cylinder (r, bt__vec (0, 0, -3), bt__vec (0, 0, 3), beam);
  if (!reef_raise (r)
      || !rope_open (p, r, n, path, TURN + 5, 1.001 * bt__length (path, TURN + 5), mu))
    return 0;
  rope_set_itself (p);
  return 1;
}

void
rope_tow (rope *p, bt_vec3 target, double speed, double h)
{
  bt_vec3 x = bt__dynamic_x (p->d)[p->d->n], way = bt__sub (target, x);
  double far = bt__norm (way), step = speed * h;
  p->in.end[1].at = far > step ? bt__axpy (x, step / far, way) : target;
}

/* Keep what happened for the judge, who takes his time.  */
static void
see (void *user, int i, int by, const bt_vec3 *x, int nodes)
{
  rope *p = user;
  if (p->parts == ROPE_PARTS)
    {
      p->crossings++; /* too much to be sure */
      return;
    }
  p->part[p->parts] = (rope_part){ i, by, nodes };
  memcpy (p->shown + p->parts++ * p->room, x, (size_t)nodes * sizeof *x);
}

/* The line before and after a part: where node I was taken out, it went to the chord.  */
static int
replay (rope *p, const rope_part *part, const bt_vec3 *x)
{
  size_t size = (size_t)part->nodes * sizeof *x;
  memcpy (p->after, x, size);
  if (part->by >= 0)
    return part->nodes;
  const bt_vec3 *a = p->before + part->node - 1;
  bt_vec3 d = bt__sub (a[2], a[0]);
  double u = bt__dot (bt__sub (a[1], a[0]), d) / fmax (bt__dot (d, d), 1e-30);
  memcpy (p->after, p->before, size + sizeof *x);
  p->after[part->node] = bt__axpy (a[0], fmin (fmax (u, 0), 1), d);
  return part->nodes + 1;
}

void
rope_judge (rope *p)
{
  for (int k = 0; k < p->parts; k++)
    {
      const bt_vec3 *x = p->shown + k * p->room;
      int n = replay (p, p->part + k, x);
      if (p->part[k].by <= 0)
        p->crossings += reef_crossings (p->reef, p->before, p->after, n);
      memcpy (p->before, x, (size_t)p->part[k].nodes * sizeof *x);
    }
  p->parts = 0;
}

int
rope_step (rope *p, double h, int judged)
{
  bt_error error = { 0 };
  p->water.current = &p->current;
  p->in.line = &p->line;
  p->in.water = &p->water;
  p->in.h = h;
  p->config.hook = &p->hook;
  p->hook.see = see;
  p->hook.witness = p;
  p->parts = 0;
  p->around.scene = p->reef->scene;
  p->water.time += h;
  int n = (int)p->d->n + 1;
  memcpy (p->before, bt__dynamic_x (p->d), (size_t)n * sizeof *p->before);
  p->steps++;
  if (bt__line_step (p->d, p->work, p->contact, &p->in, &p->around, &p->config, p->anchors,
                     &p->report, &p->touch, &p->count, &error)
      != BT_OK)
    {
      p->refused++;
      return 0;
    }
  const bt_vec3 *x = bt__dynamic_x (p->d);
  p->solves += p->report.solves;
  p->worst = p->report.solves > p->worst ? p->report.solves : p->worst;
  p->unconverged += !p->report.converged;
  p->truncated += p->touch.truncated > 0;
  p->rounds += p->touch.rounds;
  p->touches += p->touch.touches;
  p->most_touches = p->touch.touches > p->most_touches ? p->touch.touches : p->most_touches;
  p->fastest = fmax (p->fastest, p->report.speed);
  p->load = fmax (p->load, p->touch.load);
  p->tension = fmax (p->tension, p->report.tension);
  for (int i = 0; i < n; i++)
    p->nan += !bt__is_finite (x[i]) || !bt__is_finite (bt__dynamic_v (p->d)[i]);
  if (judged)
    rope_judge (p);
  return 1;
}
