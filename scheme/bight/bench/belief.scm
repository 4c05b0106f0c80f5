;;; (bight bench belief) --- `bight bench belief': is a belief as sure as it may be, and what does it cost?
;;;
;;; With `--tank' the truth is a measured rope: (bight bench belief-tank).  Else truths are drawn as the members are, from
;;; other seeds, and flown by the same orders round the head of a post that the line may or may not slip over; a shorter way
;;; round a lower one where beliefs learn.  Each row is of one number of tethers: how many truths there were time for, the
;;; share of the true line that the 90 % tube holds, of true values within their 90 % intervals, the Brier score of
;;; P(fouled) beside that of the dive without a belief, CPU time, and how many truths lie in each tenth of the members by
;;; rank: as many as there are ranks in it, where the belief is as sure as it may be (Talts, Betancourt, Simpson, Vehtari
;;; and Gelman, arXiv 1804.06788, 2018).
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(define-module (bight bench belief)
  #:use-module (bight belief)
  #:use-module (bight belief answer)
  #:use-module (bight belief cloud)
  #:use-module (bight belief unknowns)
  #:use-module (bight bench belief-tank)
  #:use-module (bight bench in-time)
  #:use-module (bight bench options)
  #:use-module ((bight bench plot) #:select (draw-line draw-on-decades draw-text))
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
  --minutes M   M minutes by the clock for all: of each number of tethers as many truths as fit
  --plot FILE   draw, as SVG, how much of the true line is outside the tube over CPU time, a point for each number of tethers
  --learn       let each belief go by readings of tension first, on a shorter dive, at 2 s of CPU for 32 tethers
  --by HOW      learn by smoother or by particles
  --cost        the cost of a step, and of a minute with readings, alone
  --tank        a measured rope instead of drawn truths: identified on the first half of a run, looked for in the second
")

(define valued '("--truths" "--tethers" "--by" "--minutes" "--plot"))
(define flags '("--learn" "--quick" "--cost" "--tank" "--help"))


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
    (in-time?)
    (run 1)))

(define (tensions-now)
  (list (anchor-tension) (rov-tension)))

(define at-once 20)                     ; truths that are drawn and flown together

(define (fly-truths dive seed)
  ;; A vector of truths, each a list: values of what is uncertain, the line, is it fouled, tensions by the second, latent
  ;; numbers.
  (enter! (dive-field dive))
  (let ((all (make-belief (current-dive) doubts #:members at-once #:seed seed)))
    (let loop ((k 0) (read '()))
      (if (< k (dive-seconds dive))
          (begin
            (fly-second! dive k)
            (loop (+ k 1) (cons (answer-values (ask-belief all tensions-now)) read)))
          (list->vector
           (map (lambda (member i)
                  (list (unknown-values (belief-unknowns all) (member-latent member))
                        (in-member member (lambda () (tether-points places)))
                        (in-member member fouled?)
                        (map (lambda (second) (list-ref second i)) (reverse read))
                        (member-latent member)))
                (belief-members all) (iota at-once)))))))

(define first-seed 100001)              ; of truths; those of beliefs are smaller

(define (truths-of dive)
  ;; A procedure that returns truth number K of DIVE, flown when it is first asked for.
  (let ((known (make-hash-table)))
    (lambda (k)
      (let ((some (quotient k at-once)))
        (unless (hash-ref known some)
          (hash-set! known some (fly-truths dive (+ first-seed some))))
        (vector-ref (hash-ref known some) (modulo k at-once))))))

(define (fouled-alone? dive)
  ;; Is the line fouled after DIVE, where nothing is uncertain?
  (enter! (dive-field dive))
  (for-each (lambda (k) (fly-second! dive k)) (iota (dive-seconds dive)))
  (fouled?))

(define (believer dive tethers seed by)
  (enter! (dive-field dive))
  (make-belief (current-dive) doubts #:members tethers #:seed seed #:by by))

(define (observe-second! belief number tensions)
  ;; NUMBER names the stream of the noise.
  (let ((random (number-stream 'tension number (now))))
    (for-each (lambda (kind value i)
                (observe! belief kind (+ value (* noise (normal-quantile (random i)))) #:noise noise))
              '(winch-tension rov-tension) tensions '(0 1))))

(define (fly-belief! dive belief look!)
  ;; LOOK! is called after each second, with its number.
  (for-each (lambda (k)
              (fly-second! dive k)
              (look! k)
              (effective-size belief))  ; it is there, too
            (iota (dive-seconds dive))))


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
  ;; Of a belief that went by what was read in TRUTH, which has NUMBER.
  (let ((belief (believer dive tethers (+ 1 number) by)))
    (fly-belief! dive belief
                 (lambda (k) (observe-second! belief number (list-ref (fourth truth) k))))
    (judge belief truth)))

(define (judge-of dive tethers truth-of learn? by)
  ;; A procedure that returns the verdict about the truth of a number.
  (if learn?
      (lambda (number) (learnt-verdict dive tethers (truth-of number) number by))
      (let ((belief #f))
        (lambda (number)
          (let ((truth (truth-of number)))
            (unless belief
              (let ((new (believer dive tethers 1 by)))
                (fly-belief! dive new (const #t))
                (set! belief new)))
            (judge belief truth))))))

(define heads "tethers,truths,learnt by,held by the 90 % tube,current covered,cdn covered,brier,\
brier of the dive alone,cpu s,\"reliability: (told true cases) ...\",ranks by tenths\n")

(define (say-row tethers all how point seconds)
  ;; ALL are verdicts about truths, POINT whether the dive is fouled of which nothing is uncertain.
  (simple-format #t "~a,~a,~a,~a,~a,~a,~a,~a,~a,\"~a\",\"~a\"~%" tethers (length all) how
                 (share (append-map first all)) (share (append-map second all)) (share (map third all))
                 (brier (map (lambda (v) (cons (fourth v) (fifth v))) all))
                 (brier (map (lambda (v) (cons (if point 1 0) (fifth v))) all))
                 (/ (round (* 100 seconds)) 100) (reliability all) (by-tenths (append-map sixth all)))
  (force-output))

(define (measure-row dive tethers truth-of n learn? by point end)
  ;; Return (TETHERS SECONDS-A-TRUTH SHARE-HELD), or #f where no truth fitted into the time until END.
  (let* ((begun (cpu))
         (all (as-many-as-fit (simple-format #f "~a tethers, truths" tethers) n end
                              (judge-of dive tethers truth-of learn? by)))
         (seconds (- (cpu) begun)))
    (cond ((null? all)
           (simple-format #t "~a,0~%" tethers)
           #f)
          (else
           (say-row tethers all (if learn? by 'nothing) point seconds)
           (list tethers (/ seconds (length all)) (share (append-map first all)))))))

(define (measure-rows dive counts n learn? by minutes)
  ;; A row of each of COUNTS, numbers of tethers, as far as MINUTES reach.
  (let ((end (minutes-from-now minutes)) (truth-of (truths-of dive)) (point (fouled-alone? dive)))
    (display heads)
    (force-output)
    (let loop ((rest counts) (found '()))
      (if (null? rest)
          (reverse! found)
          (let ((row (measure-row dive (car rest) truth-of n learn? by point (share-of-time end (length rest)))))
            (loop (cdr rest) (if row (cons row found) found)))))))

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
  (let* ((options (bench-options "belief" valued flags arguments))
         (quick? (assoc-ref options "--quick"))
         (by (string->symbol (or (assoc-ref options "--by") "smoother")))
         (tethers (whole options "--tethers" 64 8 4096))
         (truths (whole options "--truths" (if quick? 20 400) 1 100000)))
    (cond ((assoc-ref options "--help") (display help))
          ((assoc-ref options "--cost") (say-cost) (say-live-cost))
          ((assoc-ref options "--tank")
           (say-tank (if (assoc "--tethers" options) (list tethers) '(32 64 128))))
          (else
           (let* ((learn? (assoc-ref options "--learn"))
                  (rows (measure-rows (if learn? short-dive long-dive)
                                      (if (or quick? (assoc "--tethers" options)) (list tethers) '(8 16 32 64 128 256))
                                      truths learn? by (decimal options "--minutes" #f 0.01 1e5)))
                  (file (assoc-ref options "--plot")))
             (when (and file (pair? rows)) (write-coverage file rows)))))
    0))
