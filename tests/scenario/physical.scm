;;; Statics beyond the thesis: the equilibrium in a current with weight, drag and stretch.  The numbers
;;; are shooting solutions (RK4, 4000 steps) of d(T t)/ds + w + drag = 0 with Ct 0.01 on pi D,
;;; rho 1025 kg/m3, D 7.6 mm, Cn 1.2, current along x.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(define-scenario (equilibrium-in-a-current case)
  "Tensions, middle and end force of a line in a current."
  #:for ((case
          '(0.5 0 0 (-10 20 0) 40 5.5120 5.5120 (8.6038 13.2493 0) (5.4175 -1.0163 0))
          '(0.5 0 0.01 (-10 20 0) 40 5.7226 6.0196 (8.6028 13.2218 0) (5.9104 -1.1414 0))
          '(0 0.1 0.01 (20 0 -10) 30 2.1600 1.1600 (7.2797 0 -12.9070) (-.6705 0 -.9467))
          '(0.25 0.1 0.01 (0 20 -15) 40 3.6448 2.1555 (12.8890 8.3401 -11.9161)
            (1.9493 -.6611 -.6396))
          '(0.5 0.1 0.01 (0 20 -15) 40 9.5729 8.0873 (14.0231 9.4871 -8.7640)
            (7.7123 -2.3700 .5547))
          '(0.25 -0.05 0.01 (0 20 -15) 40 1.9924 2.7357 (13.7467 10.9702 -5.0523)
            (2.4131 -.6259 1.1267))
          '(0.5 0 0.01 (0 0 -30) 45 11.1109 11.1109 (15.0880 0 -15) (10.2668 0 4.2480))))
  (define-values (speed weight cdt end length anchor rov middle force) (apply values case))
  (in (world (sea (depth 60) (current speed 90))
             (rov (named minnow) (at end))
             (tether (from 0 0 0) (to minnow) (length length) (type fathom) (wet-weight weight)
                     (cdt cdt) (ea inextensible) (nodes 256) (model steady))))
  (expect (anchor-tension) is (about anchor #:within 2e-4))
  (expect (rov-tension) is (about rov #:within 2e-4))
  (expect (point-at (/ length 2)) is (about middle #:within 3e-4))
  (expect (tether-force) is (about force #:within 3e-4)))

(define-scenario tension-falls-by-weight-and-drag
  "T at the start less T at the end is w dz plus the tangential drag: here 0.1 N/m times 15 m, nearly."
  (in (world (sea (depth 60) (current 0.5 90))
             (rov (named minnow) (at 0 20 -15))
             (tether (from 0 0 0) (to minnow) (length 40) (wet-weight 0.1) (cdt 0) (ea inextensible))))
  (expect (- (anchor-tension) (rov-tension)) is (about 1.5 #:within 1e-4))
  (expect (most-easterly) is (about 14.02 #:within 0.05)))

(define (most-easterly)
  (apply max (map (lambda (s) (x (point-at s))) (iota 401 0 0.1))))
