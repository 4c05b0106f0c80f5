/* Mesh files: one shape in every format is the same triangles; every kind of bad file is an error
   that says why; and a reader that crashes, hangs or lies takes nothing with it.

   The formats and the bad files are read by bight-mesh-reader, when it was built; the bad readers
   are scripts, made here.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <config.h>

#include <fcntl.h>
#include <math.h>
#include <setjmp.h>
#include <signal.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <sys/time.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

#include <cmocka.h>

#include "base/hash.h"
#include "mesh/read.h"
#include "mesh/stream.h"

enum
{
  PATH = 600
};

static char scratch[PATH]; /* a folder for what is made here */
static char reader[PATH];  /* the real one */

static const char *
in_scratch (const char *name)
{
  static char path[2 * PATH];
  snprintf (path, sizeof path, "%s/%s", scratch, name);
  return path;
}

static const char *
in_data (const char *name)
{
  static char path[2 * PATH];
  const char *source = getenv ("top_srcdir");
  snprintf (path, sizeof path, "%s/tests/data/mesh/%s", source ? source : ".", name);
  return path;
}

static void
write_file (const char *name, const void *bytes, size_t n)
{
  FILE *f = fopen (in_scratch (name), "wb");
  assert_non_null (f);
  assert_int_equal (fwrite (bytes, 1, n, f), n);
  assert_int_equal (fclose (f), 0);
}

static void
use_reader (const char *path)
{
  assert_int_equal (setenv ("BIGHT_MESH_READER", path, 1), 0);
}

static void
need_reader (void)
{
  if (access (reader, X_OK) != 0)
    skip ();
  use_reader (reader);
}

/* ---- One shape, many formats ---- */

static const bt_vec3 tetra[4] = { { 0, 0, 0 }, { 1, 0, 0 }, { 0, 2, 0 }, { 0, 0, 3 } };
static const int faces[4][3] = { { 0, 2, 1 }, { 0, 1, 3 }, { 0, 3, 2 }, { 1, 2, 3 } };

static int
is_near (bt_vec3 a, bt_vec3 b)
{
  return fabs (a.x - b.x) + fabs (a.y - b.y) + fabs (a.z - b.z) < 1e-6;
}

/* Does triangle T of MESH join the corners of face F, beginning at any of them?  */
static int
is_face (const bt_triangles *mesh, size_t t, int f)
{
  for (int turn = 0; turn < 3; turn++)
    {
      int same = 0;
      for (int k = 0; k < 3; k++)
        same += is_near (mesh->vertex[mesh->corner[t][k]], tetra[faces[f][(k + turn) % 3]]);
      if (same == 3)
        return 1;
    }
  return 0;
}

/* Is MESH the tetrahedron, its triangles in the file's order?  */
static int
is_tetra (const bt_triangles *mesh)
{
  int same = mesh->triangles == 4 && mesh->vertices == 4 && !mesh->id;
  for (int f = 0; same && f < 4; f++)
    same = is_face (mesh, (size_t)f, f);
  return same;
}

static void
formats_agree (void **state)
{
  static const struct
  {
    const char *file;
    bt_mesh_up up;
  } cases[] = { { "tetra.obj", BT_MESH_UP_Z },  { "tetra_y.obj", BT_MESH_UP_Y },
                { "tetra.stl", BT_MESH_UP_Z },  { "tetra_binary.stl", BT_MESH_UP_Z },
                { "tetra.ply", BT_MESH_UP_Z },  { "tetra_binary.ply", BT_MESH_UP_Z },
                { "tetra.gltf", BT_MESH_UP_Y }, { "tetra.dae", BT_MESH_UP_Z } };
  (void)state;
  need_reader ();
  for (size_t i = 0; i < sizeof cases / sizeof *cases; i++)
    {
      bt_mesh_data *data;
      bt_error e = { 0 };
      if (bt_mesh_read (in_data (cases[i].file), cases[i].up, &data, &e) != BT_OK)
        fail_msg ("%s", e.text);
      if (!is_tetra (&data->mesh))
        fail_msg ("%s: other triangles", cases[i].file);
      bt_mesh_data_free (data);
    }
}

