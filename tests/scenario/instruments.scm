;;; What a pilot can read, see and be misled by.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(use-modules (srfi srfi-4))

(define (basin . noise)
  (world (sea (depth 30))
         (seabed)
         (box (named wall) (at 0 20 -15) (size 30 2 30))
         (cylinder (named pile) (from 5 10 0) (to 5 10 -30) (radius 0.5))
         (rov (named minnow) (type bluerov2-heavy) (at 0 0 -10))
         (tether (named line) (type fathom) (from 0 -10 0) (to minnow) (length 20) (model dynamic))))

(define-scenario perfect-instruments
  "Without noise and faults they tell the truth."
  (in (basin))
  (hold-depth! 10)
  (drive! #:surge 0.3)
  (run 5)
  (expect (compass) is (about (rov-heading) #:degrees #:within 1e-9))
  (expect (depth-sensor) is (about (rov-depth) #:within 1e-12))
  (expect (altimeter) is (about (- 30 (rov-depth)) #:within 1e-9))
  (expect (first (speed-log)) is (about (rov-speed) #:within 1e-3))
  (expect (load-cell) is (about (anchor-tension) #:within 1e-12))
  (expect (payout-counter) => 20.0)
  (expect (ship-range) is (about (range-to '(0 -10 0)) #:within 1e-9))
  (expect (ship-bearing) is (about (bearing-to '(0 -10 0)) #:degrees #:within 1e-9)))

(define (first x) (car x))

(define-scenario noise-is-seeded
  "Noise has the spread it was given and comes again from the same seed."
  (in (with (basin) (minnow (depth-noise 0.1) (seed 7))))
  (hold-position!)
  (let* ((read-all (lambda () (map (lambda (i) (step!) (- (depth-sensor) (rov-depth))) (iota 600))))
         (start (checkpoint))
         (errors (read-all)))
    (expect (sqrt (/ (apply + (map * errors errors)) 600)) is (about 0.1 #:within 0.01))
    (restore! start)
    (expect (equal? errors (read-all)))))

(define-scenario what-an-instructor-breaks
  "The compass drifts, the depth stands still, the altimeter is blind, the load cell dead; mended, they are
as before."
  (in (basin))
  (hold-position!)
  (fault! 'compass 0.5)
  (fault! 'depth)
  (fault! 'altitude)
  (fault! 'tension)
  (expect (faults) => '(compass depth altitude tension))
  (run 20)
  (expect (compass) is (about (+ 10 (rov-heading)) #:degrees #:within 1e-6))
  (release!)
  (drive! #:heave -0.5)
  (run 5)
  (expect (depth-sensor) is (about 10 #:within 0.01))
  (expect (rov-depth) is (above 11))
  (expect (altimeter) => #f)
  (expect (load-cell) => 0.0)
  (for-each mend! '(compass depth altitude tension))
  (expect (faults) => '())
  (expect (depth-sensor) is (about (rov-depth) #:within 1e-12))
  (expect (fault! 'cmpass) raises name)
  (expect (fault! 'thruster 8) raises domain))

(define-scenario a-dead-thruster
  "With a thruster dead it pushes nothing, and the vehicle makes less way and turns from its course."
  (in (world (sea (depth 60)) (rov (named minnow) (type bluerov2-heavy) (at 0 0 -30))))
  (stabilise! #f)
  (fault! 'thruster 0)
  (drive! #:surge 0.5)
  (run 4)
  (expect (f64vector-ref (thrusts) 0) => 0.0)
  (expect (abs (net-turns)) is (above 0.02)))

(define-scenario telemetry-goes-with-the-tether
  "Parted from its ship, the vehicle tells nothing; the winch goes on telling."
  (in (basin))
  (run 1)
  (cut-tether! #:at 10)
  (run 1)
  (expect (compass) => #f)
  (expect (depth-sensor) => #f)
  (expect (payout-counter) is (about 10 #:within 0.5)))

(define-scenario sonar-measures
  "Each echo is as far as the wall or the pile that its beam meets, within a centimetre."
  (in (basin))
  (hold-position!)
  (run 20)
  (let* ((echo (sonar #:beams 121 #:sector 120)) (bow (+ (y (rov-position)) 0.2285)))
    (expect (f64vector-ref echo 60) is (about (- 19 bow) #:within 0.01))
    (expect (f64vector-ref echo 90) is (about (/ (- 19 bow) (cos (/ (acos -1) 6))) #:within 6))
    (expect (f64vector-ref (sonar #:beams 1) 0) is (about (- 19 bow) #:within 0.01))
    (let* ((to-pile (bearing-to '(5 10 -10))) (range (- (sqrt (+ 25 (expt (- 10 bow) 2))) 0.5)))
      (expect (apply min (map (lambda (i) (f64vector-ref echo i)) (iota 40 70)))
              is (about range #:within 0.02)))
    (expect (f64vector-ref (sonar #:beams 1 #:range 5) 0) => +inf.0)))

(define-scenario is-my-tether-in-view
  "The tether behind is not in view; turned round, it is; and not through a wall."
  (in (basin))
  (hold-position!)
  (run 5)
  (expect (in-view? #:tilt 45 #:sight 100) => #f)
  (hold-heading! 180)
  (run 15)
  (expect (in-view? #:tilt 45 #:sight 100))
  (expect (tether-in-view #:tilt 45 #:sight 100) is (above (tether-in-view #:tilt 45 #:sight 8))))

(define-scenario the-tether-near-the-props
  "Backing over its own tether brings it near to a thruster that turns: an event, once."
  (in (world (sea (depth 60))
             (rov (named minnow) (type bluerov2-heavy) (at 0 4 -10))
             (tether (named line) (type fathom) (wet-weight 0) (from 0 0 -10) (to minnow) (length 5)
                     (model dynamic))))
  (hold-depth! 10)
  (drive! #:surge -0.4)
  (run 12)
  (expect (assq 'prop-danger (events))))

(define-scenario transponders-along-the-tether
  "An instrumented tether shows its shape with the noise it was given: the same again from the same seed, new
at every step; so a model can be held against it."
  (in (with (basin) (minnow (seed 7))))
  (drive! #:surge 0.3)
  (run 5)
  (expect (deviation-max (deviation (transponders 20))) is (below 1e-12))
  (expect (equal? (transponders 20) (tether-points 20)))
  (expect (deviation-rms (deviation (transponders 2000 #:noise 0.02)))
          is (about (* (sqrt 3) 0.02) #:within 1e-3))
  (let ((start (checkpoint))
        (read-all (lambda () (map (lambda (i) (step!) (transponders 5 #:noise 0.1)) (iota 10)))))
    (let ((once (read-all)))
      (expect (equal? (first once) (cadr once)) => #f)
      (restore! start)
      (expect (equal? once (read-all)))))
  (let ((measured (transponders 20 #:noise 0.02)))
    (tether-model! 'rubber-band)
    (expect (deviation-rms (deviation measured)) is (above 0.1)))
  (expect (transponders 1) raises domain)
  (expect (transponders 5 #:noise -1) raises domain))

(define (ahead . options)
  ;; What a single beam of the eye reads.
  (f64vector-ref (apply sonar 'eye #:beams 1 options) 0))

(define-scenario a-sonar-hears-hulls-clumps-and-lines
  "The hull of another is as far as its nearer side, turned or not; a clump as far as a ball of its steel; a line is heard
by a beam that has a width, and nothing is heard through what is solid."
  (in (world (sea (depth 100))
             (rov (named eye) (type kinematic) (at 0 0 -30) (size 0.5 1 0.5))
             (rov (named other) (type kinematic) (at 0 10 -30) (size 3 1 1))
             (rov (named turned) (type kinematic) (at 30 10 -30) (heading 90) (size 3 1 1))
             (tether (named line) (type fathom) (wet-weight 0) (model dynamic) (from -20 40 -30) (to other) (length 37)
                     (clump (at 15) (mass 40)))))
  (expect (ahead #:width 0) is (about 9 #:within 1e-9))
  (place! 'eye '(30 0 -30))
  (expect (ahead #:width 0) is (about 8 #:within 1e-9))
  (let* ((at (point-at 15)) (radius (expt (/ (* 3 (/ 40 7850)) (* 4 (acos -1))) 1/3)))
    (place! 'eye (vec (x at) (- (y at) 6) (z at)))
    (expect (ahead #:width 0) is (about (- 5.5 radius) #:within 1e-3)))
  (let ((p (point-at 28)))
    (place! 'eye (vec (x p) (- (y p) 6) (z p)))
    (expect (ahead #:width 0) => +inf.0)
    (expect (ahead #:width 4) is (between 5.2 5.5))
    (expect (ahead #:width 4 #:range 5) => +inf.0)))
