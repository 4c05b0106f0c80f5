/* Questions to a dive as a whole: its parts, its sea, its events, its work.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <stddef.h>
#include <string.h>

#include "guile/guile.h"

SCM
bt__from_doubles (const double *x, size_t n)
{
  SCM v = scm_make_f64vector (scm_from_size_t (n), SCM_INUM0);
  memcpy (SCM_BYTEVECTOR_CONTENTS (v), x, n * sizeof *x);
  return v;
}

static SCM
symbol (const char *name)
{
  return scm_from_utf8_symbol (name);
}

/* The names of a dive stay, and every verb about a vehicle or a tether asks for them.  */
static SCM
names (SCM object, SCM part)
{
  bt_part kind = bt__to_part ("parts", part);
  SCM *list = &bt__to_handle (object)->names[kind];
  if (scm_is_true (*list))
    return *list;
  bt_dive *dive = bt__to_dive (object);
  SCM all = SCM_EOL;
  for (int i = bt_dive_count (dive, kind); i-- > 0;)
    all = scm_cons (symbol (bt_dive_name (dive, kind, i)), all);
  *list = all;
  return all;
}

static SCM
sea (SCM object)
{
  bt_sea_view view;
  double waves[BT_WAVES_ARGS];
  int n;
  bt_dive_sea (bt__to_dive (object), &view);
  n = bt_waves_pack (&view.waves, waves);
  return bt__associate (
      "depth", scm_from_double (view.depth),
      bt__associate (
          "density", scm_from_double (view.density),
          bt__associate ("gravity", scm_from_double (view.gravity),
                         bt__associate ("waves", bt__from_doubles (waves, (size_t)n), SCM_EOL))));
}

/* The numbers of the operation `current' that set the current of a dive.  */
static SCM
current_numbers (SCM object)
{
  bt_current current;
  double args[BT_CURRENT_ARGS];
  bt_dive_current (bt__to_dive (object), &current);
  return bt__from_doubles (args, (size_t)bt_current_pack (&current, args));
}

static SCM
current_at (SCM object, SCM point)
{
  bt_vec3 v;
  bt_error error;
  bt__check (
      "current-at",
      bt_dive_current_at (bt__to_dive (object), bt__to_point ("current-at", point), &v, &error),
      &error);
  return bt__from_point (v);
}

static SCM
from_event (bt_dive *dive, const bt_event *event)
{
  const char *name = bt_dive_name (dive, (bt_part)event->part, (int)event->subject);
  const char *object = bt_dive_name (dive, BT_PART_OBSTACLE, (int)event->object);
  return scm_cons2 (symbol (bt_event_name ((bt_event_kind)event->kind)),
                    scm_from_double (event->time),
                    scm_cons (name ? symbol (name) : SCM_BOOL_F,
                              object ? scm_list_1 (symbol (object)) : SCM_EOL));
}

static SCM
event_count (SCM object)
{
  return scm_from_int64 (bt_dive_event_count (bt__to_dive (object)));
}

static SCM
event_kinds (void)
{
  SCM list = SCM_EOL;
  for (int kind = BT_EVENT_TAUT; bt_event_name ((bt_event_kind)kind); kind++)
    list = scm_cons (symbol (bt_event_name ((bt_event_kind)kind)), list);
  return scm_reverse_x (list, SCM_EOL);
}

static SCM
events (SCM object, SCM first)
{
  bt_dive *dive = bt__to_dive (object);
  bt_event kept[BT_EVENTS_KEPT];
  SCM list = SCM_EOL;
  int n = bt_dive_events (dive, scm_to_int64 (first), kept);
  while (n-- > 0)
    list = scm_cons (from_event (dive, &kept[n]), list);
  return list;
}

