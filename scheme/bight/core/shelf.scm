;;; (bight core shelf) --- where the definitions of files are kept: scenarios, lessons, studies.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(define-module (bight core shelf)
  #:use-module (srfi srfi-1)
  #:export (make-shelf
            on-shelf
            shelve!
            call-with-empty-shelf))

(define (make-shelf)
  "Return a shelf with nothing on it."
  (make-parameter (make-variable '())))  ; the things on it, the last first

(define (on-shelf shelf)
  "Return the list of what is on SHELF, in order."
  (reverse (variable-ref (shelf))))

(define (shelve! shelf name-of name things)
  "Put THINGS on SHELF, in place of what is there and by NAME-OF has NAME."
  (variable-set! (shelf)
                 (append (reverse things)
                         (remove (lambda (old) (eq? (name-of old) name)) (variable-ref (shelf))))))

(define (call-with-empty-shelf shelf thunk)
  "Call THUNK, SHELF being empty to it; return the list of what it puts there."
  (parameterize ((shelf (make-variable '())))
    (thunk)
    (on-shelf shelf)))
