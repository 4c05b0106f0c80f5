;;; (bight test generator) --- what random things are made of, and how each is made smaller.
;;;
;;; A generator draws a seed datum, tells which data are simpler than one it drew, and makes an expression of
;;; a datum.  The value of a random thing is the value of that expression: what ran is what is printed.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(define-module (bight test generator)
  #:use-module (bight core errors)
  #:use-module (bight core record)
  #:use-module (bight core verb)
  #:use-module (bight language)
  #:use-module (srfi srfi-1)
  #:use-module ((srfi srfi-9 gnu) #:select (set-record-type-printer!))
  #:export (uniform integer one-of any-of list-of point-in made-of
            generator?
            draw simpler rounder expression value-of
            magnitudes sometimes
            type:generator))

(define-record <generator>
  (make-generator name draw simplify expression)
  %generator?
  (name generator-name)
  (draw generator-draw)                 ; random state -> datum
  (simplify generator-simplify)         ; how, datum -> list of data, the boldest first
  (expression generator-expression))    ; datum -> expression

(set-record-type-printer! <generator>
  (lambda (generator port) (simple-format port "#<~a>" (generator-name generator))))

(define-argument-type (generator value)
  "a generator, such as (uniform 0 1)"
  (if (%generator? value) value refused))

(define-verb (generator? (object any))
  "Return #t if OBJECT is a generator of random things, such as (uniform 0 1)."
  (%generator? object))

(define (draw generator state)
  "Return a datum drawn from GENERATOR by the random STATE."
  ((generator-draw generator) state))

(define (simplify how generator datum)
  ;; HOW is `smaller' or `rounder'.
  ((generator-simplify generator) how datum))

