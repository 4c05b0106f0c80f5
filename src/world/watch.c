/* The awareness cache: memory, and one solve for all questions about one state.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/error.h"
#include "math/vec.h"
#include "world/obstacles.h"
#include "world/watch.h"

enum
{
  TAUT_STEPS = 400, /* of a string from the tether's own shape */
  FREE_STEPS = 200,
  FINE_STEPS = 60, /* more, with a finer mesh: corners become arcs */
  ROOM_LEAST = 256,
  ROOM_MOST = 1 << 18 /* nodes: a gigabyte is no answer */
};

#define STRAIGHT 1e-9   /* share of the chord: a string no longer is straight */
#define FINER 0.4       /* of the mesh */
#define HOLD_REACH 0.05 /* m: an obstacle nearer than this holds a corner */

/* ---- Memory ---- */

static void
free_awareness (bt__awareness *g)
{
  free (g->node);
  free (g->taut);
  free (g->shortest);
  free (g->live);
  free (g->hold);
  free (g->wound);
  free (g->favoured);
  bt__caught_free (&g->loops);
  bt__chart_release (g->ways);
  bt__chart_release (g->words);
  bt__chart_release (g->frame);
}

void
bt__watch_free_all (struct bt__watch *w)
{
  if (!w)
    return;
  for (int i = 0; i < w->n; i++)
    free_awareness (&w->tether[i]);
  bt__taut_free (w->taut);
  free (w);
}

static struct bt__watch *
watch_of (const bt_dive *dive)
{
  size_t n = (size_t)dive->model->n_tethers;
  if (!dive->watch)
    ((bt_dive *)dive)->watch = calloc (1, sizeof (struct bt__watch) + n * sizeof (bt__awareness));
  if (dive->watch)
    dive->watch->n = (int)n;
  return dive->watch;
}

static void
retain (bt__chart *chart)
{
  if (chart)
    atomic_fetch_add (&chart->references, 1);
}

void
bt__watch_share (const bt_dive *dive, bt_dive *fork)
{
  struct bt__watch *w = dive->watch ? watch_of (fork) : NULL;
  for (int i = 0; w && i < w->n; i++)
    {
      bt__awareness *from = &dive->watch->tether[i], *to = &w->tether[i];
      to->ways = from->ways;
      to->words = from->words;
      to->frame = from->frame;
      retain (to->ways);
      retain (to->words);
      retain (to->frame);
    }
}

static int
new_string (bt__string **string, uint32_t room)
{
  free (*string);
  *string = calloc (1, bt__string_size (room));
  if (*string)
    (*string)->room = room;
  return *string != NULL;
}

bt__string *
bt__watch_string (const bt_dive *dive)
{
  bt__string *s = NULL;
  return new_string (&s, dive->watch->room) ? s : NULL;
}

/* Have room for strings of ROOM nodes.  The answers kept for all tethers are forgotten.  */
static int
make_string_room (struct bt__watch *w, uint32_t room, bt__asker *asker)
{
  if (room <= w->room)
    return 1;
  bt__taut_free (w->taut);
  w->room = 0;
  for (int i = 0; i < w->n; i++)
    w->tether[i].change = 0;
  if (bt__taut_new (room, &w->taut, NULL) != BT_OK)
    return 0;
  bt__taut_ask (w->taut, asker);
  w->room = room;
  return 1;
}

static int
make_awareness_room (const struct bt__watch *w, bt__awareness *g)
{
  if (g->taut && g->shortest && g->hold && g->taut->room == w->room)
    return 1;
  free (g->live);
  g->live = NULL;
  free (g->hold);
  g->hold = calloc (w->room, sizeof *g->hold);
  g->holds = (bt__holds){ g->hold, 0, w->room, 0 };
  return new_string (&g->taut, w->room) && new_string (&g->shortest, w->room) && g->hold;
}

/* ---- What it is among ---- */

static int
is_open (const bt__scene *scene, const bt__switches *on)
{
  for (uint32_t k = 0; k < scene->solids; k++)
    if (bt__is_on (on, scene->solid[k]))
      return 0;
  return 1;
}

