;;; (bight belief level) --- when a probability is worth an alarm: as it rises past a level, and when it has fallen to half
;;; of the level that was told.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(define-module (bight belief level)
  #:use-module (srfi srfi-1)
  #:export (level-after level-said hundredths))

(define levels '(0.1 0.3 0.6 0.9))      ; each is told once on the way up

(define (hundredths p)
  "Return the probability P to two places."
  (/ (round (* 100 p)) 100.0))

(define (level-of p) (count (lambda (level) (>= p level)) levels))

(define (level-after level p)
  "Return the level that was told last, a whole number, LEVEL before, once the probability is P."
  (let ((reached (level-of p)))
    (cond ((> reached level) reached)
          ((< (* 2 p) (list-ref (cons 0 levels) level)) reached)
          (else level))))

(define (level-said before after p)
  "Return how the probability P that a tether is wound has gone from the level BEFORE to AFTER, a string, or #f: as it was."
  (and (not (= before after))
       (simple-format #f "P(wound) ~a and ~a" (hundredths p) (if (> after before) "rising" "falling"))))
