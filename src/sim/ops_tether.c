/* Operations on a tether: the winch and the knife.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <math.h>

#include "sim/ops.h"
#include "sim/sim.h"

static bt_status
spool (const bt__call *c, double sign)
{
  bt__tether *tether = bt__dive_tether (c->dive, c->state, c->subject);
  double target = tether->length + sign * c->args[0];
  double most = bt__most_out (c->dive, c->state, c->subject);
  if (bt__check_range (c, 0, "metres to spool", 0, 1e6) != BT_OK
      || bt__check_range (c, 1, "a rate in m/s", 1e-6, 1000) != BT_OK)
    return BT_ERR_DOMAIN;
  if (target > most)
    return bt__fail (c->error, BT_ERR_DOMAIN,
                     "%g m are out: of all that was on the drum, %g m can be", tether->length,
                     most);
  if (sign < 0 && tether->parted) /* no more comes in than there is */
    target = fmax (target, fmin (tether->length, BT__HOME_LENGTH));
  if (target <= 0 || target > BT_LENGTH_MAX)
    return bt__fail (c->error, BT_ERR_DOMAIN, "%g m are out: it cannot be made %g m",
                     tether->length, target);
  tether->winch_target = target;
  tether->stalling = 0;
  tether->winch_rate = target == tether->length ? 0 : sign * c->args[1];
  return BT_OK;
}

/* A cut leaves at least this share of an interval to either side: a shorter stub would bear forces
   of its own making.  */
#define SHORTEST 0.2

/* Where CHAIN is cut for S metres to be left: at a node that is near, else in interval *J, at the
   share returned.  */
static double
place_of_cut (const bt__dynamic *chain, double s, int *j)
{
  double start, share;
  *j = bt__dynamic_interval (chain, s, &start);
  share = (s - start) / bt__dynamic_rest (chain)[*j];
  if (share > 1 - SHORTEST && *j < chain->n - 1)
    return 1;
  if (share >= SHORTEST || *j == 0)
    return fmin (fmax (share, SHORTEST), 1 - SHORTEST);
  --*j;
  return 1;
}

/* Cut the line at an arc length; of a parted one the part at the anchor.  */
bt_status
bt__op_cut (const bt__call *c)
{
  bt__tether *tether = bt__dive_tether (c->dive, c->state, c->subject);
  bt__dynamic *chain = bt__dive_chain (c->dive, c->state, c->subject, 0);
  double s = c->args[0], share;
  int j;
  if (!bt__is_cable (tether))
    return bt__fail (c->error, BT_ERR_UNSUPPORTED,
                     "only a tether moved by the model `dynamic' can be cut");
  if (!(s >= 0 && s <= tether->length))
    return bt__fail (c->error, BT_ERR_DOMAIN, "a place to cut lies in 0 to %g m, not %g",
                     tether->length, s);
  share = place_of_cut (chain, s, &j);
  bt__part_chain (c->dive, c->state, c->subject, 0, j, share);
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
