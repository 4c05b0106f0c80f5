;;; (bight identify covariance) --- robust losses, and how sure is what was fitted by one.
;;;
;;; Tuning constants of the losses are for 95 % efficiency where deviations are normal (P. W. Holland and R. E. Welsch,
;;; Communications in Statistics A6, 1977).  The covariance is that of an M-estimator (P. J. Huber, Robust Statistics,
;;; 1981, section 7.6).  Where residuals follow their neighbours in time or along the line, more than chance makes them,
;;; the covariance is made of the sums of each row instead, with those of later rows by Bartlett's kernel (W. K. Newey
;;; and K. D. West, Econometrica 55, 1987), as wide as D. W. K. Andrews has it (Econometrica 59, 1991).
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(define-module (bight identify covariance)
  #:use-module (bight identify entries)
  #:use-module (bight identify solver)
  #:use-module (srfi srfi-1)
  #:use-module (srfi srfi-4)
  #:export (weight-of covariance-of))

;;; Losses.

(define (weight-of loss u)
  "Return the weight by LOSS of a residual U, in deviations: psi (u) / u."
  (let ((a (abs u)))
    (case loss
      ((huber) (if (<= a 1.345) 1. (/ 1.345 a)))
      ((cauchy) (/ 1. (+ 1. (expt (/ a 2.385) 2))))
      (else 1.))))

(define (steepness loss u)
  ;; psi' (u)
  (let ((a (abs u)))
    (case loss
      ((huber) (if (<= a 1.345) 1. 0.))
      ((cauchy) (let ((q (expt (/ a 2.385) 2))) (/ (- 1. q) (expt (+ 1. q) 2))))
      (else 1.))))


;;; Covariance.

(define (row-key entries i)
  (cons (second (vector-ref (entries-channels entries) i)) (vector-ref (entries-rows entries) i)))

(define (scores-by-row entries loss u jacobian p)
  ;; A table from (RUN . ROW) to the sums over the numbers of the row of psi times each derivative.
  (let ((table (make-hash-table)))
    (do ((i 0 (+ i 1))) ((= i (f64vector-length u)) table)
      (let* ((key (row-key entries i)) (value (f64vector-ref u i)) (psi (* value (weight-of loss value)))
             (sums (or (hash-ref table key)
                       (let ((new (make-f64vector p 0.))) (hash-set! table key new) new))))
        (do ((k 0 (+ k 1))) ((= k p))
          (f64vector-set! sums k (+ (f64vector-ref sums k) (* psi (f64vector-ref jacobian (+ k (* i p)))))))))))

(define (products a b p)
  (list->f64vector
   (append-map (lambda (j) (map (lambda (k) (* (f64vector-ref a j) (f64vector-ref b k))) (iota p))) (iota p))))

(define (add! sum more factor)
  (do ((i 0 (+ i 1))) ((= i (f64vector-length sum)) sum)
    (f64vector-set! sum i (+ (f64vector-ref sum i) (* factor (f64vector-ref more i))))))

(define (bandwidth r rows)
  ;; Of Bartlett's kernel, for numbers of the correlation R from row to row.
  (let ((alpha (/ (* 4 r r) (expt (* (- 1 r) (+ 1 r)) 2))))
    (min (quotient rows 3) (inexact->exact (ceiling (* 1.1447 (expt (* alpha rows) 1/3)))))))

(define (spread table r p)
  ;; The variance of the sum of the scores in TABLE, which follow one another with the correlation R.
  (let* ((keys (hash-map->list (lambda (key sums) key) table)) (lags (bandwidth r (length keys)))
         (sum (make-f64vector (* p p) 0.)))
    (for-each
     (lambda (key)
       (let ((here (hash-ref table key)))
         (add! sum (products here here p) 1.)
         (for-each (lambda (lag)
                     (let ((there (hash-ref table (cons (car key) (+ lag (cdr key))))))
                       (when there
                         (let ((factor (- 1. (/ lag (+ 1. lags)))))
                           (add! sum (products here there p) factor)
                           (add! sum (products there here p) factor)))))
                   (iota lags 1))))
     keys)
    sum))

(define (correlation-of pairs total n)
  ;; Of PAIRS (A . B) of numbers, 0 unless chance hardly explains it.
  (let ((r (if (or (null? pairs) (<= total 0))
               0.
               (/ (* n (apply + (map (lambda (pair) (* (car pair) (cdr pair))) pairs))) (* (length pairs) total)))))
    (if (< r (/ 2.5 (sqrt (max 1 (length pairs))))) 0. (min r .99))))

(define (in-time entries u)
  (filter-map (lambda (i)
                (and (not (vector-ref (entries-starts entries) i))
                     (cons (f64vector-ref u (- i 1)) (f64vector-ref u i))))
              (iota (- (f64vector-length u) 1) 1)))

(define (along entries u)
  ;; Of neighbouring markers, in one axis and row.
  (let ((table (make-hash-table)))
    (define (key i by)
      (let ((c (vector-ref (entries-channels entries) i)))
        (list (first c) (second c) (+ by (third c)) (fourth c) (vector-ref (entries-rows entries) i))))
    (for-each (lambda (i) (hash-set! table (key i 0) i)) (iota (f64vector-length u)))
    (filter-map (lambda (i)
                  (let ((next (hash-ref table (key i 1))))
                    (and next (cons (f64vector-ref u i) (f64vector-ref u next)))))
                (iota (f64vector-length u)))))

(define (correlations-of entries u)
  ;; Of the residuals U from row to row, and from marker to marker.
  (let ((total (apply + (map (lambda (u) (* u u)) (f64vector->list u)))))
    (map (lambda (pairs) (correlation-of pairs total (f64vector-length u)))
         (list (in-time entries u) (along entries u)))))

(define (normal-matrix jacobian weights p)
  ;; The products of the derivatives, each row of them weighted, a p x p f64vector.
  (let ((a (make-f64vector (* p p) 0.)))
    (do ((i 0 (+ i 1))) ((= i (vector-length weights)) a)
      (do ((j 0 (+ j 1))) ((= j p))
        (do ((k 0 (+ k 1))) ((= k p))
          (let ((at (+ k (* j p))))
            (f64vector-set! a at (+ (f64vector-ref a at)
                                    (* (vector-ref weights i) (f64vector-ref jacobian (+ j (* i p)))
                                       (f64vector-ref jacobian (+ k (* i p))))))))))))

(define (inverse a p)
  ;; Of the symmetric A, an f64vector: what the data say nothing of has a variance that is huge, not infinite.
  (let* ((found (%eigen a p)) (values (car found)) (vectors (cdr found))
         (least (* 1e-12 (max 1e-300 (f64vector-ref values 0))))
         (at (lambda (i k) (f64vector-ref vectors (+ k (* i p))))))
    (list->f64vector
     (append-map (lambda (j)
                   (map (lambda (k)
                          (apply + (map (lambda (i) (/ (* (at i j) (at i k)) (max least (f64vector-ref values i))))
                                        (iota p))))
                        (iota p)))
                 (iota p)))))

(define (product a b p)
  (list->f64vector
   (append-map (lambda (j)
                 (map (lambda (k)
                        (apply + (map (lambda (i) (* (f64vector-ref a (+ i (* j p))) (f64vector-ref b (+ k (* i p)))))
                                      (iota p))))
                      (iota p)))
               (iota p))))

(define (rows-of-matrix a p factor)
  (list->vector (map (lambda (j) (list->vector (map (lambda (k) (* factor (f64vector-ref a (+ k (* j p))))) (iota p))))
                     (iota p))))

(define (covariance-of entries loss u jacobian p)
  "Return two values for the residuals U of ENTRIES, in deviations, and their derivatives by P coordinates: the
covariance of these, a vector of vectors, and whether the residuals follow their neighbours."
  (let* ((n (f64vector-length u)) (all (f64vector->list u))
         (steep (max .05 (/ (apply + (map (lambda (u) (steepness loss u)) all)) n)))
         (bread (inverse (normal-matrix jacobian (make-vector n 1.) p) p))
         (r (correlations-of entries u)))
    (if (every zero? r)
        (let ((psi (apply + (map (lambda (u) (expt (* u (weight-of loss u)) 2)) all))))
          (values (rows-of-matrix bread p (/ psi (- n p) (expt steep 2))) #f))
        (let ((table (scores-by-row entries loss u jacobian p)))
          (values (rows-of-matrix (product bread (product (spread table (first r) p) bread p) p) p
                                  (/ (expt steep -2) (- 1. (/ p (max (+ p 1) (hash-count (const #t) table))))))
                  #t)))))
