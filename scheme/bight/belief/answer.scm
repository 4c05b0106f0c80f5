;;; (bight belief answer) --- what a belief answers: every question of a dive as a distribution.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(define-module (bight belief answer)
  #:use-module (bight belief cloud)
  #:use-module (bight core argument)
  #:use-module (bight core errors)
  #:use-module (bight core record)
  #:use-module (bight core verb)
  #:use-module ((bight study risk) #:select (short))
  #:use-module (srfi srfi-1)
  #:use-module (srfi srfi-4)
  #:use-module ((srfi srfi-9 gnu) #:select (set-record-type-printer!))
  #:export (ask-members
            answer? answer-values answer-weights
            share-interval
            answer-probability answer-interval answer-quantile answer-mean answer-covariance answer-shares))

(define-record <answer>
  (make-answer kind values shares effective silent)
  is-answer?
  (kind answer-kind)                    ; chance, number, point or choice
  (values answer-list)                  ; of the members that had one
  (shares answer-share-list)            ; of these, together 1
  (effective answer-effective)          ; how many equal members they are as good as
  (silent answer-silent))               ; the share of those that had none

(define-argument-type (answer value)
  "what `belief' answers"
  (if (is-answer? value) value refused))

(define (kind-of values)
  (cond ((null? values) 'choice)
        ((every boolean? values) 'chance)
        ((every (lambda (v) (and (real? v) (< -inf.0 v +inf.0))) values) 'number)
        ((every (lambda (v) (and (f64vector? v) (= 3 (f64vector-length v)))) values) 'point)
        (else 'choice)))

(define-record <refusal>
  (make-refusal error)
  refusal?
  (error refusal-error))

(define (asked member thunk)
  ;; What THUNK returns with the dive of MEMBER as the current one, or a refusal.
  (with-exception-handler
   (lambda (e) (if (bight-error? e) (make-refusal e) (raise-exception e)))
   (lambda () (in-member member thunk))
   #:unwind? #t))

(define (ask-members belief thunk)
  "Call THUNK with the dive of each living member of BELIEF as the current one, and return all it returned as one
answer.  Where it refuses in every one, raise what it raised in the first."
  (let* ((shares (f64vector->list (weights belief)))
         (all (map-in-order (lambda (member) (asked member thunk)) (living belief)))
         (told (filter (lambda (pair) (not (refusal? (car pair)))) (map cons all shares)))
         (sum (fold (lambda (pair sum) (+ sum (cdr pair))) 0.0 told))
         (kept (map (lambda (pair) (/ (cdr pair) sum)) told)))
    (when (and (null? told) (pair? all)) (raise-exception (refusal-error (car all))))
    (make-answer (kind-of (map car told)) (map car told) kept
                 (if (null? kept) 0 (effective-number (list->f64vector kept)))
                 (- 1 sum))))

(define (check-kind proc answer kinds)
  (unless (memq (answer-kind answer) kinds)
    (bight-raise 'unsupported proc "this answer is ~a, not ~a" (sentence answer)
                 (assq-ref '((chance . "true or false") (number . "a number") (point . "a point")) (car kinds)))))

(define (sentence answer)
  (case (answer-kind answer)
    ((chance) "true or false")
    ((number) "a number")
    ((point) "a point")
    (else "one of several values")))

(define-verb (answer? (object any))
  "Return #t if OBJECT is what `belief' answered."
  (is-answer? object))
(define-verb (answer-values (a answer))
  "Return what the members of the belief answered in A, a list."
  (answer-list a))
(define-verb (answer-weights (a answer))
  "Return the shares of those that answered in A, a list that adds up to 1."
  (answer-share-list a))


;;; True or false.

(define (weighted-sum answer f)
  (fold (lambda (value share sum) (+ sum (* share (f value)))) 0.0
        (answer-list answer) (answer-share-list answer)))

(define-verb (answer-probability (a answer))
  "Return the probability that A, an answer that is true or false, is true."
  (check-kind 'answer-probability a '(chance))
  (weighted-sum a (lambda (v) (if v 1.0 0.0))))

(define z-95 1.959963984540054)

(define (share-interval p n)
  "Return the list (LOW HIGH), Wilson's interval for 95 % confidence, of the share P of N, which need not be whole."
  (let* ((zz (* z-95 z-95))
         (middle (/ (+ p (/ zz (* 2 n))) (+ 1 (/ zz n))))
         (half (/ (* z-95 (sqrt (+ (/ (* p (- 1 p)) n) (/ zz (* 4 n n))))) (+ 1 (/ zz n)))))
    (list (max 0.0 (- middle half)) (min 1.0 (+ middle half)))))


;;; Numbers.

(define (quantile answer share)
  ;; By linear interpolation between the middles of the members' shares.
  (let* ((pairs (sort (map cons (answer-list answer) (answer-share-list answer))
                      (lambda (a b) (< (car a) (car b))))))
    (let loop ((rest (cdr pairs)) (value (caar pairs)) (middle (/ (cdar pairs) 2)) (width (cdar pairs)))
      (cond ((or (null? rest) (<= share middle)) value)
            (else
             (let* ((next-width (cdar rest))
                    (next (+ middle (/ (+ width next-width) 2))))
               (if (<= share next)
                   (+ value (* (- (caar rest) value)
                               (if (= next middle) 1 (/ (- share middle) (- next middle)))))
                   (loop (cdr rest) (caar rest) next next-width))))))))

(define (bound answer share)
  ;; What is below a truth drawn as the members are with probability SHARE: of n equal members k lie below with (k + 1)
  ;; chances in n + 1 (E. J. Gumbel, Statistics of Extremes, 1958, section 1.2.7), interpolated.  No bound is beyond all.
  (let* ((pairs (sort (map cons (answer-list answer) (answer-share-list answer)) (lambda (a b) (< (car a) (car b)))))
         (wanted (* share (+ 1 (/ 1 (answer-effective answer))))))
    (let loop ((rest (cdr pairs)) (value (caar pairs)) (sum (cdar pairs)))
      (if (or (null? rest) (<= wanted sum))
          value
          (let ((next (+ sum (cdar rest))))
            (if (<= wanted next)
                (+ value (* (- (caar rest) value) (/ (- wanted sum) (- next sum))))
                (loop (cdr rest) (caar rest) next)))))))

(define-verb (answer-quantile (a answer) (share (between 0 1)))
  "Return the number below which A, an answer that is a number, lies with probability SHARE."
  (check-kind 'answer-quantile a '(number))
  (quantile a share))

(define-verb (answer-interval (a answer) #:optional (share (between 0 1) 0.9))
  "Return the list (LOW HIGH) that holds the number A with probability SHARE, as much beyond either end, as far as its
members reach: n of them hold it with (n - 1) / (n + 1) at most; of an answer that is true or false Wilson's interval, for 95 % confidence, of
its probability."
  (check-kind 'answer-interval a '(number chance))
  (if (eq? 'chance (answer-kind a))
      (share-interval (answer-probability a) (answer-effective a))
      (list (bound a (/ (- 1 share) 2)) (bound a (/ (+ 1 share) 2)))))


;;; Points.

(define-verb (answer-mean (a answer))
  "Return the mean of A, an answer that is a number or a point."
  (check-kind 'answer-mean a '(number point))
  (if (eq? 'number (answer-kind a))
      (weighted-sum a identity)
      (list->f64vector (map (lambda (k) (weighted-sum a (lambda (p) (f64vector-ref p k)))) '(0 1 2)))))

(define-verb (answer-covariance (a answer))
  "Return the covariance of A, an answer that is a point, m2: a list of three rows."
  (check-kind 'answer-covariance a '(point))
  (let ((mean (answer-mean a)))
    (map (lambda (i)
           (map (lambda (j)
                  (weighted-sum a (lambda (p) (* (- (f64vector-ref p i) (f64vector-ref mean i))
                                                 (- (f64vector-ref p j) (f64vector-ref mean j))))))
                '(0 1 2)))
         '(0 1 2))))


;;; Anything else.

(define-verb (answer-shares (a answer))
  "Return the alist of the different values in A and their probabilities, the likeliest first."
  (let loop ((values (answer-list a)) (shares (answer-share-list a)) (found '()))
    (if (null? values)
        (sort found (lambda (a b) (> (cdr a) (cdr b))))
        (loop (cdr values) (cdr shares)
              (let ((entry (assoc (car values) found)))
                (acons (car values) (+ (car shares) (if entry (cdr entry) 0.0))
                       (remove (lambda (e) (equal? (car e) (car values))) found)))))))


;;; In words.

(define nothing 1e-9)                   ; m: no more is rounding

(define (deviations answer)
  (map (lambda (row k)
         (let ((deviation (sqrt (max 0.0 (list-ref row k)))))
           (if (< deviation nothing) 0 deviation)))
       (answer-covariance answer) '(0 1 2)))

(define (probability->string p) (short (/ (round (* 1000 p)) 1000.0)))

(define (body answer)
  (case (answer-kind answer)
    ((chance)
     (let ((interval (answer-interval answer)))
       (simple-format #f "~a (~a to ~a)" (probability->string (answer-probability answer))
                      (probability->string (first interval)) (probability->string (second interval)))))
    ((number)
     (simple-format #f "~a (90 %: ~a to ~a)" (short (quantile answer 0.5))
                    (short (bound answer 0.05)) (short (bound answer 0.95))))
    ((point)
     (simple-format #f "~a +- ~a m" (map short (f64vector->list (answer-mean answer)))
                    (map short (deviations answer))))
    (else (shares-said (answer-shares answer)))))

(define most-said 6)                    ; different values

(define (shares-said shares)
  (let ((left (- (length shares) most-said))
        (said (map (lambda (entry) (simple-format #f "~a: ~a" (car entry) (probability->string (cdr entry))))
                   (list-head shares (min most-said (length shares))))))
    (string-join (if (positive? left) (append said (list (simple-format #f "~a more" left))) said) ", ")))

(set-record-type-printer!
 <answer>
 (lambda (answer port)
   (simple-format port "#<answer ~a, ~a tethers~a>" (if (null? (answer-list answer)) "none" (body answer))
                  (short (answer-effective answer))
                  (if (> (answer-silent answer) 1e-9)
                      (simple-format #f "; ~a without an answer" (probability->string (answer-silent answer)))
                      ""))))
