/* The figures on a picture: title, scale bar, compass, depths, legend.

   Figures are drawn by cairo on the finished pixels, in sizes of the pen's letter, so a small
   picture has the same layout as a large one.  Each figure takes its box from the pen; labels come
   last and make way for all figures (labels.c).  In a small picture only the scale is drawn.

   The scale bar holds at the distance looked at; its length is 1, 2 or 5 times a power of ten.
   Depths stand at the side of a level view alone, where height on the picture is height in the sea.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <math.h>
#include <stdio.h>

#include "math/vec.h"
#include "render/text.h"

enum
{
  LEAST = 7 /* pixels of letters that can be read */
};

/* ---- The scale bar ---- */

/* Pixels of a metre where the camera looks.  */
static double
pixels_per_metre (const bt__pen *pen, const bt_view *view, const bt__optics *o)
{
  double away = o->perspective ? bt__distance (view->camera.from, view->camera.at) : 1;
  return pen->width / (2 * o->half_width * away);
}

/* "the vehicle is drawn 3 times its size", or nothing.  */
static void
write_growth (bt__pen *pen, const bt_view *view, const bt__optics *o, double x, double y)
{
  bt__lens lens = bt__lens_of (o, pen->height, 0);
  char text[80];
  for (size_t i = 0; i < view->n; i++)
    {
      const bt_thing *t = &view->things[i];
      double growth = t->kind == BT_THING_VEHICLE ? bt__vehicle_growth (&lens, t) : 1;
      if (growth < 1.25)
        continue;
      snprintf (text, sizeof text, "vehicle drawn %.2g times its size", growth);
      bt__pen_text (pen, x, y, 0, text);
      return;
    }
}

static void
write_scale (bt__pen *pen, const bt_view *view, const bt__optics *o)
{
  double ppm = pixels_per_metre (pen, view, o), e = pen->letter;
  double length = bt__round_step (0.24 * pen->width / ppm), w = length * ppm;
  double x = 1.2 * e, y = pen->height - 1.2 * e;
  char text[60];
  snprintf (text, sizeof text, length < 0.01 ? "%g m" : "%.2g m", length);
  if (length >= 100)
    snprintf (text, sizeof text, "%.0f m", length);
  cairo_move_to (pen->cr, x, y - 0.4 * e);
  cairo_line_to (pen->cr, x, y);
  cairo_line_to (pen->cr, x + w, y);
  cairo_line_to (pen->cr, x + w, y - 0.4 * e);
  bt__pen_stroke (pen, fmax (1, 0.1 * e));
  bt__pen_text (pen, x + w / 2, y - 0.45 * e, 0.5, text);
  if (pen->width > 40 * e && !pen->paper)
    write_growth (pen, view, o, x + w + 1.2 * e, y);
}

/* ---- The compass: a disc that lies level, seen as the scene is ---- */

static void
compass_point (const bt__optics *o, double bearing, double r, double *x, double *y)
{
  bt_vec3 d = bt__vec (sin (bearing), cos (bearing), 0);
  bt_vec3 across = bt__unit_or (bt__vec (o->right.x, o->right.y, 0), bt__vec (1, 0, 0));
  double tilt = fmax (fabs (o->ahead.z), 0.38);
  bt_vec3 level = bt__vec (-across.y, across.x, 0); /* ahead, or up when looking down */
  *x = r * bt__dot (d, across);
  *y = -r * tilt * bt__dot (d, level);
}

static void
compass_line (bt__pen *pen, const bt__optics *o, double cx, double cy, double from, double to,
              double bearing)
{
  double x, y;
  compass_point (o, bearing, from, &x, &y);
  cairo_move_to (pen->cr, cx + x, cy + y);
  compass_point (o, bearing, to, &x, &y);
  cairo_line_to (pen->cr, cx + x, cy + y);
}

static void
compass_needle (bt__pen *pen, const bt__optics *o, double cx, double cy, double r)
{
  static const double bearing[] = { 0, 2.75, -2.75 }, reach[] = { 0.95, 0.45, 0.45 };
  for (int i = 0; i < 3; i++)
    {
      double x, y;
      compass_point (o, bearing[i], reach[i] * r, &x, &y);
      cairo_line_to (pen->cr, cx + x, cy + y);
    }
  cairo_close_path (pen->cr);
  cairo_set_source_rgb (pen->cr, 0.93, 0.33, 0.2);
  cairo_fill (pen->cr);
}

