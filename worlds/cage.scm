(define-world cage
  "A cage of thick and thin bars that stands on the bed, open to one side."
  (sea    (depth 20) (current 0.2 90))
  (seabed)
  (group  (named cage) (at 0 0 -20)
          (splice (map
                   (lambda (x i)
                     (list (part capsule (named ,(string->symbol (format #f "back-~a" i)))
                                 (from x 3 0) (to x 3 5) (radius 0.05))
                           (part capsule (named ,(string->symbol (format #f "roof-~a" i)))
                                 (from x -3 5) (to x 3 5) (radius 0.02))))
                   (iota 7 -3) (iota 7 1)))
          (capsule (named port) (from -3 -3 5) (to -3 3 5) (radius 0.1))
          (capsule (named starboard) (from 3 -3 5) (to 3 3 5) (radius 0.1))
          (capsule (named door-port) (from -3 -3 0) (to -3 -3 5) (radius 0.1))
          (capsule (named door-starboard) (from 3 -3 0) (to 3 -3 5) (radius 0.1)))
  (rov    (named minnow) (at 0 -6 -17) (heading 0))
  (tether (named line) (type fathom) (wet-weight 0) (model dynamic)
          (from 0 -16 -8) (to minnow) (length 32)))
