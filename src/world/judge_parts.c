/* What holds between the members of a sound state, part by part.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <math.h>
#include <string.h>

#include "base/error.h"
#include "math/vec.h"
#include "world/form.h"
#include "world/judge_tables.h"
#include "world/layout.h"
#include "world/obstacles.h"

/* The first of two judgements that is bad.  */
#define AND(status, next) ((status) == BT_OK ? (next) : (status))

/* True if A and B are equal to the last bit, as constants of a dive and of its world are.  */
static int
is_same_bits (const double *a, const double *b)
{
  return memcmp (a, b, sizeof *a) == 0;
}

/* ---- The table of fields ---- */

/* True for a field computed from mass, diameter and sea: the computed value has no range.  */
static int
follows (const bt_field *field)
{
  return strcmp (field->name, "wet-weight") == 0 || strcmp (field->name, "mass") == 0;
}

/* Judge VALUE by FIELD, which in the world is WAS.  */
static bt_status
judge_field (const bt__judge *judge, const bt_field *field, double value, double was)
{
  double scratch;
  bt_field alone = *field;
  bt_error why;
  alone.offset = 0;
  if (!field->live && !is_same_bits (&value, &was))
    return bt__fail (judge->error, BT_ERR_FORMAT, "%s: its `%s' is %g, and in its world %g",
                     judge->whose, field->name, value, was);
  if (follows (field) ? fabs (value) <= BT__FAR
                      : bt_def_set_number (&alone, &scratch, value, &why) == BT_OK)
    return BT_OK;
  return bt__fail (judge->error, BT_ERR_FORMAT, "%s: %s", judge->whose,
                   follows (field) ? "its weight is not finite" : why.text);
}

static double
number_in_def (const void *def, size_t offset)
{
  double x;
  memcpy (&x, (const char *)def + offset, sizeof x);
  return x;
}

/* Every property is a field and judged by its field alone.  */
static bt_status
judge_props (const bt__judge *judge, const bt_tether_props *props, const bt_tether_props *was)
{
  const bt_head *head = bt_head_find ("tether");
  size_t from = offsetof (bt_tether_def, props), known = 0;
  bt_status status = BT_OK;
  for (size_t k = 0; k < head->n_fields && status == BT_OK; k++)
    {
      const bt_field *field = &head->fields[k];
      if (field->offset < from || field->offset >= from + sizeof *props)
        continue;
      status = judge_field (judge, field, number_in_def (props, field->offset - from),
                            number_in_def (was, field->offset - from));
      known++;
    }
  if (status == BT_OK && known != sizeof *props / sizeof (double))
    status = bt__fail (judge->error, BT_ERR_FORMAT, "a property of tethers is no field");
  return status;
}

/* ---- The sea ---- */

/* Room beyond the components is zero; waves asked for are present.  */
static bt_status
judge_waves (bt__judge *judge, const bt__state *state)
{
  const bt_waves *w = &state->waves;
  int whole = 1;
  for (int64_t i = w->n; i < BT_WAVES_MAX; i++)
    whole = whole && w->omega[i] == 0 && w->k[i] == 0 && w->amplitude[i] == 0 && w->speed[i] == 0;
  return bt__judge_that (judge, whole && (w->n > 0) == (state->wave.kind != BT_WAVE_NONE),
                         "its waves are as many as were asked for");
}

/* The event I of those kept.  */
static bt_status
judge_event (bt__judge *judge, const bt_dive *dive, const bt_event *event)
{
  int n = bt_dive_count (dive, (bt_part)event->part);
  bt_status status
      = bt__judge_that (judge, event->kind < 1000 && bt_event_name ((bt_event_kind)event->kind),
                        "every event is of a kind there is");
  status = AND (status,
                bt__judge_count (judge, "for the subject of an event", event->subject, 0, n - 1));
  return AND (status, bt__judge_count (judge, "for the object of an event", event->object, -1,
                                       judge->below[BT__BELOW_OBJECTS] - 1));
}

