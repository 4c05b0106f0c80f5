;;; (bight world bed) --- where the sea bed of a dive is, and whether the dive is there too.
;;;
;;; A grid in map coordinates loads like any other.  Its bed is then far from a dive about the origin, which
;;; nobody sees before something falls past where it should be.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(define-module (bight world bed)
  #:use-module (bight engine)
  #:use-module (srfi srfi-1)
  #:use-module (srfi srfi-4)
  #:export (bed-number over-bed? beside-bed))

(define (bed-number engine)
  "Return the number of the seabed among the obstacles of the dive ENGINE, or #f."
  (find (lambda (i) (eq? 'seabed (assq-ref (%obstacle engine i) 'head)))
        (iota (length (%names engine 'obstacle)))))

(define (corners engine)
  ;; The lowest and the highest corner of the bed's box, a pair; #f if it has no edge, or is none.
  (let* ((bed (bed-number engine))
         (all (and bed (%obstacle engine bed))))
    (and bed (positive? (assq-ref all 'triangles))
         (cons (assq-ref all 'low) (assq-ref all 'high)))))

(define (between-corners? box p)
  (every (lambda (k)
           (<= (f64vector-ref (car box) k) (f64vector-ref p k) (f64vector-ref (cdr box) k)))
         '(0 1)))

(define (over-bed? engine p)
  "Return #t unless the bed has an edge and the point P is beyond it."
  (let ((box (corners engine)))
    (or (not box) (between-corners? box p))))

(define (places engine)
  ;; Those of all vehicles and anchors.
  (append (map (lambda (i) (assq-ref (%vehicle engine i) 'position))
               (iota (length (%names engine 'rov))))
          (map (lambda (i) (%point-at engine i 0))
               (iota (length (%names engine 'tether))))))

(define (metres x)
  (/ (round (* 10 x)) 10))

(define (span->string box k)
  (simple-format #f "~a to ~a" (metres (f64vector-ref (car box) k)) (metres (f64vector-ref (cdr box) k))))

(define (side box k)
  (- (f64vector-ref (cdr box) k) (f64vector-ref (car box) k)))

(define (beside-bed engine)
  "Return what to say if no vehicle and no anchor of the dive ENGINE is over its bed, else #f."
  (let ((box (corners engine)))
    (and box
         (not (any (lambda (p) (between-corners? box p)) (places engine)))
         (simple-format #f "no vehicle and no anchor is over the bed: it spans x ~a m, y ~a m~a; `at' of the part `seabed' puts its origin elsewhere"
                        (span->string box 0) (span->string box 1)
                        (if (< (max (side box 0) (side box 1)) 10)
                            ", which is so little that its numbers may be degrees"
                            "")))))
