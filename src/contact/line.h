/* The moving line among obstacles: it touches, sticks, slides and never passes through.

   A step is the moving line's own (tether/dynamic.h) with contacts in the equations, as line.c
   describes: from a clear start no link's axis comes nearer than the core to an obstacle, standing
   or moving, whatever the solver gave.

   What lasts from step to step is in the bt__dynamic and in the bt__contacts beside it: both flat,
   both copied with memcpy.  A workspace holds nothing that changes a result.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#ifndef BT_CONTACT_LINE_H
#define BT_CONTACT_LINE_H

#include <stddef.h>

#include "contact/touch.h"
#include "tether/dynamic.h"

/* ---- What lasts ---- */

/* A place of the line that touches an obstacle, or touched it in the last step.  */
typedef struct bt__contact
{
  int64_t object;   /* the obstacle's id */
  int64_t triangle; /* its id on a mesh, or -1 */
  int64_t mover;    /* the obstacle's place among the movers, -1: it stands, or as below */
  int64_t state;    /* bt__touch_state */
  double from_end;  /* m of rest length from node n: the winch does not change it */
  double load;      /* N along the normal */
  double work;      /* J of slip since the contact was made */
  double step_work; /* J of slip in the last step */
  double speed;     /* m/s of the line along the obstacle in the last step */
  bt_vec3 point;    /* m: on the obstacle */
  bt_vec3 normal;   /* unit, from the obstacle to the line */
  bt_vec3 force;    /* N on the line: load and friction */
  bt_vec3 stick;    /* m: how far the line is dragged from where it stuck */
  int64_t age;      /* steps since the contact was made */
  int64_t bent;     /* bt__bent_kind: a node about which the line runs is held there; then: */
  double drag;      /* m: STICK along the line, ... */
  double side;      /* ... and along the edge */
  double flow;      /* m/s of rest length that runs through, toward node n */
  double thick;     /* m: radius of the edge */
  double span;      /* m of the line that lie on it */
  bt_vec3 axis;     /* unit: of the edge */
  bt_vec3 held;     /* m: where the node was held, ... */
  double away;      /* ... from the middle of the edge, ... */
  bt_vec3 lag;      /* m: ... and what it had yet to go round */
  double before;    /* m: surplus of the chord before, 0 if both ends are held at the same member */
  double beyond;    /* m: surplus of the chord after, see line_round.c */
  bt_vec3 after;    /* unit, across AXIS: of the next interval, if its other end is held at the same
                       member; else 0 */
  int64_t unsolved; /* steps on end that were not solved */
  double other; /* MOVER is BT__CONTACT_LINE: m of rest length from the end of what it touches */
} bt__contact;

typedef enum bt__bent_kind
{
  BT__BENT_NOT = 0,
  BT__BENT_EDGE, /* at an edge */
  BT__BENT_ROUND /* at the side of a cylinder or a capsule */
} bt__bent_kind;

enum
{
  BT__CONTACT_LINE = -2 /* for a mover: OBJECT is a line, this one or another */
};

/* The head of a flat block; N anchors follow, in order from node 0 to node n.  */
typedef struct bt__contacts
{
  int64_t n, room;
} bt__contacts;

/* Return the bytes of a block with room for ROOM anchors, and of the part of ANCHORS in use.
   Room for four an interval is never too little; what finds no room is forgotten: it starts anew
   in the next step.  */
size_t bt__contacts_size (int room);
size_t bt__contacts_live (const bt__contacts *anchors);
void bt__contacts_init (bt__contacts *anchors, int room);
bt__contact *bt__contacts_at (const bt__contacts *anchors);

/* Put A where it belongs among the N contacts AT in the order of the line; there is room.  */
void bt__contacts_put (bt__contact *at, int64_t n, const bt__contact *a);

/* Line ID is cut: leave A the contacts between FROM and TO metres from the end of the line, and
   measure their places from FROM.  The line's contacts with itself start anew, for either side may
   now belong to another part.  */
void bt__contacts_cut (bt__contacts *a, double from, double to, int64_t id);

extern const bt__record bt__contact_record, bt__contacts_record;

/* Judge ANCHORS, which were allotted room for ROOM and come from outside.  */
bt_status bt__contacts_judge (bt__judge *judge, const bt__contacts *anchors, int room);

/* ---- A step ---- */

typedef struct bt__line_work bt__line_work;

/* What a line may meet; the later includes the earlier.  */
typedef enum bt__among
{
  BT__AMONG_ITSELF,
  BT__AMONG_LINES,
  BT__AMONG_OBSTACLES
} bt__among;

/* Return a workspace for lines of up to N_MAX intervals, with room for what lies AMONG them, or
   NULL when memory is out.  */
bt__line_work *bt__line_work_new (int n_max, bt__among among);
void bt__line_work_free (bt__line_work *work); /* NULL is nothing */

/* Forget what is known to be clear: another line, another scene of the same serial.  It costs time
   alone.  */
void bt__line_work_forget (bt__line_work *work);

/* Return within what distance of where it was, m, a line came, and asked for others, in all that
   was done with WORK since this was last called: farther off others may do as they like.  */
double bt__line_work_asked (bt__line_work *work);

