/* Contact constraints: the half-spaces that keep a line out of the touched obstacles.

   A part within touching distance of a link gives constraints: at the ends of the link where the
   part is flat, or so round that the line lies along it, else at the nearest point of the link.
   Triangles of a mesh are treated in line_facet.c.  Of two like constraints at the same place the
   lower is kept.

   A half-space is placed by the closest points of the expected end of the step, if the line is then
   outside and over the same feature: the half-space of the start turns with the line and would drag
   the line back.  A line pressed nearer than its radius is let out slowly, at 0.2 m/s.  A moving
   obstacle takes its half-spaces along.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include "contact/line_row.h"

#define ROUND 2.2     /* links: an obstacle of this radius along the line is touched by nodes */
#define EVENLY 0.15   /* of what is beyond the plane, half way out: less and it is an edge */
#define SHARP 0.4     /* ... half way out: more and it is sharp */
#define FLAT 0.1      /* of the radius: a link no steeper lies along a plane */
#define SAME 0.15     /* of a link: places so near are one, ... */
#define SAME_HIT 0.25 /* ... of hits, ... */
#define ALIKE 0.995   /* ... if their normals' product is more */
#define COPLANAR 0.9999

/* ---- Rows ---- */

/* The place of a row along the line, in links.  */
static double
place_of (const bt__constraint *r)
{
  return (double)r->node + r->s;
}

void
bt__row_set (bt__line_job *k, int number, uint32_t j, double s, const bt__near *near,
             const bt__witness *w, double start)
{
  const bt__mover *m = bt__line_mover (k, near);
  bt_vec3 point = w->point, normal = w->normal, drift = { 0, 0, 0 };
  if (m)
    {
      bt__frame to = bt__motion_at (&m->motion, 1);
      normal = bt__out_of (&to, normal);
      point = bt__to_world (&to, w->point);
      drift = bt__sub (point, bt__to_world (&m->motion.from, w->point));
    }
  double out = fmin (k->config->radius, fmax (start, k->core) + BT__LINE_RECOVERY * k->h);
  k->w->row[number] = (bt__constraint){ .node = (int64_t)j,
                                        .s = s,
                                        .normal = normal,
                                        .offset = bt__dot (normal, point) + out,
                                        .drift = drift,
                                        .active = -1 };
  k->w->of[number] = (bt__line_row){
    .link = j,
    .mover = near->link,
    .object = near->object,
    .slot = near->slot,
    .triangle = near->triangle,
    .id = bt__line_scene (k, near)->object[near->object].id,
    .fresh = 1,
    .wedged = k->wedged,
    .from_end = (1 - s) * k->w->from_end[j] + s * k->w->from_end[j + 1],
    .distance = near->w.distance,
    .point = point,
  };
}

static double
height_of (const bt__line_job *k, const bt__constraint *r)
{
  const bt_vec3 *p = k->x + r->node;
  bt_vec3 at = bt__between (p, r->s);
  return bt__dot (r->normal, at) - r->offset;
}

void
bt__row_take (bt__line_job *k, int flat)
{
  bt__constraint *row = k->w->row, *r = row + k->rows;
  bt__line_row *of = k->w->of;
  of[k->rows].flat = flat;
  for (int i = k->rows - 1; i >= 0 && row[i].node + !k->wedged >= r->node; i--)
    if (fabs (place_of (row + i) - place_of (r)) < SAME
        && bt__dot (row[i].normal, r->normal) > ALIKE)
      {
        double ahead = BT__ROW_NEAREST * k->config->radius * ((flat == 1) - (of[i].flat == 1));
        if (height_of (k, r) < height_of (k, row + i) + ahead)
          {
            row[i] = *r;
            of[i] = of[k->rows];
          }
        return;
      }
  k->rows++;
}

/* Take the half-space of the closest points at the end of the step, TO.  The half-space at FROM
   would drag the line back by speed times step over radius.  FROM is kept if the line would be
   inside by then, or over the next triangle.  */
