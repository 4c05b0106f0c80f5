/* See parts.h.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include "testbed/parts.h"

uint64_t
part_work (const bt_profile *p, int parts)
{
  const struct
  {
    part of;
    uint64_t work;
  } table[] = {
    { PART_MOVING_LINE,
      p->chain_steps + p->chain_solves + p->chain_sleeps + p->chain_remeshes + p->line_pairs },
    { PART_STATIC_LINE, p->search_iterations + p->shots + p->marches + p->relaxations },
    { PART_THESIS, p->span_solves + p->span_skips },
    { PART_OBSTACLES, p->links_asked + p->boxes_visited + p->pairs_measured + p->links_clear
                          + p->casts + p->touches + p->contact_rounds + p->truncated },
    { PART_BODY, p->body_steps },
    { PART_WAVES, p->wave_samples },
    { PART_LEE, p->lee_samples },
    { PART_QUESTIONS, p->strings + p->charts + p->words },
  };
  uint64_t work = 0;
  for (size_t i = 0; i < sizeof table / sizeof *table; i++)
    if (parts & (int)table[i].of)
      work += table[i].work;
  return work;
}
