;;; (bight dive query) --- what one may ask of a dive.
;;;
;;; Every answer is a snapshot: it never changes under the user.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(define-module (bight dive query)
  #:use-module (bight core errors)
  #:use-module (bight core record)
  #:use-module (bight core units)
  #:use-module (bight core verb)
  #:use-module (bight dive)
  #:use-module (bight engine)
  #:use-module ((bight world) #:select (part-head world-part))
  #:use-module (srfi srfi-1)
  #:use-module (srfi srfi-4)
  #:use-module ((srfi srfi-9 gnu) #:select (set-record-type-printer!))
  #:export (tether-tail rov-position rov-velocity rov-heading rov-pitch rov-roll rov-depth rov-altitude rov-over rov-speed
            net-turns sticks held? range-to bearing-to
            current-at sea-depth
            tether-points point-at tangent-at
            tensions tension-at anchor-tension rov-tension max-tension tether-force
            tether-twist tether-torque anchor-torque
            tether-length straight-distance taut-length free-length slack excess
            taut? parted? asleep? settled? model-of energy error-estimate accurate? tightest-bend equilibria
            type:arc-lengths places-of deviation deviation-rms deviation-mean deviation-max deviation-worst deviation?
            events profile parts find-part part-to-alter tether-properties obstacle-properties))

(define (tether-view proc t)
  (%tether (this-engine proc) t))

