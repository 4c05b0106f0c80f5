;;; (bight lesson play) --- what the clauses of a lesson do when their turn comes.
;;;
;;; Whoever takes the lesson, a person at a terminal, a scripted pilot or a test, stands behind a guide:
;;; a handful of procedures that show, ask, and let time pass.  A task watches the dive from between its
;;; steps, and leaves by an escape as soon as it is done, failed or given up; nothing here looks at the
;;; machine's clock.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(define-module (bight lesson play)
  #:use-module (bight cockpit coach)
  #:use-module (bight core errors)
  #:use-module (bight core record)
  #:use-module (bight core verb)
  #:use-module (bight dive)
  #:use-module (bight dive checkpoint)
  #:use-module (bight dive pilot)
  #:use-module (bight dive task)
  #:use-module (bight dive time)
  #:use-module (bight lesson lost)
  #:use-module (bight lesson points)
  #:use-module (bight lesson score)
  #:use-module (bight lesson tally)
  #:use-module (bight lesson way)
  #:use-module ((bight view) #:select (look))
  #:use-module ((ice-9 control) #:select (call/ec))
  #:use-module (srfi srfi-1)
  #:export (make-guide guide? plan? guide-hears-hints?
            call-with-plan plan-rows plan-counts plan-tender
            begin-dive! say-as say-text show-picture put-probe last-answer run-task watch-fork repeat-steps
            task-set? task-set-dive task-set-time task-set-checkpoint fly-again
            untrusted? breathing
            ;; For guides.
            asked-in-degrees?
            task-text task-targets task-counters task-seconds next-hint! ask-for-hint!))

(define-record <guide>
  (make-guide say picture probe fly failed hears-hints?)
  guide?
  (say guide-say)                       ; (SAY KIND TEXT)
  (picture guide-picture)               ; (PICTURE THUNK): show what THUNK returns
  (probe guide-probe)                   ; (PROBE QUESTION TRUTH CHOICES): the answer, a number or symbol
  (fly guide-fly)                       ; (FLY N SECONDS): let time pass in the Nth task, SECONDS at most
  (failed guide-failed)                 ; (FAILED TEXT): again, back or end
  (hears-hints? guide-hears-hints?))    ; whether points to go back to are kept, too

