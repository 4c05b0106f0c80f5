/* The workspace of a line among obstacles.  Lists and arrays are made when obstacles or links come
   near, and grow; the most links of a line bound their lengths, whatever the room.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <stdlib.h>
#include <string.h>

#include "base/room.h"
#include "contact/line_job.h"

/* The most parts and pairs a link that are near, and half-spaces.  */
typedef struct room
{
  int parts, pairs, rows;
} room;

static const room rooms[] = { [BT__AMONG_ITSELF] = { 0, 8, 1 },
                              [BT__AMONG_LINES] = { 0, 24, 4 },
                              [BT__AMONG_OBSTACLES] = { BT__LINE_ROOM, 24, 4 } };

/* ---- Room, made as it is needed ---- */

/* ARRAY anew, for N elements of SIZE, holding anything.  */
static int
renew (void *array, size_t n, size_t size)
{
  void *old, *made = malloc (n * size);
  memcpy (&old, array, sizeof old);
  free (old);
  memcpy (array, &made, sizeof made);
  return made != NULL;
}

static int
longest (const bt__dynamic *d, const bt__line_config *config)
{
  int64_t n = d->n;
  for (int i = 0; i < config->strands; i++)
    n = config->strand[i].line->n > n ? config->strand[i].line->n : n;
  return (int)n;
}

/* The arrays for lines of up to LINKS: what was known of a line and itself is forgotten.  */
static int
renew_self (bt__self *s, size_t links)
{
  size_t n = links + 2, boxes = 2;
  while (boxes < 2 * n)
    boxes *= 2;
  s->still = 0;
  return renew (&s->move, n, sizeof *s->move) && renew (&s->reach, n, sizeof *s->reach)
         && renew (&s->stood, n, sizeof *s->stood) && renew (&s->box, boxes, sizeof *s->box)
         && renew (&s->its, boxes, sizeof *s->its) && renew (&s->chord, boxes, sizeof *s->chord);
}

/* Return HAS, and note that memory is out if it is false.  */
static int
note (bt__line_work *w, int has)
{
  w->lacks |= !has;
  return has;
}

int
bt__line_room (bt__line_work *w, const bt__dynamic *d, const bt__line_config *config)
{
  size_t links = (size_t)longest (d, config);
  if (links <= w->self_room)
    return 1;
  w->self_room = 0;
  links += links / 8;
  if (!note (w, renew_self (&w->self, links)))
    return 0;
  w->self_room = links;
  return 1;
}

int
bt__line_row_room (bt__line_work *w, int n)
{
  return note (w, bt__make_room (&w->row, &w->row_room, (size_t)n, sizeof *w->row)
                      && bt__make_room (&w->of, &w->of_room, (size_t)n, sizeof *w->of));
}

int
bt__line_old_room (bt__line_work *w, int n)
{
  return note (w, bt__make_room (&w->old, &w->old_room, (size_t)n, sizeof *w->old));
}

int
bt__self_pair_room (bt__line_work *w)
{
  bt__self *s = &w->self;
  return note (w, bt__make_room (&s->pair, &s->pair_room, (size_t)s->pairs + 1, sizeof *s->pair));
}

int
bt__self_known_room (bt__line_work *w)
{
  bt__self *s = &w->self;
  return note (w,
               bt__make_room (&s->known, &s->known_room, (size_t)s->knowns + 1, sizeof *s->known));
}

bt__link_list *
bt__line_list (bt__line_work *w, uint32_t link)
{
  if (!w->list[link])
    note (w, (w->list[link] = malloc (sizeof **w->list)) != NULL);
  return w->list[link];
}

bt__safe *
bt__line_safe (bt__line_work *w)
{
  size_t n = (size_t)w->n_max + 1;
  if (w->safe)
    return w->safe;
  if (note (w, (w->to || (w->to = malloc (n * sizeof *w->to)))
                   && bt__safe_new ((uint32_t)n, w->room, &w->safe, NULL) == BT_OK))
    return w->safe;
  return NULL;
}

void
bt__line_measure (const bt__line_job *k)
{
  const double *rest = bt__dynamic_rest (k->d);
  double *from_end = k->w->from_end;
  from_end[k->d->n] = 0;
  for (int64_t j = k->d->n - 1; j >= 0; j--)
    from_end[j] = from_end[j + 1] + rest[j];
}

/* ---- Life ---- */

void
bt__line_work_free (bt__line_work *w)
{
  if (!w)
    return;
  for (int j = 0; w->list && j <= w->n_max; j++)
    free (w->list[j]);
  bt__safe_free (w->safe);
  free (w->watch);
  free (w->list);
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
  size_t n = (size_t)n_max + 1;
  w->n_max = n_max;
  w->rows_max = room->rows * (int)n + 16;
  w->room = (uint32_t)room->parts;
  w->self.most = room->pairs * (int)n;
  int whole = (w->watch = calloc (n, sizeof *w->watch)) && (w->list = calloc (n, sizeof *w->list))
              && (w->from_end = malloc (n * sizeof *w->from_end)) && bt__line_old_room (w, 1)
              && (w->restart = malloc (n * sizeof *w->restart));
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
  if (w->safe)
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
  if (!bt__self_counts (&k))
    return INFINITY;
  return bt__line_room (w, d, config) ? bt__self_spare (&k) : 0;
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
