;; A mission plan in the jacket of the thesis (figure 3-8), as `bight sweep jacket-risk' flies it: in by the
;; south face, below the crossing of its braces, to the node under leg a2, out by the west face to look at
;; leg a1 from outside, and home: through the jacket again by the doors it came, or the short way, round
;; leg b1.  The water sets where and as hard as the grid says; the pilot misses each waypoint by some tens
;; of centimetres.  A tether is `fouled' when its way is longer than need be, `held' when a haul from the
;; anchor, tried on a fork of the dive, does not bring the vehicle home.
;;
;;   bight sweep jacket-risk -o jacket.db
;;   bight sweep --table jacket.db --by way,speed
;;   bight sweep --map jacket.db --of held -o jacket.svg

;; Go to the point (X Y Z), as well as a pilot can: he sees his instruments, not the mark.
(define (go x y z)
  (fly-to! (list (+ x (* 0.4 (random:normal)))
                 (+ y (* 0.4 (random:normal)))
                 (+ z (* 0.2 (random:normal))))
           #:speed 0.4)
  (run-until arrived? #:at-most 90))

(define-study jacket-risk
  "Which leg of a jacket inspection fouls the tether, by which way home, in which current?"
  #:for ((way (grid 'doors 'short))
         (speed (grid 0.05 0.2 0.35))
         (toward (grid 0 90 180 270))
         (seed (seeds 10)))
  (in (with jacket (current speed toward)))
  (leg south-door (go 0 -9 -14))
  (leg inside     (go 0 0 -14))
  (leg node-a2    (go 4.5 4.5 -14))
  (leg west-door  (go -9 0 -14))
  (leg leg-a1     (go -9 6 -14))
  (leg way-back   (cond ((eq? way 'doors) (go -9 0 -14) (go 0 0 -14) (go 0 -9 -14))
                        (else (go -10 -10 -14))))
  (leg home       (go -2 -14 -8))
  (measure (fouled (fouled?))
           (held (not (free-to-haul?)))
           (reason (or (foul-reason) 'free))
           (excess (excess))
           (tension (max-tension))
           (reached (arrived?))))
