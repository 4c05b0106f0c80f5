/* The only table of the fields of all parts: parser, defaults, error messages, help, `alter!' and
   the validator read this table.  A field has a name, a unit, an offset in its struct, a default,
   bounds, words that stand for values, and a sentence.  Fields with `live' may be changed during a
   dive.  A default of NaN means: must be given, or follows from another field, unless a word stands
   for NaN.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <math.h>
#include <string.h>

#include <bight/model.h>

#include "base/error.h"
#include "math/vec.h"

#define COUNT_OF(array) (sizeof (array) / sizeof *(array))

static const bt_word inextensible[] = { { "inextensible", INFINITY }, { NULL, 0 } };
static const bt_word unbreakable[] = { { "none", INFINITY }, { NULL, 0 } };
static const bt_word unlimited[] = { { "none", INFINITY }, { NULL, 0 } };
static const bt_word automatic[] = { { "auto", BT_SAG_AUTO }, { NULL, 0 } };
static const bt_word usual[] = { { "auto", BT_WINCH_AUTO }, { NULL, 0 } };
static const bt_word by_length[] = { { "auto", BT_ACCURACY_AUTO }, { NULL, 0 } };
static const bt_word everywhere[] = { { "all", INFINITY }, { NULL, 0 } };
static const bt_word never[] = { { "none", INFINITY }, { NULL, 0 } };
static const bt_word yes_no[] = { { "yes", 1 }, { "no", 0 }, { NULL, 0 } };
static const bt_word responses[]
    = { { "physical", BT_RESPONSE_PHYSICAL }, { "thesis", BT_RESPONSE_THESIS }, { NULL, 0 } };
static const bt_word stick_rules[] = { { "angle", BT_STICK_BY_ANGLE },
                                       { "count", BT_STICK_BY_COUNT },
                                       { "either", BT_STICK_BY_EITHER },
                                       { "both", BT_STICK_BY_BOTH },
                                       { NULL, 0 } };
static const bt_word neutral[] = { { "neutral", NAN }, { NULL, 0 } };
static const bt_word maps[] = { { "t200", BT_MAP_T200 }, { "square", BT_MAP_SQUARE }, { NULL, 0 } };
static const bt_word as_tether[] = { { "tether", NAN }, { NULL, 0 } };

static const bt_word models[] = { { "rubber-band", BT_MODEL_RUBBER_BAND },
                                  { "v-shape", BT_MODEL_V_SHAPE },
                                  { "catenary", BT_MODEL_CATENARY },
                                  { "catenary-simplex", BT_MODEL_CATENARY_SIMPLEX },
                                  { "elastic", BT_MODEL_ELASTIC },
                                  { "steady", BT_MODEL_STEADY },
                                  { "dynamic", BT_MODEL_DYNAMIC },
                                  { "auto", BT_MODEL_AUTO },
                                  { NULL, 0 } };

static const bt_word depth_rules[] = { { "sag", BT_DEPTH_SAG },
                                       { "linear", BT_DEPTH_LINEAR },
                                       { "thesis-linear", BT_DEPTH_THESIS_LINEAR },
                                       { NULL, 0 } };

#define FAR 1e7 /* metres: no sea is larger */
#define LONG BT_LENGTH_MAX

/* NUMBER (struct, member, name, unit, default, min, max, min excluded, live, words, text) */
#define NUMBER(s, m, n, u, d, lo, hi, above, live, words, t)                                       \
  {                                                                                                \
    n, u, t, BT_FIELD_NUMBER, offsetof (s, m), d, lo, hi, above, words, live                       \
  }
#define OTHER(s, m, n, u, k, d, words, live, t)                                                    \
  {                                                                                                \
    n, u, t, k, offsetof (s, m), d, -FAR, FAR, 0, words, live                                      \
  }
#define COUNT(s, m, n, u, d, lo, hi, live, t)                                                      \
  {                                                                                                \
    n, u, t, BT_FIELD_COUNT, offsetof (s, m), d, lo, hi, 0, NULL, live                             \
  }

