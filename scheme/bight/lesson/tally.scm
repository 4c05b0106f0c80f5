;;; (bight lesson tally) --- what a running lesson remembers.
;;;
;;; A session is one pupil's way through a lesson.  All that time changes in it is in its tally, an
;;; association list that is never changed in place: with a checkpoint of the dive it is the whole state
;;; of the lesson, so that a rewind is exact.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(define-module (bight lesson tally)
  #:use-module (bight core errors)
  #:use-module (bight core record)
  #:use-module (bight core verb)
  #:use-module (bight dive)
  #:use-module (bight dive time)
  #:use-module (srfi srfi-1)
  #:export (make-session
            session?
            current-session
            this-session
            session-settings
            session-level
            session-guide
            session-stop
            session-coach
            session-log
            session-limits
            tally tally-ref tally-set! restore-tally!
            log-line!
            time-or-0
            tick-counters!
            levels
            displays display-allowed
            ;; The language of lessons.
            counter count! setting jitter))

(define levels '(easy normal hard))

;; What of its views a lesson may show: all, the view from above alone, none.
(define displays '(three plan none))

(define (display-allowed)
  "Return what of its views the lesson that is going on may show: three, plan or none."
  (or (assq-ref (session-limits (this-session 'lesson)) 'display) 'three))

(define-record <session>
  (%make-session settings level guide coach stop limits tally log)
  session?
  (settings session-settings)           ; an alist from name to a list of values, one for each level
  (level session-level)                 ; one of `levels'
  (guide session-guide)
  (coach session-coach)                 ; or #f
  (stop session-stop)                   ; ends the lesson, called with why
  (limits session-limits)               ; an alist: messages, how many; hidden, verbs; display
  (tally session-tally set-session-tally!)
  (log session-log set-session-log!))   ; (TIME KIND TEXT), the last first

(define* (make-session settings level guide coach stop seed #:optional (limits '()))
  "Return a session that has only begun; SEED is a whole number that its random numbers come from.  LIMITS
is an alist: `messages', how many the pilot may send, `hidden', the verbs that the pupil has not, and
`display', which views he sees."
  (%make-session settings level guide coach stop limits `((random . ,(scramble seed))) '()))

(define current-session (make-parameter #f))

(define (this-session proc)
  "Return the session that is going on, or raise a &bight-error from PROC."
  (or (current-session)
      (bight-raise 'def proc "this belongs to a lesson, and none is going on")))


;;; The tally.

(define (tally) (session-tally (this-session 'lesson)))

(define* (tally-ref key #:optional (default #f))
  "Return what the tally has under KEY, or DEFAULT."
  (let ((entry (assq key (tally))))
    (if entry (cdr entry) default)))

(define (tally-set! key value)
  "Let the tally have VALUE under KEY."
  (set-session-tally! (this-session 'lesson)
                      (acons key value (alist-delete key (tally) eq?))))

(define (restore-tally! old)
  "Go back to the tally OLD."
  (set-session-tally! (this-session 'lesson) old))

(define (time-or-0)
  (if (current-dive) (now) 0.0))

(define (log-line! kind text)
  "Note in the log of the session that TEXT, of KIND, was said now."
  (let ((s (this-session 'lesson)))
    (set-session-log! s (cons (list (time-or-0) kind text) (session-log s)))))


;;; Random numbers: the same for the same seed on every machine.

(define modulus (- (expt 2 31) 1))

(define (next-random state)
  (modulo (* 48271 state) modulus))

(define (scramble seed)
  ;; A state from a small whole number: neighbours must not give neighbours.
  (let loop ((state (+ 1 (modulo (+ (* 7919 seed) 104729) (- modulus 1)))) (n 8))
    (if (zero? n) state (loop (next-random state) (- n 1)))))

(define-verb (jitter (most non-negative))
  "Return a number between -MOST and MOST, random but the same each time for the seed of the lesson.
Outside a lesson it is 0."
  (if (current-session)
      (let ((state (next-random (tally-ref 'random))))
        (tally-set! 'random state)
        (* most (- (* 2 (/ (exact->inexact state) modulus)) 1)))
      0.0))


;;; Counters.

(define-verb (counter (name name))
  "Return how far the counter NAME of the lesson has come: 0 at first."
  (or (assq-ref (tally-ref 'counters '()) name) 0))

(define-verb (count! (name name) #:optional (n number 1))
  "Add N to the counter NAME of the lesson, and return it."
  (let ((new (+ n (counter name))))
    (tally-set! 'counters (acons name new (alist-delete name (tally-ref 'counters '()) eq?)))
    new))

(define (tick-counters! counts)
  "Add one to each counter of COUNTS, an alist from name to thunk, whose thunk has begun to be true."
  (let ((before (tally-ref 'edges '())))
    (tally-set! 'edges
                (map (lambda (entry)
                       (let ((true? (and ((cdr entry)) #t)))
                         (when (and true? (not (assq-ref before (car entry))))
                           (count! (car entry)))
                         (cons (car entry) true?)))
                     counts))))


;;; Difficulty.

(define-verb (setting (name name))
  "Return the value of the setting NAME of the lesson at the difficulty chosen."
  (let* ((s (this-session 'setting))
         (values (assq-ref (session-settings s) name)))
    (unless values
      (unknown-name 'setting "this lesson" name (map car (session-settings s)) "setting"))
    (list-ref values (list-index (lambda (l) (eq? l (session-level s))) levels))))
