/* What a forward-looking sonar shows: a fan of echoes, range upward from the vehicle, bearing to
   either side.

   An imaging sonar hears no elevation: all that comes back from one bearing and one range falls on
   one spot.  Each beam is therefore cast at several tilts over the vertical aperture, and every
   first echo adds to the spot of its range, by the cosine of the incidence, which follows from the
   ranges of neighbouring tilts.  A bed seen at a flat angle lies between the ranges of two tilts:
   the echo is spread over all of them.  Behind the last echo there is shadow.  Tethers
   echo where nothing solid is before them.  Grain is the hash of the spot and the step: equal dives
   give equal pictures.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/error.h"
#include "math/vec.h"
#include "render/sonar.h"
#include "render/text.h"

#define DEGREE (BT__PI / 180)

enum
{
  BEAMS = 384,
  TILTS = 24,
  BINS = 512 /* along a beam */
};

static const double sector = 130 * DEGREE, aperture = 20 * DEGREE;

typedef struct fan
{
  const bt_dive *dive;
  int vehicle;
  double range;           /* m */
  bt_vehicle_view state;  /* of the vehicle */
  bt_vec3 axis[3];        /* its own: starboard, ahead, up */
  bt_vec3 head;           /* of the sonar */
  double (*reach)[TILTS]; /* m: of the first echo, for each beam */
  float (*echo)[BINS];    /* for each beam: how loud what comes back is */
} fan;

static double
row_tilt (int t)
{
  return aperture * ((t + 0.5) / TILTS - 0.5);
}

/* ---- Echoes ---- */

/* Beyond the range too: whether a tilt near its end meets a bed shows in the tilts beside it.  */
static bt_status
cast (fan *f, bt_error *error)
{
  double range[BEAMS];
  bt_status status = BT_OK;
  for (int t = 0; status == BT_OK && t < TILTS; t++)
    {
      bt_sonar sonar
          = { .sector = sector, .tilt = row_tilt (t), .range = 3 * f->range, .beams = BEAMS };
      status = bt_dive_sonar (f->dive, f->vehicle, &sonar, range, error);
      for (int b = 0; status == BT_OK && b < BEAMS; b++)
        f->reach[b][t] = range[b];
    }
  return status;
}

/* An echo at RANGE on BEAM, spread over the bins about its own.  */
static void
add_echo (fan *f, int beam, double range, double loud)
{
  double at = range / f->range * BINS;
  for (int i = (int)at - 2; i <= (int)at + 2; i++)
    if (beam >= 0 && beam < BEAMS && i >= 0 && i < BINS)
      f->echo[beam][i] += (float)(loud * exp (-0.6 * (i + 0.5 - at) * (i + 0.5 - at)));
}

/* The cosine of the incidence, by how the range changes from one tilt to the next.  */
static double
incidence (const double reach[TILTS], int t)
{
  int a = t > 0 ? t - 1 : t, b = t + 1 < TILTS ? t + 1 : t;
  double slope = (reach[b] - reach[a]) / ((b - a) * aperture / TILTS * reach[t]);
  return isfinite (slope) ? 1 / sqrt (1 + slope * slope) : 0.5;
}

/* True if tilt T and the next hit one flat surface: there, the inverse of the range is nearly
   linear in the tilt, so it is for a tilt beside the two.  */
static int
is_one_surface (const double reach[TILTS], int t)
{
  double step = fabs (1 / reach[t] - 1 / reach[t + 1]);
  for (int k = t - 1; k <= t; k++)
    if (k >= 0 && k + 2 < TILTS
        && fabs (1 / reach[k] - 2 / reach[k + 1] + 1 / reach[k + 2]) < 0.15 * step)
      return 1;
  return 0;
}

/* True if the echo of tilt T on BEAM is spread up to that of the next tilt.  */
static int
is_spread (const fan *f, int beam, int t)
{
  const double *reach = f->reach[beam];
  enum
  {
    APART = 3 /* bins that a single echo fills */
  };
  return t >= 0 && t + 1 < TILTS && fmax (reach[t], reach[t + 1]) <= 3 * f->range
         && fmin (reach[t], reach[t + 1]) <= f->range
         && fabs (reach[t + 1] - reach[t]) > APART * f->range / BINS && is_one_surface (reach, t);
}

