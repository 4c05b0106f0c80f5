/* Controllers, by SDL's own virtual devices: what is plugged in, moved, pressed and lost comes as
   events, from several at once, with the names of SDL's database or with numbers.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

#define SDL_MAIN_HANDLED
#include <SDL.h>

#include "controller/controller.h"

typedef struct bench
{
  bt__controllers *all;
  bt__controller_event event;
} bench;

static int
plug_in (void **state)
{
  static bench b;
  bt_error error;
  memset (&b, 0, sizeof b);
  assert_int_equal (bt__controllers_new (&b.all, &error), BT_OK);
  while (bt__controllers_next (b.all, &b.event))
    ;
  *state = &b;
  return 0;
}

static int
unplug (void **state)
{
  bt__controllers_free (((bench *)*state)->all);
  return 0;
}

/* True if NOW tells nothing beside OLD, the event before: an axis again, or one at rest that is not
   NAME.  */
static int
tells_nothing (const bt__controller_event *old, const bt__controller_event *now, const char *name)
{
  int again = now->value == old->value && strcmp (now->name, old->name) == 0,
      rests = now->value == 0 && !(name && strcmp (now->name, name) == 0);
  return now->what == BT__CONTROLLER_AXIS && (again || rests);
}

/* True if there is another event that tells anything.  SDL 2 tells where the axes of a device stand
   as the device is plugged in, SDL 2 made of SDL 3 with the first event of the device, and some
   events twice.  */
static int
next (bench *b, const char *name)
{
  bt__controller_event old;
  int any;
  do
    {
      old = b->event;
      any = bt__controllers_next (b->all, &b->event);
    }
  while (any && tells_nothing (&old, &b->event, name));
  return any;
}

/* The next event, which must be WHAT of NAME.  */
static const bt__controller_event *
next_is (bench *b, bt__controller_what what, const char *name)
{
  assert_true (next (b, name));
  assert_int_equal (b->event.what, what);
  if (name)
    assert_string_equal (b->event.name, name);
  return &b->event;
}

static void
nothing_more (bench *b)
{
  assert_false (next (b, NULL));
}

/* Plug a virtual device in, and return its number; *AT is its place among SDL's.  */
static int
plug (bench *b, SDL_JoystickType type, int buttons, int hats, int known, int *at)
{
  *at = SDL_JoystickAttachVirtual (type, 6, buttons, hats);
  assert_true (*at >= 0);
  assert_int_equal (next_is (b, BT__CONTROLLER_PLUGGED, NULL)->known, known);
  assert_true (strlen (b->event.name) > 0);
  int id = b->event.id;
  while (bt__controllers_next (b->all, &b->event)) /* where its axes stand at first */
    assert_true (b->event.id == id && b->event.what == BT__CONTROLLER_AXIS);
  return id;
}

/* Pull the device at AT out: all that was moved comes back to rest, then the device is lost.  */
static void
pull (bench *b, int at, int id)
{
  assert_int_equal (SDL_JoystickDetachVirtual (at), 0);
  do
    assert_true (next (b, NULL) && b->event.id == id);
  while (b->event.what != BT__CONTROLLER_LOST && b->event.value == 0);
  assert_int_equal (b->event.what, BT__CONTROLLER_LOST);
}

static SDL_Joystick *
stick_of (int id)
{
  SDL_Joystick *stick = SDL_JoystickFromInstanceID (id);
  assert_non_null (stick);
  return stick;
}

