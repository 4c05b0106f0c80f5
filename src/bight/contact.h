/* What a dive tells of contact: where its tethers touch, the spans between the places of contact,
   and the distances of tethers and vehicles from obstacles.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#ifndef BIGHT_CONTACT_H
#define BIGHT_CONTACT_H

#include <bight/dive.h>

BT_BEGIN_DECLS

/* A place where a tether touches an obstacle.  */
typedef struct bt_contact
{
  int object; /* number of the obstacle; or of the tether, counted on after the obstacles; or of the
                 vehicle with the hull, counted on after obstacles and tethers */
  int64_t triangle; /* its id on a mesh, or -1 */
  int slides;       /* zero: it sticks */
  int tail;         /* true: of the far part of a parted tether */
  double s;         /* m of arc length from the anchor; of the far part counted on beyond the near
                       part, with the line that drifted off between both */
  bt_vec3 position; /* m, on the obstacle */
  bt_vec3 normal;   /* unit, from the obstacle to the tether */
  bt_vec3 force;    /* N, on the tether; zero of a static model */
} bt_contact;

/* Write up to MAX contacts of tether I to CONTACTS, of both parts if it has parted, from the anchor
   on, and return how many there are; -1 when there is no such tether.  */
int bt_tether_contacts (const bt_dive *dive, int i, bt_contact *contacts, int max);

/* A span between contacts, or between a contact and an end.  */
typedef struct bt_segment
{
  double model;    /* bt_model_kind: the tether's, or a rubber band by a rule of the thesis */
  double from, to; /* m of arc length from the anchor; of the far part counted on, as a contact's */
  bt_vec3 a, b;    /* its ends, m */
  int tail;        /* true: of the far part of a parted tether */
} bt_segment;

/* The same for the spans of tether I; one when it touches nothing, or one of either part.  */
int bt_tether_segments (const bt_dive *dive, int i, bt_segment *segments, int max);

/* Return in *SHARE the wear of the jacket of tether I by sliding: 0 as new, 1 worn through, more
   beyond.  bt_tether_wear tells the most worn spot, bt_tether_wear_at the spot S metres of arc
   length from the anchor.  Only the moving line wears.  BT_ERR_NAME; BT_ERR_DOMAIN if S lies
   outside the paid-out length.  */
bt_status bt_tether_wear (const bt_dive *dive, int i, double *share, bt_error *error);
bt_status bt_tether_wear_at (const bt_dive *dive, int i, double s, double *share, bt_error *error);

/* The nearest obstacle to something.  */
typedef struct bt_clearance
{
  double distance;  /* m from surface to surface, less than 0 where they overlap; INFINITY: nothing
                       is there */
  int object;       /* the obstacle's number, or -1 */
  double s;         /* m: where on the tether */
  bt_vec3 position; /* m: the nearest point of the obstacle */
} bt_clearance;

/* How near tether I comes to OBSTACLE, or with OBSTACLE -1 to any; or to the hull of a vehicle that
   the tether is not made fast to, numbered as in bt_contact.  Likewise vehicle I with its hull,
   farther than 1000 m not looked for.  Pairs that are switched off count too.  BT_ERR_NAME.
 */
bt_status bt_tether_clearance (const bt_dive *dive, int i, int obstacle, bt_clearance *clearance,
                               bt_error *error);
bt_status bt_vehicle_clearance (const bt_dive *dive, int i, int obstacle, bt_clearance *clearance,
                                bt_error *error);

/* How near the point P comes to anything that tether I can meet.  BT_ERR_NAME.  */
bt_status bt_point_clearance (const bt_dive *dive, int i, bt_vec3 p, bt_clearance *clearance,
                              bt_error *error);

/* True if the I-th vehicle or tether, by PART, met OBSTACLE in the last step.  */
int bt_dive_collided (const bt_dive *dive, bt_part part, int i, int obstacle);

BT_END_DECLS

#endif
