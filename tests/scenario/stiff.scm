;;; A line with bending stiffness in a dive: it carries compression, and so keeps its length; it may have a set.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(use-modules (srfi srfi-1)
             (srfi srfi-4))

(define here-module (current-module))

(define (between-nodes)
  ;; The sum of the distances between the points of the tether.
  (let ((points (array->list (tether-points))))
    (fold (lambda (p q sum) (+ sum (norm (vec- (apply vec p) (apply vec q)))))
          0 points (cdr points))))

(define (off-its-length)
  ;; By how much of it.
  (abs (- (/ (between-nodes) (tether-length)) 1)))

(define (alone ei reach length model)
  (world (sea (depth 60))
         (rov (named minnow) (type kinematic) (at reach 0 -20))
         (tether (named line) (type fathom) (wet-weight 0) (ei ei) (from 0 0 -20) (to minnow) (length length)
                 (model ,model))))

(define-scenario (two-ends-are-pushed-apart model)
  "10 m of line between ends 9 m apart pushes with the load of the elastica, a little above Euler's 0.099 N."
  #:for ((model 'dynamic 'auto))
  (enter! (alone 1 9 10 model))
  (run 60)
  (expect (abs (- (rov-tension) 0.1038)) is (below 1e-3))
  (expect (abs (- (anchor-tension) 0.1038)) is (below 1e-3))
  (expect (off-its-length) is (below 1e-4)))

