;;; (bight view render) --- the procedures of the renderer, by their raw names.
;;;
;;; They take positional arguments already checked; users meet them through (bight view picture), which loads
;;; this module when the first picture is asked for.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(define-module (bight view render))

(load-extension "bight-render" "bight_render_init")
