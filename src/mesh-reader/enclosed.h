/* The enclosure of every reader program: limits on time and memory, one line of complaint, an
   answer out of the library's reach.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#ifndef BT_MESH_READER_ENCLOSED_H
#define BT_MESH_READER_ENCLOSED_H

#include <stddef.h>
#include <stdint.h>
#include <stdio.h>

#include <bight/status.h>

/* Limit this process to CPU seconds and MEGABYTES of addresses, both decimal numbers, and to no
   dump of its memory.  */
void bt__enclosed_limit (const char *cpu, const char *megabytes);

/* Let this process write to no file of its own making: pipes alone are left.  */
void bt__enclosed_write_nothing (void);

/* Say WORDS on standard error as one line, whatever characters are in them.  Return STATUS.  */
int bt__enclosed_complain (int status, const char *words);

/* Say the sentence of ERROR so.  Return the exit status that stands for its kind.  */
int bt__enclosed_complain_of (const bt_error *error);

/* Return the standard output; for all other code standard output is standard error from now on; or
   NULL.  */
FILE *bt__enclosed_output (void);

/* Write N bytes of DATA to TO, and continue the hash *SUM by them.  Return true if all are written.
 */
int bt__enclosed_put (FILE *to, const void *data, size_t n, uint64_t *sum);

/* Write the hash SUM, the end of an answer.  Return true if all of the answer is written.  */
int bt__enclosed_finish (FILE *to, uint64_t sum);

#endif