static const bt_field sea_fields[] = {
  NUMBER (bt_sea_def, depth, "depth", "m", 100, 0, 12000, 1, 0, NULL,
          "from the surface to the bed"),
  NUMBER (bt_sea_def, density, "density", "kg/m3", 1025, 1, 2000, 0, 1, NULL, "of the water"),
  NUMBER (bt_sea_def, gravity, "gravity", "m/s2", 9.80665, 0, 100, 0, 1, NULL, "downward"),
  OTHER (bt_sea_def, current, "current", "", BT_FIELD_CURRENT, 0, NULL, 1,
         "the flow, toward its bearing"),
  OTHER (bt_sea_def, wake, "wake", "", BT_FIELD_WORD, 0, yes_no, 1,
         "is the current less in the lee of what stands in it"),
  OTHER (bt_sea_def, waves, "waves", "", BT_FIELD_WAVES, 0, NULL, 1, "of the surface"),
};

/* Numbers along and about the own axes: two rows of three.  */
#define SIX(m, n, u, hi, t)                                                                        \
  {                                                                                                \
    n, u, t, BT_FIELD_SIX, offsetof (bt_vehicle_def, m), 0, 0, hi, 0, NULL, 0                      \
  }
#define POSITIVE(m, n, u, hi, t)                                                                   \
  {                                                                                                \
    n, u, t, BT_FIELD_POINT, offsetof (bt_vehicle_def, m), 0, 0, hi, 0, NULL, 0                    \
  }
#define NOISE(m, n, u, t)                                                                          \
  NUMBER (bt_vehicle_def, m, n, u, 0, 0, 1e3, 0, 0, NULL, t ", standard deviation")

static const bt_field vehicle_fields[] = {
  OTHER (bt_vehicle_def, at, "at", "m", BT_FIELD_POINT, 0, NULL, 0, "where it starts"),
  NUMBER (bt_vehicle_def, heading, "heading", "deg", 0, -1e6, 1e6, 0, 0, NULL,
          "compass bearing of its front"),
  NUMBER (bt_vehicle_def, pitch, "pitch", "deg", 0, -90, 90, 0, 0, NULL, "bow up positive"),
  NUMBER (bt_vehicle_def, roll, "roll", "deg", 0, -180, 180, 0, 0, NULL, "starboard down positive"),
  POSITIVE (size, "size", "m", 100,
            "of its hull, along its own x, y, z about its place; all 0: a point"),
  NUMBER (bt_vehicle_def, surge_speed, "surge-speed", "m/s", 1.0, 0, 100, 0, 1, NULL,
          "ahead at full stick; without mass"),
  NUMBER (bt_vehicle_def, sway_speed, "sway-speed", "m/s", 0.7, 0, 100, 0, 1, NULL,
          "sideways at full stick; without mass"),
  NUMBER (bt_vehicle_def, heave_speed, "heave-speed", "m/s", 0.7, 0, 100, 0, 1, NULL,
          "up at full stick; without mass"),
  NUMBER (bt_vehicle_def, yaw_rate, "yaw-rate", "deg/s", 45, 0, 3600, 0, 1, NULL,
          "turning at full stick"),
  NUMBER (bt_vehicle_def, pull, "pull", "N", 100, 0, 1e9, 0, 1, NULL,
          "the most it pulls with: a tether that pulls harder takes it along; without mass"),
  NUMBER (bt_vehicle_def, restitution, "restitution", "", 0.2, 0, 1, 0, 0, NULL,
          "of its hull; with mass"),
  NUMBER (bt_vehicle_def, mass, "mass", "kg", 0, 0, 1e6, 0, 0, NULL,
          "0: it goes exactly where it is told; else thrust, water and tether move it"),
  NUMBER (bt_vehicle_def, volume, "volume", "m3", NAN, 0, 1e6, 0, 0, neutral,
          "of water displaced; with mass, at most 800 times its mass of water"),
  POSITIVE (inertia, "inertia", "kg m2", 1e9,
            "of roll, pitch, yaw about the centre of gravity; 0: of a box of its size"),
  OTHER (bt_vehicle_def, buoyancy, "buoyancy-centre", "m", BT_FIELD_POINT, 0, NULL, 0,
         "from the centre of gravity, along its own x, y, z"),
  OTHER (bt_vehicle_def, attached, "tether-point", "m", BT_FIELD_POINT, 0, NULL, 0,
         "where the tether is made fast, likewise; with mass"),
  SIX (added, "added-mass", "kg, kg m2", 1e6, "of surge sway heave; roll pitch yaw"),
  SIX (linear, "linear-drag", "N s/m, N m s", 1e6, "of surge sway heave; roll pitch yaw"),
  SIX (quadratic, "quadratic-drag", "N s2/m2, N m s2", 1e6, "of surge sway heave; roll pitch yaw"),
  NUMBER (bt_vehicle_def, munk, "munk", "", 1, 0, 1, 0, 0, NULL,
          "share of the couple of a slender body in oblique flow that is kept"),
  SIX (
      steers, "steers", "", 1,
      "1 for what the thrusters command of surge sway heave; roll pitch yaw; all 0: what they can"),
  NUMBER (bt_vehicle_def, volts, "volts", "V", 16, 0, 1e4, 0, 1, NULL, "of its battery"),
  NUMBER (bt_vehicle_def, seed, "seed", "", 1, 0, 1e9, 0, 0, NULL, "of the noise below"),
  NOISE (compass_noise, "compass-noise", "deg", "of the compass"),
  NOISE (depth_noise, "depth-noise", "m", "of the depth sensor"),
  NOISE (speed_noise, "speed-noise", "m/s", "of the speed over ground"),
  NOISE (altitude_noise, "altitude-noise", "m", "of the altimeter"),
  NOISE (range_noise, "range-noise", "m", "of the range to the ship, and of the sonar"),
  NOISE (bearing_noise, "bearing-noise", "deg", "of the bearing to the ship"),
  NOISE (tension_noise, "tension-noise", "N", "of the load cell at the winch"),
  NOISE (counter_noise, "counter-noise", "m", "of the payout counter"),
};

