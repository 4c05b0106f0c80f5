/* The tables of the structs that are the world's own, see base/record.h.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#ifndef BT_WORLD_JUDGE_TABLES_H
#define BT_WORLD_JUDGE_TABLES_H

#include "world/judge.h"

extern const bt__record bt__current_record, bt__wave_record, bt__waves_record, bt__event_record,
    bt__state_record, bt__hold_record, bt__vehicle_record, bt__tether_record, bt__mover_record,
    bt__subject_record;

#endif
