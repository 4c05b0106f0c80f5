/* The renderer, from views made by hand: what is thin or far is seen, the water hides what is far,
   the same view gives the same bytes whole or in tiles.  Without a graphics library the pictures
   are skipped; cameras, plans and files are tried all the same.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#define _DEFAULT_SOURCE /* mkstemp */

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include <cairo.h>
#include <cmocka.h>

#include "math/vec.h"
#include "render/camera.h"
#include "render/render.h"
#include "render/sight.h"
#include "render/soup.h"

/* What the graphics libraries keep to themselves is no leak of ours.  */
const char *__lsan_default_suppressions (void);

const char *
__lsan_default_suppressions (void)
{
  return "leak:libOSMesa\nleak:libEGL\nleak:libgallium\nleak:_dri.so\nleak:libLLVM\n";
}

/* ---- Views and pictures ---- */

static bt_view *
new_view (void)
{
  bt_view *view;
  assert_int_equal (bt_view_new (&view, NULL), BT_OK);
  return view;
}

static void
add (bt_view *view, const bt_thing *thing)
{
  bt_error error;
  if (bt_view_add (view, thing, &error) != BT_OK)
    fail_msg ("%s", error.text);
}

static void
add_tube (bt_view *view, bt_vec3 a, bt_vec3 b, double radius)
{
  bt_vec3 points[2] = { a, b };
  bt_thing t = bt_thing_of (BT_THING_TUBE);
  t.points = points;
  t.n = 2;
  t.radius = radius;
  t.framing = BT_FRAME_MUST;
  add (view, &t);
}

static void
add_box (bt_view *view, bt_vec3 at, double side, bt_color color)
{
  bt_thing t = bt_thing_of (BT_THING_BOX);
  t.at = at;
  t.size = bt__vec (side, side, side);
  t.color = color;
  t.framing = BT_FRAME_NEAR;
  add (view, &t);
}

static void
add_level (bt_view *view, double z)
{
  bt_thing t = bt_thing_of (BT_THING_LEVEL);
  t.at.z = z;
  add (view, &t);
}

static void
add_vehicle (bt_view *view, bt_vec3 at)
{
  bt_thing t = bt_thing_of (BT_THING_VEHICLE);
  t.at = at;
  t.heading = 0.7;
  t.size = bt__vec (0.575, 0.457, 0.254);
  t.framing = BT_FRAME_MUST;
  add (view, &t);
}

/* Look along +y from the origin, without perspective if HEIGHT is not 0.  */
static void
look_north (bt_view *view, double away)
{
  assert_int_equal (bt_view_look (view, bt__vec (0, 0, -20), bt__vec (0, away, -20), NULL), BT_OK);
}

/* A scene with some of everything.  */
static bt_view *
rich_view (void)
{
  bt_view *view = new_view ();
  bt_thing t = bt_thing_of (BT_THING_CYLINDER);
  add_level (view, -20);
  add_tube (view, bt__vec (-5, 0, -2), bt__vec (8, 3, -14), 0.004);
  add_vehicle (view, bt__vec (8, 3, -14));
  t.from = bt__vec (3, 6, 0);
  t.to = bt__vec (3, 6, -20);
  t.radius = 0.8;
  t.framing = BT_FRAME_NEAR;
  add (view, &t);
  add_box (view, bt__vec (-1, 4, -19), 2, (bt_color){ 0.7F, 0.3F, 0.2F });
  return view;
}

static bt__renderer *
renderer_by (const char *name)
{
  bt__renderer *r = NULL;
  bt_error error;
  if (bt__renderer_new (name, &r, &error) != BT_OK)
    {
      print_message ("# %s\n", error.text);
      skip ();
    }
  return r;
}

static bt__picture
draw_with (bt__renderer *r, const bt_view *view, const bt__drawing *drawing)
{
  bt__picture picture;
  bt_error error;
  if (bt__render (r, view, drawing, &picture, &error) != BT_OK)
    fail_msg ("%s", error.text);
  return picture;
}

static bt__picture
draw (bt__renderer *r, const bt_view *view, int w, int h)
{
  bt__drawing drawing = { .width = w, .height = h, .samples = 2 };
  return draw_with (r, view, &drawing);
}

