/* The shaders that make pixels of the buffers of the scene: what is read of the buffers, how the pixels
   are sorted, and of which pieces the shader of a pass consists; shaders_lit.c has the light, outlines
   where depth or normal jump, and the water's fog.

   A first pass sorts the pixels: water, one solid, ground, or an edge.  The sort of a pixel goes to a
   depth buffer, and a shader runs for the pixels of one sort: llvmpipe takes both branches of every
   condition for every pixel.  Loops end early, when no neighbouring pixel goes on; hence loops for
   rare work.

   Depth in a buffer with perspective is affine in 1/z, which is affine over a plane in the picture:
   its second difference is zero on every plane however steep, and not at an outline.

   SAMPLES and PERSPECTIVE are constants of the program; PASS is its number.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <stddef.h>

#include "render/shaders.h"

/* clang-format off */

static const char resolve_vertex[] =
    "uniform float layer;\n"
    "void main ()\n"
    "{\n"
    "  gl_Position = vec4 (gl_VertexID == 1 ? 3.0 : -1.0, gl_VertexID == 2 ? 3.0 : -1.0,\n"
    "                      2.0 * layer - 1.0, 1);\n"
    "}\n";

/* ---- Samples ---- */

static const char samples[] =
    "uniform sampler2D colors, shapes, depths, sky;\n"
    "uniform int margin;\n"
    "uniform vec2 tile, size, half_size;\n" /* first pixel, pixels in all, half the picture in m
                                                 or tangents */
    "uniform float near, far, pixel, reach, ground, level, bare, grid;\n" /* GRID: between lines on
                                                                              the ground */
    "uniform float wide;\n" /* the share of the shadows that a metre spans */
    "uniform mat4 sunward;\n"
    "out vec4 result;\n"
    /* Distance along AHEAD, in metres, of the value D of the depth buffer.  */
    "float metres (float d)\n"
    "{\n"
    "#if PERSPECTIVE\n"
    "  return near * far / (far - d * (far - near));\n"
    "#else\n"
    "  return near + d * (far - near);\n"
    "#endif\n"
    "}\n"
    "vec3 place (ivec2 at, float z)\n"
    "{\n"
    "  vec2 f = (vec2 (at) + 0.5) / float (SAMPLES) - float (margin) + tile;\n"
    "  vec2 k = (f / size * 2.0 - 1.0) * half_size;\n"
    "#if PERSPECTIVE\n"
    "  return eye + z * (ahead + k.x * right + k.y * up);\n"
    "#else\n"
    "  return eye + z * ahead + k.x * right + k.y * up;\n"
    "#endif\n"
    "}\n"
    "#if PERSPECTIVE\n"
    "vec3 toward (vec3 p) { return normalize (p - eye); }\n"
    "float breadth_at (float z) { return z * pixel; }\n"
    "#else\n"
    "vec3 toward (vec3 p) { return ahead; }\n"
    "float breadth_at (float z) { return pixel; }\n"
    "#endif\n"
    "float depth_at (ivec2 at) { return texelFetch (depths, at, 0).x; }\n"
    /* Normal and kind: 0 without outline, 1 with one never, 2 with a line, 3 ground.  */
    "vec4 shape_at (ivec2 at)\n"
    "{\n"
    "  return texelFetch (shapes, at, 0) * vec4 (2, 2, 2, 3) - vec4 (1, 1, 1, 0);\n"
    "}\n"
    "int kind (vec4 s) { return int (s.w + 0.5); }\n"
    /* A sample's breadth, in the depth buffer's own measure.  */
    "float breadth (float d)\n"
    "{\n"
    "#if PERSPECTIVE\n"
    "  float per = pixel * max (1e-7, far / (far - near) - d);\n"
    "#else\n"
    "  float per = pixel / (far - near);\n"
    "#endif\n"
    "  return per / float (SAMPLES);\n"
    "}\n"
    /* The looks around are taken for four pixels at a time, those of cell C: the same whatever tile it is
       in.  The first cell lies before the tile's first pixel.  */
    "ivec2 odd () { return ivec2 (tile) & 1; }\n"
    "ivec2 cell_corner (ivec2 c) { return 2 * (c - 1) - odd (); }\n"
    "vec3 in_shadows (vec3 p) { return (sunward * vec4 (p, 1)).xyz * 0.5 + 0.5; }\n"
    "vec2 corner (int i) { return vec2 ((i & 1) * 2 - 1, (i & 2) - 1); }\n";

