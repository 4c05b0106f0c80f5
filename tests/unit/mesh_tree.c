/* The tree of a large mesh: the same bits for any number of workers and from disk; a file that is
   not sound, or not there, or cannot be written, is as none.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <config.h>

#include <fcntl.h>
#include <limits.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cmocka.h>

#include "base/hash.h"
#include "collide/mesh_keep.h"

enum
{
  SIDE = 190, /* posts: 71 442 triangles, enough to be shared out and kept */
  TRIANGLES = 2 * (SIDE - 1) * (SIDE - 1),
  POSTS = SIDE * SIDE,
  HEAD = 8 + 4 + 4 + 8 + 16 + 24 + 8 + 48 /* bytes of a file before its nodes */
};

/* Trees on users' disks are told apart by FILE_VERSION of mesh_keep.c alone.  Whoever changes what
   a tree or the rings of a mesh are raises that number, and writes the new bits here.  */
#define BITS 0x6daf8da12a3c001bULL

static bt_vec3 vertex[POSTS];
static uint32_t corner[TRIANGLES][3];
static char folder[] = "/tmp/bight-trees-XXXXXX", file[PATH_MAX];

/* A rough bed of whole numbers over 64, with a steep corner, so that parts are of all sizes.  */
static int
build_bed (void **state)
{
  uint32_t n = 0, dice = 1;
  (void)state;
  for (uint32_t i = 0; i < POSTS; i++)
    {
      double x = i % SIDE, y = (double)(i / SIDE);
      dice = dice * 1664525u + 1013904223u;
      vertex[i] = bt__vec (x, y, (dice >> 26) / 64.0 + (x < 20 && y < 20 ? x * y : 0));
    }
  for (uint32_t j = 0; j + 1 < SIDE; j++)
    for (uint32_t i = 0; i + 1 < SIDE; i++)
      {
        uint32_t a = i + j * SIDE,
                 both[2][3] = { { a, a + 1, a + SIDE + 1 }, { a, a + SIDE + 1, a + SIDE } };
        memcpy (corner[n], both, sizeof both);
        n += 2;
      }
  if (!mkdtemp (folder))
    return -1;
  setenv ("BIGHT_TREES", "", 1);
  return 0;
}

static int
remove_folder (void **state)
{
  char command[PATH_MAX];
  (void)state;
  snprintf (command, sizeof command, "rm -rf %s", folder);
  return system (command);
}

static bt__soup
soup_of (uint32_t triangles, int workers)
{
  return (bt__soup){ POSTS, triangles, vertex, (const uint32_t (*)[3])corner, NULL, workers };
}

/* By so many WORKERS.  */
static bt__mesh *
make (uint32_t triangles, int workers)
{
  bt__soup soup = soup_of (triangles, workers);
  bt__mesh *m = NULL;
  bt_error error;
  if (bt__mesh_new (&soup, NULL, NULL, &m, &error))
    fail_msg ("%s", error.text);
  return m;
}

static uint64_t
bits (const bt__mesh *m)
{
  size_t n = m->triangles;
  uint64_t h = bt__hash (m->tree.node, m->tree.nodes * sizeof *m->tree.node, 0);
  h = bt__hash (&m->tree.origin, sizeof m->tree.origin, h);
  h = bt__hash (&m->tree.extent, sizeof m->tree.extent, h);
  h = bt__hash (&m->box, sizeof m->box, h);
  h = bt__hash (m->tree.order, n * sizeof *m->tree.order, h);
  h = bt__hash (m->corner, n * sizeof *m->corner, h);
  h = bt__hash (m->id, n * sizeof *m->id, h);
  h = bt__hash (m->next_corner, 3 * n * sizeof *m->next_corner, h);
  h = bt__hash (m->next_edge, 3 * n * sizeof *m->next_edge, h);
  return bt__hash (m->folds, n, h);
}

static uint64_t
made_bits (uint32_t triangles, int workers)
{
  bt__mesh *m = make (triangles, workers);
  uint64_t h = bits (m);
  bt__mesh_free (m);
  return h;
}