static int
channel (uint32_t pixel, int i)
{
  return (int)(pixel >> (8 * i) & 255);
}

/* The greatest difference of a channel of two pixels.  */
static int
difference (uint32_t a, uint32_t b)
{
  int most = 0;
  for (int i = 0; i < 4; i++)
    {
      int d = abs (channel (a, i) - channel (b, i));
      most = d > most ? d : most;
    }
  return most;
}

static uint32_t
pixel_at (const bt__picture *p, int x, int y)
{
  return p->pixels[(size_t)y * (size_t)p->width + (size_t)x];
}

/* How many pixels of A and B differ by more than MOST.  */
static int
differing (const bt__picture *a, const bt__picture *b, int most)
{
  int n = 0;
  for (int i = 0; i < a->width * a->height; i++)
    n += difference (a->pixels[i], b->pixels[i]) > most;
  return n;
}

/* ---- What is seen ---- */

/* A line of 2 mm, 60 m away, where a pixel spans 0.3 m: in every column at least 1.5 pixels of it.
 */
static void
thin_far_tube (void **state)
{
  bt__renderer *r = renderer_by (NULL);
  bt_view *with = new_view (), *without = new_view ();
  bt__picture a, b;
  (void)state;
  add_tube (with, bt__vec (-80, 60, -24), bt__vec (80, 60, -18), 0.001);
  look_north (with, 30);
  look_north (without, 30);
  a = draw (r, with, 320, 180);
  b = draw (r, without, 320, 180);
  for (int x = 0; x < 320; x++)
    {
      double sum = 0, most = 0;
      for (int y = 0; y < 180; y++)
        {
          double d = abs (channel (pixel_at (&a, x, y), 2) - channel (pixel_at (&b, x, y), 2));
          sum += d;
          most = fmax (most, d);
        }
      assert_true (most > 60);
      assert_true (sum / most >= 1.45);
      assert_true (sum / most < 6);
    }
  bt__picture_free (&a);
  bt__picture_free (&b);
  bt_view_free (with);
  bt_view_free (without);
  bt__renderer_free (r);
}

/* How far the middle of a picture of a white box AWAY metres off, as large in each, is from the
   water's own colour.  */
static int
stands_out (bt__renderer *r, double away, int tube)
{
  bt_view *with = new_view (), *without = new_view ();
  bt__picture a, b;
  int d;
  if (tube)
    add_tube (with, bt__vec (-away, away, -20), bt__vec (away, away, -20), away / 10);
  else
    add_box (with, bt__vec (0, away, -20), away / 4, (bt_color){ 1, 0.82F, 0.16F });
  look_north (with, away);
  look_north (without, away);
  with->visibility = without->visibility = 30;
  with->surface = without->surface = INFINITY;
  a = draw (r, with, 64, 48);
  b = draw (r, without, 64, 48);
  d = difference (pixel_at (&a, 32, 24), pixel_at (&b, 32, 24));
  bt__picture_free (&a);
  bt__picture_free (&b);
  bt_view_free (with);
  bt_view_free (without);
  return d;
}

static void
fog (void **state)
{
  bt__renderer *r = renderer_by (NULL);
  (void)state;
  int near = stands_out (r, 4, 0), middle = stands_out (r, 20, 0), far = stands_out (r, 45, 0);
  assert_true (near > middle + 20);
  assert_true (middle > far + 20);
  assert_true (far < 25);
  assert_true (stands_out (r, 30, 1) > stands_out (r, 30, 0) + 40);
  bt__renderer_free (r);
}

/* A red box before a green one, and after it, by no order but that of depth.  */
static void
nearer_hides (void **state)
{
  static const bt_color red = { 1, 0, 0 }, green = { 0, 1, 0 };
  bt__renderer *r = renderer_by (NULL);
  (void)state;
  for (int first = 0; first < 2; first++)
    {
      bt_view *view = new_view ();
      bt__picture p;
      add_box (view, bt__vec (0, first ? 6 : 9, -20), 2, green);
      add_box (view, bt__vec (0, first ? 9 : 6, -20), 2, red);
      look_north (view, 6);
      p = draw (r, view, 64, 48);
      uint32_t c = pixel_at (&p, 32, 24);
      assert_true (first ? channel (c, 1) > 2 * channel (c, 2) : channel (c, 2) > channel (c, 1));
      bt__picture_free (&p);
      bt_view_free (view);
    }
  bt__renderer_free (r);
}

