/* The resolved shape of one tether in space: solved once, then asked.

   The plane solutions of <bight/statics.h> are set into space here, after the thesis (2.2 to 2.4):
   the plane of the bend, the depth rule, the pieces.  A shape is flat plain data and every question
   is a pure read of it.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#ifndef BT_TETHER_SHAPE_H
#define BT_TETHER_SHAPE_H

#include <stdint.h>

#include <bight/statics.h>
#include <bight/tether.h>
#include <bight/water.h>

#include "base/record.h"

typedef enum bt__shape_form
{
  BT__FORM_STRAIGHT = 0,
  BT__FORM_V,
  BT__FORM_CATENARY,
  BT__FORM_ELASTIC,
  BT__FORM_NODES, /* positions and tension vectors in arrays beside the shape */
  BT__FORM_CHAIN, /* the moving line: a bt__dynamic beside the shape; not asked through this header
                   */
  BT__FORM_AFLOAT /* as NODES, laid on the water: no solver goes on from there */
} bt__shape_form;

/* True if FORM has arrays beside the shape.  */
static inline int
bt__has_nodes (int64_t form)
{
  return form == BT__FORM_NODES || form == BT__FORM_AFLOAT;
}

/* Flat; no padding.  Arc lengths run from the anchor A to the end B, unstretched.  */
typedef struct bt__shape
{
  int64_t form;        /* bt__shape_form */
  int64_t n;           /* NODES: intervals */
  bt_vec3 a, b;        /* the ends, m */
  double length;       /* m */
  bt_vec3 across;      /* unit, in the plane of the bend, across the load */
  bt_vec3 against;     /* unit, in the plane of the bend, against the load */
  bt_vec3 rise;        /* added per metre of arc length: the linear depth rule; else zero */
  double plane_length; /* arc length of the plane curve: LENGTH, less with the linear rule */
  double load;         /* N/m on the plane curve: |(q, w)| */
  double t1, t2;       /* N: constant tension (STRAIGHT, CATENARY: t1), of the two links (V) */
  bt_v_shape v;
  bt_catenary catenary;
  bt_elastic elastic; /* NODES, AFLOAT: its ea alone, which is that of the line */
} bt__shape;

/* What a shape is solved from.  */
typedef struct bt__shape_input
{
  bt_vec3 a, b;  /* anchor and vehicle's end; |b - a| may exceed the length: straight */
  double length; /* paid out, m */
  double pull;   /* N: what the vehicle pulls with while a taut tether holds it, else 0 */
  const bt_tether_props *props;
  const bt_water *water;
} bt__shape_input;

/* How the steady line pulls at one of its ends.  */
typedef struct bt__reaction
{
  int64_t at_b; /* true: at the end B; else at the anchor A */
  bt_vec3 pull; /* tension vector there, toward the other end, N; zero: not known */
  bt_vec3
      stiffness[3]; /* rows: how the pull changes as the other end moves, N/m; zero: not known */
} bt__reaction;

/* What is remembered from shape to shape; part of the state.  */
typedef struct bt__shape_memory
{
  bt_vec3 load_direction;     /* unit, of the last load there was; zero at first */
  bt_vec3 across;             /* last across axis: used when the chord runs along the load */
  double search_a, search_xs; /* last answer of the thesis' search; search_a = 0: none */
  bt__reaction reaction;      /* last one (steady) */
} bt__shape_memory;

extern const bt__record bt__shape_record, bt__shape_memory_record;

/* Judge relations between members of SHAPE, whose single members were judged by the tables, with
   room for ROOM intervals; judge the nodes and their tensions.  */
bt_status bt__shape_judge (bt__judge *judge, const bt__shape *shape, int64_t room);
bt_status bt__shape_judge_nodes (bt__judge *judge, const bt_vec3 *nodes, const bt_vec3 *tensions,
                                 int64_t room);

/* Workspaces a solve may use; each is NULL unless the scene has a tether that needs it.  */
typedef struct bt__shape_tools
{
  bt_search *search;
  bt_steady *steady;
} bt__shape_tools;

/* What a solve cost; added to, never reset.  */
typedef struct bt__shape_counts
{
  uint64_t solves, search_iterations, shots, marches, relaxations, unsettled;
} bt__shape_counts;

/* Solve INPUT into *SHAPE.  MEMORY is read and, on success, updated.  NODES and TENSIONS hold
   props->nodes + 1 vectors each and are used by the steady model alone: on entry the present shape
   (when shape->form is NODES), on success the new one.  On failure SHAPE, MEMORY and the arrays may
   be half written: the caller works on a copy.  */
bt_status bt__shape_solve (const bt__shape_input *input, bt__shape_tools *tools,
                           bt__shape_counts *counts, bt__shape *shape, bt__shape_memory *memory,
                           bt_vec3 *nodes, bt_vec3 *tensions, bt_error *error);

/* Point, unit tangent (anchor toward vehicle) and tension (N) at arc length S, clamped to the line.
   NODES and TENSIONS as filled by the solve.  At a kink (the V's bend) the tangent is that of the
   link toward the vehicle.  Between nodes the NODES form is cubic Hermite in the position,
   second-order accurate or better in tension.  */
bt_vec3 bt__shape_point (const bt__shape *shape, const bt_vec3 *nodes, const bt_vec3 *tensions,
                         double s);
bt_vec3 bt__shape_tangent (const bt__shape *shape, const bt_vec3 *nodes, const bt_vec3 *tensions,
                           double s);
double bt__shape_tension (const bt__shape *shape, const bt_vec3 *nodes, const bt_vec3 *tensions,
                          double s);

#endif
