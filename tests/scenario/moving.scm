;;; The moving line: it comes to rest where `steady' says, sleeps and wakes, snaps, parts, is wound, and
;;; is the same every time.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(use-modules (srfi srfi-1))

(define (moving)
  ;; 40 m of neutral line across a current of 0.5 m/s; the vehicle 20 m across and 10 m up-current.
  (world (sea    (depth 60) (current 0.5 90))
         (rov    (named minnow) (at -10 20 0))
         (tether (named line) (type fathom) (wet-weight 0) (cdt 0) (from 0 0 0) (to minnow)
                 (length 40) (model dynamic))))

(define-scenario it-rests-where-steady-says
  "Disturbed and left alone, the moving line returns to the equilibrium, with its tension q A."
  (in (moving))
  (expect (rov-tension) is (about 5.512 #:within 0.02))
  (drive! #:surge -1)
  (run 5)
  (place! '(-10 20 0))
  (release!)
  (expect (settle! #:within 0.001 #:at-most 600))
  (expect (tether-force) is (about '(5.4175 -1.0163 0) #:within 0.06))
  (expect (point-at 20) is (about '(8.6038 13.2493 0) #:within 0.02)))

(define-scenario a-lee-shelters-the-middle-of-a-line
  "Behind a pile the current is less: a line across its lee rests where the moving line does, and is pulled less."
  (define (across-a-lee sea-part)
    (world (splice (list sea-part))
           (cylinder (named pile) (from -3 0 -60) (to -3 0 5) (radius 2))
           (rov (named minnow) (at 0 -12 -10))
           (tether (named line) (wet-weight 0.2) (from 0 12 -10) (to minnow) (length 30) (model steady))))
  (in (across-a-lee (part sea (depth 60) (current 1 90))))
  (define open-water (rov-tension))
  (in (across-a-lee (part sea (depth 60) (current 1 90) (wake yes))))
  (define at-rest (rov-tension))
  (define middle (point-at 15))
  (expect at-rest is (below (* 0.8 open-water)))
  (alter! 'line #:model 'dynamic)
  (expect (settle! #:within 0.001 #:at-most 600))
  (expect (rov-tension) is (about at-rest #:within 0.05))
  (expect (point-at 15) is (about middle #:within 0.01)))

(define-scenario it-bends-as-it-is-towed
  "A moving line lags: its middle trails behind the vehicle's motion, and it pulls harder."
  (in (moving))
  (let ((rest (rov-tension)))
    (drive! #:sway -1)
    (run 5)
    (expect (rov-tension) is (above (* 1.5 rest)))))

(define-scenario it-sleeps-and-wakes
  "At rest it is not stepped at all; one step after its end moves it is awake."
  (in (moving))
  (run-until asleep? #:at-most 900)
  (expect (asleep?))
  (let ((solves (assq-ref (profile) 'chain-solves)))
    (run 60)
    (expect (assq-ref (profile) 'chain-solves) => solves)
    (drive! #:surge 0.5)
    (step!)
    (expect (assq-ref (profile) 'chain-solves) is (above solves))
    (expect (asleep?) => #f)))

(define-scenario the-current-wakes-it
  "A sleeping line feels a new current."
  (in (moving))
  (run-until asleep? #:at-most 900)
  (current! 1.0 90)
  (run 60)
  (expect (rov-tension) is (about 22.05 #:within 0.5)))

(define-scenario winding-makes-no-spike
  "Ten metres out and in again at half a metre a second: the length is exact, and the tension never jumps
as nodes come and go.  (Hauling raises it by drawing the bow up the current: twice the speed through the
water there, four times the drag.)"
  (in (world (sea (depth 100) (current 0.5 90))
             (rov (named minnow) (at 0 45 0))
             (tether (named line) (type fathom) (wet-weight 0) (from 0 0 0) (to minnow) (length 50)
                     (model dynamic))))
  (run 30)
  (let ((steady (max-tension)) (last (max-tension)))
    (define (smooth?)
      ;; No more than a seventh of the steady tension in a sixtieth of a second.
      (let ((jump (abs (- (max-tension) last))))
        (set! last (max-tension))
        (< jump (/ steady 7))))
    (pay-out! 10 #:rate 0.5)
    (always (smooth?) (run 25))
    (expect (tether-length) is (about 60 #:within 1e-9))
    (run 30)
    (haul-in! 10 #:rate 0.5)
    (always (smooth?) (run 25))
    (expect (tether-length) is (about 50 #:within 1e-9))
    (run 60)
    (expect (max-tension) is (about steady #:within (* 0.05 steady)))))

(define-scenario it-parts-at-its-breaking-load
  "A weak line driven taut parts once; both parts go on moving and the vehicle is free."
  (in (world (sea (current 0.2 90))
             (rov (named minnow) (at 0 15 -5) (pull 1000))
             (tether (named line) (type fathom) (breaking-load 50) (from 0 0 -5) (to minnow)
                     (length 20) (model dynamic))))
  (drive! #:surge 1)
  (run 12)
  (expect (parted?))
  (expect (length (filter (lambda (e) (eq? (car e) 'parted)) (events))) => 1)
  (expect (y (rov-position)) is (above 25))
  (expect (tether-length) is (below 20))
  (expect (array-dimensions (tether-tail)) is (lambda (d) (= 3 (cadr d))))
  (let ((end (point-at (tether-length))))
    (run 5)
    (expect (distance end (point-at (tether-length))) is (above 0.05)))
  (expect (tether-model! 'steady) raises unsupported))

(define-scenario it-is-cut-where-one-says
  "Cut in the middle, half stays at the anchor."
  (in (moving))
  (run 1)
  (expect (tether-tail) => #f)
  (expect (cut-tether! #:at 30) is (about 30 #:within 0.7))
  (expect (parted?))
  (drive! #:surge 1)
  (run 60)
  (expect (held?) => #f))

(define-scenario it-is-cut-again
  "Of a cut line the part at the anchor is cut again: what lies between both cuts drifts off."
  (in (world (sea) (rov (named minnow) (at 0 0 -30))
             (tether (named line) (wet-weight 0.5) (from 0 0 0) (to minnow) (length 40) (drum 60) (nodes 40)
                     (clump (at 25) (mass 20)) (model dynamic))))
  (run 1)
  (expect (cut-tether! #:at 30.05) is (about 30 #:within 0.3))
  (run 1)
  (let ((tail (tether-tail)) (hung (rov-tension)))
    (expect (cut-tether! #:at 20.6) is (about 20.6 #:within 1e-6))
    (expect (tether-tail) => tail)
    (expect (rov-tension) => hung))
  (expect (length (filter (lambda (e) (eq? (car e) 'parted)) (events))) => 2)
  (run 120)
  ;; The clump was at 25 m, in the piece that is gone; 20.6 m of line weigh 10.3 N.
  (expect (anchor-tension) is (about 10.3 #:within 0.05))
  (expect (z (point-at (tether-length))) is (about -20.6 #:within 0.05))
  (expect (pay-out! 39.5) raises domain) ; 10 m hang from the vehicle, 9.4 m are gone: 29.95 + 10.05 are left
  (pay-out! 15 #:rate 2)
  (run 60)
  (expect (anchor-tension) is (about 17.8 #:within 0.2)))

(define-scenario what-hangs-from-the-vehicle-parts-too
  "A line parts above a clump that is too heavy for it, and then below it, where the vehicle holds the clump up."
  (in (world (sea) (rov (named minnow) (at 0 0 -30) (type kinematic))
             (tether (named line) (wet-weight 0) (breaking-load 100) (from 0 0 0) (to minnow) (length 31)
                     (clump (at 25) (mass 20)) (nodes 31) (model dynamic))))
  (run 60)
  (expect (length (filter (lambda (e) (eq? (car e) 'parted)) (events))) => 2)
  (expect (max-tension) is (below 100))
  (expect (rov-tension) is (below 1)))

(define-scenario the-tail-moves-though-the-stub-rests
  "A stub that lies still on the bottom does not let the other part of the line fall asleep while it swings."
  (in (world (sea (depth 20)) (seabed) (rov (named minnow) (at 30 0 -5))
             (tether (named line) (wet-weight 0.5) (from 0 0 -19.99) (to minnow) (length 34) (nodes 34)
                     (model dynamic))))
  (run 1)
  (cut-tether! #:at 1)
  (let loop ((i 0) (before (tether-tail)))
    (run 5)
    (let ((now (tether-tail)))
      (expect now is (lambda (a) (not (equal? a before))))
      (when (< i 5)
        (loop (+ i 1) now))))
  ;; All of it lies or hangs below the vehicle at last.
  (run 120)
  (expect (array-ref (tether-tail) 0 2) is (about -20 #:within 0.05)))

(define-scenario a-cut-divides-contacts
  "What the line touches is the same before and after it is cut, on either side of the cut, and both parts tell of it."
  (in (world (sea (depth 20)) (seabed) (box (named block) (at 8 0 -19) (size 1 1 2))
             (rov (named minnow) (at 30 0 -12))
             (tether (named line) (wet-weight 0.5) (from 0 0 -19.99) (to minnow) (length 36) (nodes 36)
                     (model dynamic))))
  (run 30)
  (define (touches)
    (map (lambda (c) (list (contact-object c) (f64vector->list (contact-position c)) (round (* 1e6 (contact-arc-length c)))))
         (contacts)))
  (define (off c)
    (distance (point-at (contact-arc-length c)) (contact-position c)))
  (let ((before (touches)) (lies (contact-length)) (on-the-bed (seabed-length)) (on-the-block (contact-length 'line 'block)))
    (cut-tether! #:at 18)
    (let ((now (touches)))
      (expect (length now) is (above 12))
      (expect now => before)
      (expect (length (filter contact-tail? (contacts))) is (above 3))
      (expect (map (lambda (c) (> (contact-arc-length c) (tether-length))) (contacts)) => (map contact-tail? (contacts)))
      (expect (apply max (map off (filter (lambda (c) (not (contact-tail? c))) (contacts)))) is (below 0.02))
      (expect (contact-length) is (about lies #:within 0.1))
      (expect (seabed-length) is (about on-the-bed #:within 0.1))
      (expect (contact-length 'line 'block) is (about on-the-block #:within 0.1))
      (let ((near (remove segment-tail? (segments))) (tail (filter segment-tail? (segments))))
        (expect (apply max (map segment-to near)) is (about (tether-length) #:within 1e-6))
        (expect (segment-from (car tail)) is (about (tether-length) #:within 1e-6))
        (expect (segment-to (last tail)) is (about 36 #:within 1e-6))
        (expect (cadr (segment-ends (last tail))) is (about (rov-position) #:within 1e-6))))))

(define-scenario what-lies-there-is-borne
  "Both parts of a cut line come to lie on the bottom, which bears all that does not hang from the vehicle."
  (in (world (sea (depth 20)) (seabed) (rov (named minnow) (at 30 0 -12))
             (tether (named line) (wet-weight 0.5) (from 0 0 -19.99) (to minnow) (length 46) (nodes 46)
                     (model dynamic))))
  (run 20)
  (cut-tether! #:at 20)
  (run 120)
  (expect (apply + (rov-tension) (map (lambda (c) (z (contact-force c))) (contacts))) is (about 23 #:within 0.5)))

(define (all-energy)
  (apply + (map cdr (energy))))

(define-scenario (a-break-loses-what-it-says at)
  "Cut, and cut again, a line has the energy that it had, less what is said to be lost; left to itself it gains none."
  #:for ((at 15 0.5 39))
  (in (world (sea (density 1)) (rov (named minnow) (at 25 0 -10))
             (tether (named line) (wet-weight 0.5) (ca 0) (cdn 0) (cdt 0) (from 0 0 -10) (to minnow) (length 40) (nodes 40)
                     (breaking-load none) (model dynamic))))
  (run 1)
  (move! '(30 3 -10) #:speed 1)
  (run 7)
  (define begun (all-energy))
  (expect (assq-ref (energy) 'lost) => 0.0)
  (define gravity (assq-ref (energy) 'gravity))
  (cut-tether! #:at at)
  (expect (all-energy) is (about begun #:within 1e-6))
  (expect (abs (assq-ref (energy) 'lost)) is (below 0.05))
  (expect (assq-ref (energy) 'gravity) is (about gravity #:within 0.3))
  (always (<= (all-energy) (+ begun 1e-3)) (run 5))
  (let ((before (all-energy)))
    (cut-tether! #:at (* 1/2 (tether-length)))
    (expect (all-energy) is (about before #:within 1e-6))
    (expect (assq-ref (energy) 'lost) is (lambda (lost) (< lost -0.5)))))

(define-scenario both-parts-take-the-nodes-they-need
  "A line of model auto that hangs straight in both parts, once it was cut in a bight, has fewer nodes in both."
  (in (world (sea) (rov (named minnow) (at 10 0 -60))
             (tether (named line) (wet-weight 0.5) (from 0 0 -60) (to minnow) (length 100) (accuracy 0.005) (model auto))))
  (run 2)
  (cut-tether! #:at 50)
  (let ((tail (car (array-dimensions (tether-tail)))))
    (expect tail is (above 40))
    (run 120)
    (expect (car (array-dimensions (tether-tail))) is (below (* 2/3 tail)))
    (expect (car (array-dimensions (tether-points))) is (below (* 2/3 tail)))
    (expect (array-ref (tether-tail) 0 2) is (about -110 #:within 0.1))))

(define-scenario a-vehicle-cuts-itself-free
  "Cut at its far end, a line leaves its vehicle no more than a stub."
  (in (moving))
  (run 1)
  (cut-tether! #:at (tether-length))
  (let* ((tail (tether-tail)) (nodes (map (lambda (i) (list (array-ref tail i 0) (array-ref tail i 1) (array-ref tail i 2)))
                                          (iota (car (array-dimensions tail))))))
    (expect (length nodes) => 2)
    (expect (distance (car nodes) (cadr nodes)) is (below 0.5)))
  (drive! #:surge 1)
  (run 30)
  (expect (held?) => #f))

(define-scenario a-jerk-is-a-snap
  "A slack line run out at speed comes taut with a jerk, once."
  (in (world (sea) (rov (named minnow) (at 0 10 -5) (pull 300))
             (tether (named line) (type fathom) (wet-weight 0) (ba 0) (from 0 0 -5) (to minnow)
                     (length 20) (model dynamic))))
  (drive! #:surge 1)
  (run 15)
  (expect (assq 'taut (events)))
  (expect (max-tension) is (above 100)))

(define-scenario the-same-every-time
  "Determinism: a rerun, a fork and a restored checkpoint give the same bits."
  (in (moving))
  (define (fly)
    (drive! #:surge 0.7 #:yaw 0.4)
    (run 5)
    (pay-out! 5)
    (run 7)
    (state-hash))
  (let* ((c (checkpoint))
         (forked (what-if (fly)))
         (flown (fly)))
    (expect forked => flown)
    (restore! c)
    (expect (fly) => flown)
    (enter! (moving))
    (expect (fly) => flown)))

(define-scenario models-change-hands
  "From static to moving and back, the shape goes on from where it is."
  (in (moving))
  (let ((middle (point-at 20)))
    (for-each (lambda (model)
                (tether-model! model)
                (expect (point-at 20) is (about middle #:within 0.05))
                (step!)
                (expect (point-at 20) is (about middle #:within 0.05)))
              '(steady dynamic catenary dynamic steady))))

(define-scenario twist-throws-a-loop
  "Many turns of the vehicle and little tension: the line hockles where T < M^2 / (4 EI)."
  (in (world (sea (current 0.25 90)) (rov (named minnow) (at 0 8 -5))
             (tether (named line) (type fathom) (wet-weight 0) (ei 0.01) (gj 0.02) (from 0 0 -5)
                     (to minnow) (length 10) (model dynamic))))
  (drive! #:yaw 1)
  (run 60)
  (expect (assq 'hockled (events)) => #f)
  (run 120)
  (expect (assq 'hockled (events))))


;;; Model `auto': as many nodes as the accuracy wants.

