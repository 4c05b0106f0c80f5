;;; (bight assembly) --- how parts become a world.
;;;
;;; A world (bight core part) is an immutable list of parts whose fields were checked one by one against the
;;; schema (bight core clause) and whose parts are checked against each other here: one sea, unique names, ends
;;; that are there, nothing missing.  The forms a person writes are in (bight world).
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(define-module (bight assembly)
  #:use-module (bight core allowance)
  #:use-module (bight core clause)
  #:use-module (bight core errors)
  #:use-module (bight core part)
  #:use-module (bight core schema)
  #:use-module (bight world group)
  #:use-module (bight world types)
  #:use-module (srfi srfi-1)
  #:use-module (srfi srfi-4)
  #:export (data->part
            splice-parts
            build-world
            extend-world
            reduce-world
            change-world
            malformed)
  #:re-export (is-part? part-head-of part-name-of part-fields-of
               is-world? world-name-of world-documentation-of world-parts-of world-file-of
               all-fields
               find-part
               group-members
               unknown-part))


;;; From data to parts.

(define (misplaced proc head)
  ;; Something with HEAD where a part should be.
  (bight-raise 'def proc (string-append (where-inside head) ", not beside it")))

(define (data->part datum)
  "Return the part that DATUM, (HEAD (FIELD VALUE ...) ...), describes.  Raise a &bight-error when it is
no such thing or a field is wrong."
  (unless (and (pair? datum) (list? datum) (symbol? (car datum)))
    (bight-raise 'def 'world "a part is written (HEAD (FIELD VALUE) ...), or (splice PARTS), not ~s"
                 datum))
  (when (inner-head? (car datum))
    (misplaced 'world (car datum)))
  (unless (part-head? (car datum))
    (unknown-clause 'world "a world" (car datum) (part-heads) "part"))
  (if (eq? 'group (car datum))
      (data->group (cdr datum))
      (part-of (car datum) (read-fields 'world (car datum) (cdr datum)))))

(define (part-of head fields)
  (make-part head (assq-ref fields 'named) (alist-delete 'named fields eq?)))

(define (data->group items)
  ;; Clauses of the group itself, parts, lists of parts, and data of parts.
  (define (headed? item test)
    (and (pair? item) (symbol? (car item)) (test (car item))))
  (define (clause? item)
    (headed? item (lambda (head) (head-field 'group head))))
  (define (member-parts item)
    (cond ((headed? item part-head?) (list (data->part item)))
          ((headed? item inner-head?) (misplaced 'world (car item)))
          ((headed? item (const #t))
           (unknown-name 'world "a group" (car item) (append (head-names 'group) (part-heads))))
          (else (splice-parts item))))
  (let* ((fields (read-fields 'world 'group (filter clause? items)))
         (members (append-map member-parts (remove clause? items)))
         (odd (find (lambda (part) (memq (part-head-of part) '(sea seabed))) members)))
    (when odd
      (bight-raise 'def 'world "a group holds no ~a: that is the world's own" (part-head-of odd)))
    (when (null? members)
      (bight-raise 'def 'world "a group has one part or more, as in (group (named tower) (box ...))"))
    (part-of 'group (append fields (list (cons 'parts members))))))

(define deepest-splice 20)

(define* (splice-parts value #:optional (room deepest-splice))
  "Return the list of parts in VALUE: a part, or a list of such, nested at most ROOM deep."
  (cond ((is-part? value) (list value))
        ((and (list? value) (> room 0))
         (append-map (lambda (item) (splice-parts item (- room 1))) value))
        (else (bight-raise 'domain 'world "(splice ...) takes a part or a list of parts, not ~s" value))))


;;; Putting parts together.

(define (numbered head n)
  (if (= n 1) head (symbol-append head '- (string->symbol (number->string n)))))

(define (default-names parts)
  ;; Every part with a name: an unnamed one is called by its head; obstacles and groups, of which there
  ;; may be many, box, box-2, ...
  (let ((taken (make-hash-table)) (last (make-hash-table)))
    (define (next-name head)
      (let loop ((n (+ 1 (hashq-ref last head 0))))
        (let ((name (numbered head n)))
          (if (hashq-ref taken name)
              (loop (+ n 1))
              (begin (hashq-set! last head n) name)))))
    (for-each (lambda (part)
                (when (part-name-of part) (hashq-set! taken (part-name-of part) #t)))
              parts)
    (map (lambda (part)
           (let ((head (part-head-of part)))
             (cond ((part-name-of part) part)
                   ((or (eq? head 'group) (obstacle-head? head))
                    (make-part head (next-name head) (part-fields-of part)))
                   (else (make-part head head (part-fields-of part))))))
         parts)))

(define (ungroup part)
  ;; The parts that PART, which has a name, stands for in a world: itself, or those of a group.
  (if (eq? 'group (part-head-of part))
      (let* ((fields (part-fields-of part))
             (members (append-map ungroup (default-names (assq-ref fields 'parts))))
             (names (map part-name-of members)))
        (map (lambda (member) (placed-member part member names)) members))
      (list part)))

(define (placed-member group member names)
  (let ((fields (part-fields-of group)) (name (part-name-of group)))
    (make-part (part-head-of member)
               (member-name name (part-name-of member))
               (place-fields (part-head-of member) (part-fields-of member) name
                             (or (assq-ref fields 'at) (f64vector 0 0 0))
                             (or (assq-ref fields 'heading) 0.)
                             names))))

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
  (let ((seen (make-hash-table)))
    (for-each (lambda (part)
                (let* ((name (part-name-of part)) (other (hashq-ref seen name)))
                  (when other
                    (bight-raise 'def 'world
                                 "two parts are called `~a'; names are unique: write (named ...) in each ~a"
                                 name (part-head-of other)))
                  (hashq-set! seen name part)))
              parts)))

(define (refuse-second-seabed parts)
  (let ((n (count (lambda (part) (eq? 'seabed (part-head-of part))) parts)))
    (when (> n 1)
      (bight-raise 'def 'world "a world has one seabed, not ~a" n))))

(define end-heads '(rov))               ; what may be named as an end

(define (named-end part field name parts)
  (let ((other (find-part parts name)))
    (cond ((not other)
           (unknown-name 'world
                         (simple-format #f "the end `~a' of ~a: this world" field (part-name-of part))
                         name
                         (map part-name-of
                              (filter (lambda (p) (memq (part-head-of p) end-heads)) parts))
                         "part"))
          ((memq (part-head-of other) end-heads) name)
          (else
           (bight-raise 'def 'world "the end `~a' of ~a is a point, or the name of an rov, not ~a: ~a~a"
                        field (part-name-of part) (head-title (part-head-of other)) name
                        (if (obstacle-head? (part-head-of other))
                            "; of an obstacle, give the point where it is fastened"
                            ""))))))

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
  (let ((parts (append-map ungroup (default-names (with-sea parts)))))
    (refuse-second-seabed parts)
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
  "Return the world W without the parts called NAMES, and without all parts of groups called so."
  (for-each (lambda (name)
              (unless (or (find-part (world-parts-of w) name)
                          (pair? (group-members (world-parts-of w) name)))
                (unknown-part 'without w name)))
            names)
  (rebuilt w (remove (lambda (part)
                       (any (lambda (name)
                              (or (eq? name (part-name-of part)) (member-of? name (part-name-of part))))
                            names))
                     (world-parts-of w))))


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
          ((pair? (group-members (world-parts-of w) name))
           => (lambda (yes)
                (bight-raise 'def 'with "`~a' is a group; change its parts one by one: ~a" name
                             (words->string
                              (map part-name-of (group-members (world-parts-of w) name))))))
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
