/* Shared by the files that check and compile a world.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#ifndef BT_MODEL_COMPILE_H
#define BT_MODEL_COMPILE_H

#include "model/model.h"

/* Fill ERROR with INNER, about the part of kind HEAD called NAME ("": none).  */
bt_status bt__about (const char *head, const char *name, bt_error *error, const bt_error *inner);

/* Check every field that HEAD knows of DEF, the part called NAME.  Fields left to follow from
   others must be complete.  */
bt_status bt__check_def (const bt_head *head, const char *name, void *def, bt_error *error);

/* Complete DEF and make *TYPE and, for a vehicle with mass, *RIG.  The type of a vehicle without
   mass describes the dead vehicle as a body.  */
bt_status bt__compile_vehicle (bt_vehicle_def *def, double density, bt__vehicle_type *type,
                               bt__rig *rig, bt_error *error);

/* Where the tether of DEF is made fast when the dive begins, m.  */
bt_vec3 bt__attached_at (const bt_vehicle_def *def);

bt_status bt__check_name (const char *head, const char *name, bt_error *error);

/* Make the waves of MODEL, and find the obstacles of MODEL that cast a lee.  */
bt_status bt__compile_sea (bt_model *model, bt_error *error);

/* Continue the hash H with SEA.  */
uint64_t bt__hash_sea (const bt_sea_def *sea, uint64_t h);

/* ---- Obstacles ---- */

int bt__has_axis (const bt_obstacle_def *def);    /* from FROM to TO */
int bt__has_heading (const bt_obstacle_def *def); /* and pitch and roll */
int bt__is_carried (const bt_obstacle_def *def);

/* Check DEF, number I of a world in a sea of DEPTH, and draw it in *OUT: free that with
   bt__free_shape, or give it to a scene.  ASKER, or nobody, is asked whether to go on.  */
bt_status bt__draw_obstacle (bt_obstacle_def *def, int i, double depth, bt__asker *asker,
                             bt__obstacle *out, bt_error *error);
void bt__free_shape (bt__obstacle *shape);

/* Check the obstacles of WORLD and copy them into MODEL, whose sea is set.  A world without
   obstacles allocates nothing.  */
bt_status bt__compile_obstacles (bt_model *model, const bt_world *world, bt_error *error);

void bt__release_obstacles (bt_model *model);

/* Draw the hulls of the vehicles of MODEL that a tether may meet (hulls.c).  The ends of the
   tethers are known by now.  */
bt_status bt__compile_hulls (bt_model *model, bt_error *error);
void bt__release_hulls (bt_model *model);

/* Give every scene of MODEL a serial from its id.  */
void bt__number_scenes (bt_model *model);

/* Continue the hash H with the obstacles of WORLD.  */
uint64_t bt__hash_obstacles (const bt_world *world, uint64_t h);

/* Check that the anchors, the vehicles and the lines of lay of the tethers of MODEL are clear of
   the obstacles of MODEL.  */
bt_status bt__check_laying (const bt_model *model, bt_error *error);

#endif
