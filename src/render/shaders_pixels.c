/* The shaders that make pixels of the buffers of the scene: light, outlines where depth or normal
   jump, darker corners, then the water's fog, averaging the samples of a pixel in linear light.

   A first pass sorts the pixels: water, one solid, ground, or an edge.  The sort of a pixel goes to a
   depth buffer, and a shader runs for the pixels of one sort: llvmpipe takes both branches of every
   condition for every pixel.  Loops end early, when no neighbouring pixel goes on; hence loops for
   rare work.

   A pixel on an edge is lit for at most two samples: the nearest, and the sample least like the
   nearest.  The remaining samples take the light of the more similar of the two.

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

/* ---- Water ---- */

static const char water[] =
    "vec3 above (vec3 way, vec3 hit, float t)\n"
    "{\n"
    "  float window = smoothstep (0.55, 0.72, way.z);\n"
    "  float net = caustic (0.28 * (hit.xy + shift));\n"
    "  vec3 c = mix (water (vec3 (0, 0, -0.2)), vec3 (0.42, 0.80, 0.82), 0.25 + 0.75 * window);\n"
    "  return c * (0.75 + 0.9 * net);\n"
    "}\n"
    "float fog (float t) { return 1.0 - exp (-3.0 * pow (t / visibility, 1.7)); }\n"
    /* What drifts in the water scatters the light of the lamp back.  */
    "vec3 open_water (vec3 way)\n"
    "{\n"
    "  float beam = lamp * min (murk, 1.0) * smoothstep (0.55, 1.0, dot (way, ahead));\n"
    "  return dusk * water (way) + beam * vec3 (0.24, 0.42, 0.38);\n"
    "}\n"
    /* Without perspective there is no one direction to look in: the water darkens downward.  */
    "vec3 flat_water (vec3 p)\n"
    "{\n"
    "  if (abs (ahead.z) > 0.7) return 1.6 * water (vec3 (0, 0, 0));\n"
    "  float z = p.z + height;\n"
    "  if (z > surface) return vec3 (0.36, 0.52, 0.60);\n"
    "  float t = (surface - z) / max (1.0, surface - level);\n"
    "  return 1.25 * water (vec3 (0, 0, mix (0.75, -0.45, clamp (t, 0.0, 1.0))));\n"
    "}\n"
    "vec3 backdrop (vec3 way, vec3 p)\n"
    "{\n"
    "#if !PERSPECTIVE\n"
    "  float z = p.z + height;\n"
    "  if (abs (ahead.z) < 0.7 && z < ground)\n"
    "    return vec3 (0.36, 0.33, 0.24) * (0.55 + 0.12\n"
    "           * noise (vec2 (dot (p, right), p.z) / (3.0 * pixel)))\n"
    "           * (1.0 - 0.5 * smoothstep (0.0, 60.0 * pixel, ground - z));\n"
    "  return flat_water (p);\n"
    "#else\n"
    "  vec3 c = open_water (way);\n"
    "#if PASS == 5 || PASS == 6\n"
    "  if (way.z > 0.02)\n"
    "    {\n"
    "      float t = (surface - height - eye.z) / way.z;\n"
    "      c = mix (dusk * above (way, eye + t * way, t), c, fog (t));\n"
    "    }\n"
    "#endif\n"
    "  return c;\n"
    "#endif\n"
    "}\n"
    /* The curve of sRGB (IEC 61966-2-1), its power by roots: within a tenth of a step of 255.  */
    "vec3 encode (vec3 c)\n"
    "{\n"
    "  c = 1.42 * c / (1.0 + 0.34 * c);\n" /* a soft shoulder */
    "  vec3 s = sqrt (c);\n"
    "  return mix (12.92 * c, 0.833765 * s + 0.298094 * sqrt (s) - 0.055318 * c - 0.0769,\n"
    "              step (0.0031308, c));\n"
    "}\n"
    "void finish (vec4 sum)\n"
    "{\n"
    "  vec3 c = encode (sum.rgb / max (sum.a, 1e-4));\n"
    /* Half a step of noise, against bands in what changes slowly.  */
    "  c += (hash (ivec2 (gl_FragCoord.xy + tile) + 911) - 0.5) / 255.0;\n"
    "  result = vec4 (clamp (c, 0.0, 1.0) * sum.a, sum.a);\n"
    "}\n";

static const char nothing[] =
    "void main ()\n"
    "{\n"
    "  vec3 p = place ((ivec2 (gl_FragCoord.xy) + margin) * SAMPLES + SAMPLES / 2, far);\n"
    "  finish (bare > 0.5 ? vec4 (0) : vec4 (backdrop (toward (p), p), 1));\n"
    "}\n";

