;;; (bight lesson experiment-command) --- bight experiment: consent, the draw, the steps, the table.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(define-module (bight lesson experiment-command)
  #:use-module (bight lesson command)
  #:use-module ((bight core options) #:select (bad-usage))
  #:use-module (bight lesson experiment)
  #:use-module (bight lesson log)
  #:use-module (bight lesson logbook)
  #:use-module (bight lesson order)
  #:use-module (ice-9 rdelim)
  #:use-module (srfi srfi-1)
  #:export (experiment-command
            enrolled))

(define (print . lines)
  (for-each (lambda (line) (display line) (newline)) lines))


;;; Who takes part: entries of the logbook of the lesson `enrolment'.

(define (enrolled)
  "Return who takes part, an alist from names to groups, in the order in which they came."
  (reverse
   (fold (lambda (entry all)
           (let ((group (assq-ref (log-entry-data entry) experiment-key)))
             (if (and group (not (assoc (log-entry-trainee entry) all)))
                 (acons (log-entry-trainee entry) group all)
                 all)))
         '()
         (filter (lambda (e) (equal? "enrolment" (log-entry-what e))) (logbook #:kind 'lesson)))))

(define experiment-key (string->symbol experiment-tag))

(define (enrol! who)
  ;; Ask for consent; return the group, or #f.
  (print consent-text "" (simple-format #f "Do you, ~a, take part?  Type yes:" who))
  (force-output)
  (and (equal? "yes" (let ((line (read-line))) (and (string? line) (string-trim-both line))))
       (let ((group (group-drawn (length (enrolled)))))
         (log-lesson! 'enrolment #:trainee who #:data (list (cons experiment-key group) '(consent . "yes")))
         group)))


;;; The next step.

(define (step-words who group step)
  (list (symbol->string (step-lesson step)) "--trainee" who "--group" group
        "--seed" (number->string (step-seed step)) "--display" (symbol->string (step-display step)) "--quiet"))

(define (go-on who group)
  (let ((next (next-step group (logged-results who))))
    (if next
        (begin
          (print (simple-format #f "Step ~a of ~a: ~a" (first next) (length (steps-of-experiment group))
                                (step-lesson (second next))))
          (force-output)
          (lesson-command (step-words who group (second next))))
        (begin
          (print "You have flown all steps.  Thank you.")
          0))))

(define (take-part who)
  (let ((group (or (assoc-ref (enrolled) who) (enrol! who))))
    (if group
        (go-on who group)
        (begin
          (print "Nothing is kept of you.")
          0))))

(define (experiment-command words)
  "Do what `bight experiment WORDS' asks, and return the exit status."
  (call-with-values (lambda () (read-words "experiment" words))
    (lambda (plain given)
      (let ((why (why-no-record)))
        (when why (bad-usage "experiment: it needs a logbook: ~a" why)))
      (cond ((pair? plain) (bad-usage "experiment: say bight experiment --trainee WHO, or bight experiment --table"))
            ((option given "--table" #f)
             (apply print (experiment-lines (enrolled) (logged-results #f)))
             0)
            (else (take-part (who-of given)))))))
