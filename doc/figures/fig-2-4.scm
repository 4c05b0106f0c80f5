;;; Figure 2-4: the tether in space, and what one sees of it from above and from the side.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(enter! (world (sea (depth 30) (current 0.5 90))
               (rov (named minnow) (at -4 16 -16))
               (tether (named line) (type fathom) (wet-weight 0) (cdt 0) (from 0 0 -6) (to minnow)
                       (length 30) (model catenary)
                       (sag-buoyancy -0.5) (max-current 1))))
(snapshot "fig-2-4.png" #:view '((look (18 -8 -3) (2 8 -13)) top north east) #:size '(1280 720))
