/* A world as data: parts as plain structs, one table of fields for each kind of part, and the
   immutable model compiled from a world.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#ifndef BIGHT_MODEL_H
#define BIGHT_MODEL_H

#include <stddef.h>
#include <stdint.h>

#include <bight/decls.h>
#include <bight/status.h>
#include <bight/tether.h>
#include <bight/vec.h>
#include <bight/water.h>

BT_BEGIN_DECLS

enum
{
  BT_NAME_SIZE = 64, /* bytes of a part's name with its final NUL */
  BT_VEHICLES_MAX = 64,
  BT_THRUSTERS_MAX = 12,
  BT_TETHERS_MAX = 64,
  BT_NODES_MAX = 10000,     /* intervals of one tether */
  BT_NODES_SUM_MAX = 50000, /* of all tethers of a world */
  BT_LENGTH_MAX = 100000,   /* m: of a tether, and of what is on its drum */
  BT_LUMPS_MAX = 32,        /* clumps and floats on one tether */
  BT_SETS_MAX = 32,         /* natural curvatures of one tether */
  BT_VIA_MAX = 32,          /* points that one tether is laid through */
  BT_OBSTACLES_MAX = 100000,
  BT_POSTS_MAX = 5000000,     /* of a grid */
  BT_TRIANGLES_MAX = 20000000 /* of all meshes and grids of a world */
};

/* The water and its current.  */
typedef struct bt_sea_def
{
  double depth;   /* m */
  double density; /* kg/m3 */
  double gravity; /* m/s2 */
  bt_current current;
  double wake; /* true: the current is less in the lee of what stands in it */
  bt_wave_def waves;
  bt_current_grid *grid; /* for a current of kind BT_CURRENT_GRID; borrowed: a model retains it */
} bt_sea_def;

/* Numbers along the own axes (surge, sway, heave) and about them (roll, pitch, yaw).  */
typedef struct bt_six
{
  bt_vec3 along, about;
} bt_six;

/* How a thruster answers its command, -1 to 1.  */
typedef enum bt_thrust_map
{
  BT_MAP_T200,  /* the measured table of a T200, by voltage */
  BT_MAP_SQUARE /* AHEAD or ASTERN times the square of the command */
} bt_thrust_map;

typedef struct bt_thruster_def
{
  bt_vec3 at, along; /* m from the centre of gravity; the way it pushes at a positive command */
  double map;        /* bt_thrust_map */
  double ahead;      /* N: the most either way */
  double astern;     /* N; 0: as ahead */
  double dead;       /* of the command: within it nothing turns */
  double lag;        /* s: time constant, 0: none */
} bt_thruster_def;

/* A vehicle.  Without mass the vehicle is kinematic and goes exactly where told; with mass it is a
   rigid body moved by thrusters, water and tethers.  +y of the body frame is the front.  */
typedef struct bt_vehicle_def
{
  char name[BT_NAME_SIZE];
  bt_vec3 at;                  /* m: with mass, its centre of gravity */
  double heading, pitch, roll; /* degrees: compass, bow up, starboard down */
  bt_vec3 size; /* m: of its hull, along its own x, y, z about its place; all 0: a point */
  double surge_speed, sway_speed, heave_speed; /* m/s at full stick, without mass */
  double yaw_rate;                             /* degrees/s at full stick */
  double pull;        /* N: the most it pulls a tether with, without mass */
  double restitution; /* of its hull */
  /* With mass.  */
  double mass;                     /* kg */
  double volume;                   /* m3 of water displaced; NAN: it neither floats nor sinks */
  bt_vec3 inertia;                 /* kg m2: roll, pitch, yaw; 0: of a box of its size */
  bt_vec3 buoyancy;                /* m: the centre of buoyancy from the centre of gravity */
  bt_vec3 attached;                /* m: where the tether is made fast, likewise */
  bt_six added, linear, quadratic; /* kg, kg m2; N s/m, N m s; N s2/m2, N m s2 */
  double munk;                     /* share of the couple of a slender body in oblique flow */
  bt_six steers;                   /* 1: the thrusters command it; all 0: whatever they can */
  double volts;                    /* V: of the battery; 0: the thrusters do not ask */
  bt_thruster_def thrusters[BT_THRUSTERS_MAX];
  double n_thrusters;
  /* Instruments: standard deviations.  */
  double seed;
  double compass_noise, depth_noise, speed_noise, altitude_noise;  /* degrees, m, m/s, m */
  double range_noise, bearing_noise, tension_noise, counter_noise; /* m, degrees, N, m */
} bt_vehicle_def;

