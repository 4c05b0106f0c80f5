/* Bytes as the text of an ESRI ASCII grid.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "mesh/grid.h"
#include "targets.h"

static void
check (const bt_heights *h)
{
  fuzz_check (h->nx >= 2 && h->ny >= 2 && h->nx * h->ny <= BT_HEIGHTS_POSTS_MAX);
  fuzz_check (isfinite (h->x) && isfinite (h->y) && h->dx > 0 && h->dy > 0);
  size_t known = 0;
  for (size_t i = 0; i < h->nx * h->ny; i++)
    {
      fuzz_check (isnan (h->z[i]) || fabs (h->z[i]) <= 1e5);
      known += !isnan (h->z[i]);
    }
  fuzz_check (known > 0);
}

void
fuzz_mesh_grid (const uint8_t *bytes, size_t n)
{
  bt_heights_data *data;
  bt_error e;
  char *text = malloc (n + 1);
  if (!text)
    return;
  memcpy (text, bytes, n);
  text[n] = '\0';
  bt_status s = bt__grid_parse ("grid", text, n, &data, &e);
  fuzz_check ((s == BT_OK) == (data != NULL));
  if (data)
    check (&data->heights);
  else
    fuzz_check (memchr (e.text, '\0', sizeof e.text) != NULL);
  bt_heights_data_free (data);
  free (text);
}
