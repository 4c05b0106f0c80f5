;;; (bight follow belief) --- a belief that goes by what a real vehicle tells, and is alarmed by probability.
;;;
;;; The dive's vehicle goes where the real one was and its winch turns as the real counter says, and so do those of the
;;; belief's members: positions and payouts drive them, and are no evidence.  The tension at the winch is.  All of it
;;; follows from what came and in which order, so that a log followed again gives the same bits.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(define-module (bight follow belief)
  #:use-module (bight belief)
  #:use-module (bight belief answer)
  #:use-module (bight belief clauses)
  #:use-module (bight belief level)
  #:use-module (bight belief unknowns)
  #:use-module (bight core errors)
  #:use-module (bight core record)
  #:use-module (bight dive)
  #:use-module ((bight dive aware) #:select (fouled?))
  #:use-module (bight dive in-words)
  #:use-module (bight telemetry reading)
  #:use-module (bight world)
  #:use-module (srfi srfi-1)
  #:export (make-watch watch? watch-begins! watch-sees! watch-alarms! watch-line watch-hash))

(define-record <watch>
  (%make-watch clauses members noise tether belief end level last taken impossible)
  watch?
  (clauses watch-clauses)
  (members watch-members)
  (noise watch-noise)                   ; N, of the tension
  (tether watch-tether)                 ; a name
  (belief watch-belief set-watch-belief!) ; or #f: the dive has not begun, or the belief has ended
  (end watch-end set-watch-end!)        ; why it ended, a string, or #f
  (level watch-level set-watch-level!)  ; that was told last, as (bight belief level) counts
  (last watch-last set-watch-last!)     ; the probability when it was asked last
  (taken watch-taken set-watch-taken!)
  (impossible watch-impossible set-watch-impossible!))


;;; What is uncertain.

(define (check-clauses world clauses)
  ;; An error in them is told before anything comes.
  (parameterize ((current-dive #f))
    (enter! world)
    (read-unknowns clauses)))

(define (make-watch world tether text members noise)
  "Return what will carry a belief of MEMBERS tethers in a dive in WORLD, of what TEXT, clauses or the name of a file of
them, says is uncertain.  TETHER, a name or #f, is the one whose tension is told, and NOISE the standard deviation of
that, N.  Raise a &bight-error where TEXT does not fit the world."
  (let ((clauses (clauses-from 'follow text)))
    (unless tether
      (bight-raise 'def 'follow "the vehicle of this world has no tether to believe anything of"))
    (check-clauses world clauses)
    (%make-watch clauses members noise tether #f #f 0 0.0 0 0)))

(define (watch-begins! watch)
  "Let the belief of WATCH begin in the current dive, and be the current one."
  (set-watch-belief! watch (make-belief (current-dive) (watch-clauses watch) #:members (watch-members watch)))
  (current-belief (watch-belief watch)))

(define (unless-ended watch otherwise thunk)
  ;; What THUNK returns; OTHERWISE where the belief cannot go on: its dive does.
  (with-exception-handler
      (lambda (e)
        (unless (bight-error? e) (raise-exception e))
        (set-watch-belief! watch #f)
        (current-belief #f)
        (set-watch-end! watch (bight-error-message e))
        otherwise)
    thunk
    #:unwind? #t))


;;; Readings.

(define (watch-sees! watch reading time)
  "Let the belief of WATCH go by READING, read at TIME of the dive, if it is evidence of anything."
  (when (and (watch-belief watch) (eq? 'tension (reading-quantity reading)))
    (case (unless-ended watch 'ended
            (lambda () (observe! (watch-belief watch) 'winch-tension (reading-value reading)
                                 #:at time #:noise (watch-noise watch) #:tether (watch-tether watch))))
      ((taken) (set-watch-taken! watch (+ 1 (watch-taken watch))))
      ((impossible) (set-watch-impossible! watch (+ 1 (watch-impossible watch)))))))


;;; Alarms.

(define (fouled-now watch)
  (answer-probability (ask-belief (watch-belief watch) (lambda () (fouled? (watch-tether watch))))))

(define (way-back watch)
  ;; The way home in words, where there is one.
  (with-exception-handler
      (lambda (e) (if (bight-error? e) "" (raise-exception e)))
    (lambda () (string-append "; go back.  " (in-words (watch-tether watch) 'way-home)))
    #:unwind? #t))

(define (watch-alarms! watch)
  "Return what is to be said of the belief of WATCH, as it should be asked once a second of the dive: strings."
  (if (watch-belief watch)
      (let ((p (unless-ended watch #f (lambda () (fouled-now watch)))))
        (if p (alarms-at! watch p) (list (string-append "BELIEF: it has ended: " (watch-end watch)))))
      '()))

(define (alarms-at! watch p)
  (let* ((before (watch-level watch)) (after (level-after before p)) (said (level-said before after p)))
    (set-watch-last! watch p)
    (set-watch-level! watch after)
    (cond ((not said) '())
          ((> after before) (list (string-append "BELIEF: " said (way-back watch))))
          (else (list (string-append "BELIEF: " said "."))))))


;;; In words.

(define (watch-line watch)
  "Return how the belief of WATCH stands, a string, or #f: it has not begun."
  (and (or (watch-belief watch) (watch-end watch))
       (simple-format #f "belief: ~a tethers, P(wound) ~a, ~a tensions taken, ~a that no tether explains"
                      (watch-members watch) (hundredths (watch-last watch)) (watch-taken watch)
                      (watch-impossible watch))))

(define (watch-hash watch)
  "Return a number that tells the belief of WATCH from any other, or #f: there is none now."
  (and (watch-belief watch) (belief-hash (watch-belief watch))))