static void
look_ahead (const bt__line_job *k, const bt__pass *p, const bt__link *from, const bt__link *to,
            const bt__witness *now, bt__witness *w)
{
  *w = *now;
  if (fmax (bt__distance (from->a, to->a), bt__distance (from->b, to->b)) > BT__LINE_FORETOLD)
    return;
  bt__scene_pair (bt__line_scene (k, p->near), p->near, to, w);
  int turned = !(bt__dot (w->normal, now->normal) > BT__ROW_TURNED);
  int other = p->near->slot != BT__NO_TRIANGLE && w->feature != now->feature;
  if (!(w->distance > k->core) || turned || other)
    *w = *now;
}

bt__pass
bt__row_pass (const bt__line_job *k, uint32_t j, const bt__near *near)
{
  const bt__mover *m = bt__line_mover (k, near);
  bt__pass p = { .near = near, .from = bt__link_of (k->x, j), .to = bt__link_of (k->X, j) };
  if (m)
    {
      bt__frame end = bt__motion_at (&m->motion, 1);
      p.from = bt__link_into (&m->motion.from, p.from);
      p.to = bt__link_into (&end, p.to);
    }
  return p;
}

/* An end of a link against what the link passes.  */
typedef struct pass_end
{
  bt__witness from, w; /* as the step starts; at its end */
  double lever;        /* m of link from its nearest point */
  double radius;       /* m: of the obstacle along the link on this side, as seen from the end */
  int round;           /* true: the obstacle is flat or round there, not sharp */
} pass_end;

/* The distance from the obstacle less the distance from the plane of its nearest point, at the
   place S of the link in the frame of P: half the square of the way over the radius, at a round
   obstacle.  */
static double
beyond_plane (const bt__line_job *k, const bt__pass *p, double s, bt__witness *w)
{
  const bt__witness *found = &p->near->w;
  bt_vec3 at = bt__along (&p->from, s);
  bt__link point = { at, at };
  bt__scene_pair (bt__line_scene (k, p->near), p->near, &point, w);
  return fmax (w->distance - bt__dot (found->normal, bt__sub (at, found->point)), 0);
}

static pass_end
pass_end_of (const bt__line_job *k, const bt__pass *p, int e, double length)
{
  bt_vec3 at = e ? p->from.b : p->from.a, to = e ? p->to.b : p->to.a;
  bt__link from = { at, at }, then = { to, to };
  double s = p->near->w.s;
  bt__witness half;
  pass_end end;
  double more = beyond_plane (k, p, e, &end.from);
  look_ahead (k, p, &from, &then, &end.from, &end.w);
  end.lever = fabs (e - s) * length;
  end.radius = end.lever * end.lever / (2 * fmax (more, 1e-9));
  end.round = more <= FLAT * k->config->radius
              || (end.radius >= ROUND * length
                  && beyond_plane (k, p, 0.5 * (e + s), &half) > EVENLY * more);
  return end;
}

/* The constraint at end E of link J. Nodes of a line about a round obstacle are raised, so that no
   link between them is inside.  A node below the raised height is let out slowly, as from the
   obstacle itself; an end of the line, perhaps held in place, is not raised.  */
static void
touch_end (bt__line_job *k, uint32_t j, int e, const bt__pass *p, const pass_end *end, double raise)
{
  double above = fmax (end->from.distance - k->config->radius, 0);
  int64_t i = (int64_t)j + e;
  raise = fmin (raise, above + (i > 0 && i < k->links ? BT__LINE_RECOVERY * k->h : 0));
  if (end->from.distance - raise >= k->config->radius + k->margin || !bt__line_takes_row (k))
    return;
  bt__row_set (k, k->rows, j, e, p->near, &end->w, end->from.distance - raise);
  k->w->row[k->rows].offset += raise;
  bt__row_take (k, 1);
}

