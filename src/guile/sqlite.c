/* The extension for SQLite: fills the module (bight core sqlite), and is loaded with the first
   database.

   A database is in WAL mode: committed data survives the end of the process.  Usually several
   processes may write, and a writer waits for another.  A database can also be opened for a single
   process, by SQLite's exclusive locking mode, without shared memory and therefore also on a
   network file system.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <stdlib.h>
#include <string.h>

#include <sqlite3.h>

#include "guile/guile.h"

enum
{
  PATIENCE = 10000,     /* ms that a writer waits for another */
  SHORT_PATIENCE = 1000 /* ms that who wants a database for himself waits for who reads it */
};

static scm_t_bits database_tag;

static size_t
free_database (SCM object)
{
  sqlite3_close_v2 ((sqlite3 *)SCM_SMOB_DATA (object));
  return 0;
}

static sqlite3 *
to_database (SCM object)
{
  bt_error closed = { BT_ERR_STALE, "this database is closed" };
  scm_assert_smob_type (database_tag, object);
  if (!SCM_SMOB_DATA (object))
    bt__raise ("database", &closed);
  return (sqlite3 *)SCM_SMOB_DATA (object);
}

/* A file that is no database is of the wrong format; all else is the system's fault.  */
static void
raise_sqlite (const char *who, sqlite3 *database, int code)
{
  bt_error error;
  int format = code == SQLITE_NOTADB || code == SQLITE_CORRUPT;
  const char *text = database ? sqlite3_errmsg (database) : sqlite3_errstr (code);
  error.status = format ? BT_ERR_FORMAT : BT_ERR_IO;
  strncpy (error.text, text, sizeof error.text - 1);
  error.text[sizeof error.text - 1] = 0;
  bt__raise (who, &error);
}

/* Open NAME and say how it is to be locked; return what SQLite says.  The lock of the exclusive
   mode is taken by the first statement that reads, and kept until the database is closed.  */
static int
open_named (const char *name, int alone, sqlite3 **database)
{
  const char *mode = alone ? "pragma locking_mode=exclusive;"
                             "pragma journal_mode=wal; pragma synchronous=normal;"
                             "begin immediate; commit;"
                           : "pragma journal_mode=wal; pragma synchronous=normal;";
  int code = sqlite3_open_v2 (name, database, SQLITE_OPEN_READWRITE | SQLITE_OPEN_CREATE, NULL);
  if (code != SQLITE_OK)
    return code;
  sqlite3_extended_result_codes (*database, 0);
  sqlite3_busy_timeout (*database, alone ? SHORT_PATIENCE : PATIENCE);
  code = sqlite3_exec (*database, mode, NULL, NULL, NULL);
  sqlite3_busy_timeout (*database, PATIENCE);
  return code;
}

static SCM
open_database (SCM file, SCM alone)
{
  int only = !SCM_UNBNDP (alone) && scm_is_true (alone);
  sqlite3 *database = NULL;
  int code;
  char *name;
  scm_dynwind_begin (0);
  name = scm_to_utf8_string (file);
  scm_dynwind_free (name);
  code = open_named (name, only, &database);
  scm_dynwind_end ();
  if (code == SQLITE_OK)
    return scm_new_smob (database_tag, (scm_t_bits)database);
  sqlite3_close_v2 (database);
  if (!only || code != SQLITE_BUSY)
    raise_sqlite ("database", NULL, code);
  return SCM_BOOL_F;
}

static SCM
close_database (SCM object)
{
  scm_assert_smob_type (database_tag, object);
  sqlite3_close_v2 ((sqlite3 *)SCM_SMOB_DATA (object));
  SCM_SET_SMOB_DATA (object, 0);
  return SCM_UNSPECIFIED;
}

/* ---- Statements ---- */

static void
finish (void *statement)
{
  sqlite3_finalize (statement);
}

static void
bind_text (sqlite3_stmt *statement, int i, SCM value)
{
  size_t n;
  char *text = scm_to_utf8_stringn (value, &n);
  sqlite3_bind_text (statement, i, text, (int)n, free);
}

