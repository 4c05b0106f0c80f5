;;; (bight world shape) --- shapes of obstacles, from what a person writes to what the engine takes: rows of a
;;; track, height fields.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(define-module (bight world shape)
  #:use-module (bight core argument)
  #:use-module (bight core errors)
  #:use-module (srfi srfi-1)
  #:use-module (srfi srfi-4)
  #:export (type:rows-in-time
            type:file-name
            parse-grid
            grid-clause-names
            grid->string
            place-point
            turn-points
            turn-rows))

(define-argument-type (file-name value)
  "the name of a file, a string"
  (if (and (string? value) (not (string-null? value)) (not (string-index value #\nul)))
      value
      refused))


;;; Rows of a track: n x 5, without a heading NaN.

(define (row-numbers row)
  ;; ROW, a list of 4 or 5 sane numbers, as (T X Y Z HEADING); or #f.
  (let* ((items (and (pair? row) (bounded-list row 5)))
         (n (if items (length items) 0)))
    (and (<= 4 n 5)
         (every real? items)
         (<= 0 (first items) 1e9)
         (every (lambda (x) (<= -1e7 x 1e7)) (cdr items))
         (map exact->inexact (if (= n 4) (append items (list +nan.0)) items)))))

(define (rising? rows)
  (or (null? rows)
      (every < (map first (drop-right rows 1)) (map first (cdr rows)))))

(define (without-no-heading row)
  ;; ROW of an array as it comes out below, which a world read in another process has.
  (if (and (= 5 (length row)) (real? (fifth row)) (nan? (fifth row))) (take row 4) row))

(define (listed-rows value)
  (cond ((pair? value) (bounded-list value))
        ((and (array? value) (= 2 (array-rank value))) (map without-no-heading (array->list value)))
        (else #f)))

(define-argument-type (rows-in-time value)
  "rows (t x y z) or (t x y z heading): seconds rising from 0 on, metres, degrees"
  (let* ((listed (listed-rows value))
         (rows (and listed (map row-numbers listed))))
    (if (and rows (pair? rows) (every identity rows) (rising? rows))
        (list->typed-array 'f64 2 rows)
        refused)))


;;; Height fields.

(define grid-clause-names '(from to spacing))

(define most-posts 5000000)

(define type:extent (type:between -1e7 1e7))
(define type:spacing (type:between 1e-3 1e7))

(define (grid-form proc given)
  (bight-raise 'def proc
               "a grid is a file name, or a procedure of x and y as in (grid PROC (from -50 -50) (to 50 50) (spacing 1)), not ~s"
               given))

(define (two-numbers proc clauses name type)
  ;; What the clause NAME says, one number standing for two alike.
  (let ((entry (assq name clauses)))
    (unless (and entry (memv (length entry) (if (eq? name 'spacing) '(2 3) '(3))))
      (bight-raise 'def proc "a grid of a procedure needs ~a, two numbers~a" (list name '...)
                   (if (eq? name 'spacing) " or one for both" "")))
    (let ((values (map (lambda (v)
                         (check-argument proc (simple-format #f "`~a' of a grid" name) type v))
                       (cdr entry))))
      (if (null? (cdr values)) (list (car values) (car values)) values))))

(define (post-count proc from to spacing)
  ;; Posts from FROM to TO along one axis.
  (unless (> to from)
    (bight-raise 'domain proc "a grid goes from a lower to a higher number, not from ~a to ~a" from to))
  (let ((intervals (/ (- to from) spacing)))
    (when (> intervals most-posts)
      (bight-raise 'limit proc "a grid has at most ~a posts; ~a m every ~a m are more" most-posts
                   (- to from) spacing))
    (+ 1 (max 1 (inexact->exact (round intervals))))))

(define (height proc procedure x y)
  (let ((z (procedure x y)))
    (unless (and (real? z) (or (nan? z) (<= -1e7 z 1e7)))
      (bight-raise 'domain proc
                   "the procedure of a grid must return a height z in metres, or +nan.0 where there is no bottom, not ~s"
                   z))
    (exact->inexact z)))

(define (sample proc procedure from to spacing)
  ;; #(NX NY X Y DX DY HEIGHTS), rows from south to north; the spacing such that the last post is at TO.
  (let* ((nx (post-count proc (first from) (first to) (first spacing)))
         (ny (post-count proc (second from) (second to) (second spacing)))
         (dx (/ (- (first to) (first from)) (- nx 1)))
         (dy (/ (- (second to) (second from)) (- ny 1))))
    (when (> (* nx ny) most-posts)
      (bight-raise 'limit proc "a grid has at most ~a posts, not ~a by ~a" most-posts nx ny))
    (let ((z (make-f64vector (* nx ny))))
      (do ((j 0 (+ j 1))) ((= j ny))
        (do ((i 0 (+ i 1))) ((= i nx))
          (f64vector-set! z (+ i (* j nx))
                          (height proc procedure
                                  (+ (first from) (* i dx))
                                  (+ (second from) (* j dy))))))
      (vector nx ny (first from) (second from) dx dy z))))

(define (grid-clause proc datum)
  (let ((clause (and (pair? datum) (symbol? (car datum)) (bounded-list datum 4))))
    (unless clause (grid-form proc datum))
    (unless (memq (car clause) grid-clause-names)
      (unknown-name proc "a grid" (car clause) grid-clause-names))
    clause))

(define (parse-grid proc datum)
  "Return the canonical form of the height field that DATUM describes: the name of a file, or
#(NX NY X Y DX DY HEIGHTS) from (PROCEDURE (from X Y) (to X Y) (spacing M)).  Raise a &bight-error from
PROC when it describes none."
  (cond ((accepts? type:file-name datum) datum)
        ((and (vector? datum) (= 7 (vector-length datum)) (f64vector? (vector-ref datum 6))) datum)
        ((and (pair? datum) (procedure? (car datum)) (bounded-list datum 10))
         => (lambda (items)
              (let ((procedure (car items))
                    (clauses (map (lambda (item) (grid-clause proc item)) (cdr items))))
                (unless (takes? procedure 2)
                  (bight-raise 'domain proc
                               "the procedure of a grid takes x and y; ~s does not take two" procedure))
                (sample proc procedure
                        (two-numbers proc clauses 'from type:extent)
                        (two-numbers proc clauses 'to type:extent)
                        (two-numbers proc clauses 'spacing type:spacing)))))
        (else (grid-form proc datum))))

(define (grid->string grid)
  "Return what the canonical GRID is, in a few words."
  (if (string? grid)
      grid
      (simple-format #f "~a by ~a posts of a procedure" (vector-ref grid 0) (vector-ref grid 1))))


;;; Placing: turned by a compass heading, then moved.

(define (sine-and-cosine degrees)
  ;; Exact for quarter turns.
  (let ((quarters (/ degrees 90)))
    (if (and (integer? quarters) (< (abs quarters) 1e9))
        (case (modulo (inexact->exact quarters) 4)
          ((0) (values 0. 1.))
          ((1) (values 1. 0.))
          ((2) (values 0. -1.))
          (else (values -1. 0.)))
        (let ((angle (* degrees (/ (acos -1) 180))))
          (values (sin angle) (cos angle))))))

(define (place-point point at heading)
  "Return POINT, an f64vector, turned clockwise by HEADING degrees about the origin, then moved by AT."
  (call-with-values (lambda () (sine-and-cosine heading))
    (lambda (s c)
      (let ((x (f64vector-ref point 0)) (y (f64vector-ref point 1)))
        (f64vector (+ (f64vector-ref at 0) (* c x) (* s y))
                   (+ (f64vector-ref at 1) (- (* c y) (* s x)))
                   (+ (f64vector-ref at 2) (f64vector-ref point 2)))))))

(define (place-row row at heading)
  (f64vector->list (place-point (list->f64vector row) at heading)))

(define (turn-points points at heading)
  "Return POINTS, an n x 3 array, each placed as by `place-point'."
  (list->typed-array 'f64 2 (map (lambda (row) (place-row row at heading)) (array->list points))))

(define (turn-rows rows at heading turned?)
  "Return ROWS of a track, each place as by `place-point'; with TURNED?, each heading turned too."
  (list->typed-array
   'f64 2
   (map (lambda (row)
          (append (list (first row))
                  (place-row (take (cdr row) 3) at heading)
                  (list (if turned? (+ (fifth row) heading) (fifth row)))))
        (array->list rows))))
