/* See gallery.h.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "testbed/gallery.h"
#include "testbed/gallery_rows.h"
#include "testbed/scene.h"

static void
give_up (const char *what, const char *name)
{
  fprintf (stderr, "bight testbed: there is no %s called `%s'\n", what, name);
  exit (EXIT_FAILURE);
}

static void *
room_for (size_t n, size_t size)
{
  void *room = calloc (n > 0 ? n : 1, size);
  if (room)
    return room;
  fputs ("bight testbed: out of memory\n", stderr);
  exit (EXIT_FAILURE);
}

/* ---- Fields ---- */

/* The heights of a grid, NX, NY, X, Y, DX, DY before them.  */
static bt_heights
heights_of (const double *numbers)
{
  return (bt_heights){ .nx = (size_t)numbers[0],
                       .ny = (size_t)numbers[1],
                       .x = numbers[2],
                       .y = numbers[3],
                       .dx = numbers[4],
                       .dy = numbers[5],
                       .z = numbers + 6 };
}

/* Give FIELD of DEF the numbers of R.  */
static bt_status
set_numbers (const bt_field *field, void *def, const gallery_row *r, bt_error *error)
{
  const double *x = r->numbers;
  int count = (int)(r->n * r->width);
  bt_rows rows = { x, r->n, r->width };
  bt_heights heights;
  bt_current current;
  bt_wave_def waves;
  switch (field->kind)
    {
    case BT_FIELD_CURRENT:
      scene_must (bt_current_unpack (x, count, &current, error), error);
      return bt_def_set_current (field, def, &current, error);
    case BT_FIELD_WAVES:
      scene_must (bt_waves_unpack (x, count, &waves, error), error);
      return bt_def_set_waves (field, def, &waves, error);
    case BT_FIELD_GRID:
      heights = heights_of (x);
      return bt_def_set_grid (field, def, &heights, error);
    case BT_FIELD_POINT:
    case BT_FIELD_END:
      return bt_def_set_point (field, def, (bt_vec3){ x[0], x[1], x[2] }, error);
    case BT_FIELD_NUMBER:
    case BT_FIELD_COUNT:
    case BT_FIELD_WORD:
      return bt_def_set_number (field, def, x[0], error);
    default:
      return bt_def_set_rows (field, def, &rows, error);
    }
}

static void
set_field (const bt_head *head, void *def, const gallery_row *r)
{
  const bt_field *field = bt_field_find (head, r->name);
  bt_error error;
  if (!field)
    give_up ("field", r->name);
  scene_must (!r->word                      ? set_numbers (field, def, r, &error)
              : field->kind == BT_FIELD_END ? bt_def_set_part (field, def, r->word, &error)
                                            : bt_def_set_word (field, def, r->word, &error),
              &error);
}

/* ---- Parts ---- */

/* Return the struct of the next part of kind HEAD in W, and count the part.  */
static void *
next_part (gallery_world *w, const bt_head *head)
{
  if (strcmp (head->name, "sea") == 0)
    return &w->world.sea;
  if (strcmp (head->name, "rov") == 0)
    return w->vehicle + w->world.n_vehicles++;
  if (strcmp (head->name, "tether") == 0)
    return w->tether + w->world.n_tethers++;
  return w->obstacle + w->world.n_obstacles++;
}

/* Return the struct of the next thing of kind HEAD inside OUTER, and count the thing.  */
static void *
next_inside (void *outer, const bt_head *head)
{
  bt_vehicle_def *vehicle = outer;
  bt_tether_def *tether = outer;
  if (strcmp (head->name, "thruster") == 0)
    return vehicle->thrusters + (int)vehicle->n_thrusters++;
  if (strcmp (head->name, "set") == 0)
    return tether->sets + (int)tether->n_sets++;
  return tether->lumps + (int)tether->n_lumps++;
}

/* All parts but the sea begin with their name.  */
static void
name_part (const bt_head *head, void *def, const char *name)
{
  bt_error error;
  if (strcmp (head->name, "sea") != 0)
    scene_must (bt_def_set_name (def, name, &error), &error);
}

static void
read_rows (gallery_world *w, const gallery_table *t)
{
  const bt_head *head = NULL;
  void *part = NULL, *def = NULL;
  for (const gallery_row *r = t->rows; r < t->rows + t->n; r++)
    {
      if (!r->head)
        {
          set_field (head, def, r);
          continue;
        }
      head = bt_head_find (r->head);
      if (!head)
        give_up ("kind of part", r->head);
      def = r->name ? next_part (w, head) : next_inside (part, head);
      bt_def_init (head, def);
      if (!r->name)
        continue;
      part = def;
      name_part (head, def, r->name);
    }
}

/* ---- Worlds ---- */

const char *
gallery_name (int i)
{
  for (int k = 0; gallery_tables[k].world; k++)
    if (k == i)
      return gallery_tables[k].world;
  return NULL;
}

static const gallery_table *
table_called (const char *name)
{
  const gallery_table *t = gallery_tables;
  while (t->world && strcmp (t->world, name) != 0)
    t++;
  if (!t->world)
    give_up ("world", name);
  return t;
}

gallery_world *
gallery_open (const char *name)
{
  const gallery_table *t = table_called (name);
  gallery_world *w = room_for (1, sizeof *w);
  size_t parts = 0;
  for (size_t i = 0; i < t->n; i++)
    parts += t->rows[i].head && t->rows[i].name;
  w->world.vehicles = w->vehicle = room_for (parts, sizeof *w->vehicle);
  w->world.tethers = w->tether = room_for (parts, sizeof *w->tether);
  w->world.obstacles = w->obstacle = room_for (parts, sizeof *w->obstacle);
  bt_def_init (bt_head_find ("sea"), &w->world.sea);
  read_rows (w, t);
  return w;
}

void
gallery_close (gallery_world *w)
{
  free (w->vehicle);
  free (w->tether);
  free (w->obstacle);
  free (w);
}

bt_dive *
gallery_begin (const char *name)
{
  gallery_world *w = gallery_open (name);
  bt_dive *dive = scene_begin (&w->world);
  gallery_close (w);
  return dive;
}
