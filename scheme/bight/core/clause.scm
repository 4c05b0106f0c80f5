;;; (bight core clause) --- from (HEAD (FIELD VALUE ...) ...) as written to checked fields.
;;;
;;; The first half runs while a macro expands: it turns the syntax of a part into an expression for its
;;; data, quoting what the schema calls words and leaving the rest as ordinary expressions.  What it
;;; does not understand it quotes, so that the second half, which runs later, can refuse it with a
;;; &bight-error that teaches.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(define-module (bight core clause)
  #:use-module (bight core allowance)
  #:use-module (bight core argument)
  #:use-module (bight core errors)
  #:use-module (bight core schema)
  #:use-module (bight world current)
  #:use-module (bight world shape)
  #:use-module (bight world waves)
  #:use-module (srfi srfi-1)
  #:use-module (system syntax)
  #:export (clause->expression
            part->expression
            global-value
            read-fields
            read-clause
            unknown-clause
            where-inside
            missing-field))


;;; While a macro expands.

(define (datum? stx . symbols)
  (and (identifier? stx) (memq (syntax->datum stx) symbols) #t))

(define (quoted stx)
  #`(quote #,stx))

(define (expression stx)
  ;; () is no expression: let the reader of the data refuse it.
  (if (null? (syntax->datum stx)) (quoted stx) stx))

(define (word stx)
  ;; A word stands for itself; ,EXPRESSION computes one.
  (syntax-case stx ()
    ((unquote-mark e) (datum? #'unquote-mark 'unquote) #'e)
    (_ (quoted stx))))

(define (global-value module-name name)
  "Return the value of the variable NAME seen from the module called MODULE-NAME, or #f."
  (let* ((module (resolve-module module-name #f #:ensure #f))
         (variable (and module (module-variable module name))))
    (and variable (variable-bound? variable) (variable-ref variable))))

(define (lexical? id)
  (call-with-values (lambda () (syntax-local-binding id))
    (lambda (type value) (eq? type 'lexical))))

(define (reference id)
  ;; The name of a part, or else the variable ID: which, is known when the world is put together.
  (if (lexical? id)
      #`(make-reference '#,id (lambda () #,id))
      #`(make-reference '#,id (lambda ()
                                (global-value '#,(datum->syntax id (module-name (current-module)))
                                              '#,id)))))

(define (list-of expressions)
  #`(list #,@expressions))

(define (row widths)
  ;; The reader of rows: a list as long as one of WIDTHS, or that begins with a number, is a row of
  ;; expressions; anything else, and what a comma leads, is one expression.
  (lambda (stx)
    (syntax-case stx ()
      ((unquote-mark e) (datum? #'unquote-mark 'unquote) #'e)
      ((item . more)
       (and (list? (syntax->datum stx))
            (or (memv (length (syntax->datum stx)) widths)
                (number? (syntax->datum #'item))))
       (syntax-case stx ()
         ((item ...) (list-of (map expression #'(item ...))))))
      (_ (expression stx)))))

(define (grid-part stx)
  ;; (from X Y) within a grid.  Another list here is a mistake, not an expression.
  (syntax-case stx ()
    ((name value ...)
     (apply datum? #'name grid-clause-names)
     (list-of (cons (quoted #'name) (map expression #'(value ...)))))
    (_ (quoted stx))))

(define (grid-parts stxs)
  ;; A file or a procedure, an expression; then its clauses.
  (if (null? stxs)
      '()
      (cons (expression (car stxs)) (map grid-part (cdr stxs)))))

(define (current-clause stx)
  ;; (speed .5) within a current.
  (syntax-case stx ()
    ((name value)
     (apply datum? #'name current-field-names)
     (list-of (list (quoted #'name) (expression #'value))))
    (_ (expression stx))))

(define (unknown-clause? stx)
  ;; A list where only (NAME VALUE) can be meant.
  (syntax-case stx ()
    ((name . _) (and (identifier? #'name) (not (apply datum? #'name current-field-names))))
    (_ #f)))

(define (current-part stx)
  (syntax-case stx ()
    (still (datum? #'still 'still) (quoted stx))
    ((form . _)
     (not (apply datum? #'form current-forms))
     stx)
    ((form item ...)
     (datum? #'form 'profile)
     (list-of (cons (quoted #'form) (map (row '(3)) #'(item ...)))))
    ((form item ...)
     (datum? #'form 'turning 'tide)
     (list-of (cons (quoted #'form)
                    (map (lambda (item) (if (unknown-clause? item) (quoted item) (current-clause item)))
                         #'(item ...)))))
    ((form item ...)
     (list-of (cons (quoted #'form) (map current-clause #'(item ...)))))
    (_ (expression stx))))

(define (from-part? stx)
  (syntax-case stx ()
    ((name . _) (datum? #'name 'from))
    (_ #f)))

(define (from-part stx)
  ;; (from FILE CLAUSE ...) of a current, or a clause of it: (at LATITUDE LONGITUDE), (start TIME).
  (syntax-case stx ()
    ((name value ...)
     (apply datum? #'name from-clause-names)
     (list-of (cons (quoted #'name) (map from-part #'(value ...)))))
    (_ (expression stx))))

(define (waves-part stx)
  ;; none, or (airy (height 1) ...).
  (syntax-case stx ()
    ((form item ...)
     (apply datum? #'form wave-forms)
     (list-of (cons (quoted #'form)
                    (map (lambda (item)
                           (syntax-case item ()
                             ((name value)
                              (apply datum? #'name wave-field-names)
                              (list-of (list (quoted #'name) (expression #'value))))
                             ((name . _) (identifier? #'name) (quoted item))
                             (_ (expression item))))
                         #'(item ...)))))
    (none (datum? #'none 'none) (quoted stx))
    (_ (expression stx))))

(define (special? field stx)
  (and (identifier? stx) (assq (syntax->datum stx) (field-specials field)) #t))

(define (arguments field stxs)
  (case (field-kind field)
    ((word name type) (map word stxs))
    ((current) (if (and (pair? stxs) (from-part? (car stxs)))
                   (map from-part stxs)
                   (map current-part stxs)))
    ((waves) (map waves-part stxs))
    ((points) (map (row '(3)) stxs))
    ((track) (map (row '(4 5)) stxs))
    ((grid) (grid-parts stxs))
    ((end point)
     (if (and (= 1 (length stxs)) (identifier? (car stxs)))
         (list (reference (car stxs)))
         (map expression stxs)))
    (else
     (map (lambda (stx) (if (special? field stx) (quoted stx) (expression stx))) stxs))))

(define (headed head clauses)
  ;; HEAD, an identifier, and CLAUSES of what it names.
  (list-of (cons (quoted head)
                 (map (lambda (clause) (clause->expression (syntax->datum head) clause)) clauses))))

(define (clause->expression head clause)
  "Return syntax for the data of CLAUSE, the syntax (FIELD VALUE ...) of a part with HEAD, a symbol, or
#f when that is not known yet; or the syntax (INNER (FIELD VALUE ...) ...) of a thing inside that part."
  (syntax-case clause ()
    ((name stx ...)
     (identifier? #'name)
     (let* ((wanted (syntax->datum #'name))
            (field (if head (head-field head wanted) (find-field wanted))))
       (cond (field (list-of (cons (quoted #'name) (arguments field #'(stx ...)))))
             ((if head (memq wanted (inner-heads head)) (inner-head? wanted))
              (headed #'name #'(stx ...)))
             (else (quoted clause)))))
    (_ (quoted clause))))

(define (member->expression stx)
  ;; What stands in a group: a clause of its own, or a part.
  (syntax-case stx ()
    ((head . _)
     (and (identifier? #'head) (head-field 'group (syntax->datum #'head)))
     (clause->expression 'group stx))
    ((head parts ...)
     (datum? #'head 'splice)
     #'(list parts ...))
    ((head . part)
     (datum? #'head 'part)
     (part->expression #'part))
    (_ (part->expression stx))))

(define (part->expression part)
  "Return syntax for the data of PART, the syntax (HEAD CLAUSE ...)."
  (syntax-case part ()
    ((head member ...)
     (datum? #'head 'group)
     (list-of (cons (quoted #'head) (map member->expression #'(member ...)))))
    ((head clause ...)
     (and (identifier? #'head) (part-head? (syntax->datum #'head)))
     (headed #'head #'(clause ...)))
    (_ (quoted part))))


;;; When the data are there.

(define (wrong-clause proc head clause)
  (bight-raise 'def proc "a field of ~a is written (NAME VALUE), not ~s~a" (head-title head) clause
               (if (and (eq? head 'seabed) (real? clause))
                   (simple-format #f "; the seabed lies at the depth of the sea, (sea (depth ~a))" (abs clause))
                   "")))

;; What people call a bed, that no field and no part is called.
(define words-for-a-bed '(bottom bed floor ground seafloor sea-bed sea-floor))

(define (owners name)
  ;; The heads of the parts that have a field NAME.
  (filter (lambda (head) (head-field head name)) (part-heads)))

(define (where-inside head)
  "Return where a thing with HEAD, which goes inside a part, is written."
  (let ((outer (outer-head head)))
    (simple-format #f "~a is written inside ~a, as in (~a ... (~a (~a ...) ...))" (head-title head) (head-title outer)
                   outer head (field-name (car (head-fields head))))))

(define (whereabouts name)
  "Return where NAME is written that is not where it belongs: of a part that stands in the world by itself, of what
goes inside another part, or of a field that one kind of part alone has; #f when nothing is known of it."
  (let ((owners (owners name)))
    (cond ((memq name words-for-a-bed)
           "the bottom is a part of the world, (seabed), and lies at the depth of the sea, (sea (depth D))")
          ((part-head? name)
           (simple-format #f "~a is a part of the world, beside the others: (world ... (~a ...))" (head-title name) name))
          ((inner-head? name) (where-inside name))
          ((and (pair? owners) (null? (cdr owners)))
           (simple-format #f "`~a' belongs to ~a: (~a (~a ...))" name (head-title (car owners)) (car owners) name))
          (else #f))))

(define (unknown-clause proc whose name candidates . noun)
  "Raise the &bight-error from PROC for WHOSE, a string such as \"the sea\", that has no NAME but CANDIDATES: it tells
where NAME belongs, or else what was meant.  NOUN as for `unknown-name'."
  (let ((where (whereabouts name)))
    (if (and where (not (memq name candidates)))
        (bight-raise 'name proc (string-append "~a has no~a `~a'; " where) whose
                     (if (null? noun) "" (string-append " " (car noun))) name)
        (apply unknown-name proc whose name candidates noun))))

(define (wrong-arguments proc head name values)
  (let ((field (head-field head name)))
    (bight-raise 'def proc "(~a ...) of ~a needs ~a; ~a given" name (head-title head)
                 (field-range field)
                 (if (null? values) "nothing was" (brief values)))))

(define (clause-value proc head name values)
  ;; The one value that VALUES make for the field NAME.
  (let* ((field (head-field head name))
         (n (length values))
         (kind (field-kind field)))
    (cond ((and (eq? kind 'points) (> n 0) (not (and (= n 1) (accepts? type:points (car values)))))
           values)
          ((and (eq? kind 'track) (> n 0)
                (not (and (= n 1) (accepts? type:rows-in-time (car values)))))
           values)
          ((= n 1) (car values))
          ((and (eq? kind 'grid) (> n 1)) values)
          ((and (memq kind '(point end)) (= n 3)) values)
          ((and (eq? kind 'current) (or (= n 2) (and (= n 3) (pair? (car values))))) values)
          ((and (eq? kind 'origin) (= n 2)) values)
          (else (wrong-arguments proc head name values)))))

(define (read-inner proc head clauses)
  ;; The alist of fields of a thing with HEAD inside a part: there is no type to fill in what is missing.
  (let ((fields (read-fields proc head clauses)))
    (for-each (lambda (name)
                (unless (assq name fields)
                  (missing-field proc (head-title head) (head-field head name))))
              (required-fields head))
    fields))

(define (missing-field proc whose field)
  "Raise the &bight-error from PROC for WHOSE, a string such as \"a clump\", that does not give FIELD."
  (bight-raise 'def proc "~a needs (~a ...), ~a: ~a" whose
               (field-name field) (field-range field) (field-text field)))

(define (read-clause proc head datum)
  "Return (FIELD . VALUE), canonical, from DATUM, the data (FIELD VALUE ...) of a part with HEAD, or
(INNER . FIELDS) from the data (INNER (FIELD VALUE ...) ...) of a thing inside it.  Raise a &bight-error
from PROC when HEAD has no such field, the field no such value, or the thing not all it needs."
  (let ((clause (and (pair? datum) (symbol? (car datum)) (bounded-list datum))))
    (unless clause (wrong-clause proc head datum))
    (let ((name (car clause)) (values (cdr clause)))
      (cons name
            (cond ((head-field head name)
                   (check-field proc head name (clause-value proc head name values)))
                  ((memq name (inner-heads head)) (read-inner proc name values))
                  (else (unknown-clause proc (head-title head) name (head-names head))))))))

(define (read-fields proc head clauses)
  "Return the alist of canonical fields from CLAUSES, a list of data (FIELD VALUE ...) of a part with
HEAD, in their order; among them an entry (INNER . FIELDS) for each thing inside the part.  Raise a
&bight-error from PROC for the first that is wrong, and for a field that is given twice."
  (let loop ((rest clauses) (fields '()))
    (if (null? rest)
        (reverse! fields)
        (let ((entry (read-clause proc head (car rest))))
          (when (and (head-field head (car entry)) (assq (car entry) fields))
            (bight-raise 'def proc "~a is given twice for ~a" (car entry) (head-title head)))
          (loop (cdr rest) (cons entry fields))))))
