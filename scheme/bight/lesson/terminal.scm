;;; (bight lesson terminal) --- taking a lesson: a person behind the guide.
;;;
;;; With a terminal the lesson is taken in the cockpit, (bight lesson cockpit); with a dumb one, a pipe, or
;;; when asked for, lines are typed and time passes only as they say, (bight lesson lines).  What either
;;; does is an input, (bight lesson input).
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(define-module (bight lesson terminal)
  #:use-module ((bight cockpit desk) #:select (wrap))
  #:use-module (bight core errors)
  #:use-module (bight language)
  #:use-module (bight lesson asking)
  #:use-module (bight lesson cockpit)
  #:use-module (bight lesson flying)
  #:use-module (bight lesson guide)
  #:use-module (bight lesson input)
  #:use-module (bight lesson lines)
  #:use-module (bight lesson probe)
  #:use-module (bight view)
  #:use-module (srfi srfi-1)
  #:export (person-guide))

;;; Asking and telling.

(define titles
  '((task . "TASK: ") (hint . "Hint: ") (coach . "Coach: ") (fault . "! ") (message . "Tender: ") (instructor . "Instructor: ")
    (done . "") (failed . "")
    (right . "Right: ") (wrong . "Not quite: ") (say . "")))

(define (say kind text)
  (let ((line (string-append (or (assq-ref titles kind) "") text)))
    (unless (quiet?)
      (newline)
      (for-each (lambda (line) (print line)) (wrap line 78)))))

(define (ask-answer question choices degrees?)
  (for-each print (wrap (string-append "? " question) 78))
  (let loop ()
    (let ((line (ask-line (if choices
                              (string-append "  " (words->string choices) "> ")
                              "  a number> "))))
      (if (or (eof-object? line) (string=? "q" (string-trim-both line)))
          ((leaving))
          (let ((answer (answer-in line choices degrees?)))
            (cond ((string? answer)
                   (print "  " answer "; q leaves.")
                   (loop))
                  (else (list 'answer answer))))))))

(define (probe question truth choices)
  (let ((degrees? (asked-in-degrees?)))
    (second (next-input (lambda () (ask-answer question choices degrees?))))))

(define (ask-what-next)
  (print "u go back ten seconds, a begin the task again, e end the lesson, q leave and go on later")
  (let loop ()
    (let* ((line (ask-line "u, a, e or q> "))
           (word (if (eof-object? line) "q" (string-trim-both line))))
      (cond ((string=? word "u") '(failed back))
            ((string=? word "a") '(failed again))
            ((string=? word "e") '(failed end))
            ((string=? word "q") ((leaving)))
            (else (loop))))))

(define (failed text)
  (second (next-input ask-what-next)))

(define (picture thunk)
  (unless (replaying?)
    (let ((value (thunk)))
      (for-each print (if (string? value) (list value) (shown-lines value))))))

(define* (person-guide keep inputs leave cockpit? #:key (plain? #f))
  "Return a guide for a person at standard input and output, and a procedure that calls a thunk as that
guide wants it.  KEEP is called with each input, for a journal; INPUTS are those of a journal to begin
with; LEAVE is called when the person leaves; COCKPIT? says whether the lesson is taken in the cockpit, with PLAIN?
in plain characters."
  (values (if cockpit?
              (make-guide say-in-cockpit picture-in-cockpit probe-in-cockpit fly-in-cockpit failed-in-cockpit #t)
              (make-guide say picture probe fly-by-lines failed #t))
          (lambda (thunk)
            (parameterize ((replay (make-variable inputs)) (journal keep) (leaving leave)
                           (module (language-module)))
              (if cockpit? (call-in-cockpit thunk #:plain? plain?) (thunk))))))
