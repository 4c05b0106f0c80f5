/* A set of obstacles and the questions a tether asks of it.

   Immutable once made.  Which obstacles count is the caller's: a bt__switches goes with every
   question.  An empty scene answers at once; bt__count shows what was done.  Nothing is allocated
   in a question; a buffer without room keeps the nearest parts and the distance of the nearest
   dropped part.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#ifndef BT_COLLIDE_SCENE_H
#define BT_COLLIDE_SCENE_H

#include "collide/gjk.h"
#include "collide/hull.h"
#include "collide/mesh.h"

typedef enum bt__obstacle_kind
{
  BT__OBSTACLE_BOX,
  BT__OBSTACLE_SPHERE,
  BT__OBSTACLE_CYLINDER,
  BT__OBSTACLE_CAPSULE,
  BT__OBSTACLE_CONVEX,
  BT__OBSTACLE_MESH, /* also a height field */
  BT__OBSTACLE_PLANE
} bt__obstacle_kind;

typedef struct bt__obstacle
{
  bt__obstacle_kind kind;
  uint32_t id;
  double friction;
  union
  {
    bt__box box;
    bt__sphere sphere;
    bt__cylinder cylinder;
    bt__capsule capsule;
    bt__plane plane;
    bt__hull *hull; /* owned by the scene once it is made */
    bt__mesh *mesh; /* likewise */
  } shape;
} bt__obstacle;

/* OFF[i] true: obstacle i does not count.  VERSION changes with every change of OFF.  NULL in
   place of a bt__switches: all count.  */
typedef struct bt__switches
{
  const uint8_t *off;
  uint64_t version;
} bt__switches;

#define BT__NO_TRIANGLE UINT32_MAX

/* A link and a part of an obstacle: all of it, or one triangle of a mesh.  */
typedef struct bt__near
{
  uint32_t link, object; /* object: its place in the scene */
  uint32_t slot;         /* the triangle in the mesh's order, or BT__NO_TRIANGLE */
  uint32_t triangle;     /* its id, or BT__NO_TRIANGLE */
  bt__witness w;
} bt__near;

typedef struct bt__nears
{
  bt__near *at;
  uint32_t n, room;
  double dropped; /* the smallest distance that found no room; INFINITY if all did */
} bt__nears;

typedef struct bt__scene
{
  uint32_t n, planes;
  bt__obstacle *object;
  uint32_t *plane; /* their places */
  uint32_t *solid; /* the others', by the tree's items */
  uint32_t solids;
  uint64_t serial; /* the caller's: different for different scenes */
  bt__bvh tree;
} bt__scene;

/* Make *OUT of N OBSTACLES, in the given order, and take over the hulls and meshes; on failure the
   caller keeps them.  BT_ERR_DOMAIN if a number is not finite, a size not positive, a direction not
   unit; BT_ERR_LIMIT.  */
bt_status bt__scene_new (const bt__obstacle *obstacles, uint32_t n, uint64_t serial,
                         bt__scene **out, bt_error *error);

void bt__scene_free (bt__scene *scene); /* NULL is nothing */

/* The box about an obstacle; a plane's has no end.  */
bt__aabb bt__obstacle_box (const bt__obstacle *obstacle);

/* How far BOX is from everything in SCENE, at least, m, whatever is switched off: by the cube about
   all of it.  Less than 0 says nothing; INFINITY: there is nothing.  */
double bt__scene_apart (const bt__scene *scene, const bt__aabb *box);

/* The distance of LINK to an obstacle that is not a mesh.  */
void bt__obstacle_pair (const bt__obstacle *obstacle, const bt__link *link, bt__witness *out);

/* The same for the part that NEAR names.  */
void bt__scene_pair (const bt__scene *scene, const bt__near *near, const bt__link *link,
                     bt__witness *out);

/* The same; return true if the part is within REACH, else *OUT may be as it was.  */
int bt__scene_pair_within (const bt__scene *scene, const bt__near *near, const bt__link *link,
                           double reach, bt__witness *out, bt__count *count);

/* Add to LIST every part within REACH of LINK, numbered NUMBER.  */
void bt__scene_near (const bt__scene *scene, const bt__switches *on, const bt__link *link,
                     uint32_t number, double reach, bt__nears *list, bt__count *count);

/* Fill LIST with every part within REACH of each of the N - 1 links of a polyline: with the
   tether's radius for reach, what touches which link.  */
void bt__scene_near_line (const bt__scene *scene, const bt__switches *on, const bt_vec3 *p,
                          uint32_t n, double reach, bt__nears *list, bt__count *count);

/* Return true and *OUT, the nearest part of the scene, if a part is within CAP of LINK.  */
int bt__scene_nearest (const bt__scene *scene, const bt__switches *on, const bt__link *link,
                       double cap, bt__near *out, bt__count *count);

/* Return true if a part of the scene is within REACH, positive, of LINK.  */
int bt__scene_within (const bt__scene *scene, const bt__switches *on, const bt__link *link,
                      double reach, bt__count *count);

/* Reduce LIST to the nearest part of each obstacle, nearest first.  */
void bt__nears_by_object (bt__nears *list);

/* Return true and *OUT, *GAP for the part nearest to the convex BODY, inside a ball about CENTRE
   of RADIUS, if it is within CAP.  Distances are 0 where they meet; planes may give less.  */
int bt__scene_nearest_to_body (const bt__scene *scene, const bt__switches *on,
                               const bt__convex *body, bt_vec3 centre, double radius, double cap,
                               bt__near *out, bt__gap *gap, bt__count *count);

/* Return the core of an obstacle that is neither mesh nor plane; *RADIUS is round it.  */
bt__convex bt__obstacle_core (const bt__obstacle *obstacle, double *radius);

/* Each a bt__support of the shape it is called by; of a capsule the axis.  */
bt_vec3 bt__box_support (const void *shape, bt_vec3 direction, int *hint);
bt_vec3 bt__capsule_support (const void *shape, bt_vec3 direction, int *hint);
bt_vec3 bt__triangle_support (const void *shape, bt_vec3 direction, int *hint);

static inline int
bt__is_on (const bt__switches *on, uint32_t object)
{
  return !on || !on->off || !on->off[object];
}

#endif
