;;; What a belief makes of readings against what probability says: Kalman's closed form, and ranks of truths.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(use-modules (bight bench belief) (bight bench in-time) (bight belief answer) (bight belief cloud) (bight belief tube) (bight belief regression) (bight study sweep-design) ((bight bench) #:select (bench-command)) ((srfi srfi-1) #:select (iota fold count append-map filter-map)) (srfi srfi-4))

(define (normals name)
  ;; A thunk that returns one independent standard normal number after another.
  (let ((stream (number-stream name)) (at -1))
    (lambda () (set! at (+ at 1)) (normal-quantile (stream at)))))

(define (times n thunk) (map (lambda (k) (thunk)) (iota n)))

(define (product a b) (fold (lambda (x y sum) (+ sum (* x y))) 0.0 a b))

(define (moved columns foretold values variance share)
  ;; COLUMNS, lists, as readings VALUES, whose noises have VARIANCE, move them.
  (let ((columns (map list->f64vector columns)))
    (move-columns! (linearise columns (map list->f64vector foretold) values (map (const variance) values)) columns share)
    (map f64vector->list columns)))

(define (moments columns)
  ;; Means, and the rows of the covariance.
  (let* ((n (length (car columns))) (means (map (lambda (c) (/ (apply + c) n)) columns))
         (off (map (lambda (c m) (map (lambda (x) (- x m)) c)) columns means)))
    (list means (map (lambda (a) (map (lambda (b) (/ (product a b) (- n 1))) off)) off))))

(define (kalman rows values variance)
  ;; Mean and covariance of standard normal numbers after readings VALUES of ROWS of them (R. E. Kalman, Journal of
  ;; Basic Engineering 82, 1960), one reading after another.
  (let loop ((rows rows) (values values) (mean '(0.0 0.0 0.0)) (p '((1.0 0.0 0.0) (0.0 1.0 0.0) (0.0 0.0 1.0))))
    (if (null? rows)
        (list mean p)
        (let* ((ph (map (lambda (row) (product row (car rows))) p))
               (total (+ variance (product ph (car rows))))
               (miss (- (car values) (product mean (car rows)))))
          (loop (cdr rows) (cdr values)
                (map (lambda (m g) (+ m (/ (* g miss) total))) mean ph)
                (map (lambda (row g) (map (lambda (x h) (- x (/ (* g h) total))) row ph)) p ph))))))

(define (farthest a b)
  (cond ((pair? a) (apply max (map farthest a b)))
        (else (abs (- a b)))))

