/* A step of the dive, taken by a moving line in as many parts as its accuracy asks.

   The dive's clock stays: sticks, tracks, winches, events and questions know whole steps alone.  A
   line first takes the step whole, and keeps to that where the tension has hardly changed and the
   places are near the predictor.  Elsewhere (a snap, a stall, a touch, a release) the line
   goes back to the present, takes the step in twice as many equal parts, and so on until two
   attempts in a row agree: step doubling (Hairer, Norsett, Wanner, Solving Ordinary Differential
   Equations I, II.4), with the step of the dive as the unit.  Compared are the largest tension in
   the step and the mean force at either end, by which lines part and vehicles move; and, of a line
   of model `auto', the places of the nodes.  The finest attempt is kept.  The next step begins with
   half as many parts, so that the number follows the motion both ways.

   Tension alone does not tell where a line is: two per cent of 2600 N are 26 mm along 100 m of a
   line of 200 kN.  Where smaller parts bring the places no nearer to each other, as of links in a
   heap, the parts are halved no more.

   Within a step the ends go from place to place (end_within in chain_step.c); a vehicle with mass
   on the line is stepped with each part under the forces of the step's start, and so is its
   thrust; movers go their share of the way; other lines stand where they are, as in a whole step.
   No step is divided for accuracy in which the winch turns, or may give line, for it draws in no
   line in a step that ends above its pull, and none that starts with the line touching something.
   Wear is added up over the parts, contacts and sliding nodes are those of the last one. Where a
   mover is held back the step is taken whole, for others were told how far the mover goes.

   A step that is not solved, of any line, is taken again in twice as many parts, and so on.  The
   half-spaces of contact stand as a step finds them, while in a heap of line that is being paid out
   links turn about each other, and pass by more than they are thick, within one whole step: then no
   place of the line satisfies them all, and the tensions are those of a hundred iterations that end
   nowhere, or that are let go at half a millimetre, which along a stiff line is hundreds of
   newtons. A step half as long is solved by a few.  The next step begins with as many parts; every
   COARSER steps half as many are tried.

   An attempt begins from the present state of the dive alone, so that the number of threads, and
   how time is asked for, has no influence; FINE in the state is the only memory.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <math.h>
#include <string.h>

#include "math/vec.h"
#include "sim/around.h"
#include "sim/chain.h"
#include "world/layout.h"
#include "world/obstacles.h"

/* N: of a smaller tension the accuracy asks for no more than of so much.  A vehicle without mass
   that starts at once sends 20 N along a common line, which rings for seconds and parts nothing.
   */
#define LEAST_SCALE 250.0
#define ENTER 5.0     /* errors asked for: a smaller jump is not worth parts, ... */
#define STAY 1.0      /* ... and after a step in parts, a jump of less than this */
#define FOLLOWED 1e-5 /* m: a chain so near to the length at its winch is not wound */
#define SHARE 0.25    /* of the error asked for: that of one step, for those of a snap add up */
#define MORE 0.125    /* of what was accepted: less is not worth as many parts again */
#define PLACE 0.1     /* of the accuracy in place: the error of one step */
#define GAIN 1.5      /* times as near: places come to agree by smaller parts */
#define AS_LONG 2.01  /* times the step before: the predictor of a longer step tells nothing */

enum
{
  SOLVING = 3, /* the parts of a step that is not solved are halved so often at most */
  COARSER = 16 /* steps of the dive, after which fewer parts are tried */
};

/* What an attempt at a step has come to.  */
typedef struct attempt
{
  bt__dynamic_report report; /* of all parts: the largest, the tightest */
  bt_vec3 pull[2];           /* N: the mean force on the ends */
  int64_t n[2];              /* intervals of each part of the tether */
} attempt;

/* How far two attempts are apart: forces, N, and places, m.  */
typedef struct difference
{
  double force, place;
} difference;

/* ---- Back to the present ---- */

/* The vehicle at end K of tether I that its step may move, or -1: one shared with tethers of other
   threads stays.  */
static int
own_vehicle (const bt_dive *dive, int i, int k)
{
  int v = dive->model->ends[i][k].vehicle;
  return v >= 0 && dive->context && dive->context->shared[v] ? -1 : v;
}

