;; The tank, the cable and its ends are those of M. Filliung et al., "An augmented catenary model for
;; underwater tethered robots" (ICRA 2024): cable 6, a leaded rope between the side of the tank and a
;; small vehicle; z = 0 is the fixed end.
(define-world tank
  "Still fresh water in a tank: 2.85 m of leaded rope between a fixed end and a vehicle."
  (sea    (depth 3) (density 1000) (gravity 9.81))
  (seabed (friction 0.5))
  (rov    (named minnow) (at -1.8135 -0.4338 -0.6094) (heading 270))
  (tether (named rope) (type leaded-rope) (from 0 0 0) (to minnow) (length 2.85)))
