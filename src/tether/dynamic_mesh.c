/* The moving line: how many intervals, and where, while a winch turns.

   Line paid out would be one long interval when no more nodes can come, and line hauled in would be
   left with few.  So nodes go where they are most dispensable, and come where they are missed most.

   An interval of length h is weighed by (kappa^2 + kappa0^2) h^3, kappa the curvature of the line:
   the arc is longer than its chord by kappa^2 h^3 / 24.  Merging the intervals of least weight and
   halving the intervals of greatest weight makes all weights alike, and nodes as dense as (kappa^2
   + kappa0^2)^(1/3) (equidistribution, C. de Boor 1973). kappa0, a few radians over the whole
   length, keeps nodes on straight reaches, which may bend soon.

   A lump at a point is shared out between the two nodes of its interval, and the line has a corner
   there.  If one of the nodes went, or a node came between them, the load would jump from node to
   node, and the tension with it.  So both nodes stay, and so do their neighbours; from there on the
   mesh grows coarser.  A corner is no curvature: its effect on differences is no reason for a node.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <math.h>
#include <string.h>

#include "math/vec.h"
#include "tether/dynamic_kernel.h"

#define LEAST_BEND 4.0 /* radians over the whole line: what a straight reach counts as bent by */
#define STEEPEST 2.5   /* times as long as its neighbour: the most that a merged interval is */
#define GOOD 0.25      /* of the error aimed at: a better mesh can spare nodes */

/* The interval of D in which the point FROM_END metres from the far end lies.  */
static int64_t
interval_of (const bt__dynamic *d, double from_end)
{
  const double *rest = bt__dynamic_rest (d);
  int64_t j = d->n - 1;
  while (j > 0 && from_end > rest[j])
    from_end -= rest[j--];
  return j;
}

void
bt__dynamic_keep_lumps (const bt__dynamic *d, const bt__dynamic_input *in, int wide, uint8_t *kept)
{
  for (int k = 0; k < in->n_lumps; k++)
    {
      int64_t j = interval_of (d, in->lumps[k].from_end);
      for (int64_t i = j - wide; i <= j + 1 + wide && in->lumps[k].span == 0; i++)
        if (i >= 0 && i <= d->n)
          kept[i] = 1;
    }
}

int
bt__dynamic_is_open (const bt__dynamic *d, const bt__dynamic_mesh *mesh)
{
  return d->n < (mesh->most > 0 && mesh->most < d->n_max ? mesh->most : d->n_max);
}

/* The square of the curvature at inner node I, and of the least that counts, 1/m2.  */
static double
bend_at (const bt__dynamic *d, int64_t i, double least)
{
  const bt_vec3 *x = bt__dynamic_x (d) + i;
  const double *rest = bt__dynamic_rest (d) + i;
  if (i < 1 || i >= d->n)
    return least;
  bt_vec3 before = bt__scale (1 / rest[-1], bt__sub (x[0], x[-1])),
          after = bt__scale (1 / rest[0], bt__sub (x[1], x[0]));
  bt_vec3 turn = bt__sub (after, before);
  double cell = 0.5 * (rest[-1] + rest[0]);
  return bt__dot (turn, turn) / (cell * cell) + least;
}

static double
least_bend (const bt__dynamic *d)
{
  double least = LEAST_BEND / bt__dynamic_length (d);
  return least * least;
}

/* True if the intervals about node I may become one, which their neighbours are not much shorter
   than.  */
static int
is_graded (const bt__dynamic *d, int64_t i)
{
  const double *rest = bt__dynamic_rest (d);
  double whole = rest[i - 1] + rest[i], before = i > 2 ? rest[i - 2] : whole,
         after = i + 1 < d->n ? rest[i + 1] : whole;
  return whole <= STEEPEST * fmin (before, after);
}

static int64_t
spare_node (const bt__dynamic *d, const uint8_t *kept, int graded)
{
  const double *rest = bt__dynamic_rest (d);
  double least = least_bend (d), lightest = INFINITY;
  int64_t found = 0;
  for (int64_t i = 2; i < d->n; i++)
    {
      double whole = rest[i - 1] + rest[i], weight = bend_at (d, i, least) * whole * whole * whole;
      if (weight < lightest && !(kept && kept[i]) && (!graded || is_graded (d, i)))
        {
          lightest = weight;
          found = i;
        }
    }
  return found;
}

