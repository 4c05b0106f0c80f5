;;; Figure 3-4: the tether is broken a little outside the surface, so that it does not begin in it.
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
          '((5 2 -6) (3 6 -6)))
(let ((p (contact-position (car (contacts)))))
  (snapshot "fig-3-4.png" #:overlay 'contacts #:view (list 'look (vec+ p '(0.9 -1.9 0.7)) p)
            #:size '(960 540)))
