;;; (bight core chart) --- values over time in plain characters.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(define-module (bight core chart)
  #:use-module (bight core decimal)
  #:use-module (srfi srfi-1)
  #:export (chart-lines))

(define (column-of time from to columns)
  (let ((i (inexact->exact (floor (* columns (/ (- time from) (max 1e-9 (- to from))))))))
    (max 0 (min (- columns 1) i))))

(define (binned samples from to columns)
  ;; The mean value in each of COLUMNS equal spans of time, or #f.
  (let ((sums (make-vector columns 0.0)) (counts (make-vector columns 0)))
    (for-each (lambda (s)
                (when (and (<= from (car s) to) (finite? (cdr s)))
                  (let ((i (column-of (car s) from to columns)))
                    (vector-set! sums i (+ (vector-ref sums i) (cdr s)))
                    (vector-set! counts i (+ 1 (vector-ref counts i))))))
              samples)
    (map (lambda (sum n) (and (positive? n) (/ sum n))) (vector->list sums) (vector->list counts))))

(define (row-of v bottom top rows)
  (let ((i (inexact->exact (round (* (- rows 1) (/ (- top v) (max 1e-12 (- top bottom))))))))
    (max 0 (min (- rows 1) i))))

(define (framed cells title from to top bottom)
  ;; The lines of CELLS, an array of characters, with TITLE above and what they range over beside and below.
  (let ((rows (first (array-dimensions cells))) (columns (second (array-dimensions cells))))
    (append
     (list (string-append " " title))
     (map (lambda (line i)
            (string-append
             (string-pad (cond ((= i 0) (figure top)) ((= i (- rows 1)) (figure bottom)) (else "")) 8)
             " |" (list->string line)))
          (array->list cells) (iota rows))
     (list (string-append (make-string 9 #\space) "+" (make-string columns #\-))
           (string-append (make-string 10 #\space)
                          (string-pad-right (string-append (figure from) " s") (- columns 8))
                          (string-pad (string-append (figure to) " s") 8))))))

(define (put-curve! cells mark values bottom top)
  (for-each (lambda (v c) (when v (array-set! cells mark (row-of v bottom top (first (array-dimensions cells))) c)))
            values (iota (length values))))

(define* (chart-lines title curves #:key (levels '()) from to at (columns 60) (rows 6))
  "Return the lines of a plot called TITLE of CURVES, a list of pairs of a character and of samples, pairs of time and
value; those before go over those behind.  LEVELS are values at which a dotted line stands.  Time goes FROM TO, else
as far as there are samples, over COLUMNS, with a line upright AT a time, if given.  Return () if there is nothing."
  (let* ((times (map car (append-map cdr curves)))
         (from (or from (and (pair? times) (apply min times)))) (to (or to (and (pair? times) (apply max times))))
         (values (map (lambda (curve) (if from (binned (cdr curve) from to columns) '())) curves))
         (shown (filter identity (concatenate values))))
    (if (null? shown)
        '()
        (let* ((levels (filter finite? levels)) (shown (append levels shown))
               (top (apply max shown)) (bottom (apply min shown)) (cells (make-array #\space rows columns)))
          (when at
            (for-each (lambda (i) (array-set! cells #\| i (column-of at from to columns))) (iota rows)))
          (for-each (lambda (v) (put-curve! cells #\. (make-list columns v) bottom top)) levels)
          (for-each (lambda (curve v) (put-curve! cells (car curve) v bottom top)) (reverse curves) (reverse values))
          (framed cells title from to top bottom)))))
