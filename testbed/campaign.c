/* Lines under abuse: see campaign.h.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <math.h>
#include <stdlib.h>

#include "math/vec.h"

#include "testbed/campaign.h"
#include "testbed/chance.h"

#define DENSITY 1025.0
#define GRAVITY 9.81

const char *const campaign_kind_names[CAMPAIGN_KINDS] = { "plain", "teleports", "vacuo" };

const char *const campaign_fault_names[CAMPAIGN_FAULTS]
    = { "sound", "broken", "blown up", "unrecovered", "gained energy", "not laid", "too tight" };

const campaign_tally campaign_nothing = { .gain = -HUGE_VAL };

/* ---- Random numbers ---- */

double
campaign_uniform (campaign *c, double a, double b)
{
  return chance_between (&c->seed, a, b);
}

double
campaign_decades (campaign *c, double a, double b)
{
  return exp (campaign_uniform (c, log (a), log (b)));
}

static int
happens (campaign *c, double p)
{
  return campaign_uniform (c, 0, 1) < p;
}

static bt_vec3
box (campaign *c, double r)
{
  double x = campaign_uniform (c, -r, r), y = campaign_uniform (c, -r, r);
  return bt__vec (x, y, campaign_uniform (c, -r, r));
}

/* ---- Lines ---- */

void
campaign_seed (campaign *c, uint64_t seed, long number)
{
  uint64_t z = seed * 0x9e3779b97f4a7c15u + (uint64_t)number + 1; /* SplitMix64 */
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
  z ^= z >> 31;
  c->seed = z ? z : 1;
}

int
campaign_open (campaign *c, uint64_t seed)
{
  *c = (campaign){ .seed = seed ? seed : 1 };
  c->d = malloc (bt__dynamic_size (CAMPAIGN_NODES));
  c->work = bt__dynamic_work_new (CAMPAIGN_NODES);
  for (int i = 0; i < 20; i++) /* small seeds start alike */
    campaign_uniform (c, 0, 1);
  return c->d && c->work;
}

void
campaign_close (campaign *c)
{
  free (c->d);
  bt__dynamic_work_free (c->work);
}

static bt_tether_props
random_props (campaign *c, campaign_kind kind)
{
  double d = campaign_decades (c, 0.003, 0.03), water = DENSITY * BT__PI * d * d / 4;
  bt_tether_props line = { .diameter = d,
                           .mass = water * campaign_uniform (c, 0.5, 3),
                           .wet_weight = campaign_uniform (c, -0.5, 1),
                           .ea = campaign_decades (c, 1e3, 1e9),
                           .ei = happens (c, 0.5) ? 0 : campaign_decades (c, 1e-3, 1e3),
                           .ba = happens (c, 0.3) ? 0 : campaign_uniform (c, 0, 200),
                           .cdn = campaign_uniform (c, 0.5, 2),
                           .cdt = 0.02,
                           .ca = 1 };
  if (kind == CAMPAIGN_VACUO)
    line.wet_weight = line.mass * GRAVITY;
  return line;
}

/* Draw a line of any kind that is not overstretched: slack between three points, and without water,
   where it is to move smoothly too, in an arc.  */
static void
draw_line (campaign *c, campaign_flight *f)
{
  double l = campaign_decades (c, 1, 300), a = campaign_uniform (c, 0.1, 0.99);
  double sag = 0.45 * sqrt (1 - a * a), aside = campaign_uniform (c, -0.7, 0.7);
  double most = campaign_uniform (c, 0, 1) * (c->quick ? campaign_uniform (c, 0, 1) : 1);
  bt_vec3 middle = { l * a / 2, l * sag * aside, -l * sag * 0.7 };
  f->corners = f->kind == CAMPAIGN_VACUO ? CAMPAIGN_CORNERS : 3;
  f->shape[0] = bt__vec (0, 0, 0);
  f->shape[1] = middle;
  f->shape[2] = bt__vec (l * a, 0, 0);
  for (int i = 0; i < f->corners && f->corners > 3; i++)
    {
      double turn = 4 * a, u = (double)i / (CAMPAIGN_CORNERS - 1), r = l / turn;
      double x = r * sin (turn * u), y = r * (1 - cos (turn * u));
      f->shape[i] = bt__vec (x, y * aside, -y * sqrt (1 - aside * aside));
    }
  f->nodes = (int)(2 * pow (CAMPAIGN_NODES / 2, most));
  f->line = random_props (c, f->kind);
  f->length = l;
  f->step = campaign_decades (c, 1e-3, 0.1);
  f->jittered = happens (c, 0.5);
  f->free = happens (c, f->kind == CAMPAIGN_VACUO ? 0.5 : 0.1);
  if (f->free && f->kind != CAMPAIGN_VACUO)
    f->body = (bt__dynamic_lump){ .mass = 20, .added = 10, .quadratic = 60 };
}

