(define-world open-water
  "Nothing but water: a vehicle 15 m from its anchor on 25 m of neutral line in a gentle current."
  (sea    (depth 40) (current 0.25 90))
  (rov    (named minnow) (at 0 15 -8) (heading 0))
  (tether (named line) (type fathom) (wet-weight 0) (from 0 0 -2) (to minnow) (length 25)))
