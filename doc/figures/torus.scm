;;; A ring as a mesh file, for figures 3-1, 3-3 and 3-4; and a tether drawn against it.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(define (write-torus file around across)
  ;; Radii 2 m and 0.7 m, as triangles.
  (define (corner i j)
    (let* ((turn (* 2 (acos -1))) (a (* turn (/ i around))) (b (* turn (/ j across)))
           (r (+ 2 (* 0.7 (cos b)))))
      (list (* r (cos a)) (* r (sin a)) (* 0.7 (sin b)))))
  (define (number i j)
    (+ 1 (* across (modulo i around)) (modulo j across)))
  (with-output-to-file file
    (lambda ()
      (for-each (lambda (k)
                  (apply format #t "v ~a ~a ~a~%" (corner (quotient k across) (remainder k across))))
                (iota (* around across)))
      (for-each (lambda (k)
                  (let ((i (quotient k across)) (j (remainder k across)))
                    (format #t "f ~a ~a ~a ~a~%" (number i j) (number (+ i 1) j)
                            (number (+ i 1) (+ j 1)) (number i (+ j 1)))))
                (iota (* around across))))))

(define (draw-against-torus! . places)
  ;; Enter a world with a ring and fly its vehicle, whose tether the ring is to hold, to PLACES.
  (write-torus "torus.obj" 24 12)
  (enter! (world (sea (depth 12) (current 0.25 0))
                 (mesh (named torus) (file "torus.obj") (at 0 0 -6) (up z))
                 (rov (named minnow) (at 5 -6 -6) (heading 0))
                 (tether (named line) (type fathom) (wet-weight 0) (model catenary) (response thesis)
                         (from -5 -6 -6) (to minnow) (length 24))))
  (delete-file "torus.obj")
  (for-each (lambda (p)
              (move! p #:speed 0.4)
              (run-until arrived? #:at-most 90))
            places))
