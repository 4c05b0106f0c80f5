;;; (bight identify solver) --- the procedures that lead lines and fit numbers, by their raw names.
;;;
;;; Loaded by (bight identify) when a line is first identified.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(define-module (bight identify solver))

(load-extension "bight-identify" "bight_identify_init")
