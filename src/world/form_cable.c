/* The form of a moving line: a chain of nodes and elastic intervals; two
   chains of a parted line.

   Forces and tensions at nodes are those of the last step.  The near chain answers questions along
   the line, the far chain tells the force on what the far end is fastened to.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <math.h>

#include "math/vec.h"
#include "world/form.h"
#include "world/layout.h"

static void
cable_find (const bt_dive *dive, bt__state *state, int i, bt__line *line)
{
  line->chain = bt__dive_chain (dive, state, i, 0);
  line->far_chain = bt__dive_chain (dive, state, i, line->tether->parted ? 1 : 0);
}

/* ---- Anywhere along the line ---- */

static double
cable_length (const bt__line *line)
{
  return bt__dynamic_length (line->chain);
}

static bt_vec3
cable_point (const bt__line *line, double s)
{
  return bt__dynamic_point (line->chain, s);
}

/* The direction between two points a hundredth of an interval to either side.  */
static bt_vec3
cable_tangent (const bt__line *line, double s)
{
  const bt__dynamic *chain = line->chain;
  double length = bt__dynamic_length (chain), e = 0.01 * length / (double)chain->n;
  bt_vec3 a = bt__dynamic_point (chain, fmax (s - e, 0));
  bt_vec3 b = bt__dynamic_point (chain, fmin (s + e, length));
  return bt__unit_or (bt__sub (b, a), bt__vec (0, 0, -1));
}

/* Between the tensions of the nodes to either side.  */
static double
cable_tension (const bt__line *line, double s)
{
  const bt__dynamic *chain = line->chain;
  const double *rest = bt__dynamic_rest (chain);
  int i = 0, last = (int)chain->n - 1;
  double k, t0, t1;
  s = bt__dynamic_along (chain, s);
  for (; i < last && s > rest[i]; i++)
    s -= rest[i];
  k = fmax (0, fmin (1, s / rest[i]));
  t0 = bt__dynamic_node_tension (chain, i);
  t1 = bt__dynamic_node_tension (chain, i + 1);
  return t0 + k * (t1 - t0);
}

static double
largest_in_chain (const bt__dynamic *chain)
{
  const double *t = bt__dynamic_tension (chain);
  double most = 0;
  for (int64_t j = 0; j < chain->n; j++)
    most = fmax (most, t[j]);
  return most;
}

static bt_vec3
cable_pull (const bt__line *line, int k)
{
  return k == 1 ? line->far_chain->pull[1] : line->chain->pull[0];
}

/* The ends of a moving line bear the loads of half an interval more than the last tension.  */
static double
cable_tension_max (const bt__line *line)
{
  double ends = fmax (cable_tension (line, 0), bt__norm (cable_pull (line, 1)));
  ends = fmax (ends, line->tether->peak);
  return fmax (ends, fmax (largest_in_chain (line->chain), largest_in_chain (line->far_chain)));
}

/* ---- Its nodes ---- */

static bt_vec3
cable_end (const bt__line *line, int k)
{
  return k == 0 ? bt__dynamic_x (line->chain)[0]
                : bt__dynamic_x (line->far_chain)[line->far_chain->n];
}

static int
cable_nodes (const bt__line *line)
{
  return (int)line->chain->n + 1;
}

static bt_vec3
cable_node (const bt__line *line, int k)
{
  return bt__dynamic_x (line->chain)[k];
}

static double
cable_node_tension (const bt__line *line, int k)
{
  return bt__dynamic_node_tension (line->chain, k);
}

static int
cable_touches (const bt_dive *dive, int i, const bt__line *line, bt__touch *touch, int room)
{
  return bt__line_touches (line->chain, bt__dive_anchors (dive, dive->now, i, 0), touch, room);
}

static const bt_vec3 *
cable_laid (const bt_dive *dive, bt__state *state, int i, int *n)
{
  const bt__dynamic *chain = bt__dive_chain (dive, state, i, 0);
  *n = (int)chain->n + 1;
  return bt__dynamic_x (chain);
}

/* ---- Its store ---- */

static int
cable_ranges (const bt_dive *dive, const bt__state *state, int i, bt__range *out)
{
  const bt__tether *tether = bt__dive_tether (dive, (bt__state *)state, i);
  int n = 0;
  for (int part = 0; part < bt__chains (tether); part++)
    {
      size_t at = (size_t)part * dive->line[i].part, chain = dive->line[i].chain;
      size_t anchors = bt__contacts_live (bt__dive_anchors (dive, (bt__state *)state, i, part));
      bt__dynamic_in_use (bt__dive_chain (dive, (bt__state *)state, i, part)->n,
                          bt__chain_room (&dive->model->tethers[i]), out + n);
      for (int k = 0; k < BT__DYNAMIC_RANGES; k++)
        out[n++].at += at;
      out[n++] = (bt__range){ at + chain, anchors };
    }
  return n;
}

static bt_status
cable_judge (bt__judge *judge, const bt_dive *dive, bt__state *state, int i)
{
  const bt_tether_def *def = &dive->model->tethers[i];
  bt_status status = BT_OK;
  for (int part = 0; part < bt__chains (bt__dive_tether (dive, state, i)); part++)
    {
      if (status == BT_OK)
        status = bt__dynamic_judge (judge, bt__dive_chain (dive, state, i, part),
                                    bt__chain_room (def));
      if (status == BT_OK)
        status = bt__contacts_judge (judge, bt__dive_anchors (dive, state, i, part),
                                     bt__contact_room (dive->model, def));
    }
  return status;
}

const bt__form bt__form_cable = {
  .find = cable_find,
  .length = cable_length,
  .point = cable_point,
  .tangent = cable_tangent,
  .tension = cable_tension,
  .tension_max = cable_tension_max,
  .end = cable_end,
  .pull = cable_pull,
  .nodes = cable_nodes,
  .node = cable_node,
  .node_tension = cable_node_tension,
  .touches = cable_touches,
  .laid = cable_laid,
  .ranges = cable_ranges,
  .judge = cable_judge,
};
