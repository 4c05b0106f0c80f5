/* The shaders, as text.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#ifndef BT_RENDER_SHADERS_H
#define BT_RENDER_SHADERS_H

/* Pieces; each NULL-terminated list is one shader.  */
extern const char *const bt__shader_scene_vertex[];
extern const char *const bt__shader_scene_fragment[];
extern const char *const bt__shader_shadow_vertex[];
extern const char *const bt__shader_shadow_fragment[];
extern const char *const bt__shader_resolve_vertex[];
extern const char bt__shader_version[], bt__shader_common[], bt__shader_lighting[];
/* shaders_lit.c: functions of the water and of surfaces; the main functions of passes.  */
extern const char bt__shader_water[], bt__shader_surfaces[];
extern const char bt__shader_nothing[], bt__shader_one_surface[], bt__shader_edges[];

/* The passes that make pixels.  Pass 0 sorts the pixels; each further pass shades one sort: empty
   water, one solid, edges, ground, the surface from below, edges before the surface.  Sort K has
   the depth K / 8.  */
enum
{
  BT__RESOLVE_HIGH = 5, /* the first of those that show the surface */
  BT__RESOLVE_SKY = 7,  /* before these */
  BT__RESOLVE_PASSES = 8,
  BT__SHADER_PARTS = 10
};

/* Fill TEXT with the pieces of the shader of PASS, NULL after them; CONSTANTS defines PASS, SAMPLES
   and PERSPECTIVE.  */
void bt__shader_pixels (int pass, const char *constants, const char *text[BT__SHADER_PARTS]);

#endif
