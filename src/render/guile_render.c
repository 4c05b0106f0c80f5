/* The extension for pictures: fills the module (bight view render).  It is loaded when the first
   picture is asked for, and opens a graphics library then.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <stdlib.h>
#include <string.h>

#include "guile/guile.h"
#include "render/camera.h"
#include "render/render.h"
#include "render/scene_of_dive.h"
#include "render/sonar.h"

/* A dive comes from the other extension, which alone knows its type.  */
static const bt_dive *
to_dive (SCM object)
{
  SCM is_dive = scm_c_public_ref ("bight engine", "%dive?");
  SCM_ASSERT_TYPE (scm_is_true (scm_call_1 (is_dive, object)), object, SCM_ARG2, "%draw", "dive");
  return ((bt__handle *)SCM_SMOB_DATA (object))->dive;
}

/* ---- Renderers: they live as long as the process ---- */

static SCM
open_renderer (SCM name)
{
  bt__renderer *renderer = NULL;
  bt_error error;
  char *backend = scm_is_true (name) ? scm_to_utf8_string (scm_symbol_to_string (name)) : NULL;
  bt_status status = bt__renderer_new (backend, &renderer, &error);
  free (backend);
  bt__check ("snapshot", status, &error);
  return scm_from_pointer (renderer, NULL);
}

static SCM
renderer_name (SCM renderer)
{
  return scm_from_utf8_string (bt__renderer_name (scm_to_pointer (renderer)));
}

/* ---- Words ---- */

static SCM
names_of (const char *(*name) (int))
{
  SCM list = SCM_EOL;
  for (int i = 0; name (i); i++)
    list = scm_cons (scm_from_utf8_symbol (name (i)), list);
  return scm_reverse_x (list, SCM_EOL);
}

static const char *
aim_name (int i)
{
  return bt_aim_name ((bt_aim)i);
}

static const char *
paint_name (int i)
{
  return bt__paint_name ((bt__paint)i);
}

/* The place of SYMBOL among the names, or -1.  */
static int
index_of (SCM symbol, const char *(*name) (int))
{
  for (int i = 0; name (i); i++)
    if (scm_is_eq (symbol, scm_from_utf8_symbol (name (i))))
      return i;
  return -1;
}

static SCM
views (void)
{
  return names_of (aim_name);
}

/* ---- Drawing ---- */

/* The data of one call, freed when the call is left, by error or not: a current may be a procedure
   that raises.  */
typedef struct sketch
{
  bt_view *view;
  bt__picture picture;
  bt__drawing drawing;
  int paper;
} sketch;

static void
free_sketch (void *data)
{
  sketch *s = data;
  bt_view_free (s->view);
  bt__picture_free (&s->picture);
}

/* AIM is the name of a view, or an f64vector of six numbers: from, at.  */
static bt_status
aim_still (sketch *s, SCM aim, double aspect, bt_error *error)
{
  const double *x;
  if (scm_is_symbol (aim))
    {
      int i = index_of (aim, aim_name);
      s->paper = i == BT_AIM_PLAN;
      return bt_view_aim (s->view, (bt_aim)i, aspect, error);
    }
  x = (const double *)SCM_BYTEVECTOR_CONTENTS (aim);
  return bt_view_look (s->view, (bt_vec3){ x[0], x[1], x[2] }, (bt_vec3){ x[3], x[4], x[5] },
                       error);
}

static const double degree = 0.017453292519943295;

/* MOVED, a list as aim_camera takes it, may end with how far to turn and dip the camera, degrees.  */
static bt_status
turn_camera (sketch *s, SCM moved, bt_error *error)
{
  SCM angles = scm_list_tail (moved, scm_from_int (4));
  if (scm_is_null (angles))
    return BT_OK;
  return bt_view_turn (s->view, degree * scm_to_double (scm_car (angles)),
                       degree * scm_to_double (scm_cadr (angles)), error);
}

