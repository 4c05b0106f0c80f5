/* The forms of a static tether: its shape alone, split into spans at obstacles, or held by them.

   All three have a static shape (tether/shape.h), the source of all answers beyond the
   knowledge of spans or polyline.  A thesis line among obstacles is split (contact/thesis.h); a
   line of the models `elastic' and `steady' is held (contact/held.h), and answers as a shape alone
   while no obstacle holds the line off the shape.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include "math/vec.h"
#include "world/form.h"
#include "world/layout.h"
#include "world/obstacles.h"

/* ---- The shape ---- */

static void
shape_find (const bt_dive *dive, bt__state *state, int i, bt__line *line)
{
  line->nodes = bt__dive_nodes (dive, state, i);
  line->tensions = bt__dive_tensions (dive, state, i);
}

static double
shape_length (const bt__line *line)
{
  return line->tether->shape.length;
}

static bt_vec3
shape_point (const bt__line *line, double s)
{
  return bt__shape_point (&line->tether->shape, line->nodes, line->tensions, s);
}

static bt_vec3
shape_tangent (const bt__line *line, double s)
{
  return bt__shape_tangent (&line->tether->shape, line->nodes, line->tensions, s);
}

static double
shape_tension (const bt__line *line, double s)
{
  return bt__shape_tension (&line->tether->shape, line->nodes, line->tensions, s);
}

static double
static_tension_max (const bt__line *line)
{
  return line->tether->tension_max;
}

static bt_vec3
static_end (const bt__line *line, int k)
{
  return k == 0 ? line->tether->shape.a : line->tether->shape.b;
}

static bt_vec3
static_pull (const bt__line *line, int k)
{
  double s = k == 1 ? bt__line_length (line) : 0;
  double tension = bt__line_tension (line, s);
  return bt__scale (k == 1 ? -tension : tension, bt__line_tangent (line, s));
}

static int
shape_points (const bt__line *line)
{
  switch (line->tether->shape.form)
    {
    case BT__FORM_STRAIGHT:
      return 2;
    case BT__FORM_V:
      return 3;
    default:
      return (int)line->tether->props.nodes + 1;
    }
}

/* The arc length of the K-th point: the V has one at its bend.  */
static double
shape_place (const bt__line *line, int k)
{
  const bt__shape *shape = &line->tether->shape;
  int n = shape_points (line);
  if (shape->form == BT__FORM_V && k == 1)
    return shape->v.l1 * (shape->length / (shape->v.l1 + shape->v.l2));
  return k == n - 1 ? shape->length : shape->length * k / (n - 1);
}

static bt_vec3
shape_node (const bt__line *line, int k)
{
  return shape_point (line, shape_place (line, k));
}

static double
shape_node_tension (const bt__line *line, int k)
{
  return shape_tension (line, shape_place (line, k));
}

static int
touches_nothing (const bt_dive *dive, int i, const bt__line *line, bt__touch *touch, int room)
{
  (void)dive, (void)i, (void)line, (void)touch, (void)room;
  return 0;
}

static const bt_vec3 *
laid_nowhere (const bt_dive *dive, bt__state *state, int i, int *n)
{
  (void)dive, (void)state, (void)i;
  *n = 0;
  return NULL;
}

static const bt_vec3 *
corners_of (bt__polyline *line, int *n)
{
  *n = (int)line->n;
  return bt__polyline_x (line);
}

static int
shape_ranges (const bt_dive *dive, const bt__state *state, int i, bt__range *out)
{
  const bt__tether *tether = bt__dive_tether (dive, (bt__state *)state, i);
  int n = bt__has_nodes (tether->shape.form);
  if (n)
    *out = (bt__range){ 0, bt__arrays_size (&dive->model->tethers[i]) };
  return n;
}

static bt_status
shape_nodes_judge (bt__judge *judge, const bt_dive *dive, bt__state *state, int i)
{
  if (!bt__has_nodes (bt__dive_tether (dive, state, i)->shape.form))
    return BT_OK;
  return bt__shape_judge_nodes (judge, bt__dive_nodes (dive, state, i),
                                bt__dive_tensions (dive, state, i),
                                bt__chain_room (&dive->model->tethers[i]));
}

static bt_status
shape_judge (bt__judge *judge, const bt_dive *dive, bt__state *state, int i)
{
  bt_status status = shape_nodes_judge (judge, dive, state, i);
  return status == BT_OK ? bt__shape_judge (judge, &bt__dive_tether (dive, state, i)->shape,
                                            bt__chain_room (&dive->model->tethers[i]))
                         : status;
}

const bt__form bt__form_shape = {
  .find = shape_find,
  .length = shape_length,
  .point = shape_point,
  .tangent = shape_tangent,
  .tension = shape_tension,
  .tension_max = static_tension_max,
  .end = static_end,
  .pull = static_pull,
  .nodes = shape_points,
  .node = shape_node,
  .node_tension = shape_node_tension,
  .touches = touches_nothing,
  .laid = laid_nowhere,
  .ranges = shape_ranges,
  .judge = shape_judge,
};

/* ---- Spans ---- */

static void
spans_find (const bt_dive *dive, bt__state *state, int i, bt__line *line)
{
  shape_find (dive, state, i, line);
  line->split = bt__dive_thesis (dive, state, i);
}

/* The length as the line lies: the polyline comes to what is paid out step by step.  */
static double
spans_length (const bt__line *line)
{
  bt__polyline *way = bt__thesis_line (line->split);
  return bt__polyline_u (way)[way->n - 1];
}

static bt_vec3
spans_point (const bt__line *line, double s)
{
  return bt__polyline_point (bt__thesis_line (line->split), s);
}

