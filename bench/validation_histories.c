/* Tensions over time: a jumper swung and in waves, a chain heaved on the bottom.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "testbed/outside.h"
#include "validation.h"

/* ---- Misses ---- */

typedef struct miss
{
  double rms, most, at; /* at: the moment of the most */
} miss;

/* Ours less theirs from FROM on until UNTIL.  */
static miss
miss_of (const outside_history *h, double from, double until)
{
  miss m = { 0, 0, 0 };
  int count = 0;
  for (int k = 0; k < h->rows; k++)
    if (h->t[k] >= from && h->t[k] < until)
      {
        double off = fabs (h->ours[k] - h->theirs[k]);
        m.rms += off * off;
        m.at = off > m.most ? h->t[k] : m.at;
        m.most = fmax (m.most, off);
        count++;
      }
  m.rms = sqrt (m.rms / count);
  return m;
}

static void
draw_history (validation *v, const char *name, const char *axes, const char *theirs,
              const outside_history *h)
{
  for (int k = 0; k < h->rows; k++)
    validation_point (v, name, axes, "bight", h->t[k], h->ours[k]);
  for (int k = 0; k < h->rows; k++)
    validation_point (v, name, axes, theirs, h->t[k], h->theirs[k]);
}

/* What two runs of ours differ by, a third of it: rms and at most.  */
static miss
own_of (const outside_history *fine, const outside_history *coarse)
{
  static outside_history both;
  both = *fine;
  memcpy (both.theirs, coarse->ours, sizeof both.theirs);
  miss m = miss_of (&both, -HUGE_VAL, HUGE_VAL);
  return (miss){ m.rms / 3, m.most / 3, m.at };
}

/* Theirs in H against the same PERIOD seconds later, from FROM on until UNTIL.  */
static miss
not_periodic (const outside_history *h, double period, double from, double until)
{
  static outside_history shifted;
  int by = (int)lround (period * (h->rows - 1) / (h->t[h->rows - 1] - h->t[0]));
  shifted = *h;
  shifted.rows = h->rows - by > 0 ? h->rows - by : 0;
  memcpy (shifted.ours, h->theirs + by, (size_t)shifted.rows * sizeof *h->theirs);
  return miss_of (&shifted, from, until);
}

/* Theirs in H between its rows, at T.  */
static double
theirs_at (const outside_history *h, double t)
{
  double u = (t - h->t[0]) / (h->t[h->rows - 1] - h->t[0]) * (h->rows - 1);
  int k = (int)fmin (fmax (u, 0), h->rows - 2);
  return h->theirs[k] + (u - k) * (h->theirs[k + 1] - h->theirs[k]);
}

/* Ours less theirs from FROM on, theirs moved by *BY seconds, where the rms is least: what is left
   if their time is misread.  */
static miss
moved (const outside_history *h, double from, double *by)
{
  static outside_history late;
  miss best = { HUGE_VAL, 0, 0 };
  for (int i = -100; i <= 100; i++)
    {
      late = *h;
      for (int k = 0; k < h->rows; k++)
        late.theirs[k] = theirs_at (h, h->t[k] - 0.01 * i);
      miss m = miss_of (&late, from + 1, h->t[h->rows - 1] - 1);
      *by = m.rms < best.rms ? 0.01 * i : *by;
      best = m.rms < best.rms ? m : best;
    }
  return best;
}

/* ---- Lowe and Langley ---- */

#define DIGITISED 0.1 /* kN: how well their curves could be read */

/* The amplitude of harmonic K of Y over the first PERIOD of H from START on.  */
static double
harmonic (const outside_history *h, const double *y, int k, double start, double period)
{
  double c = 0, s = 0;
  int n = 0;
  for (int i = 0; i < h->rows; i++)
    if (h->t[i] >= start && h->t[i] < start + period - 1e-6)
      {
        double angle = 2 * BT__PI * k * h->t[i] / period;
        c += y[i] * cos (angle);
        s += y[i] * sin (angle);
        n++;
      }
  return 2 * hypot (c, s) / n;
}

static void
put_harmonics (validation *v, const char *name, double start, double period,
               const outside_history *h)
{
  for (int k = 1; k <= 2; k++)
    {
      char setting[48];
      double theirs = harmonic (h, h->theirs, k, start, period);
      snprintf (setting, sizeof setting, "harmonic %d, theirs of %.2f kN", k, theirs);
      validation_varied (v, name, setting, "difference kN",
                         fabs (harmonic (h, h->ours, k, start, period) - theirs),
                         "Lowe and Langley 2006");
    }
}

/* Case WHICH, flown as H, with theirs moved in time, and with less drag.  */
static void
vary_jumper (validation *v, int which, const char *name, double start, const outside_history *h)
{
  static outside_history other;
  const char *by = "Lowe and Langley 2006";
  char setting[32];
  double shift = 0;
  miss left = moved (h, start, &shift);
  snprintf (setting, sizeof setting, "theirs moved by %+.2f s", shift);
  validation_varied (v, name, setting, "rms kN", left.rms, by);
  validation_varied (v, name, setting, "largest kN", left.most, by);
  if (!v->quick && outside_jumper (which, 160, 0.9, &other) == OUTSIDE_DONE)
    validation_varied (v, name, "Cd 0.9", "rms kN", miss_of (&other, start, HUGE_VAL).rms, by);
}

