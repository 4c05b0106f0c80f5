;;; (bight schema) --- every field of every part, declared once.
;;;
;;; The engine tells by reflection which parts a world has, which fields they take and what is written
;;; inside them, as a clump inside a tether; what only the language knows (a part's name and type) is
;;; declared here.  The parser of worlds, the defaults, the error messages, `describe', `alter!' and the
;;; manual all read these records.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(define-module (bight schema)
  #:use-module (bight argument)
  #:use-module (bight current)
  #:use-module (bight engine)
  #:use-module (bight errors)
  #:use-module (bight record)
  #:use-module (srfi srfi-1)
  #:export (part-heads
            part-head?
            inner-heads
            inner-head?
            outer-head
            head-title
            head-sentence
            head-fields
            head-field
            head-names
            find-field
            required-fields

            field?
            field-name
            field-kind
            field-unit
            field-text
            field-default
            field-words
            field-specials
            field-live?
            field-allowance
            field-range
            field-default-string

            check-field
            value->string

            make-reference
            reference?
            reference-name
            reference-value

            make-part-type
            part-type?
            part-type-head
            part-type-name
            part-type-sentence
            part-type-fields
            add-part-type!
            find-part-type
            part-types))


;;; Fields.

(define-record <field>
  (make-field name kind unit text default min max above-min? words specials live?)
  field?
  (name field-name)                     ; symbol
  (kind field-kind)                     ; number count flag point word end current name type
  (unit field-unit)                     ; "m", "deg", ... or ""
  (text field-text)                     ; a sentence
  (default field-default)               ; canonical, or #f: must be given, or follows from others
  (min field-min)                       ; number or #f
  (max field-max)
  (above-min? field-above-min?)         ; the minimum itself is excluded
  (words field-words)                   ; the symbols a `word' may be
  (specials field-specials)             ; alist, symbol -> the number it stands for
  (live? field-live?))                  ; may change while a dive runs

(document
 (field? "Return true if OBJECT is a field of a kind of part.")
 (field-name "Return the name of FIELD, a symbol.")
 (field-kind "Return the kind of FIELD: number count flag point points word end current name type.")
 (field-unit "Return the unit of FIELD, as \"m\", or \"\".")
 (field-text "Return what FIELD is, in a few words.")
 (field-default "Return the canonical default of FIELD, or #f when it must be given or follows.")
 (field-words "Return the symbols that FIELD, of kind word, may be.")
 (field-specials "Return the alist from symbols that FIELD takes to the numbers they stand for.")
 (field-live? "Return true if FIELD may change while a dive runs."))

(define (vector->field v)
  (apply make-field (vector->list v)))

(define (language-field name kind text)
  (make-field name kind "" text #f #f #f #f '() '() #f))

(define named-field
  (language-field 'named 'name "its name, unique in the world"))

(define type-field
  (language-field 'type 'type "what kind it is: a set of fields, which fills in what is not given"))

(define language-fields
  ;; What the engine does not know, by head.
  `((rov ,named-field ,type-field)
    (tether ,named-field ,type-field)))

(define titles
  '((sea . "the sea")
    (rov . "an rov")))