(define-syntax-rule (define-vehicle-question (name key) doc)
  (define-verb (name #:subject (v vehicle))
    doc
    (%vehicle-value (this-engine 'name) v 'key)))

(define-syntax-rule (define-tether-question (name key) doc)
  (define-verb (name #:subject (t tether))
    doc
    (%tether-value (this-engine 'name) t 'key)))


;;; The vehicle.

(define-vehicle-question (rov-position position)
  "Return where the vehicle is, a point.")
(define-vehicle-question (rov-velocity velocity)
  "Return the velocity of the vehicle over ground, m/s, a vector.")
(define-vehicle-question (rov-heading heading)
  "Return the heading of the vehicle, compass degrees from 0 to 360.")
(define-vehicle-question (rov-pitch pitch)
  "Return the pitch of the vehicle, degrees, bow up positive.")
(define-vehicle-question (rov-roll roll)
  "Return the roll of the vehicle, degrees, starboard down positive.")
(define-vehicle-question (net-turns turns)
  "Return the turns the vehicle has made since the dive began, clockwise positive.")
(define-vehicle-question (sticks sticks)
  "Return the sticks of the vehicle: surge, sway, heave and yaw, each -1 to 1.")
(define-vehicle-question (held? held?)
  "Return #t if a taut tether holds the vehicle back.")

(define-verb (rov-depth #:subject (v vehicle))
  "Return the depth of the vehicle, m."
  (- (%vehicle-value (this-engine 'rov-depth) v 'height)))

(define-verb (rov-altitude #:subject (v vehicle))
  "Return the height of the vehicle above what is straight below it, m: a level seabed, one of a grid or a
mesh, an obstacle on it.  Where `rov-over' says that nothing is, the height above the depth of the sea."
  (car (below 'rov-altitude v)))

(define-verb (rov-over #:subject (v vehicle))
  "Return the name of what is straight below the vehicle, #f where nothing is: a sea has no bed without the
part `seabed'."
  (cdr (below 'rov-over v)))

(define (below proc v)
  (%altitude (this-engine proc) (rov-position-of proc v)))

(define-verb (rov-speed #:subject (v vehicle))
  "Return the speed of the vehicle over ground, m/s."
  (norm (%vehicle-value (this-engine 'rov-speed) v 'velocity)))

(define (rov-position-of proc v)
  (%vehicle-value (this-engine proc) v 'position))

(define-verb (range-to #:subject (v vehicle) (p point))
  "Return the distance from the vehicle to the point P, m."
  (distance (rov-position-of 'range-to v) p))

(define-verb (bearing-to #:subject (v vehicle) (p point))
  "Return the compass bearing from the vehicle to the point P, degrees from 0 to 360."
  (let* ((way (vec- p (rov-position-of 'bearing-to v)))
         (degrees (* (atan (x way) (y way)) (/ 180 (acos -1)))))
    (if (< degrees 0) (+ degrees 360) degrees)))


;;; The sea.

(define-verb (current-at (p point))
  "Return the velocity of the water at the point P now, m/s, a vector."
  (%current-at (this-engine 'current-at) p))

(define-verb (sea-depth)
  "Return the depth of the sea, m."
  (assq-ref (%sea (this-engine 'sea-depth)) 'depth))


;;; The tether's shape.

(define most-points 100000)

(define-argument-type (points-wanted value)
  "how many points, a whole number from 2 to 100000"
  (if (and (real? value) (<= 2 value most-points) (integer? value)) (inexact->exact value) refused))

(define-verb (tether-points #:subject (t tether) #:optional (n points-wanted 0))
  "Return the polyline of the tether from its anchor to the vehicle, an n x 3 array: the model's own
nodes, or N points equally spaced in arc length, both ends included.  Between nodes a line is read off
a smooth curve, no piece of which is longer than its line by more than 1 % of it."
  (%tether-points (this-engine 'tether-points) t n))

(define-verb (tether-tail #:subject (t tether))
  "Return the polyline of the part of a parted tether that hangs from the vehicle, from its new end on, or
#f when the tether is whole."
  (%tether-tail (this-engine 'tether-tail) t))

(define-verb (point-at #:subject (t tether) (s number))
  "Return the point of the tether at arc length S metres from its anchor.  Raise domain if S lies outside
what is out."
  (%point-at (this-engine 'point-at) t s))

(define-verb (tangent-at #:subject (t tether) (s number))
  "Return the unit tangent of the tether, toward the vehicle, at arc length S metres from its anchor."
  (%tangent-at (this-engine 'tangent-at) t s))


;;; Tension.

(define-verb (tensions #:subject (t tether) #:optional (n points-wanted 0))
  "Return the tensions in newtons at the points of `tether-points', an f64vector."
  (%tether-tensions (this-engine 'tensions) t n))

(define-verb (tension-at #:subject (t tether) (s number))
  "Return the tension of the tether in newtons at arc length S metres from its anchor."
  (%tension-at (this-engine 'tension-at) t s))

(define-tether-question (anchor-tension tension-anchor)
  "Return the tension of the tether at its anchor, N.")
(define-tether-question (rov-tension tension-end)
  "Return the tension of the tether at the vehicle, N.")
(define-tether-question (max-tension tension-max)
  "Return the largest tension along the tether now, its ends included, N: the one it parts by.  Where
the last step was taken in parts (`tension-accuracy'), it is the largest in all of these.")
(define-tether-question (tether-force force)
  "Return the force of the tether on the vehicle, N, a vector.")


;;; Twist.

(define turn (* 8 (atan 1)))            ; radians

(define-verb (tether-twist #:subject (t tether))
  "Return by how many turns the far end of the tether is twisted against its anchor, right-handed about the way from the
anchor: of a moving line with `gj' that is clamped at both ends, since it was laid.  What it writhes in loops is
untwisted.  0 of any other line."
  (/ (assq-ref (tether-view 'tether-twist t) 'twist) turn))

(define-tether-question (tether-torque torque-end)
  "Return the torque in the tether at its far end, N m, right-handed about the way from the anchor: 0 unless a moving
line with `gj' is clamped at both ends.")

(define-tether-question (anchor-torque torque-anchor)
  "Return the torque in the tether at its anchor, N m, right-handed about the way from the anchor: `tether-torque', and
what a set along the line takes up on the way.  0 of a line that is not clamped at its anchor, or has no `gj'.")


;;; Lengths.

(define-tether-question (tether-length length)
  "Return how much tether is out, m.")
(define-tether-question (straight-distance chord)
  "Return the straight distance between the ends of the tether, m; of a parted one to its new end.")
(define (open-water? engine)
  ;; Nothing could hold a tether: the chord is all.
  (null? (%names engine 'obstacle)))

(define-verb (taut-length #:subject (t tether))
  "Return the length the tether would take if it were pulled tight through nothing, m; in open water the
straight distance."
  (let ((engine (this-engine 'taut-length)))
    (if (open-water? engine) (assq-ref (%tether engine t) 'chord) (%taut-length engine t))))

(define-verb (free-length #:subject (t tether))
  "Return the length of the shortest way from the anchor to the vehicle, m; in open water the straight
distance."
  (let ((engine (this-engine 'free-length)))
    (if (open-water? engine) (assq-ref (%tether engine t) 'chord) (%free-length engine t))))

(define-verb (slack #:subject (t tether))
  "Return the share of the tether that is slack, (out - taut) / out: 1 when it has parted, for nothing
holds its end."
  (let* ((view (tether-view 'slack t)) (out (assq-ref view 'length)))
    (if (assq-ref view 'parted?)
        1.0
        (max 0.0 (- 1 (/ (taut-length (tether-called t)) out))))))

(define-verb (excess #:subject (t tether))
  "Return by how much the taut length exceeds the free length, m; in open water 0."
  (let ((name (tether-called t)))
    (max 0.0 (- (taut-length name) (free-length name)))))

(define (tether-called t)
  (list-ref (%names (this-engine 'tether-length) 'tether) t))

(define-verb (taut? #:subject (t tether))
  "Return #t if the tether is pulled tight: its model says so, as the event `taut' tells, or, among
obstacles, less than a hundredth of it is slack round what it touches.  `foresee' goes by the same rule."
  (%taut? (this-engine 'taut?) t))
(define-tether-question (parted? parted?)
  "Return #t if the tether is in two; then the part at the anchor is what one asks about.")
(define-tether-question (asleep? asleep?)
  "Return #t if the moving line rests, so that it is not stepped.")
(define-tether-question (settled? settled?)
  "Return #t unless the tether still moves by itself.")

(define-verb (model-of #:subject (t tether))
  "Return the model of the tether, a symbol."
  (assq-ref (tether-properties t) 'model))

(define (tether-properties t)
  "Return the properties of tether number T, an alist by field."
  (%tether-properties (this-engine 'describe) t))

(define-verb (tightest-bend #:subject (t tether))
  "Return the radius of the tightest bend of the tether, m, infinite when it is straight: the smallest
circle through three neighbours among the model's own points."
  (%tightest-bend (this-engine 'tightest-bend) t))

(define-verb (energy #:subject (t tether))
  "Return the energies of the moving line in joules by kind: kinetic (added mass moves too), strain,
gravity (from z = 0) and bending, and what was lost where it parted, an alist; of a line that has parted those of both
parts.  No break changes the sum of all.  Raise unsupported for static models."
  (%energy (this-engine 'energy) t))

(define-verb (error-estimate #:subject (t tether))
  "Return the estimated error in position of the moving line, m: of its nodes; what is left of the error that
it had with fewer nodes before; or what it is longer or shorter than what is out, since nodes came or went:
the largest of these.  Raise unsupported for static models."
  (let ((error (%error-estimate (this-engine 'error-estimate) t)))
    (if (nan? error)
        (bight-raise 'unsupported 'error-estimate
                     "the model ~a does not estimate its error; dynamic and auto do"
                     (assq-ref (tether-properties t) 'model))
        error)))

;; What the user asked for is kept by the mesh where it can be; where it cannot, status, the pilot's view
;; and the coach say so.
(define-verb (accurate? #:subject (t tether))
  "Return #t if the tether is as exact as its world asks: if the estimate of its error in position,
`error-estimate', is at most the tether's `accuracy', and the tension of the last step
was found to its `tension-accuracy'.  Static models are."
  (let ((error (%error-estimate (this-engine 'accurate?) t)) (view (tether-view 'accurate? t)))
    (and (or (nan? error) (<= error (assq-ref view 'accuracy)))
         (zero? (assq-ref view 'tension-error)))))

(define-verb (equilibria #:subject (t tether))
  "Return the distinct shapes in which the tether could rest with its ends where they are, polylines, the
one found from its own side first.  The search tries bows to every side; finding one does not prove that
there is no other.  Only the model `steady' looks."
  (%equilibria (this-engine 'equilibria) t))


;;; Against a measurement.

(define-record <deviation>
  (make-deviation rms mean max worst)
  deviation-record?
  (rms %rms) (mean %mean) (max %max) (worst %worst))

(define (millimetres m)
  (/ (round (* 10000 m)) 10))

(set-record-type-printer!
 <deviation>
 (lambda (d port)
   (format port "#<deviation rms ~a mm, mean ~a mm, max ~a mm at ~a m>"
           (millimetres (%rms d)) (millimetres (%mean d)) (millimetres (%max d))
           (/ (round (* 100 (%worst d))) 100))))

(define-argument-type (deviation value)
  "what `deviation' returns"
  (if (deviation-record? value) value refused))

(define-verb (deviation? (object any))
  "Return #t if OBJECT is a deviation."
  (deviation-record? object))
(define-verb (deviation-rms (d deviation))
  "Return the root mean square distance of the deviation D, m."
  (%rms d))
(define-verb (deviation-mean (d deviation))
  "Return the mean distance of the deviation D, m."
  (%mean d))
(define-verb (deviation-max (d deviation))
  "Return the largest distance of the deviation D, m."
  (%max d))
(define-verb (deviation-worst (d deviation))
  "Return the arc length of the largest distance of the deviation D, m."
  (%worst d))

(define (row polyline i)
  (f64vector (array-ref polyline i 0) (array-ref polyline i 1) (array-ref polyline i 2)))

(define (polyline-rows polyline)
  (map (lambda (i) (row polyline i)) (iota (array-length polyline))))

(define (chord-lengths points)
  ;; Arc lengths along the polyline of POINTS, from 0.
  (let loop ((rest points) (s 0.0) (lengths '()))
    (if (null? (cdr rest))
        (reverse! (cons s lengths))
        (loop (cdr rest) (+ s (distance (car rest) (cadr rest))) (cons s lengths)))))

(define (spread-over length points)
  ;; The arc lengths of POINTS, stretched so that the last lies at LENGTH.
  (let* ((lengths (chord-lengths points))
         (whole (last lengths)))
    (if (zero? whole)
        (bight-raise 'domain 'deviation "the measured points all coincide")
        (map (lambda (s) (min length (* length (/ s whole)))) lengths))))

(define-argument-type (arc-lengths value)
  "a list of arc lengths in metres, one for each point"
  (if (and (list? value) (every (lambda (s) (accepts? type:non-negative s)) value)) value refused))

;; The arc lengths of points that know them: `transponders' sets it.
(define places-of (make-object-property))

(define-argument-type (measured value)
  ;; A polyline and the arc lengths it knows.
  (argument-type-sentence type:points)
  (if (accepts? type:points value)
      (cons (check-argument 'deviation 'points type:points value) (places-of value))
      refused))

(define-verb (deviation #:subject (t tether) (points measured) #:key (at arc-lengths #f))
  "Return how far the tether lies from the measured POINTS: rms, mean and largest distance, and the arc
length of that.  AT lists the arc length of each point; left out, the points run from anchor to vehicle
and are matched by their own arc length, or as `transponders' knows them: (deviation (transponders 10
#:noise .02))."
  (let* ((engine (this-engine 'deviation))
         (measured (polyline-rows (car points)))
         (out (assq-ref (%tether engine t) 'length))
         (places (or at (cdr points) (spread-over out measured))))
    (unless (= (length places) (length measured))
      (bight-raise 'domain 'deviation "~a arc lengths were given for ~a points"
                   (length places) (length measured)))
    (summary places
             (map (lambda (s p) (distance p (%point-at engine t s))) places measured))))

(define (summary places distances)
  (let* ((n (length distances))
         (worst (apply max distances)))
    (make-deviation (sqrt (/ (fold (lambda (d sum) (+ sum (* d d))) 0.0 distances) n))
                    (/ (apply + distances) n)
                    worst
                    (list-ref places (list-index (lambda (d) (= d worst)) distances)))))


;;; The dive as a whole.

(define-verb (events #:key (since number -1.0))
  "Return what has happened later than SINCE seconds, oldest first: lists (KIND TIME SUBJECT).  Asking
never drains them; the last 128 are kept."
  (filter (lambda (event) (> (cadr event) since))
          (%events (this-engine 'events) 0)))

(define-verb (profile)
  "Return the work done since the dive began and the work skipped, an alist of counters.  What was done in
vain is work too, but for steps and chain-steps, which are those taken; chain-tries are all tries at them."
  (%profile (this-engine 'profile)))

(define-verb (parts)
  "Return the names of the parts of the dive, symbols: vehicles, then tethers, then obstacles."
  (let ((engine (this-engine 'parts)))
    (append-map (lambda (kind) (%names engine kind)) '(rov tether obstacle))))

(define (obstacle-properties proc index)
  "Return the alist of what the obstacle number INDEX is and where; PROC asks."
  (%obstacle (this-engine proc) index))

(define (find-part proc name)
  "Return the kind (vehicle, tether or obstacle) and index of the part called NAME, or raise a &bight-error
from PROC."
  (let* ((engine (this-engine proc))
         (index (lambda (names) (list-index (lambda (n) (eq? n name)) names)))
         (vehicle (index (%names engine 'rov)))
         (tether (index (%names engine 'tether)))
         (obstacle (index (%names engine 'obstacle))))
    (cond (vehicle (values 'vehicle vehicle))
          (tether (values 'tether tether))
          (obstacle (values 'obstacle obstacle))
          (else
           (unknown-name proc "this dive" name (parts) "part")))))

(define (part-to-alter proc name)
  "Return the head and the index of the part called NAME, or raise a &bight-error from PROC; the sea is one."
  (if (eq? name 'sea)
      (values 'sea 0)
      (call-with-values (lambda () (find-part proc name))
        (lambda (kind index)
          (values (case kind
                    ((vehicle) 'rov)
                    ((obstacle) (part-head (world-part (dive-world (this-dive proc)) name)))
                    (else kind))
                  index)))))
