;;; (bight belief condition) --- a belief goes by what is observed.
;;;
;;; Each reading weighs the members by its likelihood, so that answers go by it at once (importance sampling).
;;; When few members bear the weight, the belief is mended, in one of two ways.  The smoother waits for that until
;;; it is asked something, and then takes all readings that came meanwhile together.
;;;
;;; `smoother': an ensemble Kalman smoother on the parameters, (bight belief regression), after which the members
;;; are flown again, so that each one's tether is what its own water makes of it.  Much evidence is taken in
;;; stages, each as much as leaves a share of the members effective (Iglesias and Yang, Inverse Problems 37,
;;; 2021), and the readings are predicted anew after each.  Then weights tell apart what no linear model can, of two
;;; members with equal values a line that caught and one that slipped off.  The linear model holds that for noise, so
;;; nothing of the evidence has been spent on it.  The weights are likelihoods to a power below 1, as small as leaves
;;; a share of the members effective, since what a line does among obstacles is as good as chance to the last newton, and
;;; the members are too few for one that slips as the true one does (power posteriors: Friel and Pettitt, Journal of the
;;; Royal Statistical Society B 70, 2008).
;;;
;;; `particles': resampling by forks, in proportion to the weights (systematic: Kitagawa, Journal of
;;; Computational and Graphical Statistics 5, 1996), and a jitter of the latent numbers that keeps their mean and
;;; covariance (Liu and West, in Doucet et al., Sequential Monte Carlo Methods in Practice, 2001).  Nothing is flown
;;; again.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(define-module (bight belief condition)
  #:use-module (bight belief cloud)
  #:use-module (bight belief readings)
  #:use-module (bight belief regression)
  #:use-module (bight belief unknowns)
  #:use-module (bight core errors)
  #:use-module (bight study sweep-design)
  #:use-module (srfi srfi-1)
  #:use-module (srfi srfi-4)
  #:export (take-reading! mend! mend-if-due!))

(define enough 0.25)                    ; of the members, effective: below, a belief is mended
(define stage-leaves 0.4)               ; of the members, effective, after a stage of the smoother
(define most-stages 6)
(define weights-leave 0.35)             ; of the members, effective, after the weights that follow the smoother
(define jitter 0.2)                     ; of the deviation of the latent numbers
(define impossible 5.0)                 ; deviations from what any member foretold
(define growth 0.15)                    ; of the way flown that is flown again, before it is once more
(define memory 18000)                   ; steps after which the past is not flown again


;;; Is a reading possible?

(define (column-spread predictions shares k)
  ;; Mean and variance of number K of PREDICTIONS.
  (let* ((mean (fold (lambda (p w sum) (+ sum (* w (f64vector-ref p k)))) 0.0 predictions shares))
         (variance (fold (lambda (p w sum) (+ sum (* w (expt (- (f64vector-ref p k) mean) 2))))
                         0.0 predictions shares)))
    (values mean variance)))

(define (strange-number? reading predictions shares k)
  ;; Is number K of READING far from what all members foretold, and from what they spread over?
  (call-with-values (lambda () (column-spread predictions shares k))
    (lambda (mean variance)
      (let* ((value (f64vector-ref (reading-scalars reading) k))
             (noise (reading-noise reading))
             (nearest (apply min (map (lambda (p) (abs (- value (f64vector-ref p k)))) predictions))))
        (and (> nearest (* impossible noise))
             (> (abs (- value mean)) (* impossible (sqrt (+ variance (* noise noise))))))))))

(define (impossible? reading predictions shares)
  (if (reading-scalars reading)
      (any (lambda (k) (strange-number? reading predictions shares k))
           (iota (f64vector-length (reading-scalars reading))))
      (every (lambda (p w) (or (< w 1e-9) (<= (f64vector-ref p 0) (least-chance reading))))
             predictions shares)))

(define (least-chance reading)
  ;; What an event has where nothing but a false report explains it.
  (if (eq? 'touched (reading-kind reading))
      (reading-noise reading)
      (exp (* -0.5 impossible impossible))))

(define (doubt! belief reading predictions shares)
  (call-with-values (lambda () (column-spread predictions shares 0))
    (lambda (mean variance)
      (set-belief-doubted! belief (cons (list reading mean (sqrt variance)) (belief-doubted belief))))))


;;; Taking a reading.

(define (weigh! members reading predictions)
  (for-each (lambda (member prediction)
              (let ((gain (log-chance reading prediction)))
                (if (reading-scalars reading)
                    (set-member-weight! member (+ gain (member-weight member)))
                    (set-member-event-weight! member (+ gain (member-event-weight member))))))
            members predictions))

(define (remember! belief reading predictions)
  ;; Predictions stand for all members in order; a lost one has #f.
  (set-reading-predictions! reading
                            (let loop ((members (belief-members belief)) (rest predictions))
                              (cond ((null? members) '())
                                    ((member-lost? (car members)) (cons #f (loop (cdr members) rest)))
                                    (else (cons (car rest) (loop (cdr members) (cdr rest)))))))
  (set-belief-readings! belief (cons reading (belief-readings belief))))

(define (take-reading! belief reading)
  "Let BELIEF, flown to where READING was read, go by it.  Return `taken', or `impossible' if no member could
explain it: then the belief is as it was, but for its doubts."
  (let* ((members (living belief))
         (predictions (map (lambda (m) (predicted reading m (belief-unknowns belief))) members))
         (shares (f64vector->list (weights belief))))
    (if (or (null? members) (impossible? reading predictions shares))
        (begin
          (unless (null? members) (doubt! belief reading predictions shares))
          'impossible)
        (begin
          (weigh! members reading predictions)
          (remember! belief reading predictions)
          (when (if (eq? 'particles (belief-kind belief)) (poor? belief) (old? belief))
            (mend! belief))
          'taken))))

(define (poor? belief)
  (< (effective-number (weights belief)) (* enough (length (belief-members belief)))))

(define (old? belief)
  (> (- (belief-step belief) (belief-origin-step belief)) memory))

(define (due? belief)
  ;; Has it flown on for long enough that to fly again costs a bounded multiple of the dive?
  (let ((last (if (null? (belief-rounds belief)) -inf.0 (third (car (belief-rounds belief))))))
    (>= (- (belief-step belief) last) (* growth (- (belief-step belief) (belief-origin-step belief))))))

(define (mend-if-due! belief)
  "Mend BELIEF if few of its members bear the weight, before it answers."
  (when (and (not (null? (living belief))) (poor? belief) (due? belief))
    (mend! belief)))


;;; Resampling.

(define (systematic shares n start)
  ;; N places among SHARES, in proportion to them; START is the first point, from 0 to 1.
  (let loop ((k 0) (i 0) (sum (f64vector-ref shares 0)) (places '()))
    (cond ((= k n) (reverse! places))
          ((or (<= (/ (+ k start) n) sum) (= i (- (f64vector-length shares) 1)))
           (loop (+ k 1) i sum (cons i places)))
          (else (loop k (+ i 1) (+ sum (f64vector-ref shares (+ i 1))) places)))))

(define (stream belief)
  ;; Random numbers of the present mending.
  (number-stream 'belief (belief-seed belief) (length (belief-rounds belief))))

(define (resample! belief shares)
  ;; Every member becomes a copy of a living one, in proportion to SHARES; those chosen stay where they are.
  (let* ((all (list->vector (belief-members belief)))
         (n (vector-length all))
         (alive (list->vector (filter (lambda (i) (not (member-lost? (vector-ref all i)))) (iota n))))
         (chosen (map (lambda (k) (vector-ref alive k)) (systematic shares n ((stream belief) 0))))
         (kept (delete-duplicates chosen))
         (copies (surplus chosen))
         (places (lset-difference = (iota n) kept)))
    (for-each (lambda (to from)
                (copy-member! belief (vector-ref all to) (vector-ref all from))
                (for-each (lambda (r) (copy-prediction! r to from)) (belief-readings belief)))
              places copies)
    places))

(define (surplus chosen)
  ;; The elements of CHOSEN, a sorted list, that repeat the one before.
  (filter-map (lambda (a b) (and (= a b) b)) chosen (if (null? chosen) '() (cdr chosen))))

(define (copy-prediction! reading to from)
  (let ((predictions (list->vector (reading-predictions reading))))
    (vector-set! predictions to (vector-ref predictions from))
    (set-reading-predictions! reading (vector->list predictions))))

(define (jitter! belief places)
  ;; Liu and West's kernel: toward the mean, and off it again by as much as that takes from the covariance.  The
  ;; step off is along differences of two members drawn at random, whose covariance is twice that of all.
  (let* ((members (list->vector (belief-members belief)))
         (n (vector-length members))
         (latents (map member-latent (belief-members belief)))
         (mean (mean-latent latents))
         (random (stream belief))
         (at -1)
         (draw (lambda () (set! at (+ at 1)) (random (+ 1 at))))
         (pick (lambda () (list-ref latents (inexact->exact (floor (* n (draw)))))))
         (a (sqrt (- 1 (* jitter jitter)))))
    (for-each
     (lambda (place)
       (let* ((z (member-latent (vector-ref members place)))
              (p (pick)) (q (pick))
              (size (* jitter (normal-quantile (draw)) (sqrt 0.5))))
         (set-member-latent! (vector-ref members place)
                             (combine (lambda (z m p q) (+ m (* a (- z m)) (* size (- p q)))) z mean p q))))
     places)))

(define (combine f . vectors)
  (list->f64vector (apply map f (map f64vector->list vectors))))

(define (mean-latent latents)
  (let ((n (length latents)))
    (apply combine (lambda all (/ (apply + all) n)) latents)))


;;; Numbers that are read one after another by one instrument are taken together in blocks, as their means.

(define most-blocks 12)                 ; of one kind of reading

(define (blocks items)
  ;; ITEMS in order, in at most `most-blocks' lists.
  (let ((size (quotient (+ (length items) most-blocks -1) most-blocks)))
    (let loop ((rest items) (found '()))
      (if (<= (length rest) size)
          (reverse! (cons rest found))
          (loop (list-tail rest size) (cons (list-head rest size) found))))))

(define (groups readings)
  ;; READINGS by what they are of, each group in the order of time.
  (let loop ((rest (reverse readings)) (found '()))
    (if (null? rest)
        (map (lambda (entry) (reverse (cdr entry))) found)
        (let* ((r (car rest)) (key (list (reading-kind r) (reading-part r))) (entry (assoc key found)))
          (loop (cdr rest)
                (acons key (cons r (if entry (cdr entry) '())) (if entry (delq entry found) found)))))))

(define (mean numbers) (/ (apply + numbers) (length numbers)))

(define (block-number readings k)
  ;; (VALUE VARIANCE FORETOLD) of the mean of number K of READINGS.
  (list (mean (map (lambda (r) (f64vector-ref (reading-scalars r) k)) readings))
        (/ (mean (map (lambda (r) (expt (reading-noise r) 2)) readings)) (length readings))
        (list->f64vector
         (apply map (lambda all (mean (map (lambda (p) (f64vector-ref p k)) all)))
                (map reading-predictions readings)))))

(define (block-numbers readings)
  (append-map (lambda (group)
                (append-map (lambda (block)
                              (map (lambda (k) (block-number block k))
                                   (iota (f64vector-length (reading-scalars (car block))))))
                            (blocks group)))
              (groups readings)))

(define (latent-columns belief)
  (map (lambda (k)
         (list->f64vector (map (lambda (m) (f64vector-ref (member-latent m) k)) (belief-members belief))))
       (iota (unknowns-size (belief-unknowns belief)))))

(define (set-latents! belief columns)
  (for-each (lambda (member i)
              (set-member-latent! member (list->f64vector (map (lambda (c) (f64vector-ref c i)) columns))))
            (belief-members belief) (iota (length (belief-members belief)))))


;;; Mending.

(define (shares-of logarithms power)
  (let* ((most (fold max -inf.0 logarithms))
         (raw (map (lambda (l) (exp (* power (- l most)))) logarithms))
         (sum (apply + raw)))
    (list->f64vector (map (lambda (w) (/ w sum)) raw))))

(define (stage-share logs left leaves)
  ;; How much of the evidence, at most LEFT, leaves the share LEAVES of the members effective.
  (define (fine? share)
    (>= (effective-number (shares-of logs share)) (* leaves (length logs))))
  (if (fine? left)
      left
      (let search ((low 0.0) (high left) (n 30))
        (let ((middle (/ (+ low high) 2)))
          (cond ((zero? n) (max low 1e-6))
                ((fine? middle) (search middle high (- n 1)))
                (else (search low middle (- n 1))))))))

(define (predict-again! belief)
  ;; Fly the members again, and predict every reading anew.
  (fly-again! belief
              #:look! (lambda (reading)
                        (set-reading-predictions!
                         reading
                         (map (lambda (m)
                                (and (not (member-lost? m)) (predicted reading m (belief-unknowns belief))))
                              (belief-members belief))))))

(define (take-stage! belief readings left last?)
  ;; Let the members go by as much of the evidence of READINGS, at most LEFT, as fits into a stage; return that.
  (let* ((numbers (block-numbers readings))
         (columns (latent-columns belief))
         (linear (linearise columns (map third numbers) (map first numbers) (map second numbers)))
         (share (if last? left (stage-share (linear-logs linear columns) left stage-leaves))))
    (move-columns! linear columns share)
    (set-latents! belief columns)
    (predict-again! belief)
    (replace-lost! belief)
    share))

(define (weigh-by-course! belief)
  ;; Weigh the members by all numbers that were read since they were flown from the origin.
  (let* ((readings (filter reading-scalars (belief-readings belief)))
         (logs (map (lambda (i) (sum-of (lambda (r) (log-chance r (list-ref (reading-predictions r) i))) readings))
                    (iota (length (belief-members belief)))))
         (power (stage-share logs 1.0 weights-leave))
         (most (fold max -inf.0 logs)))
    (for-each (lambda (member log) (set-member-weight! member (* power (- log most))))
              (belief-members belief) logs)))

(define (sum-of f items) (fold (lambda (item sum) (+ sum (f item))) 0.0 items))

(define (pending-numbers belief)
  (filter (lambda (r) (and (reading-scalars r) (not (reading-done? r)))) (belief-readings belief)))

(define (smooth! belief)
  ;; Return how many stages it took.
  (let ((pending (pending-numbers belief)))
    (let loop ((left (if (null? pending) 0.0 1.0)) (stage 0))
      (if (< left 1e-9)
          (begin
            (weigh-by-course! belief)
            (for-each (lambda (r) (set-reading-done! r #t)) pending)
            stage)
          (loop (- left (take-stage! belief pending left (= stage (- most-stages 1)))) (+ stage 1))))))

(define (check-living belief)
  (when (null? (living belief))
    (bight-raise 'diverged 'belief "no tether of this belief is left: each one's dive failed, or refused what was done")))

(define (replace-lost! belief)
  ;; Those whose dives failed become copies of others.
  (check-living belief)
  (unless (= (length (living belief)) (length (belief-members belief)))
    (let ((n (length (living belief))))
      (resample! belief (make-f64vector n (/ 1.0 n))))))

(define (note-round! belief stages)
  (set-belief-rounds! belief (cons (list (belief-kind belief) stages (belief-step belief)) (belief-rounds belief))))

(define (forget-weights! belief)
  (for-each (lambda (m)
              (set-member-weight! m 0.0)
              (set-member-event-weight! m 0.0))
            (belief-members belief)))

(define (mend-by-particles! belief)
  (let ((shares (weights belief)))
    (resample! belief shares)
    (forget-past! belief)
    (jitter! belief (iota (length (belief-members belief))))
    (forget-weights! belief)
    (fly-again! belief)                 ; no way at all: each takes its values
    (note-round! belief 0)))

(define (event-shares belief)
  (shares-of (map member-event-weight (living belief)) 1.0))

(define (mend-by-smoother! belief)
  ;; What was seen to happen chooses among the members first; numbers then move them.
  (replace-lost! belief)
  (let* ((n (length (belief-members belief)))
         (shares (event-shares belief)))
    (when (< (effective-number shares) (* 0.999 n))
      (jitter! belief (resample! belief shares)))
    (forget-weights! belief)
    (note-round! belief (smooth! belief))
    (when (old? belief)
      (keep-weights! belief)
      (forget-past! belief))))

(define (keep-weights! belief)
  ;; What the numbers told of each member's course is kept as what was seen to happen: its course is not flown again.
  (for-each (lambda (m)
              (set-member-event-weight! m (+ (member-weight m) (member-event-weight m)))
              (set-member-weight! m 0.0))
            (belief-members belief)))

(define (mend! belief)
  "Move the members of BELIEF to where what it knows lies, so that many bear its weight.  Raise diverged if none is left.
Who leaves before the end, as by ^C, leaves BELIEF as it was."
  (check-living belief)
  (let ((back! (way-back belief)))
    (with-exception-handler
     (lambda (e)
       (unless (bight-error? e) (back!))
       (raise-exception e))
     (lambda ()
       (if (eq? 'particles (belief-kind belief))
           (mend-by-particles! belief)
           (mend-by-smoother! belief)))
     #:unwind? #t)))
