/* A saved state, spoilt at some places with its checksum made anew, as a stranger would: it is
   refused, or it can be stepped and asked whatever there is to ask; and the dive that refused it is
   as it was.

   The bytes are choices: which dive, how many words, which, what comes there, what is done then.
   When they run out, they begin anew.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include <bight/bight.h>

#include "render/scene_of_dive.h"
#include "state_worlds.h"
#include "targets.h"
#include "world/layout.h"
#include "world/obstacles.h"

/* ---- Choices ---- */

typedef struct choices
{
  const uint8_t *at;
  size_t n, next;
} choices;

static size_t
choose (choices *c, size_t below)
{
  size_t x = 0;
  for (size_t most = 1; most < below; most *= 256)
    {
      x = 256 * x + c->at[c->next];
      c->next = (c->next + 1) % c->n;
    }
  return x % below;
}

/* ---- Dives to spoil ---- */

enum
{
  WORLDS_MAX = 64,
  PLACES_MAX = 64
};

typedef struct place
{
  size_t at, size;
} place;

/* A dive, its state as it was saved, and where in it something stands.  */
typedef struct victim
{
  bt_dive *dive;
  char *state, *spoilt;
  size_t size;
  uint64_t hash;
  place place[PLACES_MAX];
  int places;
} victim;

static void
add_place (victim *v, const void *at, size_t size)
{
  size_t from = (size_t)((const char *)at - (const char *)v->dive->now);
  if (v->places < PLACES_MAX && size > 0)
    v->place[v->places++] = (place){ from, size };
}

/* The heads of what lies in the store of tether I are as likely as all of the rest.  */
static void
add_store (victim *v, int i)
{
  bt_dive *d = v->dive;
  const bt__tether *tether = bt__dive_tether (d, d->now, i);
  add_place (v, tether, sizeof *tether);
  add_place (v, &tether->length, sizeof *tether - sizeof tether->props);
  add_place (v, bt__dive_nodes (d, d->now, i), bt__store_size (d->model, i));
  for (int part = 0; tether->shape.form == BT__FORM_CHAIN && part <= tether->parted; part++)
    {
      const bt__contacts *anchors = bt__dive_anchors (d, d->now, i, part);
      add_place (v, bt__dive_chain (d, d->now, i, part), sizeof (bt__dynamic));
      add_place (v, anchors, sizeof *anchors);
      add_place (v, anchors, bt__contacts_live (anchors));
    }
  if (tether->contact_form == BT__TETHER_SPANS)
    {
      const bt__thesis *thesis = bt__dive_thesis (d, d->now, i);
      add_place (v, thesis, sizeof *thesis + sizeof (bt__polyline));
      add_place (v, bt__thesis_spans (thesis), (size_t)thesis->spans * sizeof (bt__span));
    }
  if (tether->contact_form == BT__TETHER_HELD)
    add_place (v, bt__dive_held (d, d->now, i), sizeof (bt__polyline));
}

static void
find_places (victim *v)
{
  bt_dive *d = v->dive;
  add_place (v, d->now, sizeof *d->now);
  add_place (v, &d->now->step, offsetof (bt__state, event) - offsetof (bt__state, step));
  for (int i = 0; i < d->model->n_vehicles; i++)
    add_place (v, bt__dive_vehicle (d, d->now, i), sizeof (bt__vehicle));
  if (d->model->n_obstacles > 0)
    add_place (v, bt__dive_movers (d, d->now), bt__obstacles_size (d->model));
  for (int i = 0; i < d->model->n_tethers; i++)
    add_store (v, i);
}

static victim *
victim_of (int i)
{
  static victim all[WORLDS_MAX];
  victim *v = &all[i];
  if (v->dive)
    return v;
  v->dive = state_world (i);
  v->size = bt_dive_state_size (v->dive);
  v->hash = bt_dive_hash (v->dive);
  v->state = malloc (v->size);
  v->spoilt = malloc (v->size);
  fuzz_check (v->state && v->spoilt);
  bt_dive_save (v->dive, v->state);
  find_places (v);
  return v;
}

