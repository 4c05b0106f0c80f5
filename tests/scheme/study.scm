;;; Studies: what they are made of, which cases they have, what their outcomes say.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(use-modules (bight study) (bight study case) (bight study sweep-design) (bight study risk) ((srfi srfi-1) #:hide (every)))

;; Studies are made here as a file makes them, in a module of their own.
(define (evaluate form)
  (let ((module (make-fresh-user-module)))
    (module-use! module (resolve-interface '(bight)))
    (eval form module)
    (module-ref module (cadr form))))

(define-syntax-rule (study clause ...)
  (evaluate '(define-study it "A study." clause ...)))

(define (cases s)
  (map (lambda (i) (case-values s i)) (iota (study-cases s))))

(define (message-of thunk)
  (with-exception-handler bight-error-message thunk #:unwind? #t))

(define-syntax-rule (says text form)
  ;; The error of FORM says TEXT.
  (let ((said (message-of (lambda () form))))
    (expect (and (string? said) (or (string-contains said text) said)) is exact-integer?)))


;;; Which cases there are.

(define-scenario listed-values-are-crossed
  "Lists are crossed, the last varying fastest, whatever way they are written."
  (let ((s (study #:for ((U 0.1 0.2) (way (grid 'in 'out)) (B (range 0 90 45)) (seed (seeds 2)))
                  (in open-water) (measure (t (now))))))
    (expect (study-cases s) => 24)
    (expect (take (cases s) 3) => '((0.1 in 0 1) (0.1 in 0 2) (0.1 in 45 1)))
    (expect (last (cases s)) => '(0.2 out 90 2))
    (expect (length (delete-duplicates (cases s))) => 24)))

(define-scenario no-variables-is-one-case
  "A study without variables is one dive."
  (expect (study-cases (study (in open-water) (measure (t (now))))) => 1))

(define (drawn kind n seed . more)
  ;; The U of each case of a study that draws it N times.
  (map car (cases (evaluate `(define-study it "A study."
                               #:for ((U (uniform 2 5)) ,@more)
                               (in open-water) (,kind ,n #:seed ,seed) (measure (t (now))))))))

(define (slices values low high)
  ;; How many of VALUES lie in each of as many equal slices of [LOW, HIGH].
  (let* ((n (length values)) (counts (make-vector n 0)))
    (for-each (lambda (v)
                (let ((i (inexact->exact (floor (* n (/ (- v low) (- high low)))))))
                  (vector-set! counts i (+ 1 (vector-ref counts i)))))
              values)
    (vector->list counts)))

(define (one-in-each? values low high)
  (and-map (lambda (count) (= 1 count)) (slices values low high)))

(define-scenario (latin-hypercubes-are-stratified n seed)
  "Each of N equal slices of a variable's range holds one of N points, in no order; drawn at random, not."
  #:for ((n 2 7 50 333) (seed 1 2 99))
  (let ((values (drawn 'latin-hypercube n seed)))
    (expect (one-in-each? values 2 5))
    (when (> n 2)
      (expect (sort values <) is (lambda (sorted) (not (equal? sorted values))))
      (expect (one-in-each? (drawn 'monte-carlo n seed) 2 5) => #f))))

(define-scenario latin-hypercubes-of-normal-variables
  "A normal variable has one value in each of N slices of equal probability."
  (let* ((n 40)
         (values (map cadr (cases (study #:for ((U (uniform 0 1)) (V (normal 3 0.5)))
                                         (latin-hypercube 40)
                                         (in open-water) (measure (t (now)))))))
         (bounds (map (lambda (i) (+ 3 (* 0.5 (normal-quantile (/ i n))))) (iota (- n 1) 1))))
    (expect (map (lambda (low high v) (<= low v high))
                 (cons -inf.0 bounds) (append bounds '(+inf.0)) (sort values <))
            => (make-list n #t))))

(define-scenario random-points-cross-lists
  "The points are drawn once, and every listed value meets them all."
  (let* ((all (cases (study #:for ((U (uniform 0 1)) (B 0 90) (pilot (one-of 'bold 'shy)))
                            (in open-water) (monte-carlo 30) (measure (t (now))))))
         (of (lambda (b) (map (lambda (case) (list (first case) (third case)))
                              (filter (lambda (case) (= b (second case))) all)))))
    (expect (length all) => 60)
    (expect (of 0) => (of 90))
    (expect (sort (map symbol->string (delete-duplicates (map third all))) string<?)
            => '("bold" "shy"))))

(define-scenario seeds-tell-the-points
  "The same seed gives the same points, another gives others, and more points leave the first as they were."
  (expect (drawn 'monte-carlo 20 4) => (drawn 'monte-carlo 20 4))
  (expect (equal? (drawn 'monte-carlo 20 4) (drawn 'monte-carlo 20 5)) => #f)
  (expect (take (drawn 'monte-carlo 50 4) 20) => (drawn 'monte-carlo 20 4)))

(define (largest-gap values)
  ;; Kolmogorov's distance of VALUES, between 0 and 1, from the uniform distribution.
  (let ((n (length values)))
    (apply max (append-map (lambda (v i) (list (abs (- v (/ i n))) (abs (- v (/ (+ i 1) n)))))
                           (sort values <) (iota n)))))

(define (correlation a b)
  (let* ((n (length a)) (mean (lambda (l) (/ (apply + l) n))) (ma (mean a)) (mb (mean b))
         (sum (lambda (f x mx y my) (apply + (map (lambda (u v) (* (- u mx) (- v my))) x y)))))
    (/ (sum * a ma b mb) (sqrt (* (sum * a ma a ma) (sum * b mb b mb))))))

(define-scenario random-numbers-are-uniform-and-independent
  "Kolmogorov's test at 1 % and no correlation between variables, numbers and their neighbours."
  (let* ((n 2000)
         (u (list-tabulate n (number-stream 1 'U)))
         (v (list-tabulate n (number-stream 1 'V)))
         (w (list-tabulate n (number-stream 2 'U))))
    (for-each (lambda (values)
                (expect (largest-gap values) is (below (/ 1.63 (sqrt n))))
                (expect (abs (correlation (drop values 1) (drop-right values 1)))
                        is (below (/ 3 (sqrt n)))))
              (list u v w))
    (expect (abs (correlation u v)) is (below (/ 3 (sqrt n))))
    (expect (abs (correlation u w)) is (below (/ 3 (sqrt n))))
    (expect (largest-gap (map (lambda (x) (* x x)) u)) is (above 0.2))))

(define-scenario published-random-numbers
  "The stream is splitmix64, which is published with its first numbers for the seed 1234567."
  (expect ((@@ (bight study sweep-design) mixed) (+ 1234567 #x9e3779b97f4a7c15)) => 6457827717110365317))

(define pi (acos -1))

(define (normal-share z)
  ;; The normal distribution by Simpson's rule from 0 to Z.
  (let* ((n 2000) (h (/ z n)) (f (lambda (x) (exp (* -0.5 x x)))))
    (+ 0.5 (* (/ h 3 (sqrt (* 2 pi)))
              (apply + (map (lambda (i)
                              (* (cond ((or (= i 0) (= i n)) 1) ((odd? i) 4) (else 2)) (f (* i h))))
                            (iota (+ n 1))))))))

(define-scenario (normal-quantiles share)
  "The normal quantile undoes the integral of the normal density."
  #:for ((share 1e-7 0.001 0.025 0.07 0.3 0.5 0.61 0.93 0.999))
  (expect (normal-share (normal-quantile share)) is (about share #:within 1e-12)))

(define-scenario normal-quantiles-of-the-tail
  "Far out, a table to ten digits (Abramowitz and Stegun, and others since)."
  (expect (normal-quantile 0.975) is (about 1.959963984540054 #:within 1e-13))
  (expect (normal-quantile 1e-10) is (about -6.361340902404056 #:within 1e-9))
  (expect (normal-quantile 1e-100) is (about -21.27345350 #:within 1e-6)))

(define-scenario fingerprints
  "Texts that differ have other fingerprints; the same text has the same."
  (let ((texts (append-map (lambda (i) (list (number->string i) (number->string (/ i 7.0))))
                           (iota 5000 1))))
    (expect (length (delete-duplicates texts))
            => (let ((table (make-hash-table)))
                 (for-each (lambda (t) (hash-set! table (fingerprint t) #t)) texts)
                 (hash-count (const #t) table))))
  (expect (fingerprint "abc") => (fingerprint (string #\a #\b #\c)))
  (expect (equal? (fingerprint "abc") (fingerprint "acb")) => #f))


;;; A case.

(define two-legs
  '(define-study two-legs "Out and on."
     #:for ((U 0 0.2) (seed (seeds 2)))
     (in (with open-water (current U 90)))
     (define push (/ U 10))
     (leg out (drive! #:surge (random 1.0)) (run 0.5))
     (fly (run 0.25))
     (leg on (run 0.25))
     (measure (t (now)) (push push))
     (measure (far? (> (now) 0.8)) (speed (rov-speed)))))

(define-scenario a-case-is-a-dive
  "A case flies its clauses in order in its own world, and measures after each leg and at the end."
  (let* ((found (run-case (evaluate two-legs) 3))
         (legs (assq-ref found 'legs)))
    (expect (assq-ref found 'U) => 0.2)
    (expect (assq-ref found 'seed) => 1)
    (expect (assq-ref found 't) is (about 1 #:within 1e-9))
    (expect (assq-ref found 'push) => 0.02)
    (expect (map car legs) => '(out on))
    (expect (assq-ref (assq-ref legs 'out) 't) is (about 0.5 #:within 1e-9))
    (expect (map (lambda (leg) (assq-ref (cdr leg) 'far?)) legs) => '(#f #t))))

(define-scenario a-case-depends-on-its-values-alone
  "What is random in a case is the same whenever and after whatever it is flown, and other in another."
  (let* ((s (evaluate two-legs)) (before (run-case s 2)))
    (random 10)
    (run-case s 1)
    (expect (run-case s 2) => before)
    (expect (equal? (assq-ref (run-case s 1) 'speed) (assq-ref before 'speed)) => #f)))

(define-scenario a-case-leaves-the-present-dive
  "Looking at a case does not touch the dive of who looks."
  (in tank)
  (run 1)
  (run-case (evaluate two-legs))
  (expect (now) is (about 1 #:within 1e-9)))


;;; Mistakes.

(define-scenario mistakes-in-studies
  "What is written wrong is told with its place, what is allowed and the nearest thing meant."
  (says "a study has no clause `sail'; it has in, define, fly, leg, measure"
        (study (in tank) (sail) (measure (t (now)))))
  (says "a study has no clause `mesure'; did you mean (measure (NAME E) ...)?"
        (study (in tank) (mesure (t (now)))))
  (says "say (leg NAME FORM ...), not (leg)" (study (in tank) (leg) (measure (t (now)))))
  (says "say (leg NAME FORM ...), not (leg (run 1))"
        (study (in tank) (leg (run 1)) (measure (t (now)))))
  (says "say (measure (NAME E) ...), not (measure now)" (study (in tank) (measure now)))
  (says "written (NAME ...), not 3" (study (in tank) 3 (measure (t (now)))))
  (says "needs (in WORLD)" (study (measure (t (now)))))
  (says "needs (measure (NAME E) ...)" (study (in tank)))
  (says "a variable has no draw `unifrom'; it has uniform"
        (study #:for ((U (unifrom 0 1))) (in tank) (measure (t (now)))))
  (says "U is drawn by (uniform LOW HIGH), of numbers, LOW below HIGH, not by (uniform 1 0)"
        (study #:for ((U (uniform 1 0))) (in tank) (monte-carlo 3) (measure (t (now)))))
  (says "say (monte-carlo N) or (latin-hypercube N)"
        (study #:for ((U (uniform 0 1))) (in tank) (measure (t (now)))))
  (says "no variable is uniform, normal or one-of"
        (study #:for ((U 1 2)) (in tank) (monte-carlo 3) (measure (t (now)))))
  (says "say (monte-carlo N) or (monte-carlo N #:seed S), not (monte-carlo 3 #:sed 4)"
        (study #:for ((U (uniform 0 1))) (in tank) (monte-carlo 3 #:sed 4) (measure (t (now)))))
  (says "status is a column of every result" (study (in tank) (measure (status 1))))
  (says "names two columns" (study #:for ((u 1 2)) (in tank) (measure (U 1))))
  (says "two legs have one name" (study (in tank) (leg a) (leg a) (measure (t (now)))))
  (says "(at-most SECONDS) needs a number above 0, not -1"
        (study (in tank) (at-most -1) (measure (t (now)))))
  (says "(together N) needs a whole number from 1 to 1000, not 0"
        (study (in tank) (together 0) (measure (t (now)))))
  (says "the study has 1001000 cases, more than 1000000"
        (study #:for ((a (seeds 1001)) (b (seeds 1000))) (in tank) (measure (t (now))))))

(define-scenario mistakes-in-cases
  "A case that is not there, a measure that no column can hold."
  (let ((s (evaluate two-legs)))
    (says "has 4 cases; there is no case 5" (run-case s 5))
    (expect (run-case s 0) raises domain))
  (says "where is a number, true or false, a symbol or a string, not"
        (run-case (study (in tank) (measure (where (rov-position)))))))


;;; What outcomes say.

(define-scenario wilson-s-intervals
  "Wilson's intervals of Newcombe's table (Statistics in Medicine 17, 1998); all hits by symmetry."
  (for-each
   (lambda (row)
     (let ((found (wilson-interval (first row) (second row))))
       (expect (first found) is (about (third row) #:within 6e-5))
       (expect (second found) is (about (fourth row) #:within 6e-5))))
   '((81 263 0.2553 0.3662) (15 148 0.0624 0.1605) (0 20 0 0.1611) (1 29 0.0061 0.1718) (20 20 0.8389 1)))
  (expect (wilson-interval 0 0) => '(0.0 1.0))
  (expect (wilson-interval 3 2) raises domain))

(define-scenario wilson-s-law
  "At either end the share seen is 1.96 standard deviations away."
  (for-each
   (lambda (hits)
     (for-each (lambda (p)
                 (expect (/ (abs (- p (/ hits 30))) (sqrt (/ (* p (- 1 p)) 30)))
                         is (about 1.959963984540054 #:within 1e-9)))
               (wilson-interval hits 30)))
   '(1 7 15 29)))

(define-scenario numbers-in-tables
  "A number in a table has three digits that count."
  (expect (map short '(0.123456 12.3456 1234.5 12 0 -0.00123456 12345678.9 #f wound))
          => '("0.123" "12.3" "1230" "12" "0" "-0.00123" "12300000" "" "wound")))
