(define-world pier
  "Ten piles under a deck, in slack water: there is a way through, and a wrong one back."
  (sea    (depth 9))
  (seabed)
  (splice (make-pier #:depth 9))
  (rov    (named minnow) (at 0 -8 -4) (heading 0))
  (tether (named line) (type fathom) (wet-weight 0) (model dynamic)
          (from -2 -14 -1) (to minnow) (length 35)))