(define-scenario (auto-takes-nodes-as-needed accuracy)
  "A finer accuracy takes more nodes, and the estimate stays within what was accepted."
  #:for ((accuracy 0.5 0.05))
  (in (world (sea (depth 60) (current 0.5 90))
             (rov (named minnow) (at -10 20 0))
             (tether (named line) (type fathom) (wet-weight 0) (from 0 0 0) (to minnow) (length 40)
                     (model auto) (accuracy accuracy))))
  (run 2)
  (drive! #:surge 0.5 #:yaw 0.2)
  (run 20)
  (expect (error-estimate) is (below (* 1.1 accuracy)))
  (expect (array-length (tether-points)) is (between 9 (if (= accuracy 0.5) 40 129)))
  (accuracy! (* 2 accuracy))
  (run 2)
  (expect (error-estimate) is (below (* 2 accuracy))))

(define-scenario energy-is-counted
  "A moving line has energies; a static one does not."
  (in (moving))
  (drive! #:sway 1)
  (run 2)
  (expect (assq-ref (energy) 'kinetic) is (above 0.1))
  (tether-model! 'steady)
  (expect (energy) raises unsupported)
  (expect (error-estimate) raises unsupported))


;;; What is watched.

(define-scenario the-tightest-bend
  "The neutral line across a current is tightest at its bow: radius q A / q there."
  (in (world (sea (depth 60) (current 0.5 90))
             (rov (named minnow) (at 0 20 0))
             (tether (named line) (type fathom) (wet-weight 0) (cdt 0) (from 0 0 0) (to minnow)
                     (length 40) (nodes 200) (model dynamic))))
  (run 30)
  (let ((A (/ (max-tension) 1.1685)))
    (expect (tightest-bend) is (about A #:within (* 0.01 A))))
  (tether-model! 'rubber-band)
  (expect (tightest-bend) => +inf.0))

(define-scenario a-line-bent-too-tightly-is-told
  "An end that doubles back on its own line kinks it."
  (in (world (sea (depth 60) (current 0.2 90))
             (rov (named minnow) (at 0 8 -5))
             (tether (named line) (type fathom) (wet-weight 0) (min-bend-radius 1) (from 0 0 -5)
                     (to minnow) (length 10) (model dynamic))))
  (drive! #:surge -1)
  (run 7.5)
  (expect (assq 'kinked (events))))

(define-scenario a-drum-has-an-end
  "No more is paid out than the drum holds."
  (in (world (sea) (rov (named minnow) (at 0 8 -5))
             (tether (named line) (type fathom) (from 0 0 -5) (to minnow) (length 10) (drum 15))))
  (expect (pay-out! 6) raises domain)
  (expect (pay-out! 5) => 15)
  (run 20)
  (expect (tether-length) => 15))

;;; The mesh follows what is out: however short the line was laid, paid out it is the line of that length.

(define* (reach length #:key (model 'dynamic) (far 40) (drum 'none))
  ;; LENGTH of line in a current, whose vehicle is FAR away; the bed and a post are too far off to touch.
  (world (sea (depth 100) (current 0.25 90))
         (seabed)
         (cylinder (named post) (from -60 0 1) (to -60 0 -100) (radius 0.5))
         (rov (named minnow) (at 0 far (- -12 (* 0.2 far))))
         (tether (named line) (type fathom) (wet-weight 0.1) (from 0 0 -12) (to minnow) (length length)
                 (drum drum) (model ,model))))

(define (told)
  ;; What is compared: forces at both ends, N, and eight points of the line.
  (list (anchor-tension) (rov-tension) (tether-force)
        (map (lambda (k) (point-at (* k 1/8 (tether-length)))) (iota 9))))

(define (told-of world)
  (enter! world)
  (settle! #:within 0.001 #:at-most 900)
  (told))

(define (far-apart a b)
  ;; The largest distance, m, of the points of A and B.
  (apply max (map distance (cadddr a) (cadddr b))))

(define (wind-to! out)
  ;; Pay out or haul in to OUT metres while the vehicle goes to its place.
  (let ((more (- out (tether-length))))
    (if (positive? more) (pay-out! more #:rate 1) (haul-in! (- more) #:rate 1))
    (move! '(0 40 -20) #:speed (/ (distance (rov-position) '(0 40 -20)) (abs more)))
    (run-until (lambda () (and (arrived?) (not (spooling?)))) #:at-most 300)))

(define-scenario (paid-out-is-laid-whole laid model)
  "A line that was paid out, or hauled in, pulls within a hundredth of the same line laid whole, and lies
where that lies."
  #:for ((laid 2 10 44 90) (model 'dynamic 'auto))
  (define whole (told-of (reach 45 #:model model)))
  (define bound (* 0.01 (cadr whole)))
  (enter! (reach laid #:model model #:far (min 39 (* 0.9 laid))))
  (wind-to! 45)
  (settle! #:within 0.001 #:at-most 900)
  (define wound (told))
  (expect (car wound) is (about (car whole) #:within bound))
  (expect (cadr wound) is (about (cadr whole) #:within bound))
  (expect (distance (caddr wound) (caddr whole)) is (below bound))
  (expect (far-apart wound whole) is (below 0.1))
  (expect (accurate?)))

(define-scenario the-drum-costs-nothing
  "What is on the drum is no line yet: whatever it is, a dive does the same with the same work."
  (define (flown drum)
    (enter! (reach 10 #:far 9 #:drum drum))
    (wind-to! 40)
    (list (told) (assq-ref (profile) 'chain-solves) (array-dimensions (tether-points))))
  (expect (flown 1000) => (flown 40)))

(define-scenario a-coarse-line-is-told
  "Where a line bends more sharply than its nodes can follow, status says so."
  (in (world (sea (depth 60) (current 0.6 90))
             (rov (named minnow) (at 0 10 -20))
             (tether (named line) (type fathom) (wet-weight 0) (from 0 0 -20) (to minnow) (length 40) (nodes 4)
                     (model dynamic))))
  (run 30)
  (expect (error-estimate) is (above 0.05))
  (expect (not (accurate?)))
  (expect (string-contains (object->string (status)) "shape uncertain")))


;;; What is fastened to the line.

(define (hanging)
  ;; 20 m of neutral line in still water, its ends 15 m apart at one depth, 2 kg of steel in the middle.
  (world (sea (depth 60))
         (rov (named minnow) (at 0 15 -30))
         (tether (named line) (type fathom) (wet-weight 0) (from 0 0 -30) (to minnow) (length 20)
                 (model dynamic)
                 (clump (at 10) (mass 2)))))

(define (weight-on-the-ends)
  ;; What the line pulls down with on its two ends together, N.
  (- (* (rov-tension) (z (tangent-at (tether-length))))
     (* (anchor-tension) (z (tangent-at 0)))))

(define weight-of-the-clump (* 2 9.80665 (- 1 (/ 1025 7850))))

(define-scenario a-clump-hangs-from-both-ends
  "The neutral line hangs in a V under the clump, and its ends carry the clump's weight in water."
  (in (hanging))
  (expect (settle! #:within 0.001 #:at-most 600))
  (expect (point-at 10) is (about (vec 0 7.5 (- -30 (sqrt (- 100 (* 7.5 7.5))))) #:within 0.05))
  (expect (weight-on-the-ends)
          is (about weight-of-the-clump #:within (* 0.03 weight-of-the-clump)))
  (expect (z (tether-force))
          is (about (/ weight-of-the-clump -2) #:within (* 0.03 weight-of-the-clump))))

(define-scenario a-float-lifts-the-line
  "A buoyant section lifts the middle of a sinking line above its ends, by its lift less the line's weight."
  (in (world (sea (depth 60))
             (rov (named minnow) (at 0 15 -30))
             (tether (named line) (type fathom) (wet-weight 0.05) (from 0 0 -30) (to minnow) (length 20)
                     (model dynamic)
                     (float (at 10) (span 4) (buoyancy 20)))))
  (expect (settle! #:within 0.001 #:at-most 600))
  (expect (z (point-at 10)) is (between -24 -23))
  (expect (weight-on-the-ends) is (about (- (* 20 0.05) 20) #:within 0.5)))

(define-scenario a-floating-line-lies-on-the-water
  "A buoyant tether, slack, comes up and lies on the water; it does not stand in the air."
  (in (world (sea (depth 20) (current 0.1 0))
             (rov (named minnow) (at 10 0 -3))
             (tether (named line) (type fathom) (wet-weight -0.3) (from 0 0 -0.5) (to minnow) (length 16)
                     (model dynamic))))
  (define (tops) (map (lambda (s) (z (point-at s))) '(2 4 6 8 10)))
  (run 60)
  (for-each (lambda (height) (expect height is (between 0 0.1))) (tops))
  (expect (settle! #:within 0.01 #:at-most 600)))

(define-scenario paying-out-leaves-the-clump-where-it-is-on-the-line
  "Line comes off the drum at the anchor: the clump stays 6 m from the vehicle, and hangs below it once the
rest is slack."
  (in (with (hanging) (line (clump (at 14) (mass 2)) (accuracy 0.05))))
  (define (from-the-vehicle)
    (distance (rov-position) (point-at (- (tether-length) 6))))
  (settle! #:within 0.001 #:at-most 600)
  (expect (from-the-vehicle) is (about 6 #:within 0.1))
  (expect (y (point-at 14)) is (below 13))
  (pay-out! 6 #:rate 0.5)
  (run 10)
  (let ((tension (rov-tension)) (nodes (array-length (tether-points))) (changes 0))
    (define (smooth?)
      ;; No jump above 2 % of the tension as a node comes or goes.
      (let ((before tension) (n (array-length (tether-points))))
        (set! changes (+ changes (abs (- n nodes))))
        (set! nodes n)
        (set! tension (rov-tension))
        (< (abs (- tension before)) (* 0.02 before))))
    (always (smooth?) (run 50))
    (expect changes is (below 65))) ; as many as there are nodes, as the slack line folds
  (expect (tether-length) is (about 26 #:within 1e-9))
  (expect (from-the-vehicle) is (about 6 #:within 0.1))
  (expect (point-at 20) is (about '(0 15 -36) #:within 0.2))
  (expect (z (tether-force)) is (about (- weight-of-the-clump) #:within 0.5)))
