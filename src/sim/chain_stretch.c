/* A stretch: several steps of the dive through which a moving line is taken in one solve.

   The dive's clock stays.  Where all is calm a line of model `auto' is solved ahead, for up to a
   second, and each step of the dive then tells the line from the places and velocities at both
   ends of the stretch (tether/dynamic_dense.c).  Of the line the state holds the end of the stretch
   alone, and how many steps of the stretch are gone.  A question about the line brings a copy of
   the line to the present first: a state is the same to the bit however often the dive was asked,
   saved or forked.

   A stretch takes five things for granted: sticks, autopilots and tracks alone move the ends of the
   line, no obstacle moves, the water is steady, the winch stands, no line comes near
   (chain_apart.c).  An operation on anything but a vehicle ends the stretch.  Each step compares
   the ends with the stretch and looks for obstacles on their way; where the stretch is wrong, the
   line is stepped on from the present, as last told.

   The error of the last stretch says how many steps the next stretch takes: the difference of the
   solution from the predictor (Milne's device; Hairer, Norsett, Wanner, Solving Ordinary
   Differential Equations I, III.5) grows with the cube of the step.  Two more bounds are the
   distance of the tensions from the straight ways told within the stretch, and the way of a node
   clear of everything.  No stretch is more than twice as long as the step before.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <math.h>

#include "math/vec.h"
#include "sim/around.h"
#include "sim/chain.h"
#include "world/layout.h"

#define LATE 0.05 /* of the accuracy: the error of the steps of a second, at most, ... */
#define AT_ONCE                                                                                    \
  0.25           /* s: ... and of one step that of so long, for errors to and fro add up to none */
#define BOW 0.25 /* of the accuracy: how far a tension may be off its straight way */
#define ASTRAY 0.01  /* of the accuracy: how far an end may be from where the stretch has it */
#define REACHED 5e-6 /* m: an end that is nearer to its place is there, as in pins.c */
#define FOLLOWED 0.9 /* of the steps that the error would allow */
#define GROWTH 2     /* times as long as the step before */
#define CALM 2e-4    /* m/s: slower, a line is about to sleep, which costs nothing at all */
#define SETTLED 1e-3 /* m/s */
enum
{
  SHORTER = 4 /* a stretch that was refused is tried so many times shorter */
};

/* ---- May it be? ---- */

/* True if the end K of tether I goes where it is taken, whatever the line does, and nothing turns
   it.  */
static int
is_led (const bt_dive *dive, bt__state *state, int i, int k)
{
  int v = dive->model->ends[i][k].vehicle;
  return v < 0
         || (!bt__dive_vehicle (dive, state, v)->rigid
             && !bt__is_clamped (&dive->model->tethers[i], k));
}

/* True if no other tether is fastened to a vehicle of tether I.  */
static int
has_own_vehicles (const bt_dive *dive, int i)
{
  const bt_model *model = dive->model;
  int own = 1;
  for (int j = 0; j < model->n_tethers; j++)
    for (int k = 0; k < 2 && j != i; k++)
      for (int e = 0; e < 2; e++)
        own &= model->ends[j][k].vehicle < 0
               || model->ends[j][k].vehicle != model->ends[i][e].vehicle;
  return own;
}

/* True if nothing but tethers and vehicles moves in the world, and the water is steady; and what
   moves the ends of tether I is known ahead.  */
static int
is_world_still (const bt_dive *dive, bt__state *state, int i)
{
  bt_water water = bt__dive_water (dive, state);
  return has_own_vehicles (dive, i) && dive->model->n_hulls == 0 && water.density > 0
         && !bt_water_is_unsteady (&water) && is_led (dive, state, i, 0)
         && is_led (dive, state, i, 1) && !bt__movers_move (dive);
}

/* True if tether I asks for its place to an accuracy, and moved smoothly in the present.  */
static int
is_calm (const bt_dive *dive, bt__state *state, int i)
{
  const bt__tether *tether = bt__dive_tether (dive, state, i);
  const bt__dynamic *chain = bt__dive_chain (dive, state, i, 0);
  return tether->props.model == BT_MODEL_AUTO && !tether->parted && tether->fine == 0
         && tether->quiet == 0 && tether->props.gj * tether->props.ei == 0
         && !bt__layers_slip (&tether->props) && chain->history && chain->owed == 0
         && bt__may_go_back (dive, state, i) && bt__was_wound (dive, i);
}

