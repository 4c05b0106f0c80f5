/* What a tether is doing: how tight, how wound, how free, and which way out.

   An answer depends on the present state alone: equal states give equal answers, whatever was asked
   before.  Nothing is computed unless asked, and several questions about one state share one taut
   string.  The tree of free ways and the table of words depend on the world alone; both are made at
   the first question and shared by forks.  Moving obstacles are left out of strings, ways, words
   and windings, because no line stays caught on a moving obstacle; turns about them are counted.

   In a world with level ground and no other obstacle the string is the straight line, and nothing
   is solved.  Every function gives BT_ERR_NAME for a part that does not exist and BT_ERR_LIMIT when
   memory runs out.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#ifndef BIGHT_AWARE_H
#define BIGHT_AWARE_H

#include <bight/dive.h>

BT_BEGIN_DECLS

/* ---- Lengths, m ---- */

/* Of the taut string: what tether I shrinks to through nothing, without friction.  */
bt_status bt_tether_taut_length (const bt_dive *dive, int i, double *length, bt_error *error);

/* Among obstacles a tether is taut if its slack, measured along the taut string, is less than this
   share of the paid-out length.  */
#define BT_TAUT_SLACK 0.01

/* Is tether I pulled tight?  Its model says so, as the event `taut' does: its chord is all that is
   out; or, where something stands, its taut string is, but for BT_TAUT_SLACK.  A forecast and the
   live view go by the same rule.  */
bt_status bt_tether_is_taut (const bt_dive *dive, int i, int *taut, bt_error *error);

/* Put the taut string itself into POINTS, at most MAX, from the anchor on; *N is how many there
 * are.
 */
bt_status bt_tether_taut_string (const bt_dive *dive, int i, bt_vec3 *points, int max, int *n,
                                 bt_error *error);

/* Length, m, of the shortest obstacle-free way known from the anchor of tether I to its far end; at
   most bt_tether_taut_length.  */
bt_status bt_tether_free_length (const bt_dive *dive, int i, double *length, bt_error *error);

/* Metres of tether I that lie on OBSTACLE, -1 for any, of both parts if the tether has parted; with
   SLIDING true only those that are dragged.  */
bt_status bt_tether_contact_length (const bt_dive *dive, int i, int obstacle, int sliding,
                                    double *length, bt_error *error);

/* ---- Turns ---- */

/* Signed turns of tether I about OBSTACLE, continuous; clockwise looking along its axis is positive
   (down, where it has none).  The axis has no ends.  BT_ERR_UNSUPPORTED for level ground, which has
   no axis.  */
bt_status bt_tether_turns (const bt_dive *dive, int i, int obstacle, double *turns,
                           bt_error *error);

/* Whole turns, with the sign of bt_tether_turns, by which tether I is caught about OBSTACLE.  The
   turns are those of the loop out along the taut string and home by the free way, as far as the
   loop cannot be drawn off the obstacle. 0 for every obstacle if the homotopy class is the free
   way's; 0 for an obstacle with an end in the water, since a line can be drawn off an end; 0 for a
   moving obstacle.  For members that meet in joints several answers stand for one class: the answer
   has the fewest turns, in a choice about members at which the string bends.  */
bt_status bt_tether_winding (const bt_dive *dive, int i, int obstacle, int *winding,
                             bt_error *error);

/* Radians by which the taut string bends at OBSTACLE, -1 for all; and the product of
   exp (mu theta) over all it bends at: the ratio of pulls that friction bears.  */
bt_status bt_tether_wrap_angle (const bt_dive *dive, int i, int obstacle, double *radians,
                                bt_error *error);
bt_status bt_tether_capstan_lock (const bt_dive *dive, int i, double *lock, bt_error *error);

/* ---- Classes ---- */

enum
{
  BT_CLASS_MAX = 1022
};

/* The homotopy class of a tether: the reduced word of its way and the free way back.  Without
   letters it can be drawn to the free way.  Classes of tethers with the same ends are equal when
   the tethers can be moved into each other.  Flat; zeros behind the letters.  */
