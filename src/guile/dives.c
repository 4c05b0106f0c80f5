/* Dives: life, time, checkpoints.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <malloc.h>
#include <stdatomic.h>
#include <stdio.h>
#include <string.h>

#include "guile/guile.h"

#define LEFT_MOST ((size_t)32 << 20) /* bytes of dives freed before the system gets them back */

/* ---- The object ---- */

static scm_t_bits dive_tag;

static void wake (bt__handle *handle);

static bt__handle *
handle_of (SCM object)
{
  scm_assert_smob_type (dive_tag, object);
  return (bt__handle *)SCM_SMOB_DATA (object);
}

bt__handle *
bt__to_handle (SCM object)
{
  bt__handle *handle = handle_of (object);
  if (scm_is_true (handle->rest))
    wake (handle);
  return handle;
}

/* Bring the copy that answers questions of a live dive up to the latest published state.  */
static void
catch_up (bt__handle *handle)
{
  uint64_t edition = bt_live_edition (handle->live);
  bt_error error;
  if (edition == handle->edition)
    return;
  bt__check ("live!", bt_live_read (handle->live, handle->dive, &error), &error);
  handle->edition = edition;
}

bt_dive *
bt__to_dive (SCM object)
{
  bt__handle *handle = bt__to_handle (object);
  if (handle->live)
    catch_up (handle);
  return handle->dive;
}

bt_dive *
bt__to_idle_dive (const char *who, SCM object)
{
  bt__handle *handle = bt__to_handle (object);
  bt_error error = { BT_ERR_DEF, "the procedure of a current cannot change the dive that asks it" };
  if (handle->asking)
    bt__raise (who, &error);
  bt_dive *dive = bt__to_dive (object);
  if (!handle->live)
    bt__tell_states (handle, 2);
  return dive;
}

/* Dives and forks come and go by the thousand, and their memory is not the collector's: whoever
   makes one frees what was dropped before, by scm_run_finalizers, and tells the collector the size.
   A guest of a live dive only tells: other threads make guests.  */
void
bt__tell_states (bt__handle *handle, int states)
{
  if (states <= handle->states)
    return;
  scm_gc_register_allocation ((size_t)(states - handle->states)
                              * bt_dive_state_size (handle->dive));
  handle->states = states;
}

/* The collector scans the handle, and so finds its procedure: a mark function of our own would run
   on the collector's helper threads, which Guile knows nothing of.  */
bt__handle *
bt__new_handle (SCM function)
{
  bt__handle *handle = scm_gc_malloc (sizeof *handle, "dive");
  handle->dive = NULL;
  handle->function = function;
  handle->asking = 0;
  handle->journal = SCM_EOL;
  handle->serial = 0;
  handle->live = NULL;
  handle->flown = NULL;
  handle->edition = 0;
  handle->spare = NULL;
  handle->rest = SCM_BOOL_F;
  handle->origin = SCM_BOOL_F;
  handle->carried = 0;
  handle->host = SCM_BOOL_F;
  handle->thrown = SCM_BOOL_F;
  handle->looked = 0;
  handle->told = 0;
  handle->states = handle->spare_states = 0;
  for (int part = 0; part <= BT_PART_OBSTACLE; part++)
    handle->names[part] = SCM_BOOL_F;
  return handle;
}

SCM
bt__from_handle (bt__handle *handle)
{
  return scm_new_smob (dive_tag, (scm_t_bits)handle);
}

/* Free DIVE, of so many STATES, or nothing; return about how many bytes were freed.  */
static size_t
free_one (bt_dive *dive, int states)
{
  size_t size = dive ? (size_t)states * bt_dive_state_size (dive) : 0;
  bt_dive_free (dive);
  return size;
}

/* BYTES were freed.  The C library keeps freed memory that lies between memory in use: a belief
   made anew for each of many truths then takes more of the system with each.  */
static void
give_back (size_t bytes)
{
  static atomic_size_t left;
  if (atomic_fetch_add (&left, bytes) + bytes < LEFT_MOST)
    return;
  atomic_store (&left, 0);
#ifdef __GLIBC__
  malloc_trim (0);
#endif
}

/* Under plain guile this runs on its finalizer thread: it touches the dive alone.  */
static size_t
free_dive (SCM object)
{
  bt__handle *handle = (bt__handle *)SCM_SMOB_DATA (object);
  if (scm_is_true (handle->host))
    bt_live_let_go (handle->live);
  else
    bt_live_stop (handle->live, NULL);
  /* The dive flown live has the states; questions meanwhile go to a copy.  */
  give_back (free_one (handle->flown, handle->states)
             + free_one (handle->spare, handle->spare_states)
             + free_one (handle->dive, handle->flown ? 1 : handle->states));
  return 0;
}

