/* See chance.h.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <math.h>

#include "testbed/chance.h"

double
chance (uint64_t *seed)
{
  *seed ^= *seed << 13;
  *seed ^= *seed >> 7;
  *seed ^= *seed << 17;
  return (double)(*seed >> 11) * 0x1p-53;
}

double
chance_between (uint64_t *seed, double from, double to)
{
  return from + (to - from) * chance (seed);
}

double
chance_decades (uint64_t *seed, double from, double to)
{
  return pow (10, chance_between (seed, from, to));
}
