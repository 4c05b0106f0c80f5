/* Trees of large meshes on disk: see mesh_keep.h.  Here are files and folders; mesh_sound.c checks
   the contents.

   A file is the head, five arrays and a hash of head and arrays.  A new file is written under the
   name of the process and then renamed: no reader sees half a file.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <config.h>

#include <dirent.h>
#include <fcntl.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include "base/fd.h"
#include "base/hash.h"
#include "collide/mesh_keep.h"
#include "collide/mesh_sound.h"

enum
{
  FILE_VERSION
  = 2, /* of the file; another too when a tree would be built or rings be made otherwise */
  BYTE_ORDER_MARK = 0x01020304,
  NAME_SIZE = 4096,
  ARRAYS = 5
};

#define MOST_BYTES 1e9 /* of all files together */
static const char magic[8] = "bighttre";

typedef struct head
{
  char magic[8];
  uint32_t version, mark;
  uint64_t key;
  uint32_t vertices, triangles, nodes, node_size;
  bt_vec3 origin;
  double extent;
  bt__aabb box;
} head;

typedef struct array
{
  void *at;
  size_t bytes;
} array;

/* The arrays in a file of mesh M.  */
static void
list_arrays (const bt__mesh *m, array out[ARRAYS])
{
  size_t n = m->triangles;
  out[0] = (array){ m->tree.node, m->tree.nodes * sizeof *m->tree.node };
  out[1] = (array){ m->tree.order, n * sizeof *m->tree.order };
  out[2] = (array){ m->next_corner, 3 * n * sizeof *m->next_corner };
  out[3] = (array){ m->next_edge, 3 * n * sizeof *m->next_edge };
  out[4] = (array){ m->folds, n };
}

static uint64_t
hash_all (const head *h, const array a[ARRAYS])
{
  bt__hash_lanes lanes;
  bt__hash_begin (&lanes);
  bt__hash_add (&lanes, h, sizeof *h);
  for (int i = 0; i < ARRAYS; i++)
    bt__hash_add (&lanes, a[i].at, a[i].bytes);
  return bt__hash_end (&lanes);
}

static uint64_t
file_size (const array a[ARRAYS])
{
  uint64_t size = sizeof (head) + sizeof (uint64_t);
  for (int i = 0; i < ARRAYS; i++)
    size += a[i].bytes;
  return size;
}

uint64_t
bt__keep_key (const bt__mesh *m, const bt__soup *soup)
{
  bt__hash_lanes lanes;
  bt__hash_begin (&lanes);
  bt__hash_add (&lanes, m->v, m->vertices * sizeof *m->v);
  bt__hash_add (&lanes, soup->corner, m->triangles * sizeof *soup->corner);
  return bt__hash_end (&lanes);
}

/* ---- Names ---- */

/* The folder of all trees.  Return true if there is to be one and its name fits.  */
static int
find_folder (char name[NAME_SIZE])
{
  const char *trees = getenv ("BIGHT_TREES"), *cache = getenv ("XDG_CACHE_HOME"),
             *home = getenv ("HOME");
  int n = 0;
  if (trees)
    n = snprintf (name, NAME_SIZE, "%s", trees);
  else if (cache && cache[0] == '/')
    n = snprintf (name, NAME_SIZE, "%s/bight/trees", cache);
  else if (home && home[0] == '/')
    n = snprintf (name, NAME_SIZE, "%s/.cache/bight/trees", home);
  return n > 0 && n < NAME_SIZE;
}

static int
find_file (uint64_t key, const char *end, char name[NAME_SIZE])
{
  char folder[NAME_SIZE];
  if (!find_folder (folder))
    return 0;
  int n = snprintf (name, NAME_SIZE, "%s/%016llx.%s", folder, (unsigned long long)key, end);
  return n > 0 && n < NAME_SIZE;
}

