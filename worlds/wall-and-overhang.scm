(define-world wall-and-overhang
  "A quay wall with a ledge that juts out over the water: over the wall a clump helps, under the ledge a
float."
  (sea    (depth 14) (current 0.15 0))
  (seabed (friction 0.6))
  (box    (named wall) (at 0 4 -10) (size 40 1.5 8))
  (box    (named ledge) (at 0 1.25 -6.25) (size 40 4 0.5))
  (rov    (named minnow) (at 0 -3 -9) (heading 0))
  (tether (named line) (type fathom) (model dynamic)
          (from 0 -14 -1) (to minnow) (length 32)
          (clump (at 14) (mass 1.5))))
