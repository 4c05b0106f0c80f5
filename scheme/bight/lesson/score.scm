;;; (bight lesson score) --- marks: measures sampled while a task lasts, judged against a band.
;;;
;;; A row of (score ...) names a measure and the band it should be in.  Each row makes one mark between
;;; 0 and 1: by `share' the part of the time spent in the band against the part asked for, else by how
;;; far the `end', `most', `least', `mean' or `rms' value lies outside.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(define-module (bight lesson score)
  #:use-module (bight core chart)
  #:use-module (bight core decimal)
  #:use-module (bight core errors)
  #:use-module (bight core record)
  #:use-module ((bight dive) #:select (current-dive))
  #:use-module (bight dive time)
  #:use-module (bight lesson tally)
  #:use-module (srfi srfi-1)
  #:export (make-row row? row-label row-low row-high
            sample-rows! row-samples
            judge-row row-worst
            make-mark mark? mark-label mark-credit mark-weight mark-detail mark-passed? mark-why
            total-of
            words-of-measure
            strip-chart)
  #:re-export (figure))

(define-record <row>
  (%make-row label ask low high by share over weight why)
  row?
  (label row-label)                     ; a string
  (ask row-ask)                         ; a thunk
  (low row-low) (high row-high)
  (by row-by) (share row-share)
  (over row-over)                       ; how far outside nothing is left of the mark
  (weight row-weight)
  (why row-why))                        ; what a pilot who lost this mark should know, a string, or #f

(define ways '(share end most least mean rms))

;; What a pupil reads for a measure that a lesson does not name otherwise.
(define plain-words
  '((clearance . "room about the tether, m")
    (excess . "tether to spare, m")
    (max-tension . "hardest pull, N")
    (net-turns . "turns of the vehicle")
    (now . "time, s")
    (rov-altitude . "height over the bed, m")
    (rov-clearance . "room about the vehicle, m")
    (rov-depth . "depth, m")
    (rov-speed . "speed, m/s")
    (rov-tension . "pull at the vehicle, N")
    (slack . "slack, of 1")
    (tether-length . "tether out, m")
    (wear . "wear, of 1")))

(define (words-of-measure name)
  "Return what a pupil reads for the measure NAME, a symbol, or #f."
  (assq-ref plain-words name))

