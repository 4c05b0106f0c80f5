/* Live dives as their owner sees them: start, stop, commands, the latest copy.

   A live dive is stepped by a thread of its own (thread.c).  The owner posts commands to a queue
   (queue.c), which the thread carries out between steps in the order of posting, and reads
   published copies of the state (shelf.c).  Commands may be kept in a log with the number of the
   step: from the log a dive is repeated step by step to the same hash.

   All waiting is by condition variables on the monotonic clock.  A caller with a poll waits in
   pieces of 20 ms; an interrupted poll takes the command back or stops the work under way.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <config.h>

#include <math.h>
#include <signal.h>
#include <stdlib.h>

#include "base/error.h"
#include "live/live.h"

#define PATIENCE 0.02 /* s between two questions whether to go on waiting */

bt_live_options
bt_live_default_options (void)
{
  return (bt_live_options){ .pace = 1, .until = -1, .moments = 60, .log = 0 };
}

/* ---- Start and stop ---- */

static bt_status
check_options (const bt_live_options *options, bt_error *error)
{
  if (!(options->pace >= 0 && options->pace <= 1e6))
    return bt__fail (error, BT_ERR_DOMAIN, "the pace of a live dive is 0 to 1e6, not %g",
                     options->pace);
  if (options->moments < 0 || options->moments > 10000)
    return bt__fail (error, BT_ERR_DOMAIN, "a live dive keeps 0 to 10000 checkpoints, not %d",
                     options->moments);
  return BT_OK;
}

static void
make_locks (bt_live *live)
{
  pthread_condattr_t monotonic;
  pthread_condattr_init (&monotonic);
  pthread_condattr_setclock (&monotonic, CLOCK_MONOTONIC);
  pthread_mutex_init (&live->lock, NULL);
  pthread_cond_init (&live->wake, &monotonic);
  pthread_cond_init (&live->moved, &monotonic);
  pthread_condattr_destroy (&monotonic);
}

static void
free_live (bt_live *live)
{
  bt__queue log = { live->log };
  bt__queue_free (&live->queue);
  bt__queue_free (&log);
  bt__shelf_free (&live->shelf);
  pthread_cond_destroy (&live->wake);
  pthread_cond_destroy (&live->moved);
  pthread_mutex_destroy (&live->lock);
  free (live);
}

/* Signals, ^C among them, are for the owner's threads.  */
static int
start_thread (bt_live *live)
{
  sigset_t all, before;
  int failed;
  sigfillset (&all);
  pthread_sigmask (SIG_SETMASK, &all, &before);
  failed = pthread_create (&live->thread, NULL, bt__live_thread, live);
  pthread_sigmask (SIG_SETMASK, &before, NULL);
  return failed;
}

bt_status
bt_live_start (bt_dive *dive, const bt_live_options *options, bt_live **out, bt_error *error)
{
  bt_live_options chosen = options ? *options : bt_live_default_options ();
  bt_status status = check_options (&chosen, error);
  bt_live *live = status == BT_OK ? calloc (1, sizeof *live) : NULL;
  if (status != BT_OK)
    return status;
  if (!live)
    return bt__fail (error, BT_ERR_LIMIT, "no memory for a live dive");
  live->dive = dive;
  bt_dive_set_poll (dive, bt__live_leaves, live); /* who asked is in another thread */
  live->options = chosen;
  live->steps = bt_dive_steps (dive);
  live->holders = 1;
  make_locks (live);
  status = bt__shelf_init (&live->shelf, dive, chosen.moments, error);
  if (status == BT_OK && start_thread (live))
    status = bt__fail (error, BT_ERR_LIMIT, "the system has no thread for a live dive");
  if (status != BT_OK)
    {
      bt_dive_set_poll (dive, NULL, NULL);
      free_live (live);
    }
  else
    *out = live;
  return status;
}

bt_status
bt_live_stop (bt_live *live, bt_error *error)
{
  bt_status status;
  if (!live)
    return BT_OK;
  pthread_mutex_lock (&live->lock);
  live->stop = live->leave = 1;
  pthread_cond_signal (&live->wake);
  pthread_mutex_unlock (&live->lock);
  pthread_join (live->thread, NULL);
  pthread_mutex_lock (&live->lock);
  live->ended = 1;
  bt_dive_set_poll (live->dive, NULL, NULL);
  pthread_cond_broadcast (&live->moved);
  pthread_mutex_unlock (&live->lock);
  status = bt_live_status (live, error);
  bt_live_let_go (live);
  return status;
}

void
bt_live_hold (bt_live *live)
{
  pthread_mutex_lock (&live->lock);
  live->holders++;
  pthread_mutex_unlock (&live->lock);
}

void
bt_live_let_go (bt_live *live)
{
  int left;
  if (!live)
    return;
  pthread_mutex_lock (&live->lock);
  left = --live->holders;
  pthread_mutex_unlock (&live->lock);
  if (left == 0)
    free_live (live);
}

int
bt_live_stopped (bt_live *live)
{
  int stopped;
  pthread_mutex_lock (&live->lock);
  stopped = live->stop;
  pthread_mutex_unlock (&live->lock);
  return stopped;
}

/* ---- Commands ---- */

static bt_status
refuse_stopped (bt_error *error)
{
  return bt__fail (error, BT_ERR_STALE, "the dive is no longer live");
}

