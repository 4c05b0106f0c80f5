/* Flights that fail, cut down and kept: see campaign.h.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <math.h>
#include <string.h>

#include "math/vec.h"

#include "testbed/campaign.h"

/* ---- Cutting down ---- */

/* What is being cut down, and how often it may still be flown.  */
typedef struct cutter
{
  campaign *c;
  campaign_fault fault;
  campaign_flight good; /* the last that had the fault */
  int flown, budget;
  double until; /* by the clock */
} cutter;

/* Keep the flight of K's campaign if it still has the fault; else go back.  */
static int
keep (cutter *k)
{
  campaign_tally t;
  if (k->flown < k->budget && (!k->c->clock || k->c->clock () < k->until))
    {
      k->flown++;
      if (campaign_play (k->c, &t) == k->fault)
        {
          k->good = k->c->flight;
          return 1;
        }
    }
  k->c->flight = k->good;
  return 0;
}

/* Without the last moves, then without any chunk of them: halves, quarters ...  */
static void
cut_moves (cutter *k)
{
  campaign_flight *f = &k->c->flight;
  for (int cut = f->moves / 2; cut > 0; cut /= 2)
    for (int kept = 1; kept && f->moves > cut; kept = keep (k))
      f->moves -= cut;
  for (int chunk = f->moves / 2; chunk > 0; chunk /= 2)
    for (int at = 0; at + chunk < k->good.moves;)
      {
        memmove (f->move + at, f->move + at + chunk,
                 (size_t)(f->moves - at - chunk) * sizeof *f->move);
        f->moves -= chunk;
        at += keep (k) ? 0 : chunk;
      }
}

static void
cut_nodes (cutter *k)
{
  campaign_flight *f = &k->c->flight;
  for (int by = f->nodes / 2; by > 0; by /= 2)
    for (int kept = 1; kept && f->nodes - by >= 3; kept = keep (k)) /* a dive has two intervals */
      f->nodes -= by;
}

/* What can be plainer, one thing after another.  */
enum
{
  STILL_WATER,
  EVEN_STEPS,
  NO_BENDING,
  NO_DAMPING,
  NEUTRAL,
  NO_FORCE,
  STRAIGHT,
  PLAINER
};

static void
make_plainer (campaign_flight *f, int what)
{
  for (int i = 0; i < f->moves; i++)
    {
      campaign_move *m = f->move + i;
      m->flow = what == STILL_WATER ? bt__vec (0, 0, 0) : m->flow;
      m->h = what == EVEN_STEPS ? f->step : m->h;
      m->force = what == NO_FORCE ? bt__vec (0, 0, 0) : m->force;
    }
  f->line.ei = what == NO_BENDING ? 0 : f->line.ei;
  f->line.ba = what == NO_DAMPING ? 0 : f->line.ba;
  f->line.wet_weight = what == NEUTRAL ? 0 : f->line.wet_weight;
  if (what == STRAIGHT)
    {
      f->shape[1] = f->shape[f->corners - 1];
      f->corners = 2;
    }
}

int
campaign_minimise (campaign *c, campaign_fault fault, int budget, double seconds)
{
  static cutter k; /* large */
  k = (cutter){ c, fault, c->flight, 0, budget, c->clock ? c->clock () + seconds : 0 };
  cut_moves (&k);
  cut_nodes (&k);
  for (int what = 0; what < PLAINER; what++)
    {
      make_plainer (&c->flight, what);
      keep (&k);
    }
  cut_moves (&k); /* what is plainer may need less */
  c->flight = k.good;
  return k.flown;
}

/* ---- Kept ---- */

#define FIRST_LINE "bight stability flight 1\n"

static int
write_vector (FILE *port, bt_vec3 v)
{
  return fprintf (port, " %.17g %.17g %.17g", v.x, v.y, v.z) > 0;
}

int
campaign_write (FILE *port, const campaign_flight *f)
{
  const bt_tether_props *l = &f->line;
  fputs (FIRST_LINE, port);
  fprintf (port, "%d %d %d %d %d %d %.17g %.17g\n", (int)f->kind, f->jittered, f->nodes, f->corners,
           f->moves, f->free, f->length, f->step);
  fprintf (port, "%.17g %.17g %.17g %.17g %.17g %.17g %.17g %.17g %.17g\n", l->diameter, l->mass,
           l->wet_weight, l->ea, l->ei, l->ba, l->cdn, l->cdt, l->ca);
  fprintf (port, "%.17g %.17g %.17g\n", f->body.mass, f->body.added, f->body.quadratic);
  for (int i = 0; i < f->corners; i++)
    {
      write_vector (port, f->shape[i]);
      fputc ('\n', port);
    }
  for (int i = 0; i < f->moves; i++)
    {
      fprintf (port, "%.17g", f->move[i].h);
      write_vector (port, f->move[i].at);
      write_vector (port, f->move[i].force);
      write_vector (port, f->move[i].flow);
      fputc ('\n', port);
    }
  return !ferror (port);
}

static int
read_vector (FILE *port, bt_vec3 *v)
{
  return fscanf (port, "%lf %lf %lf", &v->x, &v->y, &v->z) == 3;
}

static int
read_head (FILE *port, campaign_flight *f)
{
  bt_tether_props *l = &f->line;
  char first[sizeof FIRST_LINE];
  int kind;
  if (!fgets (first, sizeof first, port) || strcmp (first, FIRST_LINE) != 0
      || fscanf (port, "%d %d %d %d %d %d %lf %lf", &kind, &f->jittered, &f->nodes, &f->corners,
                 &f->moves, &f->free, &f->length, &f->step)
             != 8
      || fscanf (port, "%lf %lf %lf %lf %lf %lf %lf %lf %lf", &l->diameter, &l->mass,
                 &l->wet_weight, &l->ea, &l->ei, &l->ba, &l->cdn, &l->cdt, &l->ca)
             != 9
      || fscanf (port, "%lf %lf %lf", &f->body.mass, &f->body.added, &f->body.quadratic) != 3)
    return 0;
  f->kind = (campaign_kind)kind;
  return kind >= 0 && kind < CAMPAIGN_KINDS && f->nodes >= 2 && f->nodes <= CAMPAIGN_NODES
         && f->corners >= 2 && f->corners <= CAMPAIGN_CORNERS && f->moves >= 1
         && f->moves <= CAMPAIGN_MOVES;
}

int
campaign_read (FILE *port, campaign_flight *f)
{
  *f = (campaign_flight){ .kind = CAMPAIGN_PLAIN };
  int good = read_head (port, f);
  for (int i = 0; good && i < f->corners; i++)
    good = read_vector (port, f->shape + i);
  for (int i = 0; good && i < f->moves; i++)
    good = fscanf (port, "%lf", &f->move[i].h) == 1 && read_vector (port, &f->move[i].at)
           && read_vector (port, &f->move[i].force) && read_vector (port, &f->move[i].flow);
  return good;
}
