;;; (bight lesson input) --- what a pupil does, as data; and what it does.
;;;
;;; All a pupil does is an input, a datum such as (pass 60), (stick surge 0.25), (form "(run 5)") or
;;; (answer 40), also that time passed.  Inputs go into a journal as they come; since a dive is
;;; deterministic the journal, played again, leads to the same point: so one resumes.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(define-module (bight lesson input)
  #:use-module ((bight cockpit orders) #:select (do-to-dive! order->text))
  #:use-module (bight core errors)
  #:use-module (bight dive)
  #:use-module (bight dive command)
  #:use-module (bight dive query)
  #:use-module (bight dive task)
  #:use-module (bight dive time)
  #:use-module (bight lesson guide)
  #:use-module (bight lesson message)
  #:use-module (bight lesson points)
  #:use-module (bight lesson score)
  #:use-module (bight lesson tally)
  #:use-module ((bight core told) #:select (exception->line))
  #:use-module (bight lesson task)
  #:use-module (bight view text)
  #:use-module ((bight view looks) #:select (value->lines))
  #:use-module ((ice-9 control) #:select (call/ec))
  #:use-module (srfi srfi-1)
  #:export (replay journal silent? replaying? quiet? next-input
            print shown-lines hidden?
            module
            interrupted? apply-input!))


;;; Inputs: from the journal while there is any, then from the person.

