/* A step of the thesis' response, on one page: bt__thesis_step.

   The spans are solved, and the polyline moves towards them.  If an obstacle stops the polyline, it
   is split at the contact, and the step repeats until the polyline has arrived or no split helps.
   A polyline that cannot arrive stays, and the vehicle with it.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <string.h>

#include "base/error.h"
#include "contact/thesis_job.h"

enum
{
  ROUNDS = 24 /* moves tried in a step */
};

/* ---- The rules of 3.5.1 ---- */

static void
make_rubber (bt__thesis_job *j, int64_t k, uint64_t *count)
{
  j->span[k].rubber = 1;
  (*count)++;
}

/* A new split that would be taken back at once: the second span becomes a rubber band, and if that
   is not enough the first.  */
static bt_status
keep_back_sides (bt__thesis_job *j)
{
  bt_status status = BT_OK;
  for (int64_t k = 0; status == BT_OK && k < j->state->spans - 1; k++)
    for (int64_t second = 1; second >= 0; second--)
      {
        bt__span *span = j->span + k;
        if (!span->end.fresh || j->in->rules->no_back_side || status != BT_OK
            || bt__spans_angle (j, k) < j->in->rules->rejoin_angle || span[second].straight)
          continue;
        make_rubber (j, k + second, &j->counts->back_side);
        status = bt__spans_solve (j);
      }
  return status;
}

static int
is_fresh (const bt__thesis_job *j, int64_t k)
{
  return (k > 0 && j->span[k - 1].end.fresh) || (k < j->state->spans - 1 && j->span[k].end.fresh);
}

/* Does LINK end in a split made in this step?  Then it is part of a link that collided before.  */
static int
collided_before (const bt__thesis_job *j, int64_t link)
{
  for (int64_t k = 0; k < j->state->spans - 1; k++)
    if (j->span[k].end.fresh && (j->span[k].end.node == link || j->span[k].end.node == link + 1))
      return 1;
  return 0;
}

/* Let the break points at the ends of span K, made in this step, stay where the line is.  */
static int
pull_in (bt__thesis_job *j, int64_t k)
{
  int any = 0;
  for (int64_t i = k - 1; i <= k; i++)
    if (i >= 0 && i < j->state->spans - 1 && j->span[i].end.fresh == BT__NEW)
      {
        j->span[i].end.point = bt__polyline_x (j->line)[j->span[i].end.node];
        j->span[i].end.fresh = BT__PULLED_IN;
        any = 1;
      }
  return any;
}

/* What is done about HIT; zero if nothing can be.  */
static int
respond (bt__thesis_job *j, const bt__hit *hit)
{
  if (hit->links == 0)
    return 0;
  int64_t k = bt__thesis_span_of (j, hit->link);
  int bends = !j->span[k].straight && !j->in->rules->no_immediate;
  j->counts->many_per_link += (uint64_t)collided_before (j, hit->link);
  if (!(bends && is_fresh (j, k)) && bt__thesis_split (j, hit))
    return 1;
  if (bends)
    {
      make_rubber (j, k, &j->counts->immediate);
      return 1;
    }
  return pull_in (j, k);
}

/* ---- The step ---- */

static bt_status
check_spans (const bt__thesis_job *j)
{
  const bt__thesis_input *in = j->in;
  int model = (int)in->props->model;
  if (!bt__is_finite (in->a) || !bt__is_finite (in->b)
      || !(in->length > 0 && isfinite (in->length)))
    return bt__fail (j->error, BT_ERR_DOMAIN,
                     "a tether needs finite ends and a positive length, not (%g, %g, %g) to "
                     "(%g, %g, %g) and %g m",
                     in->a.x, in->a.y, in->a.z, in->b.x, in->b.y, in->b.z, in->length);
  if (model != BT_MODEL_RUBBER_BAND && model != BT_MODEL_V_SHAPE && model != BT_MODEL_CATENARY
      && model != BT_MODEL_CATENARY_SIMPLEX)
    return bt__fail (j->error, BT_ERR_UNSUPPORTED,
                     "the response `thesis' is for rubber-band, v-shape, catenary and "
                     "catenary-simplex alone");
  return BT_OK;
}

static int
is_idle (const bt__thesis_job *j)
{
  const bt__thesis *s = j->state;
  return s->settled && !j->in->stale && memcmp (&s->wish_a, &j->in->a, sizeof s->wish_a) == 0
         && memcmp (&s->wish_b, &j->in->b, sizeof s->wish_b) == 0
         && s->wish_length == j->in->length;
}

static void
begin (bt__thesis_job *j)
{
  bt__thesis *s = j->state;
  for (int64_t k = 0; k < s->spans; k++)
    {
      j->span[k].end.fresh = BT__OLD;
      if (j->in->stale)
        j->span[k].solved = 0;
    }
  s->settled = 0;
  s->wish_a = j->in->a;
  s->wish_b = j->in->b;
  s->wish_length = j->in->length;
}