int64_t
bt__dynamic_spare_node (const bt__dynamic *d, const uint8_t *kept)
{
  int64_t i = spare_node (d, kept, 1);
  return i > 0 ? i : spare_node (d, kept, 0);
}

int64_t
bt__dynamic_worst_interval (const bt__dynamic *d, const bt__dynamic_mesh *mesh, const uint8_t *kept)
{
  const double *rest = bt__dynamic_rest (d);
  double least = least_bend (d), heaviest = 0;
  int64_t found = 0;
  for (int64_t j = 1; j < d->n; j++)
    {
      double bend = fmax (bend_at (d, j, least), bend_at (d, j + 1, least));
      double weight = bend * rest[j] * rest[j] * rest[j];
      if (weight > heaviest && rest[j] >= 2 * mesh->shortest && !(kept && (kept[j] || kept[j + 1])))
        {
          heaviest = weight;
          found = j;
        }
    }
  return found;
}

int
bt__dynamic_wants (const bt__dynamic *d, const bt__dynamic_mesh *mesh, const uint8_t *corner)
{
  int open = bt__dynamic_is_open (d, mesh);
  if (d->n < mesh->fewest)
    return open;
  if (!(mesh->error > 0))
    return 0;
  double error = bt__dynamic_space_error (d, corner);
  return error > mesh->error ? open : error < GOOD * mesh->error && d->n > mesh->fewest ? -1 : 0;
}

void
bt__dynamic_refit (bt__dynamic *d)
{
  d->piece = bt__dynamic_length (d) / (double)d->n;
}

static void
take_out (bt__dynamic *d, int64_t i)
{
  if (i < 1)
    return;
  bt__dynamic_remove (d, i);
  bt__dynamic_refit (d);
}

static void
halve (bt__dynamic *d, int64_t j)
{
  if (j < 1)
    return;
  bt__dynamic_split (d, j, 0.5, 0);
  bt__dynamic_refit (d);
}

/* Flag in the spare flags of W what bt__dynamic_keep_lumps does, and return them; NULL if nothing
   is lumped.  */
static const uint8_t *
lumped (const bt__dynamic *d, bt__dynamic_work *w, const bt__dynamic_input *in, int wide)
{
  if (in->n_lumps == 0)
    return NULL;
  memset (w->kept, 0, (size_t)d->n + 1);
  bt__dynamic_keep_lumps (d, in, wide, w->kept);
  return w->kept;
}

static void
spare_one (bt__dynamic *d, bt__dynamic_work *w, const bt__dynamic_input *in)
{
  take_out (d, bt__dynamic_spare_node (d, lumped (d, w, in, 1)));
}

static void
tune (bt__dynamic *d, bt__dynamic_work *w, const bt__dynamic_input *in)
{
  const uint8_t *corner = lumped (d, w, in, 0);
  int wants = bt__dynamic_wants (d, &in->mesh, corner);
  if (wants > 0)
    halve (d, bt__dynamic_worst_interval (d, &in->mesh, corner));
  else if (wants < 0)
    spare_one (d, w, in);
}

static void
wind_once (bt__dynamic *d, const bt__dynamic_turn *next, const bt__dynamic_input *in)
{
  if (next->way < 0)
    bt__dynamic_remove (d, 1);
  else if (next->lump)
    bt__dynamic_split_at_lump (d, next->first, in);
  else
    bt__dynamic_split_first (d, next, next->straight);
}

void
bt__dynamic_wind (bt__dynamic *d, bt__dynamic_work *w, const bt__dynamic_input *in)
{
  bt__dynamic_turn next;
  while ((next = bt__dynamic_winding (d, in)).way != 0)
    {
      if (next.way > 0 && !bt__dynamic_is_open (d, &in->mesh))
        spare_one (d, w, in);
      if (next.way > 0 && d->n >= d->n_max)
        break;
      wind_once (d, &next, in);
      for (int t = 0; t < BT__DYNAMIC_TUNES; t++)
        tune (d, w, in);
    }
  if (in->mesh.idle)
    tune (d, w, in);
}
