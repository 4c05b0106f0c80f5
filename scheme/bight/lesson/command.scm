;;; (bight lesson command) --- bight lesson, bight lessons.
;;;
;;; A lesson is taken in a process of its own, (bight lesson child).  The parent only waits: it keeps the
;;; journal and the logbook, gives the terminal back as it was however the child ends, and so is what a
;;; lesson from outside cannot reach.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(define-module (bight lesson command)
  #:use-module ((bight shell status) #:select (complain exit-status))
  #:use-module (bight core fork)
  #:use-module (bight core sandbox)
  #:use-module (bight core terminal)
  #:use-module (bight lesson advice)
  #:use-module (bight lesson child)
  #:use-module (bight lesson journal)
  #:use-module (bight lesson listing)
  #:use-module (bight lesson log)
  #:use-module (bight lesson order)
  #:use-module ((bight outlet) #:select (control))
  #:use-module (srfi srfi-1)
  #:re-export (lessons-command)
  #:export (lesson-command))

(define (note-line! datum order journal)
  ;; DATUM is what the child told.
  (case (and (pair? datum) (car datum))
    ((input) (when journal (write-datum! (second datum) journal)))
    ((report)
     (drop-journal! order)
     (unless (log-result! (second datum))
       (complain "lesson: the marks are not kept: no logbook can be written; BIGHT_LOGBOOK=FILE names another")))
    (else #f)))

(define (listen port order journal)
  (let loop ()
    (let ((datum (catch #t (lambda () (read port)) (const the-end))))
      (unless (eof-object? datum)
        (note-line! datum order journal)
        (loop)))))

(define (status->exit status order)
  (let ((signal (status:term-sig status)))
    (if signal
        (begin
          (force-output)
          (simple-format (current-error-port) "bight: lesson: ~a: ~a~%" (order-file order)
                         (ending-text signal))
          1)
        (or (status:exit-val status) 1))))

(define screen-back "\x1b[?25h\x1b[?1049l")

(define (run-child order inputs port)
  ;; In the child, for good.
  (primitive-exit
   (exit-status (lambda ()
                  (sigaction SIGPIPE SIG_IGN)
                  (in-child order inputs (telling port))))))

(define (end-with-child! pid state)
  ;; Whoever ends this process ends the child too, and finds the terminal as it was.
  (for-each (lambda (signal)
              (sigaction signal
                (lambda (signal)
                  (false-if-exception (kill pid SIGKILL))
                  (when state (control screen-back))
                  (restore-terminal! state)
                  (primitive-exit (+ 128 signal)))))
            (list SIGTERM SIGHUP)))

(define (wait-for pid order port journal state)
  (sigaction SIGINT SIG_IGN)            ; ^C is for the child
  (end-with-child! pid state)
  (dynamic-wind
    (const #t)
    (lambda () (listen port order journal))
    (lambda ()
      (close-port port)
      (restore-terminal! state)))
  (let ((status (cdr (waitpid pid))))
    (when (and state (status:term-sig status))
      (control screen-back))
    (restore-terminal! state)
    (status->exit status order)))

(define (lesson-command words)
  "Do what `bight lesson WORDS' asks, and return the exit status."
  (call-with-values (lambda () (read-words "lesson" words))
    (lambda (plain given)
      (if (null? plain)
          (advise given)
          (let ((order (order-of plain given)))
            (seed-of given)
            (level-of given)
            (display-of given)
            (run-order order))))))

(define (check-place order inputs)
  ;; Say so if the lesson cannot be left and gone on with.
  (let ((journal (open-journal order inputs)))
    (if journal
        (close-port journal)            ; the child does not hold it
        (complain
         "lesson: you cannot go on later: no place for that can be written; XDG_STATE_HOME=FOLDER names one"))))

(define (personal? order)
  (not (or (option (order-given order) "--check" #f) (option (order-given order) "--pilot" #f))))

(define (run-order order)
  (let* ((inputs (if (personal? order) (journal-inputs order) '()))
         (state (terminal-state))
         (ends (pipe)))
    (when (personal? order)
      (check-place order inputs))
    (force-output)
    (let ((pid (fork-process)))
      (if (zero? pid)
          (begin
            (close-port (car ends))
            (run-child order inputs (cdr ends)))
          (begin
            (close-port (cdr ends))
            (wait-for pid order (car ends)
                      (and (personal? order) (open-journal order inputs))
                      state))))))
