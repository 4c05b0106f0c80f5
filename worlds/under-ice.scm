(define-world under-ice
  "Two metres of ice with keels below it, and one hole: the only way out is the way in."
  (sea    (depth 16) (density 1026) (current 0.06 60))
  (seabed (friction 0.6))
  (splice (make-ice-hole #:hole 1.5 #:thickness 2 #:extent 120 #:keels 4))
  (rov    (named minnow) (at 0 1 -6) (heading 0))
  (tether (named line) (type fathom) (wet-weight 0) (friction 0.2) (model dynamic)
          (from 0 0 -3.5) (to minnow) (length 5)))
