/* Inside a step of the line among obstacles: what its files share.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#ifndef BT_CONTACT_LINE_JOB_H
#define BT_CONTACT_LINE_JOB_H

#include "collide/cast.h"
#include "contact/line.h"
#include "tether/dynamic_contact.h"

enum
{
  BT__LINE_ROOM = 48, /* parts near a link */
  BT__LINE_ROWS = 4,  /* half-spaces an interval, on average */
  BT__LINE_ROUNDS = 4 /* times a step is solved again */
};

#define BT__LINE_SLIP 0.002 /* m: the drag at which friction is whole */
#define BT__LINE_STRIDE 2.0 /* m: no node goes farther in a step in which anything is near */

/* What is known of a link.  */
typedef struct bt__link_watch
{
  bt_vec3 a, b;   /* m: where it was when CLEAR was measured */
  double clear;   /* m to what stands, at least, then */
  double reach;   /* m: whatever it can meet with its ends moving less than this is listed */
  uint32_t found; /* parts listed */
  uint32_t full;  /* nonzero: REACH is so short because the list is full */
} bt__link_watch;

/* What a row of the equations is of.  */
typedef struct bt__line_row
{
  uint32_t link;
  uint32_t mover; /* number + 1, 0: what stands */
  uint32_t object, slot, triangle;
  int64_t id; /* of the obstacle */
  int flat;   /* the line lies along the plane there */
  int fresh;  /* the contact is new */
  double from_end;
  int64_t age;   /* steps so far */
  double work;   /* J so far */
  bt_vec3 point; /* on the obstacle, at the end of the step */
} bt__line_row;

struct bt__line_work
{
  int n_max, rows_max;
  uint64_t serial, version; /* of the scene and the switches CLEAR is of, ... */
  const uint8_t *off;       /* ... and their place */
  bt__safe *safe;
  bt__link_watch *watch;
  bt__near *near; /* BT__LINE_ROOM a link */
  bt__dynamic_row *row;
  bt__line_row *of; /* what ROW is of */
  bt__anchor *old;  /* anchors of the last step, then of this */
  bt_vec3 *to;
  bt_vec3 *stood;   /* where the nodes were when ... */
  double spare;     /* ... the whole line was so clear of what stands, m ... */
  int still;        /* ... and had so many nodes */
  double *from_end; /* m of rest length from each node to node n */
  uint8_t *restart;
  bt__dynamic_bent bent[BT__BENTS]; /* nodes held at edges, ... */
  bt__anchor bend[BT__BENTS];       /* ... and what they are held at */
};

typedef struct bt__line_job
{
  bt__line_work *w;
  bt__dynamic *d;
  bt__dynamic_work *kernel;
  bt__dynamic_input in; /* as the kernel gets it */
  const bt__scene *scene;
  const bt__switches *on;
  bt__mover *mover;
  uint32_t movers;
  const bt__line_config *config;
  bt__anchors *anchors;
  int links, rows, olds, bents;
  double core, margin; /* m: a little more than asked for, for rounding; of what touches */
  double h;
  const bt_vec3 *x; /* at the start */
  bt_vec3 *X;       /* proposed */
  bt__dynamic_hold hold[2];
  bt__line_report *report;
  bt__count *count;
} bt__line_job;

/* ---- What is near (line_near.c) ---- */

/* List what every link could meet; return nonzero if anything is so near that it matters.  */
int bt__line_watch (bt__line_job *k);

/* Nonzero if the whole line is known to be so far from everything that no link need be asked; after
   the solution, if all of the proposed move is.  */
int bt__line_is_far (const bt__line_job *k);
int bt__line_stays_far (const bt__line_job *k);

/* List more where the proposal goes farther than was listed; shorten its moves where the lists are
   full.  */
void bt__line_watch_moves (bt__line_job *k);

static inline bt__near *
bt__line_near (const bt__line_job *k, uint32_t link)
{
  return k->w->near + (size_t)link * BT__LINE_ROOM;
}

static inline bt__link
bt__line_link (const bt_vec3 *x, uint32_t j)
{
  return (bt__link){ x[j], x[j + 1] };
}

/* The scene that NEAR is of, and its mover or NULL.  */
static inline bt__mover *
bt__line_mover (const bt__line_job *k, const bt__near *near)
{
  return near->link ? k->mover + near->link - 1 : NULL;
}

static inline const bt__scene *
bt__line_scene (const bt__line_job *k, const bt__near *near)
{
  return near->link ? k->mover[near->link - 1].body : k->scene;
}

/* ---- Rows (line_row.c) ---- */

/* Make the rows of what is touched.  */
void bt__line_rows (bt__line_job *k);

/* Add, or put in place of its like, the row of a hit: link J met NEAR after the share T of its move
   as W says, in the frame of what it met.  Return the row's number or -1.  */
int bt__line_add_hit (bt__line_job *k, uint32_t j, const bt__near *near, const bt__witness *w,
                      double t);

/* ---- Where the line runs about an edge (line_bend.c) ---- */

/* Hold the nodes at edges that were there in the last step and are still; before the rows.  */
void bt__line_bends (bt__line_job *k);

/* Nonzero if row Q says what a node held at an edge does.  */
int bt__line_is_bent_about (const bt__line_job *k, int q);

/* What is to be kept of the I-th node held at an edge.  */
bt__anchor bt__line_bent_anchor (const bt__line_job *k, int i);

/* After the step: nodes come and go where the line runs about edges, the line staying where it is
   but for those that are taken out.  */
void bt__line_rebend (bt__line_job *k);

/* ---- What sticks (line_anchor.c) ---- */

/* The coefficient of obstacle ID; the stiffness of a contact at node I that bears LOAD.  */
double bt__line_friction (const bt__line_job *k, int64_t id);
double bt__line_stiffness (const bt__line_job *k, int64_t i, double load);

/* Give the rows what is known from the last step: load, drag and work.  */
void bt__line_inherit (bt__line_job *k);

/* Give the rows that have none friction and stiffness.  */
void bt__line_harden (bt__line_job *k);

/* Gather what bears after the proposed move; then keep it for the next step.  */
void bt__line_keep (bt__line_job *k);
void bt__line_store (bt__line_job *k);

/* ---- What must not be hit (line_guard.c) ---- */

/* Make the proposal finite, and no node's move longer than MOST.  Return nonzero if all of it was
   finite.  */
int bt__line_bound (bt__line_job *k, double most);

/* Cast every link along its proposed move.  Return the number that hit; with ADD rows are made.  */
int bt__line_hits (bt__line_job *k, int add);

/* Shorten the whole proposal until it hits nothing; return the number of hits that are left.  */
int bt__line_shorten (bt__line_job *k);

/* Cut the proposal, node by node, to what is safe.  */
void bt__line_truncate (bt__line_job *k);

/* Nonzero if node 1 of P can go straight by MOVE, nodes 0 and 2 staying, and meets nothing.  */
int bt__line_may_move (bt__line_job *k, const bt_vec3 *p, bt_vec3 move);

/* Wind D, one interval at the most, if it passes through nothing on the way.  */
void bt__line_wind (bt__line_job *k);

#endif