/* ---- Spoiling ---- */

static uint64_t
bits_of (double x)
{
  uint64_t bits;
  memcpy (&bits, &x, sizeof bits);
  return bits;
}

static double
number_of (uint64_t bits)
{
  double x;
  memcpy (&x, &bits, sizeof x);
  return x;
}

/* What comes in place of WAS.  */
static uint64_t
another (choices *c, uint64_t was)
{
  static const double reals[]
      = { NAN, INFINITY, -INFINITY, 1e308, -1e308, 1e9,    -1e9, 1e-300, -0.0, 1,     -1,    0.5,
          1e3, 1e-9,     1e6,       1e7,   -1e3,   5e-324, 1e99, -1e99,  1e30, -1e30, 1e-12, 100 };
  static const int64_t wholes[]
      = { 0,    1,         -1,        2,          3,         5,         7,         8,
          11,   12,        13,        64,         127,       128,       129,       255,
          4096, INT32_MAX, INT32_MIN, UINT32_MAX, INT64_MAX, INT64_MIN, 1LL << 32, 1000000 };
  switch (choose (c, 8))
    {
    case 0:
      return bits_of (reals[choose (c, sizeof reals / sizeof *reals)]);
    case 1:
    case 2:
      return (uint64_t)wholes[choose (c, sizeof wholes / sizeof *wholes)];
    case 3:
      return was ^ (uint64_t)1 << choose (c, 64);
    case 4:
      return was + 1;
    case 5:
      return was - 1;
    case 6:
      return bits_of (number_of (was) * (1.0 + ((double)choose (c, 256) - 128) / 16));
    default:
      return bits_of (number_of (was) + ((double)choose (c, 256) - 128));
    }
}

static void
spoil (const victim *v, choices *c)
{
  const place *p = &v->place[choose (c, (size_t)v->places)];
  size_t at = p->at + 8 * choose (c, p->size / 8);
  uint64_t word;
  memcpy (&word, v->spoilt + at, sizeof word);
  word = another (c, word);
  memcpy (v->spoilt + at, &word, sizeof word);
}

/* As `bt_dive_save' makes it; what does not even fit keeps the old one.  */
static void
make_checksum (const victim *v)
{
  bt__state *state = (bt__state *)(void *)v->spoilt;
  state->checksum = 0;
  if (bt__layout_fits (v->dive, state))
    state->checksum = bt__hash_state (v->dive, state);
}

/* ---- What is asked ---- */

enum
{
  ROOM = 64
};

static void
ask_tether (const bt_dive *d, int i)
{
  bt_tether_view view;
  bt_vec3 p[ROOM];
  double x[ROOM];
  bt_energy energy;
  bt_clearance near;
  bt_contact contact[ROOM];
  bt_segment segment[ROOM];
  if (bt_dive_tether (d, i, &view, NULL) != BT_OK)
    return;
  for (int k = 0; k <= 4; k++)
    {
      bt_tether_point (d, i, view.length * k / 4, p, NULL);
      bt_tether_tangent (d, i, view.length * k / 4, p, NULL);
      bt_tether_tension (d, i, view.length * k / 4, x, NULL);
      bt_tether_wear_at (d, i, view.length * k / 4, x, NULL);
    }
  bt_tether_points (d, i, ROOM, p, NULL);
  bt_tether_tensions (d, i, ROOM, x, NULL);
  fuzz_check (view.nodes >= 2 && view.nodes < 1000000);
  bt_vec3 *own = malloc (sizeof *own * (size_t)view.nodes);
  fuzz_check (own != NULL);
  bt_tether_points (d, i, 0, own, NULL);
  bt_tether_tensions (d, i, 0, &own->x, NULL);
  free (own);
  bt_tether_tail (d, i, p, ROOM);
  bt_tether_tightest_bend (d, i, x, NULL);
  bt_tether_energy (d, i, &energy, NULL);
  int n = bt_tether_contacts (d, i, contact, ROOM);
  for (int k = 0; k < n && k < ROOM; k++)
    fuzz_check (bt_dive_name (d, BT_PART_OBSTACLE, contact[k].object) != NULL);
  bt_tether_segments (d, i, segment, ROOM);
  bt_tether_clearance (d, i, -1, &near, NULL);
  bt_tether_wear (d, i, x, NULL);
  bt_dive_transponders (d, i, ROOM, 0.1, p, NULL);
}

