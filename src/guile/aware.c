/* What a tether is doing: lengths, turns, classes, hauling, ways, forecasts.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <bight/aware.h>
#include <math.h>

#include "guile/guile.h"

enum
{
  WAY_MOST = 8192,
  EVENTS_MOST = 256
};

/* ---- Numbers ---- */

static SCM
taut_length (SCM object, SCM index)
{
  double length;
  bt_error error;
  bt__check_long ("taut-length", bt__to_handle (object),
                  bt_tether_taut_length (bt__to_dive (object), scm_to_int (index), &length, &error),
                  &error);
  return scm_from_double (length);
}

static SCM
is_taut (SCM object, SCM index)
{
  int taut;
  bt_error error;
  bt__check_long ("taut?", bt__to_handle (object),
                  bt_tether_is_taut (bt__to_dive (object), scm_to_int (index), &taut, &error),
                  &error);
  return scm_from_bool (taut);
}

static SCM
free_length (SCM object, SCM index)
{
  double length;
  bt_error error;
  bt__check_long ("free-length", bt__to_handle (object),
                  bt_tether_free_length (bt__to_dive (object), scm_to_int (index), &length, &error),
                  &error);
  return scm_from_double (length);
}

static SCM
contact_length (SCM object, SCM index, SCM obstacle, SCM sliding)
{
  double length;
  bt_error error;
  bt__check_long ("contact-length", bt__to_handle (object),
                  bt_tether_contact_length (bt__to_dive (object), scm_to_int (index),
                                            scm_to_int (obstacle), scm_is_true (sliding), &length,
                                            &error),
                  &error);
  return scm_from_double (length);
}

static SCM
turns (SCM object, SCM index, SCM obstacle)
{
  double value;
  bt_error error;
  bt__check_long ("turns", bt__to_handle (object),
                  bt_tether_turns (bt__to_dive (object), scm_to_int (index), scm_to_int (obstacle),
                                   &value, &error),
                  &error);
  return scm_from_double (value);
}

static SCM
winding (SCM object, SCM index, SCM obstacle)
{
  int value;
  bt_error error;
  bt__check_long ("winding", bt__to_handle (object),
                  bt_tether_winding (bt__to_dive (object), scm_to_int (index),
                                     scm_to_int (obstacle), &value, &error),
                  &error);
  return scm_from_int (value);
}

/* ((NAME . WINDINGS) ...) of what it winds about; level ground is left out.  */
static SCM
windings (SCM object, SCM index)
{
  bt_dive *dive = bt__to_dive (object);
  SCM list = SCM_EOL;
  for (int k = bt_dive_count (dive, BT_PART_OBSTACLE); k-- > 0;)
    {
      int value;
      bt_error error;
      bt_status status = bt_tether_winding (dive, scm_to_int (index), k, &value, &error);
      bt__check_long ("windings", bt__to_handle (object),
                      status == BT_ERR_INTERRUPTED ? status : BT_OK, &error);
      if (status == BT_OK && value != 0)
        list = scm_acons (bt__obstacle_name (dive, k), scm_from_int (value), list);
    }
  return list;
}

static SCM
wrap_angle (SCM object, SCM index, SCM obstacle)
{
  double radians;
  bt_error error;
  bt__check_long ("wrap-angle", bt__to_handle (object),
                  bt_tether_wrap_angle (bt__to_dive (object), scm_to_int (index),
                                        scm_to_int (obstacle), &radians, &error),
                  &error);
  return scm_from_double (radians);
}

static SCM
capstan_lock (SCM object, SCM index)
{
  double lock;
  bt_error error;
  bt__check_long ("capstan-lock", bt__to_handle (object),
                  bt_tether_capstan_lock (bt__to_dive (object), scm_to_int (index), &lock, &error),
                  &error);
  return scm_from_double (lock);
}

/* ---- Classes, knots, fouling ---- */

