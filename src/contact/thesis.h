/* The collision response of the thesis (D. Manowitz, chapter 3) for the quasi-static models.

   A tether that meets an obstacle is split at break points fixed in space; between two break points
   lies a span, shaped by the tether's own model.  The rules are: the averaged collision point and
   the shift outward (3.4); the back-side rule and the immediate-collision rule (3.5.1); rejoining
   at rejoin-angle, sliding at constant total length with the longest span bent, sticking, and
   pay-out without effect while stuck (3.5.2).  The spans only give the goal of the tether: the
   polyline moves towards the goal by the safe step, and the polyline is the tether.

   Differences from the thesis: a span never becomes longer than its share of the length, so for the
   rubber band the vehicle is stopped first.  The turn of the normals is added up from contact to
   contact: a second turn counts.  Any number of links may collide in a step, one after another.
   The bend stays in its span until the span is split; in the thesis the bend jumps to the longest
   span.  A contact rejoined and met again in the same step needs 5 degrees more to rejoin.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#ifndef BT_CONTACT_THESIS_H
#define BT_CONTACT_THESIS_H

#include "contact/polyline.h"
#include "tether/shape.h"

enum
{
  BT__SPLITS_MAX = 128,
  BT__THESIS_LIST = 16 /* objects a report names */
};

/* Where the tether is split.  Flat, no padding, as all that follows.  */
typedef struct bt__split
{
  int64_t object, triangle; /* ids; triangle -1 but on a mesh */
  int64_t mover;            /* the mover's place plus 1; 0: it stands still */
  int64_t node;             /* of the polyline */
  bt_vec3 contact;          /* the averaged collision point */
  bt_vec3 normal;           /* unit, averaged, out of the obstacle */
  bt_vec3 point;            /* the break point: CONTACT moved out */
  double angle;             /* between the spans on the obstacle's side, radians */
  double kept;              /* it was rejoined at this angle and met again: more is asked; else 0 */
  int64_t fresh;            /* not 0: made or moved in this step */
} bt__split;

/* A span, and the split at its far end; the last has none.  */
typedef struct bt__span
{
  bt__shape shape;
  bt__shape_memory memory;
  double length;    /* m of arc */
  double pull;      /* N, as solved from */
  int64_t solved;   /* SHAPE is of these ends, length, pull and sea */
  int64_t rubber;   /* a rubber band by the back-side or immediate-collision rule */
  int64_t straight; /* a rubber band for any reason */
  bt__split end;
} bt__span;

typedef enum bt__stuck_why
{
  BT__STUCK_NOT = 0,
  BT__STUCK_NO_SLIDING, /* the property */
  BT__STUCK_ANGLE,
  BT__STUCK_COUNT,
  BT__STUCK_BOTH
} bt__stuck_why;

/* The head of the state: SPANS room follows the polyline.  */
typedef struct bt__thesis
{
  int64_t nodes;          /* intervals of the tether as a whole */
  int64_t spans;          /* splits + 1 */
  int64_t bent;           /* the span that is bent while the tether slides */
  int64_t stuck;          /* bt__stuck_why */
  int64_t taut;           /* its vehicle cannot go farther */
  int64_t held;           /* an obstacle stopped the last move */
  int64_t settled;        /* all spans are solved and the line is where they want it */
  uint64_t version;       /* of the switches, when the splits were last looked at */
  double length;          /* m: what is out */
  bt_vec3 wish_a, wish_b; /* of the last step */
  double wish_length;
} bt__thesis;

typedef struct bt__thesis_rules
{
  double rejoin_angle; /* radians */
  double stick_angle;  /* radians of turn of the normals */
  double stick_count;  /* contacts; INFINITY: never */
  int stick_by;        /* bt_stick_by */
  int sliding;
  int no_back_side, no_immediate; /* leave a rule out: the thesis' failures */
} bt__thesis_rules;

/* The rules that PROPS asks for.  */
bt__thesis_rules bt__thesis_rules_of (const bt_tether_props *props);

typedef struct bt__thesis_input
{
  bt_vec3 a, b;  /* wanted */
  double length; /* paid out, m */
  double pull;   /* N: what the vehicle pulls with when the tether holds it */
  int stale;     /* props or sea changed since the last step, or the sea always does */
  const bt_tether_props *props; /* model: rubber-band, v-shape, catenary, catenary-simplex */
  const bt__thesis_rules *rules;
  const bt_water *water;
  bt__shape_tools *tools;
  bt__shape_counts *counts;
} bt__thesis_input;