static bt_status
judge_events (bt__judge *judge, const bt_dive *dive, const bt__state *state)
{
  int64_t kept = state->events < BT_EVENTS_KEPT ? state->events : BT_EVENTS_KEPT;
  bt_status status = BT_OK;
  for (int64_t i = 0; i < kept && status == BT_OK; i++)
    status = judge_event (judge, dive, &state->event[i]);
  return status;
}

static bt_status
judge_current (bt__judge *judge, const bt_dive *dive, const bt__state *state)
{
  bt_error why;
  if (bt_current_check (&state->current, &why) != BT_OK)
    return bt__fail (judge->error, BT_ERR_FORMAT, "%s: %s", judge->whose, why.text);
  if (state->current.kind == BT_CURRENT_FUNCTION && !dive->function)
    return bt__fail (judge->error, BT_ERR_STALE,
                     "the current of this state is a function, and this dive has none");
  return BT_OK;
}

bt_status
bt__judge_sea (bt__judge *judge, const bt_dive *dive, const bt__state *state)
{
  const bt_head *head = bt_head_find ("sea");
  const bt_sea_def *was = &dive->model->sea;
  bt_status status = bt__judge_records (judge, &bt__state_record, state, 1);
  judge->seen -= sizeof *state - bt__live_head (state); /* the rest of the head is not in use */
  status
      = AND (status, judge_field (judge, bt_field_find (head, "depth"), state->depth, was->depth));
  status = AND (status, judge_field (judge, bt_field_find (head, "density"), state->density, 0));
  status = AND (status, judge_field (judge, bt_field_find (head, "gravity"), state->gravity, 0));
  status = AND (status, judge_current (judge, dive, state));
  status = AND (status, judge_waves (judge, state));
  return AND (status, judge_events (judge, dive, state));
}

/* ---- Vehicles ---- */

bt_status
bt__judge_vehicle (bt__judge *judge, const bt_dive *dive, bt__state *state, int i)
{
  const bt__vehicle *v = bt__dive_vehicle (dive, state, i);
  const bt__quat q = v->body.attitude;
  bt_status status = bt__judge_records (judge, &bt__vehicle_record, v, 1);
  int rigid = dive->model->vehicles[i].mass > 0;
  double turn = q.w * q.w + bt__dot (q.v, q.v);
  status = AND (status, bt__judge_that (judge, v->rigid == rigid, "it has mass as in its world"));
  status = AND (status,
                bt__judge_that (judge, !rigid || fabs (turn - 1) < 1e-3, "its attitude is a turn"));
  return AND (status, bt__judge_that (judge, !rigid || v->lost >> dive->model->types[i].n == 0,
                                      "what is lost of it are its thrusters"));
}

/* ---- Tethers ---- */

/* The store of tether I.  */
static bt_status
judge_store (bt__judge *judge, const bt_dive *dive, bt__state *state, int i)
{
  const bt__tether *tether = bt__dive_tether (dive, state, i);
  bt__wear wear = bt__dive_wear (dive, state, i);
  bt_status status = BT_OK;
  if (tether->wear != 0)
    status = bt__judge_reals (judge, "worn spots", wear.spot, (size_t)wear.n, 0, BT__HUGE);
  return AND (status, bt__form_of (tether)->judge (judge, dive, state, i));
}

/* The model, the form of the shape and the contents of the store agree.  */
static bt_status
judge_form (bt__judge *judge, const bt_dive *dive, const bt__tether *tether, int i)
{
  int moves = tether->props.model >= BT_MODEL_DYNAMIC, among = dive->model->n_obstacles > 0;
  int chain = bt__is_cable (tether);
  bt_status status = bt__judge_that (judge, moves == chain, "a moving model has a chain");
  status = AND (status, bt__judge_that (judge, chain || !tether->parted,
                                        "only a moving line is in two parts"));
  status = AND (status, bt__judge_that (judge, (!chain && among) || !tether->contact_form,
                                        "only a static line among obstacles is draped"));
  status = AND (
      status, bt__judge_that (judge, among || tether->wear == 0, "only obstacles wear its jacket"));
  status = AND (status, bt__judge_that (judge, moves || dive->model->tethers[i].n_lumps == 0,
                                        "a moving model bears its clumps and floats"));
  status = AND (
      status,
      bt__judge_that (judge, (moves && tether->props.ei > 0) || dive->model->tethers[i].n_sets == 0,
                      "a stiff line that moves bears its sets"));
  return AND (status, bt__judge_that (judge, tether->length > 0, "some of it is out"));
}

