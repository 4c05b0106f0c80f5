;;; (bight view chafa) --- the procedures that turn pixels into what a terminal shows, by their raw names.
;;;
;;; Loaded by (bight view picture) when the first picture is shown.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(define-module (bight view chafa))

(load-extension "bight-chafa" "bight_chafa_init")