(define-scenario linear-readings-of-normal-numbers
  "Of numbers that are normal, by readings that are linear in them, a cloud becomes what Kalman's filter says; and so it
does by halves of the evidence."
  (let* ((normal (normals 'kalman)) (n 2000)
         (columns (times 3 (lambda () (times n normal))))
         (rows '((1.0 0.5 0.0) (0.0 -1.0 2.0))) (values '(1.2 -0.7)) (variance 0.25)
         (foretold (lambda (columns)
                     (map (lambda (row) (apply map (lambda z (product z row)) columns)) rows)))
         (once (moved columns (foretold columns) values variance 1.0))
         (half (moved columns (foretold columns) values variance 0.5))
         (twice (moved half (foretold half) values variance 0.5))
         (exact (kalman rows values variance)))
    (expect (farthest (moments once) exact) is (below 0.06))
    (expect (farthest (moments twice) (moments once)) is (below 0.02))
    (expect (farthest (moments columns) exact) is (above 0.5)))) ; the readings told something


;;; Ranks.  Of truths drawn as the members are, the rank of each truth among the members that went by its readings is as
;;; likely to be any other (Talts, Betancourt, Simpson, Vehtari and Gelman, arXiv 1804.06788, 2018).

(define members 32)
(define numbers 5)
(define readings 10)
(define noise 0.3)
(define chance 1.0)                     ; deviation of what no number explains of a reading, as where a line slips

(define (rank-of truth column)
  (count (lambda (z) (< z truth)) column))

(define (ranks-of-a-truth normal)
  (let* ((rows (times readings (lambda () (times numbers normal))))
         (read (lambda (z) (map (lambda (row) (+ (product row z) (* chance (normal)))) rows)))
         (truth (times numbers normal))
         (values (map (lambda (h) (+ h (* noise (normal)))) (read truth)))
         (cloud (times members (lambda () (times numbers normal))))
         (columns (apply map list cloud))
         (foretold (apply map list (map read cloud))))
    (map rank-of truth (moved columns foretold values (* noise noise) 1.0))))

(define (chi-square ranks bins)
  (let* ((width (/ (+ members 1) bins)) (expected (/ (length ranks) bins)))
    (fold (lambda (k sum)
            (+ sum (/ (expt (- (count (lambda (r) (= k (quotient r width))) ranks) expected) 2) expected)))
          0.0 (iota bins))))

(define-scenario truths-rank-evenly
  "Where much of each reading is chance, and the members are few, truths lie within the cloud as often as they should:
ranks are even, and those from 2 to 30 of 32 hold 29 in 33 truths."
  (let* ((normal (normals 'ranks))
         (ranks (append-map (lambda (k) (ranks-of-a-truth normal)) (iota 120)))
         (held (/ (count (lambda (r) (<= 2 r 30)) ranks) (length ranks))))
    (expect held is (about 29/33 #:within 0.04))
    (expect (chi-square ranks 11) is (below 29.6)))) ; 10 degrees of freedom: 0.999 of all lie below

(define make-answer (@@ (bight belief answer) make-answer))

(define-scenario an-interval-holds-as-often-as-it-says
  "Of a number drawn as 32 others are, the 90 % interval of these holds nine in ten; the half interval, one in two."
  (let* ((normal (normals 'intervals)) (n 32) (shares (times n (const (/ 1.0 n))))
         (held (lambda (share)
                 (let ((told (times 3000 (lambda ()
                                           (let ((i (answer-interval (make-answer 'number (times n normal) shares n 0) share)))
                                             (<= (car i) (normal) (cadr i)))))))
                   (/ (count identity told) (length told))))))
    (expect (held 0.9) is (about 0.9 #:within 0.016))
    (expect (held 0.5) is (about 0.5 #:within 0.03))))


;;; The tube.

(define (point-of-members points shares)
  (make-answer 'point points shares (/ 1 (apply + (map * shares shares))) 0))

(define-scenario (a-tube-holds-as-often-as-it-says n)
  "Of points drawn as N others are, whether normal or on a bent sheet, the 90 % ellipsoid of these holds nine in ten."
  #:for ((n 12 32))
  (let* ((normal (normals 'tubes)) (shares (times n (const (/ 1.0 n))))
         (bent (lambda () (let ((z (normal))) (f64vector z (+ (* z z) (* 0.3 (normal))) 0.0))))
         (held (lambda (draw)
                 (/ (count identity
                           (times 400 (lambda ()
                                        (let ((e (ellipsoid (point-of-members (times n draw) shares) 0.9)))
                                          (ellipsoid-holds? e (draw))))))
                    400))))
    (expect (held (lambda () (f64vector (normal) (normal) (normal)))) is (about 0.91 #:within 0.04))
    (expect (held bent) is (about 0.91 #:within 0.04))))

(define-scenario a-tube-of-little
  "Where one of eight members is off all others the ellipsoid ends, and not at any distance; where one bears all weight, or all
are at one place, it is a point, or what an error asks."
  (let* ((here (f64vector 1.0 2.0 3.0)) (there (f64vector 2.0 2.0 3.0)) (even (times 8 (const 0.125)))
         (longest (lambda (e) (let ((a (car (ellipsoid-axes e)))) (sqrt (apply + (map * (f64vector->list a) (f64vector->list a)))))))
         (alone (longest (ellipsoid (point-of-members (cons there (times 7 (const here))) even) 0.9))))
    (expect alone is (between 1 3))
    (expect (longest (ellipsoid (point-of-members (times 8 (const here)) even) 0.9)) is (below 1e-3))
    (expect (longest (ellipsoid (point-of-members (cons there (times 7 (const here))) (cons 1.0 (times 7 (const 0.0)))) 0.9))
            is (below 1e-3))
    (expect (longest (ellipsoid (point-of-members (times 8 (const here)) even) 0.8 0.1)) is (about 0.25 #:within 0.05))))


;;; In the minutes that there are.

(define-scenario as-many-truths-as-fit
  "A measurement ends with its minutes: what was under way is not told.  `bight bench' hands a bench of the language its
options, and refuses those that it has not."
  (let ((quietly (lambda (n minutes measure)
                   (parameterize ((current-error-port (%make-void-port "w")))
                     (as-many-as-fit "numbers" n (minutes-from-now minutes) measure)))))
    (expect (quietly 5 #f identity) => '(0 1 2 3 4))
    (expect (quietly 5 0 identity) => '())
    (expect (quietly 5 0.02 (lambda (k) (let loop () (when (and (= k 2) (in-time?)) (loop))) k)) is (lambda (all) (< (length all) 3)))
    (expect (share-of-time (minutes-from-now #f) 3) => +inf.0))
  (expect (bench-command '("belief" "--minutes" "soon")) raises domain)
  (expect (bench-command '("tours" "--minutes" "-1")) raises domain)
  (expect (bench-command '("belief" "--rounds" "3")) raises domain)
  (expect (run-belief '("--truths" "0")) raises domain)
  (expect (run-belief '("--truhts" "3")) raises domain)
  (expect (run-belief '("more")) raises domain))


;;; Courses: what two members with equal values do among obstacles.

(define weigh-by-course! (@@ (bight belief condition) weigh-by-course!))

(define-scenario courses-are-weighed
  "Of 32 equal members 12 foretold a pull of 5 N and were right, within 1 N: nearly all weight is theirs.  Were it two,
they are not believed so far that fewer than a third of the members count."
  (define (share-of-the-right right)
    (let* ((members (map (lambda (k) (make-member #f #f 0.0 0.0 #f #f 0.0)) (iota 32)))
           (reading (make-reading 1 0 'winch-tension 5.0 1.0 '(line) (f64vector 5.0)
                                  (map (lambda (k) (f64vector (if (< k right) 5.0 0.0))) (iota 32)) #f))
           (belief (make-belief-record #f '() '() 1 'smoother members 1 0 '() #f '() #f (list reading) '() '() 1)))
      (weigh-by-course! belief)
      (let ((shares (f64vector->list (weights belief))))
        (cons (apply + (list-head shares right)) (effective-number (weights belief))))))
  (expect (car (share-of-the-right 12)) is (above 0.99))
  (expect (share-of-the-right 2) is (lambda (both) (and (< 0.3 (car both) 0.5) (> (cdr both) 11)))))


;;; A rope that was measured.

(define folder
  (or (getenv "BIGHT_REFERENCE_DATA") (string-append (or (getenv "top_srcdir") ".") "/../shared/data")))

(define (printed . options)
  (string-split (with-output-to-string (lambda () (run-belief options))) #\newline))

(define-scenario a-measured-rope
  "Identified on the first half of a run in a tank, a rope is seen in the second where the 90 % tube is, which is at most 2.5
times as wide as the markers' own uncertainty asks.  Where the measurement is not, it is said."
  (if (file-exists? (string-append folder "/real/toulon_cable6_surge_0p6_0031.csv"))
      (let ((cells (map string->number (string-split (cadr (printed "--tank" "--tethers" "16")) #\,))))
        (expect (list-ref cells 0) => 16)
        (expect (list-ref cells 1) is (above 200))
        (expect (list-ref cells 3) is (between 0.85 0.95))
        (expect (list-ref cells 4) is (between 0.5 2.5)))
      (begin
        (expect (string-prefix? "skipped: " (car (printed "--tank"))))
        (skip "the reference data are not here"))))
