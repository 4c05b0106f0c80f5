/* A step of the moving line with contact: among obstacles, other lines and its own bights.

   The step itself is in contact/line.h.  This file provides the surroundings of the line and their
   friction, and notes the contacts afterwards.  A world without obstacles is an empty scene.

   Tethers step one after another.  Each tether sees the tethers before it at their new places and
   the tethers after it at their old places.  So no two tethers move at once, and if each step
   passes through nothing, nothing is passed through.  Of two tethers that move together, pressed to
   each other, the one in front goes first; otherwise it would stand in the other's way.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <math.h>

#include "math/vec.h"
#include "sim/around.h"
#include "sim/chain.h"
#include "world/obstacles.h"

#define STANDS 5e-6 /* m: an end that is nearer to its vehicle is there */

/* How hard the other tethers of VEHICLE pulled along the unit vector U at the start of the step, N.
 */
static double
pull_of_others (const bt_dive *dive, int i, int vehicle, bt_vec3 u)
{
  double sum = 0;
  for (int j = 0; j < dive->model->n_tethers; j++)
    for (int k = 0; k < 2 && j != i; k++)
      if (dive->model->ends[j][k].vehicle == vehicle)
        {
          bt__line line = bt__line_of (dive, dive->now, j);
          sum += bt__dot (bt__line_pull (&line, k), u);
        }
  return sum;
}

double
bt__most_pull_at (const bt_dive *dive, bt__state *state, int i, int k)
{
  int vehicle = dive->model->ends[i][k].vehicle;
  if (vehicle < 0
      || (dive->contact_work.pin && dive->contact_work.pin[vehicle].how == BT__PIN_HARD))
    return INFINITY;
  const bt__vehicle *v = bt__dive_vehicle (dive, state, vehicle);
  if (v->rigid || dive->model->n_tethers == 1)
    return v->pull;
  bt__line line = bt__line_of (dive, dive->now, i);
  bt_vec3 u = bt__unit_or (bt__line_pull (&line, k), bt__vec (0, 0, 0));
  return v->pull + fmax (0, -pull_of_others (dive, i, vehicle, u));
}

int
bt__slips_at (const bt_dive *dive, bt__state *state, int i, int k)
{
  int vehicle = dive->model->ends[i][k].vehicle;
  if (vehicle < 0
      || (dive->contact_work.pin && dive->contact_work.pin[vehicle].how == BT__PIN_HARD))
    return 0;
  const bt__vehicle *v = bt__dive_vehicle (dive, state, vehicle);
  return !v->rigid && v->goal != BT__GOAL_TRACK;
}

/* True if tether I touches tether J, which may be I.  */
static int
touches_tether (const bt_dive *dive, bt__state *state, int i, int j)
{
  return !bt__passes_tether (dive, state, i, j);
}

static double
inertia_of (const bt__state *state, const bt_tether_props *p)
{
  return p->mass + p->ca * state->density * BT__PI / 4 * p->diameter * p->diameter;
}

/* True if PART K of tether J, OTHER, is to step after PART of tether I in the present step.  */
static int
yields (const bt_dive *dive, const bt__state *state, int i, int part, const bt__tether *other,
        int j, int k)
{
  int later = i == j ? k < part : dive->contact_work.place[j] > dive->contact_work.place[i];
  return later && state->step != dive->now->step && bt__is_awake (other);
}

/* True if PART of tether I has the end E of the tether that is made fast.  */
static int
has_end (const bt_dive *dive, bt__state *state, int i, int part, int e)
{
  return part == (e && bt__dive_tether (dive, state, i)->parted);
}

/* True if end E of tether I and end F of tether J are made fast at the same place: at one vehicle,
   or at points no farther apart than the lines are thick, whatever waves do with either.  */
static int
are_made_fast_together (const bt_dive *dive, int i, int e, int j, int f)
{
  const bt_model *model = dive->model;
  const bt__end *a = &model->ends[i][e], *b = &model->ends[j][f];
  const bt_tether_def *p = &model->tethers[i], *q = &model->tethers[j];
  if (a->vehicle >= 0 || b->vehicle >= 0)
    return a->vehicle == b->vehicle;
  return bt__distance (a->at, b->at) <= 0.5 * (p->props.diameter + q->props.diameter);
}

