;;; (bight identify lean) --- places in a frame whose third axis is not quite upright.
;;;
;;; Cameras tell places in a frame of their own.  A LEAN is #f for an upright frame, else a list (X Y Z): the unit
;;; vector that points up, in the frame of the cameras.  The shortest rotation that takes it to (0 0 1) takes places
;;; of the cameras' frame to an upright one (Rodrigues).
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(define-module (bight identify lean)
  #:use-module (srfi srfi-1)
  #:use-module (srfi srfi-4)
  #:export (make-lean upright leaning))

(define (make-lean east north)
  "Return the lean of a frame in which up is EAST and NORTH radians beside the third axis."
  (and (not (and (zero? east) (zero? north)))
       (let* ((x (tan east)) (y (tan north)) (long (sqrt (+ 1 (* x x) (* y y)))))
         (list (/ x long) (/ y long) (/ 1 long)))))

(define (turn vectors ux uy uz)
  ;; VECTORS, an f64vector of x y z one behind the other, by the rotation that takes U to (0 0 1).
  (let ((all (make-f64vector (f64vector-length vectors))) (share (/ 1 (+ 1 uz))))
    (do ((k 0 (+ k 3))) ((>= k (f64vector-length vectors)) all)
      (let* ((x (f64vector-ref vectors k)) (y (f64vector-ref vectors (+ k 1))) (z (f64vector-ref vectors (+ k 2)))
             (across (+ (* ux x) (* uy y))))
        (f64vector-set! all k (- x (* ux z) (* share ux across)))
        (f64vector-set! all (+ k 1) (- y (* uy z) (* share uy across)))
        (f64vector-set! all (+ k 2) (+ across (* uz z)))))))

(define (upright vectors lean)
  "Return VECTORS of a frame that leans by LEAN, an f64vector of x y z one behind the other, or #f, in an upright frame."
  (if (and vectors lean) (apply turn vectors lean) vectors))

(define (leaning vectors lean)
  "Return VECTORS of an upright frame in the frame that leans by LEAN: the opposite of `upright'."
  (if (and vectors lean)
      (turn vectors (- (first lean)) (- (second lean)) (third lean))
      vectors))
