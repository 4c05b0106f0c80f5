/* What fails, told as scenarios that `bight test' runs: the world, what is done in it, and the
   claim that fails.

   A dive is no bare line: it steps by 1/60 s, lays its line itself, and moves a vehicle without
   mass at its end.  What the language has no words for is said in the file, with the command that
   repeats the case exactly.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "math/vec.h"

#include "stability_tell.h"

enum
{
  NAME = 128
};

/* The scenario under way.  */
typedef struct tale
{
  FILE *port;
  const stability_log *l;
  long number;
  char name[NAME]; /* of the file, without its kind */
} tale;

/* ---- Words ---- */

/* X in the fewest digits that come back bit by bit; good until 16 more are asked for.  */
static const char *
number (double x)
{
  static char text[16][32];
  static int last;
  char *it = text[last++ % 16];
  for (int digits = 6; digits <= 17; digits++)
    {
      snprintf (it, sizeof *text, "%.*g", digits, x);
      if (strtod (it, NULL) == x)
        break;
    }
  return it;
}

static void
say_point (const tale *t, const char *before, bt_vec3 p, const char *after)
{
  fprintf (t->port, "%s%s %s %s%s", before, number (p.x), number (p.y), number (p.z), after);
}

/* A current of U: how fast, and toward which bearing, as (BEFORE speed toward).  */
static void
say_current (const tale *t, const char *before, bt_vec3 u)
{
  double toward = atan2 (u.x, u.y) * 180 / BT__PI;
  fprintf (t->port, "(%s %s %s)", before, number (hypot (u.x, u.y)),
           number (toward < 0 ? toward + 360 : toward));
}

static int
open_tale (tale *t, const stability_log *l, long number)
{
  *t = (tale){ .l = l, .number = number };
  snprintf (t->name, sizeof t->name, "%s-%ld-%ld", l->plan->family, l->plan->seed, number);
  t->port = stability_open (l, t->name, "scm");
  return t->port != NULL;
}

/* What it is, and how it is repeated exactly.  */
static void
say_head (const tale *t, const char *fault)
{
  const stability_plan *p = t->l->plan;
  fprintf (t->port, ";;; Case %ld of `bight bench stability --family %s --seed %ld': %s.\n",
           t->number, p->family, p->seed, fault);
  fprintf (t->port, ";;; Exactly: bight-bench-stability --family %s --seed %ld --case %ld",
           p->family, p->seed, t->number);
  if (p->tension > 0)
    fprintf (t->port, " --tension %ld", p->tension);
  fputs (p->mutant ? " --mutant\n" : "\n", t->port);
}

static void
close_tale (const tale *t)
{
  fclose (t->port);
  fprintf (stderr, "  told in %s/%s.scm\n", t->l->plan->folder, t->name);
}

static void
say_title (const tale *t, const char *fault)
{
  fprintf (t->port, "\n(define-scenario %s\n  \"%s\"\n", t->name, fault);
}

/* It has no words: REASON.  */
static void
give_up (const tale *t, const char *reason)
{
  fprintf (t->port, ";;; No scenario: %s.\n", reason);
  close_tale (t);
}

static void
say_line (const tale *t, const bt_tether_props *p, double length, int intervals)
{
  fprintf (t->port,
           "             (length %s) (nodes %d) (diameter %s) (mass %s)\n"
           "             (wet-weight %s) (ea %s) (ei %s) (ba %s) (cdn %s)\n"
           "             (cdt %s) (ca %s) (friction %s) (model dynamic)",
           number (length), intervals, number (p->diameter), number (p->mass),
           number (p->wet_weight), number (p->ea), number (p->ei), number (p->ba), number (p->cdn),
           number (p->cdt), number (p->ca), number (p->friction));
}

/* The line from the first to the last of the N corners X.  */
static void
say_ends (const tale *t, const bt_vec3 *x, int n)
{
  say_point (t, "    (rov (named minnow) (at ", x[n - 1], ") (pull 150))\n");
  say_point (t, "    (tether (named line) (from ", x[0], ") (to minnow)\n");
  for (int i = 1; i < n - 1; i++)
    say_point (t, i == 1 ? "             (via (" : " (", x[i], i == n - 2 ? "))\n" : ")");
}

/* ---- Claims ---- */

/* The claims that need words of their own; each is a procedure that is asked after every step.  */
static const char solved[]
    = "(define (solved-within seconds)\n"
      "  ;; Whether the line was solved to tolerance in one of so many seconds' steps.\n"
      "  (let ((since (now)) (before 0))\n"
      "    (lambda ()\n"
      "      (let ((unsolved (assq-ref (profile) 'chain-unconverged)))\n"
      "        (when (= unsolved before) (set! since (now)))\n"
      "        (set! before unsolved)\n"
      "        (<= (- (now) since) seconds)))))\n";
