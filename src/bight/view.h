/* A view: what a picture shows, as plain data.

   It knows of things (tubes, solids, arrows, labels), of water and light, and of a camera; nothing
   of dives and nothing of how it is drawn.  Angles are radians, lengths metres, z up, z = 0 the
   surface of the sea.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#ifndef BIGHT_VIEW_H
#define BIGHT_VIEW_H

#include <stddef.h>
#include <stdint.h>

#include <bight/decls.h>
#include <bight/model.h>
#include <bight/status.h>
#include <bight/vec.h>

BT_BEGIN_DECLS

typedef struct bt_color
{
  float r, g, b; /* sRGB, 0 to 1 */
} bt_color;

/* ---- Things ---- */

typedef enum bt_thing_kind
{
  BT_THING_TUBE = 0, /* a polyline POINTS of RADIUS, painted by VALUES if there are any */
  BT_THING_MESH,     /* triangles CORNER among POINTS, turned and put AT, SCALE times as large; of
                        GROUND true it is looked at as the bottom of the sea is */
  BT_THING_BOX,      /* of SIZE, turned, its centre AT */
  BT_THING_SPHERE,   /* of RADIUS, AT */
  BT_THING_CYLINDER, /* of RADIUS, FROM one end TO the other */
  BT_THING_CAPSULE,  /* the same with round ends */
  BT_THING_LEVEL,    /* level ground at the height of AT, to the horizon */
  BT_THING_FIELD,    /* ground by the heights GRID */
  BT_THING_ARROW,    /* FROM TO, of RADIUS or more to be seen; TEXT stands at its point */
  BT_THING_LABEL,    /* TEXT AT a point */
  BT_THING_MARK,  /* a ring AT a point, of RADIUS pixels in a picture 720 high, with TEXT: a contact
                   */
  BT_THING_LINES, /* segments between POINTS 0 and 1, 2 and 3, ... */
  BT_THING_VEHICLE, /* a small remotely operated vehicle, SIZE.y long, turned, AT its centre */
  BT_THING_ANCHOR,  /* what a tether hangs from under water, AT */
  BT_THING_SHIP,    /* a boat of length SIZE.y on the surface, turned, AT */
  BT_THING_KINDS
} bt_thing_kind;

/* Whether a camera that aims itself wants the thing in the picture.  */
typedef enum bt_framing
{
  BT_FRAME_NOT = 0,
  BT_FRAME_NEAR, /* when it lies near those that must be in it */
  BT_FRAME_MUST
} bt_framing;

/* A thing.  Its kind says which fields count.  */
typedef struct bt_thing
{
  bt_thing_kind kind;
  bt_framing framing;
  bt_color color;
  bt_vec3 at, from, to, size;
  double heading, pitch, roll; /* compass, bow up, starboard down */
  double radius, scale;
  int ground;
  const char *text;      /* or NULL */
  const bt_vec3 *points; /* N of them */
  const double *values;  /* TUBE: N numbers on the view's scale, or NULL */
  size_t n;
  const uint32_t (*corner)[3]; /* MESH */
  size_t triangles;
  bt_heights grid; /* FIELD */
} bt_thing;

/* ---- The view ---- */

typedef struct bt_camera
{
  bt_vec3 from, at; /* where it is, and what it looks at */
  bt_vec3 up;
  double angle;  /* the picture's height seen from the camera; 0: without perspective */
  double height; /* m: the picture's height, without perspective */
} bt_camera;

/* What the numbers along tubes mean.  */
typedef struct bt_scale
{
  const char *name, *unit; /* "tension", "N"; NULL: nothing is painted by numbers */
  double low, high;
  const char *const *word; /* the words for 0, 1, 2 ..., or NULL: a scale of numbers */
  int words;
  int cool; /* true: in blue and white, for what is told of the water */
} bt_scale;

typedef struct bt_view
{
  bt_camera camera;
  bt_vec3 sun;       /* toward the light */
  double visibility; /* m at which water hides what is behind it; 0: by the size of the scene */
  double surface;    /* height of the surface; INFINITY: there is none */
  double lamp;       /* brightness of a lamp at the camera, 0 to 1 */
  double ghost;      /* how much of a tube shows through what hides it, 0 to 1 */
  double time;       /* s: the play of light */
  bt_scale scale;
  const char *title; /* or NULL; and a second line */
  const char *note;
  bt_thing *things;
  size_t n, room;
} bt_view;

/* Make an empty view under a clear surface.  BT_ERR_LIMIT without memory.  */
bt_status bt_view_new (bt_view **view, bt_error *error);
void bt_view_free (bt_view *view);

/* Return a thing of KIND with nothing but a colour.  */
bt_thing bt_thing_of (bt_thing_kind kind);

/* Copy THING, with everything reachable from THING, into VIEW.  BT_ERR_DOMAIN for numbers that are
   not finite and for indices of corners out of range, BT_ERR_LIMIT without memory.  */
bt_status bt_view_add (bt_view *view, const bt_thing *thing, bt_error *error);

/* Keep a copy of TEXT as long as VIEW lives; NULL without memory.  */
const char *bt_view_text (bt_view *view, const char *text);
/* The same of N words; the words themselves are borrowed.  */
const char *const *bt_view_words (bt_view *view, const char *const *words, size_t n);

/* ---- Cameras that aim themselves ---- */

typedef enum bt_aim
{
  BT_AIM_CHASE = 0, /* behind the vehicle and above it */
  BT_AIM_PILOT,     /* its own camera */
  BT_AIM_TOP,       /* straight down, north up */
  BT_AIM_SIDE,      /* level, across the first tube */
  BT_AIM_NORTH,     /* level, looking north */
  BT_AIM_EAST,      /* level, looking east */
  BT_AIM_OVERVIEW,  /* from above and aside, all in the picture */
  BT_AIM_PLAN,      /* as TOP, for a drawing */
  BT_AIM_COUNT
} bt_aim;

/* Return the word for AIM, or NULL.  */
const char *bt_aim_name (bt_aim aim);

/* Aim the camera of VIEW at its first vehicle, its tubes and the surroundings, for a picture ASPECT
   times as wide as high.  BT_ERR_NAME for an unknown aim, BT_ERR_DEF when there is nothing to see,
   or, for chase and pilot, no vehicle.  */
bt_status bt_view_aim (bt_view *view, bt_aim aim, double aspect, bt_error *error);

/* Look FROM a point AT another.  BT_ERR_DOMAIN when they are one, or not finite.  */
bt_status bt_view_look (bt_view *view, bt_vec3 from, bt_vec3 at, bt_error *error);

/* Move the camera that was aimed: to look AT a point (NULL: the same point as before), from a
   distance at which the picture is EXTENT metres wide at the point (0: as wide as before), and then
   ZOOM times nearer.  BT_ERR_DOMAIN for numbers out of range.  */
bt_status bt_view_move (bt_view *view, const bt_vec3 *at, double extent, double zoom, double aspect,
                        bt_error *error);

/* Carry the camera that was aimed about the point it looks at: by TURN clockwise seen from above,
   and up by DIP, as far as 85 degrees, radians.  BT_ERR_DOMAIN for numbers that are none.  */
bt_status bt_view_turn (bt_view *view, double turn, double dip, bt_error *error);

/* Return the axes of a body turned by HEADING, PITCH and ROLL: starboard, ahead, up.  */
void bt_body_axes (double heading, double pitch, double roll, bt_vec3 axis[3]);

BT_END_DECLS

#endif
