;;; (bight lesson way) --- the way flown in each task, for those who are to come back by it.
;;;
;;; The place of the vehicle is noted twice a second, in the tally, so that a step back takes it back.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(define-module (bight lesson way)
  #:use-module (bight core errors)
  #:use-module (bight core verb)
  #:use-module (bight dive query)
  #:use-module (bight lesson tally)
  #:use-module (srfi srfi-1)
  #:use-module (srfi srfi-4)
  #:export (note-way! way-flown off-the-way))

(define (this-task) (tally-ref 'tasks 0))

(define (points-of n)
  ;; The points of the way flown in task N, the last first.
  (or (assv-ref (tally-ref 'ways '()) n) '()))

(define (note-way!)
  "Note where the vehicle is in the task that is going on."
  (let ((n (this-task)))
    (tally-set! 'ways (acons n (cons (rov-position) (points-of n))
                             (alist-delete n (tally-ref 'ways '()) eqv?)))))

(define-argument-type (task-number value)
  "the number of a task, 1 or more"
  (if (and (exact-integer? value) (positive? value)) value refused))

(define-verb (way-flown (n task-number))
  "Return the way that the vehicle took in task N of the lesson: a list of points, half a second apart."
  (reverse (points-of n)))

(define (minus a b) (map - (f64vector->list a) (f64vector->list b)))
(define (dot u v) (apply + (map * u v)))

(define (distance-to-leg p a b)
  ;; From the point P to the segment from A to B, m.
  (let* ((leg (minus b a)) (to (minus p a)) (square (dot leg leg))
         (s (if (zero? square) 0 (max 0 (min 1 (/ (dot to leg) square)))))
         (off (map (lambda (t l) (- t (* s l))) to leg)))
    (sqrt (dot off off))))

(define-verb (off-the-way (n task-number))
  "Return how far the vehicle is from the way it took in task N, m: for the way back.  Raise a &bight-error
while that task is going on, or when it was not flown."
  (let ((way (points-of n)) (p (rov-position)))
    (when (or (null? way) (>= n (this-task)))
      (bight-raise 'domain 'off-the-way "task ~a is not done, so no way was flown in it yet" n))
    (fold (lambda (a b least) (min least (distance-to-leg p a b)))
          (distance-to-leg p (car way) (car way))
          way (if (null? (cdr way)) way (cdr way)))))