static void
ask_vehicle (const bt_dive *d, int i)
{
  bt_vehicle_view view;
  bt_readings readings;
  bt_clearance near;
  bt_sighting sight;
  int64_t lost;
  double x[ROOM];
  bt_dive_vehicle (d, i, &view, NULL);
  bt_dive_instruments (d, i, &readings, NULL);
  bt_dive_faults (d, i, &lost);
  bt_dive_thrusts (d, i, x);
  bt_dive_sonar (d, i, &(bt_sonar){ 2, 0, 40, ROOM, 0.05 }, x, NULL);
  bt_dive_sight (d, i, &(bt_eye){ 1, 1, 0, 20 }, 0, &sight, NULL);
  bt_vehicle_clearance (d, i, -1, &near, NULL);
}

static void
ask_world (const bt_dive *d)
{
  bt_sea_view sea;
  bt_vec3 v;
  bt_event event[BT_EVENTS_KEPT];
  bt_obstacle_view obstacle;
  bt_profile profile;
  bt_dive_sea (d, &sea);
  bt_dive_current_at (d, (bt_vec3){ 1, 2, -3 }, &v, NULL);
  int n = bt_dive_events (d, 0, event);
  for (int k = 0; k < n; k++)
    fuzz_check (bt_event_name ((bt_event_kind)event[k].kind)
                && bt_dive_name (d, (bt_part)event[k].part, (int)event[k].subject));
  for (int i = 0; i < bt_dive_count (d, BT_PART_OBSTACLE); i++)
    bt_dive_obstacle (d, i, &obstacle, NULL);
  bt_dive_profile (d, &profile);
}

/* Questions that take longer, one at a time.  */
static void
ask_deeply (const bt_dive *d, int i, size_t which)
{
  double x;
  int n;
  bt_vec3 p[ROOM];
  static bt_class class;
  bt_foul foul;
  bt_prospect prospect;
  bt_route route;
  bt_foresight foresight[8];
  bt_follow follow;
  switch (which)
    {
    case 0:
      bt_tether_taut_length (d, i, &x, NULL);
      bt_tether_is_taut (d, i, &n, NULL);
      bt_tether_taut_string (d, i, p, ROOM, &n, NULL);
      break;
    case 1:
      bt_tether_free_length (d, i, &x, NULL);
      break;
    case 2:
      bt_tether_contact_length (d, i, -1, 0, &x, NULL);
      bt_tether_turns (d, i, 0, &x, NULL);
      bt_tether_winding (d, i, 0, &n, NULL);
      bt_tether_wrap_angle (d, i, -1, &x, NULL);
      bt_tether_capstan_lock (d, i, &x, NULL);
      break;
    case 3:
      bt_tether_class (d, i, &class, NULL);
      break;
    case 4:
      bt_tether_knotted (d, i, &n, NULL);
      bt_tether_fouled (d, i, &foul, NULL);
      break;
    case 5:
      bt_tether_prospect (d, i, 300, &prospect, NULL);
      break;
    case 6:
      bt_tether_way_home (d, i, p, ROOM, &n, &route, NULL);
      bt_tether_unwind_plan (d, i, p, ROOM, &n, &route, NULL);
      break;
    default:
      bt_tether_foresee (d, i, 3, foresight, 8, &n, NULL);
      bt_tether_follow (d, i, &follow, NULL);
    }
}

