/* The moving line: nodes that come and go at the winch, and the knife.

   A split or a join changes the chords that stand for the same curve.  Were the rest lengths simply
   divided or added, the tension would jump by EA times the difference, tens of newtons for a line
   that hangs.  So the rest lengths follow the chords at the stretch there was, and the line's
   length is kept by what is owed, which the winch pays slowly.

   At a lump the line has a corner.  A node that comes beside a lump falls from the chord into the
   corner, and a corner that goes straightens the line; either is felt at both ends.  So a lump
   brings its own node, which comes as the lump leaves the winch, in the direction in which the
   winch is pulled; and the nodes about a lump go only at the winch itself.

   A stiff line has no corner: it turns over sqrt (EI / T).  A first interval much shorter than that
   would shape nothing, and be a lever: what a step leaves undone of the place of its node, times EI
   over the third power of its length, pulls at a clamp.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <math.h>
#include <string.h>

#include "math/vec.h"
#include "tether/dynamic_contact.h"

#define SPLIT 1.6 /* of a piece: the first interval is split beyond this, ... */
#define JOIN 0.4  /* ... and joined below this; far apart, so that neither undoes the other */

#define TURNS 0.1  /* of sqrt (EI / T): no first interval of a stiff line need be shorter */
#define BORN 0.001 /* of a piece: how far a lump is out when its node comes, ... */
#define GONE 0.008 /* ... and how near to the winch the node of a lump goes */
#define LEAST 0.01 /* of an interval: the least part of it */
#define BENT 0.01  /* of a piece: so far from its neighbours' chord is a node at a corner */

/* Make room for, or remove, element AT of an array of N.  */
static void
shift (void *array, size_t size, int64_t at, int64_t n, int by)
{
  char *p = array;
  if (by > 0)
    memmove (p + (size_t)(at + 1) * size, p + (size_t)at * size, (size_t)(n - at) * size);
  else
    memmove (p + (size_t)at * size, p + (size_t)(at + 1) * size, (size_t)(n - at - 1) * size);
}

/* Make room for, or remove, node I and interval I - 1 of every array: another line, to be looked at
   anew.  */
static void
shift_all (bt__dynamic *d, int64_t i, int by)
{
  d->spare = (bt__dynamic_drift){ 0, 0, 0 };
  bt_vec3 *nodes[] = { bt__dynamic_x (d), bt__dynamic_v (d), bt__dynamic_dx (d), bt__dynamic_vp (d),
                       bt__dynamic_load (d) };
  double *intervals[] = { bt__dynamic_tension (d), bt__dynamic_rest (d), bt__dynamic_stretch (d),
                          bt__dynamic_dstretch (d) };
  for (int k = 0; k < 5; k++)
    shift (nodes[k], sizeof (bt_vec3), i, d->n + 1, by);
  for (int k = 0; k < 4; k++)
    shift (intervals[k], sizeof (double), i - 1, d->n, by);
  shift (bt__dynamic_chord (d), sizeof (bt_vec3), i - 1, d->n, by);
  d->n += by;
}

static bt_vec3
point_between (const bt_vec3 *a, double u)
{
  return bt__axpy (bt__scale (1 - u, a[0]), u, a[2]);
}

/* True if interval J of D is no slack one: it is in tension, or bears compression.  */
static int
is_strained (const bt__dynamic *d, int64_t j)
{
  double t = bt__dynamic_tension (d)[j];
  return t > 0 || (t < 0 && bt__dynamic_chord (d)[j].y == BT__BEARS);
}

/* The curvature vector of the line at node I, 1/m: zero at an end and beside a slack interval.  */
static bt_vec3
curvature (const bt__dynamic *d, int64_t i)
{
  const bt_vec3 *x = bt__dynamic_x (d) + i;
  const double *rest = bt__dynamic_rest (d) + i;
  if (i < 1 || i >= d->n || !is_strained (d, i - 1) || !is_strained (d, i))
    return bt__vec (0, 0, 0);
  bt_vec3 before = bt__scale (1 / rest[-1], bt__sub (x[0], x[-1])),
          after = bt__scale (1 / rest[0], bt__sub (x[1], x[0]));
  return bt__scale (2 / (rest[-1] + rest[0]), bt__sub (after, before));
}

