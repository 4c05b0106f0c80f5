/* The thread of a live dive.

   The thread does the commands that are due, takes a step, publishes, and sleeps until the next
   step is due.  The thread never calls back: no caller can hold up the dive; a caller in a hurry
   sets a flag, and the thread leaves its present work.  A thread too slow for real time lets the
   clock run on and never hurries to catch up.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <config.h>

#include <errno.h>
#include <math.h>
#include <stdlib.h>

#include "live/live.h"

/* ---- Time ---- */

static const double century = 3.2e9; /* s */

struct timespec
bt__time_now (void)
{
  struct timespec t;
  clock_gettime (CLOCK_MONOTONIC, &t);
  return t;
}

struct timespec
bt__time_after (struct timespec t, double seconds)
{
  double whole = floor (fmin (seconds, century));
  t.tv_sec += (time_t)whole;
  t.tv_nsec += seconds < century ? (long)((seconds - whole) * 1e9) : 0;
  if (t.tv_nsec >= 1000000000)
    {
      t.tv_sec++;
      t.tv_nsec -= 1000000000;
    }
  return t;
}

static double
time_between (struct timespec from, struct timespec to)
{
  return (double)(to.tv_sec - from.tv_sec) + 1e-9 * (double)(to.tv_nsec - from.tv_nsec);
}

/* ---- What it is at ---- */

int
bt__live_leaves (void *user, double share)
{
  bt_live *live = user;
  live->share = share;
  return live->leave;
}

/* Begin COMMAND, or a step if it is NULL, with the lock held.  */
static void
begin (bt_live *live, const bt__command *command)
{
  live->doing = command;
  live->leave = live->stop;
  live->share = 0;
}

/* ---- Commands; each called with the lock held, which is let go while the dive works ---- */

static void
put_away (bt_live *live, bt__command *command)
{
  command->done = 1;
  if (command->awaited)
    return; /* its poster frees it */
  if (!live->options.log)
    {
      free (command);
      return;
    }
  if (live->log_end)
    live->log_end->next = command;
  else
    live->log = command;
  live->log_end = command;
}

static void
do_command (bt_live *live, bt__command *command)
{
  bt_status status;
  begin (live, command);
  pthread_mutex_unlock (&live->lock);
  command->step = bt_dive_steps (live->dive);
  status = bt_dive_do (live->dive, command->op, command->subject, command->args, command->n,
                       &command->error);
  command->status = status;
  if (status == BT_OK)
    bt__shelf_publish (&live->shelf, live->dive);
  pthread_mutex_lock (&live->lock);
  live->doing = NULL;
  put_away (live, command);
  pthread_cond_broadcast (&live->moved);
}

static void
do_what_is_due (bt_live *live)
{
  bt__command *command;
  while ((command = bt__queue_due (&live->queue, live->steps)))
    do_command (live, command);
}

/* ---- Steps ---- */

static int
stands_still (const bt_live *live)
{
  return live->status != BT_OK || (live->options.until >= 0 && live->steps >= live->options.until);
}

static int
is_whole_second (const bt_live *live)
{
  int64_t n = (int64_t)(1 / bt_dive_time_step (live->dive) + 0.5);
  return bt_dive_steps (live->dive) % n == 0;
}

static void
take_live_step (bt_live *live)
{
  bt_error error;
  bt_status status;
  begin (live, NULL);
  pthread_mutex_unlock (&live->lock);
  status = bt_dive_step (live->dive, &error);
  if (status == BT_ERR_INTERRUPTED) /* it was stopped, and time stands at the step before */
    {
      pthread_mutex_lock (&live->lock);
      return;
    }
  bt__shelf_publish (&live->shelf, live->dive);
  if (status == BT_OK && is_whole_second (live))
    bt__shelf_keep (&live->shelf, live->dive);
  pthread_mutex_lock (&live->lock);
  live->status = status;
  if (status != BT_OK)
    live->error = error;
  live->steps = bt_dive_steps (live->dive);
  pthread_cond_broadcast (&live->moved);
}

/* Sleep until DUE, and do meanwhile what is posted.  */
static void
rest_until (bt_live *live, struct timespec due)
{
  while (!live->stop && pthread_cond_timedwait (&live->wake, &live->lock, &due) != ETIMEDOUT)
    do_what_is_due (live);
}

static void
stand_still (bt_live *live)
{
  while (!live->stop && stands_still (live))
    {
      pthread_cond_wait (&live->wake, &live->lock);
      do_what_is_due (live);
    }
}

/* When the next step is due, after one that was due at DUE.  */
static struct timespec
next_due (bt_live *live, struct timespec due)
{
  struct timespec now = bt__time_now ();
  double behind;
  due = bt__time_after (due, bt_dive_time_step (live->dive) / live->options.pace);
  behind = time_between (due, now);
  if (behind < 0.1)
    return due;
  live->late += behind;
  return now;
}

void *
bt__live_thread (void *data)
{
  bt_live *live = data;
  struct timespec due = bt__time_now ();
  pthread_mutex_lock (&live->lock);
  while (!live->stop)
    {
      do_what_is_due (live);
      if (stands_still (live))
        {
          stand_still (live);
          continue;
        }
      take_live_step (live);
      if (live->options.pace > 0)
        rest_until (live, due = next_due (live, due));
    }
  pthread_mutex_unlock (&live->lock);
  return NULL;
}
