;;; (bight dive task) --- what runs between the steps of a dive: `every', `on', and what else has to.
;;;
;;; Tasks run after each step in order of registration, in Scheme's own thread; a step itself never
;;; enters Scheme.  A task's state is a value that never changes in place, so that a checkpoint can keep
;;; it and a fork share it.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(define-module (bight dive task)
  #:use-module (bight core errors)
  #:use-module (bight core record)
  #:use-module (bight core verb)
  #:use-module (bight dive)
  #:use-module (bight engine)
  #:use-module ((srfi srfi-1) #:select (fold remove))
  #:use-module ((srfi srfi-9 gnu) #:select (set-record-type-printer!))
  #:export (every every-seconds on cancel!
            add-task! remove-task! steered? task-state set-task-state!
            add-step-watcher! remove-step-watcher!
            idle? steps-until-due run-tasks! run-watchers!
            copy-tasks! tasks-state restore-tasks!))

(define-record <task>
  (%make-task name poll state origin steers due)
  task?
  (name task-name)                      ; a string
  (poll task-poll)                      ; called with the task after each step
  (state task-state set-task-state!)
  (origin task-origin)                  ; the task it is a copy of, or #f
  (steers task-steers)                  ; the vehicle that it steers until it is done, or #f
  (due task-due))                       ; from its state to the step before which it does nothing, or #f

(define (copy-task task state)
  ;; TASK for another dive or another time, in STATE.
  (%make-task (task-name task) (task-poll task) state (original task) (task-steers task) (task-due task)))

(define (original task)
  (or (task-origin task) task))

(define (same-task? a b)
  ;; The handle that `every' returned stands for the task's copies too.
  (eq? (original a) (original b)))

(set-record-type-printer!
 <task> (lambda (task port) (simple-format port "#<~a>" (task-name task))))

(define-argument-type (task value)
  "what `every' or `on' returned"
  (if (task? value) value refused))

