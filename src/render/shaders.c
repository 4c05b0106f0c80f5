/* The shaders.

   The scene is drawn lit, but without water, into three buffers: colour in linear light; normal,
   fog share and outline; depth.  A second pass makes pixels of it: outlines where depth or normal
   jump, darker corners, then the water's fog, averaging the samples of a pixel in linear light.

   The second pass first sorts the pixels: nothing there, one surface, or an edge of some kind. What
   a pixel is goes to a depth buffer, so that each kind has a shader of its own that runs for no
   others: a processor that draws takes every branch of a shader for every pixel.

   Depth in a buffer with perspective is affine in 1/z, which is affine over a plane in the picture:
   its second difference is zero on every plane however steep, and not at an outline.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <stddef.h>

#include "render/shaders.h"

/* clang-format off */

static const char version[] = "#version 330 core\n";

/* ---- What both passes share ---- */

static const char common[] =
    "uniform vec3 eye, right, up, ahead, sun;\n"
    "uniform float perspective, surface, visibility, lamp, time, plain;\n"
    "uniform float height;\n" /* z of the origin */
    "uniform vec2 shift;\n"
    "float hash (ivec2 p)\n"
    "{\n"
    "  uint h = uint (p.x) * 374761393u + uint (p.y) * 668265263u;\n"
    "  h = (h ^ (h >> 13)) * 1274126177u;\n"
    "  return float ((h ^ (h >> 16)) & 0xffffu) / 65535.0;\n"
    "}\n"
    "float noise (vec2 p)\n"
    "{\n"
    "  ivec2 i = ivec2 (floor (p));\n"
    "  vec2 f = fract (p), u = f * f * (3.0 - 2.0 * f);\n"
    "  return mix (mix (hash (i), hash (i + ivec2 (1, 0)), u.x),\n"
    "              mix (hash (i + ivec2 (0, 1)), hash (i + ivec2 (1, 1)), u.x), u.y);\n"
    "}\n"
    /* The net of light that waves cast: two sets of bent ridges that drift through each other. */
    "float ridges (vec2 p, float t)\n"
    "{\n"
    "  p += 0.55 * vec2 (sin (1.9 * p.y + 0.7 * t), sin (1.7 * p.x - 0.6 * t));\n"
    "  p += 0.45 * vec2 (noise (1.3 * p + 7.0), noise (1.3 * p - 11.0));\n"
    "  return 1.0 - abs (sin (1.6 * p.x + 0.9 * p.y + 0.4 * t));\n"
    "}\n"
    "float caustic (vec2 p)\n"
    "{\n"
    "  float a = ridges (p, time), b = ridges (vec2 (-p.y, p.x) * 1.13 + 3.7, -time);\n"
    "  float broad = noise (0.37 * p + 3.0);\n"
    "  return (pow (max (a, b), 9.0) + 0.6 * a * a * b * b) * (0.35 + 0.9 * broad);\n"
    "}\n"
    "vec3 water (vec3 way)\n"
    "{\n"
    "  vec3 deep = vec3 (0.006, 0.060, 0.105), level = vec3 (0.020, 0.170, 0.235);\n"
    "  vec3 high = vec3 (0.200, 0.560, 0.600);\n"
    "  vec3 c = mix (deep, level, smoothstep (-0.75, 0.12, way.z));\n"
    "  return mix (c, high, pow (smoothstep (0.0, 1.05, way.z), 1.3));\n"
    "}\n";

/* ---- The scene ---- */

static const char scene_vertex[] = "layout (location = 0) in vec3 at;\n"
    "layout (location = 1) in vec3 normal;\n"
    "layout (location = 2) in vec4 color;\n"
    "layout (location = 3) in vec4 stuff;\n"
    "uniform mat4 clip, sunward;\n"
    "out vec3 p, n, c, q;\n"
    "flat out vec4 s;\n"
    "void main ()\n"
    "{\n"
    "  p = at; n = normal; c = color.rgb; s = stuff;\n"
    "  q = (sunward * vec4 (at, 1)).xyz * 0.5 + 0.5;\n"
    "  gl_Position = clip * vec4 (at, 1);\n"
    "}\n";

/* ---- Light on a surface ---- */

