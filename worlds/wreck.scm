(define-world wreck
  "A small ship on her side on the bed, hatch open, masts and stays standing."
  (sea    (depth 24) (current 0.2 90))
  (seabed (friction 0.6))
  (splice (make-wreck #:at '(0 0 -24) #:heading 20))
  (rov    (named minnow) (at -10 -8 -16) (heading 45))
  (tether (named line) (type fathom) (wet-weight 0) (model dynamic)
          (from -16 -18 -3) (to minnow) (length 50)))
