;;; The open-water tether of the thesis: shapes, tensions and depth rules against its own figures and
;;; closed forms.  rho 1025 kg/m3, D 7.6 mm, Cn 1.2; a neutral line under normal drag alone is a
;;; catenary of constant tension T = q A, q = rho Cn D U^2 / 2, whose shape does not depend on U.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(define (across speed toward model)
  ;; 40 m of line; the vehicle is 20 m across the current and 10 m up-current, which flows along +-x.
  (world (sea    (depth 60) (current speed toward))
         (rov    (named minnow) (at (if (= toward 90) -10 10) 20 0))
         (tether (named line) (type fathom) (wet-weight 0) (cdt 0)
                 (from 0 0 0) (to minnow) (length 40) (model ,model))))

(define (most-downstream points)
  ;; By how much the polyline lies down a current along x, on the side it bows to.
  (apply max (map (lambda (i) (array-ref points i 0)) (iota (array-length points)))))

(define (all-about? value tolerance values)
  (and-map (lambda (v) (< (abs (- v value)) (* tolerance (abs value)))) values))

(define (numbers array)
  (array->list array))

(define-scenario (bow-and-tension model)
  "Figure 1-1: the bow of a slack line across a current, and its tension, the same everywhere."
  #:for ((model 'catenary 'catenary-simplex 'steady))
  (in (across 0.5 90 model))
  (expect (most-downstream (tether-points 2001)) is (about 10.86766 #:within 0.01))
  (expect (all-about? 5.5120 0.005 (numbers (tensions 101))))
  (expect (tether-force) is (about '(5.4175 -1.0163 0) #:within 0.02))
  (expect (point-at 20) is (about '(8.6038 13.2493 0) #:within 0.02)))

(define-scenario (closed-form-tension up-current span length A)
  "The closed catenary has T = q A, the vehicle up-current or down-current alike."
  #:for ((up-current 10 -10) (span 20) (length 40) (A 4.717166))
  (in (world (sea (current 0.5 90))
             (rov (named minnow) (at (- up-current) span 0))
             (tether (from 0 0 0) (to minnow) (length length) (wet-weight 0) (model catenary))))
  (expect (max-tension) is (about (* 1.1685 A) #:within 1e-5)))

(define-scenario (shape-does-not-know-the-speed speed)
  "A faster current bends the neutral line no differently, only harder."
  #:for ((speed 0.25 0.5 1.0))
  (in (across speed 90 'steady))
  (expect (point-at 20) is (about '(8.6038 13.2493 0) #:within 0.005))
  (expect (/ (max-tension) speed speed) is (about 22.05 #:within 0.04)))

(define-scenario turned-current-mirrors
  "The opposite current, from the opposite side, gives the mirror image."
  (in (across 0.5 270 'steady))
  (expect (point-at 20) is (about '(-8.6038 13.2493 0) #:within 0.005)))

(define-scenario (v-of-equation-2-1 case)
  "The V bends where equation 2-1 says, and keeps its length."
  #:for ((case '(0 (3 4 0)) '(8 (0 0 0)) '(-8 (6 8 0)) '(4 (1.5 2 0))))
  (define-values (up-current bend) (apply values case))
  (in (world (sea (current 0.3 0))
             (rov (named minnow) (at 6 (- up-current) 0))
             (tether (from 0 0 0) (to minnow) (length 10) (wet-weight 0) (model v-shape))))
  (expect (array-cell-ref (tether-points) 1) is (about bend #:within 1e-9)))

(define-scenario (still-water model)
  "Still water and a neutral line: no tension, no NaN; straight when taut, straight down when never bent."
  #:for ((model 'rubber-band 'v-shape 'catenary 'catenary-simplex 'elastic 'steady))
  (in (world (sea) (rov (named minnow) (at 12 0 -5))
             (tether (from 0 0 -5) (to minnow) (length 20) (wet-weight 0) (model ,model))))
  (expect (max-tension) => 0)
  (expect (y (point-at 10)) is (about 0 #:within 1e-9))
  (unless (eq? model 'rubber-band)
    (expect (z (point-at 10)) is (below -8)))
  (place! '(30 0 -5))
  (expect (taut?))
  (expect (straight-distance) is (between 20 22))
  (expect (z (point-at 10)) is (about -5 #:within 1e-9)))

(define-scenario last-bend-is-remembered
  "When the current dies the neutral line stays bent in the plane of its last bend."
  (in (across 0.5 90 'catenary))
  (current! 0 0)
  (expect (point-at 20) is (about '(8.6038 13.2493 0) #:within 0.001))
  (expect (max-tension) => 0))

(define-scenario heavy-chain-in-still-water
  "An inextensible heavy line in still water: w 0.1 N/m between (0,0) and (20,-10), length 30."
  (in (world (sea) (rov (named minnow) (at 20 0 -10))
             (tether (from 0 0 0) (to minnow) (length 30) (wet-weight 0.1) (ea inextensible)
                     (model elastic))))
  (expect (anchor-tension) is (about 2.1600 #:within 1e-4))
  (expect (rov-tension) is (about 1.1600 #:within 1e-4))
  (expect (apply min (map (lambda (s) (z (point-at s))) (iota 3001 0 0.01)))
          is (about -14.896 #:within 1e-3)))

(define (linear model rule factor)
  ;; 60 m across, 20 m up-current, 30 m of depth, on 100 m; the current flows along y.
  (world (sea (current 0.5 0))
         (rov (named minnow) (at 60 -20 -30))
         (tether (from 0 0 0) (to minnow) (length 100) (wet-weight 0) (nodes 1000)
                 (model ,model) (depth-rule ,rule) (thesis-length-factor factor))))

(define (polyline-length points)
  (let loop ((i 1) (sum 0))
    (if (= i (array-length points))
        sum
        (loop (+ i 1)
              (+ sum (distance (array-cell-ref points (- i 1)) (array-cell-ref points i)))))))

(define-scenario v-with-linear-depth
  "Figure B-1: depth in proportion to length, and the length kept."
  (in (linear 'v-shape 'linear 1))
  (let ((points (tether-points)))
    (expect (array-cell-ref points 1)
            is (about '(21.9096 27.0810 -10.9548) #:within 1e-4))
    (expect (polyline-length points) is (about 100 #:within 1e-9))))

(define-scenario (v-by-the-thesis-own-rule case)
  "The thesis' first rule: depth in proportion, the length not kept."
  #:for ((case '(1 (22.5 27.811 -11.25) 101.090) '(0.95 (22.5 27.564 -11.842) 100.732)))
  (define-values (factor bend total) (apply values case))
  (in (linear 'v-shape 'thesis-linear factor))
  (let ((points (tether-points)))
    (expect (array-cell-ref points 1) is (about bend #:within 1e-3))
    (expect (polyline-length points) is (about total #:within 1e-3))))

(define-scenario the-thesis-own-rule-fails-near-taut
  "Its square root goes negative near taut; the dive stays as it was."
  (in (linear 'v-shape 'linear 0.95))
  (place! '(60 0 -79))
  (let ((before (state-hash)))
    (expect (alter! 'tether #:depth-rule 'thesis-linear) raises domain)
    (expect (state-hash) => before)))

(define-scenario catenary-with-linear-depth
  "Figure B-3: the catenary's depth is linear in its length."
  (in (linear 'catenary 'linear 1))
  (expect (and-map (lambda (s) (< (abs (+ (z (point-at s)) (* 0.3 s))) 1e-9)) (iota 101)))
  (expect (polyline-length (tether-points)) is (about 100 #:within 1e-3)))

(define-scenario (sag-tilts-the-plane model)
  "Figures B-2, B-4 and 2-4: buoyancy -0.5 at half the largest current sags -0.25, a tilt of -22.5 deg."
  #:for ((model 'v-shape 'catenary))
  (in (world (sea (current 0.5 90))
             (rov (named minnow) (at 0 20 -8))
             (tether (from 0 0 0) (to minnow) (length 40) (wet-weight 0) (model ,model)
                     (sag-buoyancy -0.5) (max-current 1))))
  ;; The load points along (cos 22.5, 0, -sin 22.5); the curve lies in its plane with the chord.
  (let* ((tilt (* 22.5 (/ (acos -1) 180)))
         (load (vec (cos tilt) 0 (- (sin tilt))))
         (chord (vec 0 20 -8))
         (normal (vec (- (* (y load) (z chord)) (* (z load) (y chord)))
                      (- (* (z load) (x chord)) (* (x load) (z chord)))
                      (- (* (x load) (y chord)) (* (y load) (x chord))))))
    (define (off-plane s)
      (let ((p (point-at s)))
        (/ (+ (* (x p) (x normal)) (* (y p) (y normal)) (* (z p) (z normal))) (norm normal))))
    (expect (apply max (map (lambda (s) (abs (off-plane s))) (iota 41))) is (below 4e-8))
    (expect (x (point-at 20)) is (above 5))))