/* Note in STRAND, part K of tether J, the ends that coincide with an end of PART of tether I.  */
static void
share_ends (const bt_dive *dive, bt__state *state, int i, int part, int j, int k,
            bt__strand *strand)
{
  if (i == j) /* the two parts of a cut line lie end to end */
    strand->shared[part == 0] = 1 + (k == 0);
  for (int e = 0; e < 2; e++)
    for (int f = 0; f < 2 && i != j; f++)
      if (are_made_fast_together (dive, i, e, j, f) && has_end (dive, state, i, part, e)
          && has_end (dive, state, j, k, f))
        strand->shared[e] = f + 1;
}

/* Put the moving lines that PART of tether I touches among the dive's strands; return how many
   there are.  */
static int
gather_strands (const bt_dive *dive, bt__state *state, int i, int part)
{
  int n = 0;
  for (int j = 0; !dive->contact_work.alone && j < dive->model->n_tethers; j++)
    {
      bt__state *from = bt__are_apart (dive, i, j) ? dive->now : state;
      const bt__tether *other = bt__dive_tether (dive, from, j);
      if (!bt__is_cable (other) || !touches_tether (dive, state, i, j)
          || bt__is_out_of_sight (dive, state, j))
        continue;
      for (int k = 0; k < bt__chains (other); k++)
        if (j != i || k != part)
          {
            bt__strand *strand = dive->contact_work.strand + n++;
            *strand = (bt__strand){ .line = bt__dive_chain (dive, from, j, k),
                                    .anchors = bt__dive_anchors (dive, from, j, k),
                                    .box = j == i ? NULL : dive->contact_work.box + 2 * j + k,
                                    .inertia = inertia_of (state, &other->props),
                                    .yields = yields (dive, state, i, part, other, j, k),
                                    .id = dive->model->n_obstacles + j,
                                    .radius = other->props.diameter / 2,
                                    .core = bt__core (other->props.diameter),
                                    .friction = other->props.friction };
            share_ends (dive, state, i, part, j, k, strand);
          }
    }
  return n;
}

static bt__line_config
line_config (const bt_dive *dive, bt__state *state, int i, int part)
{
  const bt__tether *tether = bt__dive_tether (dive, state, i);
  const bt_tether_props *props = &tether->props;
  bt__line_config config
      = { .radius = props->diameter / 2,
          .core = bt__core (props->diameter),
          .friction = props->friction,
          .pull = { bt__most_pull_at (dive, state, i, 0), bt__most_pull_at (dive, state, i, 1) },
          .slips = { bt__slips_at (dive, state, i, 0), bt__slips_at (dive, state, i, 1) },
          .rough = bt__dive_roughness (dive, state),
          .obstacles = dive->model->n_obstacles,
          .itself = touches_tether (dive, state, i, i),
          .id = dive->model->n_obstacles + i,
          .strand = dive->contact_work.strand,
          .strands = gather_strands (dive, state, i, part) };
  return config;
}

/* The workspace knows one line at a time.  */
static void
take_up (bt_dive *dive, int i, int part)
{
  int line = 2 * i + part;
  if (dive->contact_work.line_of != line)
    bt__line_work_forget (dive->contact_work.line);
  dive->contact_work.line_of = line;
}

double
bt__spare_among_lines (bt_dive *dive, bt__state *state, int i, int part)
{
  bt__line_config config = line_config (dive, state, i, part);
  take_up (dive, i, part);
  return bt__line_work_spare (dive->contact_work.line, bt__dive_chain (dive, state, i, part),
                              &config);
}

void
bt__note_line_meetings (const bt_dive *dive, bt__state *state, int i, int part)
{
  bt__subject *subject = bt__dive_subject (dive, state, BT_PART_TETHER, i);
  const bt__contacts *anchors = bt__dive_anchors (dive, state, i, part);
  const bt__contact *anchor = bt__contacts_at (anchors);
  for (int64_t k = 0; k < anchors->n; k++)
    if (anchor[k].load > 0)
      bt__note_meeting (state, subject, BT_PART_TETHER, i, (int)anchor[k].object);
}

/* True if end K of tether I was held, or slipped in this part of the step or in one before.  */
static int
is_left_behind (const bt_dive *dive, bt__state *state, int i, int k, const bt__line_report *report)
{
  if (report->held[k] || !bt__slips_at (dive, state, i, k))
    return report->held[k];
  bt_vec3 here = bt__attachment (dive, state, dive->model->ends[i][k].vehicle);
  return bt__distance (report->end[k], here) > STANDS;
}

