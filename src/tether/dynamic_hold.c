/* The moving line: a winch that holds no more than it can.

   A step is solved with the rest length that the winch gives the first interval.  Where the line
   then pulls harder than the winch holds, the winch gives way: the first interval gets more line,
   until the pull is what the winch holds.  The pull falls as line is given, nearly in proportion,
   so false position finds how much in a few solutions of the step, each of which goes on from the
   one before.  What is taken is a solution that pulls no harder than the winch holds, unless there
   is no more line to give.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include "tether/dynamic_kernel.h"

enum
{
  TRIES = 24
};

#define NEAR 1e-3 /* of what the winch holds: a pull that is less by so little will do */
#define RUN 30.0  /* times: the most that is given more than in the try before */

/* What was tried: line given, and by how much the pull then exceeds what the winch holds, N.  */
typedef struct trial
{
  double given, over;
} trial;

static trial
look (bt__dynamic_work *w)
{
  return (trial){ w->given, bt__dynamic_overload (w) };
}

static trial
give (bt__dynamic_work *w, double given, bt__dynamic_report *report)
{
  bt__dynamic_lengthen (w, 0, given - w->given);
  w->link[0].start += given - w->given;
  w->given = given;
  report->converged = bt__dynamic_newton (w, report);
  return look (w);
}

/* Where the straight line through A and B meets what is aimed at, a little below no excess; NaN if
   it does not fall.  */
static double
meet (const trial *a, const trial *b, double aim)
{
  double slope = (b->over - a->over) / (b->given - a->given);
  return slope < 0 ? b->given + (aim - b->over) / slope : NAN;
}

/* How much to give after NOW, which pulls too hard; BEFORE gave less and pulled too hard as well,
   or is NOW.  The first guess is as if nothing but the first interval could stretch.  */
static double
give_more (const bt__dynamic_work *w, const trial *before, const trial *now, double aim)
{
  const bt__link *k = w->link;
  double first = now->given + (now->over - aim) / (k->ka + now->over / k->rest);
  double next = now->given > before->given ? meet (before, now, aim) : first;
  double most = now->given > 0 ? RUN * now->given : next;
  return fmin (isnan (next) ? most : fmin (next, most), w->in->room);
}

/* Between LOW, which pulls too hard, and HIGH, which does not.  */
static double
flow_between (const trial *low, const trial *high, double aim, int i)
{
  double next = meet (low, high, aim), margin = 0.01 * (high->given - low->given);
  if (isnan (next) || i % 3 == 2) /* one side may be a corner, from which false position creeps */
    next = 0.5 * (low->given + high->given);
  return fmin (fmax (next, low->given + margin), high->given - margin);
}

/* What is known so far: the most that was given and not enough, twice, and the least that was more
   than enough, if there is any.  */
typedef struct bracket
{
  trial before, low, high;
  int bounded;
} bracket;

/* True if NOW may be taken.  */
static int
is_enough (const bt__dynamic_work *w, const trial *now)
{
  double hold = w->in->hold;
  return now->over > 0 ? now->given >= w->in->room : now->over >= -NEAR * hold || !(now->given > 0);
}

static void
note (bracket *b, const trial *now)
{
  if (now->over > 0)
    {
      b->before = now->given > b->low.given ? b->low : *now;
      b->low = *now;
      return;
    }
  b->high = *now;
  b->bounded = 1;
}

/* From NOW find how much must be given.  An earlier solution of this step may have given more than
   is needed by now.  */
static void
give_way (bt__dynamic_work *w, trial now, bt__dynamic_report *report)
{
  double aim = -0.5 * NEAR * w->in->hold;
  bracket b = { .before = now, .low = now };
  for (int i = 0; i < TRIES && !is_enough (w, &now) && isfinite (now.over); i++)
    {
      note (&b, &now);
      if (i == 0 && b.bounded)
        now = give (w, 0, report);
      else if (b.bounded)
        now = give (w, flow_between (&b.low, &b.high, aim, i), report);
      else
        now = give (w, give_more (w, &b.before, &b.low, aim), report);
    }
  if (!isfinite (now.over)) /* as if it held everything */
    give (w, 0, report);
  else if (now.over > 0 && b.bounded)
    give (w, b.high.given, report);
}

int
bt__dynamic_settle (bt__dynamic_work *w, bt__dynamic_report *report)
{
  report->converged = bt__dynamic_newton (w, report);
  if (w->in->hold > 0)
    {
      trial now = look (w);
      if (now.over > 0 || (w->given > 0 && isfinite (now.over)))
        give_way (w, now, report);
    }
  return report->converged;
}

void
bt__dynamic_give_nothing (bt__dynamic_work *w)
{
  bt__dynamic_lengthen (w, 0, -w->given);
  w->link[0].start -= w->given;
  w->given = 0;
}
