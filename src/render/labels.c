/* Labels: where the words beside things stand.  No label overlaps words or figures, or leaves the
   picture; labels cover as few vehicles, anchors, arrows and tethers as can be.

   A greedy placement: labels are sorted by rank (vehicles, then labels asked for, marks, all
   others), and each is tried at eight directions and five distances beside its thing, nearest
   first.  Of the free boxes the first that covers least is taken, and kept as taken by the pen.
   Vehicles, anchors, arrows and tethers are spots along them.  The five most important labels
   stand beside their things, with a line from a distant thing.  The remaining labels are numbers,
   explained by a list under the title as far as the list has room; labels without room are left
   out.

   Order of things in the view breaks ties, so equal views give equal pictures.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "math/vec.h"
#include "render/text.h"

enum
{
  WRITTEN = 5,    /* labels beside their things */
  NUMBERED = 9,   /* and in the list */
  DIRECTIONS = 8, /* in which a label is tried */
  SPOTS = 400,    /* that labels should not cover */
  ALONG = 24      /* of these along one thing */
};

typedef struct spot
{
  double x, y, r; /* pixels */
} spot;

typedef struct spots
{
  spot at[SPOTS];
  int n;
} spots;

typedef struct label
{
  const bt_thing *thing;
  double x, y; /* what it is beside */
  int rank;    /* the lower the more it matters */
  size_t turn; /* among those of one rank */
} label;

static bt_vec3
label_place (const bt_thing *t)
{
  return t->kind == BT_THING_ARROW ? t->to : t->at;
}

static int
label_rank (const bt_thing *t)
{
  switch (t->kind)
    {
    case BT_THING_VEHICLE:
      return 0;
    case BT_THING_LABEL:
      return 1;
    case BT_THING_MARK:
      return 2;
    default:
      return 3;
    }
}

static int
by_label_rank (const void *a, const void *b)
{
  const label *p = a, *q = b;
  if (p->rank != q->rank)
    return p->rank - q->rank;
  return (p->turn > q->turn) - (p->turn < q->turn);
}

static size_t
gather_labels (const bt__pen *pen, const bt_view *view, const bt__optics *optics, label *found)
{
  size_t n = 0;
  for (size_t i = 0; i < view->n; i++)
    {
      label l = { .thing = &view->things[i], .turn = i };
      if (!l.thing->text || !*l.thing->text
          || !bt__project (optics, label_place (l.thing), pen->width, pen->height, &l.x, &l.y)
          || l.x < 0 || l.x > pen->width || l.y < 0 || l.y > pen->height)
        continue;
      l.rank = label_rank (l.thing);
      found[n++] = l;
    }
  qsort (found, n, sizeof *found, by_label_rank);
  return n;
}

/* The box of TEXT in the K-th direction from (X, Y), GAP away.  */
static bt__box
box_beside (bt__pen *pen, double x, double y, const char *text, double gap, int k)
{
  /* right, left, and the more awkward ones */
  static const double way[DIRECTIONS][2]
      = { { 1, -0.2 },    { -1, -0.2 },  { 0.7, -0.9 }, { 0.7, 0.9 },
          { -0.7, -0.9 }, { -0.7, 0.9 }, { 0, -1 },     { 0, 1 } };
  bt__box b = bt__pen_box (pen, 0, 0, text);
  double cx = x + gap * way[k][0], cy = y + gap * way[k][1];
  b.x = way[k][0] > 0.1 ? cx : way[k][0] < -0.1 ? cx - b.w : cx - b.w / 2;
  b.y = cy - b.h / 2 + (fabs (way[k][1]) > 0.5 ? way[k][1] * b.h / 2 : 0);
  return b;
}

/* From the label's thing to the nearest point of its box.  */
static void
draw_leader (bt__pen *pen, double x, double y, const bt__box *b)
{
  double tx = fmin (fmax (x, b->x), b->x + b->w), ty = fmin (fmax (y, b->y), b->y + b->h);
  double d = hypot (tx - x, ty - y), e = pen->letter;
  if (d < 1.6 * e)
    return;
  cairo_move_to (pen->cr, x + (tx - x) * 0.4 * e / d, y + (ty - y) * 0.4 * e / d);
  cairo_line_to (pen->cr, tx - (tx - x) * 0.2 * e / d, ty - (ty - y) * 0.2 * e / d);
  bt__pen_stroke (pen, fmax (0.7, 0.05 * e));
}

static int
are_apart (const bt__box *a, const bt__box *b)
{
  return a->x > b->x + b->w || b->x > a->x + a->w || a->y > b->y + b->h || b->y > a->y + a->h;
}

/* ---- What labels should not cover ---- */

