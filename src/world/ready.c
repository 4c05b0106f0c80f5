/* The spare state of a dive and the workspaces of its solvers and contacts.

   The first operation of a dive makes them: a fork for questions alone is a state and little else.
   The workspaces make their own arrays when a line needs the arrays.  When memory is out, the
   operation fails, and the next operation tries again.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <stdlib.h>
#include <string.h>

#include "base/error.h"
#include "tether/equilibrium.h"
#include "world/layout.h"
#include "world/obstacles.h"

/* The most that a tether of MODEL has of ROOM.  */
static int
most_of (const bt_model *model, int (*room) (const bt_tether_def *))
{
  int most = 0;
  for (int i = 0; i < model->n_tethers; i++)
    {
      int its = room (&model->tethers[i]);
      most = its > most ? its : most;
    }
  return most;
}

/* The most intervals of a chain, and nodes of a polyline, that a tether of MODEL may have.  */
static int
most_links (const bt_model *model)
{
  return most_of (model, bt__chain_room);
}

static int
most_points (const bt_model *model)
{
  return most_of (model, bt__polyline_room);
}

/* Make the workspaces any tether of the model may come to need: its model may change while it
   dives.  */
static int
make_tools (bt_dive *dive)
{
  int most = most_links (dive->model);
  size_t points = (size_t)most + 1 + 2 * BT__SPLITS_MAX;
  if (most == 0)
    return 1;
  dive->tools.search = bt_search_new ();
  dive->tools.steady = bt_steady_new (most); /* as many as a chain comes to */
  dive->work = bt__dynamic_work_new (most);
  if (!dive->tools.search || !dive->tools.steady || !dive->work)
    return 0;
  bt__steady_ask (dive->tools.steady, &dive->asker);
  bt__dynamic_ask (dive->work, &dive->asker);
  return (dive->polyline = malloc (points * sizeof *dive->polyline))
         && (dive->along = malloc (points * sizeof *dive->along))
         && (dive->over = malloc (points * sizeof *dive->over))
         && (dive->motion = malloc (points * sizeof *dive->motion))
         && (dive->corner = malloc (points * sizeof *dive->corner))
         && (dive->fit = malloc (points * sizeof *dive->fit));
}

/* What a step has of each vehicle and each tether: contexts borrow it.  */
static int
make_rows (bt_dive *dive)
{
  const bt_model *model = dive->model;
  bt__contact_work *shore = &dive->contact_work;
  size_t vehicles = (size_t)model->n_vehicles + 1, tethers = (size_t)model->n_tethers + 1;
  return (dive->driven = calloc (vehicles, sizeof *dive->driven))
         && (shore->pin = calloc (vehicles, sizeof *shore->pin))
         && (shore->order = calloc (tethers, sizeof *shore->order))
         && (shore->place = calloc (tethers, sizeof *shore->place))
         && (shore->barred = calloc (tethers, sizeof *shore->barred));
}

/* Make the workspaces of contact: for lines with each other; then those for obstacles.  */
static int
make_shore (bt_dive *dive)
{
  const bt_model *model = dive->model;
  bt__contact_work *shore = &dive->contact_work;
  size_t parts = 2 * (size_t)model->n_tethers + 1, links = (size_t)most_links (model) + 1;
  size_t pairs = (size_t)model->n_tethers * (size_t)model->n_hulls;
  shore->line_of = shore->safe_of = -1;
  if (!(shore->line = bt__line_work_new ((int)links, bt__model_among (model)))
      || !(shore->strand = calloc (parts, sizeof *shore->strand))
      || !(shore->box = calloc (parts, sizeof *shore->box))
      || !(shore->by_hull = calloc (pairs + 1, sizeof *shore->by_hull)))
    return 0;
  return model->n_obstacles == 0
         || ((shore->node = malloc (links * sizeof *shore->node))
             && (shore->share = malloc (links * sizeof *shore->share))
             && bt__polyline_work_new ((uint32_t)most_points (model) + 1,
                                       (uint32_t)model->n_carried, &shore->polyline, NULL)
                    == BT_OK);
}

static void
clear_shore (bt__contact_work *shore)
{
  void *parts[] = { shore->by_hull, shore->pin,    shore->strand, shore->box,  shore->order,
                    shore->place,   shore->barred, shore->node,   shore->share };
  for (size_t i = 0; i < sizeof parts / sizeof *parts; i++)
    free (parts[i]);
  bt__line_work_free (shore->line);
  bt__polyline_work_free (shore->polyline);
  bt__safe_free (shore->safe);
  shore->by_hull = shore->barred = NULL;
  shore->order = shore->place = NULL;
  shore->pin = NULL;
  shore->strand = NULL;
  shore->box = NULL;
  shore->node = NULL;
  shore->share = NULL;
  shore->line = NULL;
  shore->polyline = NULL;
  shore->safe = NULL;
}

void
bt__dive_clear_up (bt_dive *dive)
{
  void *parts[] = { dive->polyline, dive->motion, dive->corner, dive->along,
                    dive->over,     dive->fit,    dive->driven, dive->next };
  for (size_t i = 0; i < sizeof parts / sizeof *parts; i++)
    free (parts[i]);
  bt_search_free (dive->tools.search);
  bt_steady_free (dive->tools.steady);
  bt__dynamic_work_free (dive->work);
  clear_shore (&dive->contact_work);
  dive->tools = (bt__shape_tools){ 0 };
  dive->work = NULL;
  dive->polyline = dive->motion = dive->corner = NULL;
  dive->along = dive->over = NULL;
  dive->fit = NULL;
  dive->driven = NULL;
  dive->next = NULL;
}

bt_status
bt__dive_ready (bt_dive *dive, bt_error *error)
{
  if (dive->next)
    return BT_OK;
  size_t size = dive->context ? sizeof (bt__state) : dive->size;
  if (make_tools (dive) && make_shore (dive) && (dive->context || make_rows (dive))
      && (dive->next = malloc (size)))
    return BT_OK;
  bt__dive_clear_up (dive);
  return bt__fail (error, BT_ERR_LIMIT, "no memory for the workspaces of a dive");
}

bt_status
bt__dive_safe (bt_dive *dive, bt_error *error)
{
  int links = most_links (dive->model), nodes = most_points (dive->model);
  if (dive->contact_work.safe)
    return BT_OK;
  return bt__safe_new ((uint32_t)(links > nodes ? links : nodes) + 1, BT__PARTS_MAX,
                       &dive->contact_work.safe, error);
}