/* Whatever a comment says, wherever in the header it stands, the triangles are the same.  */
static void
comments_say_nothing (void **state)
{
  static const char *const words[] = { "",
                                       " ",
                                       " 1",
                                       " 1 by 2 by 3, z up",
                                       " -1e9",
                                       " a",
                                       "\t7",
                                       " end_header",
                                       " element vertex 9999",
                                       " made by 3 of us, 2026",
                                       " 12\r",
                                       " \xc3\xa9t\xc3\xa9" };
  static const char *const lines[]
      = { "ply\n",
          "format ascii 1.0\n",
          "element vertex 4\n",
          "property float x\nproperty float y\nproperty float z\n",
          "element face 4\nproperty list uchar int vertex_indices\n",
          "end_header\n0 0 0\n1 0 0\n0 2 0\n0 0 3\n3 0 2 1\n3 0 1 3\n3 0 3 2\n3 1 2 3\n" };
  enum
  {
    WORDS = sizeof words / sizeof *words,
    LINES = sizeof lines / sizeof *lines
  };
  (void)state;
  need_reader ();
  for (int k = 0; k < WORDS; k++)
    for (int at = 2; at < LINES; at++) /* before line AT */
      {
        char text[600] = "";
        bt_mesh_data *data;
        bt_error e = { 0 };
        for (int i = 0; i < LINES; i++)
          {
            size_t n = strlen (text);
            snprintf (text + n, sizeof text - n, "%s%s%s%s", i == at ? "comment" : "",
                      i == at ? words[k] : "", i == at ? "\n" : "", lines[i]);
          }
        write_file ("comment.ply", text, strlen (text));
        if (bt_mesh_read (in_scratch ("comment.ply"), BT_MESH_UP_Z, &data, &e) != BT_OK)
          fail_msg ("comment%s: %s", words[k], e.text);
        if (!is_tetra (&data->mesh))
          fail_msg ("comment%s before line %d: other triangles", words[k], at);
        bt_mesh_data_free (data);
      }
}

static double
area_of (const bt_triangles *m)
{
  double sum = 0;
  for (size_t i = 0; i < m->triangles; i++)
    {
      bt_vec3 a = m->vertex[m->corner[i][0]], b = m->vertex[m->corner[i][1]],
              c = m->vertex[m->corner[i][2]];
      double ux = b.x - a.x, uy = b.y - a.y, uz = b.z - a.z;
      double vx = c.x - a.x, vy = c.y - a.y, vz = c.z - a.z;
      sum += hypot (hypot (uy * vz - uz * vy, uz * vx - ux * vz), ux * vy - uy * vx) / 2;
    }
  return sum;
}

static void
polygons_and_soups (void **state)
{
  static const struct
  {
    const char *file;
    size_t vertices, triangles;
    double area; /* m2 */
  } cases[] = { { "cube.obj", 8, 12, 6 }, { "soup.ply", 5, 6, 1.5 + M_SQRT1_2 } };
  (void)state;
  need_reader ();
  for (size_t i = 0; i < sizeof cases / sizeof *cases; i++)
    {
      bt_mesh_data *data;
      bt_error e = { 0 };
      if (bt_mesh_read (in_data (cases[i].file), BT_MESH_UP_Z, &data, &e) != BT_OK)
        fail_msg ("%s", e.text);
      assert_int_equal (data->mesh.vertices, cases[i].vertices);
      assert_int_equal (data->mesh.triangles, cases[i].triangles);
      assert_true (fabs (area_of (&data->mesh) - cases[i].area) < 1e-6);
      bt_mesh_data_free (data);
    }
}

