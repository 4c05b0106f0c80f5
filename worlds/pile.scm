(define-world pile
  "One pile in a gentle current, to drive round: each time round adds a turn."
  (sea      (depth 15) (current 0.25 90))
  (cylinder (named p1) (from 0 0 1) (to 0 0 -15) (radius 0.45))
  (rov      (named minnow) (at 6 -6 -5) (heading 0))
  (tether   (named line) (type fathom) (wet-weight 0) (model dynamic)
            (from -6 -8 -3) (to minnow) (length 40)))
