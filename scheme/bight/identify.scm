;;; (bight identify) --- the properties of a real line, found from what was measured of it.
;;;
;;; The ends of a line go where they were seen to go; what the line does then (places of markers, forces at its ends)
;;; is held against what was measured, and what is unknown of the line is moved until the two are as near as they
;;; get.  The second part of every run is held out: the line is flown through it without looking, and how far off it
;;; is there is the score that counts.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(define-module (bight identify)
  #:use-module (bight core clause)
  #:use-module (bight core errors)
  #:use-module (bight core schema)
  #:use-module (bight core verb)
  #:use-module (bight identify entries)
  #:use-module (bight identify fit)
  #:use-module (bight identify flight)
  #:use-module (bight identify found)
  #:use-module (bight identify measured)
  #:use-module (bight identify unknown)
  #:use-module ((bight world types) #:select (merge-fields))
  #:use-module (srfi srfi-1)
  #:use-module (srfi srfi-4)
  #:export (identify))

;;; What is asked.

(define-argument-type (run-files value)
  "the name of a CSV file, or a list of several"
  (cond ((string? value) (list value))
        ((and (pair? value) (list? value) (every string? value)) value)
        (else refused)))

(define-argument-type (unknowns value)
  "a list of names of what is unknown, as '(ei cdn)"
  (cond ((symbol? value) (list value))
        ((and (pair? value) (list? value) (every symbol? value)) value)
        (else refused)))

(define-argument-type (clauses value)
  "a list of fields of the tether that are known, as '((diameter 0.004) (mass 0.05))"
  (if (and (list? value) (every pair? value)) value refused))

(define-argument-type (places value)
  "a rising list of places along the line, in metres from the anchor, one for each marker"
  (if (and (list? value) (every (lambda (x) (and (real? x) (<= 0 x 1e5))) value)
           (or (null? value) (apply <= value)))
      (map exact->inexact value)
      refused))

(define-argument-type (share value)
  "a number from 0 to 0.9"
  (if (and (real? value) (<= 0 value 0.9)) (exact->inexact value) refused))

(define (known-fields type clauses)
  (let ((own (read-fields 'identify 'tether clauses)))
    (merge-fields own (if type (part-type-fields (find-part-type 'identify 'tether type)) '()))))

(define (same-markers runs)
  (let ((names (run-marker-names (first runs))))
    (for-each (lambda (run)
                (unless (equal? names (run-marker-names run))
                  (bight-raise 'format 'identify "~a has other markers than ~a: ~a, not ~a" (run-file run)
                               (run-file (first runs)) (string-join (run-marker-names run) " ")
                               (string-join names " "))))
              (cdr runs))
    names))

(define (longest-chords runs)
  (apply map max (map run-chords runs)))

(define (running-sum numbers)
  (let loop ((rest numbers) (sum 0.) (all '()))
    (if (null? rest) (reverse all) (loop (cdr rest) (+ sum (car rest)) (cons (+ sum (car rest)) all)))))

(define (line-length known runs chords)
  ;; As it is known; else what is out at first; else no shorter than the chords.
  (cond ((assq-ref known 'length))
        ((run-out (first runs)) => (lambda (out) (f64vector-ref out 0)))
        ((null? (cddr chords))
         (bight-raise 'def 'identify "how long the line is, is not said, and there are too few markers to tell: \
#:known '((length METRES))"))
        (else (apply + chords))))

(define (marker-places places names chords long)
  (let ((at (or places (drop-right (running-sum chords) 1))))
    (unless (= (length at) (length names))
      (bight-raise 'domain 'identify "there are ~a places for ~a markers (~a); those that stand for the ends have none"
                   (length at) (length names) (string-join names " ")))
    (let ((beyond (find (lambda (s) (> s (+ long 1e-6))) at)))
      (when (and beyond places)
        (bight-raise 'domain 'identify "a marker is ~a m from the anchor, and the line is ~a m long" beyond long)))
    (map (lambda (s) (min s long)) at)))

(define spans 10)                       ; of a run, when rows are held out all over

(define (rows-fitted run hold-out held)
  ;; A vector: is the row fitted?  Of each of the spans of RUN the last HOLD-OUT is not.
  (let* ((times (run-times run)) (whole (f64vector-ref times (- (run-rows run) 1)))
         (n (if (eq? held 'all-over) spans 1)))
    (list->vector
     (map (lambda (t)
            (let ((at (* n (/ t whole))))
              (or (zero? hold-out) (<= (- at (min (floor at) (- n 1))) (- 1 hold-out)))))
          (f64vector->list times)))))

(define (check-can-tell names runs setting floor)
  (define (need name ok? what)
    (when (and (memq name names) (not ok?))
      (bight-raise 'def 'identify "~a cannot be found: ~a" name what)))
  (need 'friction floor "there is no floor to rub on, #:floor HEIGHT")
  (need 'places (pair? (setting-places setting)) "there are no markers")
  (need 'tilt (setting-clamped? setting) "its ends are not clamped, #:clamped #t")
  (need 'length (not (run-out (first runs))) "the line that is out was measured")
  (define (told? name)
    (or (memq name names) (> (or (assq-ref (setting-known setting) name) 0) 0)))
  (define (set?) (or (memq 'set names) (assq 'set (setting-known setting))))
  (need 'set (told? 'ei) "it is a bend that stiffness holds, and `ei' is neither known nor sought")
  (need 'gj (and (told? 'ei) (or (set?) (setting-clamped? setting)))
        "a line twists between clamps, #:clamped #t, or by its set, and with an `ei' that is known or sought")
  (for-each (lambda (name)
              (need name (and (told? 'ei) (told? 'ei-stuck) (told? 'slip-curvature) (not (set?)))
                    "layers slip where `ei', `ei-stuck' and `slip-curvature' are known or sought, in a line without a set"))
            '(ei-stuck slip-curvature))
  (need 'ca (> (setting-density setting) 0) "there is no water"))

(define-verb (identify (runs run-files)
                       #:key (unknown unknowns '(cdn)) (type (or-false name)) (known clauses '())
                       (places (or-false places)) (clamped flag #f) (start (one-of rest moving) 'rest)
                       (hold-out share 0.5) (held (one-of last all-over) 'last)
                       (loss (one-of huber cauchy squares) 'huber)
                       (sigma (or-false string)) (density non-negative 1000.) (gravity positive 9.80665)
                       (floor (or-false number)) (intervals (at-least 4) 60) (set-pieces (at-least 1) 1) (step positive 0.01))
  "Find what is UNKNOWN of a line: ea, ei, diameter, mass, wet-weight, cdn, cdt, ca, ba, bending-damping, gj,
ei-stuck, slip-curvature, friction, length, set (natural curvature, toward two sides, of each of SET-PIECES parts of equal length), tilt (by which the line
leaves clamps beside what their markers tell), vertical (by how much what is up leans east and north in
the frame of the places), current, clock (how late the markers' clock is against the ends') or places (of the markers).  RUNS are CSV
files of what was measured: t; anchor_x ... and end_x ... of its ends; m1_x, m1_y, m1_z ... of markers from the
anchor on, in metres; end_tension or end_fx ... in newtons; out for line that is paid out.  Without columns for an
end, the outermost marker is one.

The tether is like TYPE but for the fields KNOWN, where a search also begins.  PLACES tells where the markers are
along it; left out, each is as far as the longest chords before it.  CLAMPED: the first two and last two markers are
held, and give the ends their directions.  START is rest, or moving: along the markers of the first row.  HOLD-OUT is
the share of each run that is not looked at, on which the line found is scored: the last of it, or by HELD all-over the
last of each tenth.  LOSS is huber, cauchy or
squares; SIGMA names the column that tells how sure each row is.  DENSITY, GRAVITY and the height of a flat FLOOR are
of the water; INTERVALS and STEP, in seconds, of the line that is flown.

Return an identification, which prints what was found with 90 % intervals, scores and warnings; see `identified',
`identified-type', `residuals-in-time'."
  (let* ((names (delete-duplicates (map (lambda (name) (canonical-unknown 'identify name)) unknown)))
         (fields (known-fields type known))
         (read (map (lambda (file) (read-run 'identify file #:clamped? clamped #:sigma sigma)) runs))
         (markers (same-markers read))
         (chords (longest-chords read))
         (long (exact->inexact (line-length fields read chords)))
         (at (marker-places places markers chords long))
         (setting (make-setting fields long at set-pieces clamped (eq? start 'moving) intervals step
                                (exact->inexact density) gravity floor)))
    (check-can-tell names read setting floor)
    (let* ((coordinates (coordinates-of names fields long (length read) at set-pieces))
           (problem (make-problem read setting coordinates
                                  (map (lambda (run) (rows-fitted run hold-out held)) read) loss))
           (fit (find-unknown problem))
           (all (map run-rows read)))
      (make-identification problem fit type runs
                           (fly-runs problem (make-f64vector (length coordinates) 0.) all)
                           (fly-runs problem (fit-x fit) all)))))
