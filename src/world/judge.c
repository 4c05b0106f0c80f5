/* Judging the state of a dive, part by part.

   A state from outside is bytes that nobody may believe.  Each struct of the state has a table with
   the values allowed for each member (base/record.h); here the tables are walked over a whole
   state: the sea, the obstacles, every vehicle and every tether with its store and its subject.
   judge_parts.c adds the rules between members, such as form and contents of a store.  Every judged
   byte is counted, and the count must equal the live size of the state: a struct without a table
   fails every state.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <stdio.h>

#include "base/error.h"
#include "world/judge.h"
#include "world/layout.h"

/* Who is judged: enough for any name.  */
enum
{
  WHOSE = BT_NAME_SIZE + 16
};

static void
name_part (bt__judge *judge, char *whose, const char *kind, const char *name)
{
  snprintf (whose, WHOSE, "%s `%s'", kind, name);
  judge->whose = whose;
}

static bt_status
judge_vehicles (bt__judge *judge, bt_dive *dive, bt__state *state)
{
  char whose[WHOSE];
  bt_status status = BT_OK;
  for (int i = 0; i < dive->model->n_vehicles && status == BT_OK; i++)
    {
      name_part (judge, whose, "vehicle", dive->model->vehicles[i].name);
      status = bt__judge_vehicle (judge, dive, state, i);
      if (status == BT_OK)
        status = bt__judge_subject (judge, dive, state, BT_PART_VEHICLE, i);
    }
  return status;
}

static bt_status
judge_tethers (bt__judge *judge, bt_dive *dive, bt__state *state)
{
  char whose[WHOSE];
  bt_status status = BT_OK;
  for (int i = 0; i < dive->model->n_tethers && status == BT_OK; i++)
    {
      name_part (judge, whose, "tether", dive->model->tethers[i].name);
      status = bt__judge_tether (judge, dive, state, i);
      if (status == BT_OK)
        status = bt__judge_subject (judge, dive, state, BT_PART_TETHER, i);
    }
  return status;
}

bt_status
bt__state_judge (bt_dive *dive, bt__state *state, bt_error *error)
{
  const bt_model *model = dive->model;
  bt__judge judge
      = { .whose = "the state",
          .below = { [BT__BELOW_OBJECTS] = model->n_obstacles + model->n_tethers + model->n_hulls,
                     [BT__BELOW_MOVERS] = model->n_carried + model->n_hulls },
          .error = error };
  bt_status status = bt__judge_sea (&judge, dive, state);
  if (status == BT_OK)
    status = bt__judge_obstacles (&judge, dive, state);
  if (status == BT_OK)
    status = judge_vehicles (&judge, dive, state);
  if (status == BT_OK)
    status = judge_tethers (&judge, dive, state);
  /* Bytes without a table are not believed: a new struct of the state fails here until it has a
     table.  */
  if (status == BT_OK && judge.seen != bt__live_size (dive, state))
    status = bt__fail (error, BT_ERR_FORMAT, "%zu of %zu bytes of the state were judged",
                       judge.seen, bt__live_size (dive, state));
  return status;
}
