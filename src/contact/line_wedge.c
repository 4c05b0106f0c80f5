/* Two-sided contact: a line between two obstacles with less room than its diameter.

   The contacts on both sides press on each other: penetration given up on one side is taken up on
   the other.  A contact's stiffness must not follow its own load here, or both would grow in every
   step; it follows the tension, independent of both, and the penetration towards the core.  As a
   line pressed to its core can be pressed no further, the load at penetration D is

       k D  up to a share E of the way W from radius to core,  then  k (E + (D - E) / (1 - y)),

   y = (D - E) / (W - E): a law of the place alone, so no contact returns more energy than it took.
   A step uses the tangent of the law at the penetration from which the step starts.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include "contact/line_job.h"

#define OPPOSED (-0.25) /* product of two normals: less, and they make a wedge */
#define EASY 0.25       /* of the way to the core: so far a contact is a spring, ... */
#define HARDEST 0.7     /* ... and so far beyond it gets stiffer */

/* The direction out of NEAR in the world.  */
static bt_vec3
way_out (const bt__line_job *k, const bt__near *near)
{
  const bt__mover *m = bt__line_mover (k, near);
  return m ? bt__out_of (&m->motion.from, near->w.normal) : near->w.normal;
}

int
bt__line_is_wedged (const bt__line_job *k, uint32_t j, double share)
{
  const bt__near *near = bt__line_near (k, j);
  double touch = share * (k->config->radius + k->margin);
  uint32_t found = k->w->watch[j].found;
  for (uint32_t i = 1; i < found; i++)
    for (uint32_t q = 0; q < i && near[i].w.distance < touch; q++)
      if (near[q].w.distance < touch
          && bt__dot (way_out (k, near + i), way_out (k, near + q)) < OPPOSED)
        return 1;
  return 0;
}

void
bt__line_press (const bt__line_job *k, int i)
{
  bt__constraint *r = k->w->row + i;
  double way = k->config->radius - k->config->core, easy = EASY * way;
  double beyond = k->config->radius - k->w->of[i].distance - easy;
  if (!k->w->of[i].wedged || !(beyond > 0))
    return;
  double y = fmin (beyond / (way - easy), HARDEST), left = 1 - y;
  beyond = y * (way - easy);
  r->offset -= easy * (1 - left * left) + beyond * y;
  r->stiffness /= left * left;
}
