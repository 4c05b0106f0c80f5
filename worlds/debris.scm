(define-world debris
  "What a platform dropped lies about on the bed: two containers, a stub of a pile, a boom, a plate, a drum."
  (sea      (depth 18) (current 0.1 90))
  (seabed   (friction 0.6))
  (box      (named containers) (at 1 -6 -15.4) (size 6 2.4 5.2) (heading 10))
  (cylinder (named stub) (from -1 3 -11) (to -1 3 -18) (radius 0.5))
  (capsule  (named boom) (from 6 -1 -17.7) (to 3.5 8 -12.5) (radius 0.3))
  (box      (named plate) (at -7 -1 -16.8) (size 0.2 3 2.4) (heading 30))
  (capsule  (named drum) (from -4.5 -12 -17.4) (to -3 -13 -17.4) (radius 0.5))
  (rov      (named minnow) (at 3 14 -15) (heading 0))
  (tether   (named line) (type fathom) (wet-weight 0) (friction 0.4) (model dynamic)
            (from 0 -20 -14) (to minnow)
            (via (-3.5 -9 -15) (-3.5 -4 -15) (-2 2.5 -15) (-1.5 4.2 -15) (1.5 7 -15)) (length 39)))