/* Counted in the files' text: a face of n corners is n - 2 triangles.  */
static void
real_meshes (void **state)
{
  static const struct
  {
    const char *file;
    size_t triangles;
  } cases[] = { { "bop_panel.obj", 5212 },         { "herkules_seabed.obj", 1748 },
                { "munkholmen_seabed.obj", 2115 }, { "rexrov_body.obj", 288 },
                { "sunken_ship.obj", 4171 },       { "underwater_frame.obj", 21033 } };
  const char *folder = getenv ("BIGHT_REFERENCE_DATA"), *source = getenv ("top_srcdir");
  char path[PATH];
  (void)state;
  need_reader ();
  for (size_t i = 0; i < sizeof cases / sizeof *cases; i++)
    {
      bt_mesh_data *data;
      bt_error e = { 0 };
      snprintf (path, sizeof path, "%s%s/meshes/%s",
                folder   ? folder
                : source ? source
                         : ".",
                folder ? "" : "/../shared/data", cases[i].file);
      if (access (path, R_OK) != 0)
        skip ();
      if (bt_mesh_read (path, BT_MESH_UP_Z, &data, &e) != BT_OK)
        fail_msg ("%s", e.text);
      assert_int_equal (data->mesh.triangles, cases[i].triangles);
      bt_mesh_data_free (data);
    }
}

/* ---- Bad files ---- */

static void
refused (const char *file, const bt__reader_limits *limits, bt_status status, const char *words)
{
  bt_mesh_data *data = (bt_mesh_data *)(uintptr_t)1;
  bt_error e = { 0 };
  bt_status s = limits ? bt__mesh_read_within (file, BT_MESH_UP_Z, limits, &data, &e)
                       : bt_mesh_read (file, BT_MESH_UP_Z, &data, &e);
  if (s != status || e.status != status || data || !strstr (e.text, words))
    fail_msg ("%s: %s: %s; wanted %s: %s", file, bt_status_name (s), e.text,
              bt_status_name (status), words);
}

static void
no_file (void **state)
{
  (void)state;
  use_reader ("/nowhere/at-all"); /* it is not even asked */
  refused (in_scratch ("gone.obj"), NULL, BT_ERR_IO, "gone.obj cannot be read: No such file");
  refused (scratch, NULL, BT_ERR_IO, "is a folder");
  refused ("/dev/zero", NULL, BT_ERR_IO, "device or pipe");
  write_file ("empty.obj", "", 0);
  refused (in_scratch ("empty.obj"), NULL, BT_ERR_IO, "is empty");
  assert_int_equal (mkfifo (in_scratch ("pipe.obj"), 0600), 0);
  refused (in_scratch ("pipe.obj"), NULL, BT_ERR_IO, "device or pipe");
  write_file ("vast.obj", "v", 1);
  assert_int_equal (truncate (in_scratch ("vast.obj"), 3000000000), 0);
  refused (in_scratch ("vast.obj"), NULL, BT_ERR_LIMIT, "at most 2000");
  refused (in_data ("cube.obj"), NULL, BT_ERR_UNSUPPORTED, "libassimp-dev");
}

#define PLY_HEAD(format, vertices, faces)                                                          \
  "ply\nformat " format " 1.0\nelement vertex " vertices                                           \
  "\nproperty float x\nproperty float y\nproperty float z\nelement face " faces                    \
  "\nproperty list uchar int vertex_indices\nend_header\n"
#define STL_FACET                                                                                  \
  "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\n"
#define OBJ_CORNERS "v 0 0 0\nv 1 0 0\nv 0 1 0\n"