/* ---- Workers ---- */

static void
test_any_number_of_workers (void **state)
{
  (void)state;
  for (int workers = 2; workers <= 5; workers++)
    for (int again = 0; again < 3; again++)
      assert_int_equal (made_bits (TRIANGLES, workers), BITS);
}

static void
test_bits_of_this_version (void **state)
{
  (void)state;
  assert_int_equal (made_bits (TRIANGLES, 1), BITS);
}

static int
count_down (void *user, double share)
{
  int *left = user;
  (void)share;
  return --*left < 0;
}

/* Return the status of a mesh given up at the question LEFT.  */
static bt_status
make_for (int left, int workers)
{
  bt__soup soup = soup_of (TRIANGLES, workers);
  bt__asker asker = { .poll = count_down, .user = &left };
  bt__mesh *m = NULL;
  bt_error error;
  bt_status status = bt__mesh_new (&soup, NULL, &asker, &m, &error);
  if (!status)
    bt__mesh_free (m);
  else
    assert_null (m);
  return status;
}

static void
test_given_up_at_any_question (void **state)
{
  (void)state;
  for (int workers = 1; workers <= 3; workers++)
    {
      int left = 0, given_up = 0;
      for (; make_for (left, workers) == BT_ERR_INTERRUPTED; left = 3 * left / 2 + 1)
        given_up++;
      assert_int_equal (make_for (INT_MAX, workers), BT_OK);
      assert_true (given_up > (workers == 1 ? 10 : 1));
    }
}

/* ---- On disk ---- */

static off_t
size_of (const char *name)
{
  struct stat st;
  return stat (name, &st) == 0 ? st.st_size : -1;
}

/* The name of the file of the whole bed, in folder IN.  */
static void
name_file (const char *in)
{
  bt__soup soup = soup_of (TRIANGLES, 1);
  bt__mesh m = { .vertices = POSTS, .triangles = TRIANGLES, .v = vertex };
  snprintf (file, sizeof file, "%s/%016llx.tree", in, (unsigned long long)bt__keep_key (&m, &soup));
}

static void
use_folder (const char *name)
{
  char path[PATH_MAX / 2];
  snprintf (path, sizeof path, "%s/%s", folder, name);
  setenv ("BIGHT_TREES", path, 1);
  name_file (path);
}

/* Return true if the tree is taken from disk, and then its bits must be right; else the mesh must
   be untouched.  */
static int
is_loaded (void)
{
  bt__soup soup = soup_of (TRIANGLES, 1);
  bt__mesh *m = calloc (1, sizeof *m);
  *m = (bt__mesh){ .vertices = POSTS, .triangles = TRIANGLES };
  m->v = malloc (sizeof vertex);
  m->corner = malloc (sizeof corner);
  m->id = malloc (TRIANGLES * sizeof *m->id);
  memcpy (m->v, vertex, sizeof vertex);
  memcpy (m->corner, corner, sizeof corner);
  int loaded = bt__keep_load (m, &soup, bt__keep_key (m, &soup));
  if (loaded)
    assert_int_equal (bits (m), BITS);
  else
    {
      assert_memory_equal (m->corner, corner, sizeof corner);
      assert_null (m->tree.node);
      assert_null (m->next_edge);
    }
  bt__mesh_free (m);
  return loaded;
}

static void
test_round_trip (void **state)
{
  (void)state;
  use_folder ("a/b/c");
  assert_int_equal (size_of (file), -1);
  assert_int_equal (made_bits (TRIANGLES, 2), BITS);
  assert_true (size_of (file) > TRIANGLES);
  assert_true (is_loaded ());
  assert_int_equal (made_bits (TRIANGLES, 3), BITS);
}

