(define-world rigging
  "Two masts with shrouds and stays of 20 mm wire: what is hard to see and easy to hang on."
  (sea    (depth 25) (current 0.2 90))
  (seabed)
  (splice (make-rigging #:at '(0 0 -25)))
  (rov    (named minnow) (at -8 -8 -18) (heading 45))
  (tether (named line) (type fathom) (wet-weight 0) (model dynamic)
          (from -12 -16 -4) (to minnow) (length 40)))
