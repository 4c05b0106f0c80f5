;;; (bight dive pilot) --- scripted pilots: they fly beside whatever lets time pass.
;;;
;;; The body of a pilot reads like a script.  When it says (run 5) it does not let time pass itself: it
;;; waits, and whoever flies with it, as in (with-pilot P (run 60)), goes on.  So a pilot is a coroutine,
;;; resumed between steps when what it waits for has come.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(define-module (bight dive pilot)
  #:use-module (bight core record)
  #:use-module (bight core verb)
  #:use-module (bight dive)
  #:use-module (bight dive task)
  #:use-module ((srfi srfi-9 gnu) #:select (set-record-type-printer!))
  #:export (define-pilot
            make-pilot
            with-pilot
            call-with-pilot
            piloting?
            wait-until))

(define-record <pilot>
  (%make-pilot name sentence script)
  pilot?
  (name pilot-name)
  (sentence pilot-sentence)
  (script pilot-script))                ; a thunk

(set-record-type-printer!
 <pilot>
 (lambda (p port) (simple-format port "#<pilot ~a: ~a>" (pilot-name p) (pilot-sentence p))))

(define-argument-type (pilot value)
  "a pilot, as `define-pilot' makes"
  (if (pilot? value) value refused))

(define-verb (make-pilot (name name) (sentence string) (script thunk))
  "Return a pilot called NAME, of whom SENTENCE tells, who flies by SCRIPT, a procedure of no arguments."
  (%make-pilot name sentence script))

(define-syntax-rule (define-pilot name sentence body body* ...)
  "Define NAME as a pilot of whom SENTENCE tells: the body is what he does.  When it lets time pass, as by
(run 5), it waits while the dive goes on."
  (define name (make-pilot 'name sentence (lambda () body body* ...))))


;;; The coroutine.

(define tag (make-prompt-tag 'pilot))

(define piloting
  ;; The dive of the pilot whose body is being evaluated, or #f.
  (make-parameter #f))

(define (piloting?)
  "Return #t within the body of a pilot, as far as it is about the dive that he flies."
  (and (piloting) (eq? (piloting) (current-dive))))

(define (wait-until ready?)
  "Leave the body of the pilot until READY?, a procedure of no arguments, returns true after some step."
  (abort-to-prompt tag ready?))

(define (never) #f)

(define busy
  ;; The state of a pilot who waits for nothing: he is at work, or done.
  (cons never #f))

(define (resume! task go-on)
  ;; Let the pilot of TASK go on, by a thunk that returns `busy' in the end, until he waits or is done.
  ;; The task's state is the condition he waits for, and how to go on then; a fork that he makes meanwhile
  ;; has no second pilot.
  (set-task-state! task busy)
  (set-task-state! task
                   (parameterize ((piloting (current-dive)))
                     ;; A tail call: else each wait would leave a frame in the next continuation.
                     (call-with-prompt tag
                       go-on
                       (lambda (continue ready?)
                         (cons ready? (lambda () (continue #t))))))))

(define (poll task)
  (let ((state (task-state task)))
    (when ((car state))
      (resume! task (cdr state)))))

(define (call-with-pilot pilot thunk)
  "Call THUNK while PILOT flies the current dive, and return what it returns.  He begins at once, and
leaves when THUNK returns."
  (let* ((pilot (check-argument 'with-pilot 'pilot type:pilot pilot))
         (dive (this-dive 'with-pilot))
         (task (add-task! 'with-pilot (simple-format #f "pilot ~a" (pilot-name pilot)) poll busy)))
    (dynamic-wind
      (const #f)
      (lambda ()
        (resume! task (lambda () ((pilot-script pilot)) busy))
        (thunk))
      (lambda () (remove-task! dive task)))))

(define-syntax-rule (with-pilot pilot body body* ...)
  "Evaluate the body while PILOT flies the current dive."
  (call-with-pilot pilot (lambda () body body* ...)))