(define (simpler generator datum)
  "Return the data of GENERATOR that are simpler than DATUM, the boldest first."
  (simplify 'smaller generator datum))

(define (rounder generator datum)
  "Return the data of GENERATOR that have a number of fewer decimals than DATUM, if a larger one: for when
nothing simpler will do."
  (simplify 'rounder generator datum))

(define (expression generator datum)
  "Return the expression that DATUM of GENERATOR stands for."
  ((generator-expression generator) datum))

(define language
  (let ((module #f))
    (lambda ()
      (unless module
        (set! module (language-module)))
      module)))

(define (value-of expression)
  "Return the value of EXPRESSION, in which all names are the language's."
  (if (or (pair? expression) (symbol? expression))
      (eval expression (language))
      expression))


;;; Numbers.  A simpler one is nearer to the origin, zero or what of the range is nearest to it; first come
;;; the origin itself and what is left when decimals are cut off.

(define (cut x decimals)
  (let ((k (expt 10 decimals)))
    (/ (truncate (* x k)) k)))

(define (halvings x origin)
  ;; From half the way to the origin on, ever nearer to X.
  (let loop ((step (/ (- x origin) 2)) (n 0) (found '()))
    (if (= n 12)
        (reverse found)
        (loop (/ step 2) (+ n 1) (cons (- x step) found)))))

(define (raise-decimals x decimals)
  ;; X and, if it has more, a little, away from zero.
  (let ((k (expt 10 decimals)))
    (/ (if (negative? x) (floor (* x k)) (ceiling (* x k))) k)))

(define (rounder-number x low high decimals)
  (filter (lambda (y) (and (<= low y high) (not (= x y))))
          (map (lambda (d) (raise-decimals x d)) (iota decimals))))

(define (simplify-number how x low high decimals)
  ((if (eq? how 'smaller) simpler-number rounder-number) x low high decimals))

(define (nearest-to-zero low high)
  (cond ((> low 0) low) ((< high 0) high) (else 0)))

(define (simpler-number x low high decimals)
  (let ((origin (nearest-to-zero low high)))
    (define (nearer? y)
      (and (<= low y high) (< (abs (- y origin)) (abs (- x origin)))))
    (delete-duplicates
     (filter nearer?
             (cons origin
                   (append (map (lambda (d) (cut x d)) (iota decimals))
                           (map (lambda (y) (cut y decimals)) (halvings x origin))))))))

(define (printable x)
  ;; X, exact inside, as a person would type it.
  (if (integer? x) x (exact->inexact x)))

(define (check-range proc low high)
  (unless (<= low high)
    (bight-raise 'domain proc "the lower bound comes first, not ~a ~a" low high)))

(define decimals 3)

(define-verb (uniform (low number) (high number))
  "Return a generator of numbers from LOW to HIGH, evenly spread, to three decimals."
  (check-range 'uniform low high)
  (let ((low (inexact->exact low)) (high (inexact->exact high)))
    (make-generator
     'uniform
     (lambda (state)
       (let ((x (+ low (* (- high low) (inexact->exact (random:uniform state))))))
         (max low (min high (cut x decimals)))))
     (lambda (how x) (simplify-number how x low high decimals))
     printable)))

(define-verb (integer (low number) (high number))
  "Return a generator of whole numbers from LOW to HIGH, both included."
  (check-range 'integer low high)
  (let ((low (inexact->exact (ceiling low))) (high (inexact->exact (floor high))))
    (make-generator
     'integer
     (lambda (state) (+ low (random (+ 1 (- high low)) state)))
     (lambda (how n) (simplify-number how n low high 0))
     printable)))

;; Sizes of which nobody knows the scale are spread evenly over their logarithms.

(define (two-digits x)
  ;; X, positive, cut to two significant digits, exact.
  (let* ((x (inexact->exact x))
         (unit (expt 10 (- (inexact->exact (floor (log10 x))) 1))))
    (* unit (max 1 (truncate (/ x unit))))))

(define (magnitudes low high)
  "Return a generator of numbers from LOW, above 0, to HIGH, spread evenly over their magnitudes, to two
digits."
  (let ((bottom (log low)) (top (log high))
        (low (inexact->exact low)) (high (inexact->exact high)))
    (define (within x) (max low (min high x)))
    (make-generator
     'magnitudes
     (lambda (state) (within (two-digits (exp (+ bottom (* (- top bottom) (random:uniform state)))))))
     (lambda (how x)
       (let ((simple (delete-duplicates (list (within 1) (within (expt 10 (exact-log10 x)))))))
         (if (or (eq? how 'rounder) (memv x simple)) '() simple)))
     printable)))

(define (exact-log10 x)
  (inexact->exact (floor (log10 x))))


;;; Choices.

(define (quoted value)
  (if (or (symbol? value) (pair? value) (null? value)) (list 'quote value) value))

(define-verb (one-of (value any) #:rest (others any))
  "Return a generator of the values given; an earlier one is simpler."
  (let ((values (list->vector (cons value others))))
    (make-generator
     'one-of
     (lambda (state) (random (vector-length values) state))
     (lambda (how i) (if (eq? how 'smaller) (iota i) '()))
     (lambda (i) (quoted (vector-ref values i))))))

(define-verb (any-of (choice generator) #:rest (others generator))
  "Return a generator of what any of the generators given draws."
  (let ((choices (list->vector (cons choice others))))
    (make-generator
     'any-of
     (lambda (state)
       (let ((i (random (vector-length choices) state)))
         (cons i (draw (vector-ref choices i) state))))
     (lambda (how datum)
       (map (lambda (d) (cons (car datum) d))
            (simplify how (vector-ref choices (car datum)) (cdr datum))))
     (lambda (datum) (expression (vector-ref choices (car datum)) (cdr datum))))))


;;; Several things.

(define (with-each data simpler-of)
  ;; DATA with one of them replaced by what SIMPLER-OF, of its index and itself, returns, in all ways.
  (append-map (lambda (i)
                (map (lambda (d) (append (take data i) (list d) (drop data (+ i 1))))
                     (simpler-of i (list-ref data i))))
              (iota (length data))))

(define (without-some data least)
  ;; DATA without a half, a quarter, ... and at last each one of them, never fewer than LEAST.
  (let ((n (length data)))
    (let loop ((k (quotient (+ n 1) 2)) (found '()))
      (if (zero? k)
          (concatenate (reverse found))
          (loop (quotient k 2)
                (if (< (- n k) least)
                    found
                    (cons (map (lambda (start)
                                 (append (take data start) (drop data (min n (+ start k)))))
                               (iota (quotient (+ n k -1) k) 0 k))
                          found)))))))

(define (sequence name item least most make)
  ;; From LEAST to MOST of what ITEM draws; MAKE makes an expression of their expressions.
  (make-generator
   name
   (lambda (state)
     (map-in-order (lambda (i) (draw item state)) (iota (+ least (random (+ 1 (- most least)) state)))))
   (lambda (how data)
     (append (if (eq? how 'smaller) (without-some data least) '())
             (with-each data (lambda (i datum) (simplify how item datum)))))
   (lambda (data) (make (map (lambda (datum) (expression item datum)) data)))))

(define-verb (list-of (item generator) #:key (least count 0) (most count 10)
                      (make procedure (lambda (items) (cons 'list items))))
  "Return a generator of lists of LEAST to MOST things that ITEM draws.  MAKE, a procedure, makes an
expression of the list of theirs; when left out it is (list ...)."
  (check-range 'list-of least most)
  (sequence 'list-of item least most make))

(define-verb (made-of (make procedure) #:rest (from generator))
  "Return a generator of expressions: MAKE is called with one of what each generator FROM draws, and returns
the expression, as in (made-of (lambda (r) `(part sphere (at 0 0 -5) (radius ,r))) (uniform 0.1 1))."
  (unless (takes? make (length from))
    (bight-raise 'domain 'made-of "the procedure must take ~a arguments; ~s does not" (length from) make))
  (make-generator
   'made-of
   (lambda (state) (map-in-order (lambda (g) (draw g state)) from))
   (lambda (how data) (with-each data (lambda (i datum) (simplify how (list-ref from i) datum))))
   (lambda (data) (apply make (map expression from data)))))

(define-verb (point-in (low point) (high point))
  "Return a generator of points in the box from corner LOW to corner HIGH."
  (define (side i)
    (uniform (array-ref low i) (array-ref high i)))
  (made-of (lambda (x y z) `(vec ,x ,y ,z)) (side 0) (side 1) (side 2)))

(define (sometimes share generator)
  "Return a generator of a list: of what GENERATOR draws, in the SHARE of the cases from 0 to 1, else empty."
  (make-generator
   'sometimes
   (lambda (state)
     ;; Both are drawn always, so that what follows does not depend on the choice.
     (let ((chosen? (< (random:uniform state) share)) (datum (draw generator state)))
       (and chosen? (list datum))))
   (lambda (how datum)
     (if datum
         (append (if (eq? how 'smaller) '(#f) '())
                 (map list (simplify how generator (car datum))))
         '()))
   (lambda (datum) (if datum (list (expression generator (car datum))) '()))))