int
bt__row_lies_along (const bt__line_job *k, const bt__link *link, const bt__witness *w)
{
  double slope = bt__dot (w->normal, bt__sub (link->b, link->a));
  return fabs (slope) <= FLAT * k->config->radius;
}

void
bt__row_between (bt__line_job *k, uint32_t j, const bt__pass *p, double radius)
{
  bt_vec3 along = bt__sub (p->to.b, p->to.a);
  if (!bt__line_takes_row (k))
    return;
  bt__witness w;
  look_ahead (k, p, &p->from, &p->to, &p->near->w, &w);
  bt__row_set (k, k->rows, j, w.s, p->near, &w, p->near->w.distance);
  bt__constraint *r = k->w->row + k->rows;
  r->roll = radius / fmax (bt__dot (along, along), 1e-12);
  r->tilt = bt__dot (w.normal, along); /* the same in either frame */
  bt__row_take (k, 2 * bt__row_lies_along (k, &p->from, &p->near->w));
}

/* True if the obstacle is sharp at its point nearest to the link's end E: the distance beyond the
   plane grows with the way from the point, not with the square of the way.  */
static int
is_sharp_at (const bt__line_job *k, const bt__pass *p, int e)
{
  bt__witness w;
  double more = beyond_plane (k, p, !e, &w);
  return more > FLAT * k->config->radius && beyond_plane (k, p, 0.5, &w) > SHARP * more;
}

/* True if link J comes nearer to what NEAR is of than NEAR does.  */
static int
comes_nearer (const bt__line_job *k, int64_t j, const bt__near *near)
{
  const bt__near *its = bt__line_near (k, (uint32_t)j);
  double nearest = near->w.distance - BT__ROW_NEAREST * k->config->radius;
  for (uint32_t i = 0; i < k->w->watch[j].found; i++)
    if (its[i].link == near->link && its[i].object == near->object && its[i].w.distance < nearest)
      return 1;
  return 0;
}

/* True if link J's end E is at a sharp edge, and beyond it the line comes nearer yet: the next
   link bears, and the plane of the end would bar the way of the node over the edge.  */
static int
bars_the_way (const bt__line_job *k, uint32_t j, int e, const bt__pass *p)
{
  int64_t i = (int64_t)j + e, next = e ? i + 1 : i - 1;
  const bt__mover *m = bt__line_mover (k, p->near);
  bt_vec3 n = p->near->w.normal;
  if (next < 0 || next > k->links)
    return 0;
  if (m)
    n = bt__out_of (&m->motion.from, n);
  return bt__dot (n, bt__sub (k->x[next], k->x[i])) < -BT__ROW_NEAREST * k->config->radius
         && comes_nearer (k, e ? i : next, p->near) && is_sharp_at (k, p, e);
}

/* The raise of an end of a link about a round obstacle if the other end is HIGH above; RAISE is the
   raise of both ends of a link along the obstacle.  From HIGH of four times RAISE on, the link
   comes no nearer than its end.  */
static double
raise_below (double raise, double high)
{
  return raise > 0 ? raise * fmin (fmax (2 - 0.5 * high / raise, 0), 1) : 0;
}

static void
touch_part (bt__line_job *k, uint32_t j, const bt__near *near)
{
  if (near->slot != BT__NO_TRIANGLE)
    {
      bt__row_facet (k, j, near);
      return;
    }
  bt__pass p = bt__row_pass (k, j, near);
  double length = bt__distance (p.from.a, p.from.b);
  pass_end end[2] = { pass_end_of (k, &p, 0, length), pass_end_of (k, &p, 1, length) };
  double nearest = near->w.distance + BT__ROW_NEAREST * k->config->radius, raise = 0;
  int both = end[0].round && end[1].round && !k->wedged;
  if (both)
    {
      double about = end[0].lever > end[1].lever ? end[0].radius : end[1].radius;
      double half = length / 2;
      raise = half * half / (about + sqrt (about * about + half * half));
    }
  int is_nearest[2] = { end[0].from.distance <= nearest, end[1].from.distance <= nearest };
  for (int e = 0; e < 2; e++)
    if ((both || is_nearest[e])
        && !(is_nearest[e] && !is_nearest[!e] && bars_the_way (k, j, e, &p)))
      touch_end (k, j, e, &p, end + e,
                 raise_below (raise, end[!e].from.distance - k->config->radius));
  if (!both && !is_nearest[0] && !is_nearest[1])
    bt__row_between (k, j, &p, fmin (end[0].radius, end[1].radius));
}