/* How far the curve lies off the chord of interval J where the chord is divided into lengths A and
   B: the line bends there as it does, on the mean, at the inner nodes of the interval.  */
static bt_vec3
bow_of_interval (const bt__dynamic *d, int64_t j, double a, double b)
{
  int inner = (j > 0) + (j + 1 < d->n);
  bt_vec3 sum = bt__add (curvature (d, j), curvature (d, j + 1));
  return bt__scale (inner > 0 ? -0.5 * a * b / inner : 0, sum);
}

/* Give the new node I at the share U of its interval the motion that the line has there.  The winch
   end stands while line runs out of it: where the first interval is TAUT, all of it goes along the
   line as its far end does.  */
static void
set_moving (bt__dynamic *d, int64_t i, double u, int taut)
{
  const bt_vec3 *x = bt__dynamic_x (d);
  bt_vec3 *nodes[] = { bt__dynamic_v (d), bt__dynamic_dx (d), bt__dynamic_vp (d) };
  bt_vec3 along = bt__unit_or (bt__sub (x[i + 1], x[i - 1]), bt__vec (0, 0, 0));
  for (int k = 0; k < 3; k++)
    {
      bt_vec3 *a = nodes[k], v = point_between (a + i - 1, u);
      double lag = i == 1 && taut ? bt__dot (along, bt__sub (a[2], v)) : 0;
      a[i] = bt__axpy (v, lag, along);
    }
}

/* The stretched length of the line of interval J, m.  */
static double
drawn_length (const bt__dynamic *d, int64_t j)
{
  const bt_vec3 *x = bt__dynamic_x (d) + j;
  return bt__distance (x[0], x[1]) - bt__dynamic_chord (d)[j].z;
}

/* Give the surplus ROUND of the divided interval J to the part next to a chord with a surplus.  */
static void
share_round (bt__dynamic *d, int64_t j, double round)
{
  bt_vec3 *chord = bt__dynamic_chord (d) + j;
  double before = j > 0 ? chord[-1].z : 0, after = j + 2 < d->n ? chord[2].z : 0;
  chord[0] = chord[1] = bt__vec (0, 0, 0);
  chord[after >= before].z = d->rounded ? round : 0;
}

/* What interval J is crumpled by, m.  */
static double
crumple_of (const bt__dynamic *d, int64_t j)
{
  const bt_vec3 *chord = bt__dynamic_chord (d) + j;
  return chord->y == BT__BEARS ? chord->x : 0;
}

/* The length to which tension draws interval J, uncrumpled, over its rest length.  */
static double
drawn_share (const bt__dynamic *d, int64_t j)
{
  return bt__dynamic_stretch (d)[j] + crumple_of (d, j) / bt__dynamic_rest (d)[j];
}

/* Crumple interval J, of known rest length, so that the tension draws the interval to SHARE times
   the rest length; a longer interval has more line.  */
static void
crumple_to (bt__dynamic *d, int64_t j, double share)
{
  double *rest = bt__dynamic_rest (d) + j, chord = drawn_length (d, j);
  *rest = fmax (*rest, chord / share);
  bt__dynamic_stretch (d)[j] = chord / *rest;
  bt__dynamic_chord (d)[j].x = fmax (share * *rest - chord, 0);
  bt__dynamic_chord (d)[j].y = BT__BEARS;
}

/* What a new node at the share U of interval J keeps where loads are kept: a fourth-order part
   begins anew, the layers of a line that bends have slipped as beside it.  */
static bt_vec3
slipped_between (const bt__dynamic *d, int64_t j, double u)
{
  const bt_vec3 *a = bt__dynamic_load (d) + j;
  return bt__dynamic_chord (d)[j].y == BT__BEARS ? bt__axpy (bt__scale (1 - u, a[0]), u, a[1])
                                                 : bt__vec (0, 0, 0);
}