/* Links of an eightieth of the tether, near obstacles, within what a string can do well.  */
static double
string_mesh (double out, double core)
{
  return fmax (fmin (out / 80, 0.6), 8 * core);
}

static bt__taut_config
string_config (const bt__chart *chart, const bt__scene *scene, double out, double diameter)
{
  double core = bt__core (diameter), mesh = string_mesh (out, core);
  return (bt__taut_config){ .scene = scene,
                            .on = &chart->on,
                            .core = 0.9 * core,
                            .want = 0.9 * core,
                            .mesh = mesh,
                            .margin = fmin (mesh, 0.4) };
}

/* As many nodes as LINE has, or comes to have while time passes.  */
static uint32_t
most_nodes (const bt__line *line)
{
  return (uint32_t)(line->chain ? line->chain->n_max + 1 : bt__line_nodes (line));
}

static int
take_line_nodes (bt__awareness *g, const bt__line *line)
{
  uint32_t n = (uint32_t)bt__line_nodes (line), most = most_nodes (line);
  if (most > g->node_room)
    {
      free (g->node);
      g->node = malloc (most * sizeof *g->node);
      g->node_room = g->node ? most : 0;
    }
  for (uint32_t k = 0; g->node && k < n; k++)
    g->node[k] = bt__line_node (line, (int)k);
  g->n = n;
  return g->node != NULL;
}

/* ---- The string ---- */

/* Set the friction of every hold to the present friction of its obstacle, or of the tether.  */
static void
set_friction (const bt_dive *dive, const bt__tether *tether, bt__holds *holds)
{
  const double *rough = bt__dive_roughness (dive, dive->now);
  for (uint32_t k = 0; k < holds->n; k++)
    {
      double own = rough[dive->model->scene->object[holds->at[k].object].id];
      holds->at[k].friction = isnan (own) ? tether->props.friction : own;
    }
}

bt_status
bt__watch_no_memory (bt_error *error)
{
  return bt__fail (error, BT_ERR_LIMIT, "no memory to watch a tether");
}

double
bt__watch_longest (const bt_dive *dive, int i)
{
  const bt__tether *tether = bt__dive_tether (dive, dive->now, i);
  bt__line line = bt__line_of (dive, dive->now, i);
  double out = fmax (bt__line_length (&line), tether->length);
  return tether->winch_rate > 0 ? fmax (out, tether->winch_target) : out;
}

/* Bound on the nodes of the taut string of a tether with N intervals and OUT m of line.  */
static double
nodes_wanted (double n, double out, double diameter)
{
  return ROOM_LEAST + 2 * n + 3 * floor (out / (FINER * string_mesh (out, bt__core (diameter))));
}

/* Have room for the string, and set the scene and the mesh of the string.  */
static bt_status
make_ready (const bt_dive *dive, int i, struct bt__watch *w, bt__awareness *g, double diameter,
            bt_error *error)
{
  bt_status status = bt__chart_ways (dive, i, g, error);
  if (status != BT_OK)
    return status;
  g->config = string_config (g->ways, dive->model->scene, g->out, diameter);
  double wanted = nodes_wanted (g->n, g->out, diameter);
  double ahead = nodes_wanted (g->node_room, bt__watch_longest (dive, i), diameter);
  if (!(wanted <= ROOM_MOST))
    return bt__fail (error, BT_ERR_LIMIT,
                     "the taut string of %g m of tether would have %g nodes; at most %d are solved",
                     g->out, wanted, ROOM_MOST);
  uint32_t room = (uint32_t)fmin (fmax (wanted, ahead), ROOM_MOST);
  return make_string_room (w, room, bt__asker_of (dive)) && make_awareness_room (w, g)
             ? BT_OK
             : bt__watch_no_memory (error);
}

