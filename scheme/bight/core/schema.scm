;;; (bight core schema) --- every field of every part, declared once.
;;;
;;; The engine tells by reflection which parts a world has, which fields they take and what is written
;;; inside them, as a clump inside a tether; what only the language knows (a part's name and type, groups
;;; of parts) is declared here.  The parser of worlds, the defaults, the error messages,
;;; `describe', `alter!' and the manual all read these records.  (bight core allowance) checks values by them.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(define-module (bight core schema)
  #:use-module (bight core errors)
  #:use-module (bight core record)
  #:use-module (bight engine)
  #:use-module (srfi srfi-1)
  #:export (part-heads
            part-head?
            obstacle-head?
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
            map-field?

            field?
            field-name
            field-kind
            field-unit
            field-text
            field-default
            field-words
            field-specials
            field-live?
            field-min
            field-max
            field-above-min?

            tether-bounds
            bound?
            bound-field
            bound-of
            bound-most
            least-mass

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
            part-type-origins
            add-part-type!
            find-part-type
            part-types
            types-called))


;;; Fields.

(define-record <field>
  (make-field name kind unit text default min max above-min? words specials live?)
  field?
  (name field-name)                     ; symbol
  (kind field-kind)                     ; number count flag point points word end current name type
                                        ; track grid mesh origin text
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
 (field-kind
  "Return the kind of FIELD: number count flag point points word end current name type track grid mesh
origin text.")
 (field-unit "Return the unit of FIELD, as \"m\", or \"\".")
 (field-text "Return what FIELD is, in a few words.")
 (field-default "Return the canonical default of FIELD, or #f when it must be given or follows.")
 (field-min "Return the least value FIELD allows, or #f.")
 (field-max "Return the greatest value FIELD allows, or #f.")
 (field-above-min? "Return true if the least value of FIELD is itself not allowed.")
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

(define up-field
  (make-field 'up 'word "" "the axis that points up in its file" 'z #f #f #f '(z y) '() #f))

(define origin-field
  (make-field 'origin 'origin "deg" "latitude and longitude of the world's (0, 0)" #f #f #f #f '() '() #f))

;; Of a bed from a file in the coordinates of a map.
(define bed-fields
  (list origin-field
        (language-field 'system 'text
                        "coordinates of its grid where the file does not say: \"EPSG:NUMBER\", or \"local\"")
        (language-field 'variable 'text "which variable of a NetCDF file is its grid")
        (make-field 'positive 'word "" "which way the numbers of its grid count, where the file does not say"
                    #f #f #f #f '(up down) '() #f)
        (make-field 'reach 'number "m" "how far from the origin its grid is read; left out: all of it"
                    #f 1 250000 #f '() '() #f)))

(define titles
  '((sea . "the sea")
    (rov . "an rov")
    (seabed . "the seabed")
    (convex . "a convex body")))

;; Fields that a part cannot do without.
(define needed
  '((tether from length)
    (box size)
    (sphere radius)
    (cylinder from to radius)
    (capsule from to radius)
    (convex points)
    (mesh file)))

(define engine-heads (%part-heads))

(define outermost
  ;; The heads of parts, read from the engine once, and the language's own.
  (append engine-heads '(group)))

(define (obstacle-head? object)
  "Return true if OBJECT is the head of a kind of obstacle."
  (and (memq object engine-heads) (not (memq object '(sea rov tether)))))

(define (rov-field name text)
  ;; As the field NAME of an rov, but for TEXT.
  (let ((v (vector-copy (find (lambda (v) (eq? name (vector-ref v 0))) (%part-fields 'rov)))))
    (vector-set! v 3 text)
    (vector->field v)))

(define group-fields
  (list named-field
        (rov-field 'at "where its own origin goes")
        (rov-field 'heading "compass bearing of its own north")))

(define (language-fields head)
  ;; What the engine does not know of a part with HEAD.
  (case head
    ((rov tether) (list named-field type-field))
    ((sea) (list origin-field))
    ((mesh) (list named-field up-field))
    ((seabed) (cons* named-field up-field bed-fields))
    ((group) group-fields)
    (else (if (obstacle-head? head) (list named-field) '()))))

(define nests
  ;; alist, head -> heads of what is written inside, for parts and all that is inside them.
  (let nest ((heads outermost))
    (append-map (lambda (head)
                  (let ((inner (if (eq? head 'group) '() (%inner-heads head))))
                    (acons head inner (nest inner))))
                heads)))

(define schema
  ;; alist, head -> fields.
  (map (lambda (entry)
         (cons (car entry)
               (append (language-fields (car entry))
                       (if (eq? 'group (car entry))
                           '()
                           (map vector->field (%part-fields (car entry)))))))
       nests))

(define (map-field? field)
  "Return true if FIELD says where on the earth a world or what it reads is; the engine knows none of that."
  (and (memq field bed-fields) #t))

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
  (if (eq? head 'group)
      "parts placed together, (group (named NAME) (at X Y Z) PART ...), called NAME/PART"
      (%head-text head)))

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
  "Return the field NAME of whatever part has one, or #f; one that takes names of parts, then one that takes
words, before others."
  (let ((found (filter-map (lambda (head) (head-field head name)) (part-heads))))
    (and (pair? found)
         (or (find (lambda (field) (eq? 'end (field-kind field))) found)
             (find (lambda (field) (pair? (field-specials field))) found)
             (car found)))))

(define (required-fields head)
  "Return the names of the fields that a part with HEAD must give, itself or by its type.  A thing inside
a part must give all that have no default."
  (if (inner-head? head)
      (map field-name (remove field-default (head-fields head)))
      (or (assq-ref needed head) '())))


;;; Bounds that follow from other fields.

(define-record <bound>
  (make-bound field of factor power floor)
  bound?
  (field bound-field)                   ; symbol
  (of bound-of)                         ; symbol: the field it follows from
  (factor bound-factor)
  (power bound-power)
  (floor bound-floor))

(document
 (bound? "Return true if OBJECT is a bound of a field that follows from another field.")
 (bound-field "Return the name of the field that BOUND is about.")
 (bound-of "Return the name of the field that BOUND follows from."))

(define tether-bounds
  ;; What fields of a tether may be at most besides the ends of their ranges, those that others follow from first.
  (map (lambda (v) (apply make-bound (vector->list v))) (%tether-bounds)))

(define (bound-most bound value)
  "Return the most that the field of BOUND may be where VALUE is that of the field that it follows from."
  (max (bound-floor bound) (* (bound-factor bound) (expt value (bound-power bound)))))

(define (least-mass diameter wet-weight density gravity)
  "Return the least mass, kg/m, of a tether of DIAMETER, m, and WET-WEIGHT, N/m, or #f if that follows from the
mass, in water of DENSITY, kg/m3, under GRAVITY, m/s2."
  (%least-mass diameter wet-weight density gravity))


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
  (make-part-type head name sentence fields origins)
  part-type?
  (head part-type-head)
  (name part-type-name)
  (sentence part-type-sentence)
  (fields part-type-fields)             ; alist, name -> canonical value
  (origins part-type-origins))          ; alist, name -> where its value comes from, in a word

(document
 (make-part-type "Return a type of parts with HEAD: its NAME, SENTENCE, alist of canonical FIELDS and alist of the
ORIGINS of those, words such as published.")
 (part-type? "Return true if OBJECT is a type of part.")
 (part-type-head "Return the head of the parts that TYPE is for.")
 (part-type-name "Return the name of TYPE, a symbol.")
 (part-type-sentence "Return the sentence that says what TYPE is.")
 (part-type-fields "Return the alist of fields that TYPE sets, canonical.")
 (part-type-origins "Return the alist of where fields of TYPE come from: published, measured, fitted or assumed."))

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

(define (types-called name)
  "Return the types of the name NAME, of all heads: a vehicle and its tether may be types of one name."
  (filter (lambda (type) (eq? name (part-type-name type)))
          (append-map part-types (part-heads))))

(define (find-part-type proc head name)
  "Return the type NAME of HEAD, or raise a &bight-error from PROC."
  (or (hash-ref type-table (cons head name))
      (unknown-name proc (simple-format #f "the table of ~a types" head)
                    name (map part-type-name (part-types head)))))
