;;; (bight study sweep-design) --- which cases a study has: grids, seeds, and what is drawn at random.
;;;
;;; Each variable has a draw.  Those that list their values (grid, range, seeds) are crossed, the last
;;; varying fastest.  Those that are random (uniform, normal, one-of) are drawn together N times, crossed
;;; with the lists: at random (monte-carlo), or so that each of N equal slices of each variable's
;;; probability holds one point (latin-hypercube; McKay, Beckman and Conover, Technometrics 21, 1979).
;;;
;;; The random numbers are our own: splitmix64 (Steele, Lea and Flood, OOPSLA 2014) at a place that the
;;; seed, the variable's name and the number of the point tell.  So they are the same on every machine,
;;; and more points of a Monte Carlo study leave the first ones as they were.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(define-module (bight study sweep-design)
  #:use-module ((bight core decimal) #:select (text->number))
  #:use-module (bight core errors)
  #:use-module (bight core record)
  #:use-module (srfi srfi-1)
  #:export (make-draw
            draw?
            draw-names
            draw-variable
            draw-at
            random?
            shares
            listed-values
            design
            design?
            design-size
            design-case
            design-variables
            design-spread
            fingerprint
            number-stream
            normal-quantile))


;;; Fingerprints of text.

(define field 4294967291)               ; the largest prime below 2^32
(define points '(263167411 198491317))  ; below 2^28: a product and a character more is a fixnum

(define (text-at point text)
  ;; TEXT, as the coefficients of a polynomial over the field, at POINT.
  (let ((n (string-length text)))
    (let loop ((i 0) (sum 1))
      (if (= i n)
          sum
          (loop (+ i 1)
                (modulo (+ (* sum point) (char->integer (string-ref text i))) field))))))

(define (fingerprint text)
  "Return 16 hexadecimal digits that TEXT, a string, is known by, the same on every machine."
  (string-concatenate
   (map (lambda (point) (string-pad (number->string (text-at point text) 16) 8 #\0)) points)))


;;; Random numbers.

(define low-64 (- (ash 1 64) 1))

(define (mixed z)
  (define (step z shift factor)
    (logand low-64 (* factor (logxor z (ash z (- shift))))))
  (let ((z (step (step z 30 #xbf58476d1ce4e5b9) 27 #x94d049bb133111eb)))
    (logxor z (ash z -31))))

(define (number-stream . words)
  "Return a procedure of a number i, 0, 1, ..., that returns the random number i of the stream that WORDS
name, between 0 and 1, neither included."
  (let ((start (text->number (fingerprint (object->string words)) 16)))
    (lambda (i)
      (/ (+ 0.5 (ash (mixed (logand low-64 (+ start (* (+ i 1) #x9e3779b97f4a7c15)))) -12))
         (expt 2.0 52)))))

(define (shuffled n stream)
  ;; The numbers below N in an order that STREAM tells (Fisher and Yates).
  (let ((order (list->vector (iota n))))
    (do ((i (- n 1) (- i 1)))
        ((<= i 0) order)
      (let* ((j (inexact->exact (floor (* (stream i) (+ i 1)))))
             (kept (vector-ref order i)))
        (vector-set! order i (vector-ref order j))
        (vector-set! order j kept)))))

(define (shares kind n seed variable)
  "Return N numbers between 0 and 1 for VARIABLE, drawn as KIND, `monte-carlo' or `latin-hypercube', says."
  (let ((stream (number-stream seed variable)))
    (if (eq? kind 'monte-carlo)
        (list-tabulate n stream)
        (let ((slices (shuffled n (number-stream seed variable 'slices))))
          (list-tabulate n (lambda (i) (/ (+ (vector-ref slices i) (stream i)) n)))))))


;;; The normal distribution: Wichura's algorithm AS 241 (Applied Statistics 37, 1988), to 16 digits.

(define (ratio x above below)
  (define (polynomial coefficients)
    (fold-right (lambda (c sum) (+ c (* sum x))) 0.0 coefficients))
  (/ (polynomial above) (polynomial (cons 1.0 below))))

(define (middle r)
  (ratio r
         '(3.3871328727963666080 133.14166789178437745 1971.5909503065514427 13731.693765509461125
           45921.953931549871457 67265.770927008700853 33430.575583588128105 2509.0809287301226727)
         '(42.313330701600911252 687.18700749205790830 5394.1960214247511077 21213.794301586595867
           39307.895800092710610 28729.085735721942674 5226.4952788528545610)))

(define (shoulder r)
  (ratio r
         '(1.42343711074968357734 4.63033784615654529590 5.76949722146069140550 3.64784832476320460504
           1.27045825245236838258 0.241780725177450611770 0.0227238449892691845833
           7.74545014278341407640e-4)
         '(2.05319162663775882187 1.67638483018380384940 0.689767334985100004550
           0.148103976427480074590 0.0151986665636164571966 5.47593808499534494600e-4
           1.05075007164441684324e-9)))

(define (tail r)
  (ratio r
         '(6.65790464350110377720 5.46378491116411436990 1.78482653991729133580
           0.296560571828504891230 0.0265321895265761230930 0.00124266094738807843860
           2.71155556874348757815e-5 2.01033439929228813265e-7)
         '(0.599832206555887937690 0.136929880922735805310 0.0148753612908506148525
           7.86869131145613259100e-4 1.84631831751005468180e-5 1.42151175831644588870e-7
           2.04426310338993978564e-15)))

(define (normal-quantile share)
  "Return the number below which the SHARE, between 0 and 1, of the standard normal distribution lies."
  (let ((q (- share 0.5)))
    (if (<= (abs q) 0.425)
        (* q (middle (- 0.180625 (* q q))))
        (let* ((r (sqrt (- (log (min share (- 1 share))))))
               (size (if (<= r 5) (shoulder (- r 1.6)) (tail (- r 5)))))
          (if (negative? q) (- size) size)))))


;;; Draws.

(define-record <draw>
  (%make-draw variable kind values)
  draw?
  (variable draw-variable)              ; a symbol
  (kind draw-kind)                      ; a symbol
  (values draw-values))                 ; what the variable takes, or what the distribution is told

(define usages
  '((grid "(grid VALUE ...)")
    (range "(range FROM TO STEP)")
    (seeds "(seeds N)")
    (uniform "(uniform LOW HIGH)")
    (normal "(normal MEAN DEVIATION)")
    (one-of "(one-of VALUE ...)")))

(define draw-names (map car usages))

(define most-values 1000000)

(define (finite? x) (and (real? x) (< -inf.0 x +inf.0)))

(define (value? x)
  (or (finite? x) (boolean? x) (symbol? x) (string? x)))

(define (count? x) (and (exact-integer? x) (<= 1 x most-values)))

(define (range? values)
  (and (= 3 (length values)) (every finite? values) (not (zero? (third values)))
       (<= 0 (/ (- (second values) (first values)) (third values)) most-values)))

(define (fits? kind values)
  (case kind
    ((grid one-of) (and (pair? values) (every value? values)))
    ((seeds) (and (= 1 (length values)) (count? (car values))))
    ((range) (range? values))
    ((uniform) (and (= 2 (length values)) (every finite? values) (< (first values) (second values))))
    ((normal) (and (= 2 (length values)) (every finite? values) (positive? (second values))))
    (else #f)))

(define (range-values from to step)
  ;; A last value that rounding puts a hair beyond the end is kept.
  (map (lambda (i) (+ from (* i step)))
       (iota (+ 1 (inexact->exact (floor (+ 1e-9 (/ (- to from) step))))))))

(define* (make-draw place variable kind values #:optional (proc 'define-study))
  "Return the draw of KIND, one of `draw-names', with VALUES, for VARIABLE.  Raise a &bight-error from PROC
that begins with PLACE, a string, if there is no such draw."
  (unless (fits? kind values)
    (bight-raise 'domain proc "~a~a is drawn by ~a, of numbers~a, not by ~s" place variable
                 (car (assq-ref usages kind))
                 (case kind
                   ((grid one-of) ", symbols, strings or booleans")
                   ((seeds) " from 1 up")
                   ((uniform) ", LOW below HIGH")
                   ((normal) ", DEVIATION above 0")
                   (else ", STEP leading from FROM to TO"))
                 (cons kind values)))
  (%make-draw variable kind values))

(define (random? draw)
  "Return true if DRAW is of a distribution."
  (memq (draw-kind draw) '(uniform normal one-of)))

(define (listed-values draw)
  "Return the values that DRAW lists, or #f if it is random."
  (let ((values (draw-values draw)))
    (case (draw-kind draw)
      ((grid) values)
      ((range) (apply range-values values))
      ((seeds) (iota (car values) 1))
      (else #f))))

(define (draw-at draw share)
  "Return the value of DRAW, a random one, below which SHARE, between 0 and 1, of its distribution lies."
  (let ((values (draw-values draw)))
    (case (draw-kind draw)
      ((uniform) (+ (first values) (* share (- (second values) (first values)))))
      ((normal) (+ (first values) (* (second values) (normal-quantile share))))
      (else (list-ref values (inexact->exact (floor (* share (length values)))))))))


;;; All cases.

(define-record <design>
  (make-design variables columns points spread)
  design?
  (variables design-variables)          ; symbols
  (columns design-columns)              ; for each, (#t . VALUES) if it is crossed, (#f . VALUES) if drawn
  (points design-points)                ; how many points are drawn for each of the crossed
  (spread design-spread))               ; the variables that people compare: listed, but no seeds

(define (column draw sampling)
  (let ((listed (listed-values draw)))
    (if listed
        (cons #t (list->vector listed))
        (cons #f (list->vector
                  (map (lambda (share) (draw-at draw share))
                       (shares (first sampling) (second sampling) (third sampling)
                               (draw-variable draw))))))))

(define (check-sampling place draws sampling)
  (let ((drawn (find random? draws)))
    (cond ((and drawn (not sampling))
           (bight-raise 'def 'define-study "~a~a is drawn at random, ~s: say (monte-carlo N) or \
(latin-hypercube N)" place (draw-variable drawn) (cons (draw-kind drawn) (draw-values drawn))))
          ((and sampling (not drawn))
           (bight-raise 'def 'define-study "~a(~a ~a) draws at random, but no variable is uniform, normal \
or one-of" place (first sampling) (second sampling)))
          ((and sampling (not (count? (second sampling))))
           (bight-raise 'domain 'define-study "~a(~a N) needs a whole number from 1 to ~a, not ~s" place
                        (first sampling) most-values (second sampling))))))

(define (check-variables place names)
  ;; A column of a table is the same in small letters and in large.
  (let loop ((rest names) (seen '()))
    (when (pair? rest)
      (let* ((word (string-downcase (symbol->string (car rest))))
             (other (assoc-ref seen word)))
        (when other
          (bight-raise 'def 'define-study "~a~a is there twice~a" place (car rest)
                       (if (eq? other (car rest)) ""
                           (simple-format #f ": ~a and ~a would share a column" other (car rest)))))
        (loop (cdr rest) (acons word (car rest) seen))))))

(define (design place draws sampling)
  "Return the design of a study whose variables have DRAWS, and whose random ones are drawn by SAMPLING, a
list (KIND N SEED) or #f.  Raise a &bight-error that begins with PLACE if they do not fit."
  (check-variables place (map draw-variable draws))
  (check-sampling place draws sampling)
  (let ((made (make-design (map draw-variable draws)
                           (map (lambda (draw) (column draw sampling)) draws)
                           (if sampling (second sampling) 1)
                           (filter-map (lambda (draw)
                                         (and (memq (draw-kind draw) '(grid range)) (draw-variable draw)))
                                       draws))))
    (when (> (design-size made) most-values)
      (bight-raise 'limit 'define-study "~athe study has ~a cases, more than ~a" place (design-size made)
                   most-values))
    made))

(define (design-size design)
  "Return how many cases DESIGN has."
  (fold (lambda (column size) (if (car column) (* size (vector-length (cdr column))) size))
        (design-points design)
        (design-columns design)))

(define (design-case design number)
  "Return the values of the variables of DESIGN in the case NUMBER, from 0."
  (let ((point (remainder number (design-points design))))
    ;; From the last variable, which varies fastest, to the first.
    (let loop ((columns (reverse (design-columns design)))
               (rest (quotient number (design-points design)))
               (values '()))
      (cond ((null? columns) values)
            ((caar columns)
             (let* ((all (cdar columns)) (n (vector-length all)))
               (loop (cdr columns) (quotient rest n)
                     (cons (vector-ref all (remainder rest n)) values))))
            (else
             (loop (cdr columns) rest (cons (vector-ref (cdar columns) point) values)))))))
