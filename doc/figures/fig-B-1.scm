;;; Figure B-1: the V with its depth in proportion to its length.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(enter! (world (sea (depth 30) (current 0.5 90))
               (rov (named minnow) (at -4 18 -20))
               (tether (named line) (type fathom) (wet-weight 0) (cdt 0) (from 0 0 -4) (to minnow)
                       (length 34) (model v-shape)
                       (depth-rule linear))))
(snapshot "fig-B-1.png" #:view '((look (17 -12 -2) (2 9 -13)) east) #:size '(1280 480))
