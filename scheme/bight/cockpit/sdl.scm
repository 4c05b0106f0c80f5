;;; (bight cockpit sdl) --- the procedures that read game controllers, by their raw names.
;;;
;;; Loaded by (bight cockpit controller) when a dive is flown by what is plugged in.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(define-module (bight cockpit sdl))

(load-extension "bight-controller" "bight_controller_init")