(define* (make-row label ask low high #:key (by 'share) (share 0.8) over (weight 1) as why)
  "Return the row of a score whose measure ASK, a thunk, should lie from LOW to HIGH.  A pupil reads AS for it, else the
plain words for LABEL, the measure as the lesson has it, else LABEL.
WHY tells one who lost the mark what he should have known."
  (unless (memq by ways)
    (unknown-name 'score "a row of a score" by ways "way of judging"))
  (unless (and (real? low) (real? high) (<= low high))
    (bight-raise 'domain 'score "the band of ~a is two numbers, the lower first, not ~a ~a" label low high))
  (unless (and (real? share) (< 0 share) (<= share 1))
    (bight-raise 'domain 'score "the share of ~a is more than 0 and at most 1, not ~a" label share))
  (for-each (lambda (key text)
              (unless (or (not text) (string? text))
                (bight-raise 'domain 'score "~a of ~a is a text, not ~s" key label text)))
            '(#:as #:why) (list as why))
  (%make-row (or as (words-of-measure (string->symbol label)) label) ask low high by share
             (or over (default-over low high)) weight why))

(define (default-over low high)
  (cond ((and (finite? low) (finite? high) (< low high)) (- high low))
        ((and (finite? high) (not (zero? high))) (abs high))
        ((and (finite? low) (not (zero? low))) (abs low))
        (else 1)))


;;; Samples, kept in the tally: (TIME VALUE ...), the last first.

(define (value-of row)
  ;; A number, or #f where the dive has no answer.
  (with-exception-handler
      (lambda (e) (if (bight-error? e) #f (raise-exception e)))
    (lambda ()
      (let ((value ((row-ask row))))
        (cond ((real? value) (exact->inexact value))
              (value 1.0)
              (else 0.0))))
    #:unwind? #t))

(define (sample-rows! rows)
  "Note the values of the measures of ROWS now."
  (unless (null? rows)
    (tally-set! 'samples (cons (cons (now) (map value-of rows)) (tally-ref 'samples '())))
    (tally-set! 'sampled-in (cons (current-dive) (tally-ref 'sampled-in '())))))

(define (row-samples rows row)
  "Return the values of ROW, one of ROWS, so far, oldest first: pairs of time and value."
  (let ((i (+ 1 (list-index (lambda (r) (eq? r row)) rows))))
    (filter cdr
            (reverse-map (lambda (s) (cons (car s) (list-ref s i))) (tally-ref 'samples '())))))

(define (reverse-map f items)
  (fold (lambda (item done) (cons (f item) done)) '() items))


;;; Marks.

(define-record <mark>
  (%make-mark label credit weight passed? detail why)
  mark?
  (label mark-label)
  (credit mark-credit)                  ; 0 to 1
  (weight mark-weight)
  (passed? mark-passed?)
  (detail mark-detail)
  (why mark-why))                       ; or #f

(define* (make-mark label credit weight passed? detail #:optional why)
  "Return the mark called LABEL: CREDIT of 1, which counts WEIGHT; whether it PASSED?; in DETAIL how it came
about; and WHY it matters, or #f."
  (%make-mark label credit weight passed? detail why))

(define (percent x)
  (string-append (number->string (inexact->exact (round (* 100 x)))) " %"))

(define (inside? row v)
  (<= (row-low row) v (row-high row)))

(define (outside row v)
  (max 0 (- (row-low row) v) (- v (row-high row))))

(define (share-inside row values)
  (/ (count (lambda (v) (inside? row v)) values) (exact->inexact (length values))))

(define (band row values)
  ;; In words; of what is never below 0 it need not be said that it should not be.
  (let ((low (row-low row)) (high (row-high row)))
    (cond ((= low high) (written-figure low))
          ((not (finite? high)) (string-append "at least " (written-figure low)))
          ((or (not (finite? low)) (and (zero? low) (every (lambda (v) (>= v 0)) values)))
           (string-append "at most " (written-figure high)))
          (else (string-append (written-figure low) " to " (written-figure high))))))

(define (key-value row values)
  (case (row-by row)
    ((end) (last values))
    ((most) (apply max values))
    ((least) (apply min values))
    ((mean) (/ (apply + values) (length values)))
    ((rms) (sqrt (/ (apply + (map (lambda (v) (* v v)) values)) (length values))))))

(define (judge-row rows row)
  "Return the mark of ROW, one of ROWS."
  (let ((values (map cdr (row-samples rows row))))
    (cond ((null? values)
           (make-mark (row-label row) 0 (row-weight row) #f "was never measured" (row-why row)))
          ((eq? 'share (row-by row))
           (let* ((part (share-inside row values))
                  (credit (min 1 (/ part (row-share row)))))
             (make-mark (row-label row) credit (row-weight row) (>= part (- (row-share row) 1e-9))
                        (string-append (if (= (row-low row) (row-high row)) "right" (band row values)) " for "
                                       (percent part) " of the time; " (percent (row-share row)) " was asked")
                        (row-why row))))
          (else
           (let* ((v (key-value row values)) (off (outside row v)))
             (make-mark (row-label row) (max 0 (- 1 (/ off (row-over row)))) (row-weight row) (zero? off)
                        (string-append (value-by (row-by row) (figure-told row v)) "; " (band row values) " was asked")
                        (row-why row)))))))

(define (row-worst rows row)
  "Return where the measure of ROW, one of ROWS, lay farthest outside its band, the last place for what is judged at the
end: (DIVE . TIME), or #f if it was never measured."
  (let* ((i (+ 1 (list-index (lambda (r) (eq? r row)) rows)))
         (places (filter-map (lambda (sample dive)
                               (let ((v (list-ref sample i)))
                                 (and v (list (outside row v) dive (first sample)))))
                             (tally-ref 'samples '()) (tally-ref 'sampled-in '()))))
    (and (pair? places)
         (let ((worst (if (eq? 'end (row-by row))
                          (first places)
                          (fold (lambda (a worst) (if (>= (first a) (first worst)) a worst))
                                (first places) (cdr places)))))
           (cons (second worst) (third worst))))))

(define (figure-told row v)
  ;; V in figures, in more of them where it would read like the end of the band that it lies outside.
  (let ((end (if (< v (row-low row)) (row-low row) (row-high row))))
    (if (and (not (inside? row v)) (string=? (figure v) (figure end)))
        (fixed v 4)
        (figure v))))

(define (value-by way value)
  ;; VALUE, a string, and in words which of all values it is.
  (case way
    ((end) (string-append value " at the end"))
    ((most) (string-append "up to " value))
    ((least) (string-append "down to " value))
    ((mean) (string-append value " on average"))
    (else (string-append value " as root mean square"))))

(define (total-of marks)
  "Return the weighted mean of MARKS out of 100, a whole number."
  (let ((weight (apply + (map mark-weight marks))))
    (if (zero? weight)
        100
        (inexact->exact
         (round (* 100 (/ (apply + (map (lambda (m) (* (mark-weight m) (mark-credit m))) marks))
                          weight)))))))


;;; A measure over time in plain characters.

(define (one-after-another samples)
  ;; SAMPLES with times that go on where a lesson's next dive begins at 0 again.
  (let loop ((rest samples) (before 0) (last 0) (all '()))
    (if (null? rest)
        (reverse all)
        (let* ((time (car (car rest))) (before (if (< time last) (+ before last) before)))
          (loop (cdr rest) before time (acons (+ before time) (cdr (car rest)) all))))))

(define (strip-chart row sampled)
  "Return the lines of a plot of SAMPLED, pairs of time and value of the measure of ROW, in plain
characters: * is the measure, . where the band ends."
  (chart-lines (row-label row) (list (cons #\* (one-after-another sampled)))
               #:levels (list (row-low row) (row-high row))))