static void
bind_value (sqlite3_stmt *statement, int i, SCM value)
{
  if (scm_is_string (value))
    bind_text (statement, i, value);
  else if (scm_is_symbol (value))
    bind_text (statement, i, scm_symbol_to_string (value));
  else if (scm_is_signed_integer (value, INT64_MIN, INT64_MAX))
    sqlite3_bind_int64 (statement, i, scm_to_int64 (value));
  else if (scm_is_real (value))
    sqlite3_bind_double (statement, i, scm_to_double (value));
  else
    sqlite3_bind_null (statement, i);
}

static void
bind_row (sqlite3_stmt *statement, SCM row)
{
  for (int i = 1; scm_is_pair (row); row = SCM_CDR (row))
    bind_value (statement, i++, SCM_CAR (row));
}

static SCM
from_column (sqlite3_stmt *statement, int i)
{
  switch (sqlite3_column_type (statement, i))
    {
    case SQLITE_INTEGER:
      return scm_from_int64 (sqlite3_column_int64 (statement, i));
    case SQLITE_FLOAT:
      return scm_from_double (sqlite3_column_double (statement, i));
    case SQLITE_NULL:
      return SCM_BOOL_F;
    default:
      return scm_from_utf8_stringn ((const char *)sqlite3_column_text (statement, i),
                                    (size_t)sqlite3_column_bytes (statement, i));
    }
}

static SCM
from_row (sqlite3_stmt *statement)
{
  SCM row = SCM_EOL;
  for (int i = sqlite3_column_count (statement); i-- > 0;)
    row = scm_cons (from_column (statement, i), row);
  return row;
}

static sqlite3_stmt *
prepare (sqlite3 *database, SCM text)
{
  sqlite3_stmt *statement = NULL;
  char *sql = scm_to_utf8_string (text);
  int code = sqlite3_prepare_v2 (database, sql, -1, &statement, NULL);
  free (sql);
  if (code != SQLITE_OK)
    raise_sqlite ("database", database, code);
  scm_dynwind_unwind_handler (finish, statement, SCM_F_WIND_EXPLICITLY);
  return statement;
}

static SCM
query (SCM object, SCM text, SCM values)
{
  sqlite3 *database = to_database (object);
  sqlite3_stmt *statement;
  SCM rows = SCM_EOL;
  int code;
  scm_dynwind_begin (0);
  statement = prepare (database, text);
  bind_row (statement, values);
  while ((code = sqlite3_step (statement)) == SQLITE_ROW)
    rows = scm_cons (from_row (statement), rows);
  if (code != SQLITE_DONE)
    raise_sqlite ("database", database, code);
  scm_dynwind_end ();
  return scm_reverse_x (rows, SCM_EOL);
}

static SCM
insert (SCM object, SCM text, SCM rows)
{
  sqlite3 *database = to_database (object);
  sqlite3_stmt *statement;
  scm_dynwind_begin (0);
  statement = prepare (database, text);
  for (; scm_is_pair (rows); rows = SCM_CDR (rows))
    {
      int code;
      bind_row (statement, SCM_CAR (rows));
      code = sqlite3_step (statement);
      if (code != SQLITE_DONE && code != SQLITE_ROW)
        raise_sqlite ("database", database, code);
      sqlite3_reset (statement);
    }
  scm_dynwind_end ();
  return SCM_UNSPECIFIED;
}

void bight_sqlite_init (void);

__attribute__ ((visibility ("default"))) void
bight_sqlite_init (void)
{
  static const bt__procedure table[] = {
    { "%open-database", 1, 1, (scm_t_subr)open_database,
      "Open the database FILE, made if there is none, for many readers and writers; or, if ALONE "
      "is "
      "true, for this process alone: then return #f if another has it." },
    { "%close-database", 1, 0, (scm_t_subr)close_database, "Close DATABASE." },
    { "%query", 3, 0, (scm_t_subr)query,
      "Do the statement SQL in DATABASE with VALUES for its `?', and return its rows, lists." },
    { "%insert", 3, 0, (scm_t_subr)insert,
      "Do the statement SQL in DATABASE once for each of ROWS, lists of values for its `?'." },
  };
  database_tag = scm_make_smob_type ("database", 0);
  scm_set_smob_free (database_tag, free_database);
  bt__define_procedures (table, sizeof table / sizeof *table);
}
