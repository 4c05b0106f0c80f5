;;; Figure 3-2: a link of the tether and the one triangle that it comes to.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(with-output-to-file "triangle.obj"
  (lambda () (display "v -1.5 0 -1.2\nv 1.5 0 -1.2\nv 0 0.6 1.4\nf 1 2 3\n")))
(enter! (world (sea (depth 12) (current 0.25 0))
               (mesh (named triangle) (file "triangle.obj") (at 0 0 -5) (up z))
               (rov (named minnow) (at 2 -3 -4.5) (heading 0))
               (tether (named line) (type fathom) (wet-weight 0) (model catenary) (response thesis)
                       (from -2 -3 -5.5) (to minnow) (length 9))))
(delete-file "triangle.obj")
(move! '(3 -1 -4.5) #:speed 0.3)
(run-until arrived? #:at-most 60)
(move! '(3.5 4 -4.5) #:speed 0.3)
(run-until arrived? #:at-most 60)
(snapshot "fig-3-2.png" #:overlay 'contacts #:view '(look (3.5 -6 -3) (0 0 -5)) #:size '(960 540))
