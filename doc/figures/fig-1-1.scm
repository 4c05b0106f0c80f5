;;; Figure 1-1: the catenary of a line across a current, from above.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(enter! (world (sea (depth 60) (current 0.5 90))
               (rov (named minnow) (at -10 20 -5))
               (tether (named line) (type fathom) (wet-weight 0) (cdt 0) (from 0 0 -5) (to minnow)
                       (length 40) (model catenary))))
(snapshot "fig-1-1.png" #:view 'plan #:size '(800 600))
