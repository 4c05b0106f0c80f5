;; Between the moorings of a net pen: go in through one bay, and home through the same.
(define-lesson between-the-moorings "A net pen, between its moorings"
  (grade 2)
  (trains route unwrapping)
  (needs route bow)
  (setting speed 0.2 0.3 0.4)
  (in (with net-pen (current (list 'profile (list 0 (setting 'speed) (+ 90 (jitter 10))) '(-30 0.1 70)))))
  (say "A diver saw a hole in the south-west side of this net.  You are to find it: look at the net there from a
metre.  The pen hangs on eight moorings that run out and down from its collar; the boat lies south-west,
outside the bay between the moorings 4 (south) and 5 (south-west); the hole is in the next bay, beyond
mooring 5 and short of mooring 6 (west).")
  (say "A mooring is a slope: near the pen it is high, far out it is deep.  Over it or under it makes no
difference to you, and all the difference to your tether: by what side of a line you went, you come home.")
  (show)
  (probe "You go to the hole over mooring 5, well out from the pen.  How do you come home?"
         'above-it #:choices (above-it under-it round-the-pen))
  (task "To the hole in the net: to within a metre of the target, and look for eight seconds."
        (target "hole" '(-10.6 -4.4 -6))
        (done-when (< (range-to '(-10.6 -4.4 -6)) 1))
        (held-for 8)
        (hint-after 40 "Over mooring 5 well out from the pen, where it is deep: west first, and then north."
                    "(-18 -12 -5), then (-15 -6 -6).")
        (fail-when (parted?) "The tether has parted.")
        (at-most 300))
  (probe "Which mooring does your tether cross on its way home?" 'mooring-5
         #:choices (mooring-4 mooring-5 mooring-6))
  (task "Home to within 1.5 m of the boat, your tether off every mooring."
        (target "home" '(-8 -16 -5))
        (done-when (and (< (range-to '(-8 -16 -5)) 1.5) (< (excess) 0.5) (< (tether-length) 18)))
        (hint-after 50 "Back over mooring 5, where you came, and only then east to the boat.")
        (hint-after 120 "Held?  Wound tells by what.  Go back round it the way you came; do not pull."
                     "(contacts)")
        (fail-when (parted?) "The tether has parted.")
        (at-most 240))
  (tender "A deck hand with the tether in his hands: a metre at a time, hand-tight."
    (let tend ()
      (cond ((or (< (loose) 1.5) (taut?)) (pay-out! 1 #:rate 1))
            ((and (> (loose) 3) (> (tether-length) 13)) (haul-in! 1 #:rate 0.8)))
      (run 1)
      (tend)))
  (score ((null? (contacts)) 1 1 #:share 0.9 #:weight 4
          #:as "tether on nothing"
          #:why "The water carries a loose tether onto net and moorings: well out, and hand-tight.")
         ((abs (turns 'mooring-5)) 0 0.5 #:by end #:over 0.5 #:weight 3
          #:as "turns about mooring 5"
          #:why "Out above a mooring and home under it is a turn about it.")
         (rov-clearance 0.7 +inf.0 #:by least #:over 0.5 #:weight 3
          #:why "A propeller in a net is the end of the day: stay a metre off.")
         (max-tension 0 80 #:by most #:over 100
          #:why "What pulls is taut over a mooring, or short: ask for a metre before you push."))
  (pilot expert "Over mooring 5 far out, and back the same way."
    (answers (truth choices) truth)
    (flies (fly-legs '((-18 -12 -5) (-15 -6 -6) (-11.1 -4.6 -6)) 0.5))
    (flies (fly-legs '((-15 -6 -6) (-18 -12 -5) (-8 -16 -5)) 0.5)))
  (pilot ordinary "The same way, but close in, where the mooring is high."
    (answers (truth choices) (if (memq 'mooring-4 choices) 'mooring-6 truth))
    (flies (run 10) (fly-legs (list (list (+ -11 (jitter 0.2)) -9 -3) '(-10.6 -5.2 -5) '(-10.6 -4.6 -6)) 0.35))
    (flies (run 10) (fly-legs (list '(-10.6 -5.2 -5) (list (+ -11 (jitter 0.2)) -9 -3) '(-8 -16 -5)) 0.35)))
  (pilot careless "Out over the mooring, and home under it, by the shortest line."
    (answers (truth choices) (if (memq 'under-it choices) 'under-it 'mooring-4))
    (flies (fly-legs '((-13 -10 -4) (-11 -4.4 -6)) 0.5))
    (flies (fly-legs (list (list -13 (+ -7 (jitter 0.3)) -13) '(-10 -13 -14) '(-8 -16 -5)) 0.6))))

(define (loose) (* (slack) (tether-length)))

(define (fly-legs points speed)
  (for-each (lambda (p) (fly-to! p #:speed speed) (run-until arrived? #:at-most 90)) points))
