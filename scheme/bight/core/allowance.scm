;;; (bight core allowance) --- what each field allows: in words, and as a check of values.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(define-module (bight core allowance)
  #:use-module (bight core argument)
  #:use-module (bight core errors)
  #:use-module (bight core schema)
  #:use-module (bight world current)
  #:use-module (bight world earth)
  #:use-module (bight world shape)
  #:use-module (bight world waves)
  #:use-module (srfi srfi-1)
  #:use-module (srfi srfi-4)
  #:export (field-allowance
            field-range
            field-default-string
            value->string
            check-field))


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
    ((point) (if (bound (field-min field))
                 (string-append "three numbers " (bounds field))
                 "a point, as X Y Z in metres or one list, vector or (vec x y z)"))
    ((points) (argument-type-sentence type:points))
    ((end) "a point X Y Z in metres, or the name of a part")
    ((word) (string-append "one of " (alternatives->string (field-words field))))
    ((current) "a current: SPEED TOWARD, still, or (profile ...), (turning ...), (power ...), (tide ...), (grid FILE), (from FILE)")
    ((waves) "none, (airy ...) or (jonswap ...)")
    ((name) "a name, one word")
    ((type) "the name of a type")
    ((track) (argument-type-sentence type:rows-in-time))
    ((mesh) (argument-type-sentence type:file-name))
    ((origin) "LATITUDE LONGITUDE, north and east positive")
    ((text) "a text in double quotes")
    ((grid) "a file name, or PROCEDURE (from X Y) (to X Y) (spacing M)")
    (else "a value")))

(define (field-range field)
  "Return what FIELD allows, as in \"a number above 0 (m)\"."
  (if (and (eq? 'number (field-kind field)) (not (string-null? (field-unit field))))
      (string-append (field-allowance field) " (" (field-unit field) ")")
      (field-allowance field)))

(define (canonical-special field value)
  (let ((entry (and (number? value)
                    (find (lambda (entry) (eqv? (exact->inexact value) (cdr entry)))
                          (field-specials field)))))
    (and entry (car entry))))

(define rows-shown 4)

(define (rows->string rows)
  ;; "(1 2 3) (4 5 6)"; of a track, no heading where there is none.
  (define (row->string row)
    (string-append "(" (string-join (map tidy->string (remove nan? row))) ")"))
  (if (<= (length rows) rows-shown)
      (string-join (map row->string rows))
      (simple-format #f "~a rows" (length rows))))

(define (value->string field value)
  "Return the canonical VALUE of FIELD as a person would write it."
  (cond ((reference? value) (symbol->string (reference-name value)))
        ((part-type? value) (symbol->string (part-type-name value)))
        ((canonical-special field value) => symbol->string)
        ((eq? 'current (field-kind field)) (if (pair? value) (current->string value) (brief value)))
        ((eq? 'waves (field-kind field)) (if (pair? value) (waves->string value) (brief value)))
        ((number? value) (tidy->string value))
        ((eq? 'grid (field-kind field)) (grid->string value))
        ((string? value) value)
        ((memq (field-kind field) '(points track)) (rows->string (array->list value)))
        ((eq? #t value) "#t")
        ((not value) "#f")
        ((eq? 'origin (field-kind field)) (string-join (map tidy->string value)))
        ((array? value) (string-join (map tidy->string (array->list value))))
        (else (brief value))))

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

;; A truth value is a word, too: #t yes, #f no or none.
(define (truth->word value words)
  (cond ((eq? #t value) 'yes)
        (value value)
        ((memq 'none words) 'none)
        (else 'no)))

(define (number-or-special field value)
  (let ((special (assq (truth->word value (map car (field-specials field)))
                       (field-specials field))))
    (if special
        (cdr special)
        (in-bounds type:number field value))))

(define (plain-point value)
  (if (accepts? type:point value)
      (check-argument #f 'point type:point value)
      refused))

(define (point-value field value)
  (let ((point (plain-point (if (reference? value) (reference-value value) value))))
    (if (or (eq? point refused)
            (every (lambda (x) (in-range? field x)) (f64vector->list point)))
        point
        refused)))

(define (end-value value)
  (if (or (symbol? value) (reference? value)) value (plain-point value)))

(define (word-value field value)
  (let ((word (truth->word value (field-words field))))
    (if (memq word (field-words field)) word refused)))

(define (accepted type value)
  (if (accepts? type value) (check-argument #f 'value type value) refused))

(define (coerce proc head field value)
  (case (field-kind field)
    ((number) (number-or-special field value))
    ((count) (in-bounds type:count field value))
    ((flag) (accepted type:flag value))
    ((point) (point-value field value))
    ((points) (accepted type:points value))
    ((end) (end-value value))
    ((word) (word-value field value))
    ((current) (parse-current proc value))
    ((waves) (parse-waves proc value))
    ((track) (accepted type:rows-in-time value))
    ((mesh) (accepted type:file-name value))
    ((grid) (parse-grid proc value))
    ((origin) (parse-origin proc value))
    ((text) (if (and (string? value) (< 0 (string-length value) 100)) value refused))
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
