/* Setting the fields of a part's struct, each value checked against the table.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/error.h"
#include "model/compile.h"

static void *
member (const bt_field *field, void *def)
{
  return (char *)def + field->offset;
}

static int
is_numeric (const bt_field *field)
{
  return field->kind == BT_FIELD_NUMBER || field->kind == BT_FIELD_COUNT
         || field->kind == BT_FIELD_WORD;
}

void
bt_def_init (const bt_head *head, void *def)
{
  memset (def, 0, head->size);
  for (size_t i = 0; i < head->n_fields; i++)
    if (is_numeric (&head->fields[i]))
      *(double *)member (&head->fields[i], def) = head->fields[i].fallback;
  if (head->obstacle >= 0)
    {
      ((bt_obstacle_def *)def)->kind = (bt_obstacle_kind)head->obstacle;
      ((bt_obstacle_def *)def)->scale = 1;
    }
}

static const char *
lower_bound_word (const bt_field *field)
{
  return field->above_min ? "above" : "at least";
}

static int
is_word_value (const bt_field *field, double value)
{
  for (const bt_word *w = field->words; w && w->word; w++)
    if (w->value == value || (isnan (w->value) && isnan (value)))
      return 1;
  return 0;
}

static int
in_range (const bt_field *field, double value)
{
  return isfinite (value) && value <= field->max
         && (field->above_min ? value > field->min : value >= field->min);
}

bt_status
bt_def_set_number (const bt_field *field, void *def, double value, bt_error *error)
{
  int whole = field->kind == BT_FIELD_COUNT;
  if (!is_numeric (field))
    return bt__fail (error, BT_ERR_NAME, "`%s' does not take a number", field->name);
  if (field->kind == BT_FIELD_WORD && !is_word_value (field, value))
    return bt__fail (error, BT_ERR_NAME, "`%s' takes a word, not the number %g", field->name,
                     value);
  if (whole && (!in_range (field, value) || value != floor (value)))
    return bt__fail (error, BT_ERR_DOMAIN, "`%s' is a whole number from %g to %g, not %g",
                     field->name, field->min, field->max, value);
  if (!whole && !is_word_value (field, value) && !in_range (field, value))
    return bt__fail (error, BT_ERR_DOMAIN, "`%s' is %s %g and at most %g%s%s, not %g", field->name,
                     lower_bound_word (field), field->min, field->max, *field->unit ? " " : "",
                     field->unit, value);
  *(double *)member (field, def) = value;
  return BT_OK;
}

/* Write the words of FIELD, separated by commas, to TEXT of SIZE bytes.  */
static void
list_words (const bt_field *field, char *text, size_t size)
{
  size_t used = 0;
  *text = 0;
  for (const bt_word *w = field->words; w && w->word && used < size; w++)
    used += (size_t)snprintf (text + used, size - used, "%s%s", used ? ", " : "", w->word);
}

bt_status
bt_word_value (const bt_field *field, const char *word, double *value, bt_error *error)
{
  char words[BT_ERROR_TEXT / 2];
  for (const bt_word *w = field->words; w && w->word; w++)
    if (strcmp (w->word, word) == 0)
      {
        *value = w->value;
        return BT_OK;
      }
  if (!field->words)
    return bt__fail (error, BT_ERR_NAME, "`%s' takes no word, such as `%s'", field->name, word);
  list_words (field, words, sizeof words);
  return bt__fail (error, BT_ERR_NAME, "`%s' takes %s, not `%s'", field->name, words, word);
}

bt_status
bt_def_set_word (const bt_field *field, void *def, const char *word, bt_error *error)
{
  double value;
  bt_status status = bt_word_value (field, word, &value, error);
  if (status == BT_OK)
    *(double *)member (field, def) = value;
  return status;
}

static int
point_in_range (const bt_field *field, bt_vec3 v)
{
  return in_range (field, v.x) && in_range (field, v.y) && in_range (field, v.z);
}

