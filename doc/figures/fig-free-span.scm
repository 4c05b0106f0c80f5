;;; A tether led under a pipeline, from the manual's first job.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(enter! (world (sea (depth 80) (current (knots 0.5) 70))
               (seabed (friction 0.6))
               (splice (make-pipeline #:name 'pipe #:at '(0 0 -80) #:heading 10 #:length 60 #:radius (inches 10)
                                      #:span 1.2 #:supports 5))
               (box (named garage) (at -12 -5 -66) (size 2 2 2))
               (rov (named minnow) (type kinematic) (at -11 -5 -69) (heading 90))
               (tether (named line) (type falcon) (model dynamic) (from -12 -5 -67.2) (to minnow) (length 6)
                       (drum 150))))
(pay-out! 40 #:rate 0.6)
(for-each (lambda (p) (fly-to! p #:speed 0.5) (run-until arrived? #:at-most 250))
          '((4 -5 -76) (4 8 -79.2) (-4 8 -79.2) (-4 20 -77)))
(snapshot "fig-free-span.png" #:size '(960 540))
