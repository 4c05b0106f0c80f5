/* Persistent contacts: friction, stiffness, and the warm start from step to step.

   A contact is recognised by its place in the material of the line and by its direction, whatever
   link, triangle or obstacle it is on now.  It keeps the stick (the spring of Coulomb friction),
   the load, the work and its age.

   A chain turns at its nodes, a line all along: with the plain coefficient the tensions before and
   after a turn D would not have the ratio e^(mu D).  The ratio is right with tanh (mu D/2) / tan
   (D/2) for a single contact in a turn, at a node or on a link between two nodes, and with sinh (mu
   D) / sin D for a contact on every link, turning D at every node.

   The stiffness follows the tension: the penetration must be small against the way from radius to
   core, or the collision detection would bear the load and nothing would slide.  The stiffness does
   not follow the load: between two obstacles (line_wedge.c) and beside sliding nodes contacts press
   on each other.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <stdlib.h>
#include <string.h>

#include "contact/line_bend.h"

#define ALIKE 0.8   /* product of the normals */
#define STIFF 30.0  /* times EA over a link's length: of contacts */
#define HARDER 30.0 /* times stiffer is what is hit although it pushes */
#define YIELD 20.0  /* the part of the way to the core that the load may press a contact in */

/* ---- Friction ---- */

/* The turn of the line at node I if it is toward the obstacle, against normal N; radians.  */
static double
turn_at (const bt__line_job *k, int64_t i, bt_vec3 n)
{
  if (i < 1 || i >= k->links)
    return 0;
  bt_vec3 none = { 0, 0, 0 };
  bt_vec3 a = bt__unit_or (bt__sub (k->x[i], k->x[i - 1]), none),
          b = bt__unit_or (bt__sub (k->x[i + 1], k->x[i]), none), turn = bt__sub (b, a);
  double size = bt__norm (turn);
  return -bt__dot (turn, n) > 0.5 * size ? 2 * asin (fmin (size / 2, 1)) : 0;
}

/* Of one contact that turns the line by D.  */
static double
single (double mu, double d)
{
  d = fmin (d, 2.5);
  return d > 1e-6 && mu > 0 ? tanh (mu * d / 2) / tan (d / 2) : mu;
}

/* Of one of many, each turning it by D.  */
static double
one_of_many (double mu, double d)
{
  d = fmin (d, 1.2);
  return d > 1e-6 ? sinh (mu * d) / sin (d) : mu;
}

/* True if a row is on link J, of the same obstacle as row I.  */
static int
has_neighbour (const bt__line_job *k, int i, int64_t j)
{
  const bt__line_row *of = k->w->of;
  for (int q = i < 8 ? 0 : i - 8; q < k->rows && q <= i + 8; q++)
    if (q != i && of[q].link == j && of[q].id == of[i].id)
      return 1;
  return 0;
}

double
bt__line_friction (const bt__line_job *k, int64_t id)
{
  const bt__line_config *c = k->config;
  return c->rough && id < c->obstacles && !isnan (c->rough[id]) ? c->rough[id] : c->friction;
}

static double
coefficient (const bt__line_job *k, int i)
{
  const bt__constraint *r = k->w->row + i;
  const bt__line_row *of = k->w->of + i;
  if (of->mover == BT__LINE_SELF)
    return bt__self_friction (k, i);
  double mu = bt__line_friction (k, of->id);
  if (r->s == 0 || r->s == 1)
    return single (mu, turn_at (k, r->node + (r->s == 1), r->normal));
  int64_t j = r->node;
  double before = turn_at (k, j, r->normal), after = turn_at (k, j + 1, r->normal);
  int left = has_neighbour (k, i, j - 1), right = has_neighbour (k, i, j + 1);
  if (!left && !right)
    return single (mu, before + after);
  double many = one_of_many (mu, 0.5 * (before + after));
  if (left && right)
    return many;
  double d = 0.5 * (left ? before : after) + (left ? after : before);
  return 0.5 * (many + single (mu, d));
}