static int
print_dive (SCM object, SCM port, scm_print_state *state)
{
  char text[80];
  (void)state;
  snprintf (text, sizeof text, "#<dive %.3f s>", bt_dive_time (bt__to_dive (object)));
  scm_puts (text, port);
  return 1;
}

static SCM
is_dive (SCM object)
{
  return scm_from_bool (SCM_SMOB_PREDICATE (dive_tag, object));
}

/* ---- Forks ---- */

/* Let HANDLE have a fork of the dive of ORIGIN, a state in the memory of an earlier fork if ORIGIN
   has a spare.  */
static void
make_fork (bt__handle *handle, SCM origin)
{
  bt__handle *from = bt__to_handle (origin);
  bt_dive *dive = bt__to_dive (origin), *fork = from->spare;
  bt_error error;
  from->spare = NULL;
  handle->states = 0;
  if (fork && bt_dive_fork_again (fork, dive, &error) == BT_OK)
    {
      handle->dive = fork;
      handle->states = from->spare_states;
      return;
    }
  bt_dive_free (fork);
  scm_run_finalizers ();
  bt__check ("what-if", bt_dive_fork (dive, &fork, &error), &error);
  handle->dive = fork;
  bt__tell_states (handle, 1);
}

/* Let HANDLE have a fork of the dive of ORIGIN, which asks as HANDLE does.  */
static void
hold_fork (bt__handle *handle, SCM origin)
{
  int asks = scm_is_true (scm_procedure_p (handle->function));
  make_fork (handle, origin);
  bt_dive *dive = handle->dive;
  bt_dive_set_poll (dive, bt__ask_guile, handle);
  bt_dive_set_current_function (dive, asks ? bt__call_current : NULL, handle);
}

static SCM
fork_dive (SCM object)
{
  bt__handle *origin = bt__to_handle (object), *copy = bt__new_handle (origin->function);
  copy->journal = origin->journal;
  copy->serial = origin->serial;
  memcpy (copy->names, origin->names, sizeof copy->names);
  hold_fork (copy, object);
  return bt__from_handle (copy);
}

static int
tracks_of (const bt_dive *dive)
{
  const double *rows;
  int n = 0;
  while (bt_dive_track (dive, n, &rows) > 0)
    n++;
  return n;
}

/* Keep the state of OBJECT alone; the next fork of ORIGIN is made in the memory of OBJECT.  A
   question to OBJECT wakes OBJECT again, with new counters.  A fork that has more than a state, as
   a live dive has, stays awake.  */
static SCM
rest_fork (SCM object, SCM origin)
{
  bt__handle *fork = bt__to_handle (object), *from = bt__to_handle (origin);
  if (fork->live || fork->asking || scm_is_true (fork->host) || bt_dive_threads (fork->dive) > 1
      || tracks_of (fork->dive) != tracks_of (bt__to_dive (origin)))
    return SCM_BOOL_F;
  SCM bytes = scm_c_make_bytevector (bt_dive_keep_size (fork->dive));
  bt_dive_keep (fork->dive, SCM_BYTEVECTOR_CONTENTS (bytes));
  fork->carried = bt_dive_carried (fork->dive);
  fork->rest = bytes;
  fork->origin = origin;
  bt_dive_free (from->spare);
  from->spare = fork->dive;
  from->spare_states = fork->states;
  fork->dive = NULL;
  return SCM_BOOL_T;
}

static void
wake (bt__handle *handle)
{
  SCM bytes = handle->rest;
  bt_error error;
  hold_fork (handle, handle->origin);
  handle->rest = SCM_BOOL_F;
  bt__check ("what-if",
             bt_dive_restore (handle->dive, SCM_BYTEVECTOR_CONTENTS (bytes),
                              SCM_BYTEVECTOR_LENGTH (bytes), &error),
             &error);
  bt__tell_states (handle, 2);
  bt_dive_carry (handle->dive, handle->carried);
  handle->origin = SCM_BOOL_F;
  scm_remember_upto_here_1 (bytes);
}

/* ---- Time ---- */

/* Of a live dive the steps come by themselves.  */
static SCM
wait_for_steps (SCM object, int64_t n)
{
  bt_live *live = bt__to_handle (object)->live;
  int64_t last = bt_live_steps (live) + n;
  bt_error error, stopped = { BT_ERR_STALE, "the dive is no longer live" };
  do
    {
      bt__check ("run", bt_live_status (live, &error), &error);
      if (bt_live_stopped (live))
        bt__raise ("run", &stopped);
      SCM_TICK;
    }
  while (bt_live_wait (live, last, 0.02) < last);
  scm_remember_upto_here_1 (object);
  return scm_from_int64 (n);
}

