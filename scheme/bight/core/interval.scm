;;; (bight core interval) --- confidence intervals of means and of differences of means.
;;;
;;; Student's distribution for one sample, and for the difference of two with unequal variances the degrees of
;;; freedom of Welch (Biometrika 34, 1947).
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(define-module (bight core interval)
  #:use-module (srfi srfi-1)
  #:export (t-quantile mean-of mean-interval difference-interval))

(define right-angle (acos 0))
(define most-freedom 2000)              ; beyond, Student's distribution is the normal one to three digits

(define (integral f a b)
  ;; Simpson's rule.
  (let* ((n 400) (h (/ (- b a) n)))
    (* (/ h 3)
       (fold (lambda (i sum)
               (+ sum (* (cond ((or (= i 0) (= i n)) 1) ((odd? i) 4) (else 2)) (f (+ a (* i h))))))
             0 (iota (+ n 1))))))

(define (t-quantile p freedom)
  "Return the quantile of P, from 0.5 to 1, of Student's distribution with FREEDOM degrees of freedom."
  ;; With t = sqrt(freedom) tan(phi) the density is that of cos(phi) to the power freedom - 1.
  (let* ((freedom (min freedom most-freedom))
         (density (lambda (phi) (expt (cos phi) (- freedom 1))))
         (wanted (* (- (* 2 p) 1) (integral density 0 (* right-angle (- 1 1e-12))))))
    (let search ((low 0.0) (high right-angle) (n 50))
      (let ((middle (/ (+ low high) 2)))
        (cond ((zero? n) (* (sqrt freedom) (tan middle)))
              ((< (integral density 0 middle) wanted) (search middle high (- n 1)))
              (else (search low middle (- n 1))))))))

(define (mean-of values)
  "Return the mean of VALUES."
  (exact->inexact (/ (apply + values) (length values))))

(define (variance-of values)
  (let ((m (mean-of values)))
    (/ (apply + (map (lambda (v) (* (- v m) (- v m))) values)) (- (length values) 1))))

(define (around middle half)
  (list middle (- middle half) (+ middle half)))

(define* (mean-interval values #:optional (confidence 0.95))
  "Return the list (MEAN LOW HIGH) of VALUES; with fewer than two, LOW and HIGH are #f."
  (if (< (length values) 2)
      (list (mean-of values) #f #f)
      (around (mean-of values)
              (* (t-quantile (/ (+ 1 confidence) 2) (- (length values) 1))
                 (sqrt (/ (variance-of values) (length values)))))))

(define* (difference-interval a b #:optional (confidence 0.95))
  "Return the list (DIFFERENCE LOW HIGH) of the means of A less B; with fewer than two of either, or none that
differ, LOW and HIGH are #f."
  (let ((difference (- (mean-of a) (mean-of b))))
    (if (or (< (length a) 2) (< (length b) 2))
        (list difference #f #f)
        (let* ((u (/ (variance-of a) (length a))) (v (/ (variance-of b) (length b)))
               (square (lambda (x) (* x x))))
          (if (zero? (+ u v))
              (list difference #f #f)
              (around difference
                      (* (t-quantile (/ (+ 1 confidence) 2)
                                     (/ (square (+ u v))
                                        (+ (/ (square u) (- (length a) 1)) (/ (square v) (- (length b) 1)))))
                         (sqrt (+ u v)))))))))
