;;; Dives among obstacles as a pilot meets them: round posts and back, along walls, into corners, past
;;; what moves; and every world there is, flown by a bad pilot.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(use-modules ((srfi srfi-1) #:select (append-map count first fold iota map remove second)))


;;; What a pilot would count by hand.

(define (angle-about x0 y0 p q)
  ;; How far one turns from P to Q seen from (X0 Y0), radians, clockwise looking down.
  (let ((a (atan (- (x p) x0) (- (y p) y0)))
        (b (atan (- (x q) x0) (- (y q) y0))))
    (let loop ((d (- b a)))
      (cond ((> d (acos -1)) (loop (- d (* 2 (acos -1)))))
            ((< d (- (acos -1))) (loop (+ d (* 2 (acos -1)))))
            (else d)))))

(define (corners)
  (array->points (tether-points)))

(define (array->points array)
  (map (lambda (i) (array-cell-ref array i)) (iota (array-length array))))

(define* (turns-about x0 y0 #:optional (points (corners)))
  ;; The open angle of the tether about an upright post, in turns.
  (/ (fold + 0 (map (lambda (p q) (angle-about x0 y0 p q)) points (cdr points)))
     (* 2 (acos -1))))

(define (wound x0 y0)
  ;; The same of the tether closed by a straight chord: a whole number.
  (let ((points (corners)))
    (turns-about x0 y0 (append points (list (first points))))))

(define (fly . places)
  ;; Through PLACES one after another, giving up on each after a while.
  (for-each (lambda (p)
              (move! p #:speed 2)
              (run-until arrived? #:at-most 20))
            places))

(define (sane?)
  ;; Nothing stands in an obstacle, nothing is infinite.
  (and (> (clearance) (* -1/4 0.0077))
       (> (rov-clearance) -1e-9)
       (and-map (lambda (p) (< (norm p) 1000)) (corners))))

(define (kinds)
  (map car (events)))


;;; Posts.

(define (post part model)
  ;; The anchor south-west of a post of 1 m, the vehicle south-east of it.
  (world (sea (depth 20) (current 0.1 0))
         (splice part)
         (rov (named minnow) (at 5 -5 -6) (surge-speed 2))
         (tether (named line) (type fathom) (wet-weight 0) (model ,model) (nodes 40)
                 (stick-angle 36000) (from -5 -5 -6) (to minnow) (length 24))))

(define posts
  (list (part cylinder (named post) (from 0 0 5) (to 0 0 -20) (radius 0.5))
        (part capsule (named post) (from 0 0 5) (to 0 0 -20) (radius 0.5))
        (part box (named post) (at 0 0 -8) (size 0.8 0.8 24) (heading 20))
        (part convex (named post)
              (points (0.5 0 5) (-0.4 0.5 5) (-0.4 -0.5 5) (0.5 0 -20) (-0.4 0.5 -20) (-0.4 -0.5 -20)))))

(define-scenario (round-and-back shape model)
  "Driving round a post adds one turn, and the way back takes it off; past the anchor it goes over its own
line, on which it would catch."
  #:for ((shape 0 1 2 3) (model 'dynamic 'catenary))
  (in (post (list-ref posts shape) model))
  (let ((before (wound 0 0)))
    (expect before is (about 0 #:within 1e-6))
    (always (sane?)
      (fly '(5 5 -6) '(-5 5 -6) '(-7 0 -4) '(-5 -8 -4) '(5 -5 -4))
      (haul-in! 5 #:rate 0.5)
      (run 10))
    (expect (wound 0 0) is (about -1 #:within 1e-6))
    (expect (memq 'touched (kinds)))
    (pay-out! 5 #:rate 5)
    (always (sane?)
      (fly '(-5 -8 -4) '(-7 0 -4) '(-5 5 -6) '(5 5 -6) '(5 -5 -6)))
    (expect (wound 0 0) is (about 0 #:within 1e-6))))

(define-scenario (another-time-round model)
  "Each time round adds one: two rounds are two."
  #:for ((model 'dynamic 'catenary))
  (in (post (first posts) model))
  (pay-out! 15 #:rate 5)
  (run 4)
  (always (sane?)
    (fly '(5 5 -6) '(-5 5 -6) '(-7 0 -6) '(-5 -8 -6) '(5 -5 -7)
         '(5 5 -7) '(-5 5 -7) '(-7 0 -7) '(-5 -8 -7) '(5 -5 -7)))
  (expect (wound 0 0) is (about -2 #:within 1e-6)))

(define-scenario it-is-held-where-there-is-no-answer
  "`elastic' and `steady' do not know contact: they stop at the post, and go free on the way back."
  (in (post (first posts) 'steady))
  (always (sane?) (fly '(5 9 -6) '(-5 9 -6)))
  (expect (wound 0 0) is (about 0 #:within 1e-6))
  (expect (arrived?) => #f)
  (always (sane?) (fly '(5 -5 -6)))
  (expect (rov-position) is (about '(5 -5 -6) #:within 1e-6)))


;;; Asking.

(define (clear-post)
  ;; The same with the line carried away from the post, so that it touches nothing wherever it comes to rest.
  (with (post (first posts) 'dynamic) (current 0.1 180)))

(define-scenario what-touches
  "What touches is named, with its place, its side and its force; the spans and the wrap between them are the
line."
  (in (clear-post))
  (expect (contacts) => '())
  (expect (length (segments)) => 1)
  (expect (collided? 'line 'post) => #f)
  (fly '(5 8 -6) '(-13 9 -6))
  (drive! #:sway -0.3)
  (run 5)
  (let ((c (contacts)))
    (require (> (length c) 0))
    (expect (and-map (lambda (c) (eq? 'post (contact-object c))) c))
    (expect (and-map (lambda (c) (> (contact-arc-length c) 0)) c))
    (expect (and-map (lambda (c) (< (abs (- 1 (norm (contact-normal c)))) 1e-9)) c))
    (expect (and-map (lambda (c)          ; on the surface, and pushed away from it
                     (let ((p (contact-position c)) (n (contact-normal c)) (f (contact-force c)))
                       (and (< (abs (- 0.5 (norm (vec (x p) (y p) 0)))) 0.01)
                            (> (+ (* (x n) (x f)) (* (y n) (y f)) (* (z n) (z f))) 0))))
                   c))
    (expect (and-map (lambda (c) (memq (contact-state c) '(stick slide))) c)))
  (expect (collided? 'post 'line))
  (expect (length (segments)) is (above 1))
  (let* ((wrap (map contact-arc-length (contacts))) (wrapped (- (apply max wrap) (apply min wrap))))
    (expect wrapped is (above 0.5))
    (expect (fold + wrapped (map segment-length (segments))) is (about (tether-length) #:within 1e-9))))

(define-scenario pairs-off-and-on
  "A pair that is off passes through each other; the rest does not."
  (in (clear-post))
  (collide! 'line 'post #f)
  (collide! 'line 'line #f)
  (collide! 'minnow 'post #f)
  (fly '(0 0 -6))
  (expect (rov-position) is (about '(0 0 -6)))
  (expect (memq 'touched (kinds)) => #f)
  (expect (rov-clearance) is (below 0.01))
  (fly '(5 -5 -6))
  (collide! #:all #t)
  (always (sane?) (fly '(0 0 -6)))
  (expect (norm (vec (x (rov-position)) (y (rov-position)) 0)) is (between 0.5 0.51))
  (expect (memq 'touched (kinds))))


;;; Walls, and what stands in the way.

(define (walled model)
  (world (sea (depth 20) (current 0.1 180))
         (seabed)
         (box (named wall) (at 0 6 -10) (size 40 2 30))
         (rov (named minnow) (at 0 0 -6) (size 0.4 0.6 0.4) (heading 60))
         (tether (named line) (type fathom) (wet-weight 0) (model ,model) (from 0 -8 -6) (to minnow)
                 (length 30))))

(define-scenario (it-slides-along-a-wall model)
  "A vehicle driven at a slant into a wall slides along it, and turns only as far as its hull may."
  #:for ((model 'dynamic 'steady 'catenary))
  (in (walled model))
  (drive! #:surge 1)
  (always (> (rov-clearance) 0) (run 16))
  (expect (collided? 'minnow 'wall))
  (drive! #:yaw 0.3)
  (always (> (rov-clearance) 0) (run 2))
  (expect (x (rov-position)) is (above 3))
  (expect (y (rov-position)) is (between 4 5))
  (expect (memq 'touched (kinds)))
  (hold-heading! 0)
  (drive! #:surge -1 #:yaw 0)
  (run 4)
  (expect (memq 'left (kinds))))

(define-scenario (bed-and-wall-stop-a-jump model)
  "`place!' sweeps: it stops at what is in the way, hull and tether."
  #:for ((model 'dynamic 'catenary))
  (in (walled model))
  (expect (y (place! '(0 20 -6))) is (between 4 5))
  (expect (z (place! '(0 0 -40))) is (between -19.9 -19.7))
  (expect (rov-speed) => 0)
  (expect (sane?)))

(define (fails thunk)
  ;; The text of the error that THUNK raises, else "".
  (with-exception-handler (lambda (e) (bight-error-message e)) (lambda () (thunk) "")
    #:unwind? #t #:unwind-for-type &bight-error))

(define (names-both? text . words)
  (and-map (lambda (word) (string-contains text word)) words))

(define-scenario laid-anew
  "`place! #:fresh' puts the vehicle anywhere that is clear in a straight line, and says what is not."
  (in (walled 'dynamic))
  (expect (place! '(10 0 -6) #:fresh #t) is (about '(10 0 -6)))
  (expect (names-both? (fails (lambda () (place! '(0 6 -6) #:fresh #t))) "minnow" "wall"))
  (expect (names-both? (fails (lambda () (place! '(0 12 -6) #:fresh #t))) "line" "wall"))
  (expect (rov-position) is (about '(10 0 -6)))
  (expect (place! '(0 20 -6) #:fresh #t) raises domain))

(define (laid via-points)
  (world (sea (depth 20))
         (cylinder (named post) (from 0 0 5) (to 0 0 -20) (radius 0.5))
         (rov (named minnow) (at 6 0 -6))
         (tether (named line) (type fathom) (model dynamic) (from -6 0 -6) (to minnow) (length 20)
                 (splice via-points))))

(define-scenario lines-of-lay
  "A line is laid straight, or through points, clear of everything; else the world is refused, naming
both."
  (expect (names-both? (fails (lambda () (enter! (world (sea (depth 20))
                                                       (cylinder (named post) (from 0 0 5) (to 0 0 -20)
                                                                 (radius 0.5))
                                                       (rov (named minnow) (at 6 0 -6))
                                                       (tether (named line) (from -6 0 -6) (to minnow)
                                                               (length 20))))))
                       "line" "post"))
  (expect (names-both? (fails (lambda () (enter! (world (sea (depth 20))
                                                       (sphere (named buoy) (at 6 0.3 -6) (radius 0.5))
                                                       (rov (named minnow) (at 6 0 -6))
                                                       (tether (named line) (from -6 0 -6) (to minnow)
                                                               (length 20))))))
                       "buoy"))
  (with-dive (enter! (world (sea (depth 20))
                            (cylinder (named post) (from 0 0 5) (to 0 0 -20) (radius 0.5))
                            (rov (named minnow) (at 6 0 -6))
                            (tether (named line) (type fathom) (wet-weight 0) (model dynamic)
                                    (from -6 0 -6) (to minnow) (length 20)
                                    (via (0 3 -6)))))
    (expect (turns-about 0 0) is (about 1/2 #:within 0.01))
    (always (sane?) (run 5))))


;;; What moves.

(define (crane model)
  ;; A boom that comes down on a line stretched above the bed.
  (world (sea (depth 12))
         (seabed)
         (capsule (named boom) (from -3 0 -4) (to 3 0 -4) (radius 0.2)
                  (track (0 0 0 -4) (8 0 0 -11.75)))
         (rov (named minnow) (at 0 6 -11.5) (size 0.4 0.4 0.4))
         (tether (named line) (type fathom) (wet-weight 0.3) (model ,model) (from 0 -6 -11.5)
                 (to minnow) (length 14))))

(define-scenario (pinched model)
  "A boom that comes down on a tether is held back rather than let through."
  #:for ((model 'dynamic 'steady 'catenary))
  (in (crane model))
  (always (sane?) (run 20))
  (expect (memq 'touched (kinds)))
  (expect (clearance 'boom) is (between -0.0019 0.05))
  (expect (clearance 'seabed) is (above -0.0019)))

(define-scenario a-vehicle-under-the-boom
  "And so it is by a vehicle under it."
  (in (crane 'dynamic))
  (fly '(0 0 -11.5))
  (always (> (rov-clearance) 0) (run 15))
  (expect (memq 'pinched (kinds)))
  (expect (rov-clearance 'boom) is (below 0.1)))


;; A block that waits north of the vehicle, and a line stretched across its way further south.
(define (waiting)
  (world (sea (depth 30))
         (box (named log) (size 1 1 8) (track (0 0 10 -5)))
         (sphere (named rock) (radius 0.5) (at 9 9 -5))
         (rov (named minnow) (at 3 0 -5) (size 0.4 0.4 0.4))
         (tether (named line) (type fathom) (wet-weight 0) (model dynamic) (from -3 0 -5) (to minnow) (length 6.001))))

(define (log-north)
  ;; How far north the log is, by its distance from the line, which lies along the parallel of the origin.
  (+ 1/2 (clearance 'log)))

(define-scenario what-waits-can-be-set-adrift
  "An obstacle that has a track leaves it at the velocity told; what stands fast does not, nor does a vehicle."
  (in (waiting))
  (run 2)
  (expect (log-north) is (about 10 #:within 0.005))
  (expect (drift! 'rock 0.2 180) raises unsupported)
  (expect (drift! 'minnow 0.2 180) raises domain)
  (expect (drift! 'log 11 180) raises domain)
  (expect (drift! 'lug 1 180) raises name)
  (expect (drift! 'log 0.4 180) => 'log)
  (run 10)
  (expect (log-north) is (about 6 #:within 0.005))
  (drift! 'log 0 0)
  (run 5)
  (expect (log-north) is (about 6 #:within 0.005))
  (drift! 'log 0.4 0 #:rise 1)
  (run 10)                              ; its foot is at 1 m now; the line may bow by 5 cm
  (expect (clearance 'log) is (about (sqrt (+ (expt 9.5 2) (expt 6 2))) #:within 0.05)))

(define-scenario what-drifts-is-part-of-the-dive
  "A fork, a checkpoint and a step back know the drift, to the last bit of what follows."
  (in (waiting))
  (run 1)
  (drift! 'log 0.4 170)
  (run 3)
  (let* ((here (checkpoint)) (later (what-if (run 5) (state-hash))))
    (run 5)
    (expect (state-hash) => later)
    (rewind! 5)
    (run 5)
    (expect (state-hash) => later)
    (drift! 'log 1 0)
    (run 1)
    (restore! here)
    (run 5)
    (expect (state-hash) => later)))

(define-scenario what-drifts-is-held-by-a-line
  "A taut line between what does not yield holds it back, cut it lets it go; never is the line inside it."
  (in (waiting))
  (drift! 'log 1 180)
  (always (sane?) (run 14))
  (expect (memq 'pinched (kinds)))
  (expect (clearance 'log) is (between -0.0019 0.05))
  (cut-tether! #:at 1)
  (always (sane?) (run 6))
  (expect (distance (point-at 0) '(-3 0 -5)) is (below 0.01))
  (expect (clearance 'log) is (above 1)))


;;; Stuck.

(define-scenario stuck-in-a-wedge
  "Pulled and held fast for 5 s by what it touches, the tether is stuck; backing off, it is not."
  (in (world (sea (depth 20))
             (cylinder (named post) (from 0 0 5) (to 0 0 -20) (radius 0.5) (friction 0.9))
             (rov (named minnow) (at 5 -5 -6) (pull 60))
             (tether (named line) (type fathom) (wet-weight 0) (model dynamic) (from -5 -5 -6)
                     (to minnow) (length 26))))
  (fly '(5 5 -6) '(-5 5 -6) '(-6 -1 -6) '(-1 -6 -6))
  (move! '(30 -6 -6) #:speed 2)
  (always (sane?) (run 45))
  (expect (stuck?))
  (expect (memq 'stuck (kinds)))
  (fly '(-1 -6 -6))
  (expect (stuck?) => #f))


;; Whatever the contract leaves no doubt about: (PLACE PULLED?) second by second, the newest first.
(define (stayed? log seconds within)
  (and (> (length log) seconds)
       (and-map (lambda (entry) (and (second entry) (<= (distance (first entry) (first (first log))) within)))
                (list-head log (+ 1 seconds)))))

(define (went? log seconds by)
  (or (<= (length log) seconds)
      (not (second (first log)))
      (>= (distance (first (list-ref log seconds)) (first (first log))) by)))

(define* (expect-stuck-as-told seconds where pulled?)
  ;; Return how often it was stuck, asked once a second.
  (let loop ((left seconds) (log (list (list (where) #f))) (times 0))
    (cond ((zero? left) times)
          (else
           (run 1)
           (let ((log (cons (list (where) (pulled?)) log)))
             (when (stayed? log 6 0.08)
               (expect (stuck?)))
             (when (and (went? log 5 0.13) (went? log 6 0.13))
               (expect (stuck?) => #f))
             (loop (- left 1) log (+ times (if (stuck?) 1 0))))))))

(define (leash body? place)
  ;; A line of 9 m in open water, or round a pile.
  (world (sea (depth 30))
         (splice (if (eq? place 'pile)
                     (part cylinder (named pile) (from -1.5 1 5) (to -1.5 1 -30) (radius 0.5) (friction 0.6))
                     '()))
         (splice (if body?
                     (part rov (named minnow) (type bluerov2-heavy) (at 3 -3 -4))
                     (part rov (named minnow) (at 3 -3 -4) (pull 60))))
         (tether (named line) (type fathom) (wet-weight 0) (model dynamic) (from -3 -3 -3) (to minnow) (length 9))))

(define-scenario (stuck-is-what-it-says body? place waves)
  "Full thrust on a line that is taut: whatever holds it, still water or a ripple, a vehicle with mass or without,
it is stuck when its end has moved less than 2 cm/s for 5 s, and not before; let go it is not."
  #:for ((body? #t #f)
         (place 'open-water 'pile)
         (waves 'none '(airy (height 0.3) (period 3) (toward 40))))
  (in (leash body? place))
  (waves! waves)
  (drive! #:surge 1)
  (expect (expect-stuck-as-told 75 rov-position (lambda () (> (rov-tension) 2))) is (above 8))
  (expect (memq 'stuck (kinds)))
  (release!)
  (run 0.1)
  (expect (stuck?) => #f)
  (haul-in! 0.05)
  (run 1)
  (expect (stuck?) => #f))

(define-scenario (stuck-though-parted rate)
  "A cut line that the winch hauls at is stuck if its new end hardly moves."
  #:for ((rate 0.005 0.1))
  (in (world (sea (depth 60)) (rov (named minnow) (at 0 1 -30))
             (tether (named line) (type fathom) (wet-weight 0.5) (model dynamic) (from 0 0 0) (to minnow)
                     (length 32))))
  (cut-tether! #:at 28)
  (run 60)
  (expect (stuck?) => #f)
  (haul-in! 5 #:rate rate)
  (define (end) (point-at (tether-length)))
  (expect (expect-stuck-as-told 20 end (lambda () (> (tension-at 0) 2)))
          is (if (< rate 0.02) (above 8) (lambda (n) (zero? n)))))


;;; Soups: the real meshes, when they are here.

(define meshes
  (string-append (or (getenv "top_srcdir") "..") "/../shared/data/meshes/"))

(define-scenario (soup file scale)
  "A line dragged over an open or tangled mesh stays out of it."
  #:for ((file "sunken_ship.obj" "underwater_frame.obj") (scale 1))
  (unless (file-exists? (string-append meshes file))
    (skip "the reference meshes are not here"))
  (in (world (sea (depth 60) (current 0.1 90))
             (mesh (named soup) (file (string-append meshes file)) (at 0 0 -40))
             (rov (named minnow) (at 0 35 -30))
             (tether (named line) (type fathom) (wet-weight 0.05) (model dynamic) (from 0 -40 -20)
                     (to minnow) (length 85) (nodes 32))))
  (for-each (lambda (p)
              (move! p #:speed 4)
              (do ((i 0 (+ i 1))) ((= i 10))
                (run 1)
                (expect (clearance) is (above (* -1/4 0.0077)))))
            '((0 35 -40) (15 0 -40) (-5 -10 -39))))


;;; Every world there is.

(define-scenario (by-a-bad-pilot name)
  "Any world can be entered and flown for a minute by sticks that mean nothing."
  #:for ((name 'box 'cage 'canyon 'cross-current 'jacket 'open-water 'pier 'pile 'rigging 'tank
               'tide-profile 'wall-and-overhang 'wreck))
  (in name)
  (set! *random-state* (seed->random-state 5))
  (always (sane?)
    (do ((i 0 (+ i 1))) ((= i 12))
      (drive! #:surge (- (random 1.8) 0.8) #:sway (- (random 2.0) 1) #:heave (- (random 2.0) 1)
              #:yaw (- (random 2.0) 1))
      (run 5))))


;;; Slack lines as they open.

(define (slack-in-a-trough seed)
  ;; A line much longer than its chord, low between two walls of boxes that bend, on a level bed.
  (let* ((dice (seed->random-state seed))
         (between (lambda (low high) (+ low (* (random:uniform dice) (- high low)))))
         (wide (between 2 6)) (bow (between 0 (* 0.45 wide))) (phase (between 0 6))
         (middle (lambda (y) (* bow (sin (+ phase (/ y 8))))))
         (wall (lambda (side k)
                 (let ((y (+ -24 (* 4 k))))
                   (part box (named ,(string->symbol (simple-format #f "~a~a" (if (positive? side) 'east 'west) k)))
                         (at (+ (middle y) (* side (+ wide 4))) y -34) (size 8 4 12)))))
         (from (list (middle -20) -20 (between -38 -30)))
         (to (list (middle 18) 18 (between -38 -30))))
    (world (sea (depth 40) (current (between 0 0.2) (between 0 360))) (seabed (friction 0.5))
           (splice (append-map (lambda (k) (list (wall 1 k) (wall -1 k))) (iota 13)))
           (rov (named minnow) (at to))
           (tether (named line) (type fathom) (model dynamic) (from from) (to minnow)
                   (length (* 40 (between 1.2 2)))))))

(define (own-contacts)
  (count (lambda (c) (eq? 'line (contact-object c))) (contacts)))

(define-scenario slack-lines-open
  "A slack line among walls opens as it would lie there: it meets itself where it crosses itself once or twice, and
is no ball; in the canyon it does not at all, and bends as wide as it may."
  (enter! 'canyon)
  (expect (own-contacts) => 0)
  (expect (tightest-bend) is (above 0.3))
  (expect (remove (lambda (seed) (enter! (slack-in-a-trough seed)) (<= (own-contacts) 4)) (iota 40 1)) => '()))
