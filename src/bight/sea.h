/* What moves the water beside a plain current: a measured grid, waves, the lee of obstacles.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#ifndef BIGHT_SEA_H
#define BIGHT_SEA_H

#include <stddef.h>
#include <stdint.h>

#include <bight/decls.h>
#include <bight/status.h>
#include <bight/vec.h>

BT_BEGIN_DECLS

/* ---- A current from a table ---- */

/* A current given at the points of a grid in space and time, linear between them, constant beyond.
   Immutable once made; it may be shared.  */
typedef struct bt_current_grid bt_current_grid;

/* Read *GRID from FILE, a text of rows x y z t u v w (m, s, m/s; separated by commas or blanks;
   lines beginning with # and a first line of names are passed over).  Rows come in any order.  The
   coordinates found along each axis are the lines of the grid, with a row for every point of the
   grid.  BT_ERR_IO, BT_ERR_FORMAT (saying the line, or the point that is missing or given twice),
   BT_ERR_DOMAIN for a speed above 20 m/s, BT_ERR_LIMIT.  */
bt_status bt_current_grid_read (const char *file, bt_current_grid **grid, bt_error *error);

/* The same from N ROWS of seven numbers.  */
bt_status bt_current_grid_new (const double (*rows)[7], size_t n, bt_current_grid **grid,
                               bt_error *error);
/* A grid is reference-counted: the last bt_current_grid_free frees the memory.  */
bt_current_grid *bt_current_grid_retain (bt_current_grid *grid);
void bt_current_grid_free (bt_current_grid *grid);

/* Return the velocity of GRID at P and T; not finite where P is not.  */
bt_vec3 bt_current_grid_velocity (const bt_current_grid *grid, bt_vec3 p, double t);

/* Return true if GRID changes with time.  */
int bt_current_grid_is_unsteady (const bt_current_grid *grid);

/* ---- Waves ---- */

enum
{
  BT_WAVES_MAX = 64,   /* components */
  BT_WAVES_LEVELS = 16 /* depths for which is known how far a series reaches */
};

typedef enum bt_wave_kind
{
  BT_WAVE_NONE = 0,
  BT_WAVE_AIRY,   /* one regular wave of small amplitude */
  BT_WAVE_JONSWAP /* long-crested wind sea */
} bt_wave_kind;

/* Waves as they are asked for.  */
typedef struct bt_wave_def
{
  int64_t kind;      /* bt_wave_kind */
  double height;     /* m: crest to trough, or significant */
  double period;     /* s: of the wave, or of the peak */
  double toward;     /* rad: compass bearing they travel toward */
  double phase;      /* rad: AIRY, at the origin at t = 0; 0: a crest */
  double gamma;      /* JONSWAP: peakedness, 3.3 usual, 1 is Pierson and Moskowitz */
  double components; /* JONSWAP: 2 to BT_WAVES_MAX */
  int64_t seed;      /* JONSWAP */
  double accuracy;   /* JONSWAP: of bt_waves_motions, a share; 0: exact */
} bt_wave_def;

/* The same as components, longest first: plain data that may live in the state of a dive.  Beyond
   the N components all is zero.  */
typedef struct bt_waves
{
  int64_t n;
  double depth;                   /* m */
  double east, north;             /* unit, the way they travel */
  double omega[BT_WAVES_MAX];     /* rad/s */
  double k[BT_WAVES_MAX];         /* 1/m: omega2 = g k tanh (k depth) */
  double amplitude[BT_WAVES_MAX]; /* m */
  double speed[BT_WAVES_MAX];     /* m/s: amplitude omega / (1 - e^(-2 k depth)) */
  double bed[BT_WAVES_MAX];       /* e^(-2 k depth); 0 where the bottom is not felt */
  double phase[BT_WAVES_MAX];     /* rad */
  double accuracy;                /* of bt_waves_motions, a share; 0: exact */
  double reach[BT_WAVES_LEVELS];  /* m: of a series, at depths of waves_line.c */
} bt_waves;

/* Make *WAVES of DEF in water of DEPTH under GRAVITY.  JONSWAP in parts of equal energy between 0.5
   and 4 times the peak frequency, each part's frequency and phase drawn by SEED (K. Hasselmann et
   al., 1973; scaled so that 4 sqrt (m0) is the height).  BT_ERR_DOMAIN for a period outside 0.5 to
   60 s, a height not 0 to 40 m or that breaks (above 0.142 tanh (k depth) of the wave length,
   Miche), a gamma not 1 to 10, an accuracy neither 0 nor 1e-6 to 0.1.  */
bt_status bt_waves_make (const bt_wave_def *def, double depth, double gravity, bt_waves *waves,
                         bt_error *error);

