(define-world free-span
  "A pipeline crosses a scour on five supports; a garage hangs 12 m above the bed, the tide turns."
  (sea     (depth 80) (current (tide (speed 0.35) (toward 90) (period 1440))))
  (seabed  (friction 0.6))
  (splice  (make-pipeline #:at '(0 0 -80) #:length 60 #:radius (inches 10) #:span 1.2 #:supports 5))
  (box     (named garage) (at -12 -5 -66) (size 2 2 2))
  (capsule (named lift-wire) (from -12 -5 -65) (to -12 -5 0) (radius 0.02))
  (rov     (named minnow) (type kinematic) (at -11 -5 -69) (heading 90))
  (tether  (named line) (type falcon) (model dynamic) (friction 0.4)
           (from -12 -5 -67.2) (to minnow) (length 6)))
