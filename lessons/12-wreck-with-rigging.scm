;; Beside a wreck and below its mast tops, never over it and never through its rigging.
(define-lesson wreck-with-rigging "A wreck's rigging: never over or through"
  (grade 3)
  (trains route)
  (needs bow route)
  (setting set 0.1 0.2 0.3)
  (in (with wreck (current (setting 'set) (+ 290 (jitter 10)))))
  (say "She lies on her side with masts and stays standing; stays are wires you may not see.  You are west
of her, the current sets west.  You are to look at her stem.")
  (show)
  (probe "The current sets west.  On which side of her do you go, so that your tether is carried clear?"
         'west #:choices (west over east))
  (task "Fly to within 1.5 m of the place off her stem, and look for five seconds."
        (target "stem" '(3 18 -19))
        (done-when (< (range-to '(3 18 -19)) 1.5))
        (held-for 5)
        (hint-after 60 "Stay 8 m west of her all the way north; only then east to the stem."
                    "(-10 4 -18), (-4 17 -19), then the stem.")
        (fail-when (parted?) "The tether has parted.")
        (at-most 240))
  (task "Home to within 1.5 m of where you began, beside your tether."
        (target "home" '(-10 -8 -16))
        (done-when (< (range-to '(-10 -8 -16)) 1.5))
        (hint-after 90 "Go back as you came: west of her first, then south."
                    "(-4 17 -19), (-10 4 -18), home.")
        (fail-when (parted?) "The tether has parted.")
        (at-most 240))
  (count crossings (over-her?))
  (score ((counter 'crossings) 0 0 #:by end #:over 2 #:weight 3
          #:as "times over her" #:why "Over a wreck your tether lies across her: go beside her.")
         (rov-clearance 2.5 +inf.0 #:by least #:over 2.5 #:weight 4
          #:why "Stays are wires you may not see: keep well off all of her.")
         (clearance 1 +inf.0 #:by least #:over 1 #:weight 3
          #:why "Eight metres down-current of her the water carries your tether clear.")
         (max-tension 0 60 #:by most #:over 100
          #:why "A tether that pulls beside a wreck is a tether on the wreck."))
  (pilot expert "Beside her, down-current, both ways."
    (flies (fly-legs '((-11 4 -18) (-5 18 -19) (3 18 -19)) 0.5))
    (flies (fly-legs '((-5 18 -19) (-11 4 -18) (-10 -8 -16)) 0.5)))
  (pilot ordinary "Beside her, but so near that the tether touches her."
    (flies (fly-legs (list (list (+ -4.6 (jitter 0.1)) 4 -20) '(0.6 16.4 -20) '(3 18 -19)) 0.35))
    (flies (run 15) (fly-legs (list '(0.6 16.4 -20) (list (+ -4.6 (jitter 0.1)) 4 -20) '(-10 -8 -16)) 0.35)))
  (pilot careless "Straight over her, and through between the masts."
    (answers (truth choices) 'over)
    (flies (fly-legs (list (list 1 (jitter 0.5) -14) '(7 6 -14) '(3 18 -19)) 0.6))
    (flies (fly-legs '((8 4 -15) (0 -4 -13) (-10 -8 -16)) 0.6))))

(define (over-her?)
  ;; Whether the vehicle is within her length and breadth, seen from above; she heads 20 degrees.
  (let* ((p (rov-position)) (c 0.9397) (s 0.3420)
         (along (+ (* s (x p)) (* c (y p))))
         (off (- (* c (x p)) (* s (y p)))))
    (and (< (abs along) 15) (< (abs off) 4))))

(define (fly-legs points speed)
  (for-each (lambda (p) (fly-to! p #:speed speed) (run-until arrived? #:at-most 90)) points))
