/* Functions on a current's grid for the rooms above, beside its questions.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#ifndef BT_SEA_GRID_H
#define BT_SEA_GRID_H

#include <bight/sea.h>

#include "base/hash.h"

/* Return the hash of GRID's content, continued from SEED: part of a model's identity.  */
uint64_t bt__current_grid_hash (const bt_current_grid *grid, uint64_t seed);

#endif
