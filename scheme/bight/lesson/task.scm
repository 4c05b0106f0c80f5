;;; (bight lesson task) --- a task of a lesson: its conditions, hints, faults, and how it ends.
;;;
;;; A task watches the dive from between its steps, and leaves by an escape as soon as it is done, failed or given
;;; up; nothing here looks at the machine's clock.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(define-module (bight lesson task)
  #:use-module (bight cockpit coach)
  #:use-module (bight core decimal)
  #:use-module (bight core errors)
  #:use-module (bight core record)
  #:use-module (bight dive)
  #:use-module (bight dive checkpoint)
  #:use-module (bight dive pilot)
  #:use-module (bight dive task)
  #:use-module (bight dive time)
  #:use-module (bight lesson guide)
  #:use-module (bight lesson lost)
  #:use-module (bight lesson points)
  #:use-module (bight lesson score)
  #:use-module (bight lesson tally)
  #:use-module (bight lesson way)
  #:use-module ((ice-9 control) #:select (call/ec))
  #:use-module (srfi srfi-1)
  #:export (run-task
            task-set? task-set-dive task-set-time task-set-checkpoint fly-again
            ;; For guides.
            task-text task-targets task-counters task-gauges task-seconds next-hint! ask-for-hint!))

;;; CONDITIONS are lists: (done THUNK) (fail THUNK TEXT) (hint SECONDS TEXT [FORMS]) (at-most SECONDS)
;;; (held SECONDS) (target NAME THUNK) (first THUNK) (fault-after SECONDS TEXT THUNK) (fault-when THUNK TEXT THUNK).

(define (all-of kind conditions)
  (filter-map (lambda (c) (and (eq? kind (car c)) (cdr c))) conditions))

(define (one-of kind conditions default)
  (let ((found (all-of kind conditions)))
    (if (null? found) default (car (last found)))))

;; How often the conditions are asked, and the measures taken, s; and how far a step back is.
(define look-time 0.2)
(define sample-time 0.5)
(define point-time 5)

(define (steps-of seconds)
  (max 1 (inexact->exact (round (/ seconds (time-step))))))

(define (step-number)
  (inexact->exact (round (/ (now) (time-step)))))

(define (due? seconds)
  (zero? (modulo (step-number) (steps-of seconds))))

