/* The taut string: the local shortest line that the tether's shape shrinks to, through nothing.

   The string is a polyline of its own from the start to the end of the tether.  Only the two ends
   follow the tether, so that a frame costs a step or two.

   A step puts a plane between every link and every convex part (a solid, a triangle) near the link,
   and both ends of the link must stay on their side of the plane.  The old and the new link, and so
   the whole move, are then on one side of the part: the string crosses nothing, the homotopy class
   is kept exactly, whatever the step, and nodes slide freely along the planes.  Within the planes
   the step minimises the sum of squared link lengths, each weighted by the reciprocal of its old
   length; at the fixed point the sum is the length.

   A class may have several local minima; monotone shrinking reaches one of them.  The string
   ignores itself and moving obstacles.  Slow creeping over smooth bodies (a ball) is spread over
   the frames.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#ifndef BT_AWARE_TAUT_H
#define BT_AWARE_TAUT_H

#include <stddef.h>

#include "aware/hold.h"
#include "base/ask.h"

/* Flat: no pointers, no padding; bt__string_size bytes of it can be copied.  */
typedef struct bt__string
{
  uint32_t room, n;        /* nodes */
  uint32_t still, settled; /* steps in a row that gained nothing; true: enough of them */
  double length;           /* m, of the polyline */
  bt_vec3 x[];
} bt__string;

/* What a string is among, and how finely.  A settled string is not looked at again until an end
   moves: wake it when switches change.  */
typedef struct bt__taut_config
{
  const bt__scene *scene;
  const bt__switches *on;
  double core;   /* m: no link comes nearer, more than 0 */
  double want;   /* m: pushed out to as far as that where there is room; CORE for a taut string */
  double mesh;   /* m: of the links near obstacles */
  double margin; /* m: how near that is; about MESH */
  int whole;     /* true: far from obstacles links are split too */
} bt__taut_config;

typedef struct bt__taut bt__taut;

size_t bt__string_size (uint32_t room);

/* Make *OUT, working memory for strings of up to ROOM nodes, 8 or more.  BT_ERR_LIMIT.  */
bt_status bt__taut_new (uint32_t room, bt__taut **out, bt_error *error);

void bt__taut_free (bt__taut *taut); /* NULL is nothing */

/* Let the steps of strings ask ASKER, which must stay, whether to go on.  */
void bt__taut_ask (bt__taut *taut, bt__asker *asker);

/* Lay STRING, whose room is set, along the polyline P of N points.  Return 0 if the room is too
   small.  */
int bt__string_lay (bt__string *string, const bt_vec3 *p, uint32_t n);

/* What it is among has changed: a settled string is to be looked at again.  */
static inline void
bt__string_wake (bt__string *string)
{
  string->still = string->settled = 0;
}

/* Shrink STRING by up to STEPS steps, until it gains nothing; return the steps taken.  */
uint32_t bt__taut_relax (bt__taut *taut, const bt__taut_config *config, bt__string *string,
                         uint32_t steps, bt__count *count);

/* Lead the ends of STRING straight to START and END and relax by up to STEPS.  Return 0, and leave
   STRING, if an end would touch something on its way or there is no room: seed it again.  */
int bt__taut_step (bt__taut *taut, const bt__taut_config *config, bt__string *string, bt_vec3 start,
                   bt_vec3 end, uint32_t steps, bt__count *count);

/* Lay FRESH along the tether P of N points and relax FRESH by up to STEPS.  If STRING is empty, or
   longer than FRESH by more than the share SLIP, copy FRESH to STRING.  Return true if STRING was
   not empty and has slipped.  FRESH must have the room of STRING; if P has too many points, nothing
   happens.  */
int bt__taut_reseed (bt__taut *taut, const bt__taut_config *config, bt__string *string,
                     bt__string *fresh, const bt_vec3 *p, uint32_t n, uint32_t steps, double slip,
                     bt__count *count);

#endif
