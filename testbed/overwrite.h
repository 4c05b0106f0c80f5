/* The room that a moving line is solved in, overwritten: what a step leaves there must not reach
   the next.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#ifndef TESTBED_OVERWRITE_H
#define TESTBED_OVERWRITE_H

#include "tether/dynamic.h"

/* Set every byte of WORK's vectors and numbers per node and per interval to BYTE.  */
void overwrite_work (bt__dynamic_work *work, int byte);

#endif
