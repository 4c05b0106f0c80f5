;;; (bight identify entries) --- the numbers that are fitted, and how far a line that is flown is off them.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(define-module (bight identify entries)
  #:use-module (bight core record)
  #:use-module (bight identify flight)
  #:use-module (bight identify measured)
  #:use-module (bight identify unknown)
  #:use-module (srfi srfi-1)
  #:use-module (srfi srfi-4)
  #:export (make-problem problem? problem-runs problem-setting problem-coordinates problem-fitted problem-loss
            flights-of fly-runs median moved
            entries? entries-of entry-count entries-channels entries-rows entries-starts
            residuals derivatives times-rows))

(define-record <problem>
  (make-problem runs setting coordinates fitted loss)
  problem?
  (runs problem-runs)
  (setting problem-setting)
  (coordinates problem-coordinates)
  (fitted problem-fitted)               ; of each run, a vector: is the row fitted, or held out
  (loss problem-loss))                  ; huber, cauchy or squares

(document
 (make-problem "Return what is to be fitted: see the fields.")
 (problem? "Return true if OBJECT is what is to be fitted.")
 (problem-runs "Return the runs of PROBLEM.")
 (problem-setting "Return how the lines of PROBLEM are led.")
 (problem-coordinates "Return the coordinates of PROBLEM.")
 (problem-fitted "Return of each run of PROBLEM a vector that tells which rows are fitted.")
 (problem-loss "Return the loss of PROBLEM: huber, cauchy or squares."))

(define (last-fitted fitted)
  ;; How many rows are flown to reach all that are FITTED.
  (let loop ((n (vector-length fitted)))
    (if (or (zero? n) (vector-ref fitted (- n 1))) n (loop (- n 1)))))

(define (lasts-of problem) (map last-fitted (problem-fitted problem)))


;;; What is compared: a list of channels, each a time series of numbers of a kind.

;; A channel is (KIND RUN MARKER-OR-END AXIS); the entries of all are laid out one channel after the other.

