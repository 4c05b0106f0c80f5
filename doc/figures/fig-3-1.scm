;;; Figure 3-1: the boxes about the triangles of a mesh, level by level.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(load "torus.scm")
(write-torus "torus.obj" 36 18)
(enter! (world (sea (depth 12))
               (mesh (named torus) (file "torus.obj") (at 0 0 -8) (up z))
               (rov (named minnow) (at 5 -3 -6) (heading 300))
               (tether (named line) (type fathom) (wet-weight 0) (model catenary) (from -5 -3 -6)
                       (to minnow) (length 11))))
(delete-file "torus.obj")
(for-each (lambda (overlay file)
            (snapshot file #:overlay overlay #:view '(look (4.5 -5.5 -4) (0 0 -8)) #:size '(640 480)))
          '(bvh (bvh 1) (bvh 2) (bvh 3))
          '("fig-3-1.png" "fig-3-1-level-1.png" "fig-3-1-level-2.png" "fig-3-1-level-3.png"))
