;;; (bight shell tasks) --- what each command of the program does.
;;;
;;; A task takes the list of a command's arguments and returns the exit status.  Whatever a task needs beyond
;;; this file is loaded when that command runs, so that `bight -c EXPR' starts as fast as Guile and the
;;; language do.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(define-module (bight shell tasks)
  #:use-module (bight core errors)
  #:use-module (bight core late)
  #:use-module (bight core options)
  #:use-module (bight shell program)
  #:use-module ((bight shell usage) #:select (command-options))
  #:use-module (srfi srfi-1)
  #:export (run-script run-expression run-input run-prompt print-environment print-version
            run-tests run-benches take-snapshot fly show-controllers instruct watch follow run-sweep
            run-identify run-replay))

(define (version)
  ((from (bight engine) %version)))

(define (split name arguments)
  ;; ARGUMENTS as the others and the options that the command NAME knows.
  (split-arguments name (command-options ((from (bight shell commands) command-called) name)) arguments))

(define (run-script file arguments)
  (check-there file)
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
      ((from (bight shell repl) run-prompt) (version))
      (run-input show-values '())))

(define guile-paths '("GUILE_LOAD_PATH" "GUILE_LOAD_COMPILED_PATH" "GUILE_EXTENSIONS_PATH"))

(define (print-environment arguments)
  ;; What a shell has to know for plain guile to find bight: the first folder of each path, which the program
  ;; itself has put there.
  (for-each (lambda (name)
              (let ((folder (car (string-split (or (getenv name) "") #\:))))
                (simple-format #t "~a='~a'\"${~a:+:$~a}\"~%" name
                               (string-join (string-split folder #\') "'\\''") name name)))
            guile-paths)
  (simple-format #t "export ~a~%" (string-join guile-paths " "))
  0)

(define (print-version arguments)
  (simple-format #t "bight ~a~%" (version))
  0)

;;; bight test.

(define (default-tests)
  (or (find file-exists? '("tests/scenario" "tests"))
      (bad-usage "test: name a file or a folder; there is no folder tests here")))

(define (run-tests arguments)
  ((from (bight core place) mark-what-is-loaded!))
  (call-with-values (lambda () (split "test" arguments))
    (lambda (paths options)
      ((from (bight test command) test-command)
       (if (null? paths) (list (default-tests)) paths)
       options))))


;;; bight bench.

(define (run-benches arguments)
  ;; Not split here: what is no option of ours may be one of the program that measures.
  ((from (bight bench) bench-command) arguments))


;;; bight snapshot.

(define (world-argument word)
  ;; A file's name, or a world's.
  (if (file-like? word) word (string->symbol word)))

(define (take-snapshot arguments)
  (call-with-values (lambda () (split "snapshot" arguments))
    (lambda (worlds options)
      (when (null? worlds)
        (bad-usage "snapshot: name a world, of those that bight -c \"(worlds)\" lists, or a file, as in \
bight snapshot jacket -o jacket.png"))
      (unless (assoc-ref options "-o")
        (bad-usage "snapshot: say where to, as in bight snapshot ~a -o FILE.png" (car worlds)))
      (for-each show-values
                ((from (bight view snapshots) snapshot-worlds)
                 (map world-argument worlds)
                 (assoc-ref options "-o")
                 options))
      0)))


;;; Commands about one thing.

(define (call-with-one command what example arguments proc)
  ;; Call PROC in the language with the one thing that COMMAND is given among ARGUMENTS, and the options, and
  ;; return the exit status: 1 if PROC returns #f.  WHAT there should be, as in EXAMPLE, is said where there is
  ;; none, or more.
  (call-with-values (lambda () (split command arguments))
    (lambda (given options)
      (unless (= 1 (length given))
        (bad-usage "~a: name one ~a, as in bight ~a ~a" command what command example))
      (enter-language!)
      (if (eq? #f (proc (car given) options)) 1 0))))


;;; bight pilot.

(define (fly arguments)
  (call-with-one "pilot" "world, of those that bight -c \"(worlds)\" lists, or file" "jacket" arguments
                 (lambda (world options)
                   ((from (bight cockpit view) pilot-world) (world-argument world) options))))


;;; bight controller.

(define (show-controllers arguments)
  (call-with-values (lambda () (split "controller" arguments))
    (lambda (given options)
      (unless (null? given)
        (bad-usage "controller: it takes options alone, which bight controller --help tells, not ~a" (car given)))
      ((from (bight cockpit controller-command) controller-command) options)
      0)))


;;; bight instruct.

(define (instruct arguments)
  (unless (and (= 1 (length arguments)) (not (string-prefix? "-" (car arguments))))
    (bad-usage "instruct: name the socket of a pupil, as in bight instruct SOCKET"))
  (enter-language!)
  ((from (bight shell instruct) instruct) (absolute (car arguments))))


;;; bight watch.

(define (watch arguments)
  (call-with-one "watch" "recording" "FILE" arguments
                 (lambda (file options) ((from (bight cockpit watch) watch-file) file options))))


;;; bight follow.

(define (follow arguments)
  (call-with-one "follow" "source" "udp:14550" arguments
                 (lambda (source options) ((from (bight follow command) follow-source) source options))))


;;; bight sweep.

(define (run-sweep arguments)
  (call-with-values (lambda () (split "sweep" arguments))
    (from (bight study sweep-command) sweep-command)))


;;; bight identify.

(define (run-identify arguments)
  (call-with-values (lambda () (split "identify" arguments))
    (from (bight identify command) identify-command)))


;;; bight replay.

(define (run-replay arguments)
  (call-with-one "replay" "recording" "FILE" arguments
                 (lambda (file options) ((from (bight dive replay) replay-file) file))))