static const bt_field thruster_fields[] = {
  OTHER (bt_thruster_def, at, "at", "m", BT_FIELD_POINT, 0, NULL, 0,
         "from the centre of gravity, along the vehicle's own x, y, z"),
  OTHER (bt_thruster_def, along, "along", "", BT_FIELD_POINT, 0, NULL, 0,
         "the way it pushes at a positive command"),
  NUMBER (bt_thruster_def, ahead, "ahead", "N", NAN, 0, 1e6, 1, 0, NULL, "the most that way"),
  NUMBER (bt_thruster_def, astern, "astern", "N", 0, 0, 1e6, 0, 0, NULL,
          "the most the other way; 0: as ahead"),
  OTHER (bt_thruster_def, map, "map", "", BT_FIELD_WORD, BT_MAP_SQUARE, maps, 0,
         "how it answers its command"),
  NUMBER (bt_thruster_def, dead, "dead", "", 0, 0, 0.9, 0, 0, NULL,
          "share of the command within which nothing turns"),
  NUMBER (bt_thruster_def, lag, "lag", "s", 0.1, 0, 100, 0, 0, NULL, "time constant"),
};

#define PROP(m, n, u, d, lo, hi, above, words, t)                                                  \
  NUMBER (bt_tether_def, props.m, n, u, d, lo, hi, above, 1, words, t)

