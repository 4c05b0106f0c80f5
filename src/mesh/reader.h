/* A reader program: a separate process for a foreign library that reads a foreign file and answers
   with a stream.  The functions here find and start the program, hand the answer to the function
   for the stream, and turn the exit status into an error.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#ifndef BT_MESH_READER_H
#define BT_MESH_READER_H

#include <stdint.h>

#include <bight/status.h>

#include "mesh/answer.h"

/* Exit statuses of a reader; after a failure one line stands on the standard error.  */
enum
{
  BT__READER_EXIT_OK = 0,
  BT__READER_EXIT_FORMAT = 10,
  BT__READER_EXIT_LIMIT,
  BT__READER_EXIT_IO
};

/* One kind of reader.  */
typedef struct bt__reader
{
  const char *program;  /* its name where it is installed */
  const char *variable; /* of the environment: another program in its place */
  const char *title;    /* as a sentence calls it: "the mesh reader" */
  const char *files;    /* what it reads: "mesh files" */
  const char *library;  /* what it is made of, and the Debian package of that */
  uint64_t most_bytes;  /* of a file */
} bt__reader;

/* What reading one file may cost.  */
typedef struct bt__reader_limits
{
  double seconds;     /* of the clock */
  unsigned cpu;       /* s of the reader */
  unsigned megabytes; /* of the reader's address space */
} bt__reader_limits;

enum
{
  BT__READER_ARGUMENTS = 10 /* of a reader at most, after those that all have */
};

/* Takes the stream ANSWER into INTO; the sentence in *ERROR does not name the file.  */
typedef bt_status bt__reader_take (const bt__answer *answer, void *into, bt_error *error);

/* Run READER on FILE within LIMITS, PROGRAM CPU-SECONDS MEGABYTES FILE ARGUMENT..., the last of
   ARGUMENTS before a NULL, and have TAKE take the answer into INTO.  The caller frees the result of
   TAKE, also when the READER fails afterwards.  BT_ERR_UNSUPPORTED when bight was built without
   READER, BT_ERR_IO, BT_ERR_LIMIT, BT_ERR_FORMAT, what TAKE returns.  */
bt_status bt__reader_ask (const bt__reader *reader, const char *file, char *const *arguments,
                          const bt__reader_limits *limits, bt__reader_take *take, void *into,
                          bt_error *error);

#endif
