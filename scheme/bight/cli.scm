;;; (bight cli) --- the command line.
;;;
;;; `main' reads the arguments and hands over to a command of (bight shell commands).  Every failure ends in one line
;;; on stderr and status 1.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(define-module (bight cli)
  #:use-module (bight core errors)
  #:use-module (bight core late)
  #:use-module (bight core options)
  #:use-module (bight outlet)
  #:use-module (bight shell commands)
  #:use-module (bight shell program)
  #:use-module ((bight shell tasks) #:select (run-prompt run-script))
  #:use-module (bight shell status)
  #:export (main))

(define doors                           ; options that let others in, and what begins to serve them
  `(("--listen" . ,(lambda (file) ((from (bight shell listen) start-listening!) file)))
    ("--door" . ,(lambda (file) ((from (bight shell door) open-door!) file)))))

(define (door-option argument)
  ;; (SERVE . FILE) of --listen, --listen=FILE and the like, FILE #f for the usual one; else #f.
  (cond ((assoc argument doors) => (lambda (door) (cons (cdr door) #f)))
        ((split-option argument doors)
         => (lambda (option) (cons (assoc-ref doors (car option)) (absolute (cdr option)))))
        (else #f)))

(define (serve! door arguments)
  ;; Do what ARGUMENTS say, and serve at DOOR meanwhile; without a terminal that is all there is to do.
  (enter-language!)
  (let ((file ((car door) (cdr door))))
    (simple-format (current-error-port) "bight: listening at ~a~%" file)
    (dynamic-wind
      (const #f)
      (lambda ()
        (if (and (null? arguments) (not (isatty? (current-input-port))))
            (let loop () (sleep 3600) (loop))
            (run-command arguments)))
      (from (bight shell listen) stop-listening!))))

(define (meant-first word)
  ;; What may have been meant by WORD, the first of the command line: a command, a file; else where to read on.
  (let ((command (did-you-mean word first-words)))
    (if (string-null? command)
        (let ((file ((from (bight core missing) file-meant) word)))
          (if (string-null? file) "; bight --help lists the commands" file))
        command)))

(define (run-command arguments)
  (cond ((null? arguments) (run-prompt))
        ((door-option (car arguments)) => (lambda (door) (serve! door (cdr arguments))))
        ((string=? "-h" (car arguments)) (print-usage (cdr arguments)))
        ((command-called (car arguments)) => (lambda (command) (do-command command (cdr arguments))))
        ((string-prefix? "-" (car arguments))
         (bad-usage "there is no option ~a~a" (car arguments) (did-you-mean (without-value (car arguments)) first-words)))
        ((file-like? (car arguments)) (run-script (car arguments) (cdr arguments)))
        (else
         (bad-usage "there is no command and no file ~a~a" (car arguments) (meant-first (car arguments))))))

(define (main arguments)
  "Do what ARGUMENTS, the command line as a list of strings, ask for, and return the exit status."
  (guard-outputs!)
  (exit-status (lambda () (run-command (cdr arguments)))))
