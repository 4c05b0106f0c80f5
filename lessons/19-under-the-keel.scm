;; A hull survey: under the keel and back under the keel, never up on the far side and home round her chain.
(define-lesson under-the-keel "A hull survey, under the keel"
  (grade 2)
  (trains route slack)
  (needs route slack)
  (setting speed 0.08 0.15 0.25)
  (in (with alongside (current (setting 'speed) (+ 180 (jitter 10)))))
  (say "The coaster lies at anchor with her bow to the north; you come from a boat on her port side.  Her
starboard bilge keel has been aground: you are to look at it from below.  She draws 4 m and
there are 22 m of water.")
  (say "Under a keel your tether has two edges to lie on, both of them overgrown.  Dive a few metres below
her, so that it hangs clear, and come back by the same way.  Ahead of her the
anchor chain goes down to the bed: who comes up on the far side and goes home round that has tied his boat to
the ship.")
  (show)
  (probe "How deep do you cross under her, for a tether that hangs clear of the turn of her bilge?" 8 #:within 2)
  (task "Under her to starboard: to within a metre of the target, and look up for eight seconds."
        (target "starboard" '(6.5 -3 -5.5))
        (done-when (< (range-to '(6.5 -3 -5.5)) 1))
        (held-for 8)
        (hint-after 30 "Down to 8 m first, on this side; then across; then up on the far side.")
        (fail-when (parted?) "The tether has parted.")
        (at-most 300))
  (fork-and-show "Watch what happens to one who goes home round the bow from here."
    (for-each (lambda (p) (fly-to! p #:speed 0.7) (run-until arrived? #:at-most 60))
              '((6 24 -3) (-4 25 -3) (-12 0 -4))))
  (task "Home to within 1.5 m of the boat, and your tether out from under her."
        (target "home" '(-12 0 -4))
        (done-when (and (< (range-to '(-12 0 -4)) 1.5) (< (tether-length) 14) (< (excess) 0.5)))
        (hint-after 40 "Down, across, up: as you came.")
        (hint-after 100 "Does the tender get nothing in?  Then it lies across her keel: go back under her.")
        (fail-when (parted?) "The tether has parted.")
        (at-most 240))
  (tender "In the boat: gives and takes by hand, a metre at a time."
    (let tend ()
      (cond ((or (< (loose) 1.5) (taut?)) (pay-out! 1 #:rate 1))
            ((and (> (loose) 3) (> (tether-length) 9)) (haul-in! 1 #:rate 0.8)))
      (run 1)
      (tend)))
  (score ((null? (contacts)) 1 1 #:share 0.9 #:weight 5
          #:as "tether off the hull"
          #:why "Deeper under her: what runs level from boat to bilge runs through her.")
         (rov-clearance 0.5 +inf.0 #:by least #:over 0.5 #:weight 3
          #:why "Paint on the vehicle, and none on the ship: half a metre at least.")
         (max-tension 0 80 #:by most #:over 120 #:weight 2
          #:why "Stop and think at the first resistance.")
         ((now) 0 150 #:by end #:over 200 #:as "time under her, s"
          #:why "Two and a half minutes: know the way across before you go down."))
  (pilot expert "Down to eight metres, across, up; and the same back."
    (answers (truth choices) truth)
    (flies (fly-legs '((-9 -1 -8.5) (6.5 -3 -8.5) (6.5 -3 -5.6)) 0.5))
    (flies (fly-legs '((6.5 -3 -8.5) (-9 -1 -8.5) (-12 0 -4)) 0.5)))
  (pilot ordinary "Under the keel, but he shaves it, and so does his tether."
    (answers (truth choices) 5.5)
    (flies (run 10) (fly-legs (list '(-7 -1 -5.2) (list 0 -2 (+ -4.9 (jitter 0.1))) '(6.5 -3 -5.5)) 0.35))
    (flies (run 15) (fly-legs (list (list 0 -2 (+ -4.9 (jitter 0.1))) '(-7 -1 -5.2) '(-12 0 -4)) 0.35)))
  (pilot careless "Under the keel, up on the far side, and home round the bow."
    (answers (truth choices) 4.5)
    (flies (fly-legs (list (list 0 (- -2 (jitter 0.3)) -4.6) '(6 -3 -5)) 0.6))
    (flies (fly-legs '((6 24 -3) (-4 25 -3) (-12 0 -4)) 0.7))))

(define (loose) (* (slack) (tether-length)))

(define (fly-legs points speed)
  (for-each (lambda (p) (fly-to! p #:speed speed) (run-until arrived? #:at-most 90)) points))
