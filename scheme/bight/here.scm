;;; (bight here) --- the place in a user's file that is running, and where an error was raised.
;;;
;;; (bight place) evaluates files so that it is known.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(define-module (bight here)
  #:export (at-place
            note-place!
            place-of
            noting-places))

(define here (make-fluid #f))           ; (FILE . LINE) of the innermost call that stands in a user's file

(define (at-place place thunk)
  "Call THUNK, the call that stands at PLACE, (FILE . LINE)."
  (with-fluid* here place thunk))

(define places (make-weak-key-hash-table)) ; of exceptions

(define (note-place! exception)
  "Remember that EXCEPTION is raised here, unless it is known already where it was.  Return it."
  (when (and (fluid-ref here) (not (hashq-ref places exception)))
    (hashq-set! places exception (fluid-ref here)))
  exception)

(define (place-of exception)
  "Return the place (FILE . LINE) where EXCEPTION was raised, or #f if that is not known."
  (hashq-ref places exception))

(define (noting-places thunk)
  "Call THUNK; of what it raises it is known afterwards where."
  (with-exception-handler
      (lambda (exception) (raise-exception (note-place! exception) #:continuable? #t))
    thunk))
