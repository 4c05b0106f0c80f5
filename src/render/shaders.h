/* The shaders, as text.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#ifndef BT_RENDER_SHADERS_H
#define BT_RENDER_SHADERS_H

/* Pieces; each NULL-terminated list is one shader.  */
extern const char *const bt__shader_scene_vertex[];
extern const char *const bt__shader_scene_fragment[];
extern const char *const bt__shader_ground_fragment[]; /* the scene's, for the ground alone */
extern const char *const bt__shader_shadow_vertex[];
extern const char *const bt__shader_shadow_fragment[];
extern const char *const bt__shader_resolve_vertex[];

/* To sort the pixels; then for those with nothing in them, one surface, edges, ground: the K-th of
   these is drawn at the depth K / 8.  */
enum
{
  BT__RESOLVE_SKY = 5, /* before these */
  BT__RESOLVE_PASSES = 6
};
extern const char *const bt__shader_resolve_fragment[BT__RESOLVE_PASSES][8];

#endif