/* Return the wave number of OMEGA (rad/s) in water of DEPTH: omega2 = g k tanh (k depth).  */
double bt_wave_number (double omega, double depth, double gravity);

/* The functions below add up the components.  Each component is good to 1e-15 of its amplitude, its
   phase to 5e-16 of the larger of k (x . way) and omega t: 2 microradians in waves of 1.5 s at
   t = 1e9 s.  */

/* Return the height of the surface at (X, Y) and T, m.  */
double bt_waves_elevation (const bt_waves *waves, double x, double y, double t);

/* Write the velocity and acceleration (either may be NULL) of the water at P and T; not finite
   where P is not finite.  Above the still surface the values are those of the surface, below the
   bottom those of the bottom; a component is left out at depths where less than 1e-7 of the
   component is left.  */
void bt_waves_motion (const bt_waves *waves, bt_vec3 p, double t, bt_vec3 *velocity,
                      bt_vec3 *acceleration);

/* Write the VELOCITY and ACCELERATION of the water at the N places P and T, as bt_waves_motion
   does. Places that follow each other and lie close together are cheaper by far: they share a
   series. Velocities are then within the accuracy of WAVES times the sum of the components' speeds,
   and accelerations within the same share of the sum of theirs; exact if the accuracy is 0, or if
   there are four components or fewer.  */
void bt_waves_motions (const bt_waves *waves, const bt_vec3 *p, size_t n, double t,
                       bt_vec3 *velocity, bt_vec3 *acceleration);

/* ---- How a ship answers ---- */

/* A ship or TMS hung from one: its point moves with the water there, by these shares.  */
typedef struct bt_rider
{
  double heave, surge, sway; /* of the motion of the water at its place, 1: a small float */
  double yaw;                /* rad: compass bearing of its bow */
} bt_rider;

/* Return where waves take what rests at P: the displacement of the water at the still surface
   there, by the shares of RIDER, m.  */
bt_vec3 bt_waves_ride (const bt_waves *waves, const bt_rider *rider, bt_vec3 p, double t);

/* ---- Lee ---- */

/* Something that stands in the current: a pile, leg or brace, or a block taken as one.  */
typedef struct bt_wake
{
  bt_vec3 a, axis; /* m; unit: its axis from one end */
  double length;   /* m */
  double radius;   /* m */
} bt_wake;

/* Return what stands from A to B with RADIUS, m; upright if A and B are one.  */
bt_wake bt_wake_of (bt_vec3 a, bt_vec3 b, double radius);

/* Return the share of the current AMBIENT that is left at P behind WAKE, 0.5 to 1, smooth in P and
   in AMBIENT.  With D the diameter, s the way downstream of the axis and n across, both in the
   plane across the axis, 1 - d(s) exp (-n2 / 2 b2), d = 0.5 c, b = D/2 / c, c = sqrt (min (1, 3
   D/s)).  The lee sets in over one D about the axis, ends over one D beyond the ends of the axis,
   and fades from 40 to 60 D: half the current within 3 D, as measured behind piles, then
   Schlichting's far wake (Boundary-Layer Theory, ch. 25: the deficit falls and the width grows as
   the root of the way), with the momentum of a drag coefficient of 1.25.  */
double bt_wake_share (const bt_wake *wake, bt_vec3 ambient, bt_vec3 p);

/* The wakes of a sea.  A place asks only the wakes near by, whatever the number of all.  */
typedef struct bt_lees bt_lees;

/* Make *OUT of the N WAKES; NULL if N is 0.  BT_ERR_LIMIT without memory.  Free *OUT with
   bt_lees_free (NULL is allowed).  */
bt_status bt_lees_new (const bt_wake *wakes, size_t n, bt_lees **out, bt_error *error);
void bt_lees_free (bt_lees *lees);

/* Return the share of the current AMBIENT left at P by all wakes of LEES: the product of their
   shares.  */
double bt_lees_share (const bt_lees *lees, bt_vec3 ambient, bt_vec3 p);

/* Write the same at the N places P to SHARE, to the last bit.  For places that follow each other
   and lie close together the obstacles nearby are looked for once.  */
void bt_lees_shares (const bt_lees *lees, bt_vec3 ambient, const bt_vec3 *p, size_t n,
                     double *share);

/* ---- All of it ---- */

/* What bt_water looks at beside its current.  Everything is borrowed.  */
typedef struct bt_sea
{
  const bt_current_grid *grid; /* for BT_CURRENT_GRID */
  const bt_waves *waves;       /* or NULL */
  const bt_lees *lees;         /* or NULL */
} bt_sea;

BT_END_DECLS

#endif
