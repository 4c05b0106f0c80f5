/* The free length: the shortest way from the anchor, whatever its homotopy class.

   A tree of any-angle ways over a grid, grown from the anchor by lazy Theta* (Nash, Koenig and
   Tovey 2010) as far as questions need; a question looks for the best of the tree's points in sight
   and tightens that way.  One tree may be asked by several threads. Shortest ways in space are
   NP-hard: an answer may be too long, in trials by more than 0.2 % in one of a hundred, never too
   short.  Obstacles that move are left out.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#ifndef BT_AWARE_FREE_H
#define BT_AWARE_FREE_H

#include "aware/taut.h"
#include "base/ask.h"

typedef struct bt__free bt__free;

enum
{
  BT__FREE_CELLS_MAX = 1 << 22,
  BT__FREE_WAY_MAX = 256 /* points of a way */
};

/* The grid has cells of size CELL in the box from LO to HI.  Ways keep the distance CLEAR from
   obstacles, a little more than the core radius of the string laid along a way.  */
typedef struct bt__free_config
{
  const bt__scene *scene;
  const bt__switches *on;
  bt_vec3 lo, hi;
  double cell, clear;
} bt__free_config;

/* Make *OUT with room for its grid.  BT_ERR_DOMAIN if the box or a size makes no sense;
   BT_ERR_LIMIT if there are too many cells.  */
bt_status bt__free_new (const bt__free_config *config, bt__free **out, bt_error *error);

void bt__free_free (bt__free *tree); /* NULL is nothing */

/* Plant the tree at ANCHOR: what grew before is forgotten.  */
void bt__free_plant (bt__free *tree, bt_vec3 anchor);

/* True if the straight way from A to B keeps CLEAR from obstacles.  */
int bt__free_sees (const bt__free_config *config, bt_vec3 a, bt_vec3 b, double clear,
                   bt__count *count);

/* Lay STRING along the tree's way to P from FROM, a place in sight of the tree's anchor; return 0
   if there is no way, or if ASKER (NULL: nobody) said to leave the search.  Of two ways nearly as
   long, the way shorter from FROM may be taken.  */
int bt__free_way (bt__free *tree, bt_vec3 from, bt_vec3 p, bt__string *string, bt__asker *asker,
                  bt__count *count);
/* Tighten WAY by up to STEPS and return the length of WAY, m, with arcs for corners at round
   members.  */
double bt__free_tighten (bt__taut *taut, const bt__taut_config *config, uint32_t steps,
                         bt__string *way, bt__count *count);

/* Return the length of STRING with arcs for corners at round members.  */
double bt__string_length (const bt__taut_config *config, const bt__string *string,
                          bt__count *count);

#endif
