;; No picture, and something holds: what the counter, the load cell and your own pull tell of a wire unseen.
(define-world down-line
  "A wire from a buoy to the bed, and a tether that has been led round it."
  (sea      (depth 18) (current 0.08 90))
  (seabed   (friction 0.6))
  (capsule  (named wire) (from 3 0 1) (to 3 0 -18) (radius 0.012) (friction 0.3))
  (rov      (named minnow) (at -2 -2 -7) (heading 240))
  (tether   (named line) (type fathom) (wet-weight 0) (friction 0.4) (model dynamic)
            (from 0 -16 -2) (to minnow) (via (5 -3 -5) (5 1.5 -6) (2 1.8 -6.5)) (length 29)))

(define-lesson caught-on-a-wire "Caught on a wire, and no picture"
  (grade 3)
  (trains unwrapping blind)
  (needs slack unwrapping)
  (setting set 0.04 0.08 0.12)
  (hides look status tether-points point-at tangent-at slack excess taut-length free-length contacts clearance
         rov-clearance contact-length turns winding windings wrap-angle foresee what-if fouled? in-view? sonar
         tether-in-view way-home unwind-plan segments haul-prospect)
  (in (with down-line (current (setting 'set) (+ 90 (jitter 15)))))
  (gauge "ship, m" (ship-range))
  (gauge "bears" (ship-bearing))
  (gauge "counter, m" (payout-counter))
  (say "The camera has failed.  You have a compass, depth, range and bearing to the ship, the counter of the
winch, and the pull of your tether.  You left the ship northward and passed east of where a buoy's
down-line should be; then you were north of it, and then you came round to the south-west, where you are now.")
  (say "The ship is ~a m away.  The counter of the winch shows ~a m.  Remember both." (ship-range) (payout-counter))
  (task "On to the south-west, gently, until something holds you.  Then stop, and tell the tender: t, and then held."
        (done-when (and (note-pull!) (pair? (messages))))
        (hint-after 30 "A third of the stick ahead is enough, heading 240; watch the pull."
                    "(drive! #:surge 0.3); watch (rov-tension).")
        (hint-after 60 "Do you feel it?  Centre the sticks, then t, and held."
                    "(tell! 'tender \"held\")")
        (fail-when (> (max-tension) 250) "You pulled with more than 250 N at something that you do not know.")
        (at-most 240))
  (probe "Taut, there are 29 m out.  How far is the ship, straight through the water, m?" (ship-range) #:within 2)
  (probe "So what holds you?" 'round-something #:choices (round-something at-the-end a-turn-of-the-winch))
  (task "Free it by the way you came, and stand within 2 m of the place south-east of the wire, free to be hauled."
        (target "clear" '(5 -9 -6))
        (done-when (and (< (range-to '(5 -9 -6)) 2) (< (excess) 0.4)))
        (hint-after 20 "Slack first: astern a little.  Then by your own track: north-east, past the wire on its north
side, east of it, and south.")
        (hint-after 70 "The counter says 29 m, the ship is near, and nothing pulls: that is what free feels like.")
        (fail-when (> (max-tension) 250) "You pulled with more than 250 N: a wire cuts.")
        (fail-when (parted?) "The tether has parted.")
        (at-most 240))
  (tender "Answers that he holds, and does not haul."
    (run-until (lambda () (told 'tender)))
    (tell! 'pilot "Held, understood.  I do not haul."))
  (score (max-tension 0 80 #:by most #:over 150 #:weight 4
          #:as "hardest pull, N"
          #:why "Come up on what holds you gently: a wire under load cuts a jacket.")
         ((seconds-till-told) 0 10 #:by end #:over 40 #:weight 3
          #:as "from held to told, s" #:why "The tender must know before he hauls, not after.")
         ((abs (net-turns)) 0 1 #:by end #:over 1 #:weight 1
          #:as "turns left at the end" #:why "Turning about to look at it twists the tether round the wire.")
         ((now) 0 150 #:by end #:over 200 #:weight 2
          #:as "time, s" #:why "By your own track it is a minute; by guessing it is ten."))
  (pilot expert "Feels it, stops, says so, and goes back by his own track."
    (answers (truth choices) truth)
    (flies (hold-heading! 240) (run 4) (drive! #:surge 0.25) (run-until (lambda () (> (rov-tension) 12)) #:at-most 60)
           (release!) (tell! 'tender "held"))
    (flies (fly-legs '((-1 1 -6.5) (3 3.5 -6.5) (6.5 1 -6) (5 -9 -6)) 0.45)))
  (pilot ordinary "Is not sure, pulls once more, says so, and goes back wide."
    (answers (truth choices) (if choices truth (+ truth 6)))
    (flies (hold-heading! 240) (run 8) (drive! #:surge 0.5) (run-until (lambda () (> (rov-tension) 12)) #:at-most 60)
           (run (+ 25 (jitter 3))) (release!) (tell! 'tender "held"))
    (flies (run 15) (fly-legs '((-2 5 -6) (4 7 -6) (9 1 -6) (5 -9 -6)) 0.3)))
  (pilot careless "Full ahead; then straight home by the bearing of the ship."
    (answers (truth choices) (if choices 'at-the-end 29))
    (flies (hold-heading! 240) (run 2) (drive! #:surge 1) (run (+ 50 (jitter 5))) (tell! 'tender "held"))
    (flies (fly-legs '((0 -12 -5) (5 -9 -6)) 0.6) (drive! #:surge 1))))

(define (note-pull!)
  ;; Remember when he was first held.
  (if (and (= 0 (counter 'held)) (> (rov-tension) 10))
      (begin (count! 'held) (count! 'held-at (now))))
  (if (and (= 0 (counter 'told)) (pair? (messages)))
      (begin (count! 'told) (count! 'told-at (now))))
  #t)

(define (seconds-till-told)
  (if (= 0 (counter 'held))
      (if (= 0 (counter 'told)) 0 60)   ; told before it was so
      (- (if (= 0 (counter 'told)) (now) (counter 'told-at)) (counter 'held-at))))

(define (fly-legs points speed)
  (for-each (lambda (p) (fly-to! p #:speed speed) (run-until arrived? #:at-most 90)) points))
