/* Shapes of obstacles between Scheme and C: rows of numbers, meshes and grids from files.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <math.h>
#include <stdlib.h>

#include "guile/guile.h"

/* ---- Files: what is read belongs to a Scheme object and is freed with it ---- */

static void
free_mesh (void *data)
{
  bt_mesh_data_free (data);
}

static void
free_heights (void *data)
{
  bt_heights_data_free (data);
}

static SCM
read_mesh (SCM file, SCM up)
{
  int y_up = scm_is_eq (up, scm_from_utf8_symbol ("y"));
  char *name = scm_to_locale_string (file);
  bt_mesh_data *data;
  bt_error error;
  bt_status status = bt_mesh_read (name, y_up ? BT_MESH_UP_Y : BT_MESH_UP_Z, &data, &error);
  free (name);
  bt__check ("enter!", status, &error);
  return scm_from_pointer (data, free_mesh);
}

static SCM
read_heights (SCM file)
{
  char *name = scm_to_locale_string (file);
  bt_heights_data *data;
  bt_error error;
  bt_status status = bt_heights_read (name, &data, &error);
  free (name);
  bt__check ("enter!", status, &error);
  return scm_from_pointer (data, free_heights);
}

static void
free_flow (void *data)
{
  bt_current_grid_free (data);
}

static SCM
read_current_grid (SCM file)
{
  char *name = scm_to_locale_string (file);
  bt_current_grid *grid;
  bt_error error;
  bt_status status = bt_current_grid_read (name, &grid, &error);
  free (name);
  bt__check ("enter!", status, &error);
  return scm_from_pointer (grid, free_flow);
}

/* ---- Fields ---- */

/* Arrays are made by the language, rank 2 and packed.  */
static bt_rows
to_rows (SCM array)
{
  scm_t_array_handle handle;
  bt_rows rows = { NULL, 0, 0 };
  scm_array_get_handle (array, &handle);
  if (scm_array_handle_rank (&handle) == 2)
    {
      const scm_t_array_dim *dims = scm_array_handle_dims (&handle);
      rows.n = (size_t)(dims[0].ubnd - dims[0].lbnd + 1);
      rows.width = (size_t)(dims[1].ubnd - dims[1].lbnd + 1);
      if (dims[1].inc == 1 && dims[0].inc == (ssize_t)rows.width)
        rows.at = scm_array_handle_f64_elements (&handle);
    }
  scm_array_handle_release (&handle);
  return rows;
}

static double
number_at (SCM vector, size_t i)
{
  return scm_to_double (scm_c_vector_ref (vector, i));
}

/* #(NX NY X Y DX DY HEIGHTS), HEIGHTS an f64vector.  */
static bt_heights
to_heights (SCM v)
{
  SCM z = scm_c_vector_ref (v, 6);
  bt_heights h = { .nx = scm_to_size_t (scm_c_vector_ref (v, 0)),
                   .ny = scm_to_size_t (scm_c_vector_ref (v, 1)),
                   .x = number_at (v, 2),
                   .y = number_at (v, 3),
                   .dx = number_at (v, 4),
                   .dy = number_at (v, 5) };
  if (h.ny > 0 && scm_c_array_length (z) / h.ny >= h.nx)
    h.z = (const double *)SCM_BYTEVECTOR_CONTENTS (z);
  return h;
}

int
bt__set_shape (const char *who, const bt_field *field, void *def, SCM value)
{
  bt_error error;
  bt_status status;
  if (field->kind == BT_FIELD_VIA || field->kind == BT_FIELD_POINTS || field->kind == BT_FIELD_TRACK
      || field->kind == BT_FIELD_SIX)
    {
      bt_rows rows = to_rows (value);
      status = bt_def_set_rows (field, def, &rows, &error);
    }
  else if (field->kind == BT_FIELD_MESH)
    {
      bt_mesh_data *data = scm_to_pointer (value);
      status = bt_def_set_mesh (field, def, &data->mesh, &error);
    }
  else if (field->kind == BT_FIELD_GRID)
    {
      bt_heights own = { 0 };
      const bt_heights *grid = &own;
      if (scm_is_vector (value))
        own = to_heights (value);
      else
        grid = &((bt_heights_data *)scm_to_pointer (value))->heights;
      status = bt_def_set_grid (field, def, grid, &error);
    }
  else
    return 0;
  bt__check (who, status, &error);
  return 1;
}

/* ---- Obstacles of a dive ---- */

static SCM
obstacle (SCM object, SCM index)
{
  bt_obstacle_view v;
  bt_error error;
  SCM list = SCM_EOL;
  bt__check ("describe", bt_dive_obstacle (bt__to_dive (object), scm_to_int (index), &v, &error),
             &error);
  list = bt__associate ("triangles", scm_from_size_t (v.triangles), list);
  list = bt__associate ("moves", scm_from_bool (v.moves), list);
  list = bt__associate ("high", bt__from_point (v.high), list);
  list = bt__associate ("low", bt__from_point (v.low), list);
  list = bt__associate ("radius", scm_from_double (v.radius), list);
  list = bt__associate ("size", bt__from_point (v.size), list);
  list = bt__associate (
      "axis", v.has_axis ? scm_list_2 (bt__from_point (v.from), bt__from_point (v.to)) : SCM_BOOL_F,
      list);
  list = bt__associate ("centre", bt__from_point (v.centre), list);
  list = bt__associate ("friction", scm_from_double (v.friction), list);
  return bt__associate ("head", scm_from_utf8_symbol (bt_obstacle_head (v.kind)->name), list);
}

void
bt__define_shapes (void)
{
  static const bt__procedure table[] = {
    { "%obstacle", 2, 0, (scm_t_subr)obstacle,
      "Return the alist of what the obstacle number INDEX of DIVE is: head friction centre axis "
      "size "
      "radius low high moves triangles; a friction of NaN is the tether's own." },
    { "%read-mesh", 2, 0, (scm_t_subr)read_mesh,
      "Return the triangles in FILE, whose axis UP, y or z, points up: an object for %make-dive." },
    { "%read-current-grid", 1, 0, (scm_t_subr)read_current_grid,
      "Return the current in FILE, rows of x y z t u v w: an object for %make-dive." },
    { "%read-heights", 1, 0, (scm_t_subr)read_heights,
      "Return the heights in FILE, an ESRI ASCII grid: an object for %make-dive." },
  };
  bt__define_procedures (table, sizeof table / sizeof *table);
}