static const char lighting[] =
    "uniform sampler2DShadow shadow;\n"
    "uniform float texel;\n" /* a texel's share of the shadows */
    /* The share of direct light at Q, a place in the shadows, to which OFF is added.  */
    "float lit (vec3 q, vec2 off, float slope)\n"
    "{\n"
    "  if (q.x < 0.0 || q.x > 1.0 || q.y < 0.0 || q.y > 1.0 || q.z > 1.0) return 1.0;\n"
    "  float bias = 0.0012 + 0.003 * (1.0 - slope);\n"
    "  return texture (shadow, vec3 (q.xy + 0.8 * texel * off, q.z - bias));\n"
    "}\n"
    /* Colour A, linear, at P with the normal N seen along -V; OPEN of the direct light comes there.
       Alpha: the share of the light that waves play with.  */
    "vec4 lighted (vec3 a, vec3 p, vec3 N, vec3 V, float slope, float open, float gloss)\n"
    "{\n"
    "  float depth = max (0.0, surface - height - p.z), away = length (eye - p);\n"
    "  float direct = slope * open, day = 0.38 + 0.62 * exp (-depth / 55.0);\n"
    "  float play = smoothstep (0.0, 0.7, N.z) * exp (-depth / 80.0);\n"
    "  vec3 sky = mix (vec3 (0.10, 0.17, 0.19), vec3 (0.36, 0.56, 0.58), N.z * 0.5 + 0.5);\n"
    "  vec3 beam = day * 1.45 * vec3 (0.90, 1.0, 0.92) * direct;\n"
    "  vec3 light = beam + day * sky\n"
    "               + vec3 (0.16) * max (0.0, dot (N, V));\n"
    "  if (perspective > 0.5)\n"
    "    light += lamp * vec3 (1.3, 1.2, 1.0) * max (0.0, dot (N, V)) / (1.0 + away * away / 14.0)\n"
    "             * smoothstep (0.60, 0.92, dot (-V, ahead));\n"
    "  vec3 H = normalize (sun + V);\n"
    "  float shine = gloss * pow (max (0.0, dot (N, H)), 8.0 + 56.0 * gloss) * open;\n"
    "  return vec4 (a * light + vec3 (0.6, 0.8, 0.8) * shine * day, play * beam.g / light.g);\n"
    "}\n";

static const char scene_fragment[] =
    "in vec3 p, n, c, q;\n"
    "flat in vec4 s;\n"
    "uniform float jitter;\n"
    "layout (location = 0) out vec4 color;\n"
    "layout (location = 1) out vec4 shape;\n"
    /* What stands in the sea is not of one colour.  */
    "float weathered ()\n"
    "{\n"
    "  vec3 w = p + vec3 (shift, height);\n"
    "  vec2 k = vec2 (1.1 * w.x + 0.4 * w.y, 1.2 * w.z), l = vec2 (1.2 * w.y - 0.4 * w.x, 1.1 * w.z);\n"
    "  float width = max (max (fwidth (w.x), fwidth (w.y)), fwidth (w.z));\n"
    "  float fine = 1.0 - smoothstep (0.05, 0.3, width);\n"
    "  return 0.80 + 0.16 * (noise (k) + noise (l)) \n"
    "         + 0.16 * fine * (noise (4.7 * k) + noise (4.9 * l) - 0.9);\n"
    "}\n"
    "void main ()\n"
    "{\n"
    "  vec3 N = normalize (n), V = perspective > 0.5 ? normalize (eye - p) : -ahead;\n"
    "  vec3 a = pow (c, vec3 (2.2));\n"
    "  if (dot (N, V) < 0.0) N = -N;\n"
    "  shape = vec4 (N, s.x / 255.0 + 2.0 * step (200.0, s.y)\n"
    "                + 4.0 * step (100.0, s.y) * step (s.y, 200.0));\n"
    "  if (s.z > 1.5)\n"
    "    {\n"
    "      color = vec4 (a * (0.62 + 0.48 * max (0.0, dot (N, V))), 0);\n"
    "      return;\n"
    "    }\n"
    "  if (s.y > 100.0) a *= weathered ();\n"
    "  float slope = max (0.0, dot (N, sun));\n"
    /* The samples of a pixel look at four places of the shadows between them.  */
    "  vec2 corner = jitter * (2.0 * mod (floor (gl_FragCoord.xy), 2.0) - 1.0);\n"
    "  color = lighted (a, p, N, V, slope, lit (q, corner, slope), s.w / 255.0);\n"
    "}\n";

