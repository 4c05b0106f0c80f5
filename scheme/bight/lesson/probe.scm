;;; (bight lesson probe) --- what a pupil is asked, and how his answer is marked.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(define-module (bight lesson probe)
  #:use-module (bight core decimal)
  #:use-module (bight core errors)
  #:use-module (bight core verb)
  #:use-module (bight dive)
  #:use-module (bight dive task)
  #:use-module (bight lesson guide)
  #:use-module (bight lesson lost)
  #:use-module (bight lesson score)
  #:use-module (bight lesson tally)
  #:export (put-probe last-answer asked-in-degrees?))

(define (compass-error answer truth)
  (let ((d (- answer truth)))
    (abs (- d (* 360 (round (/ d 360)))))))

(define (probe-credit answer truth within degrees?)
  ;; Nothing is left of the mark 3.6 times as far off as is allowed: 90 degrees for 25.
  (let ((off (if degrees? (compass-error answer truth) (abs (- answer truth)))))
    (max 0 (- 1 (/ off (* 3.6 within))))))

(define (probe-mark n question answer truth choices within degrees?)
  ;; The mark of the N-th; who lost it reads QUESTION beside his answer.
  (define label (simple-format #f "question ~a" n))
  (if choices
      (let ((right? (equal? answer truth)))
        (make-mark label (if right? 1 0) 1 right?
                   (simple-format #f "said ~a, it was ~a" answer truth) question))
      (let ((credit (probe-credit answer truth within degrees?))
            (off (if degrees? (compass-error answer truth) (abs (- answer truth)))))
        (make-mark label credit 1 (<= off within)
                   (simple-format #f "said ~a, it was ~a; asked within ~a"
                                  (figure answer) (figure truth) (written-figure within))
                   question))))

(define (checked-truth truth choices)
  (cond ((and choices (not (member truth choices)))
         (bight-raise 'domain 'probe "the truth must be one of ~a, not ~s" choices truth))
        ((and (not choices) (not (real? truth)))
         (bight-raise 'domain 'probe "the truth of a probe without #:choices is a number, not ~s" truth))
        (else truth)))

(define (check-tolerance what value)
  ;; Within nothing no answer could be right.
  (unless (or (not value) (and (real? value) (finite? value) (positive? value)))
    (bight-raise 'domain 'probe "~a of a probe is a number above 0, how near an answer must come, not ~s; \
for one right answer of several say #:choices (A B ...)" what value)))

;; True while a probe is asked whose answer is a bearing.
(define asked-in-degrees? (make-parameter #f))

(define* (put-probe question truth bearing? #:key (within (if bearing? 25 #f)) choices (degrees bearing?)
                    ratio answer)
  "Ask QUESTION, whose answer TRUTH, a thunk, knows: within WITHIN, or by RATIO of the truth, or one of
CHOICES.  BEARING? says that the truth is a bearing unless DEGREES says otherwise.  ANSWER, if given, is
what somebody else than the pupil says, who is asked in his place."
  (check-tolerance "#:within" within)
  (check-tolerance "#:ratio" ratio)
  (let* ((n (+ 1 (tally-ref 'probes 0)))
         (truth (checked-truth (truth) choices))
         (within (cond (choices #f) (ratio (max 1e-9 (abs (* ratio truth)))) (else (or within 1)))))
    (tally-set! 'probes n)
    (log-line! 'probe question)
    (let* ((answer (or answer
                       (parameterize ((asked-in-degrees? (and degrees (not choices))))
                         ((guide-probe (this-guide)) question truth choices))))
           (mark (probe-mark n question answer truth choices within degrees)))
      (add-mark! mark)
      (tally-set! 'answer answer)
      (say-as (if (mark-passed? mark) 'right 'wrong) (mark-detail mark)))))


(define-verb (last-answer)
  "Return the answer to the last probe of the lesson, a number or a symbol, or #f: for (branch ...)."
  (tally-ref 'answer))