;; Fields that a part cannot do without.
(define needed
  '((tether from length)))

(define outermost
  ;; The heads of parts, read from the engine once.
  (%part-heads))

(define nests
  ;; alist, head -> heads of what is written inside, for parts and all that is inside them.
  (let nest ((heads outermost))
    (append-map (lambda (head)
                  (let ((inner (%inner-heads head)))
                    (acons head inner (nest inner))))
                heads)))

(define schema
  ;; alist, head -> fields.
  (map (lambda (entry)
         (cons (car entry)
               (append (or (assq-ref language-fields (car entry)) '())
                       (map vector->field (%part-fields (car entry))))))
       nests))

(define (part-heads)
  "Return the heads of parts, symbols: sea, rov, tether, ..."
  outermost)

(define (part-head? object)
  "Return true if OBJECT is the head of a kind of part."
  (and (memq object outermost) #t))

(define (inner-heads head)
  "Return the heads of what is written inside a part with HEAD, any number of each: clump, float, ... in
a tether."
  (or (assq-ref nests head) '()))

(define (inner-head? object)
  "Return true if OBJECT is the head of something that is written inside a part."
  (and (outer-head object) #t))

(define (outer-head head)
  "Return the head of the part inside which things with HEAD are written, or #f."
  (let ((entry (find (lambda (entry) (memq head (cdr entry))) nests)))
    (and entry (car entry))))

(define (head-title head)
  "Return HEAD with its article, as in \"a tether\"."
  (or (assq-ref titles head)
      (string-append "a " (symbol->string head))))

(define (head-sentence head)
  "Return what a part, or a thing inside one, with HEAD is, in a few words."
  (%head-text head))

(define (head-fields head)
  "Return the fields of parts, or of things inside them, with HEAD, in order; none for an unknown one."
  (or (assq-ref schema head) '()))

(define (head-field head name)
  "Return the field NAME of parts with HEAD, or #f."
  (find (lambda (field) (eq? name (field-name field))) (head-fields head)))

(define (head-names head)
  "Return all that may lead a clause of a part with HEAD: the names of its fields, then the heads of what
is inside it."
  (append (map field-name (head-fields head)) (inner-heads head)))

(define (find-field name)
  "Return the field NAME of whatever part has one, or #f; one that takes names of parts before others."
  (let ((found (filter-map (lambda (head) (head-field head name)) (part-heads))))
    (and (pair? found)
         (or (find (lambda (field) (eq? 'end (field-kind field))) found)
             (car found)))))

(define (required-fields head)
  "Return the names of the fields that a part with HEAD must give, itself or by its type.  A thing inside
a part must give all that have no default."
  (if (inner-head? head)
      (map field-name (remove field-default (head-fields head)))
      (or (assq-ref needed head) '())))


;;; References: a bare symbol where a point may stand is a part's name first, else a variable.

(define <reference>
  (make-record-type 'reference '(name thunk)
                    (lambda (it port) (display (reference-name it) port))))

(define make-reference (record-constructor <reference>))
(define reference? (record-predicate <reference>))
(define reference-name (record-accessor <reference> 'name))
(define reference-thunk (record-accessor <reference> 'thunk))

(document
 (make-reference "Return a reference to the part NAME, or to what THUNK returns.")
 (reference? "Return true if OBJECT is a reference.")
 (reference-name "Return the name in REFERENCE, a symbol."))

(define (reference-value reference)
  "Return the value of the variable that REFERENCE names, or #f when there is none."
  ((reference-thunk reference)))


;;; Types of parts: named sets of fields.

(define-record <part-type>
  (make-part-type head name sentence fields)
  part-type?
  (head part-type-head)
  (name part-type-name)
  (sentence part-type-sentence)
  (fields part-type-fields))            ; alist, name -> canonical value

(document
 (make-part-type "Return a type of parts with HEAD: its NAME, SENTENCE and alist of canonical FIELDS.")
 (part-type? "Return true if OBJECT is a type of part.")
 (part-type-head "Return the head of the parts that TYPE is for.")
 (part-type-name "Return the name of TYPE, a symbol.")
 (part-type-sentence "Return the sentence that says what TYPE is.")
 (part-type-fields "Return the alist of fields that TYPE sets, canonical."))

(define type-table (make-hash-table))   ; (HEAD . NAME) -> part type

(define (add-part-type! type)
  "Make TYPE known under its head and name, in place of any earlier one."
  (hash-set! type-table (cons (part-type-head type) (part-type-name type)) type))

(define (part-types head)
  "Return the known types of HEAD, sorted by name."
  (sort (filter (lambda (type) (eq? head (part-type-head type)))
                (hash-map->list (lambda (key type) type) type-table))
        (lambda (a b) (string<? (symbol->string (part-type-name a))
                                (symbol->string (part-type-name b))))))

(define (find-part-type proc head name)
  "Return the type NAME of HEAD, or raise a &bight-error from PROC."
  (or (hash-ref type-table (cons head name))
      (unknown-name proc (simple-format #f "the table of ~a types" head)
                    name (map part-type-name (part-types head)))))


;;; What a field allows, in words.

(define (bound limit)
  ;; LIMIT, if it says anything.
  (and limit (< (abs limit) 1e7) limit))

(define (bounds field)
  (let ((low (bound (field-min field)))
        (high (bound (field-max field)))
        (above? (field-above-min? field)))
    (cond ((not low) (if high (string-append "up to " (tidy->string high)) ""))
          ((not high) (string-append (if above? "above " "from ") (tidy->string low)))
          (else (string-append (if above? "above " "from ") (tidy->string low)
                               (if above? ", up to " " to ") (tidy->string high))))))

(define (tidy->string number)
  (number->string (tidy number)))

(define (tidy number)
  ;; 3.0 as 3.
  (if (and (integer? number) (< (abs number) 1e9))
      (inexact->exact number)
      number))

(define (join . texts)
  (string-join (remove string-null? texts) " "))

(define (special-words field)
  (string-concatenate
   (map (lambda (entry) (string-append ", or " (symbol->string (car entry)))) (field-specials field))))

(define (field-allowance field)
  "Return what FIELD allows, without its unit, as in \"a number above 0\"."
  (case (field-kind field)
    ((number) (string-append (join "a number" (bounds field)) (special-words field)))
    ((count) (join "a whole number" (bounds field)))
    ((flag) (argument-type-sentence type:flag))
    ((point) "a point, as X Y Z in metres or one list, vector or (vec x y z)")
    ((points) (argument-type-sentence type:points))
    ((end) "a point X Y Z in metres, or the name of a part")
    ((word) (string-append "one of " (alternatives->string (field-words field))))
    ((current) "a current: SPEED TOWARD, still, or (profile ...), (turning ...), (power ...), (tide ...)")
    ((name) "a name, one word")
    ((type) "the name of a type")
    (else "a value")))

(define (field-range field)
  "Return what FIELD allows, as in \"a number above 0 (m)\"."
  (if (and (eq? 'number (field-kind field)) (not (string-null? (field-unit field))))
      (string-append (field-allowance field) " (" (field-unit field) ")")
      (field-allowance field)))

(define (canonical-special field value)
  (let ((entry (and (number? value)
                    (find (lambda (entry) (= value (cdr entry))) (field-specials field)))))
    (and entry (car entry))))

(define (value->string field value)
  "Return the canonical VALUE of FIELD as a person would write it."
  (cond ((reference? value) (symbol->string (reference-name value)))
        ((part-type? value) (symbol->string (part-type-name value)))
        ((canonical-special field value) => symbol->string)
        ((eq? 'current (field-kind field)) (if (pair? value) (current->string value) (show value)))
        ((number? value) (tidy->string value))
        ((eq? #t value) "#t")
        ((not value) "#f")
        ((array? value) (string-join (map tidy->string (array->list value))))
        (else (show value))))

(define (field-default-string field)
  "Return the default of FIELD as text: \"\" when there is none."
  (let ((default (field-default field)))
    (cond (default (value->string field default))
          ((eq? 'flag (field-kind field)) "#f")
          (else ""))))


;;; Checking values.

(define (refuse-value proc head field value)
  (let ((words (append (field-words field) (map car (field-specials field)))))
    (if (and (symbol? value) (pair? words))
        (bight-raise 'name proc "`~a' of ~a must be ~a, not `~a'~a"
                     (field-name field) (head-title head) (field-range field) value
                     (let ((near (nearest value words)))
                       (if near (simple-format #f "; did you mean `~a'?" near) "")))
        (bight-raise 'domain proc "`~a' of ~a must be ~a, not ~s"
                     (field-name field) (head-title head) (field-range field) value))))

(define (in-range? field value)
  (let ((low (field-min field)) (high (field-max field)))
    (and (or (not low) (if (field-above-min? field) (> value low) (>= value low)))
         (or (not high) (<= value high)))))

(define (in-bounds type field value)
  (if (and (accepts? type value) (in-range? field value))
      (check-argument #f (field-name field) type value)
      refused))

(define (number-or-special field value)
  (let ((special (and (symbol? value) (assq value (field-specials field)))))
    (if special
        (cdr special)
        (in-bounds type:number field value))))

(define (plain-point value)
  (if (accepts? type:point value)
      (check-argument #f 'point type:point value)
      refused))

(define (point-value value)
  (plain-point (if (reference? value) (reference-value value) value)))

(define (end-value value)
  (if (or (symbol? value) (reference? value)) value (plain-point value)))

(define (word-value field value)
  (if (memq value (field-words field)) value refused))

(define (accepted type value)
  (if (accepts? type value) (check-argument #f 'value type value) refused))

(define (coerce proc head field value)
  (case (field-kind field)
    ((number) (number-or-special field value))
    ((count) (in-bounds type:count field value))
    ((flag) (accepted type:flag value))
    ((point) (point-value value))
    ((points) (accepted type:points value))
    ((end) (end-value value))
    ((word) (word-value field value))
    ((current) (parse-current proc value))
    ((name) (accepted type:name value))
    ((type) (cond ((part-type? value) value)
                  ((symbol? value) (find-part-type proc head value))
                  (else refused)))
    (else value)))

(define (check-field proc head name value)
  "Return the canonical form of VALUE for the field NAME of a part with HEAD, or raise a &bight-error
from PROC: no such field, or a value it does not allow.  Numbers come out inexact, counts exact, points
as f64vectors, currents as `parse-current' has them, types as records, ends as points, symbols or
references."
  (let* ((field (or (head-field head name)
                    (unknown-name proc (head-title head) name (map field-name (head-fields head)))))
         (canonical (coerce proc head field value)))
    (if (eq? canonical refused)
        (refuse-value proc head field value)
        canonical)))
