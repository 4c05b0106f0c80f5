/* Inside a step of the line among obstacles: shared by its files.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#ifndef BT_CONTACT_LINE_JOB_H
#define BT_CONTACT_LINE_JOB_H

#include "collide/cast.h"
#include "contact/line.h"
#include "tether/dynamic_contact.h"

enum
{
  BT__LINE_ROOM = 48,  /* parts near a link, if there are any */
  BT__LINE_ROUNDS = 4, /* times a step is solved again */
};

/* Two links that could meet in the step: I of this line and J of this or of another.  */
typedef struct bt__self_pair
{
  uint32_t i, j;
  int32_t strand; /* its number, or -1: J is of this line */
  double floor;   /* m: no nearer */
  bt__witness w;  /* of I against the axis of J, as the step starts */
  int touches;    /* of this line: the links are near each other, and not on a straight stretch */
} bt__self_pair;

/* Two links of the line that may come to touch before the next look.  */
typedef struct bt__self_known
{
  uint32_t i, j;
  double clear; /* m: more than a touch */
} bt__self_known;

/* What is known of a line and itself, see self_pairs.c.  */
typedef struct bt__self
{
  int pairs, knowns, most; /* there are, and may be of either */
  bt__self_pair *pair;     /* of this step */
  bt__self_known *known;   /* until the next look */
  size_t pair_room, known_room;
  double *move;             /* m: how far each node may go for PAIR to hold all */
  double *reach;            /* m: how far each link looks */
  bt__aabb *box, *its;      /* of links, of links of links: this line's, another's */
  bt__capsule *chord;       /* of links of links, see self_look.c */
  bt_vec3 *stood;           /* where the nodes were when it was looked ... */
  int still;                /* ... and had so many; 0: it was not */
  double turn, way;         /* m: KNOWN is of what parts by less, two in a row and any */
  double least, least_turn; /* m: no two links touch before two places, or two neighbouring nodes,
                               have moved apart by this */
  bt__dynamic_drift drift;  /* since then, as the step starts */
  int clear;                /* true: the spare of the line says that there is none of itself */
  int wait;                 /* steps until the next look */
} bt__self;

#define BT__LINE_SLIP 0.002 /* m: the drag at which friction is whole */
#define BT__LINE_SELF UINT32_MAX

/* What touches of obstacles and of lines have in common.  */
#define BT__LINE_AHEAD 1.2     /* of the last step's way: what is expected of this one */
#define BT__LINE_FORETOLD 0.2  /* m: a node that moves more in the step is not foretold */
#define BT__LINE_RECOVERY 0.2  /* m/s: a line that was pressed in is let out so fast */
#define BT__LINE_REMEMBER 0.75 /* of a link: the farthest a contact goes along it in a step */
#define BT__LINE_ALIKE_HIT 0.7 /* product of the normals: a hit is of the constraint there */
#define BT__LINE_SLIGHT 1.0    /* N: a line under less is slack, and a tension may change so */
#define BT__LINE_CREEP 0.02    /* m/s: how fast a taut line about a round member is drawn in */
#define BT__LINE_STIFFEST 1e9  /* N/m: of a contact, but for the load; of what holds an end */

/* A part of what stands, near a link: as in a bt__near.  */
typedef struct bt__candidate
{
  uint32_t object, slot;
} bt__candidate;

/* What is known of a link.  */
typedef struct bt__link_watch
{
  bt_vec3 a, b;   /* m: where it was when CLEAR was measured */
  double clear;   /* m to what stands, at least, then */
  double span;    /* m: the parts within, then, are candidates; negative: none were listed */
  uint32_t kept;  /* candidates */
  double reach;   /* m: whatever it can meet with its ends moving less than this is listed */
  uint32_t found; /* parts listed */
  uint32_t full;  /* true: REACH is so short because the list is full */
} bt__link_watch;

