;;; (bight time) --- time passes: running, what runs between steps, checkpoints and forks.
;;;
;;; Only the verbs of this module let time pass.  A step is done by the engine alone; what `every' and
;;; `on' registered runs between steps, in order of registration.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(define-module (bight time)
  #:use-module (bight dive)
  #:use-module (bight engine)
  #:use-module (bight errors)
  #:use-module (bight progress)
  #:use-module (bight record)
  #:use-module (bight verb)
  #:use-module ((srfi srfi-1) #:select (fold))
  #:use-module ((srfi srfi-9 gnu) #:select (set-record-type-printer!))
  #:export (now time-step run run-until step! settle!
            every every-seconds on cancel!
            add-step-watcher! remove-step-watcher!
            checkpoint checkpoint? restore! what-if what-if-thunk state-hash))


;;; What runs between steps.

(define-record <task>
  (make-task name work due period kind seen)
  task?
  (name task-name)
  (work task-work)                      ; a thunk, or for `on' a procedure of the event
  (due task-due set-task-due!)          ; `every': the step at which it runs next
  (period task-period)                  ; `every': in steps, may be fractional
  (kind task-kind)                      ; `on': the kind of event, else #f
  (seen task-seen set-task-seen!))      ; `on': how many events are dealt with

(set-record-type-printer!
 <task> (lambda (task port) (format port "#<~a>" (task-name task))))

(define-argument-type (task value)
  "what `every' or `on' returned"
  (if (task? value) value refused))

(define (add-task! dive task)
  (set-dive-tasks! dive (append (dive-tasks dive) (list task)))
  task)

(define (copy-task task)
  (make-task (task-name task) (task-work task) (task-due task) (task-period task) (task-kind task)
             (task-seen task)))

