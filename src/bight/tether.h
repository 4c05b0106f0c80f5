/* The properties of a tether and the models that can move it.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#ifndef BIGHT_TETHER_H
#define BIGHT_TETHER_H

#include <stdint.h>

#include <bight/decls.h>

BT_BEGIN_DECLS

typedef enum bt_model_kind
{
  BT_MODEL_RUBBER_BAND = 0,  /* straight line of any length up to the tether's */
  BT_MODEL_V_SHAPE,          /* thesis 2.2 */
  BT_MODEL_CATENARY,         /* thesis 2.3, by the closed equation */
  BT_MODEL_CATENARY_SIMPLEX, /* thesis 2.3, by the thesis' search */
  BT_MODEL_ELASTIC, /* stretching catenary under weight (Irvine 1981); ignores the current */
  BT_MODEL_STEADY,  /* equilibrium in any current with weight, drag and stretch */
  BT_MODEL_DYNAMIC, /* the moving line, with everything */
  BT_MODEL_AUTO     /* the moving line with as many nodes as its accuracy wants */
} bt_model_kind;

typedef enum bt_depth_rule
{
  BT_DEPTH_SAG = 0,      /* thesis 2.4.2 */
  BT_DEPTH_LINEAR,       /* depth proportional to arc length, length exact */
  BT_DEPTH_THESIS_LINEAR /* thesis 2.4.1; the V alone; does not keep the length */
} bt_depth_rule;

/* What a tether does where it meets an obstacle.  The model decides: the moving line responds
   physically, the thesis' models as the thesis has it (chapter 3), `elastic' and `steady' not at
   all: they are held.  A world may say which of the first two it means.  */
typedef enum bt_response
{
  BT_RESPONSE_PHYSICAL = 0,
  BT_RESPONSE_THESIS
} bt_response;

/* When it sticks, in the response of the thesis (3.5.2).  */
typedef enum bt_stick_by
{
  BT_STICK_BY_ANGLE = 0, /* the normals have turned by stick_angle from the first contact */
  BT_STICK_BY_COUNT,     /* there are stick_count contacts */
  BT_STICK_BY_EITHER,
  BT_STICK_BY_BOTH
} bt_stick_by;

/* The value of sag_buoyancy that means `from the real weight and the real drag'.  */
#define BT_SAG_AUTO 2.0

/* The value of winch_pull for 500 N or half the breaking load, whichever is less.  */
#define BT_WINCH_AUTO 0.0

/* The value of accuracy for 2 cm or 0.2 % of what is paid out, whichever is less.  */
#define BT_ACCURACY_AUTO 0.0

/* A natural curvature of a part of a tether: what a drum or a kink has left in it.  Sets that
   overlap add up.  */
typedef struct bt_set
{
  double at;        /* m of arc length from the anchor when the dive begins: its middle */
  double span;      /* m; INFINITY: all of the tether, and what is on the drum */
  double curvature; /* 1/m */
  double plane;     /* degrees: the side to which the line bends, counted about the line */
} bt_set;

/* Flat; no padding.  Counts and choices are doubles too, because one table of fields sets every
   member.  */
typedef struct bt_tether_props
{
  double diameter;             /* m */
  double mass;                 /* kg/m in air */
  double wet_weight;           /* N/m, sinking positive */
  double ea;                   /* N; INFINITY: inextensible */
  double ei;                   /* N m2 */
  double gj;                   /* N m2 */
  double ba;                   /* internal damping, N s */
  double bending_damping;      /* N m2 s: of a change of curvature */
  double ei_stuck;             /* N m2: while its layers stick to each other; 0: as EI */
  double slip_curvature;       /* 1/m: at which the layers of a straight line slip; 0: always */
  double cdn, cdt, ca;         /* drag on D, on pi D; added mass per displaced mass */
  double friction;             /* Coulomb */
  double breaking_load;        /* N */
  double min_bend_radius;      /* m */
  double wear_energy;          /* J of slip work per metre that wears the jacket through */
  double wear_limit;           /* share of the jacket at which it counts as worn */
  double nodes;                /* intervals of the models that have nodes */
  double model;                /* bt_model_kind */
  double depth_rule;           /* bt_depth_rule */
  double sag_buoyancy;         /* -1 sinks ... 1 floats, or BT_SAG_AUTO */
  double accuracy;             /* m: the error in position that nodes come and go for, or
                                  BT_ACCURACY_AUTO */
  double tension_accuracy;     /* the error in tension that steps are shortened for, as a share */
  double max_current;          /* m/s: the thesis' maximum allowed current */
  double thesis_length_factor; /* thesis 2.4.1 took 0.95 of the length in its ratio; 1 */
  double response;             /* bt_response */
  double rejoin_angle;         /* degrees: a contact opened so far is none */
  double stick_angle;          /* degrees */
  double stick_count;          /* INFINITY: never */
  double stick_by;             /* bt_stick_by */
  double sliding;              /* 0: it sticks wherever it touches */
  double winch_pull;           /* N: the most it is hauled with, or BT_WINCH_AUTO */
  double winch_brake;          /* N: what its winch holds while it does not haul; INFINITY: all */
  double winch_rate;           /* m/s: the fastest its winch turns */
  double winch_lag;            /* s: in which a moving line follows its winch */
} bt_tether_props;

BT_END_DECLS

#endif