bt_status
bt_def_set_point (const bt_field *field, void *def, bt_vec3 v, bt_error *error)
{
  if (field->kind != BT_FIELD_POINT && field->kind != BT_FIELD_END)
    return bt__fail (error, BT_ERR_NAME, "`%s' does not take a point", field->name);
  if (!point_in_range (field, v) && field->min >= 0)
    return bt__fail (error, BT_ERR_DOMAIN,
                     "`%s' is three numbers %s %g and at most %g m, not (%g %g %g)", field->name,
                     lower_bound_word (field), field->min, field->max, v.x, v.y, v.z);
  if (!point_in_range (field, v))
    return bt__fail (error, BT_ERR_DOMAIN, "`%s' is a point within %g m, not (%g %g %g)",
                     field->name, field->max, v.x, v.y, v.z);
  if (field->kind == BT_FIELD_END)
    *(bt_end *)member (field, def) = (bt_end){ .at = v };
  else
    *(bt_vec3 *)member (field, def) = v;
  return BT_OK;
}

bt_status
bt_def_set_current (const bt_field *field, void *def, const bt_current *value, bt_error *error)
{
  bt_status status;
  if (field->kind != BT_FIELD_CURRENT)
    return bt__fail (error, BT_ERR_NAME, "`%s' does not take a current", field->name);
  status = bt_current_check (value, error);
  if (status == BT_OK)
    *(bt_current *)member (field, def) = *value;
  return status;
}

bt_status
bt_def_set_waves (const bt_field *field, void *def, const bt_wave_def *value, bt_error *error)
{
  if (field->kind != BT_FIELD_WAVES)
    return bt__fail (error, BT_ERR_NAME, "`%s' does not take waves", field->name);
  *(bt_wave_def *)member (field, def) = *value;
  return BT_OK;
}

bt_status
bt_def_set_part (const bt_field *field, void *def, const char *part, bt_error *error)
{
  bt_end end = { { 0, 0, 0 }, { 0 } };
  bt_status status;
  if (field->kind != BT_FIELD_END)
    return bt__fail (error, BT_ERR_NAME, "`%s' does not take the name of a part", field->name);
  status = bt_def_set_name (end.part, part, error);
  if (status == BT_OK)
    *(bt_end *)member (field, def) = end;
  return status;
}

/* ---- Rows, meshes and grids ---- */

static bt_status
check_points (const bt_field *field, const bt_rows *rows, bt_error *error)
{
  for (size_t i = 0; i < rows->n; i++)
    {
      const double *p = rows->at + i * rows->width;
      if (!point_in_range (field, (bt_vec3){ p[0], p[1], p[2] }))
        return bt__fail (error, BT_ERR_DOMAIN, "point %zu of `%s' is (%g %g %g), not within %g m",
                         i + 1, field->name, p[0], p[1], p[2], field->max);
    }
  return BT_OK;
}

#define TIME_MAX 1e9 /* s: the longest dive */
#define TURN_MAX 1e6 /* degrees, as of any heading */

static bt_status
check_track_row (const bt_field *field, const double *row, size_t i, bt_error *error)
{
  int sane = row[0] >= 0 && row[0] <= TIME_MAX
             && point_in_range (field, (bt_vec3){ row[1], row[2], row[3] })
             && (isnan (row[4]) || fabs (row[4]) <= TURN_MAX);
  if (!sane)
    return bt__fail (error, BT_ERR_DOMAIN,
                     "row %zu of `%s' is (%g %g %g %g %g): a time from 0 to %g s, a point within "
                     "%g m and a heading in degrees are wanted",
                     i + 1, field->name, row[0], row[1], row[2], row[3], row[4], TIME_MAX,
                     field->max);
  if (i > 0 && !(row[0] > row[-5]))
    return bt__fail (error, BT_ERR_DOMAIN,
                     "row %zu of `%s' is at %g s, not later than row %zu, at %g s", i + 1,
                     field->name, row[0], i, row[-5]);
  return BT_OK;
}

static bt_status
check_track (const bt_field *field, const bt_rows *rows, bt_error *error)
{
  bt_status status = BT_OK;
  for (size_t i = 0; i < rows->n && status == BT_OK; i++)
    status = check_track_row (field, rows->at + i * rows->width, i, error);
  return status;
}

enum
{
  ROWS_MAX = 1000000
};

