/* Asking the caller whether long work should go on.

   A dive has one asker, and the workspaces of its solvers point to the asker.  A long loop asks
   between pieces of work, each much shorter than a tenth of a second, and ends early if told to.
   The unfinished result is invalid; the nearest caller that returns a status asks bt__stopped and
   fails.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#ifndef BT_BASE_ASK_H
#define BT_BASE_ASK_H

#include "base/error.h"

typedef struct bt__asker
{
  bt_poll poll; /* NULL: nobody is asked */
  void *user;
  double share; /* of the work reported last */
  int stopped;  /* true from when POLL said so until bt__stopped tells */
} bt__asker;

/* Ask ASKER, or nobody if it is NULL; return true if the work is to be left.  */
static inline int
bt__ask (bt__asker *asker)
{
  if (!asker || !asker->poll)
    return 0;
  if (!asker->stopped)
    asker->stopped = asker->poll (asker->user, asker->share) != 0;
  return asker->stopped;
}

/* BT_ERR_INTERRUPTED, once, if work was left since this was last asked.  */
static inline bt_status
bt__stopped (bt__asker *asker, bt_error *error)
{
  if (!asker || !asker->stopped)
    return BT_OK;
  asker->stopped = 0;
  return bt__fail (error, BT_ERR_INTERRUPTED, "interrupted; nothing has changed");
}

#endif
