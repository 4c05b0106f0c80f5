;;; (bight assembly) --- parts and worlds as records, and how parts become a world.
;;;
;;; A world is an immutable list of parts whose fields were checked one by one against the schema
;;; (bight clause) and whose parts are checked against each other here: one sea, unique names, ends that
;;; are there, nothing missing.  The forms a person writes are in (bight world).
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(define-module (bight assembly)
  #:use-module (bight clause)
  #:use-module (bight errors)
  #:use-module ((bight record) #:select (document))
  #:use-module (bight schema)
  #:use-module (bight types)
  #:use-module (srfi srfi-1)
  #:use-module (srfi srfi-4)
  #:export (is-part? part-head-of part-name-of part-fields-of
            is-world? world-name-of world-documentation-of world-parts-of world-file-of
            all-fields
            find-part
            unknown-part
            data->part
            splice-parts
            build-world
            extend-world
            reduce-world
            change-world
            malformed))


;;; Records.

(define <part>
  (make-record-type 'part '(head name fields) (lambda (part port) (print-part part port))))

(define make-part (record-constructor <part>))
(define part-head-of (record-accessor <part> 'head))
(define part-name-of (record-accessor <part> 'name))
(define part-fields-of (record-accessor <part> 'fields))
(define is-part? (record-predicate <part>))

(define <world>
  (make-record-type 'world '(name documentation parts file)
                    (lambda (world port) (print-world world port))))

(define make-world (record-constructor <world>))
(define is-world? (record-predicate <world>))
(define world-name-of (record-accessor <world> 'name))
(define world-documentation-of (record-accessor <world> 'documentation))
(define world-parts-of (record-accessor <world> 'parts))
(define world-file-of (record-accessor <world> 'file))

(document
 (is-part? "Return true if OBJECT is a part.")
 (part-head-of "Return the head of PART, a symbol.")
 (part-name-of "Return the name of PART, a symbol, or #f.")
 (part-fields-of "Return the alist of fields PART itself gives, canonical, and what is inside it.")
 (is-world? "Return true if OBJECT is a world.")
 (world-name-of "Return the name of WORLD, a symbol, or #f.")
 (world-documentation-of "Return the sentence of WORLD, or #f.")
 (world-parts-of "Return the parts of WORLD, the sea first.")
 (world-file-of "Return the name of the file WORLD was written in, or #f."))

(define (print-part part port)
  (simple-format port "#<~a~a>" (part-head-of part)
                 (if (part-name-of part) (string-append " " (symbol->string (part-name-of part))) "")))

(define (plural n head)
  (simple-format #f "~a ~a~a" n head (if (= n 1) "" "s")))

(define (inventory world)
  ;; "1 rov, 2 tethers"
  (let ((counts (filter-map
                 (lambda (head)
                   (let ((n (count (lambda (part) (eq? head (part-head-of part))) (world-parts-of world))))
                     (and (> n 0) (not (eq? head 'sea)) (plural n head))))
                 (part-heads))))
    (if (null? counts) "open water" (string-join counts ", "))))

(define (print-world world port)
  (simple-format port "#<world~a: ~a>"
                 (if (world-name-of world)
                     (string-append " " (symbol->string (world-name-of world)))
                     "")
                 (inventory world)))

(define (all-fields part)
  "Return the alist of fields of PART, its own before those of its type."
  (let* ((own (part-fields-of part))
         (type (assq-ref own 'type)))
    (alist-delete 'type (merge-fields own (if type (part-type-fields type) '())) eq?)))

(define (find-part parts name)
  "Return the one of PARTS called NAME, or #f."
  (find (lambda (part) (eq? name (part-name-of part))) parts))

(define (unknown-part proc w name)
  "Raise a &bight-error of kind name from PROC: the world W has no part NAME."
  (unknown-name proc (world-title w) name (map part-name-of (world-parts-of w)) "part"))

(define (world-title w)
  (if (world-name-of w)
      (string-append "world " (symbol->string (world-name-of w)))
      "this world"))


;;; From data to parts.

(define (misplaced proc head)
  ;; Something with HEAD where a part should be.
  (let ((outer (outer-head head)))
    (bight-raise 'def proc "~a is written inside ~a, as in (~a ... (~a (~a ...) ...)), not beside it"
                 (head-title head) (head-title outer) outer head
                 (field-name (car (head-fields head))))))

(define (data->part datum)
  "Return the part that DATUM, (HEAD (FIELD VALUE ...) ...), describes.  Raise a &bight-error when it is
no such thing or a field is wrong."
  (unless (and (pair? datum) (list? datum) (symbol? (car datum)))
    (bight-raise 'def 'world "a part is written (HEAD (FIELD VALUE) ...), or (splice PARTS), not ~s"
                 datum))
  (when (inner-head? (car datum))
    (misplaced 'world (car datum)))
  (unless (part-head? (car datum))
    (unknown-name 'world "a world" (car datum) (part-heads) "part"))
  (let ((fields (read-fields 'world (car datum) (cdr datum))))
    (make-part (car datum) (assq-ref fields 'named) (alist-delete 'named fields eq?))))

(define deepest-splice 20)

(define* (splice-parts value #:optional (room deepest-splice))
  "Return the list of parts in VALUE: a part, or a list of such, nested at most ROOM deep."
  (cond ((is-part? value) (list value))
        ((and (list? value) (> room 0))
         (append-map (lambda (item) (splice-parts item (- room 1))) value))
        (else (bight-raise 'domain 'world "(splice ...) takes a part or a list of parts, not ~s" value))))


;;; Putting parts together.

(define (default-names parts)
  ;; Every part with a name: an unnamed one is called by its head.
  (map (lambda (part)
         (if (part-name-of part)
             part
             (make-part (part-head-of part) (part-head-of part) (part-fields-of part))))
       parts))

(define (with-sea parts)
  ;; The sea first, with the defaults if there is none.
  (let* ((sea? (lambda (part) (eq? 'sea (part-head-of part))))
         (seas (filter sea? parts))
         (others (remove sea? parts)))
    (case (length seas)
      ((0) (cons (make-part 'sea 'sea '()) others))
      ((1) (cons (car seas) others))
      (else (bight-raise 'def 'world "a world has one sea, not ~a" (length seas))))))

(define (refuse-twins parts)
  (let loop ((rest parts))
    (unless (null? rest)
      (let* ((part (car rest)) (name (part-name-of part)))
        (when (find-part (cdr rest) name)
          (bight-raise 'def 'world
                       "two parts are called `~a'; names are unique: write (named ...) in each ~a"
                       name (part-head-of part))))
      (loop (cdr rest)))))

(define (end-heads field)
  ;; What may be named as an end.
  (if (eq? field 'to)
      '(rov)
      (remove (lambda (head) (memq head '(sea tether))) (part-heads))))

(define (named-end part field name parts)
  (let ((other (find-part parts name)))
    (cond ((not other)
           (unknown-name 'world
                         (simple-format #f "the end `~a' of ~a: this world" field (part-name-of part))
                         name
                         (map part-name-of
                              (filter (lambda (p) (memq (part-head-of p) (end-heads field))) parts))
                         "part"))
          ((memq (part-head-of other) (end-heads field)) name)
          (else
           (bight-raise 'def 'world "the end `~a' of ~a is ~a, not ~a: ~a" field (part-name-of part)
                        "a point, or the name of an rov" (head-title (part-head-of other)) name)))))

(define (resolved-end part field value parts)
  (cond ((f64vector? value) value)
        ((symbol? value) (named-end part field value parts))
        ((find-part parts (reference-name value))
         (named-end part field (reference-name value) parts))
        (else
         (let ((meant (reference-value value)))
           (if (or (not meant) (procedure? meant))
               (named-end part field (reference-name value) parts)
               (let ((end (check-field 'world (part-head-of part) field meant)))
                 (if (symbol? end) (named-end part field end parts) end)))))))

(define (resolve-ends part parts)
  (define (end? name)
    (let ((field (head-field (part-head-of part) name)))
      (and field (eq? 'end (field-kind field)))))
  (define (resolve entry)
    (if (end? (car entry))
        (cons (car entry) (resolved-end part (car entry) (cdr entry) parts))
        entry))
  (make-part (part-head-of part) (part-name-of part) (map resolve (part-fields-of part))))

(define (only-rov parts)
  (let ((rovs (filter (lambda (part) (eq? 'rov (part-head-of part))) parts)))
    (and (= 1 (length rovs)) (part-name-of (car rovs)))))

(define (default-end part parts)
  ;; A tether that does not say leads to the only vehicle.
  (let ((fields (part-fields-of part)))
    (cond ((or (not (eq? 'tether (part-head-of part))) (assq 'to fields)) part)
          ((only-rov parts)
           => (lambda (name)
                (make-part 'tether (part-name-of part) (append fields (list (cons 'to name))))))
          (else (missing part 'to)))))

(define (missing part name)
  (missing-field 'world (simple-format #f "~a `~a'" (part-head-of part) (part-name-of part))
                 (head-field (part-head-of part) name)))

(define (require-fields part)
  (let ((given (all-fields part)))
    (for-each (lambda (name) (unless (assq name given) (missing part name)))
              (required-fields (part-head-of part)))))

(define (assemble parts)
  ;; PARTS, checked against each other, ready for a world.
  (let ((parts (default-names (with-sea parts))))
    (refuse-twins parts)
    (let ((whole (map (lambda (part) (default-end (resolve-ends part parts) parts)) parts)))
      (for-each require-fields whole)
      whole)))

(define (build-world name documentation file parts)
  "Return the world NAME of PARTS, a list of parts and lists of parts.  NAME, DOCUMENTATION and FILE may
be #f.  Raise a &bight-error when the parts do not hold together."
  (make-world name documentation (assemble (splice-parts parts)) file))

(define (rebuilt w parts)
  ;; The world W with PARTS instead of its own.
  (make-world (world-name-of w) (world-documentation-of w) (assemble parts) (world-file-of w)))

(define (given-parts w)
  ;; The parts of W, without a sea that says nothing: another may take its place.
  (remove (lambda (part) (and (eq? 'sea (part-head-of part)) (null? (part-fields-of part))))
          (world-parts-of w)))

(define (extend-world w parts)
  "Return the world W with PARTS, a list of parts and lists of parts, added."
  (rebuilt w (append (given-parts w) (splice-parts parts))))

(define (reduce-world w names)
  "Return the world W without the parts called NAMES."
  (for-each (lambda (name)
              (unless (find-part (world-parts-of w) name) (unknown-part 'without w name)))
            names)
  (rebuilt w (remove (lambda (part) (memq (part-name-of part) names)) (world-parts-of w))))


;;; with: another value for some fields.

(define (put-fields part fields)
  ;; Things inside, as clumps, stand in place of all of their kind.
  (make-part (part-head-of part)
             (or (assq-ref fields 'named) (part-name-of part))
             (merge-fields (alist-delete 'named fields eq?) (part-fields-of part))))

(define (changed-part w clause)
  ;; The name of the part that CLAUSE is about.
  (let ((name (and (pair? clause) (symbol? (car clause)) (car clause))))
    (cond ((not name)
           (bight-raise 'def 'with "a change is (FIELD VALUE) of the sea or (PART (FIELD VALUE) ...), not ~s"
                        clause))
          ((find-part (world-parts-of w) name) name)
          ((inner-head? name) (misplaced 'with name))
          (else
           (unknown-name 'with (world-title w) name
                         (append (map field-name (head-fields 'sea))
                                 (map part-name-of (world-parts-of w)))
                         "part, nor the sea a field,")))))

(define (change-part parts name fields-of)
  (map (lambda (part)
         (if (eq? name (part-name-of part)) (put-fields part (fields-of (part-head-of part))) part))
       parts))

(define (change w clause)
  ;; The parts of W as CLAUSE has them.
  (if (and (pair? clause) (symbol? (car clause)) (head-field 'sea (car clause)))
      (change-part (world-parts-of w) (part-name-of (car (world-parts-of w)))
                   (lambda (head) (list (read-clause 'with 'sea clause))))
      (let ((name (changed-part w clause)))
        (unless (list? clause) (malformed 'with clause))
        (change-part (world-parts-of w) name
                     (lambda (head) (read-fields 'with head (cdr clause)))))))

(define (change-world w clauses)
  "Return the world W with the changes in CLAUSES, a list of data (FIELD VALUE ...) of the sea or (PART
(FIELD VALUE ...) ...).  The things of a kind inside a part, such as the clumps of a tether, change
together: those given take the place of all there were."
  (fold (lambda (clause w) (rebuilt w (change w clause))) w clauses))


(define (malformed proc form)
  "Raise the &bight-error for FORM, the data of a use of PROC that is not written right."
  (bight-raise 'def proc "~a, not ~s"
               (case proc
                 ((define-world) "a world is defined by (define-world NAME \"What it is.\" PART ...)")
                 ((part) "a part is (part HEAD (FIELD VALUE) ...)")
                 ((extend) "a world is extended by (extend WORLD PART ...)")
                 ((with) "a world is changed by (with WORLD (FIELD VALUE) ...)")
                 (else "a world is (world PART ...)"))
               form))