static const bt_field tether_fields[] = {
  OTHER (bt_tether_def, from, "from", "m", BT_FIELD_END, 0, NULL, 0,
         "the anchor: a point, or a vehicle that carries the winch"),
  OTHER (bt_tether_def, to, "to", "m", BT_FIELD_END, 0, NULL, 0,
         "the far end: a vehicle, or a fixed point"),
  OTHER (
      bt_tether_def, along[0], "from-along", "", BT_FIELD_POINT, 0, NULL, 0,
      "the way it leaves its anchor, if clamped; of a vehicle along its own axes; 0 0 0: hinged"),
  OTHER (bt_tether_def, along[1], "to-along", "", BT_FIELD_POINT, 0, NULL, 0,
         "the way it leaves its far end, likewise"),
  OTHER (bt_tether_def, via, "via", "m", BT_FIELD_VIA, 0, NULL, 0,
         "points that it is laid through from its anchor to its far end"),
  NUMBER (bt_tether_def, length, "length", "m", NAN, 0, LONG, 1, 0, NULL,
          "paid out; pay-out! and haul-in! change it"),
  NUMBER (bt_tether_def, drum, "drum", "m", INFINITY, 0, LONG, 1, 0, unlimited,
          "the most that can be out"),
  { "ride", "",
    "shares of the water's heave, surge and sway that an anchor at a point takes in waves",
    BT_FIELD_POINT, offsetof (bt_tether_def, ride), 0, 0, 2, 0, NULL, 0 },
  /* Half a metre of lead weighs 2.2 t/m, of steel it stretches by 4e10 N.  */
  PROP (diameter, "diameter", "m", 0.0076, 0, 0.5, 1, NULL, "outer"),
  PROP (mass, "mass", "kg/m", NAN, 0, 3e3, 1, NULL,
        "in air; at least a fortieth of the water that the line displaces, or that its lift would "
        "carry; follows from wet-weight when not given"),
  PROP (wet_weight, "wet-weight", "N/m", NAN, -3e4, 3e4, 0, NULL,
        "in the water, sinking positive; follows from mass when not given"),
  PROP (ea, "ea", "N", 2e5, 0, 1e11, 1, inextensible,
        "axial stiffness; at most that of a solid rod of the diameter, ten thousand times as stiff "
        "as diamond"),
  PROP (ei, "ei", "N m2", 0, 0, 1e9, 0, NULL, "bending stiffness; at most that of such a rod"),
  PROP (gj, "gj", "N m2", 0, 0, 1e9, 0, NULL, "torsional stiffness; no more than `ei' may be"),
  PROP (ba, "ba", "N s", 20, 0, 1e9, 0, NULL,
        "internal damping; no more than `ea' for a second, but 1e5 in any case"),
  PROP (bending_damping, "bending-damping", "N m2 s", 0, 0, 1e9, 0, NULL,
        "internal damping of bending, of the moving line; no more than a hundredth of what `ei' "
        "may be, nor than `ei' for a second, but 1 in any case"),
  PROP (ei_stuck, "ei-stuck", "N m2", 0, 0, 1e9, 0, NULL,
        "bending stiffness of the moving line while the layers of its armour stick to each other, "
        "more than `ei', which is that of layers that slip; 0: as `ei'"),
  PROP (slip_curvature, "slip-curvature", "1/m", 0, 0, 1000, 0, NULL,
        "the curvature at which the layers of a straight line slip; 0: they always do"),
  PROP (cdn, "cdn", "", 1.2, 0, 20, 0, NULL, "normal drag coefficient, on the diameter"),
  PROP (cdt, "cdt", "", 0.01, 0, 5, 0, NULL, "tangential drag coefficient, on the circumference"),
  PROP (ca, "ca", "", 1, 0, 10, 0, NULL, "normal added mass per displaced mass"),
  PROP (friction, "friction", "", 0.3, 0, 10, 0, NULL, "Coulomb coefficient against obstacles"),
  PROP (breaking_load, "breaking-load", "N", INFINITY, 0, 1e9, 1, unbreakable,
        "the tension it parts at"),
  PROP (min_bend_radius, "min-bend-radius", "m", 0, 0, 100, 0, NULL, "the tightest bend allowed"),
  PROP (wear_energy, "wear-energy", "J/m", 1e5, 0, 1e12, 1, never,
        "slip work that wears the jacket through, over the length it is done on; an estimate"),
  PROP (wear_limit, "wear-limit", "", 1, 0, 1, 1, NULL,
        "share of the jacket worn at which the event `worn' comes"),
  COUNT (bt_tether_def, props.nodes, "nodes", "", 64, 2, BT_NODES_MAX, 0,
         "intervals of the models that have nodes, of the length that is laid"),
  OTHER (bt_tether_def, props.model, "model", "", BT_FIELD_WORD, BT_MODEL_STEADY, models, 1,
         "how its shape is found"),
  OTHER (bt_tether_def, props.depth_rule, "depth-rule", "", BT_FIELD_WORD, BT_DEPTH_SAG,
         depth_rules, 1, "how the thesis' models take depth"),
  PROP (sag_buoyancy, "sag-buoyancy", "", BT_SAG_AUTO, -1, 1, 0, automatic,
        "the thesis' buoyancy for rule `sag': -1 sinks, 1 floats"),
  PROP (accuracy, "accuracy", "m", BT_ACCURACY_AUTO, 0, 100, 1, by_length,
        "the error in position that nodes come and go for: always in model `auto', in `dynamic' "
        "once its winch has turned; `auto': 0.02, or 0.2 % of what is paid out if that is less"),
  PROP (tension_accuracy, "tension-accuracy", "", 0.02, 1e-4, 1, 0, unlimited,
        "the error in the tension of a moving line, as a share of it, that its steps are divided "
        "for; `none': never"),
  PROP (max_current, "max-current", "m/s", 1, 0, 100, 1, NULL,
        "the thesis' maximum allowed current, for rule `sag'"),
  PROP (thesis_length_factor, "thesis-length-factor", "", 1, 0.5, 1, 0, NULL,
        "of the length in rule `thesis-linear'; the thesis took 0.95"),
  OTHER (bt_tether_def, props.response, "response", "", BT_FIELD_WORD, BT_RESPONSE_PHYSICAL,
         responses, 1, "to obstacles, as its model has it: for a world to say which it means"),
  PROP (rejoin_angle, "rejoin-angle", "deg", 185, 90, 360, 0, NULL,
        "response `thesis': a contact that opens so far is left"),
  PROP (stick_angle, "stick-angle", "deg", 90, 0, 36000, 0, NULL,
        "response `thesis': it sticks when the normals of its contacts turn by more"),
  PROP (stick_count, "stick-count", "", INFINITY, 1, 1000, 0, never,
        "response `thesis': it sticks when it has so many contacts"),
  OTHER (bt_tether_def, props.stick_by, "stick-by", "", BT_FIELD_WORD, BT_STICK_BY_ANGLE,
         stick_rules, 1, "response `thesis': which of the two makes it stick"),
  OTHER (bt_tether_def, props.sliding, "sliding", "", BT_FIELD_WORD, 1, yes_no, 1,
         "response `thesis': may it slide; else it sticks wherever it touches"),
  PROP (winch_pull, "winch-pull", "N", BT_WINCH_AUTO, 0, 1e9, 1, usual,
        "the most that its winch hauls with, which stalls it; `auto': 500, or half of the "
        "breaking-load if that is less"),
  PROP (winch_brake, "winch-brake", "N", INFINITY, 0, 1e9, 1, unlimited,
        "what its winch holds while it does not haul: a moving line that pulls harder draws line "
        "off the drum"),
  PROP (winch_rate, "winch-rate", "m/s", INFINITY, 0, 1000, 1, unlimited,
        "the fastest that its winch turns, whatever rate is asked of it"),
  PROP (winch_lag, "winch-lag", "s", 0.25, 0, 100, 0, NULL,
        "time constant in which a moving line follows its winch"),
};

