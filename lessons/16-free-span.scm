;; Along a pipeline in a scour, from a garage: over it and back over it, never under it and home over.
(define-lesson free-span "A free span, from the garage"
  (grade 2)
  (trains route tide)
  (needs route slack)
  (setting speed 0.25 0.35 0.45)
  (in (with free-span (current (tide (speed (setting 'speed)) (toward (+ 90 (jitter 10))) (period 1440)))))
  (say "A pipeline of 20 inches crosses a scour, 12 m east of your garage and 12 m below it.  Between its
supports it hangs free, 1.2 m above the bed.  The client wants pictures of the span from both sides.")
  (say "There is room for you under the pipe.  There is none for a mistake: what goes in under a pipe and
comes home over it has put your tether round the pipe, and no winch takes that off.  Over, and back over.")
  (show)
  (probe "Which way do you cross to the far side, if you are to be hauled into the garage at any moment?"
         'over #:choices (over under))
  (task "The near side: look at the span from the target, within a metre, for five seconds."
        (target "near side" '(-2 6 -78))
        (done-when (< (range-to '(-2 6 -78)) 1))
        (held-for 5)
        (hint-after 30 "Down and north-east from the garage, west of the pipe all the way.")
        (fail-when (parted?) "The tether has parted.")
        (at-most 300))
  (task "The far side: look at it from the target, within a metre, for five seconds."
        (target "far side" '(2.5 6 -78))
        (done-when (< (range-to '(2.5 6 -78)) 1))
        (held-for 5)
        (hint-after 30 "Up to 75 m, east over the pipe, and down again on the far side.")
        (fail-when (parted?) "The tether has parted.")
        (at-most 300))
  (probe "You hang east of the pipe.  If the tender hauled now, what would the tether do?"
         (if (< (abs (winding 'pipeline/pipe)) 1) 'come-home 'hold) #:choices (come-home hold))
  (task "Home into the garage: within 1.2 m of its door, and less than 8 m of tether out."
        (target "garage" '(-11 -5 -69))
        (done-when (and (< (range-to '(-11 -5 -69)) 1.2) (< (tether-length) 8)))
        (hint-after 60 "The way you came: up, over the pipe, and then down-slope to the garage.")
        (hint-after 120 "The winch does not get it in?  Then it is round something: go back, and over or under again.")
        (fail-when (parted?) "The tether has parted.")
        (at-most 260))
  (tender "The winch of the garage: gives and takes a metre at a time."
    (let tend ()
      (cond ((or (< (loose) (+ 1 (* 0.06 (tether-length)))) (taut?)) (pay-out! 1 #:rate 1.1))
            ((and (> (loose) (+ 2 (* 0.1 (tether-length)))) (> (tether-length) 6)) (haul-in! 1 #:rate 1)))
      (run 0.8)
      (tend)))
  (score ((abs (turns 'pipeline/pipe)) 0 0.4 #:by most #:over 0.3 #:weight 4
          #:as "turns about the pipe"
          #:why "Under it and home over it is a turn, and it is there from the moment you went under.")
         ((null? (contacts)) 1 1 #:share 0.9 #:weight 3
          #:as "tether on nothing"
          #:why "Two metres over the pipe the tether clears its crown; the coating is no place for it.")
         (rov-clearance 0.7 +inf.0 #:by least #:over 0.6 #:weight 3
          #:why "Nearer than this the thrusters stir up the scour, and nobody sees anything.")
         (max-tension 0 200 #:by most #:over 300
          #:why "The garage gives at a metre a second: fly no faster, and do not pull."))
  (pilot expert "Over the pipe with two metres to spare, and back over it."
    (answers (truth choices) truth)
    (flies (fly-legs '((-5 4 -76) (-2 6 -78)) 0.5))
    (flies (fly-legs '((-1.5 6 -75.5) (2.5 6 -75.5) (2.5 6 -78)) 0.5))
    (flies (fly-legs '((2 6 -75.5) (-3 4 -75) (-11 -5 -69)) 0.5)))
  (pilot ordinary "Over it both ways, but so low that the tether lies on it."
    (answers (truth choices) (if (memq 'over choices) truth 'hold))
    (flies (run 10) (fly-legs '((-5 4 -78) (-2 6 -78)) 0.35))
    (flies (run 10) (fly-legs (list (list -1 6 (+ -77.75 (jitter 0.03))) '(1 6 -77.75) '(2.5 6 -78)) 0.3))
    (flies (run 15) (fly-legs (list (list 1 6 (+ -77.75 (jitter 0.03))) '(-1 5 -77.75) '(-11 -5 -69)) 0.4)))
  (pilot careless "Straight on, under the pipe, and home over it."
    (answers (truth choices) (if (memq 'under choices) 'under 'come-home))
    (flies (fly-legs '((-5 4 -78) (-2 6 -78)) 0.5))
    (flies (fly-legs (list (list -1.2 (+ 6 (jitter 0.3)) -79.4) '(1.5 6 -79.4) '(2.5 6 -78)) 0.5))
    (flies (fly-legs '((2 6 -75.5) (-3 4 -75) (-11 -5 -69)) 0.6))))

(define (loose) (* (slack) (tether-length)))

(define (fly-legs points speed)
  (for-each (lambda (p) (fly-to! p #:speed speed) (run-until arrived? #:at-most 90)) points))
