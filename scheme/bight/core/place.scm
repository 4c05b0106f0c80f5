;;; (bight core place) --- evaluating a user's forms so that each error knows its line.
;;;
;;; Code that is interpreted leaves no trace of its lines, and an error in a procedure of a script would be
;;; told as one of the form that called it in the end.  So each call that stands in the file is made within
;;; its place, (bight core here).  A call of the file's own procedures in tail position stays one, so that loops
;;; take no room; any other call comes back anyway.  An argument that stands in the line of its call is within that
;;; call's place already: a place for each sum and product of a formula took twice the time of the formula.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(define-module (bight core place)
  #:use-module ((bight core here) #:select (at-place noting-places))
  #:use-module (language tree-il)
  #:export (evaluate-marked
            load-marked
            mark-what-is-loaded!))

(define (source-place source file)
  ;; (FILE . LINE) of SOURCE, which Guile tells as a vector or as a list, if it is in FILE.
  (call-with-values
      (lambda ()
        (cond ((vector? source) (values (vector-ref source 0) (vector-ref source 1)))
              ((pair? source) (values (assq-ref source 'filename) (assq-ref source 'line)))
              (else (values #f #f))))
    (lambda (name line)
      (and line (equal? name file) (cons name (+ 1 line))))))

;; They call what they are given in their own tail position.
(define callers
  (list apply call-with-values call-with-current-continuation dynamic-wind))

(define (foreign? operator module)
  ;; Does OPERATOR name a procedure that MODULE has from elsewhere?
  (or (module-ref? operator)
      (and (toplevel-ref? operator)
           (let ((name (toplevel-ref-name operator)))
             (and (not (module-local-variable module name))
                  (let ((variable (module-variable module name)))
                    (and variable (variable-bound? variable)
                         (not (memq (variable-ref variable) callers)))))))))

(define (within place name expression)
  ;; The expression that evaluates EXPRESSION, which stands at PLACE in the procedure NAME.
  (make-call #f (make-module-ref #f '(bight core here) 'at-place #t)
             (list (make-const #f (cons place name))
                   (make-lambda #f '() (make-lambda-case #f '() #f #f #f '() '() expression #f)))))

(define (marked expression file module)
  ;; EXPRESSION, as the expander leaves it, with its calls in FILE marked.
  ;; AROUND is the place within which an expression is evaluated, told by a call about it, or #f.
  (define (walk-all expressions name around) (map (lambda (e) (walk e #f name around)) expressions))
  (define (walk-call e tail? name around)
    (let* ((place (source-place (call-src e) file))
           (operator (call-proc e))
           (whole? (and place (or (not tail?) (foreign? operator module))))
           (inside (if whole? place around))
           (call (make-call (call-src e) (walk operator #f name inside) (walk-all (call-args e) name inside))))
      (cond ((or (not place) (equal? place around)) call)
            (whole? (within place name call))
            ((toplevel-ref? operator)   ; a name that nobody has is missed here
             (make-call (call-src e) (within place name operator) (call-args call)))
            (else call))))
  (define (walk e tail? name around)
    (cond ((call? e) (walk-call e tail? name around))
          ((conditional? e)
           (make-conditional (conditional-src e) (walk (conditional-test e) #f name around)
                             (walk (conditional-consequent e) tail? name around)
                             (walk (conditional-alternate e) tail? name around)))
          ((seq? e) (make-seq (seq-src e) (walk (seq-head e) #f name around) (walk (seq-tail e) tail? name around)))
          ((lambda? e)
           (make-lambda (lambda-src e) (lambda-meta e)
                      (and (lambda-body e)
                           (walk (lambda-body e) #t (or (assq-ref (lambda-meta e) 'name) name) #f))))
          ((lambda-case? e)
           (make-lambda-case (lambda-case-src e) (lambda-case-req e) (lambda-case-opt e)
                             (lambda-case-rest e) (lambda-case-kw e) (walk-all (lambda-case-inits e) name #f)
                             (lambda-case-gensyms e) (walk (lambda-case-body e) #t name #f)
                             (and (lambda-case-alternate e) (walk (lambda-case-alternate e) #t name #f))))
          ((let? e)
           (make-let (let-src e) (let-names e) (let-gensyms e) (walk-all (let-vals e) name around)
                     (walk (let-body e) tail? name around)))
          ((letrec? e)
           (make-letrec (letrec-src e) (letrec-in-order? e) (letrec-names e) (letrec-gensyms e)
                        (walk-all (letrec-vals e) name around) (walk (letrec-body e) tail? name around)))
          ((toplevel-define? e)
           (make-toplevel-define (toplevel-define-src e) (toplevel-define-mod e) (toplevel-define-name e)
                                 (walk (toplevel-define-exp e) #f name around)))
          ((toplevel-set? e)
           (make-toplevel-set (toplevel-set-src e) (toplevel-set-mod e) (toplevel-set-name e)
                              (walk (toplevel-set-exp e) #f name around)))
          ((lexical-set? e)
           (make-lexical-set (lexical-set-src e) (lexical-set-name e) (lexical-set-gensym e)
                             (walk (lexical-set-exp e) #f name around)))
          (else e)))
  (walk expression #f #f #f))

(define (evaluate-marked form file)
  "Evaluate FORM, read from a port whose name is FILE, in the current module; an error in it knows its line.
Return what it does."
  (primitive-eval (marked (macroexpand form) file (current-module))))

(define (load-marked file)
  "Evaluate all forms of FILE in the current module; an error in it knows its line."
  (noting-places
   (lambda ()
     (call-with-input-file file
       (lambda (port)
         (set-port-encoding! port "UTF-8")
         (set-port-filename! port file)
         (let loop ()
           (let ((form (read-syntax port)))
             (unless (eof-object? form)
               (evaluate-marked form file)
               (loop)))))))))

(define (mark-what-is-loaded!)
  "From now on let `load' evaluate files so that their errors know their lines."
  ;; Guile's macro `load' calls this with the folder of the file that loads.
  (module-set! the-root-module 'load-in-vicinity
               (lambda* (folder file #:optional reader)
                 (load-marked (if (absolute-file-name? file) file (string-append folder "/" file))))))
