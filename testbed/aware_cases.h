/* Scenes and lines for the laws and the bench of what a tether is doing: cases whose shortest line
   is known in closed form, and scenes drawn at random.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#ifndef BT_TESTBED_AWARE_CASES_H
#define BT_TESTBED_AWARE_CASES_H

#include "testbed/solids.h"
#include "aware/free.h"
#include "aware/word.h"

enum
{
  CASE_OBSTACLES = 1200,
  CASE_NODES = 1600
};

/* A scene being put together, then made.  */
typedef struct stage
{
  uint32_t n;
  bt__obstacle o[CASE_OBSTACLES];
  bt__scene *scene;
} stage;

void stage_clear (stage *g); /* frees the scene too */
void stage_capsule (stage *g, bt_vec3 a, bt_vec3 b, double radius);
void stage_cylinder (stage *g, bt_vec3 a, bt_vec3 b, double radius);
void stage_box (stage *g, bt_vec3 centre, bt_vec3 half);
void stage_sphere (stage *g, bt_vec3 centre, double radius);
int stage_make (stage *g); /* nonzero on success */

/* Standing piles in 36 x 28 m of water 20 m deep, from under the bed to above the surface.  */
void draw_piles (stage *g, dice *d, int n);

/* A jacket of square bays with an X on each side and horizontals round every level.  */
void draw_jacket (stage *g, dice *d, int bays);

/* Rings of 16 capsules about any axis.  */
void draw_rings (stage *g, dice *d, int n);

/* The K-th of six scenes of bars: six piles, one ring, three rings, jackets of 2, 4, 8 bays.  */
void draw_skeleton (stage *g, int k, dice *d);

/* Boxes on the bed and balls in the water.  */
void draw_boxes (stage *g, dice *d);

/* A line of straight legs clear of everything by CLEAR, from near the bed, in links of about
   MESH; its nodes.  */
uint32_t draw_line (const stage *g, dice *d, int legs, double clear, double mesh, bt_vec3 *p);

/* A point between the bed and the surface clear of everything by CLEAR.  */
bt_vec3 draw_point (const stage *g, dice *d, double clear);

/* The shortest of TRIES tightened random detours from A to B, each by up to three points near
   obstacles; INFINITY if no leg was clear.  S is used.  */
double best_detour (const stage *g, dice *d, bt__taut *taut, const bt__taut_config *config,
                    bt_vec3 a, bt_vec3 b, int tries, bt__string *s);

/* Put the polyline P of N points into links of about MESH, corners kept; at most CASE_NODES.  */
uint32_t refine (const bt_vec3 *p, uint32_t n, double mesh, bt_vec3 *out);

/* A line of up to LEGS legs from A to B, clear by CLEAR, put in links of about MESH.  */
uint32_t draw_between (const stage *g, dice *d, bt_vec3 a, bt_vec3 b, int legs, double clear,
                       double mesh, bt_vec3 *p);

/* Move node J (not an end) of the line P somewhere else at random, by up to SIZE, if both its links
   stay out of everything below the surface and sweep no member's axis; nonzero if it moved.  */
int move_node (const stage *g, dice *d, double size, bt_vec3 *p, uint32_t j);

/* ---- Ways and words: aware_ways.c ---- */

/* Return how near the polyline P of N points comes to anything, or CAP.  */
double way_clearance (const bt__taut_config *config, const bt_vec3 *p, uint32_t n, double cap,
                      bt__count *count);

/* Lay STRING along the way of TREE to TO from FROM, where the tree has grown from, and tighten it
   by up to STEPS.  Return the length of STRING, m, with arcs for corners at round members; INFINITY
   if there is no way.  */
double tight_free_length (bt__free *tree, bt_vec3 from, bt_vec3 to, uint32_t steps, bt__taut *taut,
                          const bt__taut_config *config, bt__string *string, bt__count *count);

/* Nonzero if the words are equal, and not lost.  */
int is_same_word (const bt__word *a, const bt__word *b);

/* ---- Knots and links ---- */

/* Three rings on a string: two linked, Borromean; a pipe knotted as a trefoil.  */
void draw_hopf (stage *g);
void draw_borromean (stage *g);
void draw_trefoil (stage *g);

/* ---- Exact cases ---- */

typedef enum exact_kind
{
  EXACT_PILE,
  EXACT_THIN_PILE,
  EXACT_BOX,
  EXACT_TWO_PILES,
  EXACT_WIRE,
  EXACT_SPHERE,
  EXACT_KINDS
} exact_kind;

extern const char *const exact_names[EXACT_KINDS];

/* Make case K at clearance CORE: its scene, a line to shrink in links of about the exact length
   over LINKS, and the exact length.  Return the line's nodes.  */
uint32_t exact_case (exact_kind k, double core, int links, stage *g, bt_vec3 *p, double *length);

#endif
