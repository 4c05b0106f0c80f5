;;; (bight identify unknown) --- what may be unknown of a line, and the numbers that stand for the unknown.
;;;
;;; An unknown has coordinates that a solver moves: a quantity that is positive is START exp(x), another is
;;; START + SCALE x.  All coordinates are thus of order one, and an interval of a positive quantity stays positive.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(define-module (bight identify unknown)
  #:use-module (bight core errors)
  #:use-module (bight core record)
  #:use-module (bight core schema)
  #:use-module (srfi srfi-1)
  #:export (unknown-names canonical-unknown
            coordinate?
            coordinate-name coordinate-what coordinate-which coordinate-log? coordinate-start coordinate-value
            coordinate-slope coordinate-unit
            coordinates-of))

(define-record <coordinate>
  (make-coordinate name what which log? start scale low high)
  coordinate?
  (name coordinate-name)                ; symbol, as it is told
  (what coordinate-what)                ; a field of tethers, length, set, current, clock or places
  (which coordinate-which)              ; set: (piece . component); tilt: (end . component); current, vertical: axis; clock: run; places: marker; else #f
  (log? coordinate-log?)
  (start coordinate-start)
  (scale coordinate-scale)
  (low coordinate-low)                  ; the least value
  (high coordinate-high))

(document
 (coordinate? "Return true if OBJECT is a coordinate of an unknown.")
 (coordinate-name "Return the name under which COORDINATE is told, a symbol.")
 (coordinate-what "Return what COORDINATE belongs to, a symbol.")
 (coordinate-which "Return of which axis, run or marker COORDINATE is, or #f.")
 (coordinate-log? "Return true if COORDINATE is a logarithm.")
 (coordinate-start "Return the value at which COORDINATE begins."))

;; (NAME START): fields of tethers that can be unknown, and where the search begins if nothing is known of one.
(define fields
  '((ea 1e4) (ei 1e-3) (diameter .005) (mass .05) (wet-weight .1) (cdn 1.2) (cdt .01) (ca 1.) (ba 1.)
    (bending-damping 1e-4) (gj 1e-3) (ei-stuck 1e-2) (slip-curvature .5) (friction .3)))

(define others '(length set tilt vertical current clock places))

(define aliases
  '((cn . cdn) (ct . cdt) (weight . wet-weight) (added-mass . ca) (axial-damping . ba) (damping . ba)
    (natural-curvature . set) (drum-set . set) (camera-tilt . vertical)
    (clock-offset . clock) (marker-places . places) (bending . ei) (torsion . gj) (mu . friction)))

(define unknown-names
  ;; The names of all that can be unknown, symbols.
  (append (map car fields) others))

(define (canonical-unknown proc name)
  "Return the name, a symbol, of the unknown that NAME, a symbol, means.  Raise a &bight-error from PROC."
  (cond ((assq-ref aliases name))
        ((memq name unknown-names) name)
        (else (unknown-name proc "a line" name (append unknown-names (map car aliases)) "unknown"))))

(define (bounded x low high) (max low (min high x)))

(define (coordinate-value coordinate x)
  "Return the value of COORDINATE at X."
  (let ((start (coordinate-start coordinate)) (scale (coordinate-scale coordinate)))
    (bounded (if (coordinate-log? coordinate)
                 (* start (exp (bounded x -30 30)))
                 (+ start (* scale x)))
             (coordinate-low coordinate) (coordinate-high coordinate))))

(define (coordinate-slope coordinate x)
  "Return by how much the value of COORDINATE changes with X there."
  (if (coordinate-log? coordinate) (coordinate-value coordinate x) (coordinate-scale coordinate)))

(define (coordinate-unit coordinate)
  "Return the unit of COORDINATE, a string."
  (case (coordinate-what coordinate)
    ((current) "m/s")
    ((set) "1/m")
    ((tilt vertical) "rad")
    ((clock) "s")
    ((places) "m")
    (else (field-unit (head-field 'tether (coordinate-what coordinate))))))

(define (field-coordinate name known)
  (let* ((field (head-field 'tether name))
         (given (assq-ref known name))
         (other (second (assq name fields)))
         (low (if (field-min field) (exact->inexact (field-min field)) -inf.0))
         (high (if (field-max field) (exact->inexact (field-max field)) +inf.0)))
    (if (eq? name 'wet-weight)
        (let ((start (if given (exact->inexact given) other)))
          (make-coordinate name name #f #f start (max 0.02 (* 0.3 (abs start))) low high))
        (make-coordinate name name #f #t
                         (exact->inexact (if (and given (> given 0) (< given +inf.0)) given other))
                         1. (max low 1e-12) high))))

(define (set-coordinates pieces)
  ;; Of each piece, the curvature toward the plane of 0 degrees and toward that of 90.
  (append-map (lambda (piece)
                (map (lambda (component)
                       (make-coordinate (string->symbol
                                         (if (= pieces 1)
                                             (simple-format #f "set-~a" (* 90 component))
                                             (simple-format #f "set-~a-~a" (+ piece 1) (* 90 component))))
                                        'set (cons piece component) #f 0. 1. -100. 100.))
                     '(0 1)))
              (iota pieces)))

(define (coordinates-of names known long runs places pieces)
  "Return the coordinates of NAMES, canonical names of unknowns.  KNOWN is an alist of fields from which a search
begins, LONG the line's length, RUNS how many runs there are, PLACES those of the markers along the line, m, PIECES of
how many parts of equal length a set is."
  (append-map
   (lambda (name)
     (case name
       ((length)
        (list (make-coordinate 'length 'length #f #t long 1. (* 0.5 long) (* 2 long))))
       ((set) (set-coordinates pieces))
       ((tilt) (map (lambda (name end component)
                      (make-coordinate name 'tilt (cons end component) #f 0. .05 -1. 1.))
                    '(tilt-anchor-0 tilt-anchor-90 tilt-end-0 tilt-end-90) '(0 0 1 1) '(0 1 0 1)))
       ((vertical)
        (map (lambda (axis label) (make-coordinate label 'vertical axis #f 0. .02 -.5 .5))
             '(0 1) '(vertical-east vertical-north)))
       ((current)
        (map (lambda (axis label) (make-coordinate label 'current axis #f 0. .1 -3. 3.))
             '(0 1) '(current-east current-north)))
       ((clock)
        (map (lambda (run)
               (make-coordinate (if (= runs 1) 'clock (string->symbol (simple-format #f "clock-~a" (+ run 1))))
                                'clock run #f 0. .05 -5. 5.))
             (iota runs)))
       ((places)
        (map (lambda (marker place)
               (make-coordinate (string->symbol (simple-format #f "place-~a" (+ marker 1))) 'places marker #f place
                                (* 0.005 long) 0. long))
             (iota (length places)) places))
       (else (list (field-coordinate name known)))))
   names))

