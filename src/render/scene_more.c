/* Additions to a scene for a closer look: contacts, turns, taut strings, the boxes about obstacles.
   No camera aims at additions.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "math/vec.h"
#include "render/scene.h"
#include "render/soup.h"

/* The extent of the tethers, m: additions are drawn in proportion.  */
static double
span_of (const bt__scene *s)
{
  return fmax (bt__distance (s->low, s->high), 1);
}

static int
tethers (const bt__scene *s)
{
  return s->status == BT_OK ? bt_dive_count (s->dive, BT_PART_TETHER) : 0;
}

/* ---- Contacts ---- */

static const bt_color sticks = { 1, 0.36F, 0.28F }, slides = { 0.45F, 0.95F, 0.55F };

/* An arrow along the force on the tether, as long as the root of the force; or, of a static model,
   along the normal.  LENGTH is that of the largest of all forces, MOST, and of a normal.  */
static void
add_contact (bt__scene *s, const bt_contact *c, double length, double most, int told)
{
  bt_thing arrow = bt_thing_of (BT_THING_ARROW);
  const char *name = bt_dive_name (s->dive, BT_PART_OBSTACLE, c->object);
  double force = bt__norm (c->force);
  char text[120];
  arrow.color = c->slides ? slides : sticks;
  arrow.from = c->position;
  if (force > 0)
    arrow.to = bt__axpy (c->position, length * fmax (sqrt (force / most), 0.15) / force, c->force);
  else
    arrow.to = bt__axpy (c->position, length, c->normal);
  snprintf (text, sizeof text, force > 0 ? "%.60s: %s, %.2g N" : "%.60s: %s", name ? name : "",
            c->slides ? "slides" : "sticks", force);
  arrow.text = told ? text : NULL;
  bt__scene_add (s, &arrow);
}

static double
largest_force (const bt_contact *c, int n)
{
  double most = 0;
  for (int k = 0; k < n; k++)
    most = fmax (most, bt__norm (c[k].force));
  return most;
}

/* True if none of the N contacts on the obstacle of contact K bears more.  */
static int
bears_most (const bt_contact *c, int n, int k)
{
  double force = bt__norm (c[k].force);
  for (int i = 0; i < n; i++)
    if (c[i].object == c[k].object
        && (bt__norm (c[i].force) > force || (i < k && bt__norm (c[i].force) >= force)))
      return 0;
  return 1;
}

static void
add_contacts (bt__scene *s)
{
  enum
  {
    MOST = 2000
  };
  double length = 0.1 * span_of (s);
  bt_contact *c = malloc (MOST * sizeof *c);
  for (int i = 0; c && i < tethers (s); i++)
    {
      int n = bt_tether_contacts (s->dive, i, c, MOST);
      n = n < MOST ? n : MOST;
      double most = largest_force (c, n);
      for (int k = 0; k < n; k++)
        add_contact (s, &c[k], length, most, bears_most (c, n, k));
    }
  free (c);
}

/* ---- Turns ---- */

static const bt_color turning = { 0.95F, 0.55F, 0.95F };

/* The axis of an obstacle: where it begins, the way it points, and how thick the obstacle is.  */
typedef struct axle
{
  bt_vec3 at, along;
  double radius;
} axle;

static axle
axle_of (const bt_obstacle_view *o)
{
  bt_vec3 size = bt__sub (o->high, o->low);
  if (o->has_axis)
    return (axle){ o->from, bt__unit_or (bt__sub (o->to, o->from), bt__vec (0, 0, -1)), o->radius };
  return (axle){ o->centre, bt__vec (0, 0, -1),
                 o->radius > 0 ? o->radius : hypot (size.x, size.y) / 2 };
}

/* From the nearest point of the axle to P.  */
static bt_vec3
aside (const axle *a, bt_vec3 p)
{
  return bt__off_axis (a->along, bt__sub (p, a->at));
}

