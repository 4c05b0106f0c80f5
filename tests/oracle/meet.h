/* Did two links pass through each other, how near are lines to themselves?  By brute force, without
   the engine.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#ifndef BT_ORACLE_MEET_H
#define BT_ORACLE_MEET_H

#include <bight/vec.h>

/* Return how often a link of the polyline P and one of Q pass through each other while every node
   of them goes straight from FROM to TO, all at once; links that share a node are left out when P
   is Q.  */
long meet_crossings (const bt_vec3 *p_from, const bt_vec3 *p_to, int n, const bt_vec3 *q_from,
                     const bt_vec3 *q_to, int m);

/* The distance of the links from P[0] to P[1] and from Q[0] to Q[1].  */
double meet_distance (const bt_vec3 *p, const bt_vec3 *q);

/* The nearest that links of P, N points, and of Q, M points, are to each other, at most CAP; when P
   is Q, links with fewer than APART links between them are left out.  */
double meet_clearance (const bt_vec3 *p, int n, const bt_vec3 *q, int m, int apart, double cap);

#endif
