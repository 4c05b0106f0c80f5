;;; (bight dive instruments) --- what a pilot can read: instruments with noise and faults, sonar, camera.
;;;
;;; The queries of (bight dive query) tell the truth; these tell what a vehicle's instruments show, which is #f
;;; where one shows nothing.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(define-module (bight dive instruments)
  #:use-module ((bight core argument) #:select (choice))
  #:use-module (bight core errors)
  #:use-module (bight core verb)
  #:use-module (bight dive)
  #:use-module ((bight dive query) #:select (places-of))
  #:use-module (bight engine)
  #:use-module (srfi srfi-1)
  #:use-module (srfi srfi-4)
  #:export (instruments compass depth-sensor altimeter speed-log turn-counter ship-range ship-bearing
            load-cell payout-counter transponders
            fault! mend! faults thrusts
            sonar in-view? tether-in-view))

(define-verb (instruments #:subject (v vehicle))
  "Return what all instruments of the vehicle show, an alist: heading pitch roll (degrees), depth altitude
(m), ahead aside up (m/s over ground), turns, range and bearing to the ship (m, degrees), tension (N) and
payout (m) at the winch."
  (%instruments (this-engine 'instruments) v))

(define-syntax-rule (define-instrument (name key) doc)
  (define-verb (name #:subject (v vehicle))
    doc
    (assq-ref (%instruments (this-engine 'name) v) 'key)))

(define-instrument (compass heading)
  "Return what the compass of the vehicle shows, degrees from 0 to 360.")
(define-instrument (depth-sensor depth)
  "Return what the depth sensor of the vehicle shows, m.")
(define-instrument (altimeter altitude)
  "Return the height above what is below the vehicle that its altimeter shows, m; see `rov-altitude'.")
(define-instrument (turn-counter turns)
  "Return the turns that the vehicle has made by its own count, clockwise positive.")
(define-instrument (ship-range range)
  "Return the range from the vehicle to the ship, where its tether's anchor is, m.")
(define-instrument (ship-bearing bearing)
  "Return the compass bearing from the vehicle to the ship, degrees.")
(define-instrument (load-cell tension)
  "Return the tension at the anchor that the load cell of the winch shows, N.")
(define-instrument (payout-counter payout)
  "Return the length out that the counter of the winch shows, m.")

(define-verb (speed-log #:subject (v vehicle))
  "Return the speeds over ground that the vehicle shows, ahead, to starboard and up, m/s, a list."
  (let ((all (%instruments (this-engine 'speed-log) v)))
    (map (lambda (key) (assq-ref all key)) '(ahead aside up))))


;;; Along the tether.

(define-argument-type (transponder-count value)
  "how many, a whole number from 2 to 100000"
  (if (and (exact-integer? value) (<= 2 value 100000)) value refused))

(define-verb (transponders #:subject (t tether) (n transponder-count) #:key (noise (between 0 1000) 0))
  "Return where N transponders along an instrumented tether say that they are, an n x 3 array: equally
spaced in arc length from the anchor to the vehicle, each coordinate with Gaussian noise of standard
deviation NOISE in metres.  At one step of a dive it is always the same noise, from the `seed' of the
vehicle.  The points know their arc lengths: (deviation (transponders 10 #:noise .02)) is the noise, but
asked of another model, of another tether or later, how far that lies from what was measured."
  (let* ((engine (this-engine 'transponders))
         (length (assq-ref (%tether engine t) 'length))
         (points (%transponders engine t n noise)))
    (set! (places-of points) (map (lambda (k) (* length (/ k (- n 1)))) (iota n)))
    points))


;;; Faults.

(define names (%fault-names))

(define type:fault (choice (map car names)))

(define degree (/ (acos -1) 180))

(define (set-fault! proc v fault on value)
  (%operate! (this-engine proc) 'fault! proc v
             (f64vector (assq-ref names fault) (if on 1 0) value))
  (%faults (this-engine proc) v))

(define-verb (fault! #:subject (v vehicle) (fault fault) #:optional (value number 0))
  "Break something of the vehicle, as an instructor does: the compass, which then drifts by VALUE degrees
a second; the sensors of depth, speed, altitude or tension; telemetry; or the thruster number VALUE.
Return all that is broken."
  (set-fault! 'fault! v fault #t (if (eq? fault 'compass) (* degree value) value)))

(define-verb (mend! #:subject (v vehicle) (fault fault) #:optional (value number 0))
  "Mend what `fault!' broke.  Return what is still broken."
  (set-fault! 'mend! v fault #f value))

(define-verb (faults #:subject (v vehicle))
  "Return what is broken of the vehicle: symbols, and (thruster K)."
  (%faults (this-engine 'faults) v))

(define-verb (thrusts #:subject (v vehicle))
  "Return what each thruster of the vehicle pushes with now, N, an f64vector; it is empty without mass."
  (%thrusts (this-engine 'thrusts) v))


;;; Seeing.

(define-argument-type (beam-count value)
  "a whole number from 1 to 1024"
  (if (and (exact-integer? value) (<= 1 value 1024)) value refused))

(define-verb (sonar #:subject (v vehicle) #:key (beams beam-count 120) (sector (between 0 360) 120)
                    (tilt (between -90 90) 0) (range positive 50) (width (between 0 179) #f))
  "Return the distances of the first echoes of BEAMS beams, from port to starboard over SECTOR degrees
about ahead, to RANGE metres: an f64vector, +inf.0 where nothing comes back.  Obstacles echo, hulls of other
vehicles, clumps and floats; and tethers, in a beam WIDTH degrees wide, 0: not at all.  Unless told, beams are as
wide as they are apart, a single one a degree."
  (%sonar (this-engine 'sonar) v
          (f64vector sector tilt (or width (if (= 1 beams) 1 (min 179 (/ sector (- beams 1))))))
          range beams))

(define (sighting proc v t width height tilt sight)
  (%sight (this-engine proc) v t (f64vector width height tilt) sight))

(define (own-tether proc v)
  ;; The tether of the vehicle number V.
  (let* ((engine (this-engine proc))
         (mine (filter (lambda (i) (eqv? v (assq-ref (%tether engine i) 'vehicle)))
                       (iota (length (%names engine 'tether))))))
    (if (null? mine)
        (bight-raise 'name proc "the vehicle is on no tether")
        (car mine))))

(define-verb (tether-in-view #:subject (v vehicle) #:key (width (between 1 179) 80)
                             (height (between 1 179) 64) (tilt (between -90 90) 0) (sight positive 10))
  "Return how many metres of its own tether the camera at the bow of the vehicle sees: within WIDTH by
HEIGHT degrees, TILT up, no farther than SIGHT metres, and not behind an obstacle."
  (car (sighting 'tether-in-view v (own-tether 'tether-in-view v) width height tilt sight)))

(define-verb (in-view? #:subject (v vehicle) #:key (width (between 1 179) 80)
                       (height (between 1 179) 64) (tilt (between -90 90) 0) (sight positive 10))
  "Return #t if the camera of the vehicle sees some of its own tether; see `tether-in-view'."
  (> (car (sighting 'in-view? v (own-tether 'in-view? v) width height tilt sight)) 0))
