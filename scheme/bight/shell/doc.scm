;;; (bight shell doc) --- help at the prompt.
;;;
;;; `(help)' is a short tour, `(help NAME)' tells how NAME is used and what it does.  Nothing is written
;;; twice: usage and arguments come from the verb itself, macros carry their docstring in the
;;; transformer, parts answer through `describe', all other words by (bight shell words).
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(define-module (bight shell doc)
  #:use-module (bight core errors)
  #:use-module ((bight core sentence) #:select (first-sentence))
  #:use-module (bight core verb)
  #:use-module (bight shell fold)
  #:use-module (bight shell guide)
  #:use-module ((bight shell manual) #:select (sections-about))
  #:use-module (bight shell topics)
  #:use-module ((bight shell words) #:select (word-lines))
  #:use-module ((bight core told) #:select (code->string))
  #:use-module (bight view text)
  #:use-module (ice-9 regex)
  #:use-module (srfi srfi-1)
  #:export (help-on
            usage-of
            docstring-of
            related
            language-ref)
  #:replace (help))


;;; The names of the language.

(define (language-names)
  ((module-ref (resolve-interface '(bight)) 'language-names)))

(define (language-ref name default)
  "Return what NAME, a symbol, means in the language or else in the present module, or DEFAULT."
  (let ((variable (or (module-variable (resolve-interface '(bight)) name)
                      (module-variable (current-module) name))))
    (if (and variable (variable-bound? variable))
        (variable-ref variable)
        default)))


;;; One name.

(define (tidy-docstring text)
  ;; The lines of TEXT, without the indentation that its source gave them.
  (let ((lines (string-split text #\newline)))
    (cons (car lines) (map string-trim (cdr lines)))))

(define (joined-if-folded lines)
  (if (reader-columns) (joined-lines lines) lines))

(define docstrings (make-weak-key-hash-table)) ; those read: compiled code is searched for each

(define (read-docstring value)
  (cond ((macro? value) (procedure-documentation (macro-transformer value)))
        ((and (procedure? value) (procedure-documentation value)))
        (else ((module-ref (resolve-interface '(ice-9 documentation)) 'object-documentation) value))))

(define (docstring-of value)
  "Return what VALUE, also a macro, says of itself, a string, or #f."
  (let ((known (hashq-ref docstrings value docstrings)))
    (if (eq? known docstrings)
        (let ((text (read-docstring value)))
          (hashq-set! docstrings value text)
          text)
        known)))

(define (plain-usage name procedure)
  ;; How a procedure that is not a verb is called.
  (let* ((arity ((module-ref (resolve-interface '(ice-9 session)) 'procedure-arguments) procedure))
         (part (lambda (key) (or (assq-ref arity key) '())))
         (word (lambda (text) (string-upcase (word->string text)))))
    (string-append
     "(" (string-join
          (append (list (symbol->string name))
                  (map word (part 'required))
                  (map (lambda (x) (string-append "[" (word x) "]")) (part 'optional))
                  (map (lambda (x) (simple-format #f "[~s ~a]" (car x)
                                                  (word (keyword->symbol (car x)))))
                       (part 'keyword))
                  (if (assq-ref arity 'rest) (list (word (assq-ref arity 'rest)) "...") '()))
          " ")
     ")")))

(define (macro-usages name macro)
  ;; The patterns of a macro made by syntax-rules; others begin their docstring with them.
  (map (lambda (pattern) (simple-format #f "~s" (cons name pattern)))
       (or (assq-ref (procedure-properties (macro-transformer macro)) 'patterns) '())))

(define (usage-lines name value doc)
  (cond ((and doc (string-prefix? "(" doc)) '())
        ((procedure? value) (list (or (verb-usage value) (plain-usage name value))))
        ((macro? value) (macro-usages name value))
        (else (list (simple-format #f "~a = ~a" name (brief value))))))

(define (usage-of name)
  "Return how NAME, a symbol, is used, in a line, or #f if the language does not tell."
  (let* ((value (language-ref name #f))
         (doc (and value (docstring-of value)))
         (lines (usage-lines name value doc)))
    (cond ((pair? lines) (string-join lines " or "))
          ((and doc (string-prefix? "(" doc)) (car (string-split doc #\:)))
          (else #f))))

(define (argument-lines name value)
  ;; A line for each argument: its unit, what it takes, what stands for it when it is left out.
  (let ((arguments (verb-arguments value)))
    (if (null? arguments)
        '()
        (cons "" (map (lambda (argument)
                        (let ((unit (unit-of name (second argument))))
                          (simple-format #f "  ~a: ~a~a" (word->string (second argument))
                                         (if unit (string-append unit "; ") "")
                                         (third argument))))
                      arguments)))))

(define (example-lines name value)
  (let ((examples (examples-of name value)))
    (if (null? examples)
        '()
        (cons* "" "For example:"
               (map (lambda (form) (string-append "  " (code->string form))) examples)))))

(define (quoted-words text)
  ;; The names that TEXT quotes, as in `run'.
  (map (lambda (m) (string->symbol (match:substring m 1))) (list-matches "`([^' \n]+)'" text)))

