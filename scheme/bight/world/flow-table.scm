;;; (bight world flow-table) --- a current that was measured: the table of an ADCP, a row for each time and depth.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(define-module (bight world flow-table)
  #:use-module (bight core columns)
  #:use-module (bight core errors)
  #:use-module (bight core table)
  #:use-module (bight world earth)
  #:use-module (srfi srfi-1)
  #:use-module (srfi srfi-4)
  #:use-module (srfi srfi-11)
  #:export (read-flow-table))

(define teaching
  "a current has columns time, depth or z, speed and direction: seconds or dates, metres, metres a second and the \
bearing in degrees to which the water goes, or with a unit behind the name, as in `speed (cm/s)'")

(define degree (/ (acos -1) 180))

(define (check-start proc file start rows)
  ;; START lies among the times of ROWS.
  (let ((times (map first rows)))
    (unless (<= (apply min times) start (apply max times))
      (bight-raise 'format proc "~a has no current at ~a: its times are ~a to ~a" file
                   (instant->string start) (instant->string (apply min times)) (instant->string (apply max times))))))

(define (velocity-row start row)
  ;; x y z t u v w of ROW, (time z speed direction).
  (let ((speed (third row)) (bearing (* degree (fourth row))))
    (list 0. 0. (second row) (- (first row) start) (* speed (sin bearing)) (* speed (cos bearing)) 0.)))

(define (read-flow-table proc file start)
  "Return the rows x y z t u v w, one f64vector, of the current in FILE, a table with columns time, depth, speed
and direction.  Time 0 is START, in seconds since 1970, or the first of the file for #f.  Raise a &bight-error
from PROC of kind io or format."
  (let-values (((names lines) (read-table proc file)))
    (unless names
      (bight-raise 'format proc "~a does not name its columns; ~a" file teaching))
    (let* ((columns (named-columns proc file names '(t z speed direction) teaching))
           (rows (table-numbers proc file lines columns)))
      (when start
        (check-start proc file start rows))
      (let ((start (or start (apply min (map first rows)))))
        (list->f64vector (append-map (lambda (row) (velocity-row start row)) rows))))))
