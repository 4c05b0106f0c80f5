;;; (bight telemetry rows) --- readings out of a table of named columns whose lines come one by one.
;;;
;;; The first line that is no remark names the columns.  A line without the numbers it should have is counted
;;; and passed over; an empty cell says nothing.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(define-module (bight telemetry rows)
  #:use-module (bight core columns)
  #:use-module (bight core errors)
  #:use-module (bight core record)
  #:use-module (bight core table)
  #:use-module (bight telemetry reading)
  #:use-module (ice-9 iconv)
  #:use-module (rnrs bytevectors)
  #:use-module (srfi srfi-1)
  #:export (make-rows rows? take-rows! end-rows!))

(define longest-line 16384)             ; bytes

(define-record <rows>
  (%make-rows file tally rest time count columns)
  rows?
  (file rows-file)                      ; its name, for errors
  (tally rows-tally)
  (rest rows-rest set-rows-rest!)       ; the beginning of a line, a string
  (time rows-time set-rows-time!)       ; the column of times, or #f before the names have come
  (count rows-count set-rows-count!)    ; how many columns a line has
  (columns rows-columns set-rows-columns!)) ; an alist of quantities and their columns

(define (make-rows file tally)
  "Return a table that comes from FILE line by line, and counts in TALLY what is wrong."
  (%make-rows file tally "" #f 0 '()))

(define teaching
  "its first line names the columns: t or time, with x, y and z or depth, or lat, lon and depth; further \
heading, pitch, roll, payout and tension, each with a unit behind the name if wanted, as in `tension_kN'")

(define told '(x y z lat lon heading pitch roll payout tension))

(define (read-names! rows line)
  (let* ((names (split-cells line)) (known (columns names)) (file (rows-file rows)))
    (set-rows-count! rows (length names))
    (set-rows-time! rows (first (named-columns 'follow file names '(t) teaching)))
    (set-rows-columns!
     rows (filter-map (lambda (quantity)
                        (and (any (lambda (c) (eq? quantity (column-quantity c))) known)
                             (cons quantity (first (named-columns 'follow file names (list quantity) teaching)))))
                      told))
    (unless (or (every (lambda (q) (assq q (rows-columns rows))) '(x y z))
                (every (lambda (q) (assq q (rows-columns rows))) '(lat lon z)))
      (bight-raise 'format 'follow "~a does not say where the vehicle is; ~a" file teaching))))

(define (cell-value cells column)
  ;; The number in COLUMN, #f for an empty cell, or `bad'.
  (let ((cell (list-ref cells (column-index column))))
    (if (string-null? cell) #f (or (cell-number column cell) 'bad))))

(define (grouped time values)
  ;; The readings of VALUES, an alist of quantities.
  (define (all names)
    (let ((found (map (lambda (name) (assq-ref values name)) names)))
      (and (every identity found) found)))
  (filter-map (lambda (quantity value) (and value (make-reading time quantity value)))
              '(heading pitch roll payout tension place position)
              (append (map (lambda (name) (assq-ref values name)) '(heading pitch roll payout tension))
                      (list (all '(lat lon z)) (all '(x y z))))))

(define (cell-values rows cells)
  ;; Two values: the time that CELLS tell, and an alist of quantities; #f and '() for a line that was cut.
  (if (< (length cells) (rows-count rows))
      (values #f '())
      (values (cell-value cells (rows-time rows))
              (map (lambda (entry) (cons (car entry) (cell-value cells (cdr entry)))) (rows-columns rows)))))

(define (row-readings rows line)
  (call-with-values (lambda () (cell-values rows (split-cells line)))
    (lambda (time values)
      (cond ((or (not (real? time)) (any (lambda (entry) (eq? 'bad (cdr entry))) values))
             (tally! (rows-tally rows) 'unreadable)
             '())
            (else
             (tally! (rows-tally rows) 'rows)
             (grouped time values))))))

(define (line-readings rows line)
  (cond ((or (string-null? (string-trim-both line)) (string-prefix? "#" line)) '())
        ((not (rows-time rows)) (read-names! rows line) '())
        ((> (string-length line) longest-line) (tally! (rows-tally rows) 'unreadable) '())
        (else (row-readings rows line))))

(define (cut-rest rows text)
  ;; A line without an end is not gathered for ever.
  (if (> (string-length text) longest-line)
      (substring text 0 (+ 1 longest-line))
      text))

(define (take-rows! rows bytes)
  "Return the readings of BYTES, more of the table ROWS."
  (let ((lines (string-split (string-append (rows-rest rows) (bytevector->string bytes "ISO-8859-1")) #\newline)))
    (set-rows-rest! rows (cut-rest rows (last lines)))
    (append-map (lambda (line) (line-readings rows line)) (drop-right lines 1))))

(define (end-rows! rows)
  "Return the readings of the last line of ROWS, which has no end."
  (let ((line (rows-rest rows)))
    (set-rows-rest! rows "")
    (line-readings rows line)))
