/* Live dives: a thread steps them, Scheme asks a copy.

   While a dive is live its handle holds two dives: `flown', stepped by the thread of src/live, and
   a fork, which answers questions after taking over the latest published copy.  A dive whose
   current is a Scheme procedure cannot be live, because the stepping thread never enters Scheme.
   Another thread gets a handle of its own to the same live dive (share_live), with its own fork;
   only the first handle, the host, can freeze the dive.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <pthread.h>

#include "guile/guile.h"

/* ---- Sharing: another thread's handle of the same live dive ---- */

static pthread_mutex_t sharing = PTHREAD_MUTEX_INITIALIZER;

void
bt__lock_sharing (void)
{
  pthread_mutex_lock (&sharing);
}

void
bt__unlock_sharing (void)
{
  pthread_mutex_unlock (&sharing);
}

static SCM
share_live (SCM object)
{
  bt__handle *host = bt__to_handle (object), *guest = bt__new_handle (SCM_BOOL_F);
  bt_error error = { BT_ERR_DEF, "the dive is not live" };
  bt_status status = BT_ERR_DEF;
  bt__lock_sharing ();
  if (host->live && scm_is_false (host->host))
    status = bt_dive_fork (host->dive, &guest->dive, &error);
  if (status == BT_OK)
    {
      bt_live_hold (host->live);
      guest->live = host->live;
      guest->host = object;
    }
  bt__unlock_sharing ();
  bt__check ("listen", status, &error);
  bt__tell_states (guest, 1);
  return bt__from_handle (guest);
}

/* ---- One's own ---- */

static SCM
is_live (SCM object)
{
  bt_live *live = bt__to_handle (object)->live;
  return scm_from_bool (live && !bt_live_stopped (live));
}

static SCM
go_live (SCM object, SCM pace)
{
  static const char *const who = "live!";
  bt__handle *handle = bt__to_handle (object);
  bt_live_options options = bt_live_default_options ();
  bt_error error = { BT_ERR_UNSUPPORTED, "a dive whose current is a procedure cannot be live: the "
                                         "thread that steps it never enters Scheme" };
  bt_dive *view;
  bt_status status;
  options.pace = scm_to_double (pace);
  if (handle->live)
    return SCM_BOOL_F;
  if (bt_dive_asks (bt__to_idle_dive (who, object)))
    bt__raise (who, &error);
  bt__check (who, bt_dive_fork (handle->dive, &view, &error), &error);
  status = bt_live_start (handle->dive, &options, &handle->live, &error);
  if (status != BT_OK)
    bt_dive_free (view);
  bt__check (who, status, &error);
  bt_dive_set_poll (view, bt__ask_guile, handle);
  handle->flown = handle->dive;
  handle->dive = view;
  handle->edition = 0;
  return SCM_BOOL_T;
}

static SCM
freeze (SCM object)
{
  bt__handle *handle = bt__to_handle (object);
  bt_error error, shared = { BT_ERR_DEF, "this dive is live elsewhere, and is frozen there alone" };
  bt_status status;
  if (!handle->live)
    return SCM_BOOL_F;
  if (scm_is_true (handle->host))
    bt__raise ("freeze!", &shared);
  bt__lock_sharing ();
  status = bt_live_stop (handle->live, &error);
  bt_dive_free (handle->dive);
  handle->dive = handle->flown;
  bt_dive_set_poll (handle->dive, bt__ask_guile, handle);
  handle->flown = NULL;
  handle->live = NULL;
  bt__unlock_sharing ();
  bt__check ("freeze!", status, &error);
  return SCM_BOOL_T;
}

static bt_live *
to_live (SCM object)
{
  bt__handle *handle = bt__to_handle (object);
  bt_error error = { BT_ERR_DEF, "this dive is not live" };
  if (!handle->live)
    bt__raise ("live!", &error);
  return handle->live;
}

/* #(step hash), or with BYTES? #(step hash state), for each checkpoint later than step AFTER.  */
static SCM
live_moments (SCM object, SCM after, SCM wanted)
{
  bt_live *live = to_live (object);
  int64_t last = scm_to_int64 (after), step;
  uint64_t hash;
  SCM list = SCM_EOL;
  for (int i = 0; bt_live_moment (live, i, &step, &hash, NULL) > 0; i++)
    {
      SCM moment = scm_c_make_vector (3, SCM_BOOL_F);
      if (step <= last)
        continue;
      last = step;
      if (scm_is_true (wanted))
        {
          SCM bytes = scm_c_make_bytevector (bt_dive_state_size (bt__to_handle (object)->dive));
          bt_live_moment (live, i, &step, &hash, SCM_BYTEVECTOR_CONTENTS (bytes));
          scm_c_vector_set_x (moment, 2, bytes);
        }
      scm_c_vector_set_x (moment, 0, scm_from_int64 (step));
      scm_c_vector_set_x (moment, 1, scm_from_uint64 (hash));
      list = scm_cons (moment, list);
    }
  return scm_reverse_x (list, SCM_EOL);
}

static SCM
live_late (SCM object)
{
  return scm_from_double (bt_live_late (to_live (object)));
}

void
bt__define_live (void)
{
  static const bt__procedure table[] = {
    { "%live?", 1, 0, (scm_t_subr)is_live, "Return #t while DIVE is live." },
    { "%live!", 2, 0, (scm_t_subr)go_live,
      "Let DIVE run by itself at PACE; return #f if it does already." },
    { "%freeze!", 1, 0, (scm_t_subr)freeze, "Stop what %live! started; return #f if it was not." },
    { "%live-moments", 3, 0, (scm_t_subr)live_moments,
      "Return the checkpoints of the live DIVE after the step AFTER, the oldest first: vectors "
      "#(step hash state), the state #f unless WANTED." },
    { "%share-live", 1, 0, (scm_t_subr)share_live,
      "Return another handle of the live DIVE, for another thread." },
    { "%live-late", 1, 0, (scm_t_subr)live_late,
      "Return by how much the live DIVE fell behind real time, s." },
  };
  bt__define_procedures (table, sizeof table / sizeof *table);
}
