;;; (bight core quaternion) --- turns in space as unit quaternions, lists (X Y Z W), and frames carried along a line.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(define-module (bight core quaternion)
  #:use-module (srfi srfi-1)
  #:export (turn-about-z rotated inverse-matrix turns-along))

(define (dot a b) (apply + (map * a b)))

(define (cross a b)
  (let ((part (lambda (i j) (- (* (list-ref a i) (list-ref b j)) (* (list-ref a j) (list-ref b i))))))
    (list (part 1 2) (part 2 0) (part 0 1))))

(define (unit a otherwise)
  ;; A made one long, or OTHERWISE where it has no length.
  (let ((n (sqrt (dot a a))))
    (if (> n 1e-9) (map (lambda (x) (/ x n)) a) otherwise)))

(define (product p q)
  ;; The turn Q, then P.
  (let ((u (take p 3)) (v (take q 3)) (a (fourth p)) (b (fourth q)))
    (append (map (lambda (x y z) (+ (* a y) (* b x) z)) u v (cross u v))
            (list (- (* a b) (dot u v))))))

(define (turn-about-z angle)
  "Return the turn by ANGLE, radians, about z, from x to y."
  (list 0 0 (sin (/ angle 2)) (cos (/ angle 2))))

(define (rotated q v)
  "Return the vector V, a list, turned by Q."
  (take (product (product q (append v '(0))) (append (map - (take q 3)) (list (fourth q)))) 3))

(define (inverse-matrix place q)
  "Return the 16 numbers, by columns, of what takes points to the frame that Q turns and PLACE moves."
  (let* ((axes (map (lambda (axis) (rotated q axis)) '((1 0 0) (0 1 0) (0 0 1)))))
    (append (append-map (lambda (i) (append (map (lambda (axis) (list-ref axis i)) axes) '(0))) (iota 3))
            (map (lambda (axis) (- (dot axis place))) axes) '(1))))

(define (least-turn a b)
  ;; The least turn from the direction A to the direction B.
  (let ((w (+ 1 (dot a b))))
    (if (> w 1e-9)
        (unit (append (cross a b) (list w)) '(0 0 0 1))
        (append (unit (cross a '(1 0 0)) '(0 1 0)) '(0)))))

(define (tangents points)
  ;; A direction at each of POINTS; at equal points that before, at first up.
  (let* ((ahead (append (cdr points) (list (last points)))) (behind (cons (car points) points)))
    (reverse (fold (lambda (a b found) (cons (unit (map - a b) (if (null? found) '(0 0 1) (car found))) found))
                   '() ahead (take behind (length points))))))

(define (near q before)
  ;; Q or -Q, the same turn: the one from which BEFORE is not far.
  (if (negative? (dot q before)) (map - q) q))

(define (carried directions first)
  ;; A turn for each of DIRECTIONS, FIRST carried from each to the next without twist.
  (reverse (cdr (fold (lambda (to state)
                        (cons to (cons (unit (product (least-turn (car state) to) (cadr state)) (cadr state))
                                       (cdr state))))
                      (list (car directions) first) (cdr directions)))))

(define (turns-along moments)
  "Return, for each of MOMENTS, lists of points along a line, a turn for each point: z goes to the direction there.
They are carried along the line, and at its beginning through time, so that nothing twists."
  (let ((start (tangents (car moments))))
    (let loop ((rest moments) (direction (car start)) (turn (least-turn '(0 0 1) (car start))) (before #f) (found '()))
      (if (null? rest)
          (reverse found)
          (let* ((directions (tangents (car rest)))
                 (first (product (least-turn direction (car directions)) turn))
                 (turns (carried directions first))
                 (same (if before (map near turns before) turns)))
            (loop (cdr rest) (car directions) first same (cons same found)))))))
