/* The shape of one tether: the choice of model, the load, and the memory from shape to shape.

   bt__shape_solve checks the input, measures the load (weight and drag of the mean current along
   the chord, shape_plane.c), and dispatches on the model of the tether: rubber band, V and both
   catenaries of the thesis (shape_thesis.c); here the elastic catenary (elastic.c) and the steady
   line in a current (equilibrium.c).  A line without load has closed answers: a catenary without
   tension while slack, else a straight line, held or stretched.

   Memory: the direction of the last load and of the plane serve a line without load, for which any
   plane would do; the steady model starts from the last pull and the last nodes.  Answers are flat
   data without padding, hashed and compared as bytes.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <string.h>

#include "tether/equilibrium.h"
#include "tether/shape_job.h"

/* The shape is hashed and compared as bytes.  */
_Static_assert(sizeof (bt__shape) == 8 * 38, "bt__shape must have no padding");

static const bt_vec3 up = { 0, 0, 1 }, down = { 0, 0, -1 };

/* ---- Elastic and steady ---- */

/* No load: a catenary without tension while slack, else a stretched or a held straight line.  */
static bt_status
solve_unloaded (bt__shape_job *j)
{
  double chord = bt__norm (j->chord), ea = j->props->ea;
  j->load = 0;
  j->direction = bt__shape_remembered (j);
  bt__shape_span_plane (j, j->chord);
  if (bt__shape_is_taut (j) || bt__shape_is_plane_taut (j))
    {
      bt__shape_be_straight (j,
                             isinf (ea) ? j->in->pull : ea * fmax (chord / j->in->length - 1, 0));
      return BT_OK;
    }
  bt_catenary c;
  bt_status status = bt_catenary_solve (j->h, j->v, j->in->length, &c, j->error);
  if (status == BT_OK)
    bt__shape_hang (j, &c);
  return status;
}

static bt_status
solve_elastic (bt__shape_job *j)
{
  bt__shape *s = j->shape;
  double weight = j->props->wet_weight, length = j->in->length;
  s->plane_length = length;
  if (weight == 0)
    return solve_unloaded (j);
  j->load = fabs (weight);
  j->direction = weight > 0 ? down : up;
  bt__shape_span_plane (j, j->chord);
  if (isinf (j->props->ea) && bt__shape_is_plane_taut (j))
    {
      bt__shape_be_straight (j, j->in->pull);
      return BT_OK;
    }
  s->form = BT__FORM_ELASTIC;
  return bt_elastic_solve (j->h, j->v, length, j->load, j->props->ea, &s->elastic, j->error);
}

/* True if the water rests all along the chord: the mean alone may vanish by chance.  */
static int
is_still (const bt__shape_job *j)
{
  const bt_water *w = j->in->water;
  if (!w->current || w->current->kind == BT_CURRENT_STILL)
    return 1;
  for (int i = 0; i <= 4; i++)
    {
      bt_vec3 u = bt_water_velocity (w, bt__axpy (j->in->a, i / 4.0, j->chord));
      if (u.x != 0 || u.y != 0 || u.z != 0)
        return 0;
    }
  return 1;
}

static bt_line
line_of_job (const bt__shape_job *j)
{
  const bt_tether_props *p = j->props;
  return (bt_line){ j->in->length, p->diameter, p->wet_weight, p->ea, p->cdn, p->cdt };
}

/* HAVE_SHAPE: the arrays hold the present shape.  */
static bt_status
solve_steady (bt__shape_job *j, int have_shape, bt_vec3 *nodes, bt_vec3 *tensions)
{
  bt__shape *s = j->shape;
  bt_line line = line_of_job (j);
  s->plane_length = j->in->length;
  if (j->props->wet_weight == 0 && is_still (j))
    return solve_unloaded (j);
  /* The mean load is remembered; the solver looks at every node's own.  */
  bt_vec3 load = bt__axpy (bt__scale (j->drag, j->current), -j->props->wet_weight, up);
  j->direction = bt__unit_or (load, bt__shape_remembered (j));
  bt__shape_span_plane (j, j->chord);
  if (isinf (line.ea) && bt__shape_is_taut (j))
    {
      bt__shape_be_straight (j, j->in->pull);
      return BT_OK;
    }
  s->form = BT__FORM_NODES;
  s->n = (int64_t)j->props->nodes;
  s->elastic.ea = line.ea;
  return bt__equilibrium_solve (j->tools->steady, &line, j->in->water, j->in->a, j->in->b,
                                (int)s->n, have_shape, j->direction, &j->memory->reaction, nodes,
                                tensions, j->counts, j->error);
}

