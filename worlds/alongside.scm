(define-world alongside
  "A coaster at anchor, her bow to the north in a slow tide; the boat with the winch lies off her port side."
  (sea     (depth 22) (current 0.15 180))
  (seabed  (friction 0.6))
  (splice  (make-hull #:length 40 #:beam 9 #:draught 4))
  (capsule (named cable) (from 0 32 -15) (to 0 40 -22) (radius 0.06))
  (rov     (named minnow) (at -12 0 -4) (heading 90))
  (tether  (named line) (type fathom) (wet-weight 0) (friction 0.4) (model dynamic)
           (from -18 -2 -1) (to minnow) (length 10) (drum 120)))
