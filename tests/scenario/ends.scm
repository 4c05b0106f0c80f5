;;; The ends of tethers, and what is read between their nodes.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(use-modules (bight test soundness)
             (srfi srfi-11)
             (srfi srfi-1))

(define (unsound-tethers)
  ;; What the laws of a single tether find in the present dive.
  (filter-map (lambda (name) (judge-tether (tether-answers name))) (tether-names)))

(define (unsound-while seconds)
  ;; The same after each step of so many SECONDS, what was found first.
  (let ((wrong '()))
    (run-until (lambda () (set! wrong (unsound-tethers)) (pair? wrong)) #:at-most seconds)
    wrong))

(define-scenario (few-nodes model nodes x)
  "A line that is folded between few nodes is read no longer than it is."
  #:for ((model 'dynamic 'auto 'steady) (nodes 2 3 4 7) (x 1 3 12))
  (enter! (world (sea (current 0.3 60))
                 (rov (named r1) (at x 0 -6))
                 (tether (named t1) (from 0 0 -5) (to r1) (length 26) (wet-weight 0.4)
                         (nodes nodes) (model ,model))))
  (expect (unsound-tethers) => '())
  (fly-to! 'r1 (vec 4 6 -9) #:speed 2)
  (expect (unsound-while 3) => '()))

(define-scenario an-arch-that-was-laid-on-the-water
  "An elastic line that floats is read no longer than it is where it bends down from the water."
  (enter! (world (sea)
                 (rov (named r1) (at 6 2 -6))
                 (tether (named t1) (from 0 0 -5) (to r1) (length 36) (wet-weight -0.17) (model elastic))))
  (expect (unsound-tethers) => '()))

(define-scenario paid-out-fast
  "While its winch runs fast a line begins and ends where it is made fast: what its winch owes it yet is read
along all of it."
  (enter! (world (sea (current 0.4 180))
                 (rov (named r1) (at 5 0 -6))
                 (tether (named t1) (from 0 0 -5) (to r1) (length 20) (model dynamic) (clump (at 8) (mass 0.2)))))
  (run 1)
  (pay-out! 't1 20 #:rate 3)
  (expect (unsound-while 2) => '())
  (fly-to! 'r1 (vec 25 3 -9) #:speed 3)
  (expect (unsound-while 5) => '())
  (haul-in! 't1 20 #:rate 2)
  (expect (unsound-while 5) => '()))

(define-syntax-rule (with-lines other ...)
  ;; A line t1 to a vehicle r1, and others.
  (world (sea)
         (box (at 3 9 -9) (size 1 1 1))
         (rov (named r1) (at 0 0 -8) (pull 400))
         (tether (named t1) (from -6 -3 -7) (to r1) (length 10) (wet-weight 0.3) (model dynamic))
         other ...))

(define (pulls-in world)
  ;; The tensions of t1, step by step, while its vehicle goes about and its winch hauls.
  (enter! world)
  (let ((pulls '()) (wrong '()))
    (define (go-on seconds)
      (run-until (lambda ()
                   (set! pulls (cons (max-tension 't1) pulls))
                   (set! wrong (append (unsound-tethers) wrong))
                   #f)
                 #:at-most seconds))
    (go-on 1)
    (fly-to! 'r1 (vec 1 1 -7) #:speed 1/2)
    (go-on 3)
    (haul-in! 't1 1/2 #:rate 1/2)
    (go-on 2)
    (expect wrong => '())
    pulls))

(define-scenario a-vehicle-with-several-lines
  "Lines that are made fast to one vehicle meet there by being made fast, not by contact: a line pulls as it
does alone."
  (define alone (pulls-in (with-lines)))
  (define beside
    (pulls-in (with-lines (tether (named t2) (from -6 4 -7) (to r1) (length 11) (wet-weight 0.3) (model dynamic))
                          (tether (named t3) (from 1 8 -8) (to r1) (length 12) (wet-weight 0.2) (model auto)))))
  (expect (length beside) => (length alone))
  (expect (fold max 0 (map (lambda (a b) (abs (- a b))) alone beside)) is (below 0.1)))

(define-scenario an-anchor-of-two-lines
  "The same of lines that begin at one point."
  (define alone (pulls-in (with-lines)))
  (define beside
    (pulls-in (with-lines (rov (named r2) (at -8 2 -8))
                          (tether (named t2) (from -6 -3 -7) (to r2) (length 11) (wet-weight 0.3)
                                  (model dynamic)))))
  (expect (fold max 0 (map (lambda (a b) (abs (- a b))) alone beside)) is (below 0.1)))

(define-scenario a-body-is-where-its-line-ends
  "A vehicle with mass that is jerked round by its line stays at the line's end."
  (enter! (world (sea)
                 (rov (named r1) (type bluerov2-heavy-wu) (at 0 0 -6))
                 (tether (named t1) (from -8 0 -5) (to r1) (length 8.5) (model dynamic))))
  (fly-to! 'r1 (vec 0 3 -6) #:speed 3)
  (run 2)
  (haul-in! 't1 4 #:rate 3)
  (expect (unsound-while 4) => '()))

(define-scenario an-end-beside-its-own-line
  "Where a line is near itself its end is pulled by no more than its vehicle can, and yet ends there, not a
spring's stretch beside it."
  (enter! (world (sea)
                 (rov (named r1) (at 0.03 0 -5))
                 (tether (named t1) (from 0 0 -5) (to r1) (length 20) (wet-weight 3) (model dynamic))))
  (define (beside)
    (norm (vec- (point-at 't1 20) (rov-position 'r1))))
  (always (< (beside) 1e-7) (run 1))
  (move! 'r1 '(0.02 0 -2) #:speed 1)
  (always (< (beside) 1e-7) (run 3))
  (expect (rov-tension 't1) is (above 30)))

(define-scenario (a-static-tether-beside-a-moving-one model)
  "A vehicle that its moving line holds back takes the end of a static tether along, whichever the world
names first."
  #:for ((model 'catenary 'v-shape 'elastic 'rubber-band))
  (enter! (world (sea)
                 (rov (named r1) (at -6 0 -2))
                 (tether (named t1) (from -6 0 -1) (to r1) (length 17) (model ,model))
                 (tether (named t2) (from -6 0 -1) (to r1) (length 9) (model dynamic))))
  (fly-to! 'r1 (vec -6 9 -1) #:speed 3)
  (expect (unsound-while 4) => '()))

(define-syntax-rule (three-tethers obstacle ...)
  ;; A vehicle with mass that the third of its tethers carries.
  (world (sea (current 0.3 0))
         obstacle ...
         (rov (named r1) (type bluerov2-heavy-wu) (at -6 0 -9))
         (tether (named t1) (from -10 3 -6) (to r1) (length 32) (model steady))
         (tether (named t2) (from -9 0 -5) (to r1) (length 18) (model rubber-band))
         (tether (named t3) (from -9 0 -5) (to r1) (length 19) (model dynamic))))

(define-scenario (a-static-tether-beside-the-line-that-carries among?)
  "A vehicle with mass goes where the line that carries it takes it, and the other tethers' ends with it,
whichever the world names first; it is not held where it was because they were asked first."
  #:for ((among? #f #t))
  (enter! (if among? (three-tethers (sphere (named ball) (at 30 30 -5) (radius 0.2))) (three-tethers)))
  (fly-to! 'r1 (vec -3 0 -7) #:speed 1)
  (expect (unsound-while 2) => '())
  (expect (x (rov-position 'r1)) is (above -5.5)))

(define-scenario (a-track-that-begins-elsewhere model)
  "A vehicle that is to follow a track from elsewhere is placed where it begins, which takes no time and
throws no line: it is not dragged there within a step."
  #:for ((model 'dynamic 'auto))
  (enter! (world (sea)
                 (rov (named r1) (at -8 -7 -4))
                 (tether (named t1) (from -2 7 -8) (to r1) (length 28) (model ,model))))
  (run 1)
  (follow! 'r1 '((0 -1 7 -9) (8 -2 5 -8)))
  (expect (distance (rov-position 'r1) '(-1 7 -9)) is (below 1e-9))
  (always (and (pair? (energy 't1)) (< (max-tension 't1) 50)) (run 2))
  (follow! 'r1 '((0 90 0 -9) (4 90 5 -9)))
  (expect (distance (rov-position 'r1) '(-2 7 -8)) is (below 28.5))
  (expect (unsound-while 1) => '()))

(define-scenario a-track-that-begins-here
  "A line goes on as it moves when its vehicle begins to follow a track from where it is, or nearly so."
  (enter! (world (sea)
                 (rov (named r1) (at 8 0 -4))
                 (tether (named t1) (from 0 0 -8) (to r1) (length 12) (model dynamic))))
  (fly-to! 'r1 '(8 6 -4) #:speed 1)
  (run 2)
  (define moving (assq-ref (energy 't1) 'kinetic))
  (follow! 'r1 '((0 8 2.01 -4) (4 8 5 -4)))
  (expect (assq-ref (energy 't1) 'kinetic) => moving))

(define-scenario (a-current-that-turns-at-once nodes weight)
  "A line of the model `steady' whose current changes all at once is on its way to rest for a while; there,
too, it is no longer than it is, and pulls as much as water can."
  #:for ((nodes 12 24 60) (weight 0 0.2))
  (enter! (world (sea (current (power 1 119 (exponent 1))))
                 (rov (named r1) (at -8.16 -5.7 -6))
                 (tether (named t1) (from -9.18 -6.3 -6.56) (to r1) (length 37) (wet-weight weight)
                         (nodes nodes) (model steady))))
  (define (pulls-soundly?) (< (max-tension 't1) 60))
  (for-each (lambda (speed toward)
              (current! speed toward)
              (expect (unsound-tethers) => '())
              (expect (pulls-soundly?))
              (expect (unsound-while 0.1) => '())
              (expect (pulls-soundly?)))
            '(1 0.001 0.7 0.02 1) '(0 196 90 300 120)))

(define-scenario (hauled-while-held model rate)
  "Of a static tether that an obstacle holds off its shape the winch draws in, or pays out, what the way it
comes lets it, and the tether ends at its vehicle all the while."
  #:for ((model 'elastic 'steady 'v-shape) (rate 1 -1))
  (enter! (world (sea)
                 (capsule (named o1) (from 0.929 -0.706 -6.434) (to -2.173 -5.314 -3.414) (radius 0.0076))
                 (rov (named r1) (at -0.82 0.938 -2.633))
                 (tether (named t1) (from -7.138 -2.982 -9.637) (to r1) (length 20) (model ,model))))
  (move! 'r1 '(0.6 -2.2 -2.1) #:speed 2)
  (expect (unsound-while 3) => '())
  (if (> rate 0) (pay-out! 't1 2 #:rate rate) (haul-in! 't1 2 #:rate (- rate)))
  (expect (unsound-while 1) => '())
  (move! 'r1 '(-0.82 0.938 -2.633) #:speed 1)
  (expect (unsound-while 2) => '()))

(define-scenario (hauled-over-an-edge first)
  "A static tether that is hauled in over an obstacle draws its vehicle along, and with that the end of a
moving line, whichever the world names first."
  #:for ((first 'v-shape 'dynamic))
  (define second (if (eq? first 'dynamic) 'v-shape 'dynamic))
  (enter! (world (sea)
                 (box (named o1) (at 0 0 -5) (size 1 4 1))
                 (rov (named r1) (at 5 0.2 -5))
                 (tether (named t1) (from -5 0 -5) (to r1) (via (-0.6 0 -4.3) (0.6 0 -4.3)) (length 12) (model ,first))
                 (tether (named t2) (from -5 0 -5) (to r1) (via (-0.6 0 -4.3) (0.6 0 -4.3)) (length 12) (model ,second))))
  (define static (if (eq? first 'dynamic) 't2 't1))
  (haul-in! static 4 #:rate 0.6)
  (expect (unsound-while 7) => '())
  (expect (norm (vec- (rov-position 'r1) '(5 0.2 -5))) is (above 0.5)))

(define-scenario (hauled-over-an-edge-alone model)
  "A static tether that is hauled in over an edge is read as it lies, also where it is held and has yet to
come to the length that its winch wants."
  #:for ((model 'catenary 'catenary-simplex 'v-shape 'rubber-band 'elastic 'steady))
  (enter! (world (sea)
                 (box (named o1) (at 0 0 -5) (size 1 4 1))
                 (rov (named r1) (at 5 0.2 -5))
                 (tether (named t1) (from -5 0 -5) (to r1) (via (-0.6 0 -4.3) (0.6 0 -4.3)) (length 12)
                         (model ,model))))
  (haul-in! 't1 4 #:rate 0.6)
  (expect (unsound-while 4) => '()))

(define-scenario (a-tug-of-war one other third)
  "Winches that draw at one vehicle from two sides stall where neither can have more: no step ends with a
tether beside its vehicle, and the vehicle is not held for ever."
  #:for ((one 'v-shape 'elastic 'rubber-band) (other 'v-shape 'catenary) (third 'dynamic 'v-shape))
  (enter! (world (sea)
                 (box (named o1) (at 0 0 -5) (size 1 4 1))
                 (box (named o2) (at 10 0 -5) (size 1 4 1))
                 (rov (named r1) (at 5 0.2 -5))
                 (tether (named t1) (from -5 0 -5) (to r1) (via (-0.6 0 -4.3) (0.6 0 -4.3)) (length 12)
                         (model ,one))
                 (tether (named t3) (from 5 4 -5) (to r1) (length 6) (model ,third))
                 (tether (named t2) (from 15 0 -5) (to r1) (via (10.6 0 -4.3) (9.4 0 -4.3)) (length 12)
                         (model ,other))))
  (haul-in! 't1 4 #:rate 0.6)
  (haul-in! 't2 4 #:rate 0.6)
  (expect (unsound-while 5) => '())
  (expect (tether-length 't1) is (above 9.9))
  (expect (tether-length 't2) is (above 9.9)))

(define-scenario a-vehicle-that-is-placed
  "A vehicle that is placed drags its line along and is held back by nothing, unless it comes short of the
place."
  (in pile)
  (run 1)
  (place! '(5 5 -3))
  (expect (held?) => #f)
  (place! '(0 60 -3))
  (expect (held?))
  (step!)
  (expect (held?) => #f))


;;; What stands in the way of a vehicle.

(define (restless seconds)
  ;; How far the vehicle goes back in a step of so many SECONDS, at the most, m, and the largest load of a
  ;; contact, N.
  (let ((last (rov-position)) (before (vec 0 0 0)) (back 0) (load 0))
    (run-until (lambda ()
                 (let ((way (vec- (rov-position) last)))
                   (when (< (norm (vec+ way before)) (norm (vec- way before))) (set! back (max back (norm way))))
                   (set! before way)
                   (set! last (rov-position))
                   (set! load (fold (lambda (c most) (max most (norm (contact-force c)))) load (contacts)))
                   #f))
               #:at-most seconds)
    (values back load)))

(define-scenario (driven-into obstacle from)
  "A vehicle that is told to go where something is comes to rest there, or slides along it, whatever that is
and however it comes: it does not tremble, and the end of its line is pressed on by what pulls it, no more."
  #:for ((obstacle (part cylinder (from 0 0 1) (to 0 0 -15) (radius 0.45))
                   (part cylinder (from -6 0 -5) (to 6 0 -5) (radius 0.2))
                   (part sphere (at 0 0 -5) (radius 1.5))
                   (part box (at 0 0 -5) (size 2 2 6))
                   (part capsule (from -2 1 -8) (to 2 -1 -2) (radius 0.3)))
         (from '(6 -6 -5) '(-5 -5 -4) '(0 7 -9) '(3 -6 -5.5)))
  (enter! (world (sea (depth 15) (current 0.25 90)) (splice obstacle)
                 (rov (named r1) (at from) (pull 100))
                 (tether (named line) (type fathom) (wet-weight 0) (model dynamic)
                         (from 9 3 -3) (to r1) (length 40))))
  (move! (vec 0 (* 0.05 (abs (z from))) -5.2) #:speed 2)
  (run 16)
  (let-values (((back load) (restless 2)))
    (expect back is (below 1e-3))
    (expect load is (below 160))))
(define-scenario (a-held-vehicle-stays ea weight)
  "A vehicle that pulls harder than its line stays where it is while the line touches something."
  #:for ((ea 1e5 1e7) (weight 100 1500))
  (enter! (world (sea (depth 35))
                 (seabed)
                 (rov (named r1) (at 10 0 -20) (pull 1e6))
                 (tether (named t1) (from -12 0 -10) (to r1) (length 60) (wet-weight weight) (ea ea)
                         (model dynamic))))
  (always (< (distance (rov-position) '(10 0 -20)) 1e-6) (run 10))
  (expect (rov-tension) is (above (* 13 weight))))

;;; ---- The forces at both ends balance what acts between them. ----

(define (imbalance load)
  ;; How far what anchor and vehicle pull with is from holding a line at rest under LOAD in all.
  (abs (- (anchor-tension) (norm (vec- load (tether-force))))))

(define (metre-by-metre length of)
  ;; The sum of OF over a line of LENGTH: the force on a metre whose tangent is given.
  (let* ((n 1000) (ds (/ length n)))
    (fold (lambda (k sum) (vec+ sum (vec* ds (of (tangent-at (* ds (+ k 1/2)))))))
          (vec 0 0 0) (iota n))))

(define (wet-weight-of-steel mass)
  (* mass 9.80665 (- 1 (/ 1025 7850))))

(define-scenario (a-clump-anywhere at bending)
  "A clump weighs on what holds the line wherever it is fastened, also within the last interval and at the
very ends."
  #:for ((at 0 0.1 12 24.5 24.75 24.9 24.99 25) (bending 0 0.5))
  (enter! (world (sea (depth 200))
                 (rov (named r1) (at 20 0 -10))
                 (tether (named t1) (from 0 0 -10) (to r1) (length 25) (wet-weight 0.2) (ei bending)
                         (model dynamic) (clump (at at) (mass 10)))))
  (settle! #:within 1e-4 #:at-most 300)
  (expect (imbalance (vec 0 0 (- (+ (* 25 0.2) (wet-weight-of-steel 10))))) is (below 0.05))
  (expect (>= (max-tension) (max (anchor-tension) (rov-tension))))
  (when (>= at 24.5)
    (expect (- (z (tether-force))) is (between 87.5 88))))

(define-scenario (models-at-rest model weight speed)
  "The same of the models that find the equilibrium: weight and drag, added up along the shape."
  #:for ((model 'elastic 'steady) (weight -0.3 0 0.4) (speed 0 0.5))
  (define current (vec speed 0 0))
  (define (on-a-metre tangent)
    (let* ((along (fold + 0 (map * (array->list current) (array->list tangent))))
           (across (vec- current (vec* along tangent))))
      (vec+ (vec 0 0 (- weight))
            (vec+ (vec* (* 1/2 1025 1.2 0.01 (norm across)) across)
                  (vec* (* 1/2 1025 0.02 (acos -1) 0.01 (abs along) along) tangent)))))
  (enter! (world (sea (depth 200) (current speed 90))
                 (rov (named r1) (at 0 30 -30))
                 (tether (named t1) (from 0 0 -10) (to r1) (length 42) (wet-weight weight) (diameter 0.01)
                         (cdn 1.2) (cdt 0.02) (ea 1e5) (model ,model))))
  (expect (imbalance (if (eq? model 'steady) ; the other knows no current
                         (metre-by-metre 42 on-a-metre)
                         (vec 0 0 (* -42 weight))))
          is (below 1e-4)))

(define-scenario cut-in-open-water
  "The two parts of a line that is cut lie end to end, and are not told to touch there."
  (in cross-current)
  (tether-model! 'dynamic)
  (run 5)
  (cut-tether!)
  (run 10)
  (expect (map car (events)) => '(parted)))

(define-scenario what-has-parted-is-not-laid-anew
  "The stump of a cut line is not fastened to its vehicle again, kilometres away, by being laid anew: that is refused, and
the vehicle is placed without."
  (enter! (world (sea (depth 60)) (rov (named r1) (at 8 0 -10)) (tether (named t1) (from 0 0 -10) (to r1) (length 9) (model dynamic))))
  (cut-tether! 't1 #:at 3)
  (run 1)
  (expect (place! 'r1 '(500 0 -20) #:fresh #t) raises unsupported)
  (expect (parted?))
  (expect (max-tension) is (below 50)))
