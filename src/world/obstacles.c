/* The part of a dive's state that knows of obstacles: layout, switches, surroundings, meetings.

   Pairs: every vehicle and every tether is a subject with one byte for each object that may be
   switched off.  Shapes of the scene come first, then kinematic obstacles, then tethers, so the
   bytes can be handed to a scene as they are.  The version of a subject is a hash of its bytes, 0
   if all are on: caches of clearances and charts are valid as long as the version stays the same.

   Surroundings are the scene, the switches of one subject, and the kinematic obstacles, each with
   the motion of the present step (bt__surround) or standing (bt__standing).

   Meetings: a subject remembers the obstacles that it touched, with the step of the last touch.
   The first touch raises the event `touched'; `left' follows after 30 steps without a touch, since
   a tether that bounces has not left.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <math.h>
#include <string.h>

#include "base/hash.h"
#include "math/vec.h"
#include "world/obstacles.h"

/* Steps without a touch before a subject has left an obstacle: a tether that bounces has not left.
 */
enum
{
  LEFT_AFTER = 30
};

/* ---- Layout: movers, roughness, then for each vehicle and each tether its subject and bytes ----
 */

int
bt__objects (const bt_model *model)
{
  return model->n_obstacles + model->n_floors + model->n_tethers + model->n_hulls;
}

static size_t
off_size (const bt_model *model)
{
  return ((size_t)bt__objects (model) + 7) / 8 * 8;
}

size_t
bt__subject_size (const bt_model *model)
{
  return sizeof (bt__subject) + 2 * off_size (model);
}

size_t
bt__roughness_at (const bt_model *model)
{
  return sizeof (bt__mover_state) * (size_t)model->n_carried;
}

static size_t
roughness_size (const bt_model *model)
{
  return sizeof (double) * (size_t)model->n_obstacles;
}

size_t
bt__subjects_at (const bt_model *model)
{
  return bt__roughness_at (model) + roughness_size (model);
}

size_t
bt__obstacles_size (const bt_model *model)
{
  size_t subjects = (size_t)(model->n_vehicles + model->n_tethers);
  return bt__subjects_at (model) + subjects * bt__subject_size (model);
}

static char *
section (const bt_dive *dive, bt__state *state)
{
  return bt__state_body (dive, state) + dive->layout.section;
}

bt__mover_state *
bt__dive_movers (const bt_dive *dive, bt__state *state)
{
  return (bt__mover_state *)(void *)section (dive, state);
}

double *
bt__dive_roughness (const bt_dive *dive, bt__state *state)
{
  return (double *)(void *)(section (dive, state) + bt__roughness_at (dive->model));
}

bt__subject *
bt__dive_subject (const bt_dive *dive, bt__state *state, bt_part part, int i)
{
  size_t k = (size_t)(part == BT_PART_VEHICLE ? i : dive->model->n_vehicles + i);
  return (bt__subject *)(void *)(bt__state_body (dive, state) + dive->layout.subjects
                                 + k * dive->layout.subject);
}

uint8_t *
bt__dive_off (const bt_dive *dive, bt__state *state, bt_part part, int i)
{
  return (uint8_t *)(bt__dive_subject (dive, state, part, i) + 1);
}

int8_t *
bt__dive_told (const bt_dive *dive, bt__state *state, int i)
{
  return (int8_t *)bt__dive_off (dive, state, BT_PART_TETHER, i) + off_size (dive->model);
}

void
bt__obstacles_init (const bt_dive *dive, bt__state *state)
{
  const bt_model *model = dive->model;
  for (int k = 0; k < model->n_carried; k++)
    bt__dive_movers (dive, state)[k].frame = bt__carried_frame (model, k, 0);
  bt__pairs_change (dive);
  for (int i = 0; i < model->n_obstacles; i++)
    bt__dive_roughness (dive, state)[i] = model->obstacles[i].friction;
}

/* ---- Pairs ---- */

/* The number of shapes in the scene.  */
static int
still_of (const bt_model *model)
{
  return model->n_obstacles - model->n_carried + model->n_floors;
}

int
bt__obstacle_slot (const bt_model *model, int obstacle)
{
  if (obstacle >= model->n_obstacles)
    return obstacle + model->n_floors;
  int where = model->where[obstacle], still = still_of (model);
  return where >= 0 ? where : still + (-1 - where);
}

/* A seabed and the bottom about it are one obstacle.  */
void
bt__switch_slot (const bt_model *model, uint8_t *off, int obstacle, int on)
{
  off[bt__obstacle_slot (model, obstacle)] = (uint8_t)!on;
  if (model->n_floors && obstacle < model->n_obstacles
      && model->obstacles[obstacle].kind == BT_OBSTACLE_SEABED)
    off[still_of (model) - 1] = (uint8_t)!on;
}

/* Equal switches have equal versions, so caches about a scene are kept by version.  */
uint64_t
bt__pairs_version (const bt_model *model, const uint8_t *off)
{
  size_t n = (size_t)bt__objects (model);
  return memchr (off, 1, n) ? bt__hash (off, n, 1) | 1 : 0;
}

