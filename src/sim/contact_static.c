/* A static tether among obstacles: split into spans at contacts, or held.

   The thesis' models are split at each contact (contact/thesis.h).  The models `elastic' and
   `steady' have no contact forces: the line stops at a contact, and the vehicle with the line
   (contact/held.h).

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <math.h>
#include <string.h>

#include "base/error.h"
#include "math/vec.h"
#include "sim/around.h"
#include "sim/form_step.h"
#include "sim/lay.h"
#include "world/obstacles.h"

enum
{
  /* Of which the obstacles are noted; a line split more often meets the same ones.  */
  TOUCHES_MAX = 512
};

/* The workspace of safe steps knows one line at a time.  */
static bt__way
workspace_for (bt_dive *dive, const bt__tether *tether, int i, const bt__surroundings *around)
{
  if (dive->contact_work.safe_of != i)
    bt__safe_forget (dive->contact_work.safe);
  dive->contact_work.safe_of = i;
  return (bt__way){ .around = around,
                    .core = bt__core (tether->props.diameter),
                    .safe = dive->contact_work.safe,
                    .work = dive->contact_work.polyline,
                    .count = &dive->contact_work.count,
                    .asker = &dive->asker };
}

/* ---- Laying: from a chain, from the other kind, from the world's line of lay ---- */

/* Put the *N corners of tether I on the dive's polyline, forget the shape of the former form, and
   give tether I FORM.  */
static bt_status
begin_anew (bt_dive *dive, bt__state *state, int i, const bt__ends *ends, bt__tether_form form,
            int *n, bt_error *error)
{
  bt__tether *tether = bt__dive_tether (dive, state, i);
  bt_status status = bt__corners (dive, state, i, ends, n, error);
  if (status != BT_OK)
    return status;
  if (bt__tether_form_of (tether) != BT__TETHER_SHAPE)
    memset (&tether->shape, 0, sizeof tether->shape);
  tether->contact_form = form;
  tether->blocked = 0;
  tether->stale = 1;
  bt__store_changes (dive, i);
  return BT_OK;
}

static bt_status
lay_spans (bt_dive *dive, bt__state *state, int i, const bt__ends *ends, bt_error *error)
{
  int n = 0;
  bt_status status = begin_anew (dive, state, i, ends, BT__TETHER_SPANS, &n, error);
  if (status != BT_OK)
    return status;
  return bt__thesis_lay (bt__dive_thesis (dive, state, i),
                         (uint32_t)dive->model->tethers[i].props.nodes, dive->polyline, (uint32_t)n,
                         bt__dive_tether (dive, state, i)->length, error);
}

static bt_status
lay_held (bt_dive *dive, bt__state *state, int i, const bt__ends *ends, bt_error *error)
{
  const bt_tether_def *def = &dive->model->tethers[i];
  int n = 0;
  bt_status status = begin_anew (dive, state, i, ends, BT__TETHER_HELD, &n, error);
  if (status != BT_OK)
    return status;
  return bt__polyline_lay (bt__dive_held (dive, state, i), (uint32_t)bt__polyline_room (def),
                           dive->polyline, (uint32_t)n, bt__dive_tether (dive, state, i)->length,
                           (uint32_t)def->props.nodes, error);
}

/* ---- Split ---- */

/* Of the N touches that there are TOUCH holds as many as fit.  */
static void
note_meetings (const bt_dive *dive, bt__state *state, int i, const bt__touch *touch, int n)
{
  bt__subject *subject = bt__dive_subject (dive, state, BT_PART_TETHER, i);
  for (int k = 0; k < n && k < TOUCHES_MAX; k++)
    bt__note_meeting (state, subject, BT_PART_TETHER, i, (int)touch[k].object);
}

static void
bring_ends (const bt_dive *dive, bt__state *state, int i, const bt__ends *wanted, bt_vec3 a,
            bt_vec3 b)
{
  bt__tether *tether = bt__dive_tether (dive, state, i);
  tether->shape.a = a;
  tether->shape.b = b;
  tether->shape.length = tether->length;
  if (bt__distance (a, wanted->a) > 0)
    bt__bring_end (dive, state, i, 0, a);
  if (bt__distance (b, wanted->b) > 0)
    bt__bring_end (dive, state, i, 1, b);
}