/* The spans as they are to be; the ends where they may go.  */
static bt_status
wish (bt__thesis_job *j)
{
  const bt_vec3 *x = bt__polyline_x (j->line);
  j->a = j->blocked ? x[0] : j->in->a;
  j->b = j->blocked ? x[j->line->n - 1] : j->in->b;
  bt__spans_stick (j);
  bt__spans_share_out (j);
  if (!j->blocked)
    {
      j->goal_a = j->a;
      j->goal_b = j->b;
    }
  bt_status status = bt__spans_solve (j);
  return status == BT_OK ? keep_back_sides (j) : status;
}

/* Give in to HIT, against which no split helps: the other nodes move on, then the ends stay, and
   the spans are solved for these ends.  */
static int
give_in (bt__thesis_job *j, const bt__hit *hit)
{
  j->counts->refused++;
  bt__polyline_creep (j->line, j->way);
  if (j->blocked)
    return 0;
  j->report->blocker = bt__hit_object (j->way, hit);
  j->blocked = 1;
  return 1;
}

/* Move; return true if there is more to do.  */
static int
move_polyline (bt__thesis_job *j)
{
  bt__hit hit;
  bt__thesis_aim (j);
  j->counts->rounds++;
  int arrived = bt__polyline_move (j->line, j->way, &hit) >= 1;
  j->state->settled = !j->blocked && arrived;
  if (arrived)
    bt__thesis_tidy (j);
  int responded = !arrived && respond (j, &hit);
  if (responded || bt__thesis_rejoin_open (j) > 0)
    return 1;
  return !arrived && give_in (j, &hit);
}

/* ---- The report ---- */

static int
objects_of (const bt__thesis_job *j, int64_t *list)
{
  int n = 0;
  for (int64_t k = 0; k < j->state->spans - 1; k++)
    list[n++] = j->span[k].end.object;
  return n;
}

static int
lists_object (const int64_t *list, int n, int64_t object)
{
  for (int i = 0; i < n; i++)
    if (list[i] == object)
      return 1;
  return 0;
}

/* Those of A that are not in B, each once.  */
static int
without (const int64_t *a, int n, const int64_t *b, int m, int64_t *out)
{
  int found = 0;
  for (int i = 0; i < n && found < BT__THESIS_LIST; i++)
    if (!lists_object (b, m, a[i]) && !lists_object (out, found, a[i]))
      out[found++] = a[i];
  return found;
}

static void
report (bt__thesis_job *j, const int64_t *before, int n)
{
  bt__thesis_report *r = j->report;
  const bt__surroundings *s = j->way->around;
  int64_t after[BT__SPLITS_MAX];
  int m = objects_of (j, after);
  r->a = bt__polyline_x (j->line)[0];
  r->b = bt__polyline_x (j->line)[j->line->n - 1];
  r->length = bt__polyline_u (j->line)[j->line->n - 1];
  j->state->held
      = bt__distance (r->a, j->goal_a) > BT__SAME || bt__distance (r->b, j->goal_b) > BT__SAME;
  r->held = (int)j->state->held;
  r->taut = (int)j->state->taut;
  r->touched_n = without (after, m, before, n, r->touched);
  r->left_n = without (before, n, after, m, r->left);
  for (uint32_t i = 0; i < s->movers; i++)
    if (s->mover[i].done < 1 && r->pinched_n < BT__THESIS_LIST)
      r->pinched[r->pinched_n++] = i;
}

bt_status
bt__thesis_step (bt__thesis *state, const bt__thesis_input *input, const bt__way *way,
                 bt__thesis_counts *counts, bt__thesis_report *out, bt_error *error)
{
  bt__thesis_job j = { .state = state,
                       .line = bt__thesis_line (state),
                       .span = bt__thesis_spans (state),
                       .in = input,
                       .way = way,
                       .counts = counts,
                       .report = out,
                       .error = error,
                       .radius = input->props->diameter / 2 };
  int64_t before[BT__SPLITS_MAX];
  int n = objects_of (&j, before), more = 1;
  *out = (bt__thesis_report){ .blocker = -1 };
  bt_status status = check_spans (&j);
  if (status != BT_OK)
    return status;
  bt__polyline_let_pass (j.line, way);
  bt__thesis_drop_lost (&j);
  if (is_idle (&j))
    {
      counts->skips += (uint64_t)state->spans;
      j.goal_a = bt__polyline_x (j.line)[0];
      j.goal_b = bt__polyline_x (j.line)[j.line->n - 1];
      report (&j, before, n);
      return BT_OK;
    }
  begin (&j);
  out->moved = 1;
  for (int round = 0; more && round < ROUNDS && status == BT_OK && !bt__ask (way->asker); round++)
    {
      status = wish (&j);
      more = status == BT_OK && move_polyline (&j);
    }
  state->settled = state->settled && !more;
  bt__spans_count_cheats (&j);
  report (&j, before, n);
  return status;
}
