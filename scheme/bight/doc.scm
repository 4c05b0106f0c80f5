;;; (bight doc) --- help at the prompt.
;;;
;;; `(help)' is a short tour, `(help NAME)' tells how NAME is used and what it does.  Nothing is written
;;; twice: usage and arguments come from the verb itself, macros carry their docstring in the
;;; transformer, parts and their fields answer through `describe'.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(define-module (bight doc)
  #:use-module (bight errors)
  #:use-module (bight verb)
  #:use-module (bight view)
  #:use-module (srfi srfi-1)
  #:export (help-on
            usage-of
            docstring-of
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

(define (docstring-of value)
  "Return what VALUE, also a macro, says of itself, a string, or #f."
  (cond ((macro? value) (procedure-documentation (macro-transformer value)))
        ((and (procedure? value) (procedure-documentation value)))
        (else ((module-ref (resolve-interface '(ice-9 documentation)) 'object-documentation) value))))

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

(define (argument-lines value)
  (let ((arguments (verb-arguments value)))
    (if (null? arguments)
        '()
        (cons "" (map (lambda (argument)
                        (simple-format #f "  ~a: ~a" (word->string (second argument))
                                       (third argument)))
                      arguments)))))

(define (help-lines name value)
  (let ((doc (docstring-of value)))
    (append (usage-lines name value doc)
            (if doc (tidy-docstring doc) '())
            (if (procedure? value) (argument-lines value) '()))))


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

(define (names-with text)
  (filter (lambda (name) (string-contains-ci (symbol->string name) text)) (language-names)))

(define (unknown word)
  (let* ((text (word->string word))
         (near (nearest word (language-names)))
         (like (delete near (names-with text)))
         (all (take-up-to 12 (if near (cons near like) like))))
    (list (simple-format #f "There is no `~a'.~a" text
                         (if (null? all)
                             "  (help) is a short tour."
                             (string-append "  Do you mean " (words->string all) "?"))))))

(define (take-up-to n items)
  (if (> (length items) n) (take items n) items))


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
    ";; (help drive!) tells of one name, (help \"tension\") finds names; ,q leaves."))

(define (a-world worlds)
  ;; One to begin with.
  (if (memq 'open-water worlds) 'open-water (car worlds)))

(define (tour-lines)
  (let* ((list-worlds (language-ref 'worlds #f))
         (worlds (or (and (procedure? list-worlds) (false-if-exception (list-worlds))) '())))
    (if (null? worlds)
        tour
        (map (lambda (line)
               (cond ((string-prefix? "(worlds)" line)
                      (string-append (string-pad-right "(worlds)" 35) "; " (words->string worlds)))
                     ((string-prefix? "(enter!" line)
                      (string-append
                       (string-pad-right (simple-format #f "(enter! '~a)" (a-world worlds)) 35)
                       "; start a dive in one of them"))
                     (else line)))
             tour))))


;;; `help' itself.

(define nothing (list 'nothing))

(define (topic-lines topic)
  (let* ((name (if (string? topic) (string->symbol topic) topic))
         (value (language-ref name nothing)))
    (cond ((not (eq? value nothing)) (help-lines name value))
          ((described name) => (lambda (text) (string-split (string-trim-right text) #\newline)))
          (else (unknown topic)))))

(define-argument-type (topic value)
  "a name or a string"
  (cond ((or (symbol? value) (string? value)) value)
        ((and (pair? value) (eq? 'quote (car value)) (pair? (cdr value)) (symbol? (cadr value)))
         (cadr value))
        (else refused)))

(define (help-on . topics)
  "Return help on a topic, a symbol or string, or a short tour, as a picture, which prints as text."
  (lines->picture
   (if (null? topics)
       (tour-lines)
       (topic-lines (check-argument 'help 'topic type:topic (car topics))))))

(define-syntax help
  (lambda (stx)
    "(help): a short tour of bight.
(help NAME), (help 'NAME): how NAME is used and what it does; NAME may be a part too.
(help \"word\"): the same, or the names that contain the word."
    (syntax-case stx ()
      ((_) #'(help-on))
      ((_ topic) #'(help-on 'topic))
      (_ (syntax-violation #f "say (help), (help NAME) or (help \"word\"), not" stx)))))
