/* Reading geographic files with limits of one's own, for tests.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#ifndef BT_GEO_READ_H
#define BT_GEO_READ_H

#include <bight/geo.h>

#include "mesh/reader.h"

bt_status bt__geo_heights_read_within (const char *file, const bt_geo_bed *wanted,
                                       const bt__reader_limits *limits, bt_heights_data **out,
                                       bt_error *error);

#endif
