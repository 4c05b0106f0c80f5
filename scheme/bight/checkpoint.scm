;;; (bight checkpoint) --- time as a value: checkpoints, forks, the hash of a state.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(define-module (bight checkpoint)
  #:use-module (bight dive)
  #:use-module (bight engine)
  #:use-module (bight record)
  #:use-module (bight task)
  #:use-module (bight time)
  #:use-module (bight verb)
  #:use-module ((srfi srfi-9 gnu) #:select (set-record-type-printer!))
  #:export (checkpoint checkpoint? restore! what-if what-if-thunk state-hash))

(define-record <checkpoint>
  (make-checkpoint time bytes tasks)
  is-checkpoint?
  (time checkpoint-time)
  (bytes checkpoint-bytes)
  (tasks checkpoint-tasks))

(set-record-type-printer!
 <checkpoint>
 (lambda (c port)
   (simple-format port "#<checkpoint at ~a s>" (/ (round (* 1000 (checkpoint-time c))) 1000))))

(define-argument-type (checkpoint value)
  "what `checkpoint' returned"
  (if (is-checkpoint? value) value refused))

(define-verb (checkpoint? (object any))
  "Return #t if OBJECT is a checkpoint."
  (is-checkpoint? object))

(define-verb (checkpoint)
  "Return the whole state of the dive, a value that `restore!' goes back to."
  (let ((dive (this-dive 'checkpoint)))
    (make-checkpoint (now) (%save-dive (engine-of dive)) (tasks-state dive))))

(define-verb (restore! (c checkpoint))
  "Go back to the checkpoint C of this dive.  Raise stale if it is of another.  Return the time."
  (let ((dive (this-dive 'restore!)))
    (check-not-running 'restore! dive)
    (%restore-dive! (engine-of dive) (checkpoint-bytes c))
    (restore-tasks! dive (checkpoint-tasks c))
    (now)))

(define-verb (what-if-thunk (thunk thunk))
  "Call THUNK with a fork of the dive as the current one, and return what it returns.  The dive itself is
untouched."
  (let ((fork (fork-dive (this-dive 'what-if))))
    (copy-tasks! fork)
    (parameterize ((current-dive fork))
      (thunk))))

(define-syntax-rule (what-if body body* ...)
  "Evaluate the body on a fork of the dive, and leave the dive itself untouched."
  (what-if-thunk (lambda () body body* ...)))

(define-verb (state-hash)
  "Return the 64-bit hash of the dive's whole state: equal states have equal hashes."
  (%hash-dive (this-engine 'state-hash)))