#define LUMP_PLACE                                                                                 \
  NUMBER (bt_lump, at, "at", "m", NAN, 0, LONG, 0, 0, NULL,                                        \
          "arc length of its middle from the anchor when the dive begins"),                        \
      NUMBER (bt_lump, span, "span", "m", 0, 0, LONG, 0, 0, NULL, "the length of line it covers")

static const bt_field clump_fields[] = {
  LUMP_PLACE,
  NUMBER (bt_lump, mass, "mass", "kg", NAN, 0, 1e5, 1, 0, NULL, "in air, of steel"),
};

static const bt_field float_fields[] = {
  LUMP_PLACE,
  NUMBER (bt_lump, buoyancy, "buoyancy", "N", NAN, 0, 1e6, 1, 0, NULL, "net, upward"),
};

static const bt_field set_fields[] = {
  NUMBER (bt_set, at, "at", "m", 0, 0, LONG, 0, 0, NULL,
          "arc length of its middle from the anchor when the dive begins"),
  NUMBER (bt_set, span, "span", "m", INFINITY, 0, LONG, 1, 0, everywhere,
          "the length of line it is on; `all': the whole tether, on the drum too"),
  NUMBER (bt_set, curvature, "curvature", "1/m", NAN, 0, 1000, 0, 0, NULL,
          "that the line has where nothing bends it; one by the radius"),
  NUMBER (bt_set, plane, "plane", "deg", 0, -1e6, 1e6, 0, 0, NULL,
          "the side it bends to, counted about the line against its other sets"),
};

/* ---- Obstacles: they share a struct, of which each kind has its own fields ---- */

