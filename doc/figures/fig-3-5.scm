;;; Figure 3-5: the back side: behind an obstacle the current does not bend the new part, it is straight.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(define (fly . places)
  (for-each (lambda (p)
              (move! p #:speed 1)
              (run-until arrived? #:at-most 20))
            places))

(enter! (world (sea (depth 24) (current 0.5 180))
               (box (named container) (at 0 3 -10) (size 6 6 6))
               (rov (named minnow) (at 9 -2 -10))
               (tether (named line) (type fathom) (wet-weight 0) (from -9 -2 -10) (to minnow) (length 23)
                       (nodes 32) (model catenary) (response thesis))))
(fly '(9 4 -10))
(snapshot "fig-3-5-before.png" #:view 'plan #:size '(640 480) #:paint 'model)
(fly '(6 7 -10) '(0 9 -10))
(snapshot "fig-3-5-after.png" #:view 'plan #:size '(640 480) #:paint 'model)
