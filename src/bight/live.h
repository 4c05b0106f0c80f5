/* A live dive: a thread of its own steps it in real time, whatever its owner does meanwhile.

   Commands go through one queue, each with the number of the step it is for; between two steps the
   thread does those that are due, in the order they were posted.  After every step, and after what
   is done between steps, it publishes a copy of the state for others to read.  The dive itself
   belongs to the thread from bt_live_start to bt_live_stop: nobody else may touch it, nor may its
   current ask a function that must not run in another thread.  The same queue leads to the same
   states, at any pace.

   All of these may be called from any thread, but start and stop by the owner alone.

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

/* Hold LIVE for one who uses it beside its owner, such as another thread with a fork of its own to
   read; it stays after bt_live_stop until each has let it go.  Once it is stopped commands are
   refused with BT_ERR_STALE and nothing is waited for.  */
void bt_live_hold (bt_live *live);
void bt_live_let_go (bt_live *live);
/* Return nonzero once LIVE is stopped.  */
int bt_live_stopped (bt_live *live);

/* ---- Commands ---- */

/* Queue OP with its N numbers ARGS (copied) for STEP: it is done before that step is left, or, when
   STEP is -1 or has passed, between the present step and the next.  BT_ERR_LIMIT when there is no
   memory.  Whether it succeeds, bt_live_drain tells.  */
bt_status bt_live_post (bt_live *live, int64_t step, bt_op op, int subject, const double *args,
                        int n, bt_error *error);

/* Queue OP for now, wait until it was done, and return how it went.  *STEP, unless NULL, receives
   the step it was done at.  */
bt_status bt_live_do (bt_live *live, bt_op op, int subject, const double *args, int n,
                      int64_t *step, bt_error *error);

/* The same, asking POLL with POLL_USER every now and then in the thread that waits.  When it gives
   up the command is taken back, or left if it is under way: BT_ERR_INTERRUPTED.  One that is done
   by then stays done.  */
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

/* Let time stop at step UNTIL from now on, or at the present one if it has passed; -1: never.  */
void bt_live_until (bt_live *live, int64_t until);

/* Wait until step STEP is over or the dive stands still, at most SECONDS (INFINITY:
   however long); return the latest step.  */
int64_t bt_live_wait (bt_live *live, int64_t step, double seconds);

/* ---- What is published ---- */

/* Return the step of the latest copy, which only grows.  */
int64_t bt_live_steps (bt_live *live);
/* Return a number that grows with every copy that is published.  */
uint64_t bt_live_edition (bt_live *live);
/* Bring VIEW, a fork of the dive made before it went live, to the latest copy.  A track that was
   given to the dive since must have been given to VIEW too.  */
bt_status bt_live_read (bt_live *live, bt_dive *view, bt_error *error);
/* Return BT_OK while time passes, or else fill ERROR with what stopped it.  */
bt_status bt_live_status (bt_live *live, bt_error *error);
/* Return by how much the thread fell behind real time in all, s.  */
double bt_live_late (bt_live *live);

/* Return how many checkpoints are kept.  Each was taken as soon as its step was over, before what
   was done then.  */
int bt_live_moments (bt_live *live);
/* Tell the step and the hash of the I-th checkpoint, oldest first, and copy it to STATE unless that
   is NULL.  Return the size of a state, or 0 when there is no such.  */
size_t bt_live_moment (bt_live *live, int i, int64_t *step, uint64_t *hash, void *state);

BT_END_DECLS

#endif
