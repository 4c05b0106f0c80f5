/* Screens of characters: two layers of cells, wanted and shown, and the difference between them.

   A cell is a letter, a colour of the letter and a colour behind.  A picture uses the upper half
   block as the letter, so a cell shows two pixels.  Colours are first reduced to the palette of the
   terminal, then compared with the shown cell, so a cell that looks the same is not written, nor a
   colour already set, nor a move to the present place of the cursor.  In true colour a step of
   three of 256 counts as the same.

   Palettes: 256 colours are the nearest of xterm's cube of six levels or its 24 greys.  With
   sixteen colours a picture is stretched to the full range of dark and light, since the sea is dark
   and blue and would be two colours, and mixed by ordered dither with Bayer's matrix of four.
   Without colours letters of increasing brightness stand for pixels.  The range of brightness
   follows the picture slowly, so a film does not flicker.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <config.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/error.h"
#include "base/letter.h"
#include "pilot/screen.h"

enum
{
  CELL_BYTES = 64, /* bytes of a cell at most: a move, two colours, a letter */
  SIDE_MAX = 2000, /* cells */
  UPPER_HALF = 0x2580
};

#define DITHER                                                                                     \
  5.0 /* of 255, a step of the matrix: sixteen of them are most of what lies between two colours   \
       */

typedef struct cell
{
  uint32_t letter; /* Unicode */
  int32_t ink, paper;
} cell;

struct bt__screen
{
  int columns, rows;
  bt__palette palette;
  int ascii;
  double dark, light; /* of pictures in sixteen colours so far, 0 to 255 */
  cell *wanted, *shown;
  char *bytes;
  size_t n;
  int32_t ink, paper; /* as the terminal has them; -1: not known */
  int at;             /* the cell the cursor is at, or -1 */
};

const char *
bt__palette_name (bt__palette palette)
{
  static const char *const names[BT__PALETTES] = { "none", "few", "many", "true" };
  return (unsigned)palette < BT__PALETTES ? names[palette] : NULL;
}

/* ---- Life ---- */

static size_t
cells_of (const bt__screen *s)
{
  return (size_t)s->columns * (size_t)s->rows;
}

bt_status
bt__screen_new (int columns, int rows, bt__palette palette, int ascii, bt__screen **screen,
                bt_error *error)
{
  bt__screen *s;
  if (columns < 1 || rows < 1 || columns > SIDE_MAX || rows > SIDE_MAX)
    return bt__fail (error, BT_ERR_LIMIT, "a screen has 1 to %d columns and rows, not %d and %d",
                     SIDE_MAX, columns, rows);
  s = calloc (1, sizeof *s);
  if (s)
    {
      s->columns = columns;
      s->rows = rows;
      s->palette = palette;
      s->ascii = ascii;
      s->light = -1;
      s->wanted = calloc (cells_of (s), sizeof *s->wanted);
      s->shown = calloc (cells_of (s), sizeof *s->shown);
      s->bytes = malloc (cells_of (s) * CELL_BYTES + CELL_BYTES);
    }
  if (!s || !s->wanted || !s->shown || !s->bytes)
    {
      bt__screen_free (s);
      return bt__fail (error, BT_ERR_LIMIT, "there is no memory left for a screen");
    }
  bt__screen_clear (s);
  *screen = s;
  return BT_OK;
}

void
bt__screen_free (bt__screen *s)
{
  if (!s)
    return;
  free (s->wanted);
  free (s->shown);
  free (s->bytes);
  free (s);
}

int
bt__screen_columns (const bt__screen *s)
{
  return s->columns;
}

int
bt__screen_rows (const bt__screen *s)
{
  return s->rows;
}

/* ---- Colours ---- */

static int
channel (int32_t color, int shift)
{
  return (int)((color >> shift) & 255);
}

/* 0 to 255.  */
static int
light_of (int32_t color)
{
  return (54 * channel (color, 16) + 183 * channel (color, 8) + 19 * channel (color, 0)) >> 8;
}

static int
square (int x)
{
  return x * x;
}

static int
apart (int32_t a, int32_t b)
{
  return 2 * square (channel (a, 16) - channel (b, 16))
         + 4 * square (channel (a, 8) - channel (b, 8)) + square (channel (a, 0) - channel (b, 0));
}

/* The nearest of xterm's 256: its cube of 6 levels or its 24 greys.  */
static int32_t
nearest_of_256 (int32_t color)
{
  static const int level[] = { 0, 95, 135, 175, 215, 255 };
  int index[3], grey = (light_of (color) - 3) / 10;
  int32_t cube = 0, tone;
  for (int i = 0; i < 3; i++)
    {
      int v = channel (color, 16 - 8 * i);
      index[i] = v < 48 ? 0 : v < 115 ? 1 : (v - 35) / 40;
      cube = cube << 8 | level[index[i]];
    }
  grey = grey < 0 ? 0 : grey > 23 ? 23 : grey;
  tone = (8 + 10 * grey) * 0x010101;
  return apart (color, tone) < apart (color, cube) ? 232 + grey
                                                   : 16 + 36 * index[0] + 6 * index[1] + index[2];
}