/* The work counters of a dive by name.  */
static const struct
{
  const char *name;
  size_t offset;
} counters[] = {
  { "steps", offsetof (bt_profile, steps) },
  { "shape-solves", offsetof (bt_profile, shape_solves) },
  { "shape-skips", offsetof (bt_profile, shape_skips) },
  { "search-iterations", offsetof (bt_profile, search_iterations) },
  { "shots", offsetof (bt_profile, shots) },
  { "marches", offsetof (bt_profile, marches) },
  { "relaxations", offsetof (bt_profile, relaxations) },
  { "unsettled", offsetof (bt_profile, unsettled) },
  { "chain-steps", offsetof (bt_profile, chain_steps) },
  { "chain-tries", offsetof (bt_profile, chain_tries) },
  { "chain-parts", offsetof (bt_profile, chain_parts) },
  { "chain-stretched", offsetof (bt_profile, chain_stretched) },
  { "chain-solves", offsetof (bt_profile, chain_solves) },
  { "chain-vain", offsetof (bt_profile, chain_vain) },
  { "chain-sleeps", offsetof (bt_profile, chain_sleeps) },
  { "chain-remeshes", offsetof (bt_profile, chain_remeshes) },
  { "chain-safeguarded", offsetof (bt_profile, chain_safeguarded) },
  { "chain-unconverged", offsetof (bt_profile, chain_unconverged) },
  { "chain-slips", offsetof (bt_profile, chain_slips) },
  { "still-water-shapes", offsetof (bt_profile, current_samples_skipped) },
  { "links-asked", offsetof (bt_profile, links_asked) },
  { "boxes-visited", offsetof (bt_profile, boxes_visited) },
  { "pairs-measured", offsetof (bt_profile, pairs_measured) },
  { "links-clear", offsetof (bt_profile, links_clear) },
  { "casts", offsetof (bt_profile, casts) },
  { "touches", offsetof (bt_profile, touches) },
  { "chafes", offsetof (bt_profile, chafes) },
  { "contact-rounds", offsetof (bt_profile, contact_rounds) },
  { "truncated", offsetof (bt_profile, truncated) },
  { "line-pairs", offsetof (bt_profile, line_pairs) },
  { "span-solves", offsetof (bt_profile, span_solves) },
  { "span-skips", offsetof (bt_profile, span_skips) },
  { "body-steps", offsetof (bt_profile, body_steps) },
  { "wave-samples", offsetof (bt_profile, wave_samples) },
  { "lee-samples", offsetof (bt_profile, lee_samples) },
  { "operations", offsetof (bt_profile, operations) },
  { "strings", offsetof (bt_profile, strings) },
  { "charts", offsetof (bt_profile, charts) },
  { "words", offsetof (bt_profile, words) },
  { "threads", offsetof (bt_profile, threads) },
  { "shared-steps", offsetof (bt_profile, shared_steps) },
  { "shared-again", offsetof (bt_profile, shared_again) },
  { "beside-hulls", offsetof (bt_profile, beside_hulls) },
  { "refused", offsetof (bt_profile, refused) },
};

static SCM
profile (SCM object)
{
  bt_profile p;
  SCM list = SCM_EOL;
  bt_dive_profile (bt__to_dive (object), &p);
  for (size_t k = sizeof counters / sizeof *counters; k-- > 0;)
    {
      uint64_t count;
      memcpy (&count, (const char *)&p + counters[k].offset, sizeof count);
      list = bt__associate (counters[k].name, scm_from_uint64 (count), list);
    }
  return list;
}

void
bt__define_questions (void)
{
  static const bt__procedure table[] = {
    { "%names", 2, 0, (scm_t_subr)names, "Return the names of the parts of kind PART in DIVE." },
    { "%current-numbers", 1, 0, (scm_t_subr)current_numbers,
      "Return the current of DIVE as the numbers of the operation `current', an f64vector." },
    { "%sea", 1, 0, (scm_t_subr)sea, "Return depth, density and gravity of DIVE's sea, an alist." },
    { "%current-at", 2, 0, (scm_t_subr)current_at, "Return the velocity of the water at POINT." },
    { "%events", 2, 0, (scm_t_subr)events,
      "Return the kept events of DIVE from number FIRST on, lists (KIND TIME SUBJECT)." },
    { "%event-kinds", 0, 0, (scm_t_subr)event_kinds, "Return the kinds of events, symbols." },
    { "%event-count", 1, 0, (scm_t_subr)event_count, "Return how many events DIVE ever had." },
    { "%profile", 1, 0, (scm_t_subr)profile, "Return the work counters of DIVE, an alist." },
  };
  bt__define_procedures (table, sizeof table / sizeof *table);
}
