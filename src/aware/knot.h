/* Is an open line knotted?

   The ends are led to a far point on either side and closed there.  The closed curve is judged by
   its Alexander polynomial, evaluated exactly at three integers modulo a large prime.  Knots with
   polynomial 1 (the smallest have 11 crossings) are missed; an unknotted curve is never called
   knotted.  If an end lies deep among the loops, the knot found can depend on the way along which
   the end is led out: knots of open lines are defined only up to the closure.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#ifndef BT_AWARE_KNOT_H
#define BT_AWARE_KNOT_H

#include <stdint.h>

#include <bight/status.h>

#include "base/ask.h"
#include "math/vec.h"

typedef struct bt__knot bt__knot;

/* D (t) is the polynomial, symmetric and 1 at t = 1; numbers modulo the prime 2^61 - 1.  */
typedef struct bt__knot_value
{
  uint32_t crossings;   /* of the diagram once simplified */
  uint32_t knotted;     /* true: not the values of the circle, which are 1 */
  uint64_t determinant; /* |D (-1)| */
  uint64_t at2, at3;    /* D (2)^2, D (3)^2 */
} bt__knot_value;

enum
{
  BT__KNOT_CROSSINGS = 300
};

/* Make *OUT for lines of up to NODES nodes.  BT_ERR_LIMIT.  */
bt_status bt__knot_new (uint32_t nodes, bt__knot **out, bt_error *error);

void bt__knot_free (bt__knot *knot); /* NULL is nothing */

/* Let the questions below ask ASKER whether to go on; left, they return 0.  */
void bt__knot_ask (bt__knot *knot, bt__asker *asker);

/* Fill *VALUE for the open line P of N points.  Return 0 if it has too many nodes, or crosses
   itself too often.  No allocation.  */
int bt__knot_of (bt__knot *knot, const bt_vec3 *p, uint32_t n, bt__knot_value *value);

/* The same for the closed line P.  */
int bt__knot_of_closed (bt__knot *knot, const bt_vec3 *p, uint32_t n, bt__knot_value *value);

#endif
