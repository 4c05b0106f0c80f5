/* Flights among obstacles: see stability_flight.h.  A line of 100 intervals is towed by an end that
   darts from aim to aim, or hangs on a vehicle of 20 kg that does; every step is judged for
   crossings, and every hundredth for clearance, by one who knows nothing of the engine.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include "stability_flight.h"
#include "base/hash.h"
#include "testbed/calibration.h"

const char *const flight_kind_names[FLIGHT_KINDS]
    = { "jacket", "wreck", "rigging", "canyon", "harm" };
const char *const flight_harm_names[HARMS]
    = { "25 m off at 1 MN", "25 m off, whatever it takes", "20 m/s at 1 MN", "solver overwritten" };
const char *const flight_fault_names[FLIGHT_FAULTS]
    = { "refused", "not finite", "crossing", "too near", "blown up", "unrecovered", "too tight" };

enum
{
  LOOK_EVERY = 100
};

static const double frame = 1.0 / 60;

/* A flight under way.  */
typedef struct crew
{
  const flight *f;
  reef place;
  rope line;
  dice d, junk;
  bt_vec3 target; /* of whoever means harm */
} crew;

/* ---- Who flies ---- */

static bt_vec3
end_of (const crew *c)
{
  return bt__dynamic_x (c->line.d)[c->line.d->n];
}

/* Drive the free end toward TARGET.  */
static void
thrust (crew *c, bt_vec3 target)
{
  bt_vec3 way = bt__sub (target, end_of (c));
  bt_vec3 want = bt__scale (c->f->speed / fmax (bt__norm (way), 1), way);
  bt_vec3 f = bt__scale (200, bt__sub (want, bt__dynamic_v (c->line.d)[c->line.d->n]));
  double size = bt__norm (f);
  c->line.in.end[1].body.force = size > 600 ? bt__scale (600 / size, f) : f;
}

static bt_vec3
aim_of (const flight *f, int step)
{
  int k = 0;
  while (k + 1 < f->aims && f->aim[k + 1].from <= step)
    k++;
  return f->aim[k].at;
}

static void
spoil (void *user, const bt_vec3 *from, bt_vec3 *to, int nodes)
{
  crew *c = user;
  (void)from;
  for (int i = 0; i < nodes; i++)
    {
      int bad = dice_below (&c->junk, 100);
      to[i] = bt__add (to[i], dice_point (&c->junk, 3));
      if (bad == 0)
        to[i].x = NAN;
      else if (bad == 1)
        to[i] = dice_point (&c->junk, 1e9);
    }
}

/* Step number I of a flight that means harm.  */
static void
do_harm (crew *c, int i)
{
  rope *p = &c->line;
  p->config.pull[1] = c->f->harm == HARM_FORCE ? INFINITY : c->f->harm == HARM_SPOIL ? 150 : 1e6;
  p->hook.spoil = c->f->harm == HARM_SPOIL ? spoil : NULL;
  if (c->f->harm == HARM_SPEED)
    {
      rope_tow (p, aim_of (c->f, i), 20, frame);
      return;
    }
  if (i % 5 == 0)
    c->target = bt__add (end_of (c), dice_point (&c->d, i % 3 ? 25 : 2));
  p->in.end[1].at = c->target;
  if (dice_below (&c->d, 100) == 0)
    p->in.end[1].at.y = NAN;
}

static void
steer (crew *c, int i)
{
  if (c->f->kind == FLIGHT_HARM && i >= FLIGHT_QUIET)
    do_harm (c, i);
  else if (c->f->body)
    thrust (c, aim_of (c->f, i));
  else
    rope_tow (&c->line, aim_of (c->f, i), c->f->speed, frame);
}

/* ---- What comes of it ---- */

bt_tether_props
flight_line (const flight *f)
{
  return (bt_tether_props){ .diameter = 0.01,
                            .mass = 0.0805033117 + f->weight / 9.81,
                            .wet_weight = f->weight,
                            .ea = 2e5,
                            .ba = 20,
                            .cdn = 1.2,
                            .cdt = 0.02,
                            .ca = 1,
                            .friction = f->friction };
}

