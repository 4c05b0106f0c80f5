;;; (bight core argument) --- the types of arguments: what a value must be, and its canonical form.
;;;
;;; A type is a small record: a name, a coercion that returns a value's canonical form or `refused', and
;;; a sentence that completes "x must be ...".  The type called T in a verb's formals is the variable
;;; type:T, so that plain words (point, number, string) stay free for everything else.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(define-module (bight core argument)
  #:use-module ((bight core decimal) #:select (text->number))
  #:use-module (bight core errors)
  #:use-module (bight core record)
  #:use-module (srfi srfi-1)
  #:use-module (srfi srfi-4)
  #:export (argument-type
            define-argument-type
            make-argument-type
            argument-type?
            argument-type-name
            argument-type-coerce
            argument-type-sentence
            argument-type-words
            accepts?
            check-argument
            refused
            alternatives->string
            choice
            false-or
            bounded-list
            takes?

            type:any type:number type:positive type:non-negative type:between
            type:count type:at-least type:bearing type:flag type:name type:string
            type:procedure type:thunk type:point type:points type:one-of type:or-false))


;;; Types as records.

(define refused (list 'refused))        ; what a coercion returns for a value it will not take

(define-record <argument-type>
  (%make-argument-type name coerce sentence words)
  argument-type?
  (name argument-type-name)
  (coerce argument-type-coerce)
  (sentence argument-type-sentence)
  (words argument-type-words))

(document
 (argument-type? "Return true if OBJECT is a type of argument.")
 (argument-type-name "Return the name of TYPE, a symbol.")
 (argument-type-coerce "Return the procedure that turns a value into TYPE's canonical form, or `refused'.")
 (argument-type-sentence "Return what TYPE allows, as in \"x must be SENTENCE\".")
 (argument-type-words "Return the symbols TYPE accepts, if it is a choice, else the empty list."))

(define* (make-argument-type name coerce sentence #:optional (words '()))
  "Return a type of argument called NAME, a symbol.  COERCE turns a value into its canonical form or
returns `refused'; SENTENCE says what is allowed, as in \"x must be SENTENCE\"; WORDS lists the symbols
it accepts, if it is a choice."
  (%make-argument-type name coerce sentence words))

(define-syntax argument-type
  (lambda (form)
    "Return the type that TYPE, a name or a form such as (between 0 1), stands for in a verb's formals."
    (define (type-name id)
      (datum->syntax id (symbol-append 'type: (syntax->datum id))))
    (syntax-case form ()
      ((_ (head argument ...))
       (identifier? #'head)
       #`(#,(type-name #'head) argument ...))
      ((_ name)
       (identifier? #'name)
       (type-name #'name)))))

(define-syntax define-argument-type
  (lambda (form)
    "Define the type NAME for use in verbs: it allows SENTENCE and turns VALUE into the value of BODY,
which may be `refused'."
    (syntax-case form ()
      ((_ (name value) sentence body ...)
       (with-syntax ((type-name (datum->syntax #'name (symbol-append 'type: (syntax->datum #'name)))))
         #'(define type-name
             (make-argument-type 'name (lambda (value) body ...) sentence)))))))

(define (accepts? type value)
  "Return true if TYPE takes VALUE."
  (not (eq? refused ((argument-type-coerce type) value))))

(define (alternatives->string words)
  "Return WORDS, a list of symbols, as in \"plain, tension or curvature\"."
  (let ((texts (map word->string words)))
    (if (null? (cdr texts))
        (car texts)
        (string-append (string-join (drop-right texts 1) ", ") " or " (last texts)))))

;; A value that is written as another kind of value than the one that is taken: a name as a string, a file
;; without its quotes, a number between quotes.
(define (spelt-otherwise value)
  (cond ((string? value) (cons (string->symbol value)
                               (let ((n (text->number value))) (if n (list n) '()))))
        ((symbol? value) (list (symbol->string value)))
        ((keyword? value) (list (keyword->symbol value)))
        (else '())))

(define (as-typed value)
  (if (symbol? value) (simple-format #f "'~a" value) (simple-format #f "~s" value)))

(define (other-spelling type value)
  ;; "; did you mean 'line?", where TYPE takes VALUE written otherwise.
  (let ((meant (find (lambda (other) (accepts? type other)) (spelt-otherwise value))))
    (cond (meant (string-append "; did you mean " (as-typed (abbreviate meant)) "?"))
          ((string? value) (did-you-mean value (argument-type-words type)))
          (else ""))))

(define (refuse proc argument type value)
  (let ((words (argument-type-words type)))
    (if (and (pair? words) (symbol? value)
             (or (memq (argument-type-name type) '(one-of or-false overlay)) (nearest value words)))
        (bight-raise 'name proc "~a must be ~a, not `~a'~a"
                     argument (alternatives->string words) value (did-you-mean value words))
        (bight-raise 'domain proc "~a must be ~a, not ~s~a"
                     argument (argument-type-sentence type) value (other-spelling type value)))))

(define (check-argument proc argument type value)
  "Return the canonical form of VALUE, given to the procedure PROC as ARGUMENT (both symbols), or raise
a &bight-error when TYPE does not take it."
  (let ((canonical ((argument-type-coerce type) value)))
    (if (eq? canonical refused)
        (refuse proc argument type value)
        canonical)))

(define most-points 1000000)

(define-syntax-rule (real-where value condition)
  ;; VALUE as a flonum if it is a finite number of a sane size and CONDITION holds of it.
  (if (and (real? value) (<= -1e12 value 1e12) condition)
      (exact->inexact value)
      refused))

(define-argument-type (any value) "anything" value)

(define-argument-type (number value)
  "a number from -1e12 to 1e12"
  (real-where value #t))

(define-argument-type (positive value)
  "a number above 0 and at most 1e12"
  (real-where value (> value 0)))

(define-argument-type (non-negative value)
  "a number from 0 to 1e12"
  (real-where value (>= value 0)))

(define-argument-type (bearing value)
  "a compass bearing in degrees, from -1e6 to 1e6"
  (real-where value (<= -1e6 value 1e6)))

(define (type:between low high)
  "Return the type of numbers from LOW to HIGH, both included."
  (make-argument-type 'between
                      (lambda (value) (real-where value (<= low value high)))
                      (simple-format #f "a number from ~a to ~a" low high)))

(define (type:at-least low)
  "Return the type of whole numbers not below LOW."
  (make-argument-type 'at-least
                      (lambda (value) (whole-number value low))
                      (simple-format #f "a whole number from ~a to 1e9" low)))

(define (whole-number value low)
  ;; VALUE as an exact integer; 3.0 is as good as 3.
  (if (and (real? value) (<= low value 1e9) (integer? value))
      (inexact->exact value)
      refused))

(define-argument-type (count value)
  "a whole number from 0 to 1e9"
  (whole-number value 0))

(define-argument-type (flag value)
  "#t or #f"
  (if (boolean? value) value refused))

(define-argument-type (name value)
  "a name, such as 'line"
  (if (symbol? value) value refused))

(define-argument-type (string value)
  "a string"
  (if (string? value) value refused))

(define-argument-type (procedure value)
  "a procedure"
  (if (procedure? value) value refused))

(define (takes? procedure n)
  "Return true if PROCEDURE can be called with N arguments."
  (define (fits? required optional rest?)
    (and (<= required n) (or rest? (<= n (+ required optional)))))
  (define (fits-list? arguments)
    (let ((count (lambda (key) (length (or (assq-ref arguments key) '())))))
      (fits? (count 'required) (count 'optional) (assq-ref arguments 'rest))))
  (let ((least (procedure-minimum-arity procedure)))
    (or (not least)                     ; Guile cannot tell
        (apply fits? least)
        ;; The other clauses of a case-lambda.
        (and ((@ (system vm program) program?) procedure)
             (any fits-list?
                  (or ((@ (system vm program) program-arguments-alists) procedure) '()))))))

(define-argument-type (thunk value)
  "a procedure of no arguments"
  (if (thunk? value) value refused))

(define (choice words)
  "Return the type of the symbols in the list WORDS."
  (make-argument-type 'one-of
                      (lambda (value) (if (memq value words) value refused))
                      (string-append "one of " (alternatives->string words))
                      words))

(define-syntax-rule (type:one-of word ...)
  "Return the type of the symbols WORD ..., which are not evaluated."
  (choice '(word ...)))

(define (false-or type)
  "Return the type that takes #f and whatever TYPE takes."
  (make-argument-type 'or-false
                      (lambda (value) (and value ((argument-type-coerce type) value)))
                      (string-append (argument-type-sentence type) ", or #f")
                      (argument-type-words type)))

(define-syntax-rule (type:or-false type)
  "Return the type that takes #f and whatever TYPE, named as in a verb's formals, takes."
  (false-or (argument-type type)))


;;; Points.

(define (coordinate? value)
  (and (real? value) (<= -1e7 value 1e7)))

(define (three x y z)
  (if (and (coordinate? x) (coordinate? y) (coordinate? z))
      (f64vector x y z)
      refused))

(define (point-from value)
  (cond ((pair? value) (point-from-list value))
        ((f64vector? value) (point-from-f64 value))
        ((array? value) (point-from-array value))
        (else refused)))

(define (point-from-list value)
  ;; Looks at three pairs, so neither long nor circular lists matter.
  (let* ((second (cdr value))
         (third (and (pair? second) (cdr second))))
    (if (and (pair? third) (null? (cdr third)))
        (three (car value) (car second) (car third))
        refused)))

(define (point-from-f64 value)
  (if (and (= 3 (f64vector-length value))
           (coordinate? (f64vector-ref value 0))
           (coordinate? (f64vector-ref value 1))
           (coordinate? (f64vector-ref value 2)))
      value
      refused))

(define (point-from-array value)
  ;; A vector, or a row of a polyline.
  (if (and (= 1 (array-rank value)) (= 3 (array-length value)))
      (let ((first (caar (array-shape value))))
        (three (array-ref value first) (array-ref value (+ first 1)) (array-ref value (+ first 2))))
      refused))

(define-argument-type (point value)
  "a point, three numbers in metres as '(x y z) or (vec x y z), none beyond 1e7"
  (point-from value))

(define* (bounded-list value #:optional (most most-points))
  "Return a copy of VALUE if it is a proper list of at most MOST elements, else #f."
  (let loop ((rest value) (n 0) (seen '()))
    (cond ((null? rest) (reverse! seen))
          ((or (not (pair? rest)) (= n most)) #f)
          (else (loop (cdr rest) (+ n 1) (cons (car rest) seen))))))

(define (polyline-from-list rows)
  (let ((line (make-typed-array 'f64 0.0 (length rows) 3)))
    (let loop ((i 0) (rest rows))
      (if (null? rest)
          line
          (let ((p (point-from (car rest))))
            (cond ((eq? p refused) refused)
                  (else
                   (array-set! line (f64vector-ref p 0) i 0)
                   (array-set! line (f64vector-ref p 1) i 1)
                   (array-set! line (f64vector-ref p 2) i 2)
                   (loop (+ i 1) (cdr rest)))))))))

(define (array-rows value)
  ;; The rows of an n x 3 array as a list of lists, or #f.
  (let ((shape (array-shape value)))
    (and (= 2 (length shape))
         (let ((top (car (first shape)))
               (left (car (second shape)))
               (right (cadr (second shape))))
           (and (= 2 (- right left)) (<= 1 (array-length value) most-points)
                (map (lambda (i) (map (lambda (j) (array-ref value i (+ left j))) '(0 1 2)))
                     (iota (array-length value) top)))))))

(define (polyline-from value)
  (let ((rows (cond ((pair? value) (bounded-list value))
                    ((vector? value)
                     (and (<= 1 (vector-length value) most-points) (vector->list value)))
                    ((array? value) (array-rows value))
                    (else #f))))
    (if rows (polyline-from-list rows) refused)))

(define-argument-type (points value)
  "a polyline, one or more points in a list, a vector or an n x 3 array"
  (polyline-from value))