static void
bad_files (void **state)
{
  static const struct
  {
    const char *name, *text;
    bt_status status;
    const char *words;
  } cases[] = {
    { "garbage.obj", "hello, world\n", BT_ERR_FORMAT, "garbage.obj" },
    { "prose.txt", "once upon a time", BT_ERR_FORMAT, "no format" },
    { "points.obj", OBJ_CORNERS, BT_ERR_FORMAT, "no triangle" },
    { "lines.obj", OBJ_CORNERS "l 1 2\n", BT_ERR_FORMAT, "no triangle" },
    { "index.obj", OBJ_CORNERS "f 1 2 4\n", BT_ERR_FORMAT, "index" },
    { "zero.obj", OBJ_CORNERS "f 0 1 2\n", BT_ERR_FORMAT, "index" },
    { "nan.obj", "v 0 0 0\nv nan 0 0\nv 0 1 0\nf 1 2 3\n", BT_ERR_FORMAT, "which is no place" },
    { "inf.obj", "v 0 0 0\nv 1e999 0 0\nv 0 1 0\nf 1 2 3\n", BT_ERR_FORMAT, "which is no place" },
    { "index.ply", PLY_HEAD ("ascii", "3", "1") "0 0 0\n1 0 0\n0 1 0\n3 0 1 7\n", BT_ERR_FORMAT,
      "corner 7" },
    { "cut.ply", PLY_HEAD ("ascii", "3", "2") "0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n", BT_ERR_FORMAT,
      "element 2 of the 2 of kind 2 is not there" },
    { "vast.ply", PLY_HEAD ("ascii", "4000000000", "1") "0 0 0\n1 0 0\n", BT_ERR_FORMAT,
      "of the 4000000000" },
    { "binary.ply", PLY_HEAD ("binary_little_endian", "3", "1") "0123456789abcdefghij",
      BT_ERR_FORMAT, "element 2 of the 3" },
    { "list.ply", PLY_HEAD ("binary_big_endian", "1", "1") "0123456789ab\377abcd", BT_ERR_FORMAT,
      "element 1 of the 1 of kind 2" },
    { "first.ply", "Plywood\nformat ascii 1.0\nend_header\n", BT_ERR_FORMAT, "line 1 of a PLY" },
    { "header.ply", "ply\nformat ascii 1.0\nelement ver", BT_ERR_FORMAT, "PLY header" },
    { "headless.ply", "ply\nformat ascii 1.0\n", BT_ERR_FORMAT, "no end_header" },
    { "cut.stl", STL_FACET "endfacet\nfacet normal 0 0", BT_ERR_FORMAT, "endsolid" },
    { "cut.gltf", "{\"asset\":{\"version\":\"2.0\"}", BT_ERR_FORMAT, "cut.gltf" },
    { "away.gltf",
      "{\"asset\":{\"version\":\"2.0\"},\"scene\":0,\"scenes\":[{\"nodes\":[0]}],"
      "\"nodes\":[{\"children\":[0]}]}",
      BT_ERR_FORMAT, "away.gltf" },
    { "cut.dae", "<?xml version=\"1.0\"?><COLLADA", BT_ERR_FORMAT, "cut.dae" },
  };
  (void)state;
  need_reader ();
  for (size_t i = 0; i < sizeof cases / sizeof *cases; i++)
    {
      write_file (cases[i].name, cases[i].text, strlen (cases[i].text));
      refused (in_scratch (cases[i].name), NULL, cases[i].status, cases[i].words);
    }
}

/* A polygon with a corner that is no number: assimp 5.2 aborts on it.  Whatever it does, we go on.
 */
static void
crash (void **state)
{
  (void)state;
  need_reader ();
  refused (in_data ("crash.ply"), NULL, BT_ERR_FORMAT, "crash.ply");
}

static void
cut_binary_stl (void **state)
{
  unsigned char bytes[134] = { 0 };
  (void)state;
  need_reader ();
  for (unsigned n = 2; n < 5; n++)
    {
      bytes[80] = (unsigned char)n; /* triangles promised; there is one */
      write_file ("cut_binary.stl", bytes, sizeof bytes);
      refused (in_scratch ("cut_binary.stl"), NULL, BT_ERR_FORMAT, "cut_binary.stl");
    }
}

/* No beginning of a file that says how long it is passes for the whole.  */
static void
beginnings (void **state)
{
  static const char *const files[] = { "tetra_binary.stl", "tetra_binary.ply", "tetra.ply" };
  char bytes[2000];
  (void)state;
  need_reader ();
  for (size_t i = 0; i < sizeof files / sizeof *files; i++)
    {
      FILE *f = fopen (in_data (files[i]), "rb");
      assert_non_null (f);
      size_t n = fread (bytes, 1, sizeof bytes, f);
      fclose (f);
      for (size_t cut = n - 2; cut > n / 10; cut -= n / 10)
        {
          write_file (files[i], bytes, cut);
          refused (in_scratch (files[i]), NULL, BT_ERR_FORMAT, files[i]);
        }
    }
}

