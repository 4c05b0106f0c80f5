(define-world canyon
  "A canyon that bends between two walls, 12 m deep: a tether cuts the corner where its vehicle did not."
  (sea    (depth 40) (current 0.2 20))
  (seabed (friction 0.5)
          (grid (lambda (x y)
                  (let* ((middle (* 6 (sin (/ y 8))))
                         (off (- (abs (- x middle)) 3))
                         (wall (max 0 (min 1 (/ off 5)))))
                    (+ -38 (* 12 wall wall (- 3 (* 2 wall))) (* 0.2 (sin (* 2 x)) (cos (* 3 y))))))
                (from -30 -40) (to 30 40) (spacing 0.5)))
  (rov    (named minnow) (at 0 -24 -33) (heading 0))
  (tether (named line) (type fathom) (model dynamic)
          (from 0 -32 -22) (to minnow) (length 50)))
