;;; (bight lesson guide) --- who takes a lesson, and the plain clauses: what he is told and shown.
;;;
;;; Whoever takes the lesson, a person at a terminal, a scripted pilot or a test, stands behind a guide:
;;; a handful of procedures that show, ask, and let time pass.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(define-module (bight lesson guide)
  #:use-module (bight core decimal)
  #:use-module (bight core errors)
  #:use-module (bight core record)
  #:use-module (bight dive)
  #:use-module (bight dive checkpoint)
  #:use-module (bight lesson tally)
  #:use-module ((bight view) #:select (look))
  #:export (make-guide guide? this-guide guide-probe guide-fly guide-failed guide-hears-hints?
            call-with-plan current-plan plan? plan-rows plan-counts plan-gauges plan-tender
            begin-dive! say-as say-text show-picture watch-fork repeat-steps
            untrusted? breathing at-keys?))

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
  (make-plan rows counts gauges tender)
  plan?
  (rows plan-rows)                      ; of the score
  (counts plan-counts)                  ; an alist from name to thunk
  (gauges plan-gauges)                  ; likewise: what a pupil at the keys reads besides the usual figures
  (tender plan-tender))                 ; a pilot or #f

(define current-plan (make-parameter #f))

(define (call-with-plan rows counts gauges tender thunk)
  "Call THUNK, the steps of a lesson that is scored by ROWS, counts COUNTS, shows GAUGES and has a TENDER or #f."
  (parameterize ((current-plan (make-plan rows counts gauges tender)))
    (thunk)))

;;; The plain clauses.

;; Called with #t when the dive goes on, and with #f before waiting for the pupil: who limits processor time
;; grants more.
(define breathing (make-parameter noop))

;; True for a pupil who flies by keys, who is told nothing of forms to be typed.
(define at-keys? (make-parameter #f))

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
