;; A tether management system: the garage hangs from the ship beside the riser, 20 m above the blow-out
;; preventer, and pays out from its underside.
(define-world garage
  "A garage hangs 20 m above a blow-out preventer, beside its riser; the tide sets past both, and turns."
  (sea    (depth 100) (current (tide (speed 0.35) (toward 0) (period 1080))))
  (seabed (friction 0.6))
  (splice (make-wellhead #:at '(0 0 -100) #:riser 60))
  (box    (named top-hat) (at -7 0 -65) (size 1.8 1.8 2))
  (capsule (named lift-wire) (from -7 0 -64) (to -7 0 0) (radius 0.02))
  (rov    (named minnow) (type kinematic) (at -6 1 -67.5) (heading 90))
  (tether (named line) (type falcon) (friction 0.4) (model dynamic)
          (from -7 0 -66.2) (to minnow) (length 5)))
