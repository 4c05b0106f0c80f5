/* What a tether is doing: the answers from its taut string, its windings and its word.

   Each question asks the awareness cache (watch.h) for as much as needed: the string for taut
   length, wrap angle and capstan; the free way for the excess; windings or the word for fouling.
   Turns need the tether's own nodes only.  Several questions about one state share one string.

   A tether is fouled if its taut string is longer than its free way by 1 m and by 5 %.  Fouled is
   `wound' if a winding is not 0 or the word relative to the free way is decided and not empty: then
   only flying back round frees the line.  Otherwise the line is `hung': it may slip or be lifted
   off.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include <bight/contact.h>

#include "aware/knot.h"
#include "aware/turns.h"
#include "base/error.h"
#include "math/vec.h"
#include "world/obstacles.h"
#include "world/watch.h"

enum
{
  CONTACTS_MAX = 4096
};

/* Excess beyond both is fouled: m, and a share of the free length.  */
#define FOULED_BY 1.0
#define FOULED_SHARE 0.05

/* ---- Lengths ---- */

bt_status
bt_tether_taut_length (const bt_dive *dive, int i, double *length, bt_error *error)
{
  bt__awareness *g;
  bt_status status = bt__watch_taut (dive, i, &g, error);
  if (status == BT_OK)
    *length = g->taut_length;
  return status;
}

bt_status
bt_tether_is_taut (const bt_dive *dive, int i, int *taut, bt_error *error)
{
  bt__awareness *g;
  bt_status status = bt__watch_look (dive, i, &g, error);
  if (status != BT_OK)
    return status;
  const bt__tether *tether = bt__dive_tether (dive, dive->now, i);
  *taut = tether->taut != 0;
  if (*taut || g->open || tether->parted) /* nothing holds the end of a parted one */
    return BT_OK;
  status = bt__watch_taut (dive, i, &g, error);
  if (status == BT_OK)
    *taut = bt__is_taut (g->taut_length, g->out);
  return status;
}

bt_status
bt_tether_free_length (const bt_dive *dive, int i, double *length, bt_error *error)
{
  bt__awareness *g;
  bt_status status = bt__watch_free (dive, i, &g, error);
  if (status == BT_OK)
    *length = g->free_length;
  return status;
}

/* Metres of line from contact C to its neighbour OTHER, one of either part or NULL; at most an
   interval of its part.  */
static double
to_neighbour (const bt_contact *c, const bt_contact *other, const double *interval)
{
  double most = interval[c->tail != 0];
  return other && other->tail == c->tail ? fmin (fabs (other->s - c->s), most) : most;
}

/* A contact stands for the line to half way to its neighbours.  */
static double
contact_length (const bt_contact *c, int n, int k, const double *interval)
{
  return 0.5
         * (to_neighbour (c + k, k > 0 ? c + k - 1 : NULL, interval)
            + to_neighbour (c + k, k + 1 < n ? c + k + 1 : NULL, interval));
}

static double
mean_interval (const bt__line *line)
{
  return bt__line_length (line) / fmax (1, bt__line_nodes (line) - 1);
}

bt_status
bt_tether_contact_length (const bt_dive *dive, int i, int obstacle, int sliding, double *length,
                          bt_error *error)
{
  bt_status status = bt__check_part (dive, BT_PART_TETHER, i, error);
  if (status == BT_OK && obstacle >= 0)
    status = bt__check_part (dive, BT_PART_OBSTACLE, obstacle, error);
  if (status != BT_OK)
    return status;
  *length = 0;
  if (dive->model->n_obstacles == 0)
    return BT_OK;
  bt_contact *c = malloc (sizeof *c * CONTACTS_MAX);
  if (!c)
    return bt__fail (error, BT_ERR_LIMIT, "no memory for contacts");
  bt__line line = bt__line_of (dive, dive->now, i), tail = bt__line_tail (&line);
  double interval[] = { mean_interval (&line), line.tether->parted ? mean_interval (&tail) : 0 };
  int n = bt_tether_contacts (dive, i, c, CONTACTS_MAX);
  n = n < CONTACTS_MAX ? n : CONTACTS_MAX;
  for (int k = 0; k < n; k++)
    if ((obstacle < 0 || c[k].object == obstacle) && (!sliding || c[k].slides))
      *length += contact_length (c, n, k, interval);
  free (c);
  return BT_OK;
}

/* ---- Turns ---- */

/* The axis of OBSTACLE, where it is now.  */
static bt_status
obstacle_axis (const bt_dive *dive, int obstacle, bt__axis *axis, bt_error *error)
{
  bt_status status = bt__check_part (dive, BT_PART_OBSTACLE, obstacle, error);
  if (status != BT_OK)
    return status;
  const bt__obstacle *shape = bt__model_shape (dive->model, obstacle);
  int k = bt__model_carried (dive->model, obstacle);
  if (!bt__axis_of (shape, axis))
    return bt__fail (error, BT_ERR_UNSUPPORTED,
                     "`%s' is level ground and has no axis that a tether could go round",
                     dive->model->obstacles[obstacle].name);
  if (k >= 0)
    {
      const bt__frame *frame = &bt__dive_movers (dive, dive->now)[k].frame;
      int round = shape->kind == BT__OBSTACLE_CYLINDER || shape->kind == BT__OBSTACLE_CAPSULE;
      axis->at = bt__to_world (frame, axis->at);
      if (round)
        axis->along = bt__out_of (frame, axis->along);
    }
  return BT_OK;
}