/* #(world letters objects decided? lost?) */
static SCM
class_of (SCM object, SCM index)
{
  bt_dive *dive = bt__to_dive (object);
  bt_class *c = scm_gc_malloc_pointerless (sizeof *c, "class");
  bt_error error;
  SCM letters = SCM_EOL, objects = SCM_EOL;
  bt__check_long ("homotopy-class", bt__to_handle (object),
                  bt_tether_class (dive, scm_to_int (index), c, &error), &error);
  for (int k = c->letters; k-- > 0;)
    {
      letters = scm_cons (scm_from_int32 (c->letter[k]), letters);
      objects = scm_cons (bt__obstacle_name (dive, c->object[k]), objects);
    }
  return scm_vector (scm_list_5 (scm_from_uint64 (c->world), letters, objects,
                                 scm_from_bool (c->decided), scm_from_bool (c->lost)));
}

static SCM
is_knotted (SCM object, SCM index)
{
  int knotted;
  bt_error error;
  bt__check_long ("knotted?", bt__to_handle (object),
                  bt_tether_knotted (bt__to_dive (object), scm_to_int (index), &knotted, &error),
                  &error);
  return scm_from_bool (knotted);
}

static SCM
fouled (SCM object, SCM index)
{
  bt_foul foul;
  bt_error error;
  bt__check_long ("fouled?", bt__to_handle (object),
                  bt_tether_fouled (bt__to_dive (object), scm_to_int (index), &foul, &error),
                  &error);
  return foul == BT_FOUL_NOT ? SCM_BOOL_F
                             : scm_from_utf8_symbol (foul == BT_FOUL_WOUND ? "wound" : "hung");
}

/* ---- Hauling ---- */

/* #(answer reason object s pull speed) */
static SCM
prospect (SCM object, SCM index, SCM winch, SCM grip)
{
  static const char *const answers[] = { "no", "yes", "unsure" };
  static const char *const reasons[] = { "clear", "locked", "hung", "wedged" };
  bt_dive *dive = bt__to_dive (object);
  bt_prospect p;
  bt_error error;
  SCM v = scm_c_make_vector (6, SCM_BOOL_F);
  bt__check_long ("haul-prospect", bt__to_handle (object),
                  bt_tether_prospect_by (dive, scm_to_int (index), scm_to_double (winch),
                                         scm_to_double (grip), &p, &error),
                  &error);
  scm_c_vector_set_x (v, 0, scm_from_utf8_symbol (answers[p.answer]));
  scm_c_vector_set_x (v, 1, scm_from_utf8_symbol (reasons[p.reason]));
  scm_c_vector_set_x (v, 2, bt__obstacle_name (dive, p.object));
  scm_c_vector_set_x (v, 3, scm_from_double (p.s));
  scm_c_vector_set_x (v, 4, scm_from_double (p.pull));
  scm_c_vector_set_x (v, 5, scm_from_double (p.speed));
  return v;
}

/* #(home? seconds left object hull? at parted? pull) */
static SCM
haul (SCM object, SCM index, SCM rate, SCM winch, SCM seconds)
{
  bt_dive *dive = bt__to_dive (object);
  bt_haul h;
  bt_error error;
  SCM v = scm_c_make_vector (8, SCM_BOOL_F);
  bt__check_long ("free-to-haul?", bt__to_handle (object),
                  bt_tether_haul (dive, scm_to_int (index), scm_to_double (rate),
                                  scm_to_double (winch), scm_to_double (seconds), &h, &error),
                  &error);
  scm_c_vector_set_x (v, 0, scm_from_bool (h.home));
  scm_c_vector_set_x (v, 1, scm_from_double (h.seconds));
  scm_c_vector_set_x (v, 2, scm_from_double (h.left));
  scm_c_vector_set_x (v, 3, bt__obstacle_name (dive, h.object));
  scm_c_vector_set_x (v, 4, scm_from_bool (h.hull));
  scm_c_vector_set_x (v, 5, bt__from_point (h.at));
  scm_c_vector_set_x (v, 6, scm_from_bool (h.parted));
  scm_c_vector_set_x (v, 7, scm_from_double (h.pull));
  return v;
}

/* ---- Ways ---- */

