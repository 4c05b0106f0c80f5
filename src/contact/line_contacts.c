/* The block of contacts that lasts from step to step.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <math.h>
#include <string.h>

#include "contact/line.h"
#include "math/vec.h"

size_t
bt__contacts_size (int room)
{
  return sizeof (bt__contacts) + (size_t)room * sizeof (bt__contact);
}

size_t
bt__contacts_live (const bt__contacts *a)
{
  return bt__contacts_size ((int)a->n);
}

bt__contact *
bt__contacts_at (const bt__contacts *a)
{
  return (bt__contact *)(a + 1);
}

void
bt__contacts_init (bt__contacts *a, int room)
{
  memset (a, 0, sizeof *a); /* what is behind the live ones is never read */
  a->room = room;
}

void
bt__contacts_put (bt__contact *at, int64_t n, const bt__contact *a)
{
  for (; n > 0 && at[n - 1].from_end < a->from_end; n--)
    at[n] = at[n - 1];
  at[n] = *a;
}

void
bt__contacts_cut (bt__contacts *a, double from, double to, int64_t id)
{
  bt__contact *at = bt__contacts_at (a);
  int64_t kept = 0;
  for (int64_t q = 0; q < a->n; q++)
    {
      int itself = at[q].mover == BT__CONTACT_LINE && at[q].object == id;
      if (itself || at[q].from_end < from || at[q].from_end > to)
        continue;
      at[kept] = at[q];
      at[kept++].from_end -= from;
    }
  a->n = kept;
}

/* ---- What is told ---- */

int
bt__line_touches (const bt__dynamic *d, const bt__contacts *anchors, bt__touch *out, int room)
{
  const bt__contact *a = bt__contacts_at (anchors);
  int n = anchors->n < room ? (int)anchors->n : room;
  double length = bt__dynamic_length (d), inner = length - d->owed;
  for (int i = 0; i < n; i++)
    {
      double share = fmin (fmax (1 - a[i].from_end / inner, 0), 1);
      out[i] = (bt__touch){ a[i].object, a[i].triangle, a[i].state, share * length,
                            a[i].point,  a[i].normal,   a[i].force };
    }
  return n;
}
