;;; What `help' says of a question is what the question returns.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(use-modules (bight core argument)
             (bight shell guide)
             (bight shell fold)
             ((bight view text) #:select (picture-lines))
             (bight shell topics)
             ((bight shell doc) #:select (help-on related docstring-of))
             ((bight world current) #:select (current-help current-forms))
             ((bight core told) #:select (exception->line))
             ((bight shell commands) #:select (commands))
             ((bight shell usage) #:select (command-examples command-name command-options command-run))
             ((bight shell manual) #:select (manual-sections))
             ((bight world describe) #:select (description-rows))
             ((bight core schema)
              #:select (head-names head-fields field-name field-text field-unit field-kind))
             ((bight core allowance) #:select (check-field field-range))
             ((bight core sentence) #:select (event-sentence))
             ((bight engine) #:select (%event-kinds))
             ((bight shell words) #:select (all-heads example-value))
             ((bight core verb) #:select (verb? verb-arguments verb-parameters))
             ((srfi srfi-1) #:hide (every))
             ((srfi srfi-1) #:select ((every . all?))))

(define questions
  ;; Verbs that ask: all that these modules export and the language has.
  (append-map (lambda (module)
                (filter (lambda (name)
                          (and (memq name (language-names))
                               (not (string-suffix? "!" (symbol->string name)))))
                        (module-map (lambda (name variable) name) (resolve-interface module))))
              '((bight dive query) (bight dive contact) (bight dive aware) (bight dive figures) (bight dive instruments) (bight dive foresight))))

(define (says? text . words)
  (any (lambda (word) (string-contains text word)) words))

(define (first-sentence text)
  (let* ((text (string-join (string-tokenize text)))
         (end (string-contains text ". ")))
    (if end (substring text 0 end) text)))

(define (row-of-numbers? rank columns)
  (lambda (value) (and (array? value) (= rank (array-rank value))
                       (or (not columns) (= columns (last (array-dimensions value)))))))

;; What the words of a docstring promise, the first that fits: a predicate.
(define promises
  `((("Return #t if" "Return #t unless" "Return #t while") . ,boolean?)
    (("alist") . ,(lambda (value) (and (list? value) (all? pair? value))))
    (("polylines") . ,list?)
    (("polyline" "n x 3") . ,(row-of-numbers? 2 3))
    ((", a list" "list of" "lists (" "a list (") . ,list?)
    (("f64vector") . ,f64vector?)
    ((", a point" ", a vector") . ,(row-of-numbers? 1 3))
    ((", m" ", N" "degrees" "whole number" "share of") . ,real?)))

(define (promise-of text)
  ;; What TEXT, the first sentence of a docstring, promises; #f if nothing that is known.
  (and=> (find (lambda (entry) (apply says? text (car entry))) promises) cdr))

(define (as-told? text value)
  (let ((promise (promise-of text)))
    (or (not promise)
        (and (says? text "or #f") (not value))
        (promise value))))