/* Draw *M, which begins as the move before it, the far end at V metres a second.  */
static void
draw_move (campaign *c, const campaign_flight *f, campaign_move *m, bt_vec3 *v)
{
  double reach = f->kind == CAMPAIGN_TELEPORTS ? 1.05 * f->length : f->length;
  m->h = f->jittered ? f->step * campaign_decades (c, 0.1, 1) : f->step;
  if (f->kind == CAMPAIGN_VACUO)
    return;
  if (happens (c, 0.02))
    *v = box (c, 5);
  if (happens (c, 0.02))
    *v = bt__vec (0, 0, 0);
  if (happens (c, 0.05))
    *v = bt__scale (-1, *v);
  if (happens (c, 0.01))
    {
      double u = campaign_uniform (c, -2, 2);
      m->flow = bt__vec (u, campaign_uniform (c, -2, 2), 0);
    }
  m->at = bt__axpy (m->at, m->h, *v);
  if (f->kind == CAMPAIGN_TELEPORTS && happens (c, 0.01))
    m->at = bt__add (m->at, box (c, 5));
  double far = bt__norm (m->at);
  if (far > reach)
    m->at = bt__scale (reach / far, m->at);
  m->force = bt__scale (30, *v);
}

void
campaign_draw (campaign *c, campaign_kind kind)
{
  campaign_flight *f = &c->flight;
  bt_vec3 v = { 0, 0, 0 };
  *f = (campaign_flight){ .kind = kind };
  draw_line (c, f);
  campaign_move m = { .at = f->shape[f->corners - 1] };
  f->moves = c->quick && f->nodes > 400 ? 60 : CAMPAIGN_MOVES;
  for (int i = 0; i < f->moves; i++)
    {
      draw_move (c, f, &m, &v);
      f->move[i] = m;
    }
}

/* ---- Flights ---- */

/* Lay the line of C's flight; nonzero if it can be.  */
static int
lay (campaign *c)
{
  const campaign_flight *f = &c->flight;
  c->current = (bt_current){ .kind = BT_CURRENT_STILL };
  c->water = (bt_water){
    f->kind == CAMPAIGN_VACUO ? 0 : DENSITY, GRAVITY, 1000, 0, &c->current, NULL, NULL, NULL
  };
  c->in = (bt__dynamic_input){ .line = &f->line, .water = &c->water, .tolerance = 1e-5 };
  c->in.end[0].at = f->shape[0];
  c->in.end[1].at = f->shape[f->corners - 1];
  c->in.end[1].free = f->free;
  c->in.end[1].body = f->body;
  if (bt__dynamic_init (c->d, CAMPAIGN_NODES, f->nodes - 1, f->shape, f->corners, f->length,
                        f->line.ea, NULL))
    return 0;
  c->driven = sqrt (2 * bt__dynamic_energies (c->d, &c->in).bending / (f->line.mass * f->length));
  c->driven += f->kind == CAMPAIGN_VACUO ? sqrt (2 * GRAVITY * f->length) : 5 * sqrt (3); /* jerk */
  if (f->kind == CAMPAIGN_TELEPORTS)
    c->driven += 0.05 * sqrt (f->line.ea / f->line.mass);
  return 1;
}

/* Set C for the move M.  */
static void
move (campaign *c, const campaign_move *m)
{
  bt_vec3 from = c->in.end[1].at;
  c->current.velocity[0] = m->flow;
  c->current.kind = bt__norm (m->flow) > 0 ? BT_CURRENT_UNIFORM : BT_CURRENT_STILL;
  c->in.end[1].at = m->at;
  c->in.end[1].body.force = m->force;
  if (!c->in.end[1].free)
    c->driven = fmax (c->driven, bt__distance (m->at, from) / m->h);
}

/* Return nonzero when all that the line of C is made of is finite.  */
static int
finite_line (const campaign *c)
{
  double sum = 0;
  for (int i = 0; i <= c->d->n; i++)
    {
      bt_vec3 x = bt__dynamic_x (c->d)[i], v = bt__dynamic_v (c->d)[i];
      sum += x.x + x.y + x.z + v.x + v.y + v.z;
    }
  for (int j = 0; j < c->d->n; j++)
    sum += bt__dynamic_tension (c->d)[j];
  return isfinite (sum);
}

