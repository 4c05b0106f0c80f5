;;; (bight bench belief-tank) --- a belief about a measured rope: is it as sure as it may be where nobody simulated?
;;;
;;; The rope is cable 6 of Filliung et al. (ICRA 2024), led by a vehicle in a tank, surge run; its markers lie on turned
;;; catenaries that were fitted to what cameras saw, and each frame tells how far off these were in the mean.  A belief
;;; flown along the vehicle's path reads four markers three times a second over the first half of the run.  The error of a
;;; turned catenary is alike along the rope and from frame to frame, so that readings of all four within 1.2 s are taken to
;;; tell as much as one.  How much of their uncertainty the markers show is found on that half as well: the error with which the 90 % tube holds nine
;;; tenths of what was read.  Nothing of the second half is read; its markers are looked for in the 90 % tube.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(define-module (bight bench belief-tank)
  #:use-module (bight belief)
  #:use-module (bight belief cloud)
  #:use-module (bight belief tube)
  #:use-module (bight core units)
  #:use-module (bight dive)
  #:use-module (bight dive command)
  #:use-module (bight dive time)
  #:use-module (bight world)
  #:use-module (bight world track)
  #:use-module (srfi srfi-1)
  #:use-module (srfi srfi-4)
  #:export (say-tank))

(define (file)
  (string-append (or (getenv "BIGHT_REFERENCE_DATA")
                     (string-append (or (getenv "top_srcdir") ".") "/../shared/data"))
                 "/real/toulon_cable6_surge_0p6_0031.csv"))

;; A row of the file: the time, s; in the place `doubt-column' the mean distance of the markers from what was seen, mm; from
;; `markers-column' on the places of the markers.
(define columns 60)
(define doubt-column 10)
(define markers-column 12)
(define arcs '(0.05 0.25 0.45 0.65 0.85 1.05 1.25 1.45 1.65 1.85 2.05 2.25 2.45 2.65)) ; m, of all but the ends
(define markers-read '(2 5 8 11))       ; of these
(define rows-per-look 10)
(define half 4.8)                       ; s
(define alike 16)                       ; readings that tell as much as one

(define frame-time car)

(define (frame-markers row)
  (map (lambda (k) (list-head (list-tail row (+ markers-column 3 (* 3 k))) 3)) (iota (length arcs))))

(define (frame-sigma row)
  ;; m, in each direction: the mean length of a normal vector is 2 (2 / pi)^(1/2) deviations.
  (/ (list-ref row doubt-column) 1000 (* 2 (sqrt (/ 2 (acos -1))))))

(define dynamic-rope
  (extend (without (find-world 'tank) 'rope)
          (part tether (named rope) (type leaded-rope) (from 0 0 0) (to minnow) (length 2.85) (model dynamic) (nodes 24))))

;; What was weighed is known to what the scale showed; the water may drift.
(define doubts
  '((current (error 0.02) (levels 0 -1.5) (correlation 2))
    (rope (cdn (uniform 0.9 1.8)) (cdt (uniform 0 0.05)) (ca (uniform 0.5 1.5)) (wet-weight (normal 0.4 0.016)))))

(define (observe-frame! belief row)
  (for-each (lambda (k)
              (observe! belief 'transponder (list-ref (frame-markers row) k) #:on (list-ref arcs k)
                        #:noise (* (sqrt alike) (frame-sigma row))))
            markers-read))

(define (for-each-look procedure rows)
  ;; Let time pass and call PROCEDURE with each row that is looked at.
  (for-each (lambda (row k)
              (when (zero? (modulo k rows-per-look))
                (run (max 0 (- (frame-time row) (now))))
                (procedure row)))
            rows (iota (length rows))))

(define (mean numbers) (/ (apply + numbers) (length numbers)))
(define (share items) (exact->inexact (/ (count identity items) (length items))))

(define (share-read belief part)
  ;; The share of what BELIEF read that its 90 % tube holds, seen with PART of its uncertainty.
  (share (map (lambda (r)
                (ellipsoid-holds? (ellipsoid (answer-of belief (reading-predictions r)) 0.9
                                             (* part (/ (reading-noise r) (sqrt alike))))
                                  (reading-value r)))
              (belief-readings belief))))

(define (part-shown belief)
  (find (lambda (part) (>= (share-read belief part) 0.9)) (map (lambda (k) (/ k 20.0)) (iota 60))))

(define sure 2.5)                       ; deviations hold 90 % of a normal vector

(define (judge-frame belief row part)
  ;; Two lists: which markers the tube holds, and how much wider it is than their uncertainty asks.
  (let ((noise (* part (frame-sigma row))))
    (list (tube-holds? (list->typed-array 'f64 2 (frame-markers row)) #:belief belief #:at arcs #:noise noise)
          (map (lambda (e) (/ (norm (second e)) (* sure (frame-sigma row))))
               (tether-tube #:belief belief #:at arcs #:noise noise)))))

(define (hundredths x) (/ (round (* 100 x)) 100))

(define (fly-tank rows tethers)
  ;; Print how a belief of TETHERS tethers does.
  (enter! dynamic-rope)
  (let ((belief (make-belief (current-dive) doubts #:members tethers)) (begun (get-internal-run-time)))
    (call-with-values (lambda () (partition (lambda (row) (<= (frame-time row) half)) rows))
      (lambda (first-half second-half)
        (follow! (file))
        (for-each-look (lambda (row) (observe-frame! belief row)) first-half)
        (mend-belief! belief)
        (let* ((part (part-shown belief)) (judged '()))
          (for-each-look (lambda (row) (set! judged (cons (judge-frame belief row part) judged))) second-half)
          (simple-format #t "~a,~a,~a,~a,~a,~a,~a~%" tethers (* (length judged) (length arcs)) part
                         (hundredths (share (append-map first judged))) (hundredths (mean (append-map second judged)))
                         (hundredths (apply max (map mean (map second judged))))
                         (hundredths (/ (- (get-internal-run-time) begun) internal-time-units-per-second 1.0))))))
    (force-output)))

(define (say-tank counts)
  "Print a row for a belief of each of COUNTS tethers, or that the measurement is not here."
  (if (file-exists? (file))
      (let ((rows (read-columns 'bench (file) columns)))
        (display "tethers,markers looked for,part of their uncertainty shown,held by the 90 % tube,tube's width by what their \
uncertainty asks,the same of the widest frame,cpu s\n")
        (for-each (lambda (tethers) (fly-tank rows tethers)) counts))
      (simple-format #t "skipped: the measured rope is not here (~a)~%" (file))))
