;;; (bight lesson lost) --- the marks of a lesson, and where in its dives each was lost.
;;;
;;; The mark of a probe or a task was lost when it was given; that of a measure, where the measure lay farthest outside
;;; its band.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(define-module (bight lesson lost)
  #:use-module (bight dive)
  #:use-module (bight lesson score)
  #:use-module (bight lesson tally)
  #:use-module (srfi srfi-1)
  #:export (session-marks add-mark! lost-marks))

(define (session-marks)
  "Return the marks of probes and tasks so far, in order."
  (reverse (tally-ref 'marks '())))

(define (add-mark! mark)
  "Give MARK now."
  (tally-set! 'marks (cons mark (tally-ref 'marks '())))
  (tally-set! 'given (acons mark (cons (current-dive) (time-or-0)) (tally-ref 'given '()))))

(define (place-of rows row mark)
  ;; (DIVE . TIME) where MARK was lost, which is of ROW, one of ROWS, or of a probe or a task; #f if that was nowhere.
  (if row (row-worst rows row) (assq-ref (tally-ref 'given '()) mark)))

(define (lost-marks marks rows row-marks)
  "Return where MARKS, those of probes and tasks, and ROW-MARKS, those of ROWS in order, were lost: a list of lists
(MARK DIVE TIME), in order of the marks."
  (filter-map (lambda (row mark)
                (let ((place (and (not (mark-passed? mark)) (place-of rows row mark))))
                  (and place (car place) (list mark (car place) (cdr place)))))
              (append (map (const #f) marks) rows)
              (append marks row-marks)))
