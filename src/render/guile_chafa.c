/* The extension that turns pixels into what a terminal shows, by libchafa: fills the module
   (bight view chafa).

   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */

#include <chafa.h>
#include <glib.h>

#include "guile/guile.h"

/* ---- What the terminal can do ---- */

static int
can (const ChafaTermInfo *info, ChafaTermSeq seq)
{
  return chafa_term_info_have_seq (info, seq);
}

static ChafaTermInfo *
this_terminal (void)
{
  gchar **environment = g_get_environ ();
  ChafaTermInfo *info = chafa_term_db_detect (chafa_term_db_get_default (), environment);
  g_strfreev (environment);
  return info;
}

static ChafaPixelMode
best_mode (const ChafaTermInfo *info)
{
  if (can (info, CHAFA_TERM_SEQ_BEGIN_KITTY_IMMEDIATE_IMAGE_V1))
    return CHAFA_PIXEL_MODE_KITTY;
  return can (info, CHAFA_TERM_SEQ_BEGIN_SIXELS) ? CHAFA_PIXEL_MODE_SIXELS
                                                 : CHAFA_PIXEL_MODE_SYMBOLS;
}

static ChafaCanvasMode
best_colors (const ChafaTermInfo *info)
{
  if (can (info, CHAFA_TERM_SEQ_SET_COLOR_FGBG_DIRECT))
    return CHAFA_CANVAS_MODE_TRUECOLOR;
  if (can (info, CHAFA_TERM_SEQ_SET_COLOR_FGBG_256))
    return CHAFA_CANVAS_MODE_INDEXED_240;
  return can (info, CHAFA_TERM_SEQ_SET_COLOR_FGBG_16) ? CHAFA_CANVAS_MODE_INDEXED_16
                                                      : CHAFA_CANVAS_MODE_FGBG;
}

static const char *const mode_names[] = { "symbols", "sixel", "kitty" };
static const ChafaPixelMode modes[]
    = { CHAFA_PIXEL_MODE_SYMBOLS, CHAFA_PIXEL_MODE_SIXELS, CHAFA_PIXEL_MODE_KITTY };

static SCM
terminal_mode (void)
{
  ChafaTermInfo *info = this_terminal ();
  ChafaPixelMode mode = best_mode (info);
  ChafaCanvasMode colors = best_colors (info);
  chafa_term_info_unref (info);
  for (int i = 1; i < 3; i++)
    if (modes[i] == mode)
      return scm_from_utf8_symbol (mode_names[i]);
  return colors == CHAFA_CANVAS_MODE_FGBG ? SCM_BOOL_F : scm_from_utf8_symbol (mode_names[0]);
}

static ChafaPixelMode
to_mode (SCM name)
{
  for (int i = 0; i < 3; i++)
    if (scm_is_eq (name, scm_from_utf8_symbol (mode_names[i])))
      return modes[i];
  scm_wrong_type_arg ("%picture->text", SCM_ARGn, name);
}

/* ---- Text ---- */

static ChafaCanvas *
new_canvas (const ChafaTermInfo *info, ChafaPixelMode mode, int columns, int rows)
{
  ChafaCanvasConfig *config = chafa_canvas_config_new ();
  ChafaSymbolMap *symbols = chafa_symbol_map_new ();
  ChafaCanvasMode colors = best_colors (info);
  ChafaCanvas *canvas;
  chafa_symbol_map_add_by_tags (symbols, CHAFA_SYMBOL_TAG_SPACE | CHAFA_SYMBOL_TAG_HALF
                                             | CHAFA_SYMBOL_TAG_QUAD | CHAFA_SYMBOL_TAG_BLOCK
                                             | CHAFA_SYMBOL_TAG_BORDER);
  chafa_canvas_config_set_symbol_map (config, symbols);
  chafa_canvas_config_set_geometry (config, columns, rows);
  chafa_canvas_config_set_cell_geometry (config, 8, 16);
  chafa_canvas_config_set_pixel_mode (config, mode);
  chafa_canvas_config_set_canvas_mode (
      config, colors == CHAFA_CANVAS_MODE_FGBG ? CHAFA_CANVAS_MODE_TRUECOLOR : colors);
  canvas = chafa_canvas_new (config);
  chafa_symbol_map_unref (symbols);
  chafa_canvas_config_unref (config);
  return canvas;
}

/* A terminal that cannot do what MODE asks for is told all the same: its user may know better.  */
static ChafaTermInfo *
terminal_for (ChafaPixelMode mode)
{
  ChafaTermInfo *info = this_terminal ();
  if (best_mode (info) == mode
      || (mode == CHAFA_PIXEL_MODE_SYMBOLS && best_colors (info) != CHAFA_CANVAS_MODE_FGBG))
    return info;
  chafa_term_info_unref (info);
  return chafa_term_db_get_fallback_info (chafa_term_db_get_default ());
}

static SCM
picture_to_text (SCM bytes, SCM width, SCM height, SCM columns, SCM rows, SCM mode_name)
{
  int w = scm_to_int (width), h = scm_to_int (height), c = scm_to_int (columns);
  int r = scm_to_int (rows);
  ChafaPixelMode mode = to_mode (mode_name);
  ChafaTermInfo *info;
  ChafaCanvas *canvas;
  GString *text;
  SCM string;
  SCM_ASSERT (scm_is_bytevector (bytes) && w > 0 && h > 0 && c > 0 && r > 0
                  && SCM_BYTEVECTOR_LENGTH (bytes) == (size_t)w * (size_t)h * 4,
              bytes, SCM_ARG1, "%picture->text");
  info = terminal_for (mode);
  canvas = new_canvas (info, mode, c, r);
  chafa_canvas_draw_all_pixels (canvas,
                                G_BYTE_ORDER == G_LITTLE_ENDIAN ? CHAFA_PIXEL_BGRA8_PREMULTIPLIED
                                                                : CHAFA_PIXEL_ARGB8_PREMULTIPLIED,
                                (const guint8 *)SCM_BYTEVECTOR_CONTENTS (bytes), w, h, 4 * w);
  text = chafa_canvas_print (canvas, info);
  string = scm_from_utf8_stringn (text->str, text->len);
  g_string_free (text, TRUE);
  chafa_canvas_unref (canvas);
  chafa_term_info_unref (info);
  scm_remember_upto_here_1 (bytes);
  return string;
}

void bight_chafa_init (void);

__attribute__ ((visibility ("default"))) void
bight_chafa_init (void)
{
  static const bt__procedure table[] = {
    { "%terminal-mode", 0, 0, (scm_t_subr)terminal_mode,
      "Return the best the terminal can show by its environment: kitty, sixel, symbols, or #f." },
    { "%picture->text", 6, 0, (scm_t_subr)picture_to_text,
      "Return the text that shows BYTES, the pixels of a picture of WIDTH by HEIGHT, in COLUMNS by "
      "ROWS cells by MODE: kitty, sixel or symbols." },
  };
  bt__define_procedures (table, sizeof table / sizeof *table);
}