typedef struct bt_class
{
  uint64_t world;  /* whose letters */
  int32_t letters; /* how many */
  int16_t decided; /* true: unequal words are unequal classes */
  int16_t lost;    /* true: it squeezes where it cannot be followed; equal to nothing */
  int32_t letter[BT_CLASS_MAX];
  int32_t object[BT_CLASS_MAX]; /* of each letter the obstacle it goes round, -1: not known */
} bt_class;

/* Write the homotopy class of tether I to *OUT.  */
bt_status bt_tether_class (const bt_dive *dive, int i, bt_class *out, bt_error *error);

/* True if A and B are equal and neither is lost.  */
int bt_class_equal (const bt_class *a, const bt_class *b);

/* Is the line itself knotted?  BT_ERR_UNSUPPORTED if it crosses itself too often to tell.  */
bt_status bt_tether_knotted (const bt_dive *dive, int i, int *knotted, bt_error *error);

/* ---- Fouled, hauled, freed ---- */

typedef enum bt_foul
{
  BT_FOUL_NOT = 0, /* its string exceeds the free way by no more than 1 m or 5 % */
  BT_FOUL_WOUND,   /* nothing but going back round frees it */
  BT_FOUL_HUNG     /* it may slip off, or be lifted off */
} bt_foul;

/* Write how tether I is fouled.  */
bt_status bt_tether_fouled (const bt_dive *dive, int i, bt_foul *foul, bt_error *error);

typedef enum bt_haul_answer
{
  BT_HAUL_NO = 0,
  BT_HAUL_YES,
  BT_HAUL_UNSURE
} bt_haul_answer;

typedef enum bt_haul_reason
{
  BT_HAUL_CLEAR = 0,
  BT_HAUL_LOCKED, /* friction round the object and others eats the winch's pull */
  BT_HAUL_HUNG,   /* the vehicle's body hangs on it */
  BT_HAUL_WEDGED  /* the body does not go through at it */
} bt_haul_reason;

/* Will the dead vehicle come home if tether I is hauled?  */
typedef struct bt_prospect
{
  bt_haul_answer answer;
  bt_haul_reason reason;
  int object;   /* the obstacle, or -1 */
  double s;     /* m along the string, where */
  double pull;  /* N that reach the vehicle */
  double speed; /* m/s at which it comes if nothing hangs */
} bt_prospect;

/* At once, by the string, for a winch that pulls with WINCH newtons.  */
bt_status bt_tether_prospect (const bt_dive *dive, int i, double winch, bt_prospect *out,
                              bt_error *error);

/* The share of the string's bending angle that is sure to hold by friction.  A hauled line loses
   its wrap from the far end on, where the vehicle follows the line round: less than the whole angle
   holds.  Three quarters was right in every haul tried with two turns round a pile; the value is
   measured, not derived, so bt_tether_prospect_by takes another.  */
#define BT_HAUL_GRIP 0.75

/* The same for another share GRIP, above 0 and at most 1: with less of it fewer answers are sure.
 */
bt_status bt_tether_prospect_by (const bt_dive *dive, int i, double winch, double grip,
                                 bt_prospect *out, bt_error *error);

/* By hauling on a fork with the moving line: the engine's own answer.  */
typedef struct bt_haul
{
  int home;       /* true: it came within reach of the anchor */
  double seconds; /* that it took, or until it was clear that it is stuck */
  double left;    /* m of tether still out */
  int object;     /* stuck: the obstacle at its hull or, failing that, at its tether; or -1 */
  int hull;       /* true: at its hull */
  int parted;     /* true: the tether parted, and the vehicle stays where it is */
  double pull;    /* N: at the winch in the end; stuck, what the line held against it */
  bt_vec3 at;     /* m: where the vehicle came to */
} bt_haul;

/* Haul at RATE m/s with no more than WINCH newtons, for at most SECONDS.  */
bt_status bt_tether_haul (const bt_dive *dive, int i, double rate, double winch, double seconds,
                          bt_haul *out, bt_error *error);

