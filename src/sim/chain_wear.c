/* The wear of a moving line in a dive: the sliding of its contacts in a step, added to the spots of
   its jacket.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <math.h>
#include <string.h>

#include "sim/chain.h"

/* The length of line, m, represented by one contact: an interval, or at a sliding node only the
   part in touch with the edge.  */
static double
span_of (const bt__dynamic *chain, const bt__contact *anchor)
{
  return anchor->bent ? anchor->span : bt__dynamic_length (chain) / (double)chain->n;
}

/* A tether is no rougher than steel.  */
static double
abrasiveness (const bt_dive *dive, int64_t object)
{
  const bt_model *model = dive->model;
  return object >= 0 && object < model->n_obstacles ? model->obstacles[object].abrasiveness : 1;
}

/* Tell once when the limit is reached, and again if it has been raised meanwhile.  */
static void
note_worn (bt__state *state, bt__tether *tether, int i, int64_t object)
{
  int worn = tether->wear >= tether->props.wear_limit * tether->props.wear_energy;
  if (worn && !tether->worn)
    bt__raise_event_at (state, BT_EVENT_WORN, BT_PART_TETHER, i, (int)object);
  tether->worn = worn;
}

static void
chafe (bt_dive *dive, bt__state *state, int i, double from_end, double span,
       const bt__contact *anchor)
{
  bt__tether *tether = bt__dive_tether (dive, state, i);
  bt__wear wear = bt__dive_wear (dive, state, i);
  double work = abrasiveness (dive, anchor->object) * anchor->step_work;
  if (tether->wear == 0)
    memset (wear.spot, 0, (size_t)wear.n * sizeof *wear.spot);
  tether->wear = fmax (tether->wear, bt__wear_add (&wear, from_end, span, work));
  dive->profile.chafes++;
  note_worn (state, tether, i, anchor->object);
}

void
bt__wear_chain (bt_dive *dive, bt__state *state, int i, int part)
{
  const bt__contacts *anchors = bt__dive_anchors (dive, state, i, part);
  const bt__contact *anchor = bt__contacts_at (anchors);
  if (anchors->n == 0)
    return;
  const bt__dynamic *chain = bt__dive_chain (dive, state, i, part);
  double far = part == 0 ? bt__beyond_chain (dive, state, i) : 0;
  for (int64_t k = 0; k < anchors->n; k++)
    if (anchor[k].step_work > 0)
      chafe (dive, state, i, far + anchor[k].from_end, span_of (chain, &anchor[k]), &anchor[k]);
}