(define (task-time)
  (- (now) (tally-ref 'task-begun 0.0)))

(define current-task (make-parameter #f)) ; its text and its conditions

(define (task-text) (car (current-task)))

(define (task-seconds)
  "Return how long the task has been going on, s."
  (task-time))

(define (task-targets)
  "Return where the task that is going on leads, a list of (NAME . POINT), as far as that is known now."
  (filter-map (lambda (entry)
                (let ((p (false-if-exception ((second entry)))))
                  (and p (cons (first entry) p))))
              (all-of 'target (cdr (current-task)))))

(define (task-counters)
  "Return what is counted in the lesson, an alist from names to how often."
  (append (map (lambda (entry) (cons (car entry) (counter (car entry)))) (plan-counts (current-plan)))
          (filter (lambda (entry) (positive? (cdr entry)))
                  `((hints . ,(tally-ref 'hints-given 0)) (back . ,(tally-ref 'rewinds 0))))))

(define (task-gauges)
  "Return what the lesson lets a pupil read besides the usual figures, an alist from names to numbers or strings."
  (filter-map (lambda (entry)
                (let ((value (false-if-exception ((cdr entry)))))
                  (and value (cons (car entry) value))))
              (plan-gauges (current-plan))))

(define (begin-task! conditions)
  (tally-set! 'task-begun (now))
  (tally-set! 'hints-left (all-of 'hint conditions))
  (tally-set! 'faults-left (append (map (lambda (f) (cons 'after f)) (all-of 'fault-after conditions))
                                   (map (lambda (f) (cons 'when f)) (all-of 'fault-when conditions))))
  (tally-set! 'done-since #f)
  (for-each (lambda (thunk) ((car thunk))) (all-of 'first conditions)))

(define (give-hint! hint)
  (tally-set! 'hints-left (delq hint (tally-ref 'hints-left '())))
  (tally-set! 'hints-given (+ 1 (tally-ref 'hints-given 0)))
  (say-as 'hint (string-join (if (at-keys?) (list (second hint)) (cdr hint)) "  ")))

(define (next-hint!)
  "Give the next hint of the task that is going on; return #f when there is none left."
  (let ((left (tally-ref 'hints-left '())))
    (and (pair? left)
         (begin (give-hint! (car left)) #t))))

(define (ask-for-hint!)
  "As `next-hint!', but count that it was asked for."
  (count! 'hints-asked)
  (next-hint!))

(define (hints-due!)
  (unless (eq? 'hard (session-level (this-session 'task)))
    (let ((due (find (lambda (h) (>= (task-time) (first h))) (tally-ref 'hints-left '()))))
      (when due (give-hint! due)))))

(define (fault-due? fault)
  (if (eq? 'after (car fault))
      (>= (task-time) (second fault))
      ((second fault))))

(define (faults-due!)
  (for-each (lambda (fault)
              (when (fault-due? fault)
                (tally-set! 'faults-left (delq fault (tally-ref 'faults-left)))
                (say-as 'fault (third fault))
                ((fourth fault))))
            (tally-ref 'faults-left '())))

(define (done-for? seconds done?)
  ;; Whether DONE? has been true for SECONDS.
  (let ((since (tally-ref 'done-since)))
    (cond ((not (done?)) (when since (tally-set! 'done-since #f)) #f)
          (since (>= (- (now) since) seconds))
          ((zero? seconds) #t)
          (else (tally-set! 'done-since (now)) #f))))

(define (failure-now conditions)
  ;; The text of the first fail-when that is true now, or #f.
  (any (lambda (f) (and ((first f)) (second f))) (all-of 'fail conditions)))

(define (coach!)
  (let ((coach (session-coach (this-session 'task))))
    (when (and coach (due? 1))
      (let ((words (coach-looks! coach)))
        (when words (say-as 'coach words))))))

(define (look-around conditions finish)
  ;; Called after each step of a task.
  (when (due? sample-time)
    (note-way!)
    (sample-rows! (plan-rows (current-plan)))
    (tick-counters! (plan-counts (current-plan))))
  (when (due? 1)
    ((breathing) #t))
  (when (due? point-time)
    (save-point!))
  (when (due? look-time)
    (coach!)
    (faults-due!)
    (hints-due!)
    (let ((done? (one-of 'done conditions (const #f)))
          (failed (failure-now conditions)))
      (cond (failed (finish (list 'failed failed)))
            ((done-for? (one-of 'held conditions 0) done?) (finish '(done)))
            ((>= (task-time) (one-of 'at-most conditions 600)) (finish '(late)))))))

(define (call-watched look thunk)
  (let ((dive (current-dive)))
    (dynamic-wind
      (lambda () (parameterize ((current-dive dive)) (add-step-watcher! look)))
      thunk
      (lambda () (parameterize ((current-dive dive)) (remove-step-watcher! look))))))

(define (with-tender thunk)
  (let ((tender (plan-tender (current-plan))))
    (if tender (call-with-pilot tender thunk) (thunk))))

(define (fly conditions)
  ;; Let time pass until the task is over: (done), (failed TEXT) or (late).
  (call/ec
   (lambda (finish)
     (call-watched
      (lambda () (look-around conditions finish))
      (lambda ()
        (with-tender
         (lambda ()
           ((guide-fly (this-guide)) (tally-ref 'tasks) (one-of 'at-most conditions 600))))))
     '(late))))


(define (task-mark n outcome)
  (case (car outcome)
    ((done) (make-mark (simple-format #f "task ~a" n) 1 2 #t
                       (string-append "done in " (figure (task-time)) " s")))
    ((failed) (make-mark (simple-format #f "task ~a" n) 0 2 #f (second outcome)))
    (else (make-mark (simple-format #f "task ~a" n) 0 2 #f "not done in time"))))

(define (finish-task! n outcome)
  (add-mark! (task-mark n outcome))
  (if (eq? 'done (car outcome))
      (say-as 'done "Done.")
      ((session-stop (this-session 'task)) (car outcome))))

(define (what-went-wrong outcome)
  (if (eq? 'failed (car outcome)) (second outcome) "Time is up."))

(define (attempt! n conditions)
  ;; Fly the Nth task until it is done, or given up.
  (let ((outcome (fly conditions)))
    (if (eq? 'done (car outcome))
        (finish-task! n outcome)
        (begin
          (say-as 'failed (what-went-wrong outcome))
          (case ((guide-failed (this-guide)) (what-went-wrong outcome))
            ((back) (go-back! 10) (attempt! n conditions))
            ((again) (go-back! +inf.0) (attempt! n conditions))
            (else (finish-task! n outcome)))))))

;; A task as it was set: its text and conditions, and how everything stood then, so that it can be flown again.
(define-record <task-set>
  (make-task-set dive time task checkpoint tally)
  task-set?
  (dive task-set-dive)
  (time task-set-time)
  (task task-set-task)                  ; (TEXT . CONDITIONS)
  (checkpoint task-set-checkpoint)
  (tally task-set-tally))

(define (note-task!)
  ;; Tasks are noted in the tally, the last first.
  (tally-set! 'set (cons (make-task-set (current-dive) (now) (current-task) (checkpoint) (tally)) (tally-ref 'set '()))))

(define (fly-again set)
  "Let the task SET be flown by the guide of this session until it is over, in a dive that stands where it began.  Return
how it ended: (done), (failed TEXT) or (late)."
  (restore-tally! (task-set-tally set))
  (parameterize ((current-task (task-set-task set)))
    (fly (cdr (task-set-task set)))))

(define longest-task 36000)             ; s

(define (check-seconds conditions)
  (for-each (lambda (entry)
              (unless (and (real? (car entry)) (<= 0 (car entry)) (<= (car entry) longest-task))
                (bight-raise 'domain 'task "a time in a task is from 0 to ~a s, not ~s" longest-task
                             (car entry))))
            (append-map (lambda (kind) (all-of kind conditions)) '(at-most held hint fault-after))))

(define (run-task text . conditions)
  "Set the task TEXT, and let time pass until one of CONDITIONS ends it."
  (unless (current-dive)
    (bight-raise 'def 'task "there is no dive yet: say (in WORLD) before the first task"))
  (let ((n (+ 1 (tally-ref 'tasks 0))))
    (check-seconds conditions)
    (tally-set! 'tasks n)
    (say-as 'task text)
    (begin-task! conditions)
    (parameterize ((current-task (cons text conditions))
                   (recent-points (and (guide-hears-hints? (this-guide)) (make-variable '()))))
      (save-point!)
      (note-task!)
      (attempt! n conditions))))