/* What a row of the equations is of.  */
typedef struct bt__line_row
{
  uint32_t link;
  uint32_t mover; /* number + 1, 0: what stands, BT__LINE_SELF: a line */
  uint32_t object, slot, triangle;
  int64_t id; /* of the obstacle */
  int flat;   /* the line lies along the plane there */
  int fresh;  /* the contact is new */
  int wedged; /* the link is between two obstacles */
  int again;  /* times it was hit although a row was there */
  double from_end;
  double other;    /* of a line: the same there */
  double distance; /* m: of the link from the obstacle, as the step starts */
  int64_t age;     /* steps so far */
  double work;     /* J so far */
  bt_vec3 point;   /* on the obstacle, at the end of the step */
} bt__line_row;

/* The parts near a link: such a list is made when anything comes near to the link.  */
typedef struct bt__link_list
{
  bt__near near[BT__LINE_ROOM];      /* as found in this step */
  bt__candidate kept[BT__LINE_ROOM]; /* among which later steps look */
} bt__link_list;

struct bt__line_work
{
  int n_max, rows_max;
  int lacks;                /* true: memory was out in this step, which is then not taken */
  uint64_t serial, version; /* of the scene and the switches CLEAR is of, ... */
  const uint8_t *off;       /* ... and their place */
  bt__safe *safe;           /* made when a move is cut, as is TO */
  bt_vec3 *to;
  bt__link_watch *watch;
  uint32_t room;        /* parts near a link */
  bt__link_list **list; /* of each link, or NULL */
  bt__constraint *row;
  bt__line_row *of; /* what ROW is of */
  bt__contact *old; /* anchors of the last step, then of this */
  size_t row_room, of_room, old_room, self_room;
  double *from_end; /* m of rest length from each node to node n */
  uint8_t *restart;
  bt__self self;
  double asked;                     /* m, see bt__line_work_asked */
  bt__dynamic_input in;             /* of a step in which ends are not where they are wanted */
  bt__dynamic_hold hold[2];         /* what holds them */
  bt__dynamic_bent bent[BT__BENTS]; /* nodes held at edges, ... */
  bt__contact bend[BT__BENTS];      /* ... what they are held at, ... */
  double gain[BT__BENTS][2];        /* m: gain of BEFORE and BEYOND in the step */
};

typedef struct bt__line_job
{
  bt__line_work *w;
  bt__dynamic *d;
  bt__dynamic_work *kernel;
  const bt__dynamic_input *in; /* as the kernel gets it */
  const bt__scene *scene;
  const bt__switches *on;
  bt__mover *mover;
  uint32_t movers;
  const bt__line_config *config;
  bt__contacts *anchors;
  int links, rows, olds, bents;
  int wedged;          /* of the link whose rows are made: see bt__line_is_wedged */
  double core, margin; /* m: a little more than asked for, for rounding; of what touches */
  double h;
  const bt_vec3 *x;        /* at the start */
  bt_vec3 *X;              /* proposed */
  bt__dynamic_watch watch; /* over a line that nothing touches */
  int plain;               /* true: no node is held at a round member */
  int unsolved;            /* true: what the step found is no solution, or not what was taken */
  bt__line_report *report;
  bt__count *count;
} bt__line_job;

/* ---- Room (line_work.c) ---- */

/* Make room for D beside the other lines of CONFIG; for N constraints, and for N contacts kept; for
   one more pair of links of either kind.  Return false when memory is out, which the workspace
   notes.  */
int bt__line_room (bt__line_work *w, const bt__dynamic *d, const bt__line_config *config);
int bt__line_row_room (bt__line_work *w, int n);
int bt__line_old_room (bt__line_work *w, int n);
int bt__self_pair_room (bt__line_work *w);
int bt__self_known_room (bt__line_work *w);

/* The list of LINK, made if there is none; what cuts moves, likewise.  NULL as above.  */
bt__link_list *bt__line_list (bt__line_work *w, uint32_t link);
bt__safe *bt__line_safe (bt__line_work *w);

/* True if there may be another constraint, and is room for it.  */
static inline int
bt__line_takes_row (bt__line_job *k)
{
  return k->rows < k->w->rows_max && bt__line_row_room (k->w, k->rows + 1);
}

/* Measure how far the nodes of the line are from its end: FROM_END of the workspace.  */
void bt__line_measure (const bt__line_job *k);

/* ---- Its ends (line_ends.c) ---- */

