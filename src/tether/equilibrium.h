/* The equilibrium of a line between two ends in any current: which solver, and which equilibrium.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#ifndef BT_TETHER_EQUILIBRIUM_H
#define BT_TETHER_EQUILIBRIUM_H

#include <bight/statics.h>

#include "base/ask.h"
#include "tether/shape.h"

/* Find the equilibrium of LINE in WATER between A and B into which the present shape falls.  NODES
   and TENSIONS hold N + 1 vectors.  With HAVE_SHAPE true NODES is the present shape; otherwise the
   catenary under the mean load serves, bent toward FALLBACK if the load has no direction. *REACTION
   is that of the present shape, and becomes that of the answer.  Shooting is tried first, warm then
   cold, and its answer is taken only if near the present shape; else the line is relaxed and
   polished by shooting.  All outputs are finite on BT_OK; COUNTS->unsettled counts shapes not at
   rest.  */
bt_status bt__equilibrium_solve (bt_steady *steady, const bt_line *line, const bt_water *water,
                                 bt_vec3 a, bt_vec3 b, int n, int have_shape, bt_vec3 fallback,
                                 bt__reaction *reaction, bt_vec3 *nodes, bt_vec3 *tensions,
                                 bt__shape_counts *counts, bt_error *error);

/* Let whoever searches with STEADY ask ASKER whether to go on; it must stay.  Where it is left the
   shape still moves.  */
void bt__steady_ask (bt_steady *steady, bt__asker *asker);

/* Let STEADY be ready for N intervals, each solver first.  BT_ERR_LIMIT: it holds fewer, or memory
   is out.  */
bt_status bt__steady_room (bt_steady *steady, int n, bt_error *error);

#endif
