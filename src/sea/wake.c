/* The lee of a pile: how much of a current is left behind it.  The model stands in bight/sea.h.

   Four wakes at a time.  Most water is in no lee, which is found without a root or a quotient.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <bight/sea.h>

#include "math/four.h"
#include "math/vec.h"

/* In diameters.  */
#define CLOSE 3.0
#define FADES 40.0
#define GONE 60.0
#define BEFORE 0.5
#define DEFICIT 0.5
#define WIDE 6.0                 /* standard widths beyond which nothing is left, ... */
#define WITHIN (WIDE * WIDE / 4) /* ... and squared, where the width is half a diameter */

bt_wake
bt_wake_of (bt_vec3 a, bt_vec3 b, double radius)
{
  bt_vec3 axis = bt__sub (b, a);
  return (bt_wake){ a, bt__unit_or (axis, bt__vec (0, 0, 1)), bt__norm (axis), radius };
}

void
bt_wakes_put (bt_wakes *wakes, size_t i, const bt_wake *wake)
{
  bt_wakes *block = wakes + i / BT_WAKES_WIDE;
  size_t k = i % BT_WAKES_WIDE;
  block->a[0][k] = wake->a.x;
  block->a[1][k] = wake->a.y;
  block->a[2][k] = wake->a.z;
  block->axis[0][k] = wake->axis.x;
  block->axis[1][k] = wake->axis.y;
  block->axis[2][k] = wake->axis.z;
  block->length[k] = wake->length;
  block->radius[k] = wake->radius;
}

/* A place among four wakes.  */
typedef struct place
{
  bt__four d, along, past; /* m: the diameter; from the near end along the axis, from the far one */
  bt__four across2;        /* m2/s2: square of the current across the axis */
  bt__four way, side2;     /* m2/s, m4/s2: downstream by that speed, aside squared by its square */
} place;

static BT__HOT place
find_place (const bt_wakes *w, bt_vec3 u, bt_vec3 p)
{
  bt__four x = p.x - bt__four_load (w->a[0]), y = p.y - bt__four_load (w->a[1]),
           z = p.z - bt__four_load (w->a[2]);
  bt__four ex = bt__four_load (w->axis[0]), ey = bt__four_load (w->axis[1]),
           ez = bt__four_load (w->axis[2]);
  bt__four along = x * ex + y * ey + z * ez, down = u.x * ex + u.y * ey + u.z * ez;
  bt__four across2 = bt__dot (u, u) - down * down;
  bt__four way = x * u.x + y * u.y + z * u.z - along * down;
  return (place){ 2 * bt__four_load (w->radius),
                  along,
                  along - bt__four_load (w->length),
                  across2,
                  way,
                  (x * x + y * y + z * z - along * along) * across2 - way * way };
}

/* Where it lies in the lee: not beyond an end, before, too far behind nor beside; and the current
   not along the axis.  */
static BT__HOT bt__four_mask
is_in_lee (const place *at, double speed2)
{
  bt__four way2 = at->way * at->way, d2 = at->d * at->d * at->across2;
  return (at->along > -at->d) & (at->past < at->d) & (at->across2 > 1e-12 * speed2)
         & ((at->way > 0) | (way2 < BEFORE * BEFORE * d2)) & (way2 < GONE * GONE * d2)
         & ((at->side2 < WITHIN * d2)
            | (at->side2 * at->side2 < WITHIN * WITHIN / (CLOSE * CLOSE) * (d2 * way2)));
}

/* 0 to 1 as U does.  */
static BT__HOT bt__four
smooth (bt__four u)
{
  u = bt__four_min (bt__four_max (u, bt__four_all (0)), bt__four_all (1));
  return u * u * (3 - 2 * u);
}

/* The velocity deficit behind a cylinder in a current of SPEED, zero outside the LEE.  Only the
   component of the current across the axis makes a lee.  */
static BT__HOT bt__four
deficit (const place *at, bt__four_mask lee, double speed)
{
  bt__four across = bt__four_sqrt (bt__four_where (lee, at->across2)), plus, minus;
  bt__four by = 1 / bt__four_either (lee, across * at->d, bt__four_all (1));
  bt__four s = at->way * by, side2 = bt__four_max (at->side2 * by * by, bt__four_all (0));
  bt__four c2 = CLOSE / bt__four_max (s, bt__four_all (CLOSE));
  bt__four_exp (2 * bt__four_min (side2 * c2, bt__four_all (WITHIN)), &plus, &minus);
  bt__four fade = smooth (s + BEFORE) * (1 - smooth ((s - FADES) * (1 / (GONE - FADES))));
  bt__four ends = smooth (1 - bt__four_max (-at->along, at->past) * (across * by));
  return DEFICIT * bt__four_sqrt (c2) * fade * minus * ends * (across / speed);
}

static BT__WIDE double
share_at (const bt_wakes *wakes, size_t n, bt_vec3 ambient, bt_vec3 p)
{
  bt__four share = { 1, 1, 1, 1 };
  double speed = bt__norm (ambient);
  for (size_t i = 0; i < n; i += BT_WAKES_WIDE, wakes++)
    {
      place at = find_place (wakes, ambient, p);
      bt__four_mask lee = is_in_lee (&at, speed * speed);
      if (bt__four_which (lee))
        share *= 1 - deficit (&at, lee, speed);
    }
  return (share[0] * share[2]) * (share[1] * share[3]);
}

double
bt_wakes_share (const bt_wakes *wakes, size_t n, bt_vec3 ambient, bt_vec3 p)
{
  return share_at (wakes, n, ambient, p);
}

double
bt_wake_share (const bt_wake *wake, bt_vec3 ambient, bt_vec3 p)
{
  bt_wakes alone = { 0 };
  bt_wakes_put (&alone, 0, wake);
  return bt_wakes_share (&alone, 1, ambient, p);
}
