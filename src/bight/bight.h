/* The whole face of the bight engine.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#ifndef BIGHT_BIGHT_H
#define BIGHT_BIGHT_H

#include <bight/aware.h>
#include <bight/contact.h>
#include <bight/dive.h>
#include <bight/geo.h>
#include <bight/instruments.h>
#include <bight/lead.h>
#include <bight/live.h>
#include <bight/mesh.h>
#include <bight/model.h>
#include <bight/obstacle.h>
#include <bight/statics.h>
#include <bight/status.h>
#include <bight/tether.h>
#include <bight/vec.h>
#include <bight/verbs.h>
#include <bight/view.h>
#include <bight/water.h>

#endif
