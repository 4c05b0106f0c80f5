/* Views: a growing list of things, each with copies of all it points to.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include <bight/view.h>

#include "base/error.h"
#include "math/vec.h"

/* Every copy hangs on one list: freeing knows nothing of the kinds of things.  */
typedef struct bt_keep
{
  struct bt_keep *next;
  max_align_t bytes[];
} bt_keep;

typedef struct bt_owned_view
{
  bt_view view; /* first: the two addresses are one */
  bt_keep *kept;
} bt_owned_view;

static bt_status
no_memory (bt_error *error)
{
  return bt__fail (error, BT_ERR_LIMIT, "there is no memory left for the picture");
}

bt_status
bt_view_new (bt_view **view, bt_error *error)
{
  bt_owned_view *owned = calloc (1, sizeof *owned);
  if (!owned)
    return no_memory (error);
  owned->view.sun = bt__unit_or (bt__vec (0.35, -0.25, 1), bt__vec (0, 0, 1));
  owned->view.camera.up = bt__vec (0, 0, 1);
  owned->view.ghost = 0.35;
  owned->view.camera.angle = 50 * BT__PI / 180;
  *view = &owned->view;
  return BT_OK;
}

void
bt_view_free (bt_view *view)
{
  bt_owned_view *owned = (bt_owned_view *)(void *)view;
  if (!view)
    return;
  while (owned->kept)
    {
      bt_keep *next = owned->kept->next;
      free (owned->kept);
      owned->kept = next;
    }
  free (view->things);
  free (owned);
}

/* A copy of N items of SIZE bytes; NULL without memory, and for none.  */
static void *
keep (bt_view *view, const void *items, size_t n, size_t size)
{
  bt_owned_view *owned = (bt_owned_view *)(void *)view;
  bt_keep *kept;
  if (!n || n > (SIZE_MAX - sizeof *kept) / size || !(kept = malloc (sizeof *kept + n * size)))
    return NULL;
  kept->next = owned->kept;
  owned->kept = kept;
  memcpy (kept->bytes, items, n * size);
  return kept->bytes;
}

const char *
bt_view_text (bt_view *view, const char *text)
{
  return text ? keep (view, text, strlen (text) + 1, 1) : NULL;
}

const char *const *
bt_view_words (bt_view *view, const char *const *words, size_t n)
{
  return keep (view, words, n, sizeof *words);
}

bt_thing
bt_thing_of (bt_thing_kind kind)
{
  static const bt_color colors[BT_THING_KINDS] = {
    [BT_THING_TUBE] = { 1, 0.82F, 0.16F },       [BT_THING_MESH] = { 0.62F, 0.6F, 0.55F },
    [BT_THING_BOX] = { 0.66F, 0.63F, 0.56F },    [BT_THING_SPHERE] = { 0.85F, 0.45F, 0.25F },
    [BT_THING_CYLINDER] = { 0.6F, 0.6F, 0.58F }, [BT_THING_CAPSULE] = { 0.62F, 0.6F, 0.56F },
    [BT_THING_LEVEL] = { 0.64F, 0.585F, 0.45F }, [BT_THING_FIELD] = { 0.64F, 0.585F, 0.45F },
    [BT_THING_ARROW] = { 0.75F, 0.93F, 1 },      [BT_THING_LABEL] = { 1, 1, 1 },
    [BT_THING_MARK] = { 1, 0.42F, 0.2F },        [BT_THING_LINES] = { 0.9F, 0.9F, 0.95F },
    [BT_THING_VEHICLE] = { 0.1F, 0.45F, 0.85F }, [BT_THING_ANCHOR] = { 0.95F, 0.5F, 0.12F },
    [BT_THING_SHIP] = { 0.75F, 0.2F, 0.16F },
  };
  bt_thing thing;
  memset (&thing, 0, sizeof thing);
  thing.kind = kind;
  thing.color = colors[kind];
  thing.scale = 1;
  return thing;
}

static int
all_finite (const bt_thing *t)
{
  double numbers = t->heading + t->pitch + t->roll + t->radius + t->scale;
  int ok = isfinite (numbers) && bt__is_finite (t->at) && bt__is_finite (t->from)
           && bt__is_finite (t->to) && bt__is_finite (t->size);
  for (size_t i = 0; ok && i < t->n; i++)
    ok = bt__is_finite (t->points[i]) && !(t->values && !isfinite (t->values[i]));
  return ok;
}

static int
corners_there (const bt_thing *t)
{
  int ok = 1;
  for (size_t i = 0; ok && i < t->triangles; i++)
    ok = t->corner[i][0] < t->n && t->corner[i][1] < t->n && t->corner[i][2] < t->n;
  return ok;
}

static bt_status
check (const bt_thing *t, bt_error *error)
{
  if ((unsigned)t->kind >= BT_THING_KINDS)
    return bt__fail (error, BT_ERR_NAME, "there is no thing of kind %d in a picture", (int)t->kind);
  if (!all_finite (t))
    return bt__fail (error, BT_ERR_DOMAIN, "a thing in a picture has numbers that are not finite");
  if (!corners_there (t))
    return bt__fail (error, BT_ERR_DOMAIN, "a triangle has a corner that is not among its points");
  return BT_OK;
}

static int
grow (bt_view *view)
{
  size_t room = view->room ? 2 * view->room : 16;
  bt_thing *more
      = view->n < view->room ? view->things : realloc (view->things, room * sizeof *more);
  if (!more)
    return 0;
  view->room = view->n < view->room ? view->room : room;
  view->things = more;
  return 1;
}

bt_status
bt_view_add (bt_view *view, const bt_thing *thing, bt_error *error)
{
  bt_status status = check (thing, error);
  bt_thing t = *thing;
  size_t posts = t.grid.nx * t.grid.ny;
  if (status != BT_OK)
    return status;
  t.text = bt_view_text (view, t.text);
  t.points = keep (view, t.points, t.n, sizeof *t.points);
  t.values = keep (view, t.values, t.values ? t.n : 0, sizeof *t.values);
  t.corner = keep (view, t.corner, t.triangles, sizeof *t.corner);
  t.grid.z = keep (view, t.grid.z, posts, sizeof *t.grid.z);
  if ((thing->text && !t.text) || (t.n && !t.points) || (t.n && thing->values && !t.values)
      || (t.triangles && !t.corner) || (posts && !t.grid.z) || !grow (view))
    return no_memory (error);
  view->things[view->n++] = t;
  return BT_OK;
}

void
bt_body_axes (double heading, double pitch, double roll, bt_vec3 axis[3])
{
  bt_vec3 right = bt__vec (cos (heading), -sin (heading), 0);
  bt_vec3 ahead = bt__vec (cos (pitch) * sin (heading), cos (pitch) * cos (heading), sin (pitch));
  bt_vec3 up = bt__cross (right, ahead);
  axis[0] = bt__axpy (bt__scale (cos (roll), right), -sin (roll), up);
  axis[1] = ahead;
  axis[2] = bt__axpy (bt__scale (cos (roll), up), sin (roll), right);
}
