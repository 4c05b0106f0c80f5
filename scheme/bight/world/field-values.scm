;;; (bight world field-values) --- random values for any field of the schema, from the schema itself.
;;;
;;; What a field is drawn from follows from its kind, unit, range and default, so that a field that is
;;; added to the schema is drawn, too.  The tables below hold what no schema says: how large things
;;; usually are, and where in the water they may stand.  A kind of field that is unknown here is refused.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(define-module (bight world field-values)
  #:use-module (bight core errors)
  #:use-module (bight core schema)
  #:use-module (bight test generator)
  #:use-module (srfi srfi-1)
  #:export (field-clause
            field-value
            random-current
            random-waves
            any-place
            bearing))


;;; Places: a box of water 12 m wide; the ends of tethers lie mostly to the west of it.

(define (place x-from x-to)
  (made-of list (uniform x-from x-to) (uniform -8 8) (uniform -11 -1)))

(define in-the-way (place -4 8))
(define beside (place -10 -6))

(define any-place
  ;; Four in five beside all that is in the way, the others anywhere.
  (any-of beside beside beside beside in-the-way))

(define bearing (integer 0 359))


;;; Numbers.

;; The usual sizes of what is measured in a unit, where no default tells.
(define usual-of-unit
  '(("m" 1/100 3) ("m/s" 1/20 3) ("deg/s" 1 90) ("N" 1 500) ("N/m" 1/100 3) ("kg" 1/10 50)
    ("kg/m" 1/100 1) ("s" 1/100 5) ("N m2" 1/100000 1) ("m3" 1/1000 1/10) ("J/m" 100 1000000)))

;; The usual sizes of fields whose unit or default says too little.
(define usual-of-field
  '(((sea . depth) 15 60) ((sea . density) 950 1100) ((sea . gravity) 2 20)
    ((rov . mass) 5 100) ((rov . size) 1/5 1) ((rov . inertia) 1/10 10)
    ((box . size) 1/10 4) ((sphere . radius) 1/20 2) ((mesh . scale) 1/5 2)
    ((cylinder . radius) 1/200 1) ((capsule . radius) 1/200 1)
    ((tether . length) 17 40) ((tether . drum) 40 400) ((tether . diameter) 1/500 1/25)
    ((tether . nodes) 2 48) ((tether . breaking-load) 50 5000) ((tether . rejoin-angle) 90 360)
    ((clump . at) 1 15) ((float . at) 1 15) ((clump . mass) 1/10 5) ((float . buoyancy) 1 30)
    ((set . at) 1 15) ((set . span) 1 40) ((set . curvature) 1/1000 1/50)
    ((thruster . ahead) 5 60) ((thruster . dead) 1/100 1/2)))

