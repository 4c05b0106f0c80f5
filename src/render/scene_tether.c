/* The tethers of a dive as painted tubes, and marks where they touch.

   A tube has twice as many points as the tether has nodes, at least 240, at equal arc lengths.
   Paint is a number at every point on one scale for all tethers: tension, curvature (of the circle
   through three neighbouring points), or the model at work.  Scales of curvature, and of a single
   number, begin at zero; models are numbered from 0 on and named in the legend.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/error.h"
#include "math/vec.h"
#include "render/scene.h"

enum
{
  FEWEST = 240, /* points of a tube */
  SPANS = 256   /* between contacts, looked at when painting by model */
};

/* ---- Shapes ---- */

static bt_tether_view
tether_of (bt__scene *s, int i)
{
  bt_tether_view t;
  memset (&t, 0, sizeof t);
  if (s->status == BT_OK)
    s->status = bt_dive_tether (s->dive, i, &t, s->error);
  return t;
}

static size_t
points_of (const bt_tether_view *t)
{
  int n = 2 * t->nodes;
  return (size_t)(n < FEWEST ? FEWEST : n);
}

static int
make_room (bt__scene *s)
{
  size_t n = 0;
  for (int i = 0; i < bt_dive_count (s->dive, BT_PART_TETHER); i++)
    {
      bt_tether_view t = tether_of (s, i);
      n += points_of (&t);
    }
  s->points = calloc (n + 1, sizeof *s->points);
  s->values = calloc (n + 1, sizeof *s->values);
  if (s->status == BT_OK && (!s->points || !s->values))
    s->status = bt__fail (s->error, BT_ERR_LIMIT, "there is no memory left for the picture");
  return s->status == BT_OK;
}

static void
widen_scene (bt__scene *s, bt_vec3 p)
{
  if (!s->any)
    s->low = s->high = p;
  s->any = 1;
  s->low = bt__vec (fmin (s->low.x, p.x), fmin (s->low.y, p.y), fmin (s->low.z, p.z));
  s->high = bt__vec (fmax (s->high.x, p.x), fmax (s->high.y, p.y), fmax (s->high.z, p.z));
}

/* ---- Numbers along them ---- */

/* One over the radius of the circle through A, B and C, 1/m.  */
static double
curvature (bt_vec3 a, bt_vec3 b, bt_vec3 c)
{
  bt_vec3 u = bt__sub (b, a), v = bt__sub (c, b);
  double product = bt__norm (u) * bt__norm (v) * bt__distance (a, c);
  return product > 1e-15 ? 2 * bt__norm (bt__cross (u, v)) / product : 0;
}

static void
set_curvatures (const bt_vec3 *p, double *value, size_t n)
{
  for (size_t i = 1; i + 1 < n; i++)
    value[i] = curvature (p[i - 1], p[i], p[i + 1]);
  value[0] = value[1];
  value[n - 1] = value[n - 2];
}

/* The number of the model at work at each of the points.  */
static void
set_models (bt__scene *s, int i, const bt_tether_view *t, double *value, size_t n)
{
  bt_segment span[SPANS];
  int spans = bt_tether_segments (s->dive, i, span, SPANS);
  for (size_t k = 0; k < n; k++)
    {
      double at = t->length * (double)k / (double)(n - 1);
      value[k] = t->props.model;
      for (int j = 0; j < spans && j < SPANS; j++)
        if (at >= span[j].from && at <= span[j].to)
          value[k] = span[j].model;
    }
}

static void
set_values (bt__scene *s, int i, const bt_tether_view *t, double *value, size_t n)
{
  const bt_vec3 *p = s->points + (value - s->values);
  if (s->show.paint == BT__PAINT_TENSION)
    s->status = bt_tether_tensions (s->dive, i, (int)n, value, s->error);
  else if (s->show.paint == BT__PAINT_CURVATURE)
    set_curvatures (p, value, n);
  else if (s->show.paint == BT__PAINT_MODEL)
    set_models (s, i, t, value, n);
}

/* ---- Scales ---- */

/* Low and high of all values; a scale of curvatures, and one of a single number, begins at zero. */
static void
set_range (bt__scene *s)
{
  bt_scale *scale = &s->view->scale;
  scale->low = INFINITY;
  scale->high = -INFINITY;
  for (size_t i = 0; i < s->n; i++)
    {
      scale->low = fmin (scale->low, s->values[i]);
      scale->high = fmax (scale->high, s->values[i]);
    }
  if (s->show.paint == BT__PAINT_CURVATURE
      || !(scale->high - scale->low > 1e-6 * fabs (scale->high)))
    scale->low = fmin (0, scale->low);
  if (!(scale->high > scale->low))
    scale->high = scale->low + 1;
}

static const char *
model_word (double model)
{
  const bt_field *field = bt_field_find (bt_head_find ("tether"), "model");
  for (const bt_word *w = field ? field->words : NULL; w && w->word; w++)
    if (w->value == model)
      return w->word;
  return "unknown";
}