/* How many steps the next stretch of tether I may have, none below 2.  */
static int
longest_of (const bt_dive *dive, bt__state *state, int i)
{
  const bt__stretch *s = &bt__dive_tether (dive, state, i)->stretch;
  double last = bt__dive_chain (dive, state, i, 0)->h / BT__TIME_STEP;
  int64_t wait = s->wait > 0 ? s->wait : BT__SHORTEST_WAIT;
  int64_t most = s->next > 0 ? s->next : state->step % wait == 0 ? GROWTH : 0;
  return (int)fmin (fmin ((double)most, BT__LONGEST_STRETCH), floor (GROWTH * last + 1e-6));
}

/* ---- Ahead ---- */

/* Where the ends of tether I are in STEPS steps from the present; return how many steps can be
   told.  */
static int
foresee_ends (const bt_dive *dive, bt__state *state, int i, int steps, bt__ends *to)
{
  bt_vec3 *at[2] = { &to->a, &to->b };
  int most = steps;
  *to = bt__tether_ends (dive, state, i);
  for (int k = 0; k < 2; k++)
    {
      int v = dive->model->ends[i][k].vehicle;
      if (v >= 0)
        most = (int)fmin (most, 1 + bt__foresee_vehicle (dive, state, v, steps - 1, at[k]));
    }
  return most;
}

/* Step tether I through STEPS steps in one, its ends to TO.  */
static bt_status
solve_ahead (bt_dive *dive, bt__state *state, int i, int steps, const bt__ends *to,
             bt__dynamic_report *report, bt_error *error)
{
  bt_water water = bt__dive_water (dive, state);
  bt__fastened fastened;
  water.time += (steps - 1) * BT__TIME_STEP;
  bt__dynamic_input input = bt__chain_input (dive, state, i, &water, to);
  input.h = steps * BT__TIME_STEP;
  input.growth = GROWTH * (1 + 1e-6);
  bt__fasten (dive, i, 0, INFINITY, &input, &fastened);
  dive->contact_work.alone = 1;
  bt_status status = bt__step_part (dive, state, i, 0, &input, report, error);
  dive->contact_work.alone = 0;
  return status;
}

/* True if tether I, just stepped through a stretch, can meet nothing meanwhile: the straight way of
   the step was clear by as much as the line swings.  */
static int
went_clear (bt_dive *dive, bt__state *state, int i, const bt__dynamic_report *report)
{
  bt__dynamic *chain = bt__dive_chain (dive, state, i, 0);
  double swing = 1.01 * bt__dynamic_swing (chain), way = 1.01 * report->drift.way + swing;
  double touching = 2 * bt__dive_tether (dive, state, i)->props.diameter;
  if (bt__dive_anchors (dive, state, i, 0)->n > 0)
    return 0;
  if (bt__has_obstacles (dive) && !(chain->spare.way > way + touching))
    return 0;
  return fmin (chain->spare.turned, chain->spare.apart) > 2 * swing
         || bt__spare_among_lines (dive, state, i, 0) > way;
}

/* The error in place of the last stretch of tether I over the accepted error.  */
static double
error_of (const bt_dive *dive, bt__state *state, int i)
{
  const bt__dynamic *chain = bt__dive_chain (dive, state, i, 0);
  double accuracy = bt__accuracy (bt__dive_tether (dive, state, i)),
         asked = LATE * accuracy * fmax (chain->h, AT_ONCE);
  return bt__dynamic_surprise (bt__dive_chain (dive, dive->now, i, 0), chain) / asked;
}

/* How much the force on end K of CHAIN, beyond the tension of the interval there, has changed since
   NOW, N: the loads of half an interval.  */
static double
change_of_end (const bt__dynamic *now, const bt__dynamic *chain, int k)
{
  int64_t j = k ? chain->n - 1 : 0;
  return fabs (bt__norm (chain->pull[k]) - bt__dynamic_tension (chain)[j] - bt__norm (now->pull[k])
               + bt__dynamic_tension (now)[j]);
}

/* True if the tensions of tether I in the last stretch, at most TENSION, are straight ways from
   begin to end, as near as their accuracy asks.  */
