/* Random numbers by xorshift64 (G. Marsaglia, "Xorshift RNGs", Journal of Statistical Software 8
   (14), 2003): the same everywhere.  Each call changes *SEED, which is never 0.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#ifndef BT_TESTBED_CHANCE_H
#define BT_TESTBED_CHANCE_H

#include <stdint.h>

/* Return a number of at least 0 and below 1; from FROM to TO; 10 to the power of such a number.  */
double chance (uint64_t *seed);
double chance_between (uint64_t *seed, double from, double to);
double chance_decades (uint64_t *seed, double from, double to);

#endif