/* #(points needed? feasible? length clearance obstacle longest left) */
static SCM
from_route (bt_dive *dive, const bt_route *r, const bt_vec3 *points, int n)
{
  SCM v = scm_c_make_vector (8, SCM_BOOL_F);
  if (n > 0)
    scm_c_vector_set_x (v, 0, bt__from_points (points, n));
  scm_c_vector_set_x (v, 1, scm_from_bool (r->needed));
  scm_c_vector_set_x (v, 2, scm_from_bool (r->feasible));
  scm_c_vector_set_x (v, 3, scm_from_double (r->length));
  scm_c_vector_set_x (v, 4, scm_from_double (r->clearance));
  scm_c_vector_set_x (v, 5, bt__obstacle_name (dive, r->obstacle));
  scm_c_vector_set_x (v, 6, scm_from_double (r->longest));
  scm_c_vector_set_x (v, 7, scm_from_double (r->left));
  return v;
}

static SCM
way_home (SCM object, SCM index)
{
  bt_dive *dive = bt__to_dive (object);
  bt_vec3 *points = scm_gc_malloc_pointerless (sizeof *points * WAY_MOST, "way");
  bt_route route;
  bt_error error;
  int n = 0;
  bt__check_long (
      "way-home", bt__to_handle (object),
      bt_tether_way_home (dive, scm_to_int (index), points, WAY_MOST, &n, &route, &error), &error);
  return from_route (dive, &route, points, n);
}

static SCM
leg (SCM object, SCM index, SCM from, SCM to)
{
  bt_dive *dive = bt__to_dive (object);
  bt_vec3 *points = scm_gc_malloc_pointerless (sizeof *points * WAY_MOST, "way"), end[2];
  bt_route route;
  bt_error error;
  int n = 0, starts = scm_is_true (from), ends = scm_is_true (to);
  if (starts)
    end[0] = bt__to_point ("plan-tour", from);
  if (ends)
    end[1] = bt__to_point ("plan-tour", to);
  bt__check_long ("plan-tour", bt__to_handle (object),
                  bt_tether_leg (dive, scm_to_int (index), starts ? end : NULL,
                                 ends ? end + 1 : NULL, points, WAY_MOST, &n, &route, &error),
                  &error);
  return from_route (dive, &route, points, n);
}

static SCM
unwind_plan (SCM object, SCM index)
{
  bt_dive *dive = bt__to_dive (object);
  bt_vec3 *points = scm_gc_malloc_pointerless (sizeof *points * WAY_MOST, "way");
  bt_route route;
  bt_error error;
  int n = 0;
  bt__check_long (
      "unwind-plan", bt__to_handle (object),
      bt_tether_unwind_plan (dive, scm_to_int (index), points, WAY_MOST, &n, &route, &error),
      &error);
  return from_route (dive, &route, points, n);
}

/* (LENGTH . POINTS), or what is in the way: a name, or #f.  */
static SCM
taut_to (SCM object, SCM index, SCM point)
{
  bt_dive *dive = bt__to_dive (object);
  bt_vec3 *points = scm_gc_malloc_pointerless (sizeof *points * WAY_MOST, "way");
  bt_error error;
  double length;
  int n, obstacle;
  bt_status status
      = bt_tether_taut_to (dive, scm_to_int (index), bt__to_point ("slack-to-reach", point), points,
                           WAY_MOST, &n, &length, &obstacle, &error);
  if (status == BT_ERR_UNSUPPORTED)
    return bt__obstacle_name (dive, obstacle);
  bt__check_long ("slack-to-reach", bt__to_handle (object), status, &error);
  return scm_cons (scm_from_double (length), bt__from_points (points, n));
}

/* ---- What is to come ---- */

/* Lists (KIND OBJECT SECONDS TURNS).  */
static SCM
foresee (SCM object, SCM index, SCM seconds)
{
  static const char *const kinds[] = { "touch", "turn", "taut", "bump" };
  bt_dive *dive = bt__to_dive (object);
  bt_foresight *f = scm_gc_malloc_pointerless (sizeof *f * EVENTS_MOST, "foresights");
  bt_error error;
  SCM list = SCM_EOL;
  int n = 0;
  bt__check_long ("foresee", bt__to_handle (object),
                  bt_tether_foresee (dive, scm_to_int (index), scm_to_double (seconds), f,
                                     EVENTS_MOST, &n, &error),
                  &error);
  while (n-- > 0)
    list = scm_cons (scm_list_4 (scm_from_utf8_symbol (kinds[f[n].kind - 1]),
                                 bt__obstacle_name (dive, f[n].object),
                                 scm_from_double (f[n].seconds), scm_from_double (f[n].turns)),
                     list);
  return list;
}

