/* Triangles on their way to the graphics library: positions, normals, colours and what they are
   made of, gathered in one list.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#ifndef BT_RENDER_SOUP_H
#define BT_RENDER_SOUP_H

#include <stddef.h>
#include <stdint.h>

#include <bight/view.h>

/* How a surface is shaded; the shaders know the numbers.  */
enum
{
  BT__MATTE = 0,
  BT__GROUND, /* sand, with the play of light upon it */
  BT__GLOWING /* bright even in the dark: tethers, arrows */
};

/* How its outline is drawn.  */
enum
{
  BT__EDGE_NONE = 0,
  BT__EDGE_LINE = 128,
  BT__EDGE_NEVER = 255 /* nor that of what lies behind it */
};

typedef struct bt__stuff
{
  unsigned char color[4];
  unsigned char fog; /* the share of the water's fog that it takes, of 255 */
  unsigned char edge, shading, gloss;
} bt__stuff;

typedef struct bt__vertex
{
  float at[3], normal[3];
  bt__stuff stuff;
} bt__vertex;

/* The camera as the soup needs it: how large a pixel is where.  */
typedef struct bt__lens
{
  bt_vec3 from, ahead;
  double pixel; /* m per pixel, at a distance of 1 m when there is perspective */
  int perspective;
  int rows;  /* pixels of the picture's height */
  int quick; /* true: what is not seen at a few pixels' size is left out */
} bt__lens;

/* Some of the triangles: where they begin in the list of corners, and how many corners.  */
typedef struct bt__range
{
  size_t first, n;
} bt__range;

enum
{
  BT__TUBES_MAX = 64
};

typedef struct bt__soup
{
  bt__vertex *vertex;
  uint32_t *index;
  size_t n, room, n_index, room_index;
  int full;       /* true: there was no memory for all */
  bt_vec3 origin; /* positions are from here, so that floats suffice */
  bt__lens lens;
  bt__range ghost[BT__TUBES_MAX]; /* tubes: they shine through solids in front */
  int ghosts;
  bt__stuff stuff; /* of what is added next */
} bt__soup;

/* Axes and place of a body.  */
typedef struct bt__pose
{
  bt_vec3 at, axis[3];
} bt__pose;

void bt__soup_free (bt__soup *soup);

/* Metres that one pixel spans at P.  */
double bt__pixel_at (const bt__lens *lens, bt_vec3 p);

/* How thick strokes are: 1 in a picture 720 pixels high.  */
double bt__stroke (const bt__lens *lens);

void bt__stuff_color (bt__stuff *stuff, bt_color color);

/* Add to SOUP, of its present stuff: single parts, and bodies.  */
uint32_t bt__add_vertex (bt__soup *soup, bt_vec3 p, bt_vec3 normal);
void bt__add_triangle (bt__soup *soup, uint32_t a, uint32_t b, uint32_t c);
void bt__add_flat (bt__soup *soup, bt_vec3 a, bt_vec3 b, bt_vec3 c);
void bt__add_box (bt__soup *soup, const bt__pose *pose, bt_vec3 size);
void bt__add_sphere (bt__soup *soup, bt_vec3 at, double radius);
/* A body of revolution about the line FROM TO, RADIUS at either end; CAPS closes it.  */
void bt__add_cone (bt__soup *soup, bt_vec3 from, bt_vec3 to, double r0, double r1, int caps);
void bt__add_ring (bt__soup *soup, bt_vec3 at, bt_vec3 axis, double radius, double thickness);
/* A tube through N points, nowhere thinner than LEAST pixels; COLOR, N of them or NULL.  */
void bt__add_tube (bt__soup *soup, const bt_vec3 *points, size_t n, double radius, double least,
                   const bt_color *color);

bt_vec3 bt__pose_point (const bt__pose *pose, double x, double y, double z);
bt__pose bt__pose_of (bt_vec3 at, double heading, double pitch, double roll);

/* Add a thing of any kind (things.c), and the bodies of vehicles, anchors and ships (bodies.c).  */
void bt__add_thing (bt__soup *soup, const bt_view *view, const bt_thing *thing, double reach);
void bt__add_vehicle (bt__soup *soup, const bt_thing *thing);
void bt__add_anchor (bt__soup *soup, const bt_thing *thing);
void bt__add_ship (bt__soup *soup, const bt_thing *thing);

/* The colour for VALUE on SCALE: bright at both ends, and distinct for the colour-blind.  */
bt_color bt__scale_color (const bt_scale *scale, double value);

/* The factor by which a vehicle is drawn larger to be recognised.  */
double bt__vehicle_growth (const bt__lens *lens, const bt_thing *thing);

#endif