/* The ground is most of many pictures: it is lit when pixels are made of it, once a pixel, and not here
   at every sample.  */
static const char ground_fragment[] =
    "in vec3 p, n, c, q;\n"
    "flat in vec4 s;\n"
    "layout (location = 0) out vec4 color;\n"
    "layout (location = 1) out vec4 shape;\n"
    "void main ()\n"
    "{\n"
    "  vec3 V = perspective > 0.5 ? eye - p : -ahead;\n"
    "  color = vec4 (c, 0);\n"
    "  shape = vec4 (normalize (dot (n, V) < 0.0 ? -n : n), s.x / 255.0 + 8.0);\n"
    "}\n";

/* ---- Shadows ---- */

static const char shadow_vertex[] = "layout (location = 0) in vec3 at;\n"
    "uniform mat4 sunward;\n"
    "void main () { gl_Position = sunward * vec4 (at, 1); }\n";

static const char shadow_fragment[] = "void main () { }\n";

/* ---- Pixels ---- */

static const char resolve_vertex[] =
    "uniform float layer;\n"
    "void main ()\n"
    "{\n"
    "  gl_Position = vec4 (gl_VertexID == 1 ? 3.0 : -1.0, gl_VertexID == 2 ? 3.0 : -1.0,\n"
    "                      2.0 * layer - 1.0, 1);\n"
    "}\n";

