/* Knots by the Alexander polynomial.

   The closed polygon is simplified first: a node is dropped if no other link goes through the
   triangle of the node and its neighbours (Koniaris and Muthukumar 1991).  Then the crossings of
   one projection give linear equations in the arcs of the diagram: out = t in + (1 - t) over, with
   in and out exchanged at a left-handed crossing.  A minor of the system is the polynomial, up to
   sign and a power of t; multiplying by the value at 1 / t removes the power.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "aware/knot.h"
#include "base/error.h"
#include "collide/pair.h"

#define PRIME ((UINT64_C (1) << 61) - 1)

/* An undercrossing: the places along the curve of the lower and the upper strand.  */
typedef struct under
{
  double at, over; /* number of the link plus the share of it */
  int right;
} under;

struct bt__knot
{
  bt__asker *asker; /* or NULL */
  uint32_t room, n;
  bt_vec3 *p;
  uint32_t crossings;
  under under[BT__KNOT_CROSSINGS];
  uint64_t matrix[BT__KNOT_CROSSINGS * BT__KNOT_CROSSINGS];
};

/* ---- Numbers modulo 2^61 - 1 ---- */

static uint64_t
times (uint64_t a, uint64_t b)
{
  uint64_t al = a & 0x7fffffff, ah = a >> 31, bl = b & 0x7fffffff, bh = b >> 31;
  uint64_t middle = al * bh + ah * bl;
  /* 2^62 is 2; the middle's weight is 2^31, its upper part's 2^61.  */
  uint64_t sum = 2 * ah * bh + (middle >> 30) + ((middle & 0x3fffffff) << 31) + al * bl;
  sum = (sum & PRIME) + (sum >> 61);
  return sum >= PRIME ? sum - PRIME : sum;
}

static uint64_t
minus (uint64_t a, uint64_t b)
{
  return a >= b ? a - b : a + PRIME - b;
}

static uint64_t
modular_inverse (uint64_t a)
{
  uint64_t out = 1;
  for (uint64_t e = PRIME - 2; e > 0; e >>= 1, a = times (a, a))
    if (e & 1)
      out = times (out, a);
  return out;
}

/* ---- A simpler polygon ---- */

static double
volume (bt_vec3 a, bt_vec3 b, bt_vec3 c, bt_vec3 d)
{
  return bt__dot (bt__sub (b, a), bt__cross (bt__sub (c, a), bt__sub (d, a)));
}

static int
is_apart (double a, double b, double c, double p, double q)
{
  return fmax (fmax (a, b), c) < fmin (p, q) || fmin (fmin (a, b), c) > fmax (p, q);
}

/* True unless the segment P to Q surely misses the triangle A, B, C.  */
static int
may_pierce (bt_vec3 p, bt_vec3 q, const bt_vec3 *v)
{
  if (is_apart (v[0].x, v[1].x, v[2].x, p.x, q.x) || is_apart (v[0].y, v[1].y, v[2].y, p.y, q.y)
      || is_apart (v[0].z, v[1].z, v[2].z, p.z, q.z))
    return 0;
  double size = bt__distance (v[0], v[1]) + bt__distance (v[1], v[2]) + bt__distance (p, q);
  double tiny = 1e-12 * size * size * size;
  double one = volume (v[0], v[1], v[2], p), other = volume (v[0], v[1], v[2], q);
  if ((one > tiny && other > tiny) || (one < -tiny && other < -tiny))
    return 0;
  double a = volume (p, q, v[0], v[1]), b = volume (p, q, v[1], v[2]),
         c = volume (p, q, v[2], v[0]);
  double least = fmin (a, fmin (b, c)), most = fmax (a, fmax (b, c));
  return least >= -tiny || most <= tiny;
}

static int
can_drop (const bt__knot *k, uint32_t i)
{
  uint32_t n = k->n, h = (i + n - 1) % n, j = (i + 1) % n;
  bt_vec3 v[3] = { k->p[h], k->p[i], k->p[j] };
  for (uint32_t a = 0; a < n; a++)
    {
      uint32_t b = (a + 1) % n;
      if (a == h || a == i || a == j || b == h)
        continue;
      if (may_pierce (k->p[a], k->p[b], v))
        return 0;
    }
  return 1;
}

