;; Come to a vertical from down-current, so that the water carries the tether clear of it.
(define-lesson which-side-of-the-leg "Which side of the leg?"
  (grade 2)
  (trains route bow)
  (needs bow route)
  (setting set 0.15 0.25 0.35)
  (in (with jacket (current (setting 'set) (+ 90 (jitter 10)))))
  (say "A platform stands on four legs.  You are to look at the south-east leg, leg-b2, from the north, at
8 m.  Your tether comes from the south, and the current sets east.")
  (show)
  (probe "On which side of the leg do you pass, so that the water carries your tether clear of it?"
         'east #:choices (east west))
  (task "Fly to within a metre of the place north-east of leg-b2, and look at it for five seconds."
        (target "leg-b2" '(8 -2 -8))
        (done-when (< (range-to '(8 -2 -8)) 1))
        (held-for 5)
        (hint-after 60 "Down-current of the leg is east of it: go out east, four metres off the leg, and only then north."
                    "By (10 -9 -8) and (10 -4 -8).")
        (fail-when (parted?) "The tether has parted.")
        (at-most 180))
  (task "Home to within 1.5 m of where you began, clear of every leg."
        (target "home" '(-2 -14 -8))
        (done-when (and (< (range-to '(-2 -14 -8)) 1.5) (= 0 (winding 'jacket/leg-b2))))
        (hint-after 60 "Go back by the side that you came by.")
        (hint-after 120 "Wound must not name the leg: go round it the other way."
                    "(winding 'jacket/leg-b2) is the count about the leg; it must be 0.")
        (fail-when (parted?) "The tether has parted.")
        (at-most 200))
  (count touches (pair? (contacts)))
  (score ((null? (contacts)) 1 1 #:share 0.95 #:weight 4
          #:as "tether on nothing"
          #:why "Pass the leg down-current: the water then carries your tether off it.")
         ((abs (turns 'jacket/leg-b2)) 0 0.5 #:by most #:over 0.5 #:weight 3
          #:as "turns about the leg" #:why "Home by the side that you came by.")
         (rov-clearance 1 +inf.0 #:by least #:over 0.6 #:weight 4
          #:why "Four metres off the leg until you are north of it, and a metre at the work.")
         (max-tension 0 60 #:by most #:over 100
          #:why "A tether that pulls lies on something, or is too short: stop and look."))
  (pilot expert "Round by the east, and back the same way."
    (flies (fly-legs '((10 -10 -8) (10 -3 -8) (8 -2 -8)) 0.5))
    (flies (fly-legs '((10 -3 -8) (10 -10 -8) (-2 -14 -8)) 0.5)))
  (pilot ordinary "By the east, but close to the leg."
    (flies (fly-legs (list (list (+ 7.15 (jitter 0.05)) -8 -8) '(7.2 -5 -8) '(8 -2 -8)) 0.35))
    (flies (fly-legs (list '(7.2 -5 -8) (list (+ 7.15 (jitter 0.05)) -8 -8) '(-2 -14 -8)) 0.35)))
  (pilot careless "Through the jacket, up-current of the leg, and home by the outside."
    (answers (truth choices) 'west)
    (flies (fly-legs (list (list (+ 3.3 (jitter 0.2)) -9 -8) '(3.3 -2 -8) '(8 -2 -8)) 0.6))
    (flies (fly-legs '((9 -4 -8) (9 -9 -8) (-2 -14 -8)) 0.6))))

(define (fly-legs points speed)
  (for-each (lambda (p) (fly-to! p #:speed speed) (run-until arrived? #:at-most 60)) points))
