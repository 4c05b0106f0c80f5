(define-world deep-jacket
  "Everything at once: a vehicle with mass in a jacket of 60 m, its lee in a current, a line from a ship in a wind sea."
  (sea    (depth 60) (current 0.3 90) (wake yes)
          (waves (jonswap (height 1.5) (period 7) (toward 0) (components 32) (seed 3) (accuracy 1e-4))))
  (splice (make-jacket #:depth 60))
  (rov    (named minnow) (type bluerov2-heavy) (at 0 0 -30))
  (tether (named line) (mass 0.043) (ea 1e5) (nodes 100) (model dynamic)
          (from -1 -12 0) (to minnow) (ride 1 1 1) (length 40)))