void
bt__switch_pair (const bt_dive *dive, bt__state *state, bt_part part, int i, int obstacle, int on)
{
  const bt_model *model = dive->model;
  bt__subject *subject = bt__dive_subject (dive, state, part, i);
  uint8_t *off = bt__dive_off (dive, state, part, i);
  size_t n = (size_t)bt__objects (model);
  bt__pairs_change (dive);
  if (obstacle < 0)
    memset (off, !on, n);
  else
    bt__switch_slot (model, off, obstacle, on);
  subject->version = bt__pairs_version (model, off);
}

int
bt__passes_tether (const bt_dive *dive, bt__state *state, int i, int j)
{
  int slot = bt__obstacle_slot (dive->model, dive->model->n_obstacles + j);
  return bt__dive_off (dive, state, BT_PART_TETHER, i)[slot];
}

int
bt__passes_hull (const bt_dive *dive, bt__state *state, int i, int vehicle)
{
  int slot = bt__obstacle_slot (dive->model, bt__hull_number (dive->model, vehicle));
  return bt__dive_off (dive, state, BT_PART_TETHER, i)[slot];
}

/* ---- Surroundings ---- */

bt__motion
bt__motion_part (const bt__motion *motion, double since, double until)
{
  bt__frame from = since > 0 ? bt__motion_at (motion, since) : motion->from;
  bt__frame to = bt__motion_at (motion, until);
  return since > 0 || until < 1 ? bt__motion_between (&from, &to) : *motion;
}

/* Fill the workspace with the surroundings in which the objects of OFF do not count.  */
static bt__surroundings
surround (const bt_dive *dive, bt__state *state, bt__switches off, int standing)
{
  const bt_model *model = dive->model;
  bt__contact_work *shore = &((bt_dive *)dive)->contact_work;
  shore->on = off;
  for (int k = 0; k < model->n_carried; k++)
    {
      const bt__carried *carried = &model->carried[k];
      const bt__frame *here = &bt__dive_movers (dive, state)[k].frame;
      bt__course *course = &shore->course[k];
      course->on
          = (bt__switches){ off.off ? off.off + bt__obstacle_slot (model, carried->obstacle) : NULL,
                            off.version };
      shore->mover[k]
          = (bt__mover){ .body = carried->body,
                         .on = &course->on,
                         .motion
                         = standing ? bt__motion_between (here, here)
                                    : bt__motion_part (&course->whole, course->share * shore->since,
                                                       course->share * (1 - shore->left)),
                         .radius = carried->radius,
                         .done = 1 };
    }
  return (bt__surroundings){ .scene = model->scene,
                             .on = &shore->on,
                             .mover = shore->mover,
                             .movers = (uint32_t)model->n_carried };
}

static bt__switches
switches_of (const bt_dive *dive, bt__state *state, bt_part part, int i)
{
  const bt__subject *subject = bt__dive_subject (dive, state, part, i);
  return (bt__switches){ subject->version ? bt__dive_off (dive, state, part, i) : NULL,
                         subject->version };
}

bt__surroundings
bt__surround (const bt_dive *dive, bt__state *state, bt_part part, int i)
{
  return surround (dive, state, switches_of (dive, state, part, i), 0);
}

bt__surroundings
bt__standing (const bt_dive *dive, bt__state *state, bt_part part, int i)
{
  return surround (dive, state, switches_of (dive, state, part, i), 1);
}

bt__surroundings
bt__all_standing (const bt_dive *dive, bt__state *state)
{
  return surround (dive, state, (bt__switches){ 0 }, 1);
}

/* ---- Meetings ---- */

static bt__meeting *
find_meeting (bt__subject *subject, int obstacle)
{
  for (int64_t k = 0; k < subject->n; k++)
    if (subject->meeting[k].object == obstacle)
      return &subject->meeting[k];
  return NULL;
}

void
bt__note_meeting (bt__state *state, bt__subject *subject, bt_part part, int i, int obstacle)
{
  bt__meeting *meeting = find_meeting (subject, obstacle);
  if (!meeting && subject->n < BT__MEETINGS_MAX)
    {
      meeting = &subject->meeting[subject->n++];
      meeting->object = obstacle;
      bt__raise_event_at (state, BT_EVENT_TOUCHED, part, i, obstacle);
    }
  if (meeting)
    meeting->last = state->step;
}

void
bt__note_partings (bt__state *state, bt__subject *subject, bt_part part, int i)
{
  int64_t kept = 0;
  if (subject->n == 0)
    return;
  for (int64_t k = 0; k < subject->n; k++)
    {
      bt__meeting meeting = subject->meeting[k];
      if (state->step - meeting.last < LEFT_AFTER)
        subject->meeting[kept++] = meeting;
      else
        bt__raise_event_at (state, BT_EVENT_LEFT, part, i, (int)meeting.object);
    }
  memset (&subject->meeting[kept], 0, sizeof (bt__meeting) * (size_t)(subject->n - kept));
  subject->n = kept;
}

int
bt__meets (const bt__state *state, const bt__subject *subject, int obstacle)
{
  const bt__meeting *meeting = find_meeting ((bt__subject *)subject, obstacle);
  return meeting && meeting->last == state->step;
}
