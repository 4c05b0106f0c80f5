;;; (bight shell usage) --- what a command is called with: its help, its options, and the list of all.
;;;
;;; The table of commands is in (bight shell commands).  From it come `bight --help', `bight COMMAND --help', the
;;; manual page, and which options a command knows.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(define-module (bight shell usage)
  #:use-module (bight core record)
  #:use-module (bight shell fold)
  #:use-module (srfi srfi-1)
  #:export (command
            command?
            command-name
            command-run
            command-options
            command-option-lines
            command-examples
            print-overview
            print-completion
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
 (command-option-lines "Return what COMMAND says of its options: a list (CALL LINE ...) for each, CALL as \"-o FILE\".")
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

(define examples
  ;; Of each command, lines that a newcomer can type: in the folder of a project where files are named.
  '(("-c" "bight -c \"(enter! 'pile) (run 10) (status)\"")
    ("-" "echo \"(enter! 'pile) (display (slack))\" | bight -")
    ("test" "bight test tests/scenario -k \"bow and not slow\"" "bight test --last-failed --fail-fast")
    ("lessons" "bight lessons --skills")
    ("lesson" "bight lesson" "bight lesson one-pile --pilot expert")
    ("experiment" "bight experiment --trainee Ada")
    ("bench" "bight bench --list" "bight bench statics --quick -o figures")
    ("snapshot" "bight snapshot jacket -o jacket.png --view top" "bight snapshot box pile --run 10,60 -o stills")
    ("pilot" "bight pilot jacket --view chase")
    ("controller" "bight controller --record pad.events")
    ("instruct" "bight instruct sockets/pupil")
    ("sweep" "bight sweep studies/jacket-risk.scm -j 4" "bight sweep --table jacket-risk.db")
    ("identify" "bight identify swing.csv --type fathom --unknown cdn,ea -o mine.scm")
    ("replay" "bight replay dive.rec")
    ("watch" "bight watch dive.rec --at 20")
    ("follow" "bight follow udp:14550 --in pier --record dive.rec" "bight follow dive.tlog --plain")
    ("--completion" "bight --completion bash >~/.local/share/bash-completion/completions/bight")
    ("--environment" "eval \"$(bight --environment)\"")
    ("--help" "bight --help sweep")))

(define (command-examples command)
  "Return lines that show how COMMAND is typed, or the empty list."
  (or (assoc-ref examples (command-name command)) '()))


;;; Printing.

(define (spaces n)
  (make-string n #\space))

(define (fitting lines column)
  ;; LINES that begin at COLUMN, one text, as they are if all fit, else folded.
  (let ((columns (reader-columns)))
    (if (and columns (any (lambda (line) (> (+ column (string-length line)) columns)) lines))
        (folded-lines (list (string-join lines " ")) (- columns column))
        lines)))

(define (print-entry head lines column)
  ;; HEAD, and LINES from COLUMN on: beside it if there is room, else below.
  (let ((room (- column (string-length head))))
    (simple-format #t "~a~a~a~%" head
                   (if (>= room 2) (spaces room) (string-append "\n" (spaces column)))
                   (string-join (fitting lines column) (string-append "\n" (spaces column))))))

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
  "Print how COMMAND is called, what it does, its options, and examples."
  (simple-format #t "Usage: ~a~%" (call-of command))
  (for-each (lambda (line) (simple-format #t "  ~a~%" line)) (fitting (command-text command) 2))
  (for-each (lambda (option)
              (print-entry (string-append "  " (car option)) (cdr option) 20))
            (command-option-lines command))
  (unless (null? (command-examples command))
    (simple-format #t "For example:~%")
    (for-each (lambda (line) (simple-format #t "  ~a~%" line)) (command-examples command))))


;;; Completion in shells.

(define (words-of commands)
  ;; What the first word may be: names, without the arguments that a placeholder stands for.
  (filter-map (lambda (command)
                (let ((name (car (string-split (command-name command) #\[))))
                  (and (not (string-null? name)) (not (string-any char-upper-case? name))
                       (cons name (command-text command)))))
              commands))

(define (options-of command)
  (map (lambda (option) (cons (car (string-split (car option) #\space)) (cdr option)))
       (command-option-lines command)))

(define (quoted text)
  (string-append "'" (string-join (string-split text #\') "'\\''") "'"))

(define (those-with-options commands)
  (remove (lambda (command) (null? (command-option-lines command))) commands))

(define (print-bash commands)
  (define (listed entries) (quoted (string-join (map car entries) " ")))
  (display "# Completion of bight in bash; made by `bight --completion bash'.
_bight ()
{
  local current=${COMP_WORDS[COMP_CWORD]} words=
  if [ \"$COMP_CWORD\" -eq 1 ]; then
    words=")
  (display (listed (words-of commands)))
  (display "\n  else\n    case ${COMP_WORDS[1]} in\n")
  (for-each (lambda (command)
              (simple-format #t "      ~a) words=~a ;;~%" (command-name command) (listed (options-of command))))
            (those-with-options commands))
  (display "    esac
  fi
  mapfile -t COMPREPLY < <(compgen -W \"$words\" -- \"$current\"; compgen -f -- \"$current\")
}
complete -o filenames -F _bight bight
"))

(define (print-zsh commands)
  ;; NAME:WHAT for `_describe', in which a colon of the name would be escaped; there is none.
  (define (listed entries)
    (string-join (map (lambda (entry) (quoted (string-append (car entry) ":" (string-join (cdr entry) " "))))
                      entries)
                 " "))
  (simple-format #t "#compdef bight
# Completion of bight in zsh; made by `bight --completion zsh'.
local -a words_of_bight
if (( CURRENT == 2 )); then
  words_of_bight=(~a)
else
  case $words[2] in
" (listed (words-of commands)))
  (for-each (lambda (command)
              (simple-format #t "    ~a) words_of_bight=(~a) ;;~%" (command-name command)
                             (listed (options-of command))))
            (those-with-options commands))
  (display "  esac
fi
_describe 'word' words_of_bight
_files
"))

(define (print-completion commands shell)
  "Print what the SHELL, bash or zsh, reads to complete the words of COMMANDS; return #f if it is another."
  (cond ((string=? shell "bash") (print-bash commands) #t)
        ((string=? shell "zsh") (print-zsh commands) #t)
        (else #f)))
