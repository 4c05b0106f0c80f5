;;; What model `auto' promises: of a hundred flights at most one lies farther from the truth than the
;;; error that was accepted.  The truth here is the same flight on four hundred nodes.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

;; BIGHT_SEED draws other flights.
(define state (seed->random-state (or (and=> (getenv "BIGHT_SEED") string->number) 4)))

(define (between-random low high)
  (+ low (* (- high low) (random:uniform state))))

(define (random-world)
  ;; A procedure that makes the same world with a model and a number of nodes.
  (let* ((length (between-random 15 80))
         (chord (* length (between-random 0.3 0.95)))
         (bearing (between-random 0 6.28))
         (dip (between-random -1.0 0.3))
         (flat (* chord (cos dip)))
         (end (vec (* flat (sin bearing)) (* flat (cos bearing)) (+ -20 (* chord (sin dip)))))
         (speed (between-random 0 0.7))
         (toward (between-random 0 360))
         (weight (between-random -0.05 0.3)))
    (lambda (model nodes)
      (world (sea (depth 200) (current speed toward))
             (rov (named minnow) (at end) (pull 1e6))
             (tether (named line) (type fathom) (wet-weight weight) (from 0 0 -20) (to minnow)
                     (length length) (model ,model) (nodes nodes) (accuracy asked))))))

(define asked 0.1)                      ; m

(define (shapes-of-flight w moves)
  ;; The polylines of a flight in W, one at the end of each of MOVES, four seconds long.
  (enter! w)
  (map (lambda (move)
         (drive! #:surge (car move) #:sway (cadr move) #:heave (caddr move))
         (run 4)
         (tether-points 41))
       moves))

(define (farthest-apart one other)
  (apply max
         (map (lambda (i) (distance (array-cell-ref one i) (array-cell-ref other i))) (iota 41))))

(define (random-move)
  (list (between-random -0.5 0.5) (between-random -0.5 0.5) (between-random -0.3 0.3)))

(define (flight-error)
  (let* ((make (random-world))
         (moves (list (random-move) (random-move) (random-move)))
         (found (shapes-of-flight (make 'auto 64) moves))
         (truth (shapes-of-flight (make 'dynamic 400) moves)))
    (apply max (map farthest-apart found truth))))

(define-scenario auto-keeps-its-promise
  "A hundred random flights at an accepted error of 10 cm: at most one is worse."
  (let* ((errors (map (lambda (i) (flight-error)) (iota 100)))
         (worse (filter (lambda (e) (> e asked)) errors)))
    (format #t "# errors of 100 flights: median ~,3f m, worst ~,3f m, ~a above ~a m~%"
            (list-ref (sort errors <) 50) (apply max errors) (length worse) asked)
    (expect (length worse) is (between 0 1))))

(define (default-flight length)
  ;; The estimated error of LENGTH metres of line in a current after half a minute, and whether it is accepted.
  (enter! (world (sea (depth 300) (current 0.3 90))
                 (rov (named minnow) (at 0 (* 0.8 length) -40) (pull 1e6))
                 (tether (named line) (type fathom) (from 0 0 -40) (to minnow) (length length) (model auto))))
  (run 30)
  (list (error-estimate) (accurate?)))

(define-scenario the-default-follows-what-is-out
  "Without a number the accepted error is 2 cm, and less of what is shorter than 10 m: 0.2 %."
  (for-each
   (lambda (length)
     (let ((usual (default-flight length)) (accepted (min 0.02 (* 0.002 length))))
       (expect (cadr usual))
       (expect (car usual) is (between 0 accepted))
       (accuracy! (* 0.99 (car usual)))
       (expect (not (accurate?)))
       (accuracy! 'auto)
       (expect (accurate?))
       (accuracy! accepted)
       (expect (accurate?))))
   '(2 5 30 100)))

(define pieces 24)

(define (longest-piece)
  ;; The most that a straight way between ends of such a piece of the line is, as a share of the piece.
  (let ((points (tether-points (+ pieces 1))))
    (let loop ((i 1) (most 0))
      (if (> i pieces)
          (/ most (/ (tether-length) pieces))
          (let ((way (map (lambda (k) (- (array-ref points i k) (array-ref points (- i 1) k))) '(0 1 2))))
            (loop (+ i 1) (max most (sqrt (apply + (map * way way))))))))))

(define-scenario (a-line-tells-what-it-is-longer-than-is-out volume)
  "Where nodes come to a line of few intervals they lie on its curve, and the line is longer by a metre than what is out,
until its winch has paid that: no piece is longer by more than its share of the estimated error, and a hundredth between nodes."
  #:for ((volume 0.040 0.043 0.046))
  (enter! (world (sea)
                 (rov (named minnow) (at -6 -3 -1) (heading 31) (roll -56) (mass 18) (volume volume) (tether-point 1 -1 -1))
                 (tether (named line) (from -8 3 -8) (to minnow) (via (-10 8 -10) (-9 -1 -9)) (length 26) (drum 120) (nodes 3)
                         (model dynamic) (winch-brake 4.5) (winch-rate 2.2) (set (at 9.9) (curvature 0.0014) (plane 264))
                         (ei 0.05) (from-along 1 0 0))))
  (pay-out! 52 #:rate 52)
  (always (< (longest-piece) (+ 1.011 (/ (error-estimate) (tether-length))))
    (run 1.5)))
