/* The fuzzer of the target that FUZZ_TARGET names, see targets.h.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include "targets.h"

int LLVMFuzzerTestOneInput (const uint8_t *bytes, size_t n);

int
LLVMFuzzerTestOneInput (const uint8_t *bytes, size_t n)
{
  FUZZ_TARGET (bytes, n);
  return 0;
}
