(define-world cross-current
  "Forty metres of neutral line across half a metre a second: the bow points down-current."
  (sea    (depth 60) (density 1025) (current 0.5 90))
  (rov    (named minnow) (at -10 20 -10) (heading 0))
  (tether (named line) (type fathom) (wet-weight 0) (from 0 0 -10) (to minnow) (length 40)))
