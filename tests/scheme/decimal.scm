;;; Numbers with so many decimals, against exact arithmetic.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(use-modules (bight core decimal)
             (srfi srfi-1))

(define-scenario decimals-are-those-of-the-number
  "What is read back lies within half a unit of the last place, has so many places, and no sign where it is 0."
  (in open-water)
  (for-each
   (lambda (x)
     (for-each
      (lambda (places)
        (let* ((text (fixed x places)) (back (string->number (string-append "#e" text))))
          (expect (<= (abs (- back (inexact->exact x))) (/ 1 2 (expt 10 places))) => #t)
          (expect (- (string-length text) (or (string-index text #\.) (- (string-length text) 1)) 1) => places)
          (expect (and (zero? back) (string-prefix? "-" text)) => #f)
          (expect (string->number (string-append "#e" (fixed-with-sign x places))) => back)
          (expect (string-ref (fixed-with-sign x places) 0) => (if (negative? back) #\- #\+))))
      '(0 1 2 5)))
   '(0 0.0 -0.0 7 -7 1/3 -2/3 0.05 -0.05 0.125 -0.004 9.995 -99.999 1.005 123456789.987 1e15 -1e-9))
  (expect (map (lambda (x) (fixed x 1)) '(-0.04 -0.06 0.96 12)) => '("0.0" "-0.1" "1.0" "12.0")))
