;;; (bight identify fit) --- least squares of measured runs, robust.
;;;
;;; Residuals are in units of their kind's own scale: places, tensions and forces each have one, re-estimated from
;;; the median of the residuals' sizes (a deviation is 1.4826 medians in a normal distribution).  A robust loss is
;;; minimised by iteratively reweighted least squares.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(define-module (bight identify fit)
  #:use-module (bight core errors)
  #:use-module (bight core record)
  #:use-module (bight identify covariance)
  #:use-module (bight identify entries)
  #:use-module (bight identify flight)
  #:use-module (bight identify solver)
  #:use-module (bight identify unknown)
  #:use-module (srfi srfi-1)
  #:use-module (srfi srfi-4)
  #:export (find-unknown
            fit? fit-x fit-covariance fit-scales fit-iterations fit-converged? fit-follow? fit-numbers))

(define-record <fit>
  (make-fit x covariance scales iterations converged? follow? numbers)
  fit?
  (x fit-x)                             ; f64vector
  (covariance fit-covariance)           ; of x: a vector of rows, vectors
  (scales fit-scales)                   ; alist from kind to the deviation of its residuals
  (iterations fit-iterations)
  (converged? fit-converged?)
  (follow? fit-follow?)                 ; do residuals follow their neighbours
  (numbers fit-numbers))                ; how many were fitted

(document
 (fit? "Return true if OBJECT is what `find-unknown' returned.")
 (fit-x "Return the coordinates that FIT found, an f64vector.")
 (fit-covariance "Return the covariance of the coordinates of FIT, a vector of vectors.")
 (fit-scales "Return the alist from kinds of numbers to the deviation of their residuals in FIT.")
 (fit-iterations "Return how many iterations FIT took.")
 (fit-converged? "Return true if FIT converged.")
 (fit-follow? "Return true if the residuals of FIT follow their neighbours: the line flown lacks something.")
 (fit-numbers "Return how many numbers were fitted in FIT."))


;;; Scales.

(define (kinds-of entries)
  (delete-duplicates (map first (delete-duplicates (vector->list (entries-channels entries))))))

(define (of-kind entries r kind)
  (filter-map (lambda (channel value) (and (eq? kind (first channel)) value))
              (vector->list (entries-channels entries)) (f64vector->list r)))

