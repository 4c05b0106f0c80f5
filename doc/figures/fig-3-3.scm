;;; Figure 3-3: where a tether met a mesh: the point of the collision and the normal there.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(load "torus.scm")
(write-torus "torus.obj" 24 12)
(enter! (world (sea (depth 12) (current 0.25 0))
               (mesh (named torus) (file "torus.obj") (at 0 0 -6) (up z))
               (rov (named minnow) (at 5 -6 -6) (heading 0))
               (tether (named line) (type fathom) (wet-weight 0) (model catenary) (response thesis)
                       (from -5 -6 -6) (to minnow) (length 24))))
(delete-file "torus.obj")
(for-each (lambda (p)
            (move! p #:speed 0.4)
            (run-until arrived? #:at-most 90))
          '((5 2 -6)))
(snapshot "fig-3-3.png" #:overlay 'contacts #:view '(look (5 -7 -3) (0 -1 -6)) #:size '(960 540))
