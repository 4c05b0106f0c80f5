;;; (bight usage) --- what a command is called with: its help, its options, and the list of all.
;;;
;;; The table of commands is in (bight cli).  From it come `bight --help', `bight COMMAND --help', the
;;; manual page, and which options a command knows.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(define-module (bight usage)
  #:use-module (bight record)
  #:use-module (srfi srfi-1)
  #:export (command
            command?
            command-name
            command-run
            command-options
            print-overview
            print-help))

(define-record <command>
  (make-command name run arguments text options)
  command?
  (name command-name)                   ; the first word
  (run command-run)                     ; called with the words after it, returns the exit status
  (arguments command-arguments)         ; what comes after the name, or ""
  (text command-text)                   ; lines that say what it does
  (options command-option-lines))       ; lists (CALL LINE ...), as ("--junit FILE" "write JUnit XML")

(document
 (command? "Return true if OBJECT is a command.")
 (command-name "Return the word that COMMAND is called by.")
 (command-run "Return the procedure that does COMMAND: it takes a list of words, returns an exit status."))

(define (command name run arguments text . options)
  "Return the command NAME, done by the procedure RUN.  ARGUMENTS shows what comes after the name; TEXT, a
list of lines, says what it does; each of OPTIONS is a list of how it is written and lines about it."
  (make-command name run arguments text options))

(define (command-options command)
  "Return the options of COMMAND, an alist from the name to whether a value comes after it."
  (map (lambda (option)
         (let ((words (string-split (car option) #\space)))
           (cons (car words) (pair? (cdr words)))))
       (command-option-lines command)))


;;; Printing.

(define (spaces n)
  (make-string n #\space))

(define (print-entry head lines column)
  ;; HEAD, and LINES from COLUMN on: beside it if there is room, else below.
  (let ((room (- column (string-length head))))
    (simple-format #t "~a~a~a~%" head
                   (if (>= room 2) (spaces room) (string-append "\n" (spaces column)))
                   (string-join lines (string-append "\n" (spaces column))))))

(define (call-of command)
  (string-join (remove string-null?
                       (list "bight" (command-name command) (command-arguments command)
                             (if (null? (command-option-lines command)) "" "[OPTION...]")))
               " "))

(define (print-overview commands)
  "Print how each of COMMANDS is called and what it does; their options are left to `print-help'."
  (for-each (lambda (command lead)
              (print-entry (string-append lead (call-of command)) (command-text command) 35))
            commands
            (cons "Usage: " (map (const "       ") (cdr commands)))))

(define (print-help command)
  "Print how COMMAND is called, what it does, and its options."
  (simple-format #t "Usage: ~a~%" (call-of command))
  (for-each (lambda (line) (simple-format #t "  ~a~%" line)) (command-text command))
  (for-each (lambda (option)
              (print-entry (string-append "  " (car option)) (cdr option) 20))
            (command-option-lines command)))
