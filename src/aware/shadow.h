/* Words of lines among members, rings and piles.

   Every edge of the graph of what can hold a line (graph.h) casts a shadow: a strip without end in
   one horizontal direction.  What is left of the water can be drawn together to a point along that
   direction, so a line's class is told by the strips it crosses, in order and with sign.  An edge
   that runs through another's shadow changes its letter there; the relations are those of
   Wirtinger, one for every such crossing and one for every inner vertex.  They are simplified at
   load; the direction that leaves the simplest is kept.

   The graph must be in general position: vertices are moved by JITTER of the thinnest member's
   radius at them, at most 3 cm.  Lines must stay out of the members.  Obstacles that move are left
   out.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#ifndef BT_AWARE_SHADOW_H
#define BT_AWARE_SHADOW_H

#include "aware/graph.h"
#include "aware/word.h"

typedef struct bt__shadow bt__shadow;

typedef struct bt__shadow_config
{
  double jitter;    /* share of the radius: 0.2 */
  uint32_t tries;   /* directions: 24 */
  bt__asker *asker; /* whether to go on; or NULL */
} bt__shadow_config;

/* How well the group is known.  */
typedef struct bt__shadow_report
{
  uint32_t crossings, rank, expected; /* generators; what theory says they are */
  uint32_t leftover;                  /* relations left */
  uint32_t longest;                   /* word of a strip */
  uint32_t decided;                   /* nothing left over, the rank right, nothing undescribed */
} bt__shadow_report;

/* Make *OUT for GRAPH, which may be freed.  BT_ERR_LIMIT, BT_ERR_INTERRUPTED.  */
bt_status bt__shadow_new (const bt__graph *graph, const bt__shadow_config *config, bt__shadow **out,
                          bt_error *error);

void bt__shadow_free (bt__shadow *shadow); /* NULL is nothing */

void bt__shadow_report_of (const bt__shadow *shadow, bt__shadow_report *out);

/* Put the word of the polyline P of N points into *WORD.  No allocation.  */
void bt__shadow_word (const bt__shadow *shadow, const bt_vec3 *p, uint32_t n, bt__word *word);

/* Return the object, its place in the scene, that GENERATOR (from 1, of either sign) goes round. */
uint32_t bt__shadow_object (const bt__shadow *shadow, int32_t generator);

#endif
