/* A network file system to be preloaded, as NFS under Linux is: flock locks the bytes of a file as
   fcntl does, but for the open file and not for the process, so that the two collide even in one
   process; and no memory is shared through a file (SQLite's FILE-shm), as between two hosts.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#define _GNU_SOURCE
#include <dlfcn.h>
#include <errno.h>
#include <fcntl.h>
#include <stdarg.h>
#include <string.h>
#include <sys/file.h>
#include <sys/types.h>

int
flock (int fd, int operation)
{
  struct flock lock = { .l_whence = SEEK_SET };
  int how = operation & ~LOCK_NB;
  lock.l_type = how == LOCK_UN ? F_UNLCK : how == LOCK_SH ? F_RDLCK : F_WRLCK;
  if (fcntl (fd, operation & LOCK_NB ? F_OFD_SETLK : F_OFD_SETLKW, &lock) == 0)
    return 0;
  errno = errno == EAGAIN || errno == EACCES ? EWOULDBLOCK : errno;
  return -1;
}

static int
shared_memory (const char *name)
{
  size_t n = strlen (name);
  return n > 4 && strcmp (name + n - 4, "-shm") == 0;
}

typedef int opener (const char *, int, ...);

static int
open_as (const char *symbol, const char *name, int flags, mode_t mode)
{
  union
  {
    void *object;
    opener *function;
  } real;
  if (shared_memory (name))
    {
      errno = EIO;
      return -1;
    }
  real.object = dlsym (RTLD_NEXT, symbol);
  return real.function (name, flags, mode);
}

#define OPEN(symbol)                                                                               \
  int symbol (const char *name, int flags, ...)                                                    \
  {                                                                                                \
    va_list rest;                                                                                  \
    mode_t mode = 0;                                                                               \
    va_start (rest, flags);                                                                        \
    if (flags & O_CREAT)                                                                           \
      mode = va_arg (rest, mode_t);                                                                \
    va_end (rest);                                                                                 \
    return open_as (#symbol, name, flags, mode);                                                   \
  }

OPEN (open)
OPEN (open64)
