;;; (bight watched) --- orders to a dive, each judged, and each step that they let pass.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(define-module (bight watched)
  #:use-module (bight core errors)
  #:use-module (bight core fork)
  #:use-module ((bight core programs) #:select (temporary-file))
  #:use-module (bight dive)
  #:use-module (bight dive checkpoint)
  #:use-module (bight dive query)
  #:use-module (bight dive saving)
  #:use-module (bight dive task)
  #:use-module (bight dive time)
  #:use-module (bight engine)
  #:use-module ((bight core told) #:select (exception->line))
  #:use-module (bight test invariant)
  #:use-module (bight test soundness)
  #:use-module ((ice-9 exceptions) #:select (exception-kind))
  #:use-module ((ice-9 rdelim) #:select (read-line))
  #:use-module ((srfi srfi-1) #:hide (every))
  #:export (watched
            watch-orders
            same-when-loaded!
            as-told
            unsound
            refusals))

(define as-told
  ;; What becomes of the answers about a tether before they are judged; for tests of the judge.
  (make-parameter identity))


;;; Of the whole dive.

(define-syntax-rule (unless-true claim sentence)
  (if claim #f sentence))

(define (events-in-order)
  (let ((times (map cadr (events))))
    (unless-true (or (null? times)
                     (and (apply <= times)
                          (<= (last times) (+ (now) 1e-9))))
                 "the events are not in the order of time")))

(define (dive-laws strain-is-told? turns-are-steady?)
  (list (lambda () (unless-true (all-finite?) "a number of the dive is not finite or out of all size"))
        (lambda () (unless-true (nothing-crossed?) "something is crossed"))
        (lambda () (unless-true (energy-bounded?) "a line has more energy than anything gave it"))
        (lambda () (unless-true (strain-is-told?) "a line is longer than its tension tells"))
        (lambda () (unless-true (turns-are-steady?) "a line turned all at once: it went through something"))
        events-in-order))

(define (tethers-unsound)
  (any (lambda (name) (judge-tether ((as-told) (tether-answers name)))) (tether-names)))

(define (unsound strain-is-told? turns-are-steady?)
  "Return what is wrong with the present dive, a sentence, or #f.  STRAIN-IS-TOLD? comes from `strain-watcher',
TURNS-ARE-STEADY? from `turns-watcher'."
  (or (tethers-unsound)
      (any (lambda (law) (law)) (dive-laws strain-is-told? turns-are-steady?))))


;;; Orders.

(define (outcome-of thunk)
  ;; #f when THUNK was done, the &bight-error when it was refused; other errors are sentences.
  (with-exception-handler
      (lambda (e)
        (cond ((bight-error? e) e)
              ((memq (exception-kind e) '(quit signal)) (raise-exception e))
              (else (string-append "an error that is none of bight's: " (exception->line e)))))
    (lambda () (thunk) #f)
    #:unwind? #t))

(define refusals
  ;; How many orders of the running flight were refused.
  (make-parameter #f))

(define (count-refusal!)
  (when (refusals) (set-car! (refusals) (+ 1 (car (refusals))))))

(define (judge-order thunk)
  ;; Do THUNK: what is wrong with how it ended, a sentence, or #f.
  (let* ((dive (current-dive)) (before (and dive (state-hash))) (then (and dive (now)))
         (outcome (outcome-of thunk)))
    (cond ((string? outcome) outcome)
          ((not outcome) #f)
          (else
           (count-refusal!)
           (and dive (eq? dive (current-dive)) (= then (now)) (not (equal? before (state-hash)))
                (string-append "it was refused, yet the state has changed: "
                               (exception->line outcome)))))))

(define (when-and-what form time wrong)
  (list (simple-format #f "~a (at ~a s, ~s)" wrong (/ (round (* 1000 time)) 1000) form)))

(define (watch-orders orders)
  "Do ORDERS, a list of (FORM . THUNK), in the present dive, and judge it after each and after every step.
Return the list of what was wrong first, with its time and FORM: sentences, none for a sound dive."
  (let ((strain-is-told? (strain-watcher)) (turns-are-steady? (turns-watcher)) (wrong #f) (time #f))
    (define (look!)
      (unless wrong
        (set! wrong (unsound strain-is-told? turns-are-steady?))
        (set! time (now))))
    (define (go-on orders)
      (cond ((null? orders) '())
            (else
             (let ((complaint (judge-order (cdar orders))))
               (look!)
               (cond (complaint (when-and-what (caar orders) (now) complaint))
                     (wrong (when-and-what (caar orders) time wrong))
                     (else (go-on (cdr orders))))))))
    (let ((handle #f))
      (dynamic-wind
        (lambda () (set! handle (add-step-watcher! look!)))
        (lambda () (go-on (cons (cons '(enter!) (const #t)) orders)))
        (lambda () (remove-step-watcher! handle))))))

(define-syntax-rule (watched form ...)
  "(watched FORM ...): do the FORMs, orders to the present dive, one after another, and return what was not
sound after one of them or after a step: a list of sentences, empty for a sound dive."
  (watch-orders (list (cons 'form (lambda () form)) ...)))


;;; Another process.

(define (call-in-another-process thunk)
  ;; The line that THUNK, called in a process forked from this one, writes to its output.
  (let ((ends (pipe)))
    (force-output (current-output-port))
    (force-output (current-error-port))
    (let ((process (fork-process)))
      (cond ((zero? process)
             (catch #t
               (lambda ()
                 (display (thunk) (cdr ends))
                 (force-output (cdr ends)))
               (const #f))
             (primitive-_exit 0))
            (else
             (close-port (cdr ends))
             (let ((line (read-line (car ends))))
               (close-port (car ends))
               (waitpid process)
               line))))))

(define (state-after steps)
  ;; The hash of the present dive when so many STEPS have passed.
  (do ((i 0 (+ i 1))) ((= i steps) (state-hash)) (step!)))

(define (same-when-loaded! steps)
  "Save the dive, load it in another process, and let so many STEPS pass there and in a fork of the dive:
raise an error unless both end in the same state.  Raise a &bight-error when the dive cannot be saved."
  (let ((file (temporary-file)))
    (dynamic-wind
      (const #f)
      (lambda ()
        (save! file)
        (let ((there (call-in-another-process
                      (lambda () (load-dive file) (number->string (state-after steps)))))
              (here (number->string (what-if (state-after steps)))))
          (unless (equal? there here)
            (error "another process that loaded the dive went on otherwise:" there here))))
      (lambda () (delete-file file)))))
