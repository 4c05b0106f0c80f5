/* The state of a tether with the thesis' response: its layout, and the questions to it.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <string.h>

#include "contact/thesis_job.h"

/* The state is hashed and compared as bytes.  */
_Static_assert(sizeof (bt__split) == 8 * 16, "bt__split must have no padding");
_Static_assert(sizeof (bt__span)
                   == sizeof (bt__shape) + sizeof (bt__shape_memory) + 5 * 8 + sizeof (bt__split),
               "bt__span must have no padding");
_Static_assert(sizeof (bt__thesis) == 8 * 16, "bt__thesis must have no padding");

static size_t
line_size (uint32_t nodes)
{
  return bt__polyline_size (bt__thesis_room (nodes));
}

size_t
bt__thesis_size (uint32_t nodes)
{
  return sizeof (bt__thesis) + line_size (nodes) + (BT__SPLITS_MAX + 1) * sizeof (bt__span);
}

size_t
bt__thesis_live (const bt__thesis *s)
{
  return sizeof *s + line_size ((uint32_t)s->nodes) + (size_t)s->spans * sizeof (bt__span);
}

bt__polyline *
bt__thesis_line (const bt__thesis *s)
{
  return (bt__polyline *)(s + 1);
}

bt__span *
bt__thesis_spans (const bt__thesis *s)
{
  return (bt__span *)((char *)bt__thesis_line (s) + line_size ((uint32_t)s->nodes));
}

bt__thesis_rules
bt__thesis_rules_of (const bt_tether_props *p)
{
  return (bt__thesis_rules){ .rejoin_angle = p->rejoin_angle * (BT__PI / 180),
                             .stick_angle = p->stick_angle * (BT__PI / 180),
                             .stick_count = p->stick_count,
                             .stick_by = (int)p->stick_by,
                             .sliding = p->sliding != 0 };
}

bt_status
bt__thesis_lay (bt__thesis *s, uint32_t nodes, const bt_vec3 *points, uint32_t n, double length,
                bt_error *error)
{
  memset (s, 0, bt__thesis_size (nodes));
  *s = (bt__thesis){ .nodes = nodes, .spans = 1, .length = length };
  bt__span *span = bt__thesis_spans (s);
  span->length = length;
  bt__span_be_straight (span, points[0], points[n - 1]);
  return bt__polyline_lay (bt__thesis_line (s), bt__thesis_room (nodes), points, n, length, nodes,
                           error);
}

/* ---- Asking ---- */

double
bt__thesis_tension (const bt__thesis *s, double at)
{
  const bt__span *span = bt__thesis_spans (s);
  int64_t k = 0;
  for (; k < s->spans - 1 && at >= span[k].length; k++)
    at -= span[k].length;
  return bt__shape_tension (&span[k].shape, NULL, NULL, at);
}

double
bt__thesis_tension_max (const bt__thesis *s)
{
  const bt__span *span = bt__thesis_spans (s);
  double most = 0;
  for (int64_t k = 0; k < s->spans; k++)
    for (int i = 0; i <= 2; i++)
      most = fmax (most, bt__shape_tension (&span[k].shape, NULL, NULL, i * span[k].length / 2));
  return most;
}

/* The force of the obstacle on the break point, which balances the tension of both spans.  */
static bt_vec3
force_at (const bt__span *span)
{
  const bt__shape *p = &span->shape, *q = &span[1].shape;
  bt_vec3 d = bt__shape_tangent (p, NULL, NULL, p->length);
  bt_vec3 e = bt__shape_tangent (q, NULL, NULL, 0);
  bt_vec3 f = bt__scale (bt__shape_tension (p, NULL, NULL, p->length), d);
  return bt__axpy (f, -bt__shape_tension (q, NULL, NULL, 0), e);
}

int
bt__thesis_touches (const bt__thesis *s, bt__touch *touch, int room)
{
  const bt__span *span = bt__thesis_spans (s);
  const double *u = bt__polyline_u (bt__thesis_line (s));
  for (int64_t k = 0; k < s->spans - 1 && k < room; k++)
    touch[k] = (bt__touch){ .object = span[k].end.object,
                            .triangle = span[k].end.triangle,
                            .state = s->stuck ? BT__TOUCH_STICK : BT__TOUCH_SLIDE,
                            .s = u[span[k].end.node],
                            .point = span[k].end.contact,
                            .normal = span[k].end.normal,
                            .force = force_at (span + k) };
  return (int)s->spans - 1;
}

int
bt__thesis_segments (const bt__thesis *s, int64_t model, bt__segment *segment, int room)
{
  const bt__span *span = bt__thesis_spans (s);
  const bt__polyline *line = bt__thesis_line (s);
  const bt_vec3 *x = bt__polyline_x ((bt__polyline *)line);
  const double *u = bt__polyline_u ((bt__polyline *)line);
  int64_t i = 0;
  for (int64_t k = 0; k < s->spans && k < room; k++)
    {
      int64_t end = k == s->spans - 1 ? line->n - 1 : span[k].end.node;
      segment[k] = (bt__segment){ span[k].straight ? BT_MODEL_RUBBER_BAND : model, u[i], u[end],
                                  x[i], x[end] };
      i = end;
    }
  return (int)s->spans;
}
