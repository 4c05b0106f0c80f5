;;; Laws of random worlds that compare: the same dive moved, turned, mirrored, scaled, laid whole or paid out,
;;; by another model; energy and work; windings and classes.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(use-modules (bight test any-dive)
             (bight dive any-flight)
             (bight world any-world)
             (bight test metamorphosis)
             (bight test soundness)
             ((srfi srfi-1) #:hide (every))
             ((srfi srfi-1) #:select ((every . all?))))


;;; The same dive elsewhere.

(define (as-datum generator)
  ;; What GENERATOR draws, to be evaluated by the test.
  (made-of (lambda (expression) (list 'quote expression)) generator))

(define (or-no-case thunk)
  ;; What THUNK returns; the case is given up when it is refused.
  (let ((value (with-exception-handler (lambda (e) (if (bight-error? e) e (raise-exception e)))
                 thunk
                 #:unwind? #t)))
    (assume (not (bight-error? value)))
    value))

(define (world-of-case expression)
  (or-no-case (lambda () (evaluated expression))))

(define (in-random world)
  (or-no-case (lambda () (enter! world))))

(define (do-order order)
  ;; Do ORDER, which may be refused.
  (with-exception-handler (lambda (e) (unless (bight-error? e) (raise-exception e)))
    (lambda () (evaluated order))
    #:unwind? #t))

(define (answers)
  (map tether-answers (tether-names)))

(define (span name)
  ;; How far the ends of the tether NAME are from each other as seen from above, m.
  (let ((way (vec- (point-at name (tether-length name)) (point-at name 0))))
    (norm (vec (x way) (y way) 0))))

(define (flown world orders)
  ;; The answers when ORDERS were given.  A line whose ends lie one above the other may hang in any plane:
  ;; such a case is given up.
  (in-random world)
  (assume (all? (lambda (name) (> (span name) 1)) (tether-names)))
  (for-each do-order orders)
  (answers))

(define (changed-or-none change world)
  ;; WORLD after CHANGE; the case is given up if it cannot be changed so.
  (with-exception-handler
      (lambda (e)
        (assume (not (and (bight-error? e) (eq? 'unsupported (bight-error-kind e)))))
        (raise-exception e))
    (lambda () (changed-world change world))))

(define (apart change before after)
  ;; How far two answers about a tether are from each other, m.
  (apply max (map (lambda (p q) (distance (changed-point change p) q))
                  (assq-ref before 'points) (assq-ref after 'points))))

(define (stated answers)
  ;; The error in position that a tether states, m; what rounding does to a place a kilometre off.
  (max 1e-6 (or (assq-ref answers 'error) 0)))

(define (same-after? change before after)
  (all? (lambda (a b)
          (<= (apart change a b)
              (+ (* (changed-number change "m" 1) (stated a)) (stated b))))
        before after))

(define one-tether (as-datum (any-world #:obstacles 0 #:vehicles 1 #:tethers 1)))
(define some-parts (as-datum (any-world #:obstacles 2 #:vehicles 1 #:tethers 2)))

(define ways
  ;; Changes under which a dive stays what it is, whatever its models.
  (list (moved (vec 1000 -500 0)) (turned 1) (turned 2) mirrored))

(define statics '(rubber-band v-shape catenary elastic steady))

(define (all-of-rest? world)
  ;; Are all tethers of WORLD of models that take no time?
  (all? (lambda (part)
          (or (not (eq? 'tether (part-head part)))
              (memq (assq-ref (part-all-fields part) 'model) statics)))
        (world-parts world)))

(define-property what-rests-is-the-same-elsewhere
  "Among obstacles, models of rest give the same dive where it is moved, turned or mirrored."
  #:for ((world some-parts)
         (orders (as-datum (any-flight #:most 4 #:kinds '(drive fly move pay-out haul-in current))))
         (way (integer 0 3)))
  #:cases 10
  (define change (list-ref ways way))
  (define here (world-of-case world))
  (assume (all-of-rest? here))
  (define there (changed-or-none change here))
  (define before (flown here orders))
  (define after (flown there (map (lambda (order) (changed-order change order)) orders)))
  (expect (same-after? change before after)))

(define-property a-moving-line-is-the-same-elsewhere
  "In open water the moving line does so within the error that it states, if it is not slack in a heap."
  #:for ((world one-tether)
         (orders (as-datum (any-flight #:most 3 #:kinds '(drive fly move pay-out current))))
         (way (integer 0 3)))
  #:cases 6
  (define change (list-ref ways way))
  (define here (with (world-of-case world) (t1 (model dynamic) (nodes 16))))
  (define there (changed-or-none change here))
  (define before (flown here orders))
  (assume (null? (events)))
  (define after (flown there (map (lambda (order) (changed-order change order)) orders)))
  (expect (same-after? change before after)))

(define-property lines-and-what-moves-are-the-same-elsewhere
  "So do two moving lines of one vehicle, past a ball on its way."
  #:for ((from (uniform -8 -5)) (apart (uniform 1 3)) (length (uniform 1.05 1.3)) (speed (uniform 0.2 1))
         (way (integer 0 3)))
  #:cases 4
  (define change (list-ref ways way))
  (define here
    (world (sea (depth 60) (current 0.3 70))
           (sphere (named ball) (radius 0.5) (track (0 0 9 -8) (20 0 3 -8)))
           (rov (named r1) (at 0 12 -9))
           (tether (named t1) (from from 0 -4) (to r1) (length (* length 17)) (model dynamic) (nodes 16))
           (tether (named t2) (from (+ from apart) 0 -14) (to r1) (length (* length 18)) (model dynamic)
                   (nodes 16))))
  (define orders `((move! 'r1 (vec 4 10 -7) #:speed ,speed) (run 3) (pay-out! 't1 2 #:rate 1) (run 3)))
  (define there (changed-or-none change here))
  (define before (flown here orders))
  (define after (flown there (map (lambda (order) (changed-order change order)) orders)))
  (expect (same-after? change before after)))

(define-property froude
  "A line at rest that is so many times as large, in water so much faster, has the same shape."
  #:for ((world one-tether) (by (one-of 2 4 1/4)))
  #:cases 10
  (define change (scaled by))
  (define here (world-of-case world))
  (assume (all-of-rest? here))
  (define there (or-no-case (lambda () (changed-world change here)))) ; nor what would leave the schema
  (define before (flown here '()))
  (define tension (max-tension 't1))
  (define after (flown there '()))
  (expect (same-after? change before after))
  (expect (max-tension 't1) is (about (changed-number change "N" tension)
                                      #:within (* 1e-6 (+ 1 (changed-number change "N" tension))))))

(define-property a-moving-line-scales
  "A moving line that another current takes along is where Froude's law has it, a root of the scale later."
  #:for ((world one-tether) (speed (uniform 0.1 0.8)) (toward (integer 0 359)) (by (one-of 4 1/4)))
  #:cases 6
  (define change (scaled by))
  (define here (with (world-of-case world) (t1 (model dynamic) (nodes 16))))
  (define there (or-no-case (lambda () (changed-world change here))))
  (define (swept seconds)
    `((current! ,speed ,toward) (run ,seconds)))
  (define before (flown here (swept 4)))
  (assume (null? (events)))
  (define after (flown there (map (lambda (order) (changed-order change order))
                                  (swept (changed-number change "s" 4)))))
  (expect (same-after? change before after)))

(define (within-accuracy? before after)
  ;; Among obstacles a model of rest lays its nodes along its curve; each line says how exact it is meant to be.
  (all? (lambda (a b)
          (<= (apart (moved (vec 0 0 0)) a b)
              (+ (stated a) (stated b) (assq-ref (assq-ref a 'fields) 'accuracy))))
        before after))

(define-property what-is-far-away-does-not-matter
  "Something a kilometre off changes nothing but what the nodes of a line are laid along."
  #:for ((world one-tether)
         (orders (as-datum (any-flight #:most 3 #:kinds '(drive fly move pay-out current)))))
  #:cases 6
  (define here (with (world-of-case world) (t1 (nodes 64) (accuracy 0.05))))
  (define before (flown here orders))
  (define after (flown (extend here (sphere (named far) (at 1000 1000 -8) (radius 2))) orders))
  (expect (within-accuracy? before after)))


(define-scenario another-place-is-another-dive
  "What is moved, or scaled, is not the same as what is not."
  (define (of change)
    (enter! (changed-world change (find-world 'open-water)))
    (answers))
  (define stays (moved (vec 0 0 0)))
  (define before (of stays))
  (expect (same-after? (moved (vec 0 9 0)) before (of (moved (vec 0 9 0)))))
  (expect (not (same-after? stays before (of (moved (vec 0 1 0))))))
  (expect (not (same-after? (turned 1) before (of (turned 2)))))
  (expect (not (same-after? (scaled 2) before (of (scaled 3))))))


;;; Two models of one world; what rests is in balance.

(define (given? part field)
  (assq-ref (part-all-fields part) field))

(define (bare? world)
  ;; Is there nothing on the line t1, and nothing that would move it?
  (let ((sea (world-part world 'sea)) (line (world-part world 't1)))
    (not (or (given? line 'clump) (given? line 'float) (given? sea 'waves)
             (positive? (or (given? (world-part world 'r1) 'mass) 0))
             (memq (car (or (given? sea 'current) '(still))) '(tide grid))))))

(define-property at-rest-all-models-are-one
  "A moving line begun where it rests stays there, in balance, within the errors that both have."
  #:for ((world one-tether))
  #:cases 6
  (define here (with (world-of-case world) (r1 (pull 1e6)) (t1 (model steady) (nodes 64))))
  (assume (bare? here))
  (in-random here)
  (assume (< (z (point-at 't1 (/ (tether-length 't1) 2))) -1))
  (define rest (car (answers)))
  (expect (imbalance 't1) is (below (+ 0.01 (/ 1 64)))) ; no nearer than the load of one interval
  (tether-model! 't1 'dynamic)
  (run 3)
  (expect (apart (moved (vec 0 0 0)) rest (car (answers))) is (below (* 2 (stated (car (answers))))))
  (tether-model! 't1 'auto)
  (run 6)                               ; what it states is of its own rest, not of the way there
  (expect (apart (moved (vec 0 0 0)) rest (car (answers))) is (below (* 2 (stated (car (answers)))))))

(define-property laid-whole-or-paid-out
  "A line at rest does not know how it came to be so long."
  #:for ((world one-tether) (share (uniform 0.1 0.9)))
  #:cases 6
  (define whole (with (world-of-case world) (t1 (model steady) (drum none) (winch-rate none))))
  (in-random whole)
  (assume (> (span 't1) 1))
  (define laid (car (answers)))
  (define length (tether-length 't1))
  (define least (straight-distance 't1))
  (define begun (+ least (* share (- length least))))
  (in-random (with whole (t1 (length begun))))
  (pay-out! 't1 (- length begun) #:rate (- length begun))
  (run 2)
  (assume (= least (straight-distance 't1)))
  (expect (tether-length 't1) is (about length #:within 1e-9))
  (expect (apart (moved (vec 0 0 0)) laid (car (answers))) is (below 1e-3)))


;;; Energy.

(define (total-energy)
  (apply + (map cdr (energy))))

(define (work-of thunk)
  ;; Let THUNK pass time: what the vehicle does to the line meanwhile, J, and how much to and fro.
  (let ((work 0) (all 0) (place (rov-position)) (force (tether-force)))
    (define (add!)
      (let* ((w (* -1/2 (apply + (map * (f64vector->list (vec+ force (tether-force)))
                                      (f64vector->list (vec- (rov-position) place)))))))
        (set! work (+ work w))
        (set! all (+ all (abs w)))
        (set! place (rov-position))
        (set! force (tether-force))))
    (always (begin (add!) #t) (thunk))
    (cons work all)))

(define-property energy-is-work-done-less-what-is-lost
  "In still water a moving line gains no more energy than its vehicle gives it."
  #:for ((world one-tether)
         (orders (as-datum (any-flight #:most 3 #:kinds '(drive fly move)))))
  #:cases 6
  (define here (with (world-of-case world) (t1 (model dynamic) (nodes 16)) (current still)))
  (assume (bare? here))
  (in-random here)
  (define before (total-energy))
  (define work (work-of (lambda () (for-each do-order orders) (run 1/2))))
  (expect (- (total-energy) before) is (below (+ (car work) (* 0.05 (cdr work)) 0.01))))

(define-scenario energy-without-work-is-noticed
  "A vehicle that lifts a heavy line gives it energy: without the work the law would be broken."
  (in (with open-water (current still) (line (model dynamic) (nodes 16) (wet-weight 1))))
  (define before (total-energy))
  (move! '(0 15 -2) #:speed 1)
  (define work (work-of (lambda () (run 4))))
  (expect (- (total-energy) before) is (above 1))
  (expect (car work) is (above 1)))


;;; Awareness.

(define-property nothing-winds-in-the-free-class
  "Where nothing needs to be unwound, no object is wound about."
  #:for ((world some-parts)
         (orders (as-datum (any-flight #:most 4 #:kinds '(fly move pay-out)))))
  #:cases 8
  (in-random (world-of-case world))
  (for-each do-order orders)
  (for-each (lambda (name) (expect (free-class-unwound name) => #f)) (tether-names)))
