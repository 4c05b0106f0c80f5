/* Taking a terminal and giving it back, however the process ends.

   Four ways lead back, whichever comes first: bt__terminal_leave; exit, by a function of atexit;
   handlers of the deadly signals; and a guardian, a small child process for the end by kill -9.

   The data of the handlers lie in one static record: a handler has no argument of its own, and a
   process has one terminal.  Handlers call only async-signal-safe functions: write, tcsetattr,
   raise.  Signals handled by Guile or a library, or ignored, are left alone.

   The guardian waits at the end of a pipe.  An end of file tells the death of the parent, and the
   guardian gives the terminal back; one byte tells that the terminal was given back in good order,
   and the guardian ends.  A fork of the process does not own the terminal (`owner' is compared), so
   its exit changes nothing.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <config.h>

#include <errno.h>
#include <fcntl.h>
#include <math.h>
#include <poll.h>
#include <signal.h>
#include <stdlib.h>
#include <string.h>
#include <sys/ioctl.h>
#include <sys/wait.h>
#include <termios.h>
#include <time.h>
#include <unistd.h>

#include "base/error.h"
#include "pilot/terminal.h"

/* The other page, no cursor, no wrapping; and all of it back, colours too.  Beside that, for terminals
   with more: the mouse while its button is down (1002, 1006), word of the window's losing the focus
   (1004), marks about what is pasted (2004), and keys by kitty's protocol (flags 1, 2 and 4: told
   apart, with releases, with what shift makes of them), asking whether releases will be told.  */
static const char taking[] = "\033[?1049h\033[?25l\033[?7l\033[0m\033[2J"
                             "\033[?1002h\033[?1006h\033[?1004h\033[?2004h\033[>7u\033[?u";
static const char giving[] = "\033[<u\033[?2004l\033[?1004l\033[?1006l\033[?1002l"
                             "\033[0m\033[?7h\033[?25h\033[?1049l";

/* Signals that kill, unless handled before.  */
static const int deadly[] = { SIGTERM, SIGHUP, SIGINT, SIGQUIT, SIGABRT, SIGALRM, SIGXCPU,
                              SIGSEGV, SIGBUS, SIGFPE, SIGILL,  SIGPIPE, SIGUSR1, SIGUSR2 };

enum
{
  DEADLY = sizeof deadly / sizeof *deadly
};

static struct
{
  volatile sig_atomic_t taken;
  struct termios before;
  struct sigaction handlers[DEADLY];
  pid_t owner;    /* a fork of this process does not own the terminal */
  pid_t guardian; /* or -1 */
  int leash;      /* its end of the pipe */
  int at_exit;    /* true: exit gives it back */
  char half[64];  /* the beginning of an escape sequence that was read */
  size_t n_half;
} the;

/* ---- Giving back: all of it may run in a handler ---- */

static void
put_bytes (const char *bytes, size_t n)
{
  while (n > 0)
    {
      ssize_t k = write (STDOUT_FILENO, bytes, n);
      if (k <= 0 && errno != EINTR)
        return;
      bytes += k > 0 ? k : 0;
      n -= k > 0 ? (size_t)k : 0;
    }
}

/* The settings come first: when the page is back, the settings are back too.  WHEN is TCSAFLUSH to
   drop unread keys meant for the flight.  */
static void
give_back (int when)
{
  tcsetattr (STDIN_FILENO, when, &the.before);
  put_bytes (giving, sizeof giving - 1);
}

/* Tell the guardian that the terminal was given back.  An untold guardian would give the terminal
   back a second time, perhaps after the shell has begun to read.  */
static void
release_guardian (void)
{
  if (the.guardian < 0)
    return;
  while (write (the.leash, "", 1) < 0 && errno == EINTR)
    ;
  close (the.leash);
}

static void
die_of (int number)
{
  struct sigaction usual;
  if (the.taken && getpid () == the.owner)
    {
      the.taken = 0;
      give_back (TCSAFLUSH);
      release_guardian ();
    }
  memset (&usual, 0, sizeof usual);
  usual.sa_handler = SIG_DFL;
  sigaction (number, &usual, NULL);
  raise (number); /* delivered when the handler returns */
}

/* Catch the deadly signals, except signals ignored or handled by Guile or a library.  */
static void
catch_signals (void)
{
  struct sigaction ours;
  memset (&ours, 0, sizeof ours);
  ours.sa_handler = die_of;
  sigfillset (&ours.sa_mask);
  for (int i = 0; i < DEADLY; i++)
    {
      sigaction (deadly[i], NULL, &the.handlers[i]);
      if (!(the.handlers[i].sa_flags & SA_SIGINFO) && the.handlers[i].sa_handler == SIG_DFL)
        sigaction (deadly[i], &ours, NULL);
    }
}

static void
let_signals_go (void)
{
  for (int i = 0; i < DEADLY; i++)
    {
      struct sigaction now;
      sigaction (deadly[i], NULL, &now);
      if (!(now.sa_flags & SA_SIGINFO) && now.sa_handler == die_of)
        sigaction (deadly[i], &the.handlers[i], NULL);
    }
}

/* ---- The guardian ---- */

/* In the child: wait for the parent's end, with functions that are safe after a fork of many
   threads.  */
static void
guard (int leash)
{
  char byte;
  ssize_t n;
  long most = sysconf (_SC_OPEN_MAX);
  sigset_t all;
  sigfillset (&all); /* a tcsetattr from the background must not stop it either */
  sigprocmask (SIG_SETMASK, &all, NULL);
  for (int fd = 3; fd < (most > 4096 ? 4096 : most); fd++)
    if (fd != leash)
      close (fd);
  do
    n = read (leash, &byte, 1);
  while (n < 0 && errno == EINTR);
  if (n == 0)
    give_back (TCSADRAIN); /* keys typed since the parent's end are for the shell */
  _exit (0);
}

