/* Splitting where the tether was stopped, and taking splits back.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <string.h>

#include "contact/thesis_job.h"

#define APART 1.0  /* radii: splits nearer than this are one */
#define AT_END 2.0 /* radii: nearer to an end is no place for a split */
#define MORE                                                                                       \
  (BT__PI / 36)  /* what a contact that came back at once must open further: 5 degrees             \
                  */
#define LOST 4.0 /* radii: an obstacle farther from the break point's place is gone */

/* ---- Measuring ---- */

/* In the frame of the part that was hit, and back.  */
static void
measure_collision (bt__thesis_job *j, const bt__hit *hit, bt__collision *c)
{
  const bt__switches *on;
  const bt__scene *scene = bt__way_scene (j->way, hit->mover, &on);
  bt__link link = bt__link_of (bt__polyline_x (j->line), hit->link);
  bt__near near = hit->near;
  const bt__frame *f = hit->mover ? &j->way->work->still[hit->mover - 1].motion.from : NULL;
  if (f)
    {
      link = bt__link_into (f, link);
      near.w.point = bt__to_local (f, near.w.point);
      near.w.normal = bt__into (f, near.w.normal);
    }
  bt__collision_point (scene, on, &link, &near, BT__PRESSED * j->radius, j->radius,
                       j->way->work->near, c, j->way->count);
  if (!f)
    return;
  c->contact = bt__to_world (f, c->contact);
  c->point = bt__to_world (f, c->point);
  c->normal = bt__out_of (f, c->normal);
}

/* True if something of MOVER, or of the scene for 0, is within REACH of P; OBJECT: of that id
   only, unless negative.  */
static int
is_part_near (bt__thesis_job *j, uint32_t mover, bt_vec3 p, double reach, int64_t object)
{
  const bt__switches *on;
  const bt__scene *scene = bt__way_scene (j->way, mover, &on);
  bt__nears list = { j->way->work->near, 0, BT__PARTS_MAX, INFINITY };
  if (mover)
    p = bt__to_local (&j->way->work->still[mover - 1].motion.from, p);
  bt__link point = { p, p };
  if (scene->n == 0)
    return 0;
  bt__scene_near (scene, on, &point, 0, reach, &list, j->way->count);
  for (uint32_t i = 0; i < list.n; i++)
    if (object < 0 || (int64_t)scene->object[list.at[i].object].id == object)
      return 1;
  return 0;
}

/* True if P is clear of everything, and will be if the line there is pressed in a little.  */
static int
is_clear_point (bt__thesis_job *j, bt_vec3 p)
{
  for (uint32_t m = 0; m <= j->way->around->movers; m++)
    if (is_part_near (j, m, p, (1 + BT__PRESSED) * j->way->core, -1))
      return 0;
  return 1;
}

/* ---- Splitting ---- */

/* Where on its link, by arc length, the point P is.  */
static double
arc_of (const bt__thesis_job *j, uint32_t link, bt_vec3 p)
{
  const double *u = bt__polyline_u (j->line) + link;
  bt__link at = bt__link_of (bt__polyline_x (j->line), link);
  return u[0] + bt__nearest_share (&at, p) * (u[1] - u[0]);
}

/* True if a split at P on span K would coincide with an existing split or end.  */
static int
is_split_taken (const bt__thesis_job *j, int64_t k, bt_vec3 p)
{
  const bt_vec3 *x = bt__polyline_x (j->line);
  int64_t i = bt__thesis_first (j, k), m = bt__thesis_last (j, k);
  double before = k == 0 ? AT_END : APART, after = k == j->state->spans - 1 ? AT_END : APART;
  return bt__distance (p, x[i]) < before * j->radius || bt__distance (p, x[m]) < after * j->radius;
}

/* Was a contact with OBJECT taken back in this step?  Then at which angle, else 0.  */
static double
came_back (const bt__thesis_job *j, int64_t object)
{
  double angle = 0;
  for (int i = 0; i < j->rejoined && i < BT__REJOINED_MAX; i++)
    if (j->gone[i].object == object)
      angle = fmax (angle, j->gone[i].angle);
  return j->in->rules->no_back_side ? 0 : angle;
}

static bt__split
new_split (bt__thesis_job *j, const bt__hit *hit, const bt__collision *c, int64_t node)
{
  int64_t object = bt__hit_object (j->way, hit);
  int mesh = hit->near.triangle != BT__NO_TRIANGLE;
  bt_vec3 here = bt__polyline_x (j->line)[node];
  return (bt__split){ .object = object,
                      .triangle = mesh ? (int64_t)hit->near.triangle : -1,
                      .mover = hit->mover,
                      .node = node,
                      .contact = c->contact,
                      .normal = c->normal,
                      .point = is_clear_point (j, c->point) ? c->point : here,
                      .angle = BT__PI,
                      .kept = came_back (j, object),
                      .fresh = BT__NEW };
}

/* Make room for a split in span K, of WHOLE m of arc length, F m of it before the split.  */
static void
divide_span (bt__thesis_job *j, int64_t k, double whole, double f, const bt__split *split)
{
  bt__thesis *s = j->state;
  bt__span *span = j->span;
  memmove (span + k + 1, span + k, (size_t)(s->spans - k) * sizeof *span);
  s->spans++;
  span[k].end = *split;
  for (int64_t i = k; i <= k + 1; i++)
    {
      span[i].rubber = span[i].solved = 0;
      span[i].memory.search_a = 0;
    }
  span[k].length = fmax (f * whole, bt__distance (bt__span_start (j, k), split->point));
  span[k + 1].length = fmax (whole - span[k].length, AT_END * j->radius);
  s->bent += s->bent > k || (s->bent == k && span[k + 1].length > span[k].length);
}

