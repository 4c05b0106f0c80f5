/* Hauling home, the way home, the loop that unwinds.

   The instant rule (bt__haul_prospect) walks the bends of the taut string from the winch to the
   vehicle.  Behind each bend the pull is less by the capstan factor exp (-mu theta) of Euler and
   Eytelwein.  Three questions are asked, in this order:

   Locked: the pull at the vehicle, winch over the product of all capstan factors, is less than the
   vehicle's weight in water or the least force that moves the vehicle.  The rule is sure if the
   same holds with the share `grip' of the angles alone.

   Hung: at a bend of more than 0.3 rad the vehicle, taken as a ball of radius R, must climb round a
   member of radius r.  The share of the pull along the contact is s = r / (r + R); friction of the
   body takes mu_b sqrt (1 - s^2) of the pull.  The body hangs if the remainder is less than its
   weight and 1 N more.  A share of 0 or less means hung at any pull: a thin member or an edge
   catches the body.

   Wedged: the string pushed out to the vehicle's radius finds no room (bt__haul_wedge), or the
   string passes two surfaces within the body's radius that face each other (bt__haul_crotch).

   Ways come from the string itself.  The way home is the taut string reversed, pushed out from
   obstacles by the planes of the same quadratic programme (taut_solve.c) with a greater distance.
   The loop that unwinds is the string backwards followed by the free way, drawn tight: its homotopy
   class is T^-1 F, and flying the loop leaves the tether in the class of the free way. preview
   leads a copy of the string along the loop in steps of 0.3 m and reports the greatest length on
   the way.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <string.h>

#include "aware/haul.h"

enum
{
  PUSH_STEPS = 40, /* a body's way need not be the shortest */
  LOOP_STEPS = 400,
  PARTS = 32 /* near to a link; those beyond are farther */
};

#define LEAST_BEND 0.3 /* radians: a body slides past less */
#define SPARE_PULL 1.0 /* N: less does not count as pulling */
#define TRIM 0.05      /* of the pull: a vehicle in trim weighs less */
#define FACING 0.5     /* cosine between two outward normals: less is a corner to wedge in */
#define HOME_NEAR 1.5  /* m: of the start is home */
#define NOTHING UINT32_MAX

/* ---- The instant rule ---- */

/* Return the speed, m/s, at which the drag of the vehicle equals FORCE, N.  */
static double
hauling_speed (const bt__haul_body *b, double force)
{
  if (!(force > 0))
    return 0;
  if (!(b->drag2 > 0))
    return b->drag1 > 0 ? force / b->drag1 : INFINITY;
  return 2 * force / (b->drag1 + sqrt (b->drag1 * b->drag1 + 4 * b->drag2 * force));
}

/* The share of the pull that drags a body of radius R past a contact of radius MEMBER: the
   geometric share less friction.  Less than 0: it hangs at any pull.  */
static double
share_past (const bt__haul_body *b, double member)
{
  double s = member / (member + fmax (b->radius, b->reach));
  return s - b->friction * sqrt (1 - s * s);
}

/* A stretch of the string about one round member, or about edges of an object closer together than
   the body is wide.  */
typedef struct bend
{
  uint32_t object, next; /* next: the hold after it */
  double angle, radius, s, friction;
} bend;

static int
is_one_bend (const bt__corner *a, const bt__corner *b, double width)
{
  return a->object == b->object && ((a->radius > 0 && b->radius > 0) || b->s - a->s < width);
}

static bend
bend_from (const bt__holds *h, uint32_t i, double width)
{
  bend b = {
    .object = h->at[i].object, .radius = INFINITY, .s = h->at[i].s, .friction = h->at[i].friction
  };
  for (b.next = i; b.next < h->n; b.next++)
    {
      if (b.next > i && !is_one_bend (h->at + b.next - 1, h->at + b.next, width))
        break;
      b.angle += h->at[b.next].angle;
      b.radius = fmin (b.radius, h->at[b.next].radius);
    }
  return b;
}

static void
say (bt__prospect *p, bt__answer answer, bt__haul_reason reason, uint32_t object, double s)
{
  p->answer = answer;
  p->reason = reason;
  p->object = object;
  p->s = s;
}