static double
energy (const campaign *c)
{
  bt__dynamic_energy e = bt__dynamic_energies (c->d, &c->in);
  return e.kinetic + e.strain + e.gravity + e.bending;
}

/* Step C by H; *BEHIND is for how long it has not been solved.  Return zero when it broke.  */
static int
step (campaign *c, double h, double *behind, campaign_tally *t)
{
  c->in.h = h;
  c->water.time += h;
  double start = c->clock ? c->clock () : 0;
  bt_status status = bt__dynamic_step (c->d, c->work, &c->in, &c->report, NULL);
  double spent = c->clock ? c->clock () - start : 0;
  if (status || !finite_line (c))
    {
      t->broken++;
      return 0;
    }
  *behind = c->report.converged ? 0 : *behind + h;
  t->unsolved_for = fmax (t->unsolved_for, *behind);
  t->steps++;
  t->solves += c->report.solves;
  t->unsolved += !c->report.converged;
  t->seconds += spent;
  t->slowest = fmax (t->slowest, spent);
  t->tension = fmax (t->tension, c->report.tension);
  t->fastest = fmax (t->fastest, c->report.speed);
  t->ratio = fmax (t->ratio, c->report.speed / c->driven);
  return 1;
}

/* Hold the ends of C for 3 s, BEHIND as it is.  */
static void
rest (campaign *c, double behind, campaign_tally *t)
{
  campaign_tally quiet = campaign_nothing;
  c->in.end[1].body.force = bt__vec (0, 0, 0);
  for (int i = 0; i < 60; i++)
    if (!step (c, 0.05, &behind, &quiet))
      break;
  t->broken += quiet.broken;
  t->unsolved_for = fmax (t->unsolved_for, quiet.unsolved_for);
  t->settled = c->report.speed;
}

/* The worst of what *T, of one line, says.  */
static campaign_fault
fault_of (const campaign_tally *t)
{
  return t->broken        ? CAMPAIGN_BROKEN
         : t->blown       ? CAMPAIGN_BLOWN
         : t->unrecovered ? CAMPAIGN_UNRECOVERED
         : t->gained      ? CAMPAIGN_GAINED
         : t->tight       ? CAMPAIGN_TIGHT
                          : CAMPAIGN_SOUND;
}

campaign_fault
campaign_play (campaign *c, campaign_tally *t)
{
  const campaign_flight *f = &c->flight;
  double behind = 0;
  *t = campaign_nothing;
  t->lines = 1;
  if (!lay (c))
    {
      t->broken = 1;
      return CAMPAIGN_UNLAID;
    }
  double start = energy (c), scale = f->line.mass * GRAVITY * f->length * f->length;
  scale += bt__dynamic_energies (c->d, &c->in).bending;
  for (int i = 0; i < f->moves && !t->broken; i++)
    {
      move (c, f->move + i);
      if (step (c, f->move[i].h, &behind, t) && f->kind == CAMPAIGN_VACUO)
        t->gain = fmax (t->gain, (energy (c) - start) / scale);
    }
  if (f->kind != CAMPAIGN_VACUO && !t->broken)
    rest (c, behind, t);
  t->blown = t->ratio > 20;
  t->unrecovered = t->unsolved_for > 3;
  t->gained = t->gain > CAMPAIGN_GAIN;
  t->tight = c->tension > 0 && t->tension > c->tension;
  return fault_of (t);
}

campaign_fault
campaign_fly (campaign *c, campaign_kind kind, campaign_tally *total)
{
  campaign_tally t;
  campaign_draw (c, kind);
  campaign_fault fault = campaign_play (c, &t);
  campaign_add (total, &t);
  return fault;
}

void
campaign_add (campaign_tally *t, const campaign_tally *from)
{
  t->lines += from->lines;
  t->steps += from->steps;
  t->solves += from->solves;
  t->unsolved += from->unsolved;
  t->broken += from->broken;
  t->blown += from->blown;
  t->unrecovered += from->unrecovered;
  t->gained += from->gained;
  t->tight += from->tight;
  t->tension = fmax (t->tension, from->tension);
  t->unsolved_for = fmax (t->unsolved_for, from->unsolved_for);
  t->fastest = fmax (t->fastest, from->fastest);
  t->ratio = fmax (t->ratio, from->ratio);
  t->settled = fmax (t->settled, from->settled);
  t->gain = fmax (t->gain, from->gain);
  t->seconds += from->seconds;
  t->slowest = fmax (t->slowest, from->slowest);
}
