;;; Figure 3-6: a split whose parts would meet the next face at once: one of them is made straight.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(enter! (world (sea (depth 12) (current 0.5 90))
               (box (named block) (at 1 0 -5) (size 1 2 2))
               (rov (named minnow) (at -3 6 -5))
               (tether (named line) (type fathom) (wet-weight 0) (from -3 -6 -5) (to minnow)
                       (length 12.6) (model catenary) (response thesis) (sliding #f))))
(snapshot "fig-3-6-before.png" #:view 'plan #:size '(640 480))
(move! '(3 4 -5) #:speed 0.4)
(run-until arrived? #:at-most 90)
(snapshot "fig-3-6-after.png" #:view 'plan #:size '(640 480) #:paint 'model)
