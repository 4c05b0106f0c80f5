/* The tables of the engine as Texinfo: its operations and its events, in their own words.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <stdio.h>

#include <bight/bight.h>

static const char *
subject_of (bt_part part)
{
  switch (part)
    {
    case BT_PART_VEHICLE:
      return "a vehicle";
    case BT_PART_TETHER:
      return "a tether";
    default:
      return "the sea, or a part it names";
    }
}

static void
print_operation (const bt_op_info *op)
{
  printf ("@item %s %s\n", op->name, op->args);
  printf ("On %s: %s.\n", subject_of (op->subject), op->text);
}

int
main (void)
{
  puts ("@c Made by tables.c from the engine's own tables.\n"
        "@node Operations and events\n@section Operations and events\n"
        "All that changes a dive besides time is one of these operations, which the verbs of the\n"
        "language make and @code{bt_dive_do} takes.\n@table @code");
  for (int i = 0; i < BT_OP_COUNT; i++)
    print_operation (bt_op_describe ((bt_op)i));
  puts ("@end table\n\nThe events, as @code{events} and @code{on} name them:\n@example");
  for (int i = BT_EVENT_TAUT; bt_event_name ((bt_event_kind)i); i++)
    printf ("%s%s", i == BT_EVENT_TAUT ? "" : " ", bt_event_name ((bt_event_kind)i));
  puts ("\n@end example");
  return ferror (stdout) || fflush (stdout) ? 1 : 0;
}
