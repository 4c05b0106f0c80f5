;;; Five examples of WHOI Cable 2 (J. Gobat) as worlds, beside what that program finds of them.
;;;
;;; The reference was printed by its own solver (github.com/jgobat/cable, commit e9cd811, built without graphics) from
;;; the files of its folder `examples', by `res2asc'.  Drag is taken as here: normal on the diameter, tangential on
;;; the circumference.  Its height is up from the body; here a ship is at the surface, x ahead of it is east.
;;; bench/README.md tells of the differences.  BIGHT_LONG=1 flies on, with more intervals.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(define long? (getenv "BIGHT_LONG"))
(define (short-or-long short long) (if long? long short))

(define-syntax-rule (beside what ours theirs within)
  ;; Expect OURS to be THEIRS but for WITHIN, and say how far apart they are.
  (let ((value ours))
    (simple-format #t "~a: ~a, theirs ~a\n" what (/ (round (* 100 value)) 100) theirs)
    (expect value is (about theirs #:within within))))


;;; Bodies and ships.

(define (drag density coefficient diameter)
  ;; Of a sphere, N s2/m2: half the density, times the coefficient, times its area ahead.
  (* 1/2 density coefficient 1/4 (acos -1) diameter diameter))

(define (added density diameter)
  ;; Half of the mass that a sphere displaces, kg.
  (* 1/12 density (acos -1) diameter diameter diameter))

(define-syntax-rule (define-body name sentence kg weight (density gravity) diameter across up part ...)
  ;; A sphere, for its drag: ACROSS and UP are coefficients.  WEIGHT is in the water.
  (define-vehicle name sentence
    (size 0 0 0) (mass kg) (volume (/ (- kg (/ weight gravity)) density)) (inertia 100 100 100)
    (buoyancy-centre 0 0 0.1) (tether-point 0 0 0)
    (added-mass ((added density diameter) (added density diameter) (added density diameter)) (10 10 10))
    (linear-drag (0 0 0) (30 30 30))
    (quadratic-drag ((drag density across diameter) (drag density across diameter) (drag density up diameter))
                    (10 10 10))
    part ...))

(define ship
  ;; It goes as it is told, 10 m/s at full stick; deep enough to heave.
  (part rov (named ship) (type kinematic) (at 0 0 -5) (heading 90) (pull 1e6)
        (surge-speed 10) (sway-speed 10) (heave-speed 1)))

(define (below-ship vehicle)
  (- (z (vec- (rov-position vehicle) (rov-position 'ship)))))

(define (run-while! from to step order!)
  ;; Run from FROM to TO, s; before each STEP call ORDER! with the time in its middle.
  (let loop ((t (+ from (/ step 2))))
    (when (< t to)
      (order! t)
      (run step)
      (loop (+ t step)))))


;;; towing.cbl, as appendix E of the manual of 1997 has it: a ship tows against a current, faster and slower, and a
;;; winch may help.  In its reference the winch is `top-spool-pay', since its reader knows `pay-rate' no more.

;; Its file gives the sled no drag up and down, and its solver of three dimensions asks for none.
(define-body sled "The sled of its towing examples, in a plane."
  1135 6686.35 (1025 9.81) 0.736 0.77 0)
(define-body sled-in-space "The same, in space."
  1135 6686.35 (1025 9.81) 0.736 0.77 0.77)

(define* (towed current depth astern intervals #:optional (kind 'sled))
  ;; A sled DEPTH below a ship and ASTERN of it, on 1000 m of cable, seen by who moves with the ship as it is towed
  ;; steadily: the water runs against both with CURRENT.
  (world (sea (depth 3000) (density 1025) (gravity 9.81) (current current 270))
         (splice ship)
         (rov (named sled) (type (unquote kind)) (at (- astern) 0 (- -5 depth)) (heading 90))
         (tether (named cable) (from ship) (to sled) (length 1000) (nodes intervals) (model dynamic)
                 (winch-pull 1e5) (diameter 0.0173) (mass 1.12) (wet-weight 8.89) (ea 1.2717e7)
                 (cdn 1.5) (cdt 0.01) (ca 1))))

(define-scenario a-sled-is-towed
  "At 5 knots against one, its place and both tensions."
  (in (towed 3.07 331.23 928.19 200))
  (run 400)
  (beside "depth, m" (below-ship 'sled) 331.234 0.05)
  (beside "astern, m" (- (x (rov-position 'sled))) 928.191 0.05)
  (beside "tension at the sled, N" (rov-tension) 6871.00 1)
  (beside "tension at the ship, N" (anchor-tension) 12100.63 8))

(define (sail! t) (drive! 'ship #:surge (* 0.0514 3 (sin (* 0.0105 t))))) ; beside its 5 knots

(define (wind! t)
  ;; Half a second of its winch.
  (let ((rate (* -0.5 (sin (* 0.0105 t)))))
    ((if (positive? rate) pay-out! haul-in!) (* 0.5 (abs rate)) #:rate (abs rate))))

(define (tow-yow! from to winch?)
  (run-while! from to 0.5 (lambda (t) (sail! t) (when winch? (wind! t)))))

(define (tow-yow winch? high pull-high low pull-low top-low)
  (run 30)
  (tow-yow! 0 200 winch?)
  (beside "depth after 200 s, m" (below-ship 'sled) high 1)
  (beside "tension at the sled, N" (rov-tension) pull-high 15)
  (tow-yow! 200 600 winch?)
  (beside "depth after 600 s, m" (below-ship 'sled) low 1)
  (beside "tension at the sled, N" (rov-tension) pull-low 15)
  (beside "tension at the ship, N" (anchor-tension) top-low 80))

(define-scenario a-sled-goes-up-and-down
  "As the ship sails faster and slower."
  (in (towed 3.07 331.23 928.19 60))
  (tow-yow #f 247.84 7403.3 420.84 6813.3 12752.3))

(define-scenario a-winch-helps
  "The same while it hauls in as the ship is fast, and pays out as it is slow."
  (in (towed 3.07 331.23 928.19 60))
  (tow-yow #t 224.88 7709.9 447.82 6786.8 12935.0)
  (beside "length out, m" (tether-length) (+ 1000 (* 0.5 (/ (- 1 (cos 6.3)) -0.0105))) 0.5))


;;; tow3d.cbl, begun at rest: without `static-solution = catenary' the sled begins where it is towed straight ahead.

(define (turn! t)
  (let ((a (if (< 200 t 800) (* 1/300 3.14159 (- t 200)) 0)))
    (drive! 'ship #:surge (* 0.3084 (- (cos a) 1)) #:sway (* -0.3084 (sin a)))))

(define-scenario a-sled-is-towed-in-a-circle
  "At 6 knots, in ten minutes: how far it sinks, how near the middle it stays."
  (in (towed 3.084 329.8 928.45 100 'sled-in-space))
  (run 30)
  (run-while! 200 600 1 turn!)
  (beside "depth after 600 s, m" (below-ship 'sled) 784.95 1)
  (beside "north, m" (y (rov-position 'sled)) 86.84 1)
  (beside "tension at the sled, N" (rov-tension) 5842.8 10)
  (run-while! 600 (short-or-long 700 1200) 1 turn!)
  (beside "depth then, m" (below-ship 'sled) (short-or-long 938.42 433.29) 1)
  (beside "tension at the ship, N" (anchor-tension) (short-or-long 15130 12865.1) 100))


;;; breaking.cbl: a line is let go at the ship, and falls past its body.

(define-body heavy-rov "The body of its example of a line that is let go."
  500 500 (1000 10) 1 2 2)

(define let-go
  (world (sea (depth 3000) (density 1000) (gravity 10) (current 0.5 270))
         (rov (named rov) (type heavy-rov) (at -511.48 0 -859.07) (heading 90))
         (tether (named cable) (from 0 0 0) (to rov) (length 1000) (nodes (short-or-long 240 400)) (model dynamic)
                 (diameter 0.0131) (mass 0.3) (wet-weight 2) (ea 1.5e6) (ei 10) (cdn 1) (cdt 0.005) (ca 1))))

(define-scenario a-line-is-let-go
  "Towed at 0.5 m/s, then let go: how its body sinks."
  (in let-go)
  (run 300)
  (beside "depth, m" (- (z (rov-position))) 859.065 0.1)
  (beside "astern, m" (- (x (rov-position))) 511.478 0.1)
  (beside "tension at the body, N" (rov-tension) 537.17 0.5)
  (beside "tension at the ship, N" (anchor-tension) 2260.47 1)
  (define depth (- (z (rov-position))))
  (cut-tether! #:at 1)
  (run 100)
  (beside "m sunk in 100 s" (- (- (z (rov-position))) depth) 79.77 3)
  (when long?
    (run 200)
    (beside "m sunk in 300 s" (- (- (z (rov-position))) depth) 241.45 6)))


;;; Appendix A and mine.cbl, in one plane: a buoy on a rope in a current that fades with depth.

(define-body mine "The buoy of its first example."
  1611 -1999.86 (1027 9.81) 3/2 1/2 1/2)

(define (fading depth) (* 0.2 (exp (* -0.055 depth))))

(define moored
  (world (sea (depth 25) (density 1027) (gravity 9.81)
              (current (profile (0 (fading 0) 90) (-3 (fading 3) 90) (-5 (fading 5) 90) (-10 (fading 10) 90)
                                (-15 (fading 15) 90) (-20 (fading 20) 90) (-25 (fading 25) 90))))
         (rov (named buoy) (type mine) (at 0.13 0 -4.2008) (heading 90))
         (tether (named rope) (from 0 0 -25) (to buoy) (length 20) (nodes 40) (model dynamic)
                 (diameter 0.01) (mass 0.09) (wet-weight 0.087) (ea 5e4) (ei 20) (cdn 1.5) (cdt 0.01) (ca 1))))

(define-scenario a-mine-is-moored
  "Where it stands, and what it pulls with."
  (in moored)
  (run 500)
  (beside "aside, mm" (* 1000 (x (rov-position))) 129.89 0.7)
  (beside "above the bed, mm" (* 1000 (+ 25 (z (rov-position)))) 20799.2 0.2)
  (beside "tension at the buoy, N" (rov-tension) 1999.89 0.2)
  (beside "tension at the bed, N" (anchor-tension) 1998.15 0.2))


;;; rov.cbl: a heaving ship, 1265 m of cable, a depressor, 100 m of neutral tether, a ROV that thrusts away.

(define-body depressor "The depressor of its example of a ROV."
  3300 19620 (1025 9.81) 1.24 1 1)

(define-body thrusting-rov "The ROV of that example, with its thrust."
  4000 200 (1025 9.81) 1.37 1 1.67
  (thruster (at 0 0 0) (along 0 1 0) (ahead 444.8)))

(define deep
  (world (sea (depth 3000) (density 1025) (gravity 9.81) (current 0.5 270))
         (splice ship)
         (rov (named depressor) (type depressor) (at -183.12 0 -1257.56) (heading 90))
         (rov (named rov) (type thrusting-rov) (at -279.05 0 -1285.82) (heading 270))
         (tether (named cable) (from ship) (to depressor) (length 1265) (nodes 60) (model dynamic)
                 (diameter 0.0173) (mass 1.12) (wet-weight 8.89) (ea 1.2717e7) (cdn 2.2) (cdt 0.01) (ca 1))
         (tether (named umbilical) (from depressor) (to rov) (length 100) (nodes 15) (model dynamic)
                 (diameter 0.0173) (mass 0.241) (wet-weight 1e-6) (ea 1.2717e7) (cdn 1.3) (cdt 0.01) (ca 1))))

(define (heave! t)
  ;; A metre up and down in 8 s, begun in 30 s.
  (drive! 'ship #:heave (* 1/4 (acos -1) (min 1 (/ t 30)) (cos (* 1/4 (acos -1) t)))))

(define-scenario a-rov-thrusts
  "Depressor and ROV at rest, then under the heave of the ship."
  (in deep)
  (drive! 'rov #:surge 1)
  (run 100)
  (beside "ROV below ship, m" (below-ship 'rov) 1280.82 0.3)
  (beside "ROV astern, m" (- (x (rov-position 'rov))) 279.05 1)
  (beside "depressor astern, m" (- (x (rov-position 'depressor))) 183.12 1)
  (beside "tension at the ship, N" (anchor-tension 'cable) 30919 30)
  (drive! 'rov #:surge 0)
  (run-while! 0 80 0.1 heave!)
  (define pulls
    (map (lambda (i) (run-while! (+ 80 (* 0.1 i)) (+ 80.1 (* 0.1 i)) 0.1 heave!) (anchor-tension 'cable))
         (iota 160)))
  (beside "least tension at the ship, kN" (/ (apply min pulls) 1000) 26.77 1)
  (beside "most, kN" (/ (apply max pulls) 1000) 35.14 1))