/* As xterm has the first sixteen.  */
static int32_t
nearest_of_16 (int32_t color)
{
  static const int32_t sixteen[]
      = { 0x000000, 0xcd0000, 0x00cd00, 0xcdcd00, 0x0000ee, 0xcd00cd, 0x00cdcd, 0xe5e5e5,
          0x7f7f7f, 0xff0000, 0x00ff00, 0xffff00, 0x5c5cff, 0xff00ff, 0x00ffff, 0xffffff };
  int best = 0;
  for (int i = 1; i < 16; i++)
    if (apart (color, sixteen[i]) < apart (color, sixteen[best]))
      best = i;
  return best;
}

/* COLOR as the terminal counts them.  */
static int32_t
on_terminal (const bt__screen *s, int32_t color)
{
  switch (s->palette)
    {
    case BT__PALETTE_TRUE:
      return color;
    case BT__PALETTE_256:
      return nearest_of_256 (color);
    case BT__PALETTE_16:
      return nearest_of_16 (color);
    default:
      return 0;
    }
}

/* COLOR darkened enough for words to be read on it.  */
static int32_t
dimmed (int32_t color)
{
  return (color >> 2) & 0x3f3f3f;
}

/* ---- Filling ---- */

void
bt__screen_clear (bt__screen *s)
{
  for (size_t i = 0; i < cells_of (s); i++)
    s->wanted[i] = (cell){ ' ', 0xffffff, 0 };
}

/* A letter as bright as LIGHT.  */
static uint32_t
letter_for (int light)
{
  static const char ramp[] = " .:-=+*%#@";
  return (uint32_t)ramp[light * (int)(sizeof ramp - 1) / 256];
}

/* ---- Sixteen colours: the sea is dark and blue, and would be two of them ---- */

/* The brightness that SHARE of the N pixels stay below.  */
static int
light_below (const size_t count[256], size_t n, double share)
{
  size_t sum = 0;
  int light = 0;
  while (light < 255 && (double)(sum += count[light]) < share * (double)n)
    light++;
  return light;
}

/* Follow the darkest and the lightest of PIXELS slowly: a picture does not flicker.  */
static void
look_at_light (bt__screen *s, const uint32_t *pixels)
{
  size_t n = 2 * cells_of (s), count[256] = { 0 };
  for (size_t i = 0; i < n; i++)
    count[light_of ((int32_t)(pixels[i] & 0xffffff))]++;
  double dark = light_below (count, n, 0.02), light = light_below (count, n, 0.995);
  double share = s->light < 0 ? 1 : 0.1; /* the first look is believed */
  s->dark += share * (dark - s->dark);
  s->light += share * (light - s->light);
}

/* COLOR stretched, and moved by AWAY, a share of the step between two colours.  */
static int32_t
stretched (const bt__screen *s, int32_t color, double away)
{
  double scale = 255 / fmax (s->light - s->dark, 24);
  int32_t out = 0;
  for (int shift = 16; shift >= 0; shift -= 8)
    {
      double v = (channel (color, shift) - s->dark) * scale + away;
      out |= (int32_t)fmin (fmax (v, 0), 255) << shift;
    }
  return out;
}

/* The pixel at X, Y of the terminal's picture: ordered dither by Bayer's matrix of four.  */
static int32_t
pixel_for (const bt__screen *s, uint32_t pixel, int x, int y)
{
  static const int bayer[4][4]
      = { { 0, 8, 2, 10 }, { 12, 4, 14, 6 }, { 3, 11, 1, 9 }, { 15, 7, 13, 5 } };
  int32_t color = (int32_t)(pixel & 0xffffff);
  if (s->palette != BT__PALETTE_16)
    return color;
  return stretched (s, color, (bayer[y & 3][x & 3] - 7.5) * DITHER);
}

/* The mean of two colours.  */
static int32_t
between (int32_t a, int32_t b)
{
  return ((a >> 1) & 0x7f7f7f) + ((b >> 1) & 0x7f7f7f);
}

static cell
picture_cell (const bt__screen *s, int32_t above, int32_t below)
{
  cell c = { UPPER_HALF, above, below };
  if (s->palette == BT__PALETTE_NONE)
    c.letter = letter_for ((light_of (above) + light_of (below)) / 2);
  else if (s->ascii)
    c = (cell){ ' ', above, between (above, below) };
  return c;
}

void
bt__screen_picture (bt__screen *s, const uint32_t *pixels)
{
  if (s->palette == BT__PALETTE_16)
    look_at_light (s, pixels);
  for (int row = 0; row < s->rows; row++)
    for (int column = 0; column < s->columns; column++)
      {
        const uint32_t *p = pixels + (size_t)(2 * row) * (size_t)s->columns + column;
        int32_t above = pixel_for (s, p[0], column, 2 * row);
        int32_t below = pixel_for (s, p[s->columns], column, 2 * row + 1);
        s->wanted[row * s->columns + column] = picture_cell (s, above, below);
      }
}

/* The letter at TEXT, of at most LEFT bytes, and how many it takes; a stray byte, and what a
   terminal would obey, is a question mark.  */
