;;; Print, as make rules, which compiled module needs which others compiled before it.
;;;
;;; usage: guile -s module-deps.scm FOLDER MODULE.scm...
;;;
;;; A module is compiled again when one that it uses was: macros and inlined procedures travel
;;; between them.  What a module uses is read from its own text: `#:use-module' in define-module,
;;; and `use-modules' at top level.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(use-modules (ice-9 match)
             (srfi srfi-1))

(define (read-all file)
  (call-with-input-file file
    (lambda (port)
      (let loop ((forms '()))
        (let ((form (read port)))
          (if (eof-object? form) (reverse forms) (loop (cons form forms))))))
    #:encoding "UTF-8"))

;; A module is named in an interface as (a b) or as ((a b) #:select ...).
(define (interface-module spec)
  (match spec
    (((name ...) . _) name)
    (name name)))

(define (clause-uses clauses)
  (match clauses
    ((#:use-module spec . rest) (cons (interface-module spec) (clause-uses rest)))
    ((_ . rest) (clause-uses rest))
    (() '())))

(define (form-uses form)
  (match form
    (('define-module _ . clauses) (clause-uses clauses))
    (('use-modules . specs) (map interface-module specs))
    (_ '())))

(define (module-stem name)
  (string-join (map symbol->string name) "/"))

(define (stem file)
  (string-drop-right file (string-length ".scm")))

(define (print-rule folder file stems)
  (let* ((uses (append-map form-uses (read-all (string-append folder "/" file))))
         (ours (lset-intersection string=? stems
                                  (map module-stem (filter (lambda (use) (every symbol? use)) uses)))))
    (for-each (lambda (other)
                (format #t "~a.go: ~a.go\n" (stem file) other))
              ours)))

(match (command-line)
  ((_ folder . files)
   (let ((stems (map stem files)))
     (for-each (lambda (file) (print-rule folder file stems)) files))))
