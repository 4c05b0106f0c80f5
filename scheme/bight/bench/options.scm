;;; (bight bench options) --- the command line of a bench that is written in the language.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(define-module (bight bench options)
  #:use-module ((bight core decimal) #:select (text->number))
  #:use-module (bight core errors)
  #:use-module ((bight core options) #:select (bad-usage split-arguments))
  #:export (bench-options whole decimal))

(define (bench-options name valued flags arguments)
  "Return what ARGUMENTS of the bench NAME say, an alist from an option to its value, a string, or to #t for one of FLAGS.
VALUED are the options that a value follows."
  (call-with-values
      (lambda ()
        (split-arguments (string-append "bench " name)
                         (append (map (lambda (option) (cons option #t)) valued) (map (lambda (flag) (cons flag #f)) flags))
                         arguments))
    (lambda (others options)
      (unless (null? others)
        (bad-usage "the bench ~a takes options alone, not ~a: ~a" name (car others) (string-join (append valued flags) ", ")))
      options)))

(define (whole options name default low high)
  "Return the whole number from LOW to HIGH that OPTIONS, as `bench-options' returns them, have for NAME; without it DEFAULT."
  (let* ((text (assoc-ref options name)) (n (if text (text->number text) default)))
    (unless (and (exact-integer? n) (<= low n high))
      (bight-raise 'domain 'bench "~a takes a whole number from ~a to ~a, not ~a" name low high text))
    n))

(define (decimal options name default low high)
  "Return the number from LOW to HIGH that OPTIONS have for NAME; without it DEFAULT, which may be #f."
  (let* ((text (assoc-ref options name)) (x (if text (text->number text) default)))
    (unless (or (not text) (and (real? x) (<= low x high)))
      (bight-raise 'domain 'bench "~a takes a number from ~a to ~a, not ~a" name low high text))
    x))
