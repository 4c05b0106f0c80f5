;;; (bight core table) --- files of rows of numbers, with or without names for their columns.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(define-module (bight core table)
  #:use-module (bight core columns)
  #:use-module ((bight core decimal) #:select (text->number))
  #:use-module (bight core errors)
  #:use-module ((bight core missing) #:select (why-not))
  #:use-module (bight world earth)
  #:use-module (ice-9 rdelim)
  #:use-module (srfi srfi-1)
  #:use-module (srfi srfi-11)
  #:export (read-table
            table-numbers cell-number
            first-columns
            read-columns
            file-lines refuse-device))

(define separators (char-set #\, #\; #\space #\tab #\return))

(define (line-numbers line)
  ;; The numbers of LINE up to the first word that is none.
  (take-while real?
              (map (lambda (word) (or (text->number word 10) 'none))
                   (string-tokenize line (char-set-complement separators)))))

(define (remark? line)
  (string-prefix? "#" (string-trim line)))

(define (read-lines port)
  ;; The lines of PORT that are not blank, each with its number.
  (let loop ((number 1) (lines '()))
    (let ((line (read-line port)))
      (cond ((eof-object? line) (reverse! lines))
            ((string-null? (string-trim-both line separators)) (loop (+ number 1) lines))
            (else (loop (+ number 1) (acons number line lines)))))))

(define (refuse-device proc file)
  "Raise a &bight-error from PROC if FILE is a device: what has no end is no track."
  (let ((type (stat:type (stat file))))
    (unless (memq type '(regular fifo))
      (bight-raise 'io proc "cannot read ~s: it is a ~a" file type))))

(define (file-lines proc file)
  "Return the lines of FILE that are not blank, (NUMBER . TEXT).  Raise a &bight-error from PROC of kind io."
  (catch 'system-error
    (lambda ()
      (refuse-device proc file)
      (call-with-input-file file read-lines #:guess-encoding #t))
    (lambda args
      (bight-raise 'io proc "cannot read ~s: ~a" file (why-not file args)))))

(define (first-columns proc file n entry)
  "Return the first N numbers of ENTRY, a line of FILE with its number."
  (let ((numbers (line-numbers (cdr entry))))
    (if (>= (length numbers) n)
        (map exact->inexact (take numbers n))
        (bight-raise 'format proc "line ~a of ~a has ~a numbers where ~a are wanted"
                     (car entry) file (length numbers) n))))

(define (read-table proc file)
  "Return two values: the names of the columns of FILE, strings, or #f, and its rows, lines with their numbers.
Lines that begin with # and one line of column names are passed over.  Raise a &bight-error from PROC of kind
io or format."
  (let*-values (((remarks rest) (span (lambda (entry) (remark? (cdr entry))) (file-lines proc file)))
                ((named?) (and (pair? rest) (null? (line-numbers (cdar rest)))))
                ((rows) (remove (lambda (entry) (remark? (cdr entry))) (if named? (cdr rest) rest))))
    (when (null? rows)
      (bight-raise 'format proc "~a has no rows of numbers" file))
    (let ((names (if named? (cdar rest) (naming-remark remarks (cdar rows)))))
      (values (and names (split-cells names)) rows))))

(define (naming-remark remarks row)
  ;; The last of REMARKS without its sign if it names the columns of ROW, else #f.
  (let ((line (and (pair? remarks)
                   (string-trim (cdr (last remarks)) (char-set-adjoin char-set:blank #\#)))))
    (and line (header? (split-cells line) (length (split-cells row))) line)))

(define (read-columns proc file n)
  "Return the first N numbers of every line of FILE, a list of lists, whatever names they have.  Lines that
begin with # and one line of column names are passed over; commas, semicolons and blanks part the columns.
Raise a &bight-error from PROC of kind io or format."
  (let-values (((names rows) (read-table proc file)))
    (map (lambda (entry) (first-columns proc file n entry)) rows)))


(define (cell-number column cell)
  "Return what CELL, a string, says in COLUMN, a number; #f if it says none.  A time may be a date."
  (let ((number (text->number cell 10)))
    (cond ((real? number) (exact->inexact (* number (column-factor column))))
          ((eq? 't (column-quantity column)) (parse-instant cell))
          (else #f))))

(define (table-numbers proc file rows columns)
  "Return what ROWS of FILE, lines with their numbers, say in COLUMNS: a list of lists of numbers, in metres,
seconds and metres a second; times that are dates are seconds since 1970.  Raise a &bight-error from PROC
where a cell holds no number."
  (define (value entry cells column)
    (let ((index (column-index column)))
      (or (and (< index (length cells)) (cell-number column (list-ref cells index)))
          (bight-raise 'format proc "line ~a of ~a has no number in column ~a" (car entry) file (+ 1 index)))))
  (map (lambda (entry)
         (let ((cells (split-cells (cdr entry))))
           (map (lambda (column) (value entry cells column)) columns)))
       rows))