(define-scenario (a-vehicle-backs-off ei)
  "25 m of line, its vehicle backing off 8 m in still water: the line bows out and stays as long as it is."
  #:for ((ei 1e-3 0.1 1))
  (enter! (alone ei 24.9 25 'dynamic))
  (fly-to! '(17 0 -20))
  (let ((worst 0))
    (do ((k 0 (+ k 1))) ((= k 60))
      (run 1)
      (set! worst (max worst (off-its-length))))
    (expect worst is (below 1e-4))))

(define-scenario (a-fold-on-the-floor ei)
  "A heavy line is pushed together on the bed, along it: a fold rises, or the line goes aside, and none is lost."
  #:for ((ei 0.1 1))
  (enter! (world (sea (depth 20)) (seabed)
                 (rov (named minnow) (type kinematic) (at 9 0 -19.9))
                 (tether (named line) (type fathom) (wet-weight 0.5) (ei ei) (from 0 0 -19.9) (to minnow) (length 10)
                         (model dynamic))))
  (fly-to! '(7 0 -19.9))
  (run 60)
  (expect (off-its-length) is (below 1e-4))
  (expect (fold min 0 (map third (array->list (tether-points)))) is (above -20.01)))

(define-scenario a-few-long-chords-do-not-burst
  "A stiff line laid on three chords of its curve, each a hand shorter than its piece of line, comes to its length
gently: it pulled 294 N in the first step where it rests with 8, and parted."
  (enter! (world (sea)
                 (rov (named minnow) (type kinematic) (at -8.8 -6.4 -2.6))
                 (tether (named line) (from -8.7 3.5 -6.7) (to minnow) (length 37) (diameter 0.004) (wet-weight 0.54)
                         (ei 0.05) (breaking-load 50) (nodes 3) (model dynamic))))
  (always (and (< (max-tension) 40) (< (assq-ref (energy) 'kinetic) 1)) (run 10))
  (run 240)
  (expect (parted?) => #f)
  (expect (off-its-length) is (below 1e-4)))

(define-scenario what-becomes-stiff-unfolds
  "A limp line that lies short does not burst when it is given a stiffness: it comes to its length in time, and the
same from a checkpoint and in a fork."
  (enter! (alone 0 24.9 25 'dynamic))
  (fly-to! '(15 2 -20))
  (run 60)
  (let ((lost (off-its-length)))
    (expect lost is (above 1e-2))
    (alter! 'line #:ei 0.1)
    (let ((here (checkpoint)) (fastest 0))
      (do ((k 0 (+ k 1))) ((= k 60))
        (run 0.1)
        (set! fastest (max fastest (max-tension))))
      (expect fastest is (below 50))
      (run 24)
      (expect (off-its-length) is (below 1e-4))
      (let ((there (state-hash)))
        (restore! here)
        (expect (what-if (run 6) (run 24) (state-hash)) => there)))))

(define-scenario paid-out-tenfold-and-hauled
  "Paid out tenfold in a current, and hauled: its length is kept."
  (enter! (world (sea (depth 60) (current 0.2 90))
                 (rov (named minnow) (type kinematic) (at 3 0 -20))
                 (tether (named line) (type fathom) (ei 0.1) (from 0 0 -20) (to minnow) (length 4) (drum 100)
                         (model dynamic))))
  (pay-out! 36 #:rate 1)
  (run 60)
  (expect (off-its-length) is (below 1e-4))
  (haul-in! 20 #:rate 0.5)
  (run 60)
  (expect (off-its-length) is (below 2e-4)))

(define-scenario (hauled-while-it-is-bent clauses)
  "A stiff line that is hauled in fast, until the winch stalls, is nowhere pulled much harder than at its ends: the length
that the winch takes from the first interval is no bend of the line."
  #:for ((clauses '((ei 5)) '((ei 5) (ei-stuck 50) (slip-curvature 0.2))))
  (enter! (eval `(world (sea (depth 60)) (rov (named minnow) (type kinematic) (at 10 0 -20) (pull 1e4))
                        (tether (from 0 0 -20) (to minnow) (length 12) (ea 1e6) (winch-pull 100) (breaking-load 1e7)
                                (model dynamic) ,@clauses))
                here-module))
  (run 3)
  (haul-in! 3 #:rate 2)
  (always (< (max-tension) (+ 5 (* 1.1 (max (anchor-tension) (rov-tension)))))
    (run 3)))

(define-scenario (nodes-come-where-it-has-crumpled nodes)
  "A stiff line laid on few long chords, cut at its end, falls and takes more nodes: what the chords were crumpled by goes
to the parts of each, and is no strain."
  #:for ((nodes 4 6 8))
  (enter! (eval `(world (sea) (rov (named minnow) (at 6 7 -2.4) (pull 53))
                        (tether (named line) (type fathom) (wet-weight 1.2) (from -8 -2.5 -1.2) (to minnow) (length 31)
                                (ei 0.05) (nodes ,nodes) (model dynamic)))
                here-module))
  (run 1)
  (cut-tether! 'line #:at (tether-length))
  (always (< (max-tension) 120) (run 1))
  (expect (array-length (tether-points)) is (above (+ nodes 1))))

(define-scenario laid-shorter-than-it-is
  "A stiff line laid on chords shorter than its length has the energy of its bend, and none of what has crumpled; that of
its thrust stays small beside the bend's."
  (enter! (world (sea) (rov (named minnow) (at -6 0 -1))
                 (tether (named line) (from -9 0 -5) (to minnow) (length 17) (ei 1) (model dynamic))))
  (expect (assq-ref (energy) 'strain) is (below 1e-6))
  (expect (assq-ref (energy) 'bending) is (above 1))
  (always (< (assq-ref (energy) 'strain) 0.1) (run 5)))


;;; A set.

(define (coiled model . clauses)
  ;; A neutral line in still water.
  (eval `(world (sea (depth 60))
                (rov (named minnow) (type kinematic) (at 2.8 0 -20))
                (tether (named line) (type fathom) (wet-weight 0) (ei 0.05) (from 0 0 -20) (to minnow) (length 3)
                        (drum 30) (model ,model) ,@clauses))
        here-module))

(define (curvature-at s)
  ;; Of the circle through three places about S.
  (define (place s) (point-at s))
  (let* ((a (place (- s 0.2))) (b (place s)) (c (place (+ s 0.2)))
         (u (vec- b a)) (v (vec- c b)) (w (vec- c a))
         (cross (norm (cross-product u v))))
    (/ (* 2 cross) (* (norm u) (norm v) (norm w)))))

(define (cross-product u v)
  (let ((at f64vector-ref))
    (f64vector (- (* (at u 1) (at v 2)) (* (at u 2) (at v 1)))
               (- (* (at u 2) (at v 0)) (* (at u 0) (at v 2)))
               (- (* (at u 0) (at v 1)) (* (at u 1) (at v 0))))))

(define-scenario a-drum-has-left-its-set
  "Cut off at the vehicle a line curls up to the circle of its drum, the same in a fork and from a checkpoint, and it
stays as long as it is."
  (enter! (coiled 'dynamic '(set (curvature 1))))
  (run 1)
  (cut-tether! #:at 2.9)
  (let ((here (checkpoint)))
    (run 60)
    (expect (curvature-at 1) is (about 1 #:within .03))
    (expect (curvature-at 2) is (about 1 #:within .03))
    (expect (off-its-length) is (below 1e-4))
    (expect (assq-ref (energy) 'bending) is (below 1e-3))
    (let ((there (state-hash)))
      (restore! here)
      (expect (what-if (run 60) (state-hash)) => there))))

(define-scenario a-set-goes-with-its-line
  "A kink stays where it is in the line while more comes off the drum."
  (enter! (coiled 'dynamic '(set (at 1) (span 0.5) (curvature 3))))
  (run 20)
  (expect (curvature-at 1) is (above 0.8))
  (pay-out! 6 #:rate 1)
  (fly-to! '(8.6 0 -20))
  (run 60)
  (expect (curvature-at 7) is (above (* 4 (curvature-at 1)))))

(define-scenario no-set-is-none
  "A set without curvature changes nothing to the last bit; a model that finds its sets of its own nodes has them too."
  (define (after clauses)
    (enter! (apply coiled 'dynamic clauses))
    (fly-to! '(2 1 -20))
    (run 5)
    (f64vector->list (point-at 1.5)))
  (expect (after '((set (curvature 0)))) => (after '()))
  (enter! (coiled 'auto '(set (curvature 1))))
  (fly-to! '(1.5 0 -20))
  (run 60)
  (expect (off-its-length) is (below 1e-3))
  (expect (curvature-at 1.5) is (above 1)))

(define-scenario what-cannot-have-a-set
  "A limp line, a static model, a mesh too coarse and a place beyond the line are refused, by alter! too; the dive goes
on."
  (expect (enter! (coiled 'catenary '(set (curvature 1)))) raises unsupported)
  (expect (enter! (world (sea) (rov (named minnow) (at 2 0 -1))
                         (tether (from 0 0 -1) (to minnow) (length 3) (model dynamic) (set (curvature 1)))))
          raises unsupported)
  (expect (enter! (coiled 'dynamic '(set (curvature 50)))) raises def)
  (expect (enter! (coiled 'dynamic '(set (curvature 1) (at 4)))) raises def)
  (expect (enter! (coiled 'dynamic '(set))) raises def)
  (enter! (coiled 'dynamic '(set (curvature 1))))
  (expect (alter! 'line #:ei 0) raises unsupported)
  (expect (alter! 'line #:model 'steady) raises unsupported)
  (alter! 'line #:ei 0.02)
  (run 1)
  (expect (now) is (about 1 #:within 1e-9)))

(define (armoured model . clauses)
  ;; A stiff line that its vehicle holds 2 m from its anchor, with CLAUSES more.
  (eval `(world (sea (depth 60)) (rov (named minnow) (type kinematic) (at 2 0 -20) (pull 1e6))
                (tether (named line) (type fathom) (from 0 0 -20) (to minnow) (length 3) (wet-weight 0) (ei 0.5)
                        (bending-damping 0.05) (breaking-load 1e6) (nodes 40) (drum 30) (model ,model) ,@clauses))
        here-module))

(define (bent-and-let-straight model . clauses)
  ;; How far such a line is from straight after it was bent and drawn straight again, m.
  (enter! (apply armoured model clauses))
  (fly-to! '(1 0 -20))
  (run 10)
  (fly-to! '(2.97 0 -20) #:speed 1/2)
  (run 20)
  (cut-tether! #:at 2.9)
  (run 30)
  (let ((l (tether-length)))
    (norm (vec- (point-at (/ l 2)) (vec* 1/2 (vec+ (point-at 0) (point-at l)))))))

(define-scenario (layers-slip-and-stay-slipped model)
  "Bent by its vehicle, drawn straight and cut loose, a line whose layers slip keeps a bend; an elastic one keeps none.
What it keeps is in forks and checkpoints, and goes with its line when more is paid out."
  #:for ((model 'dynamic 'auto))
  (let ((kept (bent-and-let-straight model '(ei-stuck 5) '(slip-curvature 0.2))))
    (expect kept is (above 0.05))
    (expect (assq-ref (profile) 'chain-slips) is (above 0)))
  (let ((here (checkpoint)) (l (tether-length)))
    (pay-out! 2 #:rate 1)
    (run 5)
    (let ((there (state-hash)))
      (restore! here)
      (expect (what-if (begin (pay-out! 2 #:rate 1) (run 5)) (state-hash)) => there)))
  (expect (bent-and-let-straight model) is (below 0.02))
  (expect (assq-ref (profile) 'chain-slips) => 0))

(define-scenario layers-that-are-none
  "Layers that stick no more than they slip, and such as always slip, change nothing to the last bit; a set beside them, or a
line stiffer while they slip, is refused, by alter! too."
  (define (after clauses)
    (enter! (apply armoured 'dynamic clauses))
    (fly-to! '(1.2 0.5 -20))
    (run 5)
    (f64vector->list (point-at 1.5)))
  (expect (after '((ei-stuck 0.5) (slip-curvature 0.2))) => (after '()))
  (expect (after '((ei-stuck 5))) => (after '()))
  (expect (enter! (armoured 'dynamic '(ei-stuck 0.1))) raises domain)
  (expect (enter! (armoured 'dynamic '(ei-stuck 5) '(set (curvature 1)))) raises unsupported)
  (enter! (armoured 'dynamic '(ei-stuck 5) '(slip-curvature 0.2)))
  (expect (alter! 'line #:ei 6) raises domain)
  (alter! 'line #:ei-stuck 8)
  (run 1)
  (expect (now) is (about 1 #:within 1e-9)))
