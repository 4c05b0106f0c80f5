(define-world net-pen
  "A net pen 20 m across on eight mooring lines; the current runs through it, the boat lies up-current."
  (sea     (depth 30) (current (profile (0 0.3 90) (-30 0.1 70))))
  (seabed  (friction 0.5))
  (splice  (make-net-pen #:at '(0 0 0) #:radius 10 #:depth 9 #:sides 8 #:mesh 3))
  (splice  (map (lambda (i)
                  (let ((a (* i (/ 3.14159265 4))))
                    (part capsule (named ,(string->symbol (format #f "mooring-~a" i)))
                          (from (* 10 (sin a)) (* 10 (cos a)) -0.5)
                          (to (* 34 (sin a)) (* 34 (cos a)) -29.9) (radius 0.03))))
                (iota 8)))
  (rov     (named minnow) (at -8 -16 -5) (heading 0))
  (tether  (named line) (type fathom) (wet-weight 0) (friction 0.4) (model dynamic)
           (from -12 -22 -1) (to minnow) (length 14) (drum 120)))
