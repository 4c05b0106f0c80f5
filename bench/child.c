/* See child.h.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <fcntl.h>
#include <stdio.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

#include "child.h"

static double
clock_now (void)
{
  struct timespec t;
  clock_gettime (CLOCK_MONOTONIC, &t);
  return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

static double
seconds_of (struct timeval t)
{
  return (double)t.tv_sec + 1e-6 * (double)t.tv_usec;
}

/* Become ARGV in FOLDER.  */
static void
become (const char *folder, const char *const *argv, int out)
{
  int nothing = open ("/dev/null", O_RDWR);
  dup2 (nothing, STDIN_FILENO);
  dup2 (out, STDOUT_FILENO);
  dup2 (nothing, STDERR_FILENO);
  if (!folder || chdir (folder) == 0)
    execvp (argv[0], (char *const *)argv);
  _exit (127);
}

/* Keep the beginning of what comes from FD, and let the rest go by.  */
static void
drain (int fd, bench_child *c)
{
  char text[4096];
  size_t have = 0;
  for (ssize_t n; (n = read (fd, text, sizeof text)) > 0;)
    for (ssize_t i = 0; i < n && have + 1 < sizeof c->out; i++)
      c->out[have++] = text[i];
  c->out[have] = '\0';
}

bench_child
bench_run (const char *folder, const char *const *argv)
{
  bench_child c = { .status = -1 };
  struct rusage used;
  int ends[2], status;
  double start = clock_now ();
  if (pipe (ends))
    return c;
  pid_t pid = fork ();
  if (pid == 0)
    become (folder, argv, ends[1]);
  close (ends[1]);
  drain (ends[0], &c);
  close (ends[0]);
  if (pid < 0 || wait4 (pid, &status, 0, &used) != pid)
    return c;
  c.wall = clock_now () - start;
  c.seconds = seconds_of (used.ru_utime) + seconds_of (used.ru_stime);
  c.memory = 1024 * used.ru_maxrss;
  c.status = WIFEXITED (status) && WEXITSTATUS (status) != 127 ? WEXITSTATUS (status) : -1;
  return c;
}

bench_child
bench_evaluate (const char *folder, const char *expression)
{
  const char *const argv[] = { "bight", "-c", expression, NULL };
  return bench_run (folder, argv);
}

void
bench_remove (const char *folder, const char *file)
{
  char path[512];
  snprintf (path, sizeof path, "%s/%s", folder, file);
  remove (path);
  rmdir (folder);
}
