;;; (bight lesson points) --- points of a lesson to go back to: the dive and the tally together.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(define-module (bight lesson points)
  #:use-module (bight dive checkpoint)
  #:use-module (bight dive time)
  #:use-module (bight lesson tally)
  #:use-module (srfi srfi-1)
  #:export (recent-points save-point! go-back!))

(define points-kept 24)

(define recent-points (make-parameter #f)) ; a variable with a list, the last first; #f: none are kept

(define (save-point!)
  "Keep how things are now, if points are kept, to come back to."
  (when (recent-points)
    (let ((all (cons (list (now) (checkpoint) (tally)) (variable-ref (recent-points)))))
      (variable-set! (recent-points) (take all (min points-kept (length all)))))))

(define (go-back! seconds)
  "Go back to the last point at least SECONDS ago, or to the first there is.  Return the time."
  (let* ((wanted (- (now) seconds))
         (all (variable-ref (recent-points)))
         (point (or (find (lambda (p) (<= (first p) wanted)) all)
                    (last all))))
    (variable-set! (recent-points) (memq point all))
    (let ((rewinds (+ 1 (tally-ref 'rewinds 0))))
      (restore! (second point))
      (restore-tally! (third point))
      (tally-set! 'rewinds rewinds))
    (now)))