static void
swing_jumper (validation *v, int which)
{
  static outside_history coarse, h;
  const double period = which == 6 ? 10 : 27, start = which == 6 ? 10 : 3;
  const char *by = "Lowe and Langley 2006", *axes = "top tension kN over time s";
  char name[24], file[60], early[32];
  snprintf (name, sizeof name, "jumper-%d", which);
  snprintf (file, sizeof file, "published/lowe_langley_2006_case%d.csv", which);
  snprintf (early, sizeof early, "the first %g s", start);
  if (!validation_counts (v, name, outside_jumper (which, 160, 1, &h), file)
      || outside_jumper (which, 80, 1, &coarse) != OUTSIDE_DONE)
    return;
  miss later = miss_of (&h, start, HUGE_VAL), first = miss_of (&h, -HUGE_VAL, start);
  miss own = own_of (&h, &coarse), strange = not_periodic (&h, period, -HUGE_VAL, start),
       repeats = not_periodic (&h, period, start, HUGE_VAL);
  validation_row (v, name, "at rest", "force at the top, kN off",
                  hypot (h.rest[0] - 11.40, h.rest[1] - 45.71), by, 0.01, NAN);
  validation_row (v, name, "after that", "rms kN", later.rms, by, fmax (DIGITISED, repeats.rms),
                  own.rms);
  validation_row (v, name, "after that", "largest kN", later.most, by,
                  fmax (DIGITISED, repeats.most), own.most);
  validation_row (v, name, early, "largest kN", first.most, by, fmax (DIGITISED, strange.most),
                  own.most);
  put_harmonics (v, name, start, period, &h);
  vary_jumper (v, which, name, start, &h);
  draw_history (v, name, axes, by, &h);
}

/* ---- OrcaFlex ---- */

enum
{
  CHAIN = 164 /* intervals */
};

#define LINKS (3.35 * 0.14) /* m */

/* What is not said of the reference, otherwise.  */
static const struct
{
  const char *name;
  outside_bottom bottom;
} bottoms[] = {
  { "bottom three times as stiff", { CHAIN, 3e5, 3e4, 1 / BT__PI, 0, LINKS } },
  { "bottom a third as stiff", { CHAIN, 3.3e4, 3.3e3, 1 / BT__PI, 0, LINKS } },
  { "damping of the bottom a half", { CHAIN, 1e5, 5e3, 1 / BT__PI, 0, LINKS } },
  { "axial drag pi times", { CHAIN, 1e5, 1e4, 1, 0, LINKS } },
  { "friction 0.5", { CHAIN, 1e5, 1e4, 1 / BT__PI, 0.5, LINKS } },
  { "touching with its volume's diameter", { CHAIN, 1e5, 1e4, 1 / BT__PI, 0, 0.252 } },
};

static void
vary_bottom (validation *v, int which, const char *name)
{
  static outside_history h;
  for (size_t k = 0; k < sizeof bottoms / sizeof *bottoms && !v->quick; k++)
    if (outside_chain (which, &bottoms[k].bottom, &h) == OUTSIDE_DONE)
      validation_varied (v, name, bottoms[k].name, "largest kN",
                         miss_of (&h, -HUGE_VAL, HUGE_VAL).most, "OrcaFlex");
}

/* The largest difference as a share of their own tension at the moment, and theirs then.  */
static double
worst_share (const outside_history *h, double *theirs)
{
  double worst = 0;
  for (int k = 0; k < h->rows; k++)
    if (fabs (h->ours[k] / h->theirs[k] - 1) > worst)
      {
        worst = fabs (h->ours[k] / h->theirs[k] - 1);
        *theirs = h->theirs[k];
      }
  return worst;
}

static void
heave_chain (validation *v, int which)
{
  static outside_history h, coarse;
  outside_bottom half = outside_plain_bottom;
  char name[24], file[60], lowest[48];
  double theirs = 0;
  snprintf (name, sizeof name, "orcaflex-a%d", which);
  snprintf (file, sizeof file, "published/orcaflex_WD0050_ZZP1_A%d.csv", which);
  if (!validation_counts (v, name, outside_chain (which, &outside_plain_bottom, &h), file))
    return;
  half.intervals /= 2;
  if (outside_chain (which, &half, &coarse) != OUTSIDE_DONE)
    return;
  miss m = miss_of (&h, -HUGE_VAL, HUGE_VAL), own = own_of (&h, &coarse);
  double worst = worst_share (&h, &theirs);
  snprintf (lowest, sizeof lowest, "worst, where theirs is %.0f kN", theirs);
  validation_row (v, name, "at rest, fairlead", "share of 991.6 kN", fabs (h.rest[0] / 991.6 - 1),
                  "OrcaFlex", 0, NAN);
  validation_row (v, name, "at rest, anchor", "share of 826.2 kN", fabs (h.rest[1] / 826.2 - 1),
                  "OrcaFlex", 0, NAN);
  validation_row (v, name, "164 intervals", "rms kN", m.rms, "OrcaFlex", 0, own.rms);
  validation_row (v, name, "164 intervals", "largest kN", m.most, "OrcaFlex", 0, own.most);
  validation_row (v, name, lowest, "share of theirs", worst, "OrcaFlex", 0, NAN);
  vary_bottom (v, which, name);
  draw_history (v, name, "fairlead tension kN over time s", "OrcaFlex", &h);
}

/* ---- All of them ---- */

void
validation_histories (validation *v)
{
  swing_jumper (v, 1);
  swing_jumper (v, 2);
  swing_jumper (v, 6);
  heave_chain (v, 1);
  heave_chain (v, 2);
}
