/* Reading from file descriptors.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#ifndef BT_BASE_FD_H
#define BT_BASE_FD_H

#include <errno.h>
#include <stddef.h>
#include <unistd.h>

/* Read what is left of FD, at most SIZE bytes, to TO; return how many bytes were read.  Signals
   do not end the reading.  */
static inline size_t
bt__read_all (int fd, void *to, size_t size)
{
  size_t got = 0;
  while (got < size)
    {
      ssize_t n = read (fd, (char *)to + got, size - got);
      if (n < 0 && errno == EINTR)
        continue;
      if (n <= 0)
        break;
      got += (size_t)n;
    }
  return got;
}

#endif