/* What was done, added up over the steps; never reset.  */
typedef struct bt__thesis_counts
{
  uint64_t solves, skips; /* spans solved anew; spans that had not changed */
  uint64_t rounds;        /* moves tried */
  uint64_t splits, rejoins;
  uint64_t back_side, immediate; /* spans made rubber bands by the rules */
  uint64_t many_per_link;        /* a link met a second obstacle while one was being resolved */
  uint64_t length_cheats;        /* steps in which a rubber band was shorter than its arc */
  uint64_t refused; /* moves cut short though there was a split to make: no room, no length */
} bt__thesis_counts;

typedef struct bt__thesis_report
{
  bt_vec3 a, b;    /* where the ends really are */
  double length;   /* what is really out: more than wanted if the winch could not haul it in */
  int held;        /* an obstacle stopped the move */
  int taut;        /* the vehicle was stopped by the length */
  int moved;       /* anything at all was done */
  int64_t blocker; /* id of the obstacle that stopped it, or -1 */
  int touched_n, left_n, pinched_n;
  int64_t touched[BT__THESIS_LIST], left[BT__THESIS_LIST]; /* ids, in order */
  int64_t pinched[BT__THESIS_LIST];                        /* places of the movers */
} bt__thesis_report;

/* ---- The state ---- */

/* Nodes of the polyline of a tether of NODES intervals, at most.  */
static inline uint32_t
bt__thesis_room (uint32_t nodes)
{
  return nodes + 1 + 2 * BT__SPLITS_MAX;
}

/* Bytes of a state for NODES intervals; of STATE, what is live.  */
size_t bt__thesis_size (uint32_t nodes);
size_t bt__thesis_live (const bt__thesis *state);

bt__polyline *bt__thesis_line (const bt__thesis *state);
bt__span *bt__thesis_spans (const bt__thesis *state); /* state->spans of them */

/* Lay STATE, of bt__thesis_size bytes, along POINTS (clear of everything, the anchor first).
   BT_ERR_DOMAIN, BT_ERR_LIMIT as bt__polyline_lay.  The first step gives it its shape.  */
bt_status bt__thesis_lay (bt__thesis *state, uint32_t nodes, const bt_vec3 *points, uint32_t n,
                          double length, bt_error *error);

extern const bt__record bt__split_record, bt__span_record, bt__thesis_record;

/* Judge S, which was allotted bt__thesis_size (NODES) bytes and comes from outside.  */
bt_status bt__thesis_judge (bt__judge *judge, const bt__thesis *s, uint32_t nodes);

/* ---- The step ---- */

/* Bring STATE as near to INPUT as the obstacles let it.  On failure, which only the solving of a
   span can bring, STATE is half changed: the caller works on a copy.  */
bt_status bt__thesis_step (bt__thesis *state, const bt__thesis_input *input, const bt__way *way,
                           bt__thesis_counts *counts, bt__thesis_report *report, bt_error *error);

/* ---- Asking ---- */

/* At arc length S from the anchor, clamped; the largest.  */
double bt__thesis_tension (const bt__thesis *state, double s);
double bt__thesis_tension_max (const bt__thesis *state);

/* Fill TOUCH, of ROOM, with the splits from the anchor on; return how many there are.  */
int bt__thesis_touches (const bt__thesis *state, bt__touch *touch, int room);

/* One span as the thesis' view shows it.  */
typedef struct bt__segment
{
  int64_t model;   /* bt_model_kind: the tether's, or BT_MODEL_RUBBER_BAND */
  double from, to; /* arc lengths */
  bt_vec3 a, b;
} bt__segment;

/* Fill SEGMENT, of ROOM; MODEL is the tether's.  Return how many there are.  */
int bt__thesis_segments (const bt__thesis *state, int64_t model, bt__segment *segment, int room);

/* The contact point, normal and break point of equation 3.4, for LINK pressed DEPTH m into the
   part that NEAR names (of SCENE; frame and normal those of NEAR's witness), RADIUS the tether's.
   Exposed for the laws.  */
typedef struct bt__collision
{
  bt_vec3 contact, normal, point;
  int intersections;
} bt__collision;

void bt__collision_point (const bt__scene *scene, const bt__switches *on, const bt__link *link,
                          const bt__near *near, double depth, double radius, bt__near *parts,
                          bt__collision *out, bt__count *count);

/* True and *T if LINK meets TRIANGLE, at the share T (thesis 3.4, with the test of alpha and
   beta put right).  */
int bt__meets_triangle (const bt__link *link, const bt__triangle *triangle, double *t);

#endif
