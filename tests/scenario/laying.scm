;;; A moving line is laid from its equilibrium, with a bed in the world too: what it pulls with at the start
;;; is what it pulls with when it has hung there for long.  A light line that obstacles keep from its
;;; equilibrium is still falling when its laying ends.  Slack lies on the bed in one bight.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

;; Sixty metres to a vehicle 45 m away, 15 m deeper, across a current of SPEED, with PARTs in the world too.
(define-syntax laid-in
  (syntax-rules ()
    ((_ (speed weight) part ...)
     (world (sea (depth 90) (current speed 60))
            part ...
            (rov (named minnow) (at 40 -14 -20))
            (tether (named line) (type fathom) (wet-weight weight) (model dynamic)
                    (from 0 0 -5) (to minnow) (length 60))))))

(define (above-a-bed speed weight z slope)
  (laid-in (speed weight)
           (seabed (friction 0.4)
                   (grid (lambda (x y) (+ z (* slope x))) (from -100 -100) (to 100 100) (spacing 10)))))

(define (pulls)
  (list (tension-at 0) (rov-tension)))

;; The greatest difference of the tensions at the ends, A before and B after, of the greater of B.
(define (off a b)
  (/ (apply max (map (lambda (x y) (abs (- x y))) a b)) (apply max b)))

(define (settled)
  (settle! #:within 0.002 #:at-most 600)
  (pulls))

(define-scenario (a-far-bed speed weight)
  "A bed, a slope or a rock that the line does not come to changes nothing of how it is laid."
  #:for ((speed 0 0.25 0.5) (weight 0 0.3 1.5))
  (enter! (laid-in (speed weight)))
  (let ((alone (pulls)))
    (for-each (lambda (other)
                (enter! other)
                (expect (pulls) => alone))
              (list (laid-in (speed weight) (seabed (friction 0.4)))
                    (above-a-bed speed weight -80 0.1)
                    (laid-in (speed weight) (seabed (friction 0.4))
                             (box (named rock) (at 20 40 -85) (size 6 6 8)))))))

(define-scenario (laid-as-it-rests speed weight bed)
  "The tensions at the ends are at the start those of the line at rest."
  #:for ((speed 0 0.4) (weight 0.1 1.5) (bed #f #t))
  (enter! (if bed (above-a-bed speed weight -80 0.1) (laid-in (speed weight))))
  (let* ((start (pulls)) (rest (settled)))
    (expect (off start rest) is (below 0.05))))

(define-scenario (laid-on-a-bed slope)
  "So are those of a heavy line where the bed bears a part of it, within a tenth."
  #:for ((slope 0 -0.05))
  (enter! (above-a-bed 0.1 1.5 -23 slope))
  (let ((start (pulls)))
    (run 1)
    (require (> (length (contacts)) 0))
    (expect (off start (settled)) is (below 0.1))))

;; A sea with a current of SPEED over a bed of KIND, 15 m deep or so.
(define (over-a-bed kind speed)
  (case kind
    ((box) (world (sea (depth 60) (current speed 60))
                  (box (named slab) (at 0 0 -17) (size 300 300 4) (friction 0.4))))
    ((level) (world (sea (depth 15) (current speed 60)) (seabed (friction 0.4))))
    ((slope) (world (sea (depth 60) (current speed 60))
                    (seabed (friction 0.4)
                            (grid (lambda (x y) (- (* 0.1 x) 15.5)) (from -100 -100) (to 100 100) (spacing 10)))))))

(define-scenario (slack-lies-in-one-bight bed slack speed)
  "What a slack line has too much lies on the bed in wide bends and touches no other part of the line."
  #:for ((bed 'box 'level 'slope) (slack 0.15 0.35 0.55) (speed 0 0.25))
  (enter! (extend (over-a-bed bed speed)
                  (rov (named minnow) (at 12 0 -12))
                  (tether (named line) (wet-weight 0.4) (diameter 0.012) (model auto) (from 0 0 -5)
                          (to minnow) (length (/ 14 (- 1 slack))))))
  (expect (tightest-bend) is (above 0.15))
  (expect (filter (lambda (c) (not (memq (contact-object c) '(slab seabed)))) (contacts)) => '())
  (when (> slack 0.3)
    (expect (contact-length) is (above 1))))

(define-scenario what-is-off-is-no-bed
  "A line that goes through a slab is laid as if no slab were there: at rest."
  (enter! (extend (over-a-bed 'box 0)
                  (rov (named minnow) (at 11 0 -10))
                  (tether (named line) (wet-weight 0.4) (diameter 0.012) (model steady) (from 0 0 -5) (to minnow) (length 30))))
  (collide! 'line 'slab #f)
  (tether-model! 'line 'auto)
  (let ((middle (point-at 15)))
    (run 5)
    (expect (distance (point-at 15) middle) is (below 0.02))))
