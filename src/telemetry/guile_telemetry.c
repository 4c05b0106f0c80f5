/* What (bight telemetry mavlink) asks: the frames among some bytes.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <config.h>

#include <math.h>
#include <string.h>

#include "guile/guile.h"
#include "telemetry/mavlink.h"

static const char *const kinds[] = { "short", "noise", "other", "wrong", "good" };

/* The fields of FOUND that say something, an alist.  */
static SCM
fields_of (const bt__mavlink_found *found)
{
  SCM list = SCM_EOL;
  for (int i = BT__MAVLINK_FIELDS; i-- > 0;)
    if (!isnan (found->value[i]))
      list = scm_acons (scm_from_utf8_symbol (found->message->field[i].name),
                        scm_from_double (found->value[i]), list);
  if (found->name[0])
    list = scm_acons (scm_from_utf8_symbol ("name"), scm_from_latin1_string (found->name), list);
  return list;
}

static SCM
next_frame (SCM bytes, SCM start, SCM end, SCM stamp)
{
  size_t n = SCM_BYTEVECTOR_LENGTH (bytes);
  size_t from = scm_to_unsigned_integer (start, 0, n), to = scm_to_unsigned_integer (end, from, n);
  size_t before = scm_to_unsigned_integer (stamp, 0, BT__MAVLINK_STAMP);
  bt__mavlink_found found;
  bt__mavlink_next ((const uint8_t *)SCM_BYTEVECTOR_CONTENTS (bytes) + from, to - from, before,
                    &found);
  scm_remember_upto_here_1 (bytes);
  SCM message = found.message ? scm_from_utf8_symbol (found.message->name) : SCM_BOOL_F;
  return scm_list_n (scm_from_utf8_symbol (kinds[found.kind]), scm_from_size_t (found.size),
                     message, scm_from_uint8 (found.system), scm_from_uint8 (found.component),
                     scm_from_uint8 (found.sequence), found.message ? fields_of (&found) : SCM_EOL,
                     SCM_UNDEFINED);
}

void bight_telemetry_init (void);

__attribute__ ((visibility ("default"))) void
bight_telemetry_init (void)
{
  static const bt__procedure table[] = {
    { "%mavlink-next", 4, 0, (scm_t_subr)next_frame,
      "Return what stands in BYTES from START to END, each frame after STAMP bytes of time: (KIND "
      "SIZE MESSAGE SYSTEM COMPONENT SEQUENCE FIELDS)." },
  };
  bt__define_procedures (table, sizeof table / sizeof *table);
}