/* Let the line have come, and asked, within WAY of where it was.  */
void bt__line_work_came (bt__line_work *work, double way);

/* For tests: what is done to the solver's result before it is checked, and what is left undone.  */
typedef struct bt__line_hook
{
  void (*spoil) (void *user, const bt_vec3 *from, bt_vec3 *to, int nodes); /* or NULL */
  void *user;
  /* shown the line's NODES after each part of a step: BY 0: after its move; 1 or -1: after node I
     was put in or taken out; or NULL */
  void (*see) (void *witness, int i, int by, const bt_vec3 *x, int nodes);
  void *witness;
  int no_contacts; /* the guard alone */
  int no_guard;    /* mutant: what the solver gives is taken */
  int no_rounds;   /* no second solve */
  int no_bends;    /* no node is held at an edge */
} bt__line_hook;

/* Another line, which stands while this one steps: as it is after its own step, or before it.  */
typedef struct bt__strand
{
  const bt__dynamic *line;
  const bt__contacts *anchors; /* of its last step, or NULL */
  const bt__aabb *box;         /* that its nodes are in, or NULL: it is looked for */
  int64_t id;                  /* as an object */
  double radius, core, friction;
  double inertia; /* kg/m: mass and added mass */
  int yields;     /* true: it has its step yet to come, and will give way */
  int shared[2];  /* for either end of the line that touches it: 0, or one more than the number of
                     this one's end that is made fast at the same place */
} bt__strand;

typedef struct bt__line_config
{
  double radius;       /* m: half the line's diameter */
  double core;         /* m: bt__core (diameter) */
  double friction;     /* Coulomb: the line's own, ... */
  const double *rough; /* ... and by obstacle id; NaN: the line's own.  NULL: the line's all over */
  int64_t obstacles;   /* entries of ROUGH */
  double pull[2];      /* N: what at most takes a prescribed end to its place when obstacles are
                          near; INFINITY: whatever it takes */
  int slips[2];        /* true: no more than that anywhere */
  int itself;          /* true: the line touches itself, ... */
  int64_t id;          /* ... as the object of this number, which it is to others too */
  const bt__strand *strand;  /* other lines that it touches, none of more intervals than the */
  int strands;               /* workspace has room for */
  const bt__line_hook *hook; /* NULL */
} bt__line_config;

/* Return how far each node of D may be from its place, m, for D to be clear of itself and of the
   lines of CONFIG, whatever these do; 0: D is not clear.  */
double bt__line_work_spare (bt__line_work *work, bt__dynamic *d, const bt__line_config *config);

typedef struct bt__line_report
{
  bt_vec3 end[2];   /* m: where the ends are now */
  int held[2];      /* true: a prescribed end is not where INPUT wanted it */
  int touches;      /* places that bear on an obstacle, ... */
  int bends;        /* ... and of these nodes held at an edge */
  int rows;         /* half-spaces in the equations */
  int rounds;       /* times the step was solved again for a hit */
  int vain;         /* linear solves of proposals given up for another way to hold the ends */
  int truncated;    /* nodes that go on without memory: all where the guard cut the move */
  int overlaps;     /* links nearer than the core at the start: nothing is promised for them */
  int overflows;    /* links with more near than there is room for */
  int pinched;      /* movers that were held back: bt__mover.done says how far they came */
  int pairs;        /* pairs of links, its own or another line's, that were measured, ... */
  int meets;        /* ... and of the touches those with a line */
  double load;      /* N: the largest along a normal */
  double speed;     /* m/s: the fastest slip along an obstacle, for the caller's sleep */
  double slip_work; /* J: of friction in this step */
} bt__line_report;

/* Step D by INPUT->h among AROUND.  As bt__dynamic_step, and the same to the last bit where nothing
   is near; but a place for an end that is not finite means stay, and a solution that is not finite
   is not taken: the line then stays where it is, REPORT->converged = 0.  The bodies of prescribed
   ends count when their pull is limited.  Every mover's DONE is set.  BT_ERR_DOMAIN (also for a
   radius or core that is not positive, a core above the radius) and BT_ERR_LIMIT leave D and
   ANCHORS as they were.

   The axes of two links that are no neighbours come no nearer than twice the core, and those of
   this line and another than the sum of both cores; less where so little line is between them that
   they are nearer by themselves, but never do they pass through each other.  */
bt_status bt__line_step (bt__dynamic *d, bt__dynamic_work *work, bt__line_work *contact_work,
                         const bt__dynamic_input *input, const bt__surroundings *around,
                         const bt__line_config *config, bt__contacts *anchors,
                         bt__dynamic_report *report, bt__line_report *contact_report,
                         bt__count *count, bt_error *error);

/* Return the point S metres along D, of RADIUS m, with CONTACTS: as bt__dynamic_point, but on the
   arc where the line bends about a round member (line_arc.c).  */
bt_vec3 bt__line_arc_point (const bt__dynamic *d, const bt__contacts *contacts, double radius,
                            double s);

/* Fill OUT, of ROOM, with what touches: the anchors that bear load, in order from node 0.  Return
   how many there are.  S is in metres along D, as bt__dynamic_point takes it.  */
int bt__line_touches (const bt__dynamic *d, const bt__contacts *anchors, bt__touch *out, int room);

#endif