/* A picture of it, without a renderer.  */
static void
ask_view (const bt_dive *d, choices *c)
{
  bt__show show = { .paint = (bt__paint)choose (c, BT__PAINTS), .more = (unsigned)choose (c, 16) };
  bt_view *view;
  show.level = (int)choose (c, 3) - 1;
  if (bt_view_new (&view, NULL) != BT_OK)
    return;
  bt__scene_of_dive (d, &show, view, NULL);
  bt__scene_ghost (d, view, NULL);
  bt_view_free (view);
}

static void
ask (const bt_dive *d, choices *c)
{
  int tethers = bt_dive_count (d, BT_PART_TETHER);
  for (int i = 0; i < tethers; i++)
    ask_tether (d, i);
  for (int i = 0; i < bt_dive_count (d, BT_PART_VEHICLE); i++)
    ask_vehicle (d, i);
  ask_world (d);
  if (choose (c, 8) == 0)
    ask_view (d, c);
  if (choose (c, 16) == 0)
    ask_deeply (d, (int)choose (c, (size_t)tethers), choose (c, 8));
}

/* ---- What is done ---- */

/* A number for an order: sensible, or not at all.  */
static double
an_argument (choices *c)
{
  static const double odd[] = { NAN, INFINITY, -INFINITY, 1e308, -1e308, 1e19, -1, 0, 1, 2, 1e-9 };
  return choose (c, 2) ? odd[choose (c, sizeof odd / sizeof *odd)]
                       : ((double)choose (c, 256) - 128) / 8;
}

static void
order (bt_dive *d, choices *c)
{
  double args[16];
  int op = (int)choose (c, BT_OP_COUNT + 2) - 1, n = (int)choose (c, 17);
  const bt_op_info *info = bt_op_describe ((bt_op)op);
  bt_error e;
  if (info && choose (c, 4) > 0)
    n = info->min_args;
  for (int k = 0; k < 16; k++)
    args[k] = an_argument (c);
  bt_dive_do (d, (bt_op)op, (int)choose (c, 4) - 1, args, n, &e);
}

static void
go_on (bt_dive *d, choices *c)
{
  /* Most of what goes wrong does so at once; some of it takes a while.  */
  int steps = choose (c, 32) == 0 ? 100 : choose (c, 8) == 0 ? 12 : 1 + (int)choose (c, 3);
  bt_error e;
  ask (d, c);
  while (steps-- > 0 && bt_dive_step (d, &e) == BT_OK)
    if (choose (c, 32) == 0)
      order (d, c);
  if (choose (c, 2) == 0)
    ask (d, c);
}

/* What a dive comes to by orders and steps is believed, whatever the orders.  */
static void
check_believed (const victim *v)
{
  bt_error e;
  bt_dive_save (v->dive, v->spoilt);
  fuzz_check (bt_dive_restore (v->dive, v->spoilt, v->size, &e) == BT_OK);
}

void
fuzz_state (const uint8_t *bytes, size_t n)
{
  choices c = { bytes, n, 0 };
  bt_error e;
  if (n == 0)
    return;
  victim *v = victim_of ((int)choose (&c, (size_t)state_worlds ()));
  memcpy (v->spoilt, v->state, v->size);
  int sound = choose (&c, 16) == 0;
  for (size_t k = sound ? 0 : 1 + choose (&c, 8) / 4 * choose (&c, 4); k > 0; k--)
    spoil (v, &c);
  make_checksum (v);
  if (bt_dive_restore (v->dive, v->spoilt, v->size, &e) == BT_OK)
    go_on (v->dive, &c);
  else if (sound)
    fuzz_check (0);
  else
    fuzz_check (bt_dive_hash (v->dive) == v->hash && e.text[0]);
  if (sound)
    check_believed (v);
  fuzz_check (bt_dive_restore (v->dive, v->state, v->size, &e) == BT_OK);
}
