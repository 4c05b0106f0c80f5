/* A program run beside us: posix_spawn without a shell, two pipes, one deadline.

   Standard output is the answer, of standard error the first line is kept, standard input is
   /dev/null.  Pipes are moved above the standard streams, and all descriptors are closed in the
   child by O_CLOEXEC.  Signals have their defaults in the child, whatever the parent ignores or
   blocks.

   Reading polls both pipes: a child never blocks its answer by filling standard error.  Time is the
   monotonic clock.  A child past its deadline is killed; a child that answered may finish until
   then.  The status is collected by waitpid for the child's own number alone; no handler of SIGCHLD
   is set.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <config.h>

#include <errno.h>
#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <spawn.h>
#include <string.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

#include "base/error.h"
#include "mesh/child.h"

extern char **environ;

static double
now (void)
{
  struct timespec t;
  clock_gettime (CLOCK_MONOTONIC, &t);
  return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

static void
close_end (int *fd)
{
  if (*fd >= 0)
    close (*fd);
  *fd = -1;
}

/* ---- Starting ---- */

/* Move *FD above the standard streams.  In a process started without standard streams a pipe would
   take the numbers of the streams, about to be filled by the child process.  */
static int
above_streams (int *fd)
{
  int high = fcntl (*fd, F_DUPFD_CLOEXEC, STDERR_FILENO + 1);
  close_end (fd);
  *fd = high;
  return high >= 0;
}

static int
make_pipe (int end[2])
{
  if (pipe2 (end, O_CLOEXEC) != 0)
    {
      end[0] = end[1] = -1;
      return 0;
    }
  int first = above_streams (&end[0]);
  return above_streams (&end[1]) && first;
}

/* Every signal as at the start of a process, whatever the parent ignores, handles or blocks.  */
static int
plain_signals (posix_spawnattr_t *attr)
{
  sigset_t all, none;
  sigfillset (&all);
  sigdelset (&all, SIGKILL);
  sigdelset (&all, SIGSTOP);
  sigemptyset (&none);
  return posix_spawnattr_setsigdefault (attr, &all) == 0
         && posix_spawnattr_setsigmask (attr, &none) == 0
         && posix_spawnattr_setflags (attr, POSIX_SPAWN_SETSIGDEF | POSIX_SPAWN_SETSIGMASK) == 0;
}

static int
streams (posix_spawn_file_actions_t *actions, int out, int err)
{
  return posix_spawn_file_actions_addopen (actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0) == 0
         && posix_spawn_file_actions_adddup2 (actions, out, STDOUT_FILENO) == 0
         && posix_spawn_file_actions_adddup2 (actions, err, STDERR_FILENO) == 0;
}

/* Return 0 or an error number.  */
static int
spawn (pid_t *pid, const char *program, char *const argv[], int out, int err)
{
  posix_spawn_file_actions_t actions;
  posix_spawnattr_t attr;
  if (posix_spawn_file_actions_init (&actions) != 0)
    return ENOMEM;
  int code = ENOMEM;
  if (posix_spawnattr_init (&attr) == 0)
    {
      if (plain_signals (&attr) && streams (&actions, out, err))
        code = posix_spawn (pid, program, &actions, &attr, argv, environ);
      posix_spawnattr_destroy (&attr);
    }
  posix_spawn_file_actions_destroy (&actions);
  return code;
}

bt_status
bt__child_start (bt__child *child, const char *program, char *const argv[], double seconds,
                 bt_error *error)
{
  int out[2] = { -1, -1 }, err[2] = { -1, -1 };
  int code = make_pipe (out) && make_pipe (err) ? 0 : errno;
  *child = (bt__child){ .out = out[0], .err = err[0], .deadline = now () + seconds };
  if (code == 0)
    code = spawn (&child->pid, program, argv, out[1], err[1]);
  close_end (&out[1]);
  close_end (&err[1]);
  if (code == 0)
    return BT_OK;
  close_end (&child->out);
  close_end (&child->err);
  return bt__fail (error, code == ENOENT ? BT_ERR_UNSUPPORTED : BT_ERR_IO, "%s cannot be run: %s",
                   program, strerror (code));
}

/* ---- Listening ---- */

/* Keep the first line of what the child complains about, and let the rest go.  */
static void
hear_complaint (bt__child *child)
{
  char some[512];
  ssize_t n = read (child->err, some, sizeof some);
  if (n == 0 || (n < 0 && errno != EINTR))
    close_end (&child->err);
  for (ssize_t i = 0; i < n; i++)
    if (child->n < sizeof child->words - 1)
      child->words[child->n++] = some[i];
}

/* Wait until the child said something on either stream, or closed both: true while it may say
   more.  */
static int
await (bt__child *child, int *spoke)
{
  struct pollfd ends[2] = { { child->out, POLLIN, 0 }, { child->err, POLLIN, 0 } };
  double left = child->deadline - now ();
  *spoke = 0;
  if (left <= 0)
    child->late = 1;
  if (child->late || (child->out < 0 && child->err < 0))
    return 0;
  int n = poll (ends, 2, (int)(left * 1e3) + 1);
  if (n < 0 && errno != EINTR)
    return 0;
  if (n > 0 && ends[1].revents)
    hear_complaint (child);
  *spoke = n > 0 && ends[0].revents;
  return 1;
}

static size_t
read_child (bt__child *child, void *to, size_t n)
{
  size_t got = 0;
  int spoke;
  while (got < n && child->out >= 0 && await (child, &spoke))
    if (spoke)
      {
        ssize_t k = read (child->out, (char *)to + got, n - got);
        if (k > 0)
          got += (size_t)k;
        else if (k == 0 || errno != EINTR)
          close_end (&child->out);
      }
  return got;
}

size_t
bt__child_read_as (void *child, void *to, size_t n)
{
  return read_child (child, to, n);
}

/* ---- Ending ---- */

static void
rest (void)
{
  nanosleep (&(struct timespec){ 0, 1000000 }, NULL);
}

/* Collect the child's status: true when there is nothing more to wait for.  */
static int
collected (bt__child *child, int options, int *status)
{
  pid_t pid;
  do
    pid = waitpid (child->pid, status, options);
  while (pid < 0 && errno == EINTR);
  if (pid < 0)
    *status = -1; /* SIGCHLD is ignored here, or another waited for any child */
  return pid != 0;
}

/* One line: what follows it, and what would not print, is left out.  */
static void
tidy (bt__child *child)
{
  child->words[child->n] = '\0';
  child->words[strcspn (child->words, "\n")] = '\0';
  for (char *c = child->words; *c; c++)
    if ((unsigned char)*c < ' ' || *c == 127)
      *c = ' ';
}

bt__ending
bt__child_end (bt__child *child, int stop, int *code)
{
  char rest_of_it[4096];
  int status = -1, done = 0;
  while (!stop && read_child (child, rest_of_it, sizeof rest_of_it) > 0)
    ;
  for (int spoke; !stop && child->err >= 0 && await (child, &spoke);)
    ;
  close_end (&child->out);
  while (!stop && !child->late && !(done = collected (child, WNOHANG, &status)))
    {
      child->late = now () > child->deadline;
      rest ();
    }
  if (!done)
    {
      kill (child->pid, SIGKILL);
      collected (child, 0, &status);
    }
  close_end (&child->err);
  tidy (child);
  if (child->late)
    return BT__END_LATE;
  *code = status >= 0 && WIFSIGNALED (status) ? WTERMSIG (status) : WEXITSTATUS (status);
  return status < 0 ? BT__END_UNKNOWN : WIFSIGNALED (status) ? BT__END_SIGNAL : BT__END_EXIT;
}
