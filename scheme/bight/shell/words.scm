;;; (bight shell words) --- help on words that are no verbs: fields, keywords, events, units, names.
;;;
;;; What a word is follows from the schema, the verbs, the commands and the files; only the sentences of events
;;; and of units stand here.  A word may be several things: all of them are told.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(define-module (bight shell words)
  #:use-module ((bight core allowance) #:select (field-default-string field-range))
  #:use-module (bight core late)
  #:use-module (bight core schema)
  #:use-module ((bight core sentence) #:select (event-sentence sentence-of-lesson))
  #:use-module ((bight core verb) #:select (verb? verb-arguments))
  #:use-module ((bight shell guide) #:select (unit-of))
  #:use-module ((bight shell meant) #:select (quoted-names))
  #:use-module (srfi srfi-1)
  #:export (word-lines
            example-value
            all-heads))

(define (language name)
  (module-ref (resolve-interface '(bight)) name))

(define (kind phrase)
  (or (assoc-ref (quoted-names) phrase) '()))

(define (paragraphs lists)
  ;; The lists of lines that are not empty, a blank line between two.
  (let ((full (remove null? lists)))
    (if (null? full)
        '()
        (append (car full) (append-map (lambda (lines) (cons "" lines)) (cdr full))))))


;;; Fields.

(define (all-heads)
  "Return the heads of parts and of all that is written inside them."
  (delete-duplicates (append (part-heads) (append-map inner-heads-below (part-heads))) eq?))

(define (inner-heads-below head)
  (append-map (lambda (inner) (cons inner (inner-heads-below inner))) (inner-heads head)))

(define (heads-with name)
  (filter (lambda (head) (head-field head name)) (all-heads)))

(define (a-number field)
  ;; A number that FIELD allows, as text.
  (let ((low (field-min field)) (high (field-max field)))
    (cond ((and low (>= low 1)) (number->string (inexact->exact (ceiling (+ low (if (field-above-min? field) 1 0))))))
          ((and high (< high 1)) (number->string (/ high 2)))
          (else "1"))))

(define (example-value field)
  "Return what could follow the name of FIELD, as text, or #f where one value says nothing."
  (let ((default (field-default-string field)))
    (cond ((not (or (string-null? default) (memq (field-kind field) '(end current waves)))) default)
          (else
           (case (field-kind field)
             ((number count) (a-number field))
             ((end) "0 0 -5")
             ((point) (if (and (field-min field) (>= (field-min field) 0)) "1 1 1" "0 0 -5"))
             ((current) "0.3 90")
             ((word) (symbol->string (car (field-words field))))
             ((origin) "58.5 5.2")
             ((name) "line")
             (else #f))))))

(define (example-form head field)
  ;; FIELD as it is written in a part with HEAD; a thing inside a part is written in that.
  (let* ((value (example-value field))
         (clause (and value (simple-format #f "(~a ... (~a ~a))" head (field-name field) value))))
    (and clause
         (if (part-head? head)
             clause
             (simple-format #f "(~a ... ~a)" (outer-head head) clause)))))

(define (with-unit text unit)
  (if (or (string-null? text) (string-null? unit)) text (string-append text " " unit)))

(define (said label text)
  (if (string-null? text) '() (list (string-append "  " label ": " text))))

(define (other-fields heads name)
  ;; Fields whose names share a word with NAME, of the first of HEADS.
  (let ((words (string-split (symbol->string name) #\-)))
    (filter (lambda (other)
              (and (not (eq? other name))
                   (pair? (lset-intersection string=? words (string-split (symbol->string other) #\-)))))
            (map field-name (head-fields (car heads))))))

(define (field-lines heads name)
  ;; What the field NAME is in HEADS, which say the same of it.
  (let* ((head (car heads)) (field (head-field head name)) (example (example-form head field))
         (needed? (memq name (required-fields head))))
    (append
     (list (simple-format #f "~a: a field of ~a." name (string-join (map symbol->string heads) ", "))
           (string-append "  " (field-text field)))
     (said "allowed" (field-range field))
     (if (memq (field-kind field) '(number type)) '() (said "unit" (field-unit field)))
     (said (if needed? "must be given" "left out")
           (let ((default (field-default-string field)))
             (cond (needed? "yes")
                   ((string-null? default) "it follows from others, or is not there")
                   (else (with-unit default (if (number? (field-default field)) (field-unit field) ""))))))
     (if (field-live? field)
         (list (simple-format #f "  may change during a dive: (alter! '~a #:~a ...)" head name))
         '())
     (said "for example" (or example ""))
     (list (string-append "See also: "
                          (string-join (append (map (lambda (head) (simple-format #f "(describe '~a)" head)) heads)
                                               (map symbol->string (other-fields heads name)))
                                       ", "))))))

(define (alike? a b name)
  (let ((f (head-field a name)) (g (head-field b name)))
    (and (equal? (field-text f) (field-text g))
         (equal? (field-range f) (field-range g))
         (equal? (field-default-string f) (field-default-string g)))))

(define (by-meaning heads name)
  ;; HEADS in lists of those that say the same of their field NAME.
  (if (null? heads)
      '()
      (call-with-values (lambda () (partition (lambda (head) (alike? (car heads) head name)) heads))
        (lambda (same others) (cons same (by-meaning others name))))))

(define (fields-lines name)
  (paragraphs (map (lambda (heads) (field-lines heads name)) (by-meaning (heads-with name) name))))


;;; Keywords of verbs, options of commands.

(define (verbs-with keyword)
  ;; alist, name of a verb -> what it says of its argument KEYWORD.
  (filter-map (lambda (name)
                (let* ((value (language name))
                       (argument (and (verb? value)
                                      (find (lambda (row) (eq? keyword (second row))) (verb-arguments value)))))
                  (and argument (cons name (third argument)))))
              ((language 'language-names))))

(define (keyword-lines keyword)
  (let ((found (verbs-with keyword)))
    (if (null? found)
        '()
        (cons (simple-format #f "~s: a keyword of ~a" keyword
                             (if (null? (cdr found)) "a verb." "these verbs."))
              (map (lambda (entry)
                     (let ((unit (unit-of (symbol->string (car entry)) keyword)))
                       (simple-format #f "  (~a ~s ...): ~a~a" (car entry) keyword
                                      (if unit (string-append unit "; ") "") (cdr entry))))
                   found)))))

(define (option-lines text)
  ;; What the commands say of their option TEXT, such as "--seed".
  (define (of-command command)
    (filter-map (lambda (option)
                  (and (string=? text (car (string-split (car option) #\space)))
                       (simple-format #f "  bight ~a ~a: ~a" ((from (bight shell usage) command-name) command)
                                      (car option) (string-join (cdr option) " "))))
                ((from (bight shell usage) command-option-lines) command)))
  (let ((found (append-map of-command (from (bight shell commands) commands))))
    (if (null? found) '() (cons (simple-format #f "~a: an option." text) found))))


;;; Events, units.

(define (event-lines name)
  (if (memq name (kind "an event"))
      (list (simple-format #f "~a: an event." name)
            (string-append "  " (event-sentence name))
            (simple-format #f "  for example: (on '~a (lambda (event) (display event)))" name)
            "See also: events, on, run-until")
      '()))

(define units
  '(("m" . "metres; x counts east, y north, z up from the surface of the sea")
    ("m/s" . "metres a second; (knots 1) is a knot in them")
    ("m/s2" . "metres a second squared")
    ("m3" . "cubic metres")
    ("s" . "seconds; (minutes 1) and (hours 1) are in them")
    ("1/m" . "of curvature: the inverse of the radius of a bend, in metres")
    ("deg" . "degrees: a bearing counts from north by east, as a compass does")
    ("deg/s" . "degrees a second")
    ("N" . "newtons; 1 kg weighs 9.8 N in air")
    ("N/m" . "newtons for each metre of line")
    ("N s" . "newton seconds")
    ("N m" . "newton metres")
    ("N m s" . "newton metres for each radian a second of turning")
    ("N m s2" . "newton metres for each radian a second, squared")
    ("N s/m" . "newtons for each metre a second")
    ("N s2/m2" . "newtons for each metre a second, squared")
    ("N m2" . "newtons times square metres: what holds a line straight against bending or twisting")
    ("N m2 s" . "newtons times square metres for each radian a second: what damps bending")
    ("kg" . "kilograms")
    ("kg/m" . "kilograms for each metre of line")
    ("kg/m3" . "kilograms in a cubic metre; sea water has 1025")
    ("kg m2" . "kilograms times square metres, of inertia")
    ("J/m" . "joules for each metre")
    ("V" . "volts")))

(define (units-of field)
  ;; Those of forces and of moments stand beside each other.
  (map string-trim (string-split (field-unit field) #\,)))

(define (fields-in unit)
  ;; Lines "rov: pull ...", of each kind of part its fields in UNIT, or #f.
  (let ((found (filter-map
                (lambda (head)
                  (let ((names (filter-map (lambda (field) (and (member unit (units-of field)) (field-name field)))
                                           (head-fields head))))
                    (and (pair? names)
                         (simple-format #f "~a: ~a" head (string-join (map symbol->string names) " ")))))
                (all-heads))))
    (and (pair? found) found)))

(define (unit-lines text)
  (let ((entry (assoc text units)))
    (if entry
        (append (list (simple-format #f "~a: a unit." text) (string-append "  " (cdr entry)))
                (let ((fields (fields-in text)))
                  (if fields
                      (cons "  fields in it:" (map (lambda (line) (string-append "    " line)) fields))
                      '())))
        '())))


;;; Names of worlds, types and lessons.

(define (use-lines name)
  ;; What one does with the world or type NAME; `describe' says what it is.
  (cond ((memq name (kind "a world"))
         (list (simple-format #f "For example: (enter! '~a)" name)
               "See also: worlds, enter!, (help world)"))
        ((memq name (kind "a type of tether"))
         (list (simple-format #f "For example: (tether (type ~a) (from 0 0 0) (length 50))" name) "See also: tether-types"))
        ((memq name (kind "a type of vehicle"))
         (list (simple-format #f "For example: (rov (type ~a) (at 0 0 -5))" name) "See also: vehicle-types"))
        (else '())))

(define (lesson-lines name)
  (if (memq name (kind "a lesson"))
      (list (simple-format #f "~a: a lesson." name)
            (string-append "  " (sentence-of-lesson name))
            (simple-format #f "  for example, in a shell: bight lesson ~a" name)
            "See also: lessons, lesson")
      '()))

(define (word-lines word)
  "Return the lines that say what WORD, a symbol, string or keyword, is besides a verb, a topic or a part; the
empty list if nothing is known."
  (let* ((text (cond ((keyword? word) (symbol->string (keyword->symbol word)))
                     ((symbol? word) (symbol->string word))
                     (else word)))
         (bare (string-trim text #\:))
         (name (string->symbol (if (string-prefix? "#:" text) (substring text 2) bare))))
    (paragraphs
     (list (use-lines name)
           (fields-lines name)
           (if (or (keyword? word) (string-prefix? "#:" text) (string-prefix? ":" text) (string-suffix? ":" text))
               (keyword-lines (symbol->keyword name))
               '())
           (if (string-prefix? "-" text) (option-lines text) '())
           (event-lines name)
           (unit-lines text)
           (lesson-lines name)))))
