;;; (bight identify found) --- what an identification found: values with covariance, residuals, a type of tether.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(define-module (bight identify found)
  #:use-module (bight core record)
  #:use-module (bight core verb)
  #:use-module (bight identify entries)
  #:use-module (bight identify fit)
  #:use-module (bight identify flight)
  #:use-module (bight identify measured)
  #:use-module (bight identify unknown)
  #:use-module (srfi srfi-1)
  #:use-module (srfi srfi-4)
  #:use-module ((srfi srfi-9 gnu) #:select (set-record-type-printer!))
  #:export (make-identification
            identification?
            identified
            identified-correlations
            identified-covariance
            identified-score
            identified-type
            identified-warnings
            residuals-in-time
            residuals-along))

(define-record <identification>
  (make-identification problem fit type files begun flown)
  identification-record?
  (problem identification-problem)
  (fit identification-fit)
  (type identification-base)            ; symbol: the type of tether it is like, or #f
  (files identification-files)
  (begun identification-begun)          ; what `fly-runs' returns of the line as it began, ...
  (flown identification-flown))         ; ... and as it was found, through all rows

(define-argument-type (identification value)
  "what `identify' returned"
  (if (identification-record? value) value refused))

(define-verb (identification? (object any))
  "Return #t if OBJECT is what `identify' returns."
  (identification-record? object))


;;; Values.

(define (coordinates-found i) (problem-coordinates (identification-problem i)))

(define (found-x i k) (f64vector-ref (fit-x (identification-fit i)) k))

(define (variance i j k)
  (vector-ref (vector-ref (fit-covariance (identification-fit i)) j) k))

(define normal-90 1.6449)               ; the normal distribution is within so many deviations in 90 % of cases

(define-verb (identified (i identification))
  "Return a list (NAME VALUE LOW HIGH) for each unknown of the identification I; LOW and HIGH are a 90 % interval."
  (map (lambda (coordinate k)
         (let ((x (found-x i k)) (half (* normal-90 (sqrt (variance i k k)))))
           (list (coordinate-name coordinate) (coordinate-value coordinate x)
                 (coordinate-value coordinate (- x half)) (coordinate-value coordinate (+ x half)))))
       (coordinates-found i) (iota (unknown-count i))))

(define (unknown-count i) (f64vector-length (fit-x (identification-fit i))))

