;;; Figure 2-3: the catenary in three dimensions.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(enter! (world (sea (depth 28) (current 0.4 90))
               (rov (named minnow) (at -4 16 -20))
               (tether (named line) (type fathom) (wet-weight 0) (cdt 0) (from 0 0 -14) (to minnow)
                       (length 26) (model catenary))))
(snapshot "fig-2-3.png" #:view '(look (9 -8 -3) (1.5 7.5 -17)) #:size '(960 540))