double
bt__line_stiffness (const bt__line_job *k, int64_t i)
{
  const double *rest = bt__dynamic_rest (k->d), *tension = bt__dynamic_tension (k->d);
  const bt__line_config *c = k->config;
  double stiff = fmin (STIFF * k->in->line->ea / fmax (rest[i], k->d->piece), BT__LINE_STIFFEST);
  return fmax (stiff, YIELD * tension[i] / (c->radius - c->core));
}

/* Row I of an obstacle.  */
static void
harden (bt__line_job *k, int i)
{
  bt__constraint *r = k->w->row + i;
  double stiff = bt__line_stiffness (k, r->node);
  r->stiffness = fmin (stiff * pow (HARDER, k->w->of[i].again), fmax (stiff, BT__LINE_STIFFEST));
  bt__line_press (k, i);
}

/* ---- What is remembered ---- */

/* The distance of contact Q of the last step from constraint I, along the line and by direction:
   normals at right angles count like places REACH apart.  INFINITY for another obstacle's contact
   or beyond REACH.  */
static double
contact_distance (const bt__line_job *k, int i, int q, double reach)
{
  const bt__contact *a = k->w->old + q;
  const bt__line_row *of = k->w->of + i;
  double alike = bt__dot (a->normal, k->w->row[i].normal);
  double away = fabs (a->from_end - of->from_end) + reach * (1 - alike);
  int can = a->state >= 0 && a->mover == (int64_t)of->mover - 1 && alike > ALIKE;
  return can && away < reach ? away : INFINITY;
}

static double
memory_reach (const bt__line_job *k, int i)
{
  return BT__LINE_REMEMBER * bt__dynamic_rest (k->d)[k->w->row[i].node];
}

/* Return the contact of the last step nearest to constraint I and not taken yet, from *FROM on, or
   -1; *LEAST receives the distance.  */
static int
find_anchor (bt__line_job *k, int i, int *from, double *least)
{
  double reach = memory_reach (k, i), place = k->w->of[i].from_end;
  int best = -1;
  *least = INFINITY;
  while (*from < k->olds && k->w->old[*from].from_end > place + 2 * reach)
    ++*from;
  for (int q = *from; q < k->olds && k->w->old[q].from_end >= place - reach; q++)
    {
      double away = contact_distance (k, i, q, reach);
      if (away < *least)
        {
          best = q;
          *least = away;
        }
    }
  return best;
}

/* True if a row beside I, without an anchor yet, is nearer to anchor Q than LEAST.  */
static int
is_wanted (const bt__line_job *k, int i, int q, double least)
{
  const bt__line_row *of = k->w->of;
  for (int by = -1; by <= 1; by += 2)
    for (int r = i + by; r >= 0 && r < k->rows && abs ((int)of[r].link - (int)of[i].link) <= 1;
         r += by)
      if (of[r].fresh && of[r].mover != BT__LINE_SELF
          && contact_distance (k, r, q, memory_reach (k, r)) < least)
        return 1;
  return 0;
}

static void
inherit (bt__line_job *k, int i, const bt__contact *a)
{
  bt__constraint *r = k->w->row + i;
  if (!(r->stiffness > 0))
    {
      r->load = a->load;
      r->stick = bt__off_axis (r->normal, a->stick);
    }
  k->w->of[i].work = a->work;
  k->w->of[i].age = a->age + 1;
  k->w->of[i].fresh = 0;
}

/* Give constraint I the nearest contact of the last step; with NEAREST only if no other constraint
   is nearer to the contact.  */
static void
take_anchor (bt__line_job *k, int i, int *from, int nearest)
{
  double away;
  int is_line = k->w->of[i].mover == BT__LINE_SELF;
  int a = is_line ? bt__self_anchor (k, i) : find_anchor (k, i, from, &away);
  if (a < 0 || (nearest && !is_line && is_wanted (k, i, a, away)))
    return;
  inherit (k, i, k->w->old + a);
  k->w->old[a].state = -1; /* taken */
}

/* Match the closest pairs first; otherwise an unloaded contact inherits the friction of a loaded
   neighbour.  */
void
bt__line_inherit (bt__line_job *k)
{
  for (int nearest = 1; nearest >= 0; nearest--)
    for (int i = 0, from = 0; i < k->rows; i++)
      if (k->w->of[i].fresh)
        take_anchor (k, i, &from, nearest);
}

