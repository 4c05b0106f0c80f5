/* Inside the safe step: what one call knows, between the lists and the truncation.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#ifndef BT_COLLIDE_SAFE_JOB_H
#define BT_COLLIDE_SAFE_JOB_H

#include "collide/cast.h"
#include "collide/safe.h"

struct bt__safe
{
  uint32_t nodes, room;
  uint64_t serial, version; /* of the scene and the switches the clearances are of */
  bt_vec3 *d;               /* the moves */
  bt_vec3 *known;           /* where the nodes were when the clearances were measured: 2 a link */
  double *t;                /* the shares */
  double *clear;            /* of each link, at least, then */
  uint32_t *queue;
  uint8_t *queued;
  bt__near *near;  /* ROOM a link */
  uint32_t *found; /* how many */
};

/* One call.  */
typedef struct bt__job
{
  bt__safe *safe;
  const bt__scene *scene;
  const bt__switches *on;
  bt__mover *mover;
  uint32_t movers, links, head, waiting;
  bt_vec3 *x;
  double core, stride;
  int moving; /* the movers move in this round */
  bt__safe_report *report;
  bt__count *count;
} bt__job;

/* Shorten the move of NODE to MOST.  */
void bt__cut_move (bt__job *k, uint32_t node, double most);

/* List what link J could reach in its move, static and moving; where that overflows shorten the
   moves instead.  Static parts come with link number 0, those of mover m with m + 1.  */
void bt__list_link (bt__job *k, uint32_t j);

#endif
