;;; (bight lesson-terminal) --- taking a lesson: a person behind the guide.
;;;
;;; With a terminal the dive goes on by itself and is flown by keys, (bight lesson-keys); with a pipe, or
;;; when asked for, lines are typed and time passes only as they say, (bight lesson-lines).  What either
;;; does is an input, (bight lesson-input).
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(define-module (bight lesson-terminal)
  #:use-module (bight errors)
  #:use-module (bight language)
  #:use-module (bight lesson-input)
  #:use-module (bight lesson-keys)
  #:use-module (bight lesson-lines)
  #:use-module (bight lesson-play)
  #:use-module (bight view)
  #:use-module (srfi srfi-1)
  #:export (person-guide))

;;; Asking and telling.

(define titles
  '((task . "TASK: ") (hint . "Hint: ") (coach . "Coach: ") (fault . "! ") (message . "Tender: ")
    (done . "") (failed . "")
    (right . "Right: ") (wrong . "Not quite: ") (say . "")))

(define (say kind text)
  (let ((line (string-append (or (assq-ref titles kind) "") text)))
    (unless (quiet?)
      (if (eq? kind 'task)
          (forget-heard!)               ; the screen has it at the top
          (hear! line))
      (unless (and (memq kind '(hint coach fault message)) (keys?))
        (newline)
        (for-each (lambda (line) (print line)) (wrap line 78))))))

(define keys? (make-parameter #f))

(define (read-answer text choices)
  ;; The answer in TEXT, or #f if it is none.
  (let ((word (string-trim-both text)))
    (if choices
        (or (find (lambda (c) (string=? word (simple-format #f "~a" c))) choices)
            (let ((begun (filter (lambda (c) (string-prefix? word (simple-format #f "~a" c))) choices)))
              (and (not (string-null? word)) (= 1 (length begun)) (car begun))))
        (let ((n (string->number word)))
          (and (real? n) (finite? n) n)))))

(define (ask-answer question choices)
  (for-each print (wrap (string-append "? " question) 78))
  (let loop ()
    (let ((line (ask-line (if choices
                              (string-append "  " (words->string choices) "> ")
                              "  a number> "))))
      (cond ((eof-object? line) ((leaving)))
            ((string=? "q" (string-trim-both line)) ((leaving)))
            ((read-answer line choices) => (lambda (answer) (list 'answer answer)))
            (else (print (if choices "  one of these words" "  a number, such as 45") "; q leaves.")
                  (loop))))))

(define (probe question truth choices)
  (second (next-input (lambda () (ask-answer question choices)))))

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

(define (wait-for-enter text)
  ;; There is time to read before the next picture, and before the keys take the screen.
  (when (and (keys?) (not (replaying?)))
    (ask-line text)))

(define (picture thunk)
  (unless (replaying?)
    (let ((value (thunk)))
      (print (if (or (picture? value) (not (string? value))) (show-value value) value))
      (wait-for-enter "(Enter goes on) "))))

(define (person-guide keep inputs leave by-keys?)
  "Return a guide for a person at standard input and output, and a procedure that calls a thunk as that
guide wants it.  KEEP is called with each input, for a journal; INPUTS are those of a journal to begin
with; LEAVE is called when the person leaves; BY-KEYS? says whether keys are read one by one."
  (define (fly n seconds)
    (if by-keys?
        (begin
          (wait-for-enter "(Enter begins) ")
          (fly-by-keys n seconds))
        (fly-by-lines n seconds)))
  (values (make-guide say picture probe fly failed #t)
          (lambda (thunk)
            (parameterize ((replay (make-variable inputs)) (journal keep) (leaving leave)
                           (module (language-module)) (keys? by-keys?))
              (thunk)))))
