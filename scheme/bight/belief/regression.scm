;;; (bight belief regression) --- how the latent numbers of a cloud move when readings are taken.
;;;
;;; What the members foretold is regressed on their latent numbers: a statistical linearisation (Garcia-Fernandez
;;; et al., IEEE Transactions on Signal Processing 63, 2015).  What the regression leaves unexplained, a line that
;;; slipped off in one member and caught in the next, is an error of the linear model, correlated between
;;; readings, and joins the readings' own noise; else many readings would use up the few members and leave a
;;; belief that is surer than it may be.  The covariance of that error is shrunk half way to its diagonal (Ledoit
;;; and Wolf, Journal of Multivariate Analysis 88, 2004).
;;;
;;; Of few members the regression itself is uncertain.  So the error is estimated with as many degrees of freedom as
;;; the coefficients leave, and is that of a prediction, not of a fit (Draper and Smith, Applied Regression Analysis,
;;; 1998, sections 1.4 and 5.1).  A coefficient that chance may have made draws a latent number that nothing was read
;;; of: each is shrunk toward zero by the positive part of James and Stein's rule, which leaves none below two standard
;;; errors, as the localisation by correlations of ensemble smoothers does (Luo, Bhakta and Naevdal, SPE Journal 23,
;;; 2018).
;;;
;;; The members then move by the square root filter, one decorrelated number after another (Whitaker and Hamill,
;;; Monthly Weather Review 130, 2002), which draws nothing at random.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(define-module (bight belief regression)
  #:use-module (bight core record)
  #:use-module (srfi srfi-1)
  #:use-module (srfi srfi-4)
  #:export (linearise
            linear?
            linear-logs
            move-columns!))

;; Matrices are vectors of rows, f64vectors; a column holds a number of each member.

(define (dot a b)
  (let ((n (f64vector-length a)))
    (do ((i 0 (+ i 1)) (sum 0.0 (+ sum (* (f64vector-ref a i) (f64vector-ref b i)))))
        ((= i n) sum))))

(define (mean-of column)
  (let ((n (f64vector-length column)))
    (do ((i 0 (+ i 1)) (sum 0.0 (+ sum (f64vector-ref column i))))
        ((= i n) (/ sum n)))))

(define (tabulated n f)
  (let ((v (make-f64vector n)))
    (do ((i 0 (+ i 1))) ((= i n) v)
      (f64vector-set! v i (f i)))))

(define (centred column)
  (let ((mean (mean-of column)))
    (tabulated (f64vector-length column) (lambda (i) (- (f64vector-ref column i) mean)))))

(define (matrix n f)
  (let ((rows (make-vector n)))
    (do ((i 0 (+ i 1))) ((= i n) rows)
      (vector-set! rows i (tabulated n (lambda (j) (f i j)))))))

(define (at rows i j) (f64vector-ref (vector-ref rows i) j))

(define (partial-dot a b n)
  (do ((k 0 (+ k 1)) (sum 0.0 (+ sum (* (f64vector-ref a k) (f64vector-ref b k)))))
      ((= k n) sum)))

(define (cholesky! rows)
  ;; ROWS, symmetric and positive definite, become their lower factor.
  (let ((n (vector-length rows)))
    (do ((i 0 (+ i 1))) ((= i n) rows)
      (let ((row (vector-ref rows i)))
        (do ((j 0 (+ j 1))) ((> j i))
          (let* ((other (vector-ref rows j))
                 (rest (- (f64vector-ref row j) (partial-dot row other j))))
            (f64vector-set! row j (if (= i j) (sqrt (max rest 1e-300)) (/ rest (f64vector-ref other j))))))))))

(define (solve-lower rows b)
  ;; x of L x = B, L the lower factor in ROWS.
  (let* ((n (vector-length rows)) (x (make-f64vector n)))
    (do ((i 0 (+ i 1))) ((= i n) x)
      (f64vector-set! x i (/ (- (f64vector-ref b i) (partial-dot (vector-ref rows i) x i)) (at rows i i))))))

(define (solve-upper rows b)
  ;; x of L^T x = B.
  (let* ((n (vector-length rows)) (x (f64vector-copy b)))
    (do ((i (- n 1) (- i 1))) ((< i 0) x)
      (f64vector-set! x i (/ (f64vector-ref x i) (at rows i i)))
      (do ((j 0 (+ j 1))) ((= j i))
        (f64vector-set! x j (- (f64vector-ref x j) (* (at rows i j) (f64vector-ref x i))))))))

(define (f64vector-copy v) (tabulated (f64vector-length v) (lambda (i) (f64vector-ref v i))))


;;; The linear model: decorrelated numbers with unit noise, each with coefficients of the latent numbers.

(define-record <linear>
  (make-linear coefficients offsets)
  linear?
  (coefficients linear-coefficients)    ; a list of f64vectors
  (offsets linear-offsets))             ; a list: what was read, less what the members foretold in the mean

(define doubtful 4.0)                   ; the square of the standard errors below which a coefficient is chance

(define (freedom n d)
  ;; Degrees of freedom that D coefficients and a mean leave of N members.
  (max 1 (- n 1 d)))