/* Where a tether ends: at the vehicle named PART, or, when PART is empty, at the point AT.  */
typedef struct bt_end
{
  bt_vec3 at;
  char part[BT_NAME_SIZE];
} bt_end;

/* Something fastened to the line: a clump weight (buoyancy 0) or a float (mass 0), at a point or
   spread over a section of it.  It keeps its place on the line when the winch turns.  */
typedef struct bt_lump
{
  double at;       /* m of arc length from the anchor when the dive begins: its middle */
  double span;     /* m; 0: at a point */
  double mass;     /* kg in air, of steel */
  double buoyancy; /* N, net */
} bt_lump;

/* Points between the two ends.  */
typedef struct bt_via
{
  double n;
  bt_vec3 at[BT_VIA_MAX]; /* m */
} bt_via;

typedef struct bt_tether_def
{
  char name[BT_NAME_SIZE];
  bt_end from, to;
  bt_via via;    /* what its line of lay goes through; none: it is straight */
  double length; /* paid out, m */
  double drum;   /* the most that can be out, m */
  bt_vec3 ride;  /* shares of the motion of the water, heave, surge and sway along the waves, taken
                    by an anchor that is a point; 0: the anchor stands */
  bt_tether_props props; /* mass or wet_weight may be NAN: it then follows from the other */
  bt_lump lumps[BT_LUMPS_MAX];
  double n_lumps;
  bt_set sets[BT_SETS_MAX]; /* want `ei' and a model that moves */
  double n_sets;
  bt_vec3 along[2]; /* the way the line leaves its anchor, and its far end, where it is clamped
                       there; of a vehicle along its own axes; 0: it is not.  Wants `ei', too  */
} bt_tether_def;

typedef enum bt_obstacle_kind
{
  BT_OBSTACLE_SEABED = 0, /* level at the depth of the sea; or its GRID or MESH */
  BT_OBSTACLE_BOX,
  BT_OBSTACLE_SPHERE,
  BT_OBSTACLE_CYLINDER, /* solid, with flat caps */
  BT_OBSTACLE_CAPSULE,
  BT_OBSTACLE_CONVEX, /* the hull of POINTS, which are relative to AT */
  BT_OBSTACLE_MESH    /* triangles, two-sided */
} bt_obstacle_kind;

/* Points or rows of numbers: N rows of WIDTH, borrowed until bt_model_new has copied them.  */
typedef struct bt_rows
{
  const double *at;
  size_t n, width;
} bt_rows;

/* Triangles, borrowed until bt_model_new has copied them.  Any soup will do.  */
typedef struct bt_triangles
{
  const bt_vec3 *vertex;
  size_t vertices;
  const uint32_t (*corner)[3];
  size_t triangles;
  const uint32_t *id; /* of each triangle; NULL: 0, 1, 2 ... */
} bt_triangles;

/* A height field: NX by NY posts DX and DY apart, the first at (X, Y), borrowed likewise.  */
typedef struct bt_heights
{
  const double *z; /* m, rows from south to north, each from west to east; NaN: no bottom there */
  size_t nx, ny;
  double x, y, dx, dy; /* m */
} bt_heights;

/* An obstacle.  Its kind says which fields count.  */
typedef struct bt_obstacle_def
{
  char name[BT_NAME_SIZE];
  bt_obstacle_kind kind;
  bt_vec3 at; /* m: the centre; of a mesh, convex points, a grid: their own origin */
  double heading, pitch, roll; /* degrees: compass, bow up, starboard down */
  bt_vec3 from, to;            /* m: the ends of the axis */
  bt_vec3 size;                /* m: along its own x, y, z */
  double radius;               /* m */
  double scale;                /* of a mesh */
  double friction;             /* Coulomb; NAN: the tether's own */
  double abrasiveness;         /* times as fast as bare steel */
  bt_rows points;              /* CONVEX: rows of x y z */
  bt_triangles mesh;           /* MESH, SEABED; z up */
  bt_heights grid;             /* SEABED */
  bt_rows track; /* rows of t x y z heading (s, m, degrees; heading NAN: its own): where
                    AT is and how it is turned from the start of the dive on, in place
                    of AT and HEADING; with an axis, AT is its middle, and it is drawn
                    at heading 0.  None: it stands still */
} bt_obstacle_def;

