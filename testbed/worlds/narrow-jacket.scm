(define-world narrow-jacket
  "A jacket 6.9 m across, and twelve times as much line in it as to the vehicle: laying it must not be long work."
  (sea    (depth 400))
  (splice (make-jacket #:depth 24 #:bays 2 #:top 2 #:spacing 6.908))
  (rov    (named minnow) (at 3.358 -0.589 -14.66))
  (tether (named line) (from 1.9 -2.301 -12.52) (to minnow) (length 35.7)
          (diameter 0.0586) (friction 0.2)))
