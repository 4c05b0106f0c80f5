/* Pictures: pixels in memory, and as PNG in a file.

   A picture is written to a part file beside its place, and a whole part file then takes the name:
   a full disk never costs the old picture.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "base/error.h"
#include "render/png.h"
#include "render/render.h"

bt_status
bt__picture_new (bt__picture *picture, int width, int height, bt_error *error)
{
  picture->pixels = calloc ((size_t)width * (size_t)height, sizeof *picture->pixels);
  picture->width = width;
  picture->height = height;
  if (!picture->pixels)
    return bt__fail (error, BT_ERR_LIMIT, "there is no memory left for %d x %d pixels", width,
                     height);
  return BT_OK;
}

void
bt__picture_free (bt__picture *picture)
{
  free (picture->pixels);
  picture->pixels = NULL;
}

static bt_status
cannot_write (const char *file, int why, bt_error *error)
{
  return bt__fail (error, BT_ERR_IO, "cannot write \"%.200s\": %s", file,
                   why ? strerror (why) : "the picture could not be encoded");
}

/* Write to the file PART, then rename PART to FILE unless FILE is NULL.  */
static bt_status
write_part (const bt__picture *picture, const char *part, const char *file, bt_error *error)
{
  FILE *stream = fopen (part, "wb");
  const char *name = file ? file : part;
  int ok, why;
  if (!stream)
    return cannot_write (name, errno, error);
  errno = 0;
  ok = bt__png_write (picture, stream);
  why = errno;
  if (fclose (stream) != 0 && ok)
    ok = 0, why = errno;
  if (ok && file && rename (part, file) != 0)
    ok = 0, why = errno;
  if (ok)
    return BT_OK;
  if (file)
    unlink (part);
  return cannot_write (name, why, error);
}

/* A device or a pipe is written to, never replaced.  */
static int
is_special (const char *file)
{
  struct stat s;
  return stat (file, &s) == 0 && !S_ISREG (s.st_mode) && !S_ISDIR (s.st_mode);
}

bt_status
bt__picture_write (const bt__picture *picture, const char *file, bt_error *error)
{
  size_t size = strlen (file) + 32;
  char *part;
  bt_status status;
  if (is_special (file))
    return write_part (picture, file, NULL, error);
  if (!(part = malloc (size)))
    return cannot_write (file, ENOMEM, error);
  snprintf (part, size, "%s.%ld.part", file, (long)getpid ());
  status = write_part (picture, part, file, error);
  free (part);
  return status;
}