void
bt__keep_present (const bt_dive *dive, bt__state *state, int i, bt__present *p)
{
  p->tether = *bt__dive_tether (dive, state, i);
  p->events = state->events;
  for (int k = 0; k < 2; k++)
    if (own_vehicle (dive, i, k) >= 0)
      p->vehicle[k] = *bt__dive_vehicle (dive, state, own_vehicle (dive, i, k));
}

void
bt__go_back (const bt_dive *dive, bt__state *state, int i, const bt__present *p)
{
  bt__forget_events (dive, state, p->events);
  *bt__dive_tether (dive, state, i) = *bt__dive_tether (dive, dive->now, i); /* whose store it is */
  bt__copy_store (dive, state, dive->now, i);
  bt__leave_stretch (dive, state, i);
  *bt__dive_tether (dive, state, i) = p->tether;
  *bt__dive_subject (dive, state, BT_PART_TETHER, i)
      = *bt__dive_subject (dive, dive->now, BT_PART_TETHER, i);
  for (int k = 0; k < 2; k++)
    if (own_vehicle (dive, i, k) >= 0)
      *bt__dive_vehicle (dive, state, own_vehicle (dive, i, k)) = p->vehicle[k];
}

/* ---- Attempts ---- */

void
bt__add_report (bt__dynamic_report *sum, const bt__dynamic_report *part)
{
  bt__dynamic_report before = *sum;
  *sum = *part;
  sum->converged &= before.converged;
  sum->loose |= before.loose;
  sum->speed = fmax (part->speed, before.speed);
  sum->acceleration = fmax (part->acceleration, before.acceleration);
  sum->tension = fmax (part->tension, before.tension);
  sum->bend_radius = fmin (part->bend_radius, before.bend_radius);
}

/* How far the workspace's line came, and asked for others, since it was asked last; m.  */
static double
way_asked (const bt__contact_work *work)
{
  return work->line ? bt__line_work_asked (work->line) : 0;
}

/* Take tether I through the step in 2^FINE parts.  What the parts ask for adds up: each asks about
   where the one before left the line.  */
static bt_status
try_parts (bt_dive *dive, bt__state *state, int i, const bt__ends *to, int fine, attempt *a,
           bt_error *error)
{
  const bt__tether *tether = bt__dive_tether (dive, state, i);
  bt__contact_work *work = &dive->contact_work;
  bt__ends from = { tether->shape.a, tether->shape.b };
  int n = 1 << fine;
  bt_status status = BT_OK;
  double before = n > 1 ? way_asked (work) : 0, sum = 0;
  dive->profile.chain_tries += (uint64_t)bt__chains (tether);
  work->balked = 0;
  *a = (attempt){ .report = { .converged = 1, .bend_radius = HUGE_VAL } };
  for (int k = 0; k < n && status == BT_OK && !(n > 1 && work->balked); k++)
    {
      bt__dynamic_report part = { 0 };
      work->since = (double)k / n;
      work->left = 1 - (double)(k + 1) / n;
      status = bt__advance_chain (dive, state, i, &from, to, &part, error);
      sum += n > 1 ? way_asked (work) : 0;
      bt__add_report (&a->report, &part);
      for (int e = 0; e < 2; e++)
        a->pull[e] = bt__axpy (a->pull[e], 1.0 / n,
                               bt__dive_chain (dive, state, i, e && tether->parted)->pull[e]);
    }
  for (int part = 0; part < bt__chains (tether); part++)
    a->n[part] = bt__dive_chain (dive, state, i, part)->n;
  work->since = work->left = 0;
  if (n > 1 && work->line)
    bt__line_work_came (work->line, fmax (before, sum));
  return status;
}

/* ---- Is it accurate? ---- */

double
bt__tension_asked (const bt__tether *tether, double tension)
{
  return tether->props.tension_accuracy * fmax (tension, LEAST_SCALE);
}

/* True if all line that the winch of tether I gave or took was in the chain, or out of it, in the
   present.  */
