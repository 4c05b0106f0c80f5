/* The renderer: a view in, a picture out.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#ifndef BT_RENDER_RENDER_H
#define BT_RENDER_RENDER_H

#include <stdint.h>

#include <bight/view.h>

enum
{
  BT__SIDE_MAX = 8192, /* pixels of a picture's longer side */
  BT__SIDE_MIN = 16
};

/* A picture: rows from the top, each pixel alpha, red, green, blue from the highest byte of its
   word down, the colours multiplied by alpha.  */
typedef struct bt__picture
{
  int width, height;
  uint32_t *pixels;
} bt__picture;

bt_status bt__picture_new (bt__picture *picture, int width, int height, bt_error *error);
void bt__picture_free (bt__picture *picture);
/* Write PICTURE as PNG to FILE, whole or not at all.  BT_ERR_IO says why not.  */
bt_status bt__picture_write (const bt__picture *picture, const char *file, bt_error *error);

/* A context and what is kept in it.  */
typedef struct bt__renderer bt__renderer;

/* Open a renderer by BACKEND, "osmesa" or "egl"; NULL: the first that works, OSMesa before EGL,
   unless BIGHT_GL names one.  BT_ERR_UNSUPPORTED says in one line why there is none.  */
bt_status bt__renderer_new (const char *backend, bt__renderer **renderer, bt_error *error);
void bt__renderer_free (bt__renderer *renderer);
/* Return what draws, such as "OSMesa 4.5 (Core Profile) Mesa 22.3.6".  */
const char *bt__renderer_name (const bt__renderer *renderer);

typedef struct bt__drawing
{
  int width, height; /* pixels */
  int samples;       /* a pixel is the mean of this squared; 2 for stills */
  int transparent;   /* true: no water and no ground */
  int quick;         /* true: for a frame of many a second; plainer */
  int tile;          /* most pixels of a side drawn at once; 0: as suits */
} bt__drawing;

/* Draw VIEW into PICTURE, made here.  BT_ERR_DOMAIN for absurd sizes, BT_ERR_LIMIT without
   memory.  The same view gives the same bytes.  */
bt_status bt__render (bt__renderer *renderer, const bt_view *view, const bt__drawing *drawing,
                      bt__picture *picture, bt_error *error);

/* Draw what is read, not seen, over PICTURE of VIEW: title, labels, scale, compass, depth, legend
   (overlay.c); dark for PAPER true, else bright.  */
bt_status bt__overlay (const bt_view *view, bt__picture *picture, int paper, bt_error *error);

/* A part of a picture, pixels from its upper left corner.  */
typedef struct bt__box
{
  double x, y, w, h;
} bt__box;

/* Return how many boxes the words and figures over a picture of VIEW take, up to MOST of them into
   BOX; -1 without memory.  */
int bt__written (const bt_view *view, int width, int height, int paper, bt__box *box, int most);

/* Draw VIEW as a plan on paper into PICTURE, made here: no context is needed (plan.c).  */
bt_status bt__plan (const bt_view *view, const bt__drawing *drawing, bt__picture *picture,
                    bt_error *error);

/* Refuse absurd sizes with BT_ERR_DOMAIN.  */
bt_status bt__check_size (int width, int height, bt_error *error);

#endif
