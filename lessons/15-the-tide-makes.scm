;; After a vehicle lost on a jacket, its tether chafed through in the tide: break off while you still can.
(define-lesson the-tide-makes "The tide makes, and the tether chafes"
  (grade 4)
  (trains tide crew)
  (needs tide unwrapping)
  (setting tide 0.45 0.55 0.65)
  (hides wear wear-profile)
  (in (with tidal-jacket (current 0.15 (+ 270 (jitter 10)))))
  (say "You survey a node on the east side of a jacket from a ship that heaves in the swell.
Your tether comes up past the south-east leg, which is grown over with mussels.  The survey would take six
minutes, and the first minute of it is worth having.  The tide is on the make.  You can break off at any
time: tell the tender: t, and then abort.  Nothing shows you how far the tether is worn;
(load-cell) shows how hard it is held.")
  (show)
  (probe "The tide sets west.  Where does it lay your tether, while you are at the node?"
         'on-the-leg #:choices (clear on-the-leg on-the-bed))
  (task "Survey: stay within 2 m of the node for a minute or more, and break off in time."
        (target "survey" '(9 4 -8))
        (first (pay-out! 11 #:rate 0.6))
        (done-when (and (note-survey!) (pair? (messages))))
        (fault-after 80 "The ship: the tide is making." (current! 0.35 270))
        (fault-after 130 "The ship: more than was forecast, and still making." (current! (setting 'tide) 270))
        (hint-after 20 "Stay east of the leg: out east of it first, then north to the node."
                    "(fly-to! '(10 -4 -8) #:speed 0.5), then (9 4 -8).")
        (hint-after 150 "The load cell, T, shows twice what it did, and every swell saws: is it worth it?")
        (fail-when (worn-through?) "The jacket is worn through: no picture, no power.")
        (fail-when (parted?) "The tether has parted.")
        (at-most 330))
  (probe "What wears your tether most, now: the tide by itself, the swell, or your thrusters?" 'swell
         #:choices (tide swell thrusters))
  (task "Home: to within 2 m of where you began, with the tether off the leg."
        (target "home" '(-2 -14 -8))
        (done-when (and (< (range-to '(-2 -14 -8)) 2) (< (abs (turns 'mussels)) 0.2)))
        (hint-after 40 "Back along your tether, east of the leg, until you are south of it."
                    "(11 -4 -8), (9 -11 -8), home.")
        (hint-after 90 "Never pull it round the leg: what is taut saws.  Up to it, past it, then home.")
        (fail-when (worn-through?) "The jacket is worn through: no picture, no power.")
        (fail-when (parted?) "The tether has parted.")
        (at-most 220))
  (tender "Holds what is out while he surveys; takes in what he brings home."
    (run-until (lambda () (told 'tender)))
    (tell! 'pilot "Breaking off.  I take in what you bring.")
    (let take-in ()
      (if (and (> (slack) 0.15) (> (tether-length) 14)) (haul-in! 0.5))
      (run 1)
      (take-in)))
  (score ((worn-when-he-broke-off) 0 50 #:by end #:over 30 #:weight 4
          #:as "worn as you broke off, %" #:why "The load cell shows twice what it did: that is the time to go.")
         ((* 100 (wear)) 0 60 #:by end #:over 40 #:weight 3
          #:as "worn at the end, %" #:why "What is taut saws: up to the leg, past it, then home.")
         ((counter 'surveyed) 60 +inf.0 #:by end #:over 60 #:weight 3
          #:as "time at the node, s" #:why "The first minute is worth having: be at the node for it.")
         (rov-clearance 0.5 +inf.0 #:by least #:over 0.5
          #:why "A ship that heaves in the swell moves you too: keep off the leg."))
  (pilot expert "Watches the load cell, and goes when it has doubled."
    (answers (truth choices) truth)
    (flies (fly-legs '((10 -4 -8) (9 4 -8)) 0.5)
           (run 60) (run-until (lambda () (> (load-cell) 15)) #:at-most 60) (tell! 'tender "abort"))
    (flies (fly-legs '((11 -3 -8) (10 -10 -8) (-2 -14 -8)) 0.5)))
  (pilot ordinary "One more minute, and then another; then home close to the leg."
    (answers (truth choices) (if (memq 'tide choices) 'tide truth))
    (flies (run 5) (fly-legs '((10 -4 -8) (9 4 -8)) 0.4) (run (+ 180 (jitter 4))) (tell! 'tender "abort"))
    (flies (run 10) (fly-legs '((8.5 -4 -8) (8 -9 -8) (-2 -14 -8)) 0.4)))
  (pilot careless "Finishes the survey, up and down, and then it is too late."
    (answers (truth choices) (if (memq 'clear choices) 'clear 'thrusters))
    (flies (fly-legs '((9 -4 -8) (9 4 -8)) 0.5)
           (let survey ()
             (fly-legs (list (list 9 4 (+ -5 (jitter 0.3))) '(9 4 -9)) 0.5)
             (survey)))))

(define (note-survey!)
  ;; Count the seconds at the node, and remember how far the tether was worn when it was broken off.
  (if (< (range-to '(9 4 -8)) 2) (count! 'surveyed 0.2))
  (if (pair? (messages)) (count! 'worn-at-abort (* 100 (wear))))
  #t)

(define (worn-when-he-broke-off)
  ;; Percent; how far it is worn now, if he never did.
  (if (pair? (messages)) (counter 'worn-at-abort) (* 100 (wear))))

(define (worn-through?) (>= (wear) 1))

(define (fly-legs points speed)
  ;; In a swell one is never quite there.
  (for-each (lambda (p)
              (fly-to! p #:speed speed)
              (run-until (lambda () (< (range-to p) 1)) #:at-most 60))
            points))
