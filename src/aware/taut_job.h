/* The inside of a step of the taut string.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#ifndef BT_AWARE_TAUT_JOB_H
#define BT_AWARE_TAUT_JOB_H

#include "aware/taut.h"

enum
{
  BT__PLANES_A_LINK = 16,
  BT__NEARS_A_LINK = 48,
  BT__ACTIVE_A = 1, /* at the link's first node */
  BT__ACTIVE_B = 2
};

/* A link keeps on the side NORMAL . x >= hard; it would like >= soft.  */
typedef struct bt__side
{
  bt_vec3 normal;
  double hard, soft;
} bt__side;

/* Symmetric.  */
typedef struct bt__block
{
  double xx, xy, xz, yy, yz, zz;
} bt__block;

struct bt__taut
{
  uint32_t room;
  bt__asker *asker; /* or NULL */
  bt__near near[BT__NEARS_A_LINK];
  bt__side *side;     /* by link, compact */
  uint8_t *active;    /* of each: at which of its nodes it pushes */
  uint32_t *first;    /* link i has sides first[i] to first[i + 1] - 1 */
  double *unlisted;   /* of link i: the least distance of what has no side */
  double *weight;     /* of link i */
  double *most;       /* of node j: how far it may go */
  bt__block *inverse; /* the eliminated diagonal */
  bt_vec3 *right, *y; /* the eliminated right side, the solution */
};

/* Look round: split and drop nodes of STRING, find the sides of every link.  Return 0 if that was
   left.  */
int bt__taut_look (bt__taut *t, const bt__taut_config *c, bt__string *s, bt__count *count);

/* Fill t->y with where the nodes would go; PROX, 1 / m, holds them back.  */
void bt__taut_solve (bt__taut *t, const bt__string *s, double prox);

/* Make t->y obey every side and every node's most.  */
void bt__taut_obey (bt__taut *t, const bt__string *s);

#endif
