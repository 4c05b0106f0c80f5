/* Contact: what touches what, how near things are, which pairs count.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <bight/contact.h>
#include <math.h>

#include "guile/guile.h"

enum
{
  FEW = 16, /* held without room from the collector */
  MOST = 4096
};

/* #(object triangle position normal s force sliding? tail?) */
static SCM
from_contact (bt_dive *dive, const bt_contact *c)
{
  SCM v = scm_c_make_vector (8, SCM_BOOL_F);
  scm_c_vector_set_x (v, 0, bt__obstacle_name (dive, c->object));
  if (c->triangle >= 0)
    scm_c_vector_set_x (v, 1, scm_from_int64 (c->triangle));
  scm_c_vector_set_x (v, 2, bt__from_point (c->position));
  scm_c_vector_set_x (v, 3, bt__from_point (c->normal));
  scm_c_vector_set_x (v, 4, scm_from_double (c->s));
  scm_c_vector_set_x (v, 5, bt__from_point (c->force));
  scm_c_vector_set_x (v, 6, scm_from_bool (c->slides));
  scm_c_vector_set_x (v, 7, scm_from_bool (c->tail));
  return v;
}

static SCM
contacts (SCM object, SCM index)
{
  bt_dive *dive = bt__to_dive (object);
  bt_contact few[FEW], *contact = few;
  int n = bt_tether_contacts (dive, scm_to_int (index), few, FEW);
  if (n > FEW)
    {
      contact = scm_gc_malloc_pointerless (sizeof *contact * MOST, "contacts");
      n = bt_tether_contacts (dive, scm_to_int (index), contact, MOST);
    }
  SCM list = SCM_EOL;
  for (n = n < MOST ? n : MOST; n-- > 0;)
    list = scm_cons (from_contact (dive, &contact[n]), list);
  return list;
}

static SCM
model_name (double value)
{
  return bt__from_field (bt_field_find (bt_head_find ("tether"), "model"), value);
}

/* #(model from to a b tail?) */
static SCM
from_segment (const bt_segment *s)
{
  SCM v = scm_c_make_vector (6, SCM_BOOL_F);
  scm_c_vector_set_x (v, 0, model_name (s->model));
  scm_c_vector_set_x (v, 1, scm_from_double (s->from));
  scm_c_vector_set_x (v, 2, scm_from_double (s->to));
  scm_c_vector_set_x (v, 3, bt__from_point (s->a));
  scm_c_vector_set_x (v, 4, bt__from_point (s->b));
  scm_c_vector_set_x (v, 5, scm_from_bool (s->tail));
  return v;
}

static SCM
segments (SCM object, SCM index)
{
  bt_dive *dive = bt__to_dive (object);
  bt_segment few[FEW], *segment = few;
  int n = bt_tether_segments (dive, scm_to_int (index), few, FEW);
  if (n > FEW)
    {
      segment = scm_gc_malloc_pointerless (sizeof *segment * MOST, "segments");
      n = bt_tether_segments (dive, scm_to_int (index), segment, MOST);
    }
  SCM list = SCM_EOL;
  for (n = n < MOST ? n : MOST; n-- > 0;)
    list = scm_cons (from_segment (&segment[n]), list);
  return list;
}

/* (distance object s position), or #f when nothing is near.  */
/* At S metres from the anchor; #f: the most of any spot.  */
static SCM
wear (SCM object, SCM index, SCM s)
{
  bt_dive *dive = bt__to_dive (object);
  double share = 0;
  bt_error error;
  bt__check ("wear",
             scm_is_true (s)
                 ? bt_tether_wear_at (dive, scm_to_int (index), scm_to_double (s), &share, &error)
                 : bt_tether_wear (dive, scm_to_int (index), &share, &error),
             &error);
  return scm_from_double (share);
}

static SCM
from_clearance (bt_dive *dive, const bt_clearance *c)
{
  return c->object < 0
             ? SCM_BOOL_F
             : scm_list_4 (scm_from_double (c->distance), bt__obstacle_name (dive, c->object),
                           scm_from_double (c->s), bt__from_point (c->position));
}

static SCM
clearance (SCM object, SCM part, SCM index, SCM obstacle)
{
  bt_dive *dive = bt__to_dive (object);
  int vehicle = bt__to_part ("clearance", part) == BT_PART_VEHICLE;
  bt_clearance c;
  bt_error error;
  bt_status status
      = vehicle ? bt_vehicle_clearance (dive, scm_to_int (index), scm_to_int (obstacle), &c, &error)
                : bt_tether_clearance (dive, scm_to_int (index), scm_to_int (obstacle), &c, &error);
  bt__check ("clearance", status, &error);
  return from_clearance (dive, &c);
}

static SCM
point_clearance (SCM object, SCM index, SCM point)
{
  bt_dive *dive = bt__to_dive (object);
  bt_clearance c;
  bt_error error;
  bt__check (
      "clearance",
      bt_point_clearance (dive, scm_to_int (index), bt__to_point ("clearance", point), &c, &error),
      &error);
  return from_clearance (dive, &c);
}

static SCM
collided (SCM object, SCM part, SCM index, SCM obstacle)
{
  return scm_from_bool (bt_dive_collided (bt__to_dive (object), bt__to_part ("collided?", part),
                                          scm_to_int (index), scm_to_int (obstacle)));
}

void
bt__define_contacts (void)
{
  static const bt__procedure table[] = {
    { "%contacts", 2, 0, (scm_t_subr)contacts,
      "Return the contacts of the INDEX-th tether of DIVE, vectors #(OBJECT TRIANGLE POSITION "
      "NORMAL S FORCE SLIDING?)." },
    { "%segments", 2, 0, (scm_t_subr)segments,
      "Return the spans of the INDEX-th tether of DIVE, vectors #(MODEL FROM TO A B)." },
    { "%wear", 3, 0, (scm_t_subr)wear,
      "Return the share of the jacket of the INDEX-th tether of DIVE that is worn at arc length S; "
      "with S #f the largest." },
    { "%clearance", 4, 0, (scm_t_subr)clearance,
      "Return (METRES OBJECT S POSITION) of what is nearest to the INDEX-th PART of DIVE, or #f; "
      "OBSTACLE -1 stands for all." },
    { "%point-clearance", 3, 0, (scm_t_subr)point_clearance,
      "Return the same of the point P, among what the INDEX-th tether of DIVE can meet." },
    { "%collided?", 4, 0, (scm_t_subr)collided,
      "Return #t if the INDEX-th PART of DIVE met OBSTACLE in the last step." },
  };
  bt__define_procedures (table, sizeof table / sizeof *table);
}