static bt_status
go_split (bt_dive *dive, bt__state *state, int i, const bt__ends *ends, const bt__way *way,
          bt_error *error)
{
  bt__tether *tether = bt__dive_tether (dive, state, i);
  bt__thesis *spans = bt__dive_thesis (dive, state, i);
  bt_water water = bt__dive_water (dive, state);
  bt__thesis_rules rules = bt__thesis_rules_of (&tether->props);
  bt__thesis_input input = { .a = ends->a,
                             .b = ends->b,
                             .length = tether->length,
                             .pull = bt__pull_on (dive, state, i),
                             .stale = tether->stale || bt_water_is_unsteady (&water),
                             .props = &tether->props,
                             .rules = &rules,
                             .water = &water,
                             .tools = &dive->tools,
                             .counts = &dive->counts };
  bt__thesis_report report;
  bt__touch touch[TOUCHES_MAX];
  bt_status status
      = bt__thesis_step (spans, &input, way, &dive->contact_work.thesis, &report, error);
  if (status != BT_OK)
    return status;
  tether->length = report.length;
  tether->tension_max = bt__thesis_tension_max (spans);
  tether->stale = 0;
  tether->settled = 1;
  tether->blocked = report.held != 0;
  bt__note_taut (state, tether, i, report.taut);
  bring_ends (dive, state, i, ends, report.a, report.b);
  note_meetings (dive, state, i, touch, bt__thesis_touches (spans, touch, TOUCHES_MAX));
  return BT_OK;
}

/* Step tether I by GO with the obstacles about it.  */
static bt_status
step_among_obstacles (bt_dive *dive, bt__state *state, int i, const bt__ends *ends,
                      bt_status (*go) (bt_dive *dive, bt__state *state, int i, const bt__ends *ends,
                                       const bt__way *way, bt_error *error),
                      bt_error *error)
{
  bt__surroundings around;
  bt_status status = bt__dive_safe (dive, error);
  if (status != BT_OK)
    return status;
  bt__store_changes (dive, i);
  around = bt__surround (dive, state, BT_PART_TETHER, i);
  bt__way way = workspace_for (dive, bt__dive_tether (dive, state, i), i, &around);
  status = go (dive, state, i, ends, &way, error);
  bt__around_done (dive);
  return status;
}

static bt_status
step_spans (bt_dive *dive, bt__state *state, int i, const bt__ends *ends, bt_error *error)
{
  return step_among_obstacles (dive, state, i, ends, go_split, error);
}

/* Spans slide while nothing else moves.  */
static int
spans_rest (const bt_dive *dive, bt__state *state, int i, const bt__ends *ends)
{
  (void)dive, (void)state, (void)i, (void)ends;
  return 0;
}

const bt__form_step bt__step_spans = { lay_spans, step_spans, step_spans, spans_rest };

/* ---- Held ---- */

static bt_status
go_held (bt_dive *dive, bt__state *state, int i, const bt__ends *ends, const bt__way *way,
         bt_error *error)
{
  bt__tether *tether = bt__dive_tether (dive, state, i);
  bt__polyline *line = bt__dive_held (dive, state, i);
  bt__held_report report;
  bt__touch touch[TOUCHES_MAX];
  bt_status status = bt__solve_static (dive, state, i, ends, error);
  if (status != BT_OK)
    return status;
  bt__held_step (line, way, &tether->shape, bt__dive_nodes (dive, state, i),
                 bt__dive_tensions (dive, state, i), &report);
  tether->blocked = report.held != 0;
  if (report.held)
    {
      bt__ends here = { report.a, report.b };
      tether->length
          = bt__polyline_u (line)[line->n - 1]; /* what came in or went out on that way */
      note_meetings (dive, state, i, touch,
                     bt__held_touches (line, way, tether->props.diameter, touch, TOUCHES_MAX));
      /* The tension is that of the shape between the ends where they are.  */
      status = bt__solve_static (dive, state, i, &here, error);
      tether->stale = 1;
    }
  bring_ends (dive, state, i, ends, report.a, report.b);
  return status;
}

static int
held_rests (const bt_dive *dive, bt__state *state, int i, const bt__ends *ends)
{
  return bt__is_unchanged (dive, state, bt__dive_tether (dive, state, i), ends);
}

static bt_status
step_held (bt_dive *dive, bt__state *state, int i, const bt__ends *ends, bt_error *error)
{
  if (!held_rests (dive, state, i, ends) || bt__movers_move (dive))
    return step_among_obstacles (dive, state, i, ends, go_held, error);
  dive->profile.shape_skips++;
  return BT_OK;
}

const bt__form_step bt__step_held = { lay_held, step_held, step_held, held_rests };
