/* The thesis' models in space: the rubber band, the V, the catenary by either way.

   The rubber band is the straight line, with the given pull if taut.  The V has its bend where both
   links lean by the same angle (v_shape.c); half the load acts at the bend and gives the tensions
   of the links.  With the depth rule `thesis-linear' (section 2.4.1) the bend of the flat V is
   lowered and drawn in along the current, and the two links define a plane of their own.

   The catenary is solved by the closed equation (catenary.c) or by the thesis' own simplex search
   (search.c), tried from the last answer and then from the thesis' guess.  An answer of the search
   is accepted if end and length are met within 1 % of the length; else the model fails with the
   residual.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <stddef.h>

#include "tether/shape_job.h"

/* The thesis' own tolerance of the search (section 2.3.2), and a bound on its steps.  */
#define SEARCH_TOLERANCE 0.005
enum
{
  SEARCH_STEPS = 500
};

/* An answer of the search with a larger miss, as a share of the length, is a failure.  */
#define SEARCH_MISS 0.01

bt_status
bt__shape_rubber_band (bt__shape_job *j)
{
  bt__shape_be_straight (j, bt__shape_is_taut (j) ? j->in->pull : 0);
  return BT_OK;
}

/* ---- The V ---- */

/* Load the bent links, from (0, 0) over the bend to (FAR, 0): half of the load acts at the bend,
   and (FX, FY) is the part of its unit direction in the plane of the links.  The load across the
   plane is left to the ends.  */
static void
load_bent_links (bt__shape *s, double far, double fx, double fy)
{
  double half = 0.5 * s->load * (s->v.l1 + s->v.l2);
  bt_point2 b = s->v.bend, e1 = { -b.x / s->v.l1, -b.y / s->v.l1 },
            e2 = { (far - b.x) / s->v.l2, -b.y / s->v.l2 };
  double turn = e1.x * e2.y - e1.y * e2.x;
  if (!(fabs (turn) > 1e-12))
    return; /* a link of no length, or no bend to speak of */
  s->t1 = fmax (half * (fy * e2.x - fx * e2.y) / turn, 0);
  s->t2 = fmax (half * (fx * e1.y - fy * e1.x) / turn, 0);
}

/* Thesis 2.4.1: the bend of the flat V keeps its place across the current, sinks by its share of
   the depth, and is pulled in along the current until the first link has its length again.  The
   second link changes its length.  The two links define the plane of the shape.  */
static bt_status
bend_thesis_linear (bt__shape_job *j)
{
  bt__shape *s = j->shape;
  double l1 = s->v.l1, depth = j->chord.z;
  double drop = depth * l1 / (j->props->thesis_length_factor * j->in->length);
  double square = l1 * l1 - s->v.bend.x * s->v.bend.x - drop * drop;
  if (!(square >= 0))
    return bt__fail (
        j->error, BT_ERR_DOMAIN,
        "the rule `thesis-linear' has no bend here: with %g m of depth its square root "
        "is of %g, negative (take `linear' or `sag')",
        depth, square);
  bt_vec3 bend = bt__axpy (bt__scale (s->v.bend.x, s->across), -sqrt (square), s->against);
  bend.z += drop;
  bt_vec3 along = bt__unit_or (j->chord, s->across), load = bt__scale (-1, s->against);
  s->across = along;
  s->against = bt__scale (-1, bt__shape_square_to (along, bt__norm (bend) > 0 ? bend : load));
  bt_point2 b = { bt__dot (bend, s->across), bt__dot (bend, s->against) };
  double far = bt__norm (j->chord);
  s->v = (bt_v_shape){ bt__norm (bend), hypot (far - b.x, b.y), b };
  s->plane_length = s->v.l1 + s->v.l2;
  load_bent_links (s, far, bt__dot (load, s->across), bt__dot (load, s->against));
  return BT_OK;
}

/* The straight line, with the bend at the limits of equation 2-1: at the start for a line taut
   against the load, at the end for a line taut along the load.  */
static void
pull_v_taut (bt__shape_job *j)
{
  bt__shape *s = j->shape;
  double l = j->in->length, l1 = j->v > 0 ? 0 : j->v < 0 ? l : l / 2;
  bt__shape_be_straight (j, j->in->pull);
  if (j->props->depth_rule != BT_DEPTH_SAG)
    return; /* the plane of the V is then not that of the line */
  s->form = BT__FORM_V;
  s->v = (bt_v_shape){ l1, l - l1, { j->h * (l1 / l), j->v * (l1 / l) } };
}

