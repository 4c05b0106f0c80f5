;;; `bight test' as a whole: processes, limits, seeds, what is attached to a failure, the catalogue; and the
;;; manners of the command line.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(use-modules (ice-9 popen)
             ((ice-9 rdelim) #:select (read-line))
             (ice-9 textual-ports)
             ((srfi srfi-1) #:hide (every)))

(define (write-file name text)
  (call-with-output-file name (lambda (port) (display text port))))

(define (remove-folder folder)
  (for-each (lambda (name)
              (let ((file (string-append folder "/" name)))
                (if (file-is-directory? file) (remove-folder file) (delete-file file))))
            ((@ (ice-9 ftw) scandir) folder (lambda (name) (not (member name '("." ".."))))))
  (rmdir folder))

(define (call-in-folder texts receive)
  ;; Call RECEIVE with a folder of its own in which the files a.scm, b.scm, ... hold TEXTS.
  (let ((folder (mkdtemp (string-append (or (getenv "TMPDIR") "/tmp") "/bight-test-XXXXXX"))))
    (dynamic-wind
      (lambda ()
        (for-each (lambda (text letter) (write-file (string-append folder "/" letter ".scm") text))
                  texts '("a" "b" "c" "d")))
      (lambda () (receive folder))
      (lambda () (remove-folder folder)))))

(define (report folder . options)
  (with-output-to-string (lambda () (apply run-tests folder options))))

(define (guile)
  (string-append (assq-ref %guile-build-info 'bindir) "/guile"))

(define main "(exit ((@ (bight cli) main) (command-line)))")

(define (command . arguments)
  ;; Run `bight ARGUMENTS ...': the exit status and the text on standard output and error.
  (let* ((port (apply open-pipe* OPEN_READ "/bin/sh" "-c" "exec \"$@\" 2>&1" "sh" (guile) "-c" main
                      arguments))
         (text (get-string-all port)))
    (cons (status:exit-val (close-pipe port)) text)))

(define (says text . words)
  (and-map (lambda (word) (string-contains text word)) words))


;;; Choosing what is run.

(define-syntax-rule (with-memory folder body ...)
  ;; Evaluate BODY while what failed is remembered in FOLDER.
  (let ((before (getenv "XDG_STATE_HOME")))
    (dynamic-wind
      (lambda () (setenv "XDG_STATE_HOME" (string-append folder "/state")))
      (lambda () body ...)
      (lambda () (if before (setenv "XDG_STATE_HOME" before) (unsetenv "XDG_STATE_HOME"))))))

