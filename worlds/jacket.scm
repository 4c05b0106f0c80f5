;; After figure 3-8 of the thesis: four legs 12 m apart, 1.2 m thick, and their braces.
(define-world jacket
  "Two bays of a jacket in a slow current, the anchor outside: fly in, and find the way back."
  (sea    (depth 36) (current 0.25 90))
  (seabed (friction 0.6))
  (splice (make-jacket #:depth 36 #:bays 2 #:top 2))
  (rov    (named minnow) (at -2 -14 -8) (heading 0))
  (tether (named line) (type fathom) (wet-weight 0) (friction 0.6) (model dynamic)
          (from 0 -22 -3) (to minnow) (length 60)))