(define (told-and-not-so name)
  ;; #f, or NAME, what it says and what it returns in the present dive.
  (let* ((verb (module-ref (resolve-interface '(bight)) name #f))
         (text (and (procedure? verb) (procedure-documentation verb)))
         (value (and text
                     (with-exception-handler
                         (lambda (e) (if (bight-error? e) e (raise-exception e)))
                       (lambda () (verb))
                       #:unwind? #t))))
    (and text (not (bight-error? value)) (not (as-told? (first-sentence text) value))
         (list name (first-sentence text) value))))

(define (promise-in name)
  ;; What the help of the question NAME promises.
  (let ((text (procedure-documentation (module-ref (resolve-interface '(bight)) name))))
    (and text (promise-of (first-sentence text)))))

(define-scenario (help-says-what-is-returned model)
  "Each question returns what the first sentence of its help says, or is refused, with every model."
  #:for ((model 'rubber-band 'steady 'dynamic))
  (in (with pile (line (model ,model) (nodes 16))))
  (run 1)
  (expect (length questions) is (above 80))
  (expect (length (filter promise-in questions)) is (above 70))
  (expect (as-told? "Return the depth of the vehicle, m." 'deep) => #f)
  (for-each (lambda (question) (expect (told-and-not-so question) => #f)) questions))


;;; What help shows besides.

(define here (current-module))

(define (verbs)
  (filter-map (lambda (name)
                (let ((value (module-ref (resolve-interface '(bight)) name)))
                  (and (verb? value) (cons name value))))
              (language-names)))

(define (help-text topic)
  (with-output-to-string (lambda () (display (eval `(help ,topic) here)))))

;; Numbers that count or compare, in no unit.
(define bare
  '(low high value n number jobs seed durations least most most-points hits trials components competence surge sway
    heave yaw score given truth factor grip share v zoom))

(define (bare? name)
  (memq (if (keyword? name) (keyword->symbol name) name) bare))

(define-scenario units-of-all-numbers
  "Each argument of a verb that is a number has a unit, or is known to have none."
  (expect (append-map (lambda (entry)
                        (filter-map (lambda (row)
                                      (let ((type (third row)))
                                        (and type (accepts? type 1/2) (not (accepts? type "x"))
                                             (not (unit-of (car entry) (second row)))
                                             (not (bare? (second row)))
                                             (not (memq (argument-type-name type) '(bearing any flag)))
                                             (list (car entry) (second row)))))
                                    (verb-parameters (cdr entry))))
                      (verbs))
          => '()))

;; Evaluated by nobody here: they need a terminal, a renderer, another program or an hour.
(define not-run '(pilot! film run-tests snapshot show plot))

(define-scenario each-verb-has-an-example
  "The help of each verb has an example."
  (expect (filter-map (lambda (entry)
                        (and (null? (examples-of (car entry) (cdr entry)))
                             (not (memq (car entry) in-a-lesson))
                             (car entry)))
                      (verbs))
          => '()))

(define (stopped form)
  ;; Why FORM cannot be evaluated in a dive of its own, or #f.
  (with-exception-handler
      (lambda (e) (if (and (bight-error? e) (eq? 'unsupported (bight-error-kind e))) #f (exception->line e)))
    (lambda ()
      (enter! 'pile)
      (run 1)
      (with-output-to-string (lambda () (eval form here)))
      #f)
    #:unwind? #t))

(define-scenario (examples-run part)
  "Each example runs."
  #:for ((part 0 1 2 3))
  (let ((folder (dirname (scratch-file "x"))) (before (getcwd)))
    (setenv "BIGHT_LOGBOOK" (string-append folder "/logbook.db"))
    (dynamic-wind
      (lambda () (chdir folder))
      (lambda ()
        (for-each (lambda (entry i)
                    (when (and (= part (modulo i 4)) (not (memq (car entry) not-run)))
                      (for-each (lambda (form) (expect (list (car entry) (stopped form)) => (list (car entry) #f)))
                                (examples-of (car entry) (cdr entry)))))
                  (verbs) (iota (length (verbs)))))
      (lambda () (chdir before)))))

(define-scenario topics-hold-all-names
  "Each name of the language belongs to one topic."
  (expect (filter (lambda (name) (not (topic-of name))) (language-names)) => '())
  (let ((all (append-map topic-names (map car (topics)))))
    (expect (length all) => (length (delete-duplicates all)))
    (expect (lset-xor eq? all (language-names)) => '()))
  (for-each (lambda (topic)
              (expect (string-contains (with-output-to-string (lambda () (display (help)))) (cdr topic))
                      is identity))
            (topics)))

(define-scenario help-on-nothing-is-the-tour
  "Without a word, and with an empty one, help begins at the beginning."
  (define (said topic)
    (with-output-to-string (lambda () (display topic))))
  (expect (said (help "")) => (said (help)))
  (expect (said (help "  ")) => (said (help))))

(define (names-in-see-also name)
  ;; What the help of NAME shows as related, and its topic, as symbols; what else NAME is comes after an empty line.
  (let* ((text (help-text name)) (at (string-contains text "See also: ")))
    (if at
        (map string->symbol (string-tokenize (substring text (+ at 10) (or (string-contains text "\n\n" at) (string-length text)))
                                             (char-set-complement (string->char-set ", ().\n"))))
        '())))

(define (quotes? name other)
  (string-contains (docstring-of (module-ref (resolve-interface '(bight)) name)) (string-append "`" (symbol->string other) "'")))

(define-scenario see-also-leads-on
  "The help of each verb names others, which there are, and which name it where a text names one of the two."
  (expect (length (verbs)) is (above 300))
  (let ((all (map (lambda (name) (cons name (related name))) (language-names)))
        (known (append '(help) (map car (topics)) (language-names))))
    (define (leads-back? other name) (memq name (assq-ref all other)))
    (for-each
     (lambda (entry)
       (let* ((name (car entry)) (others (assq-ref all name)) (shown (names-in-see-also name)))
         (expect (list name (pair? others)) => (list name #t))
         (expect (list name (lset-difference eq? shown known)) => (list name '()))
         (expect (list name (lset-difference eq? others shown)) => (list name '()))
         (expect (list name (remove (lambda (other) (or (not (quotes? name other)) (leads-back? other name))) others))
                 => (list name '()))
         (expect (list name (remove (lambda (other) (and (memq other known) (leads-back? other name))) (companions-of name)))
                 => (list name '()))))
     (verbs))))

(define (silent-on-absence name verb)
  ;; The arguments of VERB, called NAME, that are not required, and of which its help does not say what stands for them.
  (let ((optional (remove (lambda (argument) (eq? 'required (first argument))) (verb-arguments verb))))
    (if (null? optional)
        '()
        (let ((text (help-text name)))
          (remove (lambda (argument)
                    (and (says? (third argument) "left out" "; none, one or several")
                         (string-contains text (third argument))))
                  optional)))))

(define-scenario what-may-be-left-out-is-said
  "The help of each verb says of each argument that is not required what becomes of it when it is left out."
  (for-each (lambda (entry)
              (expect (list (car entry) (silent-on-absence (car entry) (cdr entry))) => (list (car entry) '())))
            (verbs)))

(define (options-typed line)
  ;; The words of LINE that name an option of the command.
  (map (lambda (word) (car (string-split (string-trim-right word (string->char-set ")\"")) #\=)))
       (filter (lambda (word) (and (string-prefix? "-" word) (> (string-length word) 1)))
               (string-split line #\space))))

(define-scenario commands-have-examples
  "The help of each command shows at least one line to type, with options that the command has."
  (for-each
   (lambda (command)
     (let ((name (command-name command)))
       (unless (string=? name "--version")
         (expect (list name (length (command-examples command))) is (lambda (told) (positive? (second told)))))
       (for-each (lambda (line)
                   (expect (list line (->bool (or (string-contains line (string-append "bight " name)) (string=? name "--environment"))))
                           => (list line #t))
                   (expect (list line (lset-difference string=? (options-typed line)
                                                       (cons name (map car (command-options command)))))
                           => (list line '())))
                 (command-examples command))))
   (filter command-run commands)))

(define-scenario help-finds
  "A word is looked for in names, in what they say, and in the manual; all that is related is named."
  (expect (string-contains (help-text "tangle") "fouled?") is identity)
  (expect (string-contains (help-text "autopilot") "release!") is identity)
  (unless (null? (manual-sections))     ; it is made where makeinfo is
    (expect (string-contains (help-text "autopilot") "`info bight'") is identity))
  (expect (string-contains (help-text 'pay-out!) "m/s; a number above 0 and at most 1e12; 0.5 when left out")
          is identity)
  (expect (string-contains (help-text 'fouled?) "foul-reason") is identity)
  (expect (string-contains (help-text "xyzzyx") "There is no") is identity))

(define-scenario help-of-currents
  "The help of current! shows each form of a current; what it shows can be typed."
  (in pile)
  (let ((lines (current-help)))
    (expect (string-prefix? (string-join lines "\n")
                            (substring (help-text 'current!) (string-contains (help-text 'current!) "Forms:")))
            => #t)
    (expect (length (filter (lambda (line) (string-contains line "(current! ")) lines))
            => (- (length current-forms) 2)) ; grid and from are files of a world
    (for-each (lambda (line)
                (when (string-contains line "(current! ")
                  (expect (and (stopped (call-with-input-string line read)) line) => #f)))
              lines)))

(define-scenario a-sea-is-described
  "What a sea can have is described, whether there is a dive or not."
  (define (names) (map string->symbol (map first (description-rows (describe 'sea)))))
  (expect (lset-xor eq? (names) (head-names 'sea)) => '())
  (enter! 'pile)
  (expect (lset-xor eq? (names) (head-names 'sea)) => '())
  (expect (all? (lambda (row) (> (string-length (last row)) 5)) (description-rows (describe 'sea))) => #t)
  (enter! 'cage)
  (expect (lset-difference eq? (head-names 'seabed) (map string->symbol (map first (description-rows (describe 'seabed)))))
          => '()))

(define (example-taken? head field)
  ;; Is the example of FIELD, if help shows one, a value that it takes?
  (let ((text (example-value field)))
    (or (not text)
        (memq (field-kind field) '(track points mesh grid waves))
        (let ((values (call-with-input-string (string-append "(" text ")") read)))
          (bight-error-free?
           (lambda () (check-field 'help head (field-name field)
                                   (if (null? (cdr values)) (car values) values))))))))

(define (bight-error-free? thunk)
  (with-exception-handler (lambda (e) (if (bight-error? e) #f (raise-exception e)))
    (lambda () (thunk) #t)
    #:unwind? #t))

(define-scenario fields-have-help
  "Help on each field says what it is and what it may be, and shows a value that it takes."
  (for-each
   (lambda (head)
     (for-each
      (lambda (field)
        (let ((text (help-text (field-name field))))
          (expect (list head (field-name field)
                        (->bool (string-contains text (field-text field)))
                        (->bool (string-contains text (field-range field)))
                        (->bool (example-taken? head field)))
                  => (list head (field-name field) #t #t #t))))
      (head-fields head)))
   (all-heads)))

(define-scenario other-words-have-help
  "Help on events, units, keywords, options, worlds, types and lessons says what they are."
  (for-each (lambda (event)
              (expect (list event (string-null? (event-sentence event))) => (list event #f))
              (expect (list event (->bool (string-contains (help-text event) (event-sentence event)))) => (list event #t)))
            (%event-kinds))
  (for-each (lambda (unit)
              (expect (list unit (->bool (string-contains (help-text unit) (string-append unit ": a unit.")))) => (list unit #t)))
            (remove string-null?
                    (delete-duplicates
                     (append-map (lambda (head)
                                   (append-map (lambda (field) (map string-trim (string-split (field-unit field) #\,)))
                                               (head-fields head)))
                                 (all-heads)))))
  (expect (string-contains (help-text '#:surge) "(drive! #:surge ...)") is identity)
  (expect (string-contains (help-text "--last-failed") "bight test --last-failed") is identity)
  (expect (string-prefix? "pile: One pile" (help-text 'pile)) => #t)
  (expect (string-contains (help-text 'pile) "(enter! 'pile)") is identity)
  (expect (string-contains (help-text 'fathom) "(type fathom)") is identity)
  (expect (string-contains (help-text 'snag-drill) "bight lesson snag-drill") is identity)
  ;; Scheme has a word of the same name.
  (expect (string-prefix? "length: a field of tether." (help-text 'length)) => #t))

(define-scenario help-fits-the-terminal
  "At any width no line is longer, no word is lost, and what goes on stands below its own column."
  (in open-water)
  (define (words lines) (append-map string-tokenize lines))
  (for-each
   (lambda (columns)
     (for-each
      (lambda (topic)
        (let ((lines (joined-lines (picture-lines (help-on topic)))))
          (define folded (folded-lines lines columns))
          (expect (filter (lambda (line) (and (> (string-length line) columns) (string-index (string-trim line) #\space)))
                          folded)
                  => '())
          (expect (words folded) => (words lines))))
      '("" "fly" "snapshot" "current!" "tangle")))
   '(40 80 120))
  (expect (folded-lines '("  sure?       Return what is known, and so on") 30)
          => '("  sure?       Return what is" "              known, and so on"))
  (expect (folded-lines '("  #:at: m; a point, or #f; may be left out") 30)
          => '("  #:at: m; a point, or #f; may" "    be left out"))
  (expect (folded-lines '("One.  Two, and a long sentence") 20) => '("One.  Two, and a" "long sentence"))
  (expect (folded-lines '("a-word-that-is-longer-than-a-line, and more") 20)
          => '("a-word-that-is-longer-than-a-line," "and more"))
  (expect (folded-lines '("as it is") #f) => '("as it is")))
