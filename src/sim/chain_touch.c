/* A step of the moving line among obstacles.

   The step is contact/line.h's; here it is given what surrounds the line and how rough that is, and
   what it met is noted.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <math.h>

#include "sim/around.h"
#include "sim/chain.h"
#include "world/obstacles.h"

/* What pulls end K of tether I to its place: a vehicle with its pull, a fixed point whatever it
   takes.  */
static double
pull_at (const bt_dive *dive, bt__state *state, int i, int k)
{
  int vehicle = dive->model->ends[i][k].vehicle;
  if (vehicle < 0 || dive->shore.pin[vehicle].how == BT__PIN_HARD)
    return INFINITY;
  return bt__dive_vehicle (dive, state, vehicle)->pull;
}

static bt__line_config
config_of (const bt_dive *dive, bt__state *state, int i)
{
  const bt_tether_props *props = &bt__dive_tether (dive, state, i)->props;
  return (bt__line_config){ .radius = props->diameter / 2,
                            .core = bt__core (props->diameter),
                            .friction = props->friction,
                            .rough = bt__dive_roughness (dive, state),
                            .obstacles = dive->model->n_obstacles,
                            .pull = { pull_at (dive, state, i, 0), pull_at (dive, state, i, 1) } };
}

/* The workspace knows one line at a time.  */
static void
take_up (bt_dive *dive, int i, int part)
{
  int line = 2 * i + part;
  if (dive->shore.line_of != line)
    bt__line_work_forget (dive->shore.line);
  dive->shore.line_of = line;
}

static void
note_meetings (const bt_dive *dive, bt__state *state, int i, const bt__anchors *anchors)
{
  bt__subject *subject = bt__dive_subject (dive, state, BT_PART_TETHER, i);
  const bt__anchor *anchor = bt__anchors_at (anchors);
  for (int64_t k = 0; k < anchors->n; k++)
    if (anchor[k].load > 0)
      bt__note_meeting (state, subject, BT_PART_TETHER, i, (int)anchor[k].object);
}

static void
bring_ends (const bt_dive *dive, bt__state *state, int i, int part, const bt__line_report *report)
{
  int parted = bt__dive_tether (dive, state, i)->parted != 0;
  if (part == 0 && report->held[0])
    bt__bring_end (dive, state, i, 0, report->end[0]);
  if ((part == 1 || !parted) && report->held[1])
    bt__bring_end (dive, state, i, 1, report->end[1]);
}

static void
add_up (bt_profile *profile, const bt__line_report *report)
{
  profile->touches += (uint64_t)report->touches;
  profile->contact_rounds += (uint64_t)report->rounds;
  profile->truncated += report->truncated > 0;
}

bt_status
bt__step_among (bt_dive *dive, bt__state *state, int i, int part, const bt__dynamic_input *input,
                bt__dynamic_report *report, bt_error *error)
{
  bt__anchors *anchors = bt__dive_anchors (dive, state, i, part);
  bt__surroundings around = bt__surround (dive, state, BT_PART_TETHER, i);
  bt__line_config config = config_of (dive, state, i);
  bt__line_report touch = { 0 };
  bt_status status;
  take_up (dive, i, part);
  status
      = bt__line_step (bt__dive_chain (dive, state, i, part), dive->work, dive->shore.line, input,
                       &around, &config, anchors, report, &touch, &dive->shore.count, error);
  if (status != BT_OK)
    return status;
  bt__around_done (dive);
  note_meetings (dive, state, i, anchors);
  bring_ends (dive, state, i, part, &touch);
  add_up (&dive->profile, &touch);
  return BT_OK;
}
