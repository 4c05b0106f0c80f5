;;; (bight track) --- measured tracks: files with columns t x y z.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(define-module (bight track)
  #:use-module (bight errors)
  #:use-module (bight verb)
  #:use-module (ice-9 rdelim)
  #:use-module (srfi srfi-1)
  #:use-module (srfi srfi-4)
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

(define (data-line? line)
  (not (or (string-null? (string-trim-both line separators))
           (string-prefix? "#" (string-trim line)))))

(define (read-lines port)
  (let loop ((number 1) (lines '()))
    (let ((line (read-line port)))
      (cond ((eof-object? line) (reverse! lines))
            ((data-line? line) (loop (+ number 1) (acons number line lines)))
            (else (loop (+ number 1) lines))))))

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

(define (read-columns proc file n)
  "Return the first N numbers of every line of FILE, a list of lists.  Lines that begin with # and one
line of column names are passed over; commas, semicolons and blanks part the columns.  Raise a
&bight-error from PROC of kind io or format."
  (let* ((lines (open-lines proc file))
         (rows (if (and (pair? lines) (null? (line-numbers (cdar lines)))) (cdr lines) lines)))
    (if (null? rows)
        (bight-raise 'format proc "~a has no rows of numbers" file)
        (map (lambda (entry) (first-columns proc file n entry)) rows))))

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
  (let ((rows (if (string? track) (read-columns proc track 4) (list-rows proc track))))
    (if (< (length rows) 2)
        (bight-raise 'format proc "a track has at least two rows")
        (list->f64vector (concatenate rows)))))
