/* The scenes of stability_flight.h, and who flies in them: the jacket is drawn at random, the
   others are the worlds of their names.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <stdlib.h>

#include "stability_flight.h"

/* ---- Who flies ---- */

/* Where the line is laid, and the box in which a pilot's aims are.  */
typedef struct place
{
  int corners;
  bt_vec3 shape[FLIGHT_CORNERS];
  double length;
  bt_vec3 lo, hi;
} place;

static const place places[FLIGHT_KINDS] = {
  [FLIGHT_JACKET] = { 4,
                      { { -14, 0, -5 }, { -16, -20, -8 }, { -12, -20, -8 }, { -9, 0, -8 } },
                      60,
                      { -9, -9, -28 },
                      { 9, 9, -1 } },
  [FLIGHT_WRECK] = { 4,
                     { { -16, -18, -3 }, { -28, -14, -6 }, { -18, -2, -12 }, { -10, -8, -16 } },
                     44,
                     { -8, -14, -23.5 },
                     { 8, 14, -9 } },
  [FLIGHT_RIGGING] = { 4,
                       { { -12, -16, -4 }, { -22, -12, -8 }, { -14, -2, -14 }, { -8, -8, -18 } },
                       38,
                       { -5, -8, -24.8 },
                       { 5, 8, -12 } },
  [FLIGHT_CANYON] = { 4,
                      { { 0, -32, -22 }, { 10, -22, -20 }, { 0, -12, -20 }, { 0, -24, -33 } },
                      50,
                      { -9, -34, -37.5 },
                      { 9, 14, -27 } },
};

static const place *
place_of (const flight *f)
{
  return places + (f->kind == FLIGHT_HARM ? FLIGHT_JACKET : f->kind);
}

static bt_vec3
somewhere (const place *p, dice *d)
{
  double x = dice_between (d, p->lo.x, p->hi.x), y = dice_between (d, p->lo.y, p->hi.y);
  return bt__vec (x, y, dice_between (d, p->lo.z, p->hi.z));
}

/* Now and then elsewhere, and now and then the other way.  */
static void
draw_aims (flight *f, dice *d)
{
  const place *p = place_of (f);
  bt_vec3 at = somewhere (p, d);
  for (int i = 0; i < f->steps && f->aims < FLIGHT_AIMS; i++)
    {
      int new = dice_below (d, 240) == 0, about = dice_below (d, 240) == 0;
      if (new)
        at = somewhere (p, d);
      if (about)
        at = bt__sub (bt__add (p->lo, p->hi), at);
      if (new || about || i == 0)
        f->aim[f->aims++] = (flight_aim){ i, at };
    }
}

void
flight_draw (flight *f, uint64_t seed, long number)
{
  long turn = number / 2 % FLIGHT_HARM;
  *f = (flight){ .kind = number % 2 ? FLIGHT_HARM : (flight_kind)turn,
                 .harm = (flight_harm)turn,
                 .seed = seed * 1000003 + (uint64_t)number + 1,
                 .links = 100,
                 .steps = number % 2 ? FLIGHT_HARM_STEPS : FLIGHT_STEPS,
                 .friction = 0.3 };
  const place *p = place_of (f);
  dice d = dice_new (f->seed);
  f->corners = p->corners;
  f->length = p->length;
  for (int i = 0; i < p->corners; i++)
    f->shape[i] = p->shape[i];
  f->body = dice_below (&d, 2) && f->kind != FLIGHT_HARM;
  f->speed = f->kind == FLIGHT_HARM ? 5 : exp (dice_between (&d, log (0.3), log (5)));
  f->weight = dice_below (&d, 3) ? 0 : 0.5;
  double north = dice_between (&d, -0.2, 0.2), east = dice_between (&d, -0.2, 0.2);
  f->flow = bt__vec (east, north, 0);
  draw_aims (f, &d);
}

int
flight_scene (const flight *f, reef *r)
{
  int drawn = f->kind == FLIGHT_JACKET || f->kind == FLIGHT_HARM;
  return drawn ? reef_jacket (r, f->seed) : reef_world (r, flight_kind_names[f->kind]);
}