static int
is_tension_straight (const bt_dive *dive, bt__state *state, int i, double tension)
{
  const bt__tether *tether = bt__dive_tether (dive, state, i);
  const bt__dynamic *now = bt__dive_chain (dive, dive->now, i, 0),
                    *chain = bt__dive_chain (dive, state, i, 0);
  double asked = bt__tension_asked (tether, tension),
         bow = bt__dynamic_tension_bow (now, chain, bt__stiffness (tether->props.ea));
  return !bt__has_jumped (dive, state, i, tension, 1)
         || (bow <= BOW * asked && change_of_end (now, chain, 0) <= asked
             && change_of_end (now, chain, 1) <= asked);
}

/* True if the line is neither about to sleep nor to part, and no event of tension or bends falls
   into the stretch.  */
static int
is_eventless (const bt__tether *tether, const bt__dynamic_report *report)
{
  int kinked = report->bend_radius < tether->props.min_bend_radius;
  return report->converged && report->speed > CALM && kinked == (tether->kinked != 0)
         && report->tension <= tether->props.breaking_load;
}

/* True if the ends of tether I, just stepped, came to TO, and no vehicle gives way to the tether.
 */
static int
is_in_hand (const bt_dive *dive, bt__state *state, int i, const bt__ends *to)
{
  const bt__dynamic *chain = bt__dive_chain (dive, state, i, 0);
  const bt_vec3 *x = bt__dynamic_x (chain);
  int all = bt__distance (x[0], to->a) <= REACHED && bt__distance (x[chain->n], to->b) <= REACHED;
  for (int k = 0; k < 2; k++)
    all &= !bt__slips_at (dive, state, i, k)
           || bt__norm (chain->pull[k]) < bt__most_pull_at (dive, state, i, k);
  return all;
}

/* Note the stretch of STEPS, just solved for tether I with the error OFF of the accepted error.  */
static void
begin_stretch (bt_dive *dive, bt__state *state, int i, int steps, double off,
               const bt__dynamic_report *report)
{
  bt__tether *tether = bt__dive_tether (dive, state, i);
  const bt__dynamic *now = bt__dive_chain (dive, dive->now, i, 0),
                    *chain = bt__dive_chain (dive, state, i, 0);
  bt__dynamic *end = bt__dive_chain (dive, state, i, 1);
  double next = FOLLOWED * steps / fmax (sqrt (off), FOLLOWED / GROWTH);
  bt__dynamic_copy (end, chain);
  bt__dynamic_reach_back (end, now);
  bt__contacts_init (bt__dive_anchors (dive, state, i, 1),
                     bt__contact_room (dive->model, &dive->model->tethers[i]));
  tether->stretch = (bt__stretch){ .span = steps,
                                   .gone = 1,
                                   .wait = tether->stretch.wait,
                                   .next = (int64_t)fmax (GROWTH, fmin (next, BT__LONGEST_STRETCH)),
                                   .tension = { bt__largest_tension (now), report->tension },
                                   .pull = { now->pull[0], now->pull[1] } };
  tether->peak = tether->unsure = 0;
  dive->profile.chain_steps++;
  dive->profile.chain_tries++;
}

/* Note that no stretch was to be had for tether I; return zero.  */
static int
refuse (const bt_dive *dive, bt__state *state, int i)
{
  bt__stretch *s = &bt__dive_tether (dive, state, i)->stretch;
  s->next = 0;
  s->wait = bt__next_wait (s);
  return 0;
}

/* Try to solve tether I for a stretch; return true if it is taken.  */
static int
go_ahead (bt_dive *dive, bt__state *state, int i)
{
  bt__present p;
  bt__keep_present (dive, state, i, &p);
  if (!bt__has_room_about (dive, dive->now, i, 0))
    return refuse (dive, state, i);
  for (int steps = longest_of (dive, state, i); steps >= GROWTH; steps /= SHORTER)
    {
      bt__ends to;
      bt__dynamic_report report;
      int most = foresee_ends (dive, state, i, steps, &to);
      if (most < steps)
        most = foresee_ends (dive, state, i, steps = most, &to);
      if (steps < GROWTH)
        return 0;
      bt_status status = solve_ahead (dive, state, i, steps, &to, &report, NULL);
      double off = status == BT_OK ? error_of (dive, state, i) : INFINITY;
      if (off <= 1 && is_eventless (&p.tether, &report) && is_in_hand (dive, state, i, &to)
          && went_clear (dive, state, i, &report)
          && is_tension_straight (dive, state, i, report.tension)
          && bt__has_room_about (dive, state, i, 0))
        {
          begin_stretch (dive, state, i, steps, off, &report);
          return 1;
        }
      bt__go_back (dive, state, i, &p);
      refuse (dive, state, i);
    }
  return 0;
}

