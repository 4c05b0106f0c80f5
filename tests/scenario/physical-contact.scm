;;; Contact in the physical response, as a pilot meets it: what a tether round things does to the one who
;;; flies it.  Model `dynamic' at 60 Hz; friction, stiffness and line are those stated in each world.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(define (fly . places)
  ;; Through PLACES one after another, giving up on each after a while.
  (for-each (lambda (p)
              (move! p #:speed 1)
              (run-until arrived? #:at-most 20))
            places))

(define legs '(jacket/leg-a1 jacket/leg-a2 jacket/leg-b1 jacket/leg-b2))

(define (farthest-apart a b)
  (apply max (map (lambda (p q) (abs (- p q))) a b)))

(define-scenario round-two-legs-and-back
  "Figure 3-8: once round each of two legs of a jacket and back the same way: the turns are again what they
were, and the line is hauled out without a touch."
  (in 'jacket)
  (let ((before (map turns legs))
        (home '(-2 -14 -8))
        (way '((3 -10 -8) (3 -3 -8) (9 -3 -8) (9 -9 -8) (3 -10 -8) (-3 -10 -8) (-9 -9 -8) (-9 -3 -8) (-3 -3 -8)
               (-3 -10 -8))))
    (apply fly way)
    (expect (- (turns 'jacket/leg-b2) (list-ref before 3)) is (above 0.9))
    (apply fly (append (reverse way) (list home)))
    (expect (farthest-apart before (map turns legs)) is (below 0.03))
    (haul-in! 47 #:rate 0.5)
    (run 130)
    (expect (null? (contacts)))
    (expect (null? (windings)))))

(define-scenario a-wrap-undone-is-counted-once
  "Once round a pile and back: the winding goes up once and down once, and afterwards nothing touches, and the
line lies as it lay."
  (in 'pile)
  (current! 0.25 180)
  (run 240)
  (let ((seen '()) (shape (tether-points 80)))
    (define (note!)
      (let ((w (winding 'p1)))
        (unless (and (pair? seen) (= w (car seen)))
          (set! seen (cons w seen)))))
    (define (go! . places)
      (for-each (lambda (p)
                  (move! p #:speed 1)
                  (let loop ((n 0))
                    (run 0.5)
                    (note!)
                    (unless (or (arrived?) (> n 60)) (loop (+ n 1)))))
                places))
    (go! '(6 6 -5) '(-6 6 -5) '(-6 -4 -5) '(6 -4 -5))
    (go! '(-6 -4 -5) '(-6 6 -5) '(6 6 -5) '(6 -6 -5))
    (run 240)
    (expect (equal? seen '(0 -1 0)))
    (expect (null? (contacts)))
    (expect (tether-length) => 40.0)
    (expect (deviation-max (deviation shape #:at (map (lambda (k) (* 40 (/ k 79))) (iota 80))))
            is (below 0.4))))

(define-scenario a-taut-line-stops-its-vehicle
  "Bent half round a drum, a vehicle that flies on is stopped where its line is taut: smoothly, for good, and
outside the drum."
  (in (world (sea (depth 20))
             (cylinder (named drum) (from 0 0 1) (to 0 0 -20) (radius 0.6))
             (rov (named minnow) (at 6 2 -6))
             (tether (from 6 -2 -6) (to minnow) (length 24) (via (-2 -2 -6) (-2 2 -6)) (type fathom) (wet-weight 0)
                     (friction 0.3) (model dynamic))))
  (move! '(30 2 -6) #:speed 0.5)
  (run 60)
  (let ((at (rov-position)) (pull (rov-tension)))
    (expect (x at) is (below 20))
    (run 20)
    (expect (rov-position) is (about at #:within 0.05))
    (expect (rov-tension) is (about pull #:within 0.5))
    (expect (clearance) is (above (* -1/4 0.0076)))))

(define (spaced-points gap)
  ;; Points of the tether, each GAP m of line after the one before.
  (map (lambda (k) (point-at (* k gap))) (iota (inexact->exact (floor (/ (tether-length) gap))))))

(define-scenario (points-lie-on-the-arc radius)
  "Bent half round a member, the points of a line lie on the member or off it, and are no farther from each other
than the line between them is long: they are read along the arc, not on the corner that the solver has there."
  #:for ((radius 0.05 0.6 1.5))
  (in (world (sea (depth 30))
             (cylinder (named drum) (from 0 0 1) (to 0 0 -30) (radius radius) (friction 0.3))
             (rov (named minnow) (at 6 2 -16))
             (tether (from 6 -2 -12) (to minnow) (length 24) (via (-2 -2 -12) (-2 2 -12)) (type fathom) (wet-weight 0)
                     (friction 0.3) (ei 0.5) (nodes 16) (model dynamic))))
  (move! '(20 2 -16) #:speed 0.5)
  (run 30)
  (expect (pair? (contacts)))
  (let* ((gap 0.01) (points (spaced-points gap)))
    (expect (apply min (map (lambda (p) (norm (vec (x p) (y p) 0))) points)) is (above (+ radius 0.00379)))
    (expect (apply max (map distance (list-head points (- (length points) 1)) (cdr points))) is (below (* 1.02 gap)))))

(define-scenario a-wound-line-does-not-feel-the-winch
  "Two and a half turns round a pile hold by friction, e^(0.8 5 pi): 100 N need 0.4 mN on the winch's side, and a
slack line drifting there pulls with more.  What is paid out stays there, and the vehicle, pulled as it was, gains
less than a tenth of it."
  (in 'pile)
  (alter! 'line #:friction 0.8)
  (fly '(2 3 -5) '(-3 3 -5) '(-3 -3 -5) '(3 -3 -5) '(3 3 -5) '(-3 3 -5) '(-3 -3 -5) '(3 -3 -5) '(3 3 -5))
  (move! '(12 20 -5) #:speed 1)
  (run 60)
  (expect (stuck?))
  (let ((at (rov-position)) (pull (rov-tension)))
    (pay-out! 8 #:rate 0.5)
    (run 40)
    (expect (tether-length) is (about 48 #:within 1e-6))
    (expect (rov-tension) is (about pull #:within (* 0.02 pull)))
    (expect (range-to at) is (below 0.8))))

(define core (* 1/4 0.0076))            ; the line's axis comes no nearer to anything

(define-scenario (never-through-the-solid mu)
  "Figure 3-6: drawn over an edge so that its bow hits the next face, then flown toward the box and back to the
side again and again: the line is never through it, and when it is back where it was it is on its old side."
  #:for ((mu 0 0.3 1))
  (in (world (sea (depth 60) (current 0.5 0))
             (box (named container) (at 0 3 -10) (size 6 6 6) (friction mu))
             (rov (named minnow) (at 9 -2 -10))
             (tether (named line) (type fathom) (wet-weight 0) (model dynamic) (nodes 64)
                     (from -9 -2 -10) (to minnow) (length 20))))
  (always (> (clearance) (- core))
    (fly '(9 4 -10) '(3.5 7 -10))
    (require (pair? (contacts)))
    (expect (turns 'container) is (below -0.4))
    (expect (winding 'container) => 0)  ; it can be lifted off
    (fly '(-2 7 -10) '(3.5 7 -10) '(-4 8 -10) '(6 7 -10) '(9 4 -10) '(9 -2 -10)))
  (expect (rov-position) is (about '(9 -2 -10) #:within 0.01))
  (expect (abs (turns 'container)) is (below 0.4)))

(define (spans)
  ;; The lengths of line on the anchor's side and on the vehicle's side of what it runs about.
  (let ((lengths (map segment-length (segments))))
    (list (car lengths) (- (tether-length) (car lengths)))))

;; What lies on the wire, at most half a turn of its radius and the line's, belongs to no segment.
(define on-the-wire (* 3.1416 0.0138))

(define-scenario what-slides-round-keeps-its-length
  "Figure 3-7 without friction: the vehicle goes off 5 m and comes back; what its own span takes the other gives,
by the same pull on both sides of the wire."
  (in (world (sea (depth 30) (current 0.4 90))
             (cylinder (named wire) (from 0 0 1) (to 0 0 -30) (radius 0.01) (friction 0))
             (rov (named minnow) (at 6 0.015 -6))
             (tether (named line) (type fathom) (wet-weight 0) (cdt 0) (model dynamic) (nodes 128)
                     (from -0.35 -15 -6) (via (-0.35 -0.4 -6) (-0.35 0.4 -6)) (to minnow)
                     (length 30))))
  (run 60)
  (let ((before (spans)))
    (move! '(11 0.015 -6) #:speed 0.25)
    (run 60)
    (expect (rov-tension) is (about (anchor-tension) #:within (* 0.01 (anchor-tension))))
    (let ((away (spans)))
      (expect (- (car before) (car away)) is (about 5 #:within 0.05))
      (expect (- (cadr away) (cadr before)) is (about 5 #:within 0.05))
      (expect (apply + (map segment-length (segments))) is (about 30 #:within on-the-wire)))
    (move! '(6 0.015 -6) #:speed 0.25)
    (run 60)
    (expect (car (spans)) is (about (car before) #:within 0.05))
    (expect (apply + (map segment-length (segments))) is (about 30 #:within on-the-wire))))

(define (platform mu)
  ;; Figure 3-8 with a vehicle that pulls 30 N.
  (world (sea (depth 36) (current 0.25 90))
         (splice (make-jacket #:depth 36 #:bays 2 #:top 2))
         (rov (named minnow) (at -2 -14 -8) (pull 30))
         (tether (named line) (type fathom) (wet-weight 0) (friction mu) (model dynamic) (nodes 128)
                 (from 0 -22 -6) (to minnow) (length 80))))

(define round-two-legs
  '((-3 -10 -8) (-9 -9 -8) (-9 -3 -8) (-3 -3 -8) (-3 -10 -8) (3 -10 -8) (3 -3 -8) (9 -3 -8) (9 -9 -8)
    (3 -10 -8) (3 -3 -8) (5 0 -8)))

(define-scenario platform-holds
  "Figure 3-8: wound round two legs at a friction of 0.6 the line is stuck: 10 m paid out stay on the winch's side,
and the vehicle keeps its place and its pull. The way back leaves no turn and no excess."
  (in (platform 0.6))
  (let ((before (map turns legs)))
    (apply fly round-two-legs)
    (move! '(10 40 -8) #:speed 1)
    (run 60)
    (expect (length (contacts)) is (above 2))
    (expect (map winding '(jacket/leg-b1 jacket/leg-b2)) => '(1 1))
    (expect (stuck?))
    (let ((at (rov-position)) (pull (rov-tension)) (slack-before (slack)))
      (expect pull is (about 30 #:within 1))
      (pay-out! 10 #:rate 0.5)
      (run 40)
      (expect (rov-position) is (about at #:within 0.05))
      (expect (rov-tension) is (about pull #:within (* 0.02 pull)))
      (expect (anchor-tension) is (below 2))
      (expect (slack) is (above slack-before)))
    (apply fly (append (reverse round-two-legs) '((-2 -14 -8))))
    (run 20)
    (expect (map winding legs) => '(0 0 0 0))
    (expect (farthest-apart before (map turns legs)) is (below 0.03))
    (expect (excess) is (below 0.1))))

(define-scenario platform-slips
  "The same at a friction of 0.1: the winch's side is slack, so the line slips round the legs, and the vehicle goes
where it was held before."
  (in (platform 0.1))
  (apply fly round-two-legs)
  (move! '(5 30 -8) #:speed 1)           ; clear of the leg at (6 6)
  (run 60)
  (expect (stuck?) => #f)
  (expect (rov-position) is (about '(5 30 -8) #:within 0.5)))

(define-scenario a-wound-line-with-little-friction-does
  "Two turns at a friction of 0.1 let a third of the pull through, e^(-0.1 4 pi): what is paid out comes out at the
vehicle."
  (in 'pile)
  (alter! 'line #:friction 0.1)
  (fly '(2 3 -5) '(-3 3 -5) '(-3 -3 -5) '(3 -3 -5) '(3 3 -5) '(-3 3 -5) '(-3 -3 -5) '(3 -3 -5) '(3 3 -5))
  (move! '(12 40 -5) #:speed 1)
  (run 60)
  (let ((at (rov-position)) (pull (rov-tension)))
    (expect (/ (anchor-tension) pull) is (between 0.2 0.4))
    (pay-out! 8 #:rate 0.5)
    (run 40)
    (expect (range-to at) is (between 7 8.5))))

(define-scenario what-sticks-keeps-the-anchors-side
  "Figure 1-2: bent half round a drum that lets nothing slide, e^(10 pi), the vehicle goes off by 5 m and down by 5 m:
the anchor's side of the line, drawn tight, stays to 4 mm, for what sticks gives by 2 mm, and only the vehicle's takes
another shape."
  (in (world (sea (depth 20))
             (cylinder (named drum) (from 0 0 1) (to 0 0 -20) (radius 0.6) (friction 10))
             (rov (named minnow) (at 6 0.605 -6))
             (tether (named line) (from 6 -0.605 -6) (to minnow) (length 15)
                     (via (-0.7 -0.7 -6) (-0.7 0.7 -6)) (type fathom) (wet-weight 0) (model dynamic) (nodes 100))))
  (move! '(8 0.605 -6) #:speed 0.3)
  (run 20)
  (haul-in! 0.0025 #:rate 0.001)        ; a slack side swings by millimetres, whatever sticks
  (run 100)
  (let* ((shape (tether-points 101)) (side (lambda (from to) (map (lambda (i) (+ from i)) (iota (- to from)))))
         (moved (lambda (now i) (distance (array-cell-ref shape i) (array-cell-ref now i)))))
    (for-each (lambda (to)
                (move! to #:speed 0.3)
                (run 60)
                (let ((now (tether-points 101)))
                  (expect (apply max (map (lambda (i) (moved now i)) (side 0 40))) is (below 0.004))
                  (expect (moved now 100) is (above 3))))
              '((6 5 -6) (6 0.605 -11)))))

(define-scenario a-step-that-did-not-converge-breaks-nothing
  "Drawn tight round a drum that hardly lets anything slide, a line that bears 1557 N holds a pull of 100 N."
  (in (world (sea (depth 20))
             (cylinder (named drum) (from 0 0 1) (to 0 0 -20) (radius 0.6) (friction 10))
             (rov (named minnow) (at 6 0.605 -6))
             (tether (from 6 -0.605 -6) (to minnow) (length 15) (via (-0.7 -0.7 -6) (-0.7 0.7 -6)) (type fathom)
                     (wet-weight 0) (model dynamic) (nodes 100))))
  (move! '(12 0.605 -6) #:speed 0.3)
  (run 20)
  (expect (parted?) => #f)
  (expect (rov-tension) is (about 100 #:within 10)))
