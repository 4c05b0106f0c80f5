/* Words of lines among members, rings and piles.

   Method: the Wirtinger presentation of the fundamental group of the complement of a graph.  Every
   edge of the graph of members (graph.h) casts a shadow, an endless strip in one horizontal
   direction.  Cut along all shadows, the water contracts to a point along the direction.  So the
   homotopy class of a line is given by the sequence of shadows crossed, with signs: a word, in
   which every strip is a letter.  Where an edge runs through the shadow of another edge, the letter
   of the edge changes.  Each crossing gives a relation between letters, and each inner vertex gives
   a relation: the product of the letters round the vertex is 1.  The relations are simplified when
   the world is loaded (tietze.h), in several directions; the direction with the simplest result is
   kept.

   The graph must be in general position, so every vertex is moved by the share JITTER of the radius
   of its thinnest member, at most 3 cm.  Lines must stay outside the members.  Moving obstacles are
   left out.

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

/* Put the word of the polyline P of N points into *WORD.  No allocation.  */
void bt__shadow_word (const bt__shadow *shadow, const bt_vec3 *p, uint32_t n, bt__word *word);

/* Return the object, by its index in the scene, encircled by GENERATOR (from 1, of either sign). */
uint32_t bt__shadow_object (const bt__shadow *shadow, int32_t generator);

#endif
