/* MoorDyn at a race: see rival_moordyn.h.

   MoorDyn reads its system from a file, and begins as LoadState says.  In a file of SaveState the
   matrix of a line has a row for each inner node, three coordinates and three velocities; our
   places and zeros are written over these rows.  The flow of the water is set once, as external
   wave kinematics.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <fcntl.h>
#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include <moordyn/MoorDyn2.h>

#include "math/vec.h"
#include "rival_moordyn.h"
#include "testbed/calibration.h"

enum
{
  HEADER = 7 + 2 + 8, /* bytes of a file of state before its words */
  NEAR = 4,           /* nodes between which a station lies */
  WORDS = 16 + 6 * MOORDYN_SEGMENTS_MAX,
  FASTEST = 100 /* m/s: a node that is faster blew up */
};

/* ---- Files ---- */

/* Make NAME that of a new file open for writing.  */
static FILE *
make_file (char *name, size_t size)
{
  const char *folder = getenv ("TMPDIR");
  snprintf (name, size, "%s/bight-moordyn-XXXXXX", folder ? folder : "/tmp");
  int fd = mkstemp (name);
  return fd >= 0 ? fdopen (fd, "w") : NULL;
}

static void
write_point (FILE *f, int id, const char *kind, bt_vec3 at)
{
  fprintf (f, "%d %s %.17g %.17g %.17g 0 0 0 0\n", id, kind, at.x, at.y, at.z);
}

/* Write what MoorDyn reads of R.  */
static int
write_system (const race *r, const moordyn_setting *how, double step, char *name, size_t size)
{
  const bt_tether_props *p = &r->line;
  FILE *f = make_file (name, size);
  if (!f)
    return 0;
  fputs ("---- MoorDyn ----\nrace\n---- LINE TYPES ----\n"
         "TypeName Diam Mass/m EA BA/-zeta EI Cd Ca CdAx CaAx\n"
         "(name) (m) (kg/m) (N) (N-s/-) (N-m^2) (-) (-) (-) (-)\n",
         f);
  fprintf (f, "main %.17g %.17g %.17g %.17g 0 %.17g %.17g %.17g 0\n", p->diameter, p->mass, p->ea,
           p->ba, p->cdn, p->ca, p->cdt);
  fputs ("---- POINT PROPERTIES ----\nID Type X Y Z Mass Volume CdA Ca\n"
         "(#) (-) (m) (m) (m) (kg) (m^3) (m^2) (-)\n",
         f);
  write_point (f, 1, "Fixed", r->anchor);
  write_point (f, 2, r->loose ? "Free" : "Coupled", r->led (0));
  fprintf (f,
           "---- LINES ----\nID LineType AttachA AttachB UnstrLen NumSegs LineOutputs\n"
           "(#) (name) (#) (#) (m) (-) (-)\n1 main 1 2 %.17g %d -\n---- OPTIONS ----\n"
           "0 writeLog\n%.17g dtM\n%s tScheme\n%g WtrDnsty\n1000 WtrDpth\n1 WaveKin\n"
           "1 disableOutput\n1 disableOutTime\n"
           "---- OUTPUTS ----\n---- need this line ----\n",
           r->length, how->segments, 1.001 * step, how->scheme, RACE_DENSITY);
  return fclose (f) == 0;
}

/* ---- The beginning ---- */

/* Read at S the cubic through the four nearest of N + 1 values AT, evenly along [0, 1].  */
static bt_vec3
at_share (const bt_vec3 *at, int n, double s)
{
  int from = (int)fmax (0, fmin (n - NEAR + 1, floor (s * n) - 1));
  bt_vec3 sum = { 0, 0, 0 };
  for (int a = 0; a < NEAR; a++)
    {
      double weight = 1;
      for (int b = 0; b < NEAR; b++)
        if (b != a)
          weight *= (s * n - from - b) / (a - b);
      sum = bt__axpy (sum, weight, at[from + a]);
    }
  return sum;
}

/* Put the places START into the COUNT words of a state, at the matrix of a line of N segments;
   return zero if no matrix has the size.  */
static int
put_places (uint64_t *word, size_t count, int n, const bt_vec3 *start)
{
  uint64_t inner = (uint64_t)n - 1;
  for (size_t k = 1; k + 2 + 6 * inner <= count; k++)
    if (word[k] == inner && word[k + 1] == 6)
      {
        double *row = (double *)(word + k + 2);
        for (uint64_t i = 0; i < inner; i++)
          {
            bt_vec3 at = at_share (start, OUTSIDE_STATIONS - 1, (double)(i + 1) / n);
            row[6 * i] = at.x, row[6 * i + 1] = at.y, row[6 * i + 2] = at.z;
            row[6 * i + 3] = row[6 * i + 4] = row[6 * i + 5] = 0;
          }
        return 1;
      }
  return 0;
}

/* Let SYSTEM of N segments begin at START, at rest.  */
static int
begin_at (MoorDyn system, int n, const bt_vec3 *start)
{
  static uint64_t word[WORDS];
  char header[HEADER], name[4096];
  FILE *f = make_file (name, sizeof name);
  int good = f && fclose (f) == 0 && MoorDyn_SaveState (system, name) == 0;
  f = good ? fopen (name, "r+b") : NULL;
  if (f)
    {
      size_t count = fread (header, 1, HEADER, f) == HEADER ? fread (word, 8, WORDS, f) : 0;
      good = put_places (word, count, n, start) && fseek (f, HEADER, SEEK_SET) == 0
             && fwrite (word, 8, count, f) == count;
      good &= fclose (f) == 0;
    }
  good = good && f && MoorDyn_LoadState (system, name) == 0;
  unlink (name);
  return good;
}

