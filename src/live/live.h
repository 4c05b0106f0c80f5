/* The room of live dives: what its files share.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#ifndef BT_LIVE_LIVE_H
#define BT_LIVE_LIVE_H

#include <pthread.h>
#include <stdatomic.h>
#include <time.h>

#include <bight/live.h>

/* ---- The queue: what is to be done, by step and then by the order of posting ---- */

typedef struct bt__command
{
  struct bt__command *next;
  int64_t step; /* at which it is to be done; then, at which it was */
  bt_op op;
  int subject, n;
  int awaited; /* true: its poster waits, and owns it */
  int done;
  bt_status status;
  bt_error error;
  double args[];
} bt__command;

typedef struct bt__queue
{
  bt__command *first;
} bt__queue;

/* Return a command with a copy of ARGS, or NULL.  */
bt__command *bt__command_new (int64_t step, bt_op op, int subject, const double *args, int n);
void bt__queue_put (bt__queue *queue, bt__command *command);
/* Return and remove the first command that is due at STEP, or NULL.  */
bt__command *bt__queue_due (bt__queue *queue, int64_t step);
/* Take COMMAND out of the queue, if it is in it.  */
void bt__queue_remove (bt__queue *queue, const bt__command *command);
void bt__queue_free (bt__queue *queue);

/* ---- The shelf: copies of the state that others read, and the checkpoints ---- */

typedef struct bt__moment
{
  int64_t step;
  uint64_t hash;
} bt__moment;

typedef struct bt__shelf
{
  pthread_mutex_t readers; /* held by the one who copies */
  pthread_mutex_t lock;    /* of the numbers below and the checkpoints */
  size_t size;             /* of a state, bytes */
  char *copy[3];
  int latest, read; /* which copy is the latest; which is being read, or -1 */
  int64_t steps;
  uint64_t edition;
  char *moments;             /* a ring of states */
  struct bt__moment *labels; /* of each */
  int room, kept, oldest;
} bt__shelf;

bt_status bt__shelf_init (bt__shelf *shelf, const bt_dive *dive, int moments, bt_error *error);
void bt__shelf_free (bt__shelf *shelf);
/* Publish the state of DIVE; called by the thread alone.  */
void bt__shelf_publish (bt__shelf *shelf, const bt_dive *dive);
/* Keep a checkpoint of DIVE in place of the oldest.  */
void bt__shelf_keep (bt__shelf *shelf, const bt_dive *dive);
bt_status bt__shelf_read (bt__shelf *shelf, bt_dive *view, bt_error *error);

/* ---- Time ---- */

struct timespec bt__time_now (void);
/* T plus SECONDS; what is beyond a century is a century.  */
struct timespec bt__time_after (struct timespec t, double seconds);

/* ---- The whole ---- */

struct bt_live
{
  bt_dive *dive; /* the thread's */
  bt_live_options options;
  pthread_t thread;
  pthread_mutex_t lock; /* of all below */
  pthread_cond_t wake;  /* for the thread: a command, or the end */
  pthread_cond_t moved; /* for the others: a step is over, a command done */
  bt__queue queue;
  bt__command *log, *log_end;
  const bt__command *doing; /* or NULL */
  atomic_int leave;         /* true: what the thread is at is to be left */
  _Atomic double share;     /* of it that is done */
  int64_t steps;
  int stop;
  int ended;   /* true: the thread is gone, and what waits shall wait no more */
  int holders; /* who must let it go before it is freed */
  double late;
  bt_status status;
  bt_error error; /* what stopped time */
  bt__shelf shelf;
};

/* What the dive of the thread asks: is its work to be left?  USER is the bt_live.  */
int bt__live_leaves (void *user, double share);

/* The body of the thread; DATA is the bt_live.  */
void *bt__live_thread (void *data);

#endif