/* The point of tether I nearest to the axle.  */
static bt_vec3
nearest_point (bt__scene *s, int i, const axle *a)
{
  enum
  {
    N = 401
  };
  bt_vec3 p[N], best = a->at;
  double least = INFINITY;
  if (bt_tether_points (s->dive, i, N, p, NULL) != BT_OK)
    return best;
  for (int k = 0; k < N; k++)
    {
      double d = bt__norm (aside (a, p[k]));
      if (d < least)
        least = d, best = p[k];
    }
  return best;
}

/* Draw TURNS about the axle as a helix from the direction of the tether on, with an arrow at the
   end.  */
static void
add_helix (bt__scene *s, const axle *a, int i, double turns)
{
  enum
  {
    N = 240
  };
  bt_thing line = bt_thing_of (BT_THING_LINES), head = bt_thing_of (BT_THING_ARROW);
  bt_vec3 p[2 * N], start = { 0, 0, 0 }, u, v, at, last = a->at, near = nearest_point (s, i, a);
  double r = 1.35 * a->radius + 0.01 * span_of (s), pitch = 0.25 * r;
  bt_tether_point (s->dive, i, 0, &start, NULL);
  u = bt__unit_or (aside (a, start), bt__vec (1, 0, 0));
  v = bt__cross (a->along, u);
  at = bt__axpy (a->at, bt__dot (bt__sub (near, a->at), a->along), a->along);
  for (int k = 0; k <= N; k++)
    {
      double share = (double)k / N, t = 2 * BT__PI * turns * share;
      bt_vec3 out = bt__axpy (bt__scale (cos (t), u), sin (t), v);
      bt_vec3 q = bt__axpy (bt__axpy (at, r, out), (share - 0.5) * pitch * turns, a->along);
      if (k)
        p[2 * k - 2] = last, p[2 * k - 1] = q;
      last = q;
    }
  line.points = p;
  line.n = 2 * N;
  line.color = head.color = turning;
  bt__scene_add (s, &line);
  head.from = p[2 * N - 6];
  head.to = bt__axpy (last, 0.35 * r, bt__unit_or (bt__sub (last, head.from), bt__vec (1, 0, 0)));
  bt__scene_add (s, &head);
}

/* A quarter of a turn is seen without help.  */
static void
add_turns_about (bt__scene *s, int i, int obstacle)
{
  bt_thing label = bt_thing_of (BT_THING_LABEL);
  bt_obstacle_view o;
  double turns = 0;
  int winding = 0;
  char text[120];
  axle a;
  if (bt_tether_turns (s->dive, i, obstacle, &turns, NULL) != BT_OK || fabs (turns) < 0.25
      || bt_dive_obstacle (s->dive, obstacle, &o, NULL) != BT_OK
      || bt_tether_winding (s->dive, i, obstacle, &winding, NULL) != BT_OK)
    return;
  a = axle_of (&o);
  if (winding == 0 && bt__norm (aside (&a, nearest_point (s, i, &a))) > 3 * a.radius)
    return; /* it merely passes */
  add_helix (s, &a, i, turns);
  snprintf (text, sizeof text, "%.60s: %+.2f turns, wound %+d",
            bt_dive_name (s->dive, BT_PART_OBSTACLE, obstacle), turns, winding);
  label.text = text;
  label.at = nearest_point (s, i, &a);
  label.at = bt__axpy (label.at, 1.2 * a.radius + 0.02 * span_of (s), bt__vec (0, 0, 1));
  bt__scene_add (s, &label);
}

static void
add_turns (bt__scene *s)
{
  for (int i = 0; i < tethers (s); i++)
    for (int k = 0; k < bt_dive_count (s->dive, BT_PART_OBSTACLE); k++)
      add_turns_about (s, i, k);
}

/* ---- Taut strings ---- */

static void
add_string (bt__scene *s, const bt_vec3 *points, int n)
{
  bt_thing line = bt_thing_of (BT_THING_LINES);
  line.color = (bt_color){ 0.92F, 0.98F, 1 };
  line.n = 2;
  for (int k = 1; k < n; k++)
    {
      line.points = points + k - 1;
      bt__scene_add (s, &line);
    }
}

