/* Inside the response of the thesis: what one step knows, and what its files do for each other.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#ifndef BT_CONTACT_THESIS_JOB_H
#define BT_CONTACT_THESIS_JOB_H

#include "contact/thesis.h"
#include "math/vec.h"

/* What a collision is taken from: a link pressed so deep, a share of the radius.  */
#define BT__PRESSED 0.05

enum
{
  BT__REJOINED_MAX = 8
};

/* What was done to a split in this step.  */
enum
{
  BT__OLD = 0,
  BT__NEW,
  BT__PULLED_IN, /* made in this step, and its break point taken where the line is */
  BT__LEANT      /* moved to lean on another face */
};

/* A contact taken back in this step.  */
typedef struct bt__rejoined
{
  int64_t object;
  bt_vec3 contact;
  double angle;
} bt__rejoined;

typedef struct bt__thesis_job
{
  bt__thesis *state;
  bt__polyline *line;
  bt__span *span;
  const bt__thesis_input *in;
  const bt__way *way;
  bt__thesis_counts *counts;
  bt__thesis_report *report;
  bt_error *error;
  double radius;
  bt_vec3 a, b;           /* where the ends are to go */
  bt_vec3 goal_a, goal_b; /* where they were to go before an obstacle stopped them */
  int blocked;            /* they stay: an obstacle is in their way */
  int changed;            /* a span is not as it was */
  int rejoined;           /* contacts taken back in this step */
  bt__rejoined gone[BT__REJOINED_MAX];
} bt__thesis_job;

/* ---- thesis_spans.c: how the length is shared out, and the spans' shapes ---- */

/* Where span K starts and ends.  */
bt_vec3 bt__span_start (const bt__thesis_job *j, int64_t k);
bt_vec3 bt__span_stop (const bt__thesis_job *j, int64_t k);

/* Lay SPAN straight from A to B.  */
void bt__span_be_straight (bt__span *span, bt_vec3 a, bt_vec3 b);

/* Decide whether the tether sticks.  */
void bt__spans_stick (bt__thesis_job *j);

/* Share out the length, hold the ends at their spans' reach: fills A, B and what is out.  */
void bt__spans_share_out (bt__thesis_job *j);

/* Solve what changed.  */
bt_status bt__spans_solve (bt__thesis_job *j);

/* The angle that the solved spans make at the split after span K, on the obstacle's side.  */
double bt__spans_angle (const bt__thesis_job *j, int64_t k);

/* Count the step if a rubber band is shorter than its arc.  */
void bt__spans_count_cheats (bt__thesis_job *j);

/* ---- thesis_mesh.c: the polyline of the spans ---- */

/* Give every span nodes by its length, and the workspace the goals of the nodes.  */
void bt__thesis_aim (bt__thesis_job *j);

/* All arrived: let the spare nodes go.  */
void bt__thesis_tidy (bt__thesis_job *j);

/* The span that link I belongs to.  */
int64_t bt__thesis_span_of (const bt__thesis_job *j, int64_t link);

/* First and last node of span K.  */
int64_t bt__thesis_first (const bt__thesis_job *j, int64_t k);
int64_t bt__thesis_last (const bt__thesis_job *j, int64_t k);

/* ---- thesis_split.c ---- */

/* Split where HIT stopped the move; zero if that cannot be.  */
int bt__thesis_split (bt__thesis_job *j, const bt__hit *hit);

/* Measure the angles of the polyline at the splits; take back those that are open.  Return how
   many.  */
int bt__thesis_rejoin_open (bt__thesis_job *j);

/* Take back the splits of which the obstacle is no longer there.  */
void bt__thesis_drop_lost (bt__thesis_job *j);

/* ---- thesis_point.c ---- */

/* The angle of directions D and E away from a split, on the side away from NORMAL.  */
double bt__split_angle (bt_vec3 d, bt_vec3 e, bt_vec3 normal);

#endif
