;;; (bight core verb) --- how every procedure of the language is made.
;;;
;;; `define-verb' defines a plain procedure whose arguments are checked against small types before its
;;; body runs, so that whatever is wrong with a call (count, type, range, NaN, a misspelt keyword or
;;; subject) raises a &bight-error that names the procedure, what was given and what is allowed.
;;;
;;;   (define-verb (place! #:subject (v vehicle) (p point) #:key (speed positive 1.0) (fresh flag #f))
;;;     "Sweep the vehicle V to the point P at SPEED m/s; ..."
;;;     body ...)
;;;
;;; Types are named by datum in the formals: `(p point)' uses the record `type:point' visible where the
;;; verb is defined, `(paint (one-of plain tension))' uses `type:one-of'.  A call with nothing but the
;;; required arguments takes a direct path; everything else is arranged from the verb's signature.
;;;
;;; (bight core argument) has the types, (bight core signature) the arrangement; this module offers both to those
;;; who define verbs.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(define-module (bight core verb)
  #:use-module (bight core argument)
  #:use-module (bight core signature)
  #:export (define-verb
            checked)
  #:re-export (argument-type
               define-argument-type
               make-argument-type
               argument-type?
               argument-type-name
               argument-type-sentence
               argument-type-words
               accepts?
               check-argument
               takes?
               refused
               current-subject-lister
               subject-index
               verb?
               verb-arguments
               verb-parameters
               verb-usage
               type:any type:number type:positive type:non-negative type:between
               type:count type:at-least type:bearing type:flag type:name type:string
               type:procedure type:thunk type:point type:points type:one-of type:or-false))

(define-syntax-rule (checked s parameter coerce value)
  "Return VALUE as COERCE has it, or raise a &bight-error about PARAMETER of the signature S."
  (let ((canonical (coerce value)))
    (if (eq? canonical refused)
        (check-one s parameter value)
        canonical)))

(define-syntax define-verb
  (lambda (form)
    "Define the procedure NAME with checked arguments, a docstring and BODY.

The formals are, in this order: #:subject (VARIABLE KIND), bound to the index of the subject; required
arguments (VARIABLE TYPE); #:optional (VARIABLE TYPE [DEFAULT]) ...; #:key (VARIABLE TYPE [DEFAULT]) ...;
#:rest (VARIABLE TYPE), each element checked.  DEFAULT is an expression that may use the variables
before it; without one it is #f.  A verb with #:rest and no #:key gets keywords in the rest list."
    (define (section? stx)
      (keyword? (syntax->datum stx)))
    (define (split formals)
      ;; An alist from section keyword (#f for required) to its formals.
      (let loop ((rest formals) (section #f) (sections '()))
        (syntax-case rest ()
          (() sections)
          ((head . tail)
           (section? #'head)
           (let ((section (syntax->datum #'head)))
             (unless (memq section '(#:subject #:optional #:key #:rest))
               (syntax-violation 'define-verb "unknown section" form #'head))
             (loop #'tail section sections)))
          ((head . tail)
           (loop #'tail
                 (if (memq section '(#:subject #:rest)) #f section)
                 (assq-set! sections section
                            (append (or (assq-ref sections section) '()) (list #'head))))))))
    (define (variable formal)
      (syntax-case formal () ((name type . default) (identifier? #'name) #'name)))
    (define (type formal)
      (syntax-case formal () ((name type . default) #'type)))
    (define (default formal)
      (syntax-case formal () ((name type) #'#f) ((name type value) #'value)))
    (define (key-name formal)
      (datum->syntax formal (symbol->keyword (syntax->datum (variable formal)))))
    (syntax-case form ()
      ((_ (name . formals) doc body body* ...)
       (string? (syntax->datum #'doc))
       (let* ((sections (split #'formals))
              (part (lambda (key) (or (assq-ref sections key) '())))
              (required (part #f))
              (optional (part #:optional))
              (keys (part #:key))
              (subject (part #:subject))
              (rest (part #:rest))
              (defaulted (append optional keys)))
         (with-syntax (((s-kind) (if (null? subject) '(#f) (map type subject)))
                       ((s-var) (if (null? subject) (generate-temporaries '(s)) (map variable subject)))
                       ((r-var ...) (map variable required))
                       ((r-type ...) (map type required))
                       ((r-in ...) (generate-temporaries required))
                       ((r-parameter ...) (generate-temporaries required))
                       ((r-coerce ...) (generate-temporaries required))
                       ((o-var ...) (map variable optional))
                       ((o-type ...) (map type optional))
                       ((k-name ...) (map key-name keys))
                       ((k-type ...) (map type keys))
                       ((d-var ...) (map variable defaulted))
                       ((d-in ...) (generate-temporaries defaulted))
                       ((d-absent ...) (map (lambda (_) #'absent) defaulted))
                       ((d-default ...) (map default defaulted))
                       ((rest-var) (if (null? rest) (generate-temporaries '(rest)) (map variable rest)))
                       (rest-parameter (if (null? rest)
                                           #'#f
                                           #`(cons '#,(variable (car rest))
                                                   (argument-type #,(type (car rest))))))
                       (unusual? (cond ((null? required) #'#f)
                                       ((null? subject) #'keyword?)
                                       (else #'symbol-or-keyword?))))
           (with-syntax ((usual (if (null? required)
                                    #'#t
                                    (with-syntax ((first (car #'(r-in ...))))
                                      #'(not (unusual? first)))))
                         (direct-subject (if (null? subject)
                                             #'#f
                                             #'(subject-index 'name 's-kind #f))))
             #'(define name
                 (let* ((r-parameter (cons 'r-var (argument-type r-type))) ...
                        (r-coerce (argument-type-coerce (cdr r-parameter))) ...
                        (signature
                         (make-signature 'name 's-kind
                                         (list r-parameter ...)
                                         (list (cons 'o-var (argument-type o-type)) ...)
                                         (list (cons 'k-name (argument-type k-type)) ...)
                                         rest-parameter
                                         '((d-var . d-default) ...)))
                        (work
                         (lambda (s-var r-var ... d-in ... rest-var)
                           (let* ((d-var (if (eq? d-in absent) d-default d-in)) ...)
                             body body* ...))))
                   (letrec ((name
                             (case-lambda
                               doc
                               ((r-in ...)
                                (if usual
                                    (work direct-subject
                                          (checked signature r-parameter r-coerce r-in) ...
                                          d-absent ... '())
                                    (apply work (arrange signature (list r-in ...)))))
                               (args (apply work (arrange signature args))))))
                     (mark-verb! name signature)))))))))))
