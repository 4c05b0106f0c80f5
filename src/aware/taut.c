/* The taut string's state: laid, led by its ends, relaxed, seeded anew.

   One outer step is: look (taut_look.c), solve (taut_solve.c), obey (taut_solve.c), and accept the
   step if the string got shorter by more than 1e-9 m.  A refused step is tried again with forty
   times the proximal weight, four tries at most; a large weight keeps the nodes near their places.
   A string pushed out from obstacles may grow, and every step of the string is accepted.

   The string is settled after three steps in a row with a gain of less than a millionth of the
   length each.  A settled string costs nothing until an end moves or bt__string_wake is called.

   Ends are led by new nodes: the link from the old to the new end must be clear, then the old end
   becomes an inner node and relaxes.  So the homotopy class of the string is the class of the
   tether as long as the tether passes through nothing. bt__taut_reseed lays a fresh string along
   the tether and takes the fresh string over if it is clearly shorter: the tether then has slipped
   off an obstacle that does not hold it.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <stdlib.h>
#include <string.h>

#include "aware/taut_job.h"
#include "base/error.h"

#define GAIN 1e-9       /* m: less is none */
#define SETTLED 1e-6    /* of the length: a step that gains less ... */
#define SETTLED_TIMES 3 /* ... so often in a row ends the relaxing */

size_t
bt__string_size (uint32_t room)
{
  return sizeof (bt__string) + room * sizeof (bt_vec3);
}

bt_status
bt__taut_new (uint32_t room, bt__taut **out, bt_error *error)
{
  bt__taut *t = room >= 8 ? calloc (1, sizeof *t) : NULL;
  size_t n = room, sides = n * BT__PLANES_A_LINK;
  if (t)
    {
      t->room = room;
      t->side = malloc (sides * sizeof *t->side);
      t->active = malloc (sides);
      t->first = malloc (n * sizeof *t->first);
      t->unlisted = malloc (n * sizeof *t->unlisted);
      t->weight = malloc (n * sizeof *t->weight);
      t->most = malloc (n * sizeof *t->most);
      t->inverse = malloc (n * sizeof *t->inverse);
      t->right = malloc (n * sizeof *t->right);
      t->y = malloc (n * sizeof *t->y);
    }
  *out = t;
  if (t && t->side && t->active && t->first && t->unlisted && t->weight && t->most && t->inverse
      && t->right && t->y)
    return BT_OK;
  bt__taut_free (t);
  *out = NULL;
  return bt__fail (error, BT_ERR_LIMIT, "no room for a taut string of %u nodes; 8 at least",
                   (unsigned)room);
}

void
bt__taut_free (bt__taut *t)
{
  if (!t)
    return;
  free (t->side);
  free (t->active);
  free (t->first);
  free (t->unlisted);
  free (t->weight);
  free (t->most);
  free (t->inverse);
  free (t->right);
  free (t->y);
  free (t);
}

void
bt__taut_ask (bt__taut *t, bt__asker *asker)
{
  t->asker = asker;
}

int
bt__string_lay (bt__string *s, const bt_vec3 *p, uint32_t n)
{
  if (n < 2 || n > s->room)
    return 0;
  memmove (s->x, p, n * sizeof *p);
  s->n = n;
  bt__string_wake (s);
  s->length = bt__length (s->x, n);
  return 1;
}

/* ---- Relaxing ---- */

/* One step; return the length gained, 0 if no try gained any.  Where the string is to be pushed
   out it may grow: then the step is simply taken.  */
static double
step_once (bt__taut *t, const bt__taut_config *c, bt__string *s, bt__count *count)
{
  if (!bt__taut_look (t, c, s, count) || s->n < 3)
    return 0;
  double before = bt__length (s->x, s->n), prox = 2e-3 * (s->n - 1) / fmax (before, 1e-9);
  for (int try = 0; try < 4; try++, prox *= 40)
    {
      bt__taut_solve (t, s, prox);
      bt__taut_obey (t, s);
      double gain = before - bt__length (t->y, s->n);
      if (!(gain > GAIN) && !(c->want > c->core))
        continue;
      memcpy (s->x, t->y, s->n * sizeof *s->x);
      return gain;
    }
  return 0;
}

uint32_t
bt__taut_relax (bt__taut *t, const bt__taut_config *c, bt__string *s, uint32_t steps,
                bt__count *count)
{
  uint32_t taken = 0;
  for (; taken < steps && !s->settled && !bt__ask (t->asker); taken++)
    {
      double gain = step_once (t, c, s, count);
      s->length = bt__length (s->x, s->n);
      s->still = fabs (gain) < SETTLED * s->length ? s->still + 1 : 0;
      s->settled = s->still >= SETTLED_TIMES;
    }
  return taken;
}

/* ---- Leading the ends ---- */

static int
is_free_chord (const bt__taut_config *c, bt_vec3 from, bt_vec3 to, bt__count *count)
{
  bt__link way = { from, to };
  return !bt__scene_within (c->scene, c->on, &way, c->core, count);
}

static int
differs (bt_vec3 a, bt_vec3 b)
{
  return a.x != b.x || a.y != b.y || a.z != b.z;
}

int
bt__taut_step (bt__taut *t, const bt__taut_config *c, bt__string *s, bt_vec3 start, bt_vec3 end,
               uint32_t steps, bt__count *count)
{
  int lead = differs (start, s->x[0]), trail = differs (end, s->x[s->n - 1]);
  if (s->n + (uint32_t)(lead + trail) > s->room)
    return 0;
  if ((lead && !is_free_chord (c, start, s->x[0], count))
      || (trail && !is_free_chord (c, s->x[s->n - 1], end, count)))
    return 0;
  if (lead)
    {
      memmove (s->x + 1, s->x, s->n++ * sizeof *s->x);
      s->x[0] = start;
    }
  if (trail)
    s->x[s->n++] = end;
  if (lead || trail)
    bt__string_wake (s);
  bt__taut_relax (t, c, s, steps, count);
  return 1;
}

int
bt__taut_reseed (bt__taut *t, const bt__taut_config *c, bt__string *s, bt__string *fresh,
                 const bt_vec3 *p, uint32_t n, uint32_t steps, double slip, bt__count *count)
{
  if (!bt__string_lay (fresh, p, n))
    return 0;
  bt__taut_relax (t, c, fresh, steps, count);
  int empty = s->n < 2, slipped = !empty && fresh->length < (1 - slip) * s->length;
  if (empty || slipped)
    memcpy (s, fresh, bt__string_size (s->room));
  return slipped;
}
