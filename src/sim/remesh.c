/* Model `auto': the moving line with as many nodes as its accuracy wants.

   The error that comes of the number of nodes is estimated from the bends of the line, and falls
   with its square.  The line is laid anew on more nodes when the estimate exceeds what is accepted,
   and on fewer when it is far below, the gap between keeping it from going to and fro.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <math.h>
#include <string.h>

#include "math/vec.h"
#include "sim/around.h"
#include "sim/lay.h"
#include "world/line.h"

/* What is aimed at and when nodes are saved, of the accuracy: an error made once is carried on, in
   still water for long, so the estimate of the moment is kept well below what is accepted.  */
#define AIM 0.3
#define TOO_GOOD 0.06
#define SPARE 1.15 /* times the nodes the estimate asks for */
enum
{
  FEWEST = 8
};

/* How many intervals the chain of N with the estimated ERROR should have, at most ROOM.  */
static int
wanted (int n, double error, double accuracy, int room)
{
  double ideal = SPARE * n * sqrt (error / (AIM * accuracy));
  if (error <= AIM * accuracy && error >= TOO_GOOD * accuracy)
    return n;
  return (int)fmax (FEWEST, fmin (room, ceil (ideal)));
}

/* Among obstacles a line is refined by whole multiples: its nodes stay.  */
static int
multiple (int n, int m, int room)
{
  int times = (m + n - 1) / n;
  return m < n ? m : times * n <= room ? times * n : n;
}

/* Take N + 1 points, velocities and tensions off LINE.  */
static void
sample (bt_dive *dive, const bt__line *line, int n)
{
  double length = bt__line_length (line);
  for (int k = 0; k <= n; k++)
    {
      double s = length * k / n;
      dive->polyline[k] = bt__dynamic_point (line->chain, s);
      dive->motion[k] = bt__dynamic_velocity (line->chain, s);
      dive->along[k] = bt__line_tension (line, length * fmin (k + 0.5, n) / n);
    }
}

static bt_status
lay_anew (bt_dive *dive, bt__state *state, int i, int n, bt_error *error)
{
  bt__line line = bt__line_of (dive, state, i);
  bt__tether *tether = bt__dive_tether (dive, state, i);
  bt__dynamic *chain = bt__dive_chain (dive, state, i, 0);
  bt_vec3 pull[2] = { chain->pull[0], chain->pull[1] };
  double length = bt__line_length (&line);
  bt_status status;
  sample (dive, &line, n);
  if (bt__has_obstacles (dive) && !bt__may_remesh (dive, state, i, n))
    return BT_OK;
  status = bt__dynamic_init (chain, bt__chain_room (&dive->model->tethers[i]), n, dive->polyline,
                             n + 1, length, tether->props.ea, error);
  if (status != BT_OK)
    return status;
  memcpy (bt__dynamic_v (chain), dive->motion, sizeof (bt_vec3) * (size_t)(n + 1));
  memcpy (bt__dynamic_tension (chain), dive->along, sizeof (double) * (size_t)n);
  chain->pull[0] = pull[0];
  chain->pull[1] = pull[1];
  dive->profile.chain_remeshes++;
  return BT_OK;
}

bt_status
bt__remesh_chain (bt_dive *dive, bt__state *state, int i, bt_error *error)
{
  const bt__tether *tether = bt__dive_tether (dive, state, i);
  const bt__dynamic *chain = bt__dive_chain (dive, state, i, 0);
  int n = (int)chain->n, room = bt__chain_room (&dive->model->tethers[i]);
  int m = wanted (n, bt__chain_error (chain), tether->props.accuracy, room);
  if (bt__has_obstacles (dive))
    m = multiple (n, m, room);
  return tether->parted || m == n ? BT_OK : lay_anew (dive, state, i, m, error);
}
