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
            file-meant
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

;;; Files.

(define (files-in folder)
  (let ((port (false-if-exception (opendir folder))))
    (if port
        (let loop ((names '()))
          (let ((name (readdir port)))
            (cond ((eof-object? name) (closedir port) (sort names string<?))
                  ((string-prefix? "." name) (loop names))
                  (else (loop (cons name names))))))
        '())))

(define (file-meant file)
  "Return \"; did you mean `OTHER'?\" about the file beside FILE, of which there is none, that is spelt most like
it, or the empty string."
  (let ((near (nearest (basename file) (files-in (dirname file)))))
    (if near
        (simple-format #f "; did you mean `~a'?"
                       (if (string-index file #\/) (string-append (dirname file) "/" near) near))
        "")))


;;; Variables.

(define (as-keyword name)
  ;; NAME, such as surge or :surge, as a keyword.
  (symbol->keyword (string->symbol (string-trim (symbol->string name) #\:))))

(define (quoted-meaning name)
  ;; What NAME stands for when it is quoted, as in "a world", or #f.
  (and=> (find (lambda (entry) (memq name (cdr entry))) (quoted-names)) car))

(define (nearest-hint name)
  (let* ((quoted (append-map cdr (quoted-names)))
         (near (nearest name (append (known-variables) quoted))))
    (cond ((not near) "")
          ((eq? near name) "; (use-modules (bight)) gives that name")
          ((module-variable (current-module) near) (simple-format #f "; did you mean `~a'?" near))
          ((memq near quoted)
           (simple-format #f "; did you mean '~a, ~a?" near (quoted-meaning near)))
          (else (simple-format #f "; did you mean `~a'?" near)))))

(define (unbound-hint name)
  "Return what is to be added to the news that NAME, a symbol, is no variable: what was meant, or nothing."
  (let ((meaning (quoted-meaning name))
        (verb (verb-with (as-keyword name))))
    (cond (meaning
           (simple-format #f "; ~a is ~a: did you mean '~a?" name meaning name))
          (verb
           (let ((keyword (as-keyword name)))
             (simple-format #f "; did you mean ~s, as in (~a ~s ...)?" keyword verb keyword)))
          (else (nearest-hint name)))))
