/* The extension for game controllers: fills the module (bight cockpit sdl).

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <config.h>

#include "controller/controller.h"
#include "guile/guile.h"

static void
free_controllers (void *all)
{
  bt__controllers_free (all);
}

static SCM
open_controllers (void)
{
  bt__controllers *all = NULL;
  bt_error error;
  bt__check ("controller", bt__controllers_new (&all, &error), &error);
  return scm_from_pointer (all, free_controllers);
}

static SCM
next_event (SCM object)
{
  static const char *const what[] = { "plugged", "lost", "axis", "button" };
  bt__controller_event event;
  if (!bt__controllers_next (scm_to_pointer (object), &event))
    return SCM_BOOL_F;
  scm_remember_upto_here_1 (object);
  SCM kind = scm_from_utf8_symbol (what[event.what]), id = scm_from_int (event.id), value;
  if (event.what == BT__CONTROLLER_LOST)
    return scm_list_2 (kind, id);
  if (event.what == BT__CONTROLLER_AXIS)
    value = scm_from_double (event.value);
  else
    value = scm_from_bool (event.what == BT__CONTROLLER_PLUGGED ? event.known : event.value != 0);
  return scm_list_4 (kind, id, scm_from_latin1_string (event.name), value);
}

void bight_controller_init (void);

__attribute__ ((visibility ("default"))) void
bight_controller_init (void)
{
  static const bt__procedure table[] = {
    { "%open-controllers", 0, 0, (scm_t_subr)open_controllers,
      "Listen to the game controllers there are, until what is returned is gone." },
    { "%controller-event", 1, 0, (scm_t_subr)next_event,
      "Return the next thing that happened, or #f: (plugged ID NAME KNOWN), (lost ID), (axis ID "
      "NAME "
      "VALUE) or (button ID NAME DOWN)." },
  };
  bt__define_procedures (table, sizeof table / sizeof *table);
}
