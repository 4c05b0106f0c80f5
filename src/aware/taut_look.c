/* Before a step: the mesh, and the planes between links and near obstacles.

   Near obstacles links are of about the mesh size, elsewhere as long as possible.  A node is
   dropped if the triangle of the node and its neighbours is clear.  Far from obstacles the distance
   of both links, compared with the height of the triangle, decides; near an obstacle the new link
   is tested.

   For every link the parts within the margin are listed, and each part gives a plane: normal along
   the shortest way from the part to the link, at the core's distance from the part, or through the
   link's nearer node where the link is closer already (hard), and at the wanted distance (soft).
   Since a part is convex and the link lies on one side, the plane separates the two; parts of equal
   normals share a plane.  A link keeps its 16 nearest planes.  Parts without a plane bound the
   moves of the link's nodes to 0.9 of their distance less the core (t->most), so no node reaches an
   unlisted part within the step.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <string.h>

#include "aware/taut_job.h"

/* Planes lie farther out than the core by this, m: rounding never enters the core.  */
#define SPARE 1e-6

enum
{
  LINKS_A_QUESTION = 256 /* looked at between two questions whether to go on */
};

static double
link_length (const bt__string *s, uint32_t i)
{
  return bt__distance (s->x[i], s->x[i + 1]);
}

static void
drop_node (bt__string *s, uint32_t j)
{
  memmove (s->x + j, s->x + j + 1, (s->n - j - 1) * sizeof *s->x);
  s->n--;
}

static void
split_link (bt__string *s, uint32_t i)
{
  bt_vec3 middle = bt__scale (0.5, bt__add (s->x[i], s->x[i + 1]));
  memmove (s->x + i + 2, s->x + i + 1, (s->n - i - 1) * sizeof *s->x);
  s->x[i + 1] = middle;
  s->n++;
}

/* The height of node J over the chord of its neighbours.  */
static double
node_height (const bt__string *s, uint32_t j)
{
  bt_vec3 chord = bt__sub (s->x[j + 1], s->x[j - 1]), arm = bt__sub (s->x[j], s->x[j - 1]);
  double base = bt__norm (chord), area = bt__norm (bt__cross (chord, arm));
  double near = fmin (bt__norm (arm), bt__distance (s->x[j], s->x[j + 1]));
  return base > near ? area / base : near; /* folded back: no farther than the nearer neighbour */
}

/* True if node J can go: its links are short and their triangle is clear.  */
static int
can_drop_near (const bt__taut_config *c, const bt__string *s, uint32_t j, bt__count *count)
{
  if (link_length (s, j - 1) + link_length (s, j) >= c->mesh)
    return 0;
  bt__link chord = { s->x[j - 1], s->x[j + 1] };
  return !bt__scene_within (c->scene, c->on, &chord, node_height (s, j) + c->core + SPARE, count);
}

/* ---- Sides ---- */

/* The plane of a witness, through the link's own nodes where they are nearer than the core.  */
static bt__side
side_of_witness (const bt__taut_config *c, const bt__witness *w, bt_vec3 a, bt_vec3 b)
{
  double at = bt__dot (w->normal, w->point);
  double own = fmin (bt__dot (w->normal, a), bt__dot (w->normal, b));
  return (bt__side){ w->normal, fmin (at + c->core + SPARE, own), at + c->want + SPARE };
}

/* Add the side at the end of the list, unless link I has a side with the same normal.  */
static void
add_side (bt__taut *t, uint32_t i, const bt__side *side)
{
  uint32_t end = t->first[i + 1];
  for (uint32_t k = t->first[i]; k < end; k++)
    if (bt__dot (t->side[k].normal, side->normal) > 1 - 1e-12)
      {
        t->side[k].hard = fmax (t->side[k].hard, side->hard);
        t->side[k].soft = fmax (t->side[k].soft, side->soft);
        return;
      }
  t->side[t->first[i + 1]++] = *side;
}

static void
sort_nearest (bt__near *at, uint32_t n)
{
  for (uint32_t i = 1; i < n; i++)
    {
      bt__near held = at[i];
      uint32_t k = i;
      for (; k > 0 && at[k - 1].w.distance > held.w.distance; k--)
        at[k] = at[k - 1];
      at[k] = held;
    }
}

/* Take the nearest of LIST as the sides of link I; t->first[i] is set.  */
static void
take_sides (bt__taut *t, const bt__taut_config *c, const bt__string *s, uint32_t i, bt__nears *list)
{
  t->first[i + 1] = t->first[i];
  if (list->n > BT__PLANES_A_LINK)
    sort_nearest (list->at, list->n);
  double unlisted = fmin (c->margin, list->dropped);
  for (uint32_t k = 0; k < list->n; k++)
    {
      if (t->first[i + 1] - t->first[i] == BT__PLANES_A_LINK)
        {
          unlisted = fmin (unlisted, list->at[k].w.distance);
          break;
        }
      bt__side side = side_of_witness (c, &list->at[k].w, s->x[i], s->x[i + 1]);
      add_side (t, i, &side);
    }
  t->unlisted[i] = unlisted;
}

static void
look_about (bt__taut *t, const bt__taut_config *c, const bt__string *s, uint32_t i, bt__nears *list,
            bt__count *count)
{
  bt__link link = { s->x[i], s->x[i + 1] };
  *list = (bt__nears){ t->near, 0, BT__NEARS_A_LINK, INFINITY };
  bt__scene_near (c->scene, c->on, &link, i, c->margin, list, count);
}

/* Join the links I - 1 and I, both far from everything, if their triangle is clear too.  */
static int
join_far (bt__taut *t, const bt__taut_config *c, bt__string *s, uint32_t i)
{
  if (c->whole || t->first[i - 1] != t->first[i])
    return 0;
  double clear = fmin (t->unlisted[i - 1], t->unlisted[i]), h = node_height (s, i);
  if (!(clear - h > 0.5 * c->margin + c->core))
    return 0;
  drop_node (s, i);
  t->unlisted[i - 1] = clear - h;
  return 1;
}

int
bt__taut_look (bt__taut *t, const bt__taut_config *c, bt__string *s, bt__count *count)
{
  bt__nears list;
  t->first[0] = 0;
  for (uint32_t i = 0; i + 1 < s->n;)
    {
      if (i % LINKS_A_QUESTION == 0 && bt__ask (t->asker))
        return 0;
      while (i + 2 < s->n && can_drop_near (c, s, i + 1, count))
        drop_node (s, i + 1);
      look_about (t, c, s, i, &list, count);
      if (s->n < s->room && (list.n > 0 || c->whole) && link_length (s, i) > 1.5 * c->mesh)
        {
          split_link (s, i);
          continue;
        }
      take_sides (t, c, s, i, &list);
      if (i == 0 || list.n > 0 || !join_far (t, c, s, i))
        i++;
    }
  for (uint32_t j = 1; j + 1 < s->n; j++)
    t->most[j] = fmax (0.9 * (fmin (t->unlisted[j - 1], t->unlisted[j]) - c->core - SPARE), 0);
  return 1;
}
