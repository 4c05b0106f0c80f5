;;; Figure 1-3: the trainer in the plane, with the V-shaped tether.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(enter! (world (sea (depth 12) (current 0.3 0))
               (cylinder (named pile-1) (from -0.5 -2.2 1) (to -0.5 -2.2 -12) (radius 0.5))
               (cylinder (named pile-2) (from 3.5 -2 1) (to 3.5 -2 -12) (radius 0.5))
               (box (named caisson) (at -4.2 3 -8) (size 2 1.2 8))
               (rov (named minnow) (at 6 0 -5) (heading 30))
               (tether (named line) (type fathom) (wet-weight 0) (from -5 -0.5 -5) (to minnow)
                       (length 14) (model v-shape))))
(snapshot "fig-1-3.png" #:view 'plan #:size '(800 600))