(define (run-channels run index)
  (append
   (append-map (lambda (marker) (map (lambda (axis) (list 'place index marker axis)) '(0 1 2)))
               (iota (run-markers run)))
   (append-map (lambda (force k)
                 (if (= 1 (second force))
                     (list (list 'tension index k #f))
                     (map (lambda (axis) (list 'force index k axis)) '(0 1 2))))
               (run-forces run) (iota (length (run-forces run))))))

(define (channels-of problem)
  (append-map run-channels (problem-runs problem) (iota (length (problem-runs problem)))))

(define (measured-in problem channel row)
  ;; What was measured in CHANNEL at ROW, or NaN.
  (let ((run (list-ref (problem-runs problem) (second channel))))
    (case (first channel)
      ((place) (f64vector-ref (run-seen run)
                              (+ (fourth channel) (* 3 (+ (third channel) (* row (run-markers run)))))))
      ((tension) (f64vector-ref (third (list-ref (run-forces run) (third channel))) row))
      (else (f64vector-ref (third (list-ref (run-forces run) (third channel))) (+ (fourth channel) (* 3 row)))))))

(define (pull-norm pulls i)
  (sqrt (+ (expt (f64vector-ref pulls i) 2) (expt (f64vector-ref pulls (+ i 1)) 2)
           (expt (f64vector-ref pulls (+ i 2)) 2))))

(define (flown-in problem channel row flown markers)
  ;; What FLOWN, of a run with so many MARKERS, has there.
  (let ((run (list-ref (problem-runs problem) (second channel))))
    (if (eq? 'place (first channel))
        (f64vector-ref (car flown) (+ (fourth channel) (place-of flown markers row (third channel))))
        (let ((i (pull-of flown row (first (list-ref (run-forces run) (third channel))))))
          (if (fourth channel)
              (f64vector-ref (cdr flown) (+ i (fourth channel)))
              (pull-norm (cdr flown) i))))))

(define-record <entries>
  (make-entries channels rows wanted sigmas starts)
  entries?
  (channels entries-channels)           ; vector: the channel of each number
  (rows entries-rows)                   ; vector
  (wanted entries-wanted)               ; f64vector: what was measured
  (sigmas entries-sigmas)               ; f64vector: how sure its row is, in units of the others of its run
  (starts entries-starts))              ; vector: #t where the number does not follow the one before in time

(document
 (entries? "Return true if OBJECT is the numbers that are fitted.")
 (entries-channels "Return the channel (KIND RUN WHICH AXIS) of each number of ENTRIES, a vector.")
 (entries-rows "Return the row of each number of ENTRIES, a vector.")
 (entries-starts "Return a vector that is true where a number of ENTRIES does not follow the one before in time."))

(define (row-sigma run row typical)
  (if (run-sigma run)
      (let ((s (f64vector-ref (run-sigma run) row)))
        (if (< 0 s +inf.0) (/ s typical) 1.))
      1.))

(define (median numbers)
  "Return the median of NUMBERS, 0 of none."
  (let ((sorted (sort numbers <)))
    (if (null? sorted) 0. (list-ref sorted (quotient (length sorted) 2)))))

(define (typical-sigma run)
  (if (run-sigma run)
      (let ((known (filter (lambda (s) (< 0 s +inf.0)) (f64vector->list (run-sigma run)))))
        (if (null? known) 1. (median known)))
      1.))

(define (entries-of problem)
  "Return all that was measured in the rows of PROBLEM that are fitted."
  (let ((typical (map typical-sigma (problem-runs problem))))
    (let loop ((channels (channels-of problem)) (found '()))
      (if (null? channels)
          (let ((all (reverse found)))
            (make-entries (list->vector (map first all)) (list->vector (map second all))
                          (list->f64vector (map third all))
                          (list->f64vector (map fourth all)) (list->vector (map fifth all))))
          (let* ((channel (car channels)) (index (second channel))
                 (run (list-ref (problem-runs problem) index)))
            (let by-row ((row 0) (before #f) (found found))
              (if (= row (run-rows run))
                  (loop (cdr channels) found)
                  (let ((value (measured-in problem channel row)))
                    (if (and (= value value) (vector-ref (list-ref (problem-fitted problem) index) row))
                        (by-row (+ row 1) row
                                (cons (list channel row value
                                            (if (eq? 'place (first channel))
                                                (row-sigma run row (list-ref typical index))
                                                1.)
                                            (not (eqv? before (- row 1))))
                                      found))
                        (by-row (+ row 1) before found))))))))))

(define (entry-count entries)
  "Return how many numbers there are in ENTRIES."
  (vector-length (entries-channels entries)))


;;; Residuals and their derivatives.

(define far-off 1e3)                    ; a residual, in its scale, of a line that cannot be flown

(define* (flights-of problem x #:optional (lasts (lasts-of problem)))
  "Return the flights of all runs of PROBLEM at X, an f64vector, through LASTS rows of each: those that are fitted when
left out."
  (map (lambda (run index last)
         (make-flight (problem-setting problem) (problem-coordinates problem) x run index last))
       (problem-runs problem) (iota (length lasts)) lasts))

(define* (fly-runs problem x #:optional (lasts (lasts-of problem)))
  "Fly these; return what `fly-all' does."
  (fly-all (flights-of problem x lasts)))

(define (residuals problem entries flown)
  "Return how far FLOWN, of `fly-runs', is off ENTRIES, an f64vector: the difference divided by how sure the row is."
  (let* ((n (entry-count entries)) (r (make-f64vector n far-off)) (flown (list->vector flown)))
    (do ((i 0 (+ i 1))) ((= i n) r)
      (let* ((channel (vector-ref (entries-channels entries) i)) (row (vector-ref (entries-rows entries) i))
             (run (list-ref (problem-runs problem) (second channel)))
             (one (vector-ref flown (second channel))))
        (unless (flight-failed? one)
          (let ((off (- (flown-in problem channel row one (run-markers run))
                        (f64vector-ref (entries-wanted entries) i))))
            (f64vector-set! r i (if (< (abs off) far-off) (/ off (f64vector-ref (entries-sigmas entries) i)) far-off))))))))

(define nudge 1e-3)                     ; of a coordinate: results are exact to some 1e-9

(define (moved x k by)
  "Return X, an f64vector, with BY added to its element K."
  (let ((y (list->f64vector (f64vector->list x))))
    (f64vector-set! y k (+ by (f64vector-ref y k)))
    y))

(define (touches? coordinate index)
  ;; Does the run of INDEX depend on COORDINATE?
  (or (not (eq? 'clock (coordinate-what coordinate))) (= index (coordinate-which coordinate))))

(define (derivatives problem entries x base)
  "Return the derivative of each of the residuals BASE at X by each coordinate, an f64vector, row by row."
  (let* ((coordinates (problem-coordinates problem)) (p (length coordinates)) (n (entry-count entries))
         (jacobian (make-f64vector (* n p) 0.))
         (lasts (lasts-of problem))
         (jobs (append-map
                (lambda (k coordinate)
                  (filter-map (lambda (run index last)
                                (and (touches? coordinate index)
                                     (list k index (make-flight (problem-setting problem) coordinates (moved x k nudge)
                                                                run index last))))
                              (problem-runs problem) (iota (length lasts)) lasts))
                (iota p) coordinates))
         (flown (fly-all (map third jobs)))
         (table (make-hash-table)))
    (for-each (lambda (job one) (hash-set! table (cons (first job) (second job)) one)) jobs flown)
    (do ((i 0 (+ i 1))) ((= i n) jacobian)
      (let* ((channel (vector-ref (entries-channels entries) i)) (row (vector-ref (entries-rows entries) i))
             (markers (run-markers (list-ref (problem-runs problem) (second channel))))
             (sigma (f64vector-ref (entries-sigmas entries) i))
             (here (+ (f64vector-ref (entries-wanted entries) i) (* sigma (f64vector-ref base i)))))
        (do ((k 0 (+ k 1))) ((= k p))
          (let ((one (hash-ref table (cons k (second channel)))))
            (when (and one (not (flight-failed? one)))
              (f64vector-set! jacobian (+ k (* i p))
                              (/ (- (flown-in problem channel row one markers) here) sigma nudge)))))))))

(define (times-rows m v width)
  "Return V, rows of WIDTH numbers, with the rows multiplied by the elements of M."
  (let* ((n (f64vector-length v)) (w (make-f64vector n)))
    (do ((i 0 (+ i 1))) ((= i n) w)
      (f64vector-set! w i (* (f64vector-ref m (quotient i width)) (f64vector-ref v i))))))
