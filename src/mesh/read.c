/* Reading a mesh file.  The library of formats runs in bight-mesh-reader, a separate process; this
   file takes the answer and explains a failure.

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
#include "mesh/read.h"
#include "mesh/stream.h"

#define READER "bight-mesh-reader"

enum
{
  PATH_SIZE = 4096,
  NUMBER_SIZE = 16
};

/* A million triangles take a second and half a gigabyte.  */
static const bt__mesh_limits usual = { 180, 60, 8192 };
static const uint64_t most_bytes = 2000000000;

/* ---- The program ---- */

/* BIGHT_MESH_READER names it, BIGHT_LIBEXEC its folder; else it is where it was installed.  Return
   true when it fits PATH.  */
static int
find_reader (char path[PATH_SIZE])
{
  const char *program = getenv ("BIGHT_MESH_READER"), *folder = getenv ("BIGHT_LIBEXEC");
  int n;
  if (program && *program)
    n = snprintf (path, PATH_SIZE, "%s", program);
  else
    n = snprintf (path, PATH_SIZE, "%s/" READER, folder && *folder ? folder : BIGHT_LIBEXEC_DIR);
  return n > 0 && n < PATH_SIZE;
}

static bt_status
start_reader (bt__child *child, const char *file, bt_mesh_up up, const bt__mesh_limits *limits,
              bt_error *error)
{
  char program[PATH_SIZE], cpu[NUMBER_SIZE], megabytes[NUMBER_SIZE];
  if (!find_reader (program))
    return bt__fail (error, BT_ERR_IO, "the name of the mesh reader is too long");
  snprintf (cpu, sizeof cpu, "%u", limits->cpu);
  snprintf (megabytes, sizeof megabytes, "%u", limits->megabytes);
  char *const argv[]
      = { program, (char *)(up == BT_MESH_UP_Y ? "y" : "z"), cpu, megabytes, (char *)file, NULL };
  bt_status s = bt__child_start (child, program, argv, limits->seconds, error);
  if (s == BT_ERR_UNSUPPORTED)
    return bt__fail (error, s,
                     "%s cannot be read: this bight was built without mesh files (there is no "
                     "%.150s); install assimp (Debian package: libassimp-dev), configure and "
                     "build again",
                     bt__file_tail (file), program);
  return s;
}

/* ---- Its end ---- */

static bt_status
fail_by_exit (const char *name, int code, const char *words, bt_error *error)
{
  static const bt_status statuses[] = { BT_ERR_FORMAT, BT_ERR_LIMIT, BT_ERR_IO };
  unsigned i = (unsigned)(code - BT__MESH_EXIT_FORMAT);
  if (i < sizeof statuses / sizeof *statuses)
    return bt__fail (error, statuses[i], "%s: %s", name, words);
  return bt__fail (error, BT_ERR_FORMAT, "%s: the mesh reader failed (exit status %d)%s%s", name,
                   code, *words ? ": " : "", words);
}

static bt_status
fail_by_signal (const char *name, int code, bt_error *error)
{
  if (code == SIGINT || code == SIGTERM || code == SIGHUP || code == SIGQUIT)
    return bt__fail (error, BT_ERR_IO, "%s was not read: interrupted", name);
  if (code == SIGXCPU || code == SIGKILL)
    return bt__fail (error, BT_ERR_LIMIT, "%s is too much: its reader ran out of time or memory",
                     name);
  return bt__fail (error, BT_ERR_FORMAT,
                   "%s crashes the library that reads meshes (%s); the file is damaged or of no "
                   "use",
                   name, strsignal (code));
}

/* What became of the child that answered with ANSWER (its sentence in ERROR)?  */
static bt_status
judge_child (const char *name, bt__child *child, bt_status answer, bt_error *error)
{
  int code = 0, stop = answer != BT_OK && child->out >= 0 && !child->late;
  bt__ending ending = bt__child_end (child, stop, &code);
  if (ending == BT__END_LATE)
    return bt__fail (error, BT_ERR_LIMIT, "%s is too much: reading it was given up", name);
  if (!stop && ending == BT__END_SIGNAL)
    return fail_by_signal (name, code, error);
  if (!stop && ending == BT__END_EXIT && code != BT__MESH_EXIT_OK)
    return fail_by_exit (name, code, child->words, error);
  return answer;
}

static size_t
read_child (void *user, void *to, size_t n)
{
  return bt__child_read (user, to, n);
}

bt_status
bt__mesh_read_within (const char *file, bt_mesh_up up, const bt__mesh_limits *limits,
                      bt_mesh_data **out, bt_error *error)
{
  int fd;
  uint64_t size;
  bt__child child;
  bt_error why;
  *out = NULL;
  bt_status s = bt__file_open (file, most_bytes, &fd, &size, error);
  if (s != BT_OK)
    return s;
  close (fd); /* it can be read: that is all we wanted of it */
  s = start_reader (&child, file, up, limits, error);
  if (s != BT_OK)
    return s;
  s = bt__mesh_take (&(bt__mesh_source){ read_child, &child }, out, &why);
  if (s != BT_OK)
    bt__fail (error, s, "%s: %s", bt__file_tail (file), why.text);
  s = judge_child (bt__file_tail (file), &child, s, error);
  if (s != BT_OK)
    {
      bt_mesh_data_free (*out);
      *out = NULL;
    }
  return s;
}

bt_status
bt_mesh_read (const char *file, bt_mesh_up up, bt_mesh_data **out, bt_error *error)
{
  return bt__mesh_read_within (file, up, &usual, out, error);
}
