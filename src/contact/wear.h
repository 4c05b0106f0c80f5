/* Wear of a tether's jacket, in spots along the material.

   The friction work of a sliding contact wears the jacket at the contact (J. F. Archard, J. Appl.
   Phys. 24, 1953: the worn volume is proportional to load times sliding distance, the friction work
   over mu).  Spots are indexed by the distance from the far end, unchanged by the winch: line on
   the drum keeps its wear.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#ifndef BT_CONTACT_WEAR_H
#define BT_CONTACT_WEAR_H

/* The spots: J of slip work per metre of each, N of them, WIDTH metres of rest length long.  */
typedef struct bt__wear
{
  double *spot;
  int n;
  double width;
} bt__wear;

/* The place and length of the spots of a tether that is LENGTH metres long when a dive begins: of a
   tenth of a metre, and longer where so many would be too many; there are enough for twice the
   length, beyond that all is the last.  */
int bt__wear_spots (double length);
double bt__wear_width (double length);

/* Add WORK (J) done evenly over SPAN metres about FROM_END metres from the far end; over a spot's
   length where SPAN is less.  Return the largest of the spots that it fell on, J/m.  */
double bt__wear_add (const bt__wear *wear, double from_end, double span, double work);

/* What has been done at FROM_END metres from the far end, J/m.  */
double bt__wear_at (const bt__wear *wear, double from_end);

#endif
