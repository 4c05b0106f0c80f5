/* What may be done to a tether: the winch and the knife.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include "sim/ops.h"

static bt_status
spool (const bt__call *c, double sign)
{
  bt__tether *tether = bt__dive_tether (c->dive, c->state, c->subject);
  double target = tether->length + sign * c->args[0];
  double drum = c->dive->model->tethers[c->subject].drum;
  if (bt__check_range (c, 0, "metres to spool", 0, 1e6) != BT_OK
      || bt__check_range (c, 1, "a rate in m/s", 1e-6, 1000) != BT_OK)
    return BT_ERR_DOMAIN;
  if (target > drum)
    return bt__fail (c->error, BT_ERR_DOMAIN, "%g m are out: the drum holds %g m", tether->length,
                     drum);
  if (target <= 0 || target > 1e6)
    return bt__fail (c->error, BT_ERR_DOMAIN, "%g m are out: it cannot be made %g m",
                     tether->length, target);
  tether->winch_target = target;
  tether->winch_rate = target == tether->length ? 0 : sign * c->args[1];
  return BT_OK;
}

/* Cut the line at an arc length.  */
bt_status
bt__op_cut (const bt__call *c)
{
  bt__tether *tether = bt__dive_tether (c->dive, c->state, c->subject);
  bt__dynamic *chain = bt__dive_chain (c->dive, c->state, c->subject, 0);
  double s = c->args[0];
  int j = 0;
  if (tether->shape.form != BT__FORM_CHAIN)
    return bt__fail (c->error, BT_ERR_UNSUPPORTED,
                     "only a tether moved by the model `dynamic' can be cut");
  if (tether->parted)
    return bt__fail (c->error, BT_ERR_UNSUPPORTED, "the tether has parted already");
  if (!(s >= 0 && s <= tether->length))
    return bt__fail (c->error, BT_ERR_DOMAIN, "a place to cut lies in 0 to %g m, not %g",
                     tether->length, s);
  for (; j < chain->n - 1 && s > bt__dynamic_rest (chain)[j]; j++)
    s -= bt__dynamic_rest (chain)[j];
  bt__part_chain (c->dive, c->state, c->subject, j);
  return BT_OK;
}

bt_status
bt__op_pay_out (const bt__call *c)
{
  return spool (c, 1);
}

bt_status
bt__op_haul_in (const bt__call *c)
{
  return spool (c, -1);
}
