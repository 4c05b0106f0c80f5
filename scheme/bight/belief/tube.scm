;;; (bight belief tube) --- where a tether may be: the tube that holds it with a given probability.
;;;
;;; At each of several places along the tether the members' points have a mean and a covariance.  A point lies in
;;; the tube at that place if its Mahalanobis distance is no more than that of the share of the members.  As the members and
;;; the truth are drawn alike, the share of truths held is the share asked for, whatever the distribution (conformal
;;; prediction: Vovk, Gammerman and Shafer, Algorithmic Learning in a Random World, 2005), if each member is judged as the
;;; truth is, by the mean and the covariance of others alone.  Among those that it is one of itself it is nearer to the
;;; middle than any truth: of 32 members a tube by such distances holds 0.83 of what is normal, not 0.9.  A point that was
;;; seen with an error lies where a tether's point, moved by such an error, may lie.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(define-module (bight belief tube)
  #:use-module (bight belief answer)
  #:use-module (bight study sweep-design)
  #:use-module (srfi srfi-1)
  #:use-module (srfi srfi-4)
  #:export (ellipsoid
            ellipsoid-mean
            ellipsoid-axes
            ellipsoid-holds?))

(define least-variance 1e-8)            ; m2: a tenth of a millimetre

;; An ellipsoid is (MEAN INVERSE-COVARIANCE COVARIANCE SQUARE-OF-RADIUS), matrices as lists of rows.

(define ellipsoid-mean first)

(define (minor m i j)
  (let ((rows (delete i '(0 1 2))) (columns (delete j '(0 1 2))))
    (define (at r c) (list-ref (list-ref m (list-ref rows r)) (list-ref columns c)))
    (- (* (at 0 0) (at 1 1)) (* (at 0 1) (at 1 0)))))

