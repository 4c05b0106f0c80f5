;;; (bight cockpit cells) --- the procedures that take a terminal and write a screen to it, by their raw names.
;;;
;;; Loaded by (bight cockpit view) when a dive is first flown from the keyboard.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(define-module (bight cockpit cells))

(load-extension "bight-pilot" "bight_pilot_init")
