;;; (bight study) --- studies: the same dive many times, with other currents, pilots, paths.
;;;
;;; `define-study' turns clauses, whose heads are matched by datum, into a design, (bight study sweep-design),
;;; and a procedure that flies one case, (bight study case).  `bight sweep' flies all of them, (bight study sweep).
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(define-module (bight study)
  #:use-module ((bight core clause) #:select (global-value))
  #:use-module (bight core errors)
  #:use-module (bight core shelf)
  #:use-module (bight study case)
  #:use-module (bight study sweep-design)
  #:use-module ((bight core told) #:select (source-location location->string))
  #:use-module ((bight test scenario) #:select (world-of))
  #:use-module (srfi srfi-1)
  #:use-module ((system syntax) #:select (syntax-local-binding))
  #:export (define-study
            ;; For those who run studies.
            collect-studies design-clauses
            ;; What the macro expands to.
            register-study! draw-of sampling-of wrong-clause))


;;; Studies, and where they are kept.

(define shelf (make-shelf))

(define (collect-studies thunk)
  "Call THUNK and return the studies it defines, in order."
  (call-with-empty-shelf shelf thunk))


;;; Errors that teach.

(define clauses
  '((in "(in WORLD)")
    (define "(define NAME E)")
    (fly "(fly FORM ...)")
    (leg "(leg NAME FORM ...)")
    (measure "(measure (NAME E) ...)")
    (monte-carlo "(monte-carlo N) or (monte-carlo N #:seed S)")
    (latin-hypercube "(latin-hypercube N) or (latin-hypercube N #:seed S)")
    (at-most "(at-most SECONDS)")
    (together "(together N)")))

