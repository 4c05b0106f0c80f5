/* Sharing out the length among the spans, and solving those that changed.

   A sliding tether has one bend: one span holds all the slack, the other spans are straight, and
   the sum of lengths is constant (thesis 3.5.2).  In a stuck tether every span keeps its length,
   and the winch changes the length of the first span only.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <string.h>

#include "collide/cast.h"
#include "contact/thesis_job.h"

bt_vec3
bt__span_start (const bt__thesis_job *j, int64_t k)
{
  return k == 0 ? j->a : j->span[k - 1].end.point;
}

bt_vec3
bt__span_stop (const bt__thesis_job *j, int64_t k)
{
  return k == j->state->spans - 1 ? j->b : j->span[k].end.point;
}

static double
chord (const bt__thesis_job *j, int64_t k)
{
  return bt__distance (bt__span_start (j, k), bt__span_stop (j, k));
}

/* ---- Sticking ---- */

/* From the first contact to the last the normals turn by this, added up.  */
static double
turn_of_normals (const bt__thesis_job *j)
{
  double sum = 0;
  for (int64_t k = 0; k + 2 < j->state->spans; k++)
    {
      bt_vec3 n = j->span[k].end.normal, m = j->span[k + 1].end.normal;
      sum += atan2 (bt__norm (bt__cross (n, m)), bt__dot (n, m));
    }
  return sum;
}

/* The longest span has the bend.  */
static void
choose_bent (bt__thesis_job *j)
{
  int64_t best = 0;
  for (int64_t k = 1; k < j->state->spans; k++)
    if (j->span[k].length > j->span[best].length)
      best = k;
  j->state->bent = best;
}

/* From now on every span keeps what it has.  */
static void
freeze (bt__thesis_job *j)
{
  const double *u = bt__polyline_u (j->line);
  for (int64_t k = 0; k < j->state->spans; k++)
    j->span[k].length = u[bt__thesis_last (j, k)] - u[bt__thesis_first (j, k)];
}

void
bt__spans_stick (bt__thesis_job *j)
{
  const bt__thesis_rules *r = j->in->rules;
  bt__thesis *s = j->state;
  int64_t was = s->stuck;
  int angle = turn_of_normals (j) > r->stick_angle;
  int count = (double)(s->spans - 1) >= r->stick_count;
  s->stuck = BT__STUCK_NOT;
  if (s->spans > 1 && !r->sliding)
    s->stuck = BT__STUCK_NO_SLIDING;
  else if (s->spans > 1 && angle && count)
    s->stuck = BT__STUCK_BOTH;
  else if (s->spans > 1 && angle
           && (r->stick_by == BT_STICK_BY_ANGLE || r->stick_by == BT_STICK_BY_EITHER))
    s->stuck = BT__STUCK_ANGLE;
  else if (s->spans > 1 && count
           && (r->stick_by == BT_STICK_BY_COUNT || r->stick_by == BT_STICK_BY_EITHER))
    s->stuck = BT__STUCK_COUNT;
  if (was && !s->stuck)
    choose_bent (j);
  if (s->stuck && !was)
    freeze (j);
}

/* ---- Sharing out ---- */

/* P pulled into the ball round C.  */
static bt_vec3
within (bt_vec3 p, bt_vec3 c, double reach)
{
  double d = bt__distance (p, c);
  return d > reach ? bt__axpy (c, reach / d, bt__sub (p, c)) : p;
}

/* The length, m, needed by the spans from the second to the last but one; a break point moved out
   needs a little more than before.  */
static double
need_between (bt__thesis_job *j)
{
  double sum = 0;
  for (int64_t k = 1; k < j->state->spans - 1; k++)
    {
      double least = chord (j, k);
      j->span[k].length = j->state->stuck ? fmax (j->span[k].length, least) : least;
      sum += j->span[k].length;
    }
  return sum;
}

/* Limit the distance of the anchor's end from the first split by the length available.  The end
   need not come nearer than it is: the winch stops first.  */
static void
hold_anchor (bt__thesis_job *j, double between)
{
  const bt__thesis *s = j->state;
  bt_vec3 split = j->span[0].end.point;
  double last = s->stuck ? j->span[s->spans - 1].length : 4 * j->radius;
  double there = bt__distance (bt__polyline_x (j->line)[0], split);
  j->a = within (j->a, split, fmax (j->in->length - between - last, there));
}

/* Hold the vehicle's end; fill what is out.  */
static void
hold_vehicle (bt__thesis_job *j, double between)
{
  bt__thesis *s = j->state;
  int64_t last = s->spans - 1;
  bt__span *span = j->span + last;
  double first = last > 0 ? chord (j, 0) : 0, reach;
  if (s->stuck)
    {
      reach = span->length;
      s->length = fmax (j->in->length, first + between + span->length);
    }
  else
    {
      double floor = last > 0 ? 4 * j->radius : 0;
      reach = fmax (j->in->length - first - between, floor);
      s->length = fmax (j->in->length, first + between + floor);
    }
  bt_vec3 c = bt__span_start (j, last);
  if (j->blocked)
    { /* what pulls it cannot move it */
      reach = fmax (reach, bt__distance (j->b, c));
      s->length = fmax (s->length, first + between + reach);
      if (s->stuck)
        span->length = reach;
    }
  s->taut = bt__distance (j->b, c) >= reach * (1 - BT__SAME);
  j->b = within (j->b, c, reach);
}