typedef struct bt_world
{
  bt_sea_def sea;
  const bt_vehicle_def *vehicles;
  int n_vehicles;
  const bt_tether_def *tethers;
  int n_tethers;
  const bt_obstacle_def *obstacles;
  int n_obstacles;
} bt_world;

/* ---- One table of fields, many readers ---- */

typedef enum bt_field_kind
{
  BT_FIELD_NUMBER,  /* double */
  BT_FIELD_COUNT,   /* double that holds a whole number */
  BT_FIELD_POINT,   /* bt_vec3, every component within min and max */
  BT_FIELD_WORD,    /* double: the value of one of WORDS */
  BT_FIELD_END,     /* bt_end */
  BT_FIELD_CURRENT, /* bt_current */
  BT_FIELD_WAVES,   /* bt_wave_def */
  BT_FIELD_VIA,     /* bt_via */
  BT_FIELD_POINTS,  /* bt_rows of x y z */
  BT_FIELD_SIX,     /* bt_six: two rows, along and about the own axes */
  BT_FIELD_TRACK,   /* bt_rows of t x y z heading */
  BT_FIELD_MESH,    /* bt_triangles */
  BT_FIELD_GRID     /* bt_heights */
} bt_field_kind;

typedef struct bt_word
{
  const char *word; /* NULL ends a list */
  double value;
} bt_word;

typedef struct bt_field
{
  const char *name; /* as in Scheme: "wet-weight" */
  const char *unit; /* "m", "N/m", "deg"; "" for none */
  const char *text; /* what it is, a phrase */
  bt_field_kind kind;
  size_t offset;        /* in the part's struct */
  double fallback;      /* the default number; NAN: must be given or follows from another field,
                           unless NAN is the value of one of WORDS */
  double min, max;      /* allowed range */
  int above_min;        /* true: MIN itself is not allowed */
  const bt_word *words; /* WORD: the choices; NUMBER: words allowed in place of a number; or NULL */
  int live;             /* true: may change while a dive runs */
} bt_field;

/* A kind of part.  */
typedef struct bt_head
{
  const char *name;   /* "sea", "rov", "tether", "clump", "box" */
  const char *inside; /* the kind of part it is written in; NULL: it is a part of the world */
  const char *text;
  size_t size; /* of its struct */
  const bt_field *fields;
  size_t n_fields;
  int obstacle; /* its bt_obstacle_kind, or -1: it is none */
} bt_head;

/* The most that a field of a tether may be, besides the end of the field's range: FACTOR times the
   field OF to the POWER, or FLOOR if FLOOR is more.  An infinite field is not bounded.  */
typedef struct bt_bound
{
  const char *field, *of;
  double factor;
  int power;
  double floor;
  const char *why; /* a clause: what has so much, or no more */
} bt_bound;

/* Return the kinds of parts, *N of them.  */
const bt_head *bt_heads (size_t *n);

/* Return the bounds of the fields of tethers, *N of them: of the field OF before that of FIELD.  */
const bt_bound *bt_bounds (size_t *n);

/* Return the head or field called NAME, or NULL.  */
const bt_head *bt_head_find (const char *name);
const bt_field *bt_field_find (const bt_head *head, const char *name);
/* Write to *VALUE the number that WORD stands for in FIELD.  BT_ERR_NAME lists the words it takes.
 */
bt_status bt_word_value (const bt_field *field, const char *word, double *value, bt_error *error);
/* Return the head of obstacles of KIND, or NULL.  */
const bt_head *bt_obstacle_head (bt_obstacle_kind kind);

/* Fill DEF, a struct of the kind HEAD, with the defaults and no name; an obstacle's kind is set. */
void bt_def_init (const bt_head *head, void *def);

/* Set a field of DEF, checked against its range.  BT_ERR_DOMAIN says what is allowed; BT_ERR_NAME
   for a word or kind the field does not take.  DEF is unchanged on failure.  */
