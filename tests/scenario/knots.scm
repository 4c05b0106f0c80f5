;;; Lines against lines, as a pilot meets them: a knot tied by flying it, two vehicles that cross their
;;; tethers, a line on the bottom.  Model `dynamic' at 60 Hz; neutral lines, friction as each world says.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(use-modules ((srfi srfi-1) #:select (any append-map count (every . all?) fold map)))

(define (fly . places)
  ;; Through PLACES one after another, giving up on each after a while.
  (for-each (lambda (p)
              (move! p #:speed 0.5)
              (run-until arrived? #:at-most 30))
            places))

(define (kinds)
  (map car (events)))

(define (on-itself? c)
  (eq? 'line (contact-object c)))

(define (pile-with ei)
  (world (sea (depth 20))
         (cylinder (named pile) (from 0 0 1) (to 0 0 -20) (radius 0.5))
         (rov (named minnow) (at 3 2 -6) (surge-speed 1))
         (tether (named line) (type fathom) (wet-weight 0) (model dynamic) (nodes 60) (accuracy 0.01) (friction 0.2) (ei ei)
                 (breaking-load 1e9) (from 8 2 -6) (to minnow) (length 8))))

(define beam (pile-with 0))

;; Round the pile, over the standing part, down beyond it, back under it and up between it and the pile.
(define overhand
  '((-2 2 -6) (-2 -2 -6) (3 -2 -6) (4 -2 -4.5) (4 3 -4.5) (4 3 -7.5) (1.05 0.35 -7.5) (1.05 0.35 -4) (4 -3 -4)))

(define (goes-on-the-same)
  ;; From here on a fork and a checkpoint go where the dive itself goes.
  (let* ((here (checkpoint))
         (forked (what-if (run 5) (state-hash))))
    (run 5)
    (let ((there (state-hash)))
      (expect forked => there)
      (run 20)
      (restore! here)
      (run 5)
      (expect (state-hash) => there))))

(define-scenario an-overhand-knot-holds-and-is-freed-by-the-way-it-was-made
  "Flown round a pile and through its own loop, a line is knotted; pulled, the knot runs up to the pile and
holds; hauled in, it stays; the way back through the loop, and nothing else, undoes it."
  (in beam)
  (pay-out! 22 #:rate 0.35)
  (apply fly overhand)
  (expect (knotted?))
  (let ((loose (checkpoint)))
    (move! '(20 -12 -5) #:speed 0.5)
    (run 45)
    (expect (memq 'parted (kinds)) => #f)
    (expect (knotted?))
    (expect (any on-itself? (contacts)))
    (expect (memq 'touched (kinds)))
    (expect (collided? 'line 'line))
    (expect (norm (rov-position)) is (below 20))
    (expect (rov-tension) is (above 60))
    (for-each (lambda (to)              ; no way but the one it was made undoes it
                (fly to)
                (expect (knotted?)))
              '((4 -3 -4) (3 2 -6) (8 4 -6) (-3 3 -9)))
    (restore! loose))
  (apply fly (append (reverse overhand) '((3 2 -6))))
  (expect (knotted?) => #f)
  (haul-in! 21 #:rate 0.6)
  (run 40)
  (expect (null? (windings)))
  (expect (any (lambda (c) (eq? 'pile (contact-object c))) (contacts)) => #f))

(define-scenario what-is-switched-off-passes
  "The same flight with the line's own contact off: it pulls through itself, and no knot is left."
  (in beam)
  (collide! 'line 'line #f)
  (pay-out! 22 #:rate 0.35)
  (apply fly overhand)
  (move! '(20 -12 -5) #:speed 0.5)
  (run 45)
  (expect (knotted?) => #f)
  (expect (any on-itself? (contacts)) => #f))


;; A limp line stays as it was pulled, and the way back does not lead through its loops.  A tether bends as
;; a spring: slack, the loops open.

(define (pull-tight-and-slacken!)
  (pay-out! 22 #:rate 0.24)             ; a stiff line bows out: with more of it no loop closes
  (apply fly overhand)
  (move! '(20 -12 -5) #:speed 0.5)
  (run 70)                              ; until it snaps no more
  (expect (knotted?))
  (expect (rov-tension) is (above 60))
  (expect (any (lambda (c) (eq? 'pile (contact-object c))) (contacts)))
  (fly '(4 -3 -4))
  (run 15)                              ; until it has sprung open
  (expect (rov-tension) is (below 1)))

(define (stays-a-knot? ways-out)
  ;; Is the line, wherever the vehicle flies to of WAYS-OUT, a knot about the pile?
  (let ((slack (checkpoint)))
    (all? (lambda (to)
            (fly to)
            (let ((knot? (and (knotted?) (= 1 (abs (winding 'pile))))))
              (restore! slack)
              knot?))
          ways-out)))

(define (freed-by-the-way-it-was-made?)
  (apply fly (append (reverse overhand) '((3 2 -6))))
  (and (not (knotted?)) (null? (windings))))

(define-scenario a-knot-pulled-tight-is-freed-when-slack
  "The same knot in lines of about 0.1 N m2, pulled tight on the pile with over 60 N and slackened: three ways out
leave it a knot about the pile, the way it was made leaves a line that is neither knotted nor wound.  Whether a loop
stands wide enough for the vehicle to find its way hangs on the last bit of how it was pulled: most of the lines do so."
  (define (freed? ei)
    (enter! (pile-with ei))
    (pull-tight-and-slacken!)
    (and (stays-a-knot? '((3 2 -6) (8 4 -6) (4 3 -4.5)))
         (freed-by-the-way-it-was-made?)))
  ;; Half of them are most; those that come after four are not flown.
  (expect (fold (lambda (ei freed) (if (or (= freed 4) (not (freed? ei))) freed (+ freed 1)))
                0
                '(0.08 0.085 0.09 0.095 0.1 0.105 0.11 0.115))
          => 4))


;;; With nothing else in the world.

(define open-water
  (world (sea (depth 20))
         (rov (named minnow) (at 3 2 -6) (surge-speed 1))
         (tether (named line) (type fathom) (wet-weight 0) (model dynamic) (nodes 60) (friction 0.2)
                 (breaking-load 1e9) (from 8 2 -6) (to minnow) (length 8))))

(define (tie-and-draw)
  ;; The same flight with no pile in it; then away, as far as the line lets it.
  (pay-out! 22 #:rate 0.35)
  (apply fly overhand)
  (move! '(40 -30 -6) #:speed 0.5)
  (run 90))

(define-scenario a-line-in-open-water-does-not-go-through-itself
  "Laid in a loop and drawn through it, far from everything, a line is knotted: it bears on itself and takes up some
of the line, however long it is pulled; so it does in a fork and from a checkpoint, to the last bit."
  (in open-water)
  (tie-and-draw)
  (expect (knotted?))
  (expect (collided? 'line 'line))
  (expect (any (lambda (e) (and (eq? 'touched (car e)) (equal? '(line line) (cddr e)))) (events)))
  (expect (any on-itself? (contacts)))
  (expect (distance '(8 2 -6) (rov-position)) is (below 29.8))
  (expect (rov-tension) is (above 60))
  (goes-on-the-same)
  (expect (knotted?)))

(define-scenario switched-off-it-does
  "The same flight with the line's own contact off: it comes straight."
  (in open-water)
  (collide! 'line 'line #f)
  (tie-and-draw)
  (expect (knotted?) => #f)
  (expect (collided? 'line 'line) => #f)
  (expect (contacts) => '())
  (expect (distance '(8 2 -6) (rov-position)) is (above 29.9))
  (collide! #:all #t)
  (run 1)
  (expect (knotted?) => #f))


;;; Two tethers.

(define crossed
  (world (sea (depth 20))
         (rov (named one) (at 5 0 -6) (surge-speed 1))
         (rov (named two) (at 0 5 -6.5) (surge-speed 1))
         (tether (named first) (type fathom) (wet-weight 0) (model dynamic) (nodes 40) (from -5 0 -6) (to one)
                 (length 14))
         (tether (named second) (type fathom) (wet-weight 0) (model dynamic) (nodes 40) (from 0 -5 -6.5) (to two)
                 (length 14))))

;; Seen from above, with its ends led on straight outward, one line crosses the other so often to the left
;; more than to the right where it lies on top: no motion changes that but going through each other.

(define (corners t)
  (let ((a (tether-points t)))
    (map (lambda (i) (array-cell-ref a i)) (iota (array-length a)))))

(define (side a b c)
  (- (* (- (x b) (x a)) (- (y c) (y a))) (* (- (y b) (y a)) (- (x c) (x a)))))

(define (crossing a b c d)
  ;; 1 or -1 if the link from A to B lies across that from C to D and over it, else 0.
  (let ((ca (side c d a)) (cb (side c d b)) (ac (side a b c)) (ad (side a b d)))
    (if (or (eq? (>= ca 0) (>= cb 0)) (eq? (>= ac 0) (>= ad 0)))
        0
        (let* ((s (/ ca (- ca cb))) (u (/ ac (- ac ad)))
               (over (- (+ (z a) (* s (- (z b) (z a)))) (+ (z c) (* u (- (z d) (z c)))))))
          (cond ((< over 0) 0) ((> ad ac) 1) (else -1))))))

(define (times-over)
  (let ((p (corners 'first)) (q (corners 'second)))
    (apply + (append-map (lambda (a b) (map (lambda (c d) (crossing a b c d)) q (cdr q))) p (cdr p)))))

(define-scenario (two-vehicles-hook-each-other bed)
  "One tether lies over the other; its vehicle dives and the other's climbs: they hook, pull alike, hold both
vehicles back and never pass; in open water as above a bed."
  #:for ((bed '() (list (part seabed))))
  (in (extend crossed (splice bed)))
  (define (fly-on seconds)
    (do ((i 0 (+ i 1))) ((= i seconds))
      (run 1)
      (expect (times-over) => 1)))
  (expect (times-over) => 1)
  (move! 'one '(5 0 -9) #:speed 0.5)
  (move! 'two '(0 5 -3) #:speed 0.5)
  (fly-on 10)
  (move! 'one '(14 0 -9) #:speed 0.5)
  (move! 'two '(0 14 -3) #:speed 0.5)
  (fly-on 40)
  (expect (any (lambda (c) (eq? 'second (contact-object c))) (contacts 'first)))
  (expect (any (lambda (c) (eq? 'first (contact-object c))) (contacts 'second)))
  (expect (collided? 'first 'second))
  (let ((force (lambda (t) (apply + (map (lambda (c) (norm (contact-force c))) (contacts t))))))
    (do ((i 0 (+ i 1))) ((= i 60)) ; each pulls as it can, and not to and fro
      (run 1/60)
      (expect (rov-tension 'first) is (about 100 #:within 2))
      (expect (rov-tension 'second) is (about 100 #:within 2))
      (expect (force 'first) is (about (force 'second) #:within (* 0.2 (force 'second))))))
  (expect (x (rov-position 'one)) is (below 9))
  (expect (y (rov-position 'two)) is (below 9)))

;; What a step remembers to save time is no part of the state.

(define-scenario hooked-tethers-go-on-the-same-from-a-checkpoint
  "Of two tethers that touch, a step goes on the same to the last bit from a checkpoint and in a fork, whatever
the engine knew of them before."
  (in crossed)
  (move! 'one '(5 0 -9) #:speed 0.5)
  (move! 'two '(0 5 -3) #:speed 0.5)
  (run 10)
  (move! 'one '(14 0 -9) #:speed 0.5)
  (move! 'two '(0 14 -3) #:speed 0.5)
  (run 15)
  (expect (collided? 'first 'second))
  (goes-on-the-same))

(define-scenario two-tethers-that-are-switched-off
  "Two tethers whose pair is off go through each other."
  (in crossed)
  (collide! 'first 'second #f)
  (move! 'one '(14 0 -9) #:speed 0.5)
  (move! 'two '(0 14 -3) #:speed 0.5)
  (run 45)
  (expect (memq 'touched (kinds)) => #f)
  (expect (times-over) => 0))


;;; At rest.

(define-scenario a-coil-on-the-bottom-comes-to-rest
  "A heavy line laid down in bights across itself comes to rest, lying on itself, and sleeps."
  (in (world (sea (depth 8))
             (seabed (friction 0.5))
             (rov (named minnow) (at 3 0 -7) (surge-speed 1))
             (tether (named line) (type fathom) (wet-weight 0.5) (model dynamic) (nodes 60) (friction 0.4)
                     (from -3 0 -7.8) (to minnow) (length 16))))
  (fly '(0 3 -7) '(-3 3 -7) '(-5 3 -7) '(-2 5 -7.7))
  (run 110)
  (expect (any on-itself? (contacts)))
  (expect (assq-ref (energy) 'kinetic) is (below 1e-6))
  (let ((before (assq-ref (profile) 'chain-sleeps)) (since (now)))
    (run 2)
    (expect (assq-ref (profile) 'chain-sleeps) is (above before))
    (expect (events #:since since) => '()) ; it has left neither the bed nor itself
    (expect (collided? 'line 'seabed))
    (expect (collided? 'line 'line))))


;;; A heap.

(define heaped 12)                      ; m
(define ea 1e5)                         ; N
(define mass 0.2)                       ; kg/m

(define (over-a-bed above weight)
  ;; 4 m of line whose ends are 2.8 m apart, ABOVE a bed, m; it weighs WEIGHT N/m.
  (world (sea (depth (+ 69 above)) (current 0.3 70))
         (seabed)
         (rov (named minnow) (type falcon) (at 2 0 -69))
         (tether (named line) (type falcon) (ea ea) (mass mass) (wet-weight weight)
                 (model dynamic) (from 0 0 -67) (to minnow) (length 4) (drum 40))))

(define (snap-of speed)
  ;; N: of a line that goes at SPEED and is stopped at once: v sqrt (EA m).
  (* speed (sqrt (* ea mass))))

(define-scenario (a-heap-is-solved rate above weight)
  "Line paid out that nothing draws on heaps up.  Each step is solved, and none of the line is pulled by more
than its weight and what stops at the speed of the winch."
  #:for ((rate 1 5) (above 1 4) (weight 0.05 0.5))
  (in (over-a-bed above weight))
  (pay-out! heaped #:rate rate)
  (hold-position!)
  (let loop ((most 0))
    (if (< (now) (+ 2 (/ heaped rate)))
        (begin (run 1/60) (loop (max most (max-tension))))
        (begin
          (expect most is (below (+ (* weight (tether-length)) (snap-of rate))))
          (expect (assq-ref (profile) 'chain-unconverged) => 0))))
  (expect (max-tension) is (below (+ 2 (* weight (tether-length))))))

(define-scenario a-line-paid-out-into-a-gap-heaps-up-and-is-not-jammed
  "What a heap meets in a step that is not solved is not taken for contact: such steps were solved five times, and cut."
  (in (world (sea (depth 100) (current 0.3 70))
             (seabed)
             (rov (named minnow) (type falcon) (at 2 0 -69))
             (tether (named line) (type falcon) (model dynamic) (from 0 0 -67) (to minnow) (length 4) (drum 40))))
  (pay-out! 26 #:rate 5)
  (hold-position!)
  (run 5/2)
  (expect (length (contacts)) is (above 20))
  (let* ((before (profile)) (more (lambda (what) (- (assq-ref (profile) what) (assq-ref before what)))))
    (run 1/2)
    (expect (more 'truncated) is (below 4))
    (expect (more 'contact-rounds) is (below 8))))