/* ---- The looks around ---- */

static const char around[] =
    /* How open the place is: eight looks around, turned by TURN; fewer if LOOKS is.  Each is turned
       by the golden angle from the last.  */
    "float open_sky (ivec2 at, vec3 p, vec3 N, float z, float turn, int looks)\n"
    "{\n"
    "  float sum = 0.0, breadth = breadth_at (z) * reach;\n"
    "  vec2 way = reach * float (SAMPLES) * vec2 (cos (turn), sin (turn));\n"
    "  for (int i = 0; i < looks; i++)\n"
    "    {\n"
    "      ivec2 b = at + ivec2 (round (sqrt ((float (i) + 0.6) / 8.0) * way));\n"
    "      float d = depth_at (b);\n"
    "      vec3 v = place (b, metres (d)) - p;\n"
    "      float l = length (v);\n"
    "      if (d < 1.0 && kind (shape_at (b)) != 1)\n"
    "        sum += max (0.0, dot (N, v) / max (l, 1e-6) - 0.12)\n"
    "               * (1.0 - smoothstep (breadth, 2.5 * breadth, l));\n"
    "      way = mat2 (-0.737369, 0.675490, -0.675490, -0.737369) * way;\n"
    "    }\n"
    "  return 1.0 - 0.85 * sum / 8.0 * 2.0;\n"
    "}\n"
    /* How much more or less light the waves send to P; too fine to be seen far away.  */
    "float play_at (vec3 p, float z)\n"
    "{\n"
    "  float width = breadth_at (z), sum = 0.0;\n"
    "  vec2 w = p.xy + shift - sun.xy / sun.z * p.z;\n"
    "  int nets = width < 0.22 ? 2 : width < 1.5 ? 1 : 0;\n"
    "  for (int i = 0; i < nets; i++)\n"
    "    {\n"
    "      float c = caustic ((i == 0 ? 0.16 : 0.8) * w);\n"
    "      sum += i == 0 ? 0.35 * (1.0 - smoothstep (0.25, 1.5, width)) * (c - 0.35)\n"
    "                    : (1.0 - smoothstep (0.03, 0.22, width)) * (0.85 * c - 0.24);\n"
    "    }\n"
    "  return sum;\n"
    "}\n"
    /* The direct light about the cell, exactly 0 or 1 where it is all alike.  */
    "float sunlight (vec3 p, vec3 N, float z)\n"
    "{\n"
    "  float slope = max (0.0, dot (N, sun)), sum = 0.0;\n"
    "  float spread = max (1.0, 1.5 * breadth_at (z) * wide / texel);\n"
    "  vec3 q = in_shadows (p);\n"
    "  for (int i = 0; i < 4; i++)\n"
    "    sum += 0.25 * lit (q, spread * corner (i), slope);\n"
    "  return sum;\n"
    "}\n"
    "void main ()\n"
    "{\n"
    "  ivec2 cell = ivec2 (gl_FragCoord.xy), at = (cell_corner (cell) + 1 + margin) * SAMPLES;\n"
    "  float d = depth_at (at), z = metres (d), net = 0.0;\n"
    "  vec3 p = place (at, z);\n"
    "  vec4 s = shape_at (at);\n"
    "  vec3 N = normalize (s.xyz);\n"
    "  float turn = 6.2832 * hash (cell + (ivec2 (tile) - odd ()) / 2);\n"
    "  int looks = d < 1.0 && kind (s) != 1 && reach > 0.0 ? 8 : 0;\n"
    "  float open = open_sky (at, p, dot (N, toward (p)) > 0.0 ? -N : N, z, turn, looks);\n"
    "  net = d < 1.0 && plain < 0.5 ? play_at (p, z) : 0.0;\n"
    "  result = vec4 (open, net, d < 1.0 ? z : 1e30, sunlight (p, N, z));\n"
    "}\n";