static bt_vec3
spans_tangent (const bt__line *line, double s)
{
  return bt__polyline_tangent (bt__thesis_line (line->split), s);
}

static double
spans_tension (const bt__line *line, double s)
{
  return bt__thesis_tension (line->split, s);
}

static int
spans_points (const bt__line *line)
{
  return (int)bt__thesis_line (line->split)->n;
}

static bt_vec3
spans_node (const bt__line *line, int k)
{
  return spans_point (line, bt__polyline_u (bt__thesis_line (line->split))[k]);
}

static double
spans_node_tension (const bt__line *line, int k)
{
  return spans_tension (line, bt__polyline_u (bt__thesis_line (line->split))[k]);
}

static int
spans_touches (const bt_dive *dive, int i, const bt__line *line, bt__touch *touch, int room)
{
  (void)dive, (void)i;
  return bt__thesis_touches (line->split, touch, room);
}

static const bt_vec3 *
spans_laid (const bt_dive *dive, bt__state *state, int i, int *n)
{
  return corners_of (bt__thesis_line (bt__dive_thesis (dive, state, i)), n);
}

static int
spans_ranges (const bt_dive *dive, const bt__state *state, int i, bt__range *out)
{
  int n = shape_ranges (dive, state, i, out);
  out[n++] = (bt__range){ bt__arrays_size (&dive->model->tethers[i]),
                          bt__thesis_live (bt__dive_thesis (dive, (bt__state *)state, i)) };
  return n;
}

/* Each span has a shape of its own; the tether's is not asked.  */
static bt_status
spans_judge (bt__judge *judge, const bt_dive *dive, bt__state *state, int i)
{
  bt_status status = shape_nodes_judge (judge, dive, state, i);
  return status == BT_OK ? bt__thesis_judge (judge, bt__dive_thesis (dive, state, i),
                                             (uint32_t)dive->model->tethers[i].props.nodes)
                         : status;
}

const bt__form bt__form_spans = {
  .find = spans_find,
  .length = spans_length,
  .point = spans_point,
  .tangent = spans_tangent,
  .tension = spans_tension,
  .tension_max = static_tension_max,
  .end = static_end,
  .pull = static_pull,
  .nodes = spans_points,
  .node = spans_node,
  .node_tension = spans_node_tension,
  .touches = spans_touches,
  .laid = spans_laid,
  .ranges = spans_ranges,
  .judge = spans_judge,
};

/* ---- Held ---- */

/* A line held by no obstacle follows the shape; only the points of the shape were kept clear.  */
static void
held_find (const bt_dive *dive, bt__state *state, int i, bt__line *line)
{
  const bt__polyline *held = bt__dive_held (dive, state, i);
  shape_find (dive, state, i, line);
  if (line->tether->blocked || held->n != line->tether->props.nodes + 1)
    line->held = held;
  else
    line->form = &bt__form_shape;
}

static bt_vec3
held_point (const bt__line *line, double s)
{
  return bt__polyline_point (line->held, s);
}

static bt_vec3
held_tangent (const bt__line *line, double s)
{
  return bt__polyline_tangent (line->held, s);
}

static int
held_points (const bt__line *line)
{
  return (int)line->held->n;
}

static bt_vec3
held_node (const bt__line *line, int k)
{
  return held_point (line, bt__polyline_u ((bt__polyline *)line->held)[k]);
}

/* The tension is that of the shape between the ends where they are.  */
static double
held_node_tension (const bt__line *line, int k)
{
  return shape_tension (line, bt__polyline_u ((bt__polyline *)line->held)[k]);
}

static int
held_touches (const bt_dive *dive, int i, const bt__line *line, bt__touch *touch, int room)
{
  if (bt__dive_ready ((bt_dive *)dive, NULL) != BT_OK)
    return 0;
  bt__surroundings around = bt__standing (dive, dive->now, BT_PART_TETHER, i);
  bt__way way = { .around = &around,
                  .core = bt__core (line->tether->props.diameter),
                  .work = dive->contact_work.polyline,
                  .count = &((bt_dive *)dive)->contact_work.count };
  return bt__held_touches (line->held, &way, line->tether->props.diameter, touch, room);
}

static const bt_vec3 *
held_laid (const bt_dive *dive, bt__state *state, int i, int *n)
{
  return corners_of (bt__dive_held (dive, state, i), n);
}

static int
held_ranges (const bt_dive *dive, const bt__state *state, int i, bt__range *out)
{
  const bt_tether_def *def = &dive->model->tethers[i];
  int n = shape_ranges (dive, state, i, out);
  out[n++]
      = (bt__range){ bt__arrays_size (def), bt__polyline_size ((uint32_t)bt__polyline_room (def)) };
  return n;
}

static bt_status
held_judge (bt__judge *judge, const bt_dive *dive, bt__state *state, int i)
{
  bt_status status = shape_judge (judge, dive, state, i);
  return status == BT_OK
             ? bt__polyline_judge (judge, bt__dive_held (dive, state, i),
                                   (uint32_t)bt__polyline_room (&dive->model->tethers[i]))
             : status;
}

const bt__form bt__form_held = {
  .find = held_find,
  .length = shape_length,
  .point = held_point,
  .tangent = held_tangent,
  .tension = shape_tension,
  .tension_max = static_tension_max,
  .end = static_end,
  .pull = static_pull,
  .nodes = held_points,
  .node = held_node,
  .node_tension = held_node_tension,
  .touches = held_touches,
  .laid = held_laid,
  .ranges = held_ranges,
  .judge = held_judge,
};