/* The folders that lead to FILE.  */
static void
make_folders (const char *file)
{
  char name[NAME_SIZE];
  snprintf (name, sizeof name, "%s", file);
  for (char *p = name + 1; (p = strchr (p, '/')); p++)
    {
      *p = 0;
      mkdir (name, 0700);
      *p = '/';
    }
}

/* ---- Reading ---- */

/* Open the file of KEY, a regular file of this user's.  Return it or -1.  */
static int
open_file (uint64_t key, uint64_t *size)
{
  char name[NAME_SIZE];
  struct stat st;
  int fd = -1;
  if (find_file (key, "tree", name))
    fd = open (name, O_RDONLY | O_CLOEXEC | O_NONBLOCK | O_NOCTTY | O_NOFOLLOW);
  if (fd < 0)
    return -1;
  if (fstat (fd, &st) == 0 && S_ISREG (st.st_mode) && st.st_uid == geteuid ())
    {
      *size = (uint64_t)st.st_size;
      return fd;
    }
  close (fd);
  return -1;
}

static int
is_ours (const head *h, const bt__mesh *m, uint64_t key)
{
  return memcmp (h->magic, magic, sizeof magic) == 0 && h->version == FILE_VERSION
         && h->mark == BYTE_ORDER_MARK && h->key == key && h->vertices == m->vertices
         && h->triangles == m->triangles && h->node_size == sizeof (bt__bvh_node) && h->nodes > 0
         && h->nodes <= m->triangles && bt__is_finite (h->origin) && h->extent >= 0
         && isfinite (h->extent) && bt__is_finite (h->box.lo) && bt__is_finite (h->box.hi);
}

static int
reserve (bt__mesh *m, const head *h)
{
  size_t n = m->triangles;
  m->tree = (bt__bvh){ .origin = h->origin,
                       .extent = h->extent,
                       .n = h->triangles,
                       .nodes = h->nodes,
                       .room = h->triangles,
                       .node_room = h->nodes };
  m->box = h->box;
  m->tree.node = malloc (h->nodes * sizeof *m->tree.node);
  m->tree.order = malloc (n * sizeof *m->tree.order);
  m->next_corner = malloc (3 * n * sizeof *m->next_corner);
  m->next_edge = malloc (3 * n * sizeof *m->next_edge);
  m->folds = malloc (n);
  return m->tree.node && m->tree.order && m->next_corner && m->next_edge && m->folds;
}

/* M as before a file was read.  */
static void
give_back (bt__mesh *m, const bt__soup *soup)
{
  memcpy (m->corner, soup->corner, m->triangles * sizeof *m->corner);
  bt__bvh_free (&m->tree);
  free (m->next_corner);
  free (m->next_edge);
  free (m->folds);
  m->next_corner = m->next_edge = NULL;
  m->folds = NULL;
}

/* Read what follows head H in FD, SIZE bytes in all.  */
static int
read_arrays (int fd, uint64_t size, const head *h, const bt__mesh *m)
{
  array a[ARRAYS];
  uint64_t sum;
  list_arrays (m, a);
  if (file_size (a) != size)
    return 0;
  for (int i = 0; i < ARRAYS; i++)
    if (bt__read_all (fd, a[i].at, a[i].bytes) < a[i].bytes)
      return 0;
  return bt__read_all (fd, &sum, sizeof sum) == sizeof sum && sum == hash_all (h, a);
}

int
bt__keep_load (bt__mesh *m, const bt__soup *soup, uint64_t key)
{
  uint64_t size;
  head h;
  int fd = open_file (key, &size);
  if (fd < 0)
    return 0;
  int good = 0;
  if (bt__read_all (fd, &h, sizeof h) == sizeof h && is_ours (&h, m, key))
    {
      good = reserve (m, &h) && read_arrays (fd, size, &h, m) && bt__tree_is_sound (&m->tree);
      if (good)
        {
          bt__mesh_put_in_order (m, soup);
          good = bt__rings_are_sound (m);
        }
      if (good)
        futimens (fd, NULL); /* used: see remove_oldest */
      else
        give_back (m, soup);
    }
  close (fd);
  return good;
}

