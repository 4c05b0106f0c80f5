/* The nodes that are held, while nodes come and go: the list of them, and the line's nodes.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <string.h>

#include "contact/line_bend.h"

int
bt__sliding_has (const bt__sliding *s, int64_t i)
{
  for (int q = 0; q < s->n; q++)
    if (s->node[q] == i)
      return 1;
  return 0;
}

int
bt__sliding_goes_on (const bt__sliding *s, int q)
{
  return q >= 0 && q + 1 < s->n && s->node[q] + 1 == s->node[q + 1]
         && bt__bend_goes_on (s->anchor + q, s->anchor + q + 1);
}

int
bt__sliding_is_single (const bt__line_job *k, const bt__sliding *s, int q)
{
  return bt__edge_is_thin (k, s->anchor[q].thick) && !bt__sliding_goes_on (s, q - 1)
         && !bt__sliding_goes_on (s, q);
}

static void
shift_bends (bt__sliding *s, int64_t from, int by)
{
  for (int q = 0; q < s->n; q++)
    s->node[q] += s->node[q] >= from ? by : 0;
}

int
bt__sliding_add (bt__sliding *s, const bt__contact *a, int64_t node)
{
  int at = s->n++;
  for (; at > 0 && s->node[at - 1] > node; at--)
    {
      s->anchor[at] = s->anchor[at - 1];
      s->node[at] = s->node[at - 1];
      memcpy (s->was[at], s->was[at - 1], sizeof s->was[at]);
    }
  s->anchor[at] = *a;
  s->was[at][0] = s->was[at][1] = 0;
  s->node[at] = node;
  bt__sliding_change (s);
  return at;
}

void
bt__sliding_lose (bt__sliding *s, int q)
{
  if (bt__sliding_goes_on (s, q - 1))
    s->anchor[q - 1].after = bt__vec (0, 0, 0);
  bt__sliding_change (s);
  s->n--;
  for (int i = q; i < s->n; i++)
    {
      s->anchor[i] = s->anchor[i + 1];
      s->node[i] = s->node[i + 1];
      memcpy (s->was[i], s->was[i + 1], sizeof s->was[i]);
    }
}

/* ---- The line's nodes ---- */

void
bt__sliding_show (const bt__line_job *k, int64_t i, int by)
{
  const bt__line_hook *hook = k->config->hook;
  if (hook && hook->see)
    hook->see (hook->witness, (int)i, by, bt__dynamic_x (k->d), (int)k->d->n + 1);
}

void
bt__sliding_put_in (bt__line_job *k, bt__sliding *s, int64_t j, double u, int64_t from)
{
  bt__dynamic_insert (k->d, j, u, from);
  bt__sliding_came (k, s, j + 1);
}

void
bt__sliding_came (bt__line_job *k, bt__sliding *s, int64_t i)
{
  shift_bends (s, i, 1);
  bt__sliding_change (s);
  bt__sliding_show (k, i, 1);
}

int
bt__sliding_take_out (bt__line_job *k, bt__sliding *s, int64_t i)
{
  const bt_vec3 *p = bt__dynamic_x (k->d) + i - 1;
  const double *rest = bt__dynamic_rest (k->d) + i - 1;
  if (i < 1 || i >= k->d->n || bt__sliding_has (s, i))
    return 0;
  double u = rest[0] / (rest[0] + rest[1]);
  bt_vec3 to = bt__axpy (bt__scale (1 - u, p[0]), u, p[2]);
  if (!bt__line_may_move (k, p, bt__sub (to, p[1])))
    return 0;
  bt__dynamic_remove (k->d, i);
  shift_bends (s, i, -1);
  bt__sliding_change (s);
  bt__sliding_show (k, i, -1);
  return 1;
}

void
bt__sliding_let_go (bt__line_job *k, int64_t i)
{
  bt_vec3 *arrays[] = { bt__dynamic_v (k->d), bt__dynamic_vp (k->d), bt__dynamic_dx (k->d) };
  for (int q = 0; q < 3; q++)
    {
      bt_vec3 *v = arrays[q] + i;
      v[0] = bt__scale (0.5, bt__add (v[-1], v[1]));
    }
}

void
bt__sliding_take_hold (bt__line_job *k, int64_t i, bt_vec3 axis)
{
  bt_vec3 *arrays[] = { bt__dynamic_v (k->d), bt__dynamic_vp (k->d), bt__dynamic_dx (k->d) };
  for (int q = 0; q < 3; q++)
    arrays[q][i] = bt__scale (bt__dot (axis, arrays[q][i]), axis);
}

void
bt__sliding_drop (bt__line_job *k, bt__sliding *s, int q)
{
  int64_t node = s->node[q];
  bt__sliding_lose (s, q);
  bt__sliding_let_go (k, node);
}

void
bt__sliding_measure (bt__line_job *k)
{
  k->links = (int)k->d->n;
  bt__line_measure (k);
}

/* ---- Their anchors ---- */

void
bt__sliding_gather (bt__line_job *k, bt__sliding *s)
{
  bt__contact *a = bt__contacts_at (k->anchors);
  int64_t n = 0;
  s->n = 0;
  for (int64_t q = 0; q < k->anchors->n; q++)
    {
      int i = a[q].bent && s->n < BT__BENTS ? bt__bend_node (k, a[q].from_end) : -1;
      if (i > 0)
        bt__sliding_add (s, a + q, i);
      else
        {
          a[n] = a[q];
          a[n++].bent = 0;
        }
    }
  k->anchors->n = n;
}

void
bt__sliding_scatter (bt__line_job *k, bt__sliding *s)
{
  for (int q = 0; q < s->n; q++)
    {
      s->anchor[q].from_end = k->w->from_end[s->node[q]];
      if (k->anchors->n < k->anchors->room)
        bt__contacts_put (bt__contacts_at (k->anchors), k->anchors->n++, s->anchor + q);
    }
}

int
bt__sliding_take_anchor (bt__line_job *k, int q, bt__contact *a)
{
  bt__contact *at = bt__contacts_at (k->anchors);
  const bt__line_row *of = k->w->of + q;
  int64_t i = 0;
  while (i < k->anchors->n && !(at[i].from_end == of->from_end && at[i].object == of->id))
    i++;
  if (i == k->anchors->n)
    return 0;
  *a = at[i];
  k->anchors->n--;
  memmove (at + i, at + i + 1, (size_t)(k->anchors->n - i) * sizeof *at);
  return 1;
}
