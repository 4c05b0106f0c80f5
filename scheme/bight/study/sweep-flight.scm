;;; (bight study sweep-flight) --- the flight of the cases of a study in processes of their own, and what came of each.
;;;
;;; The processes are those of (bight core crew).  One flies one case, or as many in turn as the study lets fly
;;; `together', and tells what came of each; of the first of which it tells nothing, how it ended says so, and those
;;; after that are flown by another.  A process that was ended by a signal which comes from outside, as SIGKILL does when
;;; memory is short, says nothing about its case: that is `interrupted', and what becomes of the case is for the sweep to
;;; decide.
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


;;; The process of some cases.

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

(define (limit-time! seconds)
  ;; SIGPROF ends this process when it has had SECONDS of processor time from now on.
  (let ((whole (inexact->exact (floor seconds))))
    (setitimer ITIMER_PROF 0 0 whole (inexact->exact (floor (* 1000000 (- seconds whole)))))))

(define (flyer-of study)
  ;; What `open-shops' loads: STUDY is here already.
  (lambda (file tell)
    (tell '(ready))
    (lambda (numbers tell)
      (quiet!)
      (for-each (lambda (number)
                  (limit-time! (study-limit study))
                  (tell (cons* 'outcome number (case-outcome study number))))
                numbers))))


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

(define (orders-of study numbers jobs)
  ;; The cases NUMBERS of STUDY in orders for JOBS processes, none of which is to be idle.
  (let ((size (min (study-together study) (max 1 (quotient (length numbers) jobs)))))
    (let loop ((rest numbers) (orders '()))
      (if (null? rest)
          (reverse orders)
          (let ((n (min size (length rest))))
            (loop (drop rest n) (cons (list 'study (take rest n)) orders)))))))

(define (fly-cases crew study numbers jobs settle! stop?)
  "Let CREW, of JOBS processes, fly the cases NUMBERS, from 0, of STUDY, and call SETTLE! with the number and the
outcome, an alist, of each that ends before STOP?, a procedure without arguments, returns true."
  (let ((settled (make-hash-table)) (left '()))
    (define (settle-once! number outcome)
      (hashv-set! settled number #t)
      (settle! number outcome))
    (do-orders crew (orders-of study numbers jobs)
      (lambda (order told)
        (case (first told)
          ((outcome) (settle-once! (second told) (cddr told)))
          ((closed)
           (bight-raise 'io 'sweep "all processes that had read the study are gone; start it again and it goes on"))
          (else
           (let ((untold (remove (lambda (number) (hashv-ref settled number)) (second order))))
             (unless (null? untold)
               (settle-once! (car untold) (verdict study told))
               (set! left (append (cdr untold) left)))))))
      #:stop? stop?)
    (unless (or (null? left) (stop?))
      (fly-cases crew study (sort left <) jobs settle! stop?))))
