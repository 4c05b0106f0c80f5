/* A C11 program that uses the engine as an installed library is used.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <bight/bight.h>

#include <math.h>
#include <stdio.h>
#include <string.h>

int
main (void)
{
  bt_error error;
  bt_catenary c;

  /* A symmetric line of 10 m across 6 m: 2 a sinh (h / 2a) = s.  */
  if (bt_catenary_solve (6.0, 0.0, 10.0, &c, &error) != BT_OK)
    {
      fprintf (stderr, "consumer: %s\n", error.text);
      return 1;
    }
  double length = 2.0 * c.a * sinh (3.0 / c.a);
  bt_point2 end = bt_catenary_point (&c, 10.0);
  if (fabs (length - 10.0) > 1e-9 || hypot (end.x - 6.0, end.y) > 1e-9)
    {
      fprintf (stderr, "consumer: length %.12g, end (%.12g, %.12g)\n", length, end.x, end.y);
      return 1;
    }

  /* A mistake is a value, and leaves its reason.  */
  bt_status status = bt_catenary_solve (-1.0, 0.0, 10.0, &c, &error);
  if (status != BT_ERR_DOMAIN || strcmp (bt_status_name (status), "domain") != 0 || !error.text[0])
    {
      fprintf (stderr, "consumer: a negative distance gave `%s'\n", bt_status_name (status));
      return 1;
    }
  printf ("bight %s\n", bt_version ());
  return 0;
}
