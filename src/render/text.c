/* A pen for pictures: text, strokes and boxes on finished pixels, by cairo.

   The size of letters is a fortieth of the picture's height, between 10.5 and 160 pixels.  Text and
   strokes are drawn twice, a wide halo and then the ink, to be read on any background: white ink on
   water, dark ink on paper.  The pen remembers the boxes in use, so that labels find free places
   (labels.c); a pen without memory for another box has no free place left.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <math.h>

#include "base/error.h"
#include "render/text.h"

bt_status
bt__pen_open (bt__pen *pen, bt__picture *p, int paper, bt_error *error)
{
  *pen = (bt__pen){ .width = p->width, .height = p->height, .paper = paper };
  pen->letter = fmin (fmax (p->height / 40.0, 10.5), 160);
  pen->surface = cairo_image_surface_create_for_data (
      (unsigned char *)(void *)p->pixels, CAIRO_FORMAT_ARGB32, p->width, p->height, 4 * p->width);
  pen->cr = cairo_create (pen->surface);
  cairo_select_font_face (pen->cr, "sans-serif", CAIRO_FONT_SLANT_NORMAL, CAIRO_FONT_WEIGHT_NORMAL);
  cairo_set_font_size (pen->cr, pen->letter);
  cairo_set_line_join (pen->cr, CAIRO_LINE_JOIN_ROUND);
  cairo_set_line_cap (pen->cr, CAIRO_LINE_CAP_ROUND);
  if (cairo_status (pen->cr) == CAIRO_STATUS_SUCCESS)
    return BT_OK;
  bt__pen_close (pen, NULL);
  return bt__fail (error, BT_ERR_LIMIT, "there is no memory left to write on the picture");
}

bt_status
bt__pen_close (bt__pen *pen, bt_error *error)
{
  cairo_status_t status = cairo_status (pen->cr);
  cairo_destroy (pen->cr);
  cairo_surface_flush (pen->surface);
  cairo_surface_destroy (pen->surface);
  if (status == CAIRO_STATUS_SUCCESS)
    return BT_OK;
  return bt__fail (error, BT_ERR_LIMIT, "cannot write on the picture: %s",
                   cairo_status_to_string (status));
}

static void
ink (bt__pen *pen)
{
  double v = pen->paper ? 0.1 : 1;
  cairo_set_source_rgb (pen->cr, v, v, v);
}

static void
halo (bt__pen *pen)
{
  if (pen->paper)
    cairo_set_source_rgba (pen->cr, 1, 1, 1, 0.85);
  else
    cairo_set_source_rgba (pen->cr, 0, 0.08, 0.12, 0.55);
}

/* How far letters reach above and below their base line, of their size.  */
#define ASCENT 0.82
#define DESCENT 0.24

bt__box
bt__pen_box (bt__pen *pen, double x, double y, const char *text)
{
  cairo_matrix_t m;
  cairo_get_font_matrix (pen->cr, &m);
  return (bt__box){ x, y - ASCENT * m.yy, bt__pen_width (pen, text), (ASCENT + DESCENT) * m.yy };
}

void
bt__pen_take (bt__pen *pen, const bt__box *box)
{
  if (pen->n_taken < BT__BOXES)
    pen->taken[pen->n_taken++] = *box;
}

/* Nothing is free for a pen that cannot remember more.  */
int
bt__pen_free (const bt__pen *pen, const bt__box *b)
{
  double gap = 0.15 * pen->letter;
  int ok = pen->n_taken < BT__BOXES && b->x >= 0 && b->y >= 0 && b->x + b->w <= pen->width
           && b->y + b->h <= pen->height;
  for (int i = 0; ok && i < pen->n_taken; i++)
    {
      const bt__box *t = &pen->taken[i];
      ok = b->x > t->x + t->w + gap || t->x > b->x + b->w + gap || b->y > t->y + t->h + gap
           || t->y > b->y + b->h + gap;
    }
  return ok;
}

void
bt__pen_text_in (bt__pen *pen, const bt__box *box, const char *text)
{
  cairo_move_to (pen->cr, box->x, box->y + box->h * ASCENT / (ASCENT + DESCENT));
  cairo_text_path (pen->cr, text);
  halo (pen);
  cairo_set_line_width (pen->cr, 0.2 * pen->letter);
  cairo_stroke_preserve (pen->cr);
  ink (pen);
  cairo_fill (pen->cr);
  bt__pen_take (pen, box);
}

void
bt__pen_text (bt__pen *pen, double x, double y, double align, const char *text)
{
  bt__box box = bt__pen_box (pen, x, y, text);
  box.x = fmax (0, fmin (box.x - align * box.w, pen->width - box.w)); /* all of it can be read */
  bt__pen_text_in (pen, &box, text);
}

double
bt__pen_width (bt__pen *pen, const char *text)
{
  cairo_text_extents_t e;
  cairo_text_extents (pen->cr, text, &e);
  return e.x_advance;
}

void
bt__pen_stroke (bt__pen *pen, double width)
{
  halo (pen);
  cairo_set_line_width (pen->cr, width + 0.12 * pen->letter);
  cairo_stroke_preserve (pen->cr);
  ink (pen);
  cairo_set_line_width (pen->cr, width);
  cairo_stroke (pen->cr);
}

void
bt__pen_color (bt__pen *pen, bt_color c)
{
  cairo_set_source_rgb (pen->cr, (double)c.r, (double)c.g, (double)c.b);
}

double
bt__round_step (double x)
{
  double power = pow (10, floor (log10 (x))), m = x / power * (1 + 1e-9);
  return power * (m >= 5 ? 5 : m >= 2 ? 2 : 1);
}
