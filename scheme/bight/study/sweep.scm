;;; (bight study sweep) --- all cases of a study, each flown in a process of its own, in one result.
;;;
;;; This process alone writes: it orders the cases one by one and enters what came of each, in a transaction of its
;;; own.  What is in the result when this process dies, however it dies, is whole, and what is not there is flown
;;; when it is started again.  Which case is which does not depend on who flies it: the same study gives the same
;;; result with any number of processes, shards and deaths.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(define-module (bight study sweep)
  #:use-module (bight core errors)
  #:use-module (bight core record)
  #:use-module ((bight engine) #:select (%version))
  #:use-module (bight study case)
  #:use-module (bight study sweep-design)
  #:use-module (bight study sweep-file)
  #:use-module (bight study sweep-flight)
  #:use-module (bight study sweep-plan)
  #:use-module (bight study sweep-result)
  #:use-module (bight study sweep-watch)
  #:use-module (srfi srfi-1)
  #:export (sweep
            plan-of
            shard-size
            tally-of
            tally?
            tally-cases
            tally-done
            tally-failed
            tally-flown
            tally-stopped?
            tally-fingerprint
            tally-first-failure
            merge-shards))


;;; What is to be flown.

(define (plan-of study file shard)
  "Return the plan of STUDY, read from FILE."
  (let ((design (study-design study)))
    (make-plan
     `((name . ,(study-name study))
       (sentence . ,(study-sentence study))
       (file . ,(basename file))
       (text . ,(fingerprint (study-text file)))
       (world . ,(fingerprint (world-text study)))
       (version . ,(%version))
       (variables . ,(design-variables design))
       (spread . ,(design-spread design))
       (measures . ,(study-measures study))
       (legs . ,(study-legs study))
       (cases . ,(design-size design))
       (design . ,(fingerprint (object->string
                                (map (lambda (i) (design-case design i)) (iota (design-size design))))))
       (shard . ,shard)))))

(define (case-key plan values)
  ;; What a case is known by, whatever its number.
  (fingerprint (object->string (list (plan-name plan) (plan-fact plan 'text) values))))

(define (keys-of study plan)
  ;; The keys of all cases, a vector.
  (let ((keys (make-vector (plan-fact plan 'cases))))
    (do ((i 0 (+ i 1)))
        ((= i (vector-length keys)) keys)
      (vector-set! keys i (case-key plan (case-values study i))))))

(define (numbers-of keys)
  ;; A table from keys to numbers, from 1.
  (let ((table (make-hash-table (vector-length keys))))
    (do ((i 0 (+ i 1)))
        ((= i (vector-length keys)) table)
      (when (hash-ref table (vector-ref keys i))
        (bight-raise 'def 'sweep "cases ~a and ~a have the same values: a value is listed twice"
                     (hash-ref table (vector-ref keys i)) (+ i 1)))
      (hash-set! table (vector-ref keys i) (+ i 1)))))

(define (in-shard? shard i)
  ;; Does the case I, from 0, belong to SHARD, (I . N) or #f?
  (or (not shard)
      (= (remainder i (cdr shard)) (- (car shard) 1))))

(define (missing keys known shard)
  ;; The numbers, from 0, of the cases to be flown, in order.
  (filter (lambda (i) (and (in-shard? shard i) (not (hash-ref known (vector-ref keys i)))))
          (iota (vector-length keys))))


;;; Flying them.

(define-record <tally>
  (make-tally cases done failed flown stopped? fingerprint first-failure)
  tally?
  (cases tally-cases)                   ; how many the study, or the shard, has
  (done tally-done)                     ; of those in the result
  (failed tally-failed)                 ; failed or timed out, of those in the result
  (flown tally-flown)                   ; how many were flown now
  (stopped? tally-stopped?)             ; by ^C
  (fingerprint tally-fingerprint)
  (first-failure tally-first-failure))  ; (NUMBER MESSAGE) or #f

;; A case that was ended from outside has no outcome.  It is flown again after all others and by itself, as
;; its process may have been ended for want of memory; at the third end it counts as failed, and the next
;; sweep of the same result flies it again.

(define most-flights 3)

(define (given-up outcome)
  (assq-set! (copy-tree outcome) 'message
             (simple-format #f "~a; so it was ~a times, at last flown by itself; the next sweep tries again"
                            (assq-ref outcome 'message) most-flights)))

(define (settler enter! tell-again)
  "Return a procedure of the number of a case and what came of it, which enters that, and returns #f, or
returns the number of a case that is to be flown again."
  (let ((ends (make-hash-table)))
    (lambda (number outcome)
      (let ((n (if (interrupted? outcome) (+ 1 (hashv-ref ends number 0)) 0)))
        (hashv-set! ends number n)
        (cond ((zero? n) (enter! number outcome) #f)
              ((< n most-flights) (tell-again number outcome) number)
              (else (enter! number (given-up outcome)) #f))))))

(define (fly-all! crew study pending jobs settle!)
  "Let CREW, of JOBS processes, fly the cases PENDING of STUDY, and call SETTLE! with the number and outcome of each, and again those
that it returns, one at a time.  Return #t if it was stopped."
  (let loop ((now pending) (again '()))
    (fly-cases crew study now jobs
               (lambda (number outcome)
                 (let ((left (settle! number outcome)))
                   (when left (set! again (append again (list left))))))
               stop-asked?)
    (cond ((stop-asked?) #t)
          ((null? again) #f)
          (else (loop (list (car again)) (cdr again))))))

(define (first-failure rows)
  ;; (NUMBER MESSAGE) of the first of ROWS that is not done.
  (let ((row (find (lambda (row) (not (equal? "done" (second row)))) rows)))
    (and row (list (first row) (fourth row)))))

(define (shard-size plan shard)
  "Return how many cases of PLAN belong to SHARD, (I . N), or to all for #f."
  (count (lambda (i) (in-shard? shard i)) (iota (plan-fact plan 'cases))))

(define (tally-of database plan shard flown stopped?)
  "Return the tally of what DATABASE, the result of PLAN or of its SHARD, holds; FLOWN of it now."
  (let* ((counts (count-by-status database))
         (done (or (assoc-ref counts "done") 0)))
    (make-tally (shard-size plan shard)
                done
                (- (apply + (map cdr counts)) done)
                flown stopped? (result-fingerprint database plan)
                (first-failure (case-rows database plan)))))

(define (fly-missing! study plan database crew jobs shard again?)
  (let* ((keys (keys-of study plan))
         (flown 0) (failed 0)
         (show (progress-shower)))
    (number-cases! database plan (numbers-of keys))
    (forget-cases! database (if again? 'unfinished 'interrupted))
    (let* ((pending (missing keys (known-keys database) shard))
           (all (length pending)))
      (define (enter! number outcome)
        (add-case! database plan (+ number 1) (vector-ref keys number) (case-values study number) outcome)
        (set! flown (+ flown 1))
        (unless (equal? "done" (assq-ref outcome 'status)) (set! failed (+ failed 1)))
        (show flown all failed))
      (define (tell-again number outcome)
        (show #f)
        (simple-format (current-error-port) "bight: sweep: case ~a: ~a; it is flown again, by itself~%"
                       (+ number 1) (assq-ref outcome 'message))
        (force-output (current-error-port)))
      (show 0 all 0)
      (let ((stopped? (call-with-stop
                       (lambda () (fly-all! crew study pending jobs (settler enter! tell-again))))))
        (show #f)
        (tally-of database plan shard flown stopped?)))))

(define* (sweep file result jobs shard again? #:key (patience 0))
  "Fly the cases of the study in FILE that the file RESULT lacks, JOBS at a time, and return a tally.  SHARD
is (I . N), the I-th of N parts, or #f for all; AGAIN? also flies what failed before.  Another sweep that is
writing RESULT is waited for, PATIENCE seconds at most."
  (let* ((study (load-study file))
         (plan (plan-of study file shard))
         (jobs (max 1 (min jobs (plan-fact plan 'cases)))))
    (force-output (current-output-port))
    (call-with-flyers study jobs
      (lambda (crew)
        (sigaction SIGPIPE SIG_IGN)     ; the process that has read the study may be gone when it is written to
        (let* ((database (open-result result plan #:patience patience))
               (tally (fly-missing! study plan database crew jobs shard again?)))
          (close-result! database)
          tally)))))


;;; Shards.

(define (merge-shards result shards)
  "Put the cases in the files SHARDS into the file RESULT, made if there is none.  Return a tally."
  (let* ((plan (let* ((shard (open-found (car shards)))
                      (plan (found-plan shard)))
                 (close-result! shard)
                 (make-plan (map (lambda (fact) (if (eq? 'shard (car fact)) '(shard . #f) fact))
                                 (plan-facts plan)))))
         (database (open-result result plan))
         (merged (apply + (map (lambda (shard) (merge-result! database result shard)) shards)))
         (tally (tally-of database (found-plan database) #f merged #f)))
    (close-result! database)
    tally))
