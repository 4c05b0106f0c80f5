/* Errors are values: every call that can fail returns a bt_status and fills the caller's bt_error.
   The library never prints, exits, aborts, or remembers an error.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#ifndef BIGHT_STATUS_H
#define BIGHT_STATUS_H

#include <bight/decls.h>

BT_BEGIN_DECLS

/* What kind of mistake it was.  Scheme sees the same kinds as symbols, see bt_status_name.  */
typedef enum bt_status
{
  BT_OK = 0,
  BT_ERR_DOMAIN,      /* a number outside its range, or not finite */
  BT_ERR_NAME,        /* no such part, field, model, word */
  BT_ERR_STALE,       /* a handle or checkpoint that belongs to something else */
  BT_ERR_DEF,         /* a world that does not hold together */
  BT_ERR_LIMIT,       /* too many, too large, out of memory */
  BT_ERR_DIVERGED,    /* no finite answer was found */
  BT_ERR_IO,          /* a file that cannot be read or written */
  BT_ERR_FORMAT,      /* a file whose content is wrong */
  BT_ERR_VERSION,     /* data written by another version */
  BT_ERR_UNSUPPORTED, /* the chosen model has no answer to this */
  BT_ERR_INTERRUPTED  /* who called gave up: see bt_poll */
} bt_status;

enum
{
  BT_ERROR_TEXT = 400
};

typedef struct bt_error
{
  bt_status status;
  char text[BT_ERROR_TEXT]; /* one sentence: what was given, what is allowed; UTF-8 */
} bt_error;

/* Return the lower-case word for STATUS ("domain", "name", ...; "ok" for BT_OK).  Never NULL.  */
const char *bt_status_name (bt_status status);

/* A long call asks its poll between pieces of work, each much shorter than a tenth of a second.
   SHARE, 0 to 1, is the part of the work done so far, as far as known.  A poll that returns true
   stops the call: the call fails by BT_ERR_INTERRUPTED and changes nothing.  */
typedef int (*bt_poll) (void *user, double share);

/* Return the version of the library, "MAJOR.MINOR.PATCH".  */
const char *bt_version (void);

BT_END_DECLS

#endif