(define (coefficients-of off factor inverse-diagonal h)
  ;; Of H, centred, on the centred columns OFF; each shrunk by how sure it is.
  (let* ((n (f64vector-length h))
         (b (solve-upper factor (solve-lower factor (list->f64vector (map (lambda (z) (dot z h)) off)))))
         (left (residual off b h))
         (variance (/ (dot left left) (freedom n (length off)))))
    (tabulated (f64vector-length b)
               (lambda (k)
                 (let* ((value (f64vector-ref b k))
                        (error (* variance (list-ref inverse-diagonal k))))
                   (* value (max 0.0 (- 1 (/ (* doubtful error) (max 1e-300 (* value value)))))))))))

(define (residual off b h)
  (tabulated (f64vector-length h)
             (lambda (i)
               (let loop ((rest off) (k 0) (left (f64vector-ref h i)))
                 (if (null? rest)
                     left
                     (loop (cdr rest) (+ k 1) (- left (* (f64vector-ref b k) (f64vector-ref (car rest) i)))))))))

(define (unit d k) (tabulated d (lambda (i) (if (= i k) 1.0 0.0))))

(define (noise-factor residuals variances d)
  ;; The lower factor of the covariance of all errors: noise, and what a regression on D numbers left, where it
  ;; foretells.
  (let* ((left (list->vector residuals))
         (n (f64vector-length (vector-ref left 0)))
         (more (/ (+ 1 (/ (+ 1.0 d) n)) (freedom n d)))
         (own (list->vector variances)))
    (cholesky!
     (matrix (vector-length left)
             (lambda (i j)
               (let ((covariance (* more (dot (vector-ref left i) (vector-ref left j)))))
                 (if (= i j) (+ covariance (vector-ref own i)) (* 0.5 covariance))))))))

(define (linearise columns foretold values variances)
  "Return the linear model of readings VALUES, whose noises have VARIANCES, in the latent numbers of COLUMNS, an
f64vector of all members for each; FORETOLD has, for each reading, what the members foretold."
  (let* ((off (map centred columns))
         (d (length off))
         (z (list->vector off))
         (ridge (+ 1 (/ 1.0 (f64vector-length (car off))))) ; beside as many members, one more
         (factor (cholesky! (matrix d (lambda (i j) (* (dot (vector-ref z i) (vector-ref z j)) (if (= i j) ridge 1))))))
         (inverse-diagonal (map (lambda (k) (let ((x (solve-lower factor (unit d k)))) (dot x x))) (iota d)))
         (h (map centred foretold))
         (b (map (lambda (h) (coefficients-of off factor inverse-diagonal h)) h))
         (noise (noise-factor (map (lambda (h b) (residual off b h)) h b) variances d))
         (decorrelated (lambda (numbers) (f64vector->list (solve-lower noise (list->f64vector numbers)))))
         (rows (map (lambda (k) (decorrelated (map (lambda (b) (f64vector-ref b k)) b))) (iota d))))
    (make-linear (apply map f64vector rows)
                 (decorrelated (map (lambda (value column) (- value (mean-of column))) values foretold)))))

(define (foretold-by coefficients off)
  (let ((n (f64vector-length (car off))))
    (tabulated n (lambda (i)
                   (let loop ((rest off) (k 0) (sum 0.0))
                     (if (null? rest)
                         sum
                         (loop (cdr rest) (+ k 1)
                               (+ sum (* (f64vector-ref coefficients k) (f64vector-ref (car rest) i))))))))))

(define (linear-logs linear columns)
  "Return the logarithms of the likelihoods that LINEAR gives the members with latent numbers in COLUMNS, a list."
  (let* ((off (map centred columns))
         (sum (make-f64vector (f64vector-length (car off)) 0.0)))
    (for-each (lambda (coefficients offset)
                (let ((h (foretold-by coefficients off)))
                  (do ((i 0 (+ i 1))) ((= i (f64vector-length sum)))
                    (let ((miss (- offset (f64vector-ref h i))))
                      (f64vector-set! sum i (- (f64vector-ref sum i) (* 0.5 miss miss)))))))
              (linear-coefficients linear) (linear-offsets linear))
    (f64vector->list sum)))


;;; The square root filter.

(define (move-column! column h innovation variance)
  ;; By a number with VARIANCE of noise, of which the members foretold H, centred, and which lay INNOVATION beyond
  ;; their mean.
  (let* ((n (f64vector-length column))
         (spread (/ (dot h h) (- n 1)))
         (total (+ spread variance))
         (gain (/ (dot (centred column) h) (- n 1) total))
         (share (/ 1 (+ 1 (sqrt (/ variance total)))))
         (step (* gain innovation)))
    (do ((i 0 (+ i 1))) ((= i n))
      (f64vector-set! column i (+ (f64vector-ref column i) (- step (* share gain (f64vector-ref h i))))))))

(define (move-columns! linear columns share)
  "Move the latent numbers in COLUMNS, in place, as SHARE of the evidence in LINEAR asks."
  (let ((means (map mean-of columns)) (variance (/ 1 share)))
    (for-each (lambda (coefficients offset)
                (let* ((h (foretold-by coefficients (map centred columns)))
                       (moved (fold (lambda (k column mean sum)
                                      (+ sum (* (f64vector-ref coefficients k) (- (mean-of column) mean))))
                                    0.0 (iota (length columns)) columns means)))
                  (for-each (lambda (column) (move-column! column h (- offset moved) variance)) columns)))
              (linear-coefficients linear) (linear-offsets linear))))
