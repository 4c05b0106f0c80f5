;;; (bight cli) --- the command line.
;;;
;;; `main' reads the arguments and hands over.  Whatever a command needs beyond this file is loaded when
;;; that command runs, so that `bight -c EXPR' starts as fast as Guile and the language do.  Every
;;; failure ends in one line on stderr and status 1.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(define-module (bight cli)
  #:use-module (bight errors)
  #:use-module (srfi srfi-1)
  #:export (main
            evaluate-file
            program-error?
            program-error-text))

(define-syntax-rule (from module name)
  ;; The value of NAME in MODULE, loaded now.
  (module-ref (resolve-interface 'module) 'name))

(define (version)
  ((from (bight engine) %version)))


;;; Evaluating a program form by form, so that what goes wrong has a line.

(define &program-error (make-exception-type '&program-error &error '(text)))
(define make-program-error (record-constructor &program-error))

(define program-error?
  (let ((ours? (exception-predicate &program-error)))
    (lambda (obj)
      "Return true if OBJ says what went wrong in a program."
      (ours? obj))))

(define program-error-text
  (let ((get (exception-accessor &program-error (record-accessor &program-error 'text))))
    (lambda (condition)
      "Return what CONDITION says: FILE:LINE: PROCEDURE: MESSAGE."
      (get condition))))

(define (located port file line exception)
  ;; What EXCEPTION says, after its place: the line it tells of itself, or LINE of FILE.
  (let ((text ((from (bight expect) exception->line) exception))
        (place ((from (bight expect) raised-at) exception))
        (name (string-append (port-filename port) ":")))
    (cond ((string-prefix? name text)
           (string-append (or file "expression") ":" (substring text (string-length name))))
          (place
           (string-append ((from (bight expect) location->string) place) ": " text))
          (file
           (string-append file ":" (number->string line) ": " text))
          (else text))))

(define (call-at port file line thunk)
  ;; Call THUNK; what it raises becomes a &program-error, but ^C and `exit' pass.
  (with-exception-handler
      (lambda (exception)
        (raise-exception
         (if (memq (exception-kind exception) '(quit signal))
             exception
             (make-program-error (located port file line exception)))))
    thunk
    #:unwind? #t))

(define (line-of form)
  (+ 1 (or (assq-ref (or (syntax-source form) '()) 'line) 0)))

(define (evaluate-port port file see)
  ;; Evaluate in the current module all that stands in PORT, form by form, and call SEE with the values
  ;; of each.  An error becomes a &program-error with the line, and FILE if it is not #f.
  (let loop ((line 1))
    (let ((form (call-at port file line (lambda () (read-syntax port)))))
      (unless (eof-object? form)
        (let ((line (line-of form)))
          (call-at port file line
                   (lambda () (call-with-values (lambda () (primitive-eval form)) see)))
          (loop line))))))

(define (skip-first-line! port)
  ;; Pass over `#!/usr/bin/bight', but leave Guile's own `#! ... !#' to the reader.
  (let* ((start (ftell port))
         (ours? (and (string-prefix? "#!/" (next-line port))
                     (not (string=? "!#" (next-line port))))))
    (seek port start SEEK_SET)
    (set-port-line! port 0)
    (when ours?
      (next-line port))))

(define (next-line port)
  (let ((line ((from (ice-9 rdelim) read-line) port)))
    (if (eof-object? line) "" line)))

(define (script? port)
  (eqv? #\# (peek-char port)))

(define (absolute file)
  (if (string-prefix? "/" file) file (string-append (getcwd) "/" file)))

(define (evaluate-file file)
  "Evaluate the forms of FILE in the current module.  What goes wrong is raised as a &program-error that
begins with FILE and the line."
  (call-with-input-file file
    (lambda (port)
      (set-port-encoding! port "UTF-8")
      (set-port-filename! port (absolute file)) ; `load' and the like look beside it
      (when (script? port)
        (skip-first-line! port))
      (evaluate-port port file ignore))))

(define (ignore . values) *unspecified*)

(define (show-values . values)
  (for-each (lambda (value)
              (unless (unspecified? value)
                (write value)
                (newline)))
            values))

(define (enter-language!)
  ;; Make a user's module, with the language, the current one.
  (set-current-module (resolve-module '(guile-user)))
  (process-use-modules '(((bight)))))


;;; The commands.  Each takes the list of its arguments and returns the exit status.

(define (bad-usage text . values)
  (apply bight-raise 'domain #f text values))

(define (run-script file arguments)
  (unless (file-exists? file)
    (bad-usage "there is no file ~s~a" file (meant file command-names)))
  (when (file-is-directory? file)
    (bad-usage "~s is a folder, not a script" file))
  (set-program-arguments (cons file arguments))
  (enter-language!)
  (evaluate-file file)
  0)

(define (run-expression arguments)
  (when (null? arguments)
    (bad-usage "-c needs an expression after it"))
  (set-program-arguments (cons "bight" (cdr arguments)))
  (enter-language!)
  (call-with-input-string (car arguments)
    (lambda (port)
      (set-port-filename! port "expression")
      (evaluate-port port #f show-values)))
  0)

(define (run-input see arguments)
  (set-program-arguments (cons "bight" arguments))
  (enter-language!)
  (set-port-filename! (current-input-port) "stdin")
  (evaluate-port (current-input-port) "stdin" see)
  0)

(define (run-prompt)
  (if (isatty? (current-input-port))
      ((from (bight repl) run-prompt) (version))
      (run-input show-values '())))

(define (print-version arguments)
  (simple-format #t "bight ~a~%" (version))
  0)

(define usage
  "Usage: bight                       the prompt; (help) there is a short tour
       bight FILE.scm [ARG...]     run a script
       bight -c EXPR               evaluate expressions and print their values
       bight -                     run what comes on standard input
       bight test [PATH...] [--only RE] [--junit FILE]
                                   run scenario tests, print TAP; a PATH is a file or a folder
       bight lessons [--trainee WHO | --group G] [--csv]
                                   list the lessons with marks, or the marks of a group
       bight lesson NAME|FILE [--trainee WHO] [--group G] [--level L] [--typed] [--fresh] [--quiet]
                                   take a lesson, or go on with it; a FILE from outside is enclosed,
                                   unless --trust; --pilot P shows it flown, --check proves it
       bight bench [NAME...] [-o DIR]
                                   measure run time against error; write tables and plots to DIR
       bight snapshot WORLD -o FILE.png [--view V] [--size WxH] [--paint P] [--run S]
                                   write a picture of a world, S seconds into a dive
       bight pilot WORLD [--view V] [--paint P] [--colors true|many|few|none]
                                   fly a world live from the keyboard; ? there shows the keys
       bight --listen[=SOCKET] [...]
                                   do the rest, or open the prompt, and serve another prompt on a
                                   unix socket, yours alone, to an editor
       bight replay FILE           do again what was recorded; exit 1 if it comes out otherwise
       bight --version | --help

A script and the prompt know the whole language; `(use-modules (bight))' gives it to plain guile.
Exit status: 0 if all is well, else 1 with a line on standard error.
")

(define (print-help arguments)
  (display usage)
  0)


;;; bight test.

(define (take-option options name)
  (or (assoc-ref options name) #f))

(define (split-arguments command arguments known)
  ;; ARGUMENTS as the others and an alist of the options in KNOWN, each of which takes a value.
  (let loop ((rest arguments) (others '()) (options '()))
    (cond ((null? rest) (values (reverse others) options))
          ((string=? (car rest) "--") (values (append (reverse others) (cdr rest)) options))
          ((split-equals (car rest) known)
           => (lambda (option) (loop (cdr rest) others (cons option options))))
          ((and (member (car rest) known) (pair? (cdr rest)))
           (loop (cddr rest) others (acons (car rest) (cadr rest) options)))
          ((member (car rest) known) (bad-usage "~a: ~a needs a value after it" command (car rest)))
          ((and (string-prefix? "-" (car rest)) (> (string-length (car rest)) 1))
           (bad-usage "~a has no option ~a~a" command (car rest) (meant (car rest) known)))
          (else (loop (cdr rest) (cons (car rest) others) options)))))

(define (split-equals argument known)
  ;; (NAME . VALUE) of --NAME=VALUE if --NAME is KNOWN, else #f.
  (let ((i (string-index argument #\=)))
    (and i
         (member (substring argument 0 i) known)
         (cons (substring argument 0 i) (substring argument (+ i 1))))))

(define (default-tests)
  (or (find file-exists? '("tests/scenario" "tests"))
      (bad-usage "test: name a file or a folder; there is no folder tests here")))

(define (run-tests arguments)
  (call-with-values (lambda () (split-arguments "test" arguments '("--junit" "--only")))
    (lambda (paths options)
      (if ((from (bight tap) run-tests)
           (if (null? paths) (default-tests) paths)
           #:junit (take-option options "--junit")
           #:only (take-option options "--only"))
          0
          1))))


;;; bight bench.

(define (run-benches arguments)
  (call-with-values (lambda () (split-arguments "bench" arguments '("-o")))
    (lambda (names options)
      ((from (bight bench) run-benches) names (or (take-option options "-o") "."))
      0)))


;;; bight snapshot.

(define (world-argument word)
  ;; A file's name, or a world's.
  (if (file-like? word) word (string->symbol word)))

(define snapshot-options '("-o" "--view" "--size" "--paint" "--overlay" "--run"))

(define (take-snapshot arguments)
  (call-with-values (lambda () (split-arguments "snapshot" arguments snapshot-options))
    (lambda (worlds options)
      (unless (= 1 (length worlds))
        (bad-usage "snapshot: name one world or file, as in bight snapshot WORLD -o FILE.png"))
      (unless (assoc-ref options "-o")
        (bad-usage "snapshot: say where to, as in bight snapshot ~a -o FILE.png" (car worlds)))
      (show-values ((from (bight picture) snapshot-world)
                    (world-argument (car worlds))
                    (assoc-ref options "-o")
                    options))
      0)))


;;; bight pilot.

(define (fly arguments)
  (call-with-values (lambda () (split-arguments "pilot" arguments '("--view" "--paint" "--colors")))
    (lambda (worlds options)
      (unless (= 1 (length worlds))
        (bad-usage "pilot: name one world or file, as in bight pilot WORLD"))
      (enter-language!)
      ((from (bight pilot-view) pilot-world) (world-argument (car worlds)) options)
      0)))


;;; bight replay.

(define (run-replay arguments)
  (unless (= 1 (length arguments))
    (bad-usage "replay: name one recording, as in bight replay FILE"))
  (if ((from (bight recording) replay-file) (car arguments)) 0 1))


;;; Choosing the command.

(define commands
  `(("-c" . ,run-expression)
    ("-" . ,(lambda (arguments) (run-input ignore arguments)))
    ("test" . ,run-tests)
    ("lesson" . ,(lambda (arguments) ((from (bight lesson-command) lesson-command) arguments)))
    ("lessons" . ,(lambda (arguments) ((from (bight lesson-command) lessons-command) arguments)))
    ("bench" . ,run-benches)
    ("snapshot" . ,take-snapshot)
    ("pilot" . ,fly)
    ("replay" . ,run-replay)
    ("--version" . ,print-version)
    ("--help" . ,print-help)
    ("-h" . ,print-help)))

(define command-names (map car commands))

(define (meant word words)
  (let ((near (nearest word words)))
    (if near (string-append "; did you mean `" near "'?") "")))

(define (file-like? word)
  (or (string-index word #\/)
      (string-suffix? ".scm" word)
      (file-exists? word)))

(define (listen-option argument)
  ;; The socket that --listen or --listen=SOCKET names, #t for the usual one; else #f.
  (cond ((string=? argument "--listen") #t)
        ((split-equals argument '("--listen")) => cdr)
        (else #f)))

(define (listen! socket arguments)
  ;; Do what ARGUMENTS say, and listen meanwhile; without a terminal that is all there is to do.
  (enter-language!)
  (let ((file ((from (bight listen) start-listening!) (if (string? socket) (absolute socket) #f))))
    (simple-format (current-error-port) "bight: listening at ~a~%" file)
    (dynamic-wind
      (const #f)
      (lambda ()
        (if (and (null? arguments) (not (isatty? (current-input-port))))
            (let loop () (sleep 3600) (loop))
            (run-command arguments)))
      (from (bight listen) stop-listening!))))

(define (run-command arguments)
  (cond ((null? arguments) (run-prompt))
        ((listen-option (car arguments)) => (lambda (socket) (listen! socket (cdr arguments))))
        ((assoc-ref commands (car arguments)) => (lambda (run) (run (cdr arguments))))
        ((string-prefix? "-" (car arguments))
         (bad-usage "there is no option ~a~a" (car arguments) (meant (car arguments) command-names)))
        ((file-like? (car arguments)) (run-script (car arguments) (cdr arguments)))
        (else
         (bad-usage "there is no command and no file ~a~a" (car arguments)
                    (meant (car arguments) command-names)))))

(define (complain text)
  (force-output (current-output-port))
  (simple-format (current-error-port) "bight: ~a~%" text)
  1)

(define (status-of arguments)
  ;; The exit status that `exit' was called with.
  (cond ((null? arguments) 0)
        ((exact-integer? (car arguments)) (logand (car arguments) 255))
        ((car arguments) 0)
        (else 1)))

(define (main arguments)
  "Do what ARGUMENTS, the command line as a list of strings, ask for, and return the exit status."
  (catch 'quit
    (lambda ()
      (with-exception-handler
          (lambda (exception)
            (cond ((program-error? exception) (complain (program-error-text exception)))
                  ((memq (exception-kind exception) '(quit)) (raise-exception exception))
                  (else (complain ((from (bight expect) exception->line) exception)))))
        (lambda () (run-command (cdr arguments)))
        #:unwind? #t))
    (lambda (key . arguments) (status-of arguments))))
