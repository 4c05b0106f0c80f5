/* Autopilots hold what they are told, against current and pull, and let go when a stick says so.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

#include "vehicle/body.h"
#include "vehicle/pilot.h"

#define STEP (1.0 / 60)
#define G 9.80665
#define DEGREE (BT__PI / 180)

typedef struct flight
{
  bt__vehicle_type type;
  bt__rig rig;
  bt__rigid body;
  bt__pilot pilot;
  bt__rigid_input in;
  double bottom; /* m */
} flight;

static flight
flight_of (const char *name)
{
  flight f = { .bottom = -40 };
  bt_error error;
  assert_int_equal (bt__vehicle_type_find (name, &f.type, &error), BT_OK);
  assert_int_equal (bt__rig_make (&f.type, &f.rig, &error), BT_OK);
  bt__rigid_place (&f.body, bt__vec (0, 0, -20), 0, 0, 0);
  f.in = (bt__rigid_input){ .h = STEP, .density = 1025, .gravity = G, .surface = 0 };
  f.pilot.holds = BT__HOLD_LEVEL;
  f.pilot.yaw_rate = 1;
  return f;
}

static bt__fix
fix_of (const flight *f)
{
  bt_vec3 own = { 0, 0, 0 };
  return (bt__fix){ f->body.position, bt__rigid_point_velocity (&f->body, own), f->body.attitude,
                    f->body.spin, f->body.position.z - f->bottom };
}

static void
fly (flight *f, double seconds)
{
  bt_error error;
  for (int n = (int)(seconds * 60 + 0.5); n > 0; n--)
    {
      bt__fix fix = fix_of (f);
      bt__pilot_steer (&f->type, &f->rig, &f->pilot, &fix, STEP, f->in.wish);
      assert_int_equal (bt__rigid_step (&f->type, &f->body, &f->in, &error), BT_OK);
    }
}

static void
assert_close (double value, double expected, double tolerance, const char *what)
{
  if (!(fabs (value - expected) <= tolerance))
    fail_msg ("%s: %.9g is not %.9g within %g", what, value, expected, tolerance);
}

/* BlueROV2 Heavy with T200 at 16 V: ahead 129.7 N, 0.91 m/s; up 206 N, 0.96 m/s, each within 2 %.
   v = (-l + sqrt (l2 + 4 q T)) / 2 q.  */
static void
test_full_stick (void **state)
{
  (void)state;
  flight f = flight_of ("bluerov2-heavy");
  f.pilot.sticks[0] = 1;
  fly (&f, 60);
  assert_close (f.body.velocity.y, 0.91, 0.02 * 0.91, "surge");
  assert_close (f.body.velocity.x, 0, 1e-3, "sway");
  assert_close (bt__pitch_of (f.body.attitude), 0, 0.5 * DEGREE, "pitch");
  f = flight_of ("bluerov2-heavy");
  f.body.position.z = -200;
  f.pilot.sticks[2] = 1;
  fly (&f, 60);
  assert_close (f.body.velocity.z, 0.96, 0.02 * 0.96, "heave");
}

/* Every type flies straight at every stick, bow level.  */
static void
test_every_type_flies (void **state)
{
  (void)state;
  for (int i = 0; bt__vehicle_type_name (i); i++)
    for (int stick = 0; stick < 3; stick++)
      for (double amount = -1; amount <= 1; amount += 0.5)
        {
          flight f = flight_of (bt__vehicle_type_name (i));
          f.bottom = -1e4;
          f.body.position.z = -500;
          f.pilot.holds |= BT__HOLD_HEADING | (stick == 2 ? 0 : BT__HOLD_DEPTH);
          f.pilot.height = -500;
          /* Wu's drag lets it go faster than its thrusters can keep it from turning broadside.  */
          int wu = strcmp (f.type.name, "bluerov2-heavy-wu") == 0;
          f.pilot.sticks[stick] = wu ? 0.2 * amount : amount;
          fly (&f, 60);
          double tilt = acos (fmin (1, bt__turn_out (f.body.attitude, bt__vec (0, 0, 1)).z));
          if (!(tilt < 12 * DEGREE && fabs (bt__twist_of (f.body.attitude)) < 5 * DEGREE))
            fail_msg ("%s, stick %d at %g: tilted by %g deg, heading %g deg", f.type.name, stick,
                      amount, tilt / DEGREE, bt__twist_of (f.body.attitude) / DEGREE);
          if (stick < 2)
            assert_close (f.body.position.z, -500, 0.5, f.type.name);
        }
}