static bt_status
check_field_rows (const bt_field *field, const bt_rows *rows, bt_error *error)
{
  size_t width = field->kind == BT_FIELD_TRACK ? 5 : 3;
  size_t most = field->kind == BT_FIELD_VIA   ? BT_VIA_MAX
                : field->kind == BT_FIELD_SIX ? 2
                                              : ROWS_MAX;
  if (field->kind == BT_FIELD_SIX && rows->n != 2)
    return bt__fail (error, BT_ERR_DOMAIN,
                     "`%s' is two rows, surge sway heave and roll pitch yaw, not %zu", field->name,
                     rows->n);
  if (rows->n > most)
    return bt__fail (error, BT_ERR_LIMIT, "`%s' has %zu rows; at most %zu are allowed", field->name,
                     rows->n, most);
  if (rows->n > 0 && (!rows->at || rows->width != width))
    return bt__fail (error, BT_ERR_DOMAIN, "a row of `%s' has %zu numbers, not %zu", field->name,
                     width, rows->at ? rows->width : 0);
  return field->kind == BT_FIELD_TRACK ? check_track (field, rows, error)
                                       : check_points (field, rows, error);
}

bt_status
bt_def_set_rows (const bt_field *field, void *def, const bt_rows *rows, bt_error *error)
{
  bt_status status;
  if (field->kind != BT_FIELD_VIA && field->kind != BT_FIELD_POINTS && field->kind != BT_FIELD_TRACK
      && field->kind != BT_FIELD_SIX)
    return bt__fail (error, BT_ERR_NAME, "`%s' does not take rows of numbers", field->name);
  status = check_field_rows (field, rows, error);
  if (status != BT_OK)
    return status;
  if (field->kind == BT_FIELD_VIA)
    {
      bt_via via = { .n = (double)rows->n };
      if (rows->n > 0)
        memcpy (via.at, rows->at, rows->n * sizeof *via.at);
      *(bt_via *)member (field, def) = via;
    }
  else if (field->kind == BT_FIELD_SIX)
    memcpy (member (field, def), rows->at, sizeof (bt_six));
  else
    *(bt_rows *)member (field, def) = *rows;
  return BT_OK;
}

/* The triangles themselves are checked when they become part of a model.  */
bt_status
bt_def_set_mesh (const bt_field *field, void *def, const bt_triangles *mesh, bt_error *error)
{
  if (field->kind != BT_FIELD_MESH)
    return bt__fail (error, BT_ERR_NAME, "`%s' does not take triangles", field->name);
  if (mesh->vertices > 0 && mesh->triangles > 0 && (!mesh->vertex || !mesh->corner))
    return bt__fail (error, BT_ERR_DOMAIN, "`%s' has no vertices or no corners", field->name);
  if (mesh->vertices > UINT32_MAX || mesh->triangles > BT_TRIANGLES_MAX)
    return bt__fail (error, BT_ERR_LIMIT, "`%s' has %zu triangles; at most %d are allowed",
                     field->name, mesh->triangles, BT_TRIANGLES_MAX);
  *(bt_triangles *)member (field, def) = *mesh;
  return BT_OK;
}

static bt_status
check_heights (const bt_field *field, const bt_heights *grid, bt_error *error)
{
  for (size_t i = 0; i < grid->nx * grid->ny; i++)
    if (!(isnan (grid->z[i]) || fabs (grid->z[i]) <= field->max))
      return bt__fail (error, BT_ERR_DOMAIN, "post %zu east, %zu north of `%s' is at %g m",
                       i % grid->nx, i / grid->nx, field->name, grid->z[i]);
  return BT_OK;
}

static int
is_spacing (const bt_field *field, double d)
{
  return d > 0 && d <= field->max;
}

