;;; Figure 3-5: the back side: behind an obstacle the current does not bend the new part, it is straight.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(enter! (world (sea (depth 12) (current 0.5 90))
               (box (named post) (at 0 0 -5) (size 0.6 0.6 10))
               (rov (named minnow) (at 2.346 4.86 -5))
               (tether (named line) (type fathom) (wet-weight 0) (from -1.183 -5.655 -5) (to minnow) (length 12.5)
                       (model catenary) (response thesis) (sliding #f))))
(snapshot "fig-3-5-before.png" #:view 'plan #:size '(640 480))
(for-each (lambda (p)
            (move! p #:speed 0.4)
            (run-until arrived? #:at-most 90))
          '((0 5 -5) (-4 3 -5)))
(snapshot "fig-3-5-after.png" #:view 'plan #:size '(640 480) #:paint 'model)