/* (length nodes slipped?) */
static SCM
follow (SCM object, SCM index)
{
  bt_follow f;
  bt_error error;
  bt__check_long ("follow-string", bt__to_handle (object),
                  bt_tether_follow (bt__to_dive (object), scm_to_int (index), &f, &error), &error);
  return scm_list_3 (scm_from_double (f.length), scm_from_int (f.nodes), scm_from_bool (f.slipped));
}

void
bt__define_aware (void)
{
  static const bt__procedure table[] = {
    { "%taut-length", 2, 0, (scm_t_subr)taut_length,
      "Return the length of the taut string of the INDEX-th tether of DIVE, m." },
    { "%taut?", 2, 0, (scm_t_subr)is_taut,
      "Return #t if the INDEX-th tether of DIVE is pulled tight." },
    { "%free-length", 2, 0, (scm_t_subr)free_length,
      "Return the length of the shortest way known to the end of the INDEX-th tether of DIVE, m." },
    { "%contact-length", 4, 0, (scm_t_subr)contact_length,
      "Return how much of the INDEX-th tether of DIVE lies on OBSTACLE, -1 for all, m; only what "
      "slides if SLIDING." },
    { "%turns", 3, 0, (scm_t_subr)turns,
      "Return the turns of the INDEX-th tether of DIVE about OBSTACLE." },
    { "%winding", 3, 0, (scm_t_subr)winding,
      "Return how often the INDEX-th tether of DIVE and its chord wind about OBSTACLE." },
    { "%windings", 2, 0, (scm_t_subr)windings,
      "Return what the INDEX-th tether of DIVE winds about, an alist from name to windings." },
    { "%wrap-angle", 3, 0, (scm_t_subr)wrap_angle,
      "Return the radians by which the string of the INDEX-th tether bends at OBSTACLE, -1: all." },
    { "%capstan-lock", 2, 0, (scm_t_subr)capstan_lock,
      "Return the product of exp (mu theta) over what the string of the INDEX-th tether bends "
      "at." },
    { "%class", 2, 0, (scm_t_subr)class_of,
      "Return the class of the INDEX-th tether, a vector #(WORLD LETTERS OBJECTS DECIDED? "
      "LOST?)." },
    { "%knotted?", 2, 0, (scm_t_subr)is_knotted,
      "Return #t if the INDEX-th tether of DIVE is knotted." },
    { "%fouled", 2, 0, (scm_t_subr)fouled,
      "Return `wound' or `hung' if the INDEX-th tether of DIVE is fouled, else #f." },
    { "%haul-prospect", 4, 0, (scm_t_subr)prospect,
      "Return #(ANSWER REASON OBJECT S PULL SPEED) of hauling with WINCH newtons, where GRIP of "
      "the "
      "angle holds." },
    { "%haul", 5, 0, (scm_t_subr)haul,
      "Haul on a fork at RATE with WINCH newtons for SECONDS: #(HOME? SECONDS LEFT OBJECT HULL? "
      "AT PARTED? PULL)." },
    { "%way-home", 2, 0, (scm_t_subr)way_home,
      "Return #(POINTS NEEDED? FEASIBLE? LENGTH CLEARANCE OBSTACLE LONGEST LEFT) of the way "
      "home." },
    { "%unwind-plan", 2, 0, (scm_t_subr)unwind_plan,
      "Return the same of the loop that frees the INDEX-th tether of DIVE." },
    { "%leg", 4, 0, (scm_t_subr)leg,
      "Return as %way-home does the way of the vehicle of the INDEX-th tether from FROM to TO, "
      "points or #f, from free way to free way." },
    { "%taut-to", 3, 0, (scm_t_subr)taut_to,
      "Return (LENGTH . POINTS) of the string of the INDEX-th tether led straight to POINT; or "
      "what "
      "is in the way there, a name or #f." },
    { "%foresee", 3, 0, (scm_t_subr)foresee,
      "Return lists (KIND OBJECT SECONDS TURNS) of what the string will do within SECONDS." },
    { "%follow-string", 2, 0, (scm_t_subr)follow,
      "Return (LENGTH NODES SLIPPED?) of the string that is led from call to call." },
  };
  bt__define_procedures (table, sizeof table / sizeof *table);
}
