;;; (bight lesson lines) --- taking a lesson by typed lines: time passes only as they say.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(define-module (bight lesson lines)
  #:use-module ((bight cockpit desk) #:select (wrap))
  #:use-module (bight dive time)
  #:use-module (bight core decimal)
  #:use-module (bight core units)
  #:use-module (bight lesson guide)
  #:use-module (bight lesson input)
  #:use-module (bight lesson score)
  #:use-module (bight lesson task)
  #:use-module (bight view)
  #:use-module ((bight view status) #:select (status))
  #:use-module (ice-9 rdelim)
  #:use-module (srfi srfi-1)
  #:export (ask-line leaving catch-up! fly-by-lines))

(define (prompt text)
  (unless (replaying?)
    (display text)
    (force-output)))

(define (ask-line text)
  "Return the next line, or an eof object, after showing TEXT; ^C asks anew."
  (let loop ()
    (prompt text)
    ((breathing) #f)
    (let ((line (with-exception-handler
                    (lambda (e) (if (interrupted? e) #f (raise-exception e)))
                  (lambda () (read-line))
                  #:unwind? #t)))
      ((breathing) #t)
      (cond (line line)
            (else (newline) (loop))))))

(define leaving (make-parameter #f))    ; called with nothing: leaves the lesson, which can be resumed

(define line-help
  "  a line is Scheme, as (drive! #:surge 0.5) (run 5), or one of
  h a hint   l look   s status   u back ten seconds   + - one metre of tether out, in
  t TEXT tell the tender   an empty line lets a second pass   q leave, to go on later")

(define (whole-form text)
  ;; TEXT, and further lines while it is an unfinished form.
  (let loop ((text text) (n 0))
    (if (and (< n 50) (unfinished? text))
        (let ((more (ask-line "     > ")))
          (if (eof-object? more) text (loop (string-append text "\n" more) (+ n 1))))
        text)))

(define (unfinished? text)
  (call-with-input-string text
    (lambda (port)
      (catch #t
        (lambda () (let loop () (unless (eof-object? (read port)) (loop))) #f)
        (lambda (key . arguments)
          (and (eq? key 'read-error)
               (string-contains (simple-format #f "~s" arguments) "end of file")
               #t))))))

(define (show-unless-hidden verb thunk)
  (for-each print (if (hidden? verb)
                      '("In this lesson you cannot see that from where you are.")
                      (shown-lines (thunk)))))

(define (line->input line)
  (let ((word (string-trim-both line)))
    (cond ((eof-object? line) ((leaving)))
          ((string=? word "") (list 'pass 60))
          ((string=? word "h") '(hint))
          ((string=? word "u") '(back))
          ((string=? word "+") '(winch 1))
          ((string=? word "-") '(winch -1))
          ((string=? word "q") ((leaving)))
          ((string=? word "l") (show-unless-hidden 'look look) '(nothing))
          ((string=? word "s") (show-unless-hidden 'status status) '(nothing))
          ((member word '("?" "help")) (print line-help) '(nothing))
          ((string-prefix? "t " word) (list 'tell (substring word 2)))
          (else (list 'form (whole-form line))))))

(define (ask-input)
  (let ((line (ask-line (string-append (figure (now)) " s> "))))
    (if (eof-object? line) ((leaving)) (line->input line))))

(define (marked-as-replayed input)
  (if (eq? 'form (car input)) (append input '(again)) input))

(define (catch-up!)
  "Do what is left of the journal."
  (when (replaying?)
    (let loop ()
      (when (replaying?)
        (let* ((last? (null? (cdr (variable-ref (replay)))))
               (input (marked-as-replayed (next-input noop))))
          (parameterize ((silent? #t))
            (apply-input! input))
          (unless last? (loop)))))))

(define (print-targets)
  ;; Where the task leads, as forms want it.
  (for-each (lambda (target)
              (print "  " (car target) ": (" (string-join (map (lambda (along) (figure (along (cdr target)))) (list x y z)) " ") ")"))
            (task-targets)))

(define (fly-by-lines n seconds)
  "Let the pupil fly task N by typed lines until it is over."
  (when (replaying?)
    (catch-up!)
    (for-each print (wrap (string-append "TASK: " (task-text)) 78)))
  (print-targets)
  (let loop ()
    (for-each print (apply-input! (next-input ask-input)))
    (loop)))
