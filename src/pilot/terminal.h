/* The terminal while a dive is flown in it: keys as they come, and a state to go back to.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#ifndef BT_PILOT_TERMINAL_H
#define BT_PILOT_TERMINAL_H

#include <stddef.h>

#include <bight/status.h>

/* Take the terminal on standard input and output: keys one by one and unseen, the other page of the
   screen, no cursor.  However the process ends from here on, the terminal is put back: by
   bt__terminal_leave, by `exit', by handlers of the deadly signals, or else by a small child
   process that waits for the end of its parent.  BT_ERR_UNSUPPORTED without a terminal, or if TERM
   is dumb.  */
bt_status bt__terminal_enter (bt_error *error);

/* Put the terminal back if it was taken.  */
void bt__terminal_leave (void);

/* Tell the size of the terminal in characters, or 80 by 24.  */
void bt__terminal_size (int *columns, int *rows);

/* Wait at most SECONDS for keys and put up to ROOM bytes into BYTES.  Return the number of bytes,
   or -1 when the terminal is gone.  */
int bt__terminal_keys (double seconds, char *bytes, size_t room);

/* Write all N BYTES; zero when the terminal is gone, or takes nothing for ten seconds.  */
int bt__terminal_write (const char *bytes, size_t n);

#endif