(define (mentions name other)
  (let ((doc (docstring-of (language-ref other #f))))
    (and doc (string-contains doc (simple-format #f "`~a'" name)))))

(define (words-of name)
  ;; How the words of NAME begin that say what it is about.
  (filter-map (lambda (word) (and (> (string-length word) 3) (substring word 0 4)))
          (string-split (string-trim-right (symbol->string name) (string->char-set "!?")) #\-)))

(define (kin name names)
  ;; Those of NAMES that have a word in common with NAME.
  (let ((words (words-of name)))
    (filter (lambda (other)
              (let ((text (symbol->string other)))
                (and (any (lambda (word) (string-contains text word)) words)
                     (pair? (lset-intersection string=? words (words-of other))))))
            names)))

(define most-related 6)                 ; of those that a word alone relates

(define (related name)
  "Return what to see besides NAME, names of the language: what its text names, what names it, what it is used with, all
of which name each other; then, while these are few, what has a word in common with it."
  (let* ((names (delete name (language-names)))
         (doc (or (docstring-of (language-ref name #f)) ""))
         (near (delete-duplicates
                (append (filter (lambda (word) (memq word names)) (quoted-words doc))
                        (filter (lambda (other) (mentions name other)) names)
                        (companions-of name))
                eq?)))
    (if (>= (length near) most-related)
        near
        (append near (take-up-to (- most-related (length near)) (kin name (lset-difference eq? names near)))))))

(define (more-lines value)
  ;; What a verb tells besides, such as the forms of a current.
  (let ((more (and (procedure? value) (procedure-property value 'more))))
    (if more (cons "" (more)) '())))

(define (see-also name)
  (let ((topic (topic-of name)))
    (if topic
        (list ""
              (string-append "See also: "
                             (string-concatenate (map (lambda (other) (simple-format #f "~a, " other)) (related name)))
                             (simple-format #f "(help ~a)." topic)))
        '())))

(define (help-lines name value)
  (let ((doc (docstring-of value)))
    (append (usage-lines name value doc)
            (if doc (joined-if-folded (tidy-docstring doc)) '())
            (if (procedure? value) (argument-lines name value) '())
            (more-lines value)
            (example-lines name value)
            (see-also name))))


;;; Other words: parts of a world, and words that mean nothing.

(define (described word)
  ;; What `describe' says of WORD, a part or kind of part, or #f.
  (let ((describe (language-ref 'describe #f)))
    (and (procedure? describe)
         (with-exception-handler
             (lambda (exception)
               (if (bight-error? exception) #f (raise-exception exception)))
           (lambda () (call-with-output-string (lambda (port) (display (describe word) port))))
           #:unwind? #t))))

(define (take-up-to n items)
  (if (> (length items) n) (take items n) items))

(define (says? name text)
  ;; Has NAME, or what it says of itself, TEXT in it?
  (or (string-contains-ci (symbol->string name) text)
      (let ((doc (docstring-of (language-ref name #f))))
        (and doc (string-contains-ci doc text)))))

(define (about text)
  ;; The names of the language about TEXT: those first that have it in them.
  (call-with-values (lambda ()
                      (partition (lambda (name) (string-contains-ci (symbol->string name) text))
                                 (filter (lambda (name) (says? name text)) (language-names))))
    append))

(define most-found 14)

(define (left-out all)
  (let ((n (- (length all) most-found)))
    (if (positive? n) (list (simple-format #f "  and ~a more" n)) '())))

(define (names->lines names)
  ;; Each name with its first sentence.
  (let ((width (fold (lambda (name width) (max width (string-length (symbol->string name)))) 0 names)))
    (map (lambda (name)
           (string-trim-right
            (string-append "  " (string-pad-right (symbol->string name) width) "  "
                           (first-sentence (or (docstring-of (language-ref name #f)) "")))))
         names)))

;; What people call things that have another name here.
(define other-words
  '(("tangle" "fouled" "caught") ("entangle" "fouled" "caught") ("snag" "fouled" "stuck")
    ("rope" "tether") ("cable" "tether") ("umbilical" "tether") ("wind" "winding") ("drum" "pay-out")
    ("undo" "rewind") ("fork" "what-if") ("simulate" "run") ("step" "run") ("camera" "snapshot")
    ("screenshot" "snapshot") ("video" "film") ("graph" "plot") ("tide" "current") ("joystick" "drive!")
    ("thrust" "drive!") ("velocity" "rov-velocity") ("force" "tension")))

(define (names-about text)
  ;; The names about TEXT, and about what is meant by it.
  (delete-duplicates (append (about text) (append-map about (or (assoc-ref other-words (string-downcase text)) '())))
                     eq?))

(define (times n)
  (if (= n 1) "once" (simple-format #f "~a times" n)))

(define (found-lines text)
  ;; What is known about TEXT, or the empty list.
  (let ((names (names-about text)) (sections (sections-about text)))
    (append (names->lines (take-up-to most-found names))
            (left-out names)
            (if (null? sections)
                '()
                (cons "In the manual, `info bight':"
                      (map (lambda (section) (simple-format #f "  ~a (~a)" (car section) (times (cdr section))))
                           (take-up-to 6 sections)))))))

(define (unknown word)
  (let* ((text (word->string word))
         (near (nearest word (append (language-names) (map car (topics)))))
         (found (found-lines text)))
    (cond ((and (pair? found) (not (and near (symbol? word))))
           (cons (simple-format #f "About ~s:" text) found))
          (else
           (cons (simple-format #f "There is no `~a'.~a" text
                                (if near
                                    (simple-format #f "  Do you mean ~a?" near)
                                    "  (help) is a short tour."))
                 found)))))


;;; The tour.

(define tour
  '(";; A short tour.  Type a line, press Enter; Tab completes names."
    ""
    "(worlds)                           ; the worlds there are"
    "(enter! 'WORLD)                    ; start a dive in one of them"
    "(look)                             ; see it from above and from the side"
    "(drive! #:surge 0.5 #:yaw 0.1)     ; hold the sticks: surge sway heave yaw, -1 to 1"
    "(run 20)                           ; let 20 seconds pass; nothing else lets time pass"
    "(status)                           ; position, tether, slack, tension, warnings"
    "(tether-length) (slack)            ; ask for a figure"
    "(pay-out! 5)                       ; more tether; (haul-in! 5) takes it back"
    "(what-if (run 60) (slack))         ; try the future, keep the present"
    "(release!) (run 5) (look)          ; let go of the sticks"
    "(tether-model! 'dynamic) (run 5)   ; from now on the line moves"
    ""
    ";; (help drive!) tells of one name, (help \"tangle\") searches all there is to read; ,q leaves."
    ";; All names, by topic; (help fly) lists those of one:"))

(define (a-world worlds)
  ;; One to begin with.
  (if (memq 'open-water worlds) 'open-water (car worlds)))

(define (topic-list)
  (map (lambda (topic)
         (simple-format #f ";;   ~a ~a" (string-pad-right (symbol->string (car topic)) 9) (cdr topic)))
       (topics)))

(define (topic->lines topic)
  (cons (simple-format #f "~a: ~a" topic (assq-ref (topics) topic)) (names->lines (topic-names topic))))

(define (tour-lines)
  (let* ((list-worlds (language-ref 'worlds #f))
         (worlds (or (and (procedure? list-worlds) (false-if-exception (list-worlds))) '())))
    (if (null? worlds)
        (append tour (topic-list))
        (append (map (lambda (line)
               (cond ((string-prefix? "(worlds)" line)
                      (string-append (string-pad-right "(worlds)" 35) "; " (words->string worlds)))
                     ((string-prefix? "(enter!" line)
                      (string-append
                       (string-pad-right (simple-format #f "(enter! '~a)" (a-world worlds)) 35)
                       "; start a dive in one of them"))
                     (else line)))
             tour)
                (topic-list)))))


;;; `help' itself.

(define nothing (list 'nothing))

(define (name-lines name)
  ;; What NAME, a symbol, is as a verb, a procedure, a topic or a part.
  (let ((value (language-ref name nothing)))
    (cond ((not (eq? value nothing)) (help-lines name value))
          ((topic-called name) => topic->lines)
          ((described name) => (lambda (text) (string-split (string-trim-right text) #\newline)))
          (else '()))))

(define (schemes-own? name)
  ;; Does NAME mean something, as `length' does, that bight has no part in?
  (not (or (memq name (language-names)) (eq? nothing (language-ref name nothing)))))

(define (topic-lines topic)
  (let* ((name (if (string? topic) (string->symbol topic) topic))
         (own (if (keyword? name) '() (name-lines name)))
         (others (word-lines topic)))
    (cond ((null? others) (if (null? own) (unknown topic) own))
          ((null? own) others)
          ((schemes-own? name) (append others (cons "" own)))
          (else (append own (cons "" others))))))

(define-argument-type (topic value)
  "a name, a keyword or a string"
  (cond ((or (symbol? value) (string? value) (keyword? value)) value)
        ((and (pair? value) (eq? 'quote (car value)) (pair? (cdr value)) (symbol? (cadr value)))
         (cadr value))
        (else refused)))

(define (blank? topic)
  (and (string? topic) (string-null? (string-trim-both topic))))

(define (help-on . topics)
  "Return help on a topic, a symbol or string, or a short tour, as a picture, which prints as text."
  (lines->picture
   (folded-lines (if (or (null? topics) (blank? (car topics)))
                     (tour-lines)
                     (topic-lines (check-argument 'help 'topic type:topic (car topics))))
                 (reader-columns))))

(define-syntax help
  (lambda (stx)
    "(help): a short tour of bight, and the topics.
(help NAME), (help 'NAME): how NAME is used and what it does; NAME may be a topic, a part, a field, a keyword, an option,
an event, a unit, a world, a type or a lesson too.
(help \"word\"): the same, or what is said about the word: by names, in their texts, in the manual."
    (syntax-case stx ()
      ((_) #'(help-on))
      ((_ topic) #'(help-on 'topic))
      (_ (syntax-violation #f "say (help), (help NAME) or (help \"word\"), not" stx)))))