/* Say where the ends are wanted; a place that is not finite means stay.  */
void bt__line_aim_ends (bt__line_job *k);

/* Let the prescribed ends be pulled, by no more than may pull them; return true if there are such
   ends.  Then start the proposal: an end held back from its own place, any other from its target.
 */
int bt__line_hold_ends (bt__line_job *k);
void bt__line_start_ends (bt__line_job *k);

/* Prescribe anew the ends that bt__line_hold_ends let be pulled.  */
void bt__line_let_go (bt__line_job *k);

/* True if an end slipped in the step before; true if an end that is held slips in the proposal.  */
int bt__line_slipped (const bt__line_job *k);
int bt__line_slips (const bt__line_job *k);

/* True if the line of the proposal pulls harder than an end that slips may be pulled.  */
int bt__line_is_overpulled (const bt__line_job *k);

/* Report where the ends are, INPUT being the caller's.  */
void bt__line_tell_ends (bt__line_job *k, const bt__dynamic_input *input);

/* ---- What is near (line_near.c) ---- */

/* List what every link could meet; return true if anything is so near that it matters.  */
int bt__line_watch (bt__line_job *k);

/* True if the whole line is far from all standing obstacles: no link need be asked until a node has
   moved by *MAY.  */
int bt__line_is_far (bt__line_job *k, double *may);

/* After a step of a line not known to be far: note whether anything was NEAR.  */
void bt__line_note_near (bt__line_job *k, int near);

/* List more parts where the proposed move exceeds the listed reach; shorten moves where the lists
   are full.  */
void bt__line_watch_moves (bt__line_job *k);