(define* (add-task! proc name poll state #:optional (steers #f) #:key (due #f))
  "Call POLL with the new task after each step of the current dive; given DUE, after those steps at least from DUE of
its state on.  NAME, a string, shows it; STATE is what it begins with; STEERS is the vehicle that is on its way until
the task is done.  Return the task.  Raise a &bight-error from PROC when there is no dive."
  (let ((dive (this-dive proc))
        (task (%make-task name poll state #f steers due)))
    (set-dive-tasks! dive (append (dive-tasks dive) (list task)))
    task))

(define (remove-task! dive task)
  "Take TASK, or the copy of it that is there, from DIVE; return #t if it was there."
  (let* ((tasks (dive-tasks dive))
         (others (remove (lambda (other) (same-task? task other)) tasks)))
    (set-dive-tasks! dive others)
    (< (length others) (length tasks))))

(define (steered? vehicle)
  "Return #t if a task of the current dive steers VEHICLE, a name."
  (and (memq vehicle (map task-steers (dive-tasks (this-dive 'arrived?)))) #t))


;;; The tasks a user knows.

;; A drift of a millionth of a step is rounding, not time.
(define rounding 1e-6)

(define (step-due at)
  ;; The first whole step at which a timed task in the state AT runs.
  (inexact->exact (ceiling (- at rounding))))

(define (run-when-due task thunk period)
  ;; The state of a timed task is the step, perhaps fractional, at which it is due.
  (when (>= (%dive-steps (this-engine 'every)) (step-due (task-state task)))
    (set-task-state! task (+ (task-state task) period))
    (thunk)
    (run-when-due task thunk period)))

(define (every-seconds seconds thunk)
  "Call THUNK every SECONDS of dive time from now on, between steps.  Return a handle for `cancel!'."
  (let* ((seconds (check-argument 'every 'seconds type:positive seconds))
         (engine (this-engine 'every))
         (period (/ seconds (%dive-time-step engine))))
    (when (< period 1e-3)
      (bight-raise 'domain 'every "~a s is far below a time step of ~a s" seconds
                   (%dive-time-step engine)))
    (add-task! 'every (simple-format #f "every ~a s" seconds)
               (lambda (task) (run-when-due task thunk period))
               (+ (%dive-steps engine) period)
               #:due step-due)))

(define-syntax-rule (every seconds body body* ...)
  "Evaluate the body every SECONDS of dive time from now on, between steps; return a handle."
  (every-seconds seconds (lambda () body body* ...)))

(define event-kinds (%event-kinds))

(define (run-on-events task kind procedure)
  ;; The state of a task for events is how many events it has seen.
  (let* ((engine (this-engine 'on))
         (events (%events engine (task-state task))))
    (set-task-state! task (%event-count engine))
    (for-each (lambda (event)
                (when (eq? (car event) kind)
                  (procedure event)))
              events)))

(define-verb (on (kind name) (procedure procedure))
  "Call PROCEDURE with each event of KIND from now on, between steps: taut slack arrived spooled stalled
parted snapped hockled kinked touched left stuck pinched prop-danger worn, and wrapped and freed, which are
looked for twice a second: what `(events)' lists.  An event is a list (KIND TIME SUBJECT [OBJECT]).  Return a
handle for `cancel!'."
  (unless (memq kind event-kinds)
    (unknown-name 'on "a dive" kind event-kinds "event"))
  (unless (takes? procedure 1)
    (bight-raise 'domain 'on "the procedure must take one argument, the event; ~s does not" procedure))
  (add-task! 'on (simple-format #f "on ~a" kind)
             (lambda (task) (run-on-events task kind procedure))
             (%event-count (this-engine 'on))))

(define-verb (cancel! (handle task))
  "Stop what `every' or `on' started.  Return #t if it was still registered in this dive."
  (remove-task! (this-dive 'cancel!) handle))


;;; Watchers: run after the tasks, not part of the dive's own story.

(define (add-step-watcher! thunk)
  "Call THUNK after every step of the current dive, after its tasks.  Return THUNK."
  (let ((dive (this-dive 'add-step-watcher!)))
    (set-dive-watchers! dive (append (dive-watchers dive) (list thunk)))
    thunk))

(define (remove-step-watcher! thunk)
  "No longer call THUNK after the steps of the current dive."
  (let ((dive (this-dive 'remove-step-watcher!)))
    (set-dive-watchers! dive (delq thunk (dive-watchers dive)))))


;;; For those who let time pass.

(define (idle? dive)
  "Return #t if nothing runs between the steps of DIVE."
  (and (null? (dive-tasks dive)) (null? (dive-watchers dive))))

(define (steps-until-due dive most)
  "Return how many steps of DIVE to take, 1 to MOST, before something that runs between them has anything to do."
  (define (steps-of task)
    (let ((due (task-due task)))
      (if due (max 1 (- (due (task-state task)) (%dive-steps (engine-of dive)))) 1)))
  (if (null? (dive-watchers dive))
      (fold (lambda (task n) (min n (steps-of task))) most (dive-tasks dive))
      1))

(define (run-tasks! dive)
  "Run what is due after a step of DIVE, the current dive."
  (for-each (lambda (task)
              (when (memq task (dive-tasks dive)) ; a task may cancel another
                ((task-poll task) task)))
            (dive-tasks dive))
  (run-watchers! dive))

(define (run-watchers! dive)
  "Run what watches the steps of DIVE, after its tasks."
  (for-each (lambda (watcher) (watcher)) (dive-watchers dive)))

(define (copy-tasks! dive)
  "Give DIVE, a fork, copies of the tasks it shares with its origin."
  (set-dive-tasks! dive
                   (map (lambda (task) (copy-task task (task-state task))) (dive-tasks dive))))

(define (tasks-state dive)
  "Return the tasks of DIVE with their states, a value."
  (map (lambda (task) (cons task (task-state task))) (dive-tasks dive)))

(define (restore-tasks! dive state)
  "Bring the tasks of DIVE back to STATE, from `tasks-state'."
  (set-dive-tasks! dive (map (lambda (entry) (copy-task (car entry) (cdr entry))) state)))