/* ---- Surfaces, lit where they are seen ---- */

static const char surfaces[] =
    /* The power of 2.2 as a polynomial, within a third of a step of 255 once encoded.  */
    "vec3 decode (vec3 c)\n"
    "{\n"
    "  return c * (c * (c * (0.564788 - 0.211387 * c) + 0.649984) - 0.005814);\n"
    "}\n"
    /* The share of direct light at P; KNOWN, where that is alike all about.  */
    "float direct_at (vec3 p, float slope, float known)\n"
    "{\n"
    "  vec3 q = in_shadows (p);\n"
    "  float sum = 0.0;\n"
    "  int looks = known <= 0.0 || known >= 1.0 ? 0 : 4;\n"
    "  for (int i = 0; i < looks; i++)\n"
    "    sum += 0.25 * lit (q, corner (i), slope);\n"
    "  return looks == 0 ? known : sum;\n"
    "}\n"
    /* Openness of the sky, play of the waves' light, and direct light, from the four cells about
       PIXEL; cells whose depth differs from Z by more than the reach are left out.  */
    "vec3 around_at (ivec2 pixel_at, float z)\n"
    "{\n"
    "  ivec2 x = pixel_at + odd (), c = x / 2 + 1, side = (x & 1) * 2 - 1;\n"
    "  float far_off = breadth_at (z) * max (reach, 4.0);\n"
    "  vec4 sum = vec4 (0);\n"
    "  for (int i = 0; i < 4; i++)\n"
    "    {\n"
    "      ivec2 o = ivec2 (i & 1, i >> 1);\n"
    "      vec4 a = texelFetch (sky, c + o * side, 0);\n"
    "      float w = (o.x == 0 ? 0.75 : 0.25) * (o.y == 0 ? 0.75 : 0.25);\n"
    "      sum += (abs (a.z - z) < far_off ? w : w / 8192.0) * vec4 (a.xyw, 1);\n"
    "    }\n"
    "  return sum.xyz / sum.w;\n"
    "}\n"
    /* Sand: its grain, its ripples, a faint net of lines to tell sizes by; TEXEL is how much of it a
       sample spans along x and y.  */
    "vec3 sand (vec3 a, vec2 w, vec2 texel, inout vec3 N)\n"
    "{\n"
    "  float width = max (texel.x, texel.y);\n"
    "  float fine = 1.0 - smoothstep (0.02, 0.2, width), mid = 1.0 - smoothstep (0.2, 1.6, width);\n"
    "  float swell = noise (0.13 * w) + 0.5 * noise (0.41 * w + 5.0);\n"
    "  float ripple = wave (9.0 * w.y + 3.0 * w.x + 5.0 * noise (0.7 * w) + 3.0 * swell);\n"
    "  N = normalize (N + vec3 (0.08, 0.22, 0) * ripple * fine);\n"
    "  a *= 0.80 + 0.16 * swell + 0.10 * mid * (noise (2.3 * w) - 0.5)\n"
    "       + 0.16 * fine * (noise (23.0 * w) - 0.5);\n"
    "  if (grid > 0.0)\n"
    "    {\n"
    "      vec2 g = abs (fract (w / grid + 0.5) - 0.5) * grid / max (texel, vec2 (1e-6));\n"
    "      float line = 1.0 - smoothstep (0.6, 1.8, min (g.x, g.y));\n"
    "      a *= 1.0 - 0.20 * line * (1.0 - smoothstep (0.05, 0.25, width / grid));\n"
    "    }\n"
    "  return a;\n"
    "}\n"
    /* What stands in the sea is not of one colour.  WIDTH is what a sample spans of it.  */
    "float weathered (vec3 p, float width)\n"
    "{\n"
    "  vec3 w = p + vec3 (shift, height);\n"
    "  vec2 k = vec2 (1.1 * w.x + 0.4 * w.y, 1.2 * w.z), l = vec2 (1.2 * w.y - 0.4 * w.x, 1.1 * w.z);\n"
    "  float fine = 1.0 - smoothstep (0.05, 0.3, width);\n"
    "  return 0.80 + 0.16 * (noise (k) + noise (l))\n"
    "         + 0.16 * fine * (noise (4.7 * k) + noise (4.9 * l) - 0.9);\n"
    "}\n"
    "float width_at (float z, vec3 way, vec3 N)\n"
    "{\n"
    "  return breadth_at (z) / float (SAMPLES) / max (0.05, abs (dot (way, N)));\n"
    "}\n"
    /* The colour drawn at P with shape S, of the sample A with its packed gloss and fog.  */
    "vec3 solid_at (vec4 c, vec3 p, float z, vec3 way, vec4 s, vec3 around)\n"
    "{\n"
    "  vec3 N = normalize (s.xyz), a = decode (c.rgb);\n"
    "  if (dot (N, way) > 0.0) N = -N;\n"
    "  int flags = int (c.a * 255.0 + 0.5), k = kind (s);\n"
    "  if (flags >= 128) return a * (0.62 + 0.48 * max (0.0, -dot (N, way)));\n"
    "  if (k != 0) a *= weathered (p, width_at (z, way, N));\n"
    "  float slope = max (0.0, dot (N, sun));\n"
    "  vec4 lit = lighted (a, p, N, -way, slope, direct_at (p, slope, around.z),\n"
    "                      float (flags & 15) / 15.0);\n"
    "  return lit.rgb * (1.0 + lit.a * around.y) * (k == 1 ? 1.0 : around.x);\n"
    "}\n"
    "vec3 ground_at (vec3 c, vec3 p, vec3 way, vec3 N, vec2 texel, vec3 around)\n"
    "{\n"
    "  if (dot (N, way) > 0.0) N = -N;\n"
    "  vec3 a = sand (decode (c), p.xy + shift, texel, N);\n"
    "  float slope = max (0.0, dot (N, sun));\n"
    "  vec4 lit = lighted (a, p, N, -way, slope, direct_at (p, slope, around.z), 0.0);\n"
    "  return lit.rgb * (1.0 + lit.a * around.y) * around.x;\n"
    "}\n"
    /* The share of fog that what is packed in ALPHA takes.  */
    "float fog_of (float alpha) { return float ((int (alpha * 255.0 + 0.5) >> 4) & 7) / 7.0; }\n"
    /* Colour C at P through the water.  */
    "vec3 through (vec3 c, vec3 p, vec3 way, float z, float share)\n"
    "{\n"
    "#if PERSPECTIVE\n"
    "  return mix (c, open_water (way), share * fog (length (p - eye)));\n"
    "#else\n"
    "  return mix (c, flat_water (p), share * fog (max (0.0, z)));\n"
    "#endif\n"
    "}\n";