(define (this-guide)
  (session-guide (this-session 'lesson)))

(define (say-as kind text)
  "Say TEXT to the pupil, and log it as being of KIND: say, hint, coach, fault, message and so on."
  (log-line! kind text)
  ((guide-say (this-guide)) kind text))


;;; What a lesson declares for all of its tasks.

(define-record <plan>
  (make-plan rows counts tender)
  plan?
  (rows plan-rows)                      ; of the score
  (counts plan-counts)                  ; an alist from name to thunk
  (tender plan-tender))                 ; a pilot or #f

(define current-plan (make-parameter #f))

(define (call-with-plan rows counts tender thunk)
  "Call THUNK, the steps of a lesson that is scored by ROWS, counts COUNTS and has a TENDER or #f."
  (parameterize ((current-plan (make-plan rows counts tender)))
    (thunk)))

;;; The plain clauses.

;; Called with #t when the dive goes on, and with #f before waiting for the pupil: who limits processor time
;; grants more.
(define breathing (make-parameter noop))

;; True in a process that runs what came from outside: then worlds are named, not read from files.
(define untrusted? (make-parameter #f))

(define (begin-dive! world)
  "Enter WORLD, as the clause (in WORLD) says."
  (cond ((not world) (bight-raise 'domain 'in "a lesson takes place in a world, not in #f"))
        ((and (untrusted?) (string? world))
         (bight-raise 'domain 'in "a lesson from outside names a world or defines one; it does not read ~s"
                      world)))
  (enter! world)
  (tally-set! 'dives (+ 1 (tally-ref 'dives 0))))

(define (filled text values)
  (if (null? values)
      text
      (apply simple-format #f text
             (map (lambda (v) (if (and (real? v) (not (exact-integer? v))) (figure v) v)) values))))

(define (say-text text values)
  "Say TEXT, in which each ~a stands for one of VALUES."
  (say-as 'say (filled text values)))

(define (show-picture thunk)
  "Show what THUNK returns, or, when it is #f, the dive."
  (show-allowed (or thunk look)))

(define (show-allowed thunk)
  ;; The picture that THUNK returns, for a pupil who may see one.
  (if (eq? 'none (display-allowed))
      (say-as 'say "(Here others see a picture.  You fly without.)")
      ((guide-picture (this-guide)) thunk)))

(define (watch-fork text thunk)
  "Say TEXT, call THUNK on a fork of the dive, and show what became of it; the dive is as before."
  (say-as 'say text)
  (let ((seen (what-if-thunk (lambda () (thunk) (look)))))
    (show-allowed (lambda () seen))))

(define (repeat-steps n thunk)
  (do ((i 0 (+ i 1))) ((>= i n)) (thunk)))


;;; Probes.

(define (compass-error answer truth)
  (let ((d (- answer truth)))
    (abs (- d (* 360 (round (/ d 360)))))))

(define (probe-credit answer truth within degrees?)
  ;; Nothing is left of the mark 3.6 times as far off as is allowed: 90 degrees for 25.
  (let ((off (if degrees? (compass-error answer truth) (abs (- answer truth)))))
    (max 0 (- 1 (/ off (* 3.6 within))))))

(define (probe-mark label answer truth choices within degrees?)
  (if choices
      (let ((right? (equal? answer truth)))
        (make-mark label (if right? 1 0) 1 right?
                   (simple-format #f "said ~a, it was ~a" answer truth)))
      (let ((credit (probe-credit answer truth within degrees?))
            (off (if degrees? (compass-error answer truth) (abs (- answer truth)))))
        (make-mark label credit 1 (<= off within)
                   (simple-format #f "said ~a, it was ~a; asked within ~a"
                                  (figure answer) (figure truth) (figure within))))))

(define (checked-truth truth choices)
  (cond ((and choices (not (member truth choices)))
         (bight-raise 'domain 'probe "the truth must be one of ~a, not ~s" choices truth))
        ((and (not choices) (not (real? truth)))
         (bight-raise 'domain 'probe "the truth of a probe without #:choices is a number, not ~s" truth))
        (else truth)))

(define (check-tolerance what value)
  ;; Within nothing no answer could be right.
  (unless (or (not value) (and (real? value) (finite? value) (positive? value)))
    (bight-raise 'domain 'probe "~a of a probe is a number above 0, how near an answer must come, not ~s; \
for one right answer of several say #:choices (A B ...)" what value)))

;; True while a probe is asked whose answer is a bearing.
(define asked-in-degrees? (make-parameter #f))

(define* (put-probe question truth bearing? #:key (within (if bearing? 25 #f)) choices (degrees bearing?)
                    ratio answer)
  "Ask QUESTION, whose answer TRUTH, a thunk, knows: within WITHIN, or by RATIO of the truth, or one of
CHOICES.  BEARING? says that the truth is a bearing unless DEGREES says otherwise.  ANSWER, if given, is
what somebody else than the pupil says, who is asked in his place."
  (check-tolerance "#:within" within)
  (check-tolerance "#:ratio" ratio)
  (let* ((n (+ 1 (tally-ref 'probes 0)))
         (truth (checked-truth (truth) choices))
         (within (cond (choices #f) (ratio (max 1e-9 (abs (* ratio truth)))) (else (or within 1)))))
    (tally-set! 'probes n)
    (log-line! 'probe question)
    (let* ((answer (or answer
                       (parameterize ((asked-in-degrees? (and degrees (not choices))))
                         ((guide-probe (this-guide)) question truth choices))))
           (mark (probe-mark (simple-format #f "probe ~a" n) answer truth choices within degrees)))
      (add-mark! mark)
      (tally-set! 'answer answer)
      (say-as (if (mark-passed? mark) 'right 'wrong) (mark-detail mark)))))


(define-verb (last-answer)
  "Return the answer to the last probe of the lesson, a number or a symbol, or #f: for (branch ...)."
  (tally-ref 'answer))


;;; Tasks.  CONDITIONS are lists: (done THUNK) (fail THUNK TEXT) (hint SECONDS TEXT) (at-most SECONDS)
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
  (say-as 'hint (second hint)))

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
