(define-world beside-a-post
  "A kinematic vehicle on a short line of few nodes, beside a post: a belief of it costs little."
  (sea      (depth 20) (current 0.2 90))
  (cylinder (named post) (from 3 6 0) (to 3 6 -20) (radius 0.3))
  (rov      (named minnow) (type kinematic) (at 0 12 -8) (heading 0))
  (tether   (named line) (type fathom) (wet-weight 0) (model dynamic) (nodes 8) (from 0 0 -2) (to minnow)
            (length 16)))