static const char resolve_fragment[] =
    "uniform sampler2D colors, shapes, depths, sky;\n"
    "uniform int samples, margin;\n"
    "uniform vec2 tile, size, half_size;\n" /* first pixel, pixels in all, half the picture in m
                                                 or tangents */
    "uniform float near, far, pixel, reach, ground, level, bare, grid;\n" /* GRID: between lines on
                                                                              the ground */
    "uniform mat4 sunward;\n"
    "out vec4 result;\n"
    /* Distance along AHEAD, in metres, of the value D of the depth buffer.  */
    "float metres (float d)\n"
    "{\n"
    "  return perspective > 0.5 ? near * far / (far - d * (far - near)) : near + d * (far - near);\n"
    "}\n"
    "vec3 place (ivec2 at, float z)\n"
    "{\n"
    "  vec2 f = (vec2 (at) + 0.5) / float (samples) - float (margin) + tile;\n"
    "  vec2 k = (f / size * 2.0 - 1.0) * half_size;\n"
    "  return perspective > 0.5 ? eye + z * (ahead + k.x * right + k.y * up)\n"
    "                           : eye + z * ahead + k.x * right + k.y * up;\n"
    "}\n"
    "float depth_at (ivec2 at) { return texelFetch (depths, at, 0).x; }\n"
    "vec4 shape_at (ivec2 at) { return texelFetch (shapes, at, 0); }\n"
    /* Kinds of outline: 0 none, 1 never, 2 line.  */
    "int outline (float w) { return w >= 8.0 ? 0 : w >= 4.0 ? 2 : w >= 2.0 ? 1 : 0; }\n"
    "bool is_ground (float w) { return w >= 8.0; }\n"
    /* A dark seam beside what is bright and thin, where that is in front.  */
    "float seam (ivec2 at, float d)\n"
    "{\n"
    "  float found = 0.0;\n"
    "  for (int i = 0; i < 4; i++)\n"
    "    {\n"
    "      ivec2 b = at + samples * ivec2 (i == 0 ? 1 : i == 1 ? -1 : 0, i == 2 ? 1 : i == 3 ? -1 : 0);\n"
    "      if (outline (shape_at (b).w) == 1 && depth_at (b) < d) found = 1.0;\n"
    "    }\n"
    "  return 0.42 * found;\n"
    "}\n"
    "float pair (ivec2 at, ivec2 step, float d, vec4 s, float scale)\n"
    "{\n"
    "  float d0 = depth_at (at - step), d1 = depth_at (at + step);\n"
    "  vec4 s0 = shape_at (at - step), s1 = shape_at (at + step);\n"
    "  int k0 = outline (s0.w), k1 = outline (s1.w), k = outline (s.w);\n"
    "  if (k0 == 1 || k1 == 1 || max (k, max (k0, k1)) < 2) return 0.0;\n"
    "  float jump = abs (d0 + d1 - 2.0 * d) / scale;\n"
    "  float crease = 1.0 - dot (s0.xyz, s1.xyz) / max (1e-3, length (s0.xyz) * length (s1.xyz));\n"
    "  float bend = min (k0, k1) == 2 ? smoothstep (0.12, 0.5, crease) : 0.0;\n"
    "  return max (smoothstep (2.5, 9.0, jump), 0.8 * bend);\n"
    "}\n"
    /* A sample's breadth, in the depth buffer's own measure.  */
    "float breadth (float d)\n"
    "{\n"
    "  float per = perspective > 0.5\n"
    "    ? pixel * max (1e-7, far / (far - near) - d) : pixel / (far - near);\n"
    "  return per / float (samples);\n"
    "}\n"
    "float edge (ivec2 at, float d, vec4 s)\n"
    "{\n"
    "  if (outline (s.w) == 1) return 0.0;\n"
    "  float per = breadth (d);\n"
    "  float line = max (pair (at, ivec2 (1, 0), d, s, per), pair (at, ivec2 (0, 1), d, s, per));\n"
    "  return max (line, seam (at, d));\n"
    "}\n"
    /* The looks around are taken for four pixels at a time, those of cell C: the same whatever tile it is
       in.  The first cell lies before the tile's first pixel.  */
    "ivec2 odd () { return ivec2 (tile) & 1; }\n"
    "ivec2 cell_corner (ivec2 c) { return 2 * (c - 1) - odd (); }\n"
    /* How open the place is: eight looks around, turned by TURN.  */
    "float open_sky (ivec2 at, vec3 p, vec3 N, float z, float turn)\n"
    "{\n"
    "  float radius = reach * float (samples), sum = 0.0;\n"
    "  float breadth = (perspective > 0.5 ? z * pixel : pixel) * reach;\n"
    "  for (int i = 0; i < 8; i++)\n"
    "    {\n"
    "      float t = turn + 2.39996 * float (i), r = radius * sqrt ((float (i) + 0.6) / 8.0);\n"
    "      ivec2 b = at + ivec2 (round (r * vec2 (cos (t), sin (t))));\n"
    "      float d = depth_at (b);\n"
    "      if (d >= 1.0 || outline (shape_at (b).w) == 1) continue;\n"
    "      vec3 v = place (b, metres (d)) - p;\n"
    "      float l = length (v);\n"
    "      sum += max (0.0, dot (N, v) / max (l, 1e-6) - 0.12)\n"
    "             * (1.0 - smoothstep (breadth, 2.5 * breadth, l));\n"
    "    }\n"
    "  return 1.0 - 0.85 * sum / 8.0 * 2.0;\n"
    "}\n";

/* ---- Ground, lit where it is seen ---- */

static const char resolve_ground[] =
    /* Sand: its grain, its ripples, a faint net of lines to tell sizes by; TEXEL is how much of it a
       sample spans along x and y.  */
    "vec3 sand (vec3 a, vec2 w, vec2 texel, inout vec3 N)\n"
    "{\n"
    "  float width = max (texel.x, texel.y);\n"
    "  float fine = 1.0 - smoothstep (0.02, 0.2, width), mid = 1.0 - smoothstep (0.2, 1.6, width);\n"
    "  float swell = noise (0.13 * w) + 0.5 * noise (0.41 * w + 5.0);\n"
    "  float ripple = sin (9.0 * w.y + 3.0 * w.x + 5.0 * noise (0.7 * w) + 3.0 * swell);\n"
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
    "vec4 ground_at (vec3 a, vec3 p, vec3 N, vec2 texel)\n"
    "{\n"
    "  vec3 V = perspective > 0.5 ? normalize (eye - p) : -ahead;\n"
    "  a = sand (pow (a, vec3 (2.2)), p.xy + shift, texel, N);\n"
    "  vec3 q = (sunward * vec4 (p, 1)).xyz * 0.5 + 0.5;\n"
    "  float slope = max (0.0, dot (N, sun)), open = 0.0;\n"
    "  for (int i = 0; i < 4; i++)\n"
    "    open += 0.25 * lit (q, vec2 ((i & 1) * 2 - 1, (i & 2) - 1), slope);\n"
    "  return lighted (a, p, N, V, slope, open, 0.0);\n"
    "}\n";