static void
test_where (void **state)
{
  char name[PATH_MAX / 2], home[PATH_MAX / 4];
  (void)state;
  const char *old = getenv ("HOME");
  snprintf (home, sizeof home, "%s", old ? old : "/");
  unsetenv ("BIGHT_TREES");
  setenv ("XDG_CACHE_HOME", folder, 1);
  snprintf (name, sizeof name, "%s/bight/trees", folder);
  name_file (name);
  made_bits (TRIANGLES, 1);
  assert_true (size_of (file) > 0);
  setenv ("XDG_CACHE_HOME", "not/absolute", 1);
  setenv ("HOME", folder, 1);
  snprintf (name, sizeof name, "%s/.cache/bight/trees", folder);
  name_file (name);
  made_bits (TRIANGLES, 1);
  assert_true (size_of (file) > 0);
  setenv ("HOME", home, 1);
  unsetenv ("XDG_CACHE_HOME");
}

static void
test_small_or_left_out (void **state)
{
  char path[PATH_MAX / 2];
  (void)state;
  use_folder ("small");
  snprintf (path, sizeof path, "%s/small", folder);
  made_bits (BT__KEEP_FROM - 1, 1);
  assert_int_equal (size_of (path), -1);
  made_bits (BT__KEEP_FROM, 1);
  assert_true (size_of (path) > 0);
  use_folder ("none");
  setenv ("BIGHT_TREES", "", 1);
  made_bits (TRIANGLES, 1);
  assert_int_equal (size_of (file), -1);
}

/* ---- Files that are not sound ---- */

static unsigned char *bytes;
static size_t length;

static void
read_file (void)
{
  length = (size_t)size_of (file);
  bytes = malloc (length + 1);
  int fd = open (file, O_RDONLY);
  assert_int_equal (read (fd, bytes, length), length);
  close (fd);
}

static void
write_file (size_t n)
{
  unlink (file);
  int fd = open (file, O_WRONLY | O_CREAT | O_EXCL, 0600);
  assert_int_equal (write (fd, bytes, n), n);
  close (fd);
}

static uint32_t
nodes (void)
{
  uint32_t n;
  memcpy (&n, bytes + 8 + 4 + 4 + 8 + 4 + 4, sizeof n);
  return n;
}

static size_t
order_at (void)
{
  return HEAD + nodes () * sizeof (bt__bvh_node);
}

/* Give the file the hash of what stands in it.  */
static void
sign (void)
{
  bt__hash_lanes lanes;
  size_t n = TRIANGLES, at = HEAD,
         part[5] = { nodes () * sizeof (bt__bvh_node), 4 * n, 12 * n, 12 * n, n };
  bt__hash_begin (&lanes);
  bt__hash_add (&lanes, bytes, HEAD);
  for (int i = 0; i < 5; at += part[i++])
    bt__hash_add (&lanes, bytes + at, part[i]);
  uint64_t sum = bt__hash_end (&lanes);
  assert_int_equal (at + sizeof sum, length);
  memcpy (bytes + at, &sum, sizeof sum);
}

/* Write the file with SIZE bytes at AT as FROM has them, signed; return true if it is taken.  */
static int
is_taken_with (size_t at, const void *from, size_t size)
{
  unsigned char *before = malloc (length);
  memcpy (before, bytes, length);
  memcpy (bytes + at, from, size);
  sign ();
  write_file (length);
  memcpy (bytes, before, length);
  free (before);
  return is_loaded ();
}

static int
is_taken_with_word (size_t at, uint32_t word)
{
  return is_taken_with (at, &word, sizeof word);
}

static uint32_t
word_at (size_t at)
{
  uint32_t word;
  memcpy (&word, bytes + at, sizeof word);
  return word;
}

static void
begin_spoiling (const char *name)
{
  use_folder (name);
  made_bits (TRIANGLES, 1);
  read_file ();
  assert_true (is_taken_with_word (8, word_at (8)));
}

