;;; Figure 3-8: a tether wound round the legs of a platform after several collisions.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(define corners '((0 0) (12 0) (12 12) (0 12)))

(define (leg corner i)
  (define-values (x y) (apply values corner))
  (part cylinder (named ,(string->symbol (format #f "leg-~a" i))) (from x y 1) (to x y -20)
        (radius 0.6)))

(define (brace a b i)
  (define-values (ax ay bx by) (apply values (append a b)))
  (part capsule (named ,(string->symbol (format #f "brace-~a" i))) (from ax ay -18) (to bx by -14)
        (radius 0.25)))

(enter! (world (sea (depth 20) (current 0.25 90))
               (splice (map leg corners (iota 4 1)))
               (splice (map brace corners (append (cdr corners) (list (car corners))) (iota 4 1)))
               (rov (named minnow) (at -2 -3 -10))
               (tether (named line) (type fathom) (wet-weight 0) (model catenary) (response thesis)
                       (from -8 -4 -10) (to minnow) (length 90) (stick-angle 620))))
(for-each (lambda (p)
            (move! (append p '(-10)) #:speed 0.5)
            (run-until arrived? #:at-most 90))
          '((2 -2) (2.4 2) (-2 2) (-2 -2) (2 -2) (14 -2) (14 2) (10 2) (10 -2) (14 -2)))
(snapshot "fig-3-8.png" #:overlay 'turns #:size '(1280 720))
