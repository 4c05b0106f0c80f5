/* The moving line beside MoorDyn, as others measured that.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#ifndef BT_BENCH_MOORDYN_H
#define BT_BENCH_MOORDYN_H

/* Print MoorDyn's work and precision on its case C and ours beside it, in steps of the base line:
   theirs of the machine they were measured on, ours of CALIBRATION seconds.  Without the reference
   data say so.  */
void bench_moordyn (double calibration);

#endif