/* SCM_TICK between the steps lets ^C and the collector in.  HASHES, a u32vector or nothing, takes
   32 bits of the state after each step.  */
static SCM
step_dive (SCM object, SCM count, SCM hashes)
{
  bt_dive *dive = bt__to_idle_dive ("run", object);
  int64_t n = scm_to_int64 (count);
  bt_error error;
  if (bt__to_handle (object)->live)
    return wait_for_steps (object, n);
  uint32_t *hash = NULL;
  if (!SCM_UNBNDP (hashes))
    {
      SCM_ASSERT_TYPE (SCM_BYTEVECTOR_P (hashes)
                           && (int64_t)SCM_BYTEVECTOR_LENGTH (hashes) / 4 >= n,
                       hashes, SCM_ARG3, "run", "a number for each step");
      hash = (uint32_t *)(void *)SCM_BYTEVECTOR_CONTENTS (hashes);
    }
  scm_run_finalizers ();
  for (int64_t i = 0; i < n; i++)
    {
      bt__check_long ("run", bt__to_handle (object), bt_dive_step (dive, &error), &error);
      if (hash)
        hash[i] = (uint32_t)bt_dive_hash (dive);
      SCM_TICK;
    }
  scm_remember_upto_here_2 (object, hashes);
  return count;
}

/* The list of N dives as an array, of which the collector knows.  */
static bt_dive **
to_dives (SCM list, int *n)
{
  bt_dive **dives;
  *n = scm_to_int (scm_length (list));
  dives = scm_gc_malloc (sizeof *dives * (size_t)(*n + 1), "dives");
  for (int i = 0; i < *n; i++, list = scm_cdr (list))
    dives[i] = bt__to_idle_dive ("run", scm_car (list));
  return dives;
}

static SCM
step_dives (SCM host, SCM list, SCM step, SCM threads)
{
  int n;
  bt_dive **dives = to_dives (list, &n);
  bt_status *each = scm_gc_malloc_pointerless (sizeof *each * (size_t)(n + 1), "statuses");
  bt__handle *handle = bt__to_handle (host);
  SCM lost = SCM_EOL;
  bt_error error;
  scm_run_finalizers ();
  bt__check_long ("run", handle,
                  bt_dives_step (dives, n, scm_to_int64 (step), scm_to_int (threads), bt__ask_guile,
                                 handle, each, &error),
                  &error);
  for (int i = n; i-- > 0;)
    if (each[i] != BT_OK)
      lost = scm_cons (scm_from_int (i), lost);
  scm_remember_upto_here_2 (host, list);
  return lost;
}

static SCM
whole_steps (SCM object, SCM seconds)
{
  bt_error error;
  int64_t steps;
  bt__check ("run",
             bt_dive_whole_steps (bt__to_idle_dive ("run", object), scm_to_double (seconds), &steps,
                                  &error),
             &error);
  return scm_from_int64 (steps);
}

static SCM
carried (SCM object)
{
  return scm_from_double (bt_dive_carried (bt__to_dive (object)));
}

static SCM
carry (SCM object, SCM seconds)
{
  bt_dive_carry (bt__to_dive (object), scm_to_double (seconds));
  return SCM_UNSPECIFIED;
}

static SCM
dive_time (SCM object)
{
  return scm_from_double (bt_dive_time (bt__to_dive (object)));
}

static SCM
dive_steps (SCM object)
{
  return scm_from_int64 (bt_dive_steps (bt__to_dive (object)));
}

static SCM
dive_time_step (SCM object)
{
  return scm_from_double (bt_dive_time_step (bt__to_dive (object)));
}

/* ---- Threads ---- */

static SCM
set_threads (SCM object, SCM n)
{
  bt_dive *dive = bt__to_idle_dive ("threads!", object);
  bt_error error;
  bt_error live = { BT_ERR_DEF, "a live dive keeps its threads; say (freeze!) first" };
  if (bt__to_handle (object)->live)
    bt__raise ("threads!", &live);
  bt__check ("threads!", bt_dive_set_threads (dive, scm_to_int (n), &error), &error);
  return SCM_UNSPECIFIED;
}

/* Of a live dive what is asked is a copy: the threads are those of the one that is flown.  */
static SCM
threads (SCM object)
{
  const bt__handle *handle = bt__to_handle (object);
  return scm_from_int (bt_dive_threads (handle->flown ? handle->flown : handle->dive));
}