(define replay (make-parameter #f))     ; a variable with the inputs to come, or #f
(define journal (make-parameter noop))  ; called with each new input

;; True while the last input of the journal is done.
(define silent? (make-parameter #f))

(define (replaying?)
  "Return #t while the inputs of a journal are done again."
  (and (replay) (pair? (variable-ref (replay)))))

(define (quiet?)
  "Return #t while nothing is shown."
  (or (silent?) (replaying?)))

(define (next-input ask)
  "Return the next input: out of the journal, or what ASK, a thunk, returns."
  ((breathing) #t)
  (if (replaying?)
      (let ((all (variable-ref (replay))))
        (variable-set! (replay) (cdr all))
        (car all))
      (let ((input (ask)))
        (unless (memq (car input) '(form nothing))
          ((journal) input))
        input)))

(define (print . parts)
  "Show PARTS as a line, unless all is quiet."
  (unless (quiet?)
    (for-each display parts)
    (newline)
    (force-output)))


;;; What inputs do.

(define module (make-parameter #f))

(define (hidden-verbs)
  (or (assq-ref (session-limits (this-session 'lesson)) 'hidden) '()))

(define (hidden? verb)
  "Return #t if the lesson does not let its pupil see what VERB tells."
  (and (memq verb (hidden-verbs)) #t))

(define (hide-verbs! module)
  ;; In MODULE each of the hidden verbs only tells that it is hidden.
  (for-each (lambda (verb)
              (unless (module-local-variable module verb)
                (module-define! module verb
                                (lambda arguments
                                  (bight-raise 'unsupported verb
                                               "in this lesson you cannot see that from where you are")))))
            (hidden-verbs)))

(define (evaluate-text text)
  ;; Evaluate the forms in TEXT; return the lines their values print as.
  (hide-verbs! (module))
  (call-with-input-string text
    (lambda (port)
      (let loop ((lines '()))
        (let ((form (read port)))
          (if (eof-object? form)
              (reverse lines)
              (let ((value (eval form (module))))
                (loop (if (unspecified? value)
                          lines
                          (append (reverse (shown-lines value (question-of form))) lines))))))))))

(define (question-of form)
  (and (pair? form) (symbol? (car form)) (car form)))

(define* (shown-lines value #:optional question)
  "Return VALUE, the answer to QUESTION, a symbol, or #f, as a pupil reads it: lines, as at the prompt."
  (if (picture? value)
      (picture-lines value)
      (value->lines value question)))

(define (steps-now) (inexact->exact (round (/ (now) (time-step)))))

(define (call-for-steps n thunk)
  ;; Call THUNK, but leave it when N steps have passed.
  (let ((end (+ (steps-now) n)))
    (call/ec
     (lambda (leave)
       (let ((watch (lambda () (when (>= (steps-now) end) (leave '())))))
         (dynamic-wind
           (lambda () (add-step-watcher! watch))
           thunk
           (lambda () (remove-step-watcher! watch))))))))

(define (guarded-dive thunk)
  ;; A form may not leave the dive of the lesson.
  (let ((dive (current-dive)))
    (dynamic-wind
      noop
      thunk
      (lambda () (unless (eq? dive (current-dive)) (current-dive dive))))))

(define (catching thunk)
  ;; The lines that THUNK returns, or the line of what it raises.
  (with-exception-handler
      (lambda (e)
        (if (eq? 'quit (exception-kind e))
            '("q leaves the lesson")
            (list (exception->line e))))
    (lambda () (guarded-dive thunk))
    #:unwind? #t))

(define (interrupted? e)
  "Return #t if E came of ^C."
  (and (exception? e) (eq? 'signal (exception-kind e))))

(define (evaluate-noting text)
  ;; Evaluate TEXT; note it in the journal, with how far it came if ^C ended it or the task did.
  (let ((begun (steps-now)) (noted? #f))
    (define (note! input)
      (unless noted?
        (set! noted? #t)
        ((journal) input)))
    (dynamic-wind
      noop
      (lambda ()
        (let ((lines (catching
                      (lambda ()
                        (with-exception-handler
                            (lambda (e)
                              (when (interrupted? e)
                                (note! (list 'broken text (- (steps-now) begun))))
                              (raise-exception e))
                          (lambda () (evaluate-text text)))))))
          (note! (list 'form text))
          lines))
      (lambda () (note! (list 'form text))))))

(define (stick! which by)
  (let* ((names '(surge sway heave yaw))
         (old (list-ref (array->list (sticks)) (list-index (lambda (n) (eq? n which)) names)))
         (new (max -1 (min 1 (/ (round (* 20 (+ old by))) 20)))))
    (case which
      ((surge) (drive! #:surge new))
      ((sway) (drive! #:sway new))
      ((heave) (drive! #:heave new))
      (else (drive! #:yaw new)))))

(define (sticks! values)
  (drive! #:surge (first values) #:sway (second values) #:heave (third values) #:yaw (fourth values)))

(define (hold! what)
  (case what
    ((heading) (hold-heading! (rov-heading)))
    ((depth) (hold-depth! (rov-depth)))
    ((altitude) (hold-altitude! (rov-altitude)))
    (else (hold-position!))))

(define (obey! order)
  ;; What the instructor handed in: it is in the report, and words are said.
  (case (car order)
    ((words) (say-as 'instructor (second order)) '())
    (else
     (log-line! 'instructor (order->text order))
     (case (car order)
       ((light) (tally-set! 'dark (not (second order))) '())
       ((clock) (tally-set! 'stopped (not (second order))) '())
       ((form) (evaluate-text (second order)))
       (else (do-to-dive! order) '())))))

(define (winch! metres)
  (if (positive? metres) (pay-out! metres) (haul-in! (- metres))))

(define (apply-input! input)
  "Do what INPUT says; return lines to show."
  (case (car input)
    ((pass) (run (* (second input) (time-step))) '())
    ((stick) (catching (lambda () (stick! (second input) (third input)) '())))
    ((sticks) (catching (lambda () (sticks! (cdr input)) '())))
    ((hold) (catching (lambda () (hold! (second input)) '())))
    ((release) (catching (lambda () (release!) '())))
    ((winch) (catching (lambda () (winch! (second input)) '())))
    ((hint) (if (ask-for-hint!) '() '("There is no further hint.")))
    ((back) (go-back! 10) (list (string-append "Back at " (figure (now)) " s.")))
    ((tell) (tell! 'tender (second input)) '())
    ((instruct) (catching (lambda () (obey! (second input)))))
    ((form) (if (replaying-form? input)
                (catching (lambda () (evaluate-text (second input))))
                (evaluate-noting (second input))))
    ((broken) (catching (lambda ()
                          (if (positive? (third input))
                              (call-for-steps (third input) (lambda () (evaluate-text (second input))))
                              '()))))
    (else '())))

(define (replaying-form? input) (memq 'again input))