static void
write_compass (bt__pen *pen, const bt__optics *o)
{
  double r = 2.1 * pen->letter, cx = pen->width - 2 * r, cy = 1.7 * r, x, y;
  int before = pen->n_taken;
  for (int i = 0; i <= 48; i++)
    {
      compass_point (o, 2 * BT__PI * i / 48, r, &x, &y);
      cairo_line_to (pen->cr, cx + x, cy + y);
    }
  for (int i = 1; i < 4; i++)
    compass_line (pen, o, cx, cy, 0.8 * r, r, BT__PI / 2 * i);
  bt__pen_stroke (pen, fmax (1, 0.08 * pen->letter));
  compass_needle (pen, o, cx, cy, r);
  compass_point (o, 0, 1.42 * r, &x, &y);
  bt__pen_text (pen, cx + x, cy + y + 0.36 * pen->letter, 0.5, "N");
  pen->n_taken = before; /* the N is part of it */
  bt__pen_take (pen, &(bt__box){ cx - 1.6 * r, cy - 1.6 * r, 3.2 * r, 3.2 * r });
}

/* ---- Depths, beside a level view ---- */

static void
write_depths (bt__pen *pen, const bt_view *view, const bt__optics *o)
{
  double high = o->eye.z + o->half_height, low = o->eye.z - o->half_height;
  double step = bt__round_step ((high - low) / 4), e = pen->letter, x = 1.2 * e;
  double top = fmin (high, isfinite (view->surface) ? view->surface : high);
  for (double z = step * floor (top / step); z > low; z -= step)
    {
      double y = (high - z) / (high - low) * pen->height;
      char text[40];
      if (y < 4.2 * e || y > pen->height - 3.4 * e)
        continue;
      snprintf (text, sizeof text, "%g m", fabs (round (-z * 1e6) / 1e6));
      cairo_move_to (pen->cr, 0, y);
      cairo_line_to (pen->cr, x - 0.3 * e, y);
      bt__pen_stroke (pen, fmax (1, 0.08 * e));
      bt__pen_text (pen, x, y + 0.36 * e, 0, text);
    }
}

/* ---- The legend ---- */

static void
write_bar (bt__pen *pen, const bt_scale *scale, double x, double y, double w, double h)
{
  enum
  {
    STEPS = 64
  };
  for (int i = 0; i < STEPS; i++)
    {
      double t = (i + 0.5) / STEPS;
      bt__pen_color (pen, bt__scale_color (scale, scale->low + t * (scale->high - scale->low)));
      cairo_rectangle (pen->cr, x + w * i / STEPS, y, w / STEPS + 0.6, h);
      cairo_fill (pen->cr);
    }
  cairo_rectangle (pen->cr, x, y, w, h);
  bt__pen_stroke (pen, fmax (0.7, 0.05 * pen->letter));
  bt__pen_take (pen, &(bt__box){ x, y, w, h });
}

static void
write_number_scale (bt__pen *pen, const bt_scale *scale)
{
  double e = pen->letter, w = 12 * e, h = 0.75 * e;
  double x = pen->width - w - 2 * e, y = pen->height - 2.9 * e;
  char text[120];
  if (scale->unit && *scale->unit)
    snprintf (text, sizeof text, "%s, %s", scale->name, scale->unit);
  else
    snprintf (text, sizeof text, "%s", scale->name);
  bt__pen_text (pen, x + w / 2, y - 0.5 * e, 0.5, text);
  write_bar (pen, scale, x, y, w, h);
  for (int i = 0; i < 3; i++)
    {
      snprintf (text, sizeof text, "%.3g", scale->low + (scale->high - scale->low) * i / 2);
      bt__pen_text (pen, x + w * i / 2, y + h + 1.05 * e, 0.5, text);
    }
}

