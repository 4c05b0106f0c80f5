/* Flights as text: see campaign.h.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <string.h>

#include "testbed/campaign.h"

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