bt_status
bt__shape_v (bt__shape_job *j)
{
  bt__shape_pose (j);
  bt__shape *s = j->shape;
  if (bt__shape_is_taut (j) || bt__shape_is_plane_taut (j))
    {
      pull_v_taut (j);
      return BT_OK;
    }
  bt_status status = bt_v_shape_solve (j->h, j->v, s->plane_length, &s->v, j->error);
  if (status)
    return status;
  s->form = BT__FORM_V;
  if (j->props->depth_rule == BT_DEPTH_THESIS_LINEAR)
    return bend_thesis_linear (j);
  /* Both links lean by the same angle: the load shares evenly even if a link has no length.  */
  double l = s->plane_length, sine = sqrt ((l - j->h) * (l + j->h)) / l;
  s->t1 = s->t2 = 0.5 * s->load * l / (2 * sine);
  return BT_OK;
}

/* ---- The catenary, two ways ---- */

void
bt__shape_hang (bt__shape_job *j, const bt_catenary *c)
{
  j->shape->form = BT__FORM_CATENARY;
  j->shape->catenary = *c;
  j->shape->t1 = j->shape->t2 = j->shape->load * c->a;
}

bt_status
bt__shape_catenary (bt__shape_job *j)
{
  bt__shape_pose (j);
  bt_catenary c;
  if (bt__shape_is_plane_taut (j))
    {
      bt__shape_be_straight (j, j->in->pull);
      return BT_OK;
    }
  bt_status status = bt_catenary_solve (j->h, j->v, j->shape->plane_length, &c, j->error);
  if (status == BT_OK)
    bt__shape_hang (j, &c);
  return status;
}

/* The miss of R at end and length, relative to the length; infinite if R is no curve.  */
static double
search_miss (const bt__shape_job *j, const bt_search_result *r)
{
  double s = j->shape->plane_length, q = (j->h - r->xs) / r->a, p = -r->xs / r->a;
  double end = fabs (r->a * (cosh (q) - cosh (p)) - j->v);
  double length = fabs (r->a * (sinh (q) - sinh (p)) - s);
  double miss = fmax (end, length) / s;
  return r->a > 0 && isfinite (end) && isfinite (length) ? miss : INFINITY;
}

/* Search once, from the last answer when WARM; return the miss.  */
static double
search_once (bt__shape_job *j, int warm, bt_search_result *r)
{
  *r = (bt_search_result){ j->memory->search_a, j->memory->search_xs, 0, 0 };
  bt_status status = bt_search_catenary (j->tools->search, j->h, j->v, j->shape->plane_length,
                                         SEARCH_TOLERANCE, SEARCH_STEPS, warm, r, NULL);
  j->counts->search_iterations += (uint64_t)r->iterations;
  return status == BT_OK ? search_miss (j, r) : INFINITY;
}

bt_status
bt__shape_catenary_simplex (bt__shape_job *j)
{
  bt__shape_pose (j);
  if (bt__shape_is_plane_taut (j))
    {
      bt__shape_be_straight (j, j->in->pull);
      return BT_OK;
    }
  bt_search_result r;
  int warm = j->memory->search_a > 0;
  double miss = search_once (j, warm, &r);
  /* A last answer from far away may mislead; the thesis' own guess deserves its turn.  */
  if (warm && !(miss <= SEARCH_MISS))
    miss = search_once (j, 0, &r);
  if (!(miss <= SEARCH_MISS))
    return bt__fail (
        j->error, BT_ERR_DIVERGED,
        "the thesis' search found no catenary in %d steps: residual %g of the length "
        "(%g m across, %g m against the load, %g m long); `catenary' has no such limit",
        r.iterations, miss, j->h, j->v, j->shape->plane_length);
  bt_catenary c = { j->h, j->v, j->shape->plane_length, r.a, -r.a * sinh (r.xs / r.a) };
  bt__shape_hang (j, &c);
  j->memory->search_a = r.a;
  j->memory->search_xs = r.xs;
  return BT_OK;
}
