;;; (bight bench compare) --- two reports of benchmarks: better, worse, or noise.
;;;
;;; Costs are compared as multiples of the calibration kernel measured beside them, so that a slower day of
;;; the machine is in both.  Two reports made apart: Wilcoxon's rank sum test of the rounds of the one
;;; against those of the other.  Two builds run by turns, round by round: his signed rank test of the
;;; pairs.  Both are exact, two-sided, ties with mean ranks.  A row is better or worse when chance makes so
;;; much with 5 % at most, and it has moved by more than the rounds of a report commonly stray, 5 % at
;;; least; all else is noise, and what has too few rounds to tell is said to be untold.  An error has grown
;;; when it is larger by 1 % and by more than its reference is sure.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(define-module (bight bench compare)
  #:use-module (bight bench report)
  #:use-module (bight bench row)
  #:use-module (bight core errors)
  #:use-module (bight core record)
  #:use-module (srfi srfi-1)
  #:export (rank-sum-chance signed-rank-chance verdict? compare-reports))

(define chance-limit 0.05)
(define least-change 0.05)


;;; Exact tests.  Ranks are doubled, so that the mean of two is whole.

(define (doubled-ranks numbers)
  ;; The rank of each of NUMBERS among them, twice.
  (map (lambda (x)
         (+ 1 (* 2 (count (lambda (y) (< y x)) numbers)) (count (lambda (y) (= y x)) numbers)))
       numbers))

(define (add-ways! table sum ways)
  (hashv-set! table sum (+ ways (hashv-ref table sum 0))))

(define (two-sided ways total observed)
  ;; The chance of a sum as far out as OBSERVED, where WAYS has the ways to every sum, TOTAL in all.
  (let ((tail (lambda (beyond?)
                (hash-fold (lambda (sum n all) (if (beyond? sum observed) (+ n all) all)) 0 ways))))
    (exact->inexact (min 1 (/ (* 2 (min (tail <=) (tail >=))) total)))))

(define (rank-sum-chance xs ys)
  "Return the chance that XS and YS, drawn from one distribution, differ so much in rank: Wilcoxon's rank sum
test, exact and two-sided."
  (let* ((n (length xs))
         (ranks (doubled-ranks (append xs ys)))
         (ways (make-vector (+ n 1))))
    (for-each (lambda (k) (vector-set! ways k (make-hash-table))) (iota (+ n 1)))
    (add-ways! (vector-ref ways 0) 0 1)
    (for-each (lambda (rank)
                (for-each (lambda (k)
                            (hash-for-each (lambda (sum count)
                                             (add-ways! (vector-ref ways k) (+ sum rank) count))
                                           (vector-ref ways (- k 1))))
                          (iota n n -1)))
              ranks)
    (let ((last (vector-ref ways n)))
      (two-sided last (hash-fold (lambda (sum count all) (+ count all)) 0 last)
                 (apply + (list-head ranks n))))))

(define (signed-rank-chance differences)
  "Return the chance that DIFFERENCES, were they as likely of either sign, lie so much to one side: Wilcoxon's
signed rank test, exact and two-sided; differences of nothing are left out."
  (let* ((moved (remove zero? differences))
         (ranks (doubled-ranks (map abs moved)))
         (ways (fold (lambda (rank ways)
                       (let ((next (make-hash-table)))
                         (hash-for-each (lambda (sum count)
                                          (add-ways! next sum count)
                                          (add-ways! next (+ sum rank) count))
                                        ways)
                         next))
                     (let ((none (make-hash-table))) (add-ways! none 0 1) none)
                     ranks)))
    (two-sided ways (expt 2 (length moved))
               (apply + (map (lambda (d rank) (if (positive? d) rank 0)) moved ranks)))))

(define (smallest-chance m n paired?)
  ;; The least chance that so many rounds can show.
  (if paired?
      (/ 2 (expt 2 (min m n)))
      (/ 2 (let loop ((k 1) (ways 1)) (if (> k m) ways (loop (+ k 1) (/ (* ways (+ n k)) k)))))))


;;; Verdicts.

(define-record <verdict>
  (make-verdict old new chance cost error)
  verdict?
  (old verdict-old)                     ; rows
  (new verdict-new)
  (chance verdict-chance)               ; or #f
  (cost verdict-cost)                   ; better, worse, noise, untold or #f
  (error verdict-error))                ; grew, shrank, same or #f

(define (common-stray report)
  ;; Half of how far the costs of REPORT stray over its rounds, in the median.
  (/ (or (median (filter-map (lambda (row) (and (> (length (row-ratios row)) 1) (spread (row-ratios row))))
                             (report-rows report)))
         0)
     2))

(define (threshold old new)
  (max least-change (common-stray old) (common-stray new)))

(define (pairs xs ys)
  (let ((n (min (length xs) (length ys))))
    (map (lambda (x y) (- (log y) (log x))) (list-head xs n) (list-head ys n))))

(define (chance xs ys paired?)
  (if paired? (signed-rank-chance (pairs xs ys)) (rank-sum-chance xs ys)))

(define (cost-verdict xs ys p limit paired?)
  (let ((change (/ (median ys) (median xs))))
    (cond ((> (smallest-chance (length xs) (length ys) paired?) chance-limit) 'untold)
          ((> p chance-limit) 'noise)
          ((> change (+ 1 limit)) 'worse)
          ((> (/ change) (+ 1 limit)) 'better)
          (else 'noise))))

(define (error-verdict old new)
  (let ((a (row-error old)) (b (row-error new)))
    (cond ((not (or a b)) #f)
          ((not b) 'grew)           ; what cannot be told any more is no better
          ((not a) 'grew)
          (else
           (let ((sure (+ (or (row-uncertainty old) 0) (or (row-uncertainty new) 0) 1e-12)))
             (cond ((= a b) 'same)
                   ((> b (+ (* 1.01 a) sure)) 'grew)
                   ((> a (+ (* 1.01 b) sure)) 'shrank)
                   (else 'same)))))))

(define (judge old new limit paired?)
  (let* ((xs (row-ratios old)) (ys (row-ratios new)) (costs? (and (pair? xs) (pair? ys)))
         (p (and costs? (chance xs ys paired?))))
    (make-verdict old new p
                  (and costs? (cost-verdict xs ys p limit paired?))
                  (error-verdict old new))))

(define (told? row)
  (not (row-calibration? row)))

(define (judge-all old new paired?)
  (let ((limit (threshold old new)) (known (make-hash-table)))
    (for-each (lambda (row) (hash-set! known (row-key row) row)) (report-rows old))
    (filter-map (lambda (row)
                  (and=> (hash-ref known (row-key row)) (lambda (before) (judge before row limit paired?))))
                (filter told? (report-rows new)))))


;;; Words.

(define (verdict-line v)
  (let ((row (verdict-new v)) (old (verdict-old v)))
    (simple-format #f "  ~a: ~a -> ~a, ~a times, p ~a"
                   (string-join (row-key row) ", ")
                   (short-number (row-ratio old)) (short-number (row-ratio row))
                   (short-number (/ (row-ratio row) (row-ratio old)))
                   (short-number (verdict-chance v)))))

(define (error-line v)
  (simple-format #f "  ~a: ~a -> ~a" (string-join (row-key (verdict-new v)) ", ")
                 (or (row-error (verdict-old v)) "none") (or (row-error (verdict-new v)) "none")))

(define (print-some title verdicts line)
  (unless (null? verdicts)
    (simple-format #t "~%~a:~%" title)
    (for-each (lambda (v) (display (line v)) (newline)) verdicts)))

(define (missing from other)
  ;; How many rows of FROM are of benches that OTHER has, but not in it.
  (let ((keys (make-hash-table)) (benches (report-benches other)))
    (for-each (lambda (row) (hash-set! keys (row-key row) #t)) (report-rows other))
    (count (lambda (row)
             (and (told? row) (member (row-bench row) benches) (not (hash-ref keys (row-key row)))))
           (report-rows from))))

(define (print-method old new verdicts paired?)
  (let* ((limit (threshold old new))
         (tested (count (lambda (v) (memq (verdict-cost v) '(better worse noise))) verdicts)))
    (simple-format #t "~a, exact, two-sided, of multiples of the calibration kernel; ~a and ~a rounds.~%"
                   (if paired?
                       "Wilcoxon's signed rank test of builds run by turns"
                       "Wilcoxon's rank sum test of runs made apart")
                   (report-rounds old) (report-rounds new))
    (simple-format #t "Better or worse: p at most ~a and moved by more than ~a %.  Of ~a rows tested some ~a \
pass the first by chance.~%"
                   chance-limit (short-number (* 100 limit)) tested
                   (inexact->exact (round (* chance-limit tested))))
    (simple-format #t "Before: ~a~%Now: ~a~%" (noise-words old) (noise-words new))))

(define (check-comparable old new)
  (unless (equal? (report-form old) (report-form new))
    (bight-raise 'domain 'bench "a ~a report cannot be held against a ~a one: their rows differ"
                 (report-form new) (report-form old))))

(define* (compare-reports old new #:key (paired? #f))
  "Print what is better, worse or noise in the report NEW beside OLD, and return #t unless an error grew.
PAIRED? says that the rounds of both were run by turns."
  (check-comparable old new)
  (let* ((verdicts (judge-all old new paired?))
         (of (lambda (get word) (filter (lambda (v) (eq? word (get v))) verdicts)))
         (grown (of verdict-error 'grew)))
    (print-method old new verdicts paired?)
    (for-each (lambda (word)
                (print-some (symbol->string word) (of verdict-cost word) verdict-line))
              '(worse better))
    (print-some "errors that grew" grown error-line)
    (print-some "errors that shrank" (of verdict-error 'shrank) error-line)
    (simple-format #t "~%~a rows in both: ~a better, ~a worse, ~a noise, ~a untold, which takes ~a rounds of \
each; ~a without a cost.~%"
                   (length verdicts)
                   (length (of verdict-cost 'better)) (length (of verdict-cost 'worse))
                   (length (of verdict-cost 'noise)) (length (of verdict-cost 'untold)) (if paired? 6 4)
                   (length (of verdict-cost #f)))
    (simple-format #t "Errors: ~a grew, ~a shrank, ~a the same.  Gone: ~a rows; new: ~a.~%"
                   (length grown) (length (of verdict-error 'shrank)) (length (of verdict-error 'same))
                   (missing old new) (missing new old))
    (null? grown)))