/* Return the bend with the most friction, the greatest mu theta.  */
static bend
worst_bend (const bt__holds *h, double width)
{
  bend worst = { .object = NOTHING };
  double most = -1;
  for (uint32_t i = 0; i < h->n;)
    {
      bend b = bend_from (h, i, width);
      double grip = b.friction * b.angle;
      if (grip > most)
        {
          most = grip;
          worst = b;
        }
      i = b.next;
    }
  return worst;
}

bt__prospect
bt__haul_prospect (const bt__holds *h, const bt__haul_body *body)
{
  bt__prospect p = { .object = NOTHING, .lock = bt__holds_lock (h) };
  double weight = fabs (body->weight), pull = body->winch;
  p.pull = pull / p.lock;
  p.speed = hauling_speed (body, p.pull - weight);
  say (&p, h->n == 0 && weight < TRIM * p.pull ? BT__YES : BT__UNSURE, BT__HAUL_CLEAR, NOTHING, 0);
  if (fmax (body->least, weight) > p.pull)
    {
      bend b = worst_bend (h, 2 * body->radius);
      int sure = fmax (body->least, weight) > pull / pow (p.lock, body->grip);
      say (&p, sure ? BT__NO : BT__UNSURE, BT__HAUL_LOCKED, b.object, b.s);
      return p;
    }
  for (uint32_t i = 0; i < h->n;)
    {
      bend b = bend_from (h, i, 2 * body->radius);
      pull *= exp (-b.friction * b.angle);
      if (b.angle > LEAST_BEND && pull * share_past (body, b.radius) < weight + SPARE_PULL)
        say (&p, BT__UNSURE, BT__HAUL_HUNG, b.object, b.s); /* the last one is met first */
      i = b.next;
    }
  return p;
}

void
bt__haul_wedge (const bt__route *home, const bt__haul_body *body, bt__prospect *p)
{
  if (p->reason == BT__HAUL_CLEAR && home->clearance < body->radius)
    say (p, BT__UNSURE, BT__HAUL_WEDGED, home->object, fmax (home->length - home->s, 0));
}

/* True if two parts in LIST face each other.  */
static int
is_crotch (const bt__nears *list)
{
  for (uint32_t i = 1; i < list->n; i++)
    for (uint32_t j = 0; j < i; j++)
      if (bt__dot (list->at[i].w.normal, list->at[j].w.normal) < FACING)
        return 1;
  return 0;
}

void
bt__haul_crotch (const bt__taut_config *config, const bt__string *string, const bt__haul_body *body,
                 bt__prospect *p, bt__count *count)
{
  bt__near room[PARTS];
  double s = 0;
  if (p->reason != BT__HAUL_CLEAR)
    return;
  for (uint32_t i = 0; i + 1 < string->n; i++)
    {
      bt__link link = { string->x[i], string->x[i + 1] };
      bt__nears list = { .at = room, .room = PARTS };
      s += bt__distance (link.a, link.b);
      if (s < HOME_NEAR)
        continue;
      bt__scene_near (config->scene, config->on, &link, i, body->radius, &list, count);
      if (is_crotch (&list))
        say (p, BT__UNSURE, BT__HAUL_WEDGED, list.at[0].object, s); /* the last is met first */
    }
}

/* ---- Ways ---- */

/* Return the clearance of STRING and its place.  The stretches within SPARE of the ends are left
   out: the body is at one end and arrives at the other.  */
static bt__route
measure_route (const bt__taut_config *config, double spare, double cap, const bt__string *string,
               bt__count *count)
{
  bt__route way = { string->length, cap, NOTHING, 0 };
  double s = 0;
  for (uint32_t i = 0; i + 1 < string->n; i++)
    {
      bt_vec3 d = bt__sub (string->x[i + 1], string->x[i]);
      double end = s + bt__norm (d);
      double from = fmax (s, spare), to = fmin (end, string->length - spare);
      bt__link link = { bt__axpy (string->x[i], (from - s) / (end - s), d),
                        bt__axpy (string->x[i], (to - s) / (end - s), d) };
      bt__near near;
      if (from < to
          && bt__scene_nearest (config->scene, config->on, &link, way.clearance, &near, count))
        {
          way.clearance = near.w.distance;
          way.object = near.object;
          way.s = from;
        }
      s = end;
    }
  return way;
}

