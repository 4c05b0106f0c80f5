/* The bare scene, and it with one part more: what the bench `skip' times and its test looks into.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#ifndef BT_TESTBED_SKIP_SCENES_H
#define BT_TESTBED_SKIP_SCENES_H

#include "testbed/parts.h"
#include "testbed/scene.h"

enum
{
  SKIP_NODES = 100,
  SKIP_CASES = 15
};

typedef struct skip_case
{
  const char *name;
  void (*draw) (scene *s);
  int flown;  /* vehicles that move */
  int parts;  /* what the scene has: an or of part */
  int asleep; /* nonzero: its last line goes to sleep before it is flown */
} skip_case;

/* The first is the bare one.  */
extern const skip_case skip_cases[SKIP_CASES];

/* Begin the dive of C: its lines that are to sleep asleep, and WARM steps flown.  */
bt_dive *skip_begin (const skip_case *c, int warm);

/* The work that DIVE, begun for C, has done so far for parts that C lacks.  A moving line is laid
   at rest by the static solver: look before and after.  */
uint64_t skip_stray_work (const bt_dive *dive, const skip_case *c);

#endif