/* Solve the string of tether I.  */
static void
solve_string (const bt_dive *dive, struct bt__watch *w, bt__awareness *g, const bt__tether *tether)
{
  const bt__scene *scene = dive->model->scene;
  bt__taut_config fine = g->config;
  fine.mesh *= FINER;
  bt__string_lay (g->taut, g->node, g->n);
  bt__taut_relax (w->taut, &g->config, g->taut, TAUT_STEPS, &w->count);
  bt__string_wake (g->taut);
  bt__taut_relax (w->taut, &fine, g->taut, FINE_STEPS, &w->count);
  bt__holds_find (scene, g->config.on, g->taut->x, g->taut->n, g->config.core, HOLD_REACH,
                  &g->holds, &w->count);
  set_friction (dive, tether, &g->holds);
  g->taut_length = bt__holds_length (&g->holds, g->taut->x, g->taut->n);
  ((bt_dive *)dive)->profile.strings++;
}

/* In open water the string is the chord, without a hold.  */
static void
set_open (bt__awareness *g)
{
  g->holds.n = 0;
  g->taut_length = g->free_length = bt__distance (g->node[0], g->node[g->n - 1]);
  g->has_taut = g->has_free = 1;
}

bt_status
bt__watch_look (const bt_dive *dive, int i, bt__awareness **out, bt_error *error)
{
  bt_status status = bt__check_part (dive, BT_PART_TETHER, i, error);
  if (status != BT_OK)
    return status;
  struct bt__watch *w = watch_of (dive);
  bt__awareness *g = w ? &w->tether[i] : NULL;
  if (!w)
    return bt__watch_no_memory (error);
  *out = g;
  if (g->change == dive->changes + 1)
    return BT_OK;
  bt__line line = bt__line_of (dive, dive->now, i);
  g->change = 0;
  g->has_taut = g->has_free = g->has_class = g->has_wound = 0;
  g->out = bt__line_length (&line);
  if (!take_line_nodes (g, &line))
    return bt__watch_no_memory (error);
  const uint8_t *off
      = dive->model->n_obstacles ? bt__dive_off (dive, dive->now, BT_PART_TETHER, i) : NULL;
  g->open = is_open (dive->model->scene, &(bt__switches){ off, 0 });
  if (g->open)
    set_open (g);
  else
    status = make_ready (dive, i, w, g, line.tether->props.diameter, error);
  if (status == BT_OK)
    g->change = dive->changes + 1;
  return status;
}

bt_status
bt__watch_taut (const bt_dive *dive, int i, bt__awareness **out, bt_error *error)
{
  bt_status status = bt__watch_look (dive, i, out, error);
  if (status == BT_OK && !(*out)->has_taut)
    {
      solve_string (dive, dive->watch, *out, bt__dive_tether (dive, dive->now, i));
      status = bt__stopped (bt__asker_of (dive), error);
      (*out)->has_taut = status == BT_OK;
    }
  return status;
}

static bt_status
prepare_look (const bt_dive *dive, int i, bt_error *error)
{
  bt__awareness *g;
  bt_status status = bt__watch_look (dive, i, &g, error);
  if (status == BT_OK)
    status = bt__watch_wind_ready (dive, i, g, error);
  return status == BT_OK && !g->open && g->frame->graph.edges > 0
             ? bt__chart_plant (dive, i, g, error)
             : status;
}

bt_status
bt__watch_prepare (const bt_dive *dive, bt_error *error)
{
  bt_status status = BT_OK;
  /* The last of two rounds has room enough for the strings of all.  */
  for (int round = 0; round < 2 && dive->model->n_obstacles > 0; round++)
    for (int i = 0; i < dive->model->n_tethers && status == BT_OK; i++)
      status = prepare_look (dive, i, error);
  if (dive->watch && status != BT_ERR_INTERRUPTED)
    dive->watch->ready = 1;
  return status == BT_ERR_INTERRUPTED ? status : BT_OK;
}

bt_status
bt__watch_make_ready (const bt_dive *dive, bt_error *error)
{
  int ready = dive->model->n_obstacles == 0 || (dive->watch && dive->watch->ready);
  return ready ? BT_OK : bt__watch_prepare (dive, error);
}

/* ---- The free way ---- */

