;;; What is known beforehand of lines at rest, drawn over drums, flung at wires, left alone: friction, balance,
;;; refinement, energy.  Each scenario says its response, model, friction and stiffness; a step is 1/60 s.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(use-modules ((bight assembly) #:select (data->part))
             ((srfi srfi-1) #:select (fold last map)))

(define pi (acos -1))

(define (fly . places)
  (for-each (lambda (p)
              (move! p #:speed 1)
              (run-until arrived? #:at-most 40))
            places))

(define (within share)
  ;; A predicate for a ratio about 1.
  (about 1 #:within share))


;;; At rest.

(define-scenario the-first-link-is-the-steeper
  "Figure B-4: with buoyancy -0.5 at half the largest current the plane of the V is tilted by 22.5 deg, so
that its first link falls more steeply than its second.  Model v-shape, rule sag; no stiffness or friction."
  (in (world (sea (depth 60) (current 0.5 90))
             (rov (named minnow) (at 0 20 -8))
             (tether (from 0 0 0) (to minnow) (length 40) (wet-weight 0) (model v-shape)
                     (sag-buoyancy -0.5) (max-current 1))))
  (let* ((points (tether-points))
         (bend (array-cell-ref points 1)) (end (array-cell-ref points 2))
         (first (/ (- (z bend)) (norm bend)))
         (second (/ (- (z bend) (z end)) (distance bend end))))
    (expect (> first second))
    (expect (atan (- (z bend) (* -8 (/ (y bend) 20))) (x bend))
            is (about (* -22.5 (/ pi 180)) #:within 1e-6))))

(define (hanging speed)
  ;; 40 m that weighs 0.1 N/m, 20 m across the current and 15 m down; inextensible, Ct 0.01.
  (world (sea (depth 60) (current speed 90))
         (rov (named minnow) (at 0 20 -15))
         (tether (named line) (type fathom) (wet-weight 0.1) (from 0 0 0) (to minnow) (length 40)
                 (ea inextensible) (nodes 256) (model steady))))

(define (drag-along speed n)
  ;; The drag along the line from its anchor to its end, N, by the trapezoidal rule over N spans.
  (let ((per-metre (lambda (s)
                     (let ((u (* speed (x (tangent-at s)))))
                       (* 1/2 1025 pi 0.0076 0.01 u (abs u)))))
        (step (/ (tether-length) n)))
    (fold (lambda (i sum)
            (+ sum (* step 1/2 (+ (per-metre (* i step)) (per-metre (* (+ i 1) step))))))
          0 (iota n))))

(define-scenario (weight-and-drag-share-the-tension case)
  "Figure 2-4 with real weight: the tension falls by w dz and by the drag along the line; it bows as far
as computed.  Model steady, inextensible, no friction."
  #:for ((case '(0.25 12.995) '(0.5 14.033)))
  (define-values (speed farthest) (apply values case))
  (in (hanging speed))
  (expect (apply max (map (lambda (s) (x (point-at s))) (iota 401 0 0.1)))
          is (about farthest #:within 0.003))
  (expect (- (anchor-tension) (rov-tension)) is (about (+ (* 0.1 15) (drag-along speed 400)) #:within 1e-4)))

(define-scenario (the-shape-stays-as-nodes-are-added speed weight)
  "Four times the nodes change no tension by a fiftieth, nor the farthest point.  Model steady, EA 2e5 N."
  #:for ((speed 0.25 0.5) (weight 0 0.1))
  (define (measures nodes)
    (enter! (world (sea (depth 60) (current speed 90))
                   (rov (named minnow) (at 0 20 -15))
                   (tether (type fathom) (wet-weight weight) (from 0 0 0) (to minnow) (length 40)
                           (nodes nodes) (ea 2e5) (model steady))))
    (list (anchor-tension) (rov-tension) (x (point-at 20))))
  (for-each (lambda (coarse fine) (expect (/ coarse fine) is (within 0.02)))
            (measures 32) (measures 128)))


;;; Friction.

(define (polyline-length points)
  (fold + 0 (map distance points (cdr points))))

(define (arc from to rise)
  ;; Points round the drum from FROM to TO degrees past its top, RISE along it.
  (map (lambda (k)
         (let ((a (* (/ pi 180) (+ from (* (/ k 24) (- to from))))))
           (vec (* 0.61 (sin a)) (* rise (/ k 24)) (+ -10 (* 0.61 (cos a))))))
       (iota 25)))

(define (coordinates p)
  (list (x p) (y p) (z p)))

(define (over-a-drum degrees friction)
  ;; 4 kg hang from a line that leads DEGREES round a level drum to a winch.
  (let* ((lead (arc (- 90 degrees) 90 (if (= degrees 360) 0.5 0)))
         (a (* (/ pi 180) (- 90 degrees)))
         (start (vec+ (car lead) (vec* -8 (vec (cos a) 0 (- (sin a))))))
         (end (vec+ (last lead) (vec 0 0 -6)))
         (way (append (list start) lead (list end))))
    (world (sea (depth 60))
           (cylinder (named drum) (from 0 -6 -10) (to 0 6 -10) (radius 0.6) (friction friction))
           (rov (named weight) (mass 4) (volume 0) (inertia 1 1 1) (at end))
           (splice (data->part
                    `(tether (named line) (type fathom) (wet-weight 0) (ea 2e4) (friction ,friction) (cdt 0)
                             (from ,@(coordinates start)) (to weight) (via ,@(map coordinates lead))
                             (length ,(polyline-length way)) (nodes 128) (model dynamic)))))))

(define-scenario (a-drum-multiplies-the-pull degrees friction)
  "Hauled over a drum, the winch pulls e^(mu theta) times what hangs on the other side.  Response physical,
model dynamic, EA 2e4 N, mu as named."
  #:for ((degrees 90 180 360) (friction 0.1 0.3))
  (in (over-a-drum degrees friction))
  (haul-in! 4 #:rate 0.2)
  (run 8)
  (let ((ratios '()))
    (every 0.1 (set! ratios (cons (/ (anchor-tension) (rov-tension)) ratios)))
    (run 6)
    (expect (/ (apply + ratios) (length ratios) (exp (* friction degrees (/ pi 180)))) is (within 0.05))))


;;; Thin and fast.

(define-scenario (a-wire-at-speed model)
  "Dragged at 3 m/s across a wire of 10 mm, and at 6 m/s back, the line never passes through it.  Response
physical, mu 0.3, EA 2e5 N."
  #:for ((model 'dynamic 'catenary 'rubber-band))
  (in (world (sea (depth 20))
             (cylinder (named wire) (from 0 0 1) (to 0 0 -20) (radius 0.005))
             (rov (named minnow) (at -6 8 -8) (surge-speed 6) (pull 1e6))
             (tether (named line) (type fathom) (wet-weight 0) (ea 2e5) (friction 0.3) (stick-angle 36000)
                     (from 0 -8 -8) (to minnow) (length 20) (model ,model))))
  (define (dash p speed)
    (move! p #:speed speed)
    (always-sound (run-until arrived? #:at-most 10)))
  (dash '(8 8 -8) 3)
  (expect (contacts) is pair?)
  (dash '(8 -2 -8) 3)
  (expect (winding 'wire) => 1)         ; it is hooked
  (dash '(-6 8 -8) 6)
  (run 5)
  (expect (winding 'wire) => 0))


;;; Finer, the same.

(define-scenario a-wrap-is-the-same-with-more-nodes
  "Round a pile and hauled tight: with four times the nodes the line winds about the same, touches the same
and pulls alike, to a fifteenth, since what friction holds depends on how it came to rest.  Response
physical, model dynamic, mu 0.3, EA 2e5 N."
  (define (wrapped nodes)
    (enter! (world (sea (depth 15) (current 0.25 90))
                   (cylinder (named pile) (from 0 0 1) (to 0 0 -15) (radius 0.45))
                   (rov (named minnow) (at 6 -6 -5))
                   (tether (named line) (type fathom) (wet-weight 0) (ea 2e5) (friction 0.3) (nodes nodes)
                           (from -6 -8 -3) (to minnow) (length 40) (model dynamic))))
    (fly '(6 6 -5) '(-6 6 -5) '(-6 -4 -5) '(6 -4 -5))
    (haul-in! 6 #:rate 0.5)
    (run 30)
    (list (winding 'pile) (map contact-object (contacts)) (rov-tension)))
  (let ((coarse (wrapped 64)) (fine (wrapped 256)))
    (expect (car coarse) => (car fine))
    (expect (and-map (lambda (o) (eq? o 'pile)) (append (cadr coarse) (cadr fine))))
    (expect (pair? (cadr coarse)))
    (expect (/ (caddr coarse) (caddr fine)) is (within 0.067))))


;;; Left alone.

(define-scenario energy-goes-and-never-comes
  "In still water, stirred and then left for 300 s, the line has less energy each second than ever before.
Model dynamic, EA 2e4 N, 0.1 N/m."
  (in (world (sea (depth 60))
             (rov (named minnow) (at 0 20 -15))
             (tether (named line) (type fathom) (wet-weight 0.1) (ea 2e4) (from 0 0 0) (to minnow) (length 40)
                     (nodes 32) (model dynamic))))
  (define (total) (apply + (map cdr (energy))))
  (fly '(4 16 -12) '(-4 18 -15) '(0 20 -15))
  (let ((most (total)) (began (total)))
    (do ((i 0 (+ i 1))) ((= i 300))
      (run 1)
      (expect (total) is (below (+ most 1e-3)))
      (set! most (min most (total))))
    (expect (assq-ref (energy) 'kinetic) is (below 1e-4))
    (expect most is (below began))))