bt_status bt_def_set_number (const bt_field *field, void *def, double value, bt_error *error);
bt_status bt_def_set_word (const bt_field *field, void *def, const char *word, bt_error *error);
bt_status bt_def_set_point (const bt_field *field, void *def, bt_vec3 value, bt_error *error);
bt_status bt_def_set_current (const bt_field *field, void *def, const bt_current *value,
                              bt_error *error);
bt_status bt_def_set_waves (const bt_field *field, void *def, const bt_wave_def *value,
                            bt_error *error);
bt_status bt_def_set_part (const bt_field *field, void *def, const char *part, bt_error *error);
/* VIA and SIX copy the rows, POINTS and TRACK borrow them.  */
bt_status bt_def_set_rows (const bt_field *field, void *def, const bt_rows *rows, bt_error *error);
bt_status bt_def_set_mesh (const bt_field *field, void *def, const bt_triangles *mesh,
                           bt_error *error);
bt_status bt_def_set_grid (const bt_field *field, void *def, const bt_heights *grid,
                           bt_error *error);
/* Copy NAME (1 to BT_NAME_SIZE - 1 bytes) to NAME_FIELD, which has BT_NAME_SIZE bytes.  */
bt_status bt_def_set_name (char *name_field, const char *name, bt_error *error);

/* ---- Vehicles and tethers that come with the engine ---- */

/* Return the name of the I-th type of vehicle; a description of the type with the source of its
   figures; NULL beyond the last.  */
const char *bt_vehicle_type_name (int i);
const char *bt_vehicle_type_text (int i);

/* Give DEF the figures of the type called NAME, leaving the rest as it is.  BT_ERR_NAME lists the
   types.  */
bt_status bt_def_set_vehicle_type (bt_vehicle_def *def, const char *name, bt_error *error);

/* The same for tethers: diameter, weight, stiffness, strength, drag and friction.  */
const char *bt_tether_type_name (int i);
const char *bt_tether_type_text (int i);
/* Return the origin of the I-th type's figure of FIELD, a field set by the type: "published",
   "measured", "fitted" (to a measurement) or "assumed"; NULL beyond the last type.  */
const char *bt_tether_type_origin (int i, const char *field);
bt_status bt_def_set_tether_type (bt_tether_def *def, const char *name, bt_error *error);

/* ---- The model ---- */

typedef struct bt_model bt_model;

/* Check WORLD and compile it into *MODEL, which is immutable and counted: release it with
   bt_model_release.  Everything is copied.  BT_ERR_DEF when the parts contradict each other (two
   parts of the same name, a tether to no vehicle, a tether too short to reach, a line of lay
   through an obstacle), BT_ERR_DOMAIN for a number outside its range, BT_ERR_LIMIT for too many
   parts or no memory.

   Meshes and grids of many triangles are sorted by several threads, and the trees are kept
   in files of the user's cache; no error if the cache cannot be written.  The environment variable
   BIGHT_TREES names a different folder or, empty, none.  */
bt_status bt_model_new (const bt_world *world, bt_model **model, bt_error *error);
/* The same, asking POLL with POLL_USER while meshes are sorted: BT_ERR_INTERRUPTED.  */
bt_status bt_model_new_polled (const bt_world *world, bt_poll poll, void *poll_user,
                               bt_model **model, bt_error *error);
bt_model *bt_model_retain (bt_model *model);
void bt_model_release (bt_model *model);

/* A line has at least the share 1 / BT_LIGHTEST of the mass of the displaced water, and of the mass
   that the lift would carry; in the sea, a line of 25 kg/m3.  Lighter foam is no tether.  Water 5
   to 7 m deep compresses foam of 22 to 29 kg/m3 by a hundredth (ASTM D6817, EPS22 and EPS29).  */
#define BT_LIGHTEST 40.0

/* Return the least mass of a line, kg/m, in water of DENSITY, kg/m3, under GRAVITY, m/s2.  Of PROPS
   count diameter and wet_weight; a wet_weight of NAN follows from the mass.  */
double bt_tether_least_mass (const bt_tether_props *props, double density, double gravity);

/* Complete PROPS: give mass or wet_weight from the other in water of DENSITY under GRAVITY; neutral
   when both are NAN.  A mass completed so is at least the least mass.  */
void bt_tether_props_complete (bt_tether_props *props, double density, double gravity);

BT_END_DECLS

#endif