static int
decode (const char *text, size_t left, uint32_t *letter)
{
  unsigned char lead = (unsigned char)text[0];
  int n = lead < 0x80 ? 1 : lead >> 5 == 6 ? 2 : lead >> 4 == 14 ? 3 : lead >> 3 == 30 ? 4 : 0;
  *letter = '?';
  if (n == 0 || (size_t)n > left)
    return 1;
  *letter = n == 1 ? lead : lead & (0x7fU >> n);
  for (int i = 1; i < n; i++)
    *letter = *letter << 6 | ((unsigned char)text[i] & 0x3fU);
  if (bt__is_control (*letter))
    *letter = '?';
  return n;
}

void
bt__screen_text (bt__screen *s, int column, int row, const char *text, size_t n, int32_t ink,
                 int32_t paper)
{
  for (size_t i = 0; i < n; column++)
    {
      uint32_t letter;
      i += (size_t)decode (text + i, n - i, &letter);
      if (row < 0 || row >= s->rows || column < 0 || column >= s->columns)
        continue;
      cell *c = &s->wanted[row * s->columns + column];
      c->paper = paper == BT__DIMMED ? dimmed (c->paper) : paper;
      c->ink = ink;
      c->letter = s->ascii && letter > 126 ? '?' : letter;
    }
}

/* ---- Writing ---- */

static void
put_text (bt__screen *s, const char *text)
{
  size_t n = strlen (text);
  memcpy (s->bytes + s->n, text, n);
  s->n += n;
}

static void
put_letter (bt__screen *s, uint32_t u)
{
  char *p = s->bytes + s->n;
  int n = u < 0x80 ? 1 : u < 0x800 ? 2 : u < 0x10000 ? 3 : 4;
  if (n == 1)
    *p = (char)u;
  for (int i = n; n > 1 && i-- > 0; u >>= 6)
    p[i] = (char)(i ? 0x80U | (u & 0x3fU) : (0xf00U >> n & 0xffU) | u);
  s->n += (size_t)n;
}

/* Choose COLOR, the terminal's own number, in front or BEHIND.  */
static void
put_color (bt__screen *s, int32_t color, int behind)
{
  char text[32];
  if (s->palette == BT__PALETTE_TRUE)
    snprintf (text, sizeof text, "\033[%d;2;%d;%d;%dm", behind ? 48 : 38, channel (color, 16),
              channel (color, 8), channel (color, 0));
  else if (s->palette == BT__PALETTE_256)
    snprintf (text, sizeof text, "\033[%d;5;%dm", behind ? 48 : 38, (int)color);
  else
    snprintf (text, sizeof text, "\033[%dm",
              (int)(color < 8 ? 30 + color : 82 + color) + (behind ? 10 : 0));
  put_text (s, text);
}

static int
same_color (const bt__screen *s, int32_t a, int32_t b)
{
  if (s->palette != BT__PALETTE_TRUE || a < 0 || b < 0)
    return a == b;
  return abs (channel (a, 16) - channel (b, 16)) < 4 && abs (channel (a, 8) - channel (b, 8)) < 4
         && abs (channel (a, 0) - channel (b, 0)) < 4;
}

/* The cell at I in the colours of the terminal: a half block with equal colours is a blank.  */
static cell
on_screen (const bt__screen *s, size_t i)
{
  cell c = s->wanted[i];
  c.ink = on_terminal (s, c.ink);
  c.paper = on_terminal (s, c.paper);
  if (c.letter == UPPER_HALF && c.ink == c.paper)
    c.letter = ' ';
  return c;
}

static int
looks_the_same (const bt__screen *s, cell a, cell b)
{
  return a.letter == b.letter && same_color (s, a.paper, b.paper)
         && (a.letter == ' ' || same_color (s, a.ink, b.ink));
}

static void
put_cell (bt__screen *s, int i, cell c)
{
  char text[32];
  if (s->at != i)
    {
      snprintf (text, sizeof text, "\033[%d;%dH", i / s->columns + 1, i % s->columns + 1);
      put_text (s, text);
    }
  if (s->palette != BT__PALETTE_NONE && c.paper != s->paper)
    put_color (s, s->paper = c.paper, 1);
  if (s->palette != BT__PALETTE_NONE && c.letter != ' ' && c.ink != s->ink)
    put_color (s, s->ink = c.ink, 0);
  put_letter (s, c.letter);
  s->at = (i + 1) % s->columns
              ? i + 1
              : -1; /* terminals differ in the place of the cursor at a line's end */
}

size_t
bt__screen_changes (bt__screen *s, int all, const char **bytes, int *cells)
{
  int changed = 0;
  s->n = 0;
  s->at = s->ink = s->paper = -1;
  if (all)
    put_text (s, "\033[0m\033[2J");
  for (size_t i = 0; i < cells_of (s); i++)
    {
      cell c = on_screen (s, i);
      if (!all && looks_the_same (s, c, s->shown[i]))
        continue;
      put_cell (s, (int)i, c);
      s->shown[i] = c;
      changed++;
    }
  if (changed)
    put_text (s, "\033[0m");
  *bytes = s->bytes;
  if (cells)
    *cells = changed;
  return s->n;
}