static void
write_word_scale (bt__pen *pen, const bt_scale *scale)
{
  double e = pen->letter, widest = bt__pen_width (pen, scale->name), x, y;
  for (int i = 0; i < scale->words; i++)
    widest = fmax (widest, 1.4 * e + bt__pen_width (pen, scale->word[i]));
  x = pen->width - widest - 1.5 * e;
  y = pen->height - 1.2 * e - 1.35 * e * (scale->words - 1);
  bt__pen_text (pen, x, y - 1.5 * e, 0, scale->name);
  for (int i = 0; i < scale->words; i++, y += 1.35 * e)
    {
      bt__pen_color (pen, bt__scale_color (scale, i));
      cairo_rectangle (pen->cr, x, y - 0.75 * e, 0.9 * e, 0.9 * e);
      cairo_fill (pen->cr);
      bt__pen_take (pen, &(bt__box){ x, y - 0.75 * e, 0.9 * e, 0.9 * e });
      bt__pen_text (pen, x + 1.4 * e, y, 0, scale->word[i]);
    }
}

static void
write_legend (bt__pen *pen, const bt_scale *scale)
{
  if (!scale->name)
    return;
  if (scale->word)
    write_word_scale (pen, scale);
  else
    write_number_scale (pen, scale);
}

/* ---- All of it ---- */

/* TEXT of SIZE letters at most, smaller if it would run into the compass; nothing if it could not
   be read then.  */
static void
write_line (bt__pen *pen, const char *text, double size, double y)
{
  double e = pen->letter, room = pen->width - 9 * e, share;
  cairo_set_font_size (pen->cr, size * e);
  share = fmin (1, room / bt__pen_width (pen, text));
  cairo_set_font_size (pen->cr, size * e * share);
  if (size * e * share >= LEAST)
    bt__pen_text (pen, 1.2 * e, y, 0, text);
  cairo_set_font_size (pen->cr, e);
}

/* Nothing else stands in the lines of the title.  */
static void
write_title (bt__pen *pen, const bt_view *view)
{
  double e = pen->letter;
  int before = pen->n_taken;
  if (!view->title && !view->note)
    return;
  if (view->title)
    write_line (pen, view->title, 1, 1.9 * e);
  if (view->note)
    write_line (pen, view->note, fmax (0.82, fmin (1, 10 / e)), 3.2 * e);
  pen->n_taken = before;
  bt__pen_take (pen, &(bt__box){ 0, 0, pen->width - 7.8 * e, 3.6 * e });
}

/* Write all that is read, with the pen.  In a small picture there is room for the scale alone.  */
static void
write_figures (bt__pen *pen, const bt_view *view, const bt__optics *o)
{
  int small = pen->width < 24 * pen->letter || pen->height < 16 * pen->letter;
  write_scale (pen, view, o);
  if (small)
    return;
  write_title (pen, view);
  write_compass (pen, o);
  if (!o->perspective && fabs (o->ahead.z) < 0.3)
    write_depths (pen, view, o);
  write_legend (pen, &view->scale);
  bt__write_labels (pen, view, o); /* last: they make way for all the others */
}

bt_status
bt__overlay (const bt_view *view, bt__picture *picture, int paper, bt_error *error)
{
  bt__optics optics = bt__optics_of (&view->camera, (double)picture->width / picture->height);
  bt__pen pen;
  bt_status status = bt__pen_open (&pen, picture, paper, error);
  if (status != BT_OK)
    return status;
  write_figures (&pen, view, &optics);
  return bt__pen_close (&pen, error);
}

int
bt__written (const bt_view *view, int width, int height, int paper, bt__box *box, int most)
{
  bt__optics optics = bt__optics_of (&view->camera, (double)width / height);
  bt__picture picture;
  bt__pen pen;
  int n = -1;
  if (bt__picture_new (&picture, width, height, NULL) != BT_OK)
    return n;
  if (bt__pen_open (&pen, &picture, paper, NULL) == BT_OK)
    {
      write_figures (&pen, view, &optics);
      n = pen.n_taken;
      for (int i = 0; i < n && i < most; i++)
        box[i] = pen.taken[i];
      bt__pen_close (&pen, NULL);
    }
  bt__picture_free (&picture);
  return n;
}
