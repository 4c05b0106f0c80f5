;;; (bight study sweep-flight) --- the flight of one case of a study, in a process of its own, and what came of it.
;;;
;;; The processes are those of (bight core crew).  That of a case tells what came of it; when it tells nothing, how it
;;; ended says so.  A process that was ended by a signal which comes from outside, as SIGKILL does when memory is
;;; short, says nothing about its case: that is `interrupted', and what becomes of the case is for the sweep to decide.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(define-module (bight study sweep-flight)
  #:use-module (bight core crew)
  #:use-module (bight core errors)
  #:use-module ((bight core here) #:select (noting-places))
  #:use-module (bight study case)
  #:use-module ((bight core told) #:select (chain-suffix exception->line raised-at raised-kind))
  #:use-module (srfi srfi-1)
  #:export (call-with-flyers
            fly-cases
            interrupted?))


;;; The process of a case.

(define (place->text place)
  ;; Without its folder, which another machine has elsewhere.
  (if place (simple-format #f "~a:~a: " (basename (car place)) (cdr place)) ""))

(define (failure e)
  (list (cons 'status "failed")
        (cons 'error (object->string (raised-kind e) display))
        (cons 'message (string-append (place->text (raised-at e)) (exception->line e) (chain-suffix e)))))

(define (case-outcome study number)
  ;; What comes of the case NUMBER, from 0, of STUDY: an alist of status, cpu and hash, measures, legs, or error and
  ;; message.
  (let* ((begun (get-internal-run-time))
         (outcome
          (with-exception-handler failure
            (lambda ()
              (let ((found (noting-places (lambda () (fly-case study number)))))
                (list '(status . "done")
                      (cons 'hash (object->string (third found) display))
                      (cons 'measures (first found))
                      (cons 'legs (second found)))))
            #:unwind? #t)))
    (acons 'cpu (/ (- (get-internal-run-time) begun) (exact->inexact internal-time-units-per-second))
           outcome)))

(define (quiet!)
  ;; What a study prints would stand between the cases; what it complains about is worth seeing.
  (let ((nowhere (open-file "/dev/null" "w")))
    (set-current-output-port nowhere)
    (dup2 (fileno nowhere) 1)))

(define (flyer-of study)
  ;; What `open-shops' loads: STUDY is here already.
  (lambda (file tell)
    (tell '(ready))
    (lambda (number tell)
      (quiet!)
      (let ((limit (study-limit study)))
        (setitimer ITIMER_PROF 0 0 (inexact->exact (floor limit))
                   (inexact->exact (floor (* 1000000 (- limit (floor limit)))))))
      (tell (cons 'outcome (case-outcome study number))))))


;;; What came of it.

(define patience 10)                    ; seconds of waiting allowed for each of processor time

(define (timed-out study)
  `((status . "timed out") (error . "limit")
    (message . ,(simple-format #f "it took more than (at-most ~a) seconds of processor time"
                               (study-limit study)))))

(define (broken-down how)
  `((status . "failed") (error . "crash") (message . ,(string-append "the dive's process " how))))

(define own-signals
  ;; Those that a process is ended by for what it did itself.  All others come from outside.
  (list SIGABRT SIGBUS SIGFPE SIGILL SIGSEGV SIGSYS SIGTRAP SIGPIPE SIGALRM SIGVTALRM))

(define (interrupted how)
  ;; The outcome of a case whose process was ended from outside; HOW says by what.
  `((status . "failed") (error . "interrupted")
    (message . ,(string-append "the dive's process was ended from outside, " how))))

(define (interrupted? outcome)
  "Return #t if OUTCOME says no more than that the case was ended from outside."
  (equal? "interrupted" (assq-ref outcome 'error)))

(define (signal->string signal)
  (if (= signal SIGKILL)
      (simple-format #f "by signal ~a, as when memory is short" signal)
      (simple-format #f "by signal ~a" signal)))

(define (verdict study ended)
  ;; What came of a case whose process told nothing and ENDED so: (ended EXIT SIGNAL), (late) or (orphaned).
  (let ((signal (and (eq? 'ended (first ended)) (third ended))))
    (cond ((eq? 'orphaned (first ended)) (interrupted "with the one that had read the study"))
          ((or (eq? 'late (first ended)) (eqv? signal SIGPROF)) (timed-out study))
          ((not signal) (broken-down (simple-format #f "ended with status ~a" (second ended))))
          ((memv signal own-signals) (broken-down (simple-format #f "was ended by signal ~a" signal)))
          (else (interrupted (signal->string signal))))))


;;; All of them.

(define (call-with-flyers study n receive)
  "Call RECEIVE with a crew, for `fly-cases', that flies N cases of STUDY at a time.  Neither was `sigaction' called in
this process before, nor is a database open."
  (call-with-crew n (* patience (+ 1 (study-limit study)))
    (lambda (crew)
      (open-shops crew (make-list n 'study) (flyer-of study))
      (receive crew))))

(define (fly-cases crew study numbers settle! stop?)
  "Let CREW fly the cases NUMBERS, from 0, of STUDY, and call SETTLE! with the number and the outcome, an alist, of
each that ends before STOP?, a procedure without arguments, returns true."
  (let ((outcomes (make-hash-table)))
    (do-orders crew (map (lambda (number) (list 'study number)) numbers)
      (lambda (order told)
        (let ((number (second order)))
          (case (first told)
            ((outcome) (hashv-set! outcomes number (cdr told)))
            ((closed)
             (bight-raise 'io 'sweep "all processes that had read the study are gone; start it again and it goes on"))
            (else
             (settle! number (or (hashv-ref outcomes number) (verdict study told)))
             (hashv-remove! outcomes number)))))
      #:stop? stop?)))