static void
post_guardian (void)
{
  int ends[2];
  the.guardian = -1;
  if (pipe (ends) != 0)
    return;
  the.guardian = fork ();
  if (the.guardian == 0)
    {
      close (ends[1]);
      guard (ends[0]);
    }
  close (ends[0]);
  the.leash = ends[1];
  fcntl (the.leash, F_SETFD, FD_CLOEXEC);
  if (the.guardian < 0)
    close (the.leash);
}

static void
dismiss_guardian (void)
{
  if (the.guardian < 0)
    return;
  release_guardian ();
  while (waitpid (the.guardian, NULL, 0) < 0 && errno == EINTR)
    ;
  the.guardian = -1;
}

/* ---- Taking ---- */

static bt_status
check_terminal (bt_error *error)
{
  const char *kind = getenv ("TERM");
  if (!isatty (STDIN_FILENO) || !isatty (STDOUT_FILENO))
    return bt__fail (
        error, BT_ERR_UNSUPPORTED,
        "a dive is flown in a terminal, and standard input and output are none; with ssh, "
        "ssh -t");
  if (!kind || !*kind || strcmp (kind, "dumb") == 0)
    return bt__fail (
        error, BT_ERR_UNSUPPORTED,
        "a dive is flown in a terminal that can move its cursor, and TERM says `%.40s'; "
        "if that is not so, TERM=xterm tells",
        kind ? kind : "");
  if (tcgetattr (STDIN_FILENO, &the.before) != 0)
    return bt__fail (error, BT_ERR_IO, "the terminal does not tell its state: %s",
                     strerror (errno));
  return BT_OK;
}

bt_status
bt__terminal_enter (bt_error *error)
{
  struct termios raw;
  bt_status status;
  if (the.taken)
    return BT_OK;
  status = check_terminal (error);
  if (status != BT_OK)
    return status;
  if (!the.at_exit)
    the.at_exit = atexit (bt__terminal_leave) == 0;
  the.owner = getpid ();
  post_guardian ();
  the.taken = 1;
  catch_signals ();
  raw = the.before;
  cfmakeraw (&raw);
  /* A read waits for a byte.  After kill -9 the shell may read before the guardian has given the
     settings back, and a shell takes a read without a byte for the end of its input.  */
  raw.c_cc[VMIN] = 1;
  raw.c_cc[VTIME] = 0;
  tcsetattr (STDIN_FILENO, TCSAFLUSH, &raw);
  put_bytes (taking, sizeof taking - 1);
  return BT_OK;
}

void
bt__terminal_leave (void)
{
  if (!the.taken || getpid () != the.owner)
    return;
  the.taken = 0;
  give_back (TCSAFLUSH);
  let_signals_go ();
  dismiss_guardian ();
}

/* ---- Using ---- */

void
bt__terminal_size (int *columns, int *rows)
{
  struct winsize size;
  *columns = 80;
  *rows = 24;
  if (ioctl (STDOUT_FILENO, TIOCGWINSZ, &size) != 0 || size.ws_col == 0 || size.ws_row == 0)
    return;
  *columns = size.ws_col;
  *rows = size.ws_row;
}

static int
wait_for (int fd, short what, double seconds)
{
  struct pollfd p = { fd, what, 0 };
  int n = poll (&p, 1, (int)lrint (1000 * fmin (fmax (seconds, 0), 3600)));
  if (n < 0)
    return errno == EINTR ? 0 : -1;
  return n == 0 ? 0 : p.revents & what ? 1 : -1;
}

/* How many of the N BYTES at their end begin an escape sequence whose letter is still to come.  */
static size_t
unfinished (const char *bytes, size_t n)
{
  size_t k = n;
  while (k > 0 && bytes[k - 1] >= 0x20 && bytes[k - 1] <= 0x3f)
    k--;
  return k >= 2 && bytes[k - 1] == '[' && bytes[k - 2] == '\033' ? n - k + 2 : 0;
}

/* Keep the end of the N BYTES for the next time, if that is half a sequence; return how many are
   left.  */
static int
keep_unfinished (const char *bytes, size_t n)
{
  size_t k = unfinished (bytes, n);
  if (k > sizeof the.half)
    return (int)n;
  memcpy (the.half, bytes + n - k, k);
  the.n_half = k;
  return (int)(n - k);
}

int
bt__terminal_keys (double seconds, char *bytes, size_t room)
{
  int ready = wait_for (STDIN_FILENO, POLLIN, seconds);
  size_t before = ready > 0 && the.n_half < room ? the.n_half : 0;
  ssize_t n;
  if (ready <= 0)
    return ready;
  memcpy (bytes, the.half, before);
  the.n_half = 0;
  n = read (STDIN_FILENO, bytes + before, room - before);
  if (n < 0)
    return errno == EINTR || errno == EAGAIN ? 0 : -1;
  return n == 0 ? -1 : keep_unfinished (bytes, before + (size_t)n); /* empty: it was hung up */
}

int
bt__terminal_write (const char *bytes, size_t n)
{
  while (n > 0)
    {
      ssize_t k = wait_for (STDOUT_FILENO, POLLOUT, 10) > 0 ? write (STDOUT_FILENO, bytes, n) : 0;
      if (k < 0 && errno != EINTR && errno != EAGAIN)
        return 0;
      if (k == 0)
        return 0;
      bytes += k > 0 ? k : 0;
      n -= k > 0 ? (size_t)k : 0;
    }
  return 1;
}
