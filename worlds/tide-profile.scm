(define-world tide-profile
  "A tide that weakens and turns with depth, and a line that floats a little."
  (sea    (depth 60) (current (profile (0 0.6 90) (-30 0.3 80) (-60 0.1 70))))
  (rov    (named minnow) (at 30 20 -45) (heading 60))
  (tether (named line) (type fathom) (from 0 0 -2) (to minnow) (length 75)))