int
bt__was_wound (const bt_dive *dive, int i)
{
  double in_chain = bt__dynamic_length (bt__dive_chain (dive, dive->now, i, 0));
  return fabs (bt__dive_tether (dive, dive->now, i)->length - in_chain) < FOLLOWED;
}

/* True if tether I touches something in STATE: friction that sticks and slips has no tension to
   converge to, and parts made the steps of a fleet among obstacles several times as dear.  */
static int
touches (const bt_dive *dive, bt__state *state, int i)
{
  int any = 0;
  for (int part = 0; part < bt__chains (bt__dive_tether (dive, state, i)); part++)
    any |= bt__dive_anchors (dive, state, i, part)->n > 0;
  return any;
}

/* True if tether I may be taken through the step in parts, if `bt__was_wound' says so too: it moved
   already in the present, its winch stands and gives no line, and nothing acts on it but water and
   what its ends are fastened to.  */
int
bt__may_go_back (const bt_dive *dive, bt__state *state, int i)
{
  const bt__tether *now = bt__dive_tether (dive, dive->now, i),
                   *next = bt__dive_tether (dive, state, i);
  return isfinite (next->props.tension_accuracy) && bt__is_cable (now)
         && now->parted == next->parted && next->winch_rate == 0
         && !isfinite (next->props.winch_brake) && !touches (dive, dive->now, i);
}

/* True if the tension of tether I changed in a step by more than TIMES what it may be wrong by.  */
int
bt__has_jumped (const bt_dive *dive, bt__state *state, int i, double tension, double times)
{
  const bt__tether *tether = bt__dive_tether (dive, state, i);
  double most = times * bt__tension_asked (tether, tension);
  for (int part = 0; part < bt__chains (tether); part++)
    {
      const bt__dynamic *now = bt__dive_chain (dive, dive->now, i, part),
                        *next = bt__dive_chain (dive, state, i, part);
      const double *t0 = bt__dynamic_tension (now), *t1 = bt__dynamic_tension (next);
      double up = 0, down = 0;
      for (int64_t j = 0; j < next->n && now->n == next->n; j++)
        {
          double jump = t1[j] - t0[j];
          up = jump > up ? jump : up;
          down = jump < down ? jump : down;
        }
      if (up > most || -down > most || bt__distance (now->pull[0], next->pull[0]) > most
          || bt__distance (now->pull[1], next->pull[1]) > most)
        return 1;
    }
  return 0;
}

/* True if an end of tether I is held by a vehicle without mass, which may start at once.  */
static int
may_jerk (const bt_dive *dive, bt__state *state, int i)
{
  for (int k = 0; k < 2; k++)
    {
      int v = dive->model->ends[i][k].vehicle;
      if (v >= 0 && !bt__dive_vehicle (dive, state, v)->rigid)
        return 1;
    }
  return 0;
}

/* How many times the parts of a step of tether I may be halved.  A vehicle without mass that starts
   with the speed V at once takes half an interval of length L along within the first part, of H
   seconds.  The force on that, m L V / (2 H), grows with the number of parts.  It is no more than
   that of the wave which is sent along the line, m c V with c = sqrt (EA / m), as long as the wave
   crosses half of the longest interval within a part.  */
static int
finest_of (const bt_dive *dive, bt__state *state, int i)
{
  const bt__tether *tether = bt__dive_tether (dive, state, i);
  double longest = 0, speed = sqrt (tether->props.ea / tether->props.mass);
  if (!may_jerk (dive, state, i))
    return BT__FINEST;
  for (int part = 0; part < bt__chains (tether); part++)
    {
      const bt__dynamic *chain = bt__dive_chain (dive, state, i, part);
      const double *rest = bt__dynamic_rest (chain);
      for (int64_t j = 0; j < chain->n; j++)
        longest = fmax (longest, rest[j]);
    }
  double most = floor (log2 (2 * speed * BT__TIME_STEP / longest));
  return most > 0 ? (int)fmin (most, BT__FINEST) : 0;
}

/* How far the tensions of two attempts are apart, N.  */
static double
forces_apart (const attempt *a, const attempt *b)
{
  double off = fabs (a->report.tension - b->report.tension);
  for (int e = 0; e < 2; e++)
    off = fmax (off, bt__distance (a->pull[e], b->pull[e]));
  return off;
}

