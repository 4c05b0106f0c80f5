;;; (bight cockpit traces) --- measures of recordings over time, plotted beside their picture.
;;;
;;; Once a second of a recording that is wound through its measures are noted; what was never wound through is blank.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(define-module (bight cockpit traces)
  #:use-module (bight core chart)
  #:use-module (bight core errors)
  #:use-module (bight core record)
  #:use-module (bight dive)
  #:use-module (bight dive query)
  #:use-module (bight dive reel)
  #:use-module (bight engine)
  #:use-module (srfi srfi-1)
  #:export (new-traces traces? next-trace! wind-tracing! trace-lines))

;; The measures: what the axis says, and a procedure of the names of the first vehicle and tether, which may be #f.
(define measures
  `(("tension, N" . ,(lambda (vehicle tether) (max-tension tether)))
    ("slack, %" . ,(lambda (vehicle tether) (* 100 (slack tether))))
    ("out, m" . ,(lambda (vehicle tether) (tether-length tether)))
    ("depth, m" . ,(lambda (vehicle tether) (rov-depth vehicle)))
    ("speed, m/s" . ,(lambda (vehicle tether) (rov-speed vehicle)))))

(define-record <traces>
  (make-traces notes shown)
  traces?
  (notes traces-notes)                  ; of each reel, by eq: a table from places to lists of values
  (shown traces-shown set-shown!))      ; the number of the measure that is plotted, or #f

(define (new-traces)
  "Return traces of which none is plotted yet."
  (make-traces (make-hash-table) #f))

(define (next-trace! traces)
  "Let the next of TRACES be plotted, or, after the last, none.  Return what is told of that, a string."
  (let ((n (if (traces-shown traces) (+ 1 (traces-shown traces)) 0)))
    (set-shown! traces (and (< n (length measures)) n))
    (if (traces-shown traces)
        (string-append "plotted: " (car (list-ref measures n)) "  (* this, o the ghost)")
        "nothing is plotted")))

(define (value-of measure vehicle tether)
  ;; #f where the dive has no answer.
  (with-exception-handler
      (lambda (e) (if (bight-error? e) #f (raise-exception e)))
    (lambda () (exact->inexact ((cdr measure) vehicle tether)))
    #:unwind? #t))

(define (first-name reel head)
  (let ((names (%names (engine-of (reel-dive reel)) head)))
    (and (pair? names) (car names))))

(define (notes-of traces reel)
  (or (hashq-ref (traces-notes traces) reel)
      (let ((table (make-hash-table)))
        (hashq-set! (traces-notes traces) reel table)
        table)))

(define (note! traces reel)
  (let ((notes (notes-of traces reel)))
    (unless (hashv-ref notes (reel-place reel))
      (hashv-set! notes (reel-place reel)
                  (parameterize ((current-dive (reel-dive reel)))
                    (map (lambda (m) (value-of m (first-name reel 'rov) (first-name reel 'tether))) measures))))))

(define (second-of reel)
  ;; Steps.
  (inexact->exact (round (/ (%dive-time-step (engine-of (reel-dive reel)))))))

(define (wind-tracing! traces reel place)
  "Wind REEL to PLACE, and note in TRACES what is passed."
  (let ((every (second-of reel)) (place (max 0 (min (reel-length reel) place))))
    (when (< place (reel-place reel))
      (wind! reel place))
    (let loop ()
      (when (zero? (remainder (reel-place reel) every))
        (note! traces reel))
      (when (< (reel-place reel) place)
        (wind! reel (min place (* every (+ 1 (quotient (reel-place reel) every)))))
        (loop)))))

(define (samples traces reel behind n)
  ;; Of the measure N: pairs of seconds, BEHIND steps later than in REEL, and value.
  (let ((dt (%dive-time-step (engine-of (reel-dive reel)))))
    (hash-fold (lambda (place values all)
                 (let ((value (list-ref values n)))
                   (if value (acons (* dt (+ place behind)) value all) all)))
               '() (notes-of traces reel))))

(define (trace-lines traces reel ghost behind columns)
  "Return the lines, of COLUMNS, of what is plotted of TRACES: of REEL, and of GHOST, a reel or #f, that begins where REEL
is at its place BEHIND."
  (let ((n (traces-shown traces)) (dt (%dive-time-step (engine-of (reel-dive reel)))))
    (if n
        (chart-lines (car (list-ref measures n))
                     (cons (cons #\* (samples traces reel 0 n))
                           (if ghost (list (cons #\o (samples traces ghost behind n))) '()))
                     #:from 0 #:to (* dt (reel-length reel)) #:at (* dt (reel-place reel))
                     #:columns (- columns 10))
        '())))