static void
test_damaged (void **state)
{
  (void)state;
  begin_spoiling ("damaged");
  for (int k = 0; k < 24; k++)
    {
      size_t at = (length - 1) * (size_t)k / 23;
      bytes[at] ^= (unsigned char)(1 << k % 8);
      write_file (length);
      assert_false (is_loaded ());
      bytes[at] ^= (unsigned char)(1 << k % 8);
    }
  size_t cuts[] = { 0, 1, HEAD - 1, HEAD, order_at (), length - 8, length - 1 };
  for (size_t k = 0; k < sizeof cuts / sizeof *cuts; k++)
    {
      write_file (cuts[k]);
      assert_false (is_loaded ());
    }
  bytes[length] = 0;
  write_file (length + 1);
  assert_false (is_loaded ());
  assert_int_equal (made_bits (TRIANGLES, 2), BITS);
  assert_true (is_loaded ()); /* written anew */
  free (bytes);
}

static void
test_heads_that_lie (void **state)
{
  double nan = NAN;
  (void)state;
  begin_spoiling ("heads");
  for (size_t at = 0; at < 40; at += 4)
    if (at != 32) /* nodes: the lengths would not fit either */
      assert_false (is_taken_with_word (at, word_at (at) + 1));
  for (size_t at = 40; at < HEAD; at += 8)
    assert_false (is_taken_with (at, &nan, sizeof nan));
  free (bytes);
}

/* Return the first child of node AT that is (IS_LEAF) or is not a leaf.  */
static int
child_of (uint32_t at, int is_leaf)
{
  bt__bvh_node node;
  memcpy (&node, bytes + HEAD + at * sizeof node, sizeof node);
  for (int i = 0; i < BT__BVH_WIDE; i++)
    if (node.half[0][i] > 0 && (node.count[i] > 0) == is_leaf)
      return i;
  return -1;
}

static void
test_trees_that_lie (void **state)
{
  (void)state;
  begin_spoiling ("trees");
  uint32_t last = nodes () - 1;
  size_t root = HEAD, deep = HEAD + last * sizeof (bt__bvh_node),
         first = offsetof (bt__bvh_node, first), count = offsetof (bt__bvh_node, count);
  int child = child_of (0, 0), leaf = child_of (last, 1);
  assert_true (child >= 0 && leaf >= 0);
  size_t c = 4 * (size_t)child, l = 4 * (size_t)leaf;
  assert_false (is_taken_with_word (root + first + c, 0));
  assert_false (is_taken_with_word (root + first + c, nodes ()));
  assert_false (is_taken_with_word (root + first + c, last));
  assert_false (is_taken_with_word (root + count + c, 1));
  assert_false (is_taken_with_word (deep + first + l, TRIANGLES));
  assert_false (is_taken_with_word (deep + first + l, word_at (deep + first + l) + 1));
  assert_false (is_taken_with_word (deep + count + l, word_at (deep + count + l) + 1));
  assert_false (is_taken_with_word (deep + count + l, UINT32_MAX));
  assert_false (is_taken_with_word (root + c, 0x7fc00000));
  assert_false (is_taken_with_word (root + offsetof (bt__bvh_node, half) + c, 0x7f800000));
  assert_false (is_taken_with_word (root + offsetof (bt__bvh_node, half) + c, 0xbf800000));
  assert_false (is_taken_with_word (order_at (), word_at (order_at () + 4)));
  assert_false (is_taken_with_word (order_at (), TRIANGLES));
  free (bytes);
}

/* Two entries that change places leave each number once.  */
static int
is_taken_exchanged (size_t at, size_t other)
{
  uint32_t a = word_at (at), b = word_at (other);
  memcpy (bytes + other, &a, sizeof a);
  int taken = is_taken_with_word (at, b);
  memcpy (bytes + other, &b, sizeof b);
  return taken;
}

static void
test_rings_that_lie (void **state)
{
  (void)state;
  begin_spoiling ("rings");
  size_t corners = order_at () + 4 * (size_t)TRIANGLES, edges = corners + 12 * (size_t)TRIANGLES,
         folds = edges + 12 * (size_t)TRIANGLES;
  unsigned char eight = 8;
  assert_false (is_taken_with_word (corners, word_at (corners + 4)));
  assert_false (is_taken_with_word (corners, 3 * TRIANGLES));
  assert_false (is_taken_exchanged (corners, corners + 4));
  assert_false (is_taken_with_word (edges, word_at (edges + 4)));
  assert_false (is_taken_exchanged (edges, edges + 4));
  assert_false (is_taken_exchanged (order_at (), order_at () + 40));
  assert_false (is_taken_with (folds, &eight, 1));
  free (bytes);
}

