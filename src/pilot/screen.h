/* A screen of characters: a picture in half blocks with words over the picture; only changed cells
   are written.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#ifndef BT_PILOT_SCREEN_H
#define BT_PILOT_SCREEN_H

#include <stddef.h>
#include <stdint.h>

#include <bight/status.h>

/* The colours of a terminal.  */
typedef enum bt__palette
{
  BT__PALETTE_NONE = 0, /* light and dark by characters alone */
  BT__PALETTE_16,
  BT__PALETTE_256,
  BT__PALETTE_TRUE,
  BT__PALETTES
} bt__palette;

/* Return the word for PALETTE: none, few, many, true; or NULL.  */
const char *bt__palette_name (bt__palette palette);

/* Colours are 0xRRGGBB; words have one more.  */
enum
{
  BT__DIMMED = -1 /* the background: the cell below, darker */
};

typedef struct bt__screen bt__screen;

/* Make a blank screen; with ASCII true, for a terminal without UTF-8, the screen is written in
   ASCII alone.  BT_ERR_LIMIT without memory or for absurd sizes.  */
bt_status bt__screen_new (int columns, int rows, bt__palette palette, int ascii,
                          bt__screen **screen, bt_error *error);
void bt__screen_free (bt__screen *screen);
int bt__screen_columns (const bt__screen *screen);
int bt__screen_rows (const bt__screen *screen);

/* Blank the whole screen.  */
void bt__screen_clear (bt__screen *screen);

/* Fill the screen with PIXELS, rows from the top, red, green and blue in the low 24 bits, COLUMNS
   by twice ROWS pixels.  With sixteen colours the picture is stretched to the full range of dark
   and light, and colours in between are mixed by dither.  */
void bt__screen_picture (bt__screen *screen, const uint32_t *pixels);

/* Put TEXT, UTF-8 of N bytes, each letter one cell wide, at COLUMN and ROW; letters outside the
   screen are left out.  */
void bt__screen_text (bt__screen *screen, int column, int row, const char *text, size_t n,
                      int32_t ink, int32_t paper);

/* Write to *BYTES, the screen's own memory, the changes since the last call, or the whole screen if
   ALL is true.  Return the number of bytes; *CELLS, unless NULL, receives the number of cells.  */
size_t bt__screen_changes (bt__screen *screen, int all, const char **bytes, int *cells);

#endif