(define (matrix-of i proc)
  (let ((n (unknown-count i)))
    (list->typed-array 'f64 2 (map (lambda (j) (map (lambda (k) (proc j k)) (iota n))) (iota n)))))

(define-verb (identified-covariance (i identification))
  "Return the covariance of what the identification I found, a rank-2 array in the units of its unknowns, in their
order."
  (let ((slopes (map (lambda (coordinate k) (coordinate-slope coordinate (found-x i k)))
                     (coordinates-found i) (iota (unknown-count i)))))
    (matrix-of i (lambda (j k) (* (list-ref slopes j) (list-ref slopes k) (variance i j k))))))

(define (correlation i j k)
  (/ (variance i j k) (sqrt (* (variance i j j) (variance i k k)))))

(define-verb (identified-correlations (i identification))
  "Return the correlations of what the identification I found, a rank-2 array in the order of its unknowns."
  (matrix-of i (lambda (j k) (correlation i j k))))


;;; What the data do not tell.

(define alike 0.95)                     ; a correlation from which on two unknowns are not told apart
(define wide-open 0.7)                  ; deviations of a logarithm: a factor of ten from end to end of its interval

(define (name-of i k) (coordinate-name (list-ref (coordinates-found i) k)))

(define nothing 1e-5)                   ; a share of where it began at which a positive quantity has gone to nothing

(define (gone? coordinate x)
  (and (coordinate-log? coordinate) (< (coordinate-value coordinate x) (* nothing (coordinate-start coordinate)))))

(define (at-most? coordinate x)
  (and (coordinate-log? coordinate) (= (coordinate-value coordinate x) (coordinate-value coordinate (+ x 1)))))

(define (inside? i k)
  ;; Is the unknown K not at an end of what it may be?
  (let ((coordinate (list-ref (coordinates-found i) k)) (x (found-x i k)))
    (not (or (gone? coordinate x) (at-most? coordinate x)))))

(define (at-the-ends i)
  (filter-map (lambda (coordinate k)
                (let ((name (coordinate-name coordinate)) (x (found-x i k)))
                  (cond ((gone? coordinate x)
                         (simple-format #f "~a went to nothing: the line is as near without it" name))
                        ((at-most? coordinate x)
                         (simple-format #f "~a went to the most it may be: something else is not as it is said to be" name))
                        (else #f))))
              (coordinates-found i) (iota (unknown-count i))))

(define (alike-pairs i)
  (append-map (lambda (j)
                (filter-map (lambda (k)
                              (let ((r (correlation i j k)))
                                (and (> (abs r) alike) (inside? i j) (inside? i k)
                                     (simple-format #f "the data hardly tell ~a and ~a apart (correlation ~a): \
know one of them, or measure something else, such as a force" (name-of i j) (name-of i k) (rounded r 3)))))
                            (iota (- (unknown-count i) j 1) (+ j 1))))
              (iota (unknown-count i))))

(define (open-ended i)
  (filter-map (lambda (coordinate k)
                (and (coordinate-log? coordinate) (inside? i k)
                     (> (sqrt (variance i k k)) wide-open)
                     (simple-format #f "the data tell hardly more of ~a than its order of magnitude"
                                    (coordinate-name coordinate))))
              (coordinates-found i) (iota (unknown-count i))))

(define-verb (identified-warnings (i identification))
  "Return sentences about what the data of the identification I do not tell."
  (append (if (fit-converged? (identification-fit i))
              '()
              '("the search did not come to an end: begin nearer, by #:known, or with fewer unknowns"))
          (if (fit-follow? (identification-fit i))
              '("residuals follow their neighbours: something is there that the line flown has not; intervals tell \
how sure the values are for such a line, not how far they are from the truth")
              '())
          (at-the-ends i) (open-ended i) (alike-pairs i)))


;;; Residuals.

(define (marker-off flown run row marker)
  ;; m between where MARKER was seen and where the line has it, or #f.
  (let* ((seen (run-place run row marker))
         (at (place-of flown (run-markers run) row marker)))
    (and (every (lambda (x) (= x x)) seen)
         (distance-between seen (map (lambda (axis) (f64vector-ref (car flown) (+ at axis))) '(0 1 2))))))

(define (mean numbers) (if (null? numbers) #f (/ (apply + numbers) (length numbers))))

(define (rows-off flown run rows)
  ;; All distances of the markers of RUN in ROWS.
  (if (flight-failed? flown)
      '()
      (append-map (lambda (row)
                    (filter-map (lambda (marker) (marker-off flown run row marker))
                                (iota (run-markers run))))
                  rows)))

(define (runs-of i) (problem-runs (identification-problem i)))
(define (fitted-of i) (problem-fitted (identification-problem i)))

(define (rows-that fitted held?)
  ;; The rows that are FITTED, a vector, or those that are held out.
  (filter (lambda (row) (eq? held? (not (vector-ref fitted row)))) (iota (vector-length fitted))))

(define (mean-off i flown held?)
  (mean (append-map (lambda (run fitted one) (rows-off one run (rows-that fitted held?)))
                    (runs-of i) (fitted-of i) flown)))

(define (forces-off i flown held?)
  ;; The root of the mean square difference of the forces, N, or #f.
  (let ((squares
         (append-map
          (lambda (run fitted one)
            (append-map (lambda (force)
                          (filter-map (lambda (row) (and (not (flight-failed? one)) (force-off force one row)))
                                      (rows-that fitted held?)))
                        (run-forces run)))
          (runs-of i) (fitted-of i) flown)))
    (and (pair? squares) (sqrt (mean squares)))))

(define (force-off force flown row)
  ;; The square of the difference of the FORCE at ROW, or #f.
  (let* ((at (pull-of flown row (first force)))
         (pull (map (lambda (axis) (f64vector-ref (cdr flown) (+ at axis))) '(0 1 2)))
         (seen (map (lambda (axis) (f64vector-ref (third force) (+ axis (* row (second force))))) (iota (second force))))
         (off (if (= 1 (second force))
                  (- (distance-between pull '(0 0 0)) (first seen))
                  (distance-between pull seen))))
    (and (= off off) (* off off))))

(define-verb (identified-score (i identification))
  "Return an alist of how far off the line of the identification I is: mean-distance of the markers, m, in the rows
that were fitted, held-out in those that were not, before and before-held-out of the line as it began; force and
force-held-out, the root of the mean square difference of the forces, N.  What was not measured is #f."
  (let ((flown (identification-flown i)) (begun (identification-begun i)))
    `((mean-distance . ,(mean-off i flown #f)) (held-out . ,(mean-off i flown #t))
      (before . ,(mean-off i begun #f)) (before-held-out . ,(mean-off i begun #t))
      (force . ,(forces-off i flown #f)) (force-held-out . ,(forces-off i flown #t)))))

(define-verb (residuals-in-time (i identification))
  "Return, for `plot', how far off the markers of the identification I are in the mean over time: a curve of rows (S
M) for each run."
  (map (lambda (run flown)
         (cons (simple-format #f "mean distance, ~a" (basename (run-file run)))
               (filter-map (lambda (row)
                             (let ((off (mean (rows-off flown run (list row)))))
                               (and off (list (f64vector-ref (run-times run) row) off))))
                           (iota (run-rows run)))))
       (runs-of i) (identification-flown i)))

(define-verb (residuals-along (i identification))
  "Return, for `plot', how far off the markers of the identification I are in the mean along the line: a curve of rows
(M M) for what was fitted and one for what was held out."
  (map (lambda (name held?)
         (cons name
               (filter-map
                (lambda (marker place)
                  (let ((off (mean (append-map
                                    (lambda (run fitted flown)
                                      (filter-map (lambda (row)
                                                    (and (not (flight-failed? flown))
                                                         (marker-off flown run row marker)))
                                                  (rows-that fitted held?)))
                                    (runs-of i) (fitted-of i) (identification-flown i)))))
                    (and off (list place off))))
                (iota (length (setting-places (problem-setting (identification-problem i)))))
                (setting-places (problem-setting (identification-problem i))))))
       '("distance, fitted" "distance, held out") '(#f #t)))


;;; A type of tether.

(define of-a-type '(diameter mass wet-weight ea ei ba bending-damping gj ei-stuck slip-curvature cdn cdt ca friction))

(define (digits x n)
  ;; X to N significant digits.
  (if (or (zero? x) (not (< -inf.0 x +inf.0)))
      x
      (let ((unit (expt 10. (- n 1 (floor (/ (log (abs x)) (log 10)))))))
        (/ (round (* x unit)) unit))))

(define (rounded x places)
  (let ((unit (expt 10 places))) (/ (round (* x unit)) unit)))

(define-verb (identified-type (i identification) #:optional (name name 'identified))
  "Return the form that makes the line of the identification I a type of tether called NAME, a list that
`define-tether-type' begins; write it into a file, then say (type NAME) in a world.  It has as many nodes as the line
that was flown, for which the values hold."
  (let* ((problem (identification-problem i))
         (fields (line-values (problem-setting problem) (problem-coordinates problem)
                              (fit-x (identification-fit i))))
         (known (setting-known (problem-setting problem)))
         (found (map first (identified i))))
    `(define-tether-type ,name
       ,(simple-format #f "Identified from ~a: ~a." (string-join (map basename (identification-files i)) ", ")
                       (string-join (map symbol->string found) ", "))
       ,@(if (identification-base i) `((like ,(identification-base i))) '())
       ,@(filter-map (lambda (field)
                       (and (or (memq field found) (assq field known) (memq field '(mass wet-weight)))
                            (list field (digits (assq-ref fields field) 5))))
                     of-a-type)
       ,@(map (lambda (set)
                `(set ,@(map (lambda (name value)
                               (list name (if (= value +inf.0) 'all (digits value 5))))
                             '(at span curvature plane) set)))
              (line-sets (problem-setting problem) (problem-coordinates problem) (fit-x (identification-fit i))))
       ;; What is found holds for a line of so many intervals: coarser ones lie elsewhere.
       (nodes ,(setting-intervals (problem-setting problem))))))


;;; Printing.

(define (padded text n) (string-append text (make-string (max 1 (- n (string-length text))) #\space)))

(define (number-text x) (number->string (exact->inexact (digits x 4))))

(define (print-found i port)
  (for-each (lambda (row coordinate)
              (simple-format port "  ~a~a ~a  (90 %: ~a to ~a)~%" (padded (symbol->string (first row)) 18)
                             (padded (number-text (second row)) 11) (padded (coordinate-unit coordinate) 7)
                             (number-text (third row)) (number-text (fourth row))))
            (identified i) (coordinates-found i)))

(define (print-correlations i port)
  (when (<= 2 (unknown-count i) 8)
    (display "correlations\n" port)
    (for-each (lambda (j)
                (simple-format port "  ~a~a~%" (padded (symbol->string (name-of i j)) 18)
                               (string-concatenate
                                (map (lambda (k) (padded (number->string (rounded (correlation i j k) 2)) 7))
                                     (iota (+ j 1))))))
              (iota (unknown-count i)))))

(define (print-score i port)
  (define score (identified-score i))
  (define (tell text key unit factor)
    (let ((value (assq-ref score key)))
      (when value
        (simple-format port "  ~a~a ~a~%" (padded text 34) (number-text (* factor value)) unit))))
  (display "how far off\n" port)
  (tell "markers, in the mean, fitted" 'mean-distance "mm" 1000)
  (tell "markers, held out" 'held-out "mm" 1000)
  (tell "markers, held out, as it began" 'before-held-out "mm" 1000)
  (tell "forces, rms, fitted" 'force "N" 1)
  (tell "forces, held out" 'force-held-out "N" 1))

(define (print-identification i port)
  (let ((fit (identification-fit i)))
    (simple-format port "identified from ~a (~a numbers, ~a iterations)~%"
                   (string-join (map basename (identification-files i)) ", ") (fit-numbers fit) (fit-iterations fit))
    (print-found i port)
    (print-correlations i port)
    (print-score i port)
    (for-each (lambda (sentence) (simple-format port "warning: ~a~%" sentence)) (identified-warnings i))))

(set-record-type-printer!
 <identification>
 (lambda (i port) (display (string-trim-right (call-with-output-string (lambda (port) (print-identification i port))))
                           port)))
