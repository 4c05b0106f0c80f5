(define-world box
  "A container on the bed: its edges are what a tether bends over, its lee is where one hides."
  (sea    (depth 12) (current 0.3 90))
  (seabed (friction 0.6))
  (box    (named container) (at 0 0 -10.7) (size 6 2.4 2.6))
  (rov    (named minnow) (at 0 6 -9) (heading 180))
  (tether (named line) (type fathom) (wet-weight 0) (model dynamic)
          (from 0 14 -2) (to minnow) (length 25)))
