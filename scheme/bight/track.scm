;;; (bight track) --- measured tracks: files with columns t x y z, in that order or by their names.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(define-module (bight track)
  #:use-module (bight columns)
  #:use-module (bight errors)
  #:use-module (bight verb)
  #:use-module (ice-9 rdelim)
  #:use-module (srfi srfi-1)
  #:use-module (srfi srfi-4)
  #:use-module (srfi srfi-11)
  #:export (read-track
            read-columns
            type:track))

(define-argument-type (track value)
  "a file name, or a list of rows (t x y z)"
  (if (or (string? value) (pair? value)) value refused))

(define separators (char-set #\, #\; #\space #\tab #\return))

(define (line-numbers line)
  ;; The numbers of LINE up to the first word that is none.
  (take-while real?
              (map (lambda (word) (or (string->number word 10) 'none))
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
  ;; What has no end is no track.
  (let ((type (stat:type (stat file))))
    (unless (memq type '(regular fifo))
      (bight-raise 'io proc "cannot read ~s: it is a ~a" file type))))

(define (open-lines proc file)
  (catch 'system-error
    (lambda ()
      (refuse-device proc file)
      (call-with-input-file file read-lines #:guess-encoding #t))
    (lambda args
      (bight-raise 'io proc "cannot read ~s: ~a" file (strerror (system-error-errno args))))))

(define (first-columns proc file n entry)
  (let ((numbers (line-numbers (cdr entry))))
    (if (>= (length numbers) n)
        (map exact->inexact (take numbers n))
        (bight-raise 'format proc "line ~a of ~a has ~a numbers where ~a are wanted"
                     (car entry) file (length numbers) n))))

(define (table-parts proc file)
  ;; What names the columns of FILE, a line or #f, and the rows behind it, numbered lines.
  (let*-values (((remarks rest) (span (lambda (entry) (remark? (cdr entry))) (open-lines proc file)))
                ((named?) (and (pair? rest) (null? (line-numbers (cdar rest)))))
                ((rows) (remove (lambda (entry) (remark? (cdr entry))) (if named? (cdr rest) rest))))
    (when (null? rows)
      (bight-raise 'format proc "~a has no rows of numbers" file))
    (values (if named? (cdar rest) (naming-remark remarks (cdar rows))) rows)))

(define (naming-remark remarks row)
  ;; The last of REMARKS without its sign if it names the columns of ROW, else #f.
  (let ((line (and (pair? remarks)
                   (string-trim (cdr (last remarks)) (char-set-adjoin char-set:blank #\#)))))
    (and line (header? (split-cells line) (length (split-cells row))) line)))

(define (read-columns proc file n)
  "Return the first N numbers of every line of FILE, a list of lists, whatever names they have.  Lines that
begin with # and one line of column names are passed over; commas, semicolons and blanks part the columns.
Raise a &bight-error from PROC of kind io or format."
  (let-values (((names rows) (table-parts proc file)))
    (map (lambda (entry) (first-columns proc file n entry)) rows)))

(define (column-value proc file entry cells column)
  (let* ((cell (and (< (column-index column) (length cells)) (list-ref cells (column-index column))))
         (number (and cell (string->number cell 10))))
    (if (real? number)
        (exact->inexact (* number (column-factor column)))
        (bight-raise 'format proc "line ~a of ~a has no number in column ~a" (car entry) file
                     (+ 1 (column-index column))))))

(define (read-track-file proc file)
  ;; Rows (t x y z): of the columns with these names; of the first four where none have names.
  (let-values (((names rows) (table-parts proc file)))
    (if names
        (let ((columns (named-columns proc file (split-cells names))))
          (map (lambda (entry)
                 (let ((cells (split-cells (cdr entry))))
                   (map (lambda (c) (column-value proc file entry cells c)) columns)))
               rows))
        (map (lambda (entry) (first-columns proc file 4 entry)) rows))))

(define (track-row proc row)
  (let ((row (if (array? row) (array->list row) row)))
    (if (and (list? row) (= 4 (length row)) (every (lambda (v) (accepts? type:number v)) row))
        row
        (bight-raise 'format proc "a row of a track is (t x y z), not ~s" row))))

(define (list-rows proc rows)
  (if (list? rows)
      (map (lambda (row) (track-row proc row)) rows)
      (bight-raise 'format proc "a track is a list of rows (t x y z)")))

(define (read-track proc track)
  "Return the rows of TRACK, a file name or a list of rows (t x y z), as one f64vector.  Raise a
&bight-error from PROC of kind io or format."
  (let ((rows (if (string? track) (read-track-file proc track) (list-rows proc track))))
    (if (< (length rows) 2)
        (bight-raise 'format proc "a track has at least two rows")
        (list->f64vector (concatenate rows)))))
