;;; The hull of another's vehicle: a moving line never passes through it.  The line is carried along, drapes
;;; over the hull and slides off, and a vehicle with mass feels the line.  tests/unit/dive_hulls.c judges
;;; random dives.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(use-modules ((srfi srfi-1) #:select (delete-duplicates fold)) (bight test soundness))

(define (crossed)
  ;; The line of `a' hangs across the way of `b', who looks east and belongs to nobody's line.
  (world (sea (depth 40))
         (rov (named a) (at 0 8 -10))
         (rov (named b) (at -2 0 -13.5) (heading 90) (size 0.6 0.8 0.5))
         (tether (named line) (type fathom) (wet-weight 0.1) (from 0 -8 -10) (to a) (length 18) (nodes 24)
                 (model dynamic))))

(define (middle-x)
  (x (point-at 9)))

(define (pressing)
  ;; The force of the line on hulls, N: against that of the hulls on the line.
  (fold vec+ (vec 0 0 0) (map (lambda (c) (vec* -1 (contact-force c))) (contacts))))

(define-scenario it-is-carried-along
  "A vehicle flown at the middle of a slack line takes the middle with it, 2 m and more."
  (in (crossed))
  (drive! 'b #:surge 0.5)
  (run-until (lambda () (collided? 'line 'b)) #:at-most 10)
  (expect (x (rov-position 'b)) is (about -0.4 #:within 0.05))
  (expect (map contact-object (contacts)) is (lambda (names) (equal? '(b) (delete-duplicates names))))
  (expect (clearance 'b) is (about 0 #:within 0.002))
  (always (> (middle-x) (+ 0.4 (x (rov-position 'b)) -0.02)) (run 3))
  (expect (middle-x) is (above 1.3))
  (expect (assq 'touched (events)) is (lambda (e) (equal? (cddr e) '(line b)))))

(define-scenario switched-off-it-passes
  "With the pair off the vehicle goes through, nothing is told, and nothing is done for it."
  (in (crossed))
  (collide! 'line 'b #f)
  (drive! 'b #:surge 0.5)
  (run 7)
  (expect (x (rov-position 'b)) is (above 1.4))
  (expect (abs (middle-x)) is (below 0.01))
  (expect (assq 'touched (events)) => #f)
  (expect (assq-ref (profile) 'beside-hulls) => 0)
  (collide! 'b 'line #t)
  (drive! 'b #:surge -0.5)
  (run 7)
  (expect (middle-x) is (below -0.3)))

(define-scenario a-line-drapes-over-a-hull
  "A vehicle that rises under a line lifts it: the line rests on the hull with what it weighs there."
  (in (with (crossed) (b (at 0 0 -15)) (line (nodes 72))))
  (drive! 'b #:heave 0.5)
  (run 6)
  (release! 'b)
  (expect (settle! #:within 0.001 #:at-most 600))
  (expect (z (point-at 9)) is (about (+ 0.25 (z (rov-position 'b))) #:within 0.02))
  (expect (imbalance 'line) is (below 0.02))
  (expect (- (z (pressing))) is (above 0.3))
  (expect (collided? 'line 'b))
  (drive! 'b #:heave -0.5)
  (run 10)
  (expect (collided? 'line 'b) => #f)
  (expect (assq 'left (events)) is (lambda (e) (equal? (cddr e) '(line b)))))

(define-scenario its-own-vehicle-and-what-has-no-size
  "A line ends inside the hull of its own vehicle; a vehicle without a size is no hull: neither pair is there."
  (in (with (crossed) (a (size 0.6 0.8 0.5))))
  (run 1)
  (expect (collide! 'line 'a #f) raises name)
  (expect (clearance 'a) raises name)
  (in (with (crossed) (b (size 0 0 0))))
  (expect (collide! 'line 'b #f) raises name)
  (drive! 'b #:surge 0.5)
  (run 7)
  (expect (abs (middle-x)) is (below 0.01))
  (expect (assq-ref (profile) 'beside-hulls) => 0))

(define here-module (current-module))

(define-scenario no-obstacle-goes-with-a-vehicle
  "What stands about the origin is met there alone, not about a vehicle without a size, near which another's hull is."
  ;; So many, because an obstacle too many was met where a byte of a string happened to be zero.
  (define about-the-origin
    (map (lambda (i) `(sphere (named ,(string->symbol (simple-format #f "o~a" i))) (at -0.5 0.1 0) (radius 0.3)))
         (iota 120)))
  (enter! (eval `(world (sea) ,@about-the-origin
                        (rov (named b) (at 18.5 0.5 -10) (size 0.5 0.4 0.3))
                        (rov (named a) (at 20 0 -10))
                        (tether (named line) (from 10 0 -10) (to a) (length 10.5) (wet-weight 0) (model dynamic)
                                (nodes 40)))
                here-module))
  (run 1)
  (expect (assq-ref (profile) 'beside-hulls) is (above 0))
  (expect (contacts) => '())
  (expect (events) => '()))

(define-scenario far-from-hulls-nothing-is-asked
  "A line in whose reach no hull comes is stepped as if there were none: the same bits, no pair and no link asked."
  (in (with (crossed) (b (at 30 0 -13.5))))
  (drive! 'a #:surge 0.5)
  (run 5)
  (define there (tether-points))
  (expect (assq-ref (profile) 'beside-hulls) => 0)
  (expect (assq-ref (profile) 'links-asked) => 0)
  (in (with (crossed) (b (at 30 0 -13.5) (size 0 0 0))))
  (drive! 'a #:surge 0.5)
  (run 5)
  (expect (equal? there (tether-points))))

(define-scenario a-vehicle-with-mass-feels-a-line
  "A free vehicle that drives against a line is held by it: the line bears the thrust, which the vehicle's own
line bears in its place."
  (in (world (sea (depth 40))
             (rov (named b) (type bluerov2-heavy) (at -2 0 -10) (heading 90))
             (tether (named own) (type fathom) (wet-weight 0) (from -6 0 -10) (to b) (length 4.1) (nodes 8)
                     (model dynamic))))
  (hold-depth! 'b 10)
  (hold-heading! 'b 90)
  (drive! 'b #:surge 0.3)
  (run 30)
  (define thrust (- (x (tether-force))))
  (expect thrust is (above 2))
  (in (world (sea (depth 40))
             (rov (named a) (at 0 4 -10))
             (rov (named b) (type bluerov2-heavy) (at -1 0 -10) (heading 90))
             (tether (named line) (type fathom) (wet-weight 0) (from 0 -4 -10) (to a) (length 8.001) (nodes 24)
                     (model dynamic))))
  (hold-depth! 'b 10)
  (hold-heading! 'b 90)
  (drive! 'b #:surge 0.3)
  (run 60)
  (expect (rov-speed 'b) is (below 0.02))
  (expect (x (pressing)) is (about (- thrust) #:within (* 0.05 thrust)))
  (expect (imbalance 'line) is (below 0.05)))

(define-scenario it-slides-off
  "A vehicle that has lifted a slack line and flies away below it is not held: the line slides off."
  (in (crossed))
  (drive! 'b #:surge 0.5)
  (run 5)
  (expect (collided? 'line 'b))
  (drive! 'b #:surge 0.5 #:heave -0.5)
  (run 12)
  (expect (collided? 'line 'b) => #f)
  (expect (x (rov-position 'b)) is (above 4)))

(define-scenario the-same-by-any-way
  "By a fork, a saved state, a way back in time and two threads the same line lies on the hull."
  (in (crossed))
  (drive! 'b #:surge 0.5)
  (run 4)
  (define before (checkpoint))
  (define forked (what-if (run 2) (state-hash)))
  (run 2)
  (expect (collided? 'line 'b))
  (expect (state-hash) => forked)
  (rewind! 2)
  (run 2)
  (expect (state-hash) => forked)
  (restore! before)
  (threads! 2)
  (run 2)
  (expect (state-hash) => forked))

(define-scenario a-cut-line-lies-on-a-hull
  "Both parts of a line that is cut on a hull stay outside, and fall off it."
  (in (with (crossed) (b (at 0 0 -15))))
  (drive! 'b #:heave 0.5)
  (run 6)
  (release! 'b)
  (cut-tether! #:at 9)
  (run 20)
  (expect (clearance 'b) is (above -0.001)))
