;;; (bight world track) --- measured tracks: files with columns t x y z, in that order or by their names, or with
;;; latitude and longitude; and logs of MAVLink.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(define-module (bight world track)
  #:use-module (bight core columns)
  #:use-module (bight core errors)
  #:use-module (bight core late)
  #:use-module (bight core table)
  #:use-module (bight core verb)
  #:use-module (bight world earth)
  #:use-module (srfi srfi-1)
  #:use-module (srfi srfi-4)
  #:use-module (srfi srfi-11)
  #:export (read-track
            type:track)
  #:re-export (read-columns))

(define-argument-type (track value)
  "a file name, or a list of rows (t x y z)"
  (if (or (string? value) (pair? value)) value refused))

(define teaching
  "a track has columns t, x, y and z or depth: seconds, metres east and north of the world's origin, and metres \
up or down, or with a unit behind the name, as in `depth_ft'; lat and lon take the place of x and y in a world \
that has an origin, and a time may be a date such as 2025-03-01T06:00:30Z")

(define (local-rows proc file rows origin)
  ;; ROWS (t lat lon z) as (t x y z) about ORIGIN.
  (map (lambda (row)
         (let ((place (degrees->local origin (second row) (third row))))
           (unless place
             (bight-raise 'format proc "~a has a row at latitude ~a, longitude ~a, which is far from the world's origin"
                          file (second row) (third row)))
           (list (first row) (car place) (cdr place) (fourth row))))
       rows))

(define (instants? rows)
  ;; Are the times of ROWS dates, seconds since 1970?
  (> (abs (car (first rows))) 1e8))

(define (from-first rows)
  ;; ROWS with their times from the first on.
  (let ((first-time (car (first rows))))
    (map (lambda (row) (cons (- (car row) first-time) (cdr row))) rows)))

(define (named-rows proc file names rows origin)
  (let* ((degrees? (and (not (names-quantity? names 'x)) (names-quantity? names 'lat)))
         (columns (named-columns proc file names (if degrees? '(t lat lon z) '(t x y z)) teaching)))
    (when (and degrees? (not origin))
      (bight-raise 'format proc "~a tells places in degrees, and the world has no origin: (origin LATITUDE LONGITUDE) of \
its sea or seabed; ~a" file teaching))
    (let ((numbers (table-numbers proc file rows columns)))
      (let ((rows (if degrees? (local-rows proc file numbers origin) numbers)))
        (if (instants? rows) (from-first rows) rows)))))

(define (read-track-file proc file origin)
  ;; Rows (t x y z): of the columns with these names; of the first four where none have names.
  (if (string-suffix-ci? ".tlog" file)  ; as (bight telemetry mavlink) has it, which is not loaded for others
      (tlog-rows proc file origin)
      (let-values (((names rows) (read-table proc file)))
        (if names
            (named-rows proc file names rows origin)
            (map (lambda (entry) (first-columns proc file 4 entry)) rows)))))

;;; Logs of MAVLink: few tracks are such logs, whose reader is loaded when one is.

(define (quantity reading) ((from (bight telemetry reading) reading-quantity) reading))

(define (telling-where readings origin)
  ;; Those of READINGS that say where the vehicle is: in degrees where the world of ORIGIN has a use for them.
  (let ((degrees? (and origin (find (lambda (r) (eq? 'place (quantity r))) readings))))
    (filter (lambda (r) (memq (quantity r) (if degrees? '(place) '(place position)))) readings)))

(define (positions readings origin tally)
  ;; Rows (t x y z) of READINGS about ORIGIN, each later than the one before it.
  (let ((sieve ((from (bight telemetry sieve) make-sieve) origin #f tally)))
    (define (row reading)
      (cons ((from (bight telemetry reading) reading-time) reading)
            ((from (bight telemetry reading) reading-value) reading)))
    (fold-right (lambda (row rows) (if (and (pair? rows) (>= (car row) (caar rows))) rows (cons row rows)))
                '()
                (filter-map (lambda (reading)
                              (and=> ((from (bight telemetry sieve) sift!) sieve reading) row))
                            (telling-where readings origin)))))

(define (tlog-rows proc file origin)
  (let* ((tally ((from (bight telemetry reading) make-tally)))
         (rows (positions ((from (bight telemetry mavlink) tlog-readings) proc file tally) origin tally)))
    (cond ((pair? rows) rows)
          ((> ((from (bight telemetry reading) tally-of) tally 'homeless) 0)
           (bight-raise 'format proc "~a tells places in degrees, and the world has no origin: (origin LATITUDE \
LONGITUDE) of its sea or seabed" file))
          (else (bight-raise 'format proc "~a has no frame of MAVLink that says where the vehicle is" file)))))

(define (track-row proc row)
  (let ((row (if (array? row) (array->list row) row)))
    (if (and (list? row) (= 4 (length row)) (every (lambda (v) (accepts? type:number v)) row))
        row
        (bight-raise 'format proc "a row of a track is (t x y z), not ~s" row))))

(define (list-rows proc rows)
  (if (list? rows)
      (map (lambda (row) (track-row proc row)) rows)
      (bight-raise 'format proc "a track is a list of rows (t x y z)")))

(define* (read-track proc track #:optional origin)
  "Return the rows of TRACK, a file name or a list of rows (t x y z), as one f64vector.  ORIGIN, (LATITUDE
LONGITUDE) or #f, is the world's.  Raise a &bight-error from PROC of kind io or format."
  (let ((rows (if (string? track) (read-track-file proc track origin) (list-rows proc track))))
    (if (< (length rows) 2)
        (bight-raise 'format proc "a track has at least two rows")
        (list->f64vector (concatenate rows)))))
