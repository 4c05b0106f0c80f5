/* Stepping many dives at once, one thread for each dive.

   Every dive of the ensemble has a state and workspaces of its own; the dives share an immutable
   model and charts that are immutable once made, so no result depends on the number of threads.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <stdatomic.h>

#include "base/error.h"
#include "base/workers.h"
#include "world/dive.h"

typedef struct ensemble
{
  bt_dive *const *dive;
  int64_t step;
  bt_status *each;
  bt__asker *asker; /* of the caller */
  atomic_int left;  /* true: the caller said that the work is to be left */
} ensemble;

static void
ask_about_ensemble (void *user)
{
  ensemble *e = user;
  if (bt__ask (e->asker))
    e->left = 1;
}

static int
hear_about_ensemble (void *user, double share)
{
  const ensemble *e = user;
  (void)share;
  return e->left;
}

/* Worker 0 is the caller's own thread, and asks; the other workers hear the answer.  */
static void
step_member (void *user, int w, int k)
{
  ensemble *e = user;
  bt_dive *dive = e->dive[k];
  bt__asker before = dive->asker;
  bt_error error;
  dive->asker = (bt__asker){ .poll = hear_about_ensemble, .user = e };
  e->each[k] = BT_OK;
  while (e->each[k] == BT_OK && !e->left && bt_dive_steps (dive) < e->step)
    {
      e->each[k] = bt_dive_step (dive, &error);
      if (w == 0)
        ask_about_ensemble (e);
    }
  if (e->each[k] == BT_ERR_INTERRUPTED)
    e->each[k] = BT_OK;
  dive->asker = before;
}

static int
asks_function (bt_dive *const *dives, int n)
{
  for (int k = 0; k < n; k++)
    if (bt_dive_asks (dives[k]))
      return 1;
  return 0;
}

bt_status
bt_dives_step (bt_dive *const *dives, int n, int64_t step, int threads, bt_poll poll, void *user,
               bt_status *each, bt_error *error)
{
  bt__asker asker = { .poll = poll, .user = user };
  ensemble e = { .dive = dives, .step = step, .each = each, .asker = &asker };
  bt__workers *workers;
  if (threads < 1 || threads > BT_THREADS_MAX)
    return bt__fail (error, BT_ERR_DOMAIN, "1 to %d threads, not %d", BT_THREADS_MAX, threads);
  if (asks_function (dives, n))
    return bt__fail (error, BT_ERR_UNSUPPORTED,
                     "a current that is a procedure cannot be asked by several dives at once");
  workers = bt__workers_new (threads);
  if (!workers)
    return bt__fail (error, BT_ERR_LIMIT, "no memory for %d threads", threads);
  bt__workers_run (workers, n, step_member, poll ? ask_about_ensemble : NULL, &e);
  bt__workers_free (workers);
  return bt__stopped (&asker, error);
}
