/* Reader programs: where they are found, how they are started, and what their end means.

   The program of a reader is the value of its environment variable, else a file in the folder
   BIGHT_LIBEXEC, else the installed file.  Its arguments are two limits (CPU seconds, megabytes of
   addresses), the file, and arguments of the kind of reader.  The parent adds a deadline.

   An end is understood in this order: past the deadline, too much; killed by a signal of a user,
   interrupted; by SIGXCPU or SIGKILL, too much; by another signal, the library crashed; with an
   exit status of a kind of error, the sentence on standard error; else the answer's own status.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <config.h>

#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "base/error.h"
#include "mesh/child.h"
#include "mesh/file.h"
#include "mesh/reader.h"

enum
{
  PATH_SIZE = 4096,
  NUMBER_SIZE = 16,
  OWN_ARGUMENTS = 4 /* the program, two limits, the file */
};

/* The variable of READER names the program, BIGHT_LIBEXEC its folder; else the program is where it
   was installed.  Return true if the name fits PATH.  */
static int
find_program (const bt__reader *reader, char path[PATH_SIZE])
{
  const char *program = getenv (reader->variable), *folder = getenv ("BIGHT_LIBEXEC");
  int n;
  if (program && *program)
    n = snprintf (path, PATH_SIZE, "%s", program);
  else
    n = snprintf (path, PATH_SIZE, "%s/%s", folder && *folder ? folder : BIGHT_LIBEXEC_DIR,
                  reader->program);
  return n > 0 && n < PATH_SIZE;
}

static bt_status
start_reader (const bt__reader *reader, const char *file, char *const *arguments,
              const bt__reader_limits *limits, bt__child *child, bt_error *error)
{
  char program[PATH_SIZE], cpu[NUMBER_SIZE], megabytes[NUMBER_SIZE];
  char *argv[OWN_ARGUMENTS + BT__READER_ARGUMENTS + 1] = { program, cpu, megabytes, (char *)file };
  if (!find_program (reader, program))
    return bt__fail (error, BT_ERR_IO, "the name of %s is too long", reader->title);
  snprintf (cpu, sizeof cpu, "%u", limits->cpu);
  snprintf (megabytes, sizeof megabytes, "%u", limits->megabytes);
  for (int i = 0; i < BT__READER_ARGUMENTS && arguments[i]; i++)
    argv[OWN_ARGUMENTS + i] = arguments[i];
  bt_status s = bt__child_start (child, program, argv, limits->seconds, error);
  if (s == BT_ERR_UNSUPPORTED)
    return bt__fail (error, s,
                     "%s cannot be read: this bight was built without %s (there is no %.150s); "
                     "install %s, configure and build again",
                     bt__file_tail (file), reader->files, program, reader->library);
  return s;
}

/* ---- Its end ---- */

static bt_status
fail_by_exit (const bt__reader *reader, const char *name, int code, const char *words,
              bt_error *error)
{
  static const bt_status statuses[] = { BT_ERR_FORMAT, BT_ERR_LIMIT, BT_ERR_IO };
  unsigned i = (unsigned)(code - BT__READER_EXIT_FORMAT);
  if (i < sizeof statuses / sizeof *statuses)
    return bt__fail (error, statuses[i], "%s: %s", name, words);
  return bt__fail (error, BT_ERR_FORMAT, "%s: %s failed (exit status %d)%s%s", name, reader->title,
                   code, *words ? ": " : "", words);
}

static bt_status
fail_by_signal (const bt__reader *reader, const char *name, int code, bt_error *error)
{
  if (code == SIGINT || code == SIGTERM || code == SIGHUP || code == SIGQUIT)
    return bt__fail (error, BT_ERR_IO, "%s was not read: interrupted", name);
  if (code == SIGXCPU || code == SIGKILL)
    return bt__fail (error, BT_ERR_LIMIT, "%s is too much: its reader ran out of time or memory",
                     name);
  return bt__fail (error, BT_ERR_FORMAT,
                   "%s crashes the library that reads %s (%s); the file is damaged or of no use",
                   name, reader->files, strsignal (code));
}

/* Collect CHILD, a READER of FILE.  ANSWER is the status of its answer, with a sentence in ERROR;
   return the status of answer and child together.  */
static bt_status
end_reader (const bt__reader *reader, const char *file, bt__child *child, bt_status answer,
            bt_error *error)
{
  const char *name = bt__file_tail (file);
  int code = 0, stop = answer != BT_OK && child->out >= 0 && !child->late;
  bt__ending ending = bt__child_end (child, stop, &code);
  if (ending == BT__END_LATE)
    return bt__fail (error, BT_ERR_LIMIT, "%s is too much: reading it was given up", name);
  if (!stop && ending == BT__END_SIGNAL)
    return fail_by_signal (reader, name, code, error);
  if (!stop && ending == BT__END_EXIT && code != BT__READER_EXIT_OK)
    return fail_by_exit (reader, name, code, child->words, error);
  return answer;
}

/* ---- All of it ---- */

static bt_status
check_readable (const bt__reader *reader, const char *file, bt_error *error)
{
  int fd;
  uint64_t size;
  bt_status s = bt__file_open (file, reader->most_bytes, &fd, &size, error);
  if (s == BT_OK)
    close (fd);
  return s;
}

bt_status
bt__reader_ask (const bt__reader *reader, const char *file, char *const *arguments,
                const bt__reader_limits *limits, bt__reader_take *take, void *into, bt_error *error)
{
  bt__child child;
  bt_error why;
  bt_status s = check_readable (reader, file, error);
  if (s == BT_OK)
    s = start_reader (reader, file, arguments, limits, &child, error);
  if (s != BT_OK)
    return s;
  s = take (&(bt__answer){ bt__child_read_as, &child, reader->title }, into, &why);
  if (s != BT_OK)
    bt__fail (error, s, "%s: %s", bt__file_tail (file), why.text);
  return end_reader (reader, file, &child, s, error);
}
