;;; (bight world earth) --- latitudes, longitudes and dates of day: where a world is on the earth, and when.
;;;
;;; The local metres of a world are those of the transverse Mercator projection about its origin: WGS 84,
;;; scale 1 at the origin.  Here is the series of L. Kruger (1912) as C. F. F. Karney gives it in "Transverse
;;; Mercator with an accuracy of a few nanometers" (J. Geodesy 85, 2011), to the fourth order in the
;;; flattening: a micrometre.  The geographic reader projects by PROJ; a test holds the two together.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(define-module (bight world earth)
  #:use-module ((bight core decimal) #:select (text->number))
  #:use-module (bight core errors)
  #:use-module (srfi srfi-1)
  ;; A tenth of what a start costs, and few worlds have a date.
  #:autoload (srfi srfi-19) (string->date date->string date->time-utc time-utc->date
                             make-time time-second time-utc)
  #:export (parse-origin
            degrees-pair
            origin-of-parts
            degrees->local
            parse-instant
            instant->string))


;;; Places.

(define (within? low value high)
  (and (real? value) (<= low value high)))

(define (degrees-pair value)
  "Return (LATITUDE LONGITUDE), inexact, if VALUE is a list of the two in degrees, else #f."
  (and (list? value) (= 2 (length value))
       (within? -89 (first value) 89) (within? -180 (second value) 360)
       (map exact->inexact value)))