/* ---- The same pixels ---- */

static void
same_bytes (void **state)
{
  bt__renderer *r = renderer_by (NULL), *other = renderer_by (NULL);
  bt_view *view = rich_view ();
  bt__picture a, b, c;
  (void)state;
  assert_int_equal (bt_view_aim (view, BT_AIM_OVERVIEW, 4.0 / 3, NULL), BT_OK);
  a = draw (r, view, 320, 240);
  b = draw (r, view, 320, 240);
  c = draw (other, view, 320, 240);
  assert_memory_equal (a.pixels, b.pixels, 320 * 240 * 4);
  assert_memory_equal (a.pixels, c.pixels, 320 * 240 * 4);
  bt__picture_free (&a);
  bt__picture_free (&b);
  bt__picture_free (&c);
  bt_view_free (view);
  bt__renderer_free (other);
  bt__renderer_free (r);
}

/* A picture in tiles of odd sizes is the picture drawn at once, but for the rounding of a few
   edges; at the seams no more than elsewhere.  */
static void
tiles (void **state)
{
  bt__renderer *r = renderer_by (NULL);
  bt_view *view = rich_view ();
  bt__drawing drawing = { .width = 300, .height = 200, .samples = 2 };
  bt__picture whole, parts;
  (void)state;
  for (bt_aim aim = BT_AIM_CHASE; aim < BT_AIM_PLAN; aim++)
    {
      int seam = 0;
      assert_int_equal (bt_view_aim (view, aim, 1.5, NULL), BT_OK);
      drawing.tile = 0;
      whole = draw_with (r, view, &drawing);
      drawing.tile = 67;
      parts = draw_with (r, view, &drawing);
      for (int y = 0; y < 200; y++)
        for (int x = 67; x < 300; x += 67)
          seam += difference (pixel_at (&whole, x, y), pixel_at (&parts, x, y)) > 2;
      assert_true (differing (&whole, &parts, 2) < 300 * 200 / 200);
      assert_true (seam <= 8);
      bt__picture_free (&whole);
      bt__picture_free (&parts);
    }
  bt_view_free (view);
  bt__renderer_free (r);
}

static void
back_ends_agree (void **state)
{
  bt__renderer *o = renderer_by ("osmesa"), *e = renderer_by ("egl");
  bt_view *view = rich_view ();
  bt__picture a, b;
  (void)state;
  assert_int_equal (bt_view_aim (view, BT_AIM_OVERVIEW, 4.0 / 3, NULL), BT_OK);
  a = draw (o, view, 320, 240);
  b = draw (e, view, 320, 240);
  assert_true (differing (&a, &b, 8) < 320 * 240 / 200);
  bt__picture_free (&a);
  bt__picture_free (&b);
  bt_view_free (view);
  bt__renderer_free (o);
  bt__renderer_free (e);
}

/* ---- Sizes, transparency ---- */

static void
sizes (void **state)
{
  static const int good[][2] = { { 16, 16 }, { 8192, 16 }, { 17, 2000 }, { 1601, 33 } };
  static const int bad[][2] = { { 15, 100 }, { 100, 15 }, { 8193, 100 }, { 0, 0 }, { -5, 20 } };
  bt__renderer *r = renderer_by (NULL);
  bt_view *view = rich_view ();
  bt__picture p;
  bt_error error;
  (void)state;
  for (size_t i = 0; i < sizeof good / sizeof *good; i++)
    {
      assert_int_equal (bt_view_aim (view, BT_AIM_SIDE, (double)good[i][0] / good[i][1], NULL),
                        BT_OK);
      p = draw (r, view, good[i][0], good[i][1]);
      assert_int_equal (p.width, good[i][0]);
      assert_int_equal (p.height, good[i][1]);
      assert_int_equal (channel (pixel_at (&p, p.width - 1, p.height - 1), 3), 255);
      bt__picture_free (&p);
    }
  for (size_t i = 0; i < sizeof bad / sizeof *bad; i++)
    {
      bt__drawing d = { .width = bad[i][0], .height = bad[i][1], .samples = 2 };
      assert_int_equal (bt__render (r, view, &d, &p, &error), BT_ERR_DOMAIN);
      assert_non_null (strstr (error.text, "16 to 8192"));
    }
  bt_view_free (view);
  bt__renderer_free (r);
}

