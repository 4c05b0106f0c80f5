;; Cleaning legs in a tide that turns: each side of a jacket has its hour, and it is the water's, not yours.
(define-world cleaning
  "A jacket to be cleaned on its two southern legs, the boat south of it; the tide sets west and turns."
  (sea     (depth 36) (current (tide (speed 0.3) (toward 270) (period 880))))
  (seabed  (friction 0.6))
  (splice  (make-jacket #:depth 36 #:bays 2 #:top 2))
  (rov     (named minnow) (type bluerov2-heavy) (at 0 -13 -9) (heading 0))
  (tether  (named line) (type fathom) (wet-weight 0) (friction 0.4) (model dynamic)
           (from 0 -22 1) (via (0 -21 -9)) (to minnow) (length 19) (drum 120)
           (clump (at 9) (mass 4))))

(define-lesson leg-cleaning "Cleaning the legs while the tide turns"
  (grade 3)
  (trains tide route)
  (needs route handling)
  (setting speed 0.2 0.3 0.35)
  (in (with cleaning (current (tide (speed (setting 'speed)) (toward (+ 270 (jitter 10))) (period 880)))))
  (say "Two legs are to be freed of mussels before the inspectors come: the west face of the south-west leg,
and the east face of the south-east leg.  Half a minute at each will do
today.  You stand south of the jacket; a clump keeps your tether down at 8 m.")
  (say "The tide sets west, at ~a m/s, and turns at 220 s; then it sets east.  A tether that is pressed to a
leg while the jet shakes you is a tether that is sawn.  Choose which leg first, and what you do at the turn."
       (setting 'speed))
  (show)
  (probe "Which leg do you clean while the tide sets west?" 'south-west #:choices (south-west south-east))
  (probe "The jet is on, the leg is half clean, and the tide turns.  What then?" 'move-off
         #:choices (finish-first move-off ask-for-slack))
  (task "Clean both legs: half a minute in all within 1.2 m of the one place, and half a minute of the other."
        (target "west leg" '(-7.6 -6 -9)) (target "east leg" '(7.6 -6 -9))
        (done-when (and (note-work!) (>= (counter 'west) 30) (>= (counter 'east) 30)))
        (hint-after 40 "The face that the water leaves: what it carries off the leg, it carries off your tether too.")
        (hint-after 170 "By now stand off to the south, and wait out the turn there."
                     "(0 -13 -9)")
        (fault-after 200 "The ship: slack water by the meter.  It makes to the east from now on.")
        (fail-when (parted?) "The tether has parted.")
        (at-most 400))
  (task "Home to the boat: to within 1.5 m of it, the tether clear of both legs."
        (target "boat" '(0 -13 -9))
        (done-when (and (< (range-to '(0 -13 -9)) 1.5) (null? (contacts))))
        (hint-after 40 "Away from the leg first, south, and then across.")
        (fail-when (parted?) "The tether has parted.")
        (at-most 150))
  (tender "Keeps a metre or two loose, and no more."
    (let tend ()
      (cond ((or (< (loose) 1.5) (taut?)) (pay-out! 1 #:rate 1))
            ((and (> (loose) 4) (> (tether-length) 15)) (haul-in! 1 #:rate 0.8)))
      (run 1)
      (tend)))
  (score ((null? (contacts)) 1 1 #:share 0.95 #:weight 6
          #:as "tether on nothing"
          #:why "Work the face that the water carries your tether off, and move off before it turns.")
         ((now) 0 420 #:by end #:over 150 #:weight 2
          #:as "time on the job, s"
          #:why "West leg at once, wait out the turn standing off, then the east leg: seven minutes.")
         (max-tension 0 90 #:by most #:over 150 #:weight 2
          #:why "A vehicle that jets holds itself; its tether must hang loose.")
         (rov-clearance 0.4 +inf.0 #:by least #:over 0.4
          #:why "The lance reaches a metre: keep the hull half a metre off the leg."))
  (pilot expert "West leg on the west-going tide; stands off for the turn; then the east leg."
    (answers (truth choices) truth)
    (flies (fly-legs '((-8.2 -10 -9) (-7.9 -6 -9)) 0.45) (run-until (lambda () (>= (counter 'west) 30)) #:at-most 60)
           (fly-legs '((-8.2 -10 -9) (0 -13 -9)) 0.45) (run-until (lambda () (> (now) 225)) #:at-most 200)
           (fly-legs '((8.2 -10 -9) (7.9 -6 -9)) 0.45))
    (flies (fly-legs '((8.2 -10 -9) (0 -13 -9)) 0.45)))
  (pilot ordinary "The right legs, but he goes across too early, and close."
    (answers (truth choices) (if (memq 'finish-first choices) 'ask-for-slack truth))
    (flies (run 10) (fly-legs '((-7.6 -6 -9)) 0.35) (run-until (lambda () (>= (counter 'west) 30)) #:at-most 90)
           (fly-legs (list (list (+ 7.6 (jitter 0.1)) -7 -9) '(7.6 -6 -9)) 0.35))
    (flies (run 5) (fly-legs '((0 -13 -9)) 0.35)))
  (pilot careless "Begins with the leg that is in the sun, finishes what he began, and comes home through the jacket."
    (answers (truth choices) (cond ((memq 'south-east choices) 'south-east) (else 'finish-first)))
    (flies (fly-legs (list (list (+ 7.3 (jitter 0.1)) -6 -9)) 0.5) (run 45)
           (fly-legs '((7.5 -4.5 -9) (0 -4 -9) (-7.6 -4.5 -9) (-7.5 -6 -9)) 0.5))
    (flies (fly-legs '((-7.6 -4 -9) (0 -4 -9) (0 -13 -9)) 0.6))))

(define (note-work!)
  ;; The seconds of work at each leg.
  (if (< (range-to '(-7.6 -6 -9)) 1.2) (count! 'west 0.2))
  (if (< (range-to '(7.6 -6 -9)) 1.2) (count! 'east 0.2))
  #t)

(define (loose) (* (slack) (tether-length)))

(define (fly-legs points speed)
  ;; With thrusters, in a tide, one is never quite there.
  (for-each (lambda (p)
              (fly-to! p #:speed speed)
              (run-until (lambda () (< (range-to p) 0.7)) #:at-most 70))
            points))