(define-verb (every-seconds (seconds positive) (thunk thunk))
  "Call THUNK every SECONDS of dive time from now on, between steps.  Return a handle for `cancel!'."
  (let* ((dive (this-dive 'every))
         (engine (engine-of dive))
         (period (/ seconds (%dive-time-step engine))))
    (add-task! dive (make-task (simple-format #f "every ~a s" seconds) thunk
                               (+ (%dive-steps engine) period) period #f #f))))

(define-syntax-rule (every seconds body body* ...)
  "Evaluate the body every SECONDS of dive time from now on, between steps; return a handle."
  (every-seconds seconds (lambda () body body* ...)))

(define event-kinds '(taut slack arrived spooled))

(define-verb (on (kind name) (procedure procedure))
  "Call PROCEDURE with each event of KIND (taut slack arrived spooled) from now on, between steps.  An
event is a list (KIND TIME SUBJECT).  Return a handle for `cancel!'."
  (unless (memq kind event-kinds)
    (unknown-name 'on "a dive" kind event-kinds "event"))
  (let ((dive (this-dive 'on)))
    (add-task! dive (make-task (simple-format #f "on ~a" kind) procedure #f #f kind
                               (%event-count (engine-of dive))))))

(define-verb (cancel! (handle task))
  "Stop what `every' or `on' started.  Return #t if it was still registered in this dive."
  (let* ((dive (this-dive 'cancel!))
         (there? (and (memq handle (dive-tasks dive)) #t)))
    (set-dive-tasks! dive (delq handle (dive-tasks dive)))
    there?))

(define (add-step-watcher! thunk)
  "Call THUNK after every step of the current dive, after its tasks.  Return THUNK."
  (let ((dive (this-dive 'add-step-watcher!)))
    (set-dive-watchers! dive (append (dive-watchers dive) (list thunk)))
    thunk))

(define (remove-step-watcher! thunk)
  "No longer call THUNK after the steps of the current dive."
  (let ((dive (this-dive 'remove-step-watcher!)))
    (set-dive-watchers! dive (delq thunk (dive-watchers dive)))))

;; A drift of a millionth of a step is rounding, not time.
(define (due? task step)
  (>= (+ step 1e-6) (task-due task)))

(define (run-timed task step)
  (when (due? task step)
    (set-task-due! task (+ (task-due task) (task-period task)))
    ((task-work task))
    (run-timed task step)))

(define (run-on-events task engine)
  (let ((events (%events engine (task-seen task))))
    (set-task-seen! task (%event-count engine))
    (for-each (lambda (event)
                (when (eq? (car event) (task-kind task))
                  ((task-work task) event)))
              events)))

(define (run-tasks dive)
  (let ((engine (engine-of dive)))
    (for-each (lambda (task)
                (when (memq task (dive-tasks dive)) ; a task may cancel another
                  (if (task-kind task)
                      (run-on-events task engine)
                      (run-timed task (%dive-steps engine)))))
              (dive-tasks dive))
    (for-each (lambda (watcher) (watcher)) (dive-watchers dive))))


;;; Running.

(define (plain? dive)
  (and (null? (dive-tasks dive)) (null? (dive-watchers dive))))

(define stretch 60)                     ; steps between looks at the clock

(define running-dive
  ;; The dive that a `run' is stepping, so that what runs between steps cannot run it too.
  (make-parameter #f))

(define (check-not-running proc dive)
  (when (eq? dive (running-dive))
    (bight-raise 'def proc "what runs between steps cannot let time pass itself")))

(define (step-stretch! dive n)
  (if (plain? dive)
      (%step-dive! (engine-of dive) n)
      (do ((i 0 (+ i 1)))
          ((= i n))
        (%step-dive! (engine-of dive) 1)
        (run-tasks dive))))

(define (advance! proc n)
  (let ((dive (this-dive proc)))
    (check-not-running proc dive)
    (parameterize ((running-dive dive))
      (with-progress n
        (lambda (report)
          (let loop ((done 0))
            (when (< done n)
              (let ((k (min stretch (- n done))))
                (step-stretch! dive k)
                (report (+ done k))
                (loop (+ done k))))))))))

(define-verb (now)
  "Return the time of the dive, s."
  (%dive-time (this-engine 'now)))

(define-verb (time-step)
  "Return the time step of the dive, s."
  (%dive-time-step (this-engine 'time-step)))

(define-argument-type (duration value)
  "a time in seconds from 0 to 1e9"
  (if (and (real? value) (<= 0 value 1e9)) (exact->inexact value) refused))

(define-verb (run (seconds duration))
  "Let SECONDS pass, in whole steps; the remainder is carried to the next `run'.  Return the time."
  (check-not-running 'run (this-dive 'run))
  (advance! 'run (%whole-steps! (this-engine 'run) seconds))
  (now))

(define-verb (step!)
  "Let one step pass.  Return the time."
  (advance! 'step! 1)
  (now))

(define (steps-in engine seconds)
  (inexact->exact (floor (+ 1e-6 (/ seconds (%dive-time-step engine))))))

(define-verb (run-until (condition thunk) #:key (at-most duration 3600.0))
  "Let time pass until CONDITION, a procedure of no arguments, returns true, at most AT-MOST seconds.  It
is asked before the first step and after each.  Return its value, or #f when it never came true."
  (let ((n (steps-in (this-engine 'run-until) at-most)))
    (let loop ((i 0))
      (or (condition)
          (and (< i n)
               (begin
                 (advance! 'run-until 1)
                 (loop (+ i 1))))))))


;;; Settling.

(define (shapes engine)
  (map (lambda (i) (%tether-points engine i 16)) (iota (length (%names engine 'tether)))))

(define (largest-move before after)
  (fold (lambda (old new most)
          (let ((moved 0.0))
            (array-for-each (lambda (a b) (set! moved (max moved (abs (- a b))))) old new)
            (max most moved)))
        0.0 before after))

(define (all-settled? engine)
  (and-map (lambda (i) (assq-ref (%tether engine i) 'settled?))
              (iota (length (%names engine 'tether)))))

(define-verb (settle! #:key (within positive 0.001) (at-most duration 600.0))
  "Let time pass until no tether moves more than WITHIN metres in a second, at most AT-MOST seconds.
Return #t when it came to rest."
  (let* ((engine (this-engine 'settle!))
         (second (steps-in engine 1)))
    (let loop ((left (steps-in engine at-most)) (before (shapes engine)))
      (if (< left second)
          #f
          (begin
            (advance! 'settle! second)
            (let ((after (shapes engine)))
              (if (and (all-settled? engine) (<= (largest-move before after) within))
                  #t
                  (loop (- left second) after))))))))


;;; Time as a value.

(define-record <checkpoint>
  (make-checkpoint time bytes tasks)
  checkpoint-record?
  (time checkpoint-time)
  (bytes checkpoint-bytes)
  (tasks checkpoint-tasks))

(set-record-type-printer!
 <checkpoint>
 (lambda (c port) (format port "#<checkpoint at ~a s>" (/ (round (* 1000 (checkpoint-time c))) 1000))))

(define-argument-type (checkpoint value)
  "what `checkpoint' returned"
  (if (checkpoint-record? value) value refused))

(define-verb (checkpoint? (object any))
  "Return #t if OBJECT is a checkpoint."
  (checkpoint-record? object))

(define (task-state task)
  (list task (task-due task) (task-seen task)))

(define (restore-task state)
  (set-task-due! (car state) (cadr state))
  (set-task-seen! (car state) (caddr state))
  (car state))

(define-verb (checkpoint)
  "Return the whole state of the dive, a value that `restore!' goes back to."
  (let ((dive (this-dive 'checkpoint)))
    (make-checkpoint (now) (%save-dive (engine-of dive)) (map task-state (dive-tasks dive)))))

(define-verb (restore! (c checkpoint))
  "Go back to the checkpoint C of this dive.  Raise stale if it is of another.  Return the time."
  (let ((dive (this-dive 'restore!)))
    (check-not-running 'restore! dive)
    (%restore-dive! (engine-of dive) (checkpoint-bytes c))
    (set-dive-tasks! dive (map restore-task (checkpoint-tasks c)))
    (now)))

(define-verb (what-if-thunk (thunk thunk))
  "Call THUNK with a fork of the dive as the current one, and return what it returns.  The dive itself is
untouched."
  (let ((fork (fork-dive (this-dive 'what-if))))
    (set-dive-tasks! fork (map copy-task (dive-tasks fork)))
    (parameterize ((current-dive fork))
      (thunk))))

(define-syntax-rule (what-if body body* ...)
  "Evaluate the body on a fork of the dive, and leave the dive itself untouched."
  (what-if-thunk (lambda () body body* ...)))

(define-verb (state-hash)
  "Return the 64-bit hash of the dive's whole state: equal states have equal hashes."
  (%hash-dive (this-engine 'state-hash)))
