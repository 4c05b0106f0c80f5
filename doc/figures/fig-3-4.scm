;;; Figure 3-4: the tether is broken a little outside the surface, so that it does not begin in it.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(load "torus.scm")
(draw-against-torus! '(5 2 -6) '(3 6 -6))
(let ((p (contact-position (car (contacts)))))
  (snapshot "fig-3-4.png" #:overlay 'contacts #:view (list 'look (vec+ p '(0.9 -1.9 0.7)) p)
            #:size '(960 540)))