static void
transparent (void **state)
{
  bt__renderer *r = renderer_by (NULL);
  bt_view *view = rich_view ();
  bt__drawing drawing = { .width = 160, .height = 120, .samples = 2, .transparent = 1 };
  bt__picture p;
  int clear = 0, solid = 0;
  (void)state;
  assert_int_equal (bt_view_aim (view, BT_AIM_OVERVIEW, 4.0 / 3, NULL), BT_OK);
  p = draw_with (r, view, &drawing);
  assert_int_equal (pixel_at (&p, 0, 0), 0);
  for (int i = 0; i < 160 * 120; i++)
    {
      int a = channel (p.pixels[i], 3);
      clear += a == 0;
      solid += a == 255;
      for (int c = 0; c < 3; c++)
        assert_true (channel (p.pixels[i], c) <= a);
    }
  assert_true (clear > 160 * 120 / 2);
  assert_true (solid > 400);
  bt__picture_free (&p);
  bt_view_free (view);
  bt__renderer_free (r);
}

/* ---- Cameras ---- */

/* Whatever the view, the whole tube is inside the picture, and fills a good part of it.  */
static void
framing (void **state)
{
  static const double aspects[] = { 0.5, 1, 16.0 / 9, 3 };
  bt_view *view = rich_view ();
  (void)state;
  for (bt_aim aim = BT_AIM_TOP; aim <= BT_AIM_PLAN; aim++)
    for (size_t i = 0; i < sizeof aspects / sizeof *aspects; i++)
      {
        double w = 1000 * aspects[i], h = 1000, x[2], y[2];
        assert_int_equal (bt_view_aim (view, aim, aspects[i], NULL), BT_OK);
        bt__optics o = bt__optics_of (&view->camera, aspects[i]);
        for (int k = 0; k < 2; k++)
          {
            assert_int_equal (bt__project (&o, view->things[1].points[k], w, h, &x[k], &y[k]), 1);
            assert_true (x[k] > 0.02 * w && x[k] < 0.98 * w && y[k] > 0.02 * h && y[k] < 0.98 * h);
          }
        assert_true (fabs (x[0] - x[1]) > 0.25 * w || fabs (y[0] - y[1]) > 0.25 * h);
      }
  bt_view_free (view);
}

/* An arrow whose words are beside a vehicle: they cover neither it nor the anchor below it, and
   stand under the lines of the title, whichever way the arrow points.  An overview has the dive
   under the title.  */
static void
labels_make_way (void **state)
{
  enum
  {
    MOST = 96
  };
  (void)state;
  for (int i = 0; i < 12; i++)
    {
      double angle = 2 * BT__PI * i / 12, x, y;
      bt_vec3 seen[2] = { { 0, 0, -5 }, { 0.2, 0, -8 } };
      bt_thing arrow = bt_thing_of (BT_THING_ARROW), anchor = bt_thing_of (BT_THING_ANCHOR);
      bt_view *view = new_view ();
      bt__box box[MOST];
      int n, about = 0;
      add_vehicle (view, seen[0]);
      anchor.at = seen[1];
      anchor.framing = BT_FRAME_MUST;
      add (view, &anchor);
      arrow.to = bt__add (seen[0], bt__vec (0.1 * cos (angle), 0, 0.1 * sin (angle)));
      arrow.from = bt__add (seen[0], bt__vec (-cos (angle), 0, -sin (angle)));
      arrow.text = "what is said here";
      add (view, &arrow);
      view->title = "a title";
      assert_int_equal (bt_view_aim (view, BT_AIM_OVERVIEW, 16.0 / 9, NULL), BT_OK);
      bt__optics o = bt__optics_of (&view->camera, 16.0 / 9);
      n = bt__written (view, 1280, 720, 0, box, MOST);
      for (int k = 0; k < 2; k++)
        {
          assert_int_equal (bt__project (&o, seen[k], 1280, 720, &x, &y), 1);
          assert_true (y > 3.6 * 18);
          for (int b = 0; b < n; b++)
            assert_false (box[b].x < x && x < box[b].x + box[b].w && box[b].y < y
                          && y < box[b].y + box[b].h);
        }
      for (int b = 0; b < n; b++)
        about += box[b].y > 3.6 * 18 && box[b].y + box[b].h < 600;
      assert_int_equal (about, 1);
      bt_view_free (view);
    }
}