/* ---- Within ---- */

/* True if end E of tether I is at AT, about where its stretch has that end.  An anchor stands
   still in steady water.  */
static int
is_there (const bt_dive *dive, bt__state *state, int i, int e, bt_vec3 at)
{
  if (dive->model->ends[i][e].vehicle < 0)
    return 1;
  const bt__tether *tether = bt__dive_tether (dive, state, i);
  const bt__dynamic *chain = bt__dive_chain (dive, state, i, 1);
  double share = (double)(tether->stretch.gone + 1) / (double)tether->stretch.span;
  bt_vec3 has = bt__dynamic_node_between (chain, share, e ? chain->n : 0);
  return bt__distance (has, at) <= ASTRAY * bt__accuracy (tether);
}

int
bt__are_ends_foreseen (const bt_dive *dive, bt__state *state, int i, const bt__ends *ends)
{
  return is_there (dive, state, i, 0, ends->a) && is_there (dive, state, i, 1, ends->b);
}

/* True if the stretch of tether I holds for this step too, which takes its ends to ENDS.  */
static int
still_holds (const bt_dive *dive, bt__state *state, int i, const bt__ends *ends)
{
  return is_world_still (dive, state, i) && bt__are_ends_foreseen (dive, state, i, ends);
}

/* Step tether I on by a step of its stretch, its ends to ENDS.  */
static void
go_on (bt_dive *dive, bt__state *state, int i, const bt__ends *ends)
{
  bt__tether *tether = bt__dive_tether (dive, state, i);
  bt__stretch *s = &tether->stretch;
  dive->profile.chain_stretched++;
  if (++s->gone < s->span)
    return;
  bt__store_changes (dive, i);
  bt__dynamic_copy (bt__dive_chain (dive, state, i, 0), bt__dive_chain (dive, state, i, 1));
  bt__dynamic_forget_back (bt__dive_chain (dive, state, i, 0));
  bt__dynamic_lead_ends (bt__dive_chain (dive, state, i, 0), (bt_vec3[]){ ends->a, ends->b });
  bt__contacts_init (bt__dive_anchors (dive, state, i, 0),
                     bt__contact_room (dive->model, &dive->model->tethers[i]));
  *s = (bt__stretch){ .next = s->next, .tension = { s->tension[1], s->tension[1] } };
}

/* Note that tether I was taken to ENDS.  */
static void
note_ends (bt__tether *tether, const bt__ends *ends)
{
  tether->shape.a = ends->a;
  tether->shape.b = ends->b;
}

void
bt__go_on_within (bt_dive *dive, bt__state *state, int i, const bt__ends *ends)
{
  bt__tether *tether = bt__dive_tether (dive, state, i);
  go_on (dive, state, i, ends);
  note_ends (tether, ends);
  bt__watch_tension (state, tether, i, bt__stretch_tension (tether));
}

int
bt__rides_stretch (bt_dive *dive, bt__state *state, int i, const bt__ends *ends)
{
  bt__tether *tether = bt__dive_tether (dive, state, i);
  if (bt__is_ahead (tether) && still_holds (dive, state, i, ends))
    go_on (dive, state, i, ends);
  else if (bt__is_ahead (tether))
    {
      bt__show_chain (dive, dive->now, i);
      bt__leave_stretch (dive, state, i);
      return 0;
    }
  else if (!is_calm (dive, state, i) || !is_world_still (dive, state, i)
           || longest_of (dive, state, i) < GROWTH || !go_ahead (dive, state, i))
    return 0;
  note_ends (tether, ends);
  tether->shape.length = tether->length;
  tether->stale = 0;
  tether->settled = bt__chain_in_use (dive, state, i)->fastest < SETTLED;
  return 1;
}

double
bt__stretch_tension (const bt__tether *tether)
{
  const bt__stretch *s = &tether->stretch;
  double share = s->span > 0 ? (double)s->gone / (double)s->span : 1;
  return s->tension[0] + share * (s->tension[1] - s->tension[0]);
}

void
bt__leave_stretches (const bt_dive *dive, bt__state *state)
{
  for (int i = 0; i < dive->model->n_tethers; i++)
    bt__leave_stretch (dive, state, i);
}
