/* Drawing on pictures: a pen with a size of letters, paper or water behind it.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#ifndef BT_RENDER_TEXT_H
#define BT_RENDER_TEXT_H

#include <cairo.h>

#include "render/camera.h"
#include "render/render.h"

enum
{
  BT__BOXES = 96
};

typedef struct bt__pen
{
  cairo_t *cr;
  cairo_surface_t *surface;
  int width, height;
  double letter;            /* height of the letters, pixels */
  int paper;                /* true: dark on white, else white on water */
  bt__box taken[BT__BOXES]; /* boxes in use */
  int n_taken;
} bt__pen;

bt_status bt__pen_open (bt__pen *pen, bt__picture *picture, int paper, bt_error *error);
/* Finish; fail unless all was drawn.  */
bt_status bt__pen_close (bt__pen *pen, bt_error *error);

/* Write TEXT with its left (ALIGN 0), middle (0.5) or right (1) end at X, the base line at Y.  */
void bt__pen_text (bt__pen *pen, double x, double y, double align, const char *text);
double bt__pen_width (bt__pen *pen, const char *text);

/* The box of TEXT with the left end at X, the base line at Y; text in a box; true if BOX is in the
   picture and free; take BOX for a figure.  */
bt__box bt__pen_box (bt__pen *pen, double x, double y, const char *text);
void bt__pen_text_in (bt__pen *pen, const bt__box *box, const char *text);
int bt__pen_free (const bt__pen *pen, const bt__box *box);
void bt__pen_take (bt__pen *pen, const bt__box *box);

/* Strokes: the path is drawn WIDTH pixels wide in the pen's ink, with a halo on water.  */
void bt__pen_stroke (bt__pen *pen, double width);
void bt__pen_color (bt__pen *pen, bt_color color);

/* 1, 2 or 5 times a power of ten, not above X.  */
double bt__round_step (double x);

/* The words beside things, where there is room (labels.c).  */
void bt__write_labels (bt__pen *pen, const bt_view *view, const bt__optics *optics);

#endif
