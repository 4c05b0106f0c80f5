;;; (bight core decimal) --- numbers with so many decimals, as people read them, and numbers out of text.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(define-module (bight core decimal)
  #:export (fixed fixed-with-sign figure written-figure text->number))

(define (fixed x places)
  "Return the finite number X with PLACES decimals, a string; what rounds to 0 has no sign."
  (let* ((n (round (* (abs (inexact->exact x)) (expt 10 places))))
         (digits (digits-of n (+ 1 places)))
         (point (- (string-length digits) places)))
    (string-append (if (and (negative? x) (positive? n)) "-" "")
                   (substring digits 0 point)
                   (if (zero? places) "" ".")
                   (substring digits point))))

(define (digits-of n least)
  ;; Those of the whole number N, with zeros before them where there are fewer than LEAST.
  (let ((digits (number->string n)))
    (string-pad digits (max least (string-length digits)) #\0)))

(define (fixed-with-sign x places)
  "Return X as `fixed' does, with + before what is not negative."
  (let ((text (fixed x places)))
    (if (string-prefix? "-" text) text (string-append "+" text))))

(define (figure x)
  "Return the number X as a person reads it, a string."
  (cond ((not (real? x)) "none")
        ((not (finite? x)) (if (nan? x) "none" "any"))
        (else (fixed x (cond ((>= (abs x) 100) 0) ((>= (abs x) 10) 1) (else 2))))))

(define (written-figure x)
  "Return the number X as one writes it, a string: 60, and not 60.0; at most four places."
  (string-trim-right (string-trim-right (fixed x 4) #\0) #\.))

(define* (text->number text #:optional (radix 10))
  "Return the number that the string TEXT spells with RADIX, or #f: also for one such as 1e9999, at which Guile's
`string->number' raises."
  (false-if-exception (string->number text radix)))
