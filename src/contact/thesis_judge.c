/* Judging a polyline among obstacles, and a line split at contacts, from outside.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <math.h>

#include "contact/thesis.h"

/* ---- The polyline ---- */

static const bt__member polyline[] = {
  BT__WITHIN (bt__polyline, room, 2, UINT32_MAX),
  BT__WITHIN (bt__polyline, n, 2, UINT32_MAX),
};
const bt__record bt__polyline_record = BT__RECORD (bt__polyline, "polyline", polyline);

/* Arc lengths rise from the anchor on: what lies between two nodes is found by them.  */
static int
rises (const double *u, int64_t n)
{
  int64_t i = 1;
  while (i < n && u[i] > u[i - 1])
    i++;
  return u[0] == 0 && i == n;
}

bt_status
bt__polyline_judge (bt__judge *judge, const bt__polyline *line, uint32_t room)
{
  const bt_vec3 *x = bt__polyline_x ((bt__polyline *)line);
  bt_status status = bt__judge_records (judge, &bt__polyline_record, line, 1);
  if (status == BT_OK)
    status = bt__judge_count (judge, "nodes of room in its polyline", line->room, room, room);
  if (status == BT_OK)
    status = bt__judge_count (judge, "nodes in its polyline", line->n, 2, room);
  if (status != BT_OK)
    return status;
  const double *u = bt__polyline_u ((bt__polyline *)line);
  status = bt__judge_reals (judge, "polyline's places", &x->x, 3 * (size_t)room, -BT__FAR, BT__FAR);
  if (status == BT_OK)
    status = bt__judge_reals (judge, "polyline's arc lengths", u, room, 0, BT__FAR);
  if (status == BT_OK)
    status = bt__judge_that (judge, rises (u, line->n), "arc lengths rise along its polyline");
  return status;
}

/* ---- The split line ---- */

static const bt__member split[] = {
  BT__INDEX (bt__split, object, -1, BT__BELOW_OBJECTS),
  BT__WITHIN (bt__split, triangle, -1, UINT32_MAX),
  BT__WITHIN (bt__split, mover, 0, BT__MANY),
  BT__WITHIN (bt__split, node, 0, BT__MANY),
  BT__WITHIN (bt__split, contact, -BT__FAR, BT__FAR),
  BT__WITHIN (bt__split, normal, -2, 2),
  BT__WITHIN (bt__split, point, -BT__FAR, BT__FAR),
  BT__WITHIN (bt__split, angle, -BT__FAR, BT__FAR),
  BT__WITHIN (bt__split, kept, -BT__FAR, BT__FAR),
  BT__WITHIN (bt__split, fresh, 0, BT__MANY),
};
const bt__record bt__split_record = BT__RECORD (bt__split, "split", split);

static const bt__member span[] = {
  BT__OF (bt__span, shape, bt__shape_record),
  BT__OF (bt__span, memory, bt__shape_memory_record),
  BT__WITHIN (bt__span, length, 0, BT__FAR),
  BT__WITHIN (bt__span, pull, -BT__HUGE, BT__HUGE),
  BT__TRUTH (bt__span, solved),
  BT__TRUTH (bt__span, rubber),
  BT__TRUTH (bt__span, straight),
  BT__OF (bt__span, end, bt__split_record),
};
const bt__record bt__span_record = BT__RECORD (bt__span, "span", span);

static const bt__member thesis[] = {
  BT__WITHIN (bt__thesis, nodes, 1, BT__MANY),
  BT__WITHIN (bt__thesis, spans, 1, BT__SPLITS_MAX + 1),
  BT__WITHIN (bt__thesis, bent, 0, BT__SPLITS_MAX),
  BT__WITHIN (bt__thesis, stuck, BT__STUCK_NOT, BT__STUCK_BOTH),
  BT__TRUTH (bt__thesis, taut),
  BT__TRUTH (bt__thesis, held),
  BT__TRUTH (bt__thesis, settled),
  BT__ANY (bt__thesis, version),
  BT__WITHIN (bt__thesis, length, 0, BT__FAR),
  BT__WITHIN (bt__thesis, wish_a, -BT__FAR, BT__FAR),
  BT__WITHIN (bt__thesis, wish_b, -BT__FAR, BT__FAR),
  BT__WITHIN (bt__thesis, wish_length, 0, BT__FAR),
};
const bt__record bt__thesis_record = BT__RECORD (bt__thesis, "split line", thesis);

/* Every span has a length and a shape that a split line may have; every split is at an object and
   at an inner node, farther along than the one before.  */
static bt_status
judge_spans (bt__judge *judge, const bt__thesis *s)
{
  const bt__span *span = bt__thesis_spans (s);
  int64_t last = 0, end = bt__thesis_line (s)->n - 1, movers = judge->below[BT__BELOW_MOVERS],
          objects = judge->below[BT__BELOW_OBJECTS];
  for (int64_t k = 0; k < s->spans; k++)
    {
      const bt__split *split = &span[k].end;
      bt_status status = bt__shape_judge (judge, &span[k].shape, 0);
      if (status == BT_OK)
        status = bt__judge_that (judge, span[k].shape.form < BT__FORM_NODES,
                                 "its spans are curves of a thesis' model");
      if (status == BT_OK && k < s->spans - 1)
        status = bt__judge_count (judge, "for the node of a split", split->node, last + 1, end - 1);
      if (status == BT_OK && k < s->spans - 1)
        status
            = bt__judge_count (judge, "for the object of a split", split->object, 0, objects - 1);
      if (status == BT_OK && k < s->spans - 1)
        status = bt__judge_count (judge, "for the mover of a split", split->mover, 0, movers);
      if (status != BT_OK)
        return status;
      last = split->node;
    }
  return BT_OK;
}

bt_status
bt__thesis_judge (bt__judge *judge, const bt__thesis *s, uint32_t nodes)
{
  bt_status status = bt__judge_records (judge, &bt__thesis_record, s, 1);
  if (status == BT_OK)
    status = bt__judge_count (judge, "intervals", s->nodes, nodes, nodes);
  if (status == BT_OK)
    status = bt__judge_count (judge, "for its bent span", s->bent, 0, s->spans - 1);
  if (status == BT_OK)
    status = bt__judge_that (judge, s->length > 0, "its split line has a length");
  if (status == BT_OK)
    status = bt__polyline_judge (judge, bt__thesis_line (s), bt__thesis_room (nodes));
  if (status == BT_OK)
    status = bt__judge_records (judge, &bt__span_record, bt__thesis_spans (s), (size_t)s->spans);
  return status == BT_OK ? judge_spans (judge, s) : status;
}
