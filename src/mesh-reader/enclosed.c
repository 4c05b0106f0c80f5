/* The enclosure of every reader program: limits, one line of complaint, a guarded standard output.

   A reader runs a foreign library on a foreign file.  CPU time and addresses are limited by
   setrlimit, never above the limits in force; no core is dumped, and after
   bt__enclosed_write_nothing no file can grow, so only pipes are left to write.  The answer goes to
   a duplicate of standard output, and standard output itself becomes standard error: words printed
   by the library cannot mix with the answer.  Control characters are taken out of complaints.
   Under the address sanitizer, which reserves terabytes, addresses are not limited.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <config.h>

#include <stdlib.h>
#include <sys/resource.h>
#include <unistd.h>

#include "base/hash.h"
#include "mesh-reader/enclosed.h"
#include "mesh/reader.h"

/* The sanitizers reserve terabytes of addresses.  */
#if defined __SANITIZE_ADDRESS__
#define CAN_LIMIT_MEMORY 0
#else
#define CAN_LIMIT_MEMORY 1
#endif

static void
limit (int resource, rlim_t most)
{
  struct rlimit now;
  if (getrlimit (resource, &now) != 0)
    return;
  now.rlim_cur = now.rlim_max < most ? now.rlim_max : most;
  setrlimit (resource, &now);
}

void
bt__enclosed_limit (const char *cpu, const char *megabytes)
{
  limit (RLIMIT_CORE, 0);
  limit (RLIMIT_CPU, strtoul (cpu, NULL, 10));
  if (CAN_LIMIT_MEMORY)
    limit (RLIMIT_AS, (rlim_t)strtoul (megabytes, NULL, 10) << 20);
}

void
bt__enclosed_write_nothing (void)
{
  limit (RLIMIT_FSIZE, 0);
}

int
bt__enclosed_complain (int status, const char *words)
{
  for (; *words; words++)
    fputc ((unsigned char)*words < ' ' ? ' ' : *words, stderr);
  fputc ('\n', stderr);
  return status;
}

int
bt__enclosed_complain_of (const bt_error *error)
{
  return bt__enclosed_complain (
      error->status == BT_ERR_LIMIT ? BT__READER_EXIT_LIMIT : BT__READER_EXIT_FORMAT, error->text);
}

FILE *
bt__enclosed_output (void)
{
  int fd = dup (STDOUT_FILENO);
  dup2 (STDERR_FILENO, STDOUT_FILENO);
  return fd < 0 ? NULL : fdopen (fd, "wb");
}

int
bt__enclosed_put (FILE *to, const void *data, size_t n, uint64_t *sum)
{
  *sum = bt__hash (data, n, *sum);
  return fwrite (data, 1, n, to) == n;
}

int
bt__enclosed_finish (FILE *to, uint64_t sum)
{
  return fwrite (&sum, 1, sizeof sum, to) == sizeof sum && fflush (to) == 0;
}
