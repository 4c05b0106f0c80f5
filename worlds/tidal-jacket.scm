;; Mussels on one leg, in a swell: what the tide lays against it the ship saws on it.  The jacket of the
;; tether is soft and the mussels are sharp, so that minutes stand for hours.
(define-world tidal-jacket
  "A jacket with mussels on its south-east leg, in tide and swell; the ship heaves, and saws the tether."
  (sea      (depth 36) (current 0.15 270) (waves (airy (height 2) (period 7) (toward 20))))
  (seabed   (friction 0.6))
  (splice   (make-jacket #:depth 36 #:bays 2 #:top 2))
  (cylinder (named mussels) (from 6 -6 -1) (to 6 -6 -16) (radius 0.7) (friction 0.4) (abrasiveness 100))
  (rov      (named minnow) (type bluerov2-heavy) (at 10 -10 -8) (heading 0))
  (tether   (named line) (type fathom) (wet-weight 0) (friction 0.4) (wear-energy 2e4) (model dynamic)
            (from 0 -22 -3) (to minnow) (ride 1 1 1) (length 20)))
