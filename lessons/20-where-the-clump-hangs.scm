;; A clump takes the drag of the umbilical and hands the tether over near the work: above what stands there.
(define (manifold-with metres weight)
  ;; The scene with a clump of WEIGHT kilograms at METRES of line.
  (world (sea     (depth 60) (current (profile (0 0.6 90) (-40 0.35 90) (-50 0.1 90) (-60 0.05 90))))
         (seabed  (friction 0.6))
         (box     (named manifold) (at 0 10 -57) (size 10 4 6))
         (capsule (named valve) (from 0 17.5 -60) (to 0 17.5 -53) (radius 0.2))
         (rov     (named minnow) (type bluerov2-heavy) (at 2 3 -47) (heading 0))
         (tether  (named line) (type fathom) (wet-weight 0) (friction 0.4) (model dynamic)
                  (from 0 0 1) (to minnow) (length 60) (drum 120)
                  (clump (at metres) (mass weight)))))

(define-lesson where-the-clump-hangs "The umbilical, the clump, and the tether"
  (grade 3)
  (trains trim handling)
  (needs bow slack)
  (say "Sixty metres of water with a tide in it: half a metre a second and more above, next to nothing at the
bed.  In that your umbilical is a sail.  A clump weight takes it over: down to the clump the line is the
ship's, and from the clump on it is yours, some metres to move in.")
  (say "Where it hangs is decided on deck.  You are to look at a valve, 53 m deep, behind a manifold that
stands up to 54 m.  Too high, and you drag the sail yourself.  Too low, and your tether leads through the steel.")
  (probe "At how many metres of line do you shackle the clump on?" 'at-47 #:choices (at-25 at-47 at-57))
  (in (cond ((eq? 'at-25 (last-answer)) (manifold-with 25 22))
            ((eq? 'at-57 (last-answer)) (manifold-with 57 22))
            (else (manifold-with 47 22))))
  (show)
  (task "To the valve: within 1.2 m of the target, and look at it for ten seconds."
        (target "valve" '(0 16 -53))
        (done-when (< (range-to '(0 16 -53)) 1.2))
        (held-for 10)
        (hint-after 30 "Over the manifold at 51 m, then down to the valve.  Mind that the clump stays above 54 m.")
        (fail-when (parted?) "The tether has parted.")
        (at-most 300))
  (probe "Where does your tether leave you to?  Its bearing, five metres from you."
         (bearing-to (point-at (- (tether-length) 5))) #:within 25)
  (task "Back to below the ship: within 2 m of the target."
        (target "below the ship" '(2 3 -48))
        (done-when (< (range-to '(2 3 -48)) 2))
        (hint-after 40 "Up first: your tether goes over the manifold, and so do you.")
        (fail-when (parted?) "The tether has parted.")
        (at-most 240))
  (score ((null? (contacts)) 1 1 #:share 0.9 #:weight 4
          #:as "tether off the manifold"
          #:why "A clump below the top of what you cross leads your tether through it.")
         (rov-tension 0 25 #:share 0.85 #:over 30 #:weight 4
          #:as "pull at the vehicle, N"
          #:why "The clump, deep in slack water, takes the umbilical's drag; high up it leaves it to you.")
         (rov-clearance 0.8 +inf.0 #:by least #:over 0.8 #:weight 2
          #:why "Most of a metre off the manifold: what swings under a ship swings you too."))
  (pilot expert "A clump at 47 m, and over the manifold."
    (answers (truth choices) truth)
    (flies (fly-legs '((0 8 -50.5) (0 15 -51) (0 16 -53)) 0.35))
    (flies (fly-legs '((0 15 -51) (0 8 -50) (2 3 -48)) 0.35)))
  (pilot ordinary "A clump at 47 m, but he skims the manifold."
    (answers (truth choices) (if choices truth (+ truth 40)))
    (flies (run 10) (fly-legs (list (list 0 8 (+ -53.3 (jitter 0.1))) '(0 13 -53.4) '(0 16 -53)) 0.3))
    (flies (run 10) (fly-legs (list '(0 13 -53.4) (list 0 8 (+ -53.3 (jitter 0.1))) '(2 3 -48)) 0.3)))
  (pilot careless "A clump as deep as it goes, and round the side of the manifold."
    (answers (truth choices) (if choices 'at-57 0))
    (flies (fly-legs (list (list 6.5 6 (+ -56 (jitter 0.3))) '(6.5 14 -56) '(0 16 -53)) 0.5) (run 60))
    (flies (fly-legs '((-6.5 14 -56) (-6.5 6 -56) (2 3 -48)) 0.5))))

(define (fly-legs points speed)
  (for-each (lambda (p)
              (fly-to! p #:speed speed)
              (run-until (lambda () (< (range-to p) 0.8)) #:at-most 60))
            points))
