;;; (bight core signature) --- what a verb takes, and how a call's arguments are arranged by it.
;;;
;;; The run-time half of `define-verb': finding the subject, sorting positional and keyword arguments,
;;; checking their number and types, and telling `help' about it all.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(define-module (bight core signature)
  #:use-module (bight core argument)
  #:use-module (bight core errors)
  #:use-module (bight core record)
  #:use-module ((srfi srfi-1) #:select (first second third fourth))
  #:export (current-subject-lister
            own-subjects
            subject-index

            make-signature
            arrange
            absent
            check-one
            mark-verb!
            symbol-or-keyword?

            verb?
            verb-arguments
            verb-parameters
            verb-usage))


;;; Subjects: the vehicle or tether a verb is about.

(define (no-subjects proc kind)
  (bight-raise 'def proc "there is no dive, so no ~a; (enter! WORLD) starts one" kind))

(define current-subject-lister
  ;; A procedure of PROC and KIND (vehicle, tether, ...) that returns the list of names of that kind, in
  ;; the order of their indices, or raises a &bight-error when there is no dive.
  (make-parameter no-subjects))

(define own-subjects
  ;; Names of the vehicle and the tether that are meant where a dive has several and none is named: a
  ;; pupil's own among those that others fly.
  (make-parameter '()))

(define (own-among names)
  ;; The index in NAMES of the one of them that is one's own, or #f.
  (let loop ((own (own-subjects)))
    (and (pair? own)
         (or (position (car own) names) (loop (cdr own))))))

(define (position name names)
  (let loop ((rest names) (i 0))
    (cond ((null? rest) #f)
          ((eq? name (car rest)) i)
          (else (loop (cdr rest) (+ i 1))))))

(define* (subject-index proc kind name #:optional (named (lambda (name) (simple-format #f "(~a '~a ...)" proc name))))
  "Return the index of the subject NAME of KIND (`vehicle', `tether', ...) in the present dive; with
NAME #f, of the only one, or of one's own.  Raise a &bight-error from PROC when there is no such thing, or several:
then NAMED, a procedure of a name, shows how one says which."
  (let ((names ((current-subject-lister) proc kind)))
    (cond (name (or (position name names)
                    (unknown-name proc "this dive" name names (symbol->string kind))))
          ((null? names)
           (bight-raise 'name proc "this dive has no ~a" kind))
          ((null? (cdr names)) 0)
          ((own-among names))
          (else
           (bight-raise 'name proc "this dive has ~a ~as, ~a; say which: ~a"
                        (length names) kind (words->string names) (named (car names)))))))


;;; Signatures, and the arrangement of a call's arguments by them.

(define-record <signature>
  (%make-signature name subject required optional keys rest defaults least most)
  signature?
  (name signature-name)
  (subject signature-subject)            ; kind, or #f
  (required signature-required)          ; lists of (NAME . TYPE)
  (optional signature-optional)
  (keys signature-keys)                  ; list of (KEYWORD . TYPE)
  (rest signature-rest)                  ; (NAME . TYPE), or #f
  (defaults signature-defaults)          ; alist, NAME -> the expression for what is left out
  (least signature-least)                ; how many positional arguments it takes
  (most signature-most))                 ; or #f

(define absent (list 'absent))          ; an optional argument that was not given

(define (make-signature name subject required optional keys rest defaults)
  "Return the signature of the verb NAME.  SUBJECT is a kind or #f; REQUIRED, OPTIONAL and KEYS are lists
of pairs (NAME . TYPE), REST such a pair or #f; DEFAULTS is an alist from optional arguments and keys, symbols,
to the expressions that stand for them when they are left out."
  (let ((least (length required)))
    (%make-signature name subject required optional keys rest defaults
                     least (and (not rest) (+ least (length optional))))))

(define (takes-keywords? s)
  (or (pair? (signature-keys s)) (not (signature-rest s))))

(define (unknown-keyword s keyword)
  (unknown-name (signature-name s)
                (symbol->string (signature-name s))
                keyword (map car (signature-keys s)) "keyword"))

(define (keyword-position s keyword)
  (let loop ((rest (signature-keys s)) (i 0))
    (cond ((null? rest) (unknown-keyword s keyword))
          ((eq? keyword (caar rest)) i)
          (else (loop (cdr rest) (+ i 1))))))

(define (set-keyword! s values keyword rest)
  (let ((i (keyword-position s keyword)))
    (cond ((or (null? rest) (keyword? (car rest)))
           (bight-raise 'domain (signature-name s) "~s needs a value after it" keyword))
          ((not (eq? absent (vector-ref values i)))
           (bight-raise 'domain (signature-name s) "~s is given twice" keyword))
          (else (vector-set! values i (car rest))))))

(define (take-keywords! s args values)
  ;; Put the keyword arguments among ARGS into VALUES, return the others.
  (let loop ((rest args) (others '()))
    (cond ((null? rest) (reverse! others))
          ((keyword? (car rest))
           (set-keyword! s values (car rest) (cdr rest))
           (loop (cddr rest) others))
          (else (loop (cdr rest) (cons (car rest) others))))))

(define (rest-parameters s)
  (if (signature-rest s) (list (signature-rest s)) '()))

(define (first-parameter s)
  (let ((all (append (signature-required s) (signature-optional s) (rest-parameters s))))
    (and (pair? all) (car all))))

(define (subject-among? s args)
  ;; Whether the first of ARGS, a symbol, is the subject: it names one and the rest suffice, or it can
  ;; be nothing else.
  (let* ((name (car args))
         (n (length args))
         (most (signature-most s))
         (first (first-parameter s))
         (one? (memq name ((current-subject-lister) (signature-name s) (signature-subject s)))))
    (cond (one? (or (> n (signature-least s)) (not first) (not (accepts? (cdr first) name))))
          ((and most (> n most)) #t)
          ((and first (meant-for? first name)) #f)
          (first (not (accepts? (cdr first) name)))
          (else #t))))

(define (meant-for? parameter name)
  ;; Is NAME, a symbol that PARAMETER does not take, a slip for a word that it takes?
  (and (not (accepts? (cdr parameter) name))
       (nearest name (argument-type-words (cdr parameter)))
       #t))

(define (usage-error s n)
  (bight-raise 'domain (signature-name s) "it is used as ~a; ~a given" (signature->string s)
               (case n
                 ((0) "nothing was")
                 ((1) "one argument was")
                 (else (simple-format #f "~a arguments were" n)))))

(define (check-count s n given)
  ;; Are N the arguments that the verb of S takes beside its subject and keywords?  GIVEN counts the subject, too.
  (unless (and (<= (signature-least s) n)
               (or (not (signature-most s)) (<= n (signature-most s))))
    (usage-error s given)))

(define (check-one s parameter value)
  "Return the canonical form of VALUE, given for PARAMETER, a pair (NAME . TYPE), of the verb with the
signature S, or raise a &bight-error."
  (check-argument (signature-name s) (car parameter) (cdr parameter) value))

(define (arrange-rest s args)
  (map (lambda (value) (check-one s (signature-rest s) value)) args))

(define (arrange-optional s parameters args tail)
  ;; The canonical values of ARGS, `absent' for those left out, TAIL, the rest list.
  (cond ((null? parameters) (append tail (list (arrange-rest s args))))
        ((null? args) (cons absent (arrange-optional s (cdr parameters) '() tail)))
        (else (cons (check-one s (car parameters) (car args))
                    (arrange-optional s (cdr parameters) (cdr args) tail)))))

(define (arrange-positional s args tail)
  (let loop ((parameters (signature-required s)) (args args))
    (if (null? parameters)
        (arrange-optional s (signature-optional s) args tail)
        (cons (check-one s (car parameters) (car args))
              (loop (cdr parameters) (cdr args))))))

(define (arrange-keywords s values)
  (let loop ((keys (signature-keys s)) (i 0))
    (if (null? keys)
        '()
        (let ((value (vector-ref values i)))
          (cons (if (eq? value absent) absent (check-one s (car keys) value))
                (loop (cdr keys) (+ i 1)))))))

(define (arrange s args)
  "Return the list of arguments for the body of the verb with signature S in a call with ARGS: subject,
required, optional, keys, rest; those left out are `absent'.  Raise a &bight-error when they do not fit."
  (let* ((values (make-vector (length (signature-keys s)) absent))
         (others (if (takes-keywords? s) (take-keywords! s args values) args))
         (named? (and (signature-subject s) (pair? others) (symbol? (car others))
                      (subject-among? s others)))
         (others* (if named? (cdr others) others))
         (subject (and named? (find-subject s (car others)))))
    (check-count s (length others*) (length others))
    (let* ((keywords (arrange-keywords s values))
           (arranged (arrange-positional s others* keywords)))
      (cons (or subject (find-subject s #f)) arranged))))

(define (find-subject s name)
  (and (signature-subject s)
       (subject-index (signature-name s) (signature-subject s) name)))


;;; What can be read off a verb.

(define (upper name)
  (string-upcase (symbol->string name)))

(define (signature->string s)
  (define (key entry)
    (simple-format #f " [~s ~a]" (car entry) (upper (keyword->symbol (car entry)))))
  (string-append
   "(" (symbol->string (signature-name s))
   (if (signature-subject s) (simple-format #f " ['~a]" (upper (signature-subject s))) "")
   (string-concatenate
    (append (map (lambda (p) (string-append " " (upper (car p)))) (signature-required s))
            (map (lambda (p) (string-append " [" (upper (car p)) "]")) (signature-optional s))
            (if (signature-rest s) (list " " (upper (car (signature-rest s))) " ...") '())
            (map key (signature-keys s))))
   ")"))

(define (verb-signature procedure)
  (and (procedure? procedure) (procedure-property procedure 'bight-signature)))

(define (verb? object)
  "Return true if OBJECT is a procedure made by `define-verb'."
  (signature? (verb-signature object)))

(define (verb-usage procedure)
  "Return how PROCEDURE is called, as in \"(place! ['VEHICLE] P [#:speed SPEED])\", or #f when it is not
a verb."
  (let ((s (verb-signature procedure)))
    (and s (signature->string s))))

(define (default-text expression)
  ;; What EXPRESSION, the default of an argument, tells a reader, a string: a value, or #f when it is computed
  ;; or says only that nothing was given.
  (cond ((and (pair? expression) (eq? 'quote (car expression)))
         (simple-format #f "~a" (cadr expression)))
        ((or (not expression) (pair? expression) (symbol? expression)) #f)
        ((and (real? expression) (or (nan? expression) (negative? expression))) #f)
        (else (simple-format #f "~s" expression))))

(define (verb-parameters procedure)
  "Return the arguments of PROCEDURE, a verb, as a list of (ROLE NAME TYPE DEFAULT): ROLE and NAME as
`verb-arguments' has them, TYPE the argument's type or, of a subject, #f, DEFAULT a string or #f."
  (define s (verb-signature procedure))
  (define (rows role parameters)
    (map (lambda (p)
           (let ((name (if (keyword? (car p)) (keyword->symbol (car p)) (car p))))
             (list role (car p) (cdr p) (default-text (assq-ref (signature-defaults s) name)))))
         parameters))
  (if s
      (append (if (signature-subject s) (list (list 'subject (signature-subject s) #f #f)) '())
              (rows 'required (signature-required s))
              (rows 'optional (signature-optional s))
              (rows 'key (signature-keys s))
              (rows 'rest (rest-parameters s)))
      '()))

(define (left-out-text row)
  ;; What becomes of the argument of ROW, of `verb-parameters', when it is left out, as the end of a sentence.
  (cond ((eq? 'required (first row)) "")
        ((eq? 'rest (first row)) "; none, one or several")
        ((fourth row) (simple-format #f "; ~a when left out" (fourth row)))
        (else "; may be left out")))

(define (verb-arguments procedure)
  "Return the arguments of PROCEDURE, a verb, as a list of (ROLE NAME SENTENCE): ROLE is `subject',
`required', `optional', `key' or `rest', NAME a symbol or keyword, SENTENCE says what is allowed and what
stands for it when it is left out."
  (map (lambda (row)
         (list (first row) (second row)
               (if (third row)
                   (string-append (argument-type-sentence (third row)) (left-out-text row))
                   "its name; left out, the only one")))
       (verb-parameters procedure)))

(define (mark-verb! procedure s)
  "Record the signature S of PROCEDURE for `help', and its lambda list where (ice-9 session) looks."
  (set-procedure-property! procedure 'bight-signature s)
  (set-procedure-property! procedure 'arglist
                           (list (map car (signature-required s))
                                 (map car (signature-optional s))
                                 (map car (signature-keys s))
                                 #f
                                 (and (signature-rest s) (car (signature-rest s)))))
  procedure)

(define (symbol-or-keyword? value)
  "Return true if VALUE is a symbol or a keyword, which a verb with a subject looks at twice."
  (or (symbol? value) (keyword? value)))