static void
little_memory (void **state)
{
#ifdef __SANITIZE_ADDRESS__
  skip ();
#endif
  static const bt__reader_limits small = { 60, 60, 64 };
  enum
  {
    N = 400000
  };
  (void)state;
  need_reader ();
  unsigned char *bytes = calloc (1, 84 + 50 * N);
  assert_non_null (bytes);
  memcpy (bytes + 80, &(uint32_t){ N }, 4);
  write_file ("big.stl", bytes, 84 + 50 * N);
  free (bytes);
  refused (in_scratch ("big.stl"), &small, BT_ERR_LIMIT, "memory");
}

/* ---- Bad readers ---- */

typedef struct answer
{
  bt__mesh_head head;
  double vertex[3][3];
  uint32_t corner[1][3];
} answer;

/* A right answer, for a test to spoil: one triangle.  */
static answer
right_answer (void)
{
  answer a = { { "", BT__MESH_VERSION, 3, 1, 0 },
               { { 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 } },
               { { 0, 1, 2 } } };
  memcpy (a.head.magic, BT__MESH_MAGIC, sizeof a.head.magic);
  return a;
}

/* Write A, with its checksum and OFF, as the file NAME.  */
static void
write_answer (const char *name, const answer *a, uint64_t off)
{
  char bytes[sizeof a->head + sizeof a->vertex + sizeof a->corner + 8], *at = bytes;
  uint64_t sum = bt__hash (&a->head, sizeof a->head, 0);
  sum = bt__hash (a->vertex, sizeof a->vertex, sum);
  sum = bt__hash (a->corner, sizeof a->corner, sum) + off;
  at = (char *)memcpy (at, &a->head, sizeof a->head) + sizeof a->head;
  at = (char *)memcpy (at, a->vertex, sizeof a->vertex) + sizeof a->vertex;
  at = (char *)memcpy (at, a->corner, sizeof a->corner) + sizeof a->corner;
  memcpy (at, &sum, 8);
  write_file (name, bytes, sizeof bytes);
}

/* Make a reader of the shell commands SCRIPT, run in the scratch folder, and use it.  */
static void
use_script (const char *script)
{
  char text[2 * PATH];
  int n = snprintf (text, sizeof text, "#!/bin/sh\ncd '%s'\n%s\n", scratch, script);
  unlink (in_scratch ("reader"));
  write_file ("reader", text, (size_t)n);
  assert_int_equal (chmod (in_scratch ("reader"), 0700), 0);
  use_reader (in_scratch ("reader"));
}

static void
write_answers (void)
{
  answer a = right_answer ();
  write_answer ("right", &a, 0);
  write_answer ("sum", &a, 1);
  a.corner[0][2] = 3;
  write_answer ("index", &a, 0);
  a = right_answer ();
  a.vertex[1][1] = NAN;
  write_answer ("nan", &a, 0);
  a = right_answer ();
  a.head.version++;
  write_answer ("version", &a, 0);
  a = right_answer ();
  a.head.triangles = UINT32_MAX;
  write_answer ("triangles", &a, 0);
  a = right_answer ();
  a.head.vertices = 4;
  write_answer ("vertices", &a, 0);
  a = right_answer ();
  a.head.triangles = a.head.vertices = 0;
  write_answer ("none", &a, 0);
}

static const char *
any_file (void)
{
  write_file ("any.obj", OBJ_CORNERS, strlen (OBJ_CORNERS));
  return in_scratch ("any.obj");
}

