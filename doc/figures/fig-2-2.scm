;;; Figure 2-2: the V of equation 2-1, from above: where it bends, the current to the north.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(enter! (world (sea (depth 60) (current 0.3 0))
               (rov (named minnow) (at 8 -2 -5))
               (tether (named line) (type fathom) (wet-weight 0) (cdt 0) (from 0 0 -5) (to minnow)
                       (length 12) (model v-shape))))
(snapshot "fig-2-2.png" #:view 'plan #:size '(800 600))