/* Heading, depth, altitude and place are reached and kept in a current, without a lasting error. */
static void
test_holds (void **state)
{
  (void)state;
  for (int i = 0; bt__vehicle_type_name (i); i++)
    {
      flight f = flight_of (bt__vehicle_type_name (i));
      const char *name = f.type.name;
      f.pilot.holds |= BT__HOLD_HEADING | BT__HOLD_POSITION;
      f.pilot.heading = 200 * DEGREE;
      f.pilot.place = bt__vec (3, -4, -17);
      f.in.flow = bt__vec (0.2, 0.1, 0);
      fly (&f, 120);
      assert_close (bt__distance (f.body.position, f.pilot.place), 0, 0.02, name);
      assert_close (remainder (f.body.heading - 200 * DEGREE, 2 * BT__PI), 0, 1 * DEGREE, name);
      f.pilot.holds = BT__HOLD_LEVEL | BT__HOLD_ALTITUDE;
      f.pilot.altitude = 11;
      fly (&f, 90);
      assert_close (f.body.position.z, -29, 0.02, name);
      f.pilot.holds = BT__HOLD_LEVEL | BT__HOLD_DEPTH;
      f.pilot.height = -10;
      fly (&f, 120);
      assert_close (f.body.position.z, -10, 0.02, name);
    }
}

/* The way to a waypoint is straight, at the speed told, bow ahead, and ends.  */
static void
test_waypoint (void **state)
{
  (void)state;
  flight f = flight_of ("bluerov2-heavy");
  f.pilot.holds |= BT__HOLD_WAYPOINT;
  f.pilot.place = bt__vec (12, 16, -20);
  f.pilot.speed = 0.5;
  fly (&f, 20);
  bt_vec3 v = bt__turn_out (f.body.attitude, f.body.velocity);
  assert_close (bt__norm (v), 0.5, 0.15, "speed");
  assert_close (f.body.heading, atan2 (12, 16), 2 * DEGREE, "bow");
  assert_close (f.body.position.x / f.body.position.y, 0.75, 0.05, "straight");
  fly (&f, 100);
  bt__fix fix = fix_of (&f);
  assert_true (bt__pilot_arrived (&f.pilot, &fix));
}

/* Held down for a minute, far beyond its thrust, it does not shoot up when let go: the integral did
   not wind up.  */
static void
test_no_windup (void **state)
{
  (void)state;
  flight f = flight_of ("bluerov2-heavy");
  f.pilot.holds |= BT__HOLD_DEPTH;
  f.pilot.height = -20;
  f.pilot.speed = 40; /* so that nothing but the thrust is short */
  f.in.force = bt__vec (0, 0, -400);
  fly (&f, 60);
  assert_true (f.body.position.z < -25);
  f.in.force.z = 0;
  double highest = -100;
  for (int i = 0; i < 60 * 120; i++)
    {
      fly (&f, STEP);
      highest = fmax (highest, f.body.position.z);
    }
  assert_true (highest < -19.5);
  assert_close (f.body.position.z, -20, 0.02, "depth");
}

/* A stick overrides; let go, it returns to what was told, or keeps what it has.  */
static void
test_override (void **state)
{
  (void)state;
  for (int captures = 0; captures < 2; captures++)
    {
      flight f = flight_of ("bluerov2-heavy");
      f.pilot.holds |= BT__HOLD_DEPTH | BT__HOLD_HEADING | (captures ? BT__HOLD_CAPTURES : 0);
      f.pilot.height = -20;
      f.pilot.sticks[2] = -0.5;
      f.pilot.sticks[3] = 0.5;
      fly (&f, 10);
      double low = f.body.position.z, turned = f.body.heading;
      assert_true (low < -23 && turned > 1);
      f.pilot.sticks[2] = f.pilot.sticks[3] = 0;
      fly (&f, 90);
      assert_close (f.body.position.z, captures ? low : -20, captures ? 1 : 0.02, "depth");
      assert_close (remainder (f.body.heading - (captures ? turned : 0), 2 * BT__PI), 0,
                    captures ? 0.5 : 0.02, "heading");
    }
}

/* A full yaw stick turns at the rate told, clockwise: two turns are counted in two turns' time.  */
static void
test_yaw_rate_and_turns (void **state)
{
  (void)state;
  flight f = flight_of ("bluerov2-heavy");
  f.pilot.yaw_rate = 45 * DEGREE;
  f.pilot.sticks[3] = 1;
  fly (&f, 16);
  assert_close (f.body.heading / (2 * BT__PI), 2, 0.1, "turns");
}

/* One thruster dead: it still holds its place.  */
static void
test_thruster_loss (void **state)
{
  (void)state;
  flight f = flight_of ("bluerov2-heavy");
  f.pilot.holds |= BT__HOLD_HEADING | BT__HOLD_POSITION;
  f.pilot.place = bt__vec (2, 0, -20);
  f.in.lost = 1;
  fly (&f, 120);
  assert_close (bt__distance (f.body.position, f.pilot.place), 0, 0.05, "place");
}

int
main (void)
{
  const struct CMUnitTest tests[] = {
    cmocka_unit_test (test_full_stick),
    cmocka_unit_test (test_every_type_flies),
    cmocka_unit_test (test_holds),
    cmocka_unit_test (test_waypoint),
    cmocka_unit_test (test_no_windup),
    cmocka_unit_test (test_override),
    cmocka_unit_test (test_yaw_rate_and_turns),
    cmocka_unit_test (test_thruster_loss),
  };
  return cmocka_run_group_tests (tests, NULL, NULL);
}