/* Push STRING out to WANT and measure it.  */
static bt__route
push_string_out (bt__taut *taut, const bt__taut_config *config, double want, bt__string *string,
                 bt__count *count)
{
  bt__taut_config wide = *config;
  wide.want = want;
  wide.margin = fmax (config->margin, want + 0.2);
  wide.mesh = fmin (config->mesh, want);
  bt__string_wake (string);
  bt__taut_relax (taut, &wide, string, PUSH_STEPS, count);
  return measure_route (config, want, 10 * want, string, count);
}

static void
reverse (bt_vec3 *p, uint32_t n)
{
  for (uint32_t i = 0; i < n / 2; i++)
    {
      bt_vec3 swap = p[i];
      p[i] = p[n - 1 - i];
      p[n - 1 - i] = swap;
    }
}

bt__route
bt__way_home (bt__taut *taut, const bt__taut_config *config, const bt__string *string, double want,
              bt__string *home, bt__count *count)
{
  bt__route none = { 0, 0, NOTHING, 0 };
  if (!bt__string_lay (home, string->x, string->n))
    return none;
  reverse (home->x, home->n);
  return push_string_out (taut, config, want, home, count);
}

/* ---- The loop ---- */

/* STRING backwards, then FREE_WAY.  */
static int
lay_loop (const bt__string *string, const bt__string *free_way, bt__string *loop)
{
  uint32_t n = string->n + free_way->n - 1;
  if (n > loop->room)
    return 0;
  memcpy (loop->x, string->x, string->n * sizeof *loop->x);
  reverse (loop->x, string->n);
  memcpy (loop->x + string->n, free_way->x + 1, (free_way->n - 1) * sizeof *loop->x);
  loop->n = n;
  bt__string_wake (loop);
  loop->length = bt__length (loop->x, n);
  return 1;
}

/* Lead the end of COPY along LOOP; return 0 if an obstacle stops the end. *LONGEST is the greatest
   length of COPY on the way.  */
static int
preview (bt__taut *taut, const bt__taut_config *config, const bt__string *loop, bt__string *copy,
         double *longest, bt__count *count)
{
  bt_vec3 start = copy->x[0];
  *longest = copy->length;
  for (uint32_t i = 0; i + 1 < loop->n; i++)
    {
      bt_vec3 d = bt__sub (loop->x[i + 1], loop->x[i]);
      int steps = (int)fmax (1, ceil (bt__norm (d) / 0.3));
      for (int k = 1; k <= steps; k++)
        {
          bt_vec3 to = bt__axpy (loop->x[i], (double)k / steps, d);
          if (!bt__taut_step (taut, config, copy, start, to, 2, count))
            return 0;
          *longest = fmax (*longest, copy->length);
        }
    }
  bt__taut_relax (taut, config, copy, LOOP_STEPS, count);
  return 1;
}

bt__unwind
bt__unwind_plan (bt__taut *taut, const bt__taut_config *config, const bt__string *string,
                 const bt__string *free_way, double want, double out, double radius,
                 bt__string *loop, bt__string *copy, bt__count *count)
{
  bt__unwind u = { .way = { .object = NOTHING } };
  if (!lay_loop (string, free_way, loop) || !bt__string_lay (copy, string->x, string->n))
    return u;
  bt__taut_relax (taut, config, loop, LOOP_STEPS, count);
  u.needed = loop->length > 0.05;
  u.left = u.longest = string->length;
  if (!u.needed)
    return u;
  u.way = push_string_out (taut, config, want, loop, count);
  int flown = preview (taut, config, loop, copy, &u.longest, count);
  u.left = copy->length;
  u.feasible = flown && u.longest <= out && u.way.clearance >= radius + 0.03
               && u.left <= free_way->length + fmax (0.5, 0.02 * free_way->length);
  return u;
}