bt_status
bt__judge_tether (bt__judge *judge, const bt_dive *dive, bt__state *state, int i)
{
  const bt__tether *tether = bt__dive_tether (dive, state, i);
  bt_status status = bt__judge_records (judge, &bt__tether_record, tether, 1);
  status = AND (status, judge_props (judge, &tether->props, &dive->model->tethers[i].props));
  status = AND (status, judge_form (judge, dive, tether, i));
  return AND (status, judge_store (judge, dive, state, i));
}

/* ---- Obstacles ---- */

static int
is_square (const bt__frame *f)
{
  double off = fmax (fabs (bt__dot (f->x, f->y)),
                     fmax (fabs (bt__dot (f->y, f->z)), fabs (bt__dot (f->z, f->x))));
  double x = bt__dot (f->x, f->x), y = bt__dot (f->y, f->y), z = bt__dot (f->z, f->z);
  return off < 1e-6 && fabs (x - 1) < 1e-6 && fabs (y - 1) < 1e-6 && fabs (z - 1) < 1e-6
         && bt__dot (bt__cross (f->x, f->y), f->z) > 0;
}

/* The friction of each is judged as NaN, for that of the tether, or as a coefficient.  */
static bt_status
judge_roughness (bt__judge *judge, const double *rough, int n)
{
  judge->seen += sizeof *rough * (size_t)n;
  for (int i = 0; i < n; i++)
    if (!isnan (rough[i]) && !(rough[i] >= 0 && rough[i] <= BT__FAR))
      return bt__fail (judge->error, BT_ERR_FORMAT,
                       "the friction of obstacle %d is %g, not 0 to %g", i, rough[i], BT__FAR);
  return BT_OK;
}

bt_status
bt__judge_obstacles (bt__judge *judge, const bt_dive *dive, bt__state *state)
{
  const bt_model *model = dive->model;
  const bt__mover_state *mover = bt__dive_movers (dive, state);
  bt_status status = bt__judge_records (judge, &bt__mover_record, mover, (size_t)model->n_carried);
  for (int k = 0; k < model->n_carried && status == BT_OK; k++)
    status = bt__judge_that (judge, is_square (&mover[k].frame), "axes stand across each other");
  return AND (status,
              judge_roughness (judge, bt__dive_roughness (dive, state), model->n_obstacles));
}

/* A meeting in use is with an object there is.  One that is not names object 0, also in a world
   without any.  */
static bt_status
judge_meetings (bt__judge *judge, const bt__subject *subject)
{
  bt_status status = BT_OK;
  for (int64_t k = 0; k < subject->n && status == BT_OK; k++)
    status = bt__judge_count (judge, "for the object of a meeting", subject->meeting[k].object, 0,
                              judge->below[BT__BELOW_OBJECTS] - 1);
  return status;
}

/* Behind a subject lie a switch for each object, then the windings about each obstacle, both padded
   with zeros.  The version vouches for the switches: caches of a scene compare versions alone.  */
bt_status
bt__judge_subject (bt__judge *judge, const bt_dive *dive, bt__state *state, bt_part part, int i)
{
  const bt__subject *subject = bt__dive_subject (dive, state, part, i);
  const uint8_t *off = bt__dive_off (dive, state, part, i);
  size_t bytes = dive->layout.subject - sizeof *subject;
  bt_status status = bt__judge_records (judge, &bt__subject_record, subject, 1);
  status = AND (status, judge_meetings (judge, subject));
  size_t half = bytes / 2, objects = (size_t)bt__objects (dive->model);
  int whole = 1;
  judge->seen += bytes;
  for (size_t k = 0; k < half; k++)
    whole = whole && off[k] <= (k < objects) && (k < objects || off[half + k] == 0);
  status = AND (status, bt__judge_that (judge, whole, "each of its pairs is on or off"));
  return AND (status,
              bt__judge_that (judge, subject->version == bt__pairs_version (dive->model, off),
                              "its pairs are those that its version tells"));
}
