;;; (bight dive checkpoint) --- time as a value: checkpoints, going back, forks, the hash of a state.
;;;
;;; A checkpoint holds the state, what runs between the steps, and the past that led there.  What runs
;;; between the steps of a dive (`every', `on', a pilot) goes back with it: a task's state is a value, and
;;; so is where a pilot stands in his script.  What such code did to Scheme's own variables stays done.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(define-module (bight dive checkpoint)
  #:use-module (bight core errors)
  #:use-module (bight core record)
  #:use-module (bight core verb)
  #:use-module (bight dive)
  #:use-module (bight dive past)
  #:use-module (bight dive pilot)
  #:use-module (bight dive task)
  #:use-module (bight dive time)
  #:use-module (bight engine)
  #:use-module ((srfi srfi-9 gnu) #:select (set-record-type-printer!))
  #:export (checkpoint checkpoint? restore! rewind! what-if what-if-thunk state-hash
            go-live! freeze-dive! frozen))

(define-record <checkpoint>
  (make-checkpoint time bytes tasks past journal serial carried)
  is-checkpoint?
  (time checkpoint-time)
  (bytes checkpoint-bytes)
  (tasks checkpoint-tasks)
  (past checkpoint-past)
  (journal checkpoint-journal)
  (serial checkpoint-serial)
  (carried checkpoint-carried))         ; of the time asked for, s

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
  (let* ((dive (this-dive 'checkpoint)) (engine (engine-of dive)))
    (make-checkpoint (now) (%keep-dive engine) (tasks-state dive)
                     (dive-past dive) (%journal engine) (%serial engine) (%carried engine))))


;;; A live dive stands still while it goes back.

(define (go-live! dive pace)
  "Let DIVE run by itself, PACE seconds in a second.  Return #f if it does already."
  (let ((started? (%live! (engine-of dive) pace)))
    (when started?
      (set-house-dive! dive))
    (when (and started? (dive-recorder dive))
      ((dive-recorder dive) 'live))
    started?))

(define (freeze-dive! dive)
  "Stop what `go-live!' started, and return #f if there was nothing to stop."
  (let ((engine (engine-of dive)))
    (when (%live? engine)
      (when (dive-recorder dive)
        ((dive-recorder dive) 'freeze))
      (when (dive-past dive)
        (set-dive-past! dive (past-with-moments (dive-past dive) engine
                                                (%live-moments engine -1 #t) (tasks-state dive)))))
    (%freeze! engine)))

(define (frozen dive thunk)
  "Call THUNK while DIVE stands still, and return what it returns; a live dive is live again then."
  (if (freeze-dive! dive)
      (dynamic-wind
        (const #f)
        thunk
        (lambda () (go-live! dive 1.0)))
      (thunk)))

(define (jumped dive)
  ;; Time did not pass: tell the recorder.
  (when (dive-recorder dive)
    ((dive-recorder dive) 'jump)))

(define-syntax-rule (standing-still proc dive body body* ...)
  (begin
    (check-not-running proc dive)
    (when (dive-recorder dive)
      ((dive-recorder dive) 'pause))
    (frozen dive (lambda () body body* ... (jumped dive)))
    (now)))


;;; Going back.

(define-verb (restore! (c checkpoint))
  "Go back to the checkpoint C of this dive.  Raise stale if it is of another.  Return the time."
  (let* ((dive (this-dive 'restore!)) (engine (engine-of dive)))
    (standing-still 'restore! dive
      (%restore-dive! engine (checkpoint-bytes c))
      (%carry! engine (checkpoint-carried c))
      (%raise-serial! engine (checkpoint-serial c))
      (%set-journal! engine (checkpoint-journal c))
      (when (dive-past dive)
        (set-dive-past! dive (checkpoint-past c)))
      (restore-tasks! dive (checkpoint-tasks c)))))

(define (past-of dive)
  (or (dive-past dive)
      (bight-raise 'unsupported 'rewind! "this dive remembers nothing of itself")))

(define (step-before dive seconds)
  (let* ((engine (engine-of dive))
         (now (%dive-steps engine))
         (step (- now (inexact->exact (round (/ seconds (%dive-time-step engine))))))
         (oldest (past-oldest (past-of dive))))
    (when (< step oldest)
      (bight-raise 'domain 'rewind! "this dive goes back ~a s at most, not ~a"
                   (* (- now oldest) (%dive-time-step engine)) seconds))
    step))

(define-verb (rewind! (seconds non-negative))
  "Go back SECONDS: to how the dive was when that step was reached and what runs between the steps had
run, before anything else was done then.  What follows is forgotten.  A pilot stands in his script where
he stood.  Return the time."
  (let ((dive (this-dive 'rewind!)))
    (when (piloting?)
      (bight-raise 'def 'rewind! "a pilot cannot turn back the dive that he flies"))
    (standing-still 'rewind! dive
      (let ((step (step-before dive seconds)))
        (call-with-values (lambda () (go-back! (past-of dive) (engine-of dive) step))
          (lambda (past tasks)
            (%carry! (engine-of dive) 0.0)
            (set-dive-past! dive past)
            (restore-tasks! dive tasks)))))))


;;; Forks.

(define-verb (what-if-thunk (thunk thunk))
  "Call THUNK with a fork of the dive as the current one, and return what it returns.  The dive itself is
untouched."
  (let* ((dive (this-dive 'what-if)) (fork (fork-dive dive)))
    (copy-tasks! fork)
    (call-with-values (lambda () (parameterize ((current-dive fork)) (thunk)))
      (lambda results
        (%rest-fork! (engine-of fork) (engine-of dive))
        (apply values results)))))

(define-syntax-rule (what-if body body* ...)
  "Evaluate the body on a fork of the dive, and leave the dive itself untouched."
  (what-if-thunk (lambda () body body* ...)))

(define-verb (state-hash)
  "Return the 64-bit hash of the dive's whole state: equal states have equal hashes."
  (%hash-dive (this-engine 'state-hash)))