(define design-clauses
  ;; Those that say which cases there are, how long one may take and how many share a process, but nothing of how one
  ;; comes out.
  '(monte-carlo latin-hypercube at-most together))

(define (place location)
  (if location (string-append (location->string location) ": ") ""))

(define (wrong-clause form location)
  "Raise the error about FORM, which is no clause of a study."
  (let* ((head (and (pair? form) (symbol? (car form)) (car form)))
         (known (and head (assq-ref clauses head)))
         (near (and head (not known) (nearest head (map car clauses)))))
    (cond (known
           (bight-raise 'def 'define-study "~asay ~a, not ~s" (place location) (car known) form))
          (head
           (bight-raise 'name 'define-study "~aa study has no clause `~a'; ~a" (place location) head
                        (if near
                            (simple-format #f "did you mean ~a?" (car (assq-ref clauses near)))
                            (string-append "it has " (words->string (map car clauses))))))
          (else
           (bight-raise 'def 'define-study "~aa clause of a study is written (NAME ...), not ~s~a"
                        (place location) form
                        (if (keyword? form) "; #:for ((VARIABLE VALUE ...) ...) stands before them all" ""))))))

(define (draw-of module-name head variable location thunk)
  "Return the draw for VARIABLE whose one value is (HEAD ...): of that kind if HEAD is a draw, else of the
one value that THUNK, a procedure of HEAD's arguments, returns."
  (let ((at (place location)))
    (cond ((memq head draw-names) (make-draw at variable head (thunk)))
          ((global-value module-name head) (make-draw at variable 'grid (thunk)))
          (else (unknown-name 'define-study (string-append at "a variable") head draw-names "draw")))))

(define (sampling-of location kind arguments)
  "Return the sampling (KIND N SEED) that a clause with ARGUMENTS asks for."
  (cond ((= 1 (length arguments)) (list kind (car arguments) 1))
        ((and (= 3 (length arguments)) (eq? #:seed (second arguments))
              (exact-integer? (third arguments)))
         (list kind (first arguments) (third arguments)))
        (else (wrong-clause (cons kind arguments) location))))

(define reserved
  '(number key status error message cpu hash version leg name x y z))

(define (check-names at variables measures legs)
  (let ((taken (find (lambda (name) (memq name reserved)) (append variables measures))))
    (when taken
      (bight-raise 'def 'define-study "~a~a is a column of every result: choose another name" at taken)))
  (let loop ((names (append variables measures)) (seen '()))
    (when (pair? names)
      (let ((word (string-downcase (symbol->string (car names)))))
        (when (member word seen)
          (bight-raise 'def 'define-study "~a~a names two columns of the result: choose another" at
                       (car names)))
        (loop (cdr names) (cons word seen)))))
  (unless (= (length legs) (length (delete-duplicates legs eq?)))
    (bight-raise 'def 'define-study "~atwo legs have one name; they are ~a" at (words->string legs)))
  (when (null? measures)
    (bight-raise 'def 'define-study "~aa study needs (measure (NAME E) ...): what is to be known of a case"
                 at)))

(define most-limit 1e6)
(define most-together 1000)

(define (check-limit at limit)
  (unless (and (real? limit) (< 0 limit most-limit))
    (bight-raise 'domain 'define-study "~a(at-most SECONDS) needs a number above 0, not ~s" at limit)))

(define (check-together at n)
  (unless (and (exact-integer? n) (<= 1 n most-together))
    (bight-raise 'domain 'define-study "~a(together N) needs a whole number from 1 to ~a, not ~s" at most-together n)))

(define (register-study! name sentence location draws sampling limit together measures legs world body)
  (let ((at (place location)))
    (unless world
      (bight-raise 'def 'define-study "~aa study needs (in WORLD): where its dives take place" at))
    (check-names at (map draw-variable draws) measures legs)
    (check-limit at limit)
    (check-together at together)
    (let ((study (make-study name sentence location (design at draws sampling) limit together measures legs
                             world body)))
      (shelve! shelf study-name name (list study))
      study)))


;;; The macro.

(eval-when (expand load eval)
  (define default-limit 600)

  (define (head-of clause)
    (syntax-case clause ()
      ((head . _) (identifier? #'head) (syntax->datum #'head))
      (_ #f)))

  (define (wrong clause)
    #`(wrong-clause '#,(datum->syntax #'here (syntax->datum clause)) (source-location #,clause)))

  (define (global? id)
    (call-with-values (lambda () (syntax-local-binding id))
      (lambda (type value) (eq? type 'global))))

  (define (row->draw row)
    ;; Syntax of the draw that ROW, after #:for, stands for.
    (syntax-case row ()
      ((name (head argument ...))
       (and (identifier? #'name) (identifier? #'head) (memq (syntax->datum #'head) draw-names))
       #`(draw-of #f 'head 'name (source-location #,row) (lambda () (list argument ...))))
      ((name (head argument ...))
       (and (identifier? #'name) (identifier? #'head) (global? #'head))
       #`(draw-of '#,(datum->syntax #'head (module-name (current-module))) 'head 'name
                  (source-location #,row) (lambda () (list (head argument ...)))))
      ((name value ...)
       (identifier? #'name)
       #`(draw-of #f 'grid 'name (source-location #,row) (lambda () (list value ...))))
      (_ #f)))

  (define (expand-row row)
    (or (row->draw row)
        (syntax-violation #f "a row after #:for is (VARIABLE VALUE ...) or (VARIABLE DRAW), not" row)))

  (define (expand-step flight measures clause)
    ;; A clause that is part of the dive.
    (syntax-case clause ()
      ((_ form ...) (eq? 'fly (head-of clause))
       #'(let () form ... *unspecified*))
      ((_ name form ...) (eq? 'leg (head-of clause))
       #`(fly-leg! #,flight 'name #,measures (lambda () form ... *unspecified*)))
      (_ clause)))                      ; a definition

  (define (well-formed? clause)
    (syntax-case clause ()
      ((_ argument ...)
       (let ((n (length #'(argument ...))))
         (case (head-of clause)
           ((in at-most together) (= 1 n))
           ((define) (> n 1))
           ((fly monte-carlo latin-hypercube) (> n 0))
           ((leg) (and (> n 0) (identifier? (car #'(argument ...)))))
           ((measure)
            (and-map (lambda (entry)
                       (syntax-case entry () ((name _) (identifier? #'name) #t) (_ #f)))
                     #'(argument ...)))
           (else #f))))
      (_ #f)))

  (define (all-of head clauses)
    (filter (lambda (clause) (eq? head (head-of clause))) clauses))

  (define (measures-of clauses)
    ;; A list of pairs (NAME . EXPRESSION), syntax.
    (append-map (lambda (clause)
                  (map (lambda (entry) (syntax-case entry () ((name e) (cons #'name #'e))))
                       (syntax-case clause () ((_ entry ...) #'(entry ...)))))
                (all-of 'measure clauses)))

  (define (leg-names clauses)
    (map (lambda (clause) (syntax-case clause () ((_ name . _) #'name)))
         (all-of 'leg clauses)))

  (define (only-argument clause)
    (syntax-case clause () ((_ argument) #'argument)))

  (define (the-one head clauses expand default)
    ;; Syntax of the clause HEAD, of which there may be one.
    (let ((found (all-of head clauses)))
      (cond ((null? found) default)
            ((pair? (cdr found))
             (syntax-violation #f "this clause is there twice" (cadr found)))
            (else (expand (car found))))))

  (define (world-syntax variables)
    (lambda (clause)
      #`(lambda #,variables (world-of #,(only-argument clause)))))

  (define (sampling-syntax clauses)
    (let ((found (append-map (lambda (head) (all-of head clauses)) '(monte-carlo latin-hypercube))))
      (cond ((null? found) #'#f)
            ((pair? (cdr found))
             (syntax-violation #f "the random variables of a study are drawn in one way" (cadr found)))
            (else
             (syntax-case (car found) ()
               ((kind argument ...)
                #`(sampling-of (source-location #,(car found)) 'kind (list argument ...))))))))

  (define (step? clause)
    (memq (head-of clause) '(define fly leg)))

  (define (expand-study stx name sentence rows clauses)
    (let ((variables (map (lambda (row) (syntax-case row () ((v . _) #'v) (_ row))) rows))
          (bad (find (lambda (clause) (not (well-formed? clause))) clauses)))
      (if bad
          #`(define #,name #,(wrong bad))
          #`(define #,name
              (register-study!
               '#,name #,sentence (source-location #,stx)
               (list #,@(map expand-row rows))
               #,(sampling-syntax clauses)
               #,(the-one 'at-most clauses only-argument #`#,default-limit)
               #,(the-one 'together clauses only-argument #'1)
               '#,(map car (measures-of clauses))
               '#,(leg-names clauses)
               #,(the-one 'in clauses (world-syntax variables) #'#f)
               (lambda (flight #,@variables)
                 (define measures
                   (list #,@(map (lambda (m) #`(cons '#,(car m) (lambda () #,(cdr m))))
                               (measures-of clauses))))
                 #,@(map (lambda (clause) (expand-step #'flight #'measures clause))
                         (filter step? clauses))
                 (end-case flight measures))))))))

(define-syntax define-study
  (lambda (stx)
    "(define-study NAME \"sentence\" #:for ((VARIABLE VALUE ...) ...) CLAUSE ...): a study, many dives that
`bight sweep' flies, one for each combination of the values of the variables.  A row may name a draw
instead: (U (range 0 1 0.25)), (seed (seeds 20)), or, at random, (U (uniform 0 0.5)), (U (normal 0.3 0.1)),
(U (one-of 'slow 'fast)); then (monte-carlo N) or (latin-hypercube N), with #:seed S, says how many points.
(in WORLD) is where each dive takes place; WORLD may be of the variables.
(fly FORM ...) and (leg NAME FORM ...) are flown in order; after each leg all is measured.
(measure (NAME E) ...) is what is to be known of a case: numbers, true or false, symbols, strings.
(define NAME E) defines a name for the clauses after it, and the measures.
(at-most SECONDS) is the processor time that a case may take, 600 if it does not say.
(together N) lets one process fly N cases in turn, which suits short ones whose flights change no variable of yours."
    (syntax-case stx ()
      ((_ name sentence #:for (row ...) clause ...)
       (and (identifier? #'name) (string? (syntax->datum #'sentence)))
       (expand-study stx #'name #'sentence #'(row ...) #'(clause ...)))
      ((_ name sentence clause ...)
       (and (identifier? #'name) (string? (syntax->datum #'sentence)))
       (expand-study stx #'name #'sentence '() #'(clause ...)))
      (_ (syntax-violation
          #f "say (define-study NAME \"sentence\" #:for ((VARIABLE VALUE ...) ...) CLAUSE ...), not"
          stx)))))