bt_status
bt__watch_lay_way (const bt_dive *dive, int i, bt__awareness *g, bt_vec3 p, bt__string *way,
                   int *found, bt_error *error)
{
  struct bt__watch *w = dive->watch;
  bt_vec3 ends[2] = { g->node[0], p };
  bt__link chord = { ends[0], ends[1] };
  if (!bt__scene_within (g->config.scene, g->config.on, &chord, g->config.core, &w->count))
    {
      *found = bt__string_lay (way, ends, 2);
      return BT_OK;
    }
  *found = 0;
  bt_status status = bt__chart_plant (dive, i, g, error);
  if (status != BT_OK || !g->ways->tree)
    return status;
  if (!atomic_exchange (&g->ways->asked, 1))
    ((bt_dive *)dive)->profile.charts++;
  bt__asker *asker = bt__asker_of (dive);
  *found = bt__free_way (g->ways->tree, ends[0], ends[1], way, asker, &w->count);
  return bt__stopped (asker, error);
}

bt_status
bt__watch_tighten_way (const bt_dive *dive, const bt__awareness *g, bt__string *way, double *length,
                       bt_error *error)
{
  struct bt__watch *w = dive->watch;
  *length = way->n == 2 ? bt__distance (way->x[0], way->x[1])
                        : bt__free_tighten (w->taut, &g->config, FREE_STEPS, way, &w->count);
  return bt__stopped (bt__asker_of (dive), error);
}

/* Put the shortest way home known without the string into the way of G, and its length, m, into
 *LENGTH; INFINITY if no such way is known.  */
static bt_status
find_free_way (const bt_dive *dive, int i, bt__awareness *g, double *length, bt_error *error)
{
  int found;
  g->has_free = 0;
  bt_status status = bt__watch_lay_way (dive, i, g, g->node[g->n - 1], g->shortest, &found, error);
  *length = INFINITY;
  return status == BT_OK && found ? bt__watch_tighten_way (dive, g, g->shortest, length, error)
                                  : status;
}

/* Find the free way: the shorter of the way home and the string.  A straight string is the free way
   itself, and no tree is asked.  */
bt_status
bt__watch_free (const bt_dive *dive, int i, bt__awareness **out, bt_error *error)
{
  bt_status status = bt__watch_taut (dive, i, out, error);
  bt__awareness *g = *out;
  if (status != BT_OK || g->has_free)
    return status;
  double length = INFINITY, chord = bt__distance (g->node[0], g->node[g->n - 1]);
  if (g->taut_length > (1 + STRAIGHT) * chord)
    status = find_free_way (dive, i, g, &length, error);
  if (status != BT_OK)
    return status;
  if (!(length < g->taut_length))
    {
      memcpy (g->shortest, g->taut, bt__string_size (g->taut->n));
      g->shortest->room = dive->watch->room;
      length = g->taut_length;
    }
  g->free_length = length;
  g->has_free = 1;
  return BT_OK;
}

/* ---- The word ---- */

static void
word_of (const bt__chart *chart, const bt_vec3 *p, uint32_t n, bt__word *word, bt__count *count)
{
  if (chart->shadow)
    bt__shadow_word (chart->shadow, p, n, word);
  else
    bt__voxels_word (chart->voxels, p, n, word, count);
}

bt_status
bt__watch_class (const bt_dive *dive, int i, bt__awareness **out, bt_error *error)
{
  bt_status status = bt__watch_free (dive, i, out, error);
  bt__awareness *g = *out;
  if (status != BT_OK || g->has_class)
    return status;
  bt__word_begin (&g->word, 0, 1);
  bt__word_end (&g->word);
  if (!g->open)
    {
      struct bt__watch *w = dive->watch;
      status = bt__chart_words (dive, i, g, error);
      if (status != BT_OK)
        return status;
      bt__word own, way;
      word_of (g->words, g->node, g->n, &own, &w->count);
      if (own.lost)
        word_of (g->words, g->taut->x, g->taut->n, &own, &w->count);
      word_of (g->words, g->shortest->x, g->shortest->n, &way, &w->count);
      bt__word_relative (&own, &way, &g->word);
      ((bt_dive *)dive)->profile.words++;
    }
  g->has_class = 1;
  return BT_OK;
}