/* ---- Sorting ---- */

static const char sorting[] =
    /* True if one surface, or none, lies around MIDDLE: most pixels, and they are quick.  Ground has
       no outlines: it is one surface as long as it does not jump.  */
    "bool is_flat (ivec2 middle, float d, vec4 s)\n"
    "{\n"
    "  float per = breadth (d), most = 0.0, bend = 0.0;\n"
    "  int k = kind (s), gone = d >= 1.0 ? 1 : 0;\n"
    "  bool same = k != 1;\n"
    "  for (int i = 0; i < 2; i++)\n"
    "    {\n"
    "      ivec2 o = (SAMPLES + 1) * ivec2 (1, i == 0 ? 1 : -1);\n"
    "      float d0 = depth_at (middle - o), d1 = depth_at (middle + o);\n"
    "      vec4 s0 = shape_at (middle - o), s1 = shape_at (middle + o);\n"
    "      same = same && kind (s0) == k && kind (s1) == k\n"
    "             && (d0 >= 1.0 ? 1 : 0) == gone && (d1 >= 1.0 ? 1 : 0) == gone;\n"
    "      most = max (most, abs (d0 + d1 - 2.0 * d) / per);\n"
    "      bend = max (bend, 1.0 - dot (s0.xyz, s1.xyz));\n"
    "    }\n"
    "  return same && (gone == 1 || (k == 3 ? most < 24.0 : most < 2.5 && bend < 0.12));\n"
    "}\n"
    "bool sees_surface (vec3 way)\n"
    "{\n"
    "  float rise = surface - height - eye.z;\n"
    "  return PERSPECTIVE == 1 && way.z > 0.02 && rise > 0.0 && rise < 1e6;\n"
    "}\n"
    "void main ()\n"
    "{\n"
    "  ivec2 middle = (ivec2 (gl_FragCoord.xy) + margin) * SAMPLES + SAMPLES / 2;\n"
    "  float d = depth_at (middle);\n"
    "  vec4 s = shape_at (middle);\n"
    "  bool high = sees_surface (normalize (place (middle, 1.0) - eye));\n"
    "  int pass = !is_flat (middle, d, s) ? (high ? 6 : 3) : d >= 1.0 ? (high ? 5 : 1) : kind (s) == 3 ? 4 : 2;\n"
    "  gl_FragDepth = float (pass) / 8.0;\n"
    "  result = vec4 (0);\n"
    "}\n";

/* ---- The passes ---- */

static const char *const main_of[BT__RESOLVE_PASSES]
    = { sorting,
        bt__shader_nothing,
        bt__shader_one_surface,
        bt__shader_edges,
        bt__shader_one_surface,
        bt__shader_nothing,
        bt__shader_edges,
        around };

void
bt__shader_pixels (int pass, const char *constants, const char *text[BT__SHADER_PARTS])
{
  int n = 0;
  text[n++] = bt__shader_version;
  text[n++] = constants;
  text[n++] = bt__shader_common;
  text[n++] = bt__shader_lighting;
  text[n++] = samples;
  if (pass > 0 && pass != BT__RESOLVE_SKY)
    text[n++] = bt__shader_water;
  if (main_of[pass] == bt__shader_one_surface || main_of[pass] == bt__shader_edges)
    text[n++] = bt__shader_surfaces;
  text[n++] = main_of[pass];
  text[n] = NULL;
}

const char *const bt__shader_resolve_vertex[] = { bt__shader_version, resolve_vertex, NULL };