static int
open_crew (crew *c, const flight *f, const flight_rules *rules)
{
  c->f = f;
  c->d = dice_new (f->seed + 1);
  c->junk = dice_new (f->seed + 2);
  c->target = f->shape[f->corners - 1];
  if (!flight_scene (f, &c->place)
      || !rope_open (&c->line, &c->place, f->links, f->shape, f->corners, f->length, f->friction))
    return 0;
  c->line.line = flight_line (f);
  c->line.current = (bt_current){ .kind = BT_CURRENT_UNIFORM, .velocity = { f->flow } };
  c->line.hook.user = c;
  c->line.hook.no_guard = rules->mutant;
  if (f->body)
    c->line.in.end[1] = (bt__dynamic_end){ .free = 1, .body = { .mass = 20, .quadratic = 60 } };
  return 1;
}

/* How near the line is to anything, in core radii.  */
static double
nearness (const crew *c)
{
  const rope *p = &c->line;
  return reef_clearance (&c->place, bt__dynamic_x (p->d), (int)p->d->n + 1) / p->config.core;
}

static int
worst_of (const flight_tally *t)
{
  int k = 0;
  while (k < FLIGHT_FAULTS && t->faults[k] == 0)
    k++;
  return k;
}

static void
take_end (const crew *c, flight_tally *t)
{
  const bt__dynamic *d = c->line.d;
  const bt_vec3 *x = bt__dynamic_x (d);
  size_t size = (size_t)(d->n + 1) * sizeof *x;
  t->hash = bt__hash (bt__dynamic_v (d), size, bt__hash (x, size, 0));
  for (int64_t i = 0; i <= d->n; i++)
    t->sum += x[i].x + x[i].y + x[i].z;
}

static void
sum_up (const crew *c, const flight_rules *rules, flight_tally *t)
{
  const rope *p = &c->line;
  t->flights = 1;
  t->steps = p->steps;
  t->solves = p->solves;
  t->unsolved = p->unconverged;
  t->truncated = p->truncated;
  t->jammed = p->truncated >= (p->steps + 99) / 100;
  t->touches = p->touches;
  t->fastest = p->fastest;
  t->tension = p->tension;
  t->faults[FLIGHT_REFUSED] = p->refused != 0;
  t->faults[FLIGHT_NOT_FINITE] = p->nan != 0;
  t->faults[FLIGHT_CROSSING] = p->crossings != 0;
  t->faults[FLIGHT_TOO_NEAR] = !(t->nearest >= 1);
  t->faults[FLIGHT_BLOWN] = c->f->kind != FLIGHT_HARM && !(p->fastest <= FLIGHT_FASTEST);
  t->faults[FLIGHT_UNRECOVERED] = c->f->kind != FLIGHT_HARM && t->unsolved_for > 3;
  t->faults[FLIGHT_TIGHT] = p->tension > rules->tension;
}

int
flight_play (const flight *f, const flight_rules *rules, flight_tally *t)
{
  static crew c; /* large */
  double behind = 0;
  *t = (flight_tally){ .nearest = HUGE_VAL };
  if (!open_crew (&c, f, rules))
    return -1;
  rope *p = &c.line;
  for (int i = 0; i < f->steps && !p->nan && !p->refused && !p->crossings; i++)
    {
      steer (&c, i);
      double start = bench_now ();
      rope_step (p, frame, 0);
      t->seconds += bench_now () - start;
      rope_judge (p);
      behind = p->report.converged ? 0 : behind + frame;
      t->unsolved_for = fmax (t->unsolved_for, behind);
      if (i % LOOK_EVERY == LOOK_EVERY - 1 || i == f->steps - 1 || p->crossings)
        t->nearest = fmin (t->nearest, nearness (&c));
    }
  sum_up (&c, rules, t);
  take_end (&c, t);
  rope_close (p);
  reef_close (&c.place);
  return worst_of (t);
}

void
flight_add (flight_tally *t, const flight_tally *from)
{
  t->flights += from->flights;
  t->steps += from->steps;
  t->solves += from->solves;
  t->unsolved += from->unsolved;
  t->truncated += from->truncated;
  t->jammed += from->jammed;
  t->touches += from->touches;
  for (int k = 0; k < FLIGHT_FAULTS; k++)
    t->faults[k] += from->faults[k];
  t->unsolved_for = fmax (t->unsolved_for, from->unsolved_for);
  t->fastest = fmax (t->fastest, from->fastest);
  t->tension = fmax (t->tension, from->tension);
  t->nearest = fmin (t->nearest, from->nearest);
  t->seconds += from->seconds;
}
