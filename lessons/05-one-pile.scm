;; Out round a pile and back by the same side: what goes round must come back round.
(define-lesson one-pile "One pile, out and back"
  (grade 1)
  (trains route)
  (needs slack)
  (setting set 0.05 0.15 0.25)
  (in (with pile (current (setting 'set) (+ 90 (jitter 20)))))
  (say "There is one pile here, and there is work on the far side of it.  Every time you go round a pile
your tether goes round it too, and what is wound does not come off by pulling.")
  (show)
  (task "Fly to the far side of the pile, to within a metre of the target."
        (target "far side" '(0 5 -5))
        (done-when (< (range-to '(0 5 -5)) 1))
        (hint-after 60 "Choose a side and keep it, some four metres off the pile."
                    "(fly-to! '(4 0 -5)), then (fly-to! '(0 5 -5)).")
        (fail-when (parted?) "The tether has parted.")
        (at-most 180))
  (probe "On which side of the pile does your tether pass it?"
         (if (> (turns 'p1) 0) 'west 'east) #:choices (east west))
  (fork-and-show "Watch what happens to one who goes on round, and home by the other side."
    (for-each (lambda (p) (fly-to! p #:speed 0.6) (run-until arrived? #:at-most 60))
              (if (> (turns 'p1) 0)
                  '((4 3 -5) (4 -4 -5) (-4 -4 -5) (-4 0 -5))
                  '((-4 3 -5) (-4 -4 -5) (4 -4 -5) (6 -6 -5)))))
  (task "Come home to within a metre of where you began, with no turn round the pile."
        (target "home" '(6 -6 -5))
        (done-when (and (< (range-to '(6 -6 -5)) 1) (= 0 (winding 'p1))))
        (hint-after 60 "Go back the way you came: by the same side, along your tether.")
        (hint-after 120 "Wound tells how often the tether goes round the pile: + is clockwise."
                    "(winding 'p1)")
        (fail-when (parted?) "The tether has parted.")
        (at-most 240))
  (score ((abs (turns 'p1)) 0 0.6 #:by most #:over 0.3 #:weight 3
          #:as "turns about the pile" #:why "Out by one side and home by the same: half a turn, and off again.")
         (rov-clearance 1 +inf.0 #:by least #:over 0.7 #:weight 4
          #:why "A metre at least: the current sets you onto the pile while you look at it.")
         (clearance 0.02 +inf.0 #:share 0.9 #:weight 2
          #:why "Four metres off the pile your tether passes clear of it too."))
  (pilot expert "Out and back on the east, well clear."
    (flies (fly-legs '((5 -1 -5) (3 3 -5) (0 5 -5)) 0.4))
    (flies (fly-legs '((3 3 -5) (5 -1 -5) (6 -6 -5)) 0.4)))
  (pilot ordinary "The same side, but he cuts the corners."
    (answers (truth choices) truth)
    (flies (fly-legs (list (list (+ 1.15 (jitter 0.1)) 0 -5) '(0 5 -5)) 0.35))
    (flies (run 40) (fly-legs (list (list (+ 1.15 (jitter 0.1)) 0 -5) '(6 -6 -5)) 0.35)))
  (pilot careless "Out on the east, home by the west."
    (answers (truth choices) 'west)
    (flies (fly-legs (list (list (+ 1.1 (jitter 0.1)) 0 -5) '(0 5 -5)) 0.5))
    (flies (fly-legs '((-3 3 -5) (-3 -4 -5) (6 -6 -5)) 0.5))))

(define (fly-legs points speed)
  (for-each (lambda (p) (fly-to! p #:speed speed) (run-until arrived? #:at-most 90)) points))
