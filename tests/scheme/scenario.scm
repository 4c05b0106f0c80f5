;;; The runner of scenarios, tested by itself: what fails is reported as failing, with its reason.
;;;
;;; Each scenario here writes small scenario files, runs them in a report of their own and reads that.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(use-modules (bight test scenario)           ; outcome-status and its kin
             ((bight test expect) #:select (claim))
             ((bight shell doc) #:select (docstring-of))
             (ice-9 popen)
             (ice-9 textual-ports)
             (srfi srfi-1))

(define-world tank
  "Still water, one vehicle that goes where it is told."
  (sea (depth 20))
  (rov (named minnow) (type kinematic) (at 8 6 -9) (heading 30))
  (tether (named line) (type fathom) (from 0 0 -2) (to minnow) (length 20) (model catenary)))

(define tank-text
  "(define-world tank \"Still water.\" (sea (depth 20))
     (rov (named minnow) (type kinematic) (at 8 6 -9))
     (tether (named line) (type fathom) (from 0 0 -2) (to minnow) (length 20) (model catenary)))")


;;; Running a file of scenarios apart.

(define (temporary-folder)
  (mkdtemp (string-append (or (getenv "TMPDIR") "/tmp") "/bight-scenario-XXXXXX")))

(define (call-with-files texts receive)
  ;; Call RECEIVE with the names of files that hold TEXTS, in a folder of their own.
  (let* ((folder (temporary-folder))
         (names (map (lambda (i) (string-append folder "/t" (number->string i) ".scm"))
                     (iota (length texts)))))
    (dynamic-wind
      (lambda ()
        (for-each (lambda (name text)
                    (call-with-output-file name (lambda (port) (display text port))))
                  names texts))
      (lambda () (receive folder names))
      (lambda ()
        (for-each (lambda (name) (when (file-exists? name) (delete-file name)))
                  (cons (string-append folder "/junit.xml") names))
        (rmdir folder)))))

(define (report-on paths . options)
  ;; What `run-tests' prints about PATHS, as lines, and what it returns.
  (let* ((passed? #f)
         (text (with-output-to-string
                 (lambda () (set! passed? (apply run-tests paths options))))))
    (values (string-split (string-trim-right text) #\newline) passed?)))

(define (lines-for . forms)
  ;; The lines of the report on a file whose text FORMS make up.
  (call-with-files (list (string-join (cons tank-text forms) "\n"))
    (lambda (folder names)
      (call-with-values (lambda () (report-on names))
        (lambda (lines passed?) lines)))))

(define (scenario-lines . forms)
  ;; The lines of the report on one scenario with the body FORMS in the tank.
  (lines-for (string-append "(define-scenario s \"A story.\" (in tank) "
                            (string-join forms "\n") ")")))

(define (has-line? lines start)
  (any (lambda (line) (string-prefix? start line)) lines))

(define (says? lines text)
  (any (lambda (line) (string-contains line text)) lines))

(define (passes? . forms)
  (has-line? (apply scenario-lines forms) "ok 1 - "))

(define (fails? . forms)
  (has-line? (apply scenario-lines forms) "not ok 1 - "))


;;; Claims.

(define-scenario claims-that-hold
  "Every form of expect passes when it should."
  (expect (passes? "(expect #t)"))
  (expect (passes? "(expect (< 1 2))"))
  (expect (passes? "(expect 1 => 1.0)"))
  (expect (passes? "(expect (vec 1 2 3) => '(1 2 3))"))
  (expect (passes? "(expect \"abc\" => \"abc\")"))
  (expect (passes? "(expect '(a (1 2)) => '(a (1.0 2)))"))
  (expect (passes? "(expect (rov-position) is (about '(8 6 -9) #:within 0.01))"))
  (expect (passes? "(expect 359 is (about 1 #:within 3 #:degrees))"))
  (expect (passes? "(expect 359 is (about 1 #:degrees 3))"))
  (expect (passes? "(expect 2 is (between 1 3))" "(expect 2 is (above 1))" "(expect 2 is (below 3))"))
  (expect (passes? "(expect 2 is exact-integer?)"))
  (expect (passes? "(expect (place! '(1 2)) raises domain)"))
  (expect (passes? "(expect (car 1) raises)"))
  (expect (passes? "(require #t)")))

(define-scenario claims-that-fail
  "Every form of expect fails when it should."
  (expect (fails? "(expect #f)"))
  (expect (fails? "(expect (< 2 1))"))
  (expect (fails? "(expect 1 => 2)"))
  (expect (fails? "(expect +nan.0 => +nan.0)"))
  (expect (fails? "(expect (vec 1 2 3) => '(1 2))"))
  (expect (fails? "(expect (vec 1 2 3) => '(1 2 4))"))
  (expect (fails? "(expect (rov-position) is (about '(8 6 -8) #:within 0.5))"))
  (expect (fails? "(expect '(1 2) is (about '(1 2 3)))"))
  (expect (fails? "(expect +nan.0 is (about 1 #:within 1e9))"))
  (expect (fails? "(expect 359 is (about 3 #:degrees 3))"))
  (expect (fails? "(expect 4 is (between 1 3))"))
  (expect (fails? "(expect 1 is (above 1))"))
  (expect (fails? "(expect 1 is (below 1))"))
  (expect (fails? "(expect 1 is 1)"))
  (expect (fails? "(expect (place! '(1 2)) raises name)"))
  (expect (fails? "(expect 1 raises domain)"))
  (expect (fails? "(expect (place! '(1 2)))"))
  (expect (fails? "(require #f)")))

(define-scenario failures-explain-themselves
  "A failed claim is reported with form, expected, actual, file and line; the scenario goes on."
  (define lines
    (lines-for "(define-scenario s \"A story.\""
               "  (in tank)"
               "  (expect (tether-length) => 21)"
               "  (expect (> 1 (tether-length)))"
               "  (expect (place! '(1 2)) raises name))"))
  (expect (says? lines "t0.scm:6: (expect (tether-length) => 21)"))
  (expect (has-line? lines "#     expected: 21"))
  (expect (has-line? lines "#     actual:   20.0"))
  (expect (says? lines "t0.scm:7: "))
  (expect (has-line? lines "#     actual:   (> 1 20.0)"))
  (expect (has-line? lines "#     expected: a name error"))
  (expect (has-line? lines "#     actual:   domain error: place!: ")))

(define-scenario require-stops
  "After a failed require nothing more of the scenario runs, and the next one does."
  (define lines
    (lines-for "(define-scenario one \"First.\" (require #f) (display \"reached\"))"
               "(define-scenario two \"Second.\" (expect #t))"))
  (expect (has-line? lines "not ok 1 - t0.scm: one: First."))
  (expect (not (says? lines "reached")))
  (expect (has-line? lines "ok 2 - t0.scm: two: Second.")))

(define-scenario expect-outside
  "Outside a scenario expect returns #t or raises."
  (define (alone thunk)
    (parameterize (((@ (bight test expect) current-trial) #f)) (thunk)))
  (expect (alone (lambda () (expect 1 => 1))) => #t)
  (expect (alone (lambda () (expect 1 => 2))) raises failed-expectation))


;;; Errors and skips.

(define-scenario errors-do-not-stop-the-others
  "A scenario that raises fails with kind, procedure, message and line; the next one runs."
  (define lines
    (lines-for "(define-scenario one \"First.\" (in tank)"
               "  (run 1)"
               "  (place! '(1 2)))"
               "(define-scenario two \"Second.\" (in tank) (expect (now) => 0))"))
  (expect (has-line? lines "not ok 1 "))
  (expect (says? lines "t0.scm:6: an error that was not expected"))
  (expect (has-line? lines "#     actual:   domain error: place!: "))
  (expect (has-line? lines "ok 2 ")))

(define-scenario skipping
  "A skipped scenario is ok with a SKIP directive, but not if it failed before."
  (expect (has-line? (scenario-lines "(skip \"no wind\")" "(expect #f)")
                     "ok 1 - t0.scm: s: A story. # SKIP no wind"))
  (expect (fails? "(expect #f)" "(skip \"too late\")"))
  (expect (skip 3) raises domain))

(define-scenario own-dives
  "Each scenario runs in a dive of its own; the one outside stays."
  (in tank)
  (run 1)
  (define before (state-hash))
  (expect (passes? "(run 5)" "(place! '(1 2 -3))"))
  (expect (says? (lines-for "(define-scenario s \"No world.\" (now))") "there is no dive"))
  (expect (state-hash) => before))


;;; Watching.

(define-scenario watching
  "always, never and eventually look after every step."
  (in tank)
  (expect (passes? "(always (< (now) 2) (run 1))"))
  (expect (fails? "(always (< (now) 0.5) (run 1))"))
  (expect (passes? "(never (> (now) 2) (run 1))"))
  (expect (fails? "(never (= (now) (* 30 (time-step))) (run 1))"))
  (expect (passes? "(eventually (= (now) (* 30 (time-step))) (run 1))"))
  (expect (fails? "(eventually (> (now) 2) (run 1))"))
  (expect (fails? "(always (car 1) (run 1))"))
  (expect (fails? "(never (car 1) (run 1))")))

(define-scenario watching-tells-when
  "The first step at which the claim broke is reported, once, and the body goes on."
  (define lines
    (scenario-lines "(always (< (now) 0.5) (run 1))" "(expect (now) is (about 1))"))
  (expect (says? lines "expected: true after every step"))
  (expect (says? lines "(< 0.5 0.5) at 0.5 s"))
  (expect (count (lambda (line) (string-contains line "expected:")) lines) => 1))

(define-scenario watchers-leave
  "Nothing watches once the form has ended, however it ended."
  (in tank)
  (define looks 0)
  (define (look-on) (set! looks (+ looks 1)) #t)
  (always (look-on) (run 0.5))
  (expect (> looks 20))
  (set! looks 0)
  (false-if-exception (always (look-on) (error "leave")))
  (run 0.5)
  (expect looks => 0))


;;; Variables, worlds and names.

(define-scenario rows-of-values
  "#:for makes a scenario of each combination, the last variable varying fastest."
  (define lines
    (lines-for "(define-scenario (grid U V) \"Both.\" #:for ((U 1 (+ 1 1)) (V 'a 'b))"
               "  (expect (list U V) => '(2 b)))"))
  (expect (has-line? lines "1..4"))
  (expect (has-line? lines "not ok 1 - t0.scm: grid (U=1, V=a): Both."))
  (expect (has-line? lines "not ok 2 - t0.scm: grid (U=1, V=b): Both."))
  (expect (has-line? lines "ok 4 - t0.scm: grid (U=2, V=b): Both.")))

(define-scenario (by-row depth) "The variable of a row has its value in the body."
  #:for ((depth 10 30))
  (in (with tank (sea (depth depth))))
  (expect (sea-depth) => depth))

(define-scenario worlds-by-name
  "`in' takes the name of a world in worlds/, a variable of any kind, and expressions on either."
  (expect (passes? "(in open-water)" "(expect (rov-position) => '(0 15 -8))"))
  (expect (passes? "(in (with open-water (current 0.5 90)))"
                   "(expect (current-at '(0 0 -1)) is (about '(0.5 0 0)))"))
  (expect (passes? "(in (with tank (sea (depth 33))))" "(expect (sea-depth) => 33)"))
  (expect (says? (scenario-lines "(in opne-water)") "did you mean `open-water'?")))

(define-scenario (worlds-by-value which) "A variable of #:for can stand after `in'."
  #:for ((which 'open-water tank))
  (in which)
  (expect (parts) => '(minnow line)))

(define-scenario run-by-name
  "run-scenario takes the name of a scenario and returns an outcome."
  (define outcome
    (car ((@ (bight test scenario) collect-scenarios)
          (lambda () (define-scenario inner "Inner." (expect #t) (expect 1 => 2))))))
  (define result (run-scenario outcome))
  (expect (outcome-status result) => 'fail)
  (expect (outcome-claims result) => 2)
  (expect (length (outcome-failures result)) => 1)
  (expect (run-scenario 'no-such-scenario) raises name)
  (expect (run-scenario 3) raises domain))

(define-scenario malformed
  "What cannot be a scenario is refused when the file is loaded."
  (expect (has-line? (lines-for "(define-scenario s (expect #t))") "not ok 1 - t0.scm: could not load"))
  (expect (says? (lines-for "\n(define-scenario s \"S.\" (expect 1 2 3))") "t0.scm:5: "))
  (expect (says? (lines-for "(define-scenario (s U) \"S.\" #:for ((V 1)) #t)") "could not load"))
  (expect (says? (lines-for "(define-scenario s \"S.\" #t)" "(define-scenario s \"S.\" #t)")
                 "there is a scenario `s' already")))


;;; The report.

(define-scenario plan-and-order
  "The plan comes first, the points in order of definition, the file's name in each."
  (call-with-files (list "(define-scenario b \"B.\" (expect #t)) (define-scenario a \"A # 1.\" (expect #t))"
                         "(define-scenario c \"C.\" (expect #t))")
    (lambda (folder names)
      (call-with-values (lambda () (report-on folder))
        (lambda (lines passed?)
          (expect passed?)
          (expect (take lines 5) => '("TAP version 13"
                                      "1..3"
                                      "ok 1 - t0.scm: b: B."
                                      "ok 2 - t0.scm: a: A \\# 1."
                                      "ok 3 - t1.scm: c: C.")))))))

(define-scenario nothing-passes-in-silence
  "An empty file, a broken one, and a choice that leaves nothing are failures."
  (expect (has-line? (lines-for "") "not ok 1 - t0.scm: holds no scenario"))
  (expect (has-line? (lines-for "(car 1)") "not ok 1 - t0.scm: could not load"))
  (expect (says? (lines-for "\n(no-such-thing)") "t0.scm:5: Unbound variable: no-such-thing"))
  (expect (has-line? (lines-for "(") "not ok 1 - t0.scm: could not load"))
  (expect (run-tests "/no/such/place") raises io)
  (expect (run-tests '()) raises domain)
  (expect (run-tests "." #:only "(") raises domain))

(define-scenario choosing
  "#:only runs the scenarios alone whose name matches; matching none is a failure."
  (call-with-files '("(define-scenario one \"1.\" (expect #t)) (define-scenario two \"2.\" (expect #f))")
    (lambda (folder names)
      (call-with-values (lambda () (report-on names #:only "^on"))
        (lambda (lines passed?)
          (expect passed?)
          (expect (has-line? lines "1..1"))))
      (call-with-values (lambda () (report-on names #:only "three"))
        (lambda (lines passed?)
          (expect (not passed?))
          (expect (has-line? lines "not ok 1 ")))))))

(define-scenario output-is-a-comment
  "What a scenario prints cannot be taken for a result."
  (define lines (scenario-lines "(display \"ok 7\\nnot ok 8\")" "(expect #t)"))
  (expect (has-line? lines "ok 1 - "))
  (expect (has-line? lines "#   output: ok 7"))
  (expect (not (has-line? lines "ok 7"))))

(define-scenario junit
  "The JUnit report has the counts, and its text is escaped."
  (call-with-files '("(define-scenario s \"A & B.\" (expect (< 2 1)))
                      (define-scenario k \"K.\" (skip \"<why>\"))")
    (lambda (folder names)
      (let ((file (string-append folder "/junit.xml")))
        (report-on names #:junit file)
        (let ((text (call-with-input-file file get-string-all)))
          (expect (string-contains text "tests=\"2\" failures=\"1\" skipped=\"1\""))
          (expect (string-contains text "A &amp; B."))
          (expect (string-contains text (string-append "file=\"" (car names) "\" line=\"1\"")))
          (expect (string-contains text (string-append "file=\"" (car names) "\" line=\"2\"")))
          (expect (string-contains text "(expect (&lt; 2 1))"))
          (expect (string-contains text "<skipped message=\"&lt;why&gt;\"/>")))))))


;;; The command.

(define (guile)
  (string-append (assq-ref %guile-build-info 'bindir) "/guile"))

(define (command . arguments)
  ;; Run `bight ARGUMENTS ...': the exit status and the text on standard output and error.
  (let* ((port (apply open-pipe* OPEN_READ "/bin/sh" "-c" "exec \"$@\" 2>&1" "sh"
                      (guile) "-c" "(exit ((@ (bight cli) main) (command-line)))" arguments))
         (text (get-string-all port)))
    (cons (status:exit-val (close-pipe port)) text)))

(define-scenario exit-status
  "bight test exits 0 if all is well and 1 if a scenario fails or a file holds none."
  (call-with-files '("(define-scenario s \"S.\" (expect #t))"
                     "(define-scenario s \"S.\" (expect #f))"
                     "")
    (lambda (folder names)
      (expect (car (command "test" (first names))) => 0)
      (expect (car (command "test" (second names))) => 1)
      (expect (car (command "test" (third names))) => 1)
      (expect (car (command "test" folder)) => 1)
      (expect (cdr (command "test" (second names) "--only" "x"))
              is (lambda (text) (string-contains text "not ok 1 "))))))

(define-scenario one-clear-line
  "What goes wrong on the command line is told in one line, with status 1."
  (define (one-line? result start)
    (and (= 1 (car result))
         (string-prefix? start (cdr result))
         (= 1 (string-count (cdr result) #\newline))))
  (expect (one-line? (command "tset") "bight: there is no command and no file tset; did you mean `test'?"))
  (expect (one-line? (command "--vershion") "bight: there is no option --vershion; did you mean `--version'?"))
  (expect (one-line? (command "test" "--onyl" "x") "bight: test has no option --onyl; did you mean `--only'?"))
  (expect (one-line? (command "no/such.scm") "bight: there is no file \"no/such.scm\""))
  (expect (one-line? (command "-c" "(car 1)") "bight: "))
  (expect (one-line? (command "-c" "(place! 1)") "bight: place!: "))
  (call-with-files '("\n\n(enter! 'no-such-world)")
    (lambda (folder names)
      (let ((result (command (first names))))
        (expect (one-line? result (string-append "bight: " (first names) ":3: ")))))))

(define-scenario evaluating
  "bight -c prints the value of each expression that has one; exit gives the status."
  (expect (command "-c" "1 (if #f #f) (values 2 \"x\")") => '(0 . "1\n2\n\"x\"\n"))
  (expect (car (command "-c" "(exit 7)")) => 7)
  (call-with-files '("(write (cdr (command-line)))")
    (lambda (folder names)
      (expect (command (first names) "a" "--b") => '(0 . "(\"a\" \"--b\")"))))
  (call-with-files '("#!/usr/bin/env bight\n(display 1)\n(display 2)"
                     "#!/usr/bin/bight \\\n!#\n(display 3)"
                     "#!/usr/bin/env bight\n\n(oops)")
    (lambda (folder names)
      (expect (command (first names)) => '(0 . "12"))
      (expect (command (second names)) => '(0 . "3"))
      (expect (string-contains (cdr (command (third names))) ":3: "))
      (expect (car (command folder)) => 1))))


;;; The facade.

(define-scenario facade
  "Every name of the language is bound and none hides one of Guile's own."
  (define interface (resolve-interface '(bight)))
  (define guile-s (resolve-interface '(guile)))
  (for-each (lambda (name)
              (require (module-variable interface name))
              (require (not (module-variable guile-s name))))
            (language-names))
  (expect (delete-duplicates (language-names) eq?) => (language-names)))

(define-scenario every-name-is-documented
  "Every name of the language, a macro too, has a docstring."
  (for-each (lambda (name)
              (expect (docstring-of (module-ref (resolve-interface '(bight)) name)) is string?))
            (language-names)))

(define-scenario goes-with-srfi-1
  "In a module that uses SRFI-1 too, `every' is the language's."
  (in tank)
  (let ((module (make-fresh-user-module)))
    (for-each (lambda (name) (module-use! module (resolve-interface name)))
              '((bight) (srfi srfi-1)))
    (expect (eval '(cancel! (every 1 (now))) module) => #t)
    (expect (eval '(every even? '(1 2)) module) raises domain)))

(define-scenario a-predicate-after-the-arrow
  "Somebody who writes => for is hears of it, and the claim still fails."
  (let ((verdict (claim 3 => (above 2))))
    (expect (->bool (string-contains (car verdict) "`is': (expect E is (above 2))")) => #t)
    (expect (cdr verdict) => "3"))
  (expect (claim car => car) => #f))