static SCM
most_threads (void)
{
  return scm_from_int (BT_THREADS_MAX);
}

/* ---- Checkpoints ---- */

static SCM
save_dive (SCM object)
{
  bt_dive *dive = bt__to_dive (object);
  SCM bytes = scm_c_make_bytevector (bt_dive_state_size (dive));
  bt_dive_save (dive, SCM_BYTEVECTOR_CONTENTS (bytes));
  return bytes;
}

/* The same without the room that is not in use.  */
static SCM
keep_dive (SCM object)
{
  bt_dive *dive = bt__to_dive (object);
  SCM bytes = scm_c_make_bytevector (bt_dive_keep_size (dive));
  bt_dive_keep (dive, SCM_BYTEVECTOR_CONTENTS (bytes));
  return bytes;
}

static SCM
restore_dive (SCM object, SCM bytes)
{
  bt_error error;
  bt_error live = { BT_ERR_DEF, "a live dive does not go back in time; say (freeze!) first" };
  SCM_ASSERT_TYPE (scm_is_bytevector (bytes), bytes, SCM_ARG2, "restore!", "bytevector");
  if (bt__to_handle (object)->live)
    bt__raise ("restore!", &live);
  bt_dive *dive = bt__to_idle_dive ("restore!", object);
  bt__check_long ("restore!", bt__to_handle (object),
                  bt_dive_restore (dive, SCM_BYTEVECTOR_CONTENTS (bytes),
                                   SCM_BYTEVECTOR_LENGTH (bytes), &error),
                  &error);
  scm_remember_upto_here_1 (bytes);
  return SCM_UNSPECIFIED;
}

static SCM
hash_dive (SCM object)
{
  return scm_from_uint64 (bt_dive_hash (bt__to_dive (object)));
}

void
bt__define_dives (void)
{
  static const bt__procedure table[] = {
    { "%dive?", 1, 0, (scm_t_subr)is_dive, "Return #t if OBJECT is a dive." },
    { "%fork-dive", 1, 0, (scm_t_subr)fork_dive, "Return a copy of DIVE that goes its own way." },
    { "%step-dive!", 2, 1, (scm_t_subr)step_dive,
      "Advance DIVE by COUNT steps, and note 32 bits of the state after each in HASHES." },
    { "%step-dives!", 4, 0, (scm_t_subr)step_dives,
      "Advance the DIVES of a list to STEP on up to THREADS threads; ^C interrupts as for HOST.  "
      "Return the places in the list of those that failed." },
    { "%whole-steps!", 2, 0, (scm_t_subr)whole_steps,
      "Add SECONDS to the time asked of DIVE and return the whole steps it holds." },
    { "%carried", 1, 0, (scm_t_subr)carried,
      "Return how much of the time asked of DIVE is not yet stepped, s." },
    { "%carry!", 2, 0, (scm_t_subr)carry, "Let that be SECONDS." },
    { "%dive-time", 1, 0, (scm_t_subr)dive_time, "Return the time of DIVE, s." },
    { "%dive-steps", 1, 0, (scm_t_subr)dive_steps, "Return the steps DIVE has taken." },
    { "%dive-time-step", 1, 0, (scm_t_subr)dive_time_step, "Return the time step of DIVE, s." },
    { "%set-threads!", 2, 0, (scm_t_subr)set_threads, "Let up to N threads step DIVE." },
    { "%threads", 1, 0, (scm_t_subr)threads, "Return how many may." },
    { "%most-threads", 0, 0, (scm_t_subr)most_threads, "Return the most there can be." },
    { "%rest-fork!", 2, 0, (scm_t_subr)rest_fork,
      "Keep only the state of the fork DIVE of ORIGIN until it is asked again; return #f if it is "
      "more than its state." },
    { "%save-dive", 1, 0, (scm_t_subr)save_dive, "Return the state of DIVE, a bytevector." },
    { "%keep-dive", 1, 0, (scm_t_subr)keep_dive,
      "Return the state of DIVE, a bytevector that takes no more than what is in use." },
    { "%restore-dive!", 2, 0, (scm_t_subr)restore_dive, "Return DIVE to the state in BYTES." },
    { "%hash-dive", 1, 0, (scm_t_subr)hash_dive, "Return the 64-bit hash of DIVE's state." },
  };
  dive_tag = scm_make_smob_type ("dive", 0);
  scm_set_smob_free (dive_tag, free_dive);
  scm_set_smob_print (dive_tag, print_dive);
  bt__define_procedures (table, sizeof table / sizeof *table);
}
