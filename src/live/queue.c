/* The queue of commands.

   A list in order of steps: whoever posts a command is in no hurry, whoever steps the dive looks at
   its first element alone.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <config.h>

#include <stdlib.h>
#include <string.h>

#include "live/live.h"

bt__command *
bt__command_new (int64_t step, bt_op op, int subject, const double *args, int n)
{
  size_t bytes = n > 0 && args ? sizeof *args * (size_t)n : 0;
  bt__command *command = malloc (sizeof *command + bytes);
  if (!command)
    return NULL;
  memset (command, 0, sizeof *command);
  command->step = step;
  command->op = op;
  command->subject = subject;
  command->n = n;
  if (bytes > 0)
    memcpy (command->args, args, bytes);
  return command;
}

void
bt__queue_put (bt__queue *queue, bt__command *command)
{
  bt__command **place = &queue->first;
  while (*place && (*place)->step <= command->step)
    place = &(*place)->next;
  command->next = *place;
  *place = command;
}

bt__command *
bt__queue_due (bt__queue *queue, int64_t step)
{
  bt__command *first = queue->first;
  if (!first || first->step > step)
    return NULL;
  queue->first = first->next;
  first->next = NULL;
  return first;
}

void
bt__queue_remove (bt__queue *queue, const bt__command *command)
{
  bt__command **place = &queue->first;
  while (*place && *place != command)
    place = &(*place)->next;
  if (*place)
    *place = command->next;
}

void
bt__queue_free (bt__queue *queue)
{
  while (queue->first)
    {
      bt__command *first = queue->first;
      queue->first = first->next;
      free (first);
    }
}