/* Number the models in use from 0 on, and name them.  */
static void
set_words (bt__scene *s)
{
  enum
  {
    MOST = 8
  };
  const char *words[MOST];
  double models[MOST];
  int n = 0;
  bt_scale *scale = &s->view->scale;
  for (size_t i = 0; i < s->n; i++)
    {
      int k = 0;
      while (k < n && models[k] != s->values[i])
        k++;
      if (k == n && n < MOST)
        {
          models[n] = s->values[i];
          words[n++] = model_word (s->values[i]);
        }
      s->values[i] = k;
    }
  scale->word = bt_view_words (s->view, words, (size_t)n);
  scale->words = scale->word ? n : 0;
}

static void
set_scale (bt__scene *s)
{
  static const char *const names[BT__PAINTS] = { NULL, "tension", "curvature", "model" };
  static const char *const units[BT__PAINTS] = { NULL, "N", "1/m", NULL };
  bt_scale *scale = &s->view->scale;
  scale->name = names[s->show.paint];
  scale->unit = units[s->show.paint];
  if (s->show.paint == BT__PAINT_MODEL)
    set_words (s);
  else if (s->show.paint != BT__PAINT_PLAIN)
    set_range (s);
}

/* ---- What is added ---- */

static void
add_tube (bt__scene *s, const bt_vec3 *points, const double *values, size_t n, double radius)
{
  bt_thing t = bt_thing_of (BT_THING_TUBE);
  t.points = points;
  t.values = s->show.paint == BT__PAINT_PLAIN ? NULL : values;
  t.n = n;
  t.radius = radius;
  t.framing = BT_FRAME_MUST;
  bt__scene_add (s, &t);
}

static void
add_tail (bt__scene *s, int i, const bt_tether_view *t)
{
  int n = bt_tether_tail (s->dive, i, NULL, 0);
  bt_vec3 *points = n > 1 ? calloc ((size_t)n, sizeof *points) : NULL;
  bt_thing tail = bt_thing_of (BT_THING_TUBE);
  if (!points)
    return;
  tail.n = (size_t)bt_tether_tail (s->dive, i, points, n);
  tail.points = points;
  tail.radius = t->props.diameter / 2;
  tail.framing = BT_FRAME_MUST;
  bt__scene_add (s, &tail);
  free (points);
}

/* The name of OBSTACLE, with the number of turns of tether I about the obstacle, if any.  */
static void
describe_touch (bt__scene *s, int i, int obstacle, char text[static 120])
{
  const char *name = bt_dive_name (s->dive, BT_PART_OBSTACLE, obstacle);
  double turns = 0;
  bt_status status = bt_tether_turns (s->dive, i, obstacle, &turns, NULL);
  if (status == BT_OK && fabs (turns) >= 0.75)
    snprintf (text, 120, "%.60s, %+.1f turns", name ? name : "", turns);
  else
    snprintf (text, 120, "%.60s", name ? name : "");
}

/* Rings where tether I touches, not two within a hundredth of its length; the first ring on an
   obstacle has its name, unless SHOW tells more of the obstacle.  */
static void
add_marks (bt__scene *s, int i, const bt_tether_view *t)
{
  enum
  {
    MOST = 2000
  };
  bt_contact *contact = malloc (MOST * sizeof *contact);
  int n = contact ? bt_tether_contacts (s->dive, i, contact, MOST) : 0, last = -1;
  char text[120];
  double at = -INFINITY;
  for (int k = 0; k < n && k < MOST; k++)
    {
      bt_thing mark = bt_thing_of (BT_THING_MARK);
      if (contact[k].object == last && contact[k].s - at < 0.01 * t->length)
        continue;
      mark.at = contact[k].position;
      mark.radius = 6;
      if (contact[k].object != last && !(s->show.more & (BT__SHOW_CONTACTS | BT__SHOW_TURNS)))
        {
          describe_touch (s, i, contact[k].object, text);
          mark.text = text;
        }
      last = contact[k].object;
      at = contact[k].s;
      bt__scene_add (s, &mark);
    }
  free (contact);
}

void
bt__scene_tethers (bt__scene *s)
{
  int n = bt_dive_count (s->dive, BT_PART_TETHER);
  if (!make_room (s))
    return;
  for (int i = 0; i < n && s->status == BT_OK; i++)
    {
      bt_tether_view t = tether_of (s, i);
      size_t k = points_of (&t);
      s->status = bt_tether_points (s->dive, i, (int)k, s->points + s->n, s->error);
      if (s->status == BT_OK)
        set_values (s, i, &t, s->values + s->n, k);
      for (size_t j = 0; j < k && s->status == BT_OK; j++)
        widen_scene (s, s->points[s->n + j]);
      s->n += k;
    }
  if (s->status == BT_OK)
    set_scale (s);
  for (size_t i = 0, first = 0; i < (size_t)n && s->status == BT_OK; i++)
    {
      bt_tether_view t = tether_of (s, (int)i);
      size_t k = points_of (&t);
      add_tube (s, s->points + first, s->values + first, k, t.props.diameter / 2);
      add_tail (s, (int)i, &t);
      add_marks (s, (int)i, &t);
      first += k;
    }
}
