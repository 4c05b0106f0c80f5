;;; (bight core record) --- plain records.
;;;
;;; As SRFI-9's define-record-type, but every accessor and modifier is an ordinary procedure, so that
;;; the compiler's warning for unused definitions stays meaningful.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(define-module (bight core record)
  #:export (define-record
            document))

(define-syntax define-slot
  (syntax-rules ()
    ((_ type (name get))
     (define get (record-accessor type 'name)))
    ((_ type (name get set))
     (begin
       (define get (record-accessor type 'name))
       (define set (record-modifier type 'name))))))

(define-syntax-rule (define-record type (make field ...) is? slot ...)
  "Define the record TYPE with the constructor MAKE of all FIELDs in order, the predicate IS?, and for
each SLOT, (NAME GET) or (NAME GET SET), an accessor and perhaps a modifier."
  (begin
    (define type (make-record-type 'type '(field ...)))
    (define make (record-constructor type))
    (define is? (record-predicate type))
    (define-slot type slot) ...))

(define-syntax-rule (document (procedure sentence) ...)
  "Give each PROCEDURE, which was not written as a lambda, SENTENCE for its docstring."
  (begin (set-procedure-property! procedure 'documentation sentence) ...))
