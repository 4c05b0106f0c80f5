;;; (bight language) --- modules in which all names are the language's, for files and for what is typed.
;;;
;;; `format' is there the whole one of (ice-9 format), which rounds numbers and makes columns; Guile's own
;;; knows no more than ~a, ~s, ~% and ~~.  The first call loads that module: whoever calls it not, waits not.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(define-module (bight language)
  #:use-module (bight core errors)
  #:use-module (ice-9 exceptions)
  #:use-module ((srfi srfi-1) #:select (second third))
  #:use-module ((srfi srfi-34) #:select (guard))
  #:export (use-language!
            language-module
            call-in-language))

(define (format to text . arguments)
  "Guile's `format', with its errors in one line: that module prints a report of its own, then raises."
  (let ((port (if (eq? to #t) (current-output-port) to))
        (report (open-output-string)))
    (guard (e ((error-of-format? e)
               (bight-raise 'domain 'format "~a" (reason-in (get-output-string report)))))
      (parameterize ((current-error-port report) (current-output-port report))
        (apply (@ (ice-9 format) format) port text arguments)))))

(define (error-of-format? e)
  (and (exception-with-message? e)
       (equal? (exception-message e) "error in format")))

(define (reason-in report)
  ;; Line 2 of REPORT is "FORMAT: error with call: " and the call, marked where it stopped; line 3 is the reason.
  (let ((lines (map string-trim-both (string-split report #\newline))))
    (if (< (length lines) 3)
        "cannot be done"
        (string-append (third lines) " in "
                       (string-drop (second lines) (string-length "FORMAT: error with call: "))))))

(define (use-language! module)
  "Give MODULE bight's names, and the whole of `format'."
  (module-use! module (resolve-interface '(bight)))
  (module-define! module 'format format))

(define (language-module)
  "Return a new module that has Scheme's names and bight's, and nobody's definitions."
  (let ((module (make-fresh-user-module)))
    (use-language! module)
    module))

(define (call-in-language thunk)
  "Call THUNK with such a module as the current one."
  (save-module-excursion
   (lambda ()
     (set-current-module (language-module))
     (thunk))))
