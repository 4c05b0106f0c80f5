;;; (bight study risk) --- what the outcomes of many dives say: probabilities, how sure they are, tables.
;;;
;;; A measure that is true or false gives a probability with Wilson's interval for 95 % confidence (Journal
;;; of the American Statistical Association 22, 1927), which holds for few dives and at 0 and 1 too.  Cases
;;; that failed or were timed out are counted beside those that are done, never among them.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(define-module (bight study risk)
  #:use-module ((bight core decimal) #:select (text->number))
  #:use-module (bight core errors)
  #:use-module ((bight core markup) #:select (csv-line))
  #:use-module (bight core record)
  #:use-module (bight core verb)
  #:use-module (bight study sweep-plan)
  #:use-module (bight study sweep-result)
  #:use-module (srfi srfi-1)
  #:export (wilson-interval
            measure-kind
            share-of
            group-rows
            group-variables
            short
            print-columns
            print-csv
            risk-table
            risk-summary
            ;; For (bight study risk-map).
            column-place
            column-of
            interval->string))


;;; Probabilities.

(define z-95 1.959963984540054)         ; the 97.5 % quantile of the standard normal distribution

(define-verb (wilson-interval (hits (at-least 0)) (trials (at-least 0)))
  "Return the list (LOW HIGH) of Wilson's interval, for 95 % confidence, for the probability of what came
about HITS times in TRIALS."
  (when (> hits trials)
    (bight-raise 'domain 'wilson-interval "~a hits are more than ~a trials" hits trials))
  (if (zero? trials)
      '(0.0 1.0)
      (let* ((n trials) (p (/ hits n)) (zz (* z-95 z-95))
             (middle (/ (+ p (/ zz (* 2 n))) (+ 1 (/ zz n))))
             (half (/ (* z-95 (sqrt (+ (/ (* p (- 1 p)) n) (/ zz (* 4 n n))))) (+ 1 (/ zz n)))))
        (list (if (zero? hits) 0.0 (max 0.0 (- middle half)))
              (if (= hits trials) 1.0 (min 1.0 (+ middle half)))))))

(define (zero-or-one? values)
  ;; Is all that is known of VALUES 0 or 1, and something is?
  (let ((known (filter identity values)))
    (and (pair? known)
         (every (lambda (v) (and (number? v) (or (= v 0) (= v 1)))) known))))