void
bt__dynamic_split (bt__dynamic *d, int64_t j, double u, int straight)
{
  int64_t i = j + 1;
  bt_vec3 slipped = slipped_between (d, j, u);
  double round = bt__dynamic_chord (d)[j].z, drawn = drawn_share (d, j);
  double *rest = bt__dynamic_rest (d), *e = bt__dynamic_stretch (d), whole = rest[j];
  int taut = is_strained (d, j), crumpled = taut && crumple_of (d, j) > 0;
  bt_vec3 *x = bt__dynamic_x (d), none = { 0, 0, 0 },
          off = straight || !taut ? none : bow_of_interval (d, j, u * whole, (1 - u) * whole);
  shift_all (d, i, 1);
  set_moving (d, i, u, taut);
  x[i] = bt__add (point_between (x + j, u), off);
  bt__dynamic_load (d)[i] = slipped;
  share_round (d, j, round);
  rest[j] = taut && !crumpled ? drawn_length (d, j) / e[j] : u * whole;
  rest[i] = taut && !crumpled ? drawn_length (d, i) / e[i] : whole - rest[j];
  for (int64_t k = j; crumpled && k <= i; k++)
    crumple_to (d, k, drawn);
  d->owed += taut ? whole - rest[j] - rest[i] : 0;
}

void
bt__dynamic_remove (bt__dynamic *d, int64_t i)
{
  int64_t j = i - 1;
  double *rest = bt__dynamic_rest (d) + j, *e = bt__dynamic_stretch (d) + j,
         *t = bt__dynamic_tension (d) + j, *de = bt__dynamic_dstretch (d) + j;
  double whole = rest[0] + rest[1], u = rest[0] / whole, chord;
  double mean[]
      = { u * t[0] + (1 - u) * t[1], u * e[0] + (1 - u) * e[1], u * de[0] + (1 - u) * de[1] };
  double round = d->rounded ? bt__dynamic_chord (d)[j].z + bt__dynamic_chord (d)[i].z : 0;
  double drawn = u * drawn_share (d, j) + (1 - u) * drawn_share (d, i);
  int taut = is_strained (d, j) && is_strained (d, j + 1),
      crumpled = taut && crumple_of (d, j) + crumple_of (d, i) > 0;
  shift_all (d, i, -1);
  bt__dynamic_chord (d)[j] = bt__vec (0, 0, round);
  chord = drawn_length (d, j);
  t[0] = mean[0];
  de[0] = mean[2];
  rest[0] = taut && !crumpled ? chord / mean[1] : whole;
  e[0] = chord / rest[0];
  if (crumpled)
    crumple_to (d, j, drawn);
  d->owed += whole - rest[0];
}

/* The share of the divided line in interval J, after the share U of the chord.  */
static double
share_of_line (const bt__dynamic *d, int64_t j, double u)
{
  double a = drawn_length (d, j), b = drawn_length (d, j + 1);
  return d->rounded ? fmin (fmax (a / (a + b), LEAST), 1 - LEAST) : u;
}

/* A node between a sliding node and a second node moves along the line as the second.  */
void
bt__dynamic_insert (bt__dynamic *d, int64_t j, double u, int64_t from)
{
  int64_t i = j + 1, other = from > j ? i + 1 : j;
  bt_vec3 slipped = slipped_between (d, j, u);
  double *rest = bt__dynamic_rest (d), *e = bt__dynamic_stretch (d), *t = bt__dynamic_tension (d),
         *de = bt__dynamic_dstretch (d), whole = rest[j], round = bt__dynamic_chord (d)[j].z;
  double drawn = drawn_share (d, j);
  int crumpled = crumple_of (d, j) > 0;
  shift_all (d, i, 1);
  bt_vec3 *x = bt__dynamic_x (d),
          *nodes[] = { bt__dynamic_v (d), bt__dynamic_dx (d), bt__dynamic_vp (d) };
  bt_vec3 along = bt__unit_or (bt__sub (x[i + 1], x[j]), bt__vec (0, 0, 0));
  x[i] = bt__axpy (bt__scale (1 - u, x[j]), u, x[i + 1]);
  for (int k = 0; k < 3; k++)
    {
      bt_vec3 *a = nodes[k], v = bt__axpy (bt__scale (1 - u, a[j]), u, a[i + 1]);
      a[i] = bt__axpy (v, bt__dot (along, bt__sub (a[other], v)), along);
    }
  bt__dynamic_load (d)[i] = slipped;
  share_round (d, j, round);
  rest[j] = share_of_line (d, j, u) * whole;
  rest[i] = whole - rest[j];
  t[j] = t[i];
  e[j] = e[i];
  de[j] = de[i];
  for (int64_t k = j; crumpled && k <= i; k++)
    crumple_to (d, k, drawn);
}

