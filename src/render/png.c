/* Pictures as PNG, by libpng, quickly.

   A picture of water has a step of noise in every pixel. zlib's usual level spends four fifths of
   its time searching the noise for what repeats, for a seventh of the size, and finds little else.
   Therefore zlib looks for runs of one byte alone (Z_RLE), which flat parts have after PNG's filter
   `sub', the difference from the pixel before.  An opaque picture has no alpha.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <errno.h>
#include <setjmp.h>
#include <stdlib.h>

#include <png.h>
#include <zlib.h>

#include "render/png.h"

static int
is_opaque (const bt__picture *p)
{
  uint32_t all = UINT32_MAX;
  size_t n = (size_t)p->width * (size_t)p->height;
  for (size_t i = 0; i < n; i++)
    all &= p->pixels[i];
  return all >> 24 == 255;
}

/* The colour X, which was multiplied by ALPHA.  */
static unsigned char
divided (uint32_t x, uint32_t alpha)
{
  uint32_t y = alpha ? (x * 255 + alpha / 2) / alpha : 0;
  return (unsigned char)(y > 255 ? 255 : y);
}

/* Row Y as bytes.  */
static void
unpack (const bt__picture *p, int y, int opaque, unsigned char *to)
{
  const uint32_t *pixel = p->pixels + (size_t)y * (size_t)p->width;
  for (int i = 0; opaque && i < p->width; i++)
    for (int k = 0; k < 3; k++)
      to[3 * i + k] = (unsigned char)(pixel[i] >> (16 - 8 * k));
  for (int i = 0; !opaque && i < p->width; i++)
    {
      uint32_t alpha = pixel[i] >> 24;
      for (int k = 0; k < 3; k++)
        to[4 * i + k] = divided (pixel[i] >> (16 - 8 * k) & 255, alpha);
      to[4 * i + 3] = (unsigned char)alpha;
    }
}

/* libpng's own handlers print; the caller tells of a failure.  */
static void
leave (png_structp png, png_const_charp text)
{
  (void)text;
  png_longjmp (png, 1);
}

static void
keep_silent (png_structp png, png_const_charp text)
{
  (void)png;
  (void)text;
}

static void
write_rows (png_structp png, png_infop info, const bt__picture *p, unsigned char *row)
{
  int opaque = is_opaque (p);
  png_set_IHDR (png, info, (png_uint_32)p->width, (png_uint_32)p->height, 8,
                opaque ? PNG_COLOR_TYPE_RGB : PNG_COLOR_TYPE_RGB_ALPHA, PNG_INTERLACE_NONE,
                PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
  png_set_compression_level (png, 1);
  png_set_compression_strategy (png, Z_RLE);
  png_set_filter (png, PNG_FILTER_TYPE_BASE, PNG_FILTER_SUB);
  png_write_info (png, info);
  for (int y = 0; y < p->height; y++)
    {
      unpack (p, y, opaque, row);
      png_write_row (png, row);
    }
  png_write_end (png, NULL);
}

/* All of writing that libpng may leave by a jump; ROW and INFO are set before.  */
static int
write_to (png_structp png, png_infop info, const bt__picture *p, FILE *stream, unsigned char *row)
{
  if (setjmp (png_jmpbuf (png)))
    return 0;
  png_init_io (png, stream);
  write_rows (png, info, p, row);
  return 1;
}

int
bt__png_write (const bt__picture *p, FILE *stream)
{
  png_structp png = png_create_write_struct (PNG_LIBPNG_VER_STRING, NULL, leave, keep_silent);
  png_infop info = png ? png_create_info_struct (png) : NULL;
  unsigned char *row = malloc (4 * (size_t)p->width);
  int ok = 0;
  if (info && row)
    ok = write_to (png, info, p, stream, row);
  else
    errno = ENOMEM;
  png_destroy_write_struct (&png, &info);
  free (row);
  return ok;
}
