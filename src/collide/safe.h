/* The safe step: of any proposed move of a tether as much as keeps every link clear.

   From a clear start no link's axis comes nearer than the core radius to an obstacle, whatever is
   proposed: not finite, a thousand kilometres away, any number of steps.  The promise
   is about the path taken: within a round every node moves on a straight line, all at once.

   Movers are scenes with a motion.  A mover that would touch is held back, with the links.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#ifndef BT_COLLIDE_SAFE_H
#define BT_COLLIDE_SAFE_H

#include "collide/scene.h"

/* From one place to another in a step: straight, and a turn at even speed about the origin.  */
typedef struct bt__motion
{
  bt__frame from;
  bt_vec3 travel;
  bt_vec3 axis; /* unit */
  double angle; /* radians, less than pi */
} bt__motion;

typedef struct bt__mover
{
  const bt__scene *body; /* in the mover's own frame; no planes */
  const bt__switches *on;
  bt__motion motion;
  double radius; /* of a ball about the frame's origin that holds the body */
  double done;   /* out: the share of the motion that was taken; less than 1: pinched */
} bt__mover;

/* Return the motion from FROM to TO.  */
bt__motion bt__motion_between (const bt__frame *from, const bt__frame *to);

/* The farthest a point no farther than RADIUS from the origin goes by MOTION, m.  */
static inline double
bt__motion_way (const bt__motion *m, double radius)
{
  return bt__norm (m->travel) + fabs (m->angle) * radius;
}

/* Return where MOTION is after the share T.  */
bt__frame bt__motion_at (const bt__motion *motion, double t);

typedef struct bt__safe_config
{
  double core;     /* m: what the promise is about, more than 0 */
  double stride;   /* m: the farthest a node goes in a round */
  uint32_t rounds; /* at most, 1 or more: a move farther than a stride takes several */
} bt__safe_config;

typedef struct bt__safe_report
{
  uint32_t rounds;
  uint32_t held;      /* nodes that are not where they were wanted */
  uint32_t truncated; /* rounds in which an obstacle cut the move */
  uint32_t overlaps;  /* links that were nearer than the core at the start */
  uint32_t overflows; /* links with more parts near than there is room for: they moved less */
} bt__safe_report;

/* What stopped a move of all nodes by one share.  */
typedef struct bt__hit
{
  uint32_t link;
  uint32_t mover; /* the mover's place plus 1; 0: the scene */
  uint32_t links; /* that obstacles would have stopped; 0: nothing known to be in the way */
  bt__near near; /* the part, and its closest points where the move stopped, in the world's frame */
} bt__hit;

typedef struct bt__safe bt__safe;

/* Make the working memory for tethers of up to NODES nodes, ROOM parts near each link.
   BT_ERR_LIMIT.  */
bt_status bt__safe_new (uint32_t nodes, uint32_t room, bt__safe **out, bt_error *error);

void bt__safe_free (bt__safe *safe); /* NULL is nothing */

/* Forget what is known to be clear: another tether, another scene of the same serial.  */
void bt__safe_forget (bt__safe *safe);

/* Move the N nodes X towards WANT, and the movers along their motions, as far as is safe.  X must
   be finite; N at most the nodes of SAFE.  A WANT that is not finite means stay.  No allocation. */
void bt__safe_step (bt__safe *safe, const bt__safe_config *config, const bt__scene *scene,
                    const bt__switches *on, bt__mover *mover, uint32_t movers, bt_vec3 *x,
                    const bt_vec3 *want, uint32_t n, bt__safe_report *report, bt__count *count);

/* After a bt__safe_step of one round from the N nodes X among SCENE and the movers STILL, at rest:
   return the share of that move that all nodes can take at once; less than 1: *HIT says where.  */
double bt__safe_common (bt__safe *safe, const bt__scene *scene, bt__mover *still, double core,
                        const bt_vec3 *x, uint32_t n, bt__hit *hit, bt__count *count);

#endif