void
bt__dynamic_split_first (bt__dynamic *d, const bt__dynamic_turn *next, int straight)
{
  double rest = bt__dynamic_rest (d)[0], first = next->first > 0 ? next->first : rest - d->piece;
  bt__dynamic_split (d, 0, first / rest, straight);
}

void
bt__dynamic_split_at_lump (bt__dynamic *d, double out, const bt__dynamic_input *in)
{
  bt_vec3 *x = bt__dynamic_x (d), way = bt__unit_or (d->pull[0], bt__sub (x[1], x[0]));
  double *rest = bt__dynamic_rest (d), *e = bt__dynamic_stretch (d), whole = rest[0];
  shift_all (d, 1, 1);
  bt__dynamic_v (d)[1] = bt__dynamic_vp (d)[1] = bt__scale (in->pay, way);
  bt__dynamic_dx (d)[1] = bt__scale (in->pay * in->h, way);
  bt__dynamic_tension (d)[0] = bt__norm (d->pull[0]);
  e[0] = 1 + bt__dynamic_tension (d)[0] / bt__stiffness (in->line->ea);
  rest[0] = out;
  x[1] = bt__axpy (x[0], out * e[0], way);
  rest[1] = bt__distance (x[1], x[2]) / e[1];
  bt__dynamic_load (d)[1] = bt__vec (0, 0, 0);
  bt__dynamic_chord (d)[0] = bt__dynamic_chord (d)[1] = bt__vec (0, 0, 0);
  d->owed += whole - rest[0] - rest[1];
}

/* What of D's first two intervals is lumped.  */
typedef struct first_lump
{
  int corner; /* true if the line has a corner at node 1, or a lump beside it */
  double out; /* m: of the lump nearest to the winch in the first interval: how far out; 0: none */
} first_lump;

static int
is_off_chord (const bt__dynamic *d)
{
  const bt_vec3 *x = bt__dynamic_x (d);
  bt_vec3 a = bt__sub (x[1], x[0]), b = bt__sub (x[2], x[0]);
  double chord = bt__norm (b);
  return bt__norm (bt__cross (a, b)) > BENT * d->piece * chord;
}

double
bt__dynamic_blunt (const bt__dynamic *d, const bt_tether_props *p)
{
  double pull = bt__dynamic_tension (d)[d->n > 1 ? 1 : 0], most = JOIN * d->piece;
  if (!(p->ei > 0))
    return 0;
  return pull > 0 ? fmin (TURNS * sqrt (p->ei / pull), most) : most;
}

static first_lump
first_lump_of (const bt__dynamic *d, const bt__dynamic_input *in, double edge)
{
  const double *rest = bt__dynamic_rest (d);
  double length = bt__dynamic_length (d) - d->owed;
  double next = rest[0] + (d->n > 1 ? rest[1] : 0);
  first_lump found = { d->n > 1 && is_off_chord (d), 0 };
  for (int k = 0; k < in->n_lumps; k++)
    {
      double s = length - in->lumps[k].from_end;
      if (in->lumps[k].span > 0 || s <= 0 || s >= next)
        continue;
      found.corner = 1;
      if (s >= edge && s <= rest[0] - edge && (found.out == 0 || s < found.out))
        found.out = s;
    }
  return found;
}

