/* What strangers' bytes are thrown at.  Each target takes any bytes at all, and traps when what it
   got from them is not what was promised; libfuzzer.c makes a fuzzer of each, unit/fuzz_replay.c
   tries what was found on all of them.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#ifndef BT_FUZZ_TARGETS_H
#define BT_FUZZ_TARGETS_H

#include <stddef.h>
#include <stdint.h>

typedef void fuzz_target (const uint8_t *bytes, size_t n);

fuzz_target fuzz_state;   /* a saved state of a dive, spoilt by the choices that the bytes are */
fuzz_target fuzz_mavlink; /* a stream of a vehicle's telemetry, the first byte: stamped or not */
fuzz_target fuzz_mesh_stream;  /* the answer of the mesh reader */
fuzz_target fuzz_mesh_grid;    /* an ESRI ASCII grid */
fuzz_target fuzz_mesh_whole;   /* the look that the mesh reader takes at a file */
fuzz_target fuzz_mesh_convert; /* a scene of assimp, made of the bytes; wants assimp's headers */
fuzz_target fuzz_mesh_file;    /* a mesh file, through assimp itself */

static inline void
fuzz_check (int holds)
{
  if (!holds)
    __builtin_trap ();
}

#endif
