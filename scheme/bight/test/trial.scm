;;; (bight test trial) --- one run of the body of a scenario: its claims, what it draws by chance, how it ends.
;;;
;;; A trial collects failures and goes on; with each it keeps how the dive stood.  It begins without a dive.
;;; A trial may run others, as a property does its cases; the outermost is the one that a limit stops.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(define-module (bight test trial)
  #:use-module (bight core errors)
  #:use-module ((bight core here) #:select (afresh chain-of noting-places))
  #:use-module ((bight core scratch) #:select (call-with-scratch))
  #:use-module (bight core told)
  #:use-module (bight core verb)
  #:use-module (bight dive)
  #:use-module ((bight dive query) #:select (events))
  #:use-module ((bight dive time) #:select (now))
  #:use-module (bight test expect)
  #:use-module ((ice-9 control) #:select (call/ec))
  #:use-module (srfi srfi-1)
  #:export (run-trial
            reached!
            scene
            flight-keeper
            to-the-millisecond
            stop-whole-trial!
            epilogue
            test-seed
            call-with-seed
            random-state-of
            reseed!))


;;; How the dive stands when a claim fails: its last events, and a drawing.

(define most-events 6)

(define (to-the-millisecond time)
  "Return TIME in seconds, to three decimals."
  (/ (round (* 1000 time)) 1000))

(define (event->string event)
  (simple-format #f "  ~a at ~a s: ~a" (first event) (to-the-millisecond (second event))
                 (string-join (map brief (cddr event)) " ")))

(define (last-events)
  (let ((all (events)))
    (take-right all (min most-events (length all)))))

(define (drawing)
  (string-split (string-trim-right (simple-format #f "~a" ((@ (bight view) look) #:columns 76)))
                #\newline))

(define flight-keeper
  ;; A procedure that keeps how the present dive came to be what it is, and returns a line that says how that is
  ;; watched, or #f; it is called when a claim fails.
  (make-parameter (const #f)))

(define (scene)
  "Return lines that show the present dive, none if there is none."
  (if (current-dive)
      (let ((happened (last-events)) (kept ((flight-keeper))))
        (append (list (simple-format #f "at ~a s~a" (to-the-millisecond (now))
                                     (if (null? happened) "" ", after")))
                (map event->string happened)
                (or (false-if-exception (drawing)) '())
                (if kept (list kept) '())))
      '()))


;;; Chance.

(define current-seed (make-parameter 1))

(define-verb (test-seed)
  "Return the number that random things in scenarios begin with: that of `bight test --seed N', else 1."
  (current-seed))

;; The outermost trial, which an alarm stops.
(define whole-trial (make-parameter #f))

(define (call-with-seed seed thunk)
  "Call THUNK with SEED, a whole number, for that of the tests, and no trial about it."
  (parameterize ((current-seed seed) (whole-trial #f)) (thunk)))

(define (random-state-of . words)
  "Return a random state that depends on the seed of the tests and on WORDS, whatever prints."
  ;; The first numbers of states with seeds that are alike are alike.
  (let ((state (seed->random-state
                (number->string (hash (simple-format #f "~a ~a" (current-seed) words) (expt 2 60))))))
    (do ((i 0 (+ i 1)))
        ((= i 16) state)
      (random 65536 state))))

(define (reseed! label)
  "Let random numbers be those of LABEL, whichever scenarios ran before, and in whichever process."
  (set! *random-state* (random-state-of label)))


;;; Running.

;; The line last reached in the running scenario, for errors that nobody expected.
(define current-location (make-parameter #f))

(define (reached! location)
  "Note that the running trial is at LOCATION now."
  (when (and location (current-location))
    (variable-set! (current-location) location)))

(define (unexpected exception)
  (make-failure '... "no error"
                (string-join (cons (simple-format #f "~a error: ~a" (raised-kind exception) (exception->line exception))
                                   (map frame->line (chain-of exception)))
                             "\n           ")
                (or (raised-at exception) (variable-ref (current-location)))))

(define (call-catching thunk fail)
  ;; Call THUNK; FAIL with the exception it raises, but let (exit) and ^C through.
  (with-exception-handler
      (lambda (exception)
        (if (memq (exception-kind exception) '(quit signal))
            (raise-exception exception)
            (fail exception)))
    (lambda () (afresh (lambda () (noting-places thunk))))
    #:unwind? #t))

(define epilogue
  ;; A procedure that is called in the dive of a scenario after its body, or #f.
  (make-parameter #f))

(define (stop-whole-trial! form expected actual)
  "End the running scenario as failed: FORM, a datum, and EXPECTED and ACTUAL, strings, say why."
  (let ((trial (whole-trial)))
    (when trial
      (parameterize ((current-trial trial))
        (note-failure! (make-failure form expected actual
                                     (and (current-location) (variable-ref (current-location)))
                                     (scene))
                       #:stop? #t)))))

(define (run-trial thunk location)
  "Call THUNK in a trial of its own, beginning at LOCATION, without a dive.  Return its status (pass, fail or
what it was stopped with), the reason, how many claims were judged, and the failures in order."
  (let ((claims 0) (failures '()) (status #f) (reason #f) (leave #f))
    (define (note failure)
      (set! claims (+ claims 1))
      (when failure
        (set! failures
              (cons (if (failure-remarks failure) failure (with-remarks failure (scene)))
                    failures))))
    (define (stop s r)
      (set! status s)
      (set! reason r)
      (leave))
    (define trial (make-trial note stop))
    (parameterize ((current-trial trial)
                   (whole-trial (or (whole-trial) trial))
                   (current-location (make-variable location))
                   (current-dive #f))
      (call/ec
       (lambda (return)
         (set! leave return)
         (call-catching (lambda () (call-with-scratch thunk))
                        (lambda (exception) (note (unexpected exception))))))
      (when (and (epilogue) (eq? trial (whole-trial)))
        ((epilogue))))
    (values (cond ((pair? failures) 'fail) (else (or status 'pass)))
            reason claims (reverse failures))))
