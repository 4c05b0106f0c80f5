/* A pool of threads for the tasks of one caller, who works too.

   Threads start with the first shared tasks.  The result of a task must depend neither on the
   thread that does the task nor on the time.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#ifndef BT_BASE_WORKERS_H
#define BT_BASE_WORKERS_H

typedef struct bt__workers bt__workers;

/* Return COUNT workers, 1 or more, the caller of bt__workers_run counted; NULL when memory is
   out.  */
bt__workers *bt__workers_new (int count);

/* End its threads; NULL is nothing.  */
void bt__workers_free (bt__workers *workers);

/* Do DUTY (USER, W, K) once for every K below TASKS, on worker W below COUNT, one task at a time on
   each worker; return when all tasks are done.  If the system refuses a thread, fewer workers do
   the tasks; in a child process, which does not inherit threads, the workers start anew.  A caller
   waiting for the workers calls MEANWHILE (USER) now and then, unless MEANWHILE is NULL.  If
   WORKERS is NULL, the caller does all tasks, as worker 0.  */
void bt__workers_run (bt__workers *workers, int tasks, void (*duty) (void *user, int w, int k),
                      void (*meanwhile) (void *user), void *user);

/* Return how many processors this process may use, 1 or more.  */
int bt__processors (void);

/* Return how many threads were ever started.  */
int bt__workers_started (const bt__workers *workers);

#endif
