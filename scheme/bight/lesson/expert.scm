;;; (bight lesson expert) --- what would have been right: a task flown again, by the lesson's expert, from where the pupil
;;; began it.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(define-module (bight lesson expert)
  #:use-module ((bight core signature) #:select (own-subjects))
  #:use-module (bight dive)
  #:use-module (bight dive checkpoint)
  #:use-module ((bight dive past) #:select (new-past))
  #:use-module (bight dive reel)
  #:use-module (bight dive task)
  #:use-module (bight engine)
  #:use-module (bight lesson task)
  #:use-module (bight lesson)
  #:use-module (bight lesson report)
  #:use-module (bight lesson shelf)
  #:use-module (bight lesson tally)
  #:use-module (srfi srfi-1)
  #:export (task-at expert-flight))

(define (task-at report dive time)
  "Return the task of REPORT, as `task-set' has it, that was going on in DIVE at TIME, s, or #f."
  (find (lambda (set) (and (eq? dive (task-set-dive set)) (<= (task-set-time set) time)))
        (report-tasks report)))

(define (expert-of lesson)
  (find (lambda (name) (memq name (lesson-pilots lesson))) '(expert demonstration)))

(define (begin-past!)
  ;; What is kept of the present dive begins now.
  (set-dive-past! (current-dive) (new-past (engine-of (current-dive)) '())))

(define (call-for-a-while limit thunk)
  ;; Call THUNK, but leave it when LIMIT, a thunk, returns true after some step.
  (let ((enough (make-prompt-tag 'enough)))
    (call-with-prompt enough
      (lambda ()
        (let ((watch (lambda () (when (limit) (abort-to-prompt enough)))))
          (dynamic-wind (lambda () (add-step-watcher! watch)) thunk (lambda () (remove-step-watcher! watch)))))
      (const #f))))

(define* (expert-flight report set #:key (limit (const #f)))
  "Let the lesson's expert fly SET, a task of REPORT, from where the pupil began it, until it is over or LIMIT, a thunk,
returns true.  Return a pair: that flight, a reel, and how the task ended, as `fly-again' returns it, or #f; or return #f
if the lesson has no expert."
  (let* ((lesson (report-lesson report)) (name (expert-of lesson)))
    (and name
         (parameterize ((current-dive (task-set-dive set)))
           (what-if-thunk
            (lambda ()
              (restore! (task-set-checkpoint set))
              (begin-past!)
              (parameterize ((own-subjects (concatenate (declared 'yours lesson))))
                (call-in-session lesson (scripted-guide (pilot-named lesson name)) (report-seed report)
                                 (report-level report)
                                 (lambda ()
                                   (let ((outcome (call-for-a-while limit (lambda () (fly-again set)))))
                                     (cons (flight-reel (current-dive)) outcome)))))))))))
