;;; Slack lines lighter than water lie on it, laid or solved.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(use-modules (srfi srfi-1) (bight test soundness))

(define random-numbers (seed->random-state (or (and=> (getenv "BIGHT_SEED") string->number) 5)))

(define (between-random low high)
  (+ low (* (- high low) (random:uniform random-numbers))))

(define (one-of . values)
  (list-ref values (random (length values) random-numbers)))

(define (floating model bed)
  ;; A slack line lighter than water, its ends in the water or at its surface.
  (let* ((from (vec 0 0 (one-of 0 (between-random -15 0))))
         (to (vec (between-random -20 20) (between-random -20 20) (between-random -15 -0.1)))
         (chord (distance from to)))
    (world (sea (depth 60) (current (one-of 0 (between-random 0 0.6)) (between-random 0 360)))
           (splice bed)
           (rov (named minnow) (at (x to) (y to) (z to)))
           (tether (named line) (type fathom) (from (x from) (y from) (z from)) (to minnow)
                   (wet-weight (- (one-of 0.01 0.034 0.3))) (nodes (one-of 20 64 150))
                   (model ,model) (length (* chord (between-random 1.02 6)))))))

(define (highest n)
  (apply max (map third (array->list (tether-points n)))))

(define (length-of points)
  (let ((points (array->list points)))
    (apply + (map distance points (cdr points)))))

(define radius 0.0038)

(define-scenario (no-line-stands-in-the-air model bed)
  "Laid or solved, no point of a floating line is above the surface beyond its radius, between nodes either,
and the line is no longer than what is out."
  #:for ((model 'elastic 'steady 'dynamic 'auto) (bed '() (list (part seabed))))
  (for-each
   (lambda (k)
     (enter! (floating model bed))
     (expect (highest 500) is (below radius))
     (expect (length-of (tether-points)) is (below (* 1.002 (tether-length))))
     (expect (point-at 0) is (about (first (array->list (tether-points))) #:within 1e-9))
     (expect (distance (point-at (tether-length)) (rov-position)) is (below 1e-6)))
   (iota 20)))

(define-scenario (no-piece-is-longer-than-it-is model-and-nodes)
  "However few its nodes and however much it is stretched, no piece of a floating line is longer than its tension tells:
folded back at the middle one of two intervals was by a twentieth."
  #:for ((model-and-nodes '(elastic 2) '(elastic 3) '(elastic 8) '(steady 3) '(steady 5) '(steady 8) '(dynamic 2) '(dynamic 5)))
  (define model (car model-and-nodes))
  (define nodes (cadr model-and-nodes))
  (for-each
   (lambda (pull)
     (enter! (world (sea (depth 60)) (rov (named minnow) (at (first pull) 0 -1))
                    (tether (named line) (from -6 0 -1) (to minnow) (length 17) (wet-weight (second pull)) (nodes nodes)
                            (model ,model))))
     (expect (judge-tether (tether-answers 'line)) => #f))
   '((-6 -30000) (-6 -3) (-5 -3000) (3 -30000) (8 -3000))))

(define-scenario (it-goes-on-afloat model)
  "A still line stays on the water as its end is moved, also by turns of the current."
  #:for ((model 'elastic 'steady))
  (enter! (world (sea (depth 60) (current 0.2 90)) (rov (named minnow) (at 10 0 -5))
                 (tether (named line) (type fathom) (from 0 0 -1) (to minnow) (length 40) (model ,model))))
  (for-each (lambda (heading)
              (drive! #:surge 0.5 #:yaw 0.2)
              (current! 0.3 heading)
              (run 3)
              (expect (highest 300) is (below radius)))
            '(0 90 200 300)))

(define-scenario laid-afloat-it-stays
  "Laid on the water a moving line has no more than ripples to do: it does not fall into a ball."
  (for-each
   (lambda (k)
     (enter! (world (sea (depth 60) (current (between-random 0.05 0.4) (between-random 0 360)))
                    (rov (named minnow) (at 10 0 -5))
                    (tether (named line) (type fathom) (from 0 0 -1) (to minnow) (model dynamic)
                            (length (between-random 20 60)))))
     (let ((bend (tightest-bend)))
       (run 20)
       (expect (highest 300) is (below 0.1))
       (expect (tightest-bend) is (above (min 0.3 (* 0.5 bend))))))
   (iota 4)))