(define (parse-origin proc value)
  "Return VALUE, a latitude and a longitude, canonical.  Raise a &bight-error from PROC unless it is that."
  (or (degrees-pair value)
      (bight-raise 'domain proc "a place on the earth is LATITUDE LONGITUDE in degrees, north and east positive, \
from -89 to 89 and from -180 to 360, not ~s" value)))

(define (origin-of-parts proc parts)
  "Return the origin (LATITUDE LONGITUDE) of the world of PARTS, alists of fields, or #f.  Raise a &bight-error
from PROC if two of them differ."
  (let ((origins (delete-duplicates (filter-map (lambda (fields) (assq-ref fields 'origin)) parts))))
    (when (> (length origins) 1)
      (bight-raise 'def proc "a world has one origin, not ~s and ~s" (first origins) (second origins)))
    (and (pair? origins) (car origins))))

(define degree (/ (acos -1) 180))
(define semi-major 6378137.)
(define flattening (/ 298.257223563))
(define n (/ flattening (- 2 flattening)))
(define e (sqrt (* flattening (- 2 flattening))))

(define (polynomial coefficients)
  ;; Of n, from its first power on.
  (* n (fold-right (lambda (c rest) (+ c (* n rest))) 0 coefficients)))

(define rectifying-radius
  (* (/ semi-major (+ 1 n)) (+ 1 (/ (expt n 2) 4) (/ (expt n 4) 64))))

(define alphas
  (map polynomial '((1/2 -2/3 5/16 41/180)
                    (0 13/48 -3/5 557/1440)
                    (0 0 61/240 -103/140)
                    (0 0 0 49561/161280))))

(define (arc-tanh x)
  (/ (log (/ (+ 1 x) (- 1 x))) 2))

(define (arc-sinh x)
  (let ((y (abs x)))
    (* (if (< x 0) -1 1) (log (+ y (sqrt (+ 1 (* y y))))))))

(define (projected latitude longitude)
  ;; (EAST . NORTH), m, of a place in degrees, its longitude from the middle: from -90 to 90.
  (let* ((phi (* degree latitude)) (lambda* (* degree longitude))
         (s (sin phi))
         (t (sinh (- (arc-tanh s) (* e (arc-tanh (* e s))))))
         (xi (atan t (cos lambda*)))
         (eta (arc-sinh (/ (sin lambda*) (sqrt (+ (* t t) (expt (cos lambda*) 2)))))))
    (define (series term start)
      (fold (lambda (alpha j sum) (+ sum (* alpha (term (* 2 j xi) (* 2 j eta)))))
            start alphas (iota (length alphas) 1)))
    (cons (* rectifying-radius (series (lambda (a b) (* (cos a) (sinh b))) eta))
          (* rectifying-radius (series (lambda (a b) (* (sin a) (cosh b))) xi)))))

(define (from-middle longitude middle)
  ;; Degrees of LONGITUDE east of MIDDLE, from -180 to 180.
  (let ((d (- longitude middle)))
    (- d (* 360 (round (/ d 360))))))

(define (degrees->local origin latitude longitude)
  "Return (X . Y), metres east and north of ORIGIN, (LATITUDE LONGITUDE), of a place within 80 degrees of
longitude from there; #f farther."
  (let ((east (from-middle longitude (second origin))))
    (and (< (abs east) 80) (<= (abs latitude) 89.9)
         (let ((p (projected latitude east)) (o (projected (first origin) 0.)))
           (cons (car p) (- (cdr p) (cdr o)))))))


;;; Instants: seconds since 1970-01-01T00:00Z.

(define formats
  ;; srfi-19's words, the longest first.
  '("~Y-~m-~dT~H:~M:~S" "~Y-~m-~dT~H:~M" "~Y-~m-~d"))

(define (offset-of text)
  ;; Two values: TEXT without what says how far its clock is from UTC, and that, s; none: UTC.
  (let ((found (clock-offset text)))
    (if found
        (values (car found) (cdr found))
        (values text 0))))

(define (clock-offset text)
  ;; (TEXT . SECONDS) if it does, else #f.
  (let ((k (string-length text)))
    (cond ((string-suffix? "Z" text) (cons (substring text 0 (- k 1)) 0))
          ((and (> k 16) (memv (string-ref text (- k 6)) '(#\+ #\-)) (char=? #\: (string-ref text (- k 3))))
           (let ((hours (text->number (substring text (- k 5) (- k 3))))
                 (minutes (text->number (substring text (- k 2)))))
             (and hours minutes
                  (cons (substring text 0 (- k 6))
                        (* (if (char=? #\- (string-ref text (- k 6))) -1 1)
                           (+ (* 3600 hours) (* 60 minutes)))))))
          (else #f))))

(define (without-fraction text)
  ;; Two values: TEXT without a fraction of a second, and that.
  (let ((dot (string-index text #\.)))
    (if dot
        (values (substring text 0 dot) (or (text->number (string-append "0" (substring text dot)) 10) 0))
        (values text 0))))

(define (read-date text)
  (any (lambda (format)
         (let* ((date (false-if-exception (string->date (string-append text " +0000")
                                                        (string-append format " ~z"))))
                (instant (and date (date->time-utc date))))
           (and date
                ;; What is not a day, such as February 30, would be taken for another.
                (string=? text (date->string (time-utc->date instant 0) format))
                (time-second instant))))
       formats))

(define (parse-instant text)
  "Return the seconds since 1970-01-01T00:00Z of TEXT, such as 2025-03-01T06:00Z, 2025-03-01 06:00:30 or
2025-03-01T07:00+01:00; without a clock's offset it is UTC.  #f if it is no date."
  (let ((trimmed (string-trim-both text)))
    (call-with-values (lambda () (offset-of trimmed))
      (lambda (text offset)
        (call-with-values (lambda () (without-fraction text))
          (lambda (text fraction)
            (let ((seconds (and (<= 10 (string-length text) 19)
                                (read-date (string-map (lambda (c) (if (char=? c #\space) #\T c)) text)))))
              (and seconds (exact->inexact (- (+ seconds fraction) offset))))))))))

(define (instant->string seconds)
  "Return the instant SECONDS since 1970 as people write it."
  (date->string (time-utc->date (make-time time-utc 0 (inexact->exact (floor seconds))) 0) "~Y-~m-~dT~H:~M:~SZ"))
