;;; (bight bench belief) --- `bight bench belief': is a belief as sure as it may be, and what does it cost?
;;;
;;; With `--tank' the truth is a measured rope: (bight bench belief-tank).  Else truths are drawn as the members are, from another seed, and flown by the same orders round the head of a post
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
  #:use-module (bight bench belief-tank)
  #:use-module ((bight bench plot) #:select (draw-line draw-on-decades draw-text))
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
  --tethers N   one number of tethers alone; 8 to 256 by doubling when left out, 64 with --quick
  --minutes M   with --learn: of each number of tethers no more truths than fit into M minutes
  --plot FILE   draw, as SVG, how much of the true line is outside the tube over CPU time, a point for each number of tethers
  --learn       let each belief go by readings of tension first, on a shorter dive, at 2 s of CPU for 32 tethers
  --by HOW      learn by smoother or by particles
  --cost        the cost of a step, and of a minute with readings, alone
  --tank        a measured rope instead of drawn truths: identified on the first half of a run, looked for in the second
")

(define valued '("--truths" "--tethers" "--by" "--minutes" "--plot"))
(define flags '("--learn" "--quick" "--cost" "--tank" "--help"))

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

(define (learnt-verdict dive tethers truth number by)
  (let ((belief (believer dive tethers (+ 1 number) by)))
    (fly-belief! dive belief truth number #t)
    (judge belief truth)))

(define (verdicts dive tethers truths learn? by until)
  ;; Of as many of TRUTHS as are begun before the time UNTIL.
  (if learn?
      (let loop ((rest truths) (number 0) (found '()))
        (if (or (null? rest) (and (pair? found) (>= (current-time) until)))
            (reverse! found)
            (loop (cdr rest) (+ number 1) (cons (learnt-verdict dive tethers (car rest) number by) found))))
      (let ((belief (believer dive tethers 1 by)))
        (fly-belief! dive belief (car truths) 0 #f)
        (map (lambda (truth) (judge belief truth)) truths))))

(define (say-row dive tethers truths learn? by minutes)
  ;; Return (TETHERS SECONDS-A-TRUTH SHARE-HELD).
  (let* ((begun (cpu))
         (all (verdicts dive tethers truths learn? by (+ (current-time) (* 60 minutes))))
         (held (share (append-map first all)))
         (point (fouled?)))             ; of the dive that nothing is uncertain of
    (simple-format #t "~a,~a,~a,~a,~a,~a,~a,~a,~a,\"~a\",\"~a\"~%" tethers (length all) (if learn? by 'nothing)
                   held (share (append-map second all)) (share (map third all))
                   (brier (map (lambda (v) (cons (fourth v) (fifth v))) all))
                   (brier (map (lambda (v) (cons (if point 1 0) (fifth v))) all))
                   (/ (round (* 100 (- (cpu) begun))) 100) (reliability all) (by-tenths (append-map sixth all)))
    (force-output)
    (list tethers (/ (- (cpu) begun) (length all)) held)))

(define asked 0.9)

(define (coverage-svg rows)
  ;; Of ROWS, as `say-row' returns them.
  (define (outside row) (max 0.001 (- 1 (third row))))
  (draw-on-decades "The true line beside the 90 % tube" (map second rows) (cons (- 1 asked) (map outside rows))
                   "CPU s for a truth" "share outside the tube"
    (lambda (port x y)
      (let ((all (map second rows)) (level (y (- 1 asked))))
        (draw-line port (x (apply min all)) level (x (apply max all)) level "stroke='#57606a' stroke-dasharray='4 3'"))
      (for-each (lambda (row)
                  (let ((at (x (second row))) (up (y (outside row))))
                    (simple-format port "<circle cx='~a' cy='~a' r='4' fill='#1f6feb'/>~%" at up)
                    (draw-text port (+ at 8) up (simple-format #f "~a tethers" (first row)))))
                rows))))

(define (write-coverage file rows)
  (call-with-output-file file (lambda (port) (display (coverage-svg rows) port))))


;;; What a step costs.

(define (time-of thunk)
  (let ((begun (cpu)))
    (thunk)
    (- (cpu) begun)))

(define turns 20)

(define (enter-jacket!)
  (enter! (extend (without (find-world 'jacket) 'line)
                  (part tether (named line) (type fathom) (wet-weight 0) (friction 0.6) (model dynamic)
                        (nodes 50) (from 0 -22 -3) (to minnow) (length 60)))))

(define (say-cost)
  ;; A belief in a jacket and a dive alone, by turns of a second each; one thread, so that CPU time is what is told.
  (let* ((dive (enter-jacket!))
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

(define minute 60)                      ; s

(define (say-live-cost)
  ;; A belief in a jacket that goes by two tensions a second and is asked every second, for a minute.
  (let* ((dive (enter-jacket!)) (before (list (cpu) (get-internal-real-time)))
         (b (make-belief dive '((current (error 0.1)) (line (cdn (uniform 1 1.6)))) #:members 64)))
    (drive! #:surge 0.5)
    (for-each (lambda (k)
                (run 1)
                (observe-second! b 0 (tensions-now))
                (ask-belief b fouled?))
              (iota minute))
    (simple-format #t "the same going by two tensions a second and asked every second, for ~a s: ~a s of CPU, ~a s by the clock with ~a threads; mended ~a times~%"
                   minute (round (- (cpu) (first before)))
                   (round (/ (- (get-internal-real-time) (second before)) internal-time-units-per-second 1.0))
                   (belief-threads-of b) (length (assq-ref (belief-about b) 'mended)))))

(define (run-belief arguments)
  "Do what ARGUMENTS of the bench belief ask for, print what came of it and return the exit status."
  (let* ((options (read-options arguments))
         (quick? (assoc-ref options "--quick"))
         (by (string->symbol (or (assoc-ref options "--by") "smoother"))))
    (cond ((assoc-ref options "--help") (display help))
          ((assoc-ref options "--cost") (say-cost) (say-live-cost))
          ((assoc-ref options "--tank")
           (say-tank (if (assoc "--tethers" options) (list (whole options "--tethers" 64)) '(32 64 128))))
          (else
           (let* ((learn? (assoc-ref options "--learn")) (dive (if learn? short-dive long-dive))
                  (truths (fly-truths dive (whole options "--truths" (if quick? 20 400)))))
             (display "tethers,truths,learnt by,held by the 90 % tube,current covered,cdn covered,brier,\
brier of the dive alone,cpu s,\"reliability: (told true cases) ...\",ranks by tenths\n")
             (let ((rows (map-in-order (lambda (tethers)
                                         (say-row dive tethers truths learn? by (whole options "--minutes" 100000)))
                                       (if (or quick? (assoc "--tethers" options))
                                           (list (whole options "--tethers" 64))
                                           '(8 16 32 64 128 256)))))
               (when (assoc-ref options "--plot")
                 (write-coverage (assoc-ref options "--plot") rows))))))
    0))
