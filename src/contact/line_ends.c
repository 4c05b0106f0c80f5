/* A step of the line among obstacles: its ends.

   An end with a target is a place that the line must reach, whatever the force.  There are two
   reasons to pull an end to its target by a bounded force instead.  Near anything the line may have
   no shape that reaches the target.  And a vehicle without mass pulls with no more than its pull:
   where the line pulls harder the end slips, and the vehicle comes no farther than the end.  An end
   that slips has no mass either: its place is never farther than one step's way, and with mass it
   would stay behind where the vehicle turns back along a tight line.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include "contact/line_job.h"

#define GIVE 20.0     /* m/s2: what the pull makes of the mass of an end that was held back */
#define HELD_BACK 0.9 /* of the most: an end that is pulled by more was held back */
#define HELD 1e-3     /* m: an end nearer than this to its place is there */
#define STANDS 5e-6   /* m: the same of an end that slips; what a step is accurate to */
#define HOLDING 10.0  /* times EA over a link's length: what holds an end in its place */
#define SLIPPED 0.999 /* of the most: an end that is pulled by more slipped in the last step */

/* The input, to be altered.  */
static bt__dynamic_input *
own_input (bt__line_job *k)
{
  if (k->in != &k->w->in)
    k->w->in = *k->in;
  k->in = &k->w->in;
  return &k->w->in;
}

void
bt__line_aim_ends (bt__line_job *k)
{
  for (int e = 0; e < 2; e++)
    if (!bt__is_finite (k->in->end[e].at))
      own_input (k)->end[e].at = k->x[e ? k->links : 0];
}

int
bt__line_hold_ends (bt__line_job *k)
{
  const double *rest = bt__dynamic_rest (k->d);
  int any = 0;
  for (int e = 0; e < 2; e++)
    {
      const bt__dynamic_end *end = k->in->end + e;
      bt_vec3 x = k->x[e ? k->links : 0], d = bt__sub (end->at, x);
      double size = bt__norm (d), most = k->config->pull[e];
      k->w->hold[e] = (bt__dynamic_hold){ 0 };
      if (end->free || !isfinite (most))
        continue;
      double last = rest[e ? k->links - 1 : 0];
      bt_vec3 pull = bt__scale (-1, k->d->pull[e]); /* of what held it in the last step */
      double now = bt__norm (pull);
      k->w->hold[e] = (bt__dynamic_hold){ .on = 1, .most = fmax (most, 1e-9) };
      k->w->hold[e].stiffness = fmin (HOLDING * k->in->line->ea / last, BT__LINE_STIFFEST);
      k->w->hold[e].mass = k->config->slips[e] ? 0 : most / GIVE;
      k->w->hold[e].at = size > BT__STRIDE ? bt__axpy (x, BT__STRIDE / size, d) : end->at;
      k->w->hold[e].force = now > most ? bt__scale (most / now, pull) : pull;
      own_input (k)->end[e].free = 1;
      any = 1;
    }
  return any;
}

void
bt__line_let_go (bt__line_job *k)
{
  for (int e = 0; e < 2; e++)
    if (k->w->hold[e].on)
      {
        k->w->hold[e].on = 0;
        own_input (k)->end[e].free = 0;
      }
}

void
bt__line_start_ends (bt__line_job *k)
{
  for (int e = 0; e < 2; e++)
    {
      const bt__dynamic_hold *h = k->w->hold + e;
      int i = e ? k->links : 0;
      if (h->on)
        k->X[i] = bt__norm (h->force) > HELD_BACK * h->most ? k->x[i] : h->at;
    }
}

int
bt__line_is_overpulled (const bt__line_job *k)
{
  int any = 0;
  for (int e = 0; e < 2; e++)
    any |= k->config->slips[e] && !k->in->end[e].free
           && bt__norm (bt__dynamic_end_pull (k->kernel, e)) > k->config->pull[e];
  return any;
}

int
bt__line_slipped (const bt__line_job *k)
{
  int any = 0;
  for (int e = 0; e < 2; e++)
    any |= k->config->slips[e] && !k->in->end[e].free
           && bt__norm (k->d->pull[e]) > SLIPPED * k->config->pull[e];
  return any;
}

int
bt__line_slips (const bt__line_job *k)
{
  int any = 0;
  for (int e = 0; e < 2; e++)
    any |= k->config->slips[e] && k->w->hold[e].on && k->w->hold[e].slips;
  return any;
}

void
bt__line_tell_ends (bt__line_job *k, const bt__dynamic_input *input)
{
  for (int e = 0; e < 2; e++)
    {
      bt_vec3 x = bt__dynamic_x (k->d)[e ? k->d->n : 0], at = input->end[e].at;
      k->report->end[e] = x;
      k->report->held[e]
          = !input->end[e].free && !(bt__distance (x, at) <= (k->config->slips[e] ? STANDS : HELD));
    }
}