/* A collision C beside the split at an end of span K is that split's: let it lean there, too, once
   in a step.  */
static int
lean_split (bt__thesis_job *j, int64_t k, const bt__collision *c)
{
  for (int64_t i = k - 1; i <= k; i++)
    {
      if (i < 0 || i >= j->state->spans - 1)
        continue;
      bt__split *s = &j->span[i].end;
      bt_vec3 n = bt__unit_or (bt__add (s->normal, c->normal), c->normal);
      bt_vec3 out = bt__axpy (c->contact, bt__distance (c->contact, c->point), n);
      double apart = bt__distance (c->contact, bt__polyline_x (j->line)[s->node]);
      if (s->fresh == BT__LEANT || apart > LOST * j->radius || !is_clear_point (j, out))
        continue;
      s->normal = n;
      s->contact = c->contact;
      s->point = out;
      s->fresh = BT__LEANT;
      bt__polyline_nudge (j->line, j->way, s->node, out);
      return 1;
    }
  return 0;
}

int
bt__thesis_split (bt__thesis_job *j, const bt__hit *hit)
{
  const double *u = bt__polyline_u (j->line);
  int64_t k = bt__thesis_span_of (j, hit->link), had = j->line->n;
  bt__collision c;
  if (j->state->spans > BT__SPLITS_MAX)
    return 0;
  measure_collision (j, hit, &c);
  double s = arc_of (j, hit->link, c.contact);
  if (is_split_taken (j, k, bt__polyline_point (j->line, s)) || is_split_taken (j, k, c.point))
    return lean_split (j, k, &c);
  int64_t first = bt__thesis_first (j, k), last = bt__thesis_last (j, k);
  double whole = u[last] - u[first], f = (s - u[first]) / whole;
  if (!(fmin (f, 1 - f) * whole > AT_END * j->radius))
    return 0;
  int64_t node = bt__polyline_insert (j->line, s, 0);
  if (node <= first || node > last || (node == last && j->line->n == had))
    return 0;
  for (int64_t i = k; i < j->state->spans - 1; i++)
    j->span[i].end.node += j->line->n - had;
  bt__split split = new_split (j, hit, &c, node);
  divide_span (j, k, whole, f, &split);
  /* Out first: from there both spans can turn without touching at once.  */
  bt__polyline_nudge (j->line, j->way, node, split.point);
  j->counts->splits++;
  return 1;
}

/* ---- Taking back ---- */

/* Take back the split after span K.  */
static void
take_back_split (bt__thesis_job *j, int64_t k)
{
  bt__thesis *s = j->state;
  bt__span *span = j->span;
  bt__split gone = span[k].end;
  if (j->rejoined < BT__REJOINED_MAX)
    j->gone[j->rejoined] = (bt__rejoined){ gone.object, gone.contact, gone.angle };
  j->rejoined++;
  span[k].length += span[k + 1].length;
  span[k].end = span[k + 1].end;
  span[k].rubber = span[k].solved = 0;
  memmove (span + k + 1, span + k + 2, (size_t)(s->spans - k - 2) * sizeof *span);
  s->spans--;
  memset (span + s->spans, 0, sizeof *span);
  s->bent -= s->bent > k;
  j->counts->rejoins++;
}

/* At the split after span K, of the polyline as it is.  */
static double
angle_now (const bt__thesis_job *j, int64_t k)
{
  const bt__split *split = &j->span[k].end;
  const bt_vec3 *x = bt__polyline_x (j->line) + split->node;
  bt_vec3 d = bt__unit_or (bt__sub (x[-1], x[0]), bt__vec (0, 0, 0));
  bt_vec3 e = bt__unit_or (bt__sub (x[1], x[0]), bt__vec (0, 0, 0));
  return bt__split_angle (d, e, split->normal);
}

int
bt__thesis_rejoin_open (bt__thesis_job *j)
{
  int n = 0;
  for (int64_t k = 0; k < j->state->spans - 1; k++)
    {
      bt__split *split = &j->span[k].end;
      double enough = j->in->rules->rejoin_angle;
      split->angle = angle_now (j, k);
      if (split->kept > 0)
        enough = fmax (enough, split->kept + MORE);
      if (split->angle < enough)
        continue;
      take_back_split (j, k--);
      n++;
    }
  return n;
}

void
bt__thesis_drop_lost (bt__thesis_job *j)
{
  const bt__switches *on = j->way->around->on;
  uint64_t version = on ? on->version : 0;
  if (version == j->state->version && j->way->around->movers == 0)
    return;
  j->state->version = version;
  j->state->settled = 0;
  for (int64_t k = 0; k < j->state->spans - 1; k++)
    {
      const bt__split *s = &j->span[k].end;
      double reach = bt__distance (s->contact, s->point) + LOST * j->radius;
      uint32_t mover = (uint32_t)s->mover;
      if (mover > j->way->around->movers || !is_part_near (j, mover, s->point, reach, s->object))
        take_back_split (j, k--);
    }
}