/* ---- The whole ---- */

static bt_status
check_shape_input (const bt__shape_input *in, bt_error *error)
{
  if (!bt__is_finite (in->a) || !bt__is_finite (in->b))
    return bt__fail (error, BT_ERR_DOMAIN,
                     "the ends of a tether must be finite points: (%g, %g, %g) to (%g, %g, %g)",
                     in->a.x, in->a.y, in->a.z, in->b.x, in->b.y, in->b.z);
  if (!(in->length > 0 && isfinite (in->length)))
    return bt__fail (error, BT_ERR_DOMAIN,
                     "%g m of tether are paid out; a shape needs a positive length", in->length);
  return BT_OK;
}

static bt_status
check_rule (const bt__shape_job *j)
{
  int model = (int)j->props->model;
  if (j->props->depth_rule == BT_DEPTH_THESIS_LINEAR
      && (model == BT_MODEL_CATENARY || model == BT_MODEL_CATENARY_SIMPLEX))
    return bt__fail (j->error, BT_ERR_UNSUPPORTED,
                     "the depth rule `thesis-linear' is for the v-shape alone (thesis 2.4.1); a "
                     "catenary takes `sag' or `linear'");
  if (model == BT_MODEL_CATENARY_SIMPLEX && !j->tools->search)
    return bt__fail (j->error, BT_ERR_UNSUPPORTED, "no workspace for the thesis' search");
  if (model == BT_MODEL_STEADY && !j->tools->steady)
    return bt__fail (j->error, BT_ERR_UNSUPPORTED, "no workspace for the steady model");
  return BT_OK;
}

static bt_status
dispatch (bt__shape_job *j, int have_shape, bt_vec3 *nodes, bt_vec3 *tensions)
{
  switch ((int)j->props->model)
    {
    case BT_MODEL_RUBBER_BAND:
      return bt__shape_rubber_band (j);
    case BT_MODEL_V_SHAPE:
      return bt__shape_v (j);
    case BT_MODEL_CATENARY:
      return bt__shape_catenary (j);
    case BT_MODEL_CATENARY_SIMPLEX:
      return bt__shape_catenary_simplex (j);
    case BT_MODEL_ELASTIC:
      return solve_elastic (j);
    case BT_MODEL_STEADY:
      return solve_steady (j, have_shape, nodes, tensions);
    default:
      return bt__fail (j->error, BT_ERR_NAME, "no tether model has the number %g", j->props->model);
    }
}

/* The rubber band and a straight line know no plane; the rest leave theirs for the next shape.  */
static void
remember_plane (bt__shape_job *j, bt_vec3 across)
{
  if (j->props->model == BT_MODEL_RUBBER_BAND)
    return;
  j->memory->across = across;
  if (j->load > 0)
    j->memory->load_direction = j->direction;
}

bt_status
bt__shape_solve (const bt__shape_input *input, bt__shape_tools *tools, bt__shape_counts *counts,
                 bt__shape *shape, bt__shape_memory *memory, bt_vec3 *nodes, bt_vec3 *tensions,
                 bt_error *error)
{
  int have_shape = shape->form == BT__FORM_NODES && shape->n == (int64_t)input->props->nodes;
  memset (shape, 0, sizeof *shape);
  bt_status status = check_shape_input (input, error);
  if (status)
    return status;
  bt__shape_job j = { .in = input,
                      .props = input->props,
                      .tools = tools,
                      .counts = counts,
                      .shape = shape,
                      .memory = memory,
                      .error = error,
                      .chord = bt__sub (input->b, input->a) };
  shape->a = input->a;
  shape->b = input->b;
  shape->length = input->length;
  counts->solves++;
  if ((status = check_rule (&j)) || (status = bt__shape_measure_load (&j))
      || (status = dispatch (&j, have_shape, nodes, tensions)))
    return status;
  remember_plane (&j, shape->across);
  return BT_OK;
}
