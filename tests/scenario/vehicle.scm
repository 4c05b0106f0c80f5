;;; Vehicles with mass: a rigid body that thrusters, water and tethers move.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(use-modules ((srfi srfi-1) #:hide (every)) (srfi srfi-4))

(define (open-water)
  (world (sea (depth 200)) (rov (named minnow) (type bluerov2-heavy) (at 0 0 -50))))

(define (on-a-line model)
  (world (sea (depth 200))
         (rov (named minnow) (type bluerov2-heavy) (at 0 29.9 -50))
         (tether (named line) (type fathom) (wet-weight 0) (from 0 0 -50) (to minnow) (length 30)
                 (ea 20000) (ba 0) (model ,model))))

(define (drag v) (+ (* 13.7 v) (* 141 v v)))


;;; Free.

(define-scenario (top-speed stick)
  "Full ahead and full up, the BlueROV2 Heavy makes 0.91 and 0.96 m/s: its drag is the measured thrust."
  #:for ((stick #:surge #:heave))
  (in (open-water))
  (drive! stick 1)
  (run 15)
  (expect (rov-speed) is (if (eq? stick #:surge) (about 0.91 #:within 0.018) (about 0.96 #:within 0.019))))

(define-scenario every-type-flies
  "Each type that comes with bight goes ahead on its stick, level and on its heading, and holds a depth."
  (for-each
   (lambda (type)
     (enter! (world (sea (depth 200)) (rov (named minnow) (type ,type) (at 0 0 -50) (heading 30))))
     (hold-depth! 50)
     (hold-heading! 30)
     (drive! #:surge 0.15)
     (run 40)
     (expect (rov-speed) is (above 0.3))
     (expect (bearing-of-way) is (about 30 #:within 2))
     (expect (rov-heading) is (about 30 #:within 1))
     (expect (rov-depth) is (about 50 #:within 0.5))
     (expect (abs (rov-pitch)) is (below 15)))
   ;; Wu's set, for comparison alone, turns broadside as soon as it goes.
   (filter (lambda (type) (not (memq type '(kinematic bluerov2-heavy-wu)))) (vehicle-types))))

(define (bearing-of-way)
  (let ((v (rov-velocity)))
    (* (/ 180 (acos -1)) (atan (x v) (y v)))))

(define-scenario a-type-of-ones-own
  "A vehicle from its figures: a torpedo of one thruster makes F = c v v, and nothing else is steered."
  (define-vehicle torpedo "One thruster at the stern."
    (size 0.2 1.2 0.2) (mass 30) (quadratic-drag (20 80 80) (1 5 5)) (linear-drag (0 0 0) (5 5 5))
    (added-mass (3 30 30) (0.1 2 2)) (munk 0)
    (thruster (at 0 -0.6 0) (along 0 1 0) (ahead 45) (lag 0.2)))
  (in (world (sea) (rov (named fish) (type torpedo) (at 0 0 -20))))
  (drive! #:surge 1 #:yaw 1 #:heave 1)
  (run 30)
  (expect (y (rov-velocity)) is (about 1.5 #:within 0.01))
  (expect (rov-heading) is (about 0 #:within 1e-6))
  (expect (rov-depth) is (about 20 #:within 1e-6)))

(define-scenario what-is-no-vehicle
  "Figures that make no vehicle are refused by name."
  (expect (enter! (world (rov (named m) (mass 10) (thruster (at 0 0 0) (along 0 0 0) (ahead 1)))))
          raises def)
  (expect (world (rov (named m) (mass -1))) raises domain)
  (expect (enter! (world (rov (named m) (added-mass (1 1 1))))) raises domain)
  (expect (enter! (world (rov (named m) (added-mass (1 1 1) (-1 0 0))))) raises domain)
  (expect (world (rov (named m) (thruster (at 0 0 0) (along 0 1 0)))) raises def)
  (expect (world (rov (named m) (thrust 12))) raises name))

(define-scenario it-floats-up
  "Lighter than the water it displaces, it rises without a hold and keeps its depth with one."
  (in (open-water))
  (hold-depth! 50)
  (run 10)
  (expect (rov-depth) is (about 50 #:within 0.03))
  (release!)
  (run 30)
  (expect (rov-depth) is (below 49)))

(define-scenario turns-are-counted
  "Two turns clockwise are two, and one back is one less, through pitch and roll."
  (in (open-water))
  (define (turn-by n)
    (let ((goal (+ n (net-turns))))
      (drive! #:yaw (if (> n 0) 1 -1))
      (run-until (lambda () ((if (> n 0) >= <=) (net-turns) goal)) #:at-most 120)))
  (turn-by 2)
  (expect (round (net-turns)) => 2.0)
  (turn-by -1)
  (expect (round (net-turns)) => 1.0)
  (drive! #:yaw 0) (hold-heading! (rov-heading)) (run 10)
  (expect (net-turns) is (about 1 #:within 0.2)))

(define-scenario autopilots
  "Heading, depth, altitude and place are kept, and a stick overrides its own axis as long as it is off
centre."
  (in (with (open-water) (current 0.3 90)))
  (hold-heading! 200)
  (hold-altitude! 145)
  (run 40)
  (expect (rov-heading) is (about 200 #:degrees #:within 1))
  (expect (rov-altitude) is (about 145 #:within 0.1))
  (let ((here (hold-position!)))
    (run 60)
    (expect (distance (rov-position) here) is (below 0.05))
    (drive! #:surge 0.5)
    (run 5)
    (expect (distance (rov-position) here) is (above 0.3))
    (drive! #:surge 0)
    (run 60)
    (expect (distance (rov-position) here) is (below 0.05))))

(define-scenario it-flies-to-a-place
  "It faces the place, goes there at the speed it is told, and stays."
  (in (on-a-line 'dynamic))
  (fly-to! '(10 5 -45) #:speed 0.4)
  (run 15)
  (expect (rov-speed) is (about 0.4 #:within 0.05))
  (expect (run-until arrived? #:at-most 120))
  (expect (distance (rov-position) '(10 5 -45)) is (below 0.06))
  (run 20)
  (expect (distance (rov-position) '(10 5 -45)) is (below 0.05))
  (expect (follow! '((0 0 0 0) (1 0 0 0))) raises unsupported))


;;; On a tether.

(define-scenario (the-tether-stops-the-vehicle model)
  "Driven against a taut tether it stands still, and the tension is its thrust, whatever the model."
  #:for ((model 'dynamic 'catenary 'steady 'elastic 'v-shape 'rubber-band))
  (in (on-a-line model))
  (hold-depth! 50)
  (drive! #:surge 0.5)
  (run 40)
  (expect (rov-speed) is (below 0.001))
  (expect (rov-tension) is (about 72.74 #:within 0.7))
  (expect (rov-heading) is (about 0 #:within 1e-6)))

(define (hauled-straight nodes cdn)
  ;; Haul a slack line against a kinematic vehicle of 100 N: how far the vehicle came along, having been pulled
  ;; by no more than that.
  (enter! (world (sea (depth 60)) (rov (named minnow) (at 0 30 -5))
                 (tether (named line) (type fathom) (wet-weight 0) (cdn cdn) (from 0 0 -5) (to minnow) (length 31)
                         (nodes nodes) (model dynamic))))
  (haul-in! 10 #:rate 0.5)
  (always (<= (rov-tension) 100.1) (run 8))
  (expect (rov-tension) is (about 100 #:within 1))
  (- 30 (y (rov-position))))

(define-scenario hands-feel-the-water-that-holds-a-bow
  "Hauled straight, a line would pull with 430 N at hands of 100 N, by the water that holds its bow: so the hands
come along, by as much whatever the mesh, and hardly where the water does not hold the bow."
  (let ((coarse (hauled-straight 40 1.2)) (fine (hauled-straight 80 1.2)))
    (expect fine is (between 0.5 1))
    (expect (/ coarse fine) is (about 1 #:within 0.01))
    (expect (hauled-straight 80 0.1) is (below 0.03))))

(define-scenario the-current-carries-the-vehicle
  "Its thrusters off, it drifts down-current until the tether holds it by its drag; it faces the current
no more than its tether makes it, which is made fast at its stern."
  (in (with (on-a-line 'dynamic) (current 0.3 90)))
  (hold-depth! 50)
  (run 400)
  (expect (x (rov-position)) is (above 29))
  (expect (rov-tension) is (about (drag 0.3) #:within 1.5))
  (expect (rov-heading) is (about 90 #:within 10)))

(define-scenario snap-load
  "A straight massless line comes taut at 0.8 m/s under a vehicle of 19.86 kg that moves: the peak of the
tension is v sqrt (k m)."
  (in (world (sea (density 1) (gravity 0))
             (rov (named minnow) (mass 19.86) (volume 0) (inertia 2 2 2) (at 0 29.5 -50)
                  (thruster (at 0 0 0) (along 0 1 0) (ahead 100) (lag 0)))
             (tether (named line) (mass 0.0001) (wet-weight 0) (diameter 0.0005) (from 0 0 -50)
                     (to minnow) (length 30) (ea 20000) (ba 0) (nodes 4) (breaking-load 1e4)
                     (model dynamic))))
  (drive! #:surge 1)
  (run-until (lambda () (> (rov-speed) 0.8)) #:at-most 5)
  (release!)
  (let ((peak 0) (speed (rov-speed)))
    (every 1/60 (set! peak (max peak (max-tension))))
    (run 3)
    (expect (/ peak (* speed (sqrt (* (/ 20000 30) 19.86)))) is (about 1 #:within 0.03))))


;;; On station in a current.

(define (station c u model)
  ;; A vehicle held at C metres across a current of U m/s toward south, on 1.05 C of neutral line.
  (world (sea (depth 200) (current u 180))
         (rov (named minnow) (type bluerov2-heavy) (tether-point 0 0 0) (at c 0 -50))
         (tether (named line) (type fathom) (wet-weight 0) (cdt 0) (from 0 0 -50) (to minnow)
                 (length (* 1.05 c)) (nodes 60) (model ,model))))

(define (level-thrust)
  ;; What the four level thrusters push with, over ground, (east north).
  (let* ((f (f64vector->list (thrusts))) (k (sqrt 1/2))
         (ahead (* k (- (+ (list-ref f 0) (list-ref f 1)) (list-ref f 2) (list-ref f 3))))
         (aside (* k (- (+ (list-ref f 1) (list-ref f 3)) (list-ref f 0) (list-ref f 2))))
         (h (* (/ (acos -1) 180) (rov-heading))))
    (list (+ (* ahead (sin h)) (* aside (cos h))) (- (* ahead (cos h)) (* aside (sin h))))))

(define-scenario on-station
  "Held against a current, its thrust is its own drag and the force of the line at rest, within 1 %."
  (in (station 50 0.4 'dynamic))
  (hold-heading! 0)
  (hold-position!)
  (run 300)
  (expect (rov-speed) is (below 1e-3))
  (let* ((thrust (level-thrust)) (here (rov-position)))
    (enter! (with (station 50 0.4 'steady) (minnow (mass 0) (at here))))
    (let* ((f (tether-force))
           (east (- (x f))) (north (- (drag 0.4) (y f))) (whole (sqrt (+ (* east east) (* north north)))))
      (expect (car thrust) is (about east #:within (* 0.01 whole)))
      (expect (cadr thrust) is (about north #:within (* 0.01 whole))))))

(define (needed c u)
  ;; The thrust that holds the vehicle in place, N.
  (enter! (with (station c u 'steady) (minnow (mass 0))))
  (let ((f (tether-force)))
    (sqrt (+ (expt (x f) 2) (expt (- (drag u) (y f)) 2)))))

(define (largest-current c most)
  (let bisect ((low 0.1) (high 2.0) (n 0))
    (let ((u (/ (+ low high) 2)))
      (cond ((= n 20) u)
            ((< (needed c u) most) (bisect u high (+ n 1)))
            (else (bisect low u (+ n 1)))))))

(define-scenario (the-largest-current-held c)
  "On 25, 50 and 100 m of neutral tether across the current, full thrust ahead holds .747, .629, .493 m/s."
  #:for ((c 25 50 100))
  (in (open-water))
  (hold-depth! 50)
  (drive! #:surge 1)
  (run 5)
  (let ((u (largest-current c (cadr (level-thrust)))))
    (expect (/ u (case c ((25) .747) ((50) .629) (else .493))) is (about 1 #:within 0.03))))

(define-scenario (turning-while-taut backs-off)
  "Its tether made fast at the stern, taut, the current from ahead: it does not turn round on the stick
until it has backed off."
  #:for ((backs-off #f #t))
  (in (world (sea (depth 60) (current 0.4 0))
             (rov (named minnow) (type bluerov2-heavy) (at 0 19.9 -20) (heading 0))
             (tether (named line) (type fathom) (wet-weight 0) (from 0 0 -20) (to minnow) (length 20)
                     (model dynamic))))
  (hold-depth! 20)
  (drive! #:surge 0.6)
  (run 20)
  (expect (taut?))
  (if backs-off
      (begin
        (drive! #:surge -0.9)
        (run-until (lambda () (< (straight-distance) 17)) #:at-most 60)
        (drive! #:surge 0 #:yaw 1)
        (expect (run-until (lambda () (> (abs (net-turns)) 0.5)) #:at-most 20)))
      (begin
        (drive! #:yaw 1)
        (expect (run-until (lambda () (> (abs (net-turns)) 0.5)) #:at-most 60) => #f))))
