/* Game controllers and joysticks, by SDL: what is plugged in, and what is moved and pressed.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#ifndef BT_CONTROLLER_CONTROLLER_H
#define BT_CONTROLLER_CONTROLLER_H

#include <bight/status.h>

typedef enum bt__controller_what
{
  BT__CONTROLLER_PLUGGED = 0,
  BT__CONTROLLER_LOST,
  BT__CONTROLLER_AXIS,
  BT__CONTROLLER_BUTTON
} bt__controller_what;

enum
{
  BT__CONTROLLER_NAME = 96
};

typedef struct bt__controller_event
{
  bt__controller_what what;
  int id; /* of the controller; another one for each time it is plugged in */
  char name[BT__CONTROLLER_NAME]; /* of the controller, or of the axis or button */
  int known;                      /* plugged: its axes and buttons have SDL's names */
  double value;                   /* of an axis -1 to 1, of a button 0 or 1 */
} bt__controller_event;

typedef struct bt__controllers bt__controllers;

/* Begin to listen to all controllers there are.  A controller known to SDL's database has axes
   leftx, lefty, rightx, righty, lefttrigger, righttrigger and buttons a, b, x, y, leftshoulder,
   dpup and the like; an unknown one axis0, button0, hat0up and the like.  BT_ERR_UNSUPPORTED where
   SDL cannot.  */
bt_status bt__controllers_new (bt__controllers **all, bt_error *error);
void bt__controllers_free (bt__controllers *all);

/* Put the next thing that happened into EVENT; zero if nothing has since.  */
int bt__controllers_next (bt__controllers *all, bt__controller_event *event);

#endif
