/* A tether as a polyline among obstacles, and the one way in which it moves.

   Node I has a place x[I] and an arc length u[I] from the anchor; no link is longer than its share
   of arc by more than rounding.  A move goes from a polyline to another,
   node by node and all by the same share: between two inextensible polylines lie inextensible ones,
   so a move cut short by an obstacle stretches nothing and invents no tension.  The safe step
   carries the move out: from a clear start no link's axis comes nearer to an obstacle than the
   core.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#ifndef BT_CONTACT_POLYLINE_H
#define BT_CONTACT_POLYLINE_H

#include <stddef.h>

#include <bight/status.h>

#include "base/ask.h"
#include "base/record.h"
#include "contact/touch.h"

/* Flat; X[room], then U[room] follow the head.  What is beyond N is zero.  */
typedef struct bt__polyline
{
  int64_t room, n; /* nodes */
} bt__polyline;

/* Scratch for polylines of up to ROOM nodes among up to MOVERS movers.  */
typedef struct bt__polyline_work
{
  uint32_t room, movers;
  bt_vec3 *want, *trial; /* where the nodes are to go; a copy that is moved first */
  bt_vec3 *leg;          /* where they are to go next */
  double *arc;           /* the arc lengths there */
  double *share;         /* of each node's own way */
  uint8_t *spare;        /* nodes that lie on the line of their neighbours there */
  bt__near *near;        /* BT__PARTS_MAX */
  bt__mover *still;      /* the movers, where they stand after their motions */
} bt__polyline_work;

/* What a move meets and what it may use.  */
typedef struct bt__way
{
  const bt__surroundings *around;
  double core; /* m */
  bt__safe *safe;
  bt__polyline_work *work;
  bt__count *count;
  bt__asker *asker; /* whether to go on; or NULL */
  /* Told of every straight motion that was taken, for whoever keeps watch; may be NULL.  */
  void (*watch) (void *user, const bt_vec3 *from, const bt_vec3 *to, uint32_t n);
  void *user;
} bt__way;

/* The scene of mover number MOVER less 1, or of what stands for 0; its switches to *ON.  */
const bt__scene *bt__way_scene (const bt__way *way, uint32_t mover, const bt__switches **on);

/* The id of the obstacle that HIT is of; -1 if nothing is known to be in the way.  */
int64_t bt__hit_object (const bt__way *way, const bt__hit *hit);

enum
{
  BT__PARTS_MAX = 128 /* near one link */
};

static inline size_t
bt__polyline_size (uint32_t room)
{
  return sizeof (bt__polyline) + room * (sizeof (bt_vec3) + sizeof (double));
}

static inline bt_vec3 *
bt__polyline_x (bt__polyline *line)
{
  return (bt_vec3 *)(line + 1);
}

static inline double *
bt__polyline_u (bt__polyline *line)
{
  return (double *)(bt__polyline_x (line) + line->room);
}

extern const bt__record bt__polyline_record;

/* Judge LINE, which was allotted ROOM nodes and comes from outside.  */
bt_status bt__polyline_judge (bt__judge *judge, const bt__polyline *line, uint32_t room);

/* BT_ERR_LIMIT.  */
bt_status bt__polyline_work_new (uint32_t room, uint32_t movers, bt__polyline_work **out,
                                 bt_error *error);
void bt__polyline_work_free (bt__polyline_work *work); /* NULL is nothing */

/* Lay LINE, of LENGTH m, along the POINTS of N corners in NODES equal arcs, a node more at each
   inner corner; slack is spread evenly.  BT_ERR_DOMAIN if the way is longer than LENGTH or not
   finite, BT_ERR_LIMIT if ROOM is too little.  Whether it is clear is the caller's affair.  */
bt_status bt__polyline_lay (bt__polyline *line, uint32_t room, const bt_vec3 *points, uint32_t n,
                            double length, uint32_t nodes, bt_error *error);

/* Move LINE to want[] and arc[] of the work, as far as all nodes can by one share; return the share
   taken.  Less than 1: *HIT says where.  The movers stand where bt__polyline_let_pass left them:
   call that first in every step.  A want[] that is not finite is refused.  */
double bt__polyline_move (bt__polyline *line, const bt__way *way, bt__hit *hit);

/* The same, each node by its own share, as far as that stretches no link: what is slack goes on
   where something holds it elsewhere.  For a move that was stopped and cannot be helped.  Return
   true if anything moved.  */
int bt__polyline_creep (bt__polyline *line, const bt__way *way);

/* Move the inner node I alone toward TO, as far as is safe and as draws none of its links longer
   than its arc by more than 0.5 %; the next move takes that back.  */
void bt__polyline_nudge (bt__polyline *line, const bt__way *way, int64_t i, bt_vec3 to);

/* Let the movers go along their motions while LINE stays: they report in DONE.  What stands in
   still[] from then on is where they stopped.  */
void bt__polyline_let_pass (bt__polyline *line, const bt__way *way);

/* Put a node at arc length S, exactly on its link; return its number, -1 if there is no room.  A
   node nearer than GRAIN m is taken instead.  */
int64_t bt__polyline_insert (bt__polyline *line, double s, double grain);

/* Take out the inner node I, which must lie on the line of its neighbours.  */
void bt__polyline_remove (bt__polyline *line, int64_t i);

/* Point and unit tangent from the anchor on at arc length S, clamped.  */
bt_vec3 bt__polyline_point (const bt__polyline *line, double s);
bt_vec3 bt__polyline_tangent (const bt__polyline *line, double s);

#endif