/* A way to fly.  */
typedef struct bt_route
{
  int needed;       /* zero: there is nothing to unwind, the way is empty */
  int feasible;     /* true: wide enough, never longer than what is out, free at its end */
  double length;    /* m */
  double clearance; /* m: how near it comes to OBSTACLE */
  int obstacle;     /* -1: to nothing */
  double longest;   /* m: of the string on the way */
  double left;      /* m: of the string at the end */
} bt_route;

/* Put up to MAX points into POINTS: the way home, the string of tether I retraced from vehicle to
   anchor; or the way to unwind, a loop from the vehicle back to the vehicle. *N receives the number
   of points.  BT_ERR_UNSUPPORTED when the tether has no vehicle at its far end.  */
bt_status bt_tether_way_home (const bt_dive *dive, int i, bt_vec3 *points, int max, int *n,
                              bt_route *out, bt_error *error);
bt_status bt_tether_unwind_plan (const bt_dive *dive, int i, bt_vec3 *points, int max, int *n,
                                 bt_route *out, bt_error *error);

/* Put up to MAX points into POINTS: the way from *FROM to *TO on which the vehicle of tether I
   takes the tether from the free way of *FROM to the free way of *TO.  The way leads back along the
   one and out along the other, drawn tight together and pushed out for the hull; whoever flies legs
   of this kind is wound about nothing at the end of each.  NULL for FROM: from where the vehicle
   is, with the taut string that the tether has; NULL for TO: to the anchor.  *N receives the number
   of points, 0 where no way is known to one of the two.  In OUT, feasible means wide enough for the
   hull, and never longer than what is out or, if the winch pays out, will be; BT_ERR_DOMAIN if a
   place is not finite, BT_ERR_UNSUPPORTED when the tether has parted, or has no vehicle at its far
   end.  */
bt_status bt_tether_leg (const bt_dive *dive, int i, const bt_vec3 *from, const bt_vec3 *to,
                         bt_vec3 *points, int max, int *n, bt_route *out, bt_error *error);

/* Put up to MAX points into POINTS: the taut string of tether I after a straight flight of its end
   to P. *N receives the number of points, *LENGTH the length, m.  BT_ERR_DOMAIN when P is not
   finite; BT_ERR_UNSUPPORTED when the straight way to P is not free, with the obstacle in the way,
   or -1, in *OBSTACLE.  */
bt_status bt_tether_taut_to (const bt_dive *dive, int i, bt_vec3 p, bt_vec3 *points, int max,
                             int *n, double *length, int *obstacle, bt_error *error);

/* ---- What is to come ---- */

typedef enum bt_foresight_kind
{
  BT_FORESEE_TOUCH = 1, /* the tether meets an obstacle */
  BT_FORESEE_TURN,      /* its turns about it pass the next half */
  BT_FORESEE_TAUT, /* no more than BT_TAUT_SLACK is slack: what is out then holds the vehicle */
  BT_FORESEE_BUMP  /* the vehicle meets it, and slides on */
} bt_foresight_kind;

typedef struct bt_foresight
{
  bt_foresight_kind kind;
  int object;     /* the obstacle, or -1 */
  double seconds; /* from now */
  double turns;   /* about it, then */
} bt_foresight;

/* Foretell tether I for SECONDS at the vehicle's present velocity: up to MAX events to OUT in the
   order of time, *N receives their number.  The forecast knows no forces, current or weight: the
   line trails behind the vehicle as a tractrix and touches obstacles, and the taut string tells
   turns and the end of slack.  */
bt_status bt_tether_foresee (const bt_dive *dive, int i, double seconds, bt_foresight *out, int max,
                             int *n, bt_error *error);

/* ---- For a live view ---- */

/* The string led on from one call to the next, a step or two apart.  Leading is cheap, but the
   result depends on the earlier calls; no answer above uses a led string.  */
typedef struct bt_follow
{
  double length;
  int nodes;
  int slipped; /* true: it slid off something that could not hold it */
} bt_follow;

/* Lead the string of tether I on to the present state, and write what it is like to *OUT.  */
bt_status bt_tether_follow (const bt_dive *dive, int i, bt_follow *out, bt_error *error);

BT_END_DECLS

#endif
