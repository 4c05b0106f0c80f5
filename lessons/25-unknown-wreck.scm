;; A wreck that nobody has seen, looked at from all sides, and not once gone round.
(define-lesson unknown-wreck "An unknown wreck, surveyed without a turn"
  (grade 4)
  (trains route turns)
  (needs route turns blind)
  (setting set 0.08 0.15 0.2)
  (in (with wreck (current (setting 'set) (+ 290 (jitter 10)))))
  (say "A mark on the sonar: thirty metres long, seven wide, lying about north-north-east, twenty metres down,
with masts, by the shadows.  Nobody has a drawing of it.  The archaeologists want it seen from four
sides, west, north, east and south, each from within 2 m.")
  (say "You could go round it once and be home in five minutes, and your tether with you, round masts and stays
that you have not seen.  Two halves, each out and back by the same side, cost ten, and leave nothing behind.")
  (show)
  (probe "West and north are seen.  You are off the bow: how do you come to the east side?" 'back-and-round-the-south
         #:choices (on-round-the-bow back-and-round-the-south over-her))
  (task "See it from all four sides, and come back to within 2 m of where you began."
        (target "west" '(-9 2 -17)) (target "north" '(5 19 -17)) (target "east" '(9 -3 -17))
        (target "south" '(-5 -19 -17)) (target "back" '(-10 -14 -16))
        (done-when (and (all-seen?) (< (range-to '(-10 -14 -16)) 2)))
        (hint-after 40 "West, then north; then back along her west side and by the south to her east side.")
        (hint-after 200 "Seen: west, north, south, east?  The rest of the way home is the way you came.")
        (fail-when (parted?) "The tether has parted.")
        (at-most 420))
  (task "Hand over: the tether free to haul, and no turn in it, within 2 m of where you began."
        (target "hand over" '(-10 -14 -16))
        (done-when (and (< (range-to '(-10 -14 -16)) 2) (< (excess) 0.5) (< (abs (net-turns)) 0.5)))
        (held-for 3)
        (hint-after 20 "Excess tether means that it lies round something; turns are taken off against them.")
        (at-most 90))
  (tender "Gives and takes a metre at a time."
    (let tend ()
      (cond ((or (< (loose) 2) (taut?)) (pay-out! 1 #:rate 1))
            ((and (> (loose) 4.5) (> (tether-length) 14)) (haul-in! 1 #:rate 1)))
      (run 1)
      (tend)))
  (count west (< (range-to '(-9 2 -17)) 2))
  (count north (< (range-to '(5 19 -17)) 2))
  (count east (< (range-to '(9 -3 -17)) 2))
  (count south (< (range-to '(-5 -19 -17)) 2))
  (score ((null? (contacts)) 1 1 #:share 0.9 #:weight 3
          #:as "tether on nothing"
          #:why "What you have not seen you have not cleared: keep well off, and above the bed.")
         ((abs (turns 'wreck/main-mast)) 0 0.6 #:by most #:over 0.4 #:weight 4
          #:as "turns about the mast"
          #:why "Half round by the one side, back, and half round by the other.")
         ((abs (net-turns)) 0 1 #:by most #:over 1 #:weight 2
          #:as "turns of the vehicle"
          #:why "A survey is flown with the bow on the wreck and no full circle.")
         (rov-clearance 1.2 +inf.0 #:by least #:over 1 #:weight 2
          #:as "room about the vehicle, m"
          #:why "Shrouds and nets stand off a wreck: what you see of it is not all of it."))
  (pilot expert "Two halves, each out and back by the same side."
    (answers (truth choices) truth)
    (flies (fly-legs '((-10 2 -17) (-4 20 -17) (4 20 -17) (-5 19 -17) (-11 0 -17) (-7 -19 -17) (2 -22 -17)
                       (9.5 -12 -17) (9.5 -3 -17)
                       (9.5 -12 -17) (2 -22 -17) (-7 -19 -17) (-10 -14 -16)) 0.7))
    (flies (undo-turns)))
  (pilot ordinary "Two halves, but close, and slowly."
    (answers (truth choices) truth)
    (flies (run 10)
           (fly-legs (list (list (+ -7.4 (jitter 0.1)) 2 -18) '(-2 18 -18) '(4 18 -18) '(-2 18 -18)
                           '(-7.4 2 -18) '(-5 -17.4 -18)
                           '(1 -18 -19) '(7.3 -8 -18) '(8 -3 -18) '(7.3 -8 -18)
                           '(1 -18 -19) '(-5 -17.4 -18) '(-10 -14 -16)) 0.55))
    (flies (run 10) (undo-turns)))
  (pilot careless "Once round, and home."
    (answers (truth choices) 'on-round-the-bow)
    (flies (fly-legs (list (list (+ -9 (jitter 0.3)) 2 -17) '(-2 19 -17) '(5 19 -17) '(10 8 -17) '(9 -3 -17)
                           '(5 -18 -17) '(-5 -19 -17)
                           '(-10 -14 -16)) 0.7))
    (flies (undo-turns))))

(define (all-seen?)
  (and-map (lambda (side) (> (counter side) 0)) '(west north east south)))

(define (loose) (* (slack) (tether-length)))

(define (undo-turns)
  ;; Against the turns there are, until none is left.
  (let ((sign (if (> (net-turns) 0) 1 -1)))
    (release!)
    (drive! #:yaw (* -0.5 sign))
    (run-until (lambda () (< (* sign (net-turns)) 0.05)) #:at-most 60)
    (release!)
    (hold-position!)))

(define (fly-legs points speed)
  (for-each (lambda (p) (fly-to! p #:speed speed) (run-until arrived? #:at-most 90)) points))
