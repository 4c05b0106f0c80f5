/* Shared declarations of the Guile binding, which uses the installed headers of the engine alone.

   The binding has a file for each noun, with a table of procedures: name, arguments and docstring.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#ifndef BT_GUILE_GUILE_H
#define BT_GUILE_GUILE_H

#include <bight/bight.h>
#include <libguile.h>

/* One Scheme procedure of (bight engine).  */
typedef struct bt__procedure
{
  const char *name;
  int required, optional;
  scm_t_subr function;
  const char *documentation;
} bt__procedure;

/* Define and export the N procedures of TABLE in the current module.  */
void bt__define_procedures (const bt__procedure *table, size_t n);

/* The tables, one for each file.  */
void bt__define_parts (void);
void bt__define_shapes (void);
void bt__define_geo (void);
void bt__define_dives (void);
void bt__define_operations (void);
void bt__define_times (void);
void bt__define_live (void);
void bt__define_quantities (void);
void bt__define_questions (void);
void bt__define_types (void);
void bt__define_views (void);
void bt__define_contacts (void);
void bt__define_aware (void);
void bt__define_outlines (void);
void bt__define_instruments (void);
void bt__define_patience (void);

/* Raise ERROR as a &bight-error on behalf of the Scheme procedure WHO.  Does not return.  */
void bt__raise (const char *who, const bt_error *error) SCM_NORETURN;

/* Raise ERROR unless STATUS is BT_OK.  */
void bt__check (const char *who, bt_status status, const bt_error *error);

/* Return the N numbers X as an f64vector.  */
SCM bt__from_doubles (const double *x, size_t n);

/* A dive, the Scheme procedure of its current, if any, and the journal of its operations.  */
typedef struct bt__handle
{
  bt_dive *dive;    /* while it is live, a copy to ask, no older than the last question */
  SCM function;     /* or #f */
  int asking;       /* true while the procedure runs, in the middle of a step or an operation */
  SCM journal;      /* the operations that were done, the last first, as `%journal' has them */
  int64_t serial;   /* of the last one; never the same twice */
  bt_live *live;    /* or NULL */
  bt_dive *flown;   /* the dive itself while it is live: the thread's */
  uint64_t edition; /* of what DIVE is a copy of */
  bt_dive *spare;   /* memory for the next fork, or NULL */
  SCM rest;         /* of a fork at rest, DIVE being NULL: the state, a bytevector; else #f */
  SCM origin;       /* of a fork at rest: the dive forked */
  double carried;   /* of a fork at rest: s of time asked for and not yet stepped */
  SCM host;         /* the handle whose live dive this one shares, or #f */
  SCM thrown;       /* (KEY . ARGS) while the engine gives up what was interrupted, else #f */
  double looked;    /* s: when it was last looked whether something waits */
  int told;         /* true: how far the present call is was told */
  int states; /* of DIVE, or FLOWN, known to the collector: 1 of a fork, 2 of a dive that moves */
  int spare_states; /* of SPARE, likewise */
  SCM names[BT_PART_OBSTACLE
            + 1]; /* of the parts of each kind, once they were asked for; else #f */
} bt__handle;

/* Write the last DIGITS hexadecimal digits of X to TEXT, without a zero behind them.  */
void bt__hexadecimal (char *text, uint64_t x, int digits);

/* bt__ask_guile is a bt_poll for the dive of a handle.  bt__check_long ends a call that asked the
   poll: the function raises the exception that interrupted the call, or else ERROR, unless STATUS
   is BT_OK.  */
int bt__ask_guile (void *handle, double share);
void bt__check_long (const char *who, bt__handle *handle, bt_status status, const bt_error *error);

bt_dive *bt__to_dive (SCM object);
/* The same, but raise `def' while its current is being asked: it is not to be changed then.  */
bt_dive *bt__to_idle_dive (const char *who, SCM object);
/* Do OP on the dive of HANDLE, live or not, for the procedure WHO, and note OP in the journal.  */
void bt__operate (const char *who, bt__handle *handle, bt_op op, int subject, const double *args,
                  int n);
/* Make a handle, at first without a dive; make the Scheme object of a handle with a dive.  */
bt__handle *bt__new_handle (SCM function);
SCM bt__from_handle (bt__handle *handle);
bt__handle *bt__to_handle (SCM object);
/* Tell the collector that the dive of HANDLE has so many STATES, which are not the collector's
 * memory.  */
void bt__tell_states (bt__handle *handle, int states);
/* One at a time: what threads that share a live dive do to its handle.  */
void bt__lock_sharing (void);
void bt__unlock_sharing (void);
/* The bt_current_function that calls a Scheme procedure; USER is the handle.  */
void bt__call_current (void *user, bt_vec3 p, double t, bt_vec3 *v);

/* The symbol of NAME, a text that stays where it is.  */
SCM bt__symbol (const char *name);

/* Put the association (NAME . VALUE), NAME as a symbol, in front of the list REST.  */
SCM bt__associate (const char *name, SCM value, SCM rest);

/* Points: an f64vector of three; a polyline of N points: an N x 3 array.  */
SCM bt__from_point (bt_vec3 p);
bt_vec3 bt__to_point (const char *who, SCM object);
SCM bt__from_points (const bt_vec3 *points, int n);

/* The symbol that names an obstacle, or #f where there is none.  */
SCM bt__obstacle_name (bt_dive *dive, int object);

/* The current that the canonical list OBJECT describes.  *FUNCTION receives the procedure of a
   (function PROC) current, else is left alone.  */
bt_current bt__to_current (const char *who, SCM object, SCM *function);

/* The kind of part that SYMBOL is the head of.  */
const bt_head *bt__to_head (const char *who, SCM symbol);

/* The part a symbol means: sea, rov, tether or obstacle.  */
bt_part bt__to_part (const char *who, SCM symbol);

/* Set FIELD of DEF from a Scheme value: number, word, point or part's name.  */
bt_status bt__set_field (const char *who, const bt_field *field, void *def, SCM value,
                         bt_error *error);

/* Set FIELD of DEF, of the kind rows, mesh or grid, from a Scheme value; DEF borrows the memory of
   the value.  Return false if FIELD is of another kind.  */
int bt__set_shape (const char *who, const bt_field *field, void *def, SCM value);

/* The word, or else the number, that VALUE of FIELD reads as.  */
SCM bt__from_field (const bt_field *field, double value);

#endif
