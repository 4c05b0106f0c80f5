;;; Figure 3-3: where a tether met a mesh: the point of the collision and the normal there.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(load "torus.scm")
(draw-against-torus! '(5 2 -6))
(snapshot "fig-3-3.png" #:overlay 'contacts #:view '(look (5 -7 -3) (0 -1 -6)) #:size '(960 540))
