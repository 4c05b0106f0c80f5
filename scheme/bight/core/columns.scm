;;; (bight core columns) --- which columns of a table are times, places and velocities, by their names.
;;;
;;; A name is words: whose place it is (`rov'), what it is (`x'), its unit (`m').  A name that is not of this
;;; kind is passed over; where a quantity that is wanted is missing, or there twice, nothing is guessed.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(define-module (bight core columns)
  #:use-module (bight core errors)
  #:use-module (bight core record)
  #:use-module (srfi srfi-1)
  #:export (split-cells header? name-words names-quantity? named-columns column columns column?
            column-quantity column-index column-factor))

(define-record <column>
  (make-column quantity plain? index factor)
  column?
  (quantity column-quantity)            ; t x y z lat lon speed direction, and what a log of a dive has besides
  (plain? column-plain?)                ; is it called just that
  (index column-index)                  ; from 0
  (factor column-factor))               ; of its numbers, to s, m up, degrees, m/s, N

(define quantities
  ;; (WORD QUANTITY FACTOR DIMENSION)
  '(("t" t 1 time) ("time" t 1 time) ("elapsed" t 1 time) ("sec" t 1 time) ("seconds" t 1 time)
    ("date" t 1 time) ("datetime" t 1 time) ("timestamp" t 1 time)
    ("x" x 1 length) ("east" x 1 length) ("easting" x 1 length)
    ("y" y 1 length) ("north" y 1 length) ("northing" y 1 length)
    ("z" z 1 length) ("up" z 1 length) ("depth" z -1 length) ("down" z -1 length)
    ("lat" lat 1 angle) ("latitude" lat 1 angle)
    ("lon" lon 1 angle) ("lng" lon 1 angle) ("long" lon 1 angle) ("longitude" lon 1 angle)
    ("speed" speed 1 speed) ("magnitude" speed 1 speed)
    ("direction" direction 1 angle) ("dir" direction 1 angle) ("toward" direction 1 angle)
    ("heading" heading 1 angle) ("yaw" heading 1 angle) ("pitch" pitch 1 angle) ("roll" roll 1 angle)
    ("payout" payout 1 length) ("tension" tension 1 force)))

(define units
  ;; (WORDS DIMENSION FACTOR); the longest come first.
  '((("m" "s" "1") speed 1) (("cm" "s" "1") speed 1/100)
    (("m" "s") speed 1) (("cm" "s") speed 1/100) (("mm" "s") speed 1/1000) (("mps") speed 1)
    (("kn") speed 1852/3600) (("kt") speed 1852/3600) (("knots") speed 1852/3600)
    (("deg") angle 1) (("degrees") angle 1)
    (("s") time 1) (("sec") time 1) (("seconds") time 1) (("ms") time 1/1000) (("min") time 60) (("minutes") time 60)
    (("h") time 3600) (("hours") time 3600) (("utc") time 1)
    (("m") length 1) (("metres") length 1) (("meters") length 1) (("cm") length 1/100) (("mm") length 1/1000)
    (("km") length 1000) (("ft") length 3048/10000) (("feet") length 3048/10000)
    (("n") force 1) (("newtons") force 1) (("kn") force 1000) (("kgf") force 980665/100000)
    (("lbf") force 4448222/1000000)))

(define owners '("rov" "auv" "vehicle" "body" "pos" "position" "p" "point" "local" "world" "nav" "usbl" "true"
                 "current" "water" "adcp" "bin" "tether" "winch"))

;; What a log of a dive has besides.
(define others
  '("alt" "altitude" "course"))

(define (separator line)
  (find (lambda (char) (string-index line char)) '(#\, #\; #\tab)))

(define (split-cells line)
  "Return the cells of LINE, strings: parted by commas, else semicolons, else tabs, else blanks."
  (let ((char (separator line)))
    (if char
        (map string-trim-both (string-split line char))
        (string-tokenize line))))

(define (words name)
  (string-tokenize (string-downcase name) char-set:letter+digit))

(define (ends-in? words tail)
  (and (> (length words) (length tail)) (equal? tail (take-right words (length tail)))))

(define (column-in words unit index)
  ;; The column called WORDS with UNIT at their end, or with none for #f; #f if none is called so.
  (let* ((words (if unit (drop-right words (length (first unit))) words))
         (known (and (pair? words) (assoc-ref quantities (last words)))))
    (and known
         (every (lambda (word) (member word owners)) (drop-right words 1))
         (or (not unit) (eq? (second unit) (third known)))
         (make-column (first known) (equal? words (list (symbol->string (first known)))) index
                      (* (second known) (if unit (third unit) 1))))))

(define (name-words name dimension)
  "Return two values: the words of NAME, of a column, without a unit of DIMENSION (time, length, angle, speed) at
their end, and by how much its numbers are multiplied to be in s, m, degrees or m/s."
  (let* ((all (words name))
         (unit (find (lambda (unit) (and (eq? dimension (second unit)) (ends-in? all (first unit)))) units)))
    (if unit
        (values (drop-right all (length (first unit))) (third unit))
        (values all 1))))

(define (column name index)
  "Return the column called NAME, the one of INDEX in its table, or #f: the name is none that is known."
  (let ((words (words name)))
    (or (any (lambda (unit) (and (ends-in? words (first unit)) (column-in words unit index))) units)
        (column-in words #f index))))

(define (columns names)
  "Return the columns that are known among those called NAMES."
  (filter-map column names (iota (length names))))

(define (other? name)
  (any (lambda (word) (member word others)) (words name)))

(define (header? names n)
  "Return #t if NAMES, of a line that may be a remark, are names of the N columns of a table."
  (and (= n (length names))
       (<= 2 (count (lambda (name) (or (column name 0) (other? name))) names))))

;;; An error quotes no word of a file that is not one of ours: the file may be another's secret.

(define (ours? name)
  (and (pair? (words name))
       (every (lambda (word)
                (or (assoc word quantities) (find (lambda (unit) (member word (car unit))) units)
                    (member word owners) (member word others)))
              (words name))))

(define (refuse proc file names found teaching)
  (let ((known (filter ours? names)))
    (bight-raise 'format proc "~a ~a~a; ~a"
                 file found
                 (if (null? known)
                     ""
                     (string-append " (of its columns these have a meaning here: "
                                    (string-join known ", ") ")"))
                 teaching)))

(define (names-quantity? names quantity)
  "Return true if one of NAMES, those of the columns of a file, is a name of QUANTITY."
  (find (lambda (c) (eq? quantity (column-quantity c))) (columns names)))

(define (choose proc file names quantity teaching)
  (let* ((all (filter (lambda (c) (eq? quantity (column-quantity c))) (columns names)))
         (plain (filter column-plain? all)))
    (cond ((= 1 (length all)) (car all))
          ((= 1 (length plain)) (car plain))
          ((pair? all)
           (refuse proc file names (simple-format #f "has ~a columns for ~a" (length all) quantity) teaching))
          (else (refuse proc file names (simple-format #f "has no column ~a" quantity) teaching)))))

(define (named-columns proc file names quantities teaching)
  "Return the columns of QUANTITIES, symbols, among NAMES, those of the columns of FILE.  Raise a &bight-error
from PROC of kind format, which ends in TEACHING, if one is missing or there are two."
  (map (lambda (quantity) (choose proc file names quantity teaching)) quantities))