static void
set_length (bt__thesis_job *j, int64_t k, double length)
{
  j->span[k].length = fmax (length, BT__SAME);
}

void
bt__spans_share_out (bt__thesis_job *j)
{
  bt__thesis *s = j->state;
  double between = need_between (j), others = 0;
  if (s->spans > 1)
    hold_anchor (j, between);
  hold_vehicle (j, between);
  int64_t rest = s->stuck ? 0 : s->bent;
  for (int64_t k = 0; k < s->spans; k++)
    {
      if (k == rest)
        continue;
      if (!s->stuck)
        set_length (j, k, chord (j, k));
      others += j->span[k].length;
    }
  set_length (j, rest, fmax (s->length - others, chord (j, rest)));
}

/* ---- Solving ---- */

static int
is_span_straight (const bt__thesis_job *j, int64_t k)
{
  const bt__thesis *s = j->state;
  return j->span[k].rubber || j->in->props->model == BT_MODEL_RUBBER_BAND
         || (s->spans > 1 && !s->stuck && k != s->bent);
}

static int
is_as_was (const bt__span *span, bt_vec3 a, bt_vec3 b)
{
  return span->solved && memcmp (&span->shape.a, &a, sizeof a) == 0
         && memcmp (&span->shape.b, &b, sizeof b) == 0 && span->shape.length == span->length;
}

void
bt__span_be_straight (bt__span *span, bt_vec3 a, bt_vec3 b)
{
  memset (&span->shape, 0, sizeof span->shape);
  span->shape.form = BT__FORM_STRAIGHT;
  span->shape.a = a;
  span->shape.b = b;
  span->shape.length = span->shape.plane_length = span->length;
}

static bt_status
solve_span (bt__thesis_job *j, int64_t k)
{
  bt__span *span = j->span + k;
  const bt__thesis *s = j->state;
  int straight = is_span_straight (j, k);
  bt_vec3 a = bt__span_start (j, k), b = bt__span_stop (j, k);
  double pull = s->taut && (!s->stuck || k == s->spans - 1) ? j->in->pull : 0;
  if (straight == span->straight && is_as_was (span, a, b) && (straight || pull == span->pull))
    {
      j->counts->skips++;
      return BT_OK;
    }
  j->changed = 1;
  span->straight = straight;
  span->pull = pull;
  span->solved = 1;
  if (straight)
    {
      bt__span_be_straight (span, a, b);
      return BT_OK;
    }
  bt__shape_input in = { a, b, span->length, pull, j->in->props, j->in->water };
  j->counts->solves++;
  return bt__shape_solve (&in, j->in->tools, j->in->counts, &span->shape, &span->memory, NULL, NULL,
                          j->error);
}

/* Nothing holds the line where it slides: the bent span's tension runs through to both ends.  */
static void
pass_tension_on (bt__thesis_job *j)
{
  const bt__thesis *s = j->state;
  const bt__span *bent = j->span + s->bent;
  double before = bt__shape_tension (&bent->shape, NULL, NULL, 0);
  double after = bt__shape_tension (&bent->shape, NULL, NULL, bent->length);
  for (int64_t k = 0; k < s->spans; k++)
    {
      bt__span *span = j->span + k;
      double t = s->stuck ? 0 : k < s->bent ? before : after;
      if (span->straight && s->taut && (!s->stuck || k == s->spans - 1))
        t = j->in->pull;
      if (span->straight && (k != s->bent || s->stuck || s->taut))
        span->shape.t1 = span->shape.t2 = t;
    }
}

bt_status
bt__spans_solve (bt__thesis_job *j)
{
  bt_status status = BT_OK;
  j->changed = 0;
  for (int64_t k = 0; status == BT_OK && k < j->state->spans; k++)
    status = solve_span (j, k);
  if (status == BT_OK)
    pass_tension_on (j);
  return status;
}

double
bt__spans_angle (const bt__thesis_job *j, int64_t k)
{
  const bt__span *s = j->span + k;
  bt_vec3 d = bt__shape_tangent (&s->shape, NULL, NULL, s->length);
  bt_vec3 e = bt__shape_tangent (&s[1].shape, NULL, NULL, 0);
  return bt__split_angle (bt__scale (-1, d), e, s->end.normal);
}

void
bt__spans_count_cheats (bt__thesis_job *j)
{
  for (int64_t k = 0; k < j->state->spans; k++)
    if (j->span[k].straight && chord (j, k) < j->span[k].length * (1 - BT__MARGIN))
      {
        j->counts->length_cheats += j->in->props->model != BT_MODEL_RUBBER_BAND;
        return;
      }
}
