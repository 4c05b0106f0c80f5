;;; (bight shell meant) --- what a name that nobody defined was meant for.
;;;
;;; A newcomer forgets the quote of a name, or the mark of a keyword, as often as he misspells: so the
;;; names of worlds, of parts and of whatever else is quoted are looked through beside the variables.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(define-module (bight shell meant)
  #:use-module (bight core errors)
  #:use-module (bight core schema)
  #:use-module (bight core verb)
  #:use-module ((bight engine) #:select (%event-kinds))
  #:use-module (srfi srfi-1)
  #:export (quoted-names
            keywords-of
            known-variables
            unbound-hint))

(define (language name)
  (module-ref (resolve-interface '(bight)) name))

(define (asked name)
  ;; The symbols that the question NAME lists, none where it has no answer.
  (filter symbol? (or (false-if-exception ((language name))) '())))

(define (field-words-of head name)
  (let ((field (head-field head name)))
    (if field (field-words field) '())))

(define (quoted-names)
  "Return an alist from what quoted names stand for, as in \"a world\", to the symbols that do now, likeliest
first."
  `(("a part of this dive" . ,(asked 'parts))
    ("a world" . ,(asked 'worlds))
    ("a model of tethers" . ,(field-words-of 'tether 'model))
    ("a lesson" . ,(asked 'lessons))
    ("a type of tether" . ,(asked 'tether-types))
    ("a type of vehicle" . ,(asked 'vehicle-types))
    ("a kind of part" . ,(part-heads))
    ("an event" . ,(%event-kinds))))

(define (verbs)
  ;; alist, name -> verb.
  (filter-map (lambda (name)
                (let ((value (language name)))
                  (and (verb? value) (cons name value))))
              ((language 'language-names))))

(define (keywords-of verb)
  "Return the keywords of VERB, in their order."
  (filter keyword? (map second (verb-arguments verb))))

(define (verb-with keyword)
  ;; The name of a verb that has KEYWORD, or #f.
  (and=> (find (lambda (entry) (memq keyword (keywords-of (cdr entry)))) (verbs)) car))

(define (known-variables)
  "Return the names that mean something in the present module: the user's own, the language's, Scheme's;
some more than once."
  (define (names module) (module-map (lambda (name variable) name) module))
  (append (names (current-module)) ((language 'language-names)) (append-map names (module-uses (current-module)))))

;;; Variables.

(define (as-keyword name)
  ;; NAME, such as surge or :surge, as a keyword.
  (symbol->keyword (string->symbol (string-trim (symbol->string name) #\:))))

(define (quoted-meaning name)
  ;; What NAME stands for when it is quoted, as in "a world", or #f.
  (and=> (find (lambda (entry) (memq name (cdr entry))) (quoted-names)) car))

(define (words-of name)
  (string-split (string-trim-right (symbol->string name) (char-set #\! #\?)) #\-))

(define (by-a-word name)
  ;; The names of the language that have the one word of NAME among theirs, as rov-tension has that of tension,
  ;; the shortest first; none if NAME has several words.
  (let ((words (words-of name)))
    (define (has-it? other)
      (and (null? (cdr words)) (member (car words) (words-of other))))
    (sort (filter has-it? ((language 'language-names)))
          (lambda (a b) (< (string-length (symbol->string a)) (string-length (symbol->string b)))))))

(define most-told 4)

(define (by-a-word-hint name)
  (let ((names (by-a-word name)))
    (if (null? names)
        ""
        (simple-format #f "; there ~a ~a" (if (null? (cdr names)) "is" "are")
                       (string-join (map (lambda (n) (simple-format #f "`~a'" n))
                                         (list-head names (min most-told (length names))))
                                    ", ")))))

(define (nearest-hint name)
  (let* ((quoted (append-map cdr (quoted-names)))
         (near (nearest name (append (known-variables) quoted))))
    (cond ((not near) "")
          ((eq? near name) "; (use-modules (bight)) gives that name")
          ((module-variable (current-module) near) (simple-format #f "; did you mean `~a'?" near))
          ((memq near quoted)
           (simple-format #f "; did you mean '~a, ~a?" near (quoted-meaning near)))
          (else (simple-format #f "; did you mean `~a'?" near)))))

(define (parts-with field)
  ;; The kinds of parts that have FIELD.
  (filter (lambda (head) (head-field head field)) (part-heads)))

(define (field-hint name)
  (let ((heads (parts-with name)))
    (and (pair? heads)
         (simple-format #f "; `~a' is a field of `~a': (describe '~a)" name (car heads) (car heads)))))

(define (keyword-hint name)
  (let* ((keyword (as-keyword name)) (verb (verb-with keyword)))
    (and verb (simple-format #f "; did you mean ~s, as in (~a ~s ...)?" keyword verb keyword))))

(define (unbound-hint name)
  "Return what is to be added to the news that NAME, a symbol, is no variable: what was meant, or nothing."
  ;; A word that names have is no slip of another.
  (let ((meaning (quoted-meaning name)) (by-a-word (by-a-word-hint name)))
    (cond (meaning (simple-format #f "; ~a is ~a: did you mean '~a?" name meaning name))
          ((or (keyword-hint name) (field-hint name)) => (lambda (hint) (string-append hint by-a-word)))
          ((string-null? by-a-word) (nearest-hint name))
          (else by-a-word))))
