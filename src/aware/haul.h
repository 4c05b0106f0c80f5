/* Can the vehicle be hauled home, and which way does it get free by itself?

   The instant rule looks at the taut string alone.  Capstan friction seldom holds a tether; what
   stops a haul is mostly the dead vehicle's body: hung on a thin member or an edge that the string
   bends round, or drawn into the corner between two things that the string passes.  The rule cannot
   see slack, current or a body that rolls off sideways.  A body's weight or buoyancy adds to the
   pull it takes, past what it hangs on too; that it may sink to the bed and drag is not looked at.
   A haul on a fork of the dive is the judge, this the answer at once.

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

/* A way for a body: a string, how near it comes to anything and to what, its two ends left out,
   where the body stands or is to come.  */
typedef struct bt__route
{
  double length, clearance; /* m */
  uint32_t object;          /* its place in the scene; UINT32_MAX: nothing near */
  double s;                 /* m along the way, of the link that is nearest */
} bt__route;

/* Put into HOME the way back along STRING, from its end to its start, pushed out to WANT (m) from
   obstacles where there is room.  HOME has at least the room of STRING.  */
bt__route bt__way_home (bt__taut *taut, const bt__taut_config *config, const bt__string *string,
                        double want, bt__string *home, bt__count *count);

/* If PROSPECT is not bad already and the way home is narrower than the body, make it wedged.  */
void bt__haul_wedge (const bt__route *home, const bt__haul_body *body, bt__prospect *prospect);

/* If PROSPECT is not bad already and STRING passes within the radius of the body two surfaces whose
   outward normals are 60 degrees or more apart, it is drawn in between them and wedged.  Not where
   the string begins: there it is home.  */
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
