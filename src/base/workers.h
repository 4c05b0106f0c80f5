/* Threads that share out the tasks of one caller: a few that wait, and the caller itself.

   None is started before there are tasks to share.  What a task gives must not depend on which of
   them does it, nor on when.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#ifndef BT_BASE_WORKERS_H
#define BT_BASE_WORKERS_H

typedef struct bt__workers bt__workers;

/* Return COUNT workers, 1 or more, the caller of bt__workers_run counted; NULL when memory is
   out.  */
bt__workers *bt__workers_new (int count);

/* End its threads; NULL is nothing.  */
void bt__workers_free (bt__workers *workers);

/* Do DUTY (USER, W, K) once for every K below TASKS, on worker W below COUNT, each of which does
   one at a time; return when all are done.  The rest is done with fewer where the system has no
   thread, and in a child of the process that began them, in which they are not, anew.  */
void bt__workers_run (bt__workers *workers, int tasks, void (*duty) (void *user, int w, int k),
                      void *user);

/* The same; while the caller waits for the others MEANWHILE (USER) is called by it now and then. */
void bt__workers_run_and (bt__workers *workers, int tasks, void (*duty) (void *user, int w, int k),
                          void (*meanwhile) (void *user), void *user);

/* Return how many threads were ever started.  */
int bt__workers_started (const bt__workers *workers);

#endif
