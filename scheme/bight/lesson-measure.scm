;;; (bight lesson-measure) --- how often, and which way, a tether goes round an obstacle.
;;;
;;; The angle that the tether's points sweep round the axis of an obstacle, summed from point to point:
;;; clockwise, looking along the axis from its `from' to its `to', is positive; what has no axis uses its
;;; vertical, looking down.  With the straight chord back to the anchor the sum is a whole number of
;;; turns.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(define-module (bight lesson-measure)
  #:use-module (bight dive)
  #:use-module (bight errors)
  #:use-module (bight query)
  #:use-module (bight units)
  #:use-module (bight verb)
  #:export (turns winding))

(define full-turn (* 2 (acos -1)))

(define (axis-of proc object)
  ;; A point of the axis of OBJECT and its direction, two vectors.
  (call-with-values (lambda () (find-part proc object))
    (lambda (kind index)
      (unless (eq? kind 'obstacle)
        (bight-raise 'name proc "a tether winds about an obstacle, not about the ~a ~a" kind object))
      (let* ((about (obstacle-properties proc index))
             (ends (assq-ref about 'axis))
             (way (vec- (cadr ends) (car ends))))
        (if (zero? (norm way))
            (values (assq-ref about 'centre) (vec 0 0 -1))
            (values (car ends) (vec* (/ (norm way)) way)))))))

(define (across way)
  ;; A unit vector at a right angle to WAY.
  (let* ((x-ward (< (abs (x way)) 0.9))
         (start (if x-ward (vec 1 0 0) (vec 0 1 0)))
         (off (vec- start (vec* (dot start way) way))))
    (vec* (/ (norm off)) off)))

(define (dot a b)
  (+ (* (x a) (x b)) (* (y a) (y b)) (* (z a) (z b))))

(define (cross a b)
  (vec (- (* (y a) (z b)) (* (z a) (y b)))
       (- (* (z a) (x b)) (* (x a) (z b)))
       (- (* (x a) (y b)) (* (y a) (x b)))))

(define (angles points origin way)
  ;; The angle of each of POINTS round the axis, clockwise seen along WAY.
  (let* ((u (across way)) (v (cross way u)))
    (map (lambda (p)
           (let ((r (vec- p origin)))
             (atan (dot r v) (dot r u))))
         points)))

(define (swept angles)
  ;; The sum of the steps between ANGLES, each taken the short way, in turns.
  (let loop ((rest (cdr angles)) (before (car angles)) (sum 0))
    (if (null? rest)
        (/ sum full-turn)
        (let* ((d (- (car rest) before))
               (short (- d (* full-turn (round (/ d full-turn))))))
          (loop (cdr rest) (car rest) (+ sum short))))))

(define (line-points t)
  (map (lambda (row) (apply vec row)) (array->list (%points t))))

(define (%points t)
  (tether-points (list-ref (tether-names) t)))

(define (tether-names)
  (filter (lambda (name)
            (call-with-values (lambda () (find-part 'turns name))
              (lambda (kind index) (eq? kind 'tether))))
          (parts)))

(define (angles-round proc t object)
  (call-with-values (lambda () (axis-of proc object))
    (lambda (origin way) (angles (line-points t) origin way))))

(define-verb (turns #:subject (t tether) (object name))
  "Return by how many turns the tether goes round OBJECT from its anchor to the vehicle, clockwise
positive, looking along the object's axis (down, for a pile)."
  (swept (angles-round 'turns t object)))

(define-verb (winding #:subject (t tether) (object name))
  "Return how often the tether, closed by the straight chord back to its anchor, winds about OBJECT, a whole
number, clockwise positive; 0 for a line that merely passes."
  (let ((all (angles-round 'winding t object)))
    (inexact->exact (round (swept (append all (list (car all))))))))