;; What a computer must be spared, not the engine: so many nodes are slow, and nobody asks for a longer line.
(define dearest '(((tether . nodes) . 500) ((tether . length) . 3000)))

(define (at-least field)
  ;; The least number that FIELD allows, a little above its bound where that is excluded.
  (let ((low (or (field-min field) -100)))
    (if (field-above-min? field) (+ low 1/1000) (inexact->exact low))))

(define (at-most head field)
  (inexact->exact (or (assoc-ref dearest (cons head (field-name field))) (field-max field) 100)))

(define (usual-range head field)
  ;; The lower and the upper end of what FIELD usually is, both above 0.
  (let ((default (field-default field)))
    (cond ((assoc-ref usual-of-field (cons head (field-name field))))
          ((and (number? default) (positive? default) (finite? default))
           (list (/ (inexact->exact default) 4) (* 4 (inexact->exact default))))
          ((assoc-ref usual-of-unit (field-unit field)))
          (else '(1/20 1)))))

(define (usual-number head field)
  (let ((low (at-least field)) (high (at-most head field)))
    (if (equal? "deg" (field-unit field))
        (uniform (max low -180) (min high 360))
        (let* ((usual (usual-range head field))
               (from (max low (first usual))) (to (min high (second usual)))
               (sizes (magnitudes from (max from to))))
          (if (negative? low)
              (any-of sizes (one-of 0) (made-of - sizes))
              sizes)))))

(define (extreme-numbers head field)
  (delete-duplicates
   (list (exact->inexact (at-most head field)) (exact->inexact (at-least field)))))

(define (number-value head field wild?)
  (let ((usual (usual-number head field))
        (specials (map car (field-specials field))))
    (apply any-of
           (append (make-list (if wild? 9 3) usual)
                   (if (null? specials) '() (list (apply one-of specials)))
                   (if wild? (list (apply one-of (extreme-numbers head field))) '())))))

(define (whole generator)
  (made-of (lambda (x) (inexact->exact (round x))) generator))

(define (unquoted expression)
  (if (and (pair? expression) (eq? 'quote (car expression))) (cadr expression) expression))

(define (count-value head field wild?)
  (whole (number-value head field wild?)))


;;; Three numbers, and rows of them.

(define (small-vector head field wild?)
  ;; Three numbers within the range of FIELD.
  (let ((x (if (zero? (or (field-min field) -1))
               (number-value head field wild?)
               (uniform -1 1))))
    (made-of list x x x)))

(define axes
  ;; The ways a thruster may push.
  (apply one-of '((0 1 0) (1 0 0) (0 0 1) (0.7 0.7 0) (-0.7 0.7 0) (0 0.6 0.8))))

(define (point-value head field wild?)
  (let ((name (field-name field)))
    (cond ((eq? name 'along) (made-of unquoted axes))
          ((and (memq name '(at from to)) (eq? head 'rov)) any-place)
          ((and (memq name '(at from to)) (not (inner-head? head))) in-the-way)
          (else (small-vector head field wild?)))))

(define corner (made-of list (uniform -1 1) (uniform -1 1) (uniform -1 1)))

(define (points-value head field wild?)
  ;; Corners of a convex body, points to be laid through, or two rows of three.
  (case (field-name field)
    ((points) (list-of corner #:least 4 #:most 9 #:make identity))
    ((via) (list-of beside #:least 1 #:most 2 #:make identity))
    (else (made-of list
                   (small-vector head field wild?) (small-vector head field wild?)))))

(define track-value
  ;; From 0 s on, a place every two seconds.
  (list-of (any-of in-the-way (made-of append in-the-way (made-of list bearing)))
           #:least 1 #:most 4
           #:make (lambda (places)
                    (map (lambda (i place) (cons (* 2 i) place)) (iota (length places)) places))))


;;; The sea.

(define speed (any-of (uniform 0 1) (uniform 0 1) (uniform 1 3)))

(define random-current
  ;; One of each form that a world may write, but for a procedure.
  (any-of
   (one-of ''still)
   (made-of list speed bearing)
   (list-of (made-of list (integer -60 0) speed bearing) #:least 1 #:most 4
            #:make (lambda (rows) `((profile ,@rows))))
   (made-of (lambda (s b d) `((turning (speed ,s) (toward ,b) (degrees-per-metre ,d))))
            speed bearing (uniform -3 3))
   (made-of (lambda (s b e) `((power ,s ,b (exponent ,e)))) speed bearing (uniform 0 1))
   (made-of (lambda (s b p) `((tide (speed ,s) (toward ,b) (period ,p))))
            speed bearing (magnitudes 10 50000))
   (made-of (lambda (name) `((grid (current-file ,name)))) (one-of 'shear 'eddy))))

(define random-waves
  (any-of
   (one-of ''none)
   (made-of (lambda (h p b) `((airy (height ,h) (period ,p) (toward ,b))))
            (uniform 0 3) (uniform 3 12) bearing)
   (made-of (lambda (h p b n s)
              `((jonswap (height ,h) (period ,p) (toward ,b) (components ,n) (seed ,s))))
            (uniform 0 3) (uniform 3 12) bearing (integer 2 24) (integer 1 99))))


;;; By kind.

(define (as-list expression)
  ;; What follows the name of a field: the items of a list, or one thing.
  (cond ((and (pair? expression) (eq? 'quote (car expression))) (list (cadr expression)))
        ((pair? expression) expression)
        (else (list expression))))

(define (one generator)
  (made-of (lambda (x) (list (unquoted x))) generator))

(define (words-value words)
  (one (apply one-of words)))

(define (field-value head field wild?)
  "Return a generator of what follows the name of FIELD in a clause of a part with HEAD, a list; with WILD?
among others of the least and the greatest that it allows.  Raise unsupported for a kind of field of which
no values are known."
  (case (field-kind field)
    ((number) (one (number-value head field wild?)))
    ((count) (one (count-value head field wild?)))
    ((flag) (one (one-of #f #t)))
    ((word) (words-value (field-words field)))
    ((point) (point-value head field wild?))
    ((points) (points-value head field wild?))
    ((end) (if (eq? 'to (field-name field))
               (one (integer 1 3))
               (any-of beside beside beside any-place (one (integer 1 3)))))
    ((current) (made-of as-list random-current))
    ((waves) (made-of as-list random-waves))
    ((type) (words-value (map part-type-name (part-types head))))
    ((track) track-value)
    ((mesh) (made-of (lambda (name) `((mesh-file ,name))) (one-of 'tetra 'sheet 'crate 'spikes)))
    ((grid) (made-of (lambda (name) `((heights-file ,name))) (one-of 'slope 'steps 'ridge 'holes)))
    (else (bight-raise 'unsupported 'field-value
                       "no random values are known for the field `~a' of ~a, of kind ~a"
                       (field-name field) (head-title head) (field-kind field)))))

(define (field-clause head field wild?)
  "Return a generator of clauses, (NAME VALUE ...), for FIELD of a part with HEAD; WILD? as `field-value'."
  (made-of (lambda (values) (cons (field-name field) values)) (field-value head field wild?)))