void
bt__line_harden (bt__line_job *k)
{
  for (int i = 0; i < k->rows; i++)
    {
      bt__constraint *r = k->w->row + i;
      if (r->stiffness > 0)
        continue;
      r->slip = BT__LINE_SLIP;
      r->friction = k->bents > 0 && bt__line_is_bent_about (k, i) ? 0 : coefficient (k, i);
      if (k->w->of[i].mover == BT__LINE_SELF)
        r->stiffness = bt__self_stiffness (k, i);
      else
        harden (k, i);
    }
}

/* ---- What is kept ---- */

/* The force of constraint R on the line: its load, and friction by STICK, full at a drag of SLIP.
   (The force of the last iteration belongs to the places before the iteration.) */
static bt_vec3
force_of (const bt__constraint *r, bt_vec3 stick)
{
  return bt__scale (r->load, bt__axpy (r->normal, -r->friction / r->slip, stick));
}

static bt__contact
anchor_of (const bt__line_job *k, int i)
{
  const bt__constraint *r = k->w->row + i;
  const bt__line_row *of = k->w->of + i;
  bt_vec3 slide = bt__off_axis (r->normal, bt__self_move (k, r)), stick = bt__add (r->stick, slide);
  double drag = bt__norm (stick), over = fmax (drag - r->slip, 0);
  double work = r->friction * r->load * over;
  if (over > 0)
    stick = bt__scale (r->slip / drag, stick);
  int is_line = of->mover == BT__LINE_SELF;
  if (r->pair > 0) /* half of it goes into either side */
    work *= 0.5;
  return (bt__contact){ .object = of->id,
                        .triangle
                        = is_line || of->triangle == BT__NO_TRIANGLE ? -1 : (int64_t)of->triangle,
                        .mover = is_line ? BT__CONTACT_LINE : (int64_t)of->mover - 1,
                        .other = of->other,
                        .state = over > 0 ? BT__TOUCH_SLIDE : BT__TOUCH_STICK,
                        .from_end = of->from_end,
                        .load = r->load,
                        .age = of->age,
                        .work = of->work + work,
                        .step_work = work,
                        .speed = bt__norm (slide) / k->h,
                        .point = of->point,
                        .normal = r->normal,
                        .force = force_of (r, stick),
                        .stick = stick };
}

static void
keep (bt__line_job *k, const bt__contact *a)
{
  bt__line_report *report = k->report;
  if (bt__line_old_room (k->w, k->olds + 1))
    bt__contacts_put (k->w->old, k->olds++, a);
  report->touches++;
  report->load = fmax (report->load, a->load);
  report->speed = fmax (report->speed, a->speed);
  report->slip_work += a->step_work;
}

/* Keep the reactions at the second places of pairs, as long as there is room.  In a heap of line
   more pairs may touch than half the room; the constraints themselves are all kept.  */
static void
keep_reactions (bt__line_job *k)
{
  for (int i = 0; i < k->rows && k->olds < k->w->rows_max; i++)
    {
      if (!(k->w->row[i].load > 0) || k->w->row[i].pair == 0)
        continue;
      bt__contact a = anchor_of (k, i);
      a = bt__self_reaction (k, &a);
      keep (k, &a);
    }
}

void
bt__line_keep (bt__line_job *k)
{
  k->olds = 0;
  for (int i = 0; i < k->rows; i++)
    {
      if (!(k->w->row[i].load > 0))
        continue;
      bt__contact a = anchor_of (k, i);
      keep (k, &a);
      k->report->meets += k->w->of[i].mover == BT__LINE_SELF;
    }
  for (int i = 0; i < k->bents; i++)
    {
      if (!bt__bend_bears (k, i))
        continue;
      bt__contact a = bt__line_bent_anchor (k, i);
      k->report->bends++;
      keep (k, &a);
    }
  keep_reactions (k);
}

void
bt__line_store (bt__line_job *k)
{
  bt__contacts *to = k->anchors;
  to->n = k->olds < to->room ? k->olds : to->room;
  memcpy (bt__contacts_at (to), k->w->old, (size_t)to->n * sizeof *k->w->old);
}