/* AIM is what aim_still takes; or a list of that, the point to look at, an f64vector or false, how
   many metres to see there, how many times nearer to go, and what turn_camera takes.  */
static bt_status
aim_camera (sketch *s, SCM aim, bt_error *error)
{
  double aspect = (double)s->drawing.width / s->drawing.height;
  int moved = scm_is_pair (aim);
  bt_status status = aim_still (s, moved ? scm_car (aim) : aim, aspect, error);
  const double *x;
  bt_vec3 at = { 0, 0, 0 };
  if (status != BT_OK || !moved)
    return status;
  if (scm_is_true (scm_cadr (aim)))
    {
      x = (const double *)SCM_BYTEVECTOR_CONTENTS (scm_cadr (aim));
      at = (bt_vec3){ x[0], x[1], x[2] };
    }
  status = bt_view_move (s->view, scm_is_true (scm_cadr (aim)) ? &at : NULL,
                         scm_to_double (scm_caddr (aim)), scm_to_double (scm_cadddr (aim)), aspect,
                         error);
  return status == BT_OK ? turn_camera (s, aim, error) : status;
}

/* MARKS, an f64vector of points, x y z one after another, is told where each falls in the picture:
   x and y in pixels from the upper left, and 1, or 0 for what lies behind the camera.  */
static void
place_marks (const sketch *s, SCM marks)
{
  double w = s->drawing.width, h = s->drawing.height;
  const bt__optics optics = bt__optics_of (&s->view->camera, w / h);
  double *p = (double *)SCM_BYTEVECTOR_CONTENTS (marks);
  for (size_t k = 0; k + 3 <= SCM_BYTEVECTOR_LENGTH (marks) / sizeof *p; k += 3)
    p[k + 2] = bt__project (&optics, (bt_vec3){ p[k], p[k + 1], p[k + 2] }, w, h, &p[k], &p[k + 1]);
}

static void
draw (sketch *s, SCM renderer, int figures)
{
  bt_error error;
  bt_status status = s->paper ? bt__plan (s->view, &s->drawing, &s->picture, &error)
                              : bt__render (scm_to_pointer (renderer), s->view, &s->drawing,
                                            &s->picture, &error);
  bt__check ("snapshot", status, &error);
  if (figures)
    bt__check ("snapshot",
               bt__overlay (s->view, &s->picture, s->paper || s->drawing.transparent, &error),
               &error);
}

static void
set_title (sketch *s, SCM title)
{
  char *text = scm_to_utf8_string (title);
  s->view->title = bt_view_text (s->view, text);
  free (text);
}

static SCM
pixels_of (const bt__picture *picture)
{
  size_t size = (size_t)picture->width * (size_t)picture->height * sizeof *picture->pixels;
  SCM bytes = scm_c_make_bytevector (size);
  memcpy (SCM_BYTEVECTOR_CONTENTS (bytes), picture->pixels, size);
  return bytes;
}

static int
has_flag (SCM flags, const char *name)
{
  return scm_is_true (scm_memq (scm_from_utf8_symbol (name), flags));
}

/* Lights are as the view has them, unless FLAGS say.  */
static void
set_lights (sketch *s, SCM flags)
{
  if (has_flag (flags, "lamp"))
    s->view->lamp = 1;
  if (has_flag (flags, "dark"))
    s->view->lamp = 0;
}

static void
set_drawing (bt__drawing *drawing, SCM size, SCM flags)
{
  drawing->width = scm_to_int (scm_car (size));
  drawing->height = scm_to_int (scm_cdr (size));
  drawing->quick = has_flag (flags, "quick");
  drawing->samples = drawing->quick ? 1 : 2;
  drawing->transparent = has_flag (flags, "transparent");
}

