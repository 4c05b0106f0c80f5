;;; (bight core units) --- conversion to SI, and points.
;;;
;;; A point goes in as a list, a vector or an f64vector of three numbers, and comes out as a fresh
;;; f64vector #f64(x y z): metres east, north and up.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(define-module (bight core units)
  #:use-module (bight core verb)
  #:use-module (srfi srfi-4)
  #:export (knots inches feet hours minutes
            vec x y z distance vec+ vec- vec* norm))


;;; Units.

(define-verb (knots (speed number))
  "Return SPEED knots in metres a second."
  (* speed (/ 1852.0 3600.0)))

(define-verb (inches (length number))
  "Return LENGTH inches in metres."
  (* length 0.0254))

(define-verb (feet (length number))
  "Return LENGTH feet in metres."
  (* length 0.3048))

(define-verb (hours (time number))
  "Return TIME hours in seconds."
  (* time 3600.0))

(define-verb (minutes (time number))
  "Return TIME minutes in seconds."
  (* time 60.0))


;;; Points.

(define-syntax-rule (component p i)
  (f64vector-ref p i))

(define-syntax-rule (by-component (p ...) expression)
  ;; The point of which each component is EXPRESSION with the same component of every P for P.
  (let ((at (lambda (i) (let ((p (component p i)) ...) expression))))
    (f64vector (at 0) (at 1) (at 2))))

(define-verb (vec (east (between -1e7 1e7)) (north (between -1e7 1e7)) (up (between -1e7 1e7)))
  "Return the point EAST, NORTH and UP metres from the origin, an f64vector."
  (f64vector east north up))

(define-verb (x (p point))
  "Return how far east the point P lies, in metres."
  (component p 0))

(define-verb (y (p point))
  "Return how far north the point P lies, in metres."
  (component p 1))

(define-verb (z (p point))
  "Return the height of the point P above the sea surface in metres; negative under water."
  (component p 2))

(define (length-of p)
  ;; Scaled by hand: no coordinate exceeds 1e7 by much, so nothing overflows.
  (sqrt (+ (* (component p 0) (component p 0))
           (* (component p 1) (component p 1))
           (* (component p 2) (component p 2)))))

(define-verb (norm (v point))
  "Return the length of the vector V, in its own unit."
  (length-of v))

(define-verb (distance (a point) (b point))
  "Return the distance between the points A and B in metres."
  (length-of (by-component (a b) (- a b))))

(define (sum points)
  (let loop ((total (f64vector 0.0 0.0 0.0)) (rest points))
    (if (null? rest)
        total
        (let ((p (car rest)))
          (loop (by-component (total p) (+ total p)) (cdr rest))))))

(define-verb (vec+ #:rest (points point))
  "Return the sum of POINTS."
  (sum points))

(define-verb (vec- (v point) #:rest (others point))
  "Return V less the sum of OTHERS; V alone, turned round."
  (let ((o (sum others)))
    (if (null? others)
        (by-component (v) (- 0.0 v))
        (by-component (v o) (- v o)))))

(define-argument-type (scale-or-point value)
  "a number and a point, in either order"
  (if (accepts? type:number value)
      (exact->inexact value)
      (if (accepts? type:point value) (check-argument 'vec* 'v type:point value) refused)))

(define-verb (vec* (factor scale-or-point) (v scale-or-point))
  "Return the vector V times the number FACTOR; either may come first."
  (let ((scale (if (real? factor) factor v))
        (p (if (real? factor) v factor)))
    (let ((scale (check-argument 'vec* 'factor type:number scale))
          (p (check-argument 'vec* 'v type:point p)))
      (by-component (p) (* scale p)))))
