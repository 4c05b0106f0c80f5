;;; (bight belief clauses) --- what commands are told of a belief: what is uncertain, and of how many tethers it is.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(define-module (bight belief clauses)
  #:use-module ((bight core datum) #:select (text->datum))
  #:use-module ((bight core decimal) #:select (text->number))
  #:use-module (bight core errors)
  #:use-module ((bight core missing) #:select (why-not))
  #:use-module ((ice-9 textual-ports) #:select (get-string-n))
  #:export (clauses-from tethers-from))

(define most-characters 100000)

(define (file-text proc file)
  (catch 'system-error
    (lambda () (call-with-input-file file (lambda (port) (get-string-n port most-characters)) #:encoding "UTF-8"))
    (lambda args
      (bight-raise 'io proc "cannot read ~s: ~a" file (why-not file args)))))

(define (clauses-from proc text)
  "Return the clauses of a belief, a list, that TEXT holds, or the file of that name; raise a &bight-error from PROC where
there are none."
  (let* ((text (if (string-prefix? "(" (string-trim text)) text (file-text proc text)))
         (data (and (string? text) (text->datum (string-append "(" text "\n)")))))
    (unless (pair? data)
      (bight-raise 'format proc "a belief is told by clauses, such as (current (error 0.1)) \
(line (cdn (uniform 1 1.6))), or by a file of them"))
    data))

(define usual-tethers 32)

(define (tethers-from proc text)
  "Return how many tethers a belief is of, as TEXT, that of the option --tethers or #f, says."
  (let ((n (if text (text->number text) usual-tethers)))
    (unless (and (exact-integer? n) (<= 8 n 4096))
      (bight-raise 'domain proc "--tethers is a whole number from 8 to 4096, not ~s" text))
    n))