/* East is on the right when looking north, north is up from above, south on the right when looking
   east.  */
static void
directions (void **state)
{
  static const bt_aim aims[] = { BT_AIM_NORTH, BT_AIM_TOP, BT_AIM_EAST };
  static const bt_vec3 right[] = { { 1, 0, 0 }, { 1, 0, 0 }, { 0, -1, 0 } };
  static const bt_vec3 up[] = { { 0, 0, 1 }, { 0, 1, 0 }, { 0, 0, 1 } };
  bt_view *view = rich_view ();
  (void)state;
  for (int i = 0; i < 3; i++)
    {
      assert_int_equal (bt_view_aim (view, aims[i], 1, NULL), BT_OK);
      bt__optics o = bt__optics_of (&view->camera, 1);
      assert_true (bt__distance (o.right, right[i]) < 1e-12);
      assert_true (bt__distance (o.up, up[i]) < 1e-12);
    }
  bt_view_free (view);
}

/* The matrix of the shaders and the projection of the labels put a point in one place.  */
static void
matrix_and_projection (void **state)
{
  bt_view *view = rich_view ();
  (void)state;
  for (bt_aim aim = BT_AIM_CHASE; aim <= BT_AIM_OVERVIEW; aim++)
    {
      bt_vec3 p = bt__vec (9, 5, -14.3), origin = bt__vec (1, 2, -3), q = bt__sub (p, origin);
      bt__window window = { 100, 40, 500, 300 };
      double v[4], x, y;
      float m[16];
      assert_int_equal (bt_view_aim (view, aim, 4.0 / 3, NULL), BT_OK);
      bt__optics o = bt__optics_of (&view->camera, 4.0 / 3);
      o.near = 0.1;
      o.far = 500;
      bt__camera_matrix (&o, origin, 800, 600, &window, m);
      for (int i = 0; i < 4; i++)
        v[i] = (double)m[i] * q.x + (double)m[4 + i] * q.y + (double)m[8 + i] * q.z
               + (double)m[12 + i];
      if (!bt__project (&o, p, 800, 600, &x, &y))
        continue;
      assert_true (fabs (window.x + (v[0] / v[3] + 1) / 2 * window.width - x) < 0.02);
      assert_true (fabs (600 - (window.y + (v[1] / v[3] + 1) / 2 * window.height) - y) < 0.02);
    }
  bt_view_free (view);
}

static void
bad_views (void **state)
{
  static const uint32_t corner[1][3] = { { 0, 1, 2 } };
  static const bt_vec3 two[2] = { { 0, 0, 0 }, { 1, 0, 0 } };
  bt_view *view = new_view ();
  bt_thing t = bt_thing_of (BT_THING_MESH);
  bt_error error;
  (void)state;
  t.points = two;
  t.n = 2;
  t.corner = corner;
  t.triangles = 1;
  assert_int_equal (bt_view_add (view, &t, &error), BT_ERR_DOMAIN);
  t = bt_thing_of (BT_THING_SPHERE);
  t.radius = NAN;
  assert_int_equal (bt_view_add (view, &t, &error), BT_ERR_DOMAIN);
  assert_int_equal (bt_view_aim (view, BT_AIM_OVERVIEW, 1, &error), BT_ERR_DEF);
  assert_int_equal (bt_view_aim (view, BT_AIM_CHASE, 1, &error), BT_ERR_DEF);
  assert_int_equal (bt_view_aim (view, BT_AIM_COUNT, 1, &error), BT_ERR_NAME);
  assert_int_equal (bt_view_look (view, two[1], two[1], &error), BT_ERR_DOMAIN);
  assert_int_equal (view->n, 0);
  bt_view_free (view);
}

