/* Instruments, sonar and camera of a vehicle.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <math.h>
#include <string.h>

#include "guile/guile.h"

#define DEGREES (180 / 3.14159265358979323846)

/* VALUE times SCALE, or #f where an instrument shows nothing.  */
static SCM
shown (double value, double scale)
{
  return isnan (value) ? SCM_BOOL_F : scm_from_double (value * scale);
}

static SCM
instruments (SCM object, SCM index)
{
  bt_readings r;
  bt_error error;
  SCM list = SCM_EOL;
  bt__check ("instruments",
             bt_dive_instruments (bt__to_dive (object), scm_to_int (index), &r, &error), &error);
  list = bt__associate ("payout", shown (r.payout, 1), list);
  list = bt__associate ("tension", shown (r.tension, 1), list);
  list = bt__associate ("bearing", shown (r.bearing, DEGREES), list);
  list = bt__associate ("range", shown (r.range, 1), list);
  list = bt__associate ("turns", shown (r.turns, 1), list);
  list = bt__associate ("up", shown (r.up, 1), list);
  list = bt__associate ("aside", shown (r.aside, 1), list);
  list = bt__associate ("ahead", shown (r.ahead, 1), list);
  list = bt__associate ("altitude", shown (r.altitude, 1), list);
  list = bt__associate ("depth", shown (r.depth, 1), list);
  list = bt__associate ("roll", shown (r.roll, DEGREES), list);
  list = bt__associate ("pitch", shown (r.pitch, DEGREES), list);
  return bt__associate ("heading", shown (r.heading, DEGREES), list);
}

static SCM
altitude (SCM object, SCM point)
{
  bt_dive *dive = bt__to_dive (object);
  double above;
  int obstacle;
  bt_error error;
  bt__check (
      "rov-altitude",
      bt_dive_altitude (dive, bt__to_point ("rov-altitude", point), &above, &obstacle, &error),
      &error);
  return scm_cons (scm_from_double (above),
                   obstacle < 0 ? SCM_BOOL_F : bt__obstacle_name (dive, obstacle));
}

static SCM
fault_names (void)
{
  SCM list = SCM_EOL;
  for (int fault = BT_FAULT_THRUSTER; fault > 0; fault /= 2)
    list = bt__associate (bt_fault_name ((bt_fault)fault), scm_from_int (fault), list);
  return list;
}

static SCM
faults (SCM object, SCM index)
{
  int64_t lost, sum = bt_dive_faults (bt__to_dive (object), scm_to_int (index), &lost);
  SCM list = SCM_EOL;
  for (int k = BT_THRUSTERS_MAX; k-- > 0;)
    if (lost >> k & 1)
      list = scm_cons (scm_list_2 (scm_from_utf8_symbol ("thruster"), scm_from_int (k)), list);
  for (int fault = BT_FAULT_TELEMETRY; fault > 0; fault /= 2)
    if (sum & fault)
      list = scm_cons (scm_from_utf8_symbol (bt_fault_name ((bt_fault)fault)), list);
  return list;
}

static SCM
thrusts (SCM object, SCM index)
{
  double thrust[BT_THRUSTERS_MAX];
  int n = bt_dive_thrusts (bt__to_dive (object), scm_to_int (index), thrust);
  SCM v = scm_make_f64vector (scm_from_int (n), SCM_INUM0);
  memcpy (SCM_BYTEVECTOR_CONTENTS (v), thrust, (size_t)n * sizeof *thrust);
  return v;
}

static SCM
transponders (SCM object, SCM index, SCM count, SCM noise)
{
  bt_dive *dive = bt__to_dive (object);
  int n = scm_to_int (count);
  bt_vec3 *points = scm_gc_malloc_pointerless (sizeof *points * (size_t)n, "transponders");
  bt_error error;
  bt__check (
      "transponders",
      bt_dive_transponders (dive, scm_to_int (index), n, scm_to_double (noise), points, &error),
      &error);
  return bt__from_points (points, n);
}

static SCM
sonar (SCM object, SCM index, SCM angles, SCM range, SCM beams)
{
  bt_vec3 a = bt__to_point ("sonar", angles); /* sector, tilt, width */
  bt_sonar s
      = { a.x / DEGREES, a.y / DEGREES, scm_to_double (range), scm_to_int (beams), a.z / DEGREES };
  double echo[BT_BEAMS_MAX];
  bt_error error;
  SCM v;
  bt__check ("sonar", bt_dive_sonar (bt__to_dive (object), scm_to_int (index), &s, echo, &error),
             &error);
  v = scm_make_f64vector (scm_from_int (s.beams), SCM_INUM0);
  memcpy (SCM_BYTEVECTOR_CONTENTS (v), echo, (size_t)s.beams * sizeof *echo);
  return v;
}

static SCM
sight (SCM object, SCM index, SCM tether, SCM angles, SCM far)
{
  bt_vec3 a = bt__to_point ("in-view?", angles); /* width, height, tilt */
  bt_eye camera = { a.x / DEGREES, a.y / DEGREES, a.z / DEGREES, scm_to_double (far) };
  bt_sighting s;
  bt_error error;
  bt__check ("in-view?",
             bt_dive_sight (bt__to_dive (object), scm_to_int (index), &camera, scm_to_int (tether),
                            &s, &error),
             &error);
  return scm_cons (scm_from_double (s.length), scm_from_double (s.nearest));
}

void
bt__define_instruments (void)
{
  static const bt__procedure table[] = {
    { "%instruments", 2, 0, (scm_t_subr)instruments,
      "Return what the instruments of the INDEX-th vehicle of DIVE show, an alist; #f: nothing." },
    { "%altitude", 2, 0, (scm_t_subr)altitude,
      "Return (METRES . NAME): how high the point P of DIVE is above what is below it, and what "
      "that "
      "is; #f: nothing, and the metres are above the depth of the sea." },
    { "%fault-names", 0, 0, (scm_t_subr)fault_names,
      "Return the faults there are, an alist from names to what the operation takes." },
    { "%faults", 2, 0, (scm_t_subr)faults,
      "Return the faults of the INDEX-th vehicle of DIVE, symbols and lists (thruster K)." },
    { "%thrusts", 2, 0, (scm_t_subr)thrusts,
      "Return what the thrusters of the INDEX-th vehicle of DIVE push with, N, an f64vector." },
    { "%transponders", 4, 0, (scm_t_subr)transponders,
      "Return where N transponders on the INDEX-th tether of DIVE say that they are, an N x 3 "
      "array "
      "with NOISE metres of noise in each coordinate." },
    { "%sonar", 5, 0, (scm_t_subr)sonar,
      "Return the echoes of BEAMS beams of the INDEX-th vehicle of DIVE to RANGE metres, an "
      "f64vector from port to starboard: ANGLES are the sector, the tilt and the width of a beam "
      "in "
      "degrees." },
    { "%sight", 5, 0, (scm_t_subr)sight,
      "Return (LENGTH . NEAREST) of what a camera of the INDEX-th vehicle of DIVE sees of TETHER: "
      "ANGLES are its width, height and tilt in degrees, FAR how many metres one sees." },
  };
  bt__define_procedures (table, sizeof table / sizeof *table);
}
