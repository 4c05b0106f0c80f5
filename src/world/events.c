/* Events with their times, in a ring buffer of the state: a restored dive remembers its own past
   alone.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include "world/dive.h"

void
bt__raise_event_at (bt__state *state, bt_event_kind kind, bt_part part, int subject, int object)
{
  bt_event *slot = &state->event[state->events++ % BT_EVENTS_KEPT];
  *slot = (bt_event){
    .time = bt__state_time (state), .kind = kind, .part = part, .subject = subject, .object = object
  };
}

void
bt__raise_event (bt__state *state, bt_event_kind kind, int subject)
{
  bt_part part = kind == BT_EVENT_ARRIVED || kind == BT_EVENT_PROP_DANGER ? BT_PART_VEHICLE
                 : kind == BT_EVENT_PINCHED                               ? BT_PART_OBSTACLE
                                                                          : BT_PART_TETHER;
  bt__raise_event_at (state, kind, part, subject, -1);
}

void
bt__forget_events (const bt_dive *dive, bt__state *state, int64_t events)
{
  for (int64_t k = events; k < state->events; k++)
    state->event[k % BT_EVENTS_KEPT] = dive->now->event[k % BT_EVENTS_KEPT];
  state->events = events;
}

int64_t
bt_dive_event_count (const bt_dive *dive)
{
  return dive->now->events;
}

int
bt_dive_events (const bt_dive *dive, int64_t first, bt_event *events)
{
  const bt__state *state = dive->now;
  int64_t oldest = state->events > BT_EVENTS_KEPT ? state->events - BT_EVENTS_KEPT : 0;
  int n = 0;
  for (int64_t i = first > oldest ? first : oldest; i < state->events; i++)
    events[n++] = state->event[i % BT_EVENTS_KEPT];
  return n;
}

const char *
bt_event_name (bt_event_kind kind)
{
  switch (kind)
    {
    case BT_EVENT_TAUT:
      return "taut";
    case BT_EVENT_SLACK:
      return "slack";
    case BT_EVENT_ARRIVED:
      return "arrived";
    case BT_EVENT_SPOOLED:
      return "spooled";
    case BT_EVENT_STALLED:
      return "stalled";
    case BT_EVENT_PARTED:
      return "parted";
    case BT_EVENT_SNAPPED:
      return "snapped";
    case BT_EVENT_HOCKLED:
      return "hockled";
    case BT_EVENT_KINKED:
      return "kinked";
    case BT_EVENT_TOUCHED:
      return "touched";
    case BT_EVENT_LEFT:
      return "left";
    case BT_EVENT_STUCK:
      return "stuck";
    case BT_EVENT_PINCHED:
      return "pinched";
    case BT_EVENT_PROP_DANGER:
      return "prop-danger";
    case BT_EVENT_WORN:
      return "worn";
    case BT_EVENT_WRAPPED:
      return "wrapped";
    case BT_EVENT_FREED:
      return "freed";
    }
  return NULL;
}
