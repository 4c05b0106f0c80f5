;;; What a tether is doing: turns, strings, classes, fouling, hauling, ways, forecasts, probes, each seen in
;;; dives.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(use-modules (srfi srfi-1) ((bight assembly) #:select (data->part)))

(define pi (acos -1))

(define (pile name x y)
  (part cylinder (named ,name) (from x y 1) (to x y -60) (radius 0.4)))

(define (among parts from length via model at)
  (parts->world
         (append (list (part sea (depth 60)))
                 parts
                 (list (part rov (named minnow) (at at))
                       (data->part `(tether (named line) (type fathom) (wet-weight 0) (from ,@from)
                                            (to minnow) (length ,length) (via ,@via)
                                            (model ,model)))))))

(define (parts->world parts)
  (world (splice parts)))

(define (alone model)
  (world (sea (depth 60))
         (splice (pile 'p1 0 0))
         (rov (named minnow) (at 6 -6 -5))
         (tether (named line) (type fathom) (wet-weight 0) (from -6 -6 -5) (to minnow) (length 45)
                 (model ,model))))

(define (go . places)
  (for-each (lambda (p) (move! p #:speed 1) (run-until arrived? #:at-most 60)) places))

;; Once clockwise round the pile, seen from above, and back.
(define (go-round)
  (go '(3 -3 -5) '(-3 -3 -5) '(-3 3 -5) '(3 3 -5) '(3 -3 -5)))

(define (go-back)
  (go '(3 -3 -5) '(3 3 -5) '(-3 3 -5) '(-3 -3 -5) '(3 -3 -5)))

;;; Turns.

(define-scenario (out-and-back model)
  "Clockwise round a pile, seen from above, and back: every model counts +1, +2, and 0 at the end."
  #:for ((model 'dynamic 'rubber-band 'catenary))
  (in (alone model))
  (define before (homotopy-class))
  (expect (winding 'p1) => 0)
  (go-round)
  (expect (winding 'p1) => 1)
  (expect (turns 'p1) is (about 0.75 #:within 0.02))
  (expect (winding 'line 'p1) => 1)
  (go-round)
  (expect (winding 'p1) => 2)
  (expect (equal? before (homotopy-class)) => #f)
  (expect (windings) => '((p1 . 2)))
  (expect (foul-reason) => 'wound)
  (go-back)
  (go-back)
  (go '(6 -6 -5))
  (expect (winding 'p1) => 0)
  (expect (equal? before (homotopy-class)))
  (expect (class-free? (homotopy-class)))
  (expect (fouled?) => #f))

(define-scenario the-string-of-a-pile
  "One and a half turns on a pile: the taut length, the wrap angle and the lock in closed form."
  (in (among (list (pile 'p1 0 0)) '(-6 -6 -5) 75
             '((6 -3 -5) (4 4 -5) (-4 4 -5) (-4 -4 -5) (4 -4 -5) (4 4 -5)) 'dynamic '(-6 6 -5)))
  (define r (+ 0.4 (* 0.9 1/4 0.0076)))   ; the string keeps off the steel a little
  (define d (sqrt 72))
  ;; Tangents from both ends, and the arc between; the ends are a right angle apart as the pile sees them.
  (define tangent (sqrt (- (* d d) (* r r))))
  (define arc (- (* 2 pi 2) (* 1/2 pi) (* 2 (acos (/ r d)))))
  (expect (abs (turns 'p1)) is (about (- 2 1/4) #:within 0.02))
  (expect (taut-length) is (about (+ tangent tangent (* r arc)) #:within 0.002))
  (expect (wrap-angle 'p1) is (about (/ (* 180 arc) pi) #:within 3))
  (expect (capstan-lock) is (about (exp (* 0.3 arc)) #:within 0.2))
  (expect (free-length) is (about 12 #:within 0.05))
  (expect (excess) is (about (- (taut-length) (free-length)) #:within 1e-9))
  (expect (slack) is (about (/ (- 75 (taut-length)) 75) #:within 1e-9)))

(define (legs)
  ;; The four legs of a jacket, 12 m apart, as one group.
  (part group (named tower) (at 0 0 0)
        (cylinder (named leg-1) (from -6 -6 1) (to -6 -6 -60) (radius 0.6))
        (cylinder (named leg-2) (from 6 -6 1) (to 6 -6 -60) (radius 0.6))
        (cylinder (named leg-3) (from 6 6 1) (to 6 6 -60) (radius 0.6))
        (cylinder (named leg-4) (from -6 6 1) (to -6 6 -60) (radius 0.6))))

(define-scenario figure-3-8
  "Round two legs of a jacket and out again: +1 on each leg that was looped, 0 on the others; the way back
undoes it."
  (in (world (sea (depth 60)) (seabed)
             (splice (legs))
             (rov (named minnow) (at 0 -12 -6))
             (tether (named line) (type fathom) (wet-weight 0) (from -2 -16 -4) (to minnow) (length 90)
                     (model dynamic))))
  (define (loop-clockwise x y)
    (list (list x (- y 2) -6) (list (- x 2) y -6) (list x (+ y 2) -6) (list (+ x 2) y -6)
          (list x (- y 2) -6)))
  (define way (append '((6 -9 -6)) (loop-clockwise 6 -6) '((0 -9 -6)) '((0 0 -6)) (loop-clockwise 6 6)
                      '((0 0 -6) (0 -9 -6))))
  (apply go way)
  (expect (winding 'tower/leg-2) => 1)
  (expect (winding 'tower/leg-3) => 1)
  (expect (winding 'tower/leg-1) => 0)
  (expect (winding 'tower/leg-4) => 0)
  (apply go (append (cdr (reverse way)) '((0 -12 -6))))
  (expect (windings) => '())
  (expect (class-free? (homotopy-class))))

;;; Classes.

(define weave
  '((-2 -3 -5) (-6 0 -5) (-3 3 -5) (0 0 -5) (2 -3 -5) (6 0 -5) (3 3 -5) (0 0 -4) (-2 3 -4) (-6 0 -4) (-3 -3 -4)
    (0 0 -3) (2 3 -3) (6 0 -3) (3 -3 -3)))

(define-scenario commutator
  "Round one pile, round the other, back round the first, back round the second: no winding is left, and
the line is wound all the same."
  (in (among (list (pile 'p1 -3 0) (pile 'p2 3 0)) '(0 -8 -5) 80 weave 'dynamic '(0 -8 -3)))
  (expect (windings) => '())
  (expect (class-free? (homotopy-class)) => #f)
  (expect (class-decided? (homotopy-class)))
  (expect (foul-reason) => 'wound)
  (define woven (homotopy-class))
  (in (among (list (pile 'p1 -3 0) (pile 'p2 3 0)) '(0 -8 -5) 80 '((0 -9 -4)) 'dynamic '(0 -8 -3)))
  (expect (class-free? (homotopy-class)))
  (expect (equal? woven (homotopy-class)) => #f))

(define-scenario what-holds-no-line
  "A ball in open water and a level bed hold nothing: the class is that of the free way; a bed has no axis."
  (in (world (sea (depth 20)) (seabed) (sphere (named buoy) (at 0 0 -10) (radius 1))
             (rov (named minnow) (at 6 0.5 -10))
             (tether (type fathom) (wet-weight 0) (from -6 0.5 -10) (to minnow) (length 20)
                     (via (0 3 -10)) (model dynamic))))
  (expect (class-free? (homotopy-class)))
  (expect (class-decided? (homotopy-class)))
  (expect (turns 'seabed) raises unsupported)
  (expect (turns 'bouy) raises name)
  (expect (excess) is (below 0.05))
  (expect (knotted?) => #f))

(define-scenario open-water
  "In open water all of it is the chord, and nothing is solved."
  (in open-water)
  (run 1)
  (expect (taut-length) => (straight-distance))
  (expect (free-length) => (straight-distance))
  (expect (excess) => 0.0)
  (expect (capstan-lock) => 1.0)
  (expect (fouled?) => #f)
  (expect (class-free? (homotopy-class)))
  (expect (haul-prospect) => '(yes clear #f))
  (expect (assq-ref (profile) 'strings) => 0))

(define-scenario nothing-for-nothing
  "A dive that asks nothing has a string solved when its tether is wound, for the events, and else none; one that asks twice of a state solves once."
  (in (alone 'dynamic))
  (go '(3 -3 -5) '(-3 -3 -5))
  (expect (assq-ref (profile) 'strings) => 0)
  (expect (assq-ref (profile) 'charts) => 0)
  (go '(-3 3 -5) '(3 3 -5) '(3 -3 -5))
  (expect (map car (events)) is (lambda (kinds) (memq 'wrapped kinds)))
  (define strings (assq-ref (profile) 'strings))
  (expect strings is (between 1 6))
  (taut-length) (excess) (fouled?) (capstan-lock) (slack)
  (expect (assq-ref (profile) 'strings) => (+ strings 1))
  (define charts (assq-ref (profile) 'charts))
  (run 1)
  (taut-length) (fouled?)
  (expect (assq-ref (profile) 'strings) => (+ strings 2))
  (expect (assq-ref (profile) 'charts) => charts))

;; The shortest way from P to Q round an upright of RADIUS at the origin: a helix and two tangents, unrolled.
(define (round-an-upright p q radius)
  (let* ((d (lambda (a) (hypot (x a) (y a))))
         (tangent (lambda (a) (sqrt (- (* (d a) (d a)) (* radius radius)))))
         (between (acos (/ (+ (* (x p) (x q)) (* (y p) (y q))) (d p) (d q))))
         (arc (- between (acos (/ radius (d p))) (acos (/ radius (d q))))))
    (hypot (+ (tangent p) (tangent q) (* radius arc)) (- (z p) (z q)))))

(define (hypot a b) (sqrt (+ (* a a) (* b b))))

(define-scenario (anchor-that-moves ship?)
  "An anchor that rides on waves or is carried along has its ways home from a place near it: they are right, but
for which of two sides that are nearly as long, and of the state alone; and what they go by is not made anew at every
look."
  #:for ((ship? #t #f))
  (in (world (sea (depth 60) (waves (airy (height 1) (period 6) (toward 90)))) (splice (pile 'p1 0 0))
             (splice (if ship?
                         (list (part rov (named ship) (at -6 -6 -4))
                               (part tether (type fathom) (wet-weight 0) (from ship) (to minnow) (length 30)
                                     (via (0 -4 -5)) (model dynamic)))
                         (part tether (type fathom) (wet-weight 0) (from -6 -6 -4) (ride 1 1 1) (to minnow)
                               (length 30) (via (0 -4 -5)) (model dynamic))))
             (rov (named minnow) (at 6 6 -6))))
  (when ship?
    (drive! 'ship #:surge 0.1))
  (define charts 0)
  (do ((i 0 (+ i 1))) ((= i 10))
    (run 2)
    (expect (free-length)
            is (about (round-an-upright (point-at 0) (rov-position 'minnow) 0.402) #:within 0.1))
    (expect (free-length) => (what-if (free-length)))
    (when (zero? i)
      (set! charts (assq-ref (profile) 'charts))))
  (expect (- (assq-ref (profile) 'charts) charts) is (below 3)))

(define (all-answers)
  (list (taut-length) (free-length) (wrap-angle 'p1) (capstan-lock) (homotopy-class) (foul-reason)
        (haul-prospect) (way-home) (unwind-plan) (foresee 20 #:quick #t)))

(define-scenario of-the-state-alone
  "After restore!, on a fork, and whoever asked before: the same answers, bit for bit."
  (in (alone 'dynamic))
  (go '(3 -3 -5) '(-3 -3 -5) '(-3 3 -5))
  (drive! #:surge 0.3 #:sway 0.4)
  (define there (checkpoint))
  (define answers (all-answers))
  (run 5)
  (expect (equal? answers (all-answers)) => #f)
  (all-answers)
  (restore! there)
  (expect (equal? answers (all-answers)))
  (expect (equal? answers (what-if (all-answers))))
  (in (alone 'dynamic))
  (do ((i 0 (+ i 1))) ((= i 30)) (run 0.1) (taut-length) (follow-string))
  (in (alone 'dynamic))
  (go '(3 -3 -5) '(-3 -3 -5) '(-3 3 -5))
  (drive! #:surge 0.3 #:sway 0.4)
  (expect (equal? answers (all-answers))))

;;; Events.

(define-scenario wrapped-and-freed
  "Who wants to know is told when the tether winds about something, and when it comes free."
  (in (alone 'dynamic))
  (define told '())
  (define (note event) (set! told (cons (list (car event) (cadddr event)) told)))
  (on 'wrapped note)
  (on 'freed note)
  (go-round)
  (go-back)
  (run 1)
  (expect (reverse told) => '((wrapped p1) (freed p1)))
  (expect (filter (lambda (event) (memq (car event) '(wrapped freed))) (events))
          is (lambda (all) (equal? (map (lambda (e) (list (car e) (cadddr e))) all) (reverse told)))))

(define (winding-events)
  (filter (lambda (event) (memq (car event) '(wrapped freed))) (events)))

(define-scenario events-are-kept
  "Nobody listens: the dive holds `wrapped' and `freed' all the same, with tether, object and time; so do what is
restored, a fork, and a recording flown again. A line that is laid wound has not been wrapped; laid anew it is
freed."
  (in (alone 'dynamic))
  (define file (tmpnam))
  (record! file)
  (go-round)
  (define there (checkpoint))
  (go-back)
  (run 1)
  (define all (winding-events))
  (expect (map (lambda (e) (cons (car e) (cddr e))) all) => '((wrapped line p1) (freed line p1)))
  (expect (apply < (map cadr all)))
  (stop-recording!)
  (replay file)
  (expect (winding-events) => all)
  (delete-file file)
  (restore! there)
  (expect (winding-events) => (list (car all)))
  (expect (what-if (go-back) (run 1) (winding-events)) => all)
  (place! '(6 -6 -5) #:fresh #t)
  (run 1)
  (expect (map car (winding-events)) => '(wrapped freed))
  (in (among (list (pile 'p1 0 0)) '(-6 -6 -5) 75 '((6 -3 -5) (4 4 -5) (-4 4 -5) (-4 -4 -5) (4 -4 -5)) 'dynamic
             '(4 4 -5)))
  (run 2)
  (expect (winding 'p1) is (lambda (n) (not (zero? n))))
  (expect (winding-events) => '()))

;;; Ways.

(define (dead-rov at) (part rov (named minnow) (type bluerov2-heavy) (at at)))

(define-scenario way-home
  "The way home, flown with the moving line and the winch taking in slack, arrives at the anchor."
  (in (alone 'dynamic))
  (go-round)
  (expect (assq-ref (way-home-preview) 'feasible?))
  (fly-along! (way-home) #:speed 0.5)
  (run-until arrived? #:at-most 120)
  (expect (rov-position) is (about '(-6 -6 -5) #:within 0.2))
  (expect (windings) => '())
  (expect (fouled?) => #f))

(define-scenario way-of-a-hull
  "The way home of a vehicle with a hull and mass leads round a pile without touching it."
  (in (world (sea (depth 60)) (splice (pile 'p1 0 0)) (splice (dead-rov '(-4 6 -5)))
             (tether (named line) (type fathom) (wet-weight 0) (from -6 -6 -5) (to minnow) (length 26)
                     (via (4 -3 -5) (4 4 -5)) (model dynamic))))
  (expect (assq-ref (way-home-preview) 'clearance) is (between 0.4 0.6))
  (define start (now))
  (fly-along! (way-home) #:speed 0.4)
  (run-until arrived? #:at-most 200)
  (expect (arrived?))
  (expect (rov-position) is (about '(-6 -6 -5) #:within 0.2))
  (expect (filter (lambda (e) (and (eq? 'touched (car e)) (eq? 'minnow (caddr e)))) (events #:since start))
          => '()))

(define-scenario home-on-a-fork
  "What `home-trial' says comes true, and leaves the dive as it was; what cannot come home stays."
  (in (alone 'dynamic))
  (go-round)
  (define before (state-hash))
  (define trial (home-trial))
  (expect (state-hash) => before)
  (expect (assq-ref trial 'home?))
  (expect (fly-home!) => (assq-ref trial 'plan))
  (run (assq-ref trial 'seconds))
  (expect (straight-distance) is (below 0.8))
  (expect (rov-position) is (about (assq-ref trial 'at) #:within 1e-9))
  (expect (arrived?)))

(define (home-in-the-water)
  (let ((anchor (point-at 0)))
    (vec (x anchor) (y anchor) (min -0.5 (z anchor)))))

(define (expect-home-and-held)
  ;; He is there, in the water, at rest on a slack line, and the winch stands.
  (expect (arrived?))
  (expect (distance (rov-position) (home-in-the-water)) is (below 1))
  (expect (z (rov-position)) is (below 0))
  (expect (rov-speed) is (below 0.05))
  (expect (spooling?) => #f)
  (expect (tension-at 0) is (below 5))
  (expect (rov-tension) is (below 5)))

(define (expect-to-come-home)
  (expect (fly-home!))
  (expect (arrived?) => #f)
  (run 1)
  (expect (arrived?) => #f)
  (run-until arrived? #:at-most 300)
  (expect (distance (rov-position) (home-in-the-water)) is (below 0.8))
  (run 5)
  (expect-home-and-held)
  (run 30)
  (expect-home-and-held))

(define-scenario (home-of-any-height body? height)
  "Home is the anchor, or the surface below one in the air: he is on his way until he is there, and then holds his
place on a slack line; nobody is lifted by his tether."
  #:for ((body? #t #f) (height -5 0 3))
  (in (world (sea (depth 40) (current 0.2 60)) (seabed)
             (splice (if body?
                         (part rov (named minnow) (type bluerov2-heavy) (at 8 0 -12))
                         (part rov (named minnow) (at 8 0 -12))))
             (tether (named line) (type fathom) (from 0 0 height) (to minnow) (length 25) (model dynamic))))
  (fly-to! '(12 6 -20) #:speed 0.5)
  (run-until arrived? #:at-most 60)
  (expect-to-come-home))

(define-scenario (home-in-every-world name)
  "From where he begins in the worlds that there are."
  #:for ((name 'pile 'garage 'wreck 'cage 'under-ice))
  (in name)
  (expect-to-come-home))

(define-scenario one-rule-of-taut
  "`taut?' and `foresee' go by one rule: what is foreseen as taut is so then, and not before."
  (in (alone 'dynamic))
  (go '(3 -3 -5) '(-3 -3 -5) '(-3 3 -5))
  (expect (taut?) => #f)
  (drive! #:sway 0.5 #:yaw 0.05)
  (define taut (find (lambda (f) (and (eq? 'taut (foresight-kind f)) (= 1 (foresight-confidence f))))
                     (foresee 60)))
  (when taut
    (run (- (foresight-seconds taut) 0.5))
    (expect (taut?) => #f)
    (run 0.5)
    (expect (taut?))))

(define-scenario (weight-of-the-dead volume)
  "A heavy or a buoyant vehicle adds its weight in water to the pull that a haul needs."
  #:for ((volume 0.03 0.07))
  (in (world (sea (depth 60)) (splice (pile 'p1 0 0))
             (rov (named minnow) (type bluerov2-heavy) (at 6 -6 -5) (mass 50) (volume volume))
             (tether (type fathom) (wet-weight 0) (from -6 -6 -5) (to minnow) (length 16) (model dynamic))))
  (expect (take (haul-prospect #:pull 150) 2) => '(no locked))
  (expect (second (haul-prospect #:pull 400)) => 'clear))

(define-scenario (unwinding times)
  "The plan, flown, frees the tether; the preview knew it."
  #:for ((times 1 2))
  (in (alone 'dynamic))
  (do ((i 0 (+ i 1))) ((= i times)) (go-round))
  (expect (fouled?))
  (define end (rov-position))
  (define preview (unwind-preview))
  (expect (assq-ref preview 'needed?))
  (expect (assq-ref preview 'feasible?))
  (fly-along! (unwind-plan) #:speed 0.7)
  (run-until arrived? #:at-most 300)
  (expect (rov-position) is (about end #:within 0.2))
  (expect (fouled?) => #f)
  (expect (class-free? (homotopy-class)))
  (expect (unwind-plan) => #f))

;;; Hauling.

(define (twice-round-a-pile friction)
  (world (sea (depth 60)) (splice (pile 'p1 0 0)) (splice (dead-rov '(-6 6 -5)))
         (tether (type fathom) (wet-weight 0) (friction friction) (from -6 -6 -5) (to minnow) (length 50)
                 (via (4 -2 -5) (2 2 -5) (-2 2 -5) (-2 -2 -5) (2 -2 -5) (2 2 -5)) (model dynamic))))

(define-scenario free-to-haul
  "A free line is hauled home, on the fork as in the dive; a line twice round a pile is not."
  (in (world (sea (depth 60)) (splice (pile 'p1 0 0)) (splice (dead-rov '(6 -6 -5)))
             (tether (type fathom) (wet-weight 0) (from -6 -6 -5) (to minnow) (length 16) (model dynamic))))
  (expect (free-to-haul?))
  (expect (car (haul-prospect)) => 'yes)
  (haul-in! 15 #:rate 0.4)
  (run 60)
  (expect (straight-distance) is (below 2))
  (in (twice-round-a-pile 2))
  (expect (take (haul-prospect) 2) => '(no locked))
  (expect (free-to-haul? #:pull 60) => #f)) ; soon stuck: what pulls harder creeps on for minutes first

(define-scenario (rule-and-haul friction pull)
  "Twice round a pile: where the rule is sure the haul agrees, where it is not it names what the haul then tells of."
  #:for ((friction 0.05 0.3 1 2) (pull 60 150))
  (in (twice-round-a-pile friction))
  (define prospect (haul-prospect #:pull pull))
  (define trial (haul-trial #:pull pull))
  (define (told key) (assq-ref trial key))
  (when (< friction 0.3)                ; the same haul, told in a word, is flown again where it is soon over
    (expect (free-to-haul? #:pull pull) => (told 'home?)))
  (case (first prospect)
    ((yes) (expect (told 'home?)))
    ((no) (expect (told 'home?) => #f)
          (expect (first (haul-prospect #:pull pull #:grip 1)) => 'no)))
  (expect (memq (first (haul-prospect #:pull pull #:grip 0.01)) '(yes unsure)))
  (expect (told 'pull) is (below (* 1.25 pull))) ; its brake holds more than it pulls
  (unless (or (told 'home?) (told 'parted?))
    (expect (told 'pull) is (above (* 0.5 pull))))
  (unless (told 'home?)
    (expect (second prospect) is (lambda (why) (memq why '(locked hung wedged))))
    (expect (third prospect) => 'p1)
    (expect (or (told 'parted?) (eq? 'p1 (told 'object))))))

;;; What is to come.

(define-scenario forecast
  "What `foresee' is sure of happens, then and to that; what the string says comes near it."
  (in (alone 'dynamic))
  (go '(3 -3 -5) '(-3 -3 -5) '(-3 3 -5))
  (drive! #:sway 0.5 #:yaw 0.05)
  (define sure (filter (lambda (f) (= 1 (foresight-confidence f))) (foresee 60)))
  (define string (foresee 60 #:quick #t))
  (expect (pair? string))
  (define start (now))
  (run 60)
  (define happened
    (map (lambda (e) (list (- (cadr e) start) (car e)))
         (filter (lambda (e) (memq (car e) '(touched taut))) (events #:since start))))
  (expect (map foresight-seconds (filter (lambda (f) (memq (foresight-kind f) '(touch bump taut))) sure))
          => (map car happened))
  (define taut (find (lambda (f) (eq? 'taut (foresight-kind f))) string))
  (when taut
    (expect (any (lambda (h) (and (eq? 'taut (cadr h)) (< (abs (- (car h) (foresight-seconds taut))) 3)))
                 happened))))

(define-scenario forecast-of-a-body
  "A vehicle with mass, at rest when its sticks are set, gets up to speed in the forecast as in the dive:
it meets the pile when the string alone had said so."
  (in (world (sea (depth 60) (current 0.1 90)) (splice (pile 'p1 1 0)) (splice (dead-rov '(0 -8 -5)))
             (tether (named line) (type fathom) (wet-weight 0) (from 0 -12 -5) (to minnow) (length 20)
                     (model dynamic))))
  (drive! #:surge 0.3)
  (define bump (find (lambda (f) (eq? 'bump (foresight-kind f))) (foresee 60 #:quick #t)))
  (expect (foresight-object bump) => 'p1)
  (define start (now))
  (run 60)
  (define met (find (lambda (e) (and (eq? 'touched (car e)) (eq? 'minnow (caddr e)))) (events #:since start)))
  (expect (/ (foresight-seconds bump) (- (cadr met) start)) is (between 0.8 1.25)))

;;; Probes.

(define-scenario probes
  "Every probe has a question and a level; a true answer scores 1, a wrong one less; a turn on the edge is
not asked."
  (in (alone 'dynamic))
  (go-round)
  (for-each (lambda (name)
              (define truth (probe-truth name))
              (when truth
                (expect (probe-score name truth truth) => 1)))
            (awareness-probes))
  (expect (probe-truth 'metres-out) => 45.0)
  (expect (probe-truth 'which-way-round) => 'clockwise)
  (expect (probe-truth 'fouled) => 'yes)
  (expect (probe-stable? 'which-way-round))
  (expect (probe-stable? 'metres-out))
  (expect (probe-error 'anchor 350 10) => -20)
  (expect (probe-score 'anchor 350 10) is (about 7/9 #:within 1e-9))
  (expect (probe-score 'metres-out 60 45) => 0)
  (expect (probe-score 'which-way-round 'anticlockwise 'clockwise) => 0)
  (expect (probe-error 'anchor 'north 10) raises domain)
  (expect (probe-truth 'nothing) raises domain)
  (in (alone 'dynamic))
  (expect (probe-truth 'which-way-round) => 'anticlockwise)
  (go '(0 -6 -5))
  (go '(-6 -5.9 -5))
  (expect (probe-stable? 'anchor) => #f))
