/* Colours for numbers.

   From violet to yellow, after `plasma': lightness rises evenly, so the scale can be read by the
   colour-blind and in grey.  The scale begins bright enough and has none of the colours of water.
   Words get the colours of Okabe and Ito (2008).

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <math.h>

#include "render/soup.h"

static bt_color
mix (bt_color a, bt_color b, double t)
{
  float k = (float)t;
  return (bt_color){ a.r + k * (b.r - a.r), a.g + k * (b.g - a.g), a.b + k * (b.b - a.b) };
}

/* From STOP[0] to STOP[LAST].  */
static bt_color
among (const bt_color *stop, int last, double t)
{
  double x = fmin (fmax (t, 0), 1) * last;
  int i = x < last ? (int)x : last - 1;
  return mix (stop[i], stop[i + 1], x - i);
}

/* Of what is told of a tether.  */
static bt_color
warm (double t)
{
  static const bt_color stop[]
      = { { 0.700F, 0.230F, 0.800F }, { 0.835F, 0.290F, 0.680F }, { 0.925F, 0.380F, 0.530F },
          { 0.975F, 0.500F, 0.380F }, { 0.995F, 0.640F, 0.250F }, { 0.990F, 0.795F, 0.210F },
          { 0.960F, 0.970F, 0.330F } };
  return among (stop, sizeof stop / sizeof *stop - 1, t);
}

/* Of what is told of the water: no colour that a tether has.  */
static bt_color
cool (double t)
{
  static const bt_color stop[]
      = { { 0.10F, 0.22F, 0.55F }, { 0.20F, 0.50F, 0.85F }, { 0.45F, 0.80F, 0.95F }, { 1, 1, 1 } };
  return among (stop, sizeof stop / sizeof *stop - 1, t);
}

static bt_color
word_color (int i)
{
  static const bt_color colors[]
      = { { 0.902F, 0.624F, 0 },   { 0.337F, 0.706F, 0.914F }, { 0.941F, 0.894F, 0.259F },
          { 0, 0.620F, 0.451F },   { 0.8F, 0.475F, 0.655F },   { 0.835F, 0.369F, 0 },
          { 0.95F, 0.95F, 0.95F }, { 0, 0.447F, 0.698F } };
  return colors[(unsigned)i % (sizeof colors / sizeof *colors)];
}

bt_color
bt__scale_color (const bt_scale *scale, double value)
{
  double range = scale->high - scale->low, t = range > 0 ? (value - scale->low) / range : 0;
  if (scale->word)
    return word_color ((int)lround (value));
  return scale->cool ? cool (t) : warm (t);
}
