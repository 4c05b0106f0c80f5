/* The form of a moving line: a chain of nodes and elastic intervals; two
   chains of a parted line.

   Forces and tensions at nodes are those of the last step.  The near chain answers questions along
   the line, the far chain tells the force on what the far end is fastened to.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <math.h>

#include "math/vec.h"
#include "world/form.h"
#include "world/layout.h"

/* ---- Ahead of the present ---- */

/* The share of its stretch at which TETHER was BEFORE ticks ago.  */
static double
share_gone (const bt__tether *tether, int64_t before)
{
  return (double)(tether->stretch.gone - before) / (double)tether->stretch.span;
}

bt_vec3
bt__pull_within (const bt_dive *dive, bt__state *state, int i, int k)
{
  const bt__tether *tether = bt__dive_tether (dive, state, i);
  bt_vec3 begun = tether->stretch.pull[k], is = bt__dive_chain (dive, state, i, 1)->pull[k];
  return bt__axpy (begun, share_gone (tether, 0), bt__sub (is, begun));
}

/* Lead the ends of a chain told within a stretch; give the chain pulls, and no contacts.  */
static void
tell_rest (const bt_dive *dive, bt__state *state, int i)
{
  const bt__tether *tether = bt__dive_tether (dive, state, i);
  const bt_vec3 end[2] = { tether->shape.a, tether->shape.b };
  bt__dynamic *chain = bt__dive_chain (dive, state, i, 0);
  bt__dynamic_lead_ends (chain, end);
  for (int k = 0; k < 2; k++)
    chain->pull[k] = bt__pull_within (dive, state, i, k);
  bt__contacts_init (bt__dive_anchors (dive, state, i, 0),
                     bt__contact_room (dive->model, &dive->model->tethers[i]));
}

void
bt__show_chain (const bt_dive *dive, bt__state *state, int i)
{
  const bt__tether *tether = bt__dive_tether (dive, state, i);
  if (!bt__is_ahead (tether))
    return;
  bt__dynamic_between (bt__dive_chain (dive, state, i, 1), share_gone (tether, 0),
                       bt__dive_chain (dive, state, i, 0));
  tell_rest (dive, state, i);
}

void
bt__leave_stretch (const bt_dive *dive, bt__state *state, int i)
{
  bt__tether *tether = bt__dive_tether (dive, state, i);
  if (!bt__is_ahead (tether))
    return;
  bt__store_changes (dive, i);
  bt__dynamic_resume (bt__dive_chain (dive, state, i, 1), share_gone (tether, 1),
                      share_gone (tether, 0), bt__dive_chain (dive, state, i, 0));
  tell_rest (dive, state, i);
  tether->stretch = (bt__stretch){ .wait = bt__next_wait (&tether->stretch) };
}

const bt__dynamic *
bt__chain_in_use (const bt_dive *dive, bt__state *state, int i)
{
  return bt__dive_chain (dive, state, i, bt__is_ahead (bt__dive_tether (dive, state, i)));
}

static void
cable_find (const bt_dive *dive, bt__state *state, int i, bt__line *line)
{
  bt__show_chain (dive, state, i);
  int far = line->tether->parted ? 1 : 0;
  line->chain = bt__dive_chain (dive, state, i, 0);
  line->far_chain = bt__dive_chain (dive, state, i, far);
  line->contacts = bt__dive_anchors (dive, state, i, 0);
  line->far_contacts = bt__dive_anchors (dive, state, i, far);
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
  double radius = 0.5 * line->tether->props.diameter;
  return bt__line_arc_point (line->chain, line->contacts, radius, s);
}

/* The direction between two points a hundredth of an interval to either side.  */
static bt_vec3
cable_tangent (const bt__line *line, double s)
{
  const bt__dynamic *chain = line->chain;
  double length = bt__dynamic_length (chain), e = 0.01 * length / (double)chain->n;
  bt_vec3 a = cable_point (line, fmax (s - e, 0)), b = cable_point (line, fmin (s + e, length));
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

double
bt__largest_tension (const bt__dynamic *chain)
{
  const double *t = bt__dynamic_tension (chain);
  double most = 0;
  for (int64_t j = 0; j < chain->n; j++)
    most = t[j] > most ? t[j] : most; /* fmax would be a call for each */
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
  return fmax (ends,
               fmax (bt__largest_tension (line->chain), bt__largest_tension (line->far_chain)));
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
  (void)dive;
  (void)i;
  return bt__line_touches (line->chain, line->contacts, touch, room);
}

static const bt_vec3 *
cable_laid (const bt_dive *dive, bt__state *state, int i, int *n)
{
  bt__show_chain (dive, state, i);
  const bt__dynamic *chain = bt__dive_chain (dive, state, i, 0);
  *n = (int)chain->n + 1;
  return bt__dynamic_x (chain);
}

/* ---- Its store ---- */

/* The chains in use of TETHER are those from here on, less than the other.  */
static int
first_chain (const bt__tether *tether)
{
  return bt__is_ahead (tether);
}

static int
end_of_chains (const bt__tether *tether)
{
  return bt__is_ahead (tether) ? 2 : bt__chains (tether);
}

static int
cable_ranges (const bt_dive *dive, const bt__state *state, int i, bt__range *out)
{
  const bt__tether *tether = bt__dive_tether (dive, (bt__state *)state, i);
  int n = 0;
  for (int part = first_chain (tether); part < end_of_chains (tether); part++)
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

static int
is_sound_stretch (const bt__tether *tether)
{
  const bt__stretch *s = &tether->stretch;
  return s->span == 0 || (s->gone > 0 && s->gone < s->span && !tether->parted);
}

static bt_status
cable_judge (bt__judge *judge, const bt_dive *dive, bt__state *state, int i)
{
  const bt_tether_def *def = &dive->model->tethers[i];
  const bt__tether *tether = bt__dive_tether (dive, state, i);
  bt_status status = bt__judge_that (judge, is_sound_stretch (tether),
                                     "a long step that is not over, of a line in one piece");
  for (int part = first_chain (tether); part < end_of_chains (tether); part++)
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
