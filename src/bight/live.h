/* A live dive: a thread of its own steps the dive in real time, whatever the owner does meanwhile.

   Commands go through one queue, each with the number of its step; between two steps the thread
   does the commands that are due, in the order of posting.  After every step, and after the
   commands between steps, the thread publishes a copy of the state for readers.  From bt_live_start
   to bt_live_stop the dive belongs to the thread: no other thread may touch the dive, and the
   current must not ask a function bound to another thread.  The same queue leads to the same
   states, at any pace.

   All functions may be called from any thread, but start and stop by the owner alone.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#ifndef BIGHT_LIVE_H
#define BIGHT_LIVE_H

#include <bight/dive.h>

BT_BEGIN_DECLS

typedef struct bt_live bt_live;

typedef struct bt_live_options
{
  double pace;   /* seconds of the dive in a second, at most 1e6; 0: as fast as it goes */
  int64_t until; /* the step at which time stops; -1: never */
  int moments;   /* checkpoints to keep, one for each second of the dive, the newest ones */
  int log;       /* true: keep what was done for bt_live_drain */
} bt_live_options;

/* Real time, without an end; a minute of checkpoints; no log.  */
bt_live_options bt_live_default_options (void);

/* Let a thread step DIVE (borrowed) from now on.  OPTIONS may be NULL.  BT_ERR_DOMAIN for options
   out of range, BT_ERR_LIMIT when there is no memory or no thread.  */
bt_status bt_live_start (bt_dive *dive, const bt_live_options *options, bt_live **live,
                         bt_error *error);

/* Stop the thread, leaving the step or the command that it is at; DIVE is its owner's again, and
   LIVE is let go.  Return what stopped it before, such as BT_ERR_DIVERGED, or BT_OK.  What was not
   yet due is forgotten.  */
bt_status bt_live_stop (bt_live *live, bt_error *error);

/* Hold LIVE for a user beside the owner, such as a reading thread with a fork of its own; LIVE
   stays after bt_live_stop until every holder has let go.  Once LIVE is stopped, commands are
   refused with BT_ERR_STALE and no call waits.  */
void bt_live_hold (bt_live *live);
void bt_live_let_go (bt_live *live);
/* Return true once LIVE is stopped.  */
int bt_live_stopped (bt_live *live);

/* ---- Commands ---- */

/* Queue OP with its N numbers ARGS (copied) for STEP.  OP is done before STEP is left, or, if STEP
   is -1 or has passed, between the present step and the next; bt_live_drain tells of success.
   BT_ERR_LIMIT when there is no memory.  */
bt_status bt_live_post (bt_live *live, int64_t step, bt_op op, int subject, const double *args,
                        int n, bt_error *error);

/* Queue OP for now, wait until OP is done, and return its status.  *STEP, unless NULL, receives the
   step at which OP was done.  */
bt_status bt_live_do (bt_live *live, bt_op op, int subject, const double *args, int n,
                      int64_t *step, bt_error *error);

/* The same, asking POLL with POLL_USER every now and then in the waiting thread.  If POLL gives up,
   the command is taken back, or left if under way: BT_ERR_INTERRUPTED.  A command already done
   stays done.  */
bt_status bt_live_do_polled (bt_live *live, bt_op op, int subject, const double *args, int n,
                             bt_poll poll, void *poll_user, int64_t *step, bt_error *error);

/* One command that was done, or refused.  */
typedef struct bt_live_command
{
  int64_t step;
  bt_op op;
  int subject, n;
  const double *args;
  bt_status status;
} bt_live_command;

/* Call SEE with USER and each command that was done since the last call, in order.  Needs the
   option `log'.  */
void bt_live_drain (bt_live *live, void (*see) (void *user, const bt_live_command *command),
                    void *user);

/* Let time stop at step UNTIL from now on, or at once if UNTIL has passed; -1: never.  */
void bt_live_until (bt_live *live, int64_t until);

/* Wait until step STEP is over or the dive stands still, at most SECONDS (INFINITY:
   however long); return the latest step.  */
int64_t bt_live_wait (bt_live *live, int64_t step, double seconds);

/* ---- What is published ---- */

/* Return the step of the latest copy, which only grows.  */
int64_t bt_live_steps (bt_live *live);
/* Return a number that grows with every copy that is published.  */
uint64_t bt_live_edition (bt_live *live);
/* Bring VIEW, a fork made before the dive went live, to the latest copy.  A track given to the dive
   since the fork must have been given to VIEW too.  */
bt_status bt_live_read (bt_live *live, bt_dive *view, bt_error *error);
/* Return BT_OK while time passes, or else fill ERROR with the cause of the stop.  */
bt_status bt_live_status (bt_live *live, bt_error *error);
/* Return by how much the thread fell behind real time in all, s.  */
double bt_live_late (bt_live *live);

/* Return the number of kept checkpoints.  Each was taken at the end of a step, before the commands
   between the step and the next.  */
int bt_live_moments (bt_live *live);
/* Tell the step and the hash of the I-th checkpoint, oldest first, and copy the checkpoint to
   STATE, unless STATE is NULL.  Return the size of a state, or 0 if there is no I-th checkpoint.
 */
size_t bt_live_moment (bt_live *live, int i, int64_t *step, uint64_t *hash, void *state);

BT_END_DECLS

#endif