#define PLACE(t) OTHER (bt_obstacle_def, at, "at", "m", BT_FIELD_POINT, 0, NULL, 0, t)
#define AXIS                                                                                       \
  OTHER (bt_obstacle_def, from, "from", "m", BT_FIELD_POINT, 0, NULL, 0,                           \
         "the end of its axis that it winds from"),                                                \
      OTHER (bt_obstacle_def, to, "to", "m", BT_FIELD_POINT, 0, NULL, 0,                           \
             "the other end of its axis")
#define RADIUS                                                                                     \
  NUMBER (bt_obstacle_def, radius, "radius", "m", NAN, 0, FAR, 1, 0, NULL,                         \
          "from its centre or axis to its surface")
#define HEADING                                                                                    \
  NUMBER (bt_obstacle_def, heading, "heading", "deg", 0, -1e6, 1e6, 0, 0, NULL,                    \
          "compass bearing of its own north")
#define TURNED                                                                                     \
  HEADING,                                                                                         \
      NUMBER (bt_obstacle_def, pitch, "pitch", "deg", 0, -90, 90, 0, 0, NULL, "bow up positive"),  \
      NUMBER (bt_obstacle_def, roll, "roll", "deg", 0, -180, 180, 0, 0, NULL,                      \
              "starboard down positive")
#define FRICTION                                                                                   \
  NUMBER (bt_obstacle_def, friction, "friction", "", NAN, 0, 10, 0, 1, as_tether,                  \
          "Coulomb coefficient of a tether on it; `tether': the tether's own")
#define ABRASIVE                                                                                   \
  NUMBER (bt_obstacle_def, abrasiveness, "abrasiveness", "", 1, 0, 1e6, 0, 0, NULL,                \
          "how many times as fast as bare steel it wears a tether's jacket")
#define TRACK                                                                                      \
  OTHER (bt_obstacle_def, track, "track", "", BT_FIELD_TRACK, 0, NULL, 0,                          \
         "where its place is at which time, when it moves: in place of `at' and `heading'")

static const bt_field seabed_fields[] = {
  FRICTION,
  ABRASIVE,
  OTHER (bt_obstacle_def, grid, "grid", "", BT_FIELD_GRID, 0, NULL, 0,
         "heights: a file, an ESRI ASCII grid, or a procedure of x and y"),
  OTHER (bt_obstacle_def, mesh, "mesh", "", BT_FIELD_MESH, 0, NULL, 0, "a file of triangles"),
  PLACE ("where the origin of its grid or mesh goes"),
};

static const bt_field box_fields[] = {
  PLACE ("its centre"),
  { "size", "m", "along its own x, y, z", BT_FIELD_POINT, offsetof (bt_obstacle_def, size), NAN, 0,
    FAR, 1, NULL, 0 },
  TURNED,
  FRICTION,
  ABRASIVE,
  TRACK,
};

static const bt_field sphere_fields[] = { PLACE ("its centre"), RADIUS, FRICTION, ABRASIVE, TRACK };

static const bt_field cylinder_fields[] = { AXIS, RADIUS, FRICTION, ABRASIVE, TRACK };

static const bt_field convex_fields[] = {
  OTHER (bt_obstacle_def, points, "points", "m", BT_FIELD_POINTS, 0, NULL, 0,
         "it is their hull: four or more, relative to `at'"),
  PLACE ("where their origin goes"),
  TURNED,
  FRICTION,
  ABRASIVE,
  TRACK,
};

static const bt_field mesh_fields[] = {
  OTHER (bt_obstacle_def, mesh, "file", "", BT_FIELD_MESH, 0, NULL, 0, "of its triangles"),
  PLACE ("where its origin goes"),
  TURNED,
  NUMBER (bt_obstacle_def, scale, "scale", "", 1, 0, 1e6, 1, 0, NULL, "metres of one unit"),
  FRICTION,
  ABRASIVE,
  TRACK,
};

/* ---- Kinds of parts ---- */

#define HEAD(name, inside, text, type, fields, obstacle)                                           \
  {                                                                                                \
    name, inside, text, sizeof (type), fields, COUNT_OF (fields), obstacle                         \
  }
#define OBSTACLE(name, text, fields, kind) HEAD (name, NULL, text, bt_obstacle_def, fields, kind)