/* Let the water of SYSTEM flow as R's does.  */
static int
let_flow (MoorDyn system, const race *r)
{
  static double u[3 * (MOORDYN_SEGMENTS_MAX + 4)], none[3 * (MOORDYN_SEGMENTS_MAX + 4)];
  unsigned int n = 0;
  if (MoorDyn_ExternalWaveKinInit (system, &n) || n > MOORDYN_SEGMENTS_MAX + 4)
    return 0;
  for (unsigned int i = 0; i < n; i++)
    u[3 * i] = r->flow.x, u[3 * i + 1] = r->flow.y, u[3 * i + 2] = r->flow.z;
  return MoorDyn_ExternalWaveKinSet (system, u, none, 0) == 0;
}

/* MoorDyn_Create without a word on standard output.  */
static MoorDyn
create_silently (const char *name)
{
  fflush (stdout);
  int kept = dup (STDOUT_FILENO), nowhere = open ("/dev/null", O_WRONLY);
  dup2 (nowhere, STDOUT_FILENO);
  MoorDyn system = MoorDyn_Create (name);
  dup2 (kept, STDOUT_FILENO);
  close (kept);
  close (nowhere);
  if (system)
    MoorDyn_SetVerbosity (system, MOORDYN_NO_OUTPUT);
  return system;
}

static MoorDyn
open_system (const race *r, const moordyn_setting *how, double step, const bt_vec3 *start)
{
  char name[4096];
  bt_vec3 to = r->led (0);
  double x[3] = { to.x, to.y, to.z }, still[3] = { 0, 0, 0 };
  if (!write_system (r, how, step, name, sizeof name))
    return NULL;
  MoorDyn system = create_silently (name);
  unlink (name);
  if (!system)
    return NULL;
  if (MoorDyn_Init_NoIC (system, r->loose ? NULL : x, r->loose ? NULL : still) == 0
      && let_flow (system, r) && begin_at (system, how->segments, start))
    return system;
  MoorDyn_Close (system);
  return NULL;
}

/* ---- The flight ---- */

/* The tension at end E of LINE, of N segments: the tensions of the last two segments extended.  */
static double
pull_at (MoorDynLine line, int n, int e)
{
  double last[3], both[3];
  MoorDyn_GetLineNodeTen (line, (unsigned)(e ? n : 0), last);
  MoorDyn_GetLineNodeTen (line, (unsigned)(e ? n - 1 : 1), both);
  bt_vec3 a = bt__vec (last[0], last[1], last[2]), m = bt__vec (both[0], both[1], both[2]);
  return 1.5 * bt__norm (a) - 0.5 * bt__norm (bt__axpy (bt__scale (2, m), -1, a));
}

/* Note row K of F; return zero if the line is nowhere.  */
static int
note (MoorDyn system, int n, outside_flight *f, int k)
{
  static bt_vec3 at[MOORDYN_SEGMENTS_MAX + 1];
  MoorDynLine line = MoorDyn_GetLine (system, 1);
  double fastest = 0;
  for (int i = 0; i <= n; i++)
    {
      double p[3], v[3] = { 0, 0, 0 };
      MoorDyn_GetLineNodePos (line, (unsigned)i, p);
      MoorDyn_GetLineNodeVel (line, (unsigned)i, v);
      at[i] = bt__vec (p[0], p[1], p[2]);
      double fast = bt__norm (bt__vec (v[0], v[1], v[2]));
      if (!(fast <= fastest))
        fastest = fast;
    }
  for (int i = 0; i < OUTSIDE_STATIONS; i++)
    f->at[k][i] = at_share (at, n, i / (OUTSIDE_STATIONS - 1.0));
  for (int e = 0; e < 2; e++)
    f->pull[k][e] = pull_at (line, n, e);
  f->t[k] = 0.5 * k;
  return fastest < FASTEST && isfinite (f->pull[k][0] + f->pull[k][1]);
}

/* Take SYSTEM through PER steps from the half second K on.  */
static int
step_half (MoorDyn system, const race *r, int k, int per)
{
  double h = 0.5 / per, t = 0.5 * k, force[3];
  for (int i = 0; i < per; i++)
    {
      bt_vec3 a = r->led ((k * per + i) * h), b = r->led ((k * per + i + 1) * h);
      double x[3] = { a.x, a.y, a.z };
      double v[3] = { (b.x - a.x) / h, (b.y - a.y) / h, (b.z - a.z) / h };
      double dt = h;
      if (MoorDyn_Step (system, r->loose ? NULL : x, r->loose ? NULL : v, force, &t, &dt))
        return 0;
      t = 0.5 * k + (i + 1) * h;
    }
  return 1;
}

int
moordyn_fly (const race *r, const moordyn_setting *how, const outside_flight *begin,
             outside_flight *f, double *seconds)
{
  int per = (int)ceil (0.5 / how->step);
  MoorDyn system = open_system (r, how, 0.5 / per, begin->at[0]);
  double spent = 0;
  int good = system != NULL;
  *f = *begin;
  for (int k = 1; good && k < r->rows; k++)
    {
      double from = bench_now ();
      good = step_half (system, r, k - 1, per);
      spent += bench_now () - from;
      good = good && note (system, how->segments, f, k);
    }
  if (system)
    MoorDyn_Close (system);
  *seconds = spent / (0.5 * (r->rows - 1));
  return good;
}