/* What is listed of LINK; NULL: nothing was ever near to it.  */
static inline const bt__near *
bt__line_near (const bt__line_job *k, uint32_t link)
{
  const bt__link_list *list = k->w->list[link];
  return list ? list->near : NULL;
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

/* Add the constraint of a hit, or replace a like constraint: link J met NEAR after the share T of
   its move, with closest points W in the frame of NEAR.  Return the number of the constraint or -1.
 */
int bt__line_add_hit (bt__line_job *k, uint32_t j, const bt__near *near, const bt__witness *w,
                      double t);

/* ---- Between two obstacles (line_wedge.c) ---- */

/* True if two obstacles near link J push the link toward each other; SHARE is the limit of
   nearness, of the touching distance.  */
int bt__line_is_wedged (const bt__line_job *k, uint32_t j, double share);

/* Raise the stiffness of constraint I from a light touch to the stiffness at the present
   penetration.  */
void bt__line_press (const bt__line_job *k, int i);

/* ---- What the line runs about (line_bend.c) ---- */

/* Hold the sliding nodes of the last step where they still serve; call this before bt__line_rows.
 */
void bt__line_bends (bt__line_job *k);

/* Tell the solver the surplus of chords (line_round.c); bt__line_bends calls this function.  */
void bt__line_round (bt__line_job *k);

/* True if nodes are held at a round member that is not thin.  */
int bt__line_is_laid_round (const bt__line_job *k);

/* True if row Q says what a node that is held does.  */
int bt__line_is_bent_about (const bt__line_job *k, int q);

/* What is to be kept of the I-th node held.  */
bt__contact bt__line_bent_anchor (const bt__line_job *k, int i);

/* After the step (line_rebend.c): sliding nodes come and go; the line keeps its place except where
   a node is taken out.  */
void bt__line_rebend (bt__line_job *k);

/* ---- What sticks (line_anchor.c) ---- */

/* The coefficient of obstacle ID; the stiffness of a light touch at interval I, N/m.  */
double bt__line_friction (const bt__line_job *k, int64_t id);
double bt__line_stiffness (const bt__line_job *k, int64_t i);

/* Give the rows what is known from the last step: load, drag and work.  */
void bt__line_inherit (bt__line_job *k);

/* Give the rows that have none friction and stiffness.  */
void bt__line_harden (bt__line_job *k);

/* Gather what bears after the proposed move; then keep it for the next step.  */
void bt__line_keep (bt__line_job *k);
void bt__line_store (bt__line_job *k);

/* ---- The line and itself, and other lines ---- */

/* True if they touch at all.  */
static inline int
bt__self_counts (const bt__line_job *k)
{
  return k->config->itself || k->config->strands > 0;
}

/* Note that other lines would have counted within WAY more, of the place of the line after the
   move; see bt__line_work_came.  */
static inline void
bt__self_asks_more (const bt__line_job *k, double way)
{
  k->w->asked += way;
}

/* self_pairs.c: list the candidate pairs of the step, of the line with itself and with other lines;
   return true if a pair was listed.  The same for the proposed move, shortened if the list has no
   room for all pairs.  Keep the pairs for the next step.  */
int bt__self_watch (bt__line_job *k);
void bt__self_watch_moves (bt__line_job *k);
void bt__self_note (bt__line_job *k);

/* bt__self_is_far returns true if no pair can meet and lowers *MAY to the drift up to which this
   holds; bt__self_stays_far returns true if no pair can meet in the proposed move.  */
int bt__self_is_far (bt__line_job *k, bt__dynamic_drift *may);
int bt__self_stays_far (bt__line_job *k);

/* The way, m, that every node may go while the line stays clear of itself and of other lines,
   whatever their motion; at most a share of an interval.  */
double bt__self_spare (bt__line_job *k);

/* The second link of pair P, of the places X if it is of this line.  */
static inline bt__link
bt__self_second (const bt__line_job *k, const bt_vec3 *x, const bt__self_pair *p)
{
  return bt__link_of (p->strand < 0 ? x : bt__dynamic_x (k->config->strand[p->strand].line), p->j);
}

/* Metres of line between links I and J of the line, I before J. With STRAND not negative, between
   link I and link J of STRAND: by way of a common end of both lines, infinite without a common end.
 */
double bt__self_between (const bt__line_job *k, int strand, uint32_t i, uint32_t j);

/* The least distance that the same links must keep.  */
double bt__self_floor (const bt__line_job *k, int strand, uint32_t i, uint32_t j);

/* The same for links that start at DISTANCE.  */
double bt__self_lowered (double floor, double distance);

/* self_row.c: constraints of touching pairs; of a hit, of P at W after the share T; the contact of
   the last step for constraint I, or -1; the move of one place against the other in constraint R;
   the contact at the second place of constraint I, A being the first's.  */
void bt__self_rows (bt__line_job *k);
void bt__self_add_hit (bt__line_job *k, const bt__self_pair *p, const bt__witness *w, double t);
int bt__self_anchor (const bt__line_job *k, int i);
double bt__self_friction (const bt__line_job *k, int i);
double bt__self_stiffness (const bt__line_job *k, int i);
bt_vec3 bt__self_move (const bt__line_job *k, const bt__constraint *r);
bt__contact bt__self_reaction (const bt__line_job *k, const bt__contact *a);

/* self_guard.c: as bt__line_hits and bt__line_truncate for pairs; true if node I can go straight by
   MOVE, with all other nodes at rest, and meets no link.  */
int bt__self_hits (bt__line_job *k, int add);
void bt__self_truncate (bt__line_job *k);
int bt__self_may_move (bt__line_job *k, int64_t i, bt_vec3 move);

/* True if no link except the neighbours is nearer to link J than WAY more than the distance kept.
 */
int bt__self_is_clear (const bt__line_job *k, int64_t j, double way);

/* ---- What must not be hit (line_guard.c) ---- */

/* Make the proposal finite, and no node's move longer than MOST.  Return true if all of it was
   finite.  */
int bt__line_bound (bt__line_job *k, double most);

/* Cast every link along its proposed move.  Return the number that hit; with ADD rows are made.  */
int bt__line_hits (bt__line_job *k, int add);

/* Cut the proposal, node by node, to what is safe.  */
void bt__line_truncate (bt__line_job *k);

/* True if node 1 of P, nodes of the line, can go straight by MOVE, nodes 0 and 2 staying, and
   meets nothing.  */
int bt__line_may_move (bt__line_job *k, const bt_vec3 *p, bt_vec3 move);

/* As bt__dynamic_wind, for as many nodes as can come and go without the line passing through
   anything (line_winch.c).  */
void bt__line_wind (bt__line_job *k);

#endif
