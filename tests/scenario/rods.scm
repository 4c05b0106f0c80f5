;;; A tether of model `auto' hauled round a rod, as law/law_contact_rod.c has it of a line of links chosen by hand: the
;;; tensions on both sides of the rod have the ratio e^(mu theta), hauled, at rest and let back.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(use-modules (srfi srfi-1) ((bight assembly) #:select (data->part)))

(define pi (acos -1))
(define leg 12)                         ; m
(define pull 100)                       ; N
(define near 0.02)                      ; of the exact ratio

(define (parts->world parts)
  (world (splice parts)))

(define (radians degrees)
  (* degrees (/ pi 180)))

(define (about-rod out angle)
  "The point OUT m from the axis of the rod, at ANGLE up from the axis x."
  (list (* out (cos angle)) 0 (- (* out (sin angle)) 20)))

(define (away degrees)
  "The direction of the line that has turned by DEGREES, first upwards."
  (let ((turned (radians degrees)))
    (list (sin turned) 0 (cos turned))))

(define (along from direction metres)
  (map (lambda (x d) (+ x (* metres d))) from direction))

(define (round-a-rod radius degrees nodes mu)
  ;; Laid a foot off the rod; the vehicle pulls on one side, the winch hauls on the other.
  (let* ((out (+ radius 0.005)) (end (- pi (radians degrees)))
         (way (map (lambda (k) (about-rod (+ radius 0.3) (- pi (* (radians degrees) (/ k 4))))) (iota 5))))
    (parts->world
     (list (part sea (depth 60))
           (part cylinder (named rod) (from 0 -3 -20) (to 0 3 -20) (radius radius) (friction mu))
           (data->part `(rov (named minnow) (at ,@(along (about-rod out end) (away degrees) leg)) (pull ,pull)
                             (heave-speed 2)))
           (data->part `(tether (named line) (type fathom) (wet-weight 0) (model auto) (nodes ,nodes)
                                (from ,@(along (about-rod out pi) '(0 0 -1) leg)) (to minnow) (via ,@way)
                                (length ,(+ leg leg 3 (* radius (radians degrees)))) (drum 60)))))))

(define (ratio)
  "The tension on the winch's side of the rod over that on the vehicle's."
  (/ (tension-at 4) (tension-at (- (tether-length) 4))))

(define (ratios seconds)
  (map (lambda (k) (run 0.2) (ratio)) (iota (* 5 seconds))))

(define-scenario (hauled-round-a-rod radius degrees nodes mu)
  "No node of an adaptive line catches at a rod: tensions have the ratio of Euler and Eytelwein out and home."
  #:for ((radius 0.001 0.003 0.01 0.03 0.1) (degrees 90 180) (nodes 32 128) (mu 0 0.3))
  (define exact (exp (* mu (radians degrees))))
  (define (close-to ratio found)
    (for-each (lambda (r) (expect r is (about ratio #:within (* near ratio)))) found))
  (in (round-a-rod radius degrees nodes mu))
  (move! (along (array->list (rov-position)) (away degrees) 30) #:speed 0.5)
  (run 10)
  (haul-in! 2 #:rate 0.15)
  (run 6)
  (close-to exact (ratios 5))
  (run 5)
  (when (zero? mu)
    (close-to 1 (ratios 1)))
  (pay-out! 2 #:rate 0.15)
  (run 5)
  (close-to (/ exact) (ratios 5)))
