;;; A line that is clamped at an end leaves it in a direction.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(use-modules (srfi srfi-1))

(define-scenario (a-cantilever model)
  "Cut near its vehicle, a stiff line that a clamp holds out level sags by w L^4 / (8 E I) at its free end."
  #:for ((model 'dynamic 'auto))
  (enter! (world (sea (depth 60))
                 (rov (named v) (type kinematic) (at 3.3 0 -10))
                 (tether (named l) (type fathom) (wet-weight 1) (ei 200) (bending-damping 20) (from 0 0 -10)
                         (from-along 1 0 0) (to v) (length 3.3) (nodes 66) (model ,model))))
  (cut-tether! #:at 3)
  (run 20)
  (expect (tether-length) is (about 3 #:within 0.12)) ; parted in the middle of an interval
  (let ((l (tether-length)))
    (expect (- -10 (z (point-at l))) is (about (/ (expt l 4) 8 200) #:within 1e-3))
    ;; slope of the end: w L^3 / (6 E I)
    (expect (- (z (tangent-at l))) is (about (/ (expt l 3) 6 200) #:within 1e-3))))

(define pi (* 4 (atan 1)))

(define here-module (current-module))

(define (off-a-circle n radius centre)
  "How far the tether's points are from the circle of RADIUS about CENTRE at most, m."
  (apply max (map (lambda (i) (abs (- (distance (point-at (* (tether-length) (/ i n))) centre) radius))) (iota (+ n 1)))))

(define-scenario (half-a-circle turned)
  "A line of pi R between clamps that point the same way, 2 R apart, is half a circle, and pulls at nothing;
whichever way a vehicle looks that carries the clamp in its own axes."
  #:for ((turned 0 90 -145))
  (define heading (* turned (/ pi 180)))
  (enter! (world (sea (depth 60))
                 (rov (named v) (type kinematic) (at 2 0 -10) (heading turned))
                 (tether (named l) (type fathom) (wet-weight 0) (ei 2) (bending-damping 0.5) (from 0 0 -10)
                         (from-along 0 1 0) (to v) (to-along (- (sin heading)) (cos heading) 0) (length pi)
                         (nodes 80) (model dynamic))))
  (run 40)
  (expect (off-a-circle 20 1 '(1 0 -10)) is (below 2e-3))
  (expect (y (point-at (/ pi 2))) is (about 1 #:within 2e-3))
  (expect (norm (tether-force)) is (below 0.02)))  ; E I / R^2 is 2 N

(define-scenario half-a-circle-of-a-line-that-stretches
  "Bending shortens no line: half a circle is one even where E I / (E A R^2), by which it would, is a twentieth."
  (enter! (world (sea (depth 60))
                 (rov (named v) (type kinematic) (at 2 0 -10) (pull 1e6))
                 (tether (named l) (type fathom) (wet-weight 0) (ea 1e5) (ei 5000) (bending-damping 50) (from 0 0 -10)
                         (breaking-load 1e6) (from-along 0 1 0) (to v) (to-along 0 1 0) (length pi) (nodes 80)
                         (model dynamic))))
  (run 20)
  (expect (off-a-circle 20 1 '(1 0 -10)) is (below 1e-3))
  (expect (norm (tether-force)) is (below 5))) ; E I / R^2 is 5000 N

(define-scenario a-clamp-turns-with-its-vehicle
  "A vehicle that turns where it stands turns the clamp, and wakes a line that had come to rest."
  (enter! (world (sea (depth 60))
                 (rov (named v) (type kinematic) (at 2 0 -10))
                 (tether (named l) (type fathom) (wet-weight 0) (ei 2) (bending-damping 0.5) (from 0 0 -10)
                         (to v) (to-along 0 1 0) (length 3) (nodes 60) (model dynamic))))
  (settle! #:within 1e-5 #:at-most 120)
  (expect (y (tangent-at 3)) is (below -0.99))
  (hold-heading! 180)
  (run 30)
  (expect (rov-position) is (about '(2 0 -10) #:within 1e-9))
  (expect (y (tangent-at 3)) is (above 0.99)))

(define-scenario (paid-out-from-a-clamp rate)
  "Line that is paid out, or hauled in, leaves its clamp in the clamp's direction."
  #:for ((rate 0.2 -0.2))
  (enter! (world (sea (depth 60))
                 (rov (named v) (type kinematic) (at 3 0 -10))
                 (tether (named l) (type fathom) (wet-weight 0) (ei 2) (bending-damping 0.5) (from 0 0 -10)
                         (from-along 0 1 0) (to v) (length 6) (nodes 60) (model dynamic))))
  (run 5)
  (if (positive? rate) (pay-out! 3 #:rate rate) (haul-in! 2 #:rate (- rate)))
  (run 20)
  (expect (y (tangent-at 0)) is (above 0.99)))

(define-scenario (lumps-come-to-a-clamped-winch ei)
  "Whatever the stiffness, lumps that are hauled into a clamp are felt there by a few times what the winch pulls with."
  #:for ((ei 0.001 0.05 50 1000))
  (enter! (world (sea (current 0.3 90))
                 (rov (named v) (type kinematic) (at 12 0 -8))
                 (tether (named l) (wet-weight 0.2) (ei ei) (from 0 0 -2) (from-along 1 0 0) (to v) (length 16)
                         (clump (at 1) (mass 2)) (float (at 3) (buoyancy 20)) (model dynamic))))
  (run 3)
  (haul-in! 3 #:rate 0.3)
  (always (< (anchor-tension) 300) (run 12)))

(define-scenario a-vehicle-twists-its-line
  "A vehicle that turns under its line twists it by as many turns, awake or asleep: the torque is G J Theta / L at both
ends, in forks and checkpoints too.  Paid out, the line has less of it; cut, none."
  (enter! (world (sea (depth 60))
                 (rov (named v) (type kinematic) (at 0 0 -14) (pull 1e6))
                 (tether (named l) (type fathom) (wet-weight 0.1) (ei 0.5) (gj 0.4) (bending-damping 0.05) (from 0 0 -10)
                         (from-along 0 0 -1) (to v) (to-along 0 0 1) (length 3.99) (nodes 20) (model dynamic))))
  (define (torque) (/ (* 0.4 2 pi (tether-twist)) (tether-length)))
  (settle! #:within 1e-5 #:at-most 60)
  (expect (tether-twist) is (about 0 #:within 1e-9))
  (drive! #:yaw 1)                      ; 45 degrees a second, clockwise as seen from above
  (run 12)
  (drive! #:yaw 0)
  (run 5)
  (expect (tether-twist) is (about 1.5 #:within 1e-3)) ; right-handed about the way down
  (expect (tether-torque) is (about (torque) #:within 1e-9))
  (expect (anchor-torque) is (about (tether-torque) #:within 1e-9))
  (let ((here (checkpoint)))
    (drive! #:yaw -1)
    (run 4)
    (expect (tether-twist) is (about 1 #:within 1e-3))
    (let ((there (state-hash)))
      (restore! here)
      (expect (what-if (begin (drive! #:yaw -1) (run 4) (state-hash))) => there)))
  (pay-out! 2 #:rate 1)
  (run 10)
  (expect (tether-torque) is (about (torque) #:within 1e-9))
  (cut-tether! #:at 1)
  (run 1)
  (expect (list (tether-twist) (tether-torque) (anchor-torque)) => '(0. 0. 0.)))

(define-scenario (laid-at-rest clauses)
  "A line with clamps, or with a set, begins at rest, its bending in balance with the current."
  #:for ((clauses '((set (curvature 1))) '((from-along 1 0 0) (to-along 0 1 0))
                  '((gj 0.03) (from-along 1 0 0) (to-along 0 0 1) (set (curvature 1)) (set (at 1) (span 1) (curvature 2) (plane 90)))))
  (enter! (eval `(world (sea (depth 60) (current 0.3 70))
                        (rov (named v) (type kinematic) (at 2.8 0 -20) (pull 1e6))
                        (tether (named l) (type fathom) (ei 0.05) (from 0 0 -20) (to v) (length 4) (model dynamic) ,@clauses))
                here-module))
  (define (places) (map (lambda (k) (point-at (/ k 2))) (iota 9)))
  (let ((before (places)))
    (run 5)
    (expect (apply max (map distance before (places))) is (below 1e-5))
    (expect (assq-ref (energy) 'kinetic) is (below 1e-8))))

(define-scenario what-a-clamp-wants
  "A clamp bends a line that is stiff and moves; a vehicle with mass is told of no moment."
  (define (line . fields)
    (enter! (world (sea) (rov (named v) (at 2 0 -10))
                   (splice (list (apply (lambda (model ei)
                                          (part tether (named l) (from 0 0 -10) (from-along 1 0 0) (to v) (length 3)
                                                (ei ei) (model ,model)))
                                        fields))))))
  (expect (line 'catenary 1) raises unsupported)
  (expect (line 'dynamic 0) raises unsupported)
  (line 'dynamic 1)
  (expect (alter! 'l #:ei 0) raises unsupported)
  (expect (tether-model! 'l 'catenary) raises unsupported)
  (expect (enter! (world (sea) (rov (named v) (type bluerov2-heavy) (at 2 0 -10))
                         (tether (named l) (from 0 0 -10) (to v) (to-along 0 -1 0) (length 3) (ei 1)
                                 (model dynamic))))
          raises unsupported))
