;;; (bight core here) --- the place in a user's file that is running, what led there, and where an error was raised.
;;;
;;; (bight core place) evaluates files so that it is known.  A frame is ((FILE . LINE) . NAME): a call that stands
;;; there, in the procedure NAME, or #f outside of any.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(define-module (bight core here)
  #:export (at-place
            afresh
            note-place!
            place-of
            chain-here
            chain-of
            noting-places))

(define here (make-fluid '()))          ; the frames of the calls that are under way, the innermost first

(define (at-place frame thunk)
  "Call THUNK, the call that FRAME tells of."
  (with-fluid* here (cons frame (fluid-ref here)) thunk))

(define (afresh thunk)
  "Call THUNK as if no call were under way: what it does has nothing to do with who calls."
  (with-fluid* here '() thunk))

(define places (make-weak-key-hash-table)) ; of exceptions

(define (note-place! exception)
  "Remember that EXCEPTION is raised here, unless it is known already where it was.  Return it."
  (when (and (pair? (fluid-ref here)) (not (hashq-ref places exception)))
    (hashq-set! places exception (fluid-ref here)))
  exception)

(define (place-of exception)
  "Return the place (FILE . LINE) where EXCEPTION was raised, or #f if that is not known."
  (let ((frames (hashq-ref places exception)))
    (and frames (car (car frames)))))

(define most-frames 8)

(define (calls frames)
  ;; FRAMES, of each call of a procedure the innermost alone, at most so many.
  (let loop ((rest frames) (kept '()) (room most-frames))
    (cond ((or (null? rest) (zero? room)) (reverse kept))
          ((and (pair? kept) (equal? (cdr (car kept)) (cdr (car rest)))) (loop (cdr rest) kept room))
          (else (loop (cdr rest) (cons (car rest) kept) (- room 1))))))

(define (chain-here)
  "Return the frames of the calls under way, the innermost first, one for each call of a procedure."
  (calls (fluid-ref here)))

(define (chain-of exception)
  "Return the frames of the calls that led to EXCEPTION, as `chain-here' has them; none if they are not known."
  (calls (hashq-ref places exception '())))

(define (noting-places thunk)
  "Call THUNK; of what it raises it is known afterwards where."
  (with-exception-handler
      (lambda (exception) (raise-exception (note-place! exception) #:continuable? #t))
    thunk))