static void
bad_readers (void **state)
{
  static const struct
  {
    const char *script;
    bt_status status;
    const char *words;
  } cases[] = {
    { "kill -SEGV $$", BT_ERR_FORMAT, "crashes the library" },
    { "head -c 50 right; kill -ABRT $$", BT_ERR_FORMAT, "crashes the library" },
    { "kill -INT $$", BT_ERR_IO, "interrupted" },
    { "kill -XCPU $$", BT_ERR_LIMIT, "out of time" },
    { "exit 0", BT_ERR_FORMAT, "cut short" },
    { "echo no good >&2; echo more >&2; exit 10", BT_ERR_FORMAT, "any.obj: no good" },
    { "echo too large >&2; exit 11", BT_ERR_LIMIT, "too large" },
    { "echo full >&2; exit 12", BT_ERR_IO, "full" },
    { "exit 3", BT_ERR_FORMAT, "exit status 3" },
    { "yes complaint | head -c 1000000 >&2; exit 10", BT_ERR_FORMAT, "any.obj: complaint" },
    { "exec yes garbage", BT_ERR_FORMAT, "not a mesh" },
    { "head -c 20 right", BT_ERR_FORMAT, "of the 24 bytes of its head" },
    { "head -c 60 right", BT_ERR_FORMAT, "of the 72 bytes of its vertices" },
    { "head -c 100 right", BT_ERR_FORMAT, "corners" },
    { "head -c 110 right", BT_ERR_FORMAT, "checksum" },
    { "cat sum", BT_ERR_FORMAT, "damaged" },
    { "cat index", BT_ERR_FORMAT, "corner 3" },
    { "cat nan", BT_ERR_FORMAT, "finite" },
    { "cat version", BT_ERR_VERSION, "another build" },
    { "cat triangles", BT_ERR_LIMIT, "10000000" },
    { "cat vertices", BT_ERR_FORMAT, "4 vertices" },
    { "cat none", BT_ERR_LIMIT, "0 triangles" },
    { "cat right right", BT_ERR_FORMAT, "goes on" },
    { "cat right; echo but no >&2; exit 10", BT_ERR_FORMAT, "but no" },
    { "cat right; kill -SEGV $$", BT_ERR_FORMAT, "crashes the library" },
  };
  const char *file = any_file ();
  char path[2 * PATH];
  (void)state;
  snprintf (path, sizeof path, "%s", file);
  write_answers ();
  for (size_t i = 0; i < sizeof cases / sizeof *cases; i++)
    {
      use_script (cases[i].script);
      refused (path, NULL, cases[i].status, cases[i].words);
    }
}

static void
slow_readers (void **state)
{
  static const char *const scripts[]
      = { "exec sleep 600", "sleep 600; :", "exec >&- 2>&-; exec sleep 600",
          "cat right; exec sleep 600", "yes >&2 & sleep 600; :" };
  static const bt__reader_limits brief = { 0.2, 60, 1000 };
  struct timespec from, to;
  char path[2 * PATH];
  (void)state;
  snprintf (path, sizeof path, "%s", any_file ());
  write_answers ();
  clock_gettime (CLOCK_MONOTONIC, &from);
  for (size_t i = 0; i < sizeof scripts / sizeof *scripts; i++)
    {
      use_script (scripts[i]);
      refused (path, &brief, BT_ERR_LIMIT, "given up");
    }
  clock_gettime (CLOCK_MONOTONIC, &to);
  assert_true (to.tv_sec - from.tv_sec < 300); /* on the slowest machine */
}

static void
not_a_program (void **state)
{
  char path[2 * PATH];
  (void)state;
  snprintf (path, sizeof path, "%s", any_file ());
  use_script ("exit 0");
  assert_int_equal (chmod (in_scratch ("reader"), 0600), 0);
  refused (path, NULL, BT_ERR_IO, "cannot be run");
  use_reader (scratch);
  refused (path, NULL, BT_ERR_IO, "cannot be run");
  unsetenv ("BIGHT_MESH_READER");
  assert_int_equal (setenv ("BIGHT_LIBEXEC", "/nowhere", 1), 0);
  refused (path, NULL, BT_ERR_UNSUPPORTED, "/nowhere/bight-mesh-reader");
  unsetenv ("BIGHT_LIBEXEC");
}

/* ---- A process with habits of its own ---- */