/* ---- Writing ---- */

static int
write_all (int fd, const void *from, size_t n)
{
  for (const char *p = from; n > 0;)
    {
      ssize_t put = write (fd, p, n);
      if (put <= 0)
        return 0;
      p += put;
      n -= (size_t)put;
    }
  return 1;
}

/* A process that writes a larger file than it may is ended by a signal.  */
static int
may_write (uint64_t size)
{
  struct rlimit most;
  return getrlimit (RLIMIT_FSIZE, &most) == 0
         && (most.rlim_cur == RLIM_INFINITY || size <= most.rlim_cur);
}

static int
write_file (int fd, const head *h, const array a[ARRAYS])
{
  uint64_t sum = hash_all (h, a);
  int good = write_all (fd, h, sizeof *h);
  for (int i = 0; i < ARRAYS && good; i++)
    good = write_all (fd, a[i].at, a[i].bytes);
  return good && write_all (fd, &sum, sizeof sum);
}

static int
is_kept_file (const char *name)
{
  const char *dot = strrchr (name, '.');
  return name[0] != '.' && dot && (strcmp (dot, ".tree") == 0 || strcmp (dot, ".new") == 0);
}

/* Find the file in DIR not used for longest, in NAME.  Return the bytes of all.  */
static double
find_oldest (DIR *dir, char name[NAME_SIZE])
{
  double bytes = 0;
  time_t oldest = 0;
  name[0] = 0;
  rewinddir (dir);
  for (struct dirent *e; (e = readdir (dir));)
    {
      struct stat st;
      if (!is_kept_file (e->d_name)
          || fstatat (dirfd (dir), e->d_name, &st, AT_SYMLINK_NOFOLLOW) != 0
          || !S_ISREG (st.st_mode))
        continue;
      bytes += (double)st.st_size;
      if (!name[0] || st.st_mtime < oldest)
        {
          oldest = st.st_mtime;
          snprintf (name, NAME_SIZE, "%s", e->d_name);
        }
    }
  return bytes;
}

/* Make room for SIZE bytes.  */
static void
remove_oldest (uint64_t size)
{
  char folder[NAME_SIZE], name[NAME_SIZE];
  DIR *dir = find_folder (folder) ? opendir (folder) : NULL;
  if (!dir)
    return;
  while (find_oldest (dir, name) + (double)size > MOST_BYTES && name[0]
         && unlinkat (dirfd (dir), name, 0) == 0)
    ;
  closedir (dir);
}

static head
head_of (const bt__mesh *m, uint64_t key)
{
  head h;
  memset (&h, 0, sizeof h);
  memcpy (h.magic, magic, sizeof magic);
  h.version = FILE_VERSION;
  h.mark = BYTE_ORDER_MARK;
  h.key = key;
  h.vertices = m->vertices;
  h.triangles = m->triangles;
  h.nodes = m->tree.nodes;
  h.node_size = sizeof (bt__bvh_node);
  h.origin = m->tree.origin;
  h.extent = m->tree.extent;
  h.box = m->box;
  return h;
}

void
bt__keep_save (const bt__mesh *m, uint64_t key)
{
  char file[NAME_SIZE], own[NAME_SIZE], end[32];
  array a[ARRAYS];
  head h = head_of (m, key);
  list_arrays (m, a);
  snprintf (end, sizeof end, "%ld.new", (long)getpid ());
  if (!find_file (key, "tree", file) || !find_file (key, end, own) || !may_write (file_size (a)))
    return;
  make_folders (own);
  remove_oldest (file_size (a));
  int fd = open (own, O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC | O_NOFOLLOW, 0600);
  if (fd < 0)
    return;
  int good = write_file (fd, &h, a);
  if (close (fd) != 0 || !good || rename (own, file) != 0)
    unlink (own);
}
