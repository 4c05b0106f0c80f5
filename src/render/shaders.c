/* The shaders, as text: the scene, its shadows, and the parts shared with the passes of pixels.

   The scene is drawn unlit and without water into three buffers: colour, gloss and share of fog;
   normal and kind; depth.  The passes of shaders_pixels.c make pixels of the buffers (deferred
   shading), so light, outlines and fog are computed once per pixel, not once per triangle.

   The shadow map is drawn by a shader of its own with depth alone.  Noise is a hash of whole
   numbers, not of sines, so that every driver draws the same pattern.

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <stddef.h>

#include "render/shaders.h"

/* clang-format off */

const char bt__shader_version[] = "#version 330 core\n";

/* ---- What all that light falls on has in common ---- */

const char bt__shader_common[] =
    "uniform vec3 eye, right, up, ahead, sun;\n"
    "uniform float surface, visibility, lamp, time, plain;\n"
    "uniform float dusk, murk;\n" /* DUSK: the share of daylight that comes down; MURK: 1/m, 0 in
                                      water of no known turbidity */
    "uniform float height;\n" /* z of the origin */
    "uniform vec2 shift;\n"
    "float hash (ivec2 p)\n"
    "{\n"
    "  uint h = uint (p.x) * 374761393u + uint (p.y) * 668265263u;\n"
    "  h = (h ^ (h >> 13)) * 1274126177u;\n"
    "  return float ((h ^ (h >> 16)) & 0xffffu) * (1.0 / 65535.0);\n"
    "}\n"
    /* The sine of X, to a thousandth: a parabola, and its square to mend it.  */
    "float wave (float x)\n"
    "{\n"
    "  float t = fract (0.15915494 * x + 0.5) - 0.5, y = t * (8.0 - 16.0 * abs (t));\n"
    "  return y * (0.775 + 0.225 * abs (y));\n"
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
    "  p += 0.55 * vec2 (wave (1.9 * p.y + 0.7 * t), wave (1.7 * p.x - 0.6 * t));\n"
    "  p += 0.45 * vec2 (noise (1.3 * p + 7.0), noise (1.3 * p - 11.0));\n"
    "  return 1.0 - abs (wave (1.6 * p.x + 0.9 * p.y + 0.4 * t));\n"
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

/* ---- Light on a surface ---- */

const char bt__shader_lighting[] =
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
    "  float direct = slope * open, day = dusk * (0.38 + 0.62 * exp (-depth / 55.0));\n"
    "  float play = smoothstep (0.0, 0.7, N.z) * exp (-depth / 80.0);\n"
    "  vec3 sky = mix (vec3 (0.10, 0.17, 0.19), vec3 (0.36, 0.56, 0.58), N.z * 0.5 + 0.5);\n"
    "  vec3 beam = day * 1.45 * vec3 (0.90, 1.0, 0.92) * direct;\n"
    "  vec3 light = beam + day * sky\n"
    "               + vec3 (0.16) * dusk * max (0.0, dot (N, V));\n"
    "#if PERSPECTIVE\n"
    "  light += lamp * vec3 (1.3, 1.2, 1.0) * max (0.0, dot (N, V)) / (1.0 + away * away / 14.0)\n"
    "           * smoothstep (0.60, 0.92, dot (-V, ahead)) * exp (-1.5 * away * murk);\n"
    "#endif\n"
    "  vec3 H = normalize (sun + V);\n"
    "  float shine = gloss * pow (max (0.0, dot (N, H)), 8.0 + 56.0 * gloss) * open;\n"
    "  return vec4 (a * light + vec3 (0.6, 0.8, 0.8) * shine * day, play * beam.g / light.g);\n"
    "}\n";

/* ---- The scene ---- */

static const char scene_vertex[] = "layout (location = 0) in vec3 at;\n"
    "layout (location = 1) in vec3 normal;\n"
    "layout (location = 2) in vec4 color;\n"
    "layout (location = 3) in vec4 stuff;\n" /* fog, edge, shading, gloss */
    "uniform mat4 clip;\n"
    "out vec3 n, c;\n"
    "flat out vec2 s;\n"
    "void main ()\n"
    "{\n"
    "  n = normal; c = color.rgb;\n"
    "  s.x = (128.0 * step (1.5, stuff.z) + 16.0 * floor (stuff.x * 7.0 / 255.0 + 0.5)\n"
    "         + floor (stuff.w * 15.0 / 255.0 + 0.5)) / 255.0;\n"
    "  s.y = (abs (stuff.z - 1.0) < 0.5 ? 3.0 : stuff.y > 200.0 ? 1.0 : stuff.y > 100.0 ? 2.0 : 0.0) / 3.0;\n"
    "  gl_Position = clip * vec4 (at, 1);\n"
    "}\n";

static const char scene_fragment[] = "in vec3 n, c;\n"
    "flat in vec2 s;\n"
    "layout (location = 0) out vec4 color;\n"
    "layout (location = 1) out vec4 shape;\n"
    "void main ()\n"
    "{\n"
    "  color = vec4 (c, s.x);\n"
    "  shape = vec4 (n * 0.5 + 0.5, s.y);\n" /* a unit once light falls on it */
    "}\n";

/* ---- Shadows ---- */

static const char shadow_vertex[] = "layout (location = 0) in vec3 at;\n"
    "uniform mat4 sunward;\n"
    "void main () { gl_Position = sunward * vec4 (at, 1); }\n";

static const char shadow_fragment[] = "void main () { }\n";

const char *const bt__shader_scene_vertex[] = { bt__shader_version, scene_vertex, NULL };
const char *const bt__shader_scene_fragment[] = { bt__shader_version, scene_fragment, NULL };
const char *const bt__shader_shadow_vertex[] = { bt__shader_version, shadow_vertex, NULL };
const char *const bt__shader_shadow_fragment[] = { bt__shader_version, shadow_fragment, NULL };
