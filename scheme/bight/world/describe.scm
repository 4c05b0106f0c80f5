;;; (bight world describe) --- what a kind of part, a type, a world or one of its parts is, as a table.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(define-module (bight world describe)
  #:use-module (bight assembly)
  #:use-module (bight core allowance)
  #:use-module (bight core errors)
  #:use-module ((bight core record) #:select (document))
  #:use-module (bight core schema)
  #:use-module ((bight core units) #:select (vec-))
  #:use-module (bight core verb)
  #:use-module ((bight dive) #:select (current-dive dive-world))
  #:use-module ((bight dive query)
                #:select (tether-properties obstacle-properties (find-part . index-of-part)))
  #:use-module (bight world atlas)
  #:use-module (srfi srfi-1)
  #:use-module (srfi srfi-4)
  #:export (describe
            head-description
            type-description
            part-description
            world-description
            description?
            description-title
            description-sentence
            description-rows))


;;; Descriptions: a title, a sentence, and rows of strings in columns.

(define <description>
  (make-record-type 'description '(title sentence rows)
                    (lambda (it port) (print-description it port))))

(define make-description (record-constructor <description>))
(define description? (record-predicate <description>))
(define description-title (record-accessor <description> 'title))
(define description-sentence (record-accessor <description> 'sentence))
(define description-rows (record-accessor <description> 'rows))

(document
 (description? "Return true if OBJECT is a description.")
 (description-title "Return the title of DESCRIPTION, a string.")
 (description-sentence "Return the sentence of DESCRIPTION.")
 (description-rows "Return the rows of DESCRIPTION, lists of strings of equal length."))

(define (column-width rows n)
  (fold (lambda (row width) (max width (string-length (list-ref row n)))) 0 rows))

(define (print-row row widths port)
  (let ((line (string-join (map (lambda (text width) (string-pad-right text width)) row widths) "  ")))
    (display "\n  " port)
    (display (string-trim-right line) port)))

(define (print-description it port)
  (let* ((rows (description-rows it))
         (n (if (null? rows) 0 (length (car rows))))
         (widths (map (lambda (i) (column-width rows i)) (iota n))))
    (simple-format port "~a: ~a" (description-title it) (description-sentence it))
    (for-each (lambda (row) (print-row row widths port)) rows)))

(define (symbol->row-text symbol)
  (if symbol (symbol->string symbol) ""))


;;; Of each kind of thing.

(define (field-row field)
  ;; name, unit, default, what it is and what it allows
  (list (symbol->string (field-name field))
        (field-unit field)
        (field-default-string field)
        (string-append (field-text field) "; " (field-allowance field))))

(define (inner-row head)
  ;; As field-row, for things with HEAD inside a part.
  (list (symbol->string head)
        ""
        ""
        (simple-format #f "~a; any number, each (~a (FIELD VALUE) ...)" (head-sentence head) head)))

(define (head-description head)
  "Return the description of parts, or of things inside them, with HEAD, a symbol such as tether or
clump: a row (NAME UNIT DEFAULT TEXT) of strings for each field and each kind of thing inside."
  (make-description (symbol->string head) (head-sentence head)
                    (append (map field-row (head-fields head))
                            (map inner-row (inner-heads head)))))

(define (inner->string head fields)
  ;; "at 6 m, mass 2 kg"
  (define (inner-value entry)
    (let ((row (value-row head entry "")))
      (string-trim-right (string-join (take row 3) " "))))
  (string-join (map inner-value fields) ", "))

(define (value-row head entry source)
  (let* ((name (car entry)) (field (head-field head name)))
    (list (symbol->string name)
          (if field (value->string field (cdr entry)) (inner->string name (cdr entry)))
          (if field (field-unit field) "")
          source)))

(define (type-description type)
  "Return the description of TYPE, a part type: a row (NAME VALUE UNIT ORIGIN) for each field it sets; ORIGIN is
published, measured, fitted (to a measurement), assumed, or \"\" where none is known."
  (define (origin entry) (or (assq-ref (part-type-origins type) (car entry)) ""))
  (make-description (simple-format #f "~a, a type of ~a" (part-type-name type) (part-type-head type))
                    (part-type-sentence type)
                    (map (lambda (entry) (value-row (part-type-head type) entry (origin entry)))
                         (part-type-fields type))))

(define (default-rows head given)
  ;; The fields that are left to their defaults.
  (filter-map (lambda (field)
                (and (not (assq (field-name field) given))
                     (field-default field)
                     (value-row head (cons (field-name field) (field-default field)) "default")))
              (head-fields head)))

(define (part-description part)
  "Return the description of PART of a world: a row (NAME VALUE UNIT SOURCE) for each field, whether
given, from its type or left to the default, and for each thing inside it."
  (let* ((head (part-head-of part))
         (own (part-fields-of part))
         (all (all-fields part))
         (type (assq-ref own 'type)))
    (define (source entry)
      (if (assq (car entry) own) "" (string-append "from " (symbol->string (part-type-name type)))))
    (make-description (simple-format #f "~a, ~a" (part-name-of part) (head-title head))
                      (if type (part-type-sentence type) (head-sentence head))
                      (append (map (lambda (entry) (value-row head entry (source entry))) all)
                              (default-rows head all)))))

(define (world-description w)
  "Return the description of the world W: a row (NAME HEAD TYPE) for each part."
  (define (part-row part)
    (let ((type (assq-ref (part-fields-of part) 'type)))
      (list (symbol->row-text (part-name-of part))
            (symbol->string (part-head-of part))
            (if type (symbol->string (part-type-name type)) ""))))
  (make-description (if (world-name-of w) (symbol->string (world-name-of w)) "a world")
                    (or (world-documentation-of w) "")
                    (map part-row (world-parts-of w))))


;;; By name.

(define (here-world)
  (and (current-dive) (dive-world (current-dive))))

(define (here-part name)
  (let ((w (here-world)))
    (and w (find-part (world-parts-of w) name))))

(define (live-row head row live)
  ;; ROW with the value its field has now, if that is another.
  (let* ((name (string->symbol (first row)))
         (entry (assq name live))
         (text (and entry (value->string (head-field head name) (cdr entry)))))
    (if (and text (not (string=? text (second row))))
        (list (first row) text (third row) "now")
        row)))

(define (to-five-digits value)
  ;; VALUE, if it is a number, with as many digits as what it follows from may have.
  (if (and (real? value) (inexact? value) (< 1e-9 (abs value) 1e12))
      (let ((unit (expt 10 (- 4 (inexact->exact (floor (log10 (abs value))))))))
        (exact->inexact (/ (round (* unit (inexact->exact value))) unit)))
      value))

(define (follower-rows head rows live)
  ;; Rows for the fields that were left to follow from others.
  (filter-map (lambda (entry)
                (and (not (assoc (symbol->string (car entry)) rows))
                     (value-row head (cons (car entry) (to-five-digits (cdr entry))) "follows")))
              live))

(define (corner->string corner)
  ;; A tenth of a metre tells where a body is.
  (string-join (map (lambda (x) (number->string (/ (round (* 10 x)) 10))) (f64vector->list corner))))

(define (read-rows head name)
  ;; Rows for what was read from a file or given as heights: how many triangles, and the box they fill.
  (let* ((found (if (memq head '(mesh seabed)) (obstacle-view name) '()))
         (n (or (assq-ref found 'triangles) 0)))
    (if (zero? n)
        '()
        (let ((low (assq-ref found 'low)) (high (assq-ref found 'high)))
          (list (list "triangles" (number->string n) "" "read")
                (list "box" (string-append (corner->string low) " to " (corner->string high)) "m" "read")
                (list "extent" (corner->string (vec- high low)) "m" "read"))))))

(define (dive-description part)
  ;; The description of a PART of the current dive; fields of tethers and obstacles as they are now.
  (let* ((described (part-description part))
         (head (part-head-of part))
         (rows (description-rows described))
         (live (live-properties head (part-name-of part))))
    (make-description (description-title described)
                      (description-sentence described)
                      (append (map (lambda (row) (live-row head row live)) rows)
                              (follower-rows head rows live)
                              (read-rows head (part-name-of part))))))

(define (with-possibilities described head)
  ;; DESCRIBED, a part that is called as its kind, with what each field may be, and the fields that it has not.
  (let ((rows (description-rows described)))
    (define (possible row) (list (first row) "" (second row) "" (fourth row)))
    (define (told row)
      (let ((field (assoc (first row) possibilities)))
        (append row (list (if field (fourth field) "")))))
    (define possibilities (description-rows (head-description head)))
    (make-description (description-title described)
                      (description-sentence described)
                      (append (map told rows)
                              (map possible
                                   (remove (lambda (row) (assoc (first row) rows)) possibilities))))))

(define (obstacle-view name)
  ;; The alist of what the obstacle NAME of the present dive is.
  (call-with-values (lambda () (index-of-part 'describe name))
    (lambda (kind index) (obstacle-properties 'describe index))))

(define (live-properties head name)
  ;; What may have changed since the dive began, an alist.
  (cond ((eq? head 'tether) (tether-properties (subject-index 'describe 'tether name)))
        ((obstacle-head? head)
         (list (assq 'friction (obstacle-view name))))
        (else '())))

(define (group-description name members)
  "Return the description of the group NAME of MEMBERS, parts: a row (NAME HEAD) for each."
  (make-description (simple-format #f "~a, a group" name)
                    (head-sentence 'group)
                    (map (lambda (part)
                           (list (symbol->row-text (part-name-of part))
                                 (symbol->string (part-head-of part))))
                         members)))

(define (here-group name)
  ;; The parts of the group NAME in the current dive, or #f.
  (let* ((w (here-world))
         (members (if w (group-members (world-parts-of w) name) '())))
    (and (pair? members) members)))

(define (types-description types)
  ;; The descriptions of TYPES, one after the other, as one.
  (let ((all (map type-description types)))
    (make-description (string-join (map description-title all) "; ")
                      (string-join (map description-sentence all) " ")
                      (append-map description-rows all))))

(define (all-names)
  (let ((w (here-world)))
    (append (if w (map part-name-of (world-parts-of w)) '())
            (part-heads)
            (append-map inner-heads (part-heads))
            (map part-type-name (append-map part-types (part-heads)))
            (worlds))))

(define (describe-name name)
  (cond ((and (part-head? name) (here-part name))
         => (lambda (part) (with-possibilities (dive-description part) name)))
        ((here-part name) => dive-description)
        ((here-group name) => (lambda (members) (group-description name members)))
        ((or (part-head? name) (inner-head? name)) (head-description name))
        ((pair? (types-called name)) (types-description (types-called name)))
        ((memq name (worlds)) (world-description (find-world name)))
        (else (unknown-name 'describe "the language" name (all-names) "part, type or world"))))

(define-argument-type (describable value)
  "a world, a part, or a name: of a part of the dive, a kind of part, a type or a world"
  (if (or (symbol? value) (is-world? value) (is-part? value)) value refused))

(define-verb (describe (thing describable))
  "Return a description of THING that prints as a table.  THING is a world, a part, or a symbol: the name
of a part or a group of the present dive, a kind of part such as 'tether or of a thing inside one such as
'clump, a type such as 'fathom, or a world."
  (cond ((symbol? thing) (describe-name thing))
        ((is-world? thing) (world-description thing))
        ((assq-ref (part-fields-of thing) 'parts)
         => (lambda (members) (group-description (or (part-name-of thing) 'group) members)))
        (else (part-description thing))))