bt__dynamic_turn
bt__dynamic_winding (const bt__dynamic *d, const bt__dynamic_input *in)
{
  double rest = bt__dynamic_rest (d)[0], piece = d->piece, step = in->pay * in->h;
  double blunt = in->mesh.corners ? bt__dynamic_blunt (d, in->line) : 0;
  double born = fmax (BORN * piece, blunt);
  first_lump lump = in->mesh.corners ? first_lump_of (d, in, born) : (first_lump){ 0, 0 };
  double gone = blunt > 0 ? fmin (fmax (GONE * piece, blunt - step), JOIN * piece) : GONE * piece;
  int near = lump.corner ? in->pay < 0 && rest < gone : rest < JOIN * piece;
  if (d->n > d->least && near)
    return (bt__dynamic_turn){ .way = -1 };
  if (in->pay > 0 && lump.out > 0 && lump.out <= fmax (2 * born, 2 * step))
    return (bt__dynamic_turn){ .way = 1, .first = lump.out, .lump = 1 };
  if (rest > SPLIT * piece)
    return (
        bt__dynamic_turn){ .way = 1, .first = lump.out > 0 ? born : 0, .straight = lump.corner };
  return (bt__dynamic_turn){ .way = 0 };
}

/* ---- The knife ---- */

/* Copy what D has of nodes FIRST on, COUNT intervals of it, to TO, which may be D.  */
static void
copy_part (const bt__dynamic *d, int64_t first, int64_t count, bt__dynamic *to)
{
  if (to != d)
    {
      memset (to, 0, bt__dynamic_size ((int)d->n_max));
      *to = *d;
    }
  to->spare = (bt__dynamic_drift){ 0, 0, 0 };
  to->n = count;
  bt_vec3 *(*const nodes[]) (const bt__dynamic *)
      = { bt__dynamic_x, bt__dynamic_v, bt__dynamic_dx, bt__dynamic_vp, bt__dynamic_load };
  double *(*const intervals[]) (const bt__dynamic *)
      = { bt__dynamic_tension, bt__dynamic_rest, bt__dynamic_stretch, bt__dynamic_dstretch };
  for (int k = 0; k < 5; k++)
    memmove (nodes[k](to), nodes[k](d) + first, (size_t)(count + 1) * sizeof (bt_vec3));
  for (int k = 0; k < 4; k++)
    memmove (intervals[k](to), intervals[k](d) + first, (size_t)count * sizeof (double));
  memmove (bt__dynamic_chord (to), bt__dynamic_chord (d) + first, (size_t)count * sizeof (bt_vec3));
}

/* Cut interval J of D at SHARE of it: the line now ends there, at node END.  */
static void
new_end (bt__dynamic *d, int64_t j, double share, int64_t end)
{
  bt_vec3 *(*const nodes[]) (const bt__dynamic *)
      = { bt__dynamic_x, bt__dynamic_v, bt__dynamic_dx, bt__dynamic_vp };
  for (int k = 0; k < 4; k++)
    {
      bt_vec3 *a = nodes[k](d);
      a[end] = bt__axpy (bt__scale (1 - share, a[j]), share, a[j + 1]);
    }
  bt__dynamic_load (d)[end] = bt__vec (0, 0, 0);
  bt__dynamic_chord (d)[j] = bt__vec (0, 0, 0);
  bt__dynamic_rest (d)[j] *= end ? share : 1 - share;
  bt__dynamic_tension (d)[j] = 0;
  d->pull[end ? 1 : 0] = bt__vec (0, 0, 0);
  d->history = 0;
  d->spare = (bt__dynamic_drift){ 0, 0, 0 };
  bt__twist_forget (d);
}

void
bt__dynamic_cut (const bt__dynamic *d, int j, double share, bt__dynamic *a, bt__dynamic *b)
{
  if (b)
    {
      int64_t first = share == 1 ? j + 1 : j;
      copy_part (d, first, d->n - first, b);
      new_end (b, 0, share == 1 ? 0 : share, 0);
      b->owed = 0;
    }
  if (a && a != d)
    copy_part (d, 0, j + 1, a);
  if (a)
    {
      a->n = j + 1;
      a->least = 1;
      new_end (a, j, share, j + 1);
    }
}