(define some-fail
  '("(define-scenario bow \"Bows to the east.\" (expect #t))
     (define-scenario slow-bow \"Bows to the west.\" (expect (file-exists? \"no-such-file\")))
     (define-scenario knot \"Ties a knot.\" (expect #t))"
    "(define-scenario other \"Another.\" (expect #t))"))

(define (names-run text)
  "Return the labels of the scenarios that the report TEXT says were run, in order."
  (filter-map (lambda (line)
                (and (or (string-prefix? "ok " line) (string-prefix? "not ok " line))
                     (not (string-contains line "# SKIP"))
                     (string->symbol (string-trim-both (list-ref (string-split line #\:) 1)))))
              (string-split text #\newline)))

(define-scenario chosen-by-words
  "Words choose scenarios by file, name and sentence, with and, or and not between them."
  (call-in-folder some-fail
    (lambda (folder)
      (with-memory folder
        (for-each (lambda (entry)
                    (expect (names-run (report folder #:match (car entry))) => (cdr entry)))
                  '(("bow" bow slow-bow) ("BOW and not slow" bow) ("knot or other" knot other)
                    ("not bow" knot other) ("west" slow-bow) ("b.scm" other) ("east or west and slow" bow slow-bow)))
        (expect (report folder #:match "mast") is (lambda (text) (says text "no scenario has a name")))))))

(define-scenario what-failed-is-run-again
  "What failed the last time is run alone, until it passes; then all are."
  (call-in-folder some-fail
    (lambda (folder)
      (with-memory folder
        (expect (report folder #:last-failed #t) is (lambda (text) (says text "nothing failed the last time")))
        (expect (names-run (report folder #:last-failed #t)) => '(slow-bow))
        (report folder #:match "knot")   ; what is not run is not forgotten
        (expect (names-run (report folder #:last-failed #t)) => '(slow-bow))
        (write-file (string-append folder "/a.scm") "(define-scenario slow-bow \"Bows.\" (expect #t))")
        (expect (names-run (report folder #:last-failed #t)) => '(slow-bow))
        (expect (names-run (report folder #:last-failed #t)) => '(slow-bow other))))))

(define (watch-lines text)
  ;; (FILE SECONDS) of each line of the report TEXT that says how a failure is watched.
  (filter-map (lambda (line)
                (let ((words (string-tokenize line)))
                  (and (= 8 (length words)) (equal? '("#" "watch" "it:" "bight" "watch") (take words 5))
                       (list (list-ref words 5) (string->number (list-ref words 7))))))
              (string-split text #\newline)))

(define-scenario a-failure-is-kept-to-be-watched
  "What failed in a dive leaves the flight up to there, and tells the command that shows it; without a dive there is none;
once it passes the flight is gone."
  (call-in-folder
      '("(define-scenario early \"Moves.\" (in pile) (drive! #:surge 1) (run 2) (expect (now) => 3) (run 1) (expect 1 => 2))
         (define-scenario watched \"Moves.\" (in pile) (drive! #:surge 1) (always (< (now) 1) (run 2)))
         (define-scenario broken \"Breaks.\" (in pile) (run 1) (car '()))
         (define-scenario dry \"No dive.\" (expect 1 => 2))
         (define-scenario good \"Good.\" (in pile) (run 1) (expect 1 => 1))")
    (lambda (folder)
      (with-memory folder
        (let ((kept (watch-lines (report folder #:jobs 2))))
          (expect (map second kept) => '(2.0 1.0 1.0))
          (expect (map (lambda (entry) (replay (first entry))) kept) => '(identical identical identical))
          (write-file (string-append folder "/a.scm")
                      "(define-scenario early \"Moves.\" (in pile) (run 2) (expect (now) => 2))")
          (expect (watch-lines (report folder)) => '())
          (expect (map file-exists? (map first kept)) => '(#f #t #t)))))))

(define-scenario nothing-after-a-failure
  "With #:fail-fast what follows a failure is skipped, and told so."
  (call-in-folder some-fail
    (lambda (folder)
      (with-memory folder
        (let ((text (report folder #:fail-fast #t #:jobs 1)))
          (expect (names-run text) => '(bow slow-bow))
          (expect text is (lambda (text) (says text "1..4" "ok 3 - a.scm: knot: Ties a knot. # SKIP not run"
                                               "ok 4 -" "1 passed, 1 failed, 2 skipped"))))
        (expect (names-run (report (string-append folder "/b.scm") #:fail-fast #t)) => '(other))))))

(define-scenario the-slowest-are-told
  "With #:durations the slowest are told, so many."
  (call-in-folder '("(define-scenario quick \"Quick.\" (expect #t))
                     (define-scenario slow \"Slow.\" (in pile) (run 20) (expect #t))
                     (define-scenario quick-too \"Quick.\" (expect #t))")
    (lambda (folder)
      (with-memory folder
        (let* ((lines (string-split (report folder #:durations 2) #\newline))
               (tail (member "# the slowest:" lines)))
          (expect (list? tail) => #t)
          (expect (string-suffix? "a.scm: slow" (second tail)) => #t)
          (expect (string-contains (fourth tail) "passed") is identity))))))

(define (call-watching arguments proc)
  ;; Call PROC with a thunk that waits until a round of `bight test ARGUMENTS --watch' is over and returns the
  ;; names of the scenarios that were run in it.
  (let* ((port (apply open-pipe* OPEN_READ "/bin/sh" "-c" "echo $$; exec \"$@\"" "sh" (guile) "-c" main "test"
                      "--watch" arguments))
         (process (string->number (read-line port))))
    (define (round-over)
      (let loop ((lines '()))
        (let ((line (read-line port)))
          (if (or (eof-object? line) (string-contains line "waiting for a change"))
              (names-run (string-join (reverse lines) "\n"))
              (loop (cons line lines))))))
    (dynamic-wind
      (const #f)
      (lambda () (proc round-over))
      (lambda ()
        (kill process SIGTERM)
        (close-pipe port)))))

(define-scenario what-changes-is-run-again
  "With --watch what is written anew is run, and all when it is a file beside them."
  (call-in-folder some-fail
    (lambda (folder)
      (define (write-anew name text) (write-file (string-append folder "/" name) text))
      (with-memory folder
        (call-watching (list folder "-k" "knot or other")
          (lambda (round-over)
            (expect (round-over) => '(knot other))
            (write-anew "b.scm" "(define-scenario other \"Another, longer.\" (expect #f))")
            (expect (round-over) => '(other))
            (write-anew "c.scm" "(define-scenario other-too \"New.\" (expect #t))")
            (expect (round-over) => '(other-too))))
        (call-watching (list (string-append folder "/a.scm") "-k" "knot")
          (lambda (round-over)
            (expect (round-over) => '(knot))
            (write-anew "b.scm" "1")
            (expect (round-over) => '(knot))))))))


;;; Processes.

(define slow-and-quick
  '("(define-scenario slow \"Slow.\" (in pile) (run 200) (expect #t))
     (define-scenario (two n) \"Two.\" #:for ((n 1 2)) (expect n => 1))"
    "(define-scenario quick \"Quick.\" (expect #f))"
    "(car 1)"
    ""))

(define-scenario the-same-report-whatever-ends-first
  "With one process and with four the report is the same, in the order of the files."
  (call-in-folder slow-and-quick
    (lambda (folder)
      (let ((text (report folder #:jobs 4)))
        (expect text => (report folder #:jobs 1))
        (expect (says text "1..6" "ok 1 - a.scm: slow" "ok 2 - a.scm: two (n=1)" "not ok 3 - a.scm: two (n=2)"
                      "not ok 4 - b.scm: quick" "not ok 5 - c.scm: could not load"
                      "not ok 6 - d.scm: holds no scenario"))))))

(define-scenario several-at-once
  "Four scenarios that each wait for the other three come to an end."
  (call-in-folder
      '("(define (file n) (string-append (dirname (current-filename)) \"/here-\" (number->string n)))
         (define-scenario (meet n) \"Meets the others.\" #:for ((n 1 2 3 4))
           (close-port (open-output-file (file n)))
           (let loop ()
             (unless (and-map file-exists? (map file '(1 2 3 4)))
               (usleep 10000)
               (loop)))
           (expect #t))")
    (lambda (folder)
      (expect (says (report folder #:jobs 4) "# 4 passed")))))

(define-scenario no-result-is-lost
  "A scenario whose process dies or ends by itself is a failure that says so; those after it are run."
  (call-in-folder
      '("(define-scenario crash \"Crashes.\" (kill (getpid) SIGABRT))
         (define-scenario ends \"Ends.\" (primitive-exit 7))
         (define-scenario killed \"Is killed.\" (kill (getpid) SIGKILL))
         (define-scenario after \"Goes on.\" (expect #t))"
        "(kill (getpid) SIGKILL)"
        "(define-scenario also \"Also.\" (expect #t))")
    (lambda (folder)
      (let ((text (report folder #:jobs 2 #:limit 0)))
        (expect (says text "not ok 1 - a.scm: crash: Crashes." "it aborted"
                      "not ok 2 - a.scm: ends: Ends." "ended by itself, with status 7"
                      "not ok 3 - a.scm: killed: Is killed." "its process died: it was killed"
                      "ok 4 - a.scm: after" "not ok 5 - b.scm: could not load" "ok 6 - c.scm: also"
                      "# 2 passed, 4 failed"))))))

(define-scenario files-of-its-own-are-removed
  "The files that a scenario asked for are its own while it runs, and gone when it has ended."
  (call-in-folder
      '("(define-scenario (one n) \"One.\" #:for ((n 1 2))
           (let ((file (scratch-file \"a\")))
             (expect (file-exists? file) => #f)
             (call-with-output-file file (lambda (port) (write n port)))
             (mkdir (scratch-file \"folder\"))
             (call-with-output-file (scratch-file \"folder/b\") (lambda (port) (write n port)))
             (call-with-output-file (string-append (dirname (current-filename)) \"/\" (number->string n))
               (lambda (port) (write (dirname file) port)))))")
    (lambda (folder)
      (expect (says (report folder) "# 2 passed"))
      (for-each (lambda (n)
                  (expect (file-exists? (call-with-input-file (string-append folder "/" n) read)) => #f))
                '("1" "2")))))

(define-scenario nobody-disturbs-another
  "What a scenario does to the file's variables, another does not see."
  (call-in-folder '("(define n 0)
                     (define-scenario one \"One.\" (set! n 1) (expect n => 1))
                     (define-scenario two \"Two.\" (expect n => 0))")
    (lambda (folder) (expect (says (report folder #:jobs 1) "# 2 passed, 0 failed")))))

(define-scenario too-long
  "What takes more processor time than the limit is stopped and told; what comes after is run."
  (call-in-folder '("(define-scenario ever \"For ever.\" (in pile) (run 2) (let loop () (loop)))
                     (define-scenario steps \"Too long.\" (in pile) (run 1e7))
                     (define-scenario after \"After.\" (expect #t))")
    (lambda (folder)
      (let ((result (command "test" folder "--limit" "1" "-j" "2")))
        (expect (car result) => 1)
        (expect (says (cdr result) "not ok 1" "an end within 1 s of processor time" "at 2.0 s"
                      "not ok 2" "ok 3 - a.scm: after"))))))

(define (wait-for condition)
  ;; However long it takes: whoever runs this ends what never ends.
  (or (condition)
      (begin (usleep 50000) (wait-for condition))))

(define (start-command file . arguments)
  ;; Start `bight ARGUMENTS ...', its output going to FILE; return the process.
  (let ((process (primitive-fork)))
    (when (zero? process)
      (dup2 (fileno (open file (logior O_CREAT O_WRONLY) #o600)) 1)
      (apply execl (guile) "guile" "-c" main arguments))
    process))

(define (alive? process)
  (false-if-exception (begin (kill process 0) #t)))

(define-scenario nothing-outlives-an-interrupt
  "^C ends the children too, and the status is 130."
  (call-in-folder
      '("(define-scenario hang \"Hangs.\"
           (call-with-output-file (string-append (dirname (current-filename)) \"/process\")
             (lambda (port) (write (getpid) port)))
           (let loop () (usleep 1000) (loop)))")
    (lambda (folder)
      (let* ((file (string-append folder "/process"))
             (text (string-append folder "/text"))
             (shell (start-command text "test" (string-append folder "/a.scm"))))
        (require (wait-for (lambda () (and (file-exists? file) (positive? (stat:size (stat file)))))))
        (let ((child (call-with-input-file file read)))
          (expect (alive? child))
          (kill shell SIGINT)
          (expect (status:exit-val (cdr (waitpid shell))) => 130)
          (expect (wait-for (lambda () (not (alive? child))))))))))


;;; What is attached to a failure.

(define-scenario a-failure-shows-the-dive
  "Time, last events and a drawing of the dive stand under a failure, in TAP and in JUnit, once."
  (call-in-folder '("(define-scenario s \"S.\" (in pile) (move! '(0 0 -5) #:speed 2) (run 5)
                       (expect (now) => 1) (expect (now) => 2))")
    (lambda (folder)
      (let* ((junit (string-append folder "/junit.xml"))
             (text (report folder #:junit junit))
             (xml (call-with-input-file junit get-string-all)))
        (for-each (lambda (text)
                    (expect (says text "at 5.0 s, after" "touched at " ": minnow p1" "from above, north up"
                                  "A anchor" "seed 1"))
                    (expect (not (string-contains text "from above"
                                                  (+ 1 (string-contains text "from above"))))))
                  (list text xml))))))

(define-scenario a-watched-claim-shows-the-moment
  "What is shown of `always' is the dive at the step at which it broke."
  (call-in-folder '("(define-scenario s \"S.\" (in pile) (always (< (now) 0.5) (run 3)))")
    (lambda (folder) (expect (says (report folder) "actual:   (< 0.5 0.5) at 0.5 s" "at 0.5 s")))))


;;; Chance.

(define-scenario seeded
  "Random things depend on the seed and the scenario alone; the seed is told with a failure."
  (call-in-folder '("(define-scenario a \"A.\" (expect (random 1000000) => (list 'seed (test-seed))))
                     (define-scenario b \"B.\" (expect (random 1000000) => (list 'seed (test-seed))))")
    (lambda (folder)
      (let ((seven (report folder #:seed 7)))
        (expect seven => (report folder #:seed 7))
        (expect (not (string=? seven (report folder #:seed 8))))
        (expect (says seven "(seed 7)" "#   seed 7"))
        (let ((alone (report folder #:seed 7 #:only "b")))
          (define (drawn text)
            (let ((at (string-contains text "actual:" (string-contains text "b: B."))))
              (substring text at (string-index text #\newline at))))
          (expect (drawn alone) => (drawn seven)))))))

(define property-text
  "(define limit 30)
   (define-property small \"Small.\" #:for ((n (integer 0 100))) #:cases 4 (expect (< n limit)))")

(define-scenario properties-in-parts
  "Many cases are shared out among processes, and the first that fails is told, whoever found it."
  (call-in-folder (list property-text)
    (lambda (folder)
      (let ((text (report folder #:cases 160 #:jobs 3)))
        (expect text => (report folder #:cases 160 #:jobs 1))
        (expect (says text "with seed 1" "(define n 30)"))))))

(define-scenario reproducers-are-files
  "A case that fails is written as a file that stands alone, and fails."
  (call-in-folder (list property-text)
    (lambda (folder)
      (let ((where (string-append folder "/found/here")))
        (report folder #:cases 40 #:reproducers where)
        (let ((text (report where)))
          (expect (says text "not ok 1 - small-seed-1-case-" "(expect (< n limit))" "(< 30 30)"
                        "# 0 passed, 1 failed")))))))

(define-scenario a-case-that-kills
  "Of a property whose process dies the case is told in which it did."
  (call-in-folder '("(define-property p \"P.\" #:for ((n (integer 0 9)))
                       (when (= n 7) (kill (getpid) SIGABRT)))")
    (lambda (folder) (expect (says (report folder) "it aborted" "in case " "(define n 7)")))))


;;; Lists and catalogues.

(define-scenario listing
  "--list runs nothing and shows names, sentences and places."
  (call-in-folder '("(define-scenario (s n) \"S.\" #:for ((n 1 2)) (primitive-exit 9))
(define-property p \"P.\" #:for ((x (uniform 0 1))) #:cases 9 (expect x))")
    (lambda (folder)
      (let ((result (command "test" folder "--list")))
        (expect (car result) => 0)
        (expect (says (cdr result) "a.scm:1: s (n=1): S." "a.scm:1: s (n=2): S."
                      "a.scm:2: p (9 cases): P."))))))

(define-scenario a-catalogue
  "The page has a sentence and a view of each scenario and of every world."
  (call-in-folder '("(define-scenario s \"A < B.\" (in pile) (expect #t))
                     (define-scenario t \"T.\" (expect #f))")
    (lambda (folder)
      (let ((where (string-append folder "/pages")))
        (expect (says (report folder #:catalogue where) "ok 1 - a.scm: s"))
        (let ((page (call-with-input-file (string-append where "/index.html") get-string-all)))
          (expect (says page "A &lt; B." "A anchor" "<p>T.</p>" "failed" "1 passed, 1 failed"))
          (for-each (lambda (name)
                      (expect (says page (string-append "<h3>" (symbol->string name) "</h3>"))))
                    (worlds)))))))


;;; The command line's manners.

(define-scenario (help-of-a-command name words)
  "bight COMMAND --help tells how it is called and its options, and does nothing else."
  #:for ((name "test" "lesson" "lessons" "bench" "snapshot" "pilot" "sweep" "replay") (words "--help" "-h"))
  (let ((result (command name words)))
    (expect (car result) => 0)
    (expect (cdr result) is (lambda (text) (string-prefix? (string-append "Usage: bight " name) text)))
    (expect (string-count (cdr result) #\newline) is (between 2 30)))
  (expect (command "--help" name) => (command name words)))

(define-scenario every-option-is-told
  "What `bight test' takes is what its help names; what it does not take is refused with the nearest."
  (define text (cdr (command "test" "--help")))
  (expect (says text "-j N" "--only RE" "--junit FILE" "--seed N" "--cases N" "--limit S" "--reproducers DIR"
                "--catalogue DIR" "--list"))
  (expect (command "test" "--sede" "3")
          => (cons 1 "bight: test has no option --sede; did you mean `--seed'?\n"))
  (expect (command "test" "--seed") => (cons 1 "bight: test: --seed needs a value after it\n"))
  (expect (command "test" "." "--seed" "x")
          => (cons 1 "bight: test: --seed needs a number after it, not x\n")))

(define-scenario the-nearest-command
  "A word that is no command and no file is answered with the nearest; help names all commands."
  (expect (command "sweeep")
          => (cons 1 "bight: there is no command and no file sweeep; did you mean `sweep'?\n"))
  (expect (command "qqqqqq")
          => (cons 1 "bight: there is no command and no file qqqqqq; bight --help lists the commands\n"))
  (expect (command "snapshot" "box" "-o" "box.png" "--size" "10")
          => (cons 1 "bight: snapshot: --size is written as in --size 1280x720, pixels across and down, not \"10\"\n"))
  (expect (command "--help" "sweeep")
          => (cons 1 "bight: there is no command sweeep; did you mean `sweep'?\n"))
  (expect (says (cdr (command "--help")) "bight test" "bight sweep" "bight lesson" "bight replay"
                "bight COMMAND --help"))
  (expect (car (command "-h")) => 0))

(define-scenario arguments-of-a-script-are-its-own
  "bight FILE.scm --help runs the script."
  (call-in-folder '("(write (cdr (command-line)))")
    (lambda (folder)
      (expect (command (string-append folder "/a.scm") "--help" "-j4") => '(0 . "(\"--help\" \"-j4\")")))))
