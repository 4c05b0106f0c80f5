/* Orders: operations that change what a vehicle is told, and move nothing.

   Sticks, autopilots and faults are members of one vehicle.  While every tether rests, which means
   that no operation would solve one anew, an order is therefore written to the present state
   itself: no state is copied, however large the dive is.  While a tether does not rest, as a static
   shape does not in waves or before it has settled, the order is an operation like all others
   (ops.c), and solves such tethers.  Both ways leave the same bits.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include "sim/around.h"
#include "sim/form_step.h"
#include "sim/ops.h"
#include "world/watch.h"

static int
rests (const bt_dive *dive, bt__state *state, int i)
{
  const bt__tether *tether = bt__dive_tether (dive, state, i);
  bt__ends ends = bt__tether_ends (dive, state, i);
  if (!bt__are_ends (&ends, &tether->shape) || !bt__holds_ends (dive, state, i))
    return 0;
  bt__tether_form wanted = bt__wanted_form (dive, tether);
  return bt__tether_form_of (tether) == wanted && (wanted == BT__TETHER_CABLE || !tether->parted)
         && bt__form_step_of (wanted)->rests (dive, state, i, &ends);
}

/* True if an operation that moves nothing would solve no tether of STATE anew.  */
static int
all_rest (const bt_dive *dive, bt__state *state)
{
  for (int i = 0; i < dive->model->n_tethers; i++)
    if (!rests (dive, state, i))
      return 0;
  return 1;
}

/* What is noted of tethers that an operation leaves as they are.  */
static void
note_unmoved (bt_dive *dive, bt__state *state)
{
  for (int i = 0; i < dive->model->n_tethers; i++)
    if (bt__is_moving_model (bt__dive_tether (dive, state, i)))
      bt__note_pull (dive, state, i);
    else
      dive->profile.shape_skips++;
}

static bt_status
write_order (const bt__call *c, bt_status (*apply) (const bt__call *c))
{
  bt_status status = bt__watch_make_ready (c->dive, c->error);
  if (status == BT_OK)
    status = apply (c);
  if (status != BT_OK)
    return status;
  bt__wake_lines (c);
  note_unmoved (c->dive, c->state);
  return BT_OK;
}

bt_status
bt__give_order (const bt__call *c, bt_op which, bt_status (*apply) (const bt__call *c))
{
  return all_rest (c->dive, c->state)
             ? write_order (c, apply)
             : bt__operate_on_copy (c->dive, which, c->subject, c->args, c->n, c->error);
}