/* ---- Water over it ---- */

static const char resolve_water[] =
    /* How much more or less light the waves send to P; too fine to be seen far away.  */
    "float play_at (vec3 p, float z)\n"
    "{\n"
    "  float width = perspective > 0.5 ? z * pixel : pixel;\n"
    "  vec2 w = p.xy + shift - sun.xy / sun.z * p.z;\n"
    "  float fine = 1.0 - smoothstep (0.03, 0.22, width), broad = 1.0 - smoothstep (0.25, 1.5, width);\n"
    "  float sum = 0.0;\n"
    "  if (fine > 0.0) sum += fine * (0.85 * caustic (0.8 * w) - 0.24);\n"
    "  if (broad > 0.0) sum += 0.35 * broad * (caustic (0.16 * w) - 0.35);\n"
    "  return sum;\n"
    "}\n"
    "vec3 above (vec3 way, vec3 hit, float t)\n"
    "{\n"
    "  float window = smoothstep (0.55, 0.72, way.z);\n"
    "  float net = caustic (0.28 * (hit.xy + shift));\n"
    "  vec3 c = mix (water (vec3 (0, 0, -0.2)), vec3 (0.42, 0.80, 0.82), 0.25 + 0.75 * window);\n"
    "  return c * (0.75 + 0.9 * net);\n"
    "}\n"
    "float fog (float t) { return 1.0 - exp (-3.0 * pow (t / visibility, 1.7)); }\n"
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
    "  if (perspective < 0.5)\n"
    "    {\n"
    "      float z = p.z + height;\n"
    "      if (abs (ahead.z) < 0.7 && z < ground)\n"
    "        return vec3 (0.36, 0.33, 0.24) * (0.55 + 0.12\n"
    "               * noise (vec2 (dot (p, right), p.z) / (3.0 * pixel)))\n"
    "               * (1.0 - 0.5 * smoothstep (0.0, 60.0 * pixel, ground - z));\n"
    "      return flat_water (p);\n"
    "    }\n"
    "  vec3 c = water (way);\n"
    "  float rise = surface - height - eye.z;\n"
    "  if (way.z > 0.02 && rise > 0.0 && rise < 1e6)\n"
    "    {\n"
    "      float t = rise / way.z;\n"
    "      c = mix (above (way, eye + t * way, t), c, fog (t));\n"
    "    }\n"
    "  return c;\n"
    "}\n"
    /* Colour C at P through the water.  */
    "vec3 through (vec3 c, vec3 p, vec3 way, float z, float share)\n"
    "{\n"
    "  float t = perspective > 0.5 ? length (p - eye) : max (0.0, z);\n"
    "  vec3 w = perspective > 0.5 ? water (way) : flat_water (p);\n"
    "  return mix (c, w, min (share, 1.0) * fog (t));\n"
    "}\n"
    "vec3 toward (vec3 p) { return perspective > 0.5 ? normalize (p - eye) : ahead; }\n"
    "float breadth_at (float z) { return perspective > 0.5 ? z * pixel : pixel; }\n"
    "vec4 sample_at (ivec2 at, float open, float net)\n"
    "{\n"
    "  float d = depth_at (at), z = metres (d);\n"
    "  vec3 p = place (at, z), way = toward (p);\n"
    "  vec4 s = shape_at (at), lit = texelFetch (colors, at, 0);\n"
    "  float line = edge (at, d, s);\n"
    "  if (is_ground (s.w))\n"
    "    lit = ground_at (lit.rgb, p, s.xyz, vec2 (breadth_at (z) / float (samples) / max (0.05, abs (dot (way, s.xyz)))));\n"
    "  if (d >= 1.0)\n"
    "    return bare > 0.5 ? vec4 (0, 0, 0, line) : vec4 (backdrop (way, p) * (1.0 - 0.55 * line), 1);\n"
    "  vec3 c = lit.rgb * (1.0 + lit.a * net);\n"
    "  if (outline (s.w) != 1) c *= open;\n"
    "  c *= 1.0 - 0.72 * line;\n"
    "  return bare > 0.5 ? vec4 (c, 1) : vec4 (through (c, p, way, z, mod (s.w, 2.0)), 1);\n"
    "}\n"
    /* True if one surface, or none, lies around MIDDLE: most pixels, and they are quick.  */
    "bool is_flat (ivec2 middle, float d, vec4 s)\n"
    "{\n"
    "  float per = breadth (d), most = 0.0, bend = 0.0;\n"
    "  int kind = outline (s.w), gone = d >= 1.0 ? 1 : 0;\n"
    "  bool same = kind != 1;\n"
    "  for (int i = 0; i < 2; i++)\n"
    "    {\n"
    "      ivec2 o = (samples + 1) * ivec2 (1, i == 0 ? 1 : -1);\n"
    "      float d0 = depth_at (middle - o), d1 = depth_at (middle + o);\n"
    "      vec4 s0 = shape_at (middle - o), s1 = shape_at (middle + o);\n"
    "      same = same && outline (s0.w) == kind && outline (s1.w) == kind\n"
    "             && (d0 >= 1.0 ? 1 : 0) == gone && (d1 >= 1.0 ? 1 : 0) == gone;\n"
    "      most = max (most, abs (d0 + d1 - 2.0 * d) / per);\n"
    "      bend = max (bend, 1.0 - dot (s0.xyz, s1.xyz));\n"
    "    }\n"
    "  return same && (gone == 1 || (most < 2.5 && bend < 0.12));\n"
    "}\n"
    "vec4 ground_pixel (vec3 a, float open, float net, vec3 p, float z, vec4 s)\n"
    "{\n"
    "  vec4 lit = ground_at (a, p, s.xyz, fwidth (p.xy) / float (samples));\n"
    "  vec3 c = lit.rgb * (1.0 + lit.a * net) * open;\n"
    "  return vec4 (through (c, p, toward (p), z, 1.0), 1);\n"
    "}\n"
    "vec4 flat_pixel (ivec2 first, float open, float net, vec3 p, float z, vec4 s)\n"
    "{\n"
    "  vec3 way = toward (p), c = vec3 (0);\n"
    "  for (int j = 0; j < samples; j++)\n"
    "    for (int i = 0; i < samples; i++)\n"
    "      {\n"
    "        vec4 lit = texelFetch (colors, first + ivec2 (i, j), 0);\n"
    "        c += lit.rgb * (1.0 + lit.a * net);\n"
    "      }\n"
    "  c *= open / float (samples * samples);\n"
    "  return bare > 0.5 ? vec4 (c, 1) : vec4 (through (c, p, way, z, mod (s.w, 2.0)), 1);\n"
    "}\n"
    "vec3 encode (vec3 c)\n"
    "{\n"
    "  c = 1.42 * c / (1.0 + 0.34 * c);\n" /* a soft shoulder */
    "  return mix (12.92 * c, 1.055 * pow (max (c, 0.0031308), vec3 (1.0 / 2.4)) - 0.055,\n"
    "              step (0.0031308, c));\n"
    "}\n"
    /* How open the sky is and how the waves' light plays, from the four cells about PIXEL, of those that
       lie no further away from Z than the looks around reach.  */
    "vec2 around_at (ivec2 pixel_at, float z)\n"
    "{\n"
    "  ivec2 x = pixel_at + odd (), c = x / 2 + 1, side = (x & 1) * 2 - 1;\n"
    "  float far_off = (perspective > 0.5 ? z * pixel : pixel) * max (reach, 4.0);\n"
    "  vec3 sum = vec3 (0);\n"
    "  for (int i = 0; i < 4; i++)\n"
    "    {\n"
    "      ivec2 o = ivec2 (i & 1, i >> 1);\n"
    "      vec3 a = texelFetch (sky, c + o * side, 0).xyz;\n"
    "      float w = (o.x == 0 ? 0.75 : 0.25) * (o.y == 0 ? 0.75 : 0.25);\n"
    "      sum += (abs (a.z - z) < far_off ? w : 1e-4 * w) * vec3 (a.xy, 1);\n"
    "    }\n"
    "  return sum.xy / sum.z;\n"
    "}\n"
    "#if PASS == 5\n"
    "void main ()\n"
    "{\n"
    "  ivec2 cell = ivec2 (gl_FragCoord.xy), at = (cell_corner (cell) + 1 + margin) * samples;\n"
    "  float d = depth_at (at), z = metres (d), open = 1.0, net = 0.0;\n"
    "  vec3 p = place (at, z);\n"
    "  vec4 s = shape_at (at);\n"
    "  float turn = 6.2832 * hash (cell + (ivec2 (tile) - odd ()) / 2);\n"
    "  if (d < 1.0 && outline (s.w) != 1 && reach > 0.0)\n"
    "    open = open_sky (at, p, normalize (s.xyz), z, turn);\n"
    "  if (d < 1.0 && plain < 0.5)\n"
    "    net = play_at (p, z);\n"
    "  result = vec4 (open, net, d < 1.0 ? z : 1e30, 0);\n"
    "}\n"
    "#else\n"
    "void main ()\n"
    "{\n"
    "  ivec2 first = (ivec2 (gl_FragCoord.xy) + margin) * samples;\n"
    "  ivec2 middle = first + samples / 2;\n"
    "  float d = depth_at (middle);\n"
    "  vec4 s = shape_at (middle), sum = vec4 (0);\n"
    "#if PASS == 0\n"
    "  gl_FragDepth = !is_flat (middle, d, s) ? 0.375 : d >= 1.0 ? 0.125 : is_ground (s.w) ? 0.5 : 0.25;\n"
    "#else\n"
    "  float z = metres (d);\n"
    "  vec3 p = place (middle, z);\n"
    "#if PASS == 1\n"
    "  sum = bare > 0.5 ? vec4 (0) : vec4 (backdrop (toward (p), p), 1);\n"
    "#else\n"
    "  vec2 around = d < 1.0 ? around_at (ivec2 (gl_FragCoord.xy), z) : vec2 (1, 0);\n"
    "  float open = outline (s.w) == 1 ? 1.0 : around.x, net = around.y;\n"
    "#if PASS == 2\n"
    "  sum = flat_pixel (first, open, net, p, z, s);\n"
    "#elif PASS == 4\n"
    "  sum = ground_pixel (texelFetch (colors, middle, 0).rgb, open, net, p, z, s);\n"
    "#else\n"
    "  for (int j = 0; j < samples; j++)\n"
    "    for (int i = 0; i < samples; i++)\n"
    "      {\n"
    "        vec4 c = sample_at (first + ivec2 (i, j), open, net);\n"
    "        sum += vec4 (c.rgb * c.a, c.a);\n"
    "      }\n"
    "  sum /= float (samples * samples);\n"
    "#endif\n"
    "#endif\n"
    "#endif\n"
    "  vec3 c = encode (sum.rgb / max (sum.a, 1e-4));\n"
    /* Half a step of noise, against bands in what changes slowly.  */
    "  c += (hash (ivec2 (gl_FragCoord.xy + tile) + 911) - 0.5) / 255.0;\n"
    "  result = vec4 (clamp (c, 0.0, 1.0) * sum.a, sum.a);\n"
    "}\n"
    "#endif\n";

const char *const bt__shader_scene_vertex[] = { version, scene_vertex, NULL };
const char *const bt__shader_scene_fragment[] = { version, common, lighting, scene_fragment, NULL };
const char *const bt__shader_ground_fragment[] = { version, common, ground_fragment, NULL };
const char *const bt__shader_shadow_vertex[] = { version, shadow_vertex, NULL };
const char *const bt__shader_shadow_fragment[] = { version, shadow_fragment, NULL };
const char *const bt__shader_resolve_vertex[] = { version, resolve_vertex, NULL };

#define RESOLVE(pass) \
  { version, "#define PASS " #pass "\n", common, lighting, resolve_fragment, resolve_ground, \
    resolve_water, NULL }

const char *const bt__shader_resolve_fragment[BT__RESOLVE_PASSES][8]
    = { RESOLVE (0), RESOLVE (1), RESOLVE (2), RESOLVE (3), RESOLVE (4), RESOLVE (5) };
