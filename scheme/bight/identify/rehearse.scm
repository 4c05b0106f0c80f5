;;; (bight identify rehearse) --- a dive seen as cameras in a pool would see it: a measurement rehearsed.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(define-module (bight identify rehearse)
  #:use-module (bight core errors)
  #:use-module ((bight core programs) #:select (check-writable))
  #:use-module (bight core verb)
  #:use-module ((bight dive) #:select (this-dive))
  #:use-module (bight dive query)
  #:use-module ((bight dive story) #:select (catching-io))
  #:use-module ((bight dive task) #:select (every-seconds))
  #:use-module ((bight dive time) #:select (now))
  #:use-module (srfi srfi-1)
  #:use-module (srfi srfi-4)
  #:export (measure!))

(define-argument-type (marker-places value)
  "a list of places along the tether, in metres from the anchor"
  (if (and (pair? value) (list? value) (every (lambda (s) (and (real? s) (>= s 0))) value)) value refused))

(define (columns-of-marker k)
  (let ((name (string-append "m" (number->string k))))
    (map (lambda (axis) (string-append name axis)) '("_x" "_y" "_z"))))

(define (header n tension?)
  (string-join
   (append '("t" "anchor_x" "anchor_y" "anchor_z" "end_x" "end_y" "end_z" "out")
           (if tension? '("end_tension") '())
           (append-map columns-of-marker (iota n 1)))
   ","))

(define (row at noise tension? dice)
  (define out (tether-length))
  (define (seen s)
    ;; A marker that has been hauled in, or cut off, is not seen.
    (if (> s out)
        (make-list 3 +nan.0)
        (map (lambda (x) (+ x (* noise (random:normal dice)))) (f64vector->list (point-at s)))))
  (append (list (now)) (f64vector->list (point-at 0)) (f64vector->list (point-at out)) (list out)
          (if tension? (list (rov-tension)) '())
          (append-map seen at)))

(define (cell x)
  (if (nan? x) "nan" (number->string (exact->inexact x))))

(define (write-line file text mode)
  (catching-io 'measure! file
               (let ((port (open-file file mode)))
                 (display text port)
                 (newline port)
                 (close-port port))))

(define-verb (measure! (file string) #:key (at marker-places) (seconds positive 0.05) (noise non-negative 0.0)
                       (tension flag #f) (seed count 1))
  "Write to FILE, from now on and every SECONDS of the dive, what cameras in a pool would see of its tether: the ends,
the line that is out, and the markers AT these places in metres from the anchor, each coordinate with NOISE, a standard
deviation in metres drawn from SEED, `nan' while a marker is not out; with TENSION also the pull on the vehicle.  So a measurement is rehearsed before the
pool is hired: `identify' reads the file.  Return what `cancel!' takes."
  (unless at
    (bight-raise 'domain 'measure! "where the markers are, is not said: #:at '(METRES ...)"))
  (let* ((host (this-dive 'measure!)) (out (tether-length)) (beyond (find (lambda (s) (> s out)) at))
         (dice (seed->random-state seed)))
    (when beyond
      (bight-raise 'domain 'measure! "a marker is to be ~a m along a tether of ~a m" beyond out))
    (check-writable 'measure! file)
    (write-line file (header (length at) tension) "w")
    (let ((look (lambda ()
                  (when (eq? host (this-dive 'measure!)) ; a fork is not measured
                    (write-line file
                                (string-join (map cell (row at noise tension dice)) ",")
                                "a")))))
      (look)
      (every-seconds seconds look))))
