/* Controllers by SDL's joystick and game controller subsystems; see controller.h.

   SDL is used for its database: the axes and buttons of hundreds of devices under the names of one
   pad.  Without its video SDL needs no window.  SDL's handlers of signals are not installed, and the
   devices are read through the kernel's drivers alone, not through raw USB.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <config.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#define SDL_MAIN_HANDLED
#include <SDL.h>

#include "base/error.h"
#include "controller/controller.h"

enum
{
  DEVICES = 16,
  HATS = 4,
  WAITING = 8 /* events made of one of SDL's at most */
};

typedef struct device
{
  int used, id;
  SDL_GameController *pad; /* NULL: not in the database */
  SDL_Joystick *stick;
  Uint8 hat[HATS];
} device;

struct bt__controllers
{
  device device[DEVICES];
  bt__controller_event waiting[WAITING];
  int first, n; /* of what waits */
};

/* ---- Life ---- */

bt_status
bt__controllers_new (bt__controllers **all, bt_error *error)
{
  SDL_SetHint (SDL_HINT_NO_SIGNAL_HANDLERS, "1");
  SDL_SetHint (SDL_HINT_JOYSTICK_ALLOW_BACKGROUND_EVENTS, "1");
  SDL_SetHint (SDL_HINT_JOYSTICK_HIDAPI, "0");
  SDL_SetMainReady ();
  *all = NULL;
  if (SDL_InitSubSystem (SDL_INIT_GAMECONTROLLER) != 0)
    return bt__fail (error, BT_ERR_UNSUPPORTED, "SDL reads no controllers here: %s",
                     SDL_GetError ());
  *all = calloc (1, sizeof **all);
  if (*all)
    return BT_OK;
  SDL_QuitSubSystem (SDL_INIT_GAMECONTROLLER);
  return bt__fail (error, BT_ERR_LIMIT, "there is no memory left for controllers");
}

static void
close_device (device *d)
{
  if (d->used && d->pad)
    SDL_GameControllerClose (d->pad);
  else if (d->used)
    SDL_JoystickClose (d->stick);
  *d = (device){ 0 };
}

void
bt__controllers_free (bt__controllers *all)
{
  if (!all)
    return;
  for (int i = 0; i < DEVICES; i++)
    close_device (&all->device[i]);
  SDL_QuitSubSystem (SDL_INIT_GAMECONTROLLER);
  free (all);
}

/* ---- What happened ---- */

static bt__controller_event *
add_news (bt__controllers *all, bt__controller_what what, int id, const char *name)
{
  bt__controller_event *event = &all->waiting[all->n++];
  *event = (bt__controller_event){ .what = what, .id = id };
  snprintf (event->name, sizeof event->name, "%s", name ? name : "controller");
  return event;
}

static void
add_value (bt__controllers *all, bt__controller_what what, int id, const char *name, double value)
{
  add_news (all, what, id, name)->value = value;
}

static void
add_numbered (bt__controllers *all, bt__controller_what what, int id, const char *kind, int k,
              double value)
{
  char name[32];
  snprintf (name, sizeof name, "%s%d", kind, k);
  add_value (all, what, id, name, value);
}

static device *
device_of (bt__controllers *all, SDL_JoystickID id)
{
  for (int i = 0; i < DEVICES; i++)
    if (all->device[i].used && all->device[i].id == (int)id)
      return &all->device[i];
  return NULL;
}

static device *
free_device (bt__controllers *all)
{
  for (int i = 0; i < DEVICES; i++)
    if (!all->device[i].used)
      return &all->device[i];
  return NULL;
}

/* Open what SDL counts as number INDEX; a device that is open already, or that cannot be, is left.  */
static void
plug_in (bt__controllers *all, int index)
{
  device *d = free_device (all);
  int known = SDL_IsGameController (index) == SDL_TRUE;
  if (!d || device_of (all, SDL_JoystickGetDeviceInstanceID (index)))
    return;
  d->pad = known ? SDL_GameControllerOpen (index) : NULL;
  d->stick = d->pad ? SDL_GameControllerGetJoystick (d->pad) : SDL_JoystickOpen (index);
  if (!d->stick)
    return;
  d->used = 1;
  d->id = (int)SDL_JoystickInstanceID (d->stick);
  add_news (all, BT__CONTROLLER_PLUGGED, d->id, SDL_JoystickName (d->stick))->known = known;
}