static void
make_simpler (bt__knot *k)
{
  for (uint32_t before = k->n + 1; k->n < before && k->n > 3;)
    {
      before = k->n;
      for (uint32_t i = 0; i < k->n && k->n > 3 && !bt__ask (k->asker);)
        if (can_drop (k, i))
          {
            memmove (k->p + i, k->p + i + 1, (k->n - i - 1) * sizeof *k->p);
            k->n--;
          }
        else
          i++;
    }
}

/* ---- The diagram ---- */

/* Any direction will do that no link is along.  */
static void
turn_about (bt__knot *k)
{
  bt_vec3 z = bt__unit_or (bt__vec (0.21837, 0.43981, 0.87103), bt__vec (0, 0, 1));
  bt_vec3 x = bt__unit_or (bt__cross (bt__vec (0.6113, 0.7127, -0.1), z), z), y = bt__cross (z, x);
  for (uint32_t i = 0; i < k->n; i++)
    k->p[i] = bt__vec (bt__dot (x, k->p[i]), bt__dot (y, k->p[i]), bt__dot (z, k->p[i]));
}

static double
side_in_plane (bt_vec3 a, bt_vec3 b, bt_vec3 c)
{
  return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

/* Add the crossing of links I and J, if there is one; return 0 if there is no room.  */
static int
add_crossing (bt__knot *k, uint32_t i, uint32_t j)
{
  bt_vec3 a = k->p[i], b = k->p[(i + 1) % k->n], c = k->p[j], d = k->p[(j + 1) % k->n];
  double ca = side_in_plane (c, d, a), cb = side_in_plane (c, d, b), ac = side_in_plane (a, b, c),
         ad = side_in_plane (a, b, d);
  if ((ca >= 0) == (cb >= 0) || (ac >= 0) == (ad >= 0))
    return 1;
  if (k->crossings == BT__KNOT_CROSSINGS)
    return 0;
  double s = ca / (ca - cb), t = ac / (ac - ad);
  int first_over = a.z + s * (b.z - a.z) > c.z + t * (d.z - c.z);
  int left = ad > ac; /* J goes to the left of I */
  k->under[k->crossings++]
      = first_over ? (under){ j + t, i + s, left } : (under){ i + s, j + t, !left };
  return 1;
}

static int
by_curve_place (const void *a, const void *b)
{
  const under *x = a, *y = b;
  return x->at < y->at ? -1 : x->at > y->at;
}

static int
find_knot_crossings (bt__knot *k)
{
  k->crossings = 0;
  for (uint32_t i = 0; i < k->n; i++)
    {
      if (bt__ask (k->asker))
        return 0;
      for (uint32_t j = i + 2; j < k->n; j++)
        if ((i > 0 || j + 1 < k->n) && !add_crossing (k, i, j))
          return 0;
    }
  qsort (k->under, k->crossings, sizeof *k->under, by_curve_place);
  return 1;
}

/* ---- The polynomial ---- */

/* Arc i ends at under-crossing i.  */
static uint32_t
arc_at (const bt__knot *k, double place)
{
  uint32_t i = 0;
  while (i < k->crossings && k->under[i].at < place)
    i++;
  return i % k->crossings;
}

static void
add_to (bt__knot *k, uint32_t row, uint32_t column, uint64_t value)
{
  uint32_t size = k->crossings - 1;
  if (column == size) /* the minor leaves the last out */
    return;
  uint64_t *at = k->matrix + (size_t)row * size + column;
  *at = minus (*at, minus (0, value));
}

static void
fill_matrix (bt__knot *k, uint64_t t)
{
  uint32_t size = k->crossings - 1;
  memset (k->matrix, 0, (size_t)size * size * sizeof *k->matrix);
  for (uint32_t i = 0; i < size; i++)
    {
      uint32_t in = i, out = (i + 1) % k->crossings, over = arc_at (k, k->under[i].over);
      add_to (k, i, over, minus (1, t));
      add_to (k, i, k->under[i].right ? in : out, t);
      add_to (k, i, k->under[i].right ? out : in, minus (0, 1));
    }
}

/* Gauss, with a sign.  */
static uint64_t
determinant (bt__knot *k)
{
  uint32_t n = k->crossings - 1;
  uint64_t *m = k->matrix, product = 1;
  for (uint32_t c = 0; c < n && !bt__ask (k->asker); c++)
    {
      uint32_t pivot = c;
      while (pivot < n && m[(size_t)pivot * n + c] == 0)
        pivot++;
      if (pivot == n)
        return 0;
      for (uint32_t j = c; pivot != c && j < n; j++)
        {
          uint64_t swap = m[(size_t)c * n + j];
          m[(size_t)c * n + j] = m[(size_t)pivot * n + j];
          m[(size_t)pivot * n + j] = swap;
        }
      product
          = times (product, pivot == c ? m[(size_t)c * n + c] : minus (0, m[(size_t)c * n + c]));
      uint64_t by = modular_inverse (m[(size_t)c * n + c]);
      for (uint32_t i = c + 1; i < n; i++)
        {
          uint64_t factor = times (m[(size_t)i * n + c], by);
          for (uint32_t j = c; factor && j < n; j++)
            m[(size_t)i * n + j]
                = minus (m[(size_t)i * n + j], times (factor, m[(size_t)c * n + j]));
        }
    }
  return product;
}

static uint64_t
polynomial (bt__knot *k, uint64_t t)
{
  if (k->crossings < 3)
    return 1;
  fill_matrix (k, t);
  return determinant (k);
}

/* ---- Asking ---- */

static int
ask_polynomial (bt__knot *k, bt__knot_value *v)
{
  make_simpler (k);
  turn_about (k);
  if (!find_knot_crossings (k))
    return 0;
  uint64_t d = polynomial (k, PRIME - 1);
  v->crossings = k->crossings;
  v->determinant = d > PRIME / 2 ? PRIME - d : d;
  v->at2 = times (polynomial (k, 2), polynomial (k, modular_inverse (2)));
  v->at3 = times (polynomial (k, 3), polynomial (k, modular_inverse (3)));
  v->knotted = v->determinant != 1 || v->at2 != 1 || v->at3 != 1;
  return !bt__ask (k->asker);
}

int
bt__knot_of_closed (bt__knot *k, const bt_vec3 *p, uint32_t n, bt__knot_value *value)
{
  if (n < 3 || n > k->room)
    return 0;
  memcpy (k->p, p, n * sizeof *p);
  k->n = n;
  return ask_polynomial (k, value);
}

int
bt__knot_of (bt__knot *k, const bt_vec3 *p, uint32_t n, bt__knot_value *value)
{
  bt_vec3 middle = bt__vec (0, 0, 0), up = bt__vec (0, 0, 1);
  double size = 0;
  if (n < 2 || n + 3 > k->room)
    return 0;
  for (uint32_t i = 0; i < n; i++)
    middle = bt__axpy (middle, 1.0 / n, p[i]);
  for (uint32_t i = 0; i < n; i++)
    size = fmax (size, bt__distance (middle, p[i]));
  bt_vec3 a = bt__unit_or (bt__sub (p[0], middle), up);
  bt_vec3 b = bt__unit_or (bt__sub (p[n - 1], middle), up), c = bt__add (a, b);
  /* The ends go straight out; between them the way is at least half as far.  */
  c = bt__norm (c) > 0.5 ? bt__unit_or (c, up) : bt__across (a);
  memcpy (k->p, p, n * sizeof *p);
  k->p[n] = bt__axpy (p[n - 1], 30 * size, b);
  k->p[n + 1] = bt__axpy (middle, 100 * size, c);
  k->p[n + 2] = bt__axpy (p[0], 30 * size, a);
  k->n = n + 3;
  return ask_polynomial (k, value);
}

bt_status
bt__knot_new (uint32_t nodes, bt__knot **out, bt_error *error)
{
  bt__knot *k = calloc (1, sizeof *k);
  *out = NULL;
  if (k)
    {
      k->room = nodes + 3;
      k->p = malloc (k->room * sizeof *k->p);
    }
  if (!k || !k->p)
    {
      bt__knot_free (k);
      return bt__fail (error, BT_ERR_LIMIT, "no memory for a line of %u nodes", (unsigned)nodes);
    }
  *out = k;
  return BT_OK;
}

void
bt__knot_ask (bt__knot *k, bt__asker *asker)
{
  k->asker = asker;
}

void
bt__knot_free (bt__knot *k)
{
  if (k)
    free (k->p);
  free (k);
}