static void
a_pad_has_the_names_of_the_database (void **state)
{
  bench *b = *state;
  int at, id = plug (b, SDL_JOYSTICK_TYPE_GAMECONTROLLER, 15, 0, 1, &at);
  SDL_JoystickSetVirtualAxis (stick_of (id), SDL_CONTROLLER_AXIS_LEFTY, -32768);
  SDL_JoystickSetVirtualAxis (stick_of (id), SDL_CONTROLLER_AXIS_RIGHTX, 16384);
  assert_true (next_is (b, BT__CONTROLLER_AXIS, "lefty")->value == -1);
  assert_true (fabs (next_is (b, BT__CONTROLLER_AXIS, "rightx")->value - 0.5) < 1e-4);
  assert_int_equal (b->event.id, id);
  SDL_JoystickSetVirtualButton (stick_of (id), SDL_CONTROLLER_BUTTON_X, 1);
  assert_true (next_is (b, BT__CONTROLLER_BUTTON, "x")->value == 1);
  SDL_JoystickSetVirtualButton (stick_of (id), SDL_CONTROLLER_BUTTON_X, 0);
  assert_true (next_is (b, BT__CONTROLLER_BUTTON, "x")->value == 0);
  nothing_more (b);
  pull (b, at, id);
  nothing_more (b);
}

static void
a_stick_that_is_unknown_has_numbers (void **state)
{
  bench *b = *state;
  int at, id = plug (b, SDL_JOYSTICK_TYPE_FLIGHT_STICK, 4, 1, 0, &at);
  SDL_JoystickSetVirtualAxis (stick_of (id), 3, 32767);
  SDL_JoystickSetVirtualButton (stick_of (id), 2, 1);
  SDL_JoystickSetVirtualHat (stick_of (id), 0, SDL_HAT_RIGHTUP);
  assert_true (next_is (b, BT__CONTROLLER_AXIS, "axis3")->value == 1);
  assert_true (next_is (b, BT__CONTROLLER_BUTTON, "button2")->value == 1);
  assert_true (next_is (b, BT__CONTROLLER_BUTTON, "hat0up")->value == 1);
  assert_true (next_is (b, BT__CONTROLLER_BUTTON, "hat0right")->value == 1);
  SDL_JoystickSetVirtualHat (stick_of (id), 0, SDL_HAT_RIGHT);
  assert_true (next_is (b, BT__CONTROLLER_BUTTON, "hat0up")->value == 0);
  nothing_more (b);
  pull (b, at, id);
}

static void
several_are_told_apart (void **state)
{
  bench *b = *state;
  int first_at, second_at, again_at;
  int first = plug (b, SDL_JOYSTICK_TYPE_FLIGHT_STICK, 2, 0, 0, &first_at);
  int second = plug (b, SDL_JOYSTICK_TYPE_GAMECONTROLLER, 15, 0, 1, &second_at);
  assert_int_not_equal (first, second);
  SDL_JoystickSetVirtualAxis (stick_of (second), SDL_CONTROLLER_AXIS_LEFTX, 32767);
  assert_int_equal (next_is (b, BT__CONTROLLER_AXIS, "leftx")->id, second);
  SDL_JoystickSetVirtualAxis (stick_of (first), 0, 32767);
  assert_int_equal (next_is (b, BT__CONTROLLER_AXIS, "axis0")->id, first);
  pull (b, first_at, first);
  SDL_JoystickSetVirtualAxis (stick_of (second), SDL_CONTROLLER_AXIS_LEFTX, 0);
  assert_int_equal (next_is (b, BT__CONTROLLER_AXIS, "leftx")->id, second);
  int again = plug (b, SDL_JOYSTICK_TYPE_FLIGHT_STICK, 2, 0, 0, &again_at);
  assert_true (again != first && again != second);
  nothing_more (b);
}

int
main (void)
{
  const struct CMUnitTest tests[] = {
    cmocka_unit_test_setup_teardown (a_pad_has_the_names_of_the_database, plug_in, unplug),
    cmocka_unit_test_setup_teardown (a_stick_that_is_unknown_has_numbers, plug_in, unplug),
    cmocka_unit_test_setup_teardown (several_are_told_apart, plug_in, unplug),
  };
  cmocka_set_message_output (CM_OUTPUT_TAP);
  return cmocka_run_group_tests (tests, NULL, NULL);
}