static void
bring_held_ends (const bt_dive *dive, bt__state *state, int i, int part,
                 const bt__line_report *report)
{
  int parted = bt__dive_tether (dive, state, i)->parted != 0;
  if (part == 0 && is_left_behind (dive, state, i, 0, report))
    bt__bring_end (dive, state, i, 0, report->end[0]);
  if ((part == 1 || !parted) && is_left_behind (dive, state, i, 1, report))
    bt__bring_end (dive, state, i, 1, report->end[1]);
}

static void
add_up_report (bt_profile *profile, const bt__line_report *report)
{
  profile->touches += (uint64_t)report->touches;
  profile->contact_rounds += (uint64_t)report->rounds;
  profile->truncated += report->truncated > 0;
  profile->line_pairs += (uint64_t)report->pairs;
  profile->chain_vain += (uint64_t)report->vain;
}

bt_status
bt__step_among (bt_dive *dive, bt__state *state, int i, int part, const bt__dynamic_input *input,
                bt__dynamic_report *report, bt_error *error)
{
  bt__contacts *anchors = bt__dive_anchors (dive, state, i, part);
  bt__surroundings around = bt__surround (dive, state, BT_PART_TETHER, i);
  bt__surround_by_hulls (dive, state, i, &around);
  bt__line_config config = line_config (dive, state, i, part);
  bt__line_report touch = { 0 };
  bt_status status;
  take_up (dive, i, part);
  bt__store_changes (dive, i);
  status = bt__line_step (bt__dive_chain (dive, state, i, part), dive->work,
                          dive->contact_work.line, input, &around, &config, anchors, report, &touch,
                          &dive->contact_work.count, error);
  if (status != BT_OK)
    return status;
  bt__around_done (dive);
  bt__hulls_done (dive, i);
  bt__note_line_meetings (dive, state, i, part);
  if (dive->contact_work.left == 0 && !dive->contact_work.alone)
    bring_held_ends (dive, state, i, part, &touch);
  add_up_report (&dive->profile, &touch);
  return BT_OK;
}

void
bt__wake_touched (const bt_dive *dive, bt__state *state, int i, int part)
{
  const bt__contacts *anchors = bt__dive_anchors (dive, state, i, part);
  const bt__contact *anchor = bt__contacts_at (anchors);
  for (int64_t k = 0; k < anchors->n; k++)
    {
      int j = (int)anchor[k].object - dive->model->n_obstacles;
      if (anchor[k].mover == BT__CONTACT_LINE && bt__are_apart (dive, i, j))
        dive->context->refused = 1;
      else if (anchor[k].mover == BT__CONTACT_LINE)
        bt__dive_tether (dive, state, j)->quiet = 0;
    }
}

/* ---- In which order ---- */

/* How tether I goes where it presses on tether J: toward that, or from it if less than 0; W.  */
static double
push_towards (const bt_dive *dive, bt__state *state, int i, int j)
{
  const bt__dynamic *chain = bt__dive_chain (dive, state, i, 0);
  const bt__contacts *anchors = bt__dive_anchors (dive, state, i, 0);
  const bt__contact *a = bt__contacts_at (anchors);
  double sum = 0, length = bt__dynamic_length (chain);
  for (int64_t k = 0; k < anchors->n; k++)
    if (a[k].mover == BT__CONTACT_LINE && a[k].object == dive->model->n_obstacles + j)
      sum -= a[k].load
             * bt__dot (a[k].normal, bt__dynamic_velocity (chain, length - a[k].from_end));
  return sum;
}

static int
goes_behind (const bt_dive *dive, bt__state *state, int i, int j)
{
  const bt__tether *a = bt__dive_tether (dive, state, i), *b = bt__dive_tether (dive, state, j);
  return bt__is_cable (a) && bt__is_cable (b) && !bt__is_ahead (a) && !bt__is_ahead (b)
         && push_towards (dive, state, i, j) > push_towards (dive, state, j, i);
}

void
bt__order_tethers (bt_dive *dive, bt__state *state)
{
  int *order = dive->contact_work.order, n = dive->model->n_tethers;
  for (int i = 0; i < n; i++)
    {
      int at = i;
      for (; at > 0 && goes_behind (dive, state, order[at - 1], i); at--)
        order[at] = order[at - 1];
      order[at] = i;
    }
  for (int i = 0; i < n; i++)
    dive->contact_work.place[order[i]] = i;
}