/* The tether's own nodes are enough: no string is solved.  */
bt_status
bt_tether_turns (const bt_dive *dive, int i, int obstacle, double *turns, bt_error *error)
{
  bt__axis axis;
  bt_status status = bt__check_part (dive, BT_PART_TETHER, i, error);
  if (status == BT_OK)
    status = obstacle_axis (dive, obstacle, &axis, error);
  if (status != BT_OK)
    return status;
  bt__line line = bt__line_of (dive, dive->now, i);
  bt_vec3 ends[2] = { bt__line_node (&line, 0) };
  *turns = 0;
  for (int k = 1; k < bt__line_nodes (&line); k++, ends[0] = ends[1])
    {
      ends[1] = bt__line_node (&line, k);
      *turns += bt__turns (&axis, ends, 2);
    }
  return BT_OK;
}

bt_status
bt_tether_winding (const bt_dive *dive, int i, int obstacle, int *winding, bt_error *error)
{
  bt__axis axis;
  bt__awareness *g;
  bt_status status = bt__check_part (dive, BT_PART_TETHER, i, error);
  if (status == BT_OK)
    status = obstacle_axis (dive, obstacle, &axis, error);
  if (status == BT_OK)
    status = bt__watch_wound (dive, i, &g, error);
  if (status == BT_OK)
    *winding = g->wound[obstacle];
  return status;
}

bt_status
bt_tether_wrap_angle (const bt_dive *dive, int i, int obstacle, double *radians, bt_error *error)
{
  bt__awareness *g;
  bt_status status = bt__watch_taut (dive, i, &g, error);
  if (status == BT_OK && obstacle >= 0)
    status = bt__check_part (dive, BT_PART_OBSTACLE, obstacle, error);
  if (status != BT_OK)
    return status;
  *radians = 0;
  for (uint32_t k = 0; k < g->holds.n; k++)
    {
      const bt__corner *h = &g->holds.at[k];
      if (obstacle < 0 || (int)dive->model->scene->object[h->object].id == obstacle)
        *radians += h->angle;
    }
  return BT_OK;
}

bt_status
bt_tether_capstan_lock (const bt_dive *dive, int i, double *lock, bt_error *error)
{
  bt__awareness *g;
  bt_status status = bt__watch_taut (dive, i, &g, error);
  if (status == BT_OK)
    *lock = bt__holds_lock (&g->holds);
  return status;
}

/* ---- Classes ---- */

/* The obstacle that LETTER goes round, or -1.  */
static int32_t
object_of (const bt_dive *dive, const bt__chart *chart, int32_t letter)
{
  uint32_t place = chart->shadow ? bt__shadow_object (chart->shadow, letter) : UINT32_MAX;
  return place == UINT32_MAX ? -1 : (int32_t)dive->model->scene->object[place].id;
}

bt_status
bt_tether_class (const bt_dive *dive, int i, bt_class *out, bt_error *error)
{
  bt__awareness *g;
  bt_status status = bt__watch_class (dive, i, &g, error);
  if (status != BT_OK)
    return status;
  memset (out, 0, sizeof *out);
  out->world = g->word.world;
  out->letters = (int32_t)g->word.n;
  out->decided = g->word.decided != 0;
  out->lost = g->word.lost != 0;
  for (int k = 0; k < out->letters; k++)
    {
      out->letter[k] = g->word.letter[k];
      out->object[k] = object_of (dive, g->words, g->word.letter[k]);
    }
  return BT_OK;
}

int
bt_class_equal (const bt_class *a, const bt_class *b)
{
  return !a->lost && !b->lost && a->world == b->world && a->letters == b->letters
         && memcmp (a->letter, b->letter, sizeof a->letter) == 0;
}

bt_status
bt_tether_knotted (const bt_dive *dive, int i, int *knotted, bt_error *error)
{
  bt__knot *knot = NULL;
  bt__knot_value value;
  bt_status status = bt__check_part (dive, BT_PART_TETHER, i, error);
  if (status != BT_OK)
    return status;
  bt__line line = bt__line_of (dive, dive->now, i);
  int n = bt__line_nodes (&line), known;
  bt_vec3 *node = malloc ((size_t)n * sizeof *node);
  if (!node || bt__knot_new ((uint32_t)n, &knot, error) != BT_OK)
    {
      free (node);
      return bt__fail (error, BT_ERR_LIMIT, "no memory to look for a knot");
    }
  for (int k = 0; k < n; k++)
    node[k] = bt__line_node (&line, k);
  bt__knot_ask (knot, bt__asker_of (dive));
  known = bt__knot_of (knot, node, (uint32_t)n, &value);
  bt__knot_free (knot);
  free (node);
  status = bt__stopped (bt__asker_of (dive), error);
  if (status != BT_OK)
    return status;
  if (!known)
    return bt__fail (error, BT_ERR_UNSUPPORTED,
                     "the tether crosses itself more than %d times: nobody can tell",
                     BT__KNOT_CROSSINGS);
  *knotted = value.knotted != 0;
  return BT_OK;
}

/* ---- Fouled ---- */

bt_status
bt_tether_fouled (const bt_dive *dive, int i, bt_foul *foul, bt_error *error)
{
  bt__awareness *g;
  bt_status status = bt__watch_free (dive, i, &g, error);
  *foul = BT_FOUL_NOT;
  if (status != BT_OK
      || !(g->taut_length - g->free_length > fmax (FOULED_BY, FOULED_SHARE * g->free_length)))
    return status;
  status = bt__watch_wound (dive, i, &g, error);
  if (status == BT_OK && !g->is_wound) /* words see what windings do not */
    status = bt__watch_class (dive, i, &g, error);
  int wound = g->is_wound || (g->word.decided && !g->word.lost && g->word.n > 0);
  if (status == BT_OK)
    *foul = wound ? BT_FOUL_WOUND : BT_FOUL_HUNG;
  return status;
}
