;;; An armoured cable, of two stiffnesses and layers that slip, beside every feature that moves, cuts, keeps or asks a line:
;;; judged by laws that know no solver.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(use-modules (bight watched))

(define here-module (current-module))

(define* (bent-cable #:key (model 'dynamic) (length 6))
  ;; Dive with an armoured cable between a winch and a vehicle 3 m from it, slack, in a slow current; the vehicle bends the
  ;; cable until its layers slip.
  (enter! (eval `(world (sea (depth 60) (current 0.1 90))
                        (rov (named minnow) (type kinematic) (at 3 0 -20) (pull 1e4))
                        (tether (named line) (type fathom) (from 0 0 -20) (to minnow) (length ,length) (ei 0.5)
                                (ei-stuck 5) (slip-curvature 0.2) (bending-damping 0.05) (breaking-load 1e6) (drum 60)
                                (model ,model)))
                here-module))
  (fly-to! '(1 0.5 -20) #:speed 1/2)
  (run 6)
  (expect (assq-ref (profile) 'chain-slips) is (above 0)))

(define-scenario (orders-are-sound model)
  "Whatever is done with a cable whose layers have slipped, no law is broken and all of it stays finite."
  #:for ((model 'dynamic 'auto))
  (bent-cable #:model model)
  (expect (watched (pay-out! 4 #:rate 1) (run 6)
                   (haul-in! 5 #:rate 1) (run 6)
                   (place! 'minnow '(2 2 -21)) (run 2)
                   (place! 'minnow '(2.5 1 -20) #:fresh #t) (run 2)
                   (accuracy! 0.02) (run 2)
                   (accuracy! 0.2) (run 2)
                   (current! 0.4 180) (run 3)
                   (alter! 'line #:ei-stuck 3) (run 1)
                   (alter! 'line #:slip-curvature 1) (run 1)
                   (cut-tether! #:at 2) (run 4))
          => '()))

(define-scenario (other-models-between model)
  "Another model, which may know no stiffness, takes the cable over and gives it back."
  #:for ((model 'auto 'steady 'catenary 'rubber-band 'elastic))
  (bent-cable)
  (expect (watched (tether-model! model) (run 2) (tether-model! 'dynamic) (run 2) (tether-model! model) (pay-out! 2)
                   (run 3) (tether-model! 'dynamic) (run 2))
          => '()))

(define-scenario another-process-goes-on-alike
  "What has slipped is in a file, in a fork and in a checkpoint, with nodes come and gone and after a cut."
  (bent-cable)
  (pay-out! 3 #:rate 1)
  (run 2)
  (expect (watched (same-when-loaded! 60)) => '())
  (let ((here (checkpoint)) (fork (what-if (begin (haul-in! 2 #:rate 1) (run 3) (state-hash)))))
    (haul-in! 2 #:rate 1)
    (run 3)
    (expect (state-hash) => fork)
    (restore! here)
    (cut-tether! #:at 2)
    (run 1)
    (expect (watched (same-when-loaded! 60)) => '())))

(define-scenario (what-slips-loses-energy end)
  "Cut loose in still water, a cable has less energy from second to second."
  #:for ((end 2 5.5))
  (bent-cable)
  (current! 0 0)
  (cut-tether! #:at end)
  (run 1)
  (let loop ((k 0) (before 1e9))
    (let ((energy (apply + (map cdr (energy 'line)))))
      (when (< k 5)
        (expect energy is (below (+ before 1e-6)))
        (run 1)
        (loop (+ k 1) energy)))))

(define-scenario (one-cable-however-paid-out rate)
  "Paid out and hauled in again, at any rate, a cable is as long as it was, and its ends are where they are held."
  #:for ((rate 0.2 1 5))
  (bent-cable #:length 5)
  (expect (watched (pay-out! 15 #:rate rate) (run (+ 5 (/ 15 rate))) (haul-in! 15 #:rate rate)
                   (run (+ 5 (/ 15 rate)))) => '())
  (expect (tether-length) is (about 5 #:within 1e-6))
  (run 60)
  (expect (rov-tension) is (below 20)))

(define-scenario turned-it-is-the-same-cable
  "A world turned by a quarter has the same tensions."
  (define (tension-of at)
    (enter! (eval `(world (sea (depth 60)) (rov (named minnow) (type kinematic) (at ,@at -20) (pull 1e4))
                          (tether (named line) (type fathom) (from 0 0 -20) (to minnow) (length 5) (ei 0.5)
                                  (ei-stuck 5) (slip-curvature 0.2) (model dynamic)))
                  here-module))
    (fly-to! (list (* 0.5 (car at)) (* 0.5 (cadr at)) -20) #:speed 1/2)
    (run 10)
    (rov-tension))
  (let ((east (tension-of '(3 0))))
    (expect east is (above 0.01))
    (expect (tension-of '(0 3)) is (about east #:within (* 1e-3 east)))))

(define-scenario (between-the-two-stiffnesses reach)
  "Held with its ends near each other, a cable whose layers slip pushes more than one of the lower stiffness, and less than
one of the higher."
  #:for ((reach 2 4))
  (define (push clauses)
    (enter! (eval `(world (sea (depth 60)) (rov (named minnow) (type kinematic) (at ,reach 0 -20) (pull 1e6))
                          (tether (named line) (type fathom) (wet-weight 0) (from 0 0 -20) (to minnow) (length 5)
                                  (bending-damping 0.1) (model dynamic) ,@clauses))
                  here-module))
    (run 30)
    (rov-tension))
  (let ((loose (push '((ei 0.5)))) (both (push '((ei 0.5) (ei-stuck 5) (slip-curvature 0.2))))
        (stuck (push '((ei 5)))))
    (expect both is (above loose))
    (expect both is (below stuck))))