/* A camera that is carried about something stays as far from it, sees it in the middle, and never
   stands on its head.  */
static void
carried_about (void **state)
{
  bt_view *view = new_view ();
  bt_vec3 from = bt__vec (3, -10, -15), at = bt__vec (0, 2, -20);
  bt_error error;
  (void)state;
  assert_int_equal (bt_view_look (view, from, at, &error), BT_OK);
  assert_int_equal (bt_view_turn (view, 2 * BT__PI, 0, &error), BT_OK);
  assert_true (bt__distance (view->camera.from, from) < 1e-9);
  assert_int_equal (bt_view_turn (view, BT__PI, 0, &error), BT_OK);
  assert_true (bt__distance (view->camera.from, bt__vec (-3, 14, -15)) < 1e-9);
  assert_int_equal (bt_view_turn (view, 0.3, 9, &error), BT_OK);
  bt_vec3 way = bt__sub (view->camera.from, at);
  assert_true (fabs (bt__norm (way) - bt__distance (from, at)) < 1e-9);
  assert_true (fabs (way.z / bt__norm (way) - sin (85 * BT__PI / 180)) < 1e-9);
  assert_int_equal (bt_view_turn (view, 0, -9, &error), BT_OK);
  assert_true (view->camera.from.z < at.z && view->camera.up.z == 1);
  assert_true (bt__distance (view->camera.at, at) == 0);
  assert_int_equal (bt_view_turn (view, NAN, 0, &error), BT_ERR_DOMAIN);
  bt_view_free (view);
}

static void
unknown_back_end (void **state)
{
  bt__renderer *r = NULL;
  bt_error error;
  (void)state;
  assert_int_equal (bt__renderer_new ("vulkan", &r, &error), BT_ERR_NAME);
  assert_non_null (strstr (error.text, "osmesa"));
  assert_null (strchr (error.text, '\n'));
  assert_null (r);
}

/* ---- Plans and files ---- */

/* The pile is grey where it stands and nowhere else; no graphics library is asked.  */
static void
plan (void **state)
{
  bt_view *view = rich_view ();
  bt__drawing drawing = { .width = 400, .height = 300 };
  bt__picture p;
  double x, y;
  (void)state;
  assert_int_equal (bt_view_aim (view, BT_AIM_PLAN, 4.0 / 3, NULL), BT_OK);
  assert_int_equal (bt__plan (view, &drawing, &p, NULL), BT_OK);
  bt__optics o = bt__optics_of (&view->camera, 4.0 / 3);
  double ppm = 400 / (2 * o.half_width);
  bt__project (&o, bt__vec (3, 6, 0), 400, 300, &x, &y);
  for (int i = 0; i < 8; i++)
    {
      double c = cos (i * BT__PI / 4), s = sin (i * BT__PI / 4), in = 0.7 * ppm, out = 1.0 * ppm;
      uint32_t inside = pixel_at (&p, (int)(x + in * c), (int)(y + in * s));
      uint32_t outside = pixel_at (&p, (int)(x + out * c), (int)(y + out * s));
      assert_true (channel (inside, 1) >= 190 && channel (inside, 1) <= 215);
      assert_true (channel (outside, 1) > 215);
    }
  bt__picture_free (&p);
  bt_view_free (view);
}

static void
files (void **state)
{
  bt__picture p;
  bt_error error;
  char name[] = "/tmp/bight-render-XXXXXX", head[8] = "";
  int fd = mkstemp (name);
  FILE *file;
  (void)state;
  assert_true (fd >= 0);
  close (fd);
  assert_int_equal (bt__picture_new (&p, 20, 30, &error), BT_OK);
  assert_int_equal (bt__picture_write (&p, name, &error), BT_OK);
  file = fopen (name, "rb");
  assert_int_equal (fread (head, 1, 8, file), 8);
  fclose (file);
  assert_memory_equal (head, "\211PNG\r\n\032\n", 8);
  assert_int_equal (bt__picture_write (&p, "/nowhere/at/all.png", &error), BT_ERR_IO);
  assert_non_null (strstr (error.text, "/nowhere/at/all.png"));
  if (access ("/dev/full", W_OK) == 0)
    {
      assert_int_equal (bt__picture_write (&p, "/dev/full", &error), BT_ERR_IO);
      assert_int_equal (access ("/dev/full", F_OK), 0);
    }
  unlink (name);
  bt__picture_free (&p);
}