/* What FLAGS, and PAINT, want to see; a number among them is the level of the boxes.  */
static bt__show
show_of (SCM paint, SCM flags)
{
  static const char *const more[] = { "contacts", "turns", "taut-string", "bvh", "current" };
  bt__show show = { .paint = (bt__paint)index_of (paint, paint_name), .level = -1 };
  for (unsigned i = 0; i < sizeof more / sizeof *more; i++)
    show.more |= has_flag (flags, more[i]) ? 1U << i : 0;
  for (; scm_is_pair (flags); flags = scm_cdr (flags))
    if (scm_is_exact_integer (scm_car (flags)))
      show.level = scm_to_int (scm_car (flags));
  return show;
}

/* How far one sees, m, by an entry (visibility . METRES) of FLAGS; 0 without.  */
static double
visibility_of (SCM flags)
{
  for (; scm_is_pair (flags); flags = scm_cdr (flags))
    if (scm_is_pair (scm_car (flags)))
      return scm_to_double (scm_cdar (flags));
  return 0;
}

/* GHOST, another dive, is drawn pale beside the first; or none, for what is no dive.  */
static void
gather_dive (sketch *s, const bt_dive *dive, const bt__show *show, SCM ghost, SCM flags)
{
  bt_error error;
  bt__check ("snapshot", bt_view_new (&s->view, &error), &error);
  bt__check ("snapshot", bt__scene_of_dive (dive, show, s->view, &error), &error);
  if (!SCM_UNBNDP (ghost) && scm_is_true (ghost))
    bt__check ("snapshot", bt__scene_ghost (to_dive (ghost), s->view, &error), &error);
  s->view->visibility = visibility_of (flags);
}

static SCM
draw_dive (SCM renderer, SCM object, SCM title, SCM aim, SCM size, SCM paint, SCM flags, SCM ghost,
           SCM marks)
{
  const bt_dive *dive = to_dive (object);
  const bt__show show = show_of (paint, flags);
  sketch *s = scm_gc_calloc (sizeof *s, "sketch");
  bt_error error;
  SCM bytes;
  set_drawing (&s->drawing, size, flags);
  scm_dynwind_begin (0);
  scm_dynwind_unwind_handler (free_sketch, s, SCM_F_WIND_EXPLICITLY);
  bt__check ("snapshot", bt__check_size (s->drawing.width, s->drawing.height, &error), &error);
  gather_dive (s, dive, &show, ghost, flags);
  set_title (s, title);
  bt__check ("snapshot", aim_camera (s, aim, &error), &error);
  set_lights (s, flags);
  if (!SCM_UNBNDP (marks) && scm_is_true (marks))
    place_marks (s, marks);
  draw (s, renderer, has_flag (flags, "figures"));
  bytes = pixels_of (&s->picture);
  scm_dynwind_end ();
  scm_remember_upto_here_2 (object, s);
  return bytes;
}

/* What a sonar of the first vehicle hears within RANGE metres.  */
static SCM
draw_sonar (SCM object, SCM title, SCM size, SCM range, SCM flags)
{
  const bt_dive *dive = to_dive (object);
  sketch *s = scm_gc_calloc (sizeof *s, "sketch");
  bt_error error;
  SCM bytes;
  char *text;
  bt_status status;
  set_drawing (&s->drawing, size, flags);
  bt__check ("snapshot", bt__check_size (s->drawing.width, s->drawing.height, &error), &error);
  text = scm_to_utf8_string (title);
  status = bt__sonar_picture (dive, 0, scm_to_double (range), text, has_flag (flags, "figures"),
                              &s->drawing, &s->picture, &error);
  free (text);
  if (status != BT_OK)
    bt__picture_free (&s->picture);
  bt__check ("snapshot", status, &error);
  bytes = pixels_of (&s->picture);
  bt__picture_free (&s->picture);
  scm_remember_upto_here_2 (object, s);
  return bytes;
}