static void
test_no_plain_file (void **state)
{
  char other[PATH_MAX + 8];
  (void)state;
  use_folder ("odd");
  made_bits (TRIANGLES, 1);
  snprintf (other, sizeof other, "%s.other", file);
  assert_int_equal (rename (file, other), 0);
  assert_int_equal (symlink (other, file), 0);
  assert_false (is_loaded ());
  unlink (file);
  assert_int_equal (mkdir (file, 0700), 0);
  assert_false (is_loaded ());
  rmdir (file);
  assert_int_equal (mkfifo (file, 0600), 0);
  assert_false (is_loaded ());
}

/* ---- Not to be written ---- */

static void
test_nowhere_to_write (void **state)
{
  char path[PATH_MAX / 2];
  (void)state;
  snprintf (path, sizeof path, "%s/plain", folder);
  close (open (path, O_WRONLY | O_CREAT, 0600));
  use_folder ("plain/trees");
  assert_int_equal (made_bits (TRIANGLES, 1), BITS);
  use_folder ("limited");
  struct rlimit before, small;
  getrlimit (RLIMIT_FSIZE, &before);
  small = before;
  small.rlim_cur = 100000;
  setrlimit (RLIMIT_FSIZE, &small);
  assert_int_equal (made_bits (TRIANGLES, 1), BITS);
  setrlimit (RLIMIT_FSIZE, &before);
  assert_int_equal (size_of (file), -1);
}

/* Files without a byte on the disk, a gigabyte together: the older goes.  */
static void
test_a_gigabyte_is_kept (void **state)
{
  char name[2][PATH_MAX];
  (void)state;
  use_folder ("full");
  made_bits (TRIANGLES, 1);
  unlink (file);
  for (int k = 0; k < 2; k++)
    {
      struct timespec times[2] = { { .tv_sec = 1000 + k }, { .tv_sec = 1000 + k } };
      snprintf (name[k], sizeof name[k], "%s/full/%d.tree", folder, k);
      int fd = open (name[k], O_WRONLY | O_CREAT, 0600);
      assert_int_equal (ftruncate (fd, 500000000), 0);
      futimens (fd, times);
      close (fd);
    }
  made_bits (TRIANGLES, 1);
  assert_true (size_of (file) > 0);
  assert_int_equal (size_of (name[0]), -1);
  assert_int_equal (size_of (name[1]), 500000000);
}

/* Each test begins where nothing is kept.  */
static int
keep_none (void **state)
{
  (void)state;
  return setenv ("BIGHT_TREES", "", 1);
}

int
main (void)
{
  const struct CMUnitTest tests[] = {
    cmocka_unit_test_setup (test_any_number_of_workers, keep_none),
    cmocka_unit_test_setup (test_bits_of_this_version, keep_none),
    cmocka_unit_test_setup (test_given_up_at_any_question, keep_none),
    cmocka_unit_test_setup (test_round_trip, keep_none),
    cmocka_unit_test_setup (test_where, keep_none),
    cmocka_unit_test_setup (test_small_or_left_out, keep_none),
    cmocka_unit_test_setup (test_damaged, keep_none),
    cmocka_unit_test_setup (test_heads_that_lie, keep_none),
    cmocka_unit_test_setup (test_trees_that_lie, keep_none),
    cmocka_unit_test_setup (test_rings_that_lie, keep_none),
    cmocka_unit_test_setup (test_no_plain_file, keep_none),
    cmocka_unit_test_setup (test_nowhere_to_write, keep_none),
    cmocka_unit_test_setup (test_a_gigabyte_is_kept, keep_none),
  };
  return cmocka_run_group_tests (tests, build_bed, remove_folder);
}
