;;; (bight bench belief) --- `bight bench belief': is a belief as sure as it may be, and what does it cost?
;;;
;;; Truths are drawn as the members are, from another seed, and flown by the same orders round the head of a post
;;; that the line may or may not slip over; a shorter way round a lower one where beliefs learn.  Each row is of one
;;; number of tethers: the share of the true line that the 90 % tube holds, of true values within their 90 % intervals,
;;; the Brier score of P(fouled) beside that of the dive without a belief, CPU time, and how many truths lie in each
;;; tenth of the members by rank: as many as there are ranks in it, where the belief is as sure as it may be (Talts, Betancourt, Simpson,
;;; Vehtari and Gelman, arXiv 1804.06788, 2018).
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(define-module (bight bench belief)
  #:use-module (bight belief)
  #:use-module (bight belief answer)
  #:use-module (bight belief cloud)
  #:use-module (bight belief unknowns)
  #:use-module ((bight core decimal) #:select (text->number))
  #:use-module (bight core errors)
  #:use-module (bight dive)
  #:use-module ((bight dive aware) #:select (fouled?))
  #:use-module (bight dive command)
  #:use-module (bight dive query)
  #:use-module (bight dive time)
  #:use-module (bight engine)
  #:use-module (bight study sweep-design)
  #:use-module (bight world)
  #:use-module (srfi srfi-1)
  #:use-module (srfi srfi-4)
  #:export (run-belief))

(define help "bight bench belief: how often beliefs are right, and what they cost
  --truths N    of each number of tethers, 400 when left out, 20 with --quick
  --tethers N   one number of tethers alone; 16, 32, 64 and 128 when left out, 64 with --quick
  --learn       let each belief go by readings of tension first, on a shorter dive, at 2 s of CPU for 32 tethers
  --by HOW      learn by smoother or by particles
  --cost        the cost of a step alone
")

(define valued '("--truths" "--tethers" "--by"))
(define flags '("--learn" "--quick" "--cost" "--help"))

(define (read-options arguments)
  (let loop ((rest arguments) (found '()))
    (cond ((null? rest) found)
          ((member (car rest) flags) (loop (cdr rest) (acons (car rest) #t found)))
          ((not (member (car rest) valued))
           (bight-raise 'domain 'bench "the bench belief has ~a, not ~a" (string-join (append valued flags) ", ")
                        (car rest)))
          ((null? (cdr rest)) (bight-raise 'domain 'bench "~a needs a value after it" (car rest)))
          (else (loop (cddr rest) (acons (car rest) (cadr rest) found))))))

(define (whole options name default)
  (let* ((text (assoc-ref options name)) (n (if text (text->number text) default)))
    (unless (and (exact-integer? n) (> n 0))
      (bight-raise 'domain 'bench "~a takes a whole number above 0, not ~a" name text))
    n))


;;; The dive.

(define post-field
  (world (sea (depth 20) (current 0.25 90))
         (seabed (friction 0.5))
         (cylinder (named post) (from 3 6 -4.65) (to 3 6 -20) (radius 0.3))
         (rov (named minnow) (type kinematic) (at 0 12 -8) (heading 0))
         (tether (named line) (type fathom) (wet-weight 0) (model dynamic) (nodes 24) (from 0 0 -2) (to minnow)
                 (length 18))))

(define low-post-field
  (world (sea (depth 20) (current 0.25 90))
         (seabed (friction 0.5))
         (cylinder (named post) (from 3 6 -5.15) (to 3 6 -20) (radius 0.3))
         (rov (named minnow) (type kinematic) (at 3.5 11 -8) (heading 0))
         (tether (named line) (type fathom) (wet-weight 0) (model dynamic) (nodes 10) (from 0 0 -2) (to minnow)
                 (length 15))))

(define doubts
  '((current (error 0.1) (levels 0 -20) (correlation 20))
    (line (cdn (uniform 1 1.6)) (wet-weight (normal 0 0.03)))
    (post (friction (uniform 0.1 0.6)))
    (payout (normal 0 0.2))))

;; A dive: its world, how many seconds it lasts, and orders, each (SECOND PLACE SPEED).
(define make-dive list)
(define dive-field first)
(define dive-seconds second)
(define dive-orders third)

(define long-dive (make-dive post-field 30 '((0 (9 6 -8) 0.5) (15 (7 2 -8) 0.5))))
(define short-dive (make-dive low-post-field 9 '((0 (9 6 -8) 1) (5 (7 1.5 -8) 1))))

(define noise 0.3)                      ; N, of both tensions
(define places 25)                      ; along the line

(define (fly-second! dive k)
  ;; The second number K of DIVE, from 0.
  (let ((order (assv k (dive-orders dive))))
    (when order
      (move! (second order) #:speed (third order)))
    (run 1)))

(define (tensions-now)
  (list (anchor-tension) (rov-tension)))

(define (fly-truths dive n)
  ;; A list for each of N truths: values of what is uncertain, the line, is it fouled, tensions by the second, latent
  ;; numbers.
  (enter! (dive-field dive))
  (let ((all (make-belief (current-dive) doubts #:members (max 8 n) #:seed 1001)))
    (let loop ((k 0) (read '()))
      (if (< k (dive-seconds dive))
          (begin
            (fly-second! dive k)
            (loop (+ k 1) (cons (answer-values (ask-belief all tensions-now)) read)))
          (map (lambda (member i)
                 (list (unknown-values (belief-unknowns all) (member-latent member))
                       (in-member member (lambda () (tether-points places)))
                       (in-member member fouled?)
                       (map (lambda (second) (list-ref second i)) (reverse read))
                       (member-latent member)))
               (list-head (belief-members all) n) (iota n))))))

(define (believer dive tethers seed by)
  (enter! (dive-field dive))
  (make-belief (current-dive) doubts #:members tethers #:seed seed #:by by))

(define (observe-second! belief number tensions)
  ;; NUMBER names the stream of the noise.
  (let ((random (number-stream 'tension number (now))))
    (for-each (lambda (kind value i)
                (observe! belief kind (+ value (* noise (normal-quantile (random i)))) #:noise noise))
              '(winch-tension rov-tension) tensions '(0 1))))

(define (fly-belief! dive belief truth number learn?)
  (for-each (lambda (k tensions)
              (fly-second! dive k)
              (when learn? (observe-second! belief number tensions)))
            (iota (dive-seconds dive)) (fourth truth)))


;;; How right it is.

(define (covers? answer value)
  (let ((interval (answer-interval answer)))
    (<= (first interval) value (second interval))))

(define (current-rows values) (filter (lambda (entry) (eq? 'current (car entry))) values))

(define (ranks belief latent)
  ;; Of each number of LATENT the share of the members of BELIEF in which it is less.
  (let ((members (living belief)) (shares (f64vector->list (weights belief))))
    (map (lambda (k)
           (fold (lambda (m w sum) (if (< (f64vector-ref (member-latent m) k) (f64vector-ref latent k)) (+ sum w) sum))
                 0.0 members shares))
         (iota (f64vector-length latent)))))

(define (judge belief truth)
  ;; (HELD CURRENT-COVERED CDN-COVERED PROBABILITY FOULED? RANKS), the first two and the last lists.
  (let ((values (belief-values belief)) (true (first truth)))
    (list (tube-holds? (second truth) #:belief belief)
          (append-map (lambda (told row) (map covers? (cddr told) (cdr row)))
                      (current-rows values) (assq-ref true 'current))
          (covers? (assq-ref values 'line.cdn) (assq-ref true 'line.cdn))
          (answer-probability (ask-belief belief fouled?))
          (third truth)
          (ranks belief (fifth truth)))))

(define (by-tenths shares)
  (map (lambda (k) (count (lambda (r) (= k (min 9 (inexact->exact (floor (* 10 r)))))) shares)) (iota 10)))

(define (share items)
  (/ (round (* 1000.0 (/ (count identity items) (length items)))) 1000))

(define (brier pairs)
  ;; Of pairs (PROBABILITY . OUTCOME) (Brier, Monthly Weather Review 78, 1950).
  (/ (round (* 1e4 (/ (apply + (map (lambda (p) (expt (- (car p) (if (cdr p) 1 0)) 2)) pairs)) (length pairs)))) 1e4))

(define (reliability verdicts)
  ;; By fifths of the probability: (MEAN-TOLD SHARE-TRUE HOW-MANY).
  (filter-map (lambda (k)
                (let ((those (filter (lambda (v) (= k (min 4 (inexact->exact (floor (* 5 (fourth v))))))) verdicts)))
                  (and (pair? those)
                       (list (/ (round (* 100 (/ (apply + (map fourth those)) (length those)))) 100)
                             (share (map fifth those)) (length those)))))
              (iota 5)))

(define (cpu) (/ (get-internal-run-time) (exact->inexact internal-time-units-per-second)))

(define (verdicts dive tethers truths learn? by)
  (if learn?
      (map (lambda (truth number)
             (let ((belief (believer dive tethers (+ 1 number) by)))
               (fly-belief! dive belief truth number #t)
               (judge belief truth)))
           truths (iota (length truths)))
      (let ((belief (believer dive tethers 1 by)))
        (fly-belief! dive belief (car truths) 0 #f)
        (map (lambda (truth) (judge belief truth)) truths))))

(define (say-row dive tethers truths learn? by)
  (let* ((begun (cpu))
         (all (verdicts dive tethers truths learn? by))
         (point (fouled?)))             ; of the dive that nothing is uncertain of
    (simple-format #t "~a,~a,~a,~a,~a,~a,~a,~a,~a,\"~a\",\"~a\"~%" tethers (length truths) (if learn? by 'nothing)
                   (share (append-map first all)) (share (append-map second all)) (share (map third all))
                   (brier (map (lambda (v) (cons (fourth v) (fifth v))) all))
                   (brier (map (lambda (v) (cons (if point 1 0) (fifth v))) all))
                   (/ (round (* 100 (- (cpu) begun))) 100) (reliability all) (by-tenths (append-map sixth all)))
    (force-output)))


;;; What a step costs.

(define (time-of thunk)
  (let ((begun (cpu)))
    (thunk)
    (- (cpu) begun)))

(define turns 20)

(define (say-cost)
  ;; A belief in a jacket and a dive alone, by turns of a second each; one thread, so that CPU time is what is told.
  (let* ((dive (enter! (extend (without (find-world 'jacket) 'line)
                               (part tether (named line) (type fathom) (wet-weight 0) (friction 0.6) (model dynamic)
                                     (nodes 50) (from 0 -22 -3) (to minnow) (length 60)))))
         (b (make-belief dive '((line (cdn (normal 1.2 0.001)))) #:members 64))
         (alone (begin (drive! #:surge 0.5) (engine-of (fork-dive dive)))))
    (belief-threads! 1 b)
    (let loop ((k 0) (one 0.0) (all 0.0))
      (if (< k turns)
          (loop (+ k 1)
                (begin (run 1) (+ one (time-of (lambda () (%step-dive! alone 60)))))
                (+ all (time-of (lambda () (effective-size b)))))
          (simple-format #t "64 tethers of 50 nodes in a jacket: a member's step costs ~a of the single dive's; a \
second of all takes ~a s of CPU~%"
                         (/ (round (* 100 (/ all one 64))) 100) (/ (round (* 100 (/ all turns))) 100))))))

(define (run-belief arguments)
  "Do what ARGUMENTS of the bench belief ask for, print what came of it and return the exit status."
  (let* ((options (read-options arguments))
         (quick? (assoc-ref options "--quick"))
         (by (string->symbol (or (assoc-ref options "--by") "smoother"))))
    (cond ((assoc-ref options "--help") (display help))
          ((assoc-ref options "--cost") (say-cost))
          (else
           (let* ((learn? (assoc-ref options "--learn")) (dive (if learn? short-dive long-dive))
                  (truths (fly-truths dive (whole options "--truths" (if quick? 20 400)))))
             (display "tethers,truths,learnt by,held by the 90 % tube,current covered,cdn covered,brier,\
brier of the dive alone,cpu s,\"reliability: (told true cases) ...\",ranks by tenths\n")
             (for-each (lambda (tethers) (say-row dive tethers truths learn? by))
                       (if (or quick? (assoc "--tethers" options))
                           (list (whole options "--tethers" 64))
                           '(16 32 64 128))))))
    0))
