/* What fuzzing kept, once more: every file of tests/data/fuzz/TARGET through that target, and what
   a seeded generator makes of each by changing, cutting and doubling bytes.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <config.h>

#include <dirent.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "fuzz/targets.h"

enum
{
  MOST = 4096, /* bytes of an input */
  TURNS = 2000 /* mutants of each */
};

static unsigned
draw (uint64_t *seed, size_t below)
{
  *seed = *seed * 6364136223846793005u + 1442695040888963407u;
  return (unsigned)((*seed >> 33) % below);
}

/* Change the N bytes of B a little; return how many there are then.  */
static size_t
mutate (uint8_t *b, size_t n, uint64_t *seed)
{
  for (unsigned k = 1 + draw (seed, 4); k > 0 && n > 0; k--)
    {
      size_t at = draw (seed, n), some = 1 + draw (seed, n - at);
      switch (draw (seed, 4))
        {
        case 0:
          b[at] ^= (uint8_t)(1u << draw (seed, 8));
          break;
        case 1:
          b[at] = (uint8_t)draw (seed, 256);
          break;
        case 2:
          n = at;
          break;
        default:
          some = n + some > MOST ? MOST - n : some;
          memmove (b + at + some, b + at, n - at);
          n += some;
        }
    }
  return n;
}

static void
replay_file (fuzz_target *target, const char *path, uint64_t *seed)
{
  uint8_t bytes[MOST], mutant[MOST];
  FILE *f = fopen (path, "rb");
  assert_non_null (f);
  size_t n = fread (bytes, 1, sizeof bytes, f);
  fclose (f);
  target (bytes, n);
  for (int i = 0; i < TURNS; i++)
    {
      memcpy (mutant, bytes, n);
      target (mutant, mutate (mutant, n, seed));
    }
}

static void
replay (fuzz_target *target, const char *name)
{
  const char *source = getenv ("top_srcdir");
  char folder[1000], path[2000];
  uint64_t seed = 1;
  int files = 0;
  snprintf (folder, sizeof folder, "%s/tests/data/fuzz/%s", source ? source : ".", name);
  DIR *dir = opendir (folder);
  assert_non_null (dir);
  for (struct dirent *d; (d = readdir (dir));)
    if (d->d_name[0] != '.')
      {
        snprintf (path, sizeof path, "%s/%s", folder, d->d_name);
        replay_file (target, path, &seed);
        files++;
      }
  closedir (dir);
  assert_true (files > 0);
}

static void
mavlink (void **state)
{
  (void)state;
  replay (fuzz_mavlink, "mavlink");
}

static void
mesh_stream (void **state)
{
  (void)state;
  replay (fuzz_mesh_stream, "mesh_stream");
}

static void
mesh_grid (void **state)
{
  (void)state;
  replay (fuzz_mesh_grid, "mesh_grid");
}

static void
mesh_whole (void **state)
{
  (void)state;
  replay (fuzz_mesh_whole, "mesh_whole");
}

static void
mesh_convert (void **state)
{
  (void)state;
#ifdef HAVE_ASSIMP
  replay (fuzz_mesh_convert, "mesh_convert");
#else
  skip ();
#endif
}

int
main (void)
{
  const struct CMUnitTest tests[] = {
    cmocka_unit_test (mavlink),
    cmocka_unit_test (mesh_stream),
    cmocka_unit_test (mesh_grid),
    cmocka_unit_test (mesh_whole),
    cmocka_unit_test (mesh_convert),
  };
  return cmocka_run_group_tests (tests, NULL, NULL);
}
