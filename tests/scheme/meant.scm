;;; Whatever is written a little wrong is answered by what was meant.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(use-modules (bight core errors)
             (bight core told)
             (bight test expect)
             (bight shell meant)
             (bight core schema)
             (bight shell usage)
             ((bight core verb) #:select (verb-arguments verb?))
             ((srfi srfi-1) #:hide (every))
             ((srfi srfi-1) #:select ((every . all?))))

(define (answer thunk)
  "Return what is said of the error that THUNK raises, a line, or #f if it raises none."
  (with-exception-handler exception->line
    (lambda () (thunk) #f)
    #:unwind? #t))

(define-syntax-rule (said expression)
  (answer (lambda () expression)))

;; A module that has the language: that of this file.
(define here (current-module))

(define (evaluate form)
  (save-module-excursion
   (lambda ()
     (set-current-module here)
     (eval form here))))

(define (answer-to form)
  (answer (lambda () (evaluate form))))

(define (silent-about wanted pairs)
  "Return those of PAIRS, (GIVEN . THUNK), whose answer does not hold the text that WANTED says of it."
  (filter-map (lambda (entry)
                (let ((text (answer (cdr entry))))
                  (and (not (and text (string-contains text (wanted (car entry)))))
                       (list (car entry) text))))
              pairs))

(define (swapped word)
  "Return WORD, a string, with two neighbours swapped that differ, near its middle; WORD itself if it has none."
  (define (swap i)
    (string-append (substring word 0 i) (string (string-ref word (+ i 1))) (string (string-ref word i))
                   (substring word (+ i 2))))
  (let* ((n (string-length word))
         (slips (filter-map (lambda (i) (and (not (string=? word (swap i))) (swap i))) (iota (max 0 (- n 1))))))
    (if (null? slips) word (list-ref slips (quotient (length slips) 2)))))


;;; What belongs elsewhere.

(define misplaced
  ;; alist, a part -> what the answer says of where it belongs
  '(((sea (depth 60) (seabed 40)) . "(seabed ...)")
    ((sea (bottom 40)) . "(seabed)")
    ((sea (floor -40)) . "(depth D)")
    ((seabed 40) . "(depth 40)")
    ((seabed (depth 40)) . "(sea (depth ...))")
    ((depth 60) . "(sea (depth ...))")
    ((rov (clump (at 1) (mass 1))) . "inside a tether")
    ((sea (wet-weight 1)) . "(tether (wet-weight ...))")
    ((sea (dpeth 40)) . "did you mean `depth'")))

(define-scenario what-is-written-in-the-wrong-place
  "A part inside another part, a field of another kind of part, a depth that is given to the bed: the answer says where it
belongs."
  (expect (remove (lambda (entry)
                    (string-contains (or (answer-to `(world ,(car entry) (rov (at 0 0 -5)))) "") (cdr entry)))
                  misplaced)
          => '()))


;;; Names.

(define-scenario a-name-without-its-quote
  "A name that is quoted everywhere else is known without its quote: of a part, a world, a model, a lesson."
  (in pile)
  (expect (length (append-map cdr (quoted-names))) is (above 60))
  (expect (silent-about (lambda (name) (simple-format #f "did you mean '~a?" name))
                        (filter-map (lambda (name)
                                      (and (not (module-variable here name))
                                           (cons name (lambda ()
                                                        (evaluate name)))))
                                    (append-map cdr (quoted-names))))
          => '())
  (expect (string-contains (answer-to '(enter! pile)) "pile is a world: did you mean 'pile?") is identity)
  (expect (string-contains (answer-to '(pile)) "did you mean 'pile?") is identity)
  (expect (string-contains (answer-to '(winding p1)) "p1 is a part of this dive: did you mean 'p1?") is identity)
  (expect (string-contains (answer-to '(enter! piel)) "did you mean 'pile, a world?") is identity))

(define-scenario a-name-misspelt
  "An unbound variable that is a slip away from a name of the language suggests it."
  (let ((names (filter (lambda (name) (> (string-length (symbol->string name)) 5)) (language-names))))
    (expect (silent-about
             (lambda (name) "did you mean ")
             (filter-map (lambda (name)
                           (let ((slip (string->symbol (swapped (symbol->string name)))))
                             (and (not (module-variable here slip))
                                  (cons name (lambda () (evaluate slip))))))
                         names))
            => '()))
  (expect (string-contains (answer-to '(drve! #:surge 1)) "did you mean `drive!'?") is identity)
  (expect (string-contains (answer-to '(dsiplay 1)) "did you mean `display'?") is identity)
  (expect (answer-to 'xyzzyx) is (lambda (text) (not (string-contains text "did you mean")))))

(define-scenario a-word-of-a-name
  "Of a single word that names have, the names are told, the shortest first, and not another word that it is like."
  (expect (string-suffix? "; there is `cut-tether!'" (answer-to '(cut!))) => #t)
  (expect (string-suffix? "; there is `haul-prospect'" (answer-to '(prospect))) => #t)
  (expect (string-suffix? "variable: altitude; there are `rov-altitude', `hold-altitude!'" (answer-to '(altitude)))
          => #t)
  (expect (string-contains (answer-to '(current)) "(describe 'sea); there are `current!'") is identity)
  (expect (string-contains (answer-to '(tension)) "(measure! #:tension ...)?; there are `tension-at'") is identity)
  (expect (string-contains (answer-to '(quux!)) "there ") => #f))

(define-scenario a-subject-is-counted
  "How many arguments were given is told of all of them, the name of a tether too."
  (in pile)
  (expect (string-contains (answer-to '(cut-tether! 'line 10)) "2 arguments were given") is identity))

(define-scenario a-field-written-as-a-name
  "A field of parts is no variable: which part has it is told."
  (expect (string-suffix? "; `drum' is a field of `tether': (describe 'tether)" (answer-to '(drum))) => #t))

(define-scenario a-keyword-without-its-mark
  "A keyword written as a variable is known."
  (expect (string-contains (answer-to '(drive! surge 1)) "did you mean #:surge, as in (drive! #:surge ...)?")
          is identity)
  (expect (string-contains (answer-to '(drive! :surge 1)) "did you mean #:surge") is identity))


;;; Arguments.

(define (words-of verb)
  ;; What VERB is told of in keywords.
  (map keyword->symbol (keywords-of verb)))

(define-scenario keywords-of-all-verbs
  "Each keyword of each verb is named when a slip is made in it."
  (in pile)
  (let ((cases (append-map
                (lambda (name)
                  (let ((verb (module-ref (resolve-interface '(bight)) name)))
                    (if (verb? verb)
                        (filter-map (lambda (word)
                                      (let ((slip (swapped (symbol->string word))))
                                        (and (> (string-length slip) 3)
                                             (not (string=? slip (symbol->string word)))
                                             (cons (symbol->keyword word)
                                                   (lambda ()
                                                     (verb (symbol->keyword (string->symbol slip)) 1))))))
                                    (words-of verb))
                        '())))
                (language-names))))
    (expect (length cases) is (above 50))
    (expect (silent-about (lambda (keyword) (simple-format #f "did you mean `~s'?" keyword)) cases) => '())))

(define-scenario a-value-of-another-kind
  "A name given as a string, a string as a name, a number between quotes: how it is written is told."
  (in pile)
  (expect (said (winding "p1")) is (lambda (text) (string-suffix? "; did you mean 'p1?" text)))
  (expect (said (run "20")) is (lambda (text) (string-suffix? "; did you mean 20?" text)))
  (expect (said (save! 'here)) is (lambda (text) (string-suffix? "; did you mean \"here\"?" text)))
  (expect (said (look #:columns "wide")) is (lambda (text) (not (string-contains text "did you mean"))))
  (expect (said (fault! 'thrster)) is (lambda (text) (string-suffix? "; did you mean `thruster'?" text)))
  (expect (said (plot 'tensoin)) is (lambda (text) (string-suffix? "; did you mean `tension'?" text)))
  (expect (said (enter! "piel")) is (lambda (text) (string-suffix? "; did you mean 'pile?" text))))


;;; Clauses.

(define-scenario fields-of-all-parts
  "Each field of each kind of part is named when a slip is made in it."
  (let ((cases (append-map
                (lambda (head)
                  (filter-map (lambda (name)
                                (let ((slip (swapped (symbol->string name))))
                                  (and (> (string-length slip) 3)
                                       (not (string=? slip (symbol->string name)))
                                       (cons name (lambda ()
                                                    (evaluate `(part ,head (,(string->symbol slip) 1))))))))
                              (head-names head)))
                (delete 'group (part-heads)))))
    (expect (length cases) is (above 100))
    (expect (silent-about (lambda (name) (simple-format #f "did you mean `~a'?" name)) cases) => '())))

(define-scenario clauses-of-forms
  "A slip in a clause of a scenario, a claim, a lesson, a study or a macro is answered by how it is written."
  (expect (answer-to '(define-scenario s "s" #:fro ((U 1)) (run 1)))
          is (lambda (text) (string-contains text "#:for ((VARIABLE VALUE ...) ...)")))
  (expect (answer-to '(expect 1 -> 1)) is (lambda (text) (string-contains text "did you mean `=>'?")))
  (expect (answer-to '(expect (run -1) rases domain))
          is (lambda (text) (string-contains text "did you mean `raises'?")))
  (expect (parameterize ((current-trial #f)) (answer-to '(expect (vec 1) raises domian)))
          is (lambda (text) (string-contains text "did you mean `domain'?")))
  (expect (answer-to '(define-lesson l "l" (tsak "x"))) is (lambda (text) (string-contains text "did you mean (task")))
  (expect (answer-to '(define-study s "s" (measrue (a 1))))
          is (lambda (text) (string-contains text "did you mean (measure")))
  (expect (answer-to '(define-study s "s" #:fro ((a 1)) (measure (a 1))))
          is (lambda (text) (string-contains text "#:for")))
  (expect (answer-to '(sample! 'tension)) is (lambda (text) (string-contains text "it is used as (sample!"))))


;;; The command line.

(define cli (resolve-module '(bight cli)))
(define commands (module-ref cli 'commands))

(define (command-line-answer . words)
  (answer (lambda () ((module-ref cli 'run-command) words))))

(define (long? word) (and (string-prefix? "--" word) (> (string-length word) 4)))

(define-scenario words-of-the-command-line
  "Each command and each option of each command is named when a slip is made in it, also when a value follows."
  (let ((first-words (filter (lambda (word) (> (string-length word) 2)) (module-ref cli 'first-words)))
        (options (append-map (lambda (command)
                               (filter-map (lambda (option)
                                             (and (long? (car option))
                                                  (list (command-name command) (car option))))
                                           (command-options command)))
                             (filter command-run commands))))
    (expect (length options) is (above 40))
    (expect (filter-map (lambda (word)
                          (let ((text (command-line-answer (swapped word))))
                            (and (not (string-contains (or text "") (string-append "did you mean `" word "'?")))
                                 (list word text))))
                        first-words)
            => '())
    (for-each (lambda (tail)
                (expect (filter-map (lambda (entry)
                                      (let ((text (command-line-answer
                                                   (first entry) (string-append (swapped (second entry)) tail))))
                                        (and (not (string-contains (or text "")
                                                                   (string-append "did you mean `" (second entry) "'?")))
                                             (list entry text))))
                                    options)
                        => '()))
              '("" "=7"))
    (expect (command-line-answer "help") is (lambda (text) (string-contains text "did you mean `--help'?")))
    (expect (command-line-answer "--lsiten=/tmp/x") is (lambda (text) (string-contains text "did you mean `--listen'?")))
    (expect (command-line-answer "zzzz") is (lambda (text) (not (string-contains text "did you mean"))))))

(define-scenario files-that-are-not-there
  "A file whose name is misspelt is answered by the file beside it, whichever command takes it."
  (let ((file (scratch-file "careful.scm")))
    (call-with-output-file file (lambda (port) (display "1" port)))
    (let ((slip (string-append (dirname file) "/carefull.scm"))
          (meant (string-append "did you mean `" file "'?")))
      (expect (command-line-answer slip) is (lambda (text) (string-contains text meant)))
      (expect (command-line-answer "test" slip) is (lambda (text) (string-contains text meant)))
      ;; Each command that takes a file.
      (for-each (lambda (words)
                  (expect (cons words (apply command-line-answer (append words (list slip))))
                          is (lambda (told) (string-contains (cdr told) meant))))
                '(("watch") ("replay") ("sweep") ("follow") ("lesson") ("pilot") ("snapshot" "-o" "x.png")
                  ("identify" "--unknown" "ei"))))))
