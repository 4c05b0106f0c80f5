/* A child process run for its answer: the standard output is read, the first line of the standard
   error kept, the standard input empty.  Once the answer has been taken, or has failed, the child
   is gone.  No signal handler of the process is touched: interrupts, a handled or ignored SIGCHLD
   and all further children are as before.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#ifndef BT_MESH_CHILD_H
#define BT_MESH_CHILD_H

#include <stddef.h>
#include <sys/types.h>

#include <bight/status.h>

enum
{
  BT__CHILD_WORDS = 240
};

typedef struct bt__child
{
  pid_t pid;
  int out, err;    /* our ends of its output and its complaints; -1 once it closed them */
  double deadline; /* s, on the clock that is never set */
  int late;        /* true: the deadline passed */
  size_t n;
  char words[BT__CHILD_WORDS]; /* the first line of its complaints, ended by NUL at N */
} bt__child;

/* How a child ended.  */
typedef enum bt__ending
{
  BT__END_EXIT,   /* by itself, with an exit status */
  BT__END_SIGNAL, /* by a signal that was not ours */
  BT__END_LATE,   /* by us: it took too long */
  BT__END_UNKNOWN /* someone else in the process collected its status */
} bt__ending;

/* Start PROGRAM with the arguments ARGV, for SECONDS at most.  BT_ERR_UNSUPPORTED when there is no
   such program, BT_ERR_IO.  */
bt_status bt__child_start (bt__child *child, const char *program, char *const argv[],
                           double seconds, bt_error *error);

/* The same, for an answer (mesh/answer.h): CHILD is a bt__child.  */
size_t bt__child_read_as (void *child, void *to, size_t n);

/* Collect the child.  With STOP it is killed at once; else it may finish what it has to say until
   the deadline.  *CODE is the exit status or the signal.  */
bt__ending bt__child_end (bt__child *child, int stop, int *code);

#endif
