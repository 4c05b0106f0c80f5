;;; A wreck with her stays, and a vehicle about to pass under one of them.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(enter! 'wreck)
(snapshot "fig-wreck.png" #:view '(look (-20 -22 -13) (0 -1 -20)) #:size '(960 540))