static const char slow[]
    = "(define (slower-than speed)\n"
      "  ;; Whether no point of the line went farther in a step than at SPEED m/s.\n"
      "  (let ((before (tether-points 101)))\n"
      "    (lambda ()\n"
      "      (let* ((here (tether-points 101)) (most 0))\n"
      "        (array-for-each (lambda (x y) (set! most (max most (abs (- x y))))) here before)\n"
      "        (set! before here)\n"
      "        (<= most (* speed (time-step)))))))\n";
static const char gone[] = "(define (go! p seconds)\n"
                           "  ;; Be at P after SECONDS.\n"
                           "  (move! p #:speed (max 1e-3 (/ (range-to p) seconds)))\n"
                           "  (run seconds))\n";

/* What is done is claimed not to draw the line tighter than LIMIT N, or it is claimed to be sound.
   FAULT is of a flight among obstacles.  */
static void
claim_flight (const tale *t, int fault)
{
  if (fault == FLIGHT_TIGHT)
    fprintf (t->port, "  (always (<= (max-tension) %ld)\n", t->l->plan->tension);
  else if (fault == FLIGHT_BLOWN)
    fprintf (t->port, "  (define slow? (slower-than %g))\n  (always (slow?)\n", FLIGHT_FASTEST);
  else if (fault == FLIGHT_UNRECOVERED)
    fputs ("  (define solved? (solved-within 3))\n  (always (solved?)\n", t->port);
  else
    fputs ("  (always-sound\n", t->port);
}

/* ---- Among obstacles ---- */

/* The triangles of obstacle O, as a file beside the scenario.  */
static void
write_mesh (const tale *t, const reef *r, int o)
{
  char name[NAME + 16];
  snprintf (name, sizeof name, "%s-%d", t->name, o);
  FILE *file = stability_open (t->l, name, "obj");
  int v = 0;
  for (int i = 0; file && i < r->sheets; i++)
    if (r->of_sheet[i] == o)
      {
        for (int k = 0; k < 3; k++)
          fprintf (file, "v %s %s %s\n", number (r->sheet[i].v[k].x), number (r->sheet[i].v[k].y),
                   number (r->sheet[i].v[k].z));
        fprintf (file, "f %d %d %d\n", v + 1, v + 2, v + 3);
        v += 3;
      }
  if (file)
    fclose (file);
  fprintf (t->port, "    (mesh (file \"%s.obj\"))\n", name);
}

static void
say_round (const tale *t, const char *head, bt_vec3 a, bt_vec3 b, double radius)
{
  fprintf (t->port, "    (%s", head);
  say_point (t, " (from ", a, ")");
  say_point (t, " (to ", b, ")");
  fprintf (t->port, " (radius %s))\n", number (radius));
}

static void
say_obstacle (const tale *t, const reef *r, int o)
{
  const bt__obstacle *it = r->obstacle + o;
  const bt__cylinder *c = &it->shape.cylinder;
  const bt__box *b = &it->shape.box;
  switch (it->kind)
    {
    case BT__OBSTACLE_PLANE:
      fputs ("    (seabed)\n", t->port);
      break;
    case BT__OBSTACLE_CAPSULE:
      say_round (t, "capsule", it->shape.capsule.a, it->shape.capsule.b, it->shape.capsule.radius);
      break;
    case BT__OBSTACLE_CYLINDER:
      say_round (t, "cylinder", bt__axpy (c->centre, -c->half, c->axis),
                 bt__axpy (c->centre, c->half, c->axis), c->radius);
      break;
    case BT__OBSTACLE_BOX:
      say_point (t, "    (box (at ", b->frame.origin, ")");
      say_point (t, " (size ", bt__scale (2, b->half), ")");
      fprintf (t->port, " (heading %s))\n",
               number (-atan2 (b->frame.x.y, b->frame.x.x) * 180 / BT__PI));
      break;
    default:
      write_mesh (t, r, o);
    }
}

/* The depth of the sea: where a plane is, or below everything.  */
static double
depth_of (const reef *r)
{
  double depth = 60;
  for (int o = 0; o < r->obstacles; o++)
    if (r->obstacle[o].kind == BT__OBSTACLE_PLANE)
      depth = -r->obstacle[o].shape.plane.offset;
  return depth;
}

