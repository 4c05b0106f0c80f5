;;; (bight bench row) --- the rows of benchmarks: read from programs, gathered over rounds, kept.
;;;
;;; A program prints CSV.  Repeated in rounds, each of its rows becomes one measurement: what it is of, the
;;; median error, and a CPU time and a multiple of the calibration kernel from every round.  Costs are
;;; medians over the rounds.  Among those of one case and metric, a measurement is on the front when none
;;; that is as cheap has a smaller error.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(define-module (bight bench row)
  #:use-module ((bight core decimal) #:select (text->number))
  #:use-module (bight core json)
  #:use-module ((bight core errors) #:select (bight-raise))
  #:use-module (bight core record)
  #:use-module (srfi srfi-1)
  #:export (median spread
            read-csv
            gather-rows
            row? row-bench row-case row-model row-setting row-metric row-error row-reference
            row-uncertainty row-cpus row-ratios row-counters row-front?
            row-key row-cpu row-ratio row-map? row-judged? row-calibration? row-group
            row->json json->row))

(define (median numbers)
  "Return the median of NUMBERS, #f of none."
  (let ((sorted (sort numbers <)) (n (length numbers)))
    (cond ((zero? n) #f)
          ((odd? n) (list-ref sorted (quotient n 2)))
          (else (/ (+ (list-ref sorted (quotient n 2)) (list-ref sorted (- (quotient n 2) 1))) 2)))))

(define (spread numbers)
  "Return how far the positive NUMBERS reach: the largest over the smallest, less one."
  (if (null? numbers) 0 (- (/ (apply max numbers) (apply min numbers)) 1)))


;;; CSV.

(define (read-cell chars)
  ;; The cell that CHARS begin with, and what follows it.
  (if (and (pair? chars) (eqv? #\" (car chars)))
      (let loop ((rest (cdr chars)) (cell '()))
        (cond ((null? rest) (values (list->string (reverse cell)) '()))
              ((and (eqv? #\" (car rest)) (pair? (cdr rest)) (eqv? #\" (cadr rest)))
               (loop (cddr rest) (cons #\" cell)))
              ((eqv? #\" (car rest)) (values (list->string (reverse cell)) (cdr rest)))
              (else (loop (cdr rest) (cons (car rest) cell)))))
      (call-with-values (lambda () (break (lambda (c) (eqv? c #\,)) chars))
        (lambda (cell rest) (values (list->string cell) rest)))))

(define (split-line line)
  (let loop ((chars (string->list line)) (cells '()))
    (call-with-values (lambda () (read-cell chars))
      (lambda (cell rest)
        (if (null? rest)
            (reverse (cons cell cells))
            (loop (cdr rest) (cons cell cells)))))))

(define (read-csv lines)
  "Return the rows of CSV in LINES, the first of which names the columns: alists of names and cells."
  (let ((names (split-line (car lines))))
    (map (lambda (line)
           (let ((cells (split-line line)))
             (map cons names (append cells (make-list (max 0 (- (length names) (length cells))) "")))))
         (cdr lines))))


;;; Rows.

(define-record <row>
  (make-row bench case model setting metric error reference uncertainty cpus ratios counters front?)
  row?
  (bench row-bench)
  (case row-case)
  (model row-model)
  (setting row-setting)
  (metric row-metric)
  (error row-error)                     ; or #f
  (reference row-reference)             ; a string
  (uncertainty row-uncertainty)         ; of it, or #f
  (cpus row-cpus)                       ; ns, one of each round
  (ratios row-ratios)                   ; multiples of the calibration kernel, likewise
  (counters row-counters)               ; of the first round, a string
  (front? row-front? set-row-front!))

(define (row-cpu row)
  "Return the CPU time of ROW in ns, or #f."
  (median (row-cpus row)))

(define (row-ratio row)
  "Return the cost of ROW in multiples of the calibration kernel, or #f."
  (median (row-ratios row)))

(define (row-key row)
  "Return what ROW is of: equal keys can be compared."
  (list (row-bench row) (row-case row) (row-model row) (row-setting row) (row-metric row)))

(define (row-group row)
  "Return what a front is made among."
  (list (row-bench row) (row-case row) (row-metric row)))

(define (row-map? row)
  "Return true if the case of ROW is to be drawn as a map: its settings are X=1;Y=2."
  (string-prefix? "map-" (row-case row)))

(define (row-judged? row)
  "Return true if ROW has an error and a cost to be weighed against each other: no map, and no size."
  (and (row-error row)
       (row-ratio row)
       (not (row-map? row))
       (not (string-prefix? "bytes " (row-metric row)))))

(define (row-calibration? row)
  "Return true if ROW tells of the calibration itself."
  (string=? "calibration" (row-case row)))

(define (number-cell cells . names)
  ;; The finite number in the first of the columns NAMES there is, or #f.
  (let ((x (any (lambda (name) (and=> (assoc-ref cells name) text->number)) names)))
    (and (real? x) (< -inf.0 x +inf.0) x)))

(define (error-cell cells)
  ;; One without bounds is kept: a failure is no missing number.
  (let ((text (or (assoc-ref cells "error") "")))
    (if (member text '("inf" "-inf")) +inf.0 (number-cell cells "error"))))

(define (text-cell cells name)
  (or (assoc-ref cells name) ""))

(define key-columns '("case" "model" "setting" "metric"))

(define (key-of cells)
  (map (lambda (name) (text-cell cells name)) key-columns))

(define (join-cells bench rounds)
  ;; One row of ROUNDS, its cells in each of them.
  (let* ((first (car rounds))
         (numbers (lambda (get) (filter-map get rounds))))
    (apply make-row bench
           (append (key-of first)
                   (list (median (numbers error-cell))
                         (text-cell first "reference")
                         (number-cell first "reference_uncertainty" "tolerance")
                         (numbers (lambda (cells) (number-cell cells "cpu_ns")))
                         (numbers (lambda (cells)
                                    (number-cell cells "calibration_ratio" "cpu_calibrated")))
                         (text-cell first "counters")
                         #f)))))

(define (mark-fronts! rows)
  (for-each mark-front! (group-by row-group (filter row-judged? rows))))

(define (group-by key items)
  ;; Lists of the ITEMS with equal KEY, in order.
  (let ((table (make-hash-table)) (keys '()))
    (for-each (lambda (item)
                (let ((k (key item)))
                  (unless (hash-ref table k) (set! keys (cons k keys)))
                  (hash-set! table k (cons item (hash-ref table k '())))))
              items)
    (map (lambda (k) (reverse (hash-ref table k))) (reverse keys))))

(define (mark-front! rows)
  ;; Where all are equally wrong, there is nothing to choose.
  (when (> (length (delete-duplicates (map row-error rows))) 1)
    (fold (lambda (row best)
            (cond ((< (row-error row) best) (set-row-front! row #t) (row-error row))
                  (else best)))
          +inf.0
          (sort rows (lambda (a b)
                       (or (< (row-ratio a) (row-ratio b))
                           (and (= (row-ratio a) (row-ratio b)) (< (row-error a) (row-error b)))))))))

(define (gather-rows rounds)
  "Return the rows of ROUNDS, each an alist of a bench's name and its rows of CSV, in the order of the first
round, with their fronts marked."
  (let ((rows (append-map
               (lambda (bench)
                 (let ((all (filter-map (lambda (round) (assoc-ref round bench)) rounds)))
                   (map (lambda (alike) (join-cells bench alike))
                        (group-by key-of (concatenate all)))))
               (delete-duplicates (append-map (lambda (round) (map car round)) rounds)))))
    (mark-fronts! rows)
    rows))


;;; In a report.

(define (row->json row)
  "Return ROW as a JSON object."
  `(("bench" . ,(row-bench row))
    ("case" . ,(row-case row))
    ("model" . ,(row-model row))
    ("setting" . ,(row-setting row))
    ("metric" . ,(row-metric row))
    ("error" . ,(or (row-error row) 'null))
    ("failed" . ,(eqv? +inf.0 (row-error row)))
    ("reference" . ,(row-reference row))
    ("reference_uncertainty" . ,(or (row-uncertainty row) 'null))
    ("cpu_ns" . ,(list->vector (row-cpus row)))
    ("calibration_ratio" . ,(list->vector (row-ratios row)))
    ("counters" . ,(row-counters row))
    ("front" . ,(row-front? row))))

(define (json->row object)
  "Return the row that the JSON OBJECT is.  Raise format when it is none."
  (define (text key)
    (let ((value (json-ref object key)))
      (if (string? value) value (bight-raise 'format 'bench "a row without its ~a" key))))
  (define (number key)
    (let ((value (json-ref object key))) (and (real? value) value)))
  (define (numbers key)
    (let ((value (json-ref object key)))
      (if (and (vector? value) (every real? (vector->list value)))
          (vector->list value)
          (bight-raise 'format 'bench "a row whose ~a are no numbers" key))))
  (make-row (text "bench") (text "case") (text "model") (text "setting") (text "metric")
            (if (eq? #t (json-ref object "failed")) +inf.0 (number "error"))
            (text "reference") (number "reference_uncertainty")
            (numbers "cpu_ns") (numbers "calibration_ratio") (text "counters")
            (eq? #t (json-ref object "front"))))
