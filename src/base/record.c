/* Judging flat structs by the tables of their members.

   A table lists for every member its offset, size, kind and permitted values: doubles within
   bounds, perhaps NaN; whole numbers within bounds or below a count of the world; structs with
   tables of their own; words without a rule.  Judging copies each value out of the bytes, never
   reads through a pointer, and fails at the first bad member with its name and its bounds.

   bt__record_gap proves a table complete: from byte 0 on, each member must begin where the member
   before has ended, be listed once, and be made of whole words.  A test calls the function for all
   tables, so a member added to a struct without a row in its table fails the test.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <inttypes.h>
#include <math.h>
#include <string.h>

#include "base/error.h"
#include "base/record.h"

static bt_status
refuse_real (const bt__judge *j, const char *record, const char *name, double x, double low,
             double high)
{
  return bt__fail (j->error, BT_ERR_FORMAT, "%s: `%s' of its %s is %g, not %g to %g", j->whose,
                   name, record, x, low, high);
}

static bt_status
refuse_whole (const bt__judge *j, const char *record, const char *name, int64_t x, int64_t low,
              int64_t high)
{
  return bt__fail (j->error, BT_ERR_FORMAT,
                   "%s: `%s' of its %s is %" PRId64 ", not %" PRId64 " to %" PRId64, j->whose, name,
                   record, x, low, high);
}

static bt_status
judge_reals (const bt__judge *j, const bt__record *r, const bt__member *m, const char *at)
{
  for (size_t k = 0; k < m->size; k += sizeof (double))
    {
      double x;
      memcpy (&x, at + k, sizeof x);
      if (!(x >= m->low && x <= m->high) && !(m->or_nan && isnan (x)))
        return refuse_real (j, r->name, m->name, x, m->low, m->high);
    }
  return BT_OK;
}

static bt_status
judge_wholes (const bt__judge *j, const bt__record *r, const bt__member *m, const char *at)
{
  int64_t high = m->below ? j->below[m->below] - 1 : (int64_t)m->high, x;
  for (size_t k = 0; k < m->size; k += sizeof x)
    {
      memcpy (&x, at + k, sizeof x);
      if (x < (int64_t)m->low || x > high)
        return refuse_whole (j, r->name, m->name, x, (int64_t)m->low, high);
    }
  return BT_OK;
}

static bt_status judge_members (const bt__judge *j, const bt__record *r, const char *at, size_t n);

static bt_status
judge_member (const bt__judge *j, const bt__record *r, const bt__member *m, const char *at)
{
  switch (m->kind)
    {
    case BT__MEMBER_REAL:
      return judge_reals (j, r, m, at);
    case BT__MEMBER_WHOLE:
      return judge_wholes (j, r, m, at);
    case BT__MEMBER_RECORD:
      return judge_members (j, m->record, at, m->size / m->record->size);
    default:
      return BT_OK;
    }
}

static bt_status
judge_members (const bt__judge *j, const bt__record *r, const char *at, size_t n)
{
  bt_status status = BT_OK;
  for (; n > 0 && status == BT_OK; n--, at += r->size)
    for (size_t k = 0; k < r->members && status == BT_OK; k++)
      status = judge_member (j, r, &r->member[k], at + r->member[k].at);
  return status;
}

bt_status
bt__judge_records (bt__judge *j, const bt__record *record, const void *at, size_t n)
{
  j->seen += n * record->size;
  return judge_members (j, record, at, n);
}

bt_status
bt__judge_reals (bt__judge *j, const char *what, const double *x, size_t n, double low, double high)
{
  j->seen += n * sizeof *x;
  for (size_t k = 0; k < n; k++)
    if (!(x[k] >= low && x[k] <= high))
      return bt__fail (j->error, BT_ERR_FORMAT, "%s: number %zu of its %s is %g, not %g to %g",
                       j->whose, k, what, x[k], low, high);
  return BT_OK;
}

bt_status
bt__judge_count (bt__judge *j, const char *what, int64_t n, int64_t low, int64_t high)
{
  if (n >= low && n <= high)
    return BT_OK;
  return bt__fail (j->error, BT_ERR_FORMAT, "%s has %" PRId64 " %s, not %" PRId64 " to %" PRId64,
                   j->whose, n, what, low, high);
}

bt_status
bt__judge_that (bt__judge *j, int holds, const char *true_of)
{
  return holds ? BT_OK
               : bt__fail (j->error, BT_ERR_FORMAT, "%s: it is not so that %s", j->whose, true_of);
}

/* The member that byte AT begins, or NULL.  */
static const bt__member *
member_at (const bt__record *r, size_t at)
{
  const bt__member *found = NULL;
  for (size_t k = 0; k < r->members; k++)
    if (r->member[k].at == at)
      {
        if (found)
          return NULL;
        found = &r->member[k];
      }
  return found;
}

static int
is_whole (const bt__member *m)
{
  size_t word = m->kind == BT__MEMBER_RECORD ? m->record->size : sizeof (int64_t);
  return m->size > 0 && m->size % word == 0;
}

size_t
bt__record_gap (const bt__record *r)
{
  size_t at = 0, used = 0;
  for (const bt__member *m; at < r->size && (m = member_at (r, at)) && is_whole (m); at += m->size)
    used++;
  return at == r->size && used < r->members ? 0 : at;
}