static const char one_surface[] =
    "void main ()\n"
    "{\n"
    "  ivec2 first = (ivec2 (gl_FragCoord.xy) + margin) * SAMPLES, middle = first + SAMPLES / 2;\n"
    "  float z = metres (depth_at (middle));\n"
    "  vec3 p = place (middle, z), way = toward (p), around = around_at (ivec2 (gl_FragCoord.xy), z);\n"
    "  vec4 s = shape_at (middle), a = texelFetch (colors, middle, 0);\n"
    "#if PASS == 4\n"
    "  vec3 c = ground_at (a.rgb, p, way, normalize (s.xyz), fwidth (p.xy) / float (SAMPLES), around);\n"
    "#else\n"
    "  a.rgb = vec3 (0);\n"
    "  for (int j = 0; j < SAMPLES; j++)\n"
    "    for (int i = 0; i < SAMPLES; i++)\n"
    "      a.rgb += texelFetch (colors, first + ivec2 (i, j), 0).rgb / float (SAMPLES * SAMPLES);\n"
    "  vec3 c = solid_at (a, p, z, way, s, around);\n"
    "#endif\n"
    "  finish (vec4 (bare > 0.5 ? c : through (c, p, way, z, fog_of (a.a)), 1));\n"
    "}\n";

/* ---- Edges ---- */