/* Queue a command and return it with the lock held, or NULL.  */
static bt__command *
post (bt_live *live, int64_t step, bt_op op, int subject, const double *args, int n, int awaited,
      bt_error *error)
{
  bt__command *command = bt__command_new (step, op, subject, args, n);
  if (!command)
    {
      bt__fail (error, BT_ERR_LIMIT, "no memory for a command of %d numbers", n);
      return NULL;
    }
  command->awaited = awaited;
  pthread_mutex_lock (&live->lock);
  if (live->stop)
    {
      pthread_mutex_unlock (&live->lock);
      free (command);
      refuse_stopped (error);
      return NULL;
    }
  if (step < live->steps)
    command->step = live->steps; /* after what is there for this step */
  bt__queue_put (&live->queue, command);
  pthread_cond_signal (&live->wake);
  return command;
}

bt_status
bt_live_post (bt_live *live, int64_t step, bt_op op, int subject, const double *args, int n,
              bt_error *error)
{
  if (!post (live, step, op, subject, args, n, 0, error))
    return error ? error->status : BT_ERR_LIMIT;
  pthread_mutex_unlock (&live->lock);
  return BT_OK;
}

/* Ask POLL, with the lock let go meanwhile; what it gives up is left, or taken back.  */
static void
ask_caller (bt_live *live, bt__command *command, bt_poll poll, void *poll_user)
{
  double share = live->doing == command ? live->share : 0;
  pthread_mutex_unlock (&live->lock);
  int given_up = poll (poll_user, share);
  pthread_mutex_lock (&live->lock);
  if (!given_up || command->done)
    return;
  if (live->doing == command)
    live->leave = 1;
  else
    {
      bt__queue_remove (&live->queue, command);
      command->status
          = bt__fail (&command->error, BT_ERR_INTERRUPTED, "interrupted; nothing has changed");
      command->done = 1;
    }
}

/* Wait, with the lock held, until the dive has moved; with POLL a while at most.  */
static void
wait_for (bt_live *live, bt__command *command, bt_poll poll, void *poll_user)
{
  struct timespec soon = bt__time_after (bt__time_now (), PATIENCE);
  if (!poll)
    pthread_cond_wait (&live->moved, &live->lock);
  else if (pthread_cond_timedwait (&live->moved, &live->lock, &soon) != 0)
    ask_caller (live, command, poll, poll_user);
}

bt_status
bt_live_do_polled (bt_live *live, bt_op op, int subject, const double *args, int n, bt_poll poll,
                   void *poll_user, int64_t *step, bt_error *error)
{
  bt__command *command = post (live, -1, op, subject, args, n, 1, error);
  bt_status status;
  if (!command)
    return error ? error->status : BT_ERR_LIMIT;
  while (!command->done && !live->ended)
    wait_for (live, command, poll, poll_user);
  if (!command->done)
    {
      bt__queue_remove (&live->queue, command);
      command->status = refuse_stopped (&command->error);
    }
  pthread_mutex_unlock (&live->lock);
  status = command->status;
  if (status != BT_OK && error)
    *error = command->error;
  if (step)
    *step = command->step;
  free (command);
  return status;
}

bt_status
bt_live_do (bt_live *live, bt_op op, int subject, const double *args, int n, int64_t *step,
            bt_error *error)
{
  return bt_live_do_polled (live, op, subject, args, n, NULL, NULL, step, error);
}

void
bt_live_drain (bt_live *live, void (*see) (void *user, const bt_live_command *command), void *user)
{
  bt__queue log;
  pthread_mutex_lock (&live->lock);
  log.first = live->log;
  live->log = live->log_end = NULL;
  pthread_mutex_unlock (&live->lock);
  for (const bt__command *c = log.first; c; c = c->next)
    {
      bt_live_command command = { c->step, c->op, c->subject, c->n, c->args, c->status };
      see (user, &command);
    }
  bt__queue_free (&log);
}

void
bt_live_until (bt_live *live, int64_t until)
{
  pthread_mutex_lock (&live->lock);
  live->options.until = until;
  pthread_cond_signal (&live->wake);
  pthread_mutex_unlock (&live->lock);
}

int64_t
bt_live_wait (bt_live *live, int64_t step, double seconds)
{
  struct timespec end = bt__time_after (bt__time_now (), fmax (seconds, 0));
  int64_t steps;
  int late = 0;
  pthread_mutex_lock (&live->lock);
  while (!late && !live->ended && live->steps < step && live->status == BT_OK
         && !(live->options.until >= 0 && live->steps >= live->options.until))
    late = pthread_cond_timedwait (&live->moved, &live->lock, &end) != 0;
  steps = live->steps;
  pthread_mutex_unlock (&live->lock);
  return steps;
}

/* ---- What is published ---- */

int64_t
bt_live_steps (bt_live *live)
{
  int64_t steps;
  pthread_mutex_lock (&live->shelf.lock);
  steps = live->shelf.steps;
  pthread_mutex_unlock (&live->shelf.lock);
  return steps;
}

uint64_t
bt_live_edition (bt_live *live)
{
  uint64_t edition;
  pthread_mutex_lock (&live->shelf.lock);
  edition = live->shelf.edition;
  pthread_mutex_unlock (&live->shelf.lock);
  return edition;
}

bt_status
bt_live_read (bt_live *live, bt_dive *view, bt_error *error)
{
  return bt__shelf_read (&live->shelf, view, error);
}

bt_status
bt_live_status (bt_live *live, bt_error *error)
{
  bt_status status;
  pthread_mutex_lock (&live->lock);
  status = live->status;
  if (status != BT_OK && error)
    *error = live->error;
  pthread_mutex_unlock (&live->lock);
  return status;
}

double
bt_live_late (bt_live *live)
{
  double late;
  pthread_mutex_lock (&live->lock);
  late = live->late;
  pthread_mutex_unlock (&live->lock);
  return late;
}