static void
add_strings (bt__scene *s)
{
  enum
  {
    MOST = 4096
  };
  bt_vec3 *points = malloc (MOST * sizeof *points);
  for (int i = 0; points && i < tethers (s); i++)
    {
      int n = 0;
      s->status = bt_tether_taut_string (s->dive, i, points, MOST, &n, s->error);
      add_string (s, points, n);
    }
  free (points);
}

/* ---- Boxes ---- */

enum
{
  LEVELS = 3,   /* shown together */
  BATCH = 256,  /* boxes asked for at once */
  MOST = 20000, /* boxes of an obstacle */
  EDGES = 12
};

static void
add_box (bt__scene *s, const bt_vec3 axis[3], const bt_tree_box *box, bt_color color)
{
  bt_thing line = bt_thing_of (BT_THING_LINES);
  const double half[3] = { box->half.x, box->half.y, box->half.z };
  bt_vec3 p[2 * EDGES];
  for (int e = 0; e < EDGES; e++) /* edge E runs along axis E / 4 */
    for (int end = 0; end < 2; end++)
      {
        const int along = e / 4, sign[3] = { end, e & 1, e >> 1 & 1 };
        bt_vec3 q = box->centre;
        for (int k = 0; k < 3; k++)
          {
            int j = (along + k) % 3;
            q = bt__axpy (q, (sign[k] ? 1 : -1) * half[j], axis[j]);
          }
        p[2 * e + end] = q;
      }
  line.points = p;
  line.n = 2 * EDGES;
  line.color = color;
  bt__scene_add (s, &line);
}

/* An obstacle without a tree has its bounding box alone; a box is its own.  */
static void
add_whole (bt__scene *s, const bt_obstacle_view *o, bt_color color)
{
  static const bt_vec3 level[3] = { { 1, 0, 0 }, { 0, 1, 0 }, { 0, 0, 1 } };
  bt_tree_box box = { o->centre, bt__scale (0.5, bt__sub (o->high, o->low)) };
  if (bt__is_finite (o->low) && bt__is_finite (o->high))
    add_box (s, level, &box, color);
}

static void
add_level_of (bt__scene *s, int i, const bt_obstacle_view *o, int level)
{
  static const char *const none[] = { "" };
  const bt_scale words = { .word = none };
  bt_color color = bt__scale_color (&words, level);
  bt_tree_box box[BATCH];
  size_t n, done = 0;
  while (s->status == BT_OK && done < MOST
         && (n = bt_obstacle_boxes (s->dive, i, level, done, BATCH, box)) > 0)
    {
      for (size_t k = 0; k < n; k++)
        add_box (s, o->axes, &box[k], color);
      done += n;
    }
  if (done == 0 && level == 0)
    add_whole (s, o, color);
}

/* Colours tell the levels, unless the colours of the picture have another meaning already.  */
static void
name_levels (bt__scene *s)
{
  static const char *const words[] = { "the whole", "level 1", "level 2" };
  bt_scale *scale = &s->view->scale;
  if (scale->name || s->show.level >= 0)
    return;
  scale->word = bt_view_words (s->view, words, LEVELS);
  scale->words = scale->word ? LEVELS : 0;
  scale->name = scale->word ? "boxes" : NULL;
}

static void
add_boxes (bt__scene *s)
{
  int only = s->show.level, n = bt_dive_count (s->dive, BT_PART_OBSTACLE);
  for (int i = 0; i < n && s->status == BT_OK; i++)
    {
      bt_obstacle_view o;
      s->status = bt_dive_obstacle (s->dive, i, &o, s->error);
      for (int level = only < 0 ? 0 : only; level < (only < 0 ? LEVELS : only + 1); level++)
        if (s->status == BT_OK && (level == 0 || level < bt_obstacle_levels (s->dive, i)))
          add_level_of (s, i, &o, level);
    }
  name_levels (s);
}

void
bt__scene_more (bt__scene *s)
{
  unsigned more = s->status == BT_OK ? s->show.more : 0;
  if (more & BT__SHOW_CONTACTS)
    add_contacts (s);
  if (more & BT__SHOW_TURNS)
    add_turns (s);
  if (more & BT__SHOW_STRING)
    add_strings (s);
  if (more & BT__SHOW_BOXES)
    add_boxes (s);
}
