;;; (bight core clock) --- time as it passes for a person.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(define-module (bight core clock)
  #:export (clock))

(define (clock)
  "Return the time of the machine's clock, s."
  (/ (get-internal-real-time) (exact->inexact internal-time-units-per-second)))
