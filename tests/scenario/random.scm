;;; What is true of every dive, tried on random worlds and random pilots: nothing is crossed, energy is bounded,
;;; every number is finite, turns change little by little, and the same comes of the same.  A case that fails
;;; is told as a scenario, made as simple as can be.  `bight test --cases 10000 -j 8 random.scm' looks further,
;;; `--seed N' elsewhere.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(define-property any-dive-is-sound
  "Whatever the world, the model and the pilot, every step leaves the dive as a dive must be."
  #:for ((scene (random-world))
         (pilot (random-pilot #:seconds 5)))
  #:cases 24
  (in scene)
  (always-sound (pilot)))

(define-property a-moving-line-is-sound
  "So it is of the moving line among posts and wires, flown and wound hard."
  #:for ((scene (random-world #:most 6 #:of '(pile) #:models '(dynamic)))
         (pilot (random-pilot #:most 8 #:seconds 5 #:does '(drive fly fly pay-out haul-in current release))))
  #:cases 12
  (in scene)
  (always-sound (pilot)))

(define-property the-same-comes-of-the-same
  "A fork, the dive itself and the dive restored end in the same state, bit for bit."
  #:for ((scene (random-world))
         (pilot (random-pilot #:most 4 #:seconds 1 #:does '(drive fly pay-out haul-in current model))))
  #:cases 12
  (in scene)
  (run 1/2)
  (expect (same-again? pilot)))

(define-property a-line-left-alone-loses-energy
  "In still water, its ends held, a moving line that was stirred has ever less energy."
  #:for ((east (uniform -4 4))
         (up (uniform -3 3))
         (weight (one-of 0 0.1 0.5))
         (length (uniform 17 30)))
  #:cases 6
  (in (world (sea (depth 40))
             (rov (named minnow) (at 0 16 -15))
             (tether (named line) (type fathom) (wet-weight weight) (from 0 0 -15) (to minnow)
                     (length length) (nodes 16) (model dynamic))))
  (move! (vec east 14 (+ up -15)) #:speed 2)
  (run-until arrived? #:at-most 10)
  (run 1)
  (let* ((last (total-energy)) (least last))
    (define (no-more-than-ever?)
      (let ((now (total-energy)))
        (set! least (min least (max last now)))
        (set! last now)
        (<= now (+ least (rounding weight length)))))
    (always (no-more-than-ever?) (run 10))))

;; Velocities are differences of second order, (3 x'' - 4 x' + x) / 2h.  Of a jump from v to v - J between two steps
;; the first velocity after it is v - 3/2 J, and v - J only in the next step: where a line runs taut its energy of motion is
;; told too low for one step, by m J (v - 5/4 J) / 4.  Hence the least that was told in one of any two steps on end.

;; J: what the solver of a step leaves, a little and as if all of the line had been lifted by a millimetre.
(define (rounding weight length)
  (+ 5e-3 (* 1e-3 weight length)))

(define (total-energy)
  (apply + (map cdr (energy))))