(define (share-of values)
  "Return (SHARE LOW HIGH HITS TRIALS) of VALUES, each 0, 1 or #f for one that is not known."
  (let* ((known (filter identity values))
         (hits (inexact->exact (apply + known)))
         (n (length known)))
    (cons* (if (zero? n) #f (exact->inexact (/ hits n)))
           (append (wilson-interval hits n) (list hits n)))))


;;; Groups.

(define (group-variables plan words)
  "Return the variables of PLAN to group by: those that WORDS, a string such as \"U,toward\", names, or #f for
those whose values the study lists."
  (if words
      (map (lambda (word)
             (let ((name (string->symbol (string-trim-both word))))
               (if (memq name (plan-fact plan 'variables))
                   name
                   (unknown-name 'sweep "the study" name (plan-fact plan 'variables) "variable"))))
           (string-split words #\,))
      (plan-fact plan 'spread)))

(define (group-rows rows places)
  "Return the ROWS in groups that have the same values at PLACES: an alist of those values and rows, in the
order in which they first come."
  (let ((table (make-hash-table)) (order '()))
    (for-each (lambda (row)
                (let* ((key (map (lambda (i) (list-ref row i)) places))
                       (found (hash-ref table key)))
                  (unless found (set! order (cons key order)))
                  (hash-set! table key (cons row (or found '())))))
              rows)
    (map (lambda (key) (cons key (reverse (hash-ref table key)))) (reverse order))))


;;; One measure in one group.

(define (short x)
  "Return the number X with three digits that count, a string; anything else as it prints."
  (cond ((not x) "")
        ((not (number? x)) (object->string x display))
        ((and (integer? x) (< (abs x) 1e9)) (number->string (inexact->exact x)))
        ((not (< -inf.0 x +inf.0)) (number->string x))
        (else
         (let* ((digits (inexact->exact (floor (/ (log (abs x)) (log 10)))))
                (scale (expt 10 (- 2 digits)))
                (rounded (/ (round (* (inexact->exact x) scale)) scale)))
           (number->string (if (integer? rounded) rounded (exact->inexact rounded)))))))

(define (mean values) (/ (apply + values) (length values)))

(define (deviation values)
  ;; Of the distribution that VALUES are a sample of, or #f.
  (let ((n (length values)) (m (mean values)))
    (and (> n 1)
         (sqrt (/ (apply + (map (lambda (v) (expt (- v m) 2)) values)) (- n 1))))))

(define (tallied values)
  ;; "wound 3, hung 1", the most frequent first.
  (let ((counts (map (lambda (group) (cons (caar group) (length (cdr group))))
                     (group-rows (map list values) '(0)))))
    (string-join (map (lambda (entry) (simple-format #f "~a ~a" (car entry) (cdr entry)))
                      (sort counts (lambda (a b)
                                     (or (> (cdr a) (cdr b))
                                         (and (= (cdr a) (cdr b))
                                              (string<? (object->string (car a))
                                                        (object->string (car b))))))))
                 ", ")))

(define (measure-kind plan name values)
  "Return what the measure NAME of PLAN is, whatever its VALUES happen to be: probability, number or text.  The
result of an older bight does not tell: there the values do."
  (let ((known (filter identity values)))
    (case (plan-kind plan name)
      ((boolean) 'probability)
      ((number text) => identity)
      (else
       (cond ((zero-or-one? values) 'probability)
             ((and (pair? known) (every number? known)) 'number)
             (else 'text))))))

(define (heads kind name csv?)
  (define (with suffix) (simple-format #f "~a_~a" name suffix))
  (cond ((not csv?) (list (symbol->string name)))
        ((eq? kind 'probability) (list (symbol->string name) (with "low") (with "high")))
        ((eq? kind 'number) (list (with "mean") (with "sd") (with "min") (with "max")))
        (else (list (symbol->string name)))))

(define (two-places x) (short (/ (round (* 100 x)) 100)))

(define (interval->string share)
  "Return SHARE, as `share-of' has it, as a person reads it."
  (if (first share)
      (simple-format #f "~a [~a, ~a]" (two-places (first share)) (two-places (second share))
                     (two-places (third share)))
      "-"))

(define (number-summary values)
  (simple-format #f "~a~a (~a to ~a)" (short (mean values))
                 (let ((sd (deviation values))) (if sd (string-append " +- " (short sd)) ""))
                 (short (apply min values)) (short (apply max values))))

(define (exact-text x) (if x (number->string x) ""))

(define (cells kind values csv?)
  (let ((known (filter identity values)))
    (cond ((and csv? (eq? kind 'probability)) (map exact-text (take (share-of values) 3)))
          ((eq? kind 'probability) (list (interval->string (share-of values))))
          ((and csv? (eq? kind 'number))
           (if (null? known)
               (list "" "" "" "")
               (map exact-text (list (exact->inexact (mean known)) (deviation known)
                                     (apply min known) (apply max known)))))
          ((eq? kind 'number) (list (if (null? known) "-" (number-summary known))))
          (else (list (tallied known))))))


;;; The table.

(define head-columns 4)                 ; number, status, error, message

(define (done? row) (equal? "done" (second row)))

(define (column-place plan name before)
  "Return where in a row the variable or measure NAME of PLAN stands, BEFORE columns standing before all."
  (+ before (list-index (lambda (n) (eq? n name))
                        (append (plan-fact plan 'variables) (plan-fact plan 'measures)))))

(define (place-of plan name) (column-place plan name head-columns))

(define (column-of rows place)
  "Return what stands at PLACE in each of ROWS."
  (map (lambda (row) (list-ref row place)) rows))

(define (table-cells plan rows by csv?)
  ;; The table of ROWS, cases of PLAN, grouped BY variables: rows of strings, the first their heads.
  (let* ((done (filter done? rows))
         (measures (map (lambda (name)
                          (let ((place (place-of plan name)))
                            (list name place (measure-kind plan name (column-of done place)))))
                        (plan-fact plan 'measures))))
    (define (group->cells group)
      (let ((flown (filter done? (cdr group))))
        (append (map (if csv? (lambda (v) (object->string v display)) short) (car group))
                (list (number->string (length flown))
                      (number->string (- (length (cdr group)) (length flown))))
                (append-map (lambda (m) (cells (third m) (column-of flown (second m)) csv?)) measures))))
    (cons (append (map symbol->string by) '("done" "failed")
                  (append-map (lambda (m) (heads (third m) (first m) csv?)) measures))
          (map group->cells (group-rows rows (map (lambda (name) (place-of plan name)) by))))))

(define (risk-table database by csv?)
  "Return the table of the result DATABASE, grouped BY variables, a string such as \"U,toward\", or #f: rows
of strings, the first their heads."
  (let ((plan (found-plan database)))
    (table-cells plan (case-rows database plan) (group-variables plan by) csv?)))


;;; The summary: a row for each measure, and for each word that one was.

(define (share-row name word share)
  (list name word (simple-format #f "~a of ~a" (fourth share) (fifth share)) (interval->string share)))

(define (word-rows name known)
  ;; The most frequent first.
  (let* ((words (map (lambda (v) (object->string v display)) known))
         (counts (map (lambda (word) (cons word (count (lambda (v) (string=? v word)) words)))
                      (delete-duplicates words))))
    (map (lambda (entry)
           (share-row name (car entry)
                      (share-of (map (lambda (v) (if (string=? v (car entry)) 1 0)) words))))
         (sort counts (lambda (a b)
                        (or (> (cdr a) (cdr b))
                            (and (= (cdr a) (cdr b)) (string<? (car a) (car b)))))))))

(define (summary-rows name kind values)
  (let ((known (filter identity values)))
    (case kind
      ((probability) (list (share-row name "true" (share-of values))))
      ((number) (list (list name "" (number->string (length known))
                            (if (null? known) "-" (number-summary known)))))
      (else (word-rows name known)))))

(define (risk-summary database)
  "Return what all cases of the result DATABASE came to: rows (MEASURE WORD COUNT SHARE) of strings, a share
with its interval; none when no case is done."
  (let* ((plan (found-plan database)) (done (filter done? (case-rows database plan))))
    (if (null? done)
        '()
        (append-map (lambda (name)
                      (let ((values (column-of done (place-of plan name))))
                        (summary-rows (symbol->string name) (measure-kind plan name values) values)))
                    (plan-fact plan 'measures)))))


;;; Printing.

(define (numeric? text)
  (and (not (string-null? text)) (text->number text) #t))

(define (print-columns rows)
  "Print ROWS, lists of strings, in columns, numbers to the right."
  (let* ((widths (apply map (lambda column (apply max (map string-length column))) rows))
         (right? (apply map (lambda column (every (lambda (t) (or (numeric? t) (string-null? t)))
                                                  (cdr column)))
                        rows)))
    (for-each
     (lambda (row)
       (display (string-trim-right
                 (string-join (map (lambda (text width right?)
                                     ((if right? string-pad string-pad-right) text width))
                                   row widths right?)
                              "  ")))
       (newline))
     rows)))

(define (print-csv rows)
  "Print ROWS, lists of strings, comma-separated."
  (for-each (lambda (row)
              (display (csv-line row))
              (newline))
            rows))