/* The error in place that one step of TETHER may have, m.  */
static double
place_asked (const bt__tether *tether)
{
  return tether->props.model == BT_MODEL_AUTO ? PLACE * bt__accuracy (tether) : INFINITY;
}

/* True if the whole step of tether I, just taken, is farther off in place than TETHER asks.  */
static int
is_place_off (const bt_dive *dive, bt__state *state, int i)
{
  const bt__tether *tether = bt__dive_tether (dive, state, i);
  int off = 0;
  for (int part = 0; part < bt__chains (tether) && isfinite (place_asked (tether)); part++)
    {
      const bt__dynamic *now = bt__dive_chain (dive, dive->now, i, part),
                        *next = bt__dive_chain (dive, state, i, part);
      off |= now->history && now->n == next->n && next->h <= AS_LONG * now->h
             && bt__dynamic_surprise (now, next) > place_asked (tether);
    }
  return off;
}

/* Where the places of a tether's parts are kept while another attempt is made.  */
static bt_vec3 *
kept_places (const bt_dive *dive, int part)
{
  return part ? dive->motion : dive->polyline;
}

static void
keep_places (const bt_dive *dive, bt__state *state, int i)
{
  for (int part = 0; part < bt__chains (bt__dive_tether (dive, state, i)); part++)
    {
      const bt__dynamic *chain = bt__dive_chain (dive, state, i, part);
      memcpy (kept_places (dive, part), bt__dynamic_x (chain),
              sizeof (bt_vec3) * (size_t)(chain->n + 1));
    }
}

/* How far the places of tether I are from those kept of the attempt A, m.  */
static double
places_apart (const bt_dive *dive, bt__state *state, int i, const attempt *a)
{
  double off = 0;
  for (int part = 0; part < bt__chains (bt__dive_tether (dive, state, i)); part++)
    {
      const bt__dynamic *chain = bt__dive_chain (dive, state, i, part);
      const bt_vec3 *x = bt__dynamic_x (chain), *kept = kept_places (dive, part);
      for (int64_t k = 0; k <= chain->n && chain->n == a->n[part]; k++)
        off = fmax (off, bt__distance (x[k], kept[k]));
    }
  return off;
}

/* OFF over what tether I accepts after an attempt with the largest tension TENSION.  Forces count
   while the tension changes by what they may be off.  */
static difference
over_asked (const bt_dive *dive, bt__state *state, int i, double tension, difference off)
{
  const bt__tether *tether = bt__dive_tether (dive, state, i);
  int counts = bt__has_jumped (dive, state, i, tension, STAY);
  return (difference){ counts ? off.force / (SHARE * bt__tension_asked (tether, tension)) : 0,
                       off.place / place_asked (tether) };
}

/* ---- The step ---- */

/* After the attempt *A in 2^FINE parts, go on until two attempts agree; return the number of the
   last one's doublings, or -1 where a mover was held back.  *OFF is how far the last two are apart.
 */
static int
refine (bt_dive *dive, bt__state *state, int i, const bt__ends *to, const bt__present *p, int fine,
        attempt *a, difference *off, bt_status *status, bt_error *error)
{
  int finest = finest_of (dive, state, i);
  double before = INFINITY;
  while (fine < finest && !touches (dive, state, i))
    {
      attempt coarse = *a;
      keep_places (dive, state, i);
      bt__go_back (dive, state, i, p);
      *status = try_parts (dive, state, i, to, ++fine, a, error);
      if (*status != BT_OK || dive->contact_work.balked)
        return -1;
      *off = (difference){ forces_apart (&coarse, a), places_apart (dive, state, i, &coarse) };
      difference over = over_asked (dive, state, i, a->report.tension, *off);
      if (over.force <= 1 && (over.place <= 1 || over.place * GAIN > before))
        break;
      before = over.place;
    }
  return fine;
}

/* The number of doublings for the next step: in the last, of 2^FINE parts, the error was OVER what
   was accepted.  */
