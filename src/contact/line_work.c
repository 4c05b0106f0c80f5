/* The workspace of a line among obstacles.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <stdlib.h>

#include "contact/line_job.h"

/* Room a link for parts and pairs that are near, and half-spaces.  */
typedef struct room
{
  int parts, pairs, rows;
} room;

static const room rooms[] = { [BT__AMONG_ITSELF] = { 0, 8, 1 },
                              [BT__AMONG_LINES] = { 0, 24, 4 },
                              [BT__AMONG_OBSTACLES] = { BT__LINE_ROOM, 24, 4 } };

static int
self_new (bt__self *s, size_t n, int pairs)
{
  size_t boxes = 2;
  while (boxes < 2 * n)
    boxes *= 2;
  s->room = pairs * (int)n;
  return (s->pair = calloc ((size_t)s->room, sizeof *s->pair))
         && (s->known = calloc ((size_t)s->room, sizeof *s->known))
         && (s->move = calloc (n, sizeof *s->move)) && (s->reach = calloc (n, sizeof *s->reach))
         && (s->box = calloc (boxes, sizeof *s->box)) && (s->its = calloc (boxes, sizeof *s->its))
         && (s->chord = calloc (boxes, sizeof *s->chord))
         && (s->stood = calloc (n, sizeof *s->stood));
}

void
bt__line_work_free (bt__line_work *w)
{
  if (!w)
    return;
  bt__safe_free (w->safe);
  free (w->watch);
  free (w->near);
  free (w->kept);
  free (w->row);
  free (w->of);
  free (w->old);
  free (w->to);
  free (w->from_end);
  free (w->restart);
  free (w->self.pair);
  free (w->self.move);
  free (w->self.reach);
  free (w->self.box);
  free (w->self.its);
  free (w->self.chord);
  free (w->self.stood);
  free (w->self.known);
  free (w);
}

bt__line_work *
bt__line_work_new (int n_max, bt__among among)
{
  const room *room = &rooms[among];
  bt__line_work *w = n_max < 1 ? NULL : calloc (1, sizeof *w);
  if (!w)
    return NULL;
  size_t n = (size_t)n_max + 1, rows = (size_t)room->rows * n + 16;
  w->n_max = n_max;
  w->rows_max = (int)rows;
  w->room = (uint32_t)room->parts;
  int whole
      = bt__safe_new ((uint32_t)n, w->room, &w->safe, NULL) == BT_OK
        && (w->watch = calloc (n, sizeof *w->watch))
        && (w->near = calloc (n * w->room + 1, sizeof *w->near))
        && (w->kept = calloc (n * w->room + 1, sizeof *w->kept))
        && (w->row = calloc (rows + 1, sizeof *w->row))
        && (w->of = calloc (rows + 1, sizeof *w->of))
        && (w->old = calloc (rows + BT__BENTS, sizeof *w->old))
        && (w->to = calloc (n, sizeof *w->to)) && (w->from_end = calloc (n, sizeof *w->from_end))
        && (w->restart = calloc (n, sizeof *w->restart)) && self_new (&w->self, n, room->pairs);
  if (whole)
    {
      bt__line_work_forget (w);
      return w;
    }
  bt__line_work_free (w);
  return NULL;
}

void
bt__line_work_forget (bt__line_work *w)
{
  w->self.still = 0;
  if (w->room == 0)
    return;
  bt__safe_forget (w->safe);
  for (int j = 0; j < w->n_max; j++)
    {
      w->watch[j].clear = 1e9;
      w->watch[j].span = -1;
      w->watch[j].a = w->watch[j].b = bt__vec (INFINITY, 0, 0);
    }
}

double
bt__line_work_spare (bt__line_work *w, bt__dynamic *d, const bt__line_config *config)
{
  bt__line_report unused = { 0 };
  bt__line_job k = { .w = w,
                     .d = d,
                     .config = config,
                     .links = (int)d->n,
                     .margin = config->radius,
                     .core = config->core,
                     .x = bt__dynamic_x (d),
                     .report = &unused };
  return bt__self_counts (&k) ? bt__self_spare (&k) : INFINITY;
}

double
bt__line_work_asked (bt__line_work *w)
{
  double asked = w->asked;
  w->asked = 0;
  return asked;
}

void
bt__line_work_came (bt__line_work *w, double way)
{
  w->asked = way > w->asked ? way : w->asked;
}