bt_status
bt_def_set_grid (const bt_field *field, void *def, const bt_heights *grid, bt_error *error)
{
  bt_status status;
  if (field->kind != BT_FIELD_GRID)
    return bt__fail (error, BT_ERR_NAME, "`%s' does not take heights", field->name);
  if (grid->nx < 2 || grid->ny < 2 || !grid->z)
    return bt__fail (error, BT_ERR_DOMAIN, "`%s' has %zu by %zu posts; two each way is the least",
                     field->name, grid->nx, grid->ny);
  if (grid->nx > BT_POSTS_MAX / grid->ny)
    return bt__fail (error, BT_ERR_LIMIT, "`%s' has %zu by %zu posts; at most %d are allowed",
                     field->name, grid->nx, grid->ny, BT_POSTS_MAX);
  if (!is_spacing (field, grid->dx) || !is_spacing (field, grid->dy) || !isfinite (grid->x)
      || !isfinite (grid->y))
    return bt__fail (error, BT_ERR_DOMAIN,
                     "the posts of `%s' are %g by %g m apart from (%g %g) on: distances above 0 "
                     "and finite numbers are wanted",
                     field->name, grid->dx, grid->dy, grid->x, grid->y);
  status = check_heights (field, grid, error);
  if (status == BT_OK)
    *(bt_heights *)member (field, def) = *grid;
  return status;
}

/* ---- Checking a part that was filled in by hand ---- */

/* The value of the field, as the setter would have it again.  */
static bt_status
set_again (const bt_field *field, void *def, bt_error *error)
{
  void *p = member (field, def);
  const bt_via *via = p;
  bt_rows rows = { (const double *)via->at, 0, 3 };
  switch (field->kind)
    {
    case BT_FIELD_POINT:
      return bt_def_set_point (field, def, *(bt_vec3 *)p, error);
    case BT_FIELD_CURRENT:
      return bt_current_check (p, error);
    case BT_FIELD_WAVES: /* what they are depends on the sea: checked with it */
      return BT_OK;
    case BT_FIELD_END:
      return ((bt_end *)p)->part[0] ? BT_OK
                                    : bt_def_set_point (field, def, ((bt_end *)p)->at, error);
    case BT_FIELD_VIA:
      if (!(via->n >= 0 && via->n <= BT_VIA_MAX))
        return bt__fail (error, BT_ERR_LIMIT, "`%s' has %g points; at most %d are allowed",
                         field->name, via->n, BT_VIA_MAX);
      rows.n = (size_t)via->n;
      return check_field_rows (field, &rows, error);
    case BT_FIELD_SIX:
      rows = (bt_rows){ p, 2, 3 };
      return check_field_rows (field, &rows, error);
    case BT_FIELD_POINTS:
    case BT_FIELD_TRACK:
      return check_field_rows (field, p, error);
    case BT_FIELD_MESH:
      return bt_def_set_mesh (field, def, p, error);
    case BT_FIELD_GRID:
      return ((bt_heights *)p)->z ? bt_def_set_grid (field, def, p, error) : BT_OK;
    default:
      return bt_def_set_number (field, def, *(double *)p, error);
    }
}

/* Put a sentence about PART in front of what ERROR says.  */
bt_status
bt__about (const char *head, const char *name, bt_error *error, const bt_error *inner)
{
  return bt__fail (error, inner->status, "%s%s%.63s%s: %s", head, *name ? " `" : "", name,
                   *name ? "'" : "", inner->text);
}

bt_status
bt__check_def (const bt_head *head, const char *name, void *def, bt_error *error)
{
  bt_error here;
  for (size_t i = 0; i < head->n_fields; i++)
    if (set_again (&head->fields[i], def, &here) != BT_OK)
      return bt__about (head->name, name, error, &here);
  return BT_OK;
}

bt_status
bt__check_name (const char *head, const char *name, bt_error *error)
{
  if (!memchr (name, 0, BT_NAME_SIZE) || !*name)
    return bt__fail (error, BT_ERR_DEF, "a %s needs a name of 1 to %d bytes", head,
                     BT_NAME_SIZE - 1);
  return BT_OK;
}

bt_status
bt_def_set_name (char *name_field, const char *name, bt_error *error)
{
  size_t n = strlen (name);
  if (n == 0 || n >= BT_NAME_SIZE)
    return bt__fail (error, BT_ERR_DEF, "a name has 1 to %d bytes, not %zu", BT_NAME_SIZE - 1, n);
  memset (name_field, 0, BT_NAME_SIZE);
  memcpy (name_field, name, n);
  return BT_OK;
}
