;; A day from the garage: the tide that carries the tether clear on the way out lays it on the riser later.
(define-lesson tms-day "A day from the garage"
  (grade 3)
  (trains tide route)
  (needs bow route)
  (setting speed 0.25 0.35 0.45)
  (in (with garage (current (tide (speed (setting 'speed)) (toward (+ 0 (jitter 10))) (period 1080)))))
  (say "Your garage hangs 20 m above the blow-out preventer, 7 m west of its riser.  The work is a valve 100 m
east of the garage.  The tide sets north, and by the tables turns at 360 s: then it sets
south.  The winch of the garage holds your slack; what the tide does with your tether is yours to foresee.")
  (show)
  (probe "On which side of the riser do you go out, so that the tide carries your tether clear of it?"
         'north #:choices (north south))
  (probe "And after the turn, where does it lay a tether that leads north of the riser?"
         'on-the-riser #:choices (clear on-the-riser))
  (task "Out to the valve, to within 1.5 m of it, and look at it for ten seconds."
        (target "valve" '(92 8 -75))
        (done-when (< (range-to '(92 8 -75)) 1.5))
        (held-for 10)
        (fault-after 60 "The ship: the tide is early.  It turns at 270 s, not at 360.")
        (hint-after 20 "North of the riser, ten metres clear, then the valve."
                    "(fly-to! '(0 10 -68) #:speed 0.8)")
        (fail-when (parted?) "The tether has parted.")
        (at-most 320))
  (probe "It turns at 270 s; you make 0.8 m/s.  By what time, at the latest, must you leave to be at the
garage by then?" (- 270 (/ (range-to '(-6 1 -67.5)) 0.8)) #:within 25)
  (task "Home into the garage: within 1.2 m of its door, less than 6 m of tether out, no turn left in it."
        (target "garage" '(-6 1 -67.5))
        (done-when (and (< (range-to '(-6 1 -67.5)) 1.2) (< (tether-length) 6)
                        (< (abs (turns 'wellhead/riser)) 0.5) (< (abs (net-turns)) 1)))
        (hint-after 60 "The way you came, north of the riser, before the tide turns.")
        (hint-after 200 "Touching?  Never pull: give slack, and go round the riser as your tether does.")
        (fail-when (parted?) "The tether has parted.")
        (at-most 230))
  (tender "The winch of the garage: gives and takes a metre at a time."
    (let tend ()
      (cond ((or (< (loose) (+ 1 (* 0.06 (tether-length)))) (taut?)) (pay-out! 1 #:rate 1.1))
            ((and (> (loose) (+ 2 (* 0.1 (tether-length)))) (> (tether-length) 5)) (haul-in! 1 #:rate 1)))
      (run 0.8)
      (tend)))
  (score ((now) 0 270 #:by end #:over 150 #:weight 3
          #:as "time, s" #:why "Home before the tide turns: it lays your tether on the riser then.")
         ((null? (contacts)) 1 1 #:share 0.95 #:weight 4
          #:as "tether on nothing" #:why "North of the riser, ten metres clear, as long as the tide sets north.")
         ((/ (max-tension) 50) 0 20 #:by most #:over 20
          #:as "hardest pull, % of 5 kN" #:why "Touching?  Give slack, and go round as your tether does.")
         (rov-clearance 2 +inf.0 #:share 0.9 #:weight 2
          #:why "Two metres off riser and well head: the tide carries you while you look."))
  (pilot expert "Out at once, and home as soon as he hears that the tide is early."
    (answers (truth choices) truth)
    (flies (fly-legs '((0 9 -68) (92 8 -75)) 0.85))
    (flies (fly-legs '((0 9 -68) (-4 4 -67.5) (-6 1 -67.5)) 0.85)))
  (pilot ordinary "The right side, but he takes his time."
    (answers (truth choices) (if choices truth (+ truth 50)))
    (flies (run 15) (fly-legs '((0 6 -68) (92 8 -75)) (+ 0.65 (jitter 0.02))))
    (flies (run 15) (fly-legs '((0 6 -68) (-4 3 -67.5) (-6 1 -67.5)) (+ 0.65 (jitter 0.02)))))
  (pilot careless "Out north, a long look round, and home south of the riser when the tide has turned."
    (answers (truth choices) (cond ((not choices) 300) ((memq 'clear choices) 'clear) (else truth)))
    (flies (run 30) (fly-legs '((0 4 -68) (92 8 -75)) (+ 0.6 (jitter 0.02))))
    (flies (run 120) (fly-legs '((2 -6 -68) (-4 -4 -67.5) (-6 1 -67.5)) 0.6))))

(define (loose) (* (slack) (tether-length)))

(define (fly-legs points speed)
  (for-each (lambda (p) (fly-to! p #:speed speed) (run-until arrived? #:at-most 250)) points))