/* True if a constraint from FIRST on, at node I, is like R.  */
static int
is_borne (const bt__line_job *k, const bt__constraint *r, int first, double i)
{
  for (int q = first; q < k->rows; q++)
    {
      const bt__constraint *o = k->w->row + q;
      if (k->w->of[q].flat == 1 && place_of (o) == i && bt__dot (o->normal, r->normal) > COPLANAR)
        return 1;
    }
  return 0;
}

/* Drop the spare constraints of link J, from FIRST on: those between nodes bearing on a plane along
   the link, and those of edges with a sliding node.  */
static void
drop_spare (bt__line_job *k, uint32_t j, int first, int before)
{
  int n = first;
  for (int q = first; q < k->rows; q++)
    {
      const bt__constraint *r = k->w->row + q;
      int flat
          = k->w->of[q].flat == 2 && is_borne (k, r, before, j) && is_borne (k, r, before, j + 1.0);
      if (flat || (k->bents > 0 && bt__line_is_bent_about (k, q)))
        continue;
      k->w->row[n] = *r;
      k->w->of[n++] = k->w->of[q];
    }
  k->rows = n;
}

void
bt__line_rows (bt__line_job *k)
{
  double touch = k->config->radius + k->margin;
  int before = 0;
  for (uint32_t j = 0; j < (uint32_t)k->links; j++)
    {
      const bt__near *near = bt__line_near (k, j);
      int first = k->rows;
      k->wedged = bt__line_is_wedged (k, j, 1);
      for (uint32_t i = 0; i < k->w->watch[j].found; i++)
        if (near[i].w.distance < touch)
          touch_part (k, j, near + i);
      if (k->rows > first)
        drop_spare (k, j, first, before);
      before = first;
    }
}

/* ---- Hits ---- */

/* The row that the hit of link J with NEAR at S, normal N, replaces, or the next.  */
static int
row_for_hit (const bt__line_job *k, uint32_t j, const bt__near *near, double s, bt_vec3 n)
{
  for (int i = 0; i < k->rows; i++)
    {
      const bt__constraint *r = k->w->row + i;
      const bt__line_row *of = k->w->of + i;
      if (of->link == j && of->mover == near->link && of->object == near->object
          && of->slot == near->slot && fabs (r->s - s) < SAME_HIT
          && bt__dot (r->normal, n) > BT__LINE_ALIKE_HIT)
        return i;
    }
  return k->rows;
}

int
bt__line_add_hit (bt__line_job *k, uint32_t j, const bt__near *near, const bt__witness *w, double t)
{
  const bt__mover *m = bt__line_mover (k, near);
  bt_vec3 n = w->normal;
  if (m)
    {
      bt__frame to = bt__motion_at (&m->motion, 1);
      n = bt__out_of (&to, n);
    }
  int at = row_for_hit (k, j, near, w->s, n);
  if (at == k->rows && !bt__line_takes_row (k))
    return -1;
  int again = at < k->rows ? k->w->of[at].again + 1 : 0;
  k->wedged = bt__line_is_wedged (k, j, 1);
  bt__row_set (k, at, j, w->s, near, w, near->w.distance);
  k->w->of[at].again = again;
  bt__constraint *r = k->w->row + at;
  bt_vec3 moved = bt__self_move (k, r);
  r->stick = bt__scale (-t, bt__off_axis (r->normal, moved));
  k->rows += at == k->rows;
  return at;
}