/* An echo over all ranges from A to B on BEAM, together as loud as a single one.  */
static void
spread_echo (fan *f, int beam, double a, double b, double loud)
{
  static const double single = 2.3; /* bins: the sum of the weights of add_echo */
  double low = fmin (a, b) / f->range * BINS, high = fmax (a, b) / f->range * BINS;
  for (int i = (int)low; i < BINS && i < high; i++)
    f->echo[beam][i]
        += (float)(loud * single * (fmin (i + 1, high) - fmax (i, low)) / (high - low));
}

static void
gather_beam (fan *f, int b)
{
  static const double loud = 2.2 / TILTS * 6;
  for (int t = 0; t < TILTS; t++)
    if (is_spread (f, b, t))
      spread_echo (f, b, f->reach[b][t], f->reach[b][t + 1], loud);
    else if (f->reach[b][t] <= f->range && !is_spread (f, b, t - 1))
      add_echo (f, b, f->reach[b][t], loud * incidence (f->reach[b], t));
}

static void
gather_echoes (fan *f)
{
  for (int b = 0; b < BEAMS; b++)
    gather_beam (f, b);
}

/* True if nothing solid is before a point at RANGE on BEAM with TILT.  */
static int
is_heard (const fan *f, double beam, double tilt, double range)
{
  int b = (int)lround (beam), t = (int)lround ((tilt / aperture + 0.5) * TILTS - 0.5);
  return b >= 0 && b < BEAMS && t >= 0 && t < TILTS && !(f->reach[b][t] < range - 0.05);
}

static void
add_line_point (fan *f, bt_vec3 p, double loud)
{
  bt_vec3 d = bt__sub (p, f->head);
  double ahead = bt__dot (d, f->axis[1]), range = bt__norm (d);
  double tilt = atan2 (bt__dot (d, f->axis[2]), ahead);
  double beam = (asin (bt__dot (d, f->axis[0]) / fmax (range, 1e-9)) / sector + 0.5) * (BEAMS - 1);
  if (ahead > 0 && range <= f->range && is_heard (f, beam, tilt, range))
    add_echo (f, (int)lround (beam), range, loud);
}

/* A thin line echoes weakly, wherever on it.  */
static void
add_tethers (fan *f)
{
  enum
  {
    POINTS = 2001
  };
  bt_vec3 *p = malloc (POINTS * sizeof *p);
  for (int i = 0; p && i < bt_dive_count (f->dive, BT_PART_TETHER); i++)
    if (bt_tether_points (f->dive, i, POINTS, p, NULL) == BT_OK)
      for (int k = 0; k < POINTS; k++)
        add_line_point (f, p[k], 0.35);
  free (p);
}

/* ---- The picture ---- */

/* From 0 to 1, by the hash of two whole numbers.  */
static double
grain (uint32_t x, uint32_t y)
{
  uint32_t h = x * 374761393U + y * 668265263U;
  h = (h ^ (h >> 13)) * 1274126177U;
  return ((h ^ (h >> 16)) & 0xffffU) / 65535.0;
}

/* Black, copper, white.  */
static uint32_t
shade (double loud)
{
  double v = 1 - exp (-1.4 * loud);
  int r = (int)(255 * fmin (1, 1.35 * v)), g = (int)(255 * v * (0.55 + 0.4 * v));
  int b = (int)(255 * v * v * 0.75);
  return 0xff000000U | (uint32_t)r << 16 | (uint32_t)g << 8 | (uint32_t)b;
}

/* Where the fan stands in a picture: its apex, and pixels of the whole range.  */
typedef struct place
{
  double x, y, radius;
} place;

static place
fan_place (const bt__picture *p)
{
  double room = 0.86 * p->height, wide = 0.47 * p->width / sin (sector / 2);
  double radius = room < wide ? room : wide;
  return (place){ p->width / 2.0, 0.5 * (p->height + radius) + 0.02 * p->height, radius };
}

static uint32_t
pixel_at (const fan *f, const place *at, int x, int y, uint32_t step)
{
  double dx = x + 0.5 - at->x, dy = at->y - y - 0.5, r = hypot (dx, dy) / at->radius;
  double beam = (atan2 (dx, dy) / sector + 0.5) * BEAMS;
  uint32_t b, bin;
  if (r >= 1 || beam < 0 || beam >= BEAMS)
    return 0xff0a0d10U;
  b = (uint32_t)beam;
  bin = (uint32_t)(r * BINS);
  return shade ((0.09 + (double)f->echo[b][bin]) * (0.55 + 0.9 * grain (b + (step << 9), bin)));
}