static void
accepted (void)
{
  bt_mesh_data *data;
  bt_error e = { 0 };
  if (bt_mesh_read (in_scratch ("any.obj"), BT_MESH_UP_Z, &data, &e) != BT_OK)
    fail_msg ("%s", e.text);
  assert_int_equal (data->mesh.triangles, 1);
  assert_true (data->mesh.vertex[1].x == 1);
  bt_mesh_data_free (data);
}

static volatile sig_atomic_t alarms;

static void
count_alarm (int signal)
{
  (void)signal;
  alarms++;
}

static void
habits (void **state)
{
  struct itimerval every = { { 0, 500 }, { 0, 500 } }, never = { { 0, 0 }, { 0, 0 } };
  struct sigaction action = { .sa_handler = count_alarm }, before;
  sigset_t all, old;
  (void)state;
  any_file ();
  write_answers ();
  use_script ("head -c 60 right; sleep 0.1; tail -c +61 right");
  accepted ();

  signal (SIGCHLD, SIG_IGN); /* the status is lost, the answer is not */
  accepted ();
  signal (SIGCHLD, SIG_DFL);

  sigaction (SIGALRM, &action, &before); /* every call is interrupted */
  setitimer (ITIMER_REAL, &every, NULL);
  accepted ();
  setitimer (ITIMER_REAL, &never, NULL);
  sigaction (SIGALRM, &before, NULL);
  assert_true (alarms > 0);

  sigfillset (&all);
  sigprocmask (SIG_BLOCK, &all, &old); /* what we block, the reader does not */
  signal (SIGINT, SIG_IGN);
  use_script ("kill -INT $$; cat right");
  refused (in_scratch ("any.obj"), NULL, BT_ERR_IO, "interrupted");
  signal (SIGINT, SIG_DFL);
  sigprocmask (SIG_SETMASK, &old, NULL);

  int in = dup (STDIN_FILENO);
  use_script ("cat right");
  close (STDIN_FILENO);
  accepted ();
  dup2 (in, STDIN_FILENO);
  close (in);
}

static int
open_files (void)
{
  int n = 0;
  for (int fd = 0; fd < 200; fd++)
    n += fcntl (fd, F_GETFD) >= 0;
  return n;
}

static int open_at_first;

static void
nothing_is_left (void **state)
{
  (void)state;
  assert_int_equal (open_files (), open_at_first);
  assert_true (waitpid (-1, NULL, WNOHANG) < 0); /* no child, dead or alive */
}

static int
set_up (void **state)
{
  const char *built = getenv ("top_builddir"), *given = getenv ("BIGHT_MESH_READER");
  (void)state;
  if (built)
    snprintf (reader, sizeof reader, "%s/src/bight-mesh-reader", built);
  else
    snprintf (reader, sizeof reader, "%s", given ? given : "/nowhere");
  snprintf (scratch, sizeof scratch, "/tmp/bight-mesh-XXXXXX");
  open_at_first = open_files ();
  return mkdtemp (scratch) ? 0 : -1;
}

static int
tear_down (void **state)
{
  char command[PATH + 20];
  (void)state;
  snprintf (command, sizeof command, "rm -rf '%s'", scratch);
  return system (command);
}

int
main (void)
{
  const struct CMUnitTest tests[] = {
    cmocka_unit_test (formats_agree),
    cmocka_unit_test (comments_say_nothing),
    cmocka_unit_test (polygons_and_soups),
    cmocka_unit_test (real_meshes),
    cmocka_unit_test (no_file),
    cmocka_unit_test (bad_files),
    cmocka_unit_test (crash),
    cmocka_unit_test (cut_binary_stl),
    cmocka_unit_test (beginnings),
    cmocka_unit_test (little_memory),
    cmocka_unit_test (bad_readers),
    cmocka_unit_test (slow_readers),
    cmocka_unit_test (not_a_program),
    cmocka_unit_test (habits),
    cmocka_unit_test (nothing_is_left),
  };
  return cmocka_run_group_tests (tests, set_up, tear_down);
}