/* What stands beside the dive is in the picture, though it is further off than the dive is large;
   what is far away is not.  */
static void
beside_the_dive (void **state)
{
  (void)state;
  for (int i = 0; i < 2; i++)
    {
      bt_view *view = new_view ();
      double away = i ? 500 : 6;
      bt__optics o;
      double x, y;
      add_tube (view, bt__vec (-4, 0, -5), bt__vec (4, 0, -5), 0.01);
      add_box (view, bt__vec (0, away, -5), 2, (bt_color){ 1, 0, 0 });
      assert_int_equal (bt_view_aim (view, BT_AIM_TOP, 1.5, NULL), BT_OK);
      o = bt__optics_of (&view->camera, 1.5);
      bt__project (&o, bt__vec (0, away, -5), 600, 400, &x, &y);
      assert_int_equal (y > 0 && y < 400, !i);
      bt_view_free (view);
    }
}

/* A lid over a dive, of any thing that hides: the camera goes where it sees the dive.  */
static void
under_a_lid (void **state)
{
  static const bt_thing_kind kinds[] = { BT_THING_BOX, BT_THING_SPHERE, BT_THING_MESH };
  (void)state;
  for (int i = 0; i < 3; i++)
    {
      static const bt_vec3 corner[4]
          = { { -60, -60, 0 }, { 60, -60, 0 }, { 60, 60, 0 }, { -60, 60, 0 } };
      static const uint32_t both[2][3] = { { 0, 1, 2 }, { 0, 2, 3 } };
      bt_view *view = new_view ();
      bt_thing lid = bt_thing_of (kinds[i]);
      bt_vec3 way;
      lid.at = bt__vec (0, 0, i == 1 ? 18 : -2);
      lid.size = bt__vec (120, 120, 2);
      lid.radius = 20;
      lid.points = corner;
      lid.n = i == 2 ? 4 : 0;
      lid.corner = both;
      lid.triangles = i == 2 ? 2 : 0;
      add (view, &lid);
      add_tube (view, bt__vec (-2, 0, -5), bt__vec (2, 1, -6), 0.01);
      assert_int_equal (bt_view_aim (view, BT_AIM_OVERVIEW, 1.5, NULL), BT_OK);
      way = bt__sub (view->camera.from, bt__vec (0, 0.5, -5.5));
      if (i != 1) /* a ball hides little from aside */
        assert_true (view->camera.from.z < -2);
      assert_true (bt__norm (way) > 1);
      assert_false (bt__hidden (view, view->camera.from, bt__vec (0, 0.5, -5.5)));
      bt_view_free (view);
    }
}

/* What is read back is what was written, opaque or not, for any colours and sizes.  */
static void
read_back (void **state)
{
  char name[] = "/tmp/bight-render-XXXXXX";
  int fd = mkstemp (name);
  uint32_t seed = 1;
  (void)state;
  assert_true (fd >= 0);
  close (fd);
  for (int i = 0; i < 40; i++)
    {
      bt__picture p;
      cairo_surface_t *s;
      assert_int_equal (bt__picture_new (&p, 16 + i, 56 - i, NULL), BT_OK);
      for (int k = 0; k < p.width * p.height; k++)
        {
          uint32_t a = (seed = seed * 1664525u + 1013904223u) >> 24, pixel;
          a = i & 1 ? a : 255; /* every other picture is opaque */
          pixel = a << 24 | (seed >> 16 & 255) * a / 255 << 16 | (seed >> 8 & 255) * a / 255 << 8;
          p.pixels[k] = pixel | (seed & 255) * a / 255;
        }
      assert_int_equal (bt__picture_write (&p, name, NULL), BT_OK);
      s = cairo_image_surface_create_from_png (name);
      assert_int_equal (cairo_surface_status (s), CAIRO_STATUS_SUCCESS);
      assert_int_equal (cairo_image_surface_get_width (s), p.width);
      assert_int_equal (cairo_image_surface_get_height (s), p.height);
      for (int y = 0; y < p.height; y++)
        for (int x = 0; x < p.width; x++)
          {
            uint32_t got, want = p.pixels[y * p.width + x];
            memcpy (&got,
                    cairo_image_surface_get_data (s) + y * cairo_image_surface_get_stride (s)
                        + 4 * x,
                    4);
            assert_int_equal (got & (i & 1 ? 0xffffffff : 0xffffff),
                              want & (i & 1 ? 0xffffffff : 0xffffff));
          }
      cairo_surface_destroy (s);
      bt__picture_free (&p);
    }
  unlink (name);
}

