/* PNG, quickly: a picture of water has a step of noise in every pixel.  zlib's usual level spends
   four fifths of its time searching the noise, for a seventh of the size.

   Each byte is the difference from the pixel before (PNG's filter 1), compressed at zlib's first
   level.  An opaque picture has no alpha.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <stdlib.h>
#include <string.h>

#include <zlib.h>

#include "render/png.h"

enum
{
  SUB = 1, /* PNG's filter: from the pixel before */
  RGB = 2,
  RGBA = 6 /* PNG's types of colour */
};

static int
is_opaque (const bt__picture *p)
{
  uint32_t all = UINT32_MAX;
  size_t n = (size_t)p->width * (size_t)p->height;
  for (size_t i = 0; i < n; i++)
    all &= p->pixels[i];
  return all >> 24 == 255;
}

static void
put_big_endian (unsigned char *to, uint32_t x)
{
  for (int i = 0; i < 4; i++)
    to[i] = (unsigned char)(x >> (24 - 8 * i));
}

static int
write_chunk (FILE *stream, const char *name, const unsigned char *bytes, size_t n)
{
  unsigned char head[8], tail[4];
  uLong sum = crc32 (0, (const Bytef *)name, 4);
  put_big_endian (head, (uint32_t)n);
  memcpy (head + 4, name, 4);
  put_big_endian (tail, (uint32_t)crc32_z (sum, bytes, n));
  return fwrite (head, 1, 8, stream) == 8 && fwrite (bytes, 1, n, stream) == n
         && fwrite (tail, 1, 4, stream) == 4;
}

static int
write_head (FILE *stream, const bt__picture *p, int opaque)
{
  static const unsigned char signature[] = { 0x89, 'P', 'N', 'G', '\r', '\n', 0x1a, '\n' };
  unsigned char head[13] = { [8] = 8, [9] = (unsigned char)(opaque ? RGB : RGBA) };
  put_big_endian (head, (uint32_t)p->width);
  put_big_endian (head + 4, (uint32_t)p->height);
  return fwrite (signature, 1, sizeof signature, stream) == sizeof signature
         && write_chunk (stream, "IHDR", head, sizeof head);
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

static void
filter (const unsigned char *row, size_t n, size_t step, unsigned char *to)
{
  *to++ = SUB;
  memcpy (to, row, step);
  for (size_t i = step; i < n; i++)
    to[i] = (unsigned char)(row[i] - row[i - step]);
}

/* All rows, filtered and compressed, into *BYTES, N of them; what it returns is true on success. */
static int
compress_rows (const bt__picture *p, int opaque, unsigned char *row, unsigned char **bytes,
               size_t *n)
{
  size_t step = opaque ? 3 : 4, long_row = step * (size_t)p->width;
  unsigned char *line = row + long_row;
  z_stream z = { .zalloc = NULL };
  int state = Z_OK;
  uLong room;
  if (deflateInit (&z, 1) != Z_OK)
    return 0;
  room = deflateBound (&z, (uLong)((long_row + 1) * (size_t)p->height));
  if ((*bytes = malloc (room)))
    {
      z.next_out = *bytes;
      z.avail_out = (uInt)room;
      for (int y = 0; y < p->height && state == Z_OK; y++)
        {
          unpack (p, y, opaque, row);
          filter (row, long_row, step, line);
          z.next_in = line;
          z.avail_in = (uInt)(long_row + 1);
          state = deflate (&z, y + 1 < p->height ? Z_NO_FLUSH : Z_FINISH);
        }
      *n = z.total_out;
    }
  deflateEnd (&z);
  return *bytes && state == Z_STREAM_END;
}

int
bt__png_write (const bt__picture *p, FILE *stream)
{
  int opaque = is_opaque (p), ok;
  unsigned char *row = malloc (8 * (size_t)p->width + 1), *bytes = NULL;
  size_t n = 0;
  ok = row && compress_rows (p, opaque, row, &bytes, &n) && write_head (stream, p, opaque)
       && write_chunk (stream, "IDAT", bytes, n)
       && write_chunk (stream, "IEND", (const unsigned char *)"", 0);
  free (bytes);
  free (row);
  return ok;
}