static const char edges[] =
    "int outline (vec4 s) { int k = kind (s); return k == 3 ? 0 : k; }\n"
    /* A dark seam beside bright thin things in front.  */
    "float seam (ivec2 at, float d)\n"
    "{\n"
    "  float found = 0.0;\n"
    "  for (int i = 0; i < 4; i++)\n"
    "    {\n"
    "      ivec2 b = at + SAMPLES * ivec2 (i == 0 ? 1 : i == 1 ? -1 : 0, i == 2 ? 1 : i == 3 ? -1 : 0);\n"
    "      if (outline (shape_at (b)) == 1 && depth_at (b) < d) found = 1.0;\n"
    "    }\n"
    "  return 0.42 * found;\n"
    "}\n"
    "float pair (ivec2 at, ivec2 step, float d, vec4 s, float scale)\n"
    "{\n"
    "  float d0 = depth_at (at - step), d1 = depth_at (at + step);\n"
    "  vec4 s0 = shape_at (at - step), s1 = shape_at (at + step);\n"
    "  int k0 = outline (s0), k1 = outline (s1), k = outline (s);\n"
    "  if (k0 == 1 || k1 == 1 || max (k, max (k0, k1)) < 2) return 0.0;\n"
    "  float jump = abs (d0 + d1 - 2.0 * d) / scale;\n"
    "  float crease = 1.0 - dot (s0.xyz, s1.xyz);\n"
    "  float bend = min (k0, k1) == 2 ? smoothstep (0.12, 0.5, crease) : 0.0;\n"
    "  return max (smoothstep (2.5, 9.0, jump), 0.8 * bend);\n"
    "}\n"
    "float edge (ivec2 at, float d, vec4 s)\n"
    "{\n"
    "  if (outline (s) == 1) return 0.0;\n"
    "  float per = breadth (d);\n"
    "  float line = max (pair (at, ivec2 (1, 0), d, s, per), pair (at, ivec2 (0, 1), d, s, per));\n"
    "  return max (line, seam (at, d));\n"
    "}\n"
    "struct spot { ivec2 at; float d; vec4 s, a; };\n"
    "spot spot_at (ivec2 at)\n"
    "{\n"
    "  return spot (at, depth_at (at), shape_at (at), texelFetch (colors, at, 0));\n"
    "}\n"
    "float unlike (spot x, spot y, float per)\n"
    "{\n"
    "  return abs (x.d - y.d) / per + 6.0 * (1.0 - dot (x.s.xyz, y.s.xyz)) + 12.0 * length (x.a - y.a)\n"
    "         + (kind (x.s) != kind (y.s) || (x.d >= 1.0) != (y.d >= 1.0) ? 1000.0 : 0.0);\n"
    "}\n"
    /* N samples like X, of which outlines take LINES.  */
    "vec4 shaded (spot x, float n, float lines)\n"
    "{\n"
    "  float z = metres (x.d);\n"
    "  vec3 p = place (x.at, z), way = toward (p), c, around = around_at (ivec2 (gl_FragCoord.xy), z);\n"
    "  if (x.d >= 1.0)\n"
    "    return bare > 0.5 ? vec4 (0, 0, 0, lines) : vec4 (backdrop (way, p) * (n - 0.55 * lines), n);\n"
    "  c = kind (x.s) == 3\n"
    "      ? ground_at (x.a.rgb, p, way, normalize (x.s.xyz), vec2 (width_at (z, way, x.s.xyz)), around)\n"
    "      : solid_at (x.a, p, z, way, x.s, around);\n"
    "  c *= 1.0 - 0.72 * lines / n;\n"
    "  return vec4 (n * (bare > 0.5 ? c : through (c, p, way, z, fog_of (x.a.a))), n);\n"
    "}\n"
    "void main ()\n"
    "{\n"
    "  const int all = SAMPLES * SAMPLES;\n"
    "  ivec2 first = (ivec2 (gl_FragCoord.xy) + margin) * SAMPLES;\n"
    "  spot x[all], a, b;\n"
    "  for (int i = 0; i < all; i++) x[i] = spot_at (first + ivec2 (i % SAMPLES, i / SAMPLES));\n"
    "  a = x[0];\n"
    "  for (int i = 1; i < all; i++) if (x[i].d < a.d) a = x[i];\n"
    "  b = a;\n"
    "  float per = breadth (a.d), most = 2.0;\n"
    "  for (int i = 0; i < all; i++)\n"
    "    {\n"
    "      float u = unlike (x[i], a, per);\n"
    "      if (u > most) { most = u; b = x[i]; }\n"
    "    }\n"
    "  vec2 ours = vec2 (0), theirs = vec2 (0);\n" /* samples, and their lines */
    "  float sharp = murk > 0.0 ? 1.0 - fog (metres (a.d)) : 1.0;\n"
    "  for (int i = 0; i < all; i++)\n"
    "    {\n"
    "      vec2 one = vec2 (1, sharp * edge (x[i].at, x[i].d, x[i].s));\n"
    "      if (unlike (x[i], a, per) <= unlike (x[i], b, per)) ours += one; else theirs += one;\n"
    "    }\n"
    "  vec4 sum = vec4 (0);\n"
    "  int surfaces = theirs.x > 0.0 ? 2 : 1;\n"
    "  for (int i = 0; i < surfaces; i++)\n"
    "    {\n"
    "      sum += shaded (a, ours.x, ours.y);\n"
    "      a = b;\n"
    "      ours = theirs;\n"
    "    }\n"
    "  finish (sum / float (all));\n"
    "}\n";

/* ---- The passes ---- */

static const char *const main_of[BT__RESOLVE_PASSES]
    = { sorting, nothing, one_surface, edges, one_surface, nothing, edges, around };

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
    text[n++] = water;
  if (main_of[pass] == one_surface || main_of[pass] == edges)
    text[n++] = surfaces;
  text[n++] = main_of[pass];
  text[n] = NULL;
}

const char *const bt__shader_resolve_vertex[] = { bt__shader_version, resolve_vertex, NULL };
