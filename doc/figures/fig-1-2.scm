;;; Figure 1-2: a tether that meets a post is split there; only the part toward the vehicle moves on.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(enter! (world (sea (depth 12) (current 0.25 180))
               (cylinder (named post) (from 0 0 1) (to 0 0 -12) (radius 0.5))
               (rov (named minnow) (at 6 -6 -5))
               (tether (named line) (type fathom) (wet-weight 0) (from -6 -6 -5) (to minnow) (length 20)
                       (model catenary) (response thesis) (sliding #f))))

(define (fly x y)
  (move! (list x y -5) #:speed 0.5)
  (run-until arrived? #:at-most 200))

(fly 6 0)
(snapshot "fig-1-2-before.png" #:view 'plan #:size '(640 480))
(fly 6 2)
(fly 0.5 5)
(snapshot "fig-1-2-after.png" #:view 'plan #:size '(640 480) #:paint 'model)