static void
say_flight (const tale *t, const flight *f, const reef *r, int fault)
{
  bt_tether_props line = flight_line (f);
  say_title (t, flight_fault_names[fault]);
  fprintf (t->port, "  (in (world\n    (sea (depth %s) (gravity 9.81) ", number (depth_of (r)));
  say_current (t, "current", f->flow);
  fputs (")\n", t->port);
  for (int o = 0; o < r->obstacles; o++)
    say_obstacle (t, r, o);
  say_ends (t, f->shape, f->corners);
  say_line (t, &line, f->length, f->links);
  fputs (")))\n", t->port);
  claim_flight (t, fault);
  for (int k = 0; k < f->aims && f->aim[k].from < f->steps; k++)
    {
      int until = k + 1 < f->aims && f->aim[k + 1].from < f->steps ? f->aim[k + 1].from : f->steps;
      say_point (t, "    (move! (vec ", f->aim[k].at, ")");
      fprintf (t->port, " #:speed %s)\n    (run %d/60)%s\n", number (f->speed),
               until - f->aim[k].from, until == f->steps ? "))" : "");
    }
}

void
stability_tell_flight (const stability_log *l, const flight *f, long number, int fault)
{
  static reef r;
  tale t;
  if (!open_tale (&t, l, number))
    return;
  say_head (&t, flight_fault_names[fault]);
  if (f->kind == FLIGHT_HARM)
    {
      give_up (&t, "a million newtons, places that are no numbers and a solver that is overwritten "
                   "have no words");
      return;
    }
  if (f->body)
    fputs (";;; Its vehicle has 20 kg; here it has no mass, and goes where it is told.\n", t.port);
  if (fault == FLIGHT_UNRECOVERED || fault == FLIGHT_BLOWN)
    fprintf (t.port, "\n%s", fault == FLIGHT_BLOWN ? slow : solved);
  if (flight_scene (f, &r))
    say_flight (&t, f, &r, fault);
  reef_close (&r);
  close_tale (&t);
}

/* ---- The line by itself ---- */

#define DEPTH 500.0 /* m: of the anchor, in a sea twice as deep */

static bt_vec3
sunk (bt_vec3 p)
{
  p.z -= DEPTH;
  return p;
}

/* Why F has no words, or NULL.  */
static const char *
unspeakable (const campaign_flight *f, campaign_fault fault)
{
  return f->kind == CAMPAIGN_VACUO  ? "there is no dive without water"
         : f->free                  ? "its far end is free, and pushed by a given force"
         : fault == CAMPAIGN_UNLAID ? "there is no such line"
                                    : NULL;
}

static void
claim_line (const tale *t, campaign_fault fault, double driven)
{
  switch (fault)
    {
    case CAMPAIGN_TIGHT:
      fprintf (t->port, "  (always (<= (max-tension) %ld)\n", t->l->plan->tension);
      break;
    case CAMPAIGN_BLOWN:
      fprintf (t->port, "  (define slow? (slower-than %s))\n  (always (slow?)\n",
               number (20 * driven));
      break;
    case CAMPAIGN_UNRECOVERED:
      fputs ("  (define solved? (solved-within 3))\n  (always (solved?)\n", t->port);
      break;
    default:
      fputs ("  (always (all-finite?)\n", t->port);
    }
}

static void
say_moves (const tale *t, const campaign_flight *f, campaign_fault fault)
{
  bt_vec3 flow = { 0, 0, 0 };
  for (int i = 0; i < f->moves; i++)
    {
      const campaign_move *m = f->move + i;
      if (bt__distance (m->flow, flow) > 0)
        {
          fputs ("    ", t->port);
          say_current (t, "current!", m->flow);
          fputs ("\n", t->port);
        }
      flow = m->flow;
      say_point (t, "    (go! (vec ", sunk (m->at), ")");
      fprintf (t->port, " %s)\n", number (m->h));
    }
  fputs (fault == CAMPAIGN_UNRECOVERED ? "    (run 4)))\n" : "    (run 1/20)))\n", t->port);
}

static void
say_line_flight (const tale *t, const campaign_flight *f, campaign_fault fault, double driven)
{
  bt_vec3 corner[CAMPAIGN_CORNERS];
  for (int i = 0; i < f->corners; i++)
    corner[i] = sunk (f->shape[i]);
  say_title (t, campaign_fault_names[fault]);
  fprintf (t->port, "  (in (world\n    (sea (depth %g) (gravity 9.81))\n", 2 * DEPTH);
  say_ends (t, corner, f->corners);
  say_line (t, &f->line, f->length, f->nodes - 1);
  fputs (")))\n", t->port);
  claim_line (t, fault, driven);
  say_moves (t, f, fault);
}

void
stability_tell_line (const stability_log *l, const campaign_flight *f, double driven, long number,
                     campaign_fault fault)
{
  tale t;
  if (!open_tale (&t, l, number))
    return;
  say_head (&t, campaign_fault_names[fault]);
  const char *reason = unspeakable (f, fault);
  if (reason)
    {
      give_up (&t, reason);
      return;
    }
  fprintf (t.port, "\n%s%s",
           fault == CAMPAIGN_BLOWN         ? slow
           : fault == CAMPAIGN_UNRECOVERED ? solved
                                           : "",
           gone);
  say_line_flight (&t, f, fault, driven);
  close_tale (&t);
}