/* Add the point P of a thing of radius R, m.  */
static void
shun_point (spots *s, const bt__pen *pen, const bt__optics *o, bt_vec3 p, double r)
{
  spot here = { .r = 0 };
  double away = o->perspective ? bt__dot (bt__sub (p, o->eye), o->ahead) : 1;
  if (s->n == SPOTS || !bt__project (o, p, pen->width, pen->height, &here.x, &here.y))
    return;
  here.r = fmax (r * pen->height / (2 * o->half_height * away), 0.1 * pen->letter);
  s->at[s->n++] = here;
}

static void
shun_thing (spots *s, const bt__pen *pen, const bt__optics *o, const bt_thing *t)
{
  int tube = t->kind == BT_THING_TUBE && t->framing == BT_FRAME_MUST;
  if (t->kind == BT_THING_VEHICLE)
    {
      bt__lens lens = bt__lens_of (o, pen->height, 0);
      shun_point (s, pen, o, t->at, 0.5 * t->size.y * bt__vehicle_growth (&lens, t));
    }
  else if (t->kind == BT_THING_ANCHOR)
    shun_point (s, pen, o, t->at, t->size.y);
  else if (t->kind == BT_THING_ARROW || (tube && t->n > 0))
    for (int i = 0; i < ALONG; i++)
      {
        double share = (double)i / (ALONG - 1);
        bt_vec3 p = bt__axpy (bt__scale (1 - share, t->from), share, t->to);
        shun_point (s, pen, o, tube ? t->points[(size_t)(share * (double)(t->n - 1))] : p,
                    t->radius);
      }
}

/* How many of the spots the box B covers.  */
static int
covered (const spots *s, const bt__box *b)
{
  int n = 0;
  for (int i = 0; i < s->n; i++)
    {
      const spot *p = &s->at[i];
      n += p->x + p->r > b->x && p->x - p->r < b->x + b->w && p->y + p->r > b->y
           && p->y - p->r < b->y + b->h;
    }
  return n;
}

/* ---- Places ---- */

/* Find the place for TEXT beside (X, Y), but not on the box KEPT (or NULL): of the free boxes the
   nearest of those that cover least; return true if a box was free.  */
static int
best_place (bt__pen *pen, const spots *s, double x, double y, const char *text, const bt__box *kept,
            bt__box *place)
{
  static const double gap[] = { 0.7, 1.7, 3, 4.6, 6.5 };
  int least = SPOTS + 1;
  for (size_t i = 0; i < sizeof gap / sizeof *gap && least > 0; i++)
    for (int k = 0; k < DIRECTIONS && least > 0; k++)
      {
        bt__box b = box_beside (pen, x, y, text, gap[i] * pen->letter, k);
        int over = covered (s, &b);
        if (over >= least || !bt__pen_free (pen, &b) || (kept && !are_apart (&b, kept)))
          continue;
        least = over;
        *place = b;
      }
  return least <= SPOTS;
}

/* Write TEXT at its place, with a leader; return true if there is one.  */
static int
write_beside (bt__pen *pen, const spots *s, double x, double y, const char *text,
              const bt__box *kept)
{
  bt__box b;
  if (!best_place (pen, s, x, y, text, kept, &b))
    return 0;
  draw_leader (pen, x, y, &b);
  bt__pen_text_in (pen, &b, text);
  return 1;
}

/* Number the label L as the I-th of the list, if there is room for both the number and the entry.
 */
static int
write_numbered (bt__pen *pen, const spots *s, const label *l, int i)
{
  char number[16], entry[160];
  double e = pen->letter;
  bt__box b;
  snprintf (number, sizeof number, "%d", i + 1);
  snprintf (entry, sizeof entry, "%d  %.140s", i + 1, l->thing->text);
  b = bt__pen_box (pen, 1.2 * e, (5 + 1.35 * i) * e, entry);
  if (b.y + b.h > 0.75 * pen->height || !bt__pen_free (pen, &b))
    return 0;
  if (!write_beside (pen, s, l->x, l->y, number, &b))
    return 0;
  bt__pen_text_in (pen, &b, entry);
  return 1;
}

void
bt__write_labels (bt__pen *pen, const bt_view *view, const bt__optics *optics)
{
  label *found = malloc ((view->n + 1) * sizeof *found);
  size_t n = found ? gather_labels (pen, view, optics, found) : 0;
  int written = 0, entries = 0;
  spots s = { .n = 0 };
  for (size_t i = 0; n > 0 && i < view->n; i++)
    shun_thing (&s, pen, optics, &view->things[i]);
  for (size_t i = 0; i < n; i++)
    {
      if (written < WRITTEN
          && write_beside (pen, &s, found[i].x, found[i].y, found[i].thing->text, NULL))
        {
          written++;
          continue;
        }
      if (entries < NUMBERED)
        entries += write_numbered (pen, &s, &found[i], entries);
    }
  free (found);
}