(define (scale-of loss numbers)
  (max 1e-9
       (if (eq? loss 'squares)
           (sqrt (/ (apply + (map (lambda (u) (* u u)) numbers)) (length numbers)))
           (* 1.4826 (median (map abs numbers))))))

(define (scales-of problem entries r)
  (map (lambda (kind) (cons kind (scale-of (problem-loss problem) (of-kind entries r kind)))) (kinds-of entries)))


;;; The fit.

(define (multipliers entries r scales loss)
  ;; By which each residual is multiplied: the root of its weight over its scale.
  (let* ((n (f64vector-length r)) (m (make-f64vector n)))
    (do ((i 0 (+ i 1))) ((= i n) m)
      (let ((scale (assq-ref scales (first (vector-ref (entries-channels entries) i)))))
        (f64vector-set! m i (/ (sqrt (weight-of loss (/ (f64vector-ref r i) scale))) scale))))))

(define (solve problem entries x m most)
  ;; (X ITERATIONS REASON) with the multipliers M kept.
  (let ((p (f64vector-length x)) (last-x #f) (last-r #f))
    (define (at x)
      (unless (equal? x last-x)
        (set! last-r (residuals problem entries (fly-runs problem x)))
        (set! last-x x))
      last-r)
    (%least-squares (lambda (x) (times-rows m (at x) 1))
                    (lambda (x) (times-rows m (derivatives problem entries x (at x)) p))
                    x (entry-count entries) most)))

(define (costs problem entries xs scales)
  ;; What the search for a beginning compares, at each of XS: all are flown at once.
  (let* ((runs (length (problem-runs problem)))
         (flown (fly-all (append-map (lambda (x) (flights-of problem x)) xs)))
         (m (lambda (r) (multipliers entries r scales 'squares))))
    (map (lambda (k)
           (let ((r (residuals problem entries (take (drop flown (* k runs)) runs))))
             (apply + (map (lambda (u) (if (eq? 'squares (problem-loss problem)) (* u u) (log (+ 1 (* u u)))))
                           (f64vector->list (times-rows (m r) r 1))))))
         (iota (length xs)))))

(define wide '(ei bending-damping gj ei-stuck ba ea)) ; whose size may be unknown by orders of magnitude

(define tries '(0 -2 -1 -1/2 1/2 1 2))  ; powers of ten

(define (spread-out x k)
  ;; X, and X with its element K moved by powers of ten.
  (map (lambda (by) (moved x k (* by (log 10)))) tries))

(define (least-of costs xs)
  (cdr (fold (lambda (a b) (if (< (car a) (car b)) a b)) (cons (car costs) (car xs)) (map cons (cdr costs) (cdr xs)))))

(define (scan problem entries x)
  ;; Of the coordinates whose size may be anything the best of powers of ten: of two at a time, since one makes up for
  ;; much that is wrong with another.
  (let ((scales (scales-of problem entries (residuals problem entries (fly-runs problem x)))))
    (let loop ((those (filter (lambda (k) (memq (coordinate-what (list-ref (problem-coordinates problem) k)) wide))
                              (iota (f64vector-length x))))
               (x x))
      (if (null? those)
          x
          (let* ((one (spread-out x (car those)))
                 (xs (if (null? (cdr those))
                         one
                         (append-map (lambda (x) (spread-out x (cadr those))) one))))
            (loop (if (null? (cdr those)) '() (cddr those))
                  (least-of (costs problem entries xs scales) xs)))))))

(define most-rounds 6)
(define most-iterations 30)

(define (moved-by a b)
  (apply max (map (lambda (a b) (abs (- a b))) (f64vector->list a) (f64vector->list b))))

(define (find-unknown problem)
  "Return the fit of PROBLEM.  Raise a &bight-error of kind domain if fewer numbers were measured than tell its
unknowns, of kind diverged if its line cannot be led as it begins."
  (let* ((entries (entries-of problem)) (p (length (problem-coordinates problem))) (x (make-f64vector p 0.)))
    (when (< (entry-count entries) (* 5 p))
      (bight-raise 'domain 'identify "~a numbers were measured in the rows to be fitted, too few for ~a unknowns: ~a \
are the fewest" (entry-count entries) p (* 5 p)))
    (let ((failed (find flight-failed? (fly-runs problem x))))
      (when failed (bight-raise 'diverged 'identify "the line cannot be led as it begins: ~a" failed)))
    (let loop ((x (scan problem entries x)) (round 1) (iterations 0))
      (let* ((r (residuals problem entries (fly-runs problem x)))
             (scales (scales-of problem entries r))
             (solved (solve problem entries x (multipliers entries r scales (problem-loss problem)) most-iterations))
             (found (first solved)) (iterations (+ iterations (second solved))))
        (if (and (< round most-rounds) (> (moved-by x found) 1e-3))
            (loop found (+ round 1) iterations)
            (conclude problem entries found iterations (not (zero? (third solved)))))))))


(define (conclude problem entries x iterations converged?)
  (let* ((p (f64vector-length x))
         (r (residuals problem entries (fly-runs problem x)))
         (scales (scales-of problem entries r))
         (m (multipliers entries r scales 'squares)))
    (call-with-values
        (lambda ()
          (covariance-of entries (problem-loss problem) (times-rows m r 1)
                         (times-rows m (derivatives problem entries x r) p) p))
      (lambda (covariance follow?)
        (make-fit x covariance scales iterations converged? follow? (entry-count entries))))))
