;;; Figure B-2: the V whose plane sags: its first link is the steeper one.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(enter! (world (sea (depth 30) (current 0.5 90))
               (rov (named minnow) (at -4 18 -20))
               (tether (named line) (type fathom) (wet-weight 0) (cdt 0) (from 0 0 -4) (to minnow)
                       (length 34) (model v-shape)
                       (depth-rule sag) (sag-buoyancy -0.5) (max-current 1))))
(snapshot "fig-B-2.png" #:view '((look (17 -12 -2) (2 9 -13)) east) #:size '(1280 480))