static const bt_head heads[] = {
  HEAD ("sea", NULL, "the water and its current", bt_sea_def, sea_fields, -1),
  HEAD ("rov", NULL, "a vehicle", bt_vehicle_def, vehicle_fields, -1),
  HEAD ("thruster", "rov", "a thruster of a vehicle", bt_thruster_def, thruster_fields, -1),
  HEAD ("tether", NULL, "a tether between its anchor and a vehicle", bt_tether_def, tether_fields,
        -1),
  HEAD ("clump", "tether", "a clump weight on a tether", bt_lump, clump_fields, -1),
  HEAD ("float", "tether", "a float or a buoyant section on a tether", bt_lump, float_fields, -1),
  HEAD ("set", "tether", "a natural curvature that a drum or a kink has left in a tether", bt_set,
        set_fields, -1),
  OBSTACLE ("seabed", "the bottom: level at the depth of the sea, or a grid or mesh of it",
            seabed_fields, BT_OBSTACLE_SEABED),
  OBSTACLE ("box", "a solid box", box_fields, BT_OBSTACLE_BOX),
  OBSTACLE ("sphere", "a solid sphere", sphere_fields, BT_OBSTACLE_SPHERE),
  OBSTACLE ("cylinder", "a solid cylinder with flat ends", cylinder_fields, BT_OBSTACLE_CYLINDER),
  OBSTACLE ("capsule", "a solid cylinder with round ends", cylinder_fields, BT_OBSTACLE_CAPSULE),
  OBSTACLE ("convex", "the convex hull of some points, solid", convex_fields, BT_OBSTACLE_CONVEX),
  OBSTACLE ("mesh", "triangles from a file: a surface with two sides", mesh_fields,
            BT_OBSTACLE_MESH),
};

/* ---- Bounds that follow from other fields ---- */

#define STIFFEST 1e16 /* Pa: ten thousand times diamond, so that a line may be all but rigid */
#define WITHIN 0.01   /* s */
#define CREEPS                                                                                     \
  1.0            /* s: the longest in which a line gives way to its load or its bend, unless ... */
#define SOFT 1e5 /* N s: ... it damps no more than this, ... */
#define SUPPLE 1.0 /* N m2 s: ... or its bending no more than this */

#define AREA (BT__PI / 4)
#define OF_AREA (BT__PI / 64)
#define ROD "a rod 10 000 times as stiff as diamond has no more"

/* A line stiffer than a rod of STIFFEST, of next to no weight, moves by more energy than the
   solver's rounding can hold.  The length that a step leaves undone, times `ba' over the step, is a
   tension: a line may give way as slowly as nobody sees, but not in hours what a step stretches the
   line by. A turn is a difference of chords, so an interval strained more than the next one counts
   as turned: `bending-damping' then keeps the strain where the strain is.  */
static const bt_bound bounds[] = {
  { "ea", "diameter", STIFFEST *AREA, 2, 0, ROD },
  { "ei", "diameter", STIFFEST *OF_AREA, 4, 0, ROD },
  { "ei-stuck", "diameter", STIFFEST *OF_AREA, 4, 0, ROD },
  { "gj", "diameter", STIFFEST *OF_AREA, 4, 0, ROD },
  { "ba", "ea", CREEPS, 1, SOFT, "so much gives way to a load within a second" },
  { "bending-damping", "diameter", WITHIN *STIFFEST *OF_AREA, 4, 0, ROD },
  { "bending-damping", "ei", CREEPS, 1, SUPPLE, "so much gives way to a bend within a second" },
};

const bt_bound *
bt_bounds (size_t *n)
{
  *n = COUNT_OF (bounds);
  return bounds;
}

const bt_head *
bt_heads (size_t *n)
{
  *n = COUNT_OF (heads);
  return heads;
}

const bt_head *
bt_head_find (const char *name)
{
  for (size_t i = 0; i < COUNT_OF (heads); i++)
    if (name && strcmp (heads[i].name, name) == 0)
      return &heads[i];
  return NULL;
}

const bt_field *
bt_field_find (const bt_head *head, const char *name)
{
  for (size_t i = 0; head && name && i < head->n_fields; i++)
    if (strcmp (head->fields[i].name, name) == 0)
      return &head->fields[i];
  return NULL;
}
