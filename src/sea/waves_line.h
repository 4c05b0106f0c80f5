/* How far the series of waves_line.c reach.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#ifndef BT_SEA_WAVES_LINE_H
#define BT_SEA_WAVES_LINE_H

#include <bight/sea.h>

/* Set the reaches of W, whose components and accuracy are set.  */
void bt__waves_reaches (bt_waves *w);

#endif