static void
pull_out (bt__controllers *all, SDL_JoystickID id)
{
  device *d = device_of (all, id);
  if (!d)
    return;
  add_news (all, BT__CONTROLLER_LOST, d->id, SDL_JoystickName (d->stick));
  close_device (d);
}

static double
share (Sint16 value)
{
  return fmax (value / 32767.0, -1);
}

/* Each direction of a hat is a button.  */
static void
turn_hat (bt__controllers *all, device *d, int hat, Uint8 now)
{
  static const char *const ways[] = { "up", "right", "down", "left" };
  if (hat >= HATS)
    return;
  for (int i = 0; i < 4; i++)
    if ((now ^ d->hat[hat]) & (1 << i))
      {
        char name[32];
        snprintf (name, sizeof name, "hat%d%s", hat, ways[i]);
        add_value (all, BT__CONTROLLER_BUTTON, d->id, name, (now >> i) & 1);
      }
  d->hat[hat] = now;
}

/* An event of what is not in the database.  */
static void
note_stick (bt__controllers *all, const SDL_Event *e)
{
  device *d = device_of (all, e->jaxis.which);
  if (!d || d->pad)
    return;
  if (e->type == SDL_JOYAXISMOTION)
    add_numbered (all, BT__CONTROLLER_AXIS, d->id, "axis", e->jaxis.axis, share (e->jaxis.value));
  else if (e->type == SDL_JOYHATMOTION)
    turn_hat (all, d, e->jhat.hat, e->jhat.value);
  else
    add_numbered (all, BT__CONTROLLER_BUTTON, d->id, "button", e->jbutton.button, e->jbutton.state);
}

static void
note (bt__controllers *all, const SDL_Event *e)
{
  switch (e->type)
    {
    case SDL_JOYDEVICEADDED:
      plug_in (all, e->jdevice.which);
      break;
    case SDL_JOYDEVICEREMOVED:
      pull_out (all, e->jdevice.which);
      break;
    case SDL_CONTROLLERAXISMOTION:
      add_value (all, BT__CONTROLLER_AXIS, (int)e->caxis.which,
                 SDL_GameControllerGetStringForAxis ((SDL_GameControllerAxis)e->caxis.axis),
                 share (e->caxis.value));
      break;
    case SDL_CONTROLLERBUTTONDOWN:
    case SDL_CONTROLLERBUTTONUP:
      add_value (all, BT__CONTROLLER_BUTTON, (int)e->cbutton.which,
                 SDL_GameControllerGetStringForButton ((SDL_GameControllerButton)e->cbutton.button),
                 e->cbutton.state);
      break;
    case SDL_JOYAXISMOTION:
    case SDL_JOYHATMOTION:
    case SDL_JOYBUTTONDOWN:
    case SDL_JOYBUTTONUP:
      note_stick (all, e);
      break;
    default:
      break;
    }
}

/* SDL_PollEvent now and then finds nothing although there is something.  */
static int
take_event (SDL_Event *e)
{
  for (int pumped = 0; pumped < 2; pumped++)
    {
      if (SDL_PeepEvents (e, 1, SDL_GETEVENT, SDL_FIRSTEVENT, SDL_LASTEVENT) > 0)
        return 1;
      if (!pumped)
        SDL_PumpEvents ();
    }
  return 0;
}

int
bt__controllers_next (bt__controllers *all, bt__controller_event *event)
{
  SDL_Event e;
  while (all->first == all->n)
    {
      all->first = all->n = 0;
      if (!take_event (&e))
        return 0;
      note (all, &e);
    }
  *event = all->waiting[all->first++];
  return 1;
}
