;;; Contact in the physical response, as a pilot meets it: what a tether round things does to the one who
;;; flies it.  Model `dynamic' at 60 Hz; friction, stiffness and line are those stated in each world.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(define (fly . places)
  ;; Through PLACES one after another, giving up on each after a while.
  (for-each (lambda (p)
              (move! p #:speed 1)
              (run-until arrived? #:at-most 40))
            places))

(define legs '(jacket/leg-a1 jacket/leg-a2 jacket/leg-b1 jacket/leg-b2))

(define (farthest-apart a b)
  (apply max (map (lambda (p q) (abs (- p q))) a b)))

(define-scenario round-two-legs-and-back
  "Figure 3-8: once round each of two legs of a jacket and back the same way: the turns are again what they
were, and the line is hauled out without a touch."
  (in 'jacket)
  (let ((before (map turns legs))
        (home '(-2 -14 -8))
        (way '((3 -10 -8) (3 -3 -8) (9 -3 -8) (9 -9 -8) (3 -10 -8) (-3 -10 -8) (-9 -9 -8) (-9 -3 -8) (-3 -3 -8)
               (-3 -10 -8))))
    (apply fly way)
    (expect (- (turns 'jacket/leg-b2) (list-ref before 3)) is (above 0.9))
    (apply fly (append (reverse way) (list home)))
    (expect (farthest-apart before (map turns legs)) is (below 0.03))
    (haul-in! 47 #:rate 0.5)
    (run 130)
    (expect (null? (contacts)))
    (expect (null? (windings)))))

(define-scenario a-wrap-undone-is-counted-once
  "Once round a pile and back: the winding goes up once and down once, and afterwards nothing touches."
  (in 'pile)
  (let ((seen '()))
    (define (note!)
      (let ((w (winding 'p1)))
        (unless (and (pair? seen) (= w (car seen)))
          (set! seen (cons w seen)))))
    (define (go! . places)
      (for-each (lambda (p)
                  (move! p #:speed 1)
                  (let loop ((n 0))
                    (run 0.5)
                    (note!)
                    (unless (or (arrived?) (> n 60)) (loop (+ n 1)))))
                places))
    (go! '(6 6 -5) '(-6 6 -5) '(-6 -4 -5) '(6 -4 -5))
    (go! '(-6 -4 -5) '(-6 6 -5) '(6 6 -5) '(6 -6 -5))
    (run 30)
    (expect (equal? seen '(0 -1 0)))
    (expect (null? (contacts)))))

(define-scenario a-taut-line-stops-its-vehicle
  "Bent half round a drum, a vehicle that flies on is stopped where its line is taut: smoothly, for good, and
outside the drum."
  (in (world (sea (depth 20))
             (cylinder (named drum) (from 0 0 1) (to 0 0 -20) (radius 0.6))
             (rov (named minnow) (at 6 2 -6))
             (tether (from 6 -2 -6) (to minnow) (length 24) (via (-2 -2 -6) (-2 2 -6)) (type fathom) (wet-weight 0)
                     (friction 0.3) (model dynamic))))
  (move! '(30 2 -6) #:speed 0.5)
  (run 60)
  (let ((at (rov-position)) (pull (rov-tension)))
    (expect (x at) is (below 20))
    (run 20)
    (expect (rov-position) is (about at #:within 0.05))
    (expect (rov-tension) is (about pull #:within 0.5))
    (expect (clearance) is (above (* -1/4 0.0076)))))

(define-scenario a-wound-line-does-not-feel-the-winch
  "Two turns round a pile hold by friction, e^(0.6 4 pi): what is paid out stays on the winch's side, and the
vehicle, pulled as it was, gains less than a tenth of it."
  (in 'pile)
  (alter! 'line #:friction 0.6)
  (fly '(2 3 -5) '(-3 3 -5) '(-3 -3 -5) '(3 -3 -5) '(3 3 -5) '(-3 3 -5) '(-3 -3 -5) '(3 -3 -5) '(3 3 -5))
  (move! '(12 20 -5) #:speed 1)
  (run 60)
  (expect (stuck?))
  (let ((at (rov-position)) (pull (rov-tension)))
    (pay-out! 8 #:rate 0.5)
    (run 40)
    (expect (tether-length) is (about 48 #:within 1e-6))
    (expect (rov-tension) is (about pull #:within (* 0.02 pull)))
    (expect (range-to at) is (below 0.8))))