/* A post and a ball get no more triangles when they are farther away; return how many they get at
   all distances, QUICK or not.  */
static size_t
triangles_grow_rarer (int quick)
{
  size_t last = SIZE_MAX, first = 0, all = 0;
  for (double away = 1; away < 2000; away *= 2)
    {
      bt__soup soup = { .n = 0 };
      soup.lens = (bt__lens){ { 0, -away, 0 }, { 0, 1, 0 }, 0.001, 1, 720, quick };
      bt__add_cone (&soup, bt__vec (0, 0, 0), bt__vec (0, 0, 1), 0.3, 0.3, 1);
      bt__add_sphere (&soup, bt__vec (0, 0, 0), 0.3);
      assert_true (soup.n_index <= last && soup.n_index >= 3 * (quick ? 4 : 8));
      last = soup.n_index;
      first = first ? first : last;
      all += last;
      bt__soup_free (&soup);
    }
  assert_true (last < first / (quick ? 4 : 10));
  return all;
}

/* What is smaller in the picture is drawn with fewer triangles, down to what still looks round; in
   a quick picture with fewer yet.  */
static void
small_is_cheap (void **state)
{
  (void)state;
  assert_true (10 * triangles_grow_rarer (1) < 7 * triangles_grow_rarer (0));
}

/* Corners of triangles of a post about the z axis from LOW to HIGH, Y ahead of the camera.  */
static size_t
corners_of_post (double y, double low, double high)
{
  bt__soup soup = { .n = 0 };
  size_t n;
  soup.lens = (bt__lens){ { 0, -y, 0 }, { 0, 1, 0 }, 0.001, 1, 720, 0 };
  bt__add_cone (&soup, bt__vec (0, 0, low), bt__vec (0, 0, high), 0.05, 0.05, 0);
  n = soup.n_index;
  bt__soup_free (&soup);
  return n;
}

/* A post behind the camera has as few triangles as one far ahead, not as many as one at the lens; a
   long post that passes near is as round there as a short one.  */
static void
beside_and_behind (void **state)
{
  (void)state;
  assert_true (corners_of_post (-10, -1, 1) <= corners_of_post (5, -1, 1));
  assert_true (3 * corners_of_post (-50, -1, 1) < corners_of_post (0.5, -1, 1));
  assert_int_equal (corners_of_post (0.5, -30, 60), corners_of_post (0.5, -1, 1));
}

int
main (void)
{
  const struct CMUnitTest tests[] = {
    cmocka_unit_test (thin_far_tube),
    cmocka_unit_test (fog),
    cmocka_unit_test (nearer_hides),
    cmocka_unit_test (same_bytes),
    cmocka_unit_test (tiles),
    cmocka_unit_test (back_ends_agree),
    cmocka_unit_test (sizes),
    cmocka_unit_test (transparent),
    cmocka_unit_test (framing),
    cmocka_unit_test (labels_make_way),
    cmocka_unit_test (directions),
    cmocka_unit_test (bad_views),
    cmocka_unit_test (carried_about),
    cmocka_unit_test (matrix_and_projection),
    cmocka_unit_test (unknown_back_end),
    cmocka_unit_test (plan),
    cmocka_unit_test (files),
    cmocka_unit_test (beside_the_dive),
    cmocka_unit_test (under_a_lid),
    cmocka_unit_test (read_back),
    cmocka_unit_test (small_is_cheap),
    cmocka_unit_test (beside_and_behind),
  };
  return cmocka_run_group_tests (tests, NULL, NULL);
}
