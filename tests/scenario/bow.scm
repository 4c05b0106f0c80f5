;;; The first gross behaviour the thesis asks of any model, as a law over random worlds: the bow of a
;;; slack tether points down-current whenever there is current.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(define pi (acos -1))

(define (random-between low high state)
  (+ low (* (- high low) (random:uniform state))))

(define (direction state)
  ;; A unit vector, evenly spread over the sphere.
  (let* ((up (random-between -1 1 state))
         (turn (random-between 0 (* 2 pi) state))
         (flat (sqrt (- 1 (* up up)))))
    (vec (* flat (cos turn)) (* flat (sin turn)) up)))

(define (dot a b)
  (+ (* (x a) (x b)) (* (y a) (y b)) (* (z a) (z b))))

(define (across chord v)
  ;; What of V is across CHORD.
  (let ((t (vec* (/ 1 (norm chord)) chord)))
    (vec- v (vec* (dot v t) t))))

(define (bow points chord)
  ;; From the chord to the mean of the polyline, across the chord.
  (let* ((n (array-length points))
         (sum (let loop ((i 0) (sum (vec 0 0 0)))
                (if (= i n) sum (loop (+ i 1) (vec+ sum (array-cell-ref points i)))))))
    (across chord (vec- (vec* (/ 1 n) sum) (array-cell-ref points 0)))))

(define models '#(v-shape catenary steady))

(define (bows-down-current? state)
  ;; One random world; #t also where the chord lies within a degree of the current.
  (let* ((length (expt 10 (random-between 0 2.5 state)))
         (chord (vec* (* length (random-between 0.05 0.98 state)) (direction state)))
         (speed (random-between 0.05 1.5 state))
         (toward (random-between 0 360 state))
         (model (vector-ref models (random 3 state)))
         (flow (across chord (vec (sin (* toward (/ pi 180))) (cos (* toward (/ pi 180))) 0))))
    (enter! (world (sea (current speed toward))
                   (rov (named minnow) (at chord))
                   (tether (from 0 0 0) (to minnow) (length length) (wet-weight 0) (nodes 24)
                           (model ,model))))
    (or (< (norm flow) (sin (/ pi 180)))
        (> (dot (bow (tether-points 33) chord) flow) 0))))

(define-scenario bow-points-down-current
  "In 10 000 random worlds the bow of a slack neutral tether points down-current."
  (let ((state (seed->random-state 20261121)))
    (let loop ((i 0) (against 0))
      (if (< i 10000)
          (loop (+ i 1) (if (bows-down-current? state) against (+ against 1)))
          (expect against => 0)))))
