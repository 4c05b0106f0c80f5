/* Can the vehicle be hauled home, and along which way does the vehicle get free by itself?

   The instant rule looks at the taut string alone.  Capstan friction seldom holds a tether.  Mostly
   the body of the dead vehicle stops a haul: hung on a thin member or an edge round which the
   string bends, or drawn into the corner between two obstacles beside the string.  The weight or
   buoyancy of the body adds to the pull, also beyond a member on which the body hangs.  The rule
   ignores slack, current, a body that rolls off sideways, and a body dragged over the bed.  A haul
   on a fork of the dive is the judge; the rule gives an answer at once.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#ifndef BT_AWARE_HAUL_H
#define BT_AWARE_HAUL_H

#include "aware/taut.h"

/* The dead vehicle and the winch.  */
typedef struct bt__haul_body
{
  double radius;       /* m, of a ball as large */
  double reach;        /* m, half its longest side, by which it hangs; if less than RADIUS: that */
  double friction;     /* of its body on obstacles; 0.4 caught most in trials */
  double weight;       /* N, in water; its size counts */
  double least;        /* N: what it takes to move it at the least speed that counts */
  double drag1, drag2; /* N s / m, N s^2 / m^2: what it takes at speed v is drag1 v + drag2 v^2 */
  double winch;        /* N: what the winch pulls */
  double grip;         /* of the angle: where so much of it holds, friction holds for sure */
} bt__haul_body;

typedef enum bt__answer
{
  BT__NO,
  BT__YES,
  BT__UNSURE
} bt__answer;

typedef enum bt__haul_reason
{
  BT__HAUL_CLEAR,  /* nothing is in the way; with BT__UNSURE: nothing that seems to hold */
  BT__HAUL_LOCKED, /* friction round OBJECT and others eats the winch's pull; BT__UNSURE: it just
                      does */
  BT__HAUL_HUNG,   /* the body hangs on OBJECT */
  BT__HAUL_WEDGED  /* the body does not go through at OBJECT */
} bt__haul_reason;

typedef struct bt__prospect
{
  bt__answer answer;
  bt__haul_reason reason;
  uint32_t object; /* its place in the scene; UINT32_MAX: none */
  double s;        /* m along the string, where */
  double lock;     /* product of exp (mu theta) */
  double pull;     /* N that reach the vehicle */
  double speed;    /* m/s it then comes home at if nothing hangs; 0 if not at all */
} bt__prospect;

/* Judge by the HOLDS of the string, its start at the winch.  */
bt__prospect bt__haul_prospect (const bt__holds *holds, const bt__haul_body *body);

/* A way for a body: the length of a string, its least clearance, and the nearest object.  The two
   ends, the body's place and goal, are left out of the clearance.  */
typedef struct bt__route
{
  double length, clearance; /* m */
  uint32_t object;          /* its place in the scene; UINT32_MAX: nothing near */
  double s;                 /* m along the way, of the link that is nearest */
} bt__route;

/* Put into HOME the way back along STRING, from end to start, pushed out to the distance WANT, m,
   from obstacles where there is room.  HOME has at least the room of STRING.  */
bt__route bt__way_home (bt__taut *taut, const bt__taut_config *config, const bt__string *string,
                        double want, bt__string *home, bt__count *count);

/* If PROSPECT is not bad already and the way home is narrower than the body, make it wedged.  */
void bt__haul_wedge (const bt__route *home, const bt__haul_body *body, bt__prospect *prospect);

/* Find crotches, unless PROSPECT is bad already.  A body is drawn in and wedged between two
   surfaces if STRING passes both within the body's radius and their outward normals are 60 degrees
   or more apart.  The start of STRING is left out: there the body is home.  */
void bt__haul_crotch (const bt__taut_config *config, const bt__string *string,
                      const bt__haul_body *body, bt__prospect *prospect, bt__count *count);

/* What flying a loop would do, by the string alone.  */
typedef struct bt__unwind
{
  int needed;     /* 0: the string's class is already that of the free way */
  int feasible;   /* flown to its end, never longer than paid out, free at the end, wide enough */
  bt__route way;  /* the loop */
  double longest; /* m: of the string on the way */
  double left;    /* m: of the string at the end */
} bt__unwind;

/* Put into LOOP what the vehicle must fly to free its tether: back along STRING to the start and
   out along FREE_WAY, which have the same ends, drawn tight together and pushed out to WANT.  Then
   lead a copy of STRING, COPY, along it: OUT is the length paid out, RADIUS the vehicle's.  All
   strings have the same room.  */
bt__unwind bt__unwind_plan (bt__taut *taut, const bt__taut_config *config, const bt__string *string,
                            const bt__string *free_way, double want, double out, double radius,
                            bt__string *loop, bt__string *copy, bt__count *count);

#endif