static int
next_fine (int fine, difference over)
{
  double off = fmax (over.force, over.place);
  return off < MORE * MORE ? 0 : off < MORE ? (int)fmax (fine - 1, 0) : fine;
}

/* Take tether I, which may go back for its accuracy, through the step, at first in 2^*FINE parts,
   until it is accurate; *FINE and *OFF are then as `refine' has them.  */
static bt_status
advance_in_parts (bt_dive *dive, bt__state *state, int i, const bt__ends *to, const bt__present *p,
                  int *fine, attempt *a, difference *off, bt_error *error)
{
  if (*fine > 0 && !bt__was_wound (dive, i))
    *fine = 0;
  bt_status status = try_parts (dive, state, i, to, *fine, a, error);
  if (status == BT_OK && !dive->contact_work.balked
      && (*fine > 0
          || ((bt__has_jumped (dive, state, i, a->report.tension, ENTER)
               || is_place_off (dive, state, i))
              && bt__was_wound (dive, i))))
    *fine = refine (dive, state, i, to, p, *fine, a, off, &status, error);
  return status;
}

/* True if A has places and tensions to be believed.  */
static int
is_solved (const attempt *a)
{
  return a->report.converged && !a->report.loose;
}

/* Take tether I, whose step in 2^*FINE parts came to *A, through it in more parts until it is
   solved, and whole where a mover was held back in a part.  Return true if there were more.  */
static int
solve_in_parts (bt_dive *dive, bt__state *state, int i, const bt__ends *to, const bt__present *p,
                int *fine, attempt *a, bt_status *status, bt_error *error)
{
  int more = 0;
  for (; *status == BT_OK && !is_solved (a) && *fine >= 0 && *fine < SOLVING; more = 1)
    {
      bt__go_back (dive, state, i, p);
      *status = try_parts (dive, state, i, to, ++*fine, a, error);
    }
  if (*status == BT_OK && *fine != 0 && dive->contact_work.balked)
    {
      bt__go_back (dive, state, i, p);
      *status = try_parts (dive, state, i, to, *fine = 0, a, error);
    }
  return more;
}

/* With how many parts the next step of STATE begins, as the state has it, if this one was solved in
   2^FINE.  */
static int
solved_fine (const bt__state *state, int fine)
{
  return fine == 0 ? 0 : BT__FINEST + fine + (state->step % COARSER != 0);
}

/* How often the parts of the present step are halved at first.  Where the line MAY not go back for
   its accuracy, parts that were taken for that count no more.  */
static int
first_fine (const bt__tether *tether, int may)
{
  int solving = tether->fine > BT__FINEST, fine = (int)tether->fine - (solving ? BT__FINEST : 0);
  return fine > 0 && (may || solving) ? fine - 1 : 0;
}

bt_status
bt__advance_as_asked (bt_dive *dive, bt__state *state, int i, const bt__ends *to,
                      bt__dynamic_report *report, bt_error *error)
{
  bt__tether *tether = bt__dive_tether (dive, state, i);
  uint64_t unsolved = dive->profile.chain_unconverged;
  int may = bt__may_go_back (dive, state, i), fine = first_fine (tether, may);
  bt__present p;
  attempt a;
  difference off = { 0, 0 };
  bt__keep_present (dive, state, i, &p);
  bt_status status = may ? advance_in_parts (dive, state, i, to, &p, &fine, &a, &off, error)
                         : try_parts (dive, state, i, to, fine, &a, error);
  int solving = solve_in_parts (dive, state, i, to, &p, &fine, &a, &status, error) || !may;
  if (status != BT_OK)
    return status;
  *report = a.report;
  tether->peak = fine > 0 ? a.report.tension : 0;
  tether->unsure = off.force > bt__tension_asked (tether, a.report.tension) ? off.force : 0;
  tether->fine = solving     ? solved_fine (state, fine)
                 : fine == 0 ? 0
                             : next_fine (fine, over_asked (dive, state, i, a.report.tension, off));
  dive->profile.chain_steps += (uint64_t)bt__chains (tether);
  dive->profile.chain_unconverged = unsolved + !a.report.converged;
  return BT_OK;
}
