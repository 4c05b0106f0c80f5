;;; (bight columns) --- which columns of a table are t, x, y and z, by their names.
;;;
;;; A name is words: whose place it is (`rov'), what it is (`x'), its unit (`m').  What is neither of these
;;; four nor known to be something else is passed over; where one of the four is missing, or there twice,
;;; nothing is guessed.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(define-module (bight columns)
  #:use-module (bight errors)
  #:use-module (bight record)
  #:use-module (srfi srfi-1)
  #:export (split-cells header? named-columns column? column-index column-factor))

(define-record <column>
  (make-column quantity plain? index factor)
  column?
  (quantity column-quantity)            ; t, x, y or z
  (plain? column-plain?)                ; is it called just that
  (index column-index)                  ; from 0
  (factor column-factor))               ; of its numbers, to seconds and metres up

(define quantities
  '(("t" t 1) ("time" t 1) ("elapsed" t 1) ("sec" t 1) ("seconds" t 1)
    ("x" x 1) ("east" x 1) ("easting" x 1)
    ("y" y 1) ("north" y 1) ("northing" y 1)
    ("z" z 1) ("up" z 1) ("depth" z -1) ("down" z -1)))

(define units
  '(("s" time 1) ("sec" time 1) ("seconds" time 1) ("ms" time 1/1000) ("min" time 60) ("minutes" time 60)
    ("h" time 3600) ("hours" time 3600)
    ("m" length 1) ("metres" length 1) ("meters" length 1) ("cm" length 1/100) ("mm" length 1/1000)
    ("km" length 1000) ("ft" length 3048/10000) ("feet" length 3048/10000)))

(define owners '("rov" "auv" "vehicle" "body" "pos" "position" "p" "point" "local" "world" "nav" "usbl" "true"))

;; What a log of a dive has besides; none of it is a place in metres.
(define others
  '("lat" "latitude" "lon" "lng" "long" "longitude" "alt" "altitude" "heading" "yaw" "pitch" "roll" "speed"
    "course" "tension"))

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

(define (without-unit words)
  ;; The words but for a unit at their end, and that unit.
  (let ((unit (and (pair? words) (pair? (cdr words)) (assoc-ref units (last words)))))
    (values (if unit (drop-right words 1) words) unit)))

(define (column name index)
  ;; The column called NAME, or #f: it is none of the four.
  (call-with-values (lambda () (without-unit (words name)))
    (lambda (words unit)
      (let ((known (and (pair? words) (assoc-ref quantities (last words)))))
        (and known
             (every (lambda (word) (member word owners)) (drop-right words 1))
             (or (not unit) (eq? (first unit) (if (eq? 't (first known)) 'time 'length)))
             (make-column (first known) (equal? words (list (symbol->string (first known)))) index
                          (* (second known) (if unit (second unit) 1))))))))

(define (columns names)
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
                (or (assoc word quantities) (assoc word units) (member word owners) (member word others)))
              (words name))))

(define (refuse proc file names found)
  (let ((known (filter ours? names)))
    (bight-raise 'format proc
                 "~a ~a~a; a track has columns t, x, y and z or depth: seconds, metres east and north of the world's origin, and metres up or down, or with a unit behind the name, as in `depth_ft'"
                 file found
                 (if (null? known)
                     ""
                     (string-append " (of its columns these have a meaning here: "
                                    (string-join known ", ") ")")))))

(define (degrees? name)
  (member (car (append (words name) '(""))) '("lat" "latitude" "lon" "lng" "long" "longitude")))

(define (choose proc file names quantity)
  (let* ((all (filter (lambda (c) (eq? quantity (column-quantity c))) (columns names)))
         (plain (filter column-plain? all)))
    (cond ((= 1 (length all)) (car all))
          ((= 1 (length plain)) (car plain))
          ((pair? all)
           (refuse proc file names (simple-format #f "has ~a columns for ~a" (length all) quantity)))
          ((any degrees? names)
           (refuse proc file names
                   (simple-format #f "tells places in degrees, and has no ~a" quantity)))
          (else (refuse proc file names (simple-format #f "has no column ~a" quantity))))))

(define (named-columns proc file names)
  "Return the columns t, x, y and z among NAMES, those of the columns of FILE.  Raise a &bight-error from
PROC of kind format if one is missing or there are two."
  (map (lambda (quantity) (choose proc file names quantity)) '(t x y z)))
