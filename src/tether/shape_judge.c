/* Judging the shape of a static tether from outside.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <math.h>

#include "tether/shape.h"

/* A straight line is a catenary whose parameter is infinite; a line that does not stretch has an
   infinite stiffness.  */
static const bt__member point2[] = {
  BT__WITHIN (bt_point2, x, -BT__FAR, BT__FAR),
  BT__WITHIN (bt_point2, y, -BT__FAR, BT__FAR),
};
static const bt__record point2_record = BT__RECORD (bt_point2, "point", point2);

static const bt__member v_shape[] = {
  BT__WITHIN (bt_v_shape, l1, -BT__FAR, BT__FAR),
  BT__WITHIN (bt_v_shape, l2, -BT__FAR, BT__FAR),
  BT__OF (bt_v_shape, bend, point2_record),
};
static const bt__record v_record = BT__RECORD (bt_v_shape, "V", v_shape);

static const bt__member catenary[] = {
  BT__WITHIN (bt_catenary, h, -BT__FAR, BT__FAR),
  BT__WITHIN (bt_catenary, v, -BT__FAR, BT__FAR),
  BT__WITHIN (bt_catenary, s, 0, BT__FAR),
  BT__WITHIN (bt_catenary, a, 0, INFINITY),
  BT__WITHIN (bt_catenary, sigma0, -BT__HUGE, BT__HUGE),
};
static const bt__record catenary_record = BT__RECORD (bt_catenary, "catenary", catenary);

static const bt__member elastic[] = {
  BT__WITHIN (bt_elastic, h, -BT__FAR, BT__FAR),   BT__WITHIN (bt_elastic, v, -BT__FAR, BT__FAR),
  BT__WITHIN (bt_elastic, s, 0, BT__FAR),          BT__WITHIN (bt_elastic, w, 0, BT__HUGE),
  BT__WITHIN (bt_elastic, ea, 0, INFINITY),        BT__WITHIN (bt_elastic, H, -BT__HUGE, BT__HUGE),
  BT__WITHIN (bt_elastic, V, -BT__HUGE, BT__HUGE),
};
static const bt__record elastic_record = BT__RECORD (bt_elastic, "elastic catenary", elastic);

static const bt__member shape[] = {
  BT__WITHIN (bt__shape, form, BT__FORM_STRAIGHT, BT__FORM_AFLOAT),
  BT__WITHIN (bt__shape, n, 0, BT__MANY),
  BT__WITHIN (bt__shape, a, -BT__FAR, BT__FAR),
  BT__WITHIN (bt__shape, b, -BT__FAR, BT__FAR),
  BT__WITHIN (bt__shape, length, 0, BT__FAR),
  BT__WITHIN (bt__shape, across, -2, 2),
  BT__WITHIN (bt__shape, against, -2, 2),
  BT__WITHIN (bt__shape, rise, -BT__FAR, BT__FAR),
  BT__WITHIN (bt__shape, plane_length, 0, BT__FAR),
  BT__WITHIN (bt__shape, load, 0, BT__HUGE),
  BT__WITHIN (bt__shape, t1, -BT__HUGE, BT__HUGE),
  BT__WITHIN (bt__shape, t2, -BT__HUGE, BT__HUGE),
  BT__OF (bt__shape, v, v_record),
  BT__OF (bt__shape, catenary, catenary_record),
  BT__OF (bt__shape, elastic, elastic_record),
};
const bt__record bt__shape_record = BT__RECORD (bt__shape, "shape", shape);

static const bt__member reaction[] = {
  BT__TRUTH (bt__reaction, at_b),
  BT__WITHIN (bt__reaction, pull, -BT__HUGE, BT__HUGE),
  BT__WITHIN (bt__reaction, stiffness, -BT__HUGE, BT__HUGE),
};
static const bt__record reaction_record = BT__RECORD (bt__reaction, "reaction", reaction);

static const bt__member memory[] = {
  BT__WITHIN (bt__shape_memory, load_direction, -2, 2),
  BT__WITHIN (bt__shape_memory, across, -2, 2),
  BT__WITHIN (bt__shape_memory, search_a, -BT__HUGE, BT__HUGE),
  BT__WITHIN (bt__shape_memory, search_xs, -BT__HUGE, BT__HUGE),
  BT__OF (bt__shape_memory, reaction, reaction_record),
};
const bt__record bt__shape_memory_record = BT__RECORD (bt__shape_memory, "memory", memory);

bt_status
bt__shape_judge (bt__judge *judge, const bt__shape *shape, int64_t room)
{
  bt_status status = bt__judge_that (judge, shape->length > 0, "its shape has a length");
  if (status == BT_OK && bt__has_nodes (shape->form))
    status = bt__judge_count (judge, "intervals", shape->n, 1, room);
  return status;
}

bt_status
bt__shape_judge_nodes (bt__judge *judge, const bt_vec3 *nodes, const bt_vec3 *tensions,
                       int64_t room)
{
  size_t n = 3 * ((size_t)room + 1);
  bt_status status = bt__judge_reals (judge, "nodes", &nodes->x, n, -BT__FAR, BT__FAR);
  return status == BT_OK ? bt__judge_reals (judge, "tensions", &tensions->x, n, -BT__HUGE, BT__HUGE)
                         : status;
}
