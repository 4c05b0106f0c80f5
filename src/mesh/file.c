/* Opening a file: missing names, folders, pipes, empty and absurdly large files end here.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <config.h>

#include <errno.h>
#include <fcntl.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "base/error.h"
#include "mesh/file.h"

enum
{
  TAIL = 150
};

const char *
bt__file_tail (const char *file)
{
  size_t n = strlen (file);
  const char *tail = n > TAIL ? file + (n - TAIL) : file;
  while ((*tail & 0xc0) == 0x80) /* not within a character of UTF-8 */
    tail++;
  return tail;
}

static bt_status
check_kind (const char *name, const struct stat *st, uint64_t most, bt_error *error)
{
  if (S_ISDIR (st->st_mode))
    return bt__fail (error, BT_ERR_IO, "%s is a folder; the name of a file is wanted", name);
  if (!S_ISREG (st->st_mode))
    return bt__fail (error, BT_ERR_IO, "%s is a device or pipe; a file is wanted", name);
  if (st->st_size == 0)
    return bt__fail (error, BT_ERR_IO, "%s is empty", name);
  if ((uint64_t)st->st_size > most)
    return bt__fail (error, BT_ERR_LIMIT, "%s has %.0f MB; at most %.0f are read", name,
                     (double)st->st_size * 1e-6, (double)most * 1e-6);
  return BT_OK;
}

bt_status
bt__file_open (const char *file, uint64_t most, int *fd, uint64_t *size, bt_error *error)
{
  const char *name = bt__file_tail (file);
  struct stat st;
  bt_status s = BT_OK;
  *fd = open (file, O_RDONLY | O_CLOEXEC | O_NONBLOCK | O_NOCTTY); /* a pipe must not hold us */
  if (*fd < 0 || fstat (*fd, &st) != 0)
    s = bt__fail (error, BT_ERR_IO, "%s cannot be read: %s", name, strerror (errno));
  else
    s = check_kind (name, &st, most, error);
  if (s == BT_OK)
    *size = (uint64_t)st.st_size;
  else if (*fd >= 0)
    {
      close (*fd);
      *fd = -1;
    }
  return s;
}
