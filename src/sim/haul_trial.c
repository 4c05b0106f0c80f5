/* A haul on a fork: a dead vehicle at the end of the moving line, and a winch with limited pull.

   A kinematic vehicle becomes a dead body in the trial.  The winch keeps its limit by itself
   (winch.c); after a stall the winch is turned on again as soon as the line pulls less.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <math.h>
#include <string.h>

#include <bight/aware.h>
#include <bight/contact.h>
#include <bight/verbs.h>

#include "base/error.h"
#include "math/vec.h"
#include "sim/sim.h"
#include "world/line.h"

#define HOME_WITHIN 1.5 /* m, beyond the hull */
#define LEAST_OUT 0.5   /* m */
#define RESUMES 0.9     /* of the limit: the winch turns again when the line pulls less */
#define STUCK_WAY 0.15  /* m: less ... */
#define STUCK_TIME 20.0 /* s: ... in so long is stuck */
#define AT_HULL 0.03    /* m: so near to the hull it is what holds it */

/* ---- The fork ---- */

static bt_status
make_moving (bt_dive *fork, int i, bt_error *error)
{
  if (bt__is_moving_model (bt__dive_tether (fork, fork->now, i)))
    return BT_OK;
  return bt_part_choose (fork, BT_PART_TETHER, i, "model", "dynamic", error);
}

static bt_status
make_trial (const bt_dive *dive, int i, double winch, bt_dive **out, bt_error *error)
{
  int vehicle = dive->model->ends[i][1].vehicle;
  bt_status status = bt_dive_fork (dive, out, error);
  if (status != BT_OK)
    return status;
  bt_dive_set_poll (*out, dive->asker.poll, dive->asker.user);
  status = bt_vehicle_release (*out, vehicle, error);
  if (status == BT_OK)
    status = make_moving (*out, i, error);
  if (status != BT_OK)
    {
      bt_dive_free (*out);
      return status;
    }
  bt__deaden_vehicle (bt__dive_vehicle (*out, (*out)->now, vehicle));
  bt__dive_tether (*out, (*out)->now, i)->props.winch_pull = winch;
  return BT_OK;
}

/* ---- The haul ---- */

typedef struct trial
{
  bt_dive *fork;
  int tether, vehicle;
  double rate, winch; /* m/s, N */
  double least;       /* m: home */
  bt_vec3 there;      /* where the vehicle was when it last moved on */
  double since;       /* s */
} trial;

static bt_vec3
vehicle_at (const trial *t)
{
  return bt__dive_vehicle (t->fork, t->fork->now, t->vehicle)->position;
}

static bt__line
trial_line (const trial *t)
{
  return bt__line_of (t->fork, t->fork->now, t->tether);
}

/* Turn the winch again when it stands and the line pulls less.  */
static bt_status
turn_winch_again (const trial *t, bt_error *error)
{
  bt__line line = trial_line (t);
  double metres = line.tether->length - LEAST_OUT;
  if (line.tether->winch_rate != 0 || !(metres > 0)
      || bt__line_tension (&line, 0) > RESUMES * t->winch)
    return BT_OK;
  return bt_tether_haul_in (t->fork, t->tether, &(bt_spooling){ metres, t->rate }, error);
}

static int
is_home (const trial *t)
{
  bt__line line = trial_line (t);
  return bt__distance (bt__line_node (&line, 0), vehicle_at (t)) < t->least;
}

static int
is_parted (const trial *t)
{
  return trial_line (t).tether->parted != 0;
}

static int
trial_is_stuck (trial *t, double now)
{
  bt_vec3 here = vehicle_at (t);
  if (bt__distance (here, t->there) > STUCK_WAY)
    {
      t->there = here;
      t->since = now;
    }
  return now - t->since > STUCK_TIME;
}

/* True while the line still comes in slack: nothing pulls at the vehicle yet.  */
static int
is_slack (const trial *t)
{
  bt__line line = trial_line (t);
  return bt__line_tension (&line, 0) < fmin (t->winch, 5)
         && bt__norm (bt__line_pull (&line, 1)) < 1;
}

static void
look_for_culprit (const trial *t, bt_haul *out)
{
  bt_clearance near;
  bt_contact contact;
  out->object = -1;
  if (bt_vehicle_clearance (t->fork, t->vehicle, -1, &near, NULL) == BT_OK
      && near.distance < AT_HULL)
    {
      out->object = near.object;
      out->hull = 1;
    }
  else if (bt_tether_contacts (t->fork, t->tether, &contact, 1) > 0 && !contact.tail)
    out->object = contact.object;
}

static bt_status
haul_until_end (trial *t, double seconds, bt_haul *out, bt_error *error)
{
  bt_status status = BT_OK;
  double begin = bt_dive_time (t->fork), now = 0;
  t->there = vehicle_at (t);
  out->home = is_home (t);
  while (!out->home && !out->parted && now < seconds)
    {
      status = turn_winch_again (t, error);
      if (status == BT_OK)
        status = bt_dive_step (t->fork, error);
      if (status == BT_OK)
        status = bt__poll (t->fork, now / seconds, error);
      if (status != BT_OK)
        return status;
      now = bt_dive_time (t->fork) - begin;
      out->home = is_home (t);
      out->parted = is_parted (t);
      if (is_slack (t))
        t->since = now;
      if (trial_is_stuck (t, now))
        break;
    }
  bt__line line = trial_line (t);
  out->seconds = now;
  out->left = bt__line_length (&line);
  out->at = vehicle_at (t);
  out->pull = bt__line_tension (&line, 0);
  if (!out->home)
    look_for_culprit (t, out);
  return BT_OK;
}

static bt_status
check_trial (const bt_dive *dive, int i, double rate, double winch, double seconds, bt_error *error)
{
  bt_status status = bt__check_part (dive, BT_PART_TETHER, i, error);
  if (status != BT_OK)
    return status;
  if (!(rate > 0 && winch > 0 && seconds >= 0 && seconds <= 1e5))
    return bt__fail (error, BT_ERR_DOMAIN,
                     "a haul has a rate and a pull above 0 and 0 to 1e5 s, not %g m/s, %g N, %g s",
                     rate, winch, seconds);
  if (dive->model->ends[i][1].vehicle < 0)
    return bt__fail (error, BT_ERR_UNSUPPORTED, "no vehicle is at the far end of `%s' to be hauled",
                     dive->model->tethers[i].name);
  if (bt__dive_tether (dive, dive->now, i)->parted)
    return bt__fail (error, BT_ERR_UNSUPPORTED, "`%s' has parted: nothing hangs from its winch",
                     dive->model->tethers[i].name);
  return BT_OK;
}

bt_status
bt_tether_haul (const bt_dive *dive, int i, double rate, double winch, double seconds, bt_haul *out,
                bt_error *error)
{
  bt_status status = check_trial (dive, i, rate, winch, seconds, error);
  trial t = { .tether = i, .rate = rate, .winch = winch };
  if (status == BT_OK)
    status = make_trial (dive, i, winch, &t.fork, error);
  if (status != BT_OK)
    return status;
  t.vehicle = dive->model->ends[i][1].vehicle;
  t.least = 0.5 * bt__norm (dive->model->vehicles[t.vehicle].size) + HOME_WITHIN;
  memset (out, 0, sizeof *out);
  out->object = -1;
  status = haul_until_end (&t, seconds, out, error);
  bt_dive_free (t.fork);
  return status;
}
