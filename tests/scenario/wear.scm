;;; The wear of a tether's jacket, as a pilot meets it: what slides on something is worn there, and what was
;;; worn stays worn.  So that it shows in minutes, jackets here are a thousand times as soft as real ones.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(define (events-of kind)
  (filter (lambda (e) (eq? kind (car e))) (events)))

(define (waist abrasiveness)
  ;; A line across the tide, which presses it on an overgrown leg of a jacket and takes it off again.
  (world (sea (depth 40) (current (tide (speed 0.5) (toward 90) (period 120))))
         (cylinder (named leg) (from 0 0 0) (to 0 0 -40) (radius 0.6) (friction 0.4)
                   (abrasiveness abrasiveness))
         (rov (named minnow) (at -0.8 -14 -14))
         (tether (named line) (type fathom) (from -0.8 14 -4) (to minnow) (length 31.5) (nodes 48)
                 (model dynamic) (wear-energy 40) (wear-limit 0.2))))

(define-scenario the-tide-chafes-a-tether-through
  "A tether that the tide saws on a leg wears there, a little each tide and nowhere else, until the limit is
reached; it is said once, with what did it."
  (in (waist 20))
  (expect (wear) => 0.0)
  (let loop ((tides 0) (before 0.0))
    (run 120)
    (expect (wear) is (above before))
    (when (and (< (wear) 0.2) (< tides 12))
      (expect (events-of 'worn) => '())
      (loop (+ tides 1) (wear))))
  (expect (wear) is (between 0.2 0.5))
  (expect (map cddr (events-of 'worn)) => '((line leg)))
  (expect (wear #:at 2) => 0.0)
  (expect (wear #:at 29) => 0.0)
  (run 240)
  (expect (length (events-of 'worn)) => 1))

(define-scenario a-clean-leg-chafes-less
  "Wear goes as the abrasiveness of what it slides on; on what is smooth there is none."
  (let ((worn-by (lambda (abrasiveness)
                   (with-dive (enter! (waist abrasiveness))
                     (run 120)
                     (wear)))))
    (let ((steel (worn-by 1)))
      (expect steel is (above 0))
      (expect (/ (worn-by 20) steel) is (about 20 #:within 1e-9))
      (expect (worn-by 0) => 0.0))))

(define-scenario wear-is-wound-in-and-paid-out
  "The worn spot goes with the tether through the winch, and comes out where it was."
  (in (waist 20))
  (run 120)
  (let* ((profile (wear-profile 316))       ; a place each 0.1 m
         (worst (apply max (array->list profile)))
         (place (* 0.1 (list-index (array->list profile) worst))))
    (collide! 'line 'leg #f)
    (pay-out! 5 #:rate 0.5)
    (run 15)
    (expect (wear #:at (+ 5 place)) is (about worst #:within 1e-12))
    (expect (wear #:at place) => 0.0)
    (expect (wear) is (above (* 0.999 worst)))))

(define (list-index values value)
  (let loop ((k 0) (rest values))
    (if (= (car rest) value) k (loop (+ k 1) (cdr rest)))))

(define-scenario wear-is-part-of-the-state
  "A rewound dive has its wear back, and goes on to the same bit."
  (in (waist 20))
  (run 60)
  (let ((start (checkpoint)) (before (wear)))
    (run 60)
    (let ((after (wear)) (hash (state-hash)))
      (expect after is (above before))
      (restore! start)
      (expect (wear) => before)
      (run 60)
      (expect (wear) => after)
      (expect (state-hash) => hash))))

(define-scenario what-touches-nothing-is-not-worn
  "Far from everything no wear is counted; nor with a model at rest, though it touches."
  (in (with (waist 20) (minnow (at -20 -14 -14)) (line (from -20 14 -4))))
  (run 120)
  (expect (assq-ref (profile) 'chafes) => 0)
  (expect (wear) => 0.0)
  (in (with (waist 20) (line (model catenary) (response thesis))))
  (run 120)
  (expect (wear) => 0.0))
