/* Lines under abuse: see campaign.h.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <math.h>
#include <stdlib.h>

#include "math/vec.h"

#include "campaign.h"

#define DENSITY 1025.0
#define GRAVITY 9.81

const campaign_tally campaign_nothing = { .gain = -HUGE_VAL };

/* ---- Random numbers ---- */

double
campaign_uniform (campaign *c, double a, double b)
{
  c->seed ^= c->seed << 13;
  c->seed ^= c->seed >> 7;
  c->seed ^= c->seed << 17;
  return a + (b - a) * (double)(c->seed >> 11) * 0x1p-53;
}

double
campaign_decades (campaign *c, double a, double b)
{
  return exp (campaign_uniform (c, log (a), log (b)));
}

static int
chance (campaign *c, double p)
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
random_props (campaign *c)
{
  double d = campaign_decades (c, 0.003, 0.03), water = DENSITY * BT__PI * d * d / 4;
  bt_tether_props line = { .diameter = d,
                           .mass = water * campaign_uniform (c, 0.5, 3),
                           .wet_weight = campaign_uniform (c, -0.5, 1),
                           .ea = campaign_decades (c, 1e3, 1e9),
                           .ei = chance (c, 0.5) ? 0 : campaign_decades (c, 1e-3, 1e3),
                           .ba = chance (c, 0.3) ? 0 : campaign_uniform (c, 0, 200),
                           .cdn = campaign_uniform (c, 0.5, 2),
                           .cdt = 0.02,
                           .ca = 1 };
  if (c->kind == CAMPAIGN_VACUO)
    line.wet_weight = line.mass * GRAVITY;
  return line;
}

enum
{
  CORNERS = 129
};

/* Lay a line of any kind without overstretching it: slack between three points, and without water,
   where what pushes a bent interval to its length would count as a gain, in an arc.  */
static void
lay (campaign *c)
{
  double l = campaign_decades (c, 1, 300), a = campaign_uniform (c, 0.1, 0.99);
  double sag = 0.45 * sqrt (1 - a * a), aside = campaign_uniform (c, -0.7, 0.7);
  double most = campaign_uniform (c, 0, 1) * (c->quick ? campaign_uniform (c, 0, 1) : 1);
  bt_vec3 shape[CORNERS]
      = { { 0, 0, 0 }, { l * a / 2, l * sag * aside, -l * sag * 0.7 }, { l * a, 0, 0 } };
  int corners = c->kind == CAMPAIGN_VACUO ? CORNERS : 3;
  for (int i = 0; i < corners && corners > 3; i++)
    {
      double turn = 4 * a, u = (double)i / (CORNERS - 1), r = l / turn;
      double x = r * sin (turn * u), y = r * (1 - cos (turn * u));
      shape[i] = bt__vec (x, y * aside, -y * sqrt (1 - aside * aside));
    }
  c->nodes = (int)(2 * pow (CAMPAIGN_NODES / 2, most));
  c->line = random_props (c);
  c->length = l;
  c->step = campaign_decades (c, 1e-3, 0.1);
  c->jittered = chance (c, 0.5);
  c->v = bt__vec (0, 0, 0);
  c->current = (bt_current){ .kind = BT_CURRENT_STILL };
  c->water = (bt_water){
    c->kind == CAMPAIGN_VACUO ? 0 : DENSITY, GRAVITY, 1000, 0, &c->current, NULL, NULL, NULL
  };
  c->in = (bt__dynamic_input){ .line = &c->line, .water = &c->water, .tolerance = 1e-5 };
  if (c->kind == CAMPAIGN_VACUO)
    c->in.tolerance = 1e-9; /* what is not solved may be gained */
  c->in.end[1].at = shape[corners - 1];
  c->in.end[1].free = chance (c, c->kind == CAMPAIGN_VACUO ? 0.5 : 0.1);
  if (c->in.end[1].free && c->kind != CAMPAIGN_VACUO)
    c->in.end[1].body = (bt__dynamic_lump){ .mass = 20, .added = 10, .quadratic = 60 };
  if (bt__dynamic_init (c->d, CAMPAIGN_NODES, c->nodes - 1, shape, corners, l, c->line.ea, NULL))
    abort ();
  c->driven = sqrt (2 * bt__dynamic_energies (c->d, &c->in).bending / (c->line.mass * l));
  c->driven += c->kind == CAMPAIGN_VACUO ? sqrt (2 * GRAVITY * l) : 5 * sqrt (3); /* a jerk */
  if (c->kind == CAMPAIGN_TELEPORTS)
    c->driven += 0.05 * sqrt (c->line.ea / c->line.mass);
}

/* Where the far end goes in the next H seconds.  */
static void
move (campaign *c, double h)
{
  bt_vec3 *at = &c->in.end[1].at, from = *at;
  double reach = c->kind == CAMPAIGN_TELEPORTS ? 1.05 * c->length : c->length;
  if (c->kind == CAMPAIGN_VACUO)
    return;
  if (chance (c, 0.02))
    c->v = box (c, 5);
  if (chance (c, 0.02))
    c->v = bt__vec (0, 0, 0);
  if (chance (c, 0.05))
    c->v = bt__scale (-1, c->v);
  if (chance (c, 0.01))
    {
      double u = campaign_uniform (c, -2, 2);
      c->current = (bt_current){ .kind = BT_CURRENT_UNIFORM,
                                 .velocity = { bt__vec (u, campaign_uniform (c, -2, 2), 0) } };
    }
  *at = bt__axpy (*at, h, c->v);
  if (c->kind == CAMPAIGN_TELEPORTS && chance (c, 0.01))
    *at = bt__add (*at, box (c, 5));
  double far = bt__norm (*at);
  if (far > reach)
    *at = bt__scale (reach / far, *at);
  c->in.end[1].body.force = bt__scale (30, c->v);
  if (!c->in.end[1].free)
    c->driven = fmax (c->driven, bt__distance (*at, from) / h);
}

/* ---- Flights ---- */

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

void
campaign_fly (campaign *c, campaign_kind kind, campaign_tally *total)
{
  campaign_tally t = campaign_nothing;
  double behind = 0;
  c->kind = kind;
  lay (c);
  double start = energy (c), scale = c->line.mass * GRAVITY * c->length * c->length;
  scale += bt__dynamic_energies (c->d, &c->in).bending;
  int steps = c->quick && c->nodes > 400 ? 60 : 200;
  for (int i = 0; i < steps && !t.broken; i++)
    {
      double h = c->jittered ? c->step * campaign_decades (c, 0.1, 1) : c->step;
      move (c, h);
      if (step (c, h, &behind, &t) && kind == CAMPAIGN_VACUO)
        t.gain = fmax (t.gain, (energy (c) - start) / scale);
    }
  if (kind != CAMPAIGN_VACUO && !t.broken)
    rest (c, behind, &t);
  t.lines = 1;
  t.blown = t.ratio > 20;
  t.unrecovered = t.unsolved_for > 3;
  campaign_add (total, &t);
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
  t->unsolved_for = fmax (t->unsolved_for, from->unsolved_for);
  t->fastest = fmax (t->fastest, from->fastest);
  t->ratio = fmax (t->ratio, from->ratio);
  t->settled = fmax (t->settled, from->settled);
  t->gain = fmax (t->gain, from->gain);
  t->seconds += from->seconds;
  t->slowest = fmax (t->slowest, from->slowest);
}
