/* The polyline: laying, inserting, asking.  How it moves is in polyline_move.c.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <stdlib.h>
#include <string.h>

#include "base/error.h"
#include "contact/polyline.h"

/* ---- Scratch ---- */

void
bt__polyline_work_free (bt__polyline_work *w)
{
  if (!w)
    return;
  free (w->want);
  free (w->trial);
  free (w->leg);
  free (w->arc);
  free (w->share);
  free (w->spare);
  free (w->near);
  free (w->still);
  free (w);
}

bt_status
bt__polyline_work_new (uint32_t room, uint32_t movers, bt__polyline_work **out, bt_error *error)
{
  bt__polyline_work *w = calloc (1, sizeof *w);
  size_t n = (size_t)room + 1;
  if (w)
    {
      w->room = room;
      w->movers = movers;
      w->want = calloc (n, sizeof *w->want);
      w->trial = calloc (n, sizeof *w->trial);
      w->leg = calloc (n, sizeof *w->leg);
      w->arc = calloc (n, sizeof *w->arc);
      w->share = calloc (n, sizeof *w->share);
      w->spare = calloc (n, sizeof *w->spare);
      w->near = calloc (BT__PARTS_MAX, sizeof *w->near);
      w->still = calloc ((size_t)movers + 1, sizeof *w->still);
    }
  if (!w || !w->want || !w->trial || !w->leg || !w->arc || !w->share || !w->spare || !w->near
      || !w->still)
    {
      bt__polyline_work_free (w);
      return bt__fail (error, BT_ERR_LIMIT, "no memory for a tether of %u nodes among obstacles",
                       (unsigned)room);
    }
  *out = w;
  return BT_OK;
}

/* ---- Laying ---- */

static void
append_point (bt__polyline *line, bt_vec3 x, double u)
{
  bt__polyline_x (line)[line->n] = x;
  bt__polyline_u (line)[line->n++] = u;
}

/* The nodes strictly within the straight piece from P at arc U to Q at arc V.  */
static void
lay_piece (bt__polyline *line, bt_vec3 p, double u, bt_vec3 q, double v, double length,
           uint32_t nodes)
{
  double h = length / nodes, same = BT__SAME * length;
  for (uint32_t k = (uint32_t)(u / h); k < nodes; k++)
    {
      double s = k * h;
      if (s >= v - same)
        break;
      if (s > u + same)
        append_point (line, bt__axpy (p, (s - u) / (v - u), bt__sub (q, p)), s);
    }
}

bt_status
bt__polyline_lay (bt__polyline *line, uint32_t room, const bt_vec3 *points, uint32_t n,
                  double length, uint32_t nodes, bt_error *error)
{
  double way = bt__length (points, n), u = 0;
  if (n < 2 || nodes < 1 || !isfinite (way) || !(length > 0 && isfinite (length))
      || way > length * (1 + BT__SAME))
    return bt__fail (error, BT_ERR_DOMAIN, "a tether of %g m cannot lie along a way of %g m",
                     length, way);
  if (room < nodes + n - 1)
    return bt__fail (error, BT_ERR_LIMIT, "a tether of %u nodes has no room for %u corners",
                     (unsigned)nodes, (unsigned)n - 2);
  memset (line, 0, bt__polyline_size (room));
  line->room = room;
  for (uint32_t i = 0; i + 1 < n; i++)
    {
      double d = bt__distance (points[i], points[i + 1]);
      double v = way > 0 ? u + d * (length / way) : length * (i + 1) / (n - 1);
      if (i + 2 == n)
        v = length;
      append_point (line, points[i], u);
      lay_piece (line, points[i], u, points[i + 1], v, length, nodes);
      u = v;
    }
  append_point (line, points[n - 1], length);
  return BT_OK;
}

/* ---- Nodes ---- */

/* The link that holds arc length S, clamped.  */
static int64_t
link_at_arc (const bt__polyline *line, double s)
{
  const double *u = bt__polyline_u ((bt__polyline *)line);
  int64_t lo = 0, hi = line->n - 1;
  while (hi - lo > 1)
    {
      int64_t mid = (lo + hi) / 2;
      if (u[mid] <= s)
        lo = mid;
      else
        hi = mid;
    }
  return lo;
}

int64_t
bt__polyline_insert (bt__polyline *line, double s, double grain)
{
  bt_vec3 *x = bt__polyline_x (line);
  double *u = bt__polyline_u (line);
  int64_t j = link_at_arc (line, s), i = j + 1;
  if (fabs (u[j] - s) <= grain)
    return j;
  if (fabs (u[i] - s) <= grain)
    return i;
  if (line->n >= line->room)
    return -1;
  bt_vec3 p = bt__polyline_point (line, s);
  memmove (x + i + 1, x + i, (size_t)(line->n - i) * sizeof *x);
  memmove (u + i + 1, u + i, (size_t)(line->n - i) * sizeof *u);
  x[i] = p;
  u[i] = s;
  line->n++;
  return i;
}

void
bt__polyline_remove (bt__polyline *line, int64_t i)
{
  bt_vec3 *x = bt__polyline_x (line);
  double *u = bt__polyline_u (line);
  memmove (x + i, x + i + 1, (size_t)(line->n - i - 1) * sizeof *x);
  memmove (u + i, u + i + 1, (size_t)(line->n - i - 1) * sizeof *u);
  line->n--;
  x[line->n] = bt__vec (0, 0, 0);
  u[line->n] = 0;
}

/* ---- Asking ---- */

bt_vec3
bt__polyline_point (const bt__polyline *line, double s)
{
  int64_t j = link_at_arc (line, s);
  const bt_vec3 *x = bt__polyline_x ((bt__polyline *)line) + j;
  const double *u = bt__polyline_u ((bt__polyline *)line) + j;
  return bt__axpy (x[0], bt__share (s - u[0], u[1] - u[0]), bt__sub (x[1], x[0]));
}

bt_vec3
bt__polyline_tangent (const bt__polyline *line, double s)
{
  const bt_vec3 *x = bt__polyline_x ((bt__polyline *)line) + link_at_arc (line, s);
  return bt__unit_or (bt__sub (x[1], x[0]), bt__vec (0, 0, -1));
}
