;;; Does this Guile compile rightly what a loop reads of a thing that may be missing?
;;;
;;; usage: guild compile -O2 -o LOOPS.go guarded-loops.scm, then load LOOPS.go: the status is 0 if so
;;;
;;; The pass `licm' of Guile 3.0.10 and 3.0.11 moves such a read out of the loop, before the test of whether the
;;; thing is there: where it is #f, the program ends by SIGSEGV.  Configure compiles and runs this file, and
;;; compiles without that pass where it fails; tests/compiler.sh runs it with the flags of the build.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(use-modules (rnrs bytevectors)
             (srfi srfi-4)
             (srfi srfi-9))

(define-record-type <box> (make-box value) box? (value box-value))

(define-syntax-rule (sum-of (thing j) read)
  ;; A procedure that returns the sum of what READ finds at j = 2 ... n of its argument THING, 0 if that is #f.
  (lambda (thing n)
    (do ((j 1 (+ j 1))
         (sum 0 (+ sum (if (and thing (> j 1)) read 0))))
        ((> j n) sum))))

(define-syntax-rule (row-of (thing j) read)
  ;; The same, whose sum grows in a vector: the shape in which the fault was met.
  (lambda (thing n)
    (let ((row (make-vector (+ n 1) 0)))
      (do ((j 1 (+ j 1)))
          ((> j n) (vector-ref row n))
        (let ((there? (and thing (> j 1)))
              (before (vector-ref row (- j 1))))
          (vector-set! row j (if there? (+ before read) before)))))))

(define-syntax-rule (shapes (example (thing j) read) ...)
  (list (list example (sum-of (thing j) read) (row-of (thing j) read)) ...))

(define all
  (shapes
   ((vector 1 1 1) (v j) (vector-ref v (- j 2)))
   ((vector 1) (v j) (vector-length v))
   ((string #\1 #\1 #\1) (s j) (if (char=? #\1 (string-ref s (- j 2))) 1 0))
   ((string #\1) (s j) (string-length s))
   ((u8-list->bytevector (list 1 1 1)) (b j) (bytevector-u8-ref b (- j 2)))
   ((f64vector 1 1 1) (b j) (if (= 1 (f64vector-ref b (- j 2))) 1 0))
   ((u8-list->bytevector (list 1)) (b j) (bytevector-length b))
   ((list 1) (p j) (car p))
   ((make-box 1) (b j) (box-value b))
   ((make-variable 1) (v j) (variable-ref v))
   ((lambda (j) 1) (f j) (f j))))

(define (right? example . loops)
  (and-map (lambda (loop) (and (= 0 (loop #f 4)) (= 3 (loop example 4)))) loops))

(unless (and-map (lambda (shape) (apply right? shape)) all)
  (exit 1))
