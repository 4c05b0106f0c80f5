;;; Altitude: what is straight below, whatever that is, asked in whatever way.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(use-modules (srfi srfi-1) (srfi srfi-4) (srfi srfi-71))

;;; Beds of every kind: their parts; a procedure of X, Y and the time, the height of their top by a closed
;;; form that knows no ray, #f beside them; the height of what is there then.

(define depth 60)

(define (plane a b c)
  (lambda (x y t) (+ a (* b x) (* c y))))

(define (inside half height)
  (lambda (x y t) (and (<= (abs x) half) (<= (abs y) half) (height x y t))))

(define (grid-part height)
  (part seabed (grid (lambda (x y) (height x y 0)) (from -30 -30) (to 30 30) (spacing 3))))

(define (flat)
  (values (list (part seabed)) (plane (- depth) 0 0) #f))

(define (sloping)
  (let ((height (plane -38 0.1 0.3)))
    (values (list (grid-part height)) (inside 30 height) (- depth))))

(define (deep)
  ;; A bed below the depth that the sea is said to have.
  (let ((height (plane -80 0 0.2)))
    (values (list (grid-part height)) (inside 30 height) -87)))

(define (on-a-slope)
  (let* ((height (plane -38 0 0.3)) (bed (inside 30 height)))
    (values (list (grid-part height) (part box (named block) (at 0 0 -38) (size 12 12 16)))
            (lambda (x y t) (if (and (<= (abs x) 6) (<= (abs y) 6)) -30 (bed x y t)))
            (- depth))))

(define (box)
  (values (list (part box (named block) (at 0 0 -40) (size 30 30 10)))
          (inside 15 (plane -35 0 0)) #f))

(define (tilted-box)
  ;; Pitched by 20 degrees: its top rises to the north, and its north face is seen from above.
  (let* ((angle (* 20 (/ (acos -1) 180))) (c (cos angle)) (s (sin angle)))
    (values (list (part box (named ramp) (at 0 0 -40) (size 30 40 8) (pitch 20)))
            (lambda (x y t)
              (let ((along (/ (+ y (* 4 s)) c)))
                (and (<= (abs x) 15)
                     (cond ((<= -20 along 20) (+ -40 (* along s) (* 4 c)))
                           ((and (> along 20) (<= y (+ (* 20 c) (* 4 s))))
                            (+ -40 (* 20 s) (/ (- (* 20 c) y) (tan angle))))
                           (else #f)))))
            #f)))

(define (convex)
  ;; A wedge whose top falls by 0.2 to the east.
  (values (list (part convex (named wedge)
                      (points (-20 -20 -50) (20 -20 -50) (20 20 -50) (-20 20 -50)
                              (-20 -20 -32) (20 -20 -40) (20 20 -40) (-20 20 -32))))
          (inside 20 (plane -36 -0.2 0)) #f))

(define (sphere)
  (values (list (part sphere (named boulder) (at 3 4 -45) (radius 20)))
          (lambda (x y t)
            (let ((square (- 400 (expt (- x 3) 2) (expt (- y 4) 2))))
              (and (>= square 0) (+ -45 (sqrt square)))))
          #f))

(define (bar x y t)
  (and (<= (abs y) 15) (+ -40 (sqrt (- 225 (* y y))))))

(define (cylinder)
  (values (list (part cylinder (named bar) (from -40 0 -40) (to 40 0 -40) (radius 15))) bar #f))

(define (capsule)
  (values (list (part capsule (named bar) (from -40 0 -40) (to 40 0 -40) (radius 15))) bar #f))

(define (moving)
  (values (list (part box (named barge) (size 20 20 4) (track (0 -20 0 -30) (100 20 0 -20))))
          (lambda (x y t)
            (let ((share (min 1 (/ t 100))))
              (and (<= (abs (- x (* 40 share) -20)) 10) (<= (abs y) 10) (+ -28 (* 10 share)))))
          #f))

(define (moving-over-a-grid)
  (let* ((height (plane -38 0.1 0.3)) (bed (inside 30 height))
         (parts above nothing (moving)))
    (values (cons (grid-part height) parts)
            (lambda (x y t) (or (above x y t) (bed x y t)))
            (- depth))))

(define (nothing)
  (values '() (lambda (x y t) #f) #f))

;;; Every way to ask.

(define random-numbers (seed->random-state (or (and=> (getenv "BIGHT_SEED") string->number) 7)))

(define (between-random low high)
  (+ low (* (- high low) (random:uniform random-numbers))))

(define hud-altitude
  (let ((read (@@ (bight cockpit hud) read-figures)) (altitude (@@ (bight cockpit hud) figures-altitude)))
    (lambda () (altitude (read 'minnow #f)))))

(define (text-of picture)
  (with-output-to-string (lambda () (display picture))))

(define (shown-altitude)
  ;; What the panel shows, a number.
  (let* ((text (text-of (status)))
         (from (+ 9 (string-contains text "altitude "))))
    (string->number (substring text from (string-index text #\space from)))))

(define (echo-below)
  (f64vector-ref (sonar #:beams 1 #:tilt -90 #:range 200) 0))

(define (agree? wanted)
  (and (< (abs (- (rov-altitude) wanted)) 1e-8)
       (= (rov-altitude) (altimeter) (hud-altitude))
       (<= (abs (- (shown-altitude) (rov-altitude))) 0.006)
       (or (not (rov-over)) (< (abs (- (echo-below) wanted)) 1e-8))))

(define (at-random parts)
  (enter! (world (sea (depth depth)) (splice parts)
                 (rov (named minnow) (at 0 0 -1) (heave-speed 5))))
  (run (between-random 0 30))
  (place! (vec (between-random -40 40) (between-random -40 40) (between-random -12 0)) #:fresh #t))

(define-scenario (altitude-is-the-way-down bed)
  "The query, the altimeter, the panel, the head-up display and a beam straight down agree with the closed
form, over what stands, slopes or moves, beside it, and where there is nothing."
  #:for ((bed flat sloping deep on-a-slope box tilted-box convex sphere cylinder capsule moving
              moving-over-a-grid nothing))
  (let ((parts top floor (bed)))
    (define (check)
      (let* ((p (rov-position)) (height (top (x p) (y p) (now))))
        (expect (agree? (- (z p) (or height floor (- depth)))))
        (expect (->bool (rov-over)) => (->bool (or height floor)))))
    (for-each (lambda (k) (at-random parts) (check)) (iota 40))))

(define-scenario (altitude-is-held bed)
  "Without mass too the altitude is held, while what is below slopes, ends or moves."
  #:for ((bed flat sloping deep on-a-slope box tilted-box convex sphere cylinder capsule moving
              moving-over-a-grid nothing))
  (let ((parts top floor (bed)))
    (for-each
     (lambda (k)
       (at-random parts)
       (let ((wanted (between-random 1 12)))
         (hold-altitude! wanted)
         (drive! #:surge (between-random -0.5 0.5) #:sway (between-random -0.5 0.5))
         (run 25)
         ;; After an edge it takes a while: that there is none within a second is seen afterwards.
         (let ((before (rov-altitude)))
           (run 1)
           (when (< (abs (- before wanted)) 1e-6)
             (expect (rov-altitude) is (about wanted #:within 0.03))))
         (drive! #:surge 0 #:sway 0)
         (run 20)
         (unless (memq bed (list moving moving-over-a-grid))
           (expect (rov-altitude) is (about wanted #:within 1e-6)))))
     (iota 5))))

(define-scenario with-mass-too
  "A vehicle with thrusters keeps its altitude over a slope."
  (let ((parts top floor (sloping)))
    (enter! (world (sea (depth depth)) (splice parts)
                   (rov (named minnow) (type bluerov2-heavy) (at 0 -20 -35))))
    (hold-altitude! 5)
    (run 30)
    (drive! #:surge 0.2)
    (run 40)
    (expect (y (rov-position)) is (above -15))
    (expect (rov-altitude) is (about 5 #:within 0.3))))

(define-scenario it-says-that-there-is-no-bed
  "A sea without the part `seabed' has none: the panel and the drawing say so; with one they do not."
  (define (says? text) (->bool (string-contains text "no bed")))
  (enter! (world (sea (depth depth)) (rov (named minnow) (at 0 0 -70))))
  (expect (says? (text-of (status))))
  (expect (says? (text-of (look))))
  (expect (rov-altitude) => -10.0)
  (expect (altimeter) => -10.0)
  (enter! (world (sea (depth depth)) (seabed) (rov (named minnow) (at 0 0 -55))))
  (expect (says? (text-of (status))) => #f)
  (expect (says? (text-of (look))) => #f)
  (expect (hold-altitude! 61) raises domain))

(define (beside)
  ;; A bed of 60 m by 60 m, and beside it a vehicle on a line that sinks.
  (let ((parts top floor (sloping)))
    (world (sea (depth depth)) (splice parts)
           (rov (named minnow) (at 55 0 -58))
           (tether (named line) (type fathom) (wet-weight 3) (model dynamic) (nodes 30)
                   (from 50 0 -50) (to minnow) (length 20)))))

(define (warning-at world)
  (let ((port (open-output-string)))
    (parameterize ((current-warning-port port))
      (enter! world))
    (get-output-string port)))

(define-scenario beyond-the-edge-there-is-a-bottom
  "Beside a bed of a grid the bottom is level, and a line lies on it; `collide!' switches both as one."
  (define (lowest)
    (apply min (map third (array->list (tether-points)))))
  (warning-at (beside))
  (run 30)
  (expect (lowest) is (about -60 #:within 0.01))
  (expect (->bool (memq 'seabed (map contact-object (contacts)))))
  (expect (clearance 'seabed) is (below 0.01))
  (collide! #:all #f)
  (run 30)
  (expect (lowest) is (below -60.1)))

(define-scenario a-dive-beside-its-bed
  "It is said at `enter!' and in the panel; over the bed, or without an edge, it is not."
  (expect (->bool (string-contains (warning-at (beside)) "over the bed")))
  (expect (->bool (string-contains (text-of (status)) "beyond the edge")))
  (expect (warning-at (with (beside) (line (from 25 0 -20)) (minnow (at 20 0 -20)))) => "")
  (expect (->bool (string-contains (text-of (status)) "beyond the edge")) => #f)
  (expect (warning-at (with (beside) (line (from 29 0 -20)) (minnow (at 35 0 -20)))) => "")
  (expect (->bool (string-contains (text-of (status)) "beyond the edge")))
  (expect (warning-at (world (sea) (seabed) (rov (named minnow) (at 0 0 -5)))) => "")
  (expect (->bool (string-contains
                   (warning-at (world (seabed (grid (lambda (x y) -30) (from 4 48) (to 4.01 48.02) (spacing 0.001)))
                                      (rov (named minnow) (at 0 0 -5))))
                   "degrees"))))

(define-scenario (pairs-over-a-bed off?)
  "Over a bed with an edge the pairs of tethers are still their own: switched off they pass."
  #:for ((off? #t #f))
  (let ((parts top floor (sloping)))
    (enter! (world (sea (depth depth)) (splice parts)
                   (sphere (named buoy) (track (0 30 30 -5) (9 31 30 -5)) (radius 1))
                   (rov (named one) (at 10 0 -10)) (rov (named two) (at 5 6 -14))
                   (tether (named first) (type fathom) (wet-weight 0) (model dynamic) (nodes 20)
                           (from 0 0 -10) (to one) (length 10.5))
                   (tether (named second) (type fathom) (wet-weight 0) (model dynamic) (nodes 20)
                           (from 5 -6 -14) (to two) (length 14))))
    (when off? (collide! 'first 'second #f))
    (move! 'two '(5 6 -2) #:speed 1)
    (run 14)
    (expect (->bool (find (lambda (e) (and (eq? 'touched (car e)) (memq 'second (cdr e)) (memq 'first (cdr e))))
                          (events)))
            => (not off?))))