static void
paint_fan (const fan *f, bt__picture *p)
{
  place at = fan_place (p);
  uint32_t step = (uint32_t)lround (bt_dive_time (f->dive) * 10);
  for (int y = 0; y < p->height; y++)
    for (int x = 0; x < p->width; x++)
      p->pixels[(size_t)y * (size_t)p->width + (size_t)x] = pixel_at (f, &at, x, y, step);
}

static void
write_ring (bt__pen *pen, const place *at, double share, double range)
{
  char text[40];
  double x = at->x + at->radius * share * sin (sector / 2);
  double y = at->y - at->radius * share * cos (sector / 2);
  cairo_arc (pen->cr, at->x, at->y, at->radius * share, -BT__PI / 2 - sector / 2,
             -BT__PI / 2 + sector / 2);
  cairo_set_source_rgba (pen->cr, 0.6, 0.9, 0.7, 0.45);
  cairo_set_line_width (pen->cr, fmax (0.7, 0.04 * pen->letter));
  cairo_stroke (pen->cr);
  snprintf (text, sizeof text, "%.3g m", range);
  bt__pen_text (pen, x + 0.4 * pen->letter, y + 0.9 * pen->letter, 0, text);
}

static void
write_bearing (bt__pen *pen, const place *at, double bearing)
{
  char text[40];
  double r = at->radius + 0.5 * pen->letter;
  snprintf (text, sizeof text, bearing == 0 ? "%.0f\xc2\xb0" : "%+.0f\xc2\xb0", bearing / DEGREE);
  cairo_move_to (pen->cr, at->x, at->y);
  cairo_line_to (pen->cr, at->x + at->radius * sin (bearing), at->y - at->radius * cos (bearing));
  cairo_set_source_rgba (pen->cr, 0.6, 0.9, 0.7, 0.25);
  cairo_set_line_width (pen->cr, fmax (0.7, 0.04 * pen->letter));
  cairo_stroke (pen->cr);
  bt__pen_text (pen, at->x + r * sin (bearing), at->y - r * cos (bearing), 0.5, text);
}

static bt_status
write_on (const fan *f, bt__picture *picture, const char *title, bt_error *error)
{
  place at = fan_place (picture);
  double step = bt__round_step (f->range / 3);
  bt__pen pen;
  bt_status status = bt__pen_open (&pen, picture, 0, error);
  if (status != BT_OK)
    return status;
  for (double r = step; r < 1.001 * f->range; r += step)
    write_ring (&pen, &at, r / f->range, r);
  for (int k = -2; k <= 2; k++)
    write_bearing (&pen, &at, k * 30 * DEGREE);
  bt__pen_text (&pen, 1.2 * pen.letter, 1.9 * pen.letter, 0, title);
  return bt__pen_close (&pen, error);
}

static int
have_fan (fan *f)
{
  f->reach = calloc (BEAMS, sizeof *f->reach);
  f->echo = calloc (BEAMS, sizeof *f->echo);
  return f->reach && f->echo;
}

static bt_status
draw_fan (fan *f, const bt__drawing *d, int figures, const char *title, bt__picture *picture,
          bt_error *error)
{
  bt_status status = bt__picture_new (picture, d->width, d->height, error);
  if (status != BT_OK)
    return status;
  gather_echoes (f);
  add_tethers (f);
  paint_fan (f, picture);
  return figures ? write_on (f, picture, title, error) : BT_OK;
}

bt_status
bt__sonar_picture (const bt_dive *dive, int vehicle, double range, const char *title, int figures,
                   const bt__drawing *d, bt__picture *picture, bt_error *error)
{
  fan f = { .dive = dive, .vehicle = vehicle, .range = range };
  bt_status status;
  if (bt_dive_count (dive, BT_PART_VEHICLE) <= vehicle)
    return bt__fail (
        error, BT_ERR_DEF,
        "the view sonar is a vehicle's, and this dive has none: give its world one, as "
        "in (rov (named minnow) (at 0 0 -5))");
  status = bt_dive_vehicle (dive, vehicle, &f.state, error);
  if (status == BT_OK && !have_fan (&f))
    status = bt__fail (error, BT_ERR_LIMIT, "there is no memory left for the picture");
  bt_body_axes (f.state.heading, f.state.pitch, f.state.roll, f.axis);
  f.head = bt__axpy (f.state.position, f.state.size.y / 2, f.axis[1]);
  if (status == BT_OK)
    status = cast (&f, error);
  if (status == BT_OK)
    status = draw_fan (&f, d, figures, title, picture, error);
  free (f.reach);
  free (f.echo);
  return status;
}