(define (inverse m)
  ;; Of a symmetric matrix of three rows.
  (let* ((cofactor (lambda (i j) (* (if (even? (+ i j)) 1 -1) (minor m i j))))
         (determinant (fold (lambda (j sum) (+ sum (* (list-ref (car m) j) (cofactor 0 j)))) 0.0 '(0 1 2))))
    (map (lambda (i) (map (lambda (j) (/ (cofactor j i) determinant)) '(0 1 2))) '(0 1 2))))

(define (product matrix u v)
  (fold (lambda (row a sum) (+ sum (* a (apply + (map * row v))))) 0.0 matrix u))

(define (off mean p) (map - (f64vector->list p) (f64vector->list mean)))

(define (square-distance mean inverse p)
  (let ((d (off mean p)))
    (product inverse d d)))

(define (widened covariance variance)
  (map (lambda (row i) (map (lambda (v j) (if (= i j) (+ v variance) v)) row '(0 1 2)))
       covariance '(0 1 2)))

(define (weighted-rank pairs share n)
  ;; Below which of the values of PAIRS, (VALUE . WEIGHT), SHARE of the weight, and that of one more of N members, lies,
  ;; interpolated; the greatest where there are too few for that.
  (let ((sorted (sort pairs (lambda (a b) (< (car a) (car b)))))
        (wanted (* share (+ 1 (/ 1 n)))))
    (let loop ((rest sorted) (sum 0.0) (below 0.0))
      (cond ((null? rest) below)
            ((>= (+ sum (cdar rest)) (- wanted 1e-12))
             (+ below (* (- (caar rest) below) (min 1 (/ (- wanted sum) (cdar rest))))))
            (else (loop (cdr rest) (+ sum (cdar rest)) (caar rest)))))))


;;; How far a member is from the others.

(define (distance-from-others inverse d share error)
  ;; The square of the Mahalanobis distance of a member with SHARE, D off the mean of all and seen with ERROR beside it,
  ;; from the mean of the others by their covariance, where INVERSE is that of the covariance of all (Sherman and
  ;; Morrison, Annals of Mathematical Statistics 21, 1950).
  (let* ((left (max 1e-6 (- 1 share))) (own (/ share left))
         (v (map (lambda (e c) (+ e (/ c left))) error d))
         (along (product inverse d v)))
    (* left (+ (product inverse v v)
               (/ (* own along along) (max 1e-9 (- 1 (* own (product inverse d d)))))))))

;; Such distances grow without end where a member is alone off the others.  Their ranks are interpolated in a number that
;; does not: the distance among N equal members that it is one of.

(define (among d n) (/ (* d (- n 1)) (+ n d)))

(define (from-others d n)
  ;; The distance from N members of who would be at D, at most N - 1, among N + 1.
  (/ (* d (+ n 1)) (- n d)))

(define draws 8)                        ; of an error, for each member

(define (errors i noise)
  ;; What may be seen beside the point of member number I, lists.
  (if (zero? noise)
      '((0.0 0.0 0.0))
      (let ((random (number-stream 'tube i)))
        (map (lambda (k) (map (lambda (c) (* noise (normal-quantile (random (+ c (* 3 k)))))) '(0 1 2)))
             (iota draws)))))

(define* (ellipsoid answer share #:optional (noise 0.0))
  "Return the ellipsoid that holds the point of ANSWER, seen with an error of NOISE in each direction, with probability
SHARE."
  (let* ((mean (answer-mean answer)) (shares (answer-weights answer))
         (n (max 2 (/ 1 (apply + (map * shares shares)))))
         (own (answer-covariance answer)) (seen (+ least-variance (* noise noise)))
         (of-others (inverse (widened own (* seen (- 1 (/ 1 n))))))
         (covariance (widened own seen))
         (ranked (append-map (lambda (p w i)
                               (let ((d (off mean p)) (all (errors i noise)))
                                 (map (lambda (error)
                                        (cons (among (distance-from-others of-others d w error) n) (/ w (length all))))
                                      all)))
                             (answer-values answer) shares (iota (length shares)))))
    (list mean (inverse covariance) covariance (from-others (weighted-rank ranked share n) n))))

(define (ellipsoid-holds? ellipsoid p)
  "Return true if P, a point, lies in ELLIPSOID."
  (<= (square-distance (first ellipsoid) (second ellipsoid) p) (fourth ellipsoid)))


;;; Axes: the eigenvectors of the covariance, by Jacobi's rotations (Golub and Van Loan, Matrix Computations,
;;; section 8.5).

(define (rotated m v p q)
  ;; The matrix M with its element (P, Q) turned to zero, and V turned alike: arrays, changed in place.
  (let ((off (array-ref m p q)))
    (unless (zero? off)
      (let* ((theta (/ (- (array-ref m q q) (array-ref m p p)) (* 2 off)))
             (t (/ (if (< theta 0) -1.0 1.0) (+ (abs theta) (sqrt (+ 1 (* theta theta))))))
             (c (/ 1 (sqrt (+ 1 (* t t))))) (s (* t c)))
        (define (turn! a row? k)
          (let ((x (if row? (array-ref a p k) (array-ref a k p)))
                (y (if row? (array-ref a q k) (array-ref a k q))))
            (define (put! value at) (if row? (array-set! a value at k) (array-set! a value k at)))
            (put! (- (* c x) (* s y)) p)
            (put! (+ (* s x) (* c y)) q)))
        (for-each (lambda (k) (turn! m #f k)) '(0 1 2))
        (for-each (lambda (k) (turn! m #t k)) '(0 1 2))
        (for-each (lambda (k) (turn! v #f k)) '(0 1 2))))))

(define (ellipsoid-axes ellipsoid)
  "Return the three half axes of ELLIPSOID, vectors in metres, f64vectors, the longest first."
  (let ((m (list->typed-array 'f64 2 (third ellipsoid)))
        (v (list->typed-array 'f64 2 '((1 0 0) (0 1 0) (0 0 1)))))
    (for-each (lambda (sweep)
                (for-each (lambda (pq) (rotated m v (car pq) (cadr pq))) '((0 1) (0 2) (1 2))))
              (iota 12))
    (sort (map (lambda (k)
                 (let ((length (sqrt (max 0.0 (* (fourth ellipsoid) (array-ref m k k))))))
                   (list->f64vector (map (lambda (i) (* length (array-ref v i k))) '(0 1 2)))))
               '(0 1 2))
          (lambda (a b) (> (length-of a) (length-of b))))))

(define (length-of v)
  (sqrt (apply + (map (lambda (c) (* c c)) (f64vector->list v)))))