/* What stands over a picture, as a list of lists X Y WIDTH HEIGHT; nothing is drawn.  */
static SCM
written_boxes (SCM object, SCM title, SCM aim, SCM size, SCM paint, SCM flags)
{
  enum
  {
    MOST = 96
  };
  const bt_dive *dive = to_dive (object);
  const bt__show show = show_of (paint, flags);
  sketch *s = scm_gc_calloc (sizeof *s, "sketch");
  bt__box box[MOST];
  bt_error error;
  SCM list = SCM_EOL;
  int n;
  set_drawing (&s->drawing, size, flags);
  scm_dynwind_begin (0);
  scm_dynwind_unwind_handler (free_sketch, s, SCM_F_WIND_EXPLICITLY);
  gather_dive (s, dive, &show, SCM_UNDEFINED, flags);
  set_title (s, title);
  bt__check ("snapshot", aim_camera (s, aim, &error), &error);
  n = bt__written (s->view, s->drawing.width, s->drawing.height, s->paper, box, MOST);
  while (n-- > 0)
    list = scm_cons (scm_list_4 (scm_from_double (box[n].x), scm_from_double (box[n].y),
                                 scm_from_double (box[n].w), scm_from_double (box[n].h)),
                     list);
  scm_dynwind_end ();
  scm_remember_upto_here_2 (object, s);
  return list;
}

/* ---- Files ---- */

static SCM
write_picture (SCM bytes, SCM width, SCM height, SCM file)
{
  bt__picture picture = { scm_to_int (width), scm_to_int (height), NULL };
  bt_error error;
  bt_status status;
  char *name;
  SCM_ASSERT_TYPE (scm_is_bytevector (bytes), bytes, SCM_ARG1, "%write-picture", "bytevector");
  SCM_ASSERT (SCM_BYTEVECTOR_LENGTH (bytes)
                  == (size_t)picture.width * (size_t)picture.height * sizeof *picture.pixels,
              bytes, SCM_ARG1, "%write-picture");
  picture.pixels = (uint32_t *)(void *)SCM_BYTEVECTOR_CONTENTS (bytes);
  name = scm_to_locale_string (file);
  status = bt__picture_write (&picture, name, &error);
  free (name);
  bt__check ("snapshot", status, &error);
  scm_remember_upto_here_1 (bytes);
  return SCM_UNSPECIFIED;
}

void bight_render_init (void);

__attribute__ ((visibility ("default"))) void
bight_render_init (void)
{
  static const bt__procedure table[] = {
    { "%open-renderer", 1, 0, (scm_t_subr)open_renderer,
      "Return a renderer by the back end NAME, osmesa or egl, or by the first that works for #f." },
    { "%renderer-name", 1, 0, (scm_t_subr)renderer_name, "Return what draws for RENDERER." },
    { "%views", 0, 0, (scm_t_subr)views, "Return the names of the views." },
    { "%draw", 7, 2, (scm_t_subr)draw_dive,
      "Return the pixels, a bytevector, of a picture by RENDERER of DIVE with TITLE, seen by AIM, "
      "of SIZE (WIDTH . HEIGHT), tethers painted by PAINT; FLAGS are of figures, transparent, "
      "quick, "
      "lamp, dark, contacts, turns, taut-string, bvh, current, a level of boxes, (visibility . "
      "METRES); GHOST, another dive, is drawn "
      "pale beside it; MARKS, an f64vector of points, receives where they fall in the picture: x y "
      "and 1, or 0 behind the camera." },
    { "%draw-sonar", 5, 0, (scm_t_subr)draw_sonar,
      "Return the pixels, a bytevector, of what a sonar of the first vehicle of DIVE hears within "
      "RANGE metres, with TITLE, of SIZE (WIDTH . HEIGHT); FLAGS as of %draw." },
    { "%written", 6, 0, (scm_t_subr)written_boxes,
      "Return the boxes (X Y WIDTH HEIGHT) that words and figures take over the picture that %draw "
      "would make of the same DIVE TITLE AIM SIZE PAINT FLAGS." },
    { "%write-picture", 4, 0, (scm_t_subr)write_picture,
      "Write BYTES, the pixels of a picture of WIDTH by HEIGHT, to FILE as PNG." },
  };
  bt__define_procedures (table, sizeof table / sizeof *table);
}
